# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that brings the seams of another object to the active one."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import bpy

from ..mesh.settings import settings
from ..words.names import DEGREE_NAMES, count
from .edit_mesh_operator import EditMeshOperator, changing

if TYPE_CHECKING:
    from ..core.matching.transferred import Transfer
    from ..mesh.object_session import ObjectSession

PLACE_ITEMS = (
    (
        "AUTO",
        "Automatic",
        "By vertex numbers if both meshes have the same topology, otherwise by pairs or on the surface",
    ),
    ("NUMBERS", "Vertex Numbers", "Vertex by vertex, on a mesh with the same topology"),
    ("SURFACE", "Nearest Surface", "At the nearest point, on a mesh with a similar shape"),
)
MIRROR_ITEMS = (("NONE", "None", ""), ("X", "X", ""), ("Y", "Y", ""), ("Z", "Z", ""))
ALIGN = "Move, rotate and scale the network onto the mesh if it does not lie there already"
_MOST_TOLD = 12
"""The largest number of problems to report one by one."""


def axis_of(name: str) -> int | None:
    """Return the axis of an item of `MIRROR_ITEMS`."""
    return None if name == "NONE" else "XYZ".index(name)


def write_and_report(
    operator: bpy.types.Operator, context: bpy.types.Context, mesh: ObjectSession, found: Transfer
) -> set[str]:
    """Write the wires to the mesh, and report how certain each seed is and what is missing."""
    from ..core.matching.transferred import DEGREES
    from ..mesh import edit_mesh
    from ..mesh.transfer import write

    told = [*found.doubts, *found.lost, *(seed.message for seed in found.seeds if seed.confidence < DEGREES[1][0])]
    for text in map(str, told[:_MOST_TOLD]):
        operator.report({"WARNING"}, text[:1].upper() + text[1:])
    if len(told) > _MOST_TOLD:
        operator.report({"WARNING"}, f"{len(told) - _MOST_TOLD} more seeds are doubtful or missing")
    if not found.wires and not found.strokes:
        operator.report({"ERROR"}, "No wire could be placed on this mesh")
        return {"CANCELLED"}
    with changing():
        wires, marked = write(mesh, found)
        edit_mesh.live_unwrap(context)
    parts = [count(wires, "wire")]
    if wires < len(found.wires):
        parts.append(f"{len(found.wires) - wires} already present")
    parts.append(f"{count(marked, 'edge')} marked")
    if found.seeds:
        degrees = (f"{number} {DEGREE_NAMES[degree]}" for degree, number in found.degrees.items())
        parts.append(f"seeds: {', '.join(degrees)}")
    if found.added:
        parts.append(f"{count(found.added, 'seed')} added in between")
    if found.lost:
        parts.append(f"{len(found.lost)} not placed")
    operator.report({"INFO"}, ", ".join(parts))
    return {"FINISHED"}


class MESH_OT_seamwire_transfer(EditMeshOperator, bpy.types.Operator):
    """Draw the seams of another object on the active mesh, and report how certain each seed is"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_transfer"
    bl_label = "Transfer Seamwires"

    source: bpy.props.StringProperty(
        name="Source", description="Object with the seams. If empty, the other selected object"
    )
    place: bpy.props.EnumProperty(
        name="Place",
        description="How to place seeds",
        items=(
            *PLACE_ITEMS,
            ("PAIRS", "Pairs", "By distances along the surface to pairs of vertices, in any pose"),
        ),
        default="AUTO",
    )
    pairs: bpy.props.StringProperty(
        name="Pairs",
        description="Matching vertices, each as the source's number, a hyphen and this mesh's number. If empty, the centers of"
        " vertex groups with the same names",
    )
    mirror: bpy.props.EnumProperty(
        name="Mirror",
        description="Axis to mirror the seams over before they are placed",
        items=MIRROR_ITEMS,
        default="NONE",
    )
    align: bpy.props.BoolProperty(name="Align", description=ALIGN, default=True)

    def draw(self, _context: bpy.types.Context) -> None:
        """Show the settings that have an effect."""
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

    def run(self, context: bpy.types.Context) -> set[str]:
        """Read the source, and write its seams to the active mesh."""
        from ..mesh import transfer

        target = context.active_object
        source = self._source(context)
        pairs = _pairs(self.pairs)
        if not pairs and self.place == "PAIRS":
            target.update_from_editmode()
            pairs = transfer.pairs_of_groups(source, target)
            if len(pairs) < 3:
                raise ValueError(
                    f"Give at least three pairs of vertices: the objects share {count(len(pairs), 'vertex group')}"
                )
        drawn = self.open_mesh(source)
        network = transfer.network_of(drawn, settings(context))
        mesh = self.open_mesh(target)
        found = transfer.carry_over(
            mesh,
            network,
            place=self.place,
            mirror=axis_of(self.mirror),
            align=self.align,
            source=transfer.shape_of(drawn.arrays),
            pairs=pairs,
        )
        return write_and_report(self, context, mesh, found)

    def _source(self, context: bpy.types.Context) -> bpy.types.Object:
        """Return the object with the seams. Raise ValueError if it is ambiguous."""
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


def _pairs(text: str) -> list[tuple[int, int]]:
    """Read pairs of vertices of two meshes, such as ``"7-12 40-41"``. Raise ValueError if one is malformed."""
    pairs = []
    for token in text.replace(",", " ").replace(";", " ").split():
        match = re.fullmatch(r"(\d+)-(\d+)", token)
        if match is None:
            raise ValueError(f"Pairs: '{token}' is not a pair of vertices such as 7-12")
        pairs.append((int(match[1]), int(match[2])))
    return pairs


register, unregister = bpy.utils.register_classes_factory((MESH_OT_seamwire_transfer,))
