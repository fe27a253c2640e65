# SPDX-License-Identifier: GPL-3.0-or-later
"""What a chain does for each meaning of an event: the table `ACTS`, and the functions that it names."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..core.network.network import Snap
from ..core.sketch.picture import Role
from ..mesh.settings import settings
from ..terms.options import strength_name
from ..view.edited_objects import edited
from ..words.keys import Action, drag_threshold
from . import keymaps
from .events import Meant, Sign
from .holds import Hold
from .running import DRAW, EDIT

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..core.network.strokes import Stroke
    from ..core.network.wires import Wire
    from ..core.sketch.sketch import Sketch
    from ..view.object_view import ObjectView
    from ..view.viewport import Place
    from ..words.keys import Bindings
    from .chain import Chain

    Act = Callable[[Chain, Meant], object]

_OFFERED = (Action.LOOP, Action.BEND)
"""The preview while the modifiers of its click are held."""


# Motions


def hover(chain: Chain, given: Meant) -> None:
    """Show what a click, or a key after *W*, would take."""
    loop, bend = (chain.keys.previews(action, given.event) for action in _OFFERED)
    view, snap = edited.find(given.place, plain=True) if loop or bend else edited.find_or_turned(given.place)
    edited.point_at(view, given.place)
    if view is not None and view is not edited.front:
        chain.session.hover(None)
        # A live wire stays with its object until there is a click on another.
        if chain.session.seed is None and not chain.session.waiting:
            edited.front = view
        else:
            snap = None
    chain.session.hover(snap, loop=loop, bend=bend)


def rehover(chain: Chain, place: Place) -> None:
    view, snap = edited.find_or_turned(place)
    chain.session.hover(snap if view is edited.front else None)


def drag(chain: Chain, given: Meant) -> None:
    if not chain.hold.move(given.place, drag_threshold(given.event, bpy.context.preferences)):
        chain.go("DRAWING")


def release(chain: Chain, given: Meant) -> None:
    hold = chain.hold
    chain.go("DRAWING")
    title = hold.end()
    if title:
        chain.titles.add(title)
    else:
        chain.hint = "Drag over the mesh to draw a stroke"
    if given.place is not None:
        rehover(chain, given.place)


# Presses


def click(chain: Chain, given: Meant) -> None:
    """Take what is under the mouse, or begin to drag it."""
    action, place, event = given.what, given.place, given.event
    view, snap = edited.find(place, plain=action in _OFFERED)
    if view is None or snap is None:
        return
    chain.begin()
    if view is not edited.front:
        chain.session.hover(None)
    if action is Action.NEW_CHAIN or chain.stage == "ENDING":
        chain.begin_anew()
        # More wires may be under the mouse now, and the mesh may have been cut.
        view, snap = edited.find(place, plain=action in _OFFERED)
        if view is None or snap is None:
            return
    chain.draw_on(view)
    session, title = view.session, DRAW
    if action is Action.NEW_CHAIN:
        session.start(snap)
        session.hover(snap)
    elif action is Action.BEND:
        session.bend(snap)
        title = EDIT
    elif action is Action.LOOP and _is_loop(chain, session, snap, event):
        session.loop(snap)
    elif session.network.seed is None and snap.to in {"SEED", "WIRE"}:
        # Whether it is a click or the beginning of a drag is known when the button or the mouse has moved.
        session.hover(snap)
        chain.go("HOLDING", Hold("SEED", event, view, place, snap))
        return
    elif snap.to in {"MESH", "FEATURE", "SEAM"} or session.goes_on_from(snap):
        chain.go("HOLDING", Hold("LINE", event, view, place, snap))
        return
    else:
        session.click(snap)
    chain.titles.add(title)


def _is_loop(chain: Chain, session: Sketch, snap: Snap, event: bpy.types.Event) -> bool:
    """Return whether a click takes what runs around. Across the surface, a double click ends a wire instead."""
    if session.options.along == "SURFACE":
        return chain.keys.previews(Action.LOOP, event)
    return isinstance(snap.pick, tuple)


def begin_stroke(chain: Chain, given: Meant) -> None:
    chain.begin()
    if chain.stage == "ENDING":
        chain.begin_anew()
    found, _ = edited.find(given.place)
    is_live = chain.session.seed is not None or chain.session.waiting
    view = edited.front if is_live or found is None else found
    chain.draw_on(view)
    scale = bpy.context.preferences.system.ui_scale
    chain.go("HOLDING", Hold(given.what.name, given.event, view, given.place, scale=scale))


def has_target(given: Meant, keys: Bindings) -> bool:
    """Return whether a press that may begin a chain finds something to act on, without changing anything."""
    if given.place is None:
        return False
    can_bend = edited.front.options.along == "SURFACE"  # along edges there is no closed cut to bend
    if given.what is Sign.HOVER:
        return any(keys.previews(action, given.event) for action in (_OFFERED if can_bend else _OFFERED[:1]))
    if given.what is Action.BEND:
        return can_bend
    _, wire, stroke = _drawn_at(given)
    return wire is not None or (stroke is not None and given.what is Action.REMOVE)


def _drawn_at(given: Meant) -> tuple[ObjectView | None, Wire | None, Stroke | None]:
    """Return the object under the mouse, and the kept wire there, or else the stroke.

    A wire that was just given another path counts as there until the mouse moves.
    """
    view, snap = edited.find_or_turned(given.place)
    if snap is not None and snap.to == "WIRE":
        return view, snap.wire, None
    return view, None, None if view is None else view.stroke_at(given.place.view, given.place.cursor)


def remove(chain: Chain, given: Meant) -> bool:
    """Remove the wire or the stroke under the mouse, and return whether there was one."""
    view, wire, stroke = _drawn_at(given)
    if view is None or (wire is None and stroke is None):
        return False
    chain.draw_on(view)
    if wire is not None:
        view.session.drop(wire)
    else:
        view.session.erase(stroke)
    chain.titles.add(EDIT)
    rehover(chain, given.place)
    return True


def _remove(chain: Chain, given: Meant) -> bool:
    """Remove what is under the mouse. If there is nothing, Blender's own meaning of the key changes the mesh."""
    is_removed = remove(chain, given)
    if not is_removed:
        chain.end_now()
    return not is_removed


