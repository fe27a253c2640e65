# SPDX-License-Identifier: GPL-3.0-or-later
"""Seeds, wires, seams and strokes under the cursor."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import nearest_on_segments
from ..network.network import Snap
from ..network.picks import place_of
from .camera import Projected, Segments

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray

    from ..drawing.session import Session
    from ..network.picks import Pick
    from ..network.strokes import Stroke
    from ..network.wires import Wire
    from .camera import Sight
    from .surface import VisibleSurface

SEED_REACH = 9.0
"""Pixels beside a seed in which it is found..."""
WIRE_REACH = 6.0
"""...beside a wire..."""
SEAM_REACH = 4.0
"""...and beside a seam: narrower, for meshes have many, and they must not keep the edges next to them from being picked."""
STROKE_REACH = 12.0
"""Pixels beside a stroke in which it is found."""


@dataclass(frozen=True)
class _Drawn:
    """What of a network can be found by the cursor, in object coordinates."""

    key: object
    picks: tuple[Pick, ...]
    seeds: Projected
    wires: tuple[Wire, ...]
    curves: Segments


class DrawnPicker:
    """Finds what was drawn on a mesh. `seams` are those edges, (s, 2), that are seams and that no wire runs along."""

    def __init__(self, surface: VisibleSurface, seams: ArrayLike) -> None:
        self._surface = surface
        self._seam_edges = np.asarray(seams, dtype=np.int64).reshape(-1, 2)
        self._drawn: _Drawn | None = None

    def set_seams(self, seams: ArrayLike) -> None:
        """Take other edges, (s, 2), as the seams that no wire runs along."""
        edges = np.asarray(seams, dtype=np.int64).reshape(-1, 2)
        if not np.array_equal(edges, self._seam_edges):
            self._seam_edges = edges
            self.__dict__.pop("_seams", None)

    @cached_property
    def _seams(self) -> Segments:
        surface = self._surface
        ends = surface.in_object(surface.points[self._seam_edges.reshape(-1)]).reshape(-1, 2, 3)
        return Segments(list(ends))

    def at(self, sight: Sight, session: Session) -> Snap | None:
        """Return the seed, otherwise the wire, otherwise the seam under the cursor."""
        surface, drawn = self._surface, self._drawn_now(session)
        cursor, reach = sight.cursor, SEED_REACH * sight.scale
        rows = drawn.seeds.near(sight.camera, sight.matrix, cursor, reach)
        x, y, _ = drawn.seeds.seen(sight.camera, sight.matrix)
        gaps = np.hypot(x[rows] - cursor[0], y[rows] - cursor[1])
        for i in np.argsort(gaps, kind="stable").tolist():
            if gaps[i] <= reach and surface.can_pick(sight, drawn.seeds.points[rows[i]]):
                return Snap(drawn.picks[rows[i]], "SEED")
        for owner, place in drawn.curves.near(sight, WIRE_REACH * sight.scale):
            if surface.can_pick(sight, place):
                wire = drawn.wires[owner]
                return Snap(self._nearest(np.array(wire.vertices), place), "WIRE", wire)
        for owner, place in self._seams.near(sight, SEAM_REACH * sight.scale):
            if surface.can_pick(sight, place):
                return Snap(self._nearest(self._seam_edges[owner], place), "SEAM")
        return None

    def _nearest(self, vertices: NDArray[np.integer], place: NDArray[np.float64]) -> int:
        """Return the vertex nearest to a place in object coordinates."""
        away = np.linalg.norm(self._surface.in_object(self._surface.points[vertices]) - place, axis=1)
        return int(vertices[np.argmin(away)])

    def _drawn_now(self, session: Session) -> _Drawn:
        """Return what can be found of a session's network. A dragged seed and its wires cannot, because they follow the mouse."""
        moved = {wire.id for wire in session.moved}
        picks = tuple(session.seeds())
        key = (id(session), session.network_revision, picks, tuple(sorted(moved)))
        if self._drawn is not None and self._drawn.key == key:
            return self._drawn
        followed = {end for wire in session.wires if wire.id in moved for end in (wire.start, wire.end)}
        followed |= {end[::-1] for end in followed if isinstance(end, tuple)}
        picks = tuple(pick for pick in picks if pick not in followed)
        surface = self._surface
        places = [place_of(pick, surface.points) for pick in picks]
        wires = tuple(wire for wire in session.wires if wire.id not in moved)
        self._drawn = _Drawn(
            key,
            picks,
            Projected(surface.in_object(np.array(places).reshape(-1, 3))),
            wires,
            Segments([surface.curve_in_object(wire.points) for wire in wires]),
        )
        return self._drawn


def stroke_at(strokes: Sequence[Stroke], sight: Sight, surface: VisibleSurface) -> Stroke | None:
    """Return the stroke nearest to the cursor. Of equally near strokes, it is the newest.

    Parameters
    ----------
    strokes
        Oldest first.
    sight
        The cursor, and the object under it.
    surface
        The mesh that hides strokes.
    """
    best: tuple[float, Stroke | None] = (STROKE_REACH * sight.scale, None)
    for stroke in strokes:
        places = surface.curve_in_object(stroke.points)
        pixels = sight.pixels(places)
        part, gaps = nearest_on_segments(sight.cursor, pixels[:-1], pixels[1:])
        gaps = np.where(np.isnan(gaps), np.inf, gaps)
        for row in np.argsort(gaps, kind="stable").tolist():
            if gaps[row] > best[0]:
                break
            if surface.can_pick(sight, places[row] + part[row] * (places[row + 1] - places[row])):
                best = (float(gaps[row]), stroke)
                break
    return best[1]
