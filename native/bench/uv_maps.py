# SPDX-License-Identifier: GPL-3.0-or-later
"""Models and their UV maps: the files that the benchmark of automatic seams reads and writes.

A model is a file NAME.npz of polygons with an artist's seams, where there are any:

- ``P`` (n, 3): points.
- ``lv`` (c,): the vertex of each polygon corner.
- ``start`` (p + 1,): the corners of polygon i are ``start[i]`` to ``start[i + 1]``.
- ``seams`` (k, 2): the artist's seams as vertex pairs (optional).
- ``uv`` (c, 2): the artist's UV map (optional). Without ``seams``, it also gives the seams.

Files of native/bench/parts.py may say ``points``, ``corners`` and ``offsets`` instead of ``P``, ``lv`` and ``start``.

A map is a file NAME.METHOD.npz:

- ``P`` (n, 3), ``lv`` (c,) and ``uv`` (c, 2): points, and the vertex and the UV of each corner.
- ``lt`` (m, 3): triangles as corner numbers.
- ``info``: a JSON object with the seconds (``sec``), processor seconds (``cpu``) and megabytes (``mem``) that the method took.
  ``is_packed`` is false if the method places islands anywhere.

``frames.json`` in the folder of the models has ``{"NAME": {"front": [x, y, z], "up": [x, y, z], "hard": true}}``: the direction in which a
model faces, its up direction, and whether it is a hard-surface model. Models that it does not name face +z, with y up.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Integers = NDArray[np.int64]
    Bools = NDArray[np.bool_]

_SAME_UV = 1e-5
"""UVs nearer than this fraction of the map's extent are the same: files keep them in single precision."""


def fan(start: Integers) -> Integers:
    """Return the triangles (m, 3) that cut polygons into fans, as corner numbers; start is (p + 1,)."""
    inner = np.diff(start) - 2
    first = np.repeat(start[:-1], inner)
    step = np.arange(len(first)) - np.repeat(np.cumsum(inner) - inner, inner)
    return np.stack([first, first + step + 1, first + step + 2], axis=1)


def polygon_sides(start: Integers, corners: Integers) -> Integers:
    """Return the sides (e, 2) of polygons as vertex pairs, each once, the lower vertex first."""
    following = np.arange(1, len(corners) + 1)
    following[start[1:] - 1] = start[:-1]
    return np.unique(np.sort(np.stack([corners, corners[following]], axis=1), axis=1), axis=0)


