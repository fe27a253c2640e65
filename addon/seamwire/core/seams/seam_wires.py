# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams that become wires, with the fewest seeds whose wires run as they do or with given seeds, and gaps in seams.

In a gap a cut ends just before it meets another one, or a border: that keeps two islands from separating.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Generator, Iterable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ..base import native
from ..base.refused import Refused
from ..network.wires import Wire
from ..solver.solver import MOST_WAITS, by_number

if TYPE_CHECKING:
    import seamwire_core
    from numpy.typing import NDArray

    from ..network.picks import Edge
    from ..solver.solver import LiveWire

_MISSES = 24
"""How many vertices in a row of a seam no wire has to reach along it before it is given up that one reaches further."""
_SLICE = 0.005
"""Seconds; wires to vertices near the seed are there long before those to all others."""


def seam_chains(seams: NDArray[np.int32], seeds: Collection[int] = ()) -> list[list[int]]:
    """Return seams, (k, 2), as chains of vertices between seeds, ends, and where more than two meet. Closed ones end where they begin."""
    return [chain.tolist() for chain in native.load().edge_chains(seams, list(seeds))]


def wires_between(seams: NDArray[np.int32], seeds: Collection[int], points: NDArray[np.float64]) -> Iterator[Wire]:
    """Yield one wire for each chain of seams between seeds, junctions and ends, see `seam_chains`; a circle is halved."""
    for chain in seam_chains(seams, seeds):
        middle = len(chain) // 2
        for part in (chain[: middle + 1], chain[middle:]) if chain[0] == chain[-1] else (chain,):
            yield Wire("EDGES", tuple(part), points[part], part[0], part[-1])


def wires_along(
    live: LiveWire, chain: list[int], points: NDArray[np.float64], strength: float, before: Edge | None = None
) -> Iterator[Wire | None]:
    """Yield wires that run along a chain of edges, each as far as one does, and going on from the one before.

    `live` runs along edges with a metric of a strength, and is seeded anew. If the last vertex of the chain is the first, there are two
    wires at least. The first one may go on from the directed edge `before`. Points are the mesh's vertices, (n, 3). Yields None while the
    live wires are not that far yet. Raises ValueError where the chain is not part of the surface.
    """
    begin = 0
    while begin < len(chain) - 1:
        end, follow, heading = yield from _reach(live, chain, begin, before)
        vertices = tuple(chain[begin : end + 1])
        yield Wire(
            "EDGES", vertices, points[list(vertices)], vertices[0], vertices[-1],
            heading=heading, follow=follow, strength=strength,
        )  # fmt: skip
        begin, before = end, (vertices[-2], vertices[-1])


def waiting(live: LiveWire, wires: Iterable[Wire | None]) -> Iterator[Wire]:
    """Yield the wires of `wires_along`, waiting for each. Raises Refused if all work is done and a wire is still missing."""
    done = 0
    for wire in wires:
        if wire is not None:
            done = 0
            yield wire
            continue
        done = done + 1 if live.wait(_SLICE) else 0
        if done > MOST_WAITS:
            raise Refused("The computation ended without a result: this step was dropped")


def _reach(
    live: LiveWire, chain: list[int], begin: int, before: Edge | None
) -> Generator[None, None, tuple[int, int, Edge | None]]:
    """Return how far a wire from a place of a chain runs along it, which of them does, and what it goes on from.

    Going on from the last edge before, it may turn less there than one that begins anew. One edge at least: where no wire
    runs along that, it is one all the same, until a seed of it is moved. Yields while it has to wait.
    """
    best: tuple[int, int, Edge | None] = (begin, 0, None)
    # A wire does not end where it begins: around a circle there are two.
    last = len(chain) - (1 if begin == 0 and chain[0] == chain[-1] else 0)
    for heading in (None,) if before is None else (before, None):
        live.seed(chain[begin] if heading is None else heading, forward=heading is not None)
        reached, follow = begin + 1, 0
        for end in range(begin + 1, last):
            if end > reached + _MISSES:
                break
            found = live.wires(chain[end])
            while not found.final:
                yield
                found = live.wires(chain[end])
            # Without the edge before it.
            ways = [way.vertices[0 if heading is None else 1 :].tolist() for way in by_number(found)[0]]
            if chain[begin : end + 1] in ways:
                reached, follow = end, ways.index(chain[begin : end + 1])
        if reached > best[0]:
            best = reached, follow, heading
        if reached == len(chain) - 1:
            break
    return best


@dataclass(frozen=True)
class Gap:
    """Where a cut ends, and the vertex that it nearly meets, with the shortest way there along edges and its length."""

    end: int
    target: int
    length: float
    path: tuple[int, ...] = field(default=(), compare=False)


class GapFinder:
    """Finds the gaps of a mesh's seams, see `seamwire_core.find_gaps`. `surface` returns its surface, on the thread that asks."""

    def __init__(
        self,
        surface: Callable[[], seamwire_core.Surface],
        partly_hidden: NDArray[np.int32] = np.empty((0, 2), dtype=np.int32),  # noqa: B008 - it is not changed
    ) -> None:
        self._surface, self._partly_hidden = surface, partly_hidden

    def find(
        self, seams: NDArray[np.int32], longest: float = 0.5, meant: Collection[int] = (), **options: float
    ) -> list[Gap]:
        """Find the gaps of seams, (k, 2), shortest first. The options are those of `find_gaps`."""
        find, hidden = native.load().find_gaps, self._partly_hidden
        found = find(self._surface(), seams, longest, meant=sorted(meant), partly_hidden=hidden, **options)
        return [Gap(int(path[0]), int(path[-1]), length, tuple(path.tolist())) for path, length in found]
