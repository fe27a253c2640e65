# SPDX-License-Identifier: GPL-3.0-or-later
"""A live wire small enough to see through: a grid, walked by breadth-first search, computed when the test says so."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
import pytest
from numpy.typing import NDArray


@dataclass
class FakeCandidate:
    """A candidate as the library hands it out."""

    points: NDArray[np.float64]
    vertices: NDArray[np.int32]
    length: float
    final: bool
    follow: str = "min"
    faces: NDArray[np.int32] = field(default_factory=lambda: np.empty(0, dtype=np.int32))


@dataclass
class FakeWires:
    """The candidates."""

    wires: tuple[FakeCandidate, ...]
    active: int
    settled: bool
    final: bool

    @property
    def solved(self) -> bool:
        """Nothing here becomes more exact."""
        return self.final


@dataclass
class FakeReport:
    """What became of an embedding."""

    invalid_left: int


@dataclass
class FakeChain:
    """A chain of edges."""

    vertices: NDArray[np.int32]
    final: bool = True
    closed: bool = False
    places: NDArray[np.float64] = field(default_factory=lambda: np.empty(0))
    corners: int = 0


@dataclass
class FakePiece:
    """A piece of a closed cut."""

    points: NDArray[np.float64]
    vertices: NDArray[np.int32]
    faces: NDArray[np.int32] = field(default_factory=lambda: np.empty(0, dtype=np.int32))


@dataclass
class FakeCut:
    """A closed cut."""

    pieces: list[FakePiece]
    joints: list[int | tuple[int, tuple[float, float, float]]]
    separates: bool
    id: tuple[int, int]


@dataclass
class FakeCuts:
    """The closed cuts through a point."""

    cuts: list[FakeCut]
    final: bool


def grid_edges(size: int) -> NDArray[np.int32]:
    """Return the edges of that grid."""
    numbers = np.arange(size * size).reshape(size, size)
    across = np.stack([numbers[:, :-1].ravel(), numbers[:, 1:].ravel()], axis=1)
    up = np.stack([numbers[:-1].ravel(), numbers[1:].ravel()], axis=1)
    return np.concatenate([across, up]).astype(np.int32)


def grid_triangles(size: int) -> NDArray[np.int32]:
    """Return the triangles of that grid: those of square s, from below left, are 2 s and 2 s + 1."""
    numbers = np.arange(size * size).reshape(size, size)
    a, b, c, d = (part.ravel() for part in (numbers[:-1, :-1], numbers[:-1, 1:], numbers[1:, 1:], numbers[1:, :-1]))
    return np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3).astype(np.int32)


def grid_points(size: int) -> NDArray[np.float64]:
    """Return size x size points; vertex y * size + x lies at (x, y, 0)."""
    return np.array([[x, y, 0.0] for y in range(size) for x in range(size)], dtype=np.float64)


@functools.cache
def _library_wires(size: int) -> object:
    """Return the library's live wires along the edges of that grid, ready to answer."""
    core = pytest.importorskip("seamwire_core")
    live = core.LiveWire(grid_points(size), grid_triangles(size), grid_edges(size), along="edges")
    live.wait()
    return live


