# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed cuts across the surface: what one click on a point offers, and what of them is kept."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import length_of, nearest_on_segments
from ..base.refused import Refused
from ..network.picks import FacePoint, place_of
from ..network.wires import Wire
from ..solver.solver import for_live

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from numpy.typing import NDArray

    from ...terms.choices import LoopKind
    from ..network.drawn import Drawn
    from ..network.picks import Pick
    from ..solver.solver import ClosedCut, Engines, LiveWire
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
    """A closed cut that is kept, and where it came from: what it takes to bend it."""

    through: Pick  # the point that it was taken at
    course: NDArray[np.float64]  # (k, 3) when it was added, from that point around; bending does not change it
    wires: tuple[Wire, ...]
    id: tuple[int, int] | None = (
        None  # the library's among the cuts through that point; None: it was added on another mesh
    )
    metric: tuple[object, ...] = ()  # the request that found it

    def is_in(self, network: Drawn) -> bool:
        own = [(wire, network.find(wire)) for wire in self.wires]
        return all(now is not None and now.like(wire) for wire, now in own)

    def of(self, network: Drawn) -> TakenCut | None:
        """Return it as another mesh has it, of those wires of a network that run as its wires ran; None where they do not lead around.

        Where it was cut, they are others: a seed may have gone that lay in the way of a straight cut.
        """
        ran = np.concatenate([wire.points for wire in self.wires])
        length = sum(length_of(wire.points) for wire in self.wires)
        near = _ON * length
        wires = tuple(
            wire
            for wire in network.wires
            # Most are told by where they begin.
            if nearest_on_segments(wire.points[0], ran[:-1], ran[1:])[1].min() < 5.0 * near
            and _mean_gap(wire.points, ran) < near
        )
        around = sum(length_of(wire.points) for wire in wires)
        if abs(around - length) > _LONGER * length:
            return None
        return replace(self, wires=wires, id=None, metric=())


def is_same(one: NDArray[np.float64], two: NDArray[np.float64]) -> float | None:
    """Return how far two closed courses, (k, 3), are apart, as part of the first one's length; None: too far to be the same cut."""
    apart = max(_mean_gap(one, two), _mean_gap(two, one)) / length_of(one)
    return apart if apart < _SAME else None


def _mean_gap(course: NDArray[np.float64], other: NDArray[np.float64]) -> float:
    steps = np.linalg.norm(np.diff(course, axis=0), axis=1)
    gaps = [
        np.nanmin(nearest_on_segments(place, other[:-1], other[1:])[1]) for place in 0.5 * (course[:-1] + course[1:])
    ]
    return float(np.average(gaps, weights=steps))


class CutMemory:
    """The closed cuts that were taken since the file was opened: undo brings back meshes whose sessions are over."""

    def __init__(self) -> None:
        self.clear()

    def clear(self) -> None:
        # Courses in object coordinates, by the numbers under which meshes know the wires of a cut.
        self._courses: dict[frozenset[int], NDArray[np.float64]] = {}
        self._size = 0

    def keep(self, cuts: Iterable[TakenCut], network: Drawn, places: Places) -> None:
        number_of = {wire.id: wire.stored for wire in network.wires}
        for cut in cuts:
            numbers = frozenset(number_of[wire.id] for wire in cut.wires)
            if 0 in numbers or numbers in self._courses:
                continue
            self._courses[numbers] = cut.course @ places.to_object.T
            self._size += cut.course.nbytes
            while self._size > _MOST_BYTES and len(self._courses) > 1:
                self._size -= self._courses.pop(next(iter(self._courses))).nbytes

    def recall(self, network: Drawn, places: Places) -> Iterator[TakenCut]:
        """Yield the cuts whose wires a network has, as they are on its mesh, the one taken last at the end."""
        wire_of = {wire.stored: wire for wire in network.wires}
        for numbers, in_object in self._courses.items():
            if not wire_of.keys() >= numbers:
                continue
            wires = tuple(wire_of[number] for number in sorted(numbers))
            course = in_object @ np.linalg.pinv(places.to_object).T
            # A point inside a face became a vertex when the wires were cut.
            ends = {end for wire in wires for end in (wire.start, wire.end) if not isinstance(end, tuple)}
            gaps = {end: float(np.linalg.norm(place_of(end, places.points) - course[0])) for end in ends}
            if gaps:
                yield TakenCut(min(gaps, key=gaps.__getitem__), course, wires)


