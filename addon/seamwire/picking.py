# SPDX-License-Identifier: GPL-3.0-or-later
"""What is under the cursor: the edge or the vertex nearest to it on the visible part of an edit mesh."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree

if TYPE_CHECKING:
    import bmesh
    import bpy
    from mathutils import Matrix
    from numpy.typing import NDArray

    from .network import Pick

VERTEX_RADIUS = 12.0
"""Pixels around a vertex in which it is picked rather than its edge..."""
VERTEX_SHARE = 0.25
"""...but never over more than this part of the edge, so that every edge can be picked."""
REACH = 14.0
"""Pixels beside the mesh in which it is still found: rims and silhouettes are hard to hit."""
_MAX_HIDDEN_LAYERS = 256


@dataclass(frozen=True)
class View:
    """How a region sees the world.

    Parameters
    ----------
    width, height
        Size in pixels.
    perspective
        (4, 4), takes world coordinates to clip space.
    """

    width: float
    height: float
    perspective: NDArray[np.float64]

    @classmethod
    def of(cls, region: bpy.types.Region, region_3d: bpy.types.RegionView3D) -> View:
        """Return the view of a 3D region."""
        return cls(region.width, region.height, np.array(region_3d.perspective_matrix, dtype=np.float64))

    def to_pixels(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Project (n, 3) world points to (n, 2) pixels from the bottom left; NaN behind the viewer."""
        clip = points @ self.perspective[:, :3].T + self.perspective[:, 3]
        w = np.where(clip[:, 3] > 1e-9, clip[:, 3], np.nan)[:, None]
        return (clip[:, :2] / w * 0.5 + 0.5) * (self.width, self.height)

    def ray(self, cursor: tuple[float, float]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return two world points on the line that a pixel shows, on the near and on the far plane."""
        x, y = 2.0 * cursor[0] / self.width - 1.0, 2.0 * cursor[1] / self.height - 1.0
        ends = np.array([[x, y, -1.0, 1.0], [x, y, 1.0, 1.0]]) @ np.linalg.inv(self.perspective).T
        ends = ends[:, :3] / ends[:, 3:]
        return ends[0], ends[1]


def nearest_edge(
    cursor: tuple[float, float], starts: NDArray[np.float64], ends: NDArray[np.float64]
) -> tuple[int, int | None]:
    """Find the segment nearest to a point, and whether one of its ends is meant.

    Parameters
    ----------
    cursor
        Pixels.
    starts, ends
        (k, 2) pixels; NaN where an end is not in front of the viewer.

    Returns
    -------
    index
        Which segment; -1: none.
    end
        0 or 1 where the cursor is so near to that end that it is meant, else None.
    """
    point = np.asarray(cursor)
    along = ends - starts
    square = np.einsum("ij,ij->i", along, along)
    part = np.einsum("ij,ij->i", point - starts, along) / np.where(square > 0.0, square, 1.0)
    gaps = np.linalg.norm(starts + np.clip(part, 0.0, 1.0)[:, None] * along - point, axis=1)
    if not len(gaps) or np.isnan(gaps).all():
        return -1, None
    index = int(np.nanargmin(gaps))
    to_ends = np.linalg.norm(np.stack([starts[index], ends[index]]) - point, axis=1)
    end = int(np.argmin(to_ends))
    radius = min(VERTEX_RADIUS, VERTEX_SHARE * float(np.sqrt(square[index])))
    return index, end if to_ends[end] <= radius else None


class Picker:
    """Finds what is under the cursor on one edit mesh.

    Parameters
    ----------
    bm
        The edit mesh. Its topology and its coordinates must stay as they are while the picker is used.
    size
        How large it is, in object coordinates, in any direction: a measure for steps that are small beside it.
    """

    def __init__(self, bm: bmesh.types.BMesh, size: float) -> None:
        self._bm = bm
        self._tree = BVHTree.FromBMesh(bm)
        bm.verts.ensure_lookup_table()
        bm.faces.ensure_lookup_table()
        self._step = max(1e-6 * size, 1e-12)

    def pick(
        self, view: View, matrix: Matrix, cursor: tuple[float, float], vertices_only: bool, reach: float = REACH
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
        vertices_only
            Find vertices alone.
        reach
            How far beside the mesh the cursor may be, in pixels.

        Returns
        -------
        int, tuple of int or None
            A vertex, an edge by its vertices, or nothing.
        """
        if abs(matrix.determinant()) < 1e-30:
            return None
        faces = list(self._faces_at(view, matrix, cursor, reach))
        edges = {edge for face in faces for edge in self._surroundings(face, view, matrix) if not edge.hide}
        if not edges:
            return None
        pairs = [(edge.verts[0].index, edge.verts[1].index) for edge in sorted(edges, key=lambda edge: edge.index)]
        numbers = sorted({vertex for pair in pairs for vertex in pair})
        world = np.array([matrix @ self._bm.verts[vertex].co for vertex in numbers], dtype=np.float64)
        pixels = view.to_pixels(world)
        if vertices_only:
            gaps = np.linalg.norm(pixels - np.asarray(cursor), axis=1)
            return None if np.isnan(gaps).all() else numbers[int(np.nanargmin(gaps))]
        row = {vertex: i for i, vertex in enumerate(numbers)}
        ends = np.array([[row[a], row[b]] for a, b in pairs])
        index, end = nearest_edge(cursor, pixels[ends[:, 0]], pixels[ends[:, 1]])
        if index < 0:
            return None
        return pairs[index] if end is None else pairs[index][end]

    def _faces_at(
        self, view: View, matrix: Matrix, cursor: tuple[float, float], reach: float
    ) -> Iterator[bmesh.types.BMFace]:
        """Yield the face under the cursor; where there is none, those just beside it."""
        face = self._cast(view, matrix, cursor)
        if face is not None:
            yield face
            return
        for radius in (0.5 * reach, reach):
            found = False
            for turn in np.arange(8) * (np.pi / 4.0):
                beside = (cursor[0] + radius * float(np.cos(turn)), cursor[1] + radius * float(np.sin(turn)))
                face = self._cast(view, matrix, beside)
                if face is not None:
                    found = True
                    yield face
            if found:
                return

    def depth(self, view: View, matrix: Matrix, cursor: tuple[float, float]) -> float | None:
        """Return how far behind the near plane the mesh is under the cursor; None where it is not."""
        hit = self._hit(view, matrix, cursor) if abs(matrix.determinant()) >= 1e-30 else None
        return None if hit is None else (matrix @ hit[1] - Vector(view.ray(cursor)[0])).length

    def _cast(self, view: View, matrix: Matrix, cursor: tuple[float, float]) -> bmesh.types.BMFace | None:
        """Return the first face that is not hidden along the line that a pixel shows."""
        hit = self._hit(view, matrix, cursor)
        return None if hit is None else hit[0]

    def _hit(self, view: View, matrix: Matrix, cursor: tuple[float, float]) -> tuple[bmesh.types.BMFace, Vector] | None:
        near, far = view.ray(cursor)
        inverse = matrix.inverted()
        origin, end = inverse @ Vector(near), inverse @ Vector(far)
        direction = (end - origin).normalized()
        for _ in range(_MAX_HIDDEN_LAYERS):
            location, _, index, _ = self._tree.ray_cast(origin, direction)
            if location is None:
                return None
            face = self._bm.faces[index]
            if not face.hide:
                return face, location
            origin = location + self._step * direction
        return None

    @staticmethod
    def _surroundings(face: bmesh.types.BMFace, view: View, matrix: Matrix) -> Iterator[bmesh.types.BMEdge]:
        """Yield the edges of a face and of those around it that turn the same side to the viewer."""
        # (0, 0, -1, 0) in clip space is the eye, or the direction to it where there is no perspective.
        *eye, weight = np.linalg.inv(view.perspective) @ (0.0, 0.0, -1.0, 0.0)
        to_eye = Vector(eye)
        normals = matrix.to_3x3().inverted().transposed()

        def side(of: bmesh.types.BMFace) -> float:
            towards = to_eye / weight - matrix @ of.calc_center_median() if abs(weight) > 1e-9 else to_eye
            return towards.dot(normals @ of.normal)

        yield from face.edges
        facing = side(face)
        around = {other for vertex in face.verts for other in vertex.link_faces if not other.hide}
        for other in around - {face}:
            if side(other) * facing > 0.0:
                yield from other.edges
