# SPDX-License-Identifier: GPL-3.0-or-later
"""A button that is held: a click as long as the mouse stays, a drag once it has moved."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Protocol

import numpy as np

from . import undo_steps

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..core.drawing.line import LineGesture
    from ..core.network.network import Snap
    from ..core.picking.camera import Camera
    from ..view.object_view import ObjectView
    from ..view.viewport import Place

STEP = 3.0
"""Pixels between two looks at the surface under a stroke: a hand moves the mouse farther from one event to the next."""
CLOSE_REACH = 10.0
"""Pixels from its beginning in which a stroke that ends there is closed..."""
CLOSE_LENGTH = 6.0
"""...where it went this many times as far away before."""


class Hold(Protocol):
    """The thing that a pressed button drags."""

    button: str

    def move(self, place: Place, threshold: float) -> bool:
        """Follow the mouse; a drag begins beyond the threshold, in pixels. Returns whether it is still held."""

    def release(self) -> str:
        """Do what was meant. Return the title of the step of undo, or an empty text if nothing was done."""

    def cancel(self) -> None:
        """Cancel without a change."""


class _ClickHold:
    """A hold that is a click until the mouse has moved.

    Parameters
    ----------
    button
        The button.
    view
        The object under the mouse.
    snap
        The pick under the mouse.
    place
        Where the button was pressed.
    """

    def __init__(self, button: str, view: ObjectView, snap: Snap, place: Place) -> None:
        self.button = button
        self._view = view
        self._snap = snap
        self._place = place

    def _click(self) -> str:
        self._view.session.click(self._snap)
        return undo_steps.DRAW


class SeedHold(_ClickHold):
    """A seed or a wire: a click begins or ends a chain there, a drag moves the seed, or one that it puts into the wire."""

    _dragging = False

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

    def release(self) -> str:
        """Leave the seed there, or click."""
        if self._dragging:
            self._view.session.drag_end()
            return undo_steps.EDIT
        return self._click()

    def cancel(self) -> None:
        """Let the seed go back."""
        if self._dragging:
            self._view.session.drag_cancel()


class Trail:
    """Where a hand has gone over an object's surface while it held a button.

    Parameters
    ----------
    view
        The object.
    place
        Where the button was pressed.
    ends_at_rim
        Whether all is over where the hand leaves the surface; else it may come back.

    Attributes
    ----------
    points, triangles
        Places on the surface, as the session has them, and the triangle of each.
    left
        Whether the hand went over the rim.
    last
        Where it is now.
    """

    def __init__(self, view: ObjectView, place: Place, ends_at_rim: bool = True) -> None:
        self._view = view
        self._ends_at_rim = ends_at_rim
        self.points: list[NDArray[np.float64]] = []
        self.triangles: list[int] = []
        self.left = False
        self.last = place
        self._add(place.view, place.cursor)

    def to(self, place: Place) -> None:
        """Follow the hand."""
        # Where the view was changed in the meantime, what lies between is not where the hand went.
        last = self.last
        same = place.region == last.region and np.array_equal(place.view.perspective, last.view.perspective)
        start, end = (last.cursor if same else place.cursor), place.cursor
        steps = max(1, math.ceil(math.dist(start, end) / STEP))
        for step in range(1, steps + 1):
            part = step / steps
            self._add(place.view, (start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1])))
        self.last = place

    def _add(self, camera: Camera, cursor: tuple[float, float]) -> None:
        found = None if self.left else self._view.surface_at(camera, cursor)
        if found is None:
            # Over the rim it ends; begun beside the model, it has not begun.
            self.left = self._ends_at_rim and bool(self.points)
            return
        point, triangle = found
        if not self.points or not np.array_equal(point, self.points[-1]):
            self.points.append(point)
            self.triangles.append(triangle)


class LineHold(_ClickHold):
    """The surface: a click adds a seed, or keeps the live wire; a drag draws a line that wires follow."""

    _trail: Trail | None = None
    _line: LineGesture | None = None

    def move(self, place: Place, threshold: float) -> bool:
        """Draw on to where the mouse is now."""
        if self._trail is None:
            if place.away(self._place) <= threshold:
                return True
            if not self._view.session.line_begin(self._snap):
                return False
            self._trail = Trail(self._view, self._place, ends_at_rim=False)
        self._trail.to(place)
        # A key may have ended the line in the meantime.
        return self._view.session.draws_line and self._draw()

    def follow(self, place: Place) -> None:
        """Take note of where the mouse was between two moves."""
        if self._trail is not None:
            self._trail.to(place)

    def _draw(self) -> bool:
        trail = self._trail
        assert trail is not None
        snap = self._view.snap(trail.last.view, trail.last.cursor)
        points, triangles = np.array(trail.points).reshape(-1, 3), np.array(trail.triangles, dtype=np.int32)
        return self._view.session.line_to(points, triangles, snap)

    def starts_chain(self) -> bool:
        """Take the line out of the session. Return whether the live wires are a separate chain, which is kept before the line."""
        session = self._view.session
        self._line = session.line_release()
        live = session.seed is not None and not session.waiting_clicks
        return self._line is not None and live and not session.goes_on_from(self._snap)

    def release(self) -> str:
        """Keep the wires that follow the line, or click."""
        if self._trail is None:
            return self._click()
        if self._line is None:
            return ""
        self._view.session.line_keep(self._line)
        return undo_steps.DRAW

    def cancel(self) -> None:
        """Forget the line."""
        self._view.session.line_cancel()


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
        self._attracts = attracts
        self._reach = CLOSE_REACH * scale
        self._first = place
        self._trail: Trail | None = None
        self._farthest = 0.0

    def move(self, place: Place, threshold: float) -> bool:
        """Draw on to where the mouse is now."""
        if self._trail is None:
            if place.away(self._first) <= threshold:
                return True
            self._view.session.hover(None)
            self._trail = Trail(self._view, self._first)
        self._trail.to(place)
        self._farthest = max(self._farthest, math.dist(self._first.cursor, place.cursor))
        self._view.stroke = (np.array(self._trail.points).reshape(-1, 3), self._attracts)
        return True

    def release(self) -> str:
        """Let the wires follow it, or keep off."""
        self._view.stroke = None
        trail = self._trail
        if trail is None or len(trail.points) < 2:
            return ""
        points, triangles = trail.points, trail.triangles
        near = math.dist(self._first.cursor, trail.last.cursor) <= self._reach
        if near and not trail.left and self._farthest > CLOSE_LENGTH * self._reach and len(points) > 2:
            points, triangles = [*points, points[0]], [*triangles, triangles[0]]
        self._view.session.draw_stroke(
            np.array(points), np.array(triangles), attracts=self._attracts, radius=self._view.stroke_radius
        )
        return undo_steps.DRAW

    def cancel(self) -> None:
        """Forget it."""
        self._view.stroke = None
