# SPDX-License-Identifier: GPL-3.0-or-later
"""What a click would take on the visible part of an edit mesh: a seed, a wire, a seam, a feature, or the plain mesh."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import nearest_on_segments, triangle_normals
from ..network.network import Snap
from ..network.picks import FacePoint, place_of
from .camera import Projected, Segments, Sight
from .plain import PlainPicker
from .surface import VisibleSurface

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from numpy.typing import ArrayLike, NDArray

    from ..base.mesh_arrays import Arrays
    from ..fields.crests import Crests
    from ..network.picks import Pick
    from ..network.strokes import Stroke
    from ..network.wires import Wire
    from ..sketch.sketch import Sketch
    from .camera import Camera
    from .surface import Bend


FEATURE_REACH = 10.0
"""Pixels in which the strongest feature is looked for."""
FEATURE_QUANTILE = 0.75
"""A vertex counts as a feature from this share of all vertices' strengths on: on a plain nothing is stronger than noise."""
_SHARP_COSINE = float(np.cos(np.radians(30.0)))
"""An edge counts as a feature if its faces meet at 30 degrees or more, as Blender's Select Sharp Edges takes it."""
_CORNER = 3
"""So many such edges meet at a corner."""
_MOST_TRIED = 4
"""So many of the vertices near the cursor are tried for one that is not hidden."""


class FeaturePicker:
    """Finds features of a mesh near the cursor."""

    def __init__(self, surface: VisibleSurface) -> None:
        self._surface = surface
        self._strength: tuple[object, float] = (None, 0.0)
        self._crests: tuple[Crests | None, Segments] = (None, Segments([]))

    def near(self, sight: Sight, pick: Pick) -> dict[int, float]:
        """Return the vertices within reach with their distances in pixels, going over the mesh from what is under the cursor."""
        return self._surface.vertices_near(sight, pick, FEATURE_REACH * sight.scale)

    def preferred_at(self, sight: Sight, near: dict[int, float], preferred: Collection[int]) -> int | None:
        """Return the nearest of the preferred vertices among those within reach."""
        return self._nearest(sight, {vertex: gap for vertex, gap in near.items() if vertex in preferred})

    def corner_at(self, sight: Sight, near: dict[int, float]) -> int | None:
        """Return the nearest vertex within reach where three or more sharp edges meet."""
        count = dict.fromkeys(near, 0)
        for edge in self._sharp_edges(near):
            for vertex in edge:
                if vertex in count:
                    count[vertex] += 1
        return self._nearest(sight, {vertex: gap for vertex, gap in near.items() if count[vertex] >= _CORNER})

    def _sharp_edges(self, vertices: Collection[int]) -> list[tuple[int, int]]:
        """Return the edges at vertices where the mesh ends, where faces meet at a sharp angle, or where more than two meet."""
        surface = self._surface
        triangles = surface.triangles[surface.triangles_at.rows(vertices)]
        normals = triangle_normals(surface.points, triangles)
        sides: dict[tuple[int, int], list[NDArray[np.float64]]] = {}
        for (one, two, three), normal in zip(triangles.tolist(), normals, strict=True):
            for tail, tip in ((one, two), (two, three), (three, one)):
                # Faces that agree which side is out have the edge in opposite directions.
                sides.setdefault((min(tail, tip), max(tail, tip)), []).append(normal if tail < tip else -normal)
        found = []
        for one, two in surface.edges[surface.edges_at.rows(vertices)].tolist():
            beside = sides.get((min(one, two), max(one, two)), [])
            if len(beside) != 2 or -float(beside[0] @ beside[1]) <= _SHARP_COSINE:
                found.append((one, two))
        return found

    def _nearest(self, sight: Sight, gaps: dict[int, float]) -> int | None:
        """Return the nearest vertex that can be picked. `gaps` tells how far each one is from the cursor."""
        nearest = sorted(gaps, key=gaps.__getitem__)[:_MOST_TRIED]
        return next((vertex for vertex in nearest if self._can_pick(sight, vertex)), None)

    def strongest_at(self, sight: Sight, near: dict[int, float], strength: NDArray[np.float64]) -> int | None:
        """Return the vertex of the strongest feature within reach."""
        if self._strength[0] is not strength:
            self._strength = (strength, float(np.quantile(strength, FEATURE_QUANTILE)) if len(strength) else 0.0)
        for vertex in sorted(near, key=lambda v: -strength[v])[:_MOST_TRIED]:
            if strength[vertex] <= self._strength[1]:
                return None
            if self._can_pick(sight, vertex):
                return vertex
        return None

    def crest_at(self, sight: Sight, crests: Crests, anywhere: bool) -> Pick | None:
        """Return the nearest point of a ridge or valley within reach of the cursor.

        The point may lie within a triangle if it may lie `anywhere`. Otherwise it is a vertex beside it that is as near.
        """
        surface = self._surface
        if self._crests[0] is not crests:
            ends = surface.in_object(crests.segments.reshape(-1, 3)).reshape(-1, 2, 3)
            self._crests = crests, Segments(list(ends))
        for piece, seen in self._crests[1].near(sight, FEATURE_REACH * sight.scale):
            if not surface.can_pick(sight, seen):
                continue
            place, triangle, vertex = crests.place_at(piece, surface.to_points @ seen)
            if anywhere:
                return FacePoint.at(place, triangle, surface.triangles, surface.points)
            pixel = surface.pixels(sight, [vertex])[0]
            if np.linalg.norm(pixel - np.asarray(sight.cursor)) <= FEATURE_REACH * sight.scale:
                return vertex
        return None

    def _can_pick(self, sight: Sight, vertex: int) -> bool:
        return self._surface.can_pick(sight, self._surface.to_object @ self._surface.points[vertex])


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
        self._drawn_of: tuple[object, ...] = ()

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

    def at(self, sight: Sight, session: Sketch) -> Snap | None:
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

    def _drawn_now(self, session: Sketch) -> _Drawn:
        """Return what can be found of a session's network. A held seed and its wires cannot, because they follow the mouse."""
        of = session.drawn, session.options.along, session.seed_place, session.moved
        if self._drawn is not None and self._drawn_of == of:
            return self._drawn
        moved, followed = session.moved
        wires = tuple(wire for wire in session.wires if wire.id not in moved)
        picks = tuple(pick for pick in session.seeds() if pick not in followed)
        key = picks, wires
        if self._drawn is not None and self._drawn.key == key:
            self._drawn_of = of
            return self._drawn
        surface = self._surface
        places = [place_of(pick, surface.points) for pick in picks]
        self._drawn = _Drawn(
            key,
            picks,
            Projected(surface.in_object(np.array(places).reshape(-1, 3))),
            wires,
            Segments([surface.curve_in_object(wire.points) for wire in wires]),
        )
        self._drawn_of = of
        return self._drawn


