# SPDX-License-Identifier: GPL-3.0-or-later
"""What is under the cursor: a seed, a wire, a seam, or the edge or vertex nearest to it on the visible part of an edit mesh."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..core.base import native
from ..core.base.geometry import nearest_on_segments
from ..core.base.incidence import Incidence
from ..core.network.network import FacePoint, Snap, place_of, vertices_of
from .viewport import Projected

if TYPE_CHECKING:
    from mathutils import Matrix
    from numpy.typing import ArrayLike, NDArray

    from ..core.base.mesh_arrays import Arrays
    from ..core.drawing.session import Session
    from ..core.fields.crests import Crests
    from ..core.network.network import Edge, Pick, Wire
    from ..core.network.strokes import Stroke
    from .viewport import View

VERTEX_RADIUS = 12.0
"""Pixels around a vertex in which it is picked rather than its edge..."""
VERTEX_SHARE = 0.25
"""...but never over more than this part of the edge, so that every edge can be picked."""
REACH = 14.0
"""Pixels beside the mesh in which it is still found: rims and silhouettes are hard to hit."""
SEED_REACH = 9.0
"""Pixels beside a seed in which it is found..."""
WIRE_REACH = 6.0
"""...beside a wire..."""
SEAM_REACH = 4.0
"""...and beside a seam: narrower, for meshes have many, and they must not keep the edges next to them from being picked."""
STROKE_REACH = 12.0
"""Pixels beside a stroke in which it is found."""
FEATURE_REACH = 10.0
"""Pixels in which the strongest feature is looked for."""
FEATURE_QUANTILE = 0.75
"""A vertex counts as a feature from this share of all vertices' strengths on: on a plain nothing is stronger than noise."""
SHORT_EDGE = 12.0
"""Pixels below which an edge is too short to point at."""
_STRAIGHT_COSINE = 0.9
"""An edge that turns off by less than some 25 degrees does not cross another one..."""
_SAME_COSINE = 0.05
"""...and edges cross equally well if these cosines differ by less."""
_MAX_NEAR = 400
"""Vertices that are looked at for a feature: what a far view has within a few pixels more than this, nobody can tell apart."""
_MOST_TRIED = 4
"""So many of the vertices near the cursor are tried for one that is not hidden."""
_MAX_PIECES = 24
"""Pieces of wires under one cursor that are tried for one that is not hidden."""
_FEW_EDGES = 50_000
"""So many are projected all; of more, those at the vertices that are near."""


