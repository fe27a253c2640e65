# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that save a mesh's wires as a file, and load them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import bpy
from bpy_extras.io_utils import ExportHelper, ImportHelper

from ..mesh.settings import settings
from .report import count, in_edit_mode

if TYPE_CHECKING:
    from ..core.network_file import NetworkFile

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
        from ..core.native import NativeError
        from ..mesh.object_session import ObjectSession

        try:
            mesh = ObjectSession(context.active_object)
            network = mesh.network_file(settings(context))
        except (ValueError, NativeError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if mesh.problem:
            self.report({"WARNING"}, mesh.problem)
        if not network.courses and not network.strokes:
            self.report({"ERROR"}, "The mesh has no wires to save: Take Over Seams makes wires of its seams")
            return {"CANCELLED"}
        try:
            _write(Path(self.filepath), network.text())
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
    from ..core.network_file import NetworkFile

    try:
        text = Path(path).read_text(encoding="utf-8")
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

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether a mesh is in edit mode."""
        return in_edit_mode(cls, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Read the file, and write its wires to the mesh."""
        from ..core.native import NativeError
        from ..mesh import edit_mesh
        from ..mesh.object_session import ObjectSession

        try:
            network = read_network(self.filepath)
            mesh = ObjectSession(context.active_object)
            problem = network.problem_with(mesh.cage.vertex_count, mesh.arrays.edges)
            if problem:
                raise ValueError(problem)
        except (ValueError, NativeError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        arrays = mesh.arrays
        wires = network.wires(arrays.points, arrays.to_object)
        there = {wire.vertices for wire in mesh.session.wires}
        new = [wire for wire in wires if wire.vertices not in there]
        mesh.add(new, network.strokes_on(arrays.points, arrays.to_object))
        marked, _ = mesh.write(mesh.plan())
        edit_mesh.live_unwrap(context)
        already = f", {len(wires) - len(new)} there already" if len(new) < len(wires) else ""
        self.report({"INFO"}, f"{count(len(new), 'wire')} loaded{already}, {count(marked, 'edge')} marked")
        return {"FINISHED"}


CLASSES = (MESH_OT_seamwire_save_network, MESH_OT_seamwire_load_network)


def register() -> None:
    """Add the operators."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    """Remove them."""
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
