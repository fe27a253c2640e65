# SPDX-License-Identifier: GPL-3.0-or-later
"""Strokes drawn on the surface under the cursor, which wires are to follow or to keep off."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..core.geometry import nearest_on_segments

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from mathutils import Matrix
    from numpy.typing import NDArray

    from ..core.network import Wire
    from ..core.strokes import Scribble
    from ..mesh.object_session import Board
    from ..view.places import Place
    from ..view.viewport import View

STEP = 3.0
"""Pixels between two looks at the surface under a stroke: a hand moves the mouse farther from one event to the next."""
CLOSE_REACH = 10.0
"""Pixels from its beginning in which a stroke that ends there is closed..."""
CLOSE_LENGTH = 6.0
"""...where it went this many times as far away before."""
ERASE_REACH = 12.0
"""Pixels beside a stroke in which it is found."""


class StrokeHold:
    """A stroke that is drawn while a button is held; without a drag, the wire under the cursor is dropped.

    Parameters
    ----------
    button
        Which.
    board
        The object that is drawn on.
    place
        Where the button was pressed.
    attracts
        Whether wires are to follow the stroke, rather than keep off it.
    wire
        What a click drops; None: nothing.
    scale
        Of the display.
    """

    def __init__(
        self,
        button: str,
        board: Board,
        place: Place,
        attracts: bool,
        wire: Wire | None = None,
        scale: float = 1.0,
    ) -> None:
        self.button = button
        self._board = board
        self._last = place
        self._attracts = attracts
        self._wire = wire
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
            self._board.session.hover(None)
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
        """Let the wires obey, or drop the wire that was clicked."""
        self._board.overlay.stroke = None
        session = self._board.session
        if not self._dragging:
            if self._wire is not None:
                session.drop(self._wire)
            return
        near = math.dist(self._first.cursor, self._last.cursor) <= self._reach
        if near and not self._ended and self._farthest > CLOSE_LENGTH * self._reach and len(self._points) > 2:
            self._points.append(self._points[0])
            self._triangles.append(self._triangles[0])
        if len(self._points) > 1:
            points, triangles = np.array(self._points), np.array(self._triangles)
            session.scribble(points, triangles, attracts=self._attracts, radius=self._board.stroke_radius)

    def cancel(self) -> bool:
        """Forget it."""
        self._board.overlay.stroke = None
        return self._dragging

    @property
    def missed(self) -> bool:
        """Whether nothing was drawn, and no wire clicked."""
        return len(self._points) < 2 if self._dragging else self._wire is None

    def _add(self, view: View, cursor: tuple[float, float]) -> None:
        if self._ended:
            return
        found = self._board.surface_at(view, cursor)
        if found is None:
            # Over the rim it ends; begun beside the model, it has not begun.
            self._ended = bool(self._points)
            return
        point, triangle = found
        if not self._points or not np.array_equal(point, self._points[-1]):
            self._points.append(point)
            self._triangles.append(triangle)

    def _show(self) -> None:
        self._board.overlay.stroke = (np.array(self._points).reshape(-1, 3), self._attracts)


def stroke_at(
    strokes: Sequence[Scribble],
    view: View,
    matrix: Matrix,
    to_object: NDArray[np.float64],
    cursor: tuple[float, float],
    reach: float,
    sees: Callable[[NDArray[np.float64]], bool],
) -> Scribble | None:
    """Return the stroke nearest to the cursor, of equal ones the newest.

    Parameters
    ----------
    strokes
        Oldest first.
    view, matrix
        The view, and the object's matrix.
    to_object
        (3, 3) takes the strokes' points to object coordinates.
    cursor
        Pixels.
    reach
        How many pixels away it may be.
    sees
        Whether a place, in object coordinates, is to be looked at.
    """
    world = np.array(matrix, dtype=np.float64)
    best: tuple[float, Scribble | None] = (reach, None)
    for stroke in strokes:
        places = np.asarray(stroke.points) @ to_object.T
        pixels = view.to_pixels(places @ world[:3, :3].T + world[:3, 3])
        part, gaps = nearest_on_segments(cursor, pixels[:-1], pixels[1:])
        gaps = np.where(np.isnan(gaps), np.inf, gaps)
        for row in np.argsort(gaps, kind="stable").tolist():
            if gaps[row] > best[0]:
                break
            if sees(places[row] + part[row] * (places[row + 1] - places[row])):
                best = (float(gaps[row]), stroke)
                break
    return best[1]
