# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed cuts that are kept, and what of them outlives a session: a mesh that was cut is another one, with another session."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import length_of, nearest_on_segments
from ..network.picks import place_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from numpy.typing import NDArray

    from ..network.network import Network
    from ..network.picks import Pick
    from ..network.wires import Wire
    from ..storage.serialization import Places

_SAME = 0.125
"""Two closed cuts count as the same if their mean distance is below this fraction of their length. Cutting or sliding changes the
triangles, so where the shape suggests little, the cut that is computed again may lie elsewhere around the same limb. Circles around
two limbs that touch are 0.18 of their length apart, those around a torus and its tube 0.2."""

_ON = 0.02
"""How far from a closed cut, as part of its length, the wires are in the mean that it was cut along: cuts are straight over faces."""
_LONGER = 0.1
"""By how much of its length these may be longer or shorter in all."""
_MOST_BYTES = 16_000_000
"""Of the courses that are remembered. The oldest ones go first."""


@dataclass(frozen=True, eq=False)
class TakenCut:
    """A closed cut that is kept, and where it came from: what it takes to bend it.

    Parameters
    ----------
    through
        The point that it was taken at.
    course
        (k, 3) its course when it was added, from that point around. Bending does not change it.
    wires
        The wires that it consists of.
    id
        The library's number among the cuts through that point, or None if it was added on another mesh.
    metric
        The request that found it.
    """

    through: Pick
    course: NDArray[np.float64]
    wires: tuple[Wire, ...]
    id: tuple[int, int] | None = None
    metric: tuple[object, ...] = ()

    def is_in(self, network: Network) -> bool:
        """Return whether a network still has its wires unchanged."""
        own = [(wire, network.find(wire)) for wire in self.wires]
        return all(now is not None and now.like(wire) for wire, now in own)

    def of(self, network: Network) -> TakenCut | None:
        """Return it as another mesh has it, of those wires of a network that run as its wires ran; None where they do not lead around.

        Where it was cut, they are others: a seed may have gone that lay in the way of a straight cut.
        """
        ran = np.concatenate([wire.points for wire in self.wires])
        length = sum(length_of(wire.points) for wire in self.wires)
        wires = tuple(wire for wire in network.wires if _runs_along(wire.points, ran, _ON * length))
        around = sum(length_of(wire.points) for wire in wires)
        if abs(around - length) > _LONGER * length:
            return None
        return replace(self, wires=wires, id=None, metric=())


def is_same(one: NDArray[np.float64], two: NDArray[np.float64]) -> float | None:
    """Return how far two closed courses, (k, 3), are apart, as part of the first one's length; None: too far to be the same cut."""
    apart = max(_mean_gap(one, two), _mean_gap(two, one)) / length_of(one)
    return apart if apart < _SAME else None


def _runs_along(course: NDArray[np.float64], other: NDArray[np.float64], near: float) -> bool:
    """Whether a course is in the mean no farther from another; most are told by where they begin."""
    begins = nearest_on_segments(course[0], other[:-1], other[1:])[1].min()
    return bool(begins < 5.0 * near) and _mean_gap(course, other) < near


def _mean_gap(course: NDArray[np.float64], other: NDArray[np.float64]) -> float:
    """Return how far a course is from another, in the mean over its length."""
    steps = np.linalg.norm(np.diff(course, axis=0), axis=1)
    gaps = [
        np.nanmin(nearest_on_segments(place, other[:-1], other[1:])[1]) for place in 0.5 * (course[:-1] + course[1:])
    ]
    return float(np.average(gaps, weights=steps))


@dataclass(frozen=True)
class _StoredCut:
    """A closed cut by the numbers under which meshes know its wires; its course, in object coordinates."""

    numbers: frozenset[int]
    course: NDArray[np.float64] = field(compare=False)


class CutMemory:
    """The closed cuts that were taken since the file was opened: undo brings back meshes whose sessions are over."""

    def __init__(self) -> None:
        self._cuts: dict[_StoredCut, None] = {}
        self._size = 0

    def clear(self) -> None:
        """Forget all cuts."""
        self._cuts.clear()
        self._size = 0

    def keep(self, cuts: Iterable[TakenCut], network: Network, places: Places) -> None:
        """Remember cuts that a mesh holds now, and the numbers that it knows their wires by, which `network` has."""
        number_of = {wire.id: wire.stored for wire in network.wires}
        for cut in cuts:
            numbers = frozenset(number_of[wire.id] for wire in cut.wires)
            if 0 not in numbers:
                self._add(_StoredCut(numbers, cut.course @ places.to_object.T))

    def _add(self, cut: _StoredCut) -> None:
        if cut in self._cuts:
            return
        self._cuts[cut] = None
        self._size += cut.course.nbytes
        while self._size > _MOST_BYTES and len(self._cuts) > 1:
            oldest = next(iter(self._cuts))
            del self._cuts[oldest]
            self._size -= oldest.course.nbytes

    def recall(self, network: Network, places: Places) -> Iterator[TakenCut]:
        """Yield the cuts whose wires a network has, as they are on its mesh, the one taken last at the end."""
        wire_of = {wire.stored: wire for wire in network.wires}
        for cut in self._cuts:
            if not wire_of.keys() >= cut.numbers:
                continue
            wires = tuple(wire_of[number] for number in sorted(cut.numbers))
            course = cut.course @ np.linalg.pinv(places.to_object).T
            # A point inside a face became a vertex when the wires were cut.
            ends = {end for wire in wires for end in (wire.start, wire.end) if not isinstance(end, tuple)}
            gaps = {end: float(np.linalg.norm(place_of(end, places.points) - course[0])) for end in ends}
            if gaps:
                yield TakenCut(min(gaps, key=gaps.__getitem__), course, wires)
