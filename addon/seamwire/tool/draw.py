# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator of the tool: it draws chains, loops and strokes, and moves seeds. Others listen elsewhere, or while nothing runs."""

from __future__ import annotations

import traceback
from itertools import count
from typing import TYPE_CHECKING, ClassVar

import bpy
from bpy.app.handlers import persistent

from ..core.base.native import NativeError
from ..mesh.registration import classes, handler, together
from ..mesh.settings import ADDON, notices, preferences, settings, tool_is_active
from ..terms.choices import ALONG, items
from ..words.keys import Action, Key
from .keymaps import keys, takes
from .running import LISTEN, NeedsEditMode, chains, listen, listening, steps

if TYPE_CHECKING:
    from .chain import Chain

_FIRST = (
    ("NONE", "Nothing", "Wait for the next click", 0),
    ("CLICK", "Begin Chain", "Place the first seed, or grab a seed or a wire", 1),
    ("LOOP", "Loop", "Add the loop through the edge", 2),
    ("GUIDE", "Guide Stroke", "Draw a stroke that attracts wires", 3),
    ("AVOID", "Avoid Stroke", "Draw a stroke that repels wires", 4),
    ("REMOVE", "Remove", "Remove the wire or the stroke. Elsewhere the key keeps Blender's meaning", 5),
    ("NEXT", "Next Candidate", "Swap the path of the wire. Elsewhere the key keeps Blender's meaning", 6),
    ("PEEK", "Show Loop", "Show the loop that a click would add, while the key is held", 7),
    ("BEND", "Bend Closed Cut", "Bend the last closed cut. Along edges the key keeps Blender's meaning", 8),
)
_FOR_BLENDER = {"REMOVE", "NEXT", "PEEK", "BEND"}
"""If these find nothing to do, the key keeps Blender's meaning."""

_ENOUGH = 3
"""After so many chains nobody needs the first steps."""
_kept = count(1)
"""Numbers the chains of this session of Blender that were kept."""

_LOOK = 0.3
"""Seconds between two looks at whether anything runs in another window."""
_CHAIN_ELSEWHERE = "A chain is being drawn in another window: end it there first"
_STEPS_ELSEWHERE = "{} is running: wait for it, or press Esc in its window"