class _Placement:
    """Where an object stands in the world.

    Parameters
    ----------
    matrix
        The object's matrix; may rotate, scale and shear.
    """

    def __init__(self, matrix: Matrix | NDArray[np.float64]) -> None:
        self.matrix = np.array(matrix, dtype=np.float64)

    @property
    def is_flat(self) -> bool:
        """Whether the matrix flattens the object, so that nothing of it can be picked."""
        return abs(float(np.linalg.det(self.matrix))) < 1e-30

    @cached_property
    def inverse(self) -> NDArray[np.float64]:
        """(4, 4), takes world coordinates to object coordinates."""
        return np.linalg.inv(self.matrix)

    def to_world(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Take (..., 3) points from object coordinates to world coordinates."""
        return points @ self.matrix[:3, :3].T + self.matrix[:3, 3]

    def from_world(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Take (..., 3) points from world coordinates to object coordinates."""
        return points @ self.inverse[:3, :3].T + self.inverse[:3, 3]


class _Segments:
    """Straight pieces of curves, each with the number of its owner.

    Parameters
    ----------
    curves
        Each (k, 3), in object coordinates.
    """

    def __init__(self, curves: list[NDArray[np.float64]]) -> None:
        none = np.empty((0, 3))
        self.starts = Projected(np.concatenate([none, *(curve[:-1] for curve in curves)]))
        self.ends = Projected(np.concatenate([none, *(curve[1:] for curve in curves)]))
        self.owners = np.repeat(np.arange(len(curves)), [max(len(curve) - 1, 0) for curve in curves])

    def near(
        self, view: View, matrix: NDArray[np.float64], cursor: tuple[float, float], radius: float
    ) -> Iterator[tuple[int, NDArray[np.float64]]]:
        """Yield owners and their points under the cursor, nearest first: of one that lies there more than once, each."""
        if not len(self.owners):
            return
        starts = np.stack(self.starts.seen(view, matrix)[:2], axis=1)
        ends = np.stack(self.ends.seen(view, matrix)[:2], axis=1)
        part, gaps = nearest_on_segments(cursor, starts, ends)
        rows = np.flatnonzero(gaps <= radius)
        for row in rows[np.argsort(gaps[rows], kind="stable")][:_MAX_PIECES].tolist():
            start, end = self.starts.points[row], self.ends.points[row]
            # Halves on the screen are not halves in space where there is perspective; near enough for a few pixels.
            yield int(self.owners[row]), start + part[row] * (end - start)


@dataclass(frozen=True)
class _Drawn:
    """What of a network can be found by the cursor, in object coordinates."""

    key: object
    picks: tuple[Pick, ...]
    seeds: Projected
    wires: tuple[Wire, ...]
    curves: _Segments


def nearest_edge(
    cursor: tuple[float, float], starts: NDArray[np.float64], ends: NDArray[np.float64], scale: float = 1.0
) -> tuple[int, int | None]:
    """Find the segment nearest to a point, and whether one of its ends is meant.

    Parameters
    ----------
    cursor
        Pixels.
    starts, ends
        (k, 2) pixels; NaN where an end is not in front of the viewer.
    scale
        Of the display.

    Returns
    -------
    index
        Which segment; -1: none.
    end
        0 or 1 where the cursor is so near to that end that it is meant, else None.
    """
    _, gaps = nearest_on_segments(cursor, starts, ends)
    if not len(gaps) or np.isnan(gaps).all():
        return -1, None
    index = int(np.nanargmin(gaps))
    to_ends = np.linalg.norm(np.stack([starts[index], ends[index]]) - np.asarray(cursor), axis=1)
    end = int(np.argmin(to_ends))
    length = float(np.linalg.norm(ends[index] - starts[index]))
    radius = min(VERTEX_RADIUS * scale, VERTEX_SHARE * length)
    return index, end if to_ends[end] <= radius else None


class Picker:
    """Finds what is under the cursor on one edit mesh.

    Parameters
    ----------
    arrays
        The edit mesh.
    seams
        (s, 2) the edges that are seams and that no wire runs along.

    Notes
    -----
    Threads build the library's tree of the triangles and the tables of what meets at each vertex. A lookup before they are ready
    waits for the tables.
    """

    def __init__(self, arrays: Arrays, seams: ArrayLike = ()) -> None:
        self._points = arrays.points
        self._to_object = arrays.to_object
        self._all_edges = arrays.edges
        self._triangles = arrays.triangles
        self._polygons = arrays.polygons
        self._to_points = np.linalg.inv(arrays.to_object)
        self._rays = native.load().RayTree(arrays.points, arrays.triangles)
        self._triangles_at = Incidence(arrays.triangles, len(arrays.points))
        self._edges_at = Incidence(arrays.edges, len(arrays.points))
        self._seam_edges = np.asarray(seams, dtype=np.int64).reshape(-1, 2)
        self._drawn: _Drawn | None = None
        self._strength: tuple[object, float] = (None, 0.0)
        self._crests: tuple[Crests | None, _Segments] = (None, _Segments([]))

    def wait(self) -> None:
        """Wait until the threads have finished."""
        self._rays.wait()
        self._triangles_at.wait()
        self._edges_at.wait()

    def set_seams(self, seams: ArrayLike) -> None:
        """Take other edges, (s, 2), as the seams that no wire runs along."""
        edges = np.asarray(seams, dtype=np.int64).reshape(-1, 2)
        if not np.array_equal(edges, self._seam_edges):
            self._seam_edges = edges
            self.__dict__.pop("_seams", None)

    @cached_property
    def _seams(self) -> _Segments:
        ends = self._in_object(self._points[self._seam_edges.reshape(-1)]).reshape(-1, 2, 3)
        return _Segments(list(ends))

    @cached_property
    def _vertices(self) -> tuple[NDArray[np.int32], Projected]:
        """Return the vertices that are not hidden, and their coordinates."""
        used = np.zeros(len(self._points), dtype=np.bool_)
        used[self._all_edges] = True
        numbers = np.flatnonzero(used).astype(np.int32)
        return numbers, Projected(self._in_object(self._points[numbers]).astype(np.float32))

    def _in_object(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(points) @ self._to_object.T

    def _pixels(self, view: View, placement: _Placement, vertices: ArrayLike) -> NDArray[np.float64]:
        """Return where vertices are seen, (k, 2)."""
        return view.to_pixels(placement.to_world(self._in_object(self._points[vertices])))

    def snap(
        self,
        view: View,
        matrix: Matrix,
        cursor: tuple[float, float],
        *,
        vertices_only: bool,
        edges_only: bool = False,
        anywhere: bool = False,
        session: Session | None = None,
        xray: bool = False,
        preferred: frozenset[int] = frozenset(),
        strength: NDArray[np.float64] | None = None,
        crests: Crests | None = None,
        scale: float = 1.0,
    ) -> Snap | None:
        """Return what a click would take: a seed before a wire, a wire before a seam, a seam before the plain mesh.

        Parameters
        ----------
        view
            The view it is seen in.
        matrix
            The object's matrix; may rotate, scale and shear.
        cursor
            Pixels from the region's bottom left.
        vertices_only, edges_only
            Find vertices of the mesh alone, or edges.
        anywhere
            Of vertices alone, find only those that are meant, else the point of the surface under the cursor.
        session
            Whose seeds and wires can be found; without it neither they nor seams are.
        xray
            Find what lies behind faces too; the nearest on the screen.
        preferred
            Vertices that are taken before all else of the plain mesh if they are as near as features may be.
        strength
            (n,) how strong the feature is at each vertex; then the strongest one nearby is taken.
        crests
            Ridges and valleys; then what lies on one nearby is taken before all else of the plain mesh.
        scale
            Of the display.
        """
        placement = _Placement(matrix)
        if placement.is_flat:
            return None
        if session is not None:
            found = self._drawn_at(session, view, placement, cursor, xray, scale)
            if found is not None:
                return found
        if xray:
            pick = self._pick_through(view, placement, cursor, vertices_only, scale)
        else:
            pick = self._point_at(view, placement, cursor, scale) if anywhere else None
            if pick is None:
                pick = self._pick(view, placement, cursor, vertices_only, scale, edges_only)
        if pick is None:
            return None
        if preferred:
            near = self._vertices_near(view, placement, cursor, pick, scale)
            for vertex in sorted((v for v in near if v in preferred), key=near.__getitem__)[:_MOST_TRIED]:
                if xray or self._sees(view, placement, self._to_object @ self._points[vertex]):
                    return Snap(vertex)
        crest = None if crests is None else self._crest_at(view, placement, cursor, crests, anywhere, xray, scale)
        if crest is not None:
            return Snap(crest, "FEATURE")
        if edges_only and isinstance(pick, tuple):
            return self._with_crossing(view, placement, cursor, pick, scale)
        if strength is None:
            return Snap(pick)
        feature = self._feature_at(view, placement, cursor, pick, strength, xray, scale)
        return Snap(pick) if feature is None else Snap(feature, "FEATURE")

    def seen_along(self, view: View, matrix: Matrix, pick: Pick) -> tuple[float, float, float] | None:
        """Return the direction from the viewer to a pick, as `Arrays.points` are given; None: it lies behind the viewer."""
        placement = _Placement(matrix)
        if placement.is_flat:
            return None
        place = self._to_object @ place_of(pick, self._points)
        pixel = view.to_pixels(placement.to_world(place)[None])[0]
        if not np.isfinite(pixel).all():
            return None
        near, far = self._ray(view, placement, (float(pixel[0]), float(pixel[1])))
        x, y, z = (far - near).tolist()
        return x, y, z

    def depth(self, view: View, matrix: Matrix, cursor: tuple[float, float]) -> float | None:
        """Return how far away the face under the cursor is, in world units from the near plane; None beside the mesh."""
        placement = _Placement(matrix)
        hit = None if placement.is_flat else self._cast(view, placement, cursor)
        return None if hit is None else float(np.linalg.norm(placement.to_world(hit[1]) - view.ray(cursor)[0]))

    def surface_at(
        self, view: View, matrix: Matrix, cursor: tuple[float, float]
    ) -> tuple[NDArray[np.float64], int] | None:
        """Return the point of the surface under the cursor, as `Arrays.points` are given, and the triangle it lies in."""
        placement = _Placement(matrix)
        hit = None if placement.is_flat else self._cast(view, placement, cursor)
        return None if hit is None else (self._to_points @ hit[1], hit[0])

    def sees(self, view: View, matrix: Matrix, place: NDArray[np.float64]) -> bool:
        """Whether nothing lies before a point, (3,), but for what is nearer by no more than a few pixels: it may lie in a crease."""
        return self._sees(view, _Placement(matrix), place)

    # Seeds, wires, seams

    def _drawn_at(
        self,
        session: Session,
        view: View,
        placement: _Placement,
        cursor: tuple[float, float],
        xray: bool,
        scale: float,
    ) -> Snap | None:
        drawn = self._drawn_now(session)

        def free(place: NDArray[np.float64]) -> bool:
            return xray or self._sees(view, placement, place)

        matrix = placement.matrix
        rows = drawn.seeds.near(view, matrix, cursor, SEED_REACH * scale)
        x, y, _ = drawn.seeds.seen(view, matrix)
        gaps = np.hypot(x[rows] - cursor[0], y[rows] - cursor[1])
        for i in np.argsort(gaps, kind="stable").tolist():
            if gaps[i] <= SEED_REACH * scale and free(drawn.seeds.points[rows[i]]):
                return Snap(drawn.picks[rows[i]], "SEED")
        for owner, place in drawn.curves.near(view, matrix, cursor, WIRE_REACH * scale):
            if free(place):
                wire = drawn.wires[owner]
                numbers = np.array(wire.vertices)
                away = np.linalg.norm(self._in_object(self._points[numbers]) - place, axis=1)
                return Snap(int(numbers[np.argmin(away)]), "WIRE", wire)
        for owner, place in self._seams.near(view, matrix, cursor, SEAM_REACH * scale):
            if free(place):
                pair = self._seam_edges[owner]
                away = np.linalg.norm(self._in_object(self._points[pair]) - place, axis=1)
                return Snap(int(pair[np.argmin(away)]), "SEAM")
        return None

    def _drawn_now(self, session: Session) -> _Drawn:
        """Return what can be found of a session's network. Of a dragged seed, neither it nor its wires: they follow."""
        moved = {wire.id for wire in session.moved}
        picks = tuple(session.seeds())
        key = (id(session), session.network_revision, picks, tuple(sorted(moved)))
        if self._drawn is not None and self._drawn.key == key:
            return self._drawn
        followed = {end for wire in session.wires if wire.id in moved for end in (wire.start, wire.end)}
        followed |= {end[::-1] for end in followed if isinstance(end, tuple)}
        picks = tuple(pick for pick in picks if pick not in followed)
        places = [place_of(pick, self._points) for pick in picks]
        wires = tuple(wire for wire in session.wires if wire.id not in moved)
        self._drawn = _Drawn(
            key,
            picks,
            Projected(self._in_object(np.array(places).reshape(-1, 3))),
            wires,
            _Segments([self._in_object(wire.points) for wire in wires]),
        )
        return self._drawn

    def _sees(self, view: View, placement: _Placement, place: NDArray[np.float64]) -> bool:
        world = placement.to_world(place)
        pixel = view.to_pixels(world[None])[0]
        if np.isnan(pixel).any():
            return False
        at = (float(pixel[0]), float(pixel[1]))
        hit = self._cast(view, placement, at)
        if hit is None:
            return True
        near = view.ray(at)[0]
        before = np.linalg.norm(world - near) - np.linalg.norm(placement.to_world(hit[1]) - near)
        return bool(before <= 6.0 * view.pixel_size(world))

    # Features

    def _crest_at(
        self,
        view: View,
        placement: _Placement,
        cursor: tuple[float, float],
        crests: Crests,
        anywhere: bool,
        xray: bool,
        scale: float,
    ) -> Pick | None:
        """Return the nearest point of a ridge or valley within reach of the cursor, else a vertex beside one that is as near."""
        if self._crests[0] is not crests:
            ends = self._in_object(crests.segments.reshape(-1, 3)).reshape(-1, 2, 3)
            self._crests = crests, _Segments(list(ends))
        for piece, seen in self._crests[1].near(view, placement.matrix, cursor, FEATURE_REACH * scale):
            if not (xray or self._sees(view, placement, seen)):
                continue
            place, triangle, vertex = crests.place_at(piece, self._to_points @ seen)
            if anywhere:
                return FacePoint.at(place, triangle, self._triangles, self._points)
            pixel = self._pixels(view, placement, [vertex])[0]
            if np.linalg.norm(pixel - np.asarray(cursor)) <= FEATURE_REACH * scale:
                return vertex
        return None

    def _feature_at(
        self,
        view: View,
        placement: _Placement,
        cursor: tuple[float, float],
        pick: Pick,
        strength: NDArray[np.float64],
        xray: bool,
        scale: float,
    ) -> int | None:
        """Return the vertex of the strongest feature within reach, going from what is under the cursor over the mesh."""
        if self._strength[0] is not strength:
            self._strength = (strength, float(np.quantile(strength, FEATURE_QUANTILE)) if len(strength) else 0.0)
        near = self._vertices_near(view, placement, cursor, pick, scale)
        for vertex in sorted(near, key=lambda v: -strength[v])[:_MOST_TRIED]:
            if strength[vertex] <= self._strength[1]:
                return None
            if xray or self._sees(view, placement, self._to_object @ self._points[vertex]):
                return vertex
        return None

    def _vertices_near(
        self, view: View, placement: _Placement, cursor: tuple[float, float], pick: Pick, scale: float
    ) -> dict[int, float]:
        """Return the vertices as near to the cursor as features may be, and how near, going from what is under it over the mesh."""
        frontier = sorted(set(pick.corners if isinstance(pick, FacePoint) else vertices_of(pick)))
        seen = set(frontier)
        near: dict[int, float] = {}
        while frontier and len(seen) < _MAX_NEAR:
            gaps = np.linalg.norm(self._pixels(view, placement, frontier) - np.asarray(cursor), axis=1)
            inside = {v: gap for v, gap in zip(frontier, gaps.tolist(), strict=True) if gap <= FEATURE_REACH * scale}
            near |= inside
            reached = self._all_edges[self._edges_at.rows(list(inside))]
            frontier = sorted(set(reached.reshape(-1).tolist()) - seen)
            seen.update(frontier)
        return near

    # The mesh

    def _pick_through(
        self, view: View, placement: _Placement, cursor: tuple[float, float], vertices_only: bool, scale: float
    ) -> Pick | None:
        """Return the vertex or edge that is nearest on the screen, however much lies before it."""
        numbers, projected = self._vertices
        x, y, depth = projected.seen(view, placement.matrix)
        for radius in (REACH * scale, 5.0 * REACH * scale):
            rows = projected.near(view, placement.matrix, cursor, radius)
            if len(rows):
                break
        if vertices_only:
            if not len(rows):
                return None
            gaps = np.hypot(x[rows] - cursor[0], y[rows] - cursor[1])
            same = rows[gaps <= gaps.min() + 1.0]  # of those at the same place, the one in front
            return int(numbers[same[np.argmin(depth[same])]])
        if len(self._all_edges) <= _FEW_EDGES:
            pairs = self._all_edges
        else:
            gaps = np.hypot(x[rows] - cursor[0], y[rows] - cursor[1])
            nearest = numbers[rows[np.argsort(gaps)[:_MAX_NEAR]]]
            pairs = self._all_edges[self._edges_at.rows(nearest)]
        at = np.searchsorted(numbers, pairs)
        screen = np.stack([x, y], axis=1)
        starts, ends = screen[at[:, 0]], screen[at[:, 1]]
        index, end = nearest_edge(cursor, starts, ends, scale)
        if index < 0 or nearest_on_segments(cursor, starts[[index]], ends[[index]])[1][0] > 5.0 * REACH * scale:
            return None
        pair = (int(pairs[index, 0]), int(pairs[index, 1]))
        return pair if end is None else pair[end]

    def pick(
        self,
        view: View,
        matrix: Matrix,
        cursor: tuple[float, float],
        vertices_only: bool,
        scale: float = 1.0,
        edges_only: bool = False,
    ) -> Pick | None:
        """Return the edge or the vertex under the cursor.

        Parameters
        ----------
        view
            The view it is seen in.
        matrix
            The object's matrix; may rotate, scale and shear.
        cursor
            Pixels from the region's bottom left.
        vertices_only, edges_only
            Find vertices alone, or edges.
        scale
            Of the display.

        Returns
        -------
        int, tuple of int or None
            A vertex, an edge by its vertices, or nothing.
        """
        placement = _Placement(matrix)
        if placement.is_flat:
            return None
        return self._pick(view, placement, cursor, vertices_only, scale, edges_only)

    def _pick(
        self,
        view: View,
        placement: _Placement,
        cursor: tuple[float, float],
        vertices_only: bool,
        scale: float,
        edges_only: bool,
    ) -> Pick | None:
        rows = self._edges_near(view, placement, cursor, scale, loose_too=not vertices_only)
        if not rows:
            return None
        pairs = self._all_edges[rows]
        if vertices_only:
            numbers = np.unique(pairs)
            gaps = np.linalg.norm(self._pixels(view, placement, numbers) - np.asarray(cursor), axis=1)
            return None if np.isnan(gaps).all() else int(numbers[np.nanargmin(gaps)])
        starts, ends = self._pixels(view, placement, pairs.T.reshape(-1)).reshape(2, -1, 2)
        index, end = nearest_edge(cursor, starts, ends, scale)
        if index < 0:
            return None
        pair = (int(pairs[index, 0]), int(pairs[index, 1]))
        return pair if end is None or edges_only else pair[end]

    def _with_crossing(
        self, view: View, placement: _Placement, cursor: tuple[float, float], edge: Edge, scale: float
    ) -> Snap:
        """Return the snap of an edge with the edge that crosses it at its end nearer to the cursor."""
        seen = self._pixels(view, placement, [*edge])
        end = edge[int(np.argmin(np.linalg.norm(seen - np.asarray(cursor), axis=1)))]
        start = edge[0] if end == edge[1] else edge[1]
        pairs = self._all_edges[self._edges_at.rows([end])]
        ends = pairs.sum(axis=1) - end
        ends = ends[ends != start]
        ways = self._in_object(self._points[[start, *ends]]) - self._in_object(self._points[end])
        lengths = np.linalg.norm(ways, axis=1)
        if not len(ends) or lengths.min() <= 0.0:
            return Snap(edge)
        cosines = np.abs(ways[1:] @ ways[0]) / (lengths[1:] * lengths[0])
        if cosines.min() > _STRAIGHT_COSINE:
            return Snap(edge)
        best = ends[cosines <= cosines.min() + _SAME_COSINE]
        places = self._pixels(view, placement, best)
        here = self._pixels(view, placement, [end])
        _, gaps = nearest_on_segments(cursor, np.broadcast_to(here, places.shape), places)
        at = int(np.argmin(np.where(np.isnan(gaps), np.inf, gaps)))
        sizes = np.linalg.norm([seen[1] - seen[0], places[at] - here[0]], axis=1)
        return Snap(edge, crossing=(end, int(best[at])), is_close_call=bool(sizes.min() < SHORT_EDGE * scale))

    def _point_at(
        self, view: View, placement: _Placement, cursor: tuple[float, float], scale: float
    ) -> int | FacePoint | None:
        """Return the point of the surface under the cursor, or the vertex that is meant."""
        hit = self._cast(view, placement, cursor)
        if hit is None:
            return None
        corners = self._triangles[hit[0]].tolist()
        pixels = self._pixels(view, placement, corners)
        gaps = np.linalg.norm(pixels - np.asarray(cursor), axis=1)
        if not np.isnan(gaps).any():
            nearest = int(np.argmin(gaps))
            shorter = np.linalg.norm(np.delete(pixels, nearest, axis=0) - pixels[nearest], axis=1).min()
            if gaps[nearest] <= min(VERTEX_RADIUS * scale, VERTEX_SHARE * float(shorter)):
                return corners[nearest]
        return FacePoint.at(self._to_points @ hit[1], hit[0], self._triangles, self._points)

    @cached_property
    def _loose(self) -> _Segments:
        """The edges without a visible face."""
        return _Segments(list(self._in_object(self._points[self._all_edges[self._loose_rows]])))

    @cached_property
    def _loose_rows(self) -> NDArray[np.int64]:
        return np.flatnonzero(~self._triangles_at.contain(self._all_edges))

    def _edges_near(
        self, view: View, placement: _Placement, cursor: tuple[float, float], scale: float, loose_too: bool
    ) -> list[int]:
        """Return the edges that may be meant, by their rows: those of polygons near the cursor, and those without one."""
        hits = set(self._polygons_at(view, placement, cursor, REACH * scale))
        found = {row for polygon in hits for row in self._surroundings(polygon, view, placement)}
        if loose_too:
            loose = self._loose.near(view, placement.matrix, cursor, REACH * scale)
            found.update(int(self._loose_rows[row]) for row, place in loose if self._sees(view, placement, place))
        return sorted(found)

    def _polygons_at(
        self, view: View, placement: _Placement, cursor: tuple[float, float], reach: float
    ) -> Iterator[int]:
        """Yield the polygon under the cursor, or the polygons just beside a cursor that is over no polygon."""
        hit = self._cast(view, placement, cursor)
        if hit is not None:
            yield int(self._polygons[hit[0]])
            return
        for radius in (0.5 * reach, reach):
            found = False
            for turn in np.arange(8) * (np.pi / 4.0):
                beside = (cursor[0] + radius * float(np.cos(turn)), cursor[1] + radius * float(np.sin(turn)))
                hit = self._cast(view, placement, beside)
                if hit is not None:
                    found = True
                    yield int(self._polygons[hit[0]])
            if found:
                return

    def _ray(
        self, view: View, placement: _Placement, cursor: tuple[float, float]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return both ends of the line that a pixel shows, as `Arrays.points` are given."""
        near, far = placement.from_world(np.array(view.ray(cursor))) @ self._to_points.T
        return near, far

    def _cast(
        self, view: View, placement: _Placement, cursor: tuple[float, float]
    ) -> tuple[int, NDArray[np.float64]] | None:
        """Return the first visible triangle along the line that a pixel shows, and where, in object coordinates."""
        origin, end = self._ray(view, placement, cursor)
        hit = self._rays.first_hit(origin, end - origin)
        if hit is None or hit[1] > 1.0:  # behind the far plane
            return None
        return hit[0], self._to_object @ (origin + hit[1] * (end - origin))

    def _triangles_of(self, polygons: Collection[int]) -> list[int]:
        """Return the rows of the triangles that polygons are cut into."""
        # Of the same type, or NumPy would convert the whole array each time.
        wanted = np.fromiter(polygons, self._polygons.dtype, len(polygons))
        begins, ends = (np.searchsorted(self._polygons, wanted, side).tolist() for side in ("left", "right"))
        return [row for begin, end in zip(begins, ends, strict=True) for row in range(begin, end)]

    def _surroundings(self, polygon: int, view: View, placement: _Placement) -> list[int]:
        """Return the edges of a polygon and of those around it that turn the same side to the viewer, by their rows."""
        corners = set(self._triangles[self._triangles_of([polygon])].reshape(-1).tolist())
        rows = self._triangles_of(set(self._polygons[self._triangles_at.rows(corners)].tolist()))
        triangles, owners = self._triangles[rows], self._polygons[rows].tolist()
        # The volume between the eye and a triangle is below 0 for those that turn one side to it, and above 0 for the others.
        to_clip = (view.perspective @ placement.matrix)[[0, 1, 3]]
        places = self._in_object(self._points[triangles]) @ to_clip[:, :3].T + to_clip[:, 3]
        facing = dict.fromkeys(owners, 0.0)
        for owner, volume in zip(owners, np.linalg.det(places).tolist(), strict=True):
            facing[owner] += volume
        alike = {owner for owner, volume in facing.items() if volume * facing[polygon] > 0.0 or owner == polygon}
        return self._sides(
            (owner, *corners) for owner, corners in zip(owners, triangles.tolist(), strict=True) if owner in alike
        )

    def _sides(self, triangles: Iterable[tuple[int, int, int, int]]) -> list[int]:
        """Return the edges of polygons, by their rows. Their triangles are given, each as its polygon and its corners.

        A side that two triangles of a polygon share is a diagonal and not one of its edges.
        """
        sides: set[tuple[int, int, int]] = set()
        for owner, a, b, c in triangles:
            for one, two in ((a, b), (b, c), (c, a)):
                side = (owner, one, two) if one < two else (owner, two, one)
                if side in sides:
                    sides.remove(side)
                else:
                    sides.add(side)
        own = {(one, two) for _, one, two in sides}
        rows = self._edges_at.rows({vertex for side in own for vertex in side})
        pairs = zip(rows.tolist(), self._all_edges[rows].tolist(), strict=True)
        return [row for row, (one, two) in pairs if (one, two) in own or (two, one) in own]


def stroke_at(
    strokes: Sequence[Stroke],
    view: View,
    matrix: Matrix,
    to_object: NDArray[np.float64],
    cursor: tuple[float, float],
    scale: float,
    sees: Callable[[NDArray[np.float64]], bool],
) -> Stroke | None:
    """Return the stroke nearest to the cursor, of equal ones the newest.

    Parameters
    ----------
    strokes
        Oldest first.
    view, matrix
        The view, and the object's matrix.
    to_object
        (3, 3) takes the strokes' points to object coordinates.
    cursor
        Pixels.
    scale
        Of the display.
    sees
        Whether a place, in object coordinates, is to be looked at.
    """
    world = np.array(matrix, dtype=np.float64)
    best: tuple[float, Stroke | None] = (STROKE_REACH * scale, None)
    for stroke in strokes:
        places = np.asarray(stroke.points) @ to_object.T
        pixels = view.to_pixels(places @ world[:3, :3].T + world[:3, 3])
        part, gaps = nearest_on_segments(cursor, pixels[:-1], pixels[1:])
        gaps = np.where(np.isnan(gaps), np.inf, gaps)
        for row in np.argsort(gaps, kind="stable").tolist():
            if gaps[row] > best[0]:
                break
            if sees(places[row] + part[row] * (places[row + 1] - places[row])):
                best = (float(gaps[row]), stroke)
                break
    return best[1]