class Picker:
    """Finds what is under the cursor on one edit mesh.

    In all methods, `matrix` is the object's (4, 4) matrix, which may rotate, scale and shear. `cursor` is in pixels from the region's
    bottom left. `seams`, (s, 2), are those that no wire runs along, and `bend` is as in `VisibleSurface`.
    """

    def __init__(self, arrays: Arrays, seams: ArrayLike = (), bend: Bend | None = None) -> None:
        self._surface = VisibleSurface(arrays, bend)
        self._plain = PlainPicker(self._surface)
        self._features = FeaturePicker(self._surface)
        self._drawn = DrawnPicker(self._surface, seams)

    def wait(self) -> None:
        """Wait until the threads have finished."""
        self._surface.wait()

    def set_seams(self, seams: ArrayLike) -> None:
        """Take other edges, (s, 2), as the seams that no wire runs along."""
        self._drawn.set_seams(seams)

    def snap(
        self,
        camera: Camera,
        matrix: ArrayLike,
        cursor: tuple[float, float],
        *,
        vertices_only: bool,
        edges_only: bool = False,
        anywhere: bool = False,
        session: Sketch | None = None,
        xray: bool = False,
        preferred: frozenset[int] = frozenset(),
        strength: NDArray[np.float64] | None = None,
        crests: Crests | None = None,
        scale: float = 1.0,
    ) -> Snap | None:
        """Return what a click would take: a seed before a wire, a wire before a seam, a seam before the plain mesh.

        Parameters
        ----------
        vertices_only, edges_only
            Find vertices of the mesh alone, or edges.
        anywhere
            Of vertices alone, find only those that are meant. Otherwise find the point of the surface under the cursor.
        session
            Whose seeds and wires can be found. Without it, neither these nor seams are found.
        xray
            Find what lies behind faces too; the nearest on the screen.
        preferred
            Vertices that are taken before anything else of the plain mesh if they are as near as features may be.
        strength
            (n,) how strong the feature is at each vertex. The nearest corner is taken, where three sharp edges meet, and otherwise the
            strongest feature nearby.
        crests
            Ridges and valleys. What lies on one nearby is taken before anything else of the plain mesh.
        """
        sight = Sight.of(camera, matrix, cursor, scale, xray)
        if sight is None:
            return None
        if session is not None:
            found = self._drawn.at(sight, session)
            if found is not None:
                return found
        if xray:
            pick = self._plain.through(sight, vertices_only)
        else:
            pick = self._plain.point_at(sight) if anywhere else None
            if pick is None:
                pick = self._plain.at(sight, vertices_only, edges_only)
        if pick is None:
            return None
        near = self._features.near(sight, pick) if preferred or strength is not None else {}
        vertex = self._features.preferred_at(sight, near, preferred) if preferred else None
        if vertex is not None:
            return Snap(vertex)
        corner = None if strength is None else self._features.corner_at(sight, near)
        if corner is not None:
            return Snap(corner, "FEATURE")
        crest = None if crests is None else self._features.crest_at(sight, crests, anywhere)
        if crest is not None:
            return Snap(crest, "FEATURE")
        if edges_only and isinstance(pick, tuple):
            return self._plain.with_crossing(sight, pick)
        feature = None if strength is None else self._features.strongest_at(sight, near, strength)
        return Snap(pick) if feature is None else Snap(feature, "FEATURE")

    def stroke_at(
        self,
        strokes: Sequence[Stroke],
        camera: Camera,
        matrix: ArrayLike,
        cursor: tuple[float, float],
        xray: bool = False,
        scale: float = 1.0,
    ) -> Stroke | None:
        """Return the stroke nearest to the cursor that the surface does not hide. Of equally near strokes, it is the last one."""
        sight = Sight.of(camera, matrix, cursor, scale, xray)
        if sight is None:
            return None
        best, nearest = None, STROKE_REACH * sight.scale
        for stroke in strokes:
            places = self._surface.curve_in_object(stroke.points)
            pixels = sight.pixels(places)
            part, gaps = nearest_on_segments(sight.cursor, pixels[:-1], pixels[1:])
            gaps = np.where(np.isnan(gaps), np.inf, gaps)
            for row in np.argsort(gaps, kind="stable").tolist():
                if gaps[row] > nearest:
                    break
                if self._surface.can_pick(sight, places[row] + part[row] * (places[row + 1] - places[row])):
                    best, nearest = stroke, float(gaps[row])
                    break
        return best

    def seen_along(self, camera: Camera, matrix: ArrayLike, pick: Pick) -> tuple[float, float, float] | None:
        """Return the direction from the viewer to a pick, in the coordinates of the mesh, or None if it lies behind the viewer."""
        surface = self._surface
        sight = Sight.of(camera, matrix, (0.0, 0.0))
        if sight is None:
            return None
        pixel = sight.pixels((surface.to_object @ place_of(pick, surface.points))[None])[0]
        if not np.isfinite(pixel).all():
            return None
        near, far = surface.ray(sight, (float(pixel[0]), float(pixel[1])))
        x, y, z = (far - near).tolist()
        return x, y, z

    def depth(self, camera: Camera, matrix: ArrayLike, cursor: tuple[float, float]) -> float | None:
        """Return how far the face under the cursor is from the near plane, in world units, or None beside the mesh."""
        sight = Sight.of(camera, matrix, cursor)
        hit = None if sight is None else self._surface.cast(sight, cursor)
        return None if hit is None else float(np.linalg.norm(sight.to_world(hit[1]) - camera.ray(cursor)[0]))

    def surface_at(
        self, camera: Camera, matrix: ArrayLike, cursor: tuple[float, float]
    ) -> tuple[NDArray[np.float64], int] | None:
        """Return the point of the surface under the cursor, in the coordinates of the mesh, and its triangle."""
        sight = Sight.of(camera, matrix, cursor)
        hit = None if sight is None else self._surface.cast(sight, cursor)
        return None if hit is None else (self._surface.to_points @ hit[1], hit[0])