def retrace(chain: Chain, given: Meant) -> None:
    """Let the wire under the mouse take its other path."""
    view, wire, _ = _drawn_at(given)
    if view is None or wire is None:
        return
    chain.draw_on(view)
    view.session.hover(Snap(wire.start, "WIRE", wire))
    view.session.retrace(wire)
    view.turned = wire, given.place
    chain.titles.add(EDIT)


# Keys


def on_front(act: Callable[[Sketch], object]) -> Act:
    """Return the function that lets the sketch of the object in front do something."""

    def call(chain: Chain, _given: Meant) -> None:
        chain.draw_on(edited.front)
        act(chain.session)

    return call


def swap(chain: Chain, given: Meant) -> None:
    """Take the next candidate, or the other path of the kept wire under the mouse."""
    chain.draw_on(edited.front)
    session = chain.session
    hovered = session.picture.one(Role.HOVERED)
    if session.seed is None and hovered is not None:
        session.retrace(hovered)
        edited.front.turned = None if given.place is None else (hovered, given.place)
    else:
        session.next_candidate()


def change_strength(chain: Chain, given: Meant) -> None:
    session, chosen = chain.session, settings()
    is_more = given.what is Action.STRONGER
    name, strength = strength_name(session.options.along), session.options.stepped(1 if is_more else -1).strength
    if session.is_held:
        chain.hint = "Finish moving the seed first"
    elif strength == session.options.strength:
        chain.hint = f"The strength is {strength:g} already, the {'most' if is_more else 'least'} there is"
    else:
        setattr(chosen, name, strength)
        chain.hint = f"Strength {strength:.3g}"


def close(chain: Chain, given: Meant) -> None:
    chain.draw_on(edited.front)
    first = chain.session.network.closing_point
    chain.session.close(None if first is None else edited.front.seen_along(given.place.view, first))


def toggle(name: str) -> Act:
    """Return the function that changes a view or an aid which is on or off."""

    def act(chain: Chain, given: Meant) -> None:
        setattr(settings(), name, not getattr(settings(), name))
        if chain.hold is None and given.place is not None:
            rehover(chain, given.place)

    return act


def clear(chain: Chain, _given: Meant) -> None:
    """Clear seams, or mark them again, until the chain ends."""
    is_clearing = not settings().clear
    chain.switch("clear", is_clearing)
    chain.hint = "Clears seams until the chain ends" if is_clearing else "Marks seams"


def switch(chain: Chain, given: Meant) -> None:
    """Draw across the surface, or along edges, until the chain ends."""
    is_across = chain.session.options.along == "EDGES"
    chain.switch("along", "SURFACE" if is_across else "EDGES")
    chain.hint = f"{'Across the surface' if is_across else 'Along edges'} until the chain ends"
    rehover(chain, given.place)


def cycle_mirror(chain: Chain, _given: Meant) -> None:
    """Mirror over the next axis, over all of them, or over none."""
    session, mesh = chain.session, edited.front.mesh
    try:
        symmetric = mesh.symmetric_soon()
    except ValueError as error:
        chain.hint = str(error)
        return
    if symmetric is None:
        chain.hint = "Still checking the mesh for symmetry"
        return
    ways = [(), *((axis,) for axis in symmetric), *([symmetric] if len(symmetric) > 1 else ())]
    if len(ways) == 1 and not session.options.mirror:
        chain.hint = "The mesh is not symmetric on X, Y or Z"
        return
    now = ways.index(session.options.mirror) if session.options.mirror in ways else len(ways) - 1
    axes = ways[(now + 1) % len(ways)]
    # The mesh's own option, which Blender's tools use as well.
    for axis, name in enumerate("xyz"):
        setattr(mesh.obj.data, f"use_mirror_{name}", axis in axes)
    edited.follow_settings()
    chain.hint = f"Mirrored on {', '.join('XYZ'[axis] for axis in axes)}" if axes else "Not mirrored"


