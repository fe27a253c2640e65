# SPDX-License-Identifier: GPL-3.0-or-later
"""The card of first steps: a gizmo that takes clicks on its close button and its link, and lets everything else through."""

from __future__ import annotations

import bpy

from ..mesh.redraw import redraw_views
from ..mesh.registration import classes, together
from ..mesh.settings import preferences, tool_is_active
from .report import running

OPERATOR = "mesh.seamwire_card"
_PARTS = ("CLOSE", "LINK")
_NOWHERE = -1
_ENOUGH = 3
"""Chains after which nobody needs the first steps."""


class MESH_OT_seamwire_card(bpy.types.Operator):
    """Close the card, or open the guide"""  # noqa: D400 - a tooltip

    bl_idname = OPERATOR
    bl_label = "Seamwire First Steps"
    bl_options = {"INTERNAL"}

    part: bpy.props.EnumProperty(
        name="Part",
        description="What was clicked",
        items=(("CLOSE", "Close", "Close the card for good"), ("LINK", "Open the Guide", "Open the guide")),
    )

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Do what the part of the card is for."""
        from ..words import card as words

        if self.part == "LINK":
            return bpy.ops.wm.url_open(url=words.guide())
        close(context)
        return {"FINISHED"}


class SEAMWIRE_GT_card(bpy.types.Gizmo):
    """The card in the largest view of a window."""

    bl_idname = "SEAMWIRE_GT_card"
    _part: str | None = None

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the card, if the view has room for it."""
        # Not before the tool is used: Blender's start is not to wait for NumPy.
        from ..view import card

        placed = card.placed(context.area, context.region) if shows_in(context) else None
        if placed is not None:
            card.draw(placed, self._part if self.is_highlight else None)

    def test_select(self, context: bpy.types.Context, location: tuple[int, int]) -> int:
        """Take the mouse over the close button and the link only."""
        from ..view import card

        placed = card.placed(context.area, context.region) if shows_in(context) else None
        before, self._part = self._part, None if placed is None else placed.part_at(tuple(location))
        if self._part != before:
            context.area.tag_redraw()
        return _NOWHERE if self._part is None else _PARTS.index(self._part)


class SEAMWIRE_GGT_card(bpy.types.GizmoGroup):
    """The card in all 3D views."""

    bl_idname = "SEAMWIRE_GGT_card"
    bl_label = "Seamwire First Steps"
    bl_space_type = "VIEW_3D"
    bl_region_type = "WINDOW"
    bl_options = {"PERSISTENT", "SHOW_MODAL_ALL"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether the tool waits for a first click, and the card was not closed yet."""
        return not running and tool_is_active(context) and preferences(context).show_card

    @classmethod
    def setup_keymap(cls, configuration: bpy.types.KeyConfig) -> bpy.types.KeyMap:
        """Let a press click the card. Blender's own keys do; keys of ours would stay after the add-on is disabled."""
        return configuration.keymaps.new(name="Generic Gizmo")

    def setup(self, _context: bpy.types.Context) -> None:
        """Make it."""
        gizmo = self.gizmos.new(SEAMWIRE_GT_card.bl_idname)
        for number, part in enumerate(_PARTS):
            gizmo.target_set_operator(OPERATOR, index=number).part = part


def shows_in(context: bpy.types.Context) -> bool:
    """Return whether the card is shown in the region: in the window's largest 3D view, and in a quad view in the user's."""
    areas = [area for area in context.window.screen.areas if area.type == "VIEW_3D"]
    area = max(areas, key=lambda area: area.width * area.height, default=None)
    if area is None or area != context.area:
        return False
    # Of the four views of a quad view, Blender lists the user's last.
    return [region for region in area.regions if region.type == "WINDOW"][-1] == context.region


def chain_drawn(context: bpy.types.Context) -> None:
    """Count a chain that was kept, and close the card after a few."""
    chosen = preferences(context)
    if not chosen.show_card:
        return
    chosen.chains_drawn += 1
    if chosen.chains_drawn >= _ENOUGH:
        close(context)


def close(context: bpy.types.Context) -> None:
    """Close the card for good."""
    chosen = preferences(context)
    chosen.show_card, chosen.chains_drawn = False, 0
    context.preferences.is_dirty = True
    redraw_views()


_CLASSES = (MESH_OT_seamwire_card, SEAMWIRE_GT_card, SEAMWIRE_GGT_card)
register, unregister = together(*classes(*_CLASSES))
