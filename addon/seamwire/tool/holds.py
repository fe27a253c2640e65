# SPDX-License-Identifier: GPL-3.0-or-later
"""A button that is held: a click as long as the mouse stays, a drag once it has moved."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..words.keys import MODIFIERS
from .running import DRAW, EDIT

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..core.network.network import Snap
    from ..core.picking.picker import Camera
    from ..view.object_view import ObjectView
    from ..view.viewport import Place
    from ..words.keys import Event

STEP = 3.0
"""Pixels between two looks at the surface under a stroke: a hand moves the mouse farther from one event to the next."""
CLOSE_REACH = 10.0
"""A stroke is closed if it ends within this many pixels of its beginning..."""
CLOSE_LENGTH = 6.0
"""...and went this many times as far away in between."""


class Hold:
    """The thing that a pressed button drags on an object.

    The `modifiers` of the press are those that are still down. Once the mouse has moved beyond the threshold it `is_drag`. Until then it is
    a click at `snap`, which a stroke does not have.
    """

    def __init__(self, event: Event, view: ObjectView, place: Place, snap: Snap | None = None) -> None:
        self.button = event.type
        self.modifiers = list(MODIFIERS)
        self.follow_modifiers(event)
        self._view = view
        self._session = view.session
        self.place = place
        self.snap = snap
        self.is_drag = False

    def follow_modifiers(self, event: Event) -> None:
        """Take note of the modifiers that are released."""
        self.modifiers = [name for name in self.modifiers if getattr(event, name)]

    def move(self, place: Place, threshold: float) -> bool:
        """Follow the mouse. A drag begins beyond the threshold, in pixels. Return whether it is still held."""
        if not self.is_drag:
            if place.away(self.place) <= threshold:
                return True
            if not self.begin():
                return False
            self.is_drag = True
        return self.drag(place)

    def cancel(self) -> None:
        """Cancel without a change."""
        raise NotImplementedError

    def begin(self) -> bool:
        """Begin a drag. Return whether that is possible."""
        raise NotImplementedError

    def drag(self, place: Place) -> bool:
        """Follow the mouse. Return whether the drag goes on."""
        raise NotImplementedError

    def end(self) -> str:
        """End the drag where it is. Return the title of the step of undo, or an empty text."""
        raise NotImplementedError


class SeedHold(Hold):
    """A seed or a wire: a click begins or ends a chain there, a drag moves the seed, or one that it puts into the wire."""

    def begin(self) -> bool:
        """Take hold of the seed."""
        return self._session.drag(self.snap)

    def drag(self, place: Place) -> bool:
        """Let the seed follow."""
        self._session.drag_to(self._view.snap(place.view, place.cursor))
        return True

    def end(self) -> str:
        """Leave the seed there."""
        self._session.drag_end()
        return EDIT

    def cancel(self) -> None:
        """Let the seed go back."""
        self._session.cancel()


class Trail:
    """Where a hand has gone over an object's surface while it held a button: points in the session's coordinates, with their triangles.

    If it `ends_at_rim`, all is over once the hand has left the surface. Otherwise the hand may come back.
    """

    def __init__(self, view: ObjectView, place: Place, ends_at_rim: bool) -> None:
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
            # Over the rim it ends. If it began beside the model, it has not begun.
            self.left = self._ends_at_rim and bool(self.points)
            return
        point, triangle = found
        if not self.points or not np.array_equal(point, self.points[-1]):
            self.points.append(point)
            self.triangles.append(triangle)


class LineHold(Hold):
    """The surface: a click adds a seed, or keeps the live wire; a drag draws a line that wires follow."""

    _trail: Trail | None = None

    def begin(self) -> bool:
        """Begin a line."""
        if not self._session.line_begin(self.snap):
            return False
        self._trail = Trail(self._view, self.place, ends_at_rim=False)
        return True

    def follow(self, place: Place) -> None:
        """Take note of where the mouse was between two moves."""
        if self._trail is not None:
            self._trail.to(place)

    def drag(self, place: Place) -> bool:
        """Draw on to where the mouse is now."""
        trail = self._trail
        assert trail is not None
        trail.to(place)
        if not self._session.is_held:
            return False  # a key has ended the line in the meantime
        points, triangles = np.array(trail.points).reshape(-1, 3), np.array(trail.triangles, dtype=np.int32)
        return self._session.line_to(points, triangles, self._view.snap(place.view, place.cursor))

    def end(self) -> str:
        """Keep the wires that follow the line."""
        self._session.line_end()
        return DRAW

    def cancel(self) -> None:
        """Forget the line."""
        self._session.cancel()


class StrokeHold(Hold):
    """A stroke that is drawn while a button is held."""

    attracts = True
    """Whether wires are to follow the stroke, rather than keep off it."""
    scale = 1.0
    """The scale of the display."""
    _trail: Trail | None = None
    _farthest = 0.0

    def begin(self) -> bool:
        """Begin a stroke."""
        self._session.hover(None)
        self._trail = Trail(self._view, self.place, ends_at_rim=True)
        return True

    def drag(self, place: Place) -> bool:
        """Draw on to where the mouse is now."""
        trail = self._trail
        assert trail is not None
        trail.to(place)
        self._farthest = max(self._farthest, math.dist(self.place.cursor, place.cursor))
        self._view.stroke = (np.array(trail.points).reshape(-1, 3), self.attracts)
        return True

    def end(self) -> str:
        """Let the wires follow the stroke, or keep off."""
        self._view.stroke = None
        trail, reach = self._trail, CLOSE_REACH * self.scale
        assert trail is not None
        points, triangles = trail.points, trail.triangles
        if len(points) < 2:
            return ""
        near = math.dist(self.place.cursor, trail.last.cursor) <= reach
        if near and not trail.left and self._farthest > CLOSE_LENGTH * reach and len(points) > 2:
            points, triangles = [*points, points[0]], [*triangles, triangles[0]]
        self._session.draw_stroke(
            np.array(points),
            np.array(triangles),
            attracts=self.attracts,
            radius=self._view.options.stroke_radius or None,  # 0: as many rings as the library takes
        )
        return DRAW

    def cancel(self) -> None:
        """Forget it."""
        self._view.stroke = None
