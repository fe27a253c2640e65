# SPDX-License-Identifier: GPL-3.0-or-later
"""Borders of parts and of flat faces: the parts that *Suggest Seamwires* makes islands of."""

from __future__ import annotations

import threading
import traceback
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import length_of
from ..base.half_edges import after
from ..base.refused import Refused
from .turns import SurfaceEdges

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from numpy.typing import NDArray

    from ..network.picks import Edge

VertexChain = tuple[int, ...]
"""The vertices of a closed chain, the first one not repeated."""

NO_SEAMS = np.empty((0, 2), dtype=np.int32)
AMOUNTS = (0.5, 0.75, 1.0, 0.25)
"""How many parts there are, on the scale of *Suggest Seamwires*: the default, then more parts, then fewer."""
AT_ONCE = 5_000
"""Triangles up to which finding parts takes some ten milliseconds, so that a thread would only make it late."""
_LONGEST = 20_000
"""Edges of a border: longer ones go around so much that nobody wants them in one click."""
_IN_PLANE = float(np.cos(np.radians(1.0)))
"""Two faces lie in a plane if the cosine between their normals is at least this."""
_LARGEST = 50_000
"""Triangles of a flat face: around larger ones nobody needs help."""
_LARGEST_WALL = 10_000
"""Triangles of the wall of a tube."""
_LID_CORNERS = 8
"""A flat fan of at least so many faces is a lid."""
_MOST_LIDS = 16
_PLUG = 0.02
"""The part of the mesh's area up to which a part inside of another one counts as a plug."""
_SHARP = float(np.cos(np.radians(65.0)))
"""Two faces meet at a rim if the cosine between their normals is below this. The sides of a tube with six corners meet at 60 degrees."""


