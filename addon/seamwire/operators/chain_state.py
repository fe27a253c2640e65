# SPDX-License-Identifier: GPL-3.0-or-later
"""The state of a chain between two events: what is held, what was drawn, and whether it is about to end."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..view.edited_objects import edited
from ..words.notices import Notices
from .chain_record import ChainRecord

if TYPE_CHECKING:
    from ..core.drawing.session import Session
    from ..view.object_view import ObjectView
    from ..words.keys import Bindings
    from .drag_handlers import Hold


class ChainState:
    """The state of a chain.

    Parameters
    ----------
    keys
        What each key does.

    Attributes
    ----------
    notices
        What there is to report when the chain ends, and the hint about the last key.
    record
        The wires drawn since the last step of undo.
    hold
        The thing that a pressed button drags.
    has_begun
        Whether there was something to do. From then on the chain ends when it is idle.
    peek
        The key that shows the loop under the mouse while it is held, or an empty text.
    is_ending
        Whether the chain ends as soon as its last wire is computed.
    """

    def __init__(self, keys: Bindings) -> None:
        self.keys = keys
        self.notices = Notices()
        self.record = ChainRecord(self.notices)
        self.hold: Hold | None = None
        self.has_begun = False
        self.peek = ""
        self.is_ending = False

    @property
    def view(self) -> ObjectView:
        """The object that was pointed at last."""
        assert edited.front is not None
        return edited.front

    def find_front(self) -> None:
        """Let the active object be in front if none is, because a cut mesh is read anew. This may read the whole mesh."""
        if edited.front is None:
            edited.front = edited.of(bpy.context.active_object)

    @property
    def session(self) -> Session:
        """The session of this object."""
        return self.view.session

    @property
    def waits(self) -> bool:
        """Whether a click waits for its wire."""
        return any(view.session.waiting_clicks for view in edited.views())

    @property
    def is_idle(self) -> bool:
        """Whether the chain has begun, and nothing is live, dragged or waited for any more. Then it ends."""
        return (
            self.has_begun
            and not self.peek
            and self.hold is None
            and not any(
                view.session.seed is not None or view.session.waiting_clicks or view.session.dragging
                for view in edited.views()
            )
        )

    def say(self, hint: str) -> None:
        """Show the result of a key in the status bar."""
        self.notices.hint = hint

    def draw_on(self, view: ObjectView) -> None:
        """Draw on this object. Wires drawn on another object become a separate chain."""
        edited.front = view
        if self.record.view is not view:
            if self.record.view is not None:
                self.keep()
            self.record.begin(view)

    def keep(self) -> None:
        """Keep what was drawn as a separate step of undo."""
        self.record.keep(bpy.context, waits=self.is_ending)

    def let_go(self) -> None:
        """Cancel what a button holds."""
        hold, self.hold = self.hold, None
        if hold is not None:
            hold.cancel()

    def cancel_drags(self) -> bool:
        """Cancel what a button holds, and released drags that still wait. Return whether there was something."""
        is_held = self.hold is not None
        self.let_go()
        return any([view.session.drag_cancel() for view in edited.views()]) or is_held

    def end_if_done(self) -> None:
        """End the chain that is about to end, once nothing waits and no button is held."""
        if self.is_ending and not self.waits and self.hold is None:
            self.end()

    def end(self, wait: bool = True) -> None:
        """Let go of everything that is live.

        Parameters
        ----------
        wait
            Whether clicks that wait for their wires are done first. Otherwise they are forgotten.
        """
        self.has_begun, self.peek = True, ""
        if not wait and self.cancel_drags():
            return
        if wait and self.waits:
            self.is_ending = True
            self.say("Ending as soon as the last wire is computed")
            return
        self.is_ending = False
        for view in edited.views():
            view.session.stop_preview()
            view.session.end_chain()
