# SPDX-License-Identifier: GPL-3.0-or-later
"""A button that is held: a click as long as the mouse stays, a drag once it has moved."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from ..core.network import Snap
    from ..mesh.object_session import Board
    from ..view.places import Place


class Hold(Protocol):
    """What a button holds, until it is released."""

    button: str

    def move(self, place: Place, threshold: float) -> bool:
        """Follow the mouse; a drag begins beyond the threshold, in pixels. Returns whether it is still held."""

    def release(self) -> None:
        """Do what was meant."""

    def cancel(self) -> bool:
        """Leave all as it was; returns whether there was a drag."""


class SeedHold:
    """A seed or a wire: a click begins or ends a chain there, a drag moves the seed, or one that it puts into the wire.

    Parameters
    ----------
    button
        Which.
    board
        The object it is on.
    snap
        What is held.
    place
        Where the button was pressed.
    """

    def __init__(self, button: str, board: Board, snap: Snap, place: Place) -> None:
        self.button = button
        self._board = board
        self._snap = snap
        self._place = place
        self._dragging = False

    def move(self, place: Place, threshold: float) -> bool:
        """Let the seed follow."""
        session = self._board.session
        if not self._dragging:
            if place.away(self._place) <= threshold:
                return True
            if not session.drag(self._snap):
                return False
            self._dragging = True
        session.drag_to(self._board.snap(place.view, place.cursor))
        return True

    def release(self) -> None:
        """Leave the seed there, or click."""
        if self._dragging:
            self._board.session.drag_end()
        else:
            self._board.session.click(self._snap)

    def cancel(self) -> bool:
        """Let the seed go back."""
        return self._board.session.drag_cancel()
