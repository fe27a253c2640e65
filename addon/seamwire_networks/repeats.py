# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a mesh has again what a set of edges runs along: fingers, bolts, wheels, the other hand.

The set is described by a walk along it: how many edges each of its vertices has, whether that is on the border, and by how many edges
the walk turns there. The same walk is begun at every other edge of the mesh, in both directions and mirrored. If it comes to its end, the
place is a repeat. Repeats have the same connectivity and the same lengths of edges. They may lie anywhere.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from .placing import tell, within
from .tool import groups

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from numpy.typing import NDArray

    from .placing import Progress
    from .tool import Arrays, Edge, Pick, Wire

_TOLERANCES = (0.01, 0.05)
"""Parts by which lengths of edges may differ; the second is asked where with the first nothing is found."""


@dataclass(frozen=True)
class _WalkStep:
    """One edge of the walk: a dart, the step whose head it leaves, or -1, and by how many places it lies beyond the way back there."""

    dart: int
    parent: int
    turn: int


class Repeats:
    """Finds the repeats of wires on one mesh, with vertices (n, 3), triangles (m, 3) that its polygons are cut into, and edges (e, 2).

    A dart is an edge with a direction: 2 e from the first vertex of edge e to the second, 2 e + 1 back.
    """

    def __init__(self, points: NDArray[np.float64], triangles: NDArray[np.int32], edges: NDArray[np.int32]) -> None:
        self._edges = edges
        self._tails = edges.reshape(-1).astype(np.int64)
        self._lengths = np.repeat(np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1), 2)
        self._numbers = {(min(pair), max(pair)): number for number, pair in enumerate(edges.tolist())}
        self._look_around(len(points), triangles)

    def of(
        self, wires: Iterable[Wire], points: NDArray[np.float64], progress: Progress = lambda _: True
    ) -> Iterator[list[Wire]]:
        """Yield for each repeat of connected wires along edges its wires. Edges that the walk does not reach are ignored."""
        wires = list(wires)
        for to in self.maps({edge for wire in wires for edge in wire.edges()}, progress):
            yield [_moved(wire, to, points) for wire in wires if set(wire.vertices) <= to.keys()]

    def maps(self, edges: Iterable[Edge], progress: Progress = lambda _: True) -> Iterator[dict[int, int]]:
        """Yield for each repeat of a connected set of edges where its vertices are there; no two have all edges in common.

        Raises `seamwire_core.Cancelled` where `progress` returns False.
        """
        known = [self._numbers[pair] for pair in edges]
        steps = self._walk(known)
        seen = {frozenset(known)}
        for number, tolerance in enumerate(_TOLERANCES):
            for half, sense in enumerate((1, -1)):
                part = within(progress, 0.5 * number + 0.25 * half, 0.5 * number + 0.25 * (half + 1))
                found = self._follow(steps, tolerance, sense, part)
                for row, darts in enumerate(found.tolist()):
                    tell(part, 0.5 + 0.5 * row / len(found))
                    whole = frozenset(dart >> 1 for dart in darts)
                    to = self._matched(steps, darts)
                    if whole not in seen and to is not None:
                        seen.add(whole)
                        yield to
            if len(seen) > 1:
                return

    def _walk(self, edges: list[int]) -> list[_WalkStep]:
        """Return a walk along all edges that hang together with the first one, breadth first."""
        left = set(edges[1:])
        # The walk starts from both ends of the first edge. The way back to its other end counts as a step.
        steps = [_WalkStep(2 * edges[0], -1, 0), _WalkStep(2 * edges[0] + 1, -1, 0)]
        at = 0
        while at < len(steps):
            back = steps[at].dart ^ 1
            vertex = self._tails[back]
            for dart in self._order[self._begin[vertex] : self._begin[vertex + 1]].tolist():
                if dart >> 1 in left:
                    left.discard(dart >> 1)
                    turn = (self._place[dart] - self._place[back]) % self._valence[vertex]
                    steps.append(_WalkStep(dart, at, int(turn)))
            at += 1
        return steps

    def _follow(self, steps: list[_WalkStep], tolerance: float, sense: int, progress: Progress) -> NDArray[np.int64]:
        """Return the darts, (k, steps), of all walks that are like one, counterclockwise or mirrored: half of the progress."""
        begin = np.arange(len(self._tails))
        darts = np.empty((len(begin), len(steps)), dtype=np.int64)
        for number, step in enumerate(steps):
            tell(progress, 0.5 * number / len(steps))
            if step.parent < 0:
                darts[:, number] = begin[: len(darts)] if number == 0 else darts[:, 0] ^ 1
            else:
                back = darts[:, step.parent] ^ 1
                vertices = self._tails[back]
                place = (self._place[back] + sense * step.turn) % np.maximum(self._valence[vertices], 1)
                darts[:, number] = self._order[self._begin[vertices] + place]
            darts = darts[self._alike(step.dart, darts[:, number], tolerance, sense)]
        return darts

    def _alike(self, dart: int, others: NDArray[np.int64], tolerance: float, sense: int) -> NDArray[np.bool_]:
        """Tell which darts are as long as one, and lead to a vertex like its head."""
        head, heads = self._tails[dart ^ 1], self._tails[others ^ 1]
        alike = np.abs(self._lengths[others] - self._lengths[dart]) <= tolerance * self._lengths[dart]
        alike &= self._valence[heads] == self._valence[head]
        alike &= self._on_border[heads] == self._on_border[head]
        alike &= self._sound[heads] & self._sound[head]
        if self._on_border[head]:
            # Around a vertex on the border places are counted from there.
            place = self._place[dart ^ 1]
            wanted = place if sense > 0 else self._valence[head] - 1 - place
            alike &= self._place[others ^ 1] == wanted
        return alike

    def _matched(self, steps: list[_WalkStep], darts: list[int]) -> dict[int, int] | None:
        """Return which vertices those of the walk are at another place; None: not one to one."""
        to: dict[int, int] = {}
        for step, dart in zip(steps, darts, strict=True):
            for ours, theirs in ((step.dart, dart), (step.dart ^ 1, dart ^ 1)):
                if to.setdefault(int(self._tails[ours]), int(self._tails[theirs])) != self._tails[theirs]:
                    return None
        return to if len(set(to.values())) == len(to) else None

    def _look_around(self, count: int, triangles: NDArray[np.int32]) -> None:
        """Order the darts that leave each vertex counterclockwise; on the border the first one follows on it."""
        # Sides of triangles that are not edges have darts too, behind those of the edges. The walk turns past them.
        tails, heads = (each.astype(np.int64).reshape(-1) for each in (triangles, np.roll(triangles, -1, axis=1)))
        sides = np.minimum(tails, heads) * count + np.maximum(tails, heads)
        keys = np.sort(self._edges, axis=1).astype(np.int64) @ (count, 1)
        diagonals = np.setdiff1d(sides, keys)
        ends = np.concatenate([self._edges, np.stack([diagonals // count, diagonals % count], axis=1)]).astype(np.int64)
        keys = np.concatenate([keys, diagonals])
        order = np.argsort(keys)
        number = order[np.searchsorted(keys[order], sides)]
        dart = 2 * number + (tails != ends[number, 0])
        leaves = ends.reshape(-1)
        # On the left of a dart lies a triangle, and behind that the next dart around its tail: the last side, backwards.
        behind = np.full(len(leaves), -1, dtype=np.int64)
        behind[dart] = np.roll(dart.reshape(-1, 3), 1, axis=1).reshape(-1) ^ 1

        first = np.ones(len(leaves), dtype=np.bool_)
        first[behind[behind >= 0]] = False
        firsts = np.bincount(leaves[first], minlength=count)
        self._on_border = firsts > 0
        start = np.full(count, -1, dtype=np.int64)
        start[leaves] = np.arange(len(leaves))
        start[leaves[first]] = np.flatnonzero(first)

        degree = np.bincount(leaves, minlength=count)
        self._place = np.zeros(len(self._tails), dtype=np.int64)
        self._valence = np.zeros(count, dtype=np.int64)
        passed = np.zeros(count, dtype=np.int64)
        at = start.copy()
        turning = np.flatnonzero(start >= 0)
        while len(turning):
            here = at[turning]
            is_edge = here < len(self._tails)
            self._place[here[is_edge]] = self._valence[turning[is_edge]]
            self._valence[turning[is_edge]] += 1
            passed[turning] += 1
            at[turning] = behind[here]
            goes_on = (at[turning] >= 0) & (at[turning] != start[turning]) & (passed[turning] < degree[turning])
            turning = turning[goes_on]
        # Several fans, edges with more than two triangles or none, triangles turned inside out: nothing to turn around.
        self._sound = (passed == degree) & (firsts <= 1)
        self._sound[leaves[np.bincount(dart, minlength=len(leaves)) > 1]] = False
        self._valence = np.bincount(self._tails, minlength=count)
        self._begin = np.concatenate([[0], np.cumsum(self._valence)])
        self._order = np.zeros(len(self._tails), dtype=np.int64)
        whole = np.flatnonzero(self._sound[self._tails])
        self._order[self._begin[self._tails[whole]] + self._place[whole]] = whole


def _moved(wire: Wire, to: dict[int, int], points: NDArray[np.float64]) -> Wire:
    vertices = tuple(to[vertex] for vertex in wire.vertices)
    around = [*vertices, *vertices[:1]] if wire.closed else list(vertices)

    def pick(old: Pick, end: int) -> Pick:
        if isinstance(old, tuple) and set(old) <= to.keys():
            return to[old[0]], to[old[1]]
        return end

    start, end = pick(wire.start, vertices[0]), pick(wire.end, vertices[-1])
    through = None if wire.through is None else pick(wire.through, -1)
    ends = sorted(through) if isinstance(through, tuple) else None
    # Mirrored places are found as others are.
    kept = replace(wire, offers=(), heading=None, mirror=())
    return kept.anew(
        vertices=vertices,
        points=points[around],
        start=start,
        end=end,
        kind=wire.kind if ends else None,
        through=(ends[0], ends[1]) if ends else None,
    )


def missing_wires(
    groups: Sequence[list[Wire]], arrays: Arrays, progress: Progress = lambda _: True
) -> tuple[int, list[Wire]]:
    """Find the places where a mesh repeats groups of connected wires. Return how many lack seams, and the wires to add there.

    Raises `seamwire_core.Cancelled` where `progress` returns False.
    """
    repeats = Repeats(arrays.points, arrays.triangles, arrays.edges)
    taken = {(min(pair), max(pair)) for pair in arrays.seams.tolist()}
    places, new = 0, []
    for number, group in enumerate(groups):
        part = within(progress, number / len(groups), (number + 1) / len(groups))
        for place in repeats.of(group, arrays.points, part):
            wires = [wire for wire in place if not taken.issuperset(wire.edges())]
            places += bool(wires)
            new += wires
            taken.update(edge for wire in wires for edge in wire.edges())
    return places, new


def connected_groups(wanted: Iterable[Wire], wires: Sequence[Wire]) -> list[list[Wire]]:
    """Return each group of connected wires, which share vertices, that has a wanted wire, once."""
    chosen = set(wanted)
    found = ([wires[row] for row in rows] for rows in groups([wire.vertices for wire in wires]))
    return [group for group in found if not chosen.isdisjoint(group)]
