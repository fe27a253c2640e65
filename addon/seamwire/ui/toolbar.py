# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool in the toolbar: its keys, its hints in the status bar, and its settings in the header, the sidebar and Properties."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import bpy
from bl_ui.space_statusbar import STATUSBAR_HT_header

from ..mesh.registration import classes, together
from ..mesh.settings import ADDON, TOOL, settings, tool_is_active
from ..operators import island_operators
from ..terms.choices import ALONG
from ..terms.options import SETTINGS, strength_name
from ..tool import draw
from ..tool.keymaps import ACTION_OPERATOR, HELP_PANEL, NAME, items_of, key_of, user_keymap
from ..tool.running import chains, draw_hints, steps
from ..words.hints import idle_hints
from ..words.keys import KEYS, Action, Key

if TYPE_CHECKING:
    from ..terms.choices import Along

VIEWS = "Views"
"""The group of settings that a popover and a menu show."""
GROUPS = tuple(dict.fromkeys(setting.group for setting in SETTINGS.values() if setting.group != VIEWS))
"""The groups of settings that have panels."""
_STRENGTHS = set(map(strength_name, ALONG))
_OBJECTS = f"{ADDON}.view.edited_objects"


def draw_header(context: bpy.types.Context, layout: bpy.types.UILayout) -> None:
    """Show the buttons of a job, at most six controls, and the help. Blender shows the mirror of the mesh beside them."""
    chosen, along = settings(context), along_of(context)

    def row(width: float, align: bool = False) -> bpy.types.UILayout:
        made = layout.row(align=align)
        made.ui_units_x = width
        return made

    jobs = row(6, align=True)
    jobs.operator("mesh.seamwire_suggest", text="Suggest")
    jobs.operator("mesh.seamwire_unwrap", text="Unwrap")
    row(5.5).prop(chosen, "along", text="")
    if along == "SURFACE":
        row(3).prop(chosen, "finish", text="")
    row(5.5).prop(chosen, strength_name(along))
    if along == "SURFACE":
        layout.prop(chosen, "straight", text="Straight", toggle=True)
    layout.prop(chosen, "clear", text="Clear", toggle=True)
    panels = layout.row(align=True)
    panels.popover(VIEW3D_PT_seamwire_overlays.bl_idname, text="Views")
    panels.popover(HELP_PANEL, text="", icon="QUESTION")


def along_of(context: bpy.types.Context) -> Along:
    along = settings(context).along
    if along != "AUTO":
        return along
    # Drawing the header must not wait for an import of NumPy. Without it, no object is read yet.
    objects = sys.modules.get(_OBJECTS)
    return "EDGES" if objects is None else objects.edited.best_along(context.edit_object)


def draw_group(context: bpy.types.Context, layout: bpy.types.UILayout, group: str) -> None:
    """Show the settings of a group. A setting without an effect is grayed out. Of both strengths only one is shown."""
    chosen, along = settings(context), along_of(context)
    # Names of toggles need the whole width of the sidebar.
    toggles: bpy.types.UILayout | None = None
    for name, setting in SETTINGS.items():
        if setting.group != group or name in _STRENGTHS - {strength_name(along)}:
            continue
        is_toggle = chosen.bl_rna.properties[name].type == "BOOLEAN"
        if is_toggle and toggles is None:
            toggles = layout.column(heading="Show") if group == VIEWS else layout.column()
            toggles.use_property_split = group == VIEWS
        row = (toggles if is_toggle else layout).row()
        row.active = setting.matters(along, chosen.metric)
        row.prop(chosen, name, slider=setting.slider)
    obj = context.edit_object if group == "Drawing" else None
    if obj is not None and obj.type == "MESH":
        row = layout.row(align=True, heading="Mirror")
        for axis in "xyz":
            row.prop(obj.data, f"use_mirror_{axis}", text=axis.upper(), toggle=True)


def draw_settings(context: bpy.types.Context, layout: bpy.types.UILayout) -> None:
    """Show the settings where Blender shows those of the active tool. In the sidebar, panels of our own do."""
    region = context.region.type if context.region is not None else ""
    if region in {"TOOL_HEADER", "HEADER"}:
        draw_header(context, layout)
    elif region != "UI":
        for group in GROUPS:
            box = layout.box()
            box.label(text=group)
            draw_group(context, _split(box.column()), group)


def _split(layout: bpy.types.UILayout) -> bpy.types.UILayout:
    layout.use_property_split = True
    layout.use_property_decorate = False
    return layout