@dataclass
class FakeLive:
    """Wires on a grid: candidate 0 goes along x first, candidate 1 along y first; a third, where `ready` has one, by turns.

    The first is shorter, unless `shorter` says otherwise; of three the third one leads, whichever is shorter. Vertices in
    `islands` are reached by no wire. Forks begin as `fork_ready` says (None: as this is); a new metric makes it ready as
    `metric_ready` says, and until it is the wires are `stale` ones. Loops go straight on at their corners, as around a limb,
    or turn off there, as `boxes`. Closed cuts may be there `early`, before they are final, the second alone. Across the
    surface the embeddings leave `holes`. If `turned`, candidate 1 comes to an edge over the vertex where candidate 0 leaves it.
    """

    size: int
    along: str = "EDGES"
    ready: tuple[bool, ...] = (True, True)
    shorter: int = 0
    islands: tuple[int, ...] = ()
    holes: tuple[int, int] = (0, 0)
    seeded: tuple[object, bool] | None = None
    seeds: list[tuple[object, bool]] = field(default_factory=list)
    fork_ready: tuple[bool, ...] | None = None
    metric_ready: tuple[bool, ...] | None = None
    stale: bool = False
    boxes: bool = False
    early: bool = False
    turned: bool = False
    through: list[object] = field(default_factory=list)
    bent: list[object] = field(default_factory=list)
    forks: list[FakeLive] = field(default_factory=list)
    metrics: list[tuple[str, float | None, float | None]] = field(default_factory=list)
    strokes: list[tuple[object, ...]] = field(default_factory=list)

    def seed(self, pick: object, forward: bool = False) -> None:
        for vertex in pick if isinstance(pick, tuple) else (pick,):
            if not 0 <= vertex < self.size**2:
                raise ValueError(f"vertex {vertex} is not part of the surface")
        self.seeded = (pick, forward)
        self.seeds.append(self.seeded)

    def _walk(self, start: int, end: int, index: int) -> list[int]:
        x, y = start % self.size, start // self.size
        to_x, to_y = end % self.size, end // self.size
        path = [start]
        while index == 2 and x != to_x and y != to_y:
            x += 1 if to_x > x else -1
            path.append(y * self.size + x)
            y += 1 if to_y > y else -1
            path.append(y * self.size + x)
        for axis in ("xy", "yx", "xy")[index]:
            while (x != to_x) if axis == "x" else (y != to_y):
                if axis == "x":
                    x += 1 if to_x > x else -1
                else:
                    y += 1 if to_y > y else -1
                path.append(y * self.size + x)
        return path

    def wires(self, target: object) -> FakeWires:
        pick, _ = self.seeded
        head = list(pick) if isinstance(pick, tuple) else [pick]
        tail = list(target) if isinstance(target, tuple) else [target]
        candidates = []
        for index in range(len(self.ready)):
            arrives = tail[::-1] if self.turned and index == 1 else tail
            path = head[:-1] + self._walk(head[-1], arrives[0], index) + arrives[1:]
            if not (self.ready[index] or self.stale) or set(tail) & set(self.islands):
                path = []
            points = grid_points(self.size)[path] if path else np.empty((0, 3))
            length = float(len(path)) if path else float("inf")
            follow = ("min", "max", "concave")[index]
            candidates.append(FakeCandidate(points, np.array(path, dtype=np.int32), length, self.ready[index], follow))
        if len(candidates) == 3:
            in_order = (candidates[2], *candidates[:2])
            return FakeWires(in_order, 0, self.ready[2], all(self.ready))
        return FakeWires(tuple(candidates), self.shorter, all(self.ready), all(self.ready))

    def loop(self, edge: tuple[int, int]) -> FakeChain:
        a, b = edge
        if not all(self.ready) or abs(a - b) != 1:
            return FakeChain(np.empty(0, dtype=np.int32), final=all(self.ready))
        up = self.size if max(a, b) + 2 * self.size < self.size**2 else -self.size
        ring = [a, b, b + up, b + 2 * up, a + 2 * up, a + up]
        return FakeChain(np.array(ring, dtype=np.int32), corners=4 if self.boxes else 0)

    def closed_wires(self, through: object) -> FakeCuts:
        """Squares of two cells, to the right of a vertex and to its left; the second does not separate. On `islands` none."""
        if not 0 <= through < self.size**2:
            raise ValueError(f"vertex {through} is not part of the surface")
        self.through.append(through)
        if not (all(self.ready) or self.early) or through in self.islands:
            return FakeCuts([], all(self.ready))
        late = [self._square(through, 1)] if all(self.ready) else []
        return FakeCuts([*late, self._square(through, -1)], all(self.ready))

    def bent_wire(self, through: object, second: object, cut: tuple[int, int]) -> FakeCuts:
        """Along x from a vertex to another and up, then on around the square between them; none where they are in line."""
        if not 0 <= second < self.size**2:
            raise ValueError(f"vertex {second} is not part of the surface")
        self.bent.append((through, second, cut))
        (x, y), (to_x, to_y) = ((v % self.size, v // self.size) for v in (through, second))
        if not all(self.ready) or x == to_x or y == to_y:
            return FakeCuts([], all(self.ready))
        dx, dy = 1 if to_x > x else -1, 1 if to_y > y else -1
        right = [(i, y) for i in range(x, to_x, dx)] + [(to_x, j) for j in range(y, to_y, dy)]
        left = [(i, to_y) for i in range(to_x, x, -dx)] + [(x, j) for j in range(to_y, y, -dy)]
        there, back = ([i + self.size * j for i, j in way] for way in (right, left))
        chains = [[*there, second], [*back, through]]
        pieces = [FakePiece(grid_points(self.size)[chain], np.array(chain, dtype=np.int32)) for chain in chains]
        return FakeCuts([FakeCut(pieces, [second], separates=cut == (0, 0), id=cut)], True)

    def _square(self, corner: int, dx: int) -> FakeCut:
        up = self.size if corner + 2 * self.size < self.size**2 else -self.size
        ring = [
            corner,
            *(corner + dx * x + up * y for x, y in ((1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1))),
        ]
        ring = [*ring, corner]
        chains = [ring[:4], ring[3:7], ring[6:]]
        triangles = grid_triangles(self.size).tolist()
        joints = []
        for chain in chains[:2]:
            at = next(i for i, corners in enumerate(triangles) if chain[-1] in corners)
            joints.append((at, tuple(0.8 if v == chain[-1] else 0.1 for v in triangles[at])))
        pieces = [FakePiece(grid_points(self.size)[chain], np.array(chain, dtype=np.int32)) for chain in chains]
        return FakeCut(pieces, joints, separates=dx > 0, id=(0, 0) if dx > 0 else (1, 1))

    def extend_straight(self, edge: tuple[int, int], stops: Iterable[int] = ()) -> FakeChain:
        """Return the way on to a stop, to the boundary (or around along it), or to a vertex where it has been."""
        stops = set(stops)
        before, at = edge
        way, visited = [at], {before, at}
        while (after := self._straight_on(before, at)) is not None:
            way.append(after)
            if after in stops or after in visited:
                break
            visited.add(after)
            before, at = at, after
        return FakeChain(np.array(way, dtype=np.int32))

    def _straight_on(self, before: int, at: int) -> int | None:
        last = self.size - 1
        (from_x, from_y), (x, y) = ((v % self.size, v // self.size) for v in (before, at))
        dx, dy = x - from_x, y - from_y
        if 0 <= x + dx <= last and 0 <= y + dy <= last:
            return at + dx + self.size * dy
        if (x, y) in itertools.product((0, last), repeat=2):  # a boundary does not turn at its corners
            dx, dy = (0, -1 if y else 1) if dx else (-1 if x else 1, 0)
            return at + dx + self.size * dy
        return None

    def edge_loop(self, edge: tuple[int, int], stops: Iterable[int] = ()) -> object:
        """Return the library's own edge loop on the grid, as soon as this is ready."""
        if not any(self.ready):
            return FakeChain(np.empty(0, dtype=np.int32))
        return _library_wires(self.size).edge_loop(edge, stops)

    def fit_chain(
        self, points: NDArray[np.float64], faces: NDArray[np.int32], begin: int | None = None, end: int | None = None
    ) -> object:
        """Return the library's own chain along a line on the grid, as soon as this is ready."""
        if not any(self.ready):
            return FakeChain(np.empty(0, dtype=np.int32))
        return _library_wires(self.size).fit_chain(points, faces, begin, end)

    def fork(self) -> FakeLive:
        ready = self.fork_ready or self.ready
        fork = FakeLive(
            self.size, self.along, ready, self.shorter, self.islands, holes=self.holes, boxes=self.boxes,
            stale=self.stale, metric_ready=self.metric_ready, early=self.early,
        )  # fmt: skip
        self.forks.append(fork)
        return fork

    def set_metric(
        self, metric: str, *, max_anisotropy: float | None = None, clamp_percentile: float | None = None
    ) -> None:
        self.metrics.append((metric, max_anisotropy, clamp_percentile))
        self.stale = self.stale or all(self.ready)
        self.ready = self.metric_ready or (True,) * len(self.ready)

    def set_scribbles(self, strokes: list[object]) -> None:
        self.strokes.append(tuple(strokes))
        self.stale = self.stale or all(self.ready)
        self.ready = self.metric_ready or (True,) * len(self.ready)

    def embeddings(self) -> tuple[FakeReport | None, FakeReport | None]:
        holes = (*self.holes, 0)[: len(self.ready)]
        reports = (FakeReport(count) if ready else None for count, ready in zip(holes, self.ready, strict=True))
        return tuple(reports) if self.along == "SURFACE" else (None, None)

    def feature_strength(self) -> NDArray[np.float64]:
        return np.zeros(self.size**2)

    @property
    def surface(self) -> object:
        """The library's own surface of the grid."""
        return _library_wires(self.size).surface

    def wait_for_surface(self) -> bool:
        return True

    def progress(self) -> float:
        return sum(self.ready) / len(self.ready)

    def wait(self, seconds: float | None = None) -> bool:
        self.ready = (True,) * len(self.ready)
        return True
