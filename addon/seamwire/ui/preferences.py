# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's preferences: the look of the drawing, and the keys."""

from __future__ import annotations

import bpy

from ..mesh.registration import classes, together
from ..mesh.settings import ADDON, SeamwireSettings
from ..operators import island_operators
from ..tool import keymaps
from ..words.keys import Action
from . import toolbar


class _Chosen:
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
    tint: bpy.props.FloatProperty(
        name="Island Tint",
        description="Strength of the islands' colors. 0 turns them off",
        default=0.22,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )
    text: bpy.props.EnumProperty(
        name="Text in the View",
        description="What the corner of the 3D view says",
        items=(
            ("STEPS", "First Steps", "The first steps until a few chains are drawn, and information"),
            ("INFORMATION", "Information", "The number of islands and other information"),
            ("NONE", "Nothing", "No text"),
        ),
    )


class SeamwireDefaults(_Chosen, bpy.types.PropertyGroup):
    """The preferences while Blender does not list the add-on. They start with the defaults, and are not stored in Blender's preferences."""


class SeamwirePreferences(_Chosen, bpy.types.AddonPreferences):
    bl_idname = ADDON

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        column = layout.column(heading="Drawing")
        column.prop(self, "line_width")
        column.prop(self, "tint")
        column.prop(self, "text")
        layout.column(heading="Mouse").prop(self, "wheel_switches")
        layout.use_property_split = False
        draw_keys(layout, context)


def draw_keys(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    box = layout.box()
    box.label(text="Keys of the Tool", icon="MOUSE_LMB")
    keys = keymaps.user_keymap(context.window_manager, toolbar.KEYMAP)
    for operator, name in ((toolbar.OPERATOR, "first"), (island_operators.OPERATOR, "which")):
        for item in keymaps.items_of(keys, operator):
            given = item.properties
            _draw_key(box, keys, item, given.bl_rna.properties[name].enum_items[getattr(given, name)].name)
    for item in keymaps.items_of(keys, "wm.call_panel"):
        _draw_key(box, keys, item, Action.KEYS.text)
    keys = keymaps.user_keymap(context.window_manager)
    if keys is None:
        box.label(text="No keymaps available")
        return
    box = layout.box()
    box.label(text="Keys While a Chain Is Drawn", icon="MOUSE_LMB")
    last: Action | None = None
    for item in keymaps.items_of(keys, keymaps.ACTION_OPERATOR):
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


def _add_defaults() -> None:
    bpy.types.WindowManager.seamwire_defaults = bpy.props.PointerProperty(type=SeamwireDefaults)


register, unregister = together(
    *classes(SeamwireDefaults, SeamwirePreferences),
    (_add_defaults, lambda: delattr(bpy.types.WindowManager, "seamwire_defaults")),
)