class VIEW3D_PT_seamwire_overlays(bpy.types.Panel):
    """Views of the mesh and of its UV map"""  # noqa: D400 - a tooltip

    bl_idname = "VIEW3D_PT_seamwire_overlays"
    bl_space_type = "VIEW_3D"
    bl_region_type = "HEADER"
    bl_label = "Seamwire Views"
    bl_ui_units_x = 13

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.label(text="Seamwire Views")
        draw_group(context, _split(self.layout), VIEWS)


def _panel(name: str) -> type[bpy.types.Panel]:
    def draw(self: bpy.types.Panel, context: bpy.types.Context) -> None:
        draw_group(context, _split(self.layout), name)

    body = {
        "__doc__": f"Settings of the Seamwire tool: {name}",
        "bl_space_type": "VIEW_3D",
        "bl_region_type": "UI",
        "bl_category": "Tool",
        "bl_label": name,
        "bl_parent_id": "VIEW3D_PT_active_tool",
        "bl_options": {"DEFAULT_CLOSED"} if name == "Advanced" else set(),
        "poll": classmethod(lambda _cls, context: tool_is_active(context)),
        "draw": draw,
    }
    return type(f"VIEW3D_PT_seamwire_{name.lower()}", (bpy.types.Panel,), body)


OPERATOR = "mesh.seamwire_draw"
KEYMAP = f"3D View Tool: Edit Mesh, {NAME}"
"""The name of the tool's keymap in Blender."""
_OTHER = "builtin.select_box"
_NOTHING_ELSE = dict.fromkeys(
    ("keymap", "gizmo_group", "data_block", "operator", "idname_fallback", "keymap_fallback"), ""
)
"""Blender 3.4 crashes if a text is left out."""
_ICON = Path(__file__).parent.parent / "icons" / "seamwire.draw"


def _key(first: str, type: str = "LEFTMOUSE", **held: bool) -> tuple[str, dict[str, object], dict[str, object]]:
    return OPERATOR, {"type": type, "value": "PRESS", **held}, {"properties": [("first", first)]}


class SeamwireTool(bpy.types.WorkSpaceTool):
    bl_space_type = "VIEW_3D"
    bl_context_mode = "EDIT_MESH"
    bl_idname = TOOL
    bl_label = NAME
    bl_description = (
        "Draw UV seams that follow the shape of the mesh.\n"
        "Click to begin, click to keep a wire, right-click to end.\n"
        "Drag to draw by hand or to move seeds. Hold Alt for loops. X removes a wire"
    )
    bl_icon = str(_ICON) if _ICON.with_suffix(".draw.dat").exists() else "ops.mesh.knife_tool"
    bl_cursor = "CROSSHAIR"
    bl_widget = draw.GROUP
    bl_keymap = (
        _key("CLICK"),
        _key("CLICK", ctrl=True),
        _key("LOOP", alt=True),
        _key("BEND", shift=True, alt=True),
        _key("GUIDE", shift=True),
        _key("AVOID", shift=True, ctrl=True),
        _key("REMOVE", "X"),
        _key("REMOVE", "DEL"),
        _key("NEXT", "W"),
        _key("PEEK", "LEFT_ALT", any=True),
        # Systems differ in whether the pressed key counts as held.
        _key("PEEK", "LEFT_SHIFT", alt=True),
        _key("PEEK", "LEFT_SHIFT", alt=True, shift=True),
        (
            island_operators.OPERATOR,
            {"type": "W", "value": "PRESS", "shift": True, "ctrl": True},
            {"properties": [("which", "WORST")]},
        ),
        ("wm.call_panel", {"type": "F1", "value": "PRESS"}, {"properties": [("name", HELP_PANEL)]}),
        (draw.HOVER, {"type": "MOUSEMOVE", "value": "ANY", "any": True}, None),
    )

    draw_settings = staticmethod(lambda context, layout, _tool: draw_settings(context, layout))


def _add_tool() -> None:
    if bpy.context.window_manager.keyconfigs.addon is not None:  # Blender as a module has no keymaps for a tool
        bpy.utils.register_tool(SeamwireTool)


def leave() -> None:
    """Choose Blender's first tool wherever this tool is chosen, shown or not: a tool without keys fills the console."""
    for window in bpy.context.window_manager.windows:
        area = next((area for area in window.screen.areas if area.type == "VIEW_3D"), None)
        if area is None:
            continue
        with bpy.context.temp_override(window=window, area=area, region=area.regions[-1]):
            tool = bpy.context.workspace.tools.from_space_view3d_mode(bpy.context.mode, create=False)
            if tool is not None and tool.idname == TOOL:
                bpy.ops.wm.tool_set_by_id(name=_OTHER)
    # Blender sets up the tools of other workspaces and modes when it shows them.
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        for workspace in bpy.data.workspaces:
            for tool in workspace.tools:
                if tool.idname == TOOL:
                    tool.setup(idname=_OTHER, **_NOTHING_ELSE)


