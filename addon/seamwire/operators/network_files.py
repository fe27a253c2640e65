# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that save a mesh's wires as a file, and load them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

import bpy
from bpy_extras.io_utils import ExportHelper, ImportHelper

from ..mesh.settings import settings
from ..words.names import count
from .edit_mesh_operator import EditMeshOperator
from .transfer import ALIGN, MIRROR_ITEMS, PLACE_ITEMS, axis_of, write_and_report

if TYPE_CHECKING:
    from ..core.storage.network_file import NetworkFile

SUFFIX = ".json"


class MESH_OT_seamwire_save_network(EditMeshOperator, bpy.types.Operator, ExportHelper):
    """Save the wires and strokes of the active mesh as a file that other meshes can load"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_save_network"
    bl_label = "Save Seamwire Network"
    bl_options: ClassVar[set[str]] = set()

    filename_ext = SUFFIX
    filter_glob: bpy.props.StringProperty(default=f"*{SUFFIX}", options={"HIDDEN"})

    def run(self, context: bpy.types.Context) -> set[str]:
        """Write the file, whole or not at all."""
        network = self.open_mesh(context.active_object).network_file(settings(context))
        if not network.courses and not network.strokes:
            self.report({"ERROR"}, "The mesh has no wires to save: Take Over Seams makes wires of its seams")
            return {"CANCELLED"}
        try:
            _write(Path(bpy.path.abspath(self.filepath)), network.text())
        except OSError as error:
            self.report({"ERROR"}, f"The file cannot be written: {error}")
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
    """Read a file; raises ValueError with a sentence for the artist where it cannot be read."""
    from ..core.storage.network_file import NetworkFile

    try:
        text = Path(bpy.path.abspath(path)).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"The file cannot be read: {error}") from error
    return NetworkFile.parse(text)


class MESH_OT_seamwire_load_network(EditMeshOperator, bpy.types.Operator, ImportHelper):
    """Draw the wires of a saved network on the active mesh"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_load_network"
    bl_label = "Load Seamwire Network"

    filename_ext = SUFFIX
    filter_glob: bpy.props.StringProperty(default=f"*{SUFFIX}", options={"HIDDEN"})
    place: bpy.props.EnumProperty(name="Place", description="How seeds are placed", items=PLACE_ITEMS, default="AUTO")
    mirror: bpy.props.EnumProperty(
        name="Mirror",
        description="The axis over which the network is mirrored first",
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


register, unregister = bpy.utils.register_classes_factory(CLASSES)
