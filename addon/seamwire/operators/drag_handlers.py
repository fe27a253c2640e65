# SPDX-License-Identifier: GPL-3.0-or-later
"""A button that is held: a click as long as the mouse stays, a drag once it has moved."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Protocol

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from ..core.network import Snap
    from ..view.object_view import ObjectView
    from ..view.viewport import Place, View

STEP = 3.0
"""Pixels between two looks at the surface under a stroke: a hand moves the mouse farther from one event to the next."""
CLOSE_REACH = 10.0
"""Pixels from its beginning in which a stroke that ends there is closed..."""
CLOSE_LENGTH = 6.0
"""...where it went this many times as far away before."""


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
    view
        The object it is on.
    snap
        What is held.
    place
        Where the button was pressed.
    note
        Told what was done, in words.
    """

    def __init__(self, button: str, view: ObjectView, snap: Snap, place: Place, note: Callable[[str], None]) -> None:
        self.button = button
        self._view = view
        self._snap = snap
        self._place = place
        self._note = note
        self._dragging = False

    def move(self, place: Place, threshold: float) -> bool:
        """Let the seed follow."""
        session = self._view.session
        if not self._dragging:
            if place.away(self._place) <= threshold:
                return True
            if not session.drag(self._snap):
                return False
            self._dragging = True
        session.drag_to(self._view.snap(place.view, place.cursor))
        return True

    def release(self) -> None:
        """Leave the seed there, or click."""
        if self._dragging:
            self._view.session.drag_end()
            self._note("Move Seed")
        else:
            self._view.session.click(self._snap)
            self._note("Draw Wires")

    def cancel(self) -> bool:
        """Let the seed go back."""
        return self._view.session.drag_cancel()


class StrokeHold:
    """A stroke that is drawn while a button is held.

    Parameters
    ----------
    button
        Which.
    view
        The object that is drawn on.
    place
        Where the button was pressed.
    attracts
        Whether wires are to follow the stroke, rather than keep off it.
    scale
        Of the display.
    """

    def __init__(
        self,
        button: str,
        view: ObjectView,
        place: Place,
        attracts: bool,
        scale: float = 1.0,
    ) -> None:
        self.button = button
        self._view = view
        self._last = place
        self._attracts = attracts
        self._reach = CLOSE_REACH * scale
        self._first = place
        self._dragging = False
        self._ended = False
        self._farthest = 0.0
        self._points: list[NDArray[np.float64]] = []
        self._triangles: list[int] = []

    def move(self, place: Place, threshold: float) -> bool:
        """Draw on to where the mouse is now."""
        if not self._dragging:
            if place.away(self._first) <= threshold:
                return True
            self._dragging = True
            self._view.session.hover(None)
            self._add(self._first.view, self._first.cursor)
        # Where the view was changed in the meantime, what lies between is not where the hand went.
        same = place.region == self._last.region and np.array_equal(place.view.perspective, self._last.view.perspective)
        start, end = (self._last.cursor if same else place.cursor), place.cursor
        steps = max(1, math.ceil(math.dist(start, end) / STEP))
        for step in range(1, steps + 1):
            part = step / steps
            self._add(place.view, (start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1])))
        self._last = place
        self._farthest = max(self._farthest, math.dist(self._first.cursor, place.cursor))
        self._show()
        return True

    def release(self) -> None:
        """Let the wires follow it, or keep off."""
        self._view.overlay.stroke = None
        session = self._view.session
        near = math.dist(self._first.cursor, self._last.cursor) <= self._reach
        if near and not self._ended and self._farthest > CLOSE_LENGTH * self._reach and len(self._points) > 2:
            self._points.append(self._points[0])
            self._triangles.append(self._triangles[0])
        if len(self._points) > 1:
            points, triangles = np.array(self._points), np.array(self._triangles)
            session.scribble(points, triangles, attracts=self._attracts, radius=self._view.stroke_radius)

    def cancel(self) -> bool:
        """Forget it."""
        self._view.overlay.stroke = None
        return self._dragging

    @property
    def missed(self) -> bool:
        """Whether nothing was drawn."""
        return len(self._points) < 2

    def _add(self, view: View, cursor: tuple[float, float]) -> None:
        if self._ended:
            return
        found = self._view.surface_at(view, cursor)
        if found is None:
            # Over the rim it ends; begun beside the model, it has not begun.
            self._ended = bool(self._points)
            return
        point, triangle = found
        if not self._points or not np.array_equal(point, self._points[-1]):
            self._points.append(point)
            self._triangles.append(triangle)

    def _show(self) -> None:
        self._view.overlay.stroke = (np.array(self._points).reshape(-1, 3), self._attracts)