def _follow(operator: bpy.types.Operator, chain: Chain, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
    """Pass an event to a chain, and end with it. Return what a modal operator returns."""
    from .acts import act
    from .events import read

    if chain.stage == "CLOSED":
        return {"CANCELLED", "PASS_THROUGH"}
    try:
        trouble = chain.trouble(context)
        if trouble:
            chain.notices.add("WARNING", f"{trouble}: the chain has ended")
            return _finish(operator, chain, context) | {"PASS_THROUGH"}
        chain.find_front()
        passes = act(chain, read(chain, context, event))
        if chain.stage != "OVER":
            return {"PASS_THROUGH"} if passes else {"RUNNING_MODAL"}
        result = _finish(operator, chain, context)
        return result | {"PASS_THROUGH"} if passes else result
    except Exception as error:
        return _fail(operator, chain, context, error)


def _finish(operator: bpy.types.Operator, chain: Chain, context: bpy.types.Context) -> set[str]:
    has_kept = chain.finish()
    chain.notices.tell(operator.report)
    if has_kept and next(_kept) >= _ENOUGH and preferences(context).text == "STEPS":
        preferences(context).text = "INFORMATION"
        # Blender does not list an add-on that is enabled for one run, and must store nothing of it.
        context.preferences.is_dirty |= ADDON in context.preferences.addons
    return {"FINISHED"} if has_kept else {"CANCELLED"}


def _fail(operator: bpy.types.Operator, chain: Chain, context: bpy.types.Context, error: Exception) -> set[str]:
    """End a chain after an error. The wires up to there are kept."""
    traceback.print_exc()
    if chain.peek:
        chain.finish()
        return {"CANCELLED", "PASS_THROUGH"}
    chain.failure = error
    return _finish(operator, chain, context)


class MESH_OT_seamwire_draw(NeedsEditMode, bpy.types.Operator):
    """Draw seams with live wires that follow the shape of the mesh"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_draw"
    bl_label = "Draw Seamwires"
    # A chain makes its own step of undo, named for what it did.
    bl_options = set()

    along: bpy.props.EnumProperty(
        name="Along",
        description="How wires run on the mesh. If not given, as set in the tool",
        items=items(ALONG),
        options={"SKIP_SAVE"},
    )
    first: bpy.props.EnumProperty(
        name="First", description="What to do first, under the cursor", items=_FIRST, options={"SKIP_SAVE"}
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not super().poll(context):
            return False
        if any(chain.window == context.window for chain in chains):
            cls.poll_message_set("A chain is already being drawn")
            return False
        return True

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        from ..mesh.edit_mesh import NothingVisibleError
        from ..view.edited_objects import edited
        from ..view.viewport import place_of
        from .acts import act_first, has_target
        from .chain import Chain
        from .events import Meant, Sign

        if self.first != "NONE" and takes(Key.of(event), context):
            return {"PASS_THROUGH"}
        if chains or steps:
            if self.first in _FOR_BLENDER:
                return {"PASS_THROUGH"}
            listen((chains or steps)[0].window)  # this window is a new one
            self.report({"WARNING"}, _CHAIN_ELSEWHERE if chains else _STEPS_ELSEWHERE.format(steps[0].bl_label))
            return {"CANCELLED"}
        if not any(area.type == "VIEW_3D" for area in context.window.screen.areas):
            self.report({"ERROR"}, "Drawing needs a 3D view in this window")
            return {"CANCELLED"}
        try:
            if self.properties.is_property_set("along"):
                settings(context).along = self.along
            edited.take_stock()
            what = Action[self.first] if self.first in Action.__members__ else Sign.HOVER
            given = Meant(what, event, place_of(context.window, event))
            if self.first in _FOR_BLENDER and not has_target(given, keys(context)):
                return {"PASS_THROUGH"}
            self._chain = Chain(context)
        except (ValueError, NativeError) as error:
            if self.first in _FOR_BLENDER:
                return {"PASS_THROUGH"}
            # Blender opens a popup for an error, and the popup takes the next key.
            nothing = isinstance(error, NothingVisibleError) and self.first != "NONE"
            self.report({"WARNING"} if nothing else {"ERROR"}, str(error))
            return {"CANCELLED"}
        # Blender frees an operator whose invoke raised an exception, but would still call its modal method.
        try:
            if self.first != "PEEK":
                mesh = edited.front.mesh
                notices.tell(self.report)
                mesh.notices.tell(self.report)
                if mesh.obj.modifiers:
                    self._chain.hint = "Modifiers are ignored"
            if self.first != "NONE":
                act_first(self._chain, given)
            else:
                self._chain.show()
            if self._chain.stage == "OVER":
                place = given.place
                views = [] if place is None else edited.views()
                mirrored = any(view.is_on_mirrored_half(place.view, place.cursor) for view in views)
                result = _finish(self, self._chain, context)
                if mirrored and result == {"CANCELLED"}:
                    tell_mirrored(self)
                return result
        except Exception as error:
            return _fail(self, self._chain, context, error)
        listen(context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"} if self.first != "PEEK" else {"RUNNING_MODAL", "PASS_THROUGH"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if chains:
            listen(chains[0].window)  # other windows may be new
        return _follow(self, self._chain, context, event)

    def cancel(self, _context: bpy.types.Context) -> None:
        """End the chain when Blender stops the operator. Its wires are kept if the mesh still exists, without those that wait."""
        if self._chain.stage != "CLOSED":
            self._chain.finish(at_once=True)


class MESH_OT_seamwire_listen(bpy.types.Operator):
    """Listen in a window beside that of what runs. A chain can be drawn in all windows"""  # noqa: D400 - a tooltip

    bl_idname = LISTEN
    bl_label = "Seamwire Listen"
    bl_options: ClassVar[set[str]] = {"INTERNAL"}

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """Begin to listen. A timer lets it end soon, because Blender does not save automatically meanwhile."""
        self._window = context.window.as_pointer()
        listening[self._window] = context.window_manager.event_timer_add(_LOOK, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        result = {"PASS_THROUGH"}
        if not (chains or steps):
            result = {"CANCELLED", "PASS_THROUGH"}
        elif not event.type.startswith("TIMER") and context.window != (chains or steps)[0].window:
            result = _follow(self, chains[0], context, event) if chains else steps[0].overhear(context, event)
        if "CANCELLED" in result or "FINISHED" in result:
            self.cancel(context)
        return result

    def cancel(self, context: bpy.types.Context) -> None:
        timer = listening.pop(self._window, None)
        if timer is not None:
            context.window_manager.event_timer_remove(timer)


# Hovering: while no operator runs, the edge or vertex that a click would pick is highlighted. Blender asks a gizmo of the tool at each
# motion of the mouse. In views without gizmos, an operator in the tool's keymap receives the motion and ends at once.

GROUP = "SEAMWIRE_GGT_hover"
HOVER = "mesh.seamwire_hover"


def _hover(context: bpy.types.Context, location: tuple[int, int]) -> None:
    # Imported only when the tool is used, so that Blender's start does not wait for NumPy.
    from ..view.edited_objects import edited
    from ..view.viewport import place_in

    if not chains:
        edited.hover(place_in(context.area, context.region, location))


class MESH_OT_seamwire_hover(bpy.types.Operator):
    """Highlight the edge or vertex under the mouse in views without gizmos"""  # noqa: D400 - a tooltip

    bl_idname = HOVER
    bl_label = "Seamwire Hover"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        space = context.space_data
        hidden = space is not None and space.type == "VIEW_3D" and not (space.show_gizmo and space.show_gizmo_tool)
        return hidden and tool_is_active(context)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        _hover(context, (event.mouse_region_x, event.mouse_region_y))
        return {"PASS_THROUGH"}


class SEAMWIRE_GT_hover(bpy.types.Gizmo):
    """Receives the position of the mouse. It is invisible and cannot be grabbed."""

    bl_idname = "SEAMWIRE_GT_hover"

    def draw(self, _context: bpy.types.Context) -> None:
        """Draw nothing, because the overlay draws the highlight."""

    def test_select(self, context: bpy.types.Context, location: tuple[int, int]) -> int:
        if context.area is not None and context.area.type == "VIEW_3D":
            _hover(context, location)
        return -1  # no gizmo is there


class SEAMWIRE_GGT_hover(bpy.types.GizmoGroup):
    """The gizmo of the tool."""

    bl_idname = GROUP
    bl_label = "Seamwire Hover"
    bl_space_type = "VIEW_3D"
    bl_region_type = "WINDOW"
    bl_options = {"3D"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return tool_is_active(context)

    def setup(self, _context: bpy.types.Context) -> None:
        self.gizmos.new(SEAMWIRE_GT_hover.bl_idname)


def tell_mirrored(operator: bpy.types.Operator) -> None:
    """Say why a click on a half that a modifier mirrors does nothing."""
    operator.report({"INFO"}, "This half comes from the Mirror modifier: click the other half")


@persistent
def _on_save(*_: object) -> None:
    for chain in chains:
        chain.attempt(chain.save)


@persistent
def _end_all(*_: object) -> None:
    """End the chain that is being drawn, and keep its wires. A file that cannot be loaded leaves the open one with them."""
    for chain in tuple(chains):
        chain.finish()
        chain.notices.tell(lambda _kind, text: print(f"Seamwire: {text}"))


register, unregister = together(
    *classes(
        MESH_OT_seamwire_draw,
        MESH_OT_seamwire_listen,
        MESH_OT_seamwire_hover,
        SEAMWIRE_GT_hover,
        SEAMWIRE_GGT_hover,
    ),
    handler("save_pre", _on_save),
    handler("load_pre", _end_all),
    (lambda: None, _end_all),
)
