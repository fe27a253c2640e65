# SPDX-License-Identifier: GPL-3.0-or-later
"""The stretch of an object's UV map, as heat over its faces, with a legend and its worst island outlined."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..core.stretch import Stretch
from ..mesh import uv_map
from . import gpu_draw
from .theme import Style

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..core.islands import IslandMaker
    from ..mesh.edit_mesh import Arrays
    from .gpu_draw import Eye
    from .theme import Color

HOT = 1.0
"""Octaves that are red: twice as long one way, or an area twice too large or small."""
_STEPS = 32
_OPACITY = 0.8
_RAMP = ((0.13, 0.22, 0.78), (0.10, 0.66, 0.86), (0.30, 0.76, 0.32), (0.98, 0.86, 0.16), (0.74, 0.04, 0.12))
"""From blue to red, at equal distances. Yellow is the lightest: where it turns to red is seen without color too. The red is
darker than that of seams, which are seen on it."""
_OUTLINE = Style((1.0, 1.0, 1.0, 1.0), 8.0, halo=2.0, lift=2.5)
"""Wider than the seams that lie on it."""
_TEXT: Color = (0.93, 0.93, 0.93, 1.0)
_GROUND: Color = (0.07, 0.07, 0.08, 0.8)
_NAMES = {"ANGLE": "Stretch of angles", "AREA": "Stretch of areas"}


def heat_colors(opacity: float = 1.0) -> list[Color]:
    """Return the colors from no stretch to the most."""
    at = np.linspace(0.0, len(_RAMP) - 1.0, _STEPS)
    red, green, blue = (np.interp(at, np.arange(len(_RAMP)), column) for column in zip(*_RAMP, strict=True))
    return [(float(r), float(g), float(b), opacity) for r, g, b in zip(red, green, blue, strict=True)]


@dataclass(frozen=True)
class Summary:
    """What there is to say of the islands.

    Parameters
    ----------
    mean
        Octaves, of all.
    worst
        The island with the most stretch; None: there is one island only.
    value
        Its octaves.
    count
        How many islands there are.
    triangles
        (m,) whether each is part of the worst one.
    """

    mean: float
    worst: int | None
    value: float
    count: int
    triangles: NDArray[np.bool_]


class StretchHeat:
    """The stretch of one object's UV map.

    Parameters
    ----------
    arrays
        The mesh.
    islands
        Computes the islands of its triangles.
    """

    def __init__(self, arrays: Arrays, islands: IslandMaker) -> None:
        self._arrays = arrays
        self._islands = islands
        self._kind = "NONE"
        self._stretch: Stretch | None = None
        self._known = False
        self._missing = False
        self._revision = 0
        self._faces: gpu_draw.Faces | None = None
        self._drawn = -1
        self._outline: tuple[object, gpu_draw.Lines | None] = (None, None)
        self._summary: tuple[object, Summary | None] = (None, None)

    @property
    def shown(self) -> bool:
        """Whether there is heat to be seen."""
        return self._kind != "NONE" and self._stretch is not None and not self._missing

    def follow(self, obj: bpy.types.Object, kind: str, anew: bool = False) -> bool:
        """Show a kind of stretch, or none, of the active UV map of an object in edit mode.

        Parameters
        ----------
        obj
            Whose mesh it is.
        kind
            ``NONE``, ``ANGLE`` or ``AREA``.
        anew
            Whether its UVs may be others than they were; else they are read where that was not yet done.

        Returns
        -------
        bool
            Whether they were read.
        """
        if kind == "NONE":
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
            self._stretch = Stretch(arrays.points, arrays.triangles, arrays.polygons, corners.of_triangles(arrays))
        else:
            uvs = uv_map.read_uvs(obj)
        self._missing = uvs is None
        if uvs is not None:
            found = self._islands.newest
            self._stretch.update(uvs, None if found is None else found.labels)
        self._revision += 1

    @property
    def values(self) -> NDArray[np.float64]:
        """The octaves of each triangle's face, (m,), zero and more."""
        assert self._stretch is not None
        return self._stretch.angle if self._kind == "ANGLE" else np.abs(self._stretch.area)

    def summary(self) -> Summary | None:
        """Return what there is to say of the islands; None where that is not known yet."""
        found = self._islands.newest
        if not self.shown or found is None or not found.count:
            return None
        key = (found.key, self._revision)
        if self._summary[0] != key:
            islands = self._stretch.islands(found.labels)
            values = islands.angle if self._kind == "ANGLE" else islands.area
            total = islands.areas.sum()
            mean = float((values * islands.areas).sum() / total) if total > 0.0 else 0.0
            worst = int(values.argmax())
            many = found.count > 1 and values[worst] > 0.0
            part = found.labels == worst if many else np.zeros(len(found.labels), dtype=bool)
            self._summary = key, Summary(mean, worst if many else None, float(values[worst]), found.count, part)
        return self._summary[1]

    # Drawing

    def draw(self, eye: Eye) -> None:
        """Draw the heat over the faces, and the outline of the worst island."""
        if self._faces is None:
            self._faces = gpu_draw.Faces(self._arrays.points)
        if self._drawn != self._revision:
            self._drawn = self._revision
            self._fill(self._faces)
        self._faces.draw_over(eye, heat_colors(_OPACITY))
        lines = self._outline_of(self.summary())
        if lines is not None:
            with gpu_draw.blended("LESS_EQUAL"):
                lines.within(eye).draw(eye)

    def _fill(self, faces: gpu_draw.Faces) -> None:
        steps = np.minimum(self.values * (_STEPS / HOT), _STEPS - 1).astype(np.uint8)
        order = np.argsort(steps, kind="stable")
        bounds = np.searchsorted(steps[order], np.arange(_STEPS + 1))
        faces.clear()
        for step in range(_STEPS):
            rows = order[bounds[step] : bounds[step + 1]]
            if len(rows):
                faces.add(step, self._arrays.triangles[rows])

    def _outline_of(self, summary: Summary | None) -> gpu_draw.Lines | None:
        if summary is None or summary.worst is None:
            return None
        if self._outline[0] is not summary:
            triangles = self._arrays.triangles[summary.triangles].astype(np.int64)
            sides = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)
            _, first, counts = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
            ends = self._arrays.points[sides[first[counts == 1]]]
            self._outline = summary, gpu_draw.Lines(_OUTLINE, ends) if len(ends) else None
        return self._outline[1]

    def legend(self) -> list[str]:
        """Return what is written beside the colors; nothing where no stretch is to be seen."""
        if self._kind == "NONE":
            return []
        if self._missing:
            return ["No UV map: unwrap to see its stretch"]
        lines, summary = [_NAMES[self._kind]], self.summary()
        if summary is not None:
            lines.append(f"Mean {times(summary.mean)}")
            if summary.worst is not None:
                lines.append(f"Worst of {summary.count} islands {times(summary.value)}, outlined")
        return lines

    def draw_legend(self, room: tuple[float, float, float, float], scale: float) -> None:
        """Draw the colors with their numbers in the lower right corner of a room: left, bottom, width, height."""
        lines = self.legend()
        if not lines:
            return
        left, bottom, width, _ = room
        size = gpu_draw.text_size(scale)
        gpu_draw.set_text(size)
        wide = max(14.0 * size, *(gpu_draw.text_width(line) for line in lines))
        bar = 0.0 if self._missing else 2.6 * size
        right = left + width - 1.2 * size
        low = bottom + 1.1 * size
        x, high = right - wide - size, low + bar + 1.5 * size * len(lines) + 0.6 * size
        gpu_draw.draw_rectangle((x, low), (right, high), _GROUND, 4.0 * scale)
        x += 0.5 * size
        if bar:
            colors = heat_colors()
            step = wide / len(colors)
            for i, color in enumerate(colors):
                # One over the other, so that no gap is left between them.
                gpu_draw.draw_rectangle((x + i * step, low + 1.7 * size), (x + wide, low + 2.5 * size), color)
            for part, align in ((0.0, 0.0), (0.5, 0.5), (1.0, 1.0)):
                text = times(part * HOT) + ("+" if part == 1.0 else "")
                at = x + part * wide - align * gpu_draw.text_width(text)
                gpu_draw.draw_text(text, (at, low + 0.55 * size), _TEXT, shadow=False)
        y = high - 1.4 * size
        for line in lines:
            gpu_draw.draw_text(line, (x, y), _TEXT, shadow=False)
            y -= 1.5 * size


def times(octaves: float) -> str:
    """Return octaves as what they multiply by."""
    return f"{2.0**octaves:.2f}×"  # noqa: RUF001 - a sign, no letter
