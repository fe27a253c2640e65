# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that save the wires of a mesh to a file, and load them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

import bpy
from bpy_extras.io_utils import ExportHelper, ImportHelper

from ..mesh.registration import classes, together
from ..mesh.settings import settings
from ..words.names import count
from .edit_mesh_operator import EditMeshOperator
from .transfer import ALIGN, MIRROR_ITEMS, PLACE_ITEMS, axis_of, write_and_report

if TYPE_CHECKING:
    from ..core.storage.network_file import NetworkFile

SUFFIX = ".json"


class MESH_OT_seamwire_save_network(EditMeshOperator, bpy.types.Operator, ExportHelper):
    """Save the wires and strokes of the active mesh to a file. Other meshes can load it"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_save_network"
    bl_label = "Save Seamwire Network"
    bl_options: ClassVar[set[str]] = set()

    filename_ext = SUFFIX
    filter_glob: bpy.props.StringProperty(default=f"*{SUFFIX}", options={"HIDDEN"})

    def run(self, context: bpy.types.Context) -> set[str]:
        """Write the file completely, or leave an existing file unchanged."""
        network = self.open_mesh(context.active_object).network_file(settings(context))
        if not network.courses and not network.strokes:
            self.report({"ERROR"}, "No wires to save: Seams to Seamwires turns seams into wires")
            return {"CANCELLED"}
        try:
            _write(Path(bpy.path.abspath(self.filepath)), network.text())
        except OSError as error:
            self.report({"ERROR"}, f"Cannot write the file: {error}")
            return {"CANCELLED"}
        saved = f"{count(len(network.courses), 'wire')}, {count(len(network.strokes), 'stroke')} saved"
        self.report({"INFO"}, saved)
        return {"FINISHED"}


def _write(path: Path, text: str) -> None:
    beside = path.with_name(f"{path.name}.part")
    try:
        beside.write_text(text, encoding="utf-8")
        beside.replace(path)
    finally:
        beside.unlink(missing_ok=True)


def read_network(path: str) -> NetworkFile:
    """Read a file. Raise ValueError with a sentence for the artist if that fails."""
    from ..core.storage.network_file import NetworkFile

    try:
        text = Path(bpy.path.abspath(path)).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"Cannot read the file: {error}") from error
    return NetworkFile.parse(text)


class MESH_OT_seamwire_load_network(EditMeshOperator, bpy.types.Operator, ImportHelper):
    """Draw the wires from a file on the active mesh"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_load_network"
    bl_label = "Load Seamwire Network"

    filename_ext = SUFFIX
    filter_glob: bpy.props.StringProperty(default=f"*{SUFFIX}", options={"HIDDEN"})
    place: bpy.props.EnumProperty(name="Place", description="How to place seeds", items=PLACE_ITEMS, default="AUTO")
    mirror: bpy.props.EnumProperty(
        name="Mirror",
        description="Axis to mirror the network over before it is placed",
        items=MIRROR_ITEMS,
        default="NONE",
    )
    align: bpy.props.BoolProperty(name="Align", description=ALIGN, default=True)

    def run(self, context: bpy.types.Context) -> set[str]:
        """Read the file, and write its wires to the mesh."""
        from ..mesh.transfer import carry_over

        network = read_network(self.filepath)
        mesh = self.open_mesh(context.active_object)
        found = carry_over(mesh, network, place=self.place, mirror=axis_of(self.mirror), align=self.align)
        return write_and_report(self, context, mesh, found)


CLASSES = (MESH_OT_seamwire_save_network, MESH_OT_seamwire_load_network)


register, unregister = together(*classes(*CLASSES))
