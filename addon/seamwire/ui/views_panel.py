# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar's panel in Object Mode with views of the active object."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import bpy

from ..core.drawing.options import strength_name
from ..mesh import settings as chosen
from ..view.timer import Timer
from .properties import draw_views

if TYPE_CHECKING:
    from ..core.network.picks import Along


class VIEW3D_PT_seamwire_views(bpy.types.Panel):
    """Views of what wires follow on the active object"""  # noqa: D400 - a tooltip

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Seamwire"
    bl_label = "Seamwire Views"
    bl_context = "objectmode"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether a mesh is active."""
        return context.active_object is not None and context.active_object.type == "MESH"

    def draw_header(self, context: bpy.types.Context) -> None:
        """Show the switch for all views."""
        self.layout.prop(chosen.settings(context), "views_in_object_mode", text="")

    def draw(self, context: bpy.types.Context) -> None:
        """Show the views and the settings that they depend on."""
        layout, settings = self.layout, chosen.settings(context)
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.active = settings.views_in_object_mode
        draw_views(settings, layout)
        layout.prop(settings, "along")
        layout.prop(settings, strength_name(_along(settings)))
        layout.prop(settings, "metric")
        layout.menu("VIEW3D_MT_seamwire_store_view")


def _along(settings: chosen.SeamwireSettings) -> Along:
    """Return how wires would run on the object whose views are shown."""
    if settings.along != "AUTO":
        return settings.along
    module = sys.modules.get(f"{chosen.ADDON}.view.object_mode")
    return "EDGES" if module is None else module.object_mode.best_along


def _follow() -> None:
    if chosen.settings().views_in_object_mode:
        from ..view.object_mode import object_mode

        object_mode.start()


_timer = Timer(_follow, persistent=True)


def register() -> None:
    """Add the panel, and show the views again that were on."""
    bpy.utils.register_class(VIEW3D_PT_seamwire_views)
    chosen.listeners.append(_follow)
    _timer.start(after=0.5)


def unregister() -> None:
    """Remove the panel and the views."""
    if _follow in chosen.listeners:
        chosen.listeners.remove(_follow)
    _timer.stop()
    module = sys.modules.get(f"{chosen.ADDON}.view.object_mode")
    if module is not None:
        module.object_mode.stop()
    bpy.utils.unregister_class(VIEW3D_PT_seamwire_views)
