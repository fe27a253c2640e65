# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that save a mesh's wires as a file, and load them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import bpy
from bpy_extras.io_utils import ExportHelper, ImportHelper

from ..mesh.settings import settings
from .report import count, in_edit_mode, open_mesh
from .transfer import ALIGN, MIRROR_ITEMS, PLACE_ITEMS, axis_of, write_and_report

if TYPE_CHECKING:
    from ..core.storage.network_file import NetworkFile

SUFFIX = ".json"


class MESH_OT_seamwire_save_network(bpy.types.Operator, ExportHelper):
    """Save the wires and strokes of the active mesh as a file that other meshes can load"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_save_network"
    bl_label = "Save Seamwire Network"

    filename_ext = SUFFIX
    filter_glob: bpy.props.StringProperty(default=f"*{SUFFIX}", options={"HIDDEN"})

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether a mesh is in edit mode."""
        return in_edit_mode(cls, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Write the file, whole or not at all."""
        from ..core.base.native import NativeError

        try:
            mesh = open_mesh(self, context.active_object)
            network = mesh.network_file(settings(context))
        except (ValueError, NativeError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
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


class MESH_OT_seamwire_load_network(bpy.types.Operator, ImportHelper):
    """Draw the wires of a saved network on the active mesh"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_load_network"
    bl_label = "Load Seamwire Network"
    bl_options = {"REGISTER", "UNDO"}

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

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether a mesh is in edit mode."""
        return in_edit_mode(cls, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Read the file, and write its wires to the mesh."""
        from ..core.base.native import NativeError
        from ..mesh.transfer import carry_over

        try:
            network = read_network(self.filepath)
            mesh = open_mesh(self, context.active_object)
            found = carry_over(mesh, network, place=self.place, mirror=axis_of(self.mirror), align=self.align)
        except (ValueError, NativeError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return write_and_report(self, context, mesh, found)


CLASSES = (MESH_OT_seamwire_save_network, MESH_OT_seamwire_load_network)


def register() -> None:
    """Add the operators."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    """Remove them."""
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
