# SPDX-License-Identifier: GPL-3.0-or-later
"""Deprecated names of operators, for old scripts and keymaps. The search does not find them."""

from __future__ import annotations

import bpy

from ..mesh.registration import classes, together
from .edit_mesh_operator import EditMeshOperator
from .finish import finish_wires
from .islands import SelectingIslands, kind_property
from .store import ISLAND_ITEMS, Storing


class _Alias(EditMeshOperator):
    """Reports its new name and does the same."""

    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    def _warn(self, old: str, new: str) -> None:
        self.report({"WARNING"}, f"mesh.seamwire_{old} is deprecated and will be removed: use mesh.seamwire_{new}")


class MESH_OT_seamwire_cut(_Alias, bpy.types.Operator):
    """Deprecated: use Finish Seamwires"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_cut"
    bl_label = "Cut Seamwires"

    def run(self, context: bpy.types.Context) -> set[str]:
        """Cut the kept wires."""
        self._warn("cut", "finish(finish='CUT')")
        return finish_wires(self, context, "CUT")


class MESH_OT_seamwire_slide(_Alias, bpy.types.Operator):
    """Deprecated: use Finish Seamwires"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_slide"
    bl_label = "Slide Seamwires"

    def run(self, context: bpy.types.Context) -> set[str]:
        """Slide vertices onto the kept wires."""
        self._warn("slide", "finish(finish='SLIDE')")
        return finish_wires(self, context, "SLIDE")


class MESH_OT_seamwire_select_islands_to_cut(_Alias, SelectingIslands, bpy.types.Operator):
    """Deprecated: use Select Islands"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_select_islands_to_cut"
    bl_label = "Select Islands to Cut"

    def run(self, context: bpy.types.Context) -> set[str]:
        """Select them."""
        self._warn("select_islands_to_cut", "select_islands(which='TO_CUT')")
        return self.select_islands_to_cut(context)


class MESH_OT_seamwire_worst_island(_Alias, SelectingIslands, bpy.types.Operator):
    """Deprecated: use Select Islands"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_worst_island"
    bl_label = "Select Worst Stretched Island"

    kind: kind_property()

    def run(self, context: bpy.types.Context) -> set[str]:
        """Select it."""
        self._warn("worst_island", "select_islands(which='WORST')")
        return self.select_worst_island(context, self.stretch_kind(context))


class MESH_OT_seamwire_store_islands(_Alias, Storing, bpy.types.Operator):
    """Deprecated: use Store Islands"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_store_islands"
    bl_label = "Store Islands"

    kind: bpy.props.EnumProperty(name="As", description="How to store islands", items=ISLAND_ITEMS)

    def run(self, context: bpy.types.Context) -> set[str]:
        """Store the islands."""
        self._warn("store_islands", f"store(what='{self.kind}')")
        return self.store_islands(context, self.kind)


register, unregister = together(
    *classes(
        MESH_OT_seamwire_cut,
        MESH_OT_seamwire_slide,
        MESH_OT_seamwire_select_islands_to_cut,
        MESH_OT_seamwire_worst_island,
        MESH_OT_seamwire_store_islands,
    )
)
