# SPDX-License-Identifier: GPL-3.0-or-later
"""How much a UV map stretches the faces of a mesh, by angle and by area. Knows neither Blender nor the GPU.

Let s1 >= s2 be the singular values of the map from a triangle to its UVs. The map preserves angles if s1 = s2, and areas if s1 s2 is
constant (Sander, Snyder, Gortler, Hoppe: Texture mapping progressive meshes, 2001; Hormann, Greiner: MIPS, 2000). Both are counted in
octaves: 1 means twice as long one way as the other, or an area twice too large.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

LIMIT = 5.0
"""Octaves that count at most: a face without any UV area, stretched beyond all numbers, does not outweigh all others."""


class Stretch:
    """The stretch of a mesh's faces, which follows their UVs.

    Parameters
    ----------
    points
        (n, 3) vertices.
    triangles
        (m, 3) what the faces are cut into.
    polygons
        (m,) the face that each triangle is part of, ascending.
    corners
        (m, 3) the rows of the UV map that belong to the triangles' corners.

    Attributes
    ----------
    angle
        (m,) log2(s1 / s2) of the face of each triangle, zero and more.
    area
        (m,) log2 of the UV area of the face of each triangle over that of its area on the model, where the mean of all is zero:
        positive where the map enlarges. Both are within `LIMIT`, and zero for faces without area on the model.
    measured
        How many triangles the last update looked at.
    """

    def __init__(
        self,
        points: NDArray[np.float64],
        triangles: NDArray[np.int32],
        polygons: NDArray[np.int32],
        corners: NDArray[np.int64],
    ) -> None:
        count = len(triangles)
        x, y, z = (np.ascontiguousarray(column)[triangles.T] for column in np.asarray(points, dtype=np.float64).T)
        one = [column[1] - column[0] for column in (x, y, z)]
        two = [column[2] - column[0] for column in (x, y, z)]
        # The first fundamental form of each triangle, over its two sides at the first corner.
        e, f, g = (sum(p * q for p, q in zip(a, b, strict=True)) for a, b in ((one, one), (one, two), (two, two)))
        twice = np.sqrt(np.maximum(e * g - f * f, 0.0))
        # Below this, rounding decides.
        self._solid = twice > 1e-12 * np.maximum(e, g)
        self._areas = np.where(self._solid, 0.5 * twice, 0.0)
        scale = np.divide(0.5, twice, out=np.zeros(count), where=self._solid)
        self._form = np.stack([e * scale, f * scale, g * scale])
        self._starts = np.flatnonzero(np.diff(polygons, prepend=-1)) if count else np.empty(0, dtype=np.int64)
        self._sizes = np.diff(self._starts, append=count)
        self._plain = bool((self._sizes == 1).all())
        self._face_areas = self._per_face(self._areas)
        self._corners = np.ascontiguousarray(corners.T)
        self._uvs: NDArray[np.float32] | None = None
        self._energy = np.zeros(count)
        self._uv_areas = np.zeros(count)
        self.angle = np.zeros(count)
        self.area = np.zeros(count)
        self.measured = 0

    def _per_face(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the sums over the triangles of each face."""
        return values if self._plain or not len(values) else np.add.reduceat(values, self._starts)

    def update(self, uvs: NDArray[np.float32], labels: NDArray[np.int32] | None = None) -> bool:
        """Follow a UV map, (c, 2); return whether it is another than before.

        Only the islands of which some corner has moved are measured anew, where `labels`, (m,), tells the islands apart.
        """
        moved = np.ones(len(uvs), dtype=bool) if self._uvs is None else (uvs != self._uvs).any(axis=1)
        fresh = np.ones(len(self._areas), dtype=bool) if moved.all() else moved[self._corners].any(axis=0)
        self.measured = 0
        if not fresh.any():
            return False
        if labels is not None:
            touched = np.zeros(int(labels.max()) + 1, dtype=bool)
            touched[labels[fresh]] = True
            fresh = touched[labels]
        self.measured = int(np.count_nonzero(fresh))
        self._measure(uvs, slice(None) if self.measured == len(fresh) else np.flatnonzero(fresh))
        self._uvs = np.array(uvs, dtype=np.float32)
        self._sum_up()
        return True

    def _measure(self, uvs: NDArray[np.float32], rows: slice | NDArray[np.int64]) -> None:
        """Set the UV areas of triangles and the energies (s1 / s2 + s2 / s1) / 2, weighted by the areas on the model."""
        corners = self._corners[:, rows]
        x, y = (np.ascontiguousarray(column)[corners].astype(np.float64) for column in uvs.T)
        ux, vx, uy, vy = x[1] - x[0], x[2] - x[0], y[1] - y[0], y[2] - y[0]
        e, f, g = self._form[:, rows]
        doubled = np.abs(ux * vy - uy * vx)
        # trace / (2 det) of the map's squared lengths: (g E - 2 f F + e G) / (2 |sides| |UV sides|).
        energy = g * (ux * ux + uy * uy) - 2.0 * f * (ux * vx + uy * vy) + e * (vx * vx + vy * vy)
        with np.errstate(divide="ignore", invalid="ignore"):
            energy = np.minimum(energy / doubled, _MOST)
        energy[~np.isfinite(energy)] = _MOST
        self._uv_areas[rows] = 0.5 * doubled
        self._energy[rows] = energy * self._areas[rows]

    def _sum_up(self) -> None:
        """Set the stretch of faces, by that of their triangles."""
        areas, uv_areas = self._face_areas, self._per_face(np.where(self._solid, self._uv_areas, 0.0))
        solid = areas > 0.0
        energy = np.divide(self._per_face(self._energy), areas, out=np.ones(len(areas)), where=solid)
        angle = np.minimum(np.arccosh(np.maximum(energy, 1.0)) * _TO_OCTAVES, LIMIT)
        total = uv_areas.sum()
        mean = areas.sum() / total if total > 0.0 else 1.0
        with np.errstate(divide="ignore"):
            ratio = np.log2(np.divide(uv_areas * mean, areas, out=np.ones(len(areas)), where=solid))
        area = np.clip(ratio, -LIMIT, LIMIT)
        self.angle, self.area = (
            (angle, area) if self._plain else (np.repeat(angle, self._sizes), np.repeat(area, self._sizes))
        )

    def values(self, kind: str) -> NDArray[np.float64]:
        """Return the stretch of the face of each triangle, (m,), in octaves by ``ANGLE`` or ``AREA``, zero and more."""
        return self.angle if kind == "ANGLE" else np.abs(self.area)

    def islands(self, labels: NDArray[np.int32], kind: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the stretch and the area on the model of the islands that labels, (m,), tell apart, (count,) each.

        The stretch is the mean of the faces, weighted by their areas, and zero for islands without area.
        """
        count = int(labels.max(initial=-1)) + 1
        areas = np.bincount(labels, self._areas, count)
        sums = np.bincount(labels, self.values(kind) * self._areas, count)
        return np.divide(sums, areas, out=np.zeros(count), where=areas > 0.0), areas


_TO_OCTAVES = 1.0 / np.log(2.0)
_MOST = float(np.cosh(LIMIT / _TO_OCTAVES))
