# SPDX-License-Identifier: GPL-3.0-or-later
"""The loop that crosses the picked edge: which of both directions a click on a short edge takes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import length_of, nearest_on_segments

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ..network.wires import Wire

_MUCH_SHORTER = 0.8
"""Loops whose lengths differ by less count as equally long."""


@dataclass(frozen=True)
class Direction:
    """The likeliest loop in one direction.

    Parameters
    ----------
    wire
        The loop.
    unlikeliness
        How unlikely it is that the artist wants it.
    edge
        (2, 3) both ends of its edge at the cursor.
    """

    wire: Wire
    unlikeliness: float
    edge: NDArray[np.float64]


class Directions:
    """Chooses between the loop through an edge and the loop that crosses it, where edges are too short to point at one.

    The last loop that was shown counts until the artist stops asking for loops. So the direction stays while the cursor moves.
    """

    def __init__(self) -> None:
        self._last: Wire | None = None
        self._is_chosen = False

    def forget(self) -> None:
        """Forget the last loop: the artist asks for loops anew."""
        self._last, self._is_chosen = None, False

    def was_shown(self, wire: Wire | None, is_chosen: bool) -> None:
        """Remember the loop that was shown last; `is_chosen`: the artist asked for it in place of the first one."""
        if wire is not None:
            self._last, self._is_chosen = wire, self._is_chosen or is_chosen

    def crossing_first(self, own: Direction, crossing: Direction) -> bool:
        """Whether the crossing loop comes first: the chosen direction, the likelier one, the shorter one, the last one."""
        if self._is_chosen and self._last is not None:
            return self._follows(self._last, own, crossing)
        if own.unlikeliness != crossing.unlikeliness:
            return crossing.unlikeliness < own.unlikeliness
        own_length, crossing_length = length_of(own.wire.points), length_of(crossing.wire.points)
        if min(own_length, crossing_length) < _MUCH_SHORTER * max(own_length, crossing_length):
            return crossing_length < own_length
        return self._last is not None and self._follows(self._last, own, crossing)

    @staticmethod
    def _follows(last: Wire, own: Direction, crossing: Direction) -> bool:
        """Whether the crossing edge runs more like the last loop, where that is nearest, than the picked edge does."""
        starts, ends = last.points[:-1], last.points[1:]
        _, gaps = nearest_on_segments(own.edge.mean(axis=0), starts, ends)
        at = int(np.nanargmin(gaps))
        return _cosine(crossing.edge, (starts[at], ends[at])) > _cosine(own.edge, (starts[at], ends[at]))


def _cosine(one: ArrayLike, two: ArrayLike) -> float:
    """Return the cosine of the angle between two edges without directions."""
    along, other = np.diff(one, axis=0)[0], np.diff(two, axis=0)[0]
    size = float(np.linalg.norm(along) * np.linalg.norm(other))
    return abs(float(along @ other)) / size if size > 0.0 else 0.0
