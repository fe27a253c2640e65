# SPDX-License-Identifier: GPL-3.0-or-later
"""A button that is held: a click as long as the mouse stays, a drag once it has moved."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal

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

    Held = Literal["SEED", "LINE", "GUIDE", "AVOID"]
    """A seed or a wire, a line that wires follow, or a stroke that attracts or repels wires."""

STEP = 3.0
"""Pixels between two looks at the surface under a stroke: a hand moves the mouse farther from one event to the next."""
CLOSE_REACH = 10.0
"""A stroke is closed if it ends within this many pixels of its beginning..."""
CLOSE_LENGTH = 6.0
"""...and went this many times as far away in between."""


class Hold:
    """The thing that a pressed button drags on an object.

    The `modifiers` of the press are those that are still down. Once the mouse has moved beyond the threshold it `is_drag`. Until then it is
    a click at `snap`, which a stroke does not have. `scale` is that of the display.
    """

    def __init__(
        self, what: Held, event: Event, view: ObjectView, place: Place, snap: Snap | None = None, scale: float = 1.0
    ) -> None:
        self.what, self.button, self.place, self.snap = what, event.type, place, snap
        self.modifiers = list(MODIFIERS)
        self.follow_modifiers(event)
        self.is_drag = False
        self._view, self._session, self._scale = view, view.session, scale
        # Where the hand has gone over the surface: points in the session's coordinates, with their triangles.
        self._points: list[NDArray[np.float64]] = []
        self._triangles: list[int] = []
        self._last, self._farthest, self._has_left = place, 0.0, False

    def follow_modifiers(self, event: Event) -> None:
        self.modifiers = [name for name in self.modifiers if getattr(event, name)]

    def move(self, place: Place, threshold: float) -> bool:
        """Follow the mouse. A drag begins beyond the threshold, in pixels. Return whether it is still held."""
        session = self._session
        if not self.is_drag:
            if place.away(self.place) <= threshold:
                return True
            if not self._begin():
                return False
            self.is_drag = True
        if self.what == "SEED":
            session.drag_to(self._view.snap(place.view, place.cursor))
            return True
        self.follow(place)
        points = np.array(self._points).reshape(-1, 3)
        if self.what == "LINE":
            if not session.is_held:
                return False  # a key has ended the line in the meantime
            triangles = np.array(self._triangles, dtype=np.int32)
            return session.line_to(points, triangles, self._view.snap(place.view, place.cursor))
        self._farthest = max(self._farthest, math.dist(self.place.cursor, place.cursor))
        self._view.stroke = points, self.what == "GUIDE"
        return True

    def _begin(self) -> bool:
        if self.what == "SEED":
            return self._session.drag(self.snap)
        if self.what == "LINE":
            if not self._session.line_begin(self.snap):
                return False
        else:
            self._session.hover(None)
        self._add(self.place.view, self.place.cursor)
        return True

    def end(self) -> str:
        """Do what was meant: a click or a drag. Return the title of the step of undo, or an empty text."""
        if not self.is_drag:
            if self.snap is None:
                return ""
            self._session.click(self.snap)
            return DRAW
        if self.what == "SEED":
            self._session.drag_end()
            return EDIT
        if self.what == "LINE":
            self._session.line_end()
            return DRAW
        self._view.stroke = None
        points, triangles, reach = self._points, self._triangles, CLOSE_REACH * self._scale
        if len(points) < 2:
            return ""
        is_near = math.dist(self.place.cursor, self._last.cursor) <= reach
        if is_near and not self._has_left and self._farthest > CLOSE_LENGTH * reach and len(points) > 2:
            points, triangles = [*points, points[0]], [*triangles, triangles[0]]
        self._session.draw_stroke(
            np.array(points),
            np.array(triangles),
            attracts=self.what == "GUIDE",
            radius=self._view.options.stroke_radius or None,  # 0: as many rings as the library takes
        )
        return DRAW

    def cancel(self) -> None:
        self._view.stroke = None
        self._session.cancel()

    def follow(self, place: Place) -> None:
        """Take note of where the hand goes over the surface, once it is a drag."""
        if not self.is_drag:
            return
        # Where the view was changed in the meantime, what lies between is not where the hand went.
        last = self._last
        same = place.region == last.region and np.array_equal(place.view.perspective, last.view.perspective)
        start, end = (last.cursor if same else place.cursor), place.cursor
        steps = max(1, math.ceil(math.dist(start, end) / STEP))
        for step in range(1, steps + 1):
            part = step / steps
            self._add(place.view, (start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1])))
        self._last = place

    def _add(self, camera: Camera, cursor: tuple[float, float]) -> None:
        found = None if self._has_left else self._view.surface_at(camera, cursor)
        if found is None:
            # A stroke ends at the rim. If it began beside the model, it has not begun. A line may come back.
            self._has_left = self.what != "LINE" and bool(self._points)
            return
        point, triangle = found
        if not self._points or not np.array_equal(point, self._points[-1]):
            self._points.append(point)
            self._triangles.append(triangle)