class PartBorders:
    """Finds the borders of parts and of flat faces.

    Parameters
    ----------
    points
        (n, 3) vertices of the mesh.
    triangles
        (m, 3) what its polygons are divided into.
    edges
        (e, 2) its edges. Other sides of triangles lie within polygons, which are flat by definition.
    seams
        Returns the edges, (k, 2), that part the mesh already.
    find_parts
        Yields the part of each triangle, (m,), for each of `AMOUNTS`. It takes the seams, and a function that returns whether to search
        further. A thread calls it.

    Attributes
    ----------
    half_edges
        The half-edges of the triangles.
    is_complete
        Whether the parts are known. Until then there are only flat faces.
    """

    def __init__(
        self,
        points: NDArray[np.float64],
        triangles: NDArray[np.int32],
        edges: NDArray[np.int32],
        seams: Callable[[], NDArray[np.int32]] = lambda: NO_SEAMS,
        find_parts: Callable[[NDArray[np.int32], Callable[[], bool]], Iterable[NDArray[np.int32]]] = lambda *_: (),
    ) -> None:
        self.half_edges = SurfaceEdges(points, triangles, edges)
        self._points, self._triangles = points, triangles
        self._seams_now, self._find_parts = seams, find_parts
        self._seams = NO_SEAMS
        self._steps: list[_Parts] = []
        self._thread: threading.Thread | None = None
        self._stop = threading.Event()
        self._working = threading.Lock()
        self._is_prepared = False
        self._error: Exception | None = None
        self.is_complete = False
        # The number of the wall of each triangle; 0: not known.
        self._wall_of = np.zeros(len(triangles), dtype=np.int32)
        self._rims_of_walls: list[tuple[VertexChain, ...]] = [()]

    def ready(self) -> bool:
        """Whether flat faces can be found. This begins to prepare them, and then to find the parts, on a thread that `stop` stops.

        Raises Refused if an error has ended that.
        """
        if self._thread is None:
            self._error = None
            self._stop = threading.Event()
            self._seams = self._seams_now()
            self._thread = threading.Thread(
                target=self._search, args=(self._seams, self._stop), name="seamwire parts", daemon=True
            )
            self._thread.start()
            if len(self._triangles) <= AT_ONCE:
                self._thread.join()
        if self._error is not None:
            raise Refused(f"Loops could not be found: {self._error}")
        return self._is_prepared

    def stop(self) -> None:
        """Let the search for parts end soon. The next call of `ready` begins it again, with what it has measured."""
        if self._thread is not None and not self.is_complete:
            self._stop.set()
            self._thread = None

    def renew(self) -> None:
        """Forget the parts if the seams are others than they were found with."""
        if self._thread is not None and not np.array_equal(self._seams, self._seams_now()):
            self._stop.set()
            self._thread = None
            self._steps, self.is_complete = [], False

    def wait(self) -> None:
        """Wait until everything is known, if `ready` was called."""
        if self._thread is not None:
            self._thread.join()

    def _search(self, seams: NDArray[np.int32], stop: threading.Event) -> None:
        with self._working:  # a search that was stopped ends first
            found: list[_Parts] = []
            try:
                if not self._is_prepared:
                    self.half_edges.prepare()
                    self._is_prepared = True
                for labels in () if stop.is_set() else self._find_parts(seams, lambda: not stop.is_set()):
                    found.append(_Parts(self.half_edges, labels))
            except Exception as error:
                traceback.print_exc()
                # Without parts there are other loops.
                self._error = None if self._is_prepared or stop.is_set() else error
            finally:
                if not stop.is_set():
                    self._steps, self.is_complete = found, True

    def borders(self, edge: Edge) -> Iterator[VertexChain]:
        """Yield the closed chains through an edge that are borders of parts beside it.

        A part may have several borders. A chain that meets itself is left out. Chains may come more than once.
        """
        for parts in self._steps:
            found = (chain for side in self.half_edges.of(edge) for chain in parts.borders(side // 3))
            yield from sorted((chain for chain in found if _has_edge(chain, edge)), key=len)

    def around(self, triangle: int) -> Iterator[tuple[VertexChain, ...]]:
        """Yield the borders of the part that a triangle belongs to, for each of `AMOUNTS`."""
        for parts in self._steps:
            yield parts.borders(triangle)

    def plug_rim(self, triangle: int) -> VertexChain:
        """Return the rim around the small part that a triangle belongs to, such as a button or a bung, or nothing.

        The part has no other border, and no boundary.
        """
        return next(filter(None, (parts.plug_rim(triangle) for parts in self._steps)), ())

    def rims(self, edge: Edge) -> tuple[VertexChain, ...]:
        """Return both rims of the tube inside of which an edge lies, or nothing.

        The tube is a part, an open piece, or in an undivided piece the wall up to sharp edges, lids and the boundary.
        """
        sides = [side // 3 for side in self.half_edges.of(edge)]
        parts = self._steps[0] if self._steps and sides else None
        if parts is None or len({int(parts.labels[side]) for side in sides}) > 1 or len(sides) != 2:
            return ()
        own, other = sides
        if parts.rims(own) or parts.borders(own) or self._wall(own) != self._wall(other):
            return parts.rims(own)
        return self._rims_of_walls[self._wall(own)]

    def _wall(self, triangle: int) -> int:
        """Return the number of the wall of a triangle: the faces around it up to sharp edges, lids and the boundary."""
        if not self._wall_of[triangle]:
            found, rims = self._find_wall(triangle)
            self._wall_of[found & (self._wall_of == 0)] = len(self._rims_of_walls)
            self._rims_of_walls.append(rims)
        return int(self._wall_of[triangle])

    def _find_wall(self, triangle: int) -> tuple[NDArray[np.bool_], tuple[VertexChain, ...]]:
        """Return which triangles, (m,), are part of a triangle's wall, and both rims of the wall if it is a tube."""
        normals, visible = self.half_edges.normals, self.half_edges.visible

        def is_smooth(own: NDArray[np.int64], beside: NDArray[np.int64]) -> NDArray[np.bool_]:
            return (np.einsum("ij,ij->i", normals[own // 3], normals[beside]) >= _SHARP) | ~visible[own]

        def rims(found: NDArray[np.bool_]) -> tuple[VertexChain, ...]:
            return _Parts(self.half_edges, found.astype(np.int32)).rims(triangle)

        found, is_whole = self._around(triangle, is_smooth, _LARGEST_WALL)
        own_rims = rims(found) if is_whole else ()
        if own_rims or not is_whole:
            return found, own_rims
        lids = self._lids(found)
        if lids[triangle]:
            return lids, ()
        found, _ = self._around(triangle, lambda own, beside: is_smooth(own, beside) & ~lids[beside], _LARGEST_WALL)
        return found, rims(found)

    def _lids(self, region: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Return which triangles, (m,), lie on flat faces with a fan of many triangles in a region, (m,)."""
        tails, normals = self.half_edges.tails.reshape(-1, 3), self.half_edges.normals
        corners = tails[region]
        lids = np.zeros_like(region)
        counts = np.bincount(corners.reshape(-1))
        # A lid's fan has the most triangles. Vertices of walls may have many, too.
        for hub in np.argsort(-counts, kind="stable")[: min(_MOST_LIDS, (counts >= _LID_CORNERS).sum())]:
            fan = np.flatnonzero(region)[(corners == hub).any(axis=1)]
            if (normals[fan] @ normals[fan[0]] >= _IN_PLANE).all():
                lids |= self._plane_around(int(fan[0]))
        return lids

    def beside(self, edge: Edge) -> Iterator[Edge]:
        """Yield the edges that meet an edge inside of the same tube."""
        sides, rims = self.half_edges, self.rims(edge)
        for end in edge:
            for side in np.flatnonzero(sides.tails == end).tolist() if rims else ():
                found = (end, int(sides.tails[after(side)]))
                if sides.visible[side] and self.rims(found) is rims and set(found) != set(edge):
                    yield found

    def flat_face(self, triangle: int) -> VertexChain:
        """Return the outer border of the flat face that a triangle is part of, or nothing if that meets itself.

        The face is the polygon of the triangle, with all polygons around it that lie in the same plane.
        """
        is_in_face = self._plane_around(triangle)
        twins = self.half_edges.twins

        def is_inner(half_edge: int) -> bool:
            twin = int(twins[half_edge])
            return twin >= 0 and bool(is_in_face[twin // 3])

        sides = (3 * np.flatnonzero(is_in_face)[:, None] + np.arange(3)).reshape(-1)
        outer = (twins[sides] < 0) | ~is_in_face[twins[sides] // 3]
        chains = [self.half_edges.chain(border) for border in _borders(twins, sides[outer], is_inner)]
        longest = max(chains, key=self._length, default=())
        return longest if len(longest) > 2 and len(set(longest)) == len(longest) else ()

    def _plane_around(self, triangle: int) -> NDArray[np.bool_]:
        """Return which triangles, (m,), are part of a triangle's flat face; none if these are too many."""
        normals, visible = self.half_edges.normals, self.half_edges.visible

        def is_flat(own: NDArray[np.int64], beside: NDArray[np.int64]) -> NDArray[np.bool_]:
            return (normals[beside] @ normals[triangle] >= _IN_PLANE) | ~visible[own]

        found, is_whole = self._around(triangle, is_flat, _LARGEST)
        return found if is_whole else np.zeros_like(found)

    def _around(
        self, triangle: int, joins: Callable[[NDArray[np.int64], NDArray[np.int64]], NDArray[np.bool_]], most: int
    ) -> tuple[NDArray[np.bool_], bool]:
        """Return which triangles, (m,), are connected with one, and whether these are all, because they are not more than `most`.

        `joins` returns whether half-edges, (k,), connect their triangles with those beside them, (k,).
        """
        twins = self.half_edges.twins
        found = np.zeros(len(self._triangles), dtype=np.bool_)
        new = np.array([triangle])
        count = 0
        while len(new):
            found[new] = True
            count += len(new)
            if count > most:
                return found, False
            own = (3 * new[:, None] + np.arange(3)).reshape(-1)
            own = own[twins[own] >= 0]
            beside = twins[own] // 3
            new = np.unique(beside[joins(own, beside) & ~found[beside]])
        return found, True

    def _length(self, chain: VertexChain) -> float:
        return length_of(self._points[[*chain, chain[0]]])


@dataclass(eq=False)
class _Parts:
    """The parts for one amount: `labels` has the part of each triangle, (m,)."""

    half_edges: SurfaceEdges
    labels: NDArray[np.int32]

    def __post_init__(self) -> None:
        self._found: dict[int, tuple[VertexChain, ...]] = {}
        self._rims: dict[int, tuple[VertexChain, ...]] = {}
        _ = self._outer  # on the thread that finds the parts

    @cached_property
    def _outer(self) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
        """The half-edges at borders of parts and at the boundary, sorted by part, and the part of each."""
        twins = self.half_edges.twins
        own = np.repeat(self.labels, 3)
        outer = np.flatnonzero((twins < 0) | (own != self.labels[twins // 3]))
        outer = outer[np.argsort(own[outer], kind="stable")]
        return outer, own[outer]

    def borders(self, triangle: int) -> tuple[VertexChain, ...]:
        """Return the borders of the part with a triangle between parts. Borders that meet themselves are left out."""
        part = int(self.labels[triangle])
        if part not in self._found:
            between = (border for border in self._all(part) if not self.half_edges.boundary[border].all())
            chains = map(self.half_edges.chain, between)
            self._found[part] = tuple(chain for chain in chains if len(set(chain)) == len(chain) > 2)
        return self._found[part]

    def plug_rim(self, triangle: int) -> VertexChain:
        """Return the only border of the part with a triangle if the part is small, or nothing."""
        areas = self._areas
        if areas[self.labels[triangle]] > _PLUG * areas.sum():
            return ()
        borders = self.borders(triangle)
        return borders[0] if len(borders) == 1 == len(self._all(int(self.labels[triangle]))) else ()

    @cached_property
    def _areas(self) -> NDArray[np.float64]:
        return np.bincount(self.labels, self.half_edges.areas)

    def rims(self, triangle: int) -> tuple[VertexChain, ...]:
        """Return both rims of the part with a triangle if that is a tube, or nothing."""
        part = int(self.labels[triangle])
        if part not in self._rims:
            rims = tuple(map(self.half_edges.chain, self._all(part)))
            own = self.half_edges.tails.reshape(-1, 3)[self.labels == part]
            edges = (3 * len(own) + len(self._sides_of(part))) // 2
            is_tube = len(rims) == 2 and len(np.unique(own)) - edges + len(own) == 0
            self._rims[part] = rims if is_tube else ()
        return self._rims[part]

    def _sides_of(self, part: int) -> NDArray[np.int64]:
        outer, owners = self._outer
        begin, end = np.searchsorted(owners, [part, part + 1])
        return outer[begin:end]

    def _all(self, part: int) -> list[list[int]]:
        """Return all borders of a part as half-edges, those on the boundary of the mesh too."""
        twins, labels = self.half_edges.twins, self.labels

        def is_inner(half_edge: int) -> bool:
            twin = int(twins[half_edge])
            return twin >= 0 and bool(labels[twin // 3] == labels[half_edge // 3])

        return _borders(twins, self._sides_of(part), is_inner)


def _has_edge(chain: VertexChain, edge: Edge) -> bool:
    ends = set(edge)
    return any({one, two} == ends for one, two in zip(chain, chain[1:] + chain[:1], strict=True))


def _borders(twins: NDArray[np.int64], sides: NDArray[np.int64], is_inner: Callable[[int], bool]) -> list[list[int]]:
    """Return the outer half-edges of a region as closed chains; nothing if one of them is too long."""
    left = set(sides.tolist())
    borders = []
    for side in sides.tolist():
        if side not in left:
            continue
        border = _walk(twins, side, is_inner)
        if not border:
            return []
        left.difference_update(border)
        borders.append(border)
    return borders


def _walk(twins: NDArray[np.int64], start: int, is_inner: Callable[[int], bool]) -> list[int]:
    """Return the half-edges around a region from one of its border, in order; nothing if they are too many."""
    found: list[int] = []
    at = start
    while len(found) < _LONGEST:
        found.append(at)
        # Around the tip, within the region, to the side that it ends at.
        at = after(at)
        while is_inner(at):
            at = after(int(twins[at]))
        if at == start:
            return found
    return []