class SurfaceLoops:
    """Finds the closed cuts through a point, or the cut that was taken last bent to it."""

    def __init__(self, engines: Engines, triangles: NDArray[np.int32]) -> None:
        self._engines = engines
        self._triangles = triangles
        self._found: dict[int, tuple[tuple[Wire, ...], tuple[int, int]]] = {}
        self._cuts: list[TakenCut] = []

    def find(
        self, pick: Pick, network: Drawn, bends: bool = False, into_faces: bool = False
    ) -> tuple[tuple[Wire, ...], bool]:
        """Return the closed cuts through a pick, each as one wire to be shown, and whether they are final.

        With `bends`, it is the cut that was taken last, bent to the pick. If cuts do not go `into_faces`, two of them that go to the same
        edges are one. Raise ValueError if the pick is not part of the surface, or there is no cut that can be bent to it.
        """
        live = self._engines.cuts()
        begin = pick
        if bends:
            cut = self.bendable(network)
            if cut is None:
                raise Refused("No closed cut to bend: add one first")
            begin = cut.through
            number = self._id_of(cut, live)
            if number is None:
                return (), False
            found = live.bent_wire(for_live(begin, "SURFACE"), for_live(pick, "SURFACE"), number)
            if found.final and not found.cuts:
                raise Refused("No closed cut leads through both points")
        else:
            found = live.closed_wires(for_live(pick, "SURFACE"))
        self._found = {}
        shown: list[Wire] = []
        for each in found.cuts:
            pieces = self._pieces_of(each, begin)
            if len(pieces) < 2:
                continue
            vertices = sum((piece.vertices[:-1] for piece in pieces), ())
            points = np.concatenate([piece.points[:-1] for piece in pieces] + [pieces[0].points[:1]])
            kind: LoopKind = "ACROSS" if each.separates else "HANDLE"
            whole = pieces[0].anew(vertices=vertices, points=points, faces=None, end=begin, closed=True, kind=kind)
            # On a coarse mesh, cuts apart from each other may go to the same edges.
            edges = None if into_faces else set(whole.edges())
            if not any(whole.like(other) or set(other.edges()) == edges for other in shown):
                shown.append(whole)
                self._found[whole.id] = pieces, each.id
        return tuple(shown), found.final

    def bendable(self, network: Drawn) -> TakenCut | None:
        """Return the last cut that the network still has unchanged, and that would be found again."""
        metric = self._metric
        known = (cut for cut in reversed(self._cuts) if cut.id is None or cut.metric == metric)
        return next((cut for cut in known if cut.is_in(network)), None)

    def taken(self, network: Drawn) -> tuple[TakenCut, ...]:
        return tuple(cut for cut in self._cuts if cut.is_in(network))

    def recall(self, cuts: Iterable[TakenCut]) -> None:
        """Go on from cuts that were taken in other sessions, in place of those taken in this one."""
        self._cuts = list(cuts)

    def _id_of(self, cut: TakenCut, live: LiveWire) -> tuple[int, int] | None:
        """Return the library's number of a cut that is bent. None while it is computed: on a mesh that was cut, numbers are others."""
        if cut.id is not None:
            return cut.id
        found = live.closed_wires(for_live(cut.through, "SURFACE"))
        if not found.final:
            return None
        courses = {each.id: np.concatenate([np.asarray(piece.points) for piece in each.pieces]) for each in found.cuts}
        apart = {number: is_same(cut.course, course.astype(np.float64)) for number, course in courses.items()}
        same = {number: gap for number, gap in apart.items() if gap is not None}
        if not same:
            raise Refused("The mesh has changed too much to find this cut again: undo, or add another cut")
        nearest = min(same, key=same.__getitem__)
        self._cuts[self._cuts.index(cut)] = replace(cut, id=nearest, metric=self._metric)
        return nearest

    @property
    def _metric(self) -> tuple[object, ...]:
        return self._engines.strengths["SURFACE"], self._engines.strokes

    def pieces(self, offer: Wire) -> tuple[Wire, ...]:
        """Return the wires that an offer found last consists of: a closed chain with seeds where they meet."""
        return self._found[offer.id][0]

    def take(
        self, found: SurfaceLoops, pick: Pick, offer: Wire, wires: tuple[Wire, ...], before: TakenCut | None
    ) -> None:
        """Remember that an offer which was `found` last for a pick is kept now, as these wires. It may replace the cut `before`."""
        through, course = (pick, offer.points) if before is None else (before.through, before.course)
        self._cuts.append(TakenCut(through, course, wires, found._found[offer.id][1], found._metric))

    def _pieces_of(self, cut: ClosedCut, pick: Pick) -> tuple[Wire, ...]:
        joints: list[Pick] = []
        for joint in cut.joints:
            if not isinstance(joint, int):
                triangle, weights = joint
                joint = FacePoint(int(triangle), tuple(self._triangles[triangle].tolist()), tuple(map(float, weights)))
            joints.append(joint)
        wires = []
        for piece, start, end in zip(cut.pieces, [pick, *joints], [*joints, pick], strict=True):
            vertices, points = tuple(map(int, piece.vertices)), np.array(piece.points, dtype=np.float64)
            wires.append(Wire("SURFACE", vertices, points, start, end, np.array(piece.faces)))
        return tuple(wires)
