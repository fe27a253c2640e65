# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that save networks, load them and draw them on other meshes, and their menus."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

import bpy
from bpy_extras.io_utils import ExportHelper, ImportHelper

from .tool import (
    EditMeshOperator,
    Step,
    Stepwise,
    classes,
    count,
    menu_entry,
    settings,
    together,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Generator

    from .carry import Source
    from .tool import ObjectSession, Wire
    from .transfer import Transfer

SUFFIX = ".json"
_PLACE_ITEMS = (
    (
        "AUTO",
        "Automatic",
        "By vertex numbers if both meshes have the same topology, otherwise by pairs or on the surface",
    ),
    ("NUMBERS", "Vertex Numbers", "Vertex by vertex, on a mesh with the same topology"),
    ("SURFACE", "Nearest Surface", "At the nearest point, on a mesh with a similar shape"),
)
_MOST_TOLD = 12
"""The largest number of problems to report one by one."""


class _Placing(Stepwise):
    """Gives an operator the steps that place a network on the active mesh. The operator has `source` and the properties."""

    pairs = ""
    mirror: bpy.props.EnumProperty(
        name="Mirror",
        description="Axis to mirror the seams over before they are placed",
        items=(("NONE", "None", ""), ("X", "X", ""), ("Y", "Y", ""), ("Z", "Z", "")),
        default="NONE",
    )
    align: bpy.props.BoolProperty(
        name="Align",
        description="Move, rotate and scale the network onto the mesh if it does not lie there already",
        default=True,
    )

    def source_steps(self, context: bpy.types.Context) -> Generator[Step, None, Source]:
        raise NotImplementedError

    def steps(self, context: bpy.types.Context) -> Generator[Step, None, set[str]]:
        from .carry import carry_over

        pairs = _pairs(self.pairs)
        source = yield from self.source_steps(context)
        mesh = self.open_mesh(context.active_object)
        mirror = None if self.mirror == "NONE" else "XYZ".index(self.mirror)
        work = carry_over(mesh, source, place=self.place, mirror=mirror, align=self.align, pairs=pairs)
        found = yield from _done("Placing wires", work)
        _read_again(self, mesh)
        return self._write(context, mesh, found)

    def _write(self, context: bpy.types.Context, mesh: ObjectSession, found: Transfer) -> set[str]:
        from .carry import add

        problems = found.problems
        for text in problems[:_MOST_TOLD]:
            self.report({"WARNING"}, text[:1].upper() + text[1:])
        if len(problems) > _MOST_TOLD:
            self.report({"WARNING"}, f"{len(problems) - _MOST_TOLD} more seeds are doubtful or missing")
        if not found.wires and not found.strokes:
            raise ValueError("No wire could be placed on this mesh")
        wires = add(mesh, found)
        marked = self.write(context, [mesh])
        parts = [count(wires, "wire")]
        if wires < len(found.wires):
            parts.append(f"{len(found.wires) - wires} already present")
        parts.append(f"{count(marked, 'edge')} marked")
        if found.seeds:
            parts.append(f"seeds: {', '.join(f'{number} {degree}' for degree, number in found.degrees.items())}")
        if found.added:
            parts.append(f"{count(found.added, 'seed')} added in between")
        if found.lost:
            parts.append(f"{len(found.lost)} not placed")
        self.report({"INFO"}, ", ".join(parts))
        return {"FINISHED"}


def _done(text: str, work: Callable[..., object]) -> Generator[Step, None, object]:
    found = []
    yield Step(text, lambda progress: found.append(work(progress=progress)))
    return found[0]


def _read_again(operator: Stepwise, mesh: ObjectSession) -> None:
    """Read a mesh again after steps beside the interface. Raise ValueError if wires would run on it in another way."""
    if operator.is_beside and not (mesh.alive() and mesh.refresh(mesh.obj)):
        raise ValueError("The mesh changed while wires were placed")


def _pairs(text: str) -> list[tuple[int, int]]:
    """Read pairs of vertices of two meshes, such as ``"7-12 40-41"``. Raise ValueError if one is malformed."""
    pairs = []
    for token in text.replace(",", " ").replace(";", " ").split():
        match = re.fullmatch(r"(\d+)-(\d+)", token)
        if match is None:
            raise ValueError(f"Pairs: '{token}' is not a pair of vertices such as 7-12")
        pairs.append((int(match[1]), int(match[2])))
    return pairs


class MESH_OT_seamwire_transfer(_Placing, bpy.types.Operator):
    """Draw the seams of another object on the active mesh, and report how certain each seed is"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_transfer"
    bl_label = "Transfer Seamwires"

    source: bpy.props.StringProperty(
        name="Source", description="Object with the seams. If empty, the other selected object"
    )
    place: bpy.props.EnumProperty(
        name="Place",
        description="How to place seeds",
        items=(*_PLACE_ITEMS, ("PAIRS", "Pairs", "By distances along the surface to pairs of vertices, in any pose")),
        default="AUTO",
    )
    pairs: bpy.props.StringProperty(
        name="Pairs",
        description="Matching vertices, each as the source's number, a hyphen and this mesh's number. If empty, the centers of"
        " vertex groups with the same names",
    )

    def draw(self, _context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.prop_search(self, "source", bpy.data, "objects")
        layout.prop(self, "place")
        pairs = layout.row()
        pairs.enabled = self.place in {"AUTO", "PAIRS"}
        pairs.prop(self, "pairs")
        surface = layout.column()
        surface.enabled = self.place in {"AUTO", "SURFACE"}
        surface.prop(self, "mirror")
        surface.prop(self, "align")

    def source_steps(self, context: bpy.types.Context) -> Generator[Step, None, Source]:
        from .carry import Source, seam_wires

        obj = self._object(context)
        mesh = self.open_mesh(obj)
        wires = yield from _done("Reading seams", partial(seam_wires, mesh))
        source = Source.of(mesh, settings(context), wires)
        if not source.network.courses:
            raise ValueError(f"{obj.name} has no seams")
        return source

    def _object(self, context: bpy.types.Context) -> bpy.types.Object:
        target = context.active_object
        if self.source:
            obj = bpy.data.objects.get(self.source)
            if obj is None:
                raise ValueError(f"No object is named {self.source}")
            found = [obj]
        else:
            found = [obj for obj in context.selected_objects if obj.type == "MESH" and obj.data != target.data]
        if len(found) != 1 or found[0].type != "MESH" or found[0].data == target.data:
            raise ValueError("Select one other mesh object, or name the source")
        return found[0]


class MESH_OT_seamwire_load_network(_Placing, bpy.types.Operator, ImportHelper):
    """Draw the wires from a file on the active mesh"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_load_network"
    bl_label = "Load Seamwire Network"

    filename_ext = SUFFIX
    filter_glob: bpy.props.StringProperty(default=f"*{SUFFIX}", options={"HIDDEN"})
    place: bpy.props.EnumProperty(name="Place", description="How to place seeds", items=_PLACE_ITEMS, default="AUTO")
    _is_chosen = False

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        self._is_chosen = True
        return ImportHelper.invoke(self, context, event)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Place the network: in a window beside the interface, after the artist has chosen a file."""
        if not self._is_chosen:
            return super().execute(context)
        self._is_chosen = False
        return super().invoke(context, None)

    def source_steps(self, _context: bpy.types.Context) -> Generator[Step, None, Source]:
        from .carry import Source

        yield Step("Reading the file")
        return Source.load(Path(bpy.path.abspath(self.filepath)))


class MESH_OT_seamwire_save_network(EditMeshOperator, bpy.types.Operator, ExportHelper):
    """Save the wires and strokes of the active mesh to a file. Other meshes can load it"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_save_network"
    bl_label = "Save Seamwire Network"
    bl_options: ClassVar[set[str]] = set()

    filename_ext = SUFFIX
    filter_glob: bpy.props.StringProperty(default=f"*{SUFFIX}", options={"HIDDEN"})

    def run(self, context: bpy.types.Context) -> set[str]:
        """Write the file completely, or leave an existing file unchanged."""
        from .carry import network_of

        network = network_of(self.open_mesh(context.active_object), settings(context))
        if not network.courses and not network.strokes:
            raise ValueError("No wires to save: Seams to Seamwires turns seams into wires")
        path = Path(bpy.path.abspath(self.filepath))
        beside = path.with_name(f"{path.name}.part")
        try:
            beside.write_text(network.text(), encoding="utf-8")
            beside.replace(path)
        except OSError as error:
            raise ValueError(f"Cannot write the file: {error}") from error
        finally:
            beside.unlink(missing_ok=True)
        saved = f"{count(len(network.courses), 'wire')}, {count(len(network.strokes), 'stroke')} saved"
        self.report({"INFO"}, saved)
        return {"FINISHED"}


class MESH_OT_seamwire_repeat(Stepwise, bpy.types.Operator):
    """Repeat all wires, or those with selected edges, wherever edges match"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_repeat"
    bl_label = "Repeat Seamwires"

    selected: bpy.props.BoolProperty(
        name="Selected Only",
        description="Repeat only wires with selected edges, and those connected to them",
        default=False,
    )

    def steps(self, context: bpy.types.Context) -> Generator[Step, None, set[str]]:
        from .repeats import missing_wires

        mesh = self.open_mesh(context.active_object)
        groups = self._groups(mesh)
        if not groups:
            raise ValueError(f"No {'selected wire' if self.selected else 'wire'} along edges to repeat")
        places, new = yield from _done("Finding matching places", partial(missing_wires, groups, mesh.arrays))
        _read_again(self, mesh)
        if not new:
            self.report({"INFO"}, "No other unmarked place matches these wires")
            return {"CANCELLED"}
        mesh.add(new)
        marked = self.write(context, [mesh])
        self.report(
            {"INFO"}, f"Repeated at {count(places, 'place')}: {count(len(new), 'wire')}, {count(marked, 'edge')} marked"
        )
        return {"FINISHED"}

    def _groups(self, mesh: ObjectSession) -> list[list[Wire]]:
        from .repeats import connected_groups

        wires = [wire for wire in mesh.session.wires if wire.along == "EDGES"]
        wanted = wires
        if self.selected:
            chosen = {
                tuple(sorted(vertex.index for vertex in edge.verts))
                for edge in mesh.cage.number_bmesh().edges
                if edge.select
            }
            wanted = [wire for wire in wires if not chosen.isdisjoint(wire.edges())]
        return connected_groups(wanted, wires)


def _draw_network(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    layout = menu.layout
    layout.operator_context = "INVOKE_DEFAULT"
    layout.operator("mesh.seamwire_repeat", text="Repeat")
    layout.operator("mesh.seamwire_transfer", text="Transfer")
    layout.separator()
    layout.operator("mesh.seamwire_load_network", text="Load...")
    layout.operator("mesh.seamwire_save_network", text="Save...")


def _draw_import(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    menu.layout.operator("mesh.seamwire_load_network", text="Seamwire Network (.json)")


def _draw_export(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    menu.layout.operator("mesh.seamwire_save_network", text="Seamwire Network (.json)")


register, unregister = together(
    *classes(
        MESH_OT_seamwire_transfer,
        MESH_OT_seamwire_load_network,
        MESH_OT_seamwire_save_network,
        MESH_OT_seamwire_repeat,
    ),
    menu_entry("VIEW3D_MT_seamwire_network", _draw_network),
    menu_entry("TOPBAR_MT_file_import", _draw_import),
    menu_entry("TOPBAR_MT_file_export", _draw_export),
)
