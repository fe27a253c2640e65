# SPDX-License-Identifier: GPL-3.0-or-later
"""What the keys of a chain do, apart from clicks."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..core.drawing.picture import Role
from ..mesh.settings import settings
from ..terms.options import strength_name
from ..view.edited_objects import edited
from ..words.keys import Action
from .bindings import HELP_PANEL
from .chain_gestures import rehover

if TYPE_CHECKING:
    from .chain_events import Given
    from .chain_state import ChainState

_AXES = "XYZ"


def swap(state: ChainState, _given: Given) -> None:
    """Take the next candidate, or the other path of the kept wire under the mouse."""
    state.draw_on(state.view)
    session = state.session
    hovered = session.picture.one(Role.HOVERED)
    if session.seed is None and hovered is not None:
        session.retrace(hovered)
    else:
        session.next_candidate()


def change_strength(state: ChainState, given: Given) -> None:
    """Let wires follow the shape more or less."""
    session, chosen = state.session, settings()
    is_more = given.what is Action.STRONGER
    name, strength = strength_name(session.options.along), session.options.stepped(1 if is_more else -1).strength
    if session.dragging:
        state.say("Finish moving the seed first")
    elif strength == session.options.strength:
        state.say(f"The strength is {strength:g} already, the {'most' if is_more else 'least'} there is")
    else:
        setattr(chosen, name, strength)
        state.say(f"Strength {strength:.3g}")


def close(state: ChainState, given: Given) -> None:
    """Close the chain."""
    assert given.place is not None
    state.draw_on(state.view)
    first = state.session.drawing.network.closing_point
    state.session.close(None if first is None else state.view.seen_along(given.place.view, first))


def extend(state: ChainState, _given: Given) -> None:
    """Show how the wire would run to its end, and at the second press keep it."""
    state.draw_on(state.view)
    state.session.run_to_end(preview=state.session.picture.one(Role.EXTENSION) is None)


def toggle_clear(_state: ChainState, _given: Given) -> None:
    """Clear seams instead of marking them, or mark them again."""
    settings().clear = not settings().clear


def toggle_xray(_state: ChainState, _given: Given) -> None:
    """Pick through the mesh, or only what is visible."""
    settings().xray = not settings().xray


def toggle_snap(state: ChainState, given: Given) -> None:
    """Snap to features, or no longer."""
    assert given.place is not None
    settings().snap = not settings().snap
    rehover(state, given.place)


def switch(state: ChainState, given: Given) -> None:
    """Draw across the surface, or along edges."""
    assert given.place is not None
    settings().along = "SURFACE" if state.session.options.along == "EDGES" else "EDGES"
    rehover(state, given.place)


def cycle_mirror(state: ChainState, _given: Given) -> None:
    """Mirror over the next axis, over all of them, or over none."""
    session, mesh = state.session, state.view.mesh
    try:
        symmetric = mesh.symmetric_soon()
    except ValueError as error:
        state.say(str(error))
        return
    if symmetric is None:
        state.say("Still checking the mesh for symmetry")
        return
    ways = [(), *((axis,) for axis in symmetric), *([symmetric] if len(symmetric) > 1 else ())]
    if len(ways) == 1 and not session.options.mirror:
        state.say("The mesh is not symmetric on X, Y or Z")
        return
    now = ways.index(session.options.mirror) if session.options.mirror in ways else len(ways) - 1
    axes = ways[(now + 1) % len(ways)]
    # The mesh's own option, which Blender's tools use as well.
    for axis, name in enumerate("xyz"):
        setattr(mesh.obj.data, f"use_mirror_{name}", axis in axes)
    edited.follow_settings()
    state.say(f"Mirrored on {', '.join(_AXES[axis] for axis in axes)}" if axes else "Not mirrored")


def show_keys(_state: ChainState, _given: Given) -> None:
    """Open the panel with all keys. The chain goes on when it closes."""
    bpy.ops.wm.call_panel("INVOKE_DEFAULT", name=HELP_PANEL)


def undo(state: ChainState, _given: Given) -> None:
    """Undo within the chain. End the chain if nothing is left to undo."""
    state.draw_on(state.view)
    if not state.session.undo():
        state.end()


def redo(state: ChainState, _given: Given) -> None:
    """Redo within the chain."""
    state.draw_on(state.view)
    state.session.redo()
