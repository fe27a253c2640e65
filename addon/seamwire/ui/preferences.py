# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's preferences: the look of the drawing, and the keys."""

from __future__ import annotations

import bpy

from ..mesh.registration import classes, together
from ..mesh.settings import ADDON, SeamwireSettings
from ..operators import bindings, select_islands
from ..words.keys import Action
from . import toolbar


def _color(name: str, description: str, default: tuple[float, float, float, float]) -> object:
    return bpy.props.FloatVectorProperty(
        name=name, description=description, subtype="COLOR_GAMMA", size=4, min=0.0, max=1.0, default=default
    )


class SeamwirePreferences(bpy.types.AddonPreferences):
    """The preferences that Blender stores."""

    bl_idname = ADDON

    tool: bpy.props.PointerProperty(type=SeamwireSettings)

    wheel_switches: bpy.props.BoolProperty(
        name="Wheel Takes Next Candidate",
        description="While a wire is live, the wheel takes the next candidate, and Ctrl and the wheel zoom",
        default=False,
    )
    line_width: bpy.props.FloatProperty(
        name="Line Width",
        description="Scale of wires and seeds, in addition to Blender's display scale",
        default=1.0,
        min=0.25,
        max=5.0,
        soft_max=3.0,
    )
    theme_colors: bpy.props.BoolProperty(
        name="Use Theme Colors", description="Draw kept wires in the theme's color for seams", default=True
    )
    active_color: _color("Live Wire", "The wire that a click keeps", (1.0, 0.72, 0.05, 1.0))
    other_color: _color("Next Candidate", "The next candidate", (0.45, 0.8, 1.0, 0.9))
    kept_color: _color("Kept Wires", "Wires whose edges become seams", (1.0, 0.2, 0.1, 1.0))
    clear_color: _color("Cleared Seams", "Wires that clear seams", (0.82, 0.86, 0.95, 1.0))
    loop_color: _color("Loop", "The loop that a click adds", (0.3, 1.0, 0.55, 1.0))
    seed_color: _color("Seeds", "Seeds, and the edge or vertex under the cursor", (1.0, 1.0, 1.0, 1.0))
    tint: bpy.props.FloatProperty(
        name="Island Tint",
        description="Strength of the islands' colors. 0 turns them off",
        default=0.22,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )
    show_text: bpy.props.BoolProperty(
        name="Viewport Text",
        description="Show the number of islands and other information in the 3D view",
        default=True,
    )
    first_steps: bpy.props.BoolProperty(
        name="First Steps",
        description="Show the first steps in the corner of the 3D view until a few chains are drawn",
        default=True,
    )

    def draw(self, context: bpy.types.Context) -> None:
        """Show the preferences."""
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        column = layout.column(heading="Drawing")
        column.prop(self, "line_width")
        column.prop(self, "tint")
        column.prop(self, "show_text")
        column.prop(self, "first_steps")
        layout.column(heading="Mouse").prop(self, "wheel_switches")
        column = layout.column(heading="Colors")
        column.prop(self, "theme_colors")
        kept = column.row()
        kept.enabled = not self.theme_colors
        kept.prop(self, "kept_color")
        for name in ("active_color", "other_color", "clear_color", "loop_color", "seed_color"):
            column.prop(self, name)
        layout.use_property_split = False
        draw_keys(layout, context)


def draw_keys(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """Show the keys, so that users can change them."""
    configuration = context.window_manager.keyconfigs.user
    box = layout.box()
    box.label(text="Keys of the Tool", icon="MOUSE_LMB")
    keys = configuration.keymaps.get(toolbar.KEYMAP) if configuration is not None else None
    for item in bindings.items_of(keys, toolbar.OPERATOR) if keys is not None else ():
        _draw_key(box, keys, item, item.properties.bl_rna.properties["first"].enum_items[item.properties.first].name)
    for item in bindings.items_of(keys, select_islands.OPERATOR) if keys is not None else ():
        _draw_key(box, keys, item, item.properties.bl_rna.properties["which"].enum_items[item.properties.which].name)
    for item in bindings.items_of(keys, "wm.call_panel") if keys is not None else ():
        _draw_key(box, keys, item, Action.KEYS.text)
    keys = bindings.user_keymap(context.window_manager)
    if keys is None:
        box.label(text="No keymaps available")
        return
    box = layout.box()
    box.label(text="Keys While a Chain Is Drawn", icon="MOUSE_LMB")
    last: Action | None = None
    order = list(Action)
    items = bindings.items_of(keys, bindings.ACTION_OPERATOR)
    for item in sorted(items, key=lambda item: order.index(Action[item.properties.action])):
        action = Action[item.properties.action]
        _draw_key(box, keys, item, action.text if action is not last else "")
        last = action
    row = box.row()
    row.context_pointer_set("keymap", keys)
    row.label()
    if keys.is_user_modified:
        row.operator("preferences.keymap_restore", text="Restore All", icon="BACK")


def _draw_key(box: bpy.types.UILayout, keys: bpy.types.KeyMap, item: bpy.types.KeyMapItem, text: str) -> None:
    split = box.split(factor=0.4)
    split.label(text=text)
    row = split.row()
    row.context_pointer_set("keymap", keys)
    row.prop(item, "active", text="", emboss=False)
    sub = row.row()
    sub.active = item.active
    sub.prop(item, "map_type", text="")
    sub.prop(item, "type", text="", full_event=True)
    if item.value == "DOUBLE_CLICK":
        sub.label(text="twice")
    if item.is_user_modified:
        row.operator("preferences.keyitem_restore", text="", icon="BACK").item_id = item.id


def _list() -> None:
    """List the add-on in Blender's preferences, which hold its settings. Blender's option ``--addons`` does not."""
    addons = bpy.context.preferences.addons
    if ADDON not in addons:
        addons.new().module = ADDON


register, unregister = together(*classes(SeamwirePreferences), (_list, lambda: None))