def _remove_tool() -> None:
    if hasattr(SeamwireTool, "_bl_tool"):
        leave()
        _empty(KEYMAP)
        bpy.utils.unregister_tool(SeamwireTool)


class MESH_OT_seamwire_key(bpy.types.Operator):
    """Represents a key of a chain in the keymap"""  # noqa: D400 - a tooltip

    bl_idname = ACTION_OPERATOR
    bl_label = "Seamwire Key"
    bl_options = {"INTERNAL"}

    action: bpy.props.EnumProperty(
        name="Action",
        description="Action of the key",
        items=tuple((action.name, action.text, "", "NONE", action.number) for action in Action),
    )

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        """Return False, because a chain looks up its keys itself."""
        return False


_registered: list[tuple[bpy.types.KeyMap, bpy.types.KeyMapItem]] = []
_SPACE = {"space_type": "VIEW_3D", "region_type": "WINDOW"}


def _add_keys() -> None:
    configurations = bpy.context.window_manager.keyconfigs
    if configurations.addon is None:  # background mode has no keymaps
        return
    keymap = configurations.addon.keymaps.new(name="Mesh", space_type="EMPTY")
    item = keymap.keymap_items.new("wm.tool_set_by_id", "W", "PRESS", ctrl=True, alt=True)
    _registered.append((keymap, item))
    item.properties.name = TOOL
    # Blender copies an add-on's keymap to the user's only if its own configuration has a keymap with this name.
    configurations.default.keymaps.new(name=NAME, **_SPACE)
    keymap = configurations.addon.keymaps.new(name=NAME, **_SPACE)
    for action, key in KEYS:
        held = {name: getattr(key, name) for name in ("ctrl", "shift", "alt")}
        given = {"any": True} if set(held.values()) == {-1} else {name: want == 1 for name, want in held.items()}
        item = keymap.keymap_items.new(ACTION_OPERATOR, key.type, key.value, **given)
        item.properties.action = action.name


def _remove_keys() -> None:
    while _registered:
        keymap, item = _registered.pop()
        keymap.keymap_items.remove(item)
    _empty(NAME)
    configurations = bpy.context.window_manager.keyconfigs
    for configuration in (configurations.addon, configurations.default):
        keymap = configuration.keymaps.get(NAME) if configuration is not None else None
        if keymap is not None:
            configuration.keymaps.remove(keymap)


def _empty(name: str) -> None:
    """Remove the add-on's items from a keymap. Otherwise they would stay in the user's keymap."""
    configurations = bpy.context.window_manager.keyconfigs
    keymap = configurations.addon.keymaps.get(name) if configurations.addon is not None else None
    if keymap is not None:
        while keymap.keymap_items:
            keymap.keymap_items.remove(keymap.keymap_items[0])
        configurations.update()


def draw_idle(header: bpy.types.Header, context: bpy.types.Context) -> None:
    """Draw what the tool can do, before Blender's own hints. Draw nothing while another tool or operator has the mouse."""
    # Blender 3.4 tells only of running operators of this add-on.
    if not tool_is_active(context) or chains or steps or getattr(context.window, "modal_operators", ()):
        return
    keys: dict[str, Key] = {}
    for item in items_of(user_keymap(context.window_manager, KEYMAP), OPERATOR):
        if item.active:
            keys.setdefault(item.properties.first, key_of(item))
    draw_hints(header, idle_hints(keys))


def _add_hints() -> None:
    STATUSBAR_HT_header.prepend(draw_idle)
    if hasattr(STATUSBAR_HT_header, "_draw_orig"):
        # An add-on has shown its own status before. Blender goes back to this function after each such status.
        STATUSBAR_HT_header._draw_orig = STATUSBAR_HT_header.draw


def _remove_hints() -> None:
    # While a chain is drawn, Blender keeps its own function aside.
    draw = getattr(STATUSBAR_HT_header, "_draw_orig", STATUSBAR_HT_header.draw)
    if draw_idle in draw._draw_funcs:
        draw._draw_funcs.remove(draw_idle)


register, unregister = together(
    *classes(MESH_OT_seamwire_key, VIEW3D_PT_seamwire_overlays, *map(_panel, GROUPS)),
    (lambda: None, _remove_keys),  # keys that were added before an error are removed too
    (_add_keys, lambda: None),
    (_add_tool, _remove_tool),
    (_add_hints, _remove_hints),
)
