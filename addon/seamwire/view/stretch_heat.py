# SPDX-License-Identifier: GPL-3.0-or-later
"""The stretch of an object's UV map, as heat over its faces, with a legend and its worst island outlined."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import bpy
import numpy as np

from ..core.fields import color_maps
from ..core.islands.stretch import Stretch
from ..mesh import uv_map
from . import gpu_draw
from .layers import Layer, Legend
from .theme import Style

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..core.base.mesh_arrays import Arrays
    from ..core.islands.islands import IslandMaker
    from ..mesh.pose import Pose
    from .gpu_draw import Eye
    from .theme import Color

HOT = 1.0
"""Octaves that are red: twice as long one way, or an area twice too large or small."""
_STEPS = 32
_OPACITY = 0.8
_OUTLINE = Style((1.0, 1.0, 1.0, 1.0), 8.0, halo=2.0, lift=2.5)
"""Wider than the seams that lie on it."""
_NAMES = {"ANGLE": "Stretch of angles", "AREA": "Stretch of areas"}


def heat_colors(opacity: float = 1.0) -> list[Color]:
    return color_maps.steps(color_maps.STRETCH, _STEPS, opacity)


class _Summary(NamedTuple):
    """What there is to say of the islands: mean and worst octaves, their number, and whether each triangle, (m,), is part of the worst."""

    mean: float
    value: float
    count: int
    triangles: NDArray[np.bool_]


class StretchHeat(Layer):
    """The stretch of the UV map of an object, as colors, and which island is stretched most."""

    def __init__(self, arrays: Arrays, islands: IslandMaker, pose: Pose) -> None:
        self._arrays = arrays
        self._pose = pose
        self._islands = islands
        self._kind = "NONE"
        self._stretch: Stretch | None = None
        self._known = False
        self._missing = False
        self._revision = 0
        self._faces: gpu_draw.ColoredFaces | None = None
        self._drawn = -1
        self._outline: tuple[object, gpu_draw.Lines | None] = (None, None)
        self._summary: tuple[object, _Summary | None] = (None, None)

    @property
    def shown(self) -> bool:
        return self._kind != "NONE" and self._stretch is not None and not self._missing

    def read(self, obj: bpy.types.Object, kind: str, anew: bool = False) -> bool:
        """Show the stretch of the active UV map of an object in edit mode by ``ANGLE`` or ``AREA``, or none. Return whether UVs were read.

        They are read `anew`, or where that was not yet done.
        """
        if kind not in _NAMES:
            kind = "NONE"
            # What changes meanwhile is read when it is to be seen again.
            self._kind, self._known = kind, self._known and not anew
            return False
        if kind != self._kind:
            self._kind = kind
            self._revision += 1
        if self._known and not anew:
            return False
        self._measure(obj)
        self._known = True
        return True

    def _measure(self, obj: bpy.types.Object) -> None:
        arrays = self._arrays
        if self._stretch is None:
            corners, uvs = uv_map.read(obj)
            self._stretch = Stretch(arrays.in_object, arrays.triangles, arrays.polygons, corners.of_triangles(arrays))
        else:
            uvs = uv_map.read_uvs(obj)
        self._missing = uvs is None
        if uvs is not None:
            self._stretch.update(uvs)
        self._revision += 1

    @property
    def values(self) -> NDArray[np.float64]:
        """The octaves of each triangle's face, (m,), zero and more."""
        assert self._stretch is not None
        return self._stretch.values(self._kind)

    @property
    def summary(self) -> _Summary | None:
        """The mean and the worst stretch, as the last call of `poll` found them. None if they are not known, or no heat is shown."""
        return self._summary[1] if self.shown else None

    @property
    def busy(self) -> bool:
        """Whether `poll` must be called, because the summary is of other islands or another map."""
        return self._key() not in (None, self._summary[0])

    def _key(self) -> tuple[object, int] | None:
        """Return what the summary depends on, or None if there is nothing to say."""
        found = self._islands.answer
        return (found.key, self._revision) if self.shown and found is not None and found.count else None

    def poll(self) -> bool:
        """Find what there is to say of the islands, so that drawing does not. Return whether that is new."""
        found, key = self._islands.answer, self._key()
        if key is None or key == self._summary[0]:
            return False
        values, areas = self._stretch.islands(found.labels, self._kind)
        mean = float(np.average(values, weights=areas)) if areas.any() else 0.0
        worst = int(values.argmax())
        part = (found.labels == worst) & (found.count > 1 and values[worst] > 0.0)
        self._summary = key, _Summary(mean, float(values[worst]), found.count, part)
        return True

    # Drawing

    def repose(self) -> None:
        """Draw everything where it is seen now."""
        self._faces, self._drawn, self._outline = None, -1, (None, None)

    def draw_heat(self, eye: Eye) -> bool:
        """Draw the heat over the faces, and the outline of the worst island."""
        if not self.shown:
            return False
        if self._faces is None:
            self._faces = gpu_draw.ColoredFaces(self._pose.points)
        if self._drawn != self._revision:
            self._drawn = self._revision
            self._fill(self._faces)
        self._faces.draw_over(eye, heat_colors(_OPACITY))
        lines = self._outline_of(self.summary)
        if lines is not None:
            with gpu_draw.blended("LESS_EQUAL"):
                lines.draw(eye)
        return True

    def _fill(self, faces: gpu_draw.ColoredFaces) -> None:
        steps = np.minimum(self.values * (_STEPS / HOT), _STEPS - 1).astype(np.uint8)
        order = np.argsort(steps, kind="stable")
        bounds = np.searchsorted(steps[order], np.arange(_STEPS + 1))
        faces.fill((step, self._arrays.triangles[order[bounds[step] : bounds[step + 1]]]) for step in range(_STEPS))

    def _outline_of(self, summary: _Summary | None) -> gpu_draw.Lines | None:
        if summary is None or not summary.triangles.any():
            return None
        if self._outline[0] is not summary:
            triangles = self._arrays.triangles[summary.triangles].astype(np.int64)
            sides = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)
            _, first, counts = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
            ends = self._pose.points[sides[first[counts == 1]]]
            self._outline = summary, gpu_draw.Lines(_OUTLINE, ends) if len(ends) else None
        return self._outline[1]

    def legends(self) -> list[Legend]:
        if self._kind == "NONE":
            return []
        if self._missing:
            return [Legend(("No UV map: unwrap to see its stretch",))]
        lines, summary = [_NAMES[self._kind]], self.summary
        if summary is not None:
            lines.append(f"Mean {times(summary.mean)}")
            if summary.triangles.any():
                lines.append(f"Worst of {summary.count} islands {times(summary.value)}, outlined")
        marks = tuple((part, times(part * HOT) + ("+" if part == 1.0 else "")) for part in (0.0, 0.5, 1.0))
        return [Legend(tuple(lines), heat_colors(), marks)]


def times(octaves: float) -> str:
    """Return octaves as what they multiply by."""
    return f"{2.0**octaves:.2f}×"  # noqa: RUF001 - a sign, no letter