def undo(chain: Chain, _given: Meant) -> None:
    """Undo within the chain. End the chain if nothing is left to undo."""
    chain.draw_on(edited.front)
    if not chain.session.undo():
        chain.end()


# The table


def _refuse(chain: Chain, _given: Meant) -> None:
    chain.hint = "Release the button first"


def _end_held(chain: Chain, given: Meant) -> None:
    """Cancel what is held if another button asks for it, as in Blender's own drags. A key waits."""
    if given.event.type.endswith("MOUSE"):
        chain.let_go()
    else:
        _refuse(chain, given)


ACTS: dict[Action | Sign, Act] = {
    Action.CLICK: click,
    Action.NEW_CHAIN: click,
    Action.LOOP: click,
    Action.BEND: click,
    Action.REMOVE: _remove,
    Action.GUIDE: begin_stroke,
    Action.AVOID: begin_stroke,
    Action.END: lambda chain, _: chain.end(),
    Action.CANCEL: lambda chain, _: chain.cancel(),
    Action.NEXT: swap,
    Action.STRONGER: change_strength,
    Action.WEAKER: change_strength,
    Action.CLOSE: close,
    # The first press shows how the wire would run, and the second one keeps it.
    Action.EXTEND: on_front(lambda sketch: sketch.run_to_end(preview=sketch.picture.one(Role.EXTENSION) is None)),
    Action.CLEAR: clear,
    Action.XRAY: toggle("xray"),
    Action.MIRROR: cycle_mirror,
    Action.SWITCH: switch,
    Action.SNAP: toggle("snap"),
    Action.KEYS: lambda *_: bpy.ops.wm.call_panel("INVOKE_DEFAULT", name=keymaps.HELP_PANEL),
    Action.UNDO: undo,
    Action.REDO: on_front(lambda sketch: sketch.redo()),
    Sign.TICK: lambda *_: edited.poll(),
    Sign.RELEASE: release,
    Sign.AWAY: lambda chain, _: chain.session.hover(None),
    Sign.DRAG: drag,
    Sign.TRACE: lambda chain, given: chain.hold.follow(given.place),
    Sign.HOVER: hover,
    Sign.ZOOM: lambda _, given: keymaps.zoom(bpy.context, given.place, given.event),
    Sign.OTHER_TOOL: lambda chain, _: chain.end_now(),
    Sign.NOTHING: lambda *_: None,
    Sign.REPEAT: lambda *_: None,
}
"""The function for each meaning."""
WHILE_HELD: dict[Action | Sign, Act] = {
    **dict.fromkeys(Action, _refuse),
    **{what: ACTS[what] for what in Sign},
    Action.XRAY: ACTS[Action.XRAY],
    Action.UNDO: lambda chain, _: chain.let_go(),
    Action.CANCEL: lambda chain, _: chain.let_go(),
    Action.END: _end_held,
    Sign.OTHER_TOOL: _refuse,
    Sign.HOVER: ACTS[Sign.NOTHING],
    Sign.AWAY: ACTS[Sign.NOTHING],
}
"""The function for each meaning while a button is held. A key works only on what is held, or on what is shown."""
_FIRST = {**ACTS, Action.REMOVE: remove, Action.NEXT: retrace}
"""The function for a press that begins a chain."""
_BLENDERS = frozenset({Sign.TICK, Sign.AWAY, Sign.HOVER, Sign.OTHER_TOOL, Sign.NOTHING})
"""Signs that Blender always receives too."""
_UNSEEN = frozenset({Sign.NOTHING, Sign.TRACE, Sign.REPEAT})
"""Signs after which there is nothing new to show."""


def act(chain: Chain, given: Meant) -> bool:
    """Do what an event asks for, show it, and return whether Blender is to have the event too."""
    what = given.what
    if what not in {Sign.TICK, Sign.RELEASE}:
        chain.set_cursor("CROSSHAIR" if given.place else "")
    if isinstance(what, Action):
        chain.hint = ""
        if chain.peek and what is not Action.NEXT:
            chain.go("DRAWING")
    is_held = chain.hold is not None
    passes = (WHILE_HELD if is_held else ACTS)[what](chain, given)
    chain.settle()
    if what not in _UNSEEN:
        chain.show()
    if what is Action.REMOVE:
        return bool(passes)  # where there is nothing of ours, Blender has the key
    return what in _BLENDERS and not (is_held and what is Sign.OTHER_TOOL)


def act_first(chain: Chain, given: Meant) -> None:
    """Do what begins a chain, under the mouse."""
    if given.what is Sign.HOVER:
        chain.go("PEEKING", peek=given.event.type)
        hover(chain, given)
    elif given.place is not None:
        chain.begin()
        _FIRST[given.what](chain, given)
    chain.settle()
    chain.show()