def triangle_areas(points: Floats, triangles: Integers) -> Floats:
    """Return the areas (m,) of triangles."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


@dataclass(frozen=True)
class Frame:
    """The direction in which a model faces, its up direction, and whether it is a hard-surface model."""

    front: Floats = field(default_factory=lambda: np.array([0.0, 0.0, 1.0]))
    up: Floats = field(default_factory=lambda: np.array([0.0, 1.0, 0.0]))
    is_hard: bool = False

    @property
    def axes(self) -> Floats:
        """The rows right, up and front of an orthonormal frame, (3, 3)."""
        front = self.front / np.linalg.norm(self.front)
        right = np.cross(self.up, front)
        right /= np.linalg.norm(right)
        return np.stack([right, np.cross(front, right), front])


def read_frames(folder: Path) -> dict[str, Frame]:
    """Read frames.json of a folder of models; empty if the file does not exist."""
    file = folder / "frames.json"
    if not file.is_file():
        return {}
    frames = {}
    for name, axes in json.loads(file.read_text()).items():
        given = {key: np.array(axes[key], dtype=np.float64) for key in ("front", "up") if axes.get(key)}
        frames[name] = Frame(**given, is_hard=bool(axes.get("hard")))
    return frames


@dataclass(frozen=True)
class UvMap:
    """A UV map: points (n, 3), triangles (m, 3), a UV for each corner of a triangle (m, 3, 2), and what the method took."""

    points: Floats
    triangles: Integers
    uvs: Floats
    info: dict[str, Any] = field(default_factory=dict)

    @classmethod
    def read(cls, file: Path) -> UvMap:
        """Read a NAME.METHOD.npz."""
        with np.load(file) as arrays:
            corners = arrays["lt"]
            info = json.loads(str(arrays["info"])) if "info" in arrays else {}
            uvs = arrays["uv"][corners].astype(np.float64)
            return cls(arrays["P"], arrays["lv"][corners].astype(np.int64), uvs, info)

    def write(self, file: Path) -> None:
        """Write a NAME.METHOD.npz."""
        corners = self.triangles.reshape(-1)
        np.savez_compressed(
            file,
            P=self.points,
            lv=corners,
            start=np.arange(0, len(corners) + 1, 3),
            uv=self.uvs.reshape(-1, 2),
            lt=np.arange(len(corners)).reshape(-1, 3),
            info=json.dumps(self.info),
        )

    @cached_property
    def inner_edges(self) -> InnerEdges:
        """The edges between two triangles, and which of them the map is torn along."""
        return InnerEdges.of(self)

    @cached_property
    def islands(self) -> Integers:
        """The island of each triangle, (m,): triangles are joined by edges along which the map is not torn."""
        from scipy.sparse import coo_matrix  # Blender's Python, which reads and writes maps, need not have SciPy
        from scipy.sparse.csgraph import connected_components

        faces = self.inner_edges.faces[~self.inner_edges.torn]
        count = len(self.triangles)
        joined = coo_matrix((np.ones(len(faces)), (faces[:, 0], faces[:, 1])), shape=(count, count))
        return connected_components(joined, directed=False)[1].astype(np.int64)

    @property
    def seams(self) -> Integers:
        """The seams as vertex pairs, (k, 2)."""
        return self.inner_edges.vertices[self.inner_edges.torn]

    @cached_property
    def boundary_vertices(self) -> Bools:
        """Whether each vertex lies on an edge that has not exactly two triangles, (n,)."""
        sides = np.sort(self.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        edges, count = np.unique(sides, axis=0, return_counts=True)
        found = np.zeros(len(self.points), dtype=bool)
        found[edges[count != 2].reshape(-1)] = True
        return found


@dataclass(frozen=True)
class InnerEdges:
    """Edges with two triangles: their vertices (e, 2), triangles (e, 2), and whether the UVs of the two sides differ (e,)."""

    vertices: Integers
    faces: Integers
    torn: Bools

    @classmethod
    def of(cls, uv_map: UvMap) -> InnerEdges:
        """Find the edges of a map's triangles that have two of them."""
        triangles, uvs = uv_map.triangles, uv_map.uvs
        sides = triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
        ends = uvs[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2, 2)
        turned = sides[:, 0] > sides[:, 1]
        sides[turned] = sides[turned, ::-1]
        ends[turned] = ends[turned, ::-1]
        order = np.lexsort((sides[:, 1], sides[:, 0]))
        begins = np.flatnonzero(np.r_[True, (np.diff(sides[order], axis=0) != 0).any(axis=1)])
        pairs = begins[np.diff(np.r_[begins, len(order)]) == 2]
        one, other = order[pairs], order[pairs + 1]
        tolerance = _SAME_UV * np.ptp(uvs.reshape(-1, 2), axis=0).max()
        torn = np.abs(ends[one] - ends[other]).max(axis=(1, 2)) > tolerance
        return cls(sides[one], np.stack([one, other], axis=1) // 3, torn)


@dataclass(frozen=True)
class Model:
    """A model of the benchmark: polygons, the direction in which it faces, and an artist's seams or map where there are any."""

    name: str
    points: Floats
    start: Integers
    corners: Integers
    frame: Frame
    seams: Integers | None = None
    corner_uvs: Floats | None = None

    @classmethod
    def read(cls, file: Path, frame: Frame | None = None) -> Model:
        """Read a NAME.npz."""
        with np.load(file) as arrays:
            names = ("P", "start", "lv") if "P" in arrays else ("points", "offsets", "corners")
            points, start, corners = (arrays[name] for name in names)
            return cls(
                file.stem,
                points.astype(np.float64),
                start.astype(np.int64),
                corners.astype(np.int64),
                frame or Frame(),
                arrays["seams"].astype(np.int64) if "seams" in arrays else None,
                arrays["uv"].astype(np.float64) if "uv" in arrays else None,
            )

    @cached_property
    def triangles(self) -> Integers:
        """Fans of the polygons, (m, 3)."""
        return self.corners[fan(self.start)]

    @cached_property
    def edges(self) -> Integers:
        """The sides of the polygons, (e, 2)."""
        return polygon_sides(self.start, self.corners)

    @cached_property
    def published_map(self) -> UvMap | None:
        """The artist's map, if the file has it."""
        if self.corner_uvs is None:
            return None
        return UvMap(self.points, self.triangles, self.corner_uvs[fan(self.start)])

    @cached_property
    def artist_seams(self) -> Integers | None:
        """The artist's seams (k, 2), if the file has them or a map."""
        if self.seams is None and self.published_map is not None:
            return self.published_map.seams
        return self.seams

    @cached_property
    def area(self) -> float:
        """The area of the surface."""
        return float(triangle_areas(self.points, self.triangles).sum())

    @cached_property
    def diagonal(self) -> float:
        """The diagonal of the bounding box."""
        return float(np.linalg.norm(np.ptp(self.points, axis=0)))
