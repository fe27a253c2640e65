# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn on the surface of an edited object, below its wires, and what its colors mean. Other add-ons can add layers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..core.base import native
from ..core.base.newest import Newest
from ..core.islands.uv_maps import Stretch
from ..core.offers.crests import Crests
from ..mesh import uv_islands
from ..terms.choices import HEATS
from ..words.reports import count
from . import gpu_draw
from .theme import STRETCH, Style, steps

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import bpy
    import seamwire_core
    from numpy.typing import NDArray

    from ..core.base.mesh_arrays import Arrays
    from ..core.islands.islands import IslandMaker
    from ..core.solver.solver import End
    from ..mesh.edit_mesh import Pose
    from ..terms.options import Options
    from .gpu_draw import Eye
    from .theme import Color

    LayerMaker = Callable[[Arrays, Callable[[], seamwire_core.Surface], Pose], "Layer"]
    """Makes a layer of the mesh, a function that waits for the library's surface of it, and the pose in which it is seen."""

HOT = 1.0
"""Octaves that are red: twice as long one way, or an area twice too large or small."""
_STEPS = 32
_OPACITY = 0.8
_OUTLINE = Style((1.0, 1.0, 1.0, 1.0), 8.0, halo=2.0, lift=2.5)
"""Wider than the seams that lie on it."""
_RIDGE = Style((0.98, 0.45, 0.10, 1.0), 2.0, halo=1.0, lift=4.0)
_VALLEY = Style((0.20, 0.50, 1.0, 1.0), 2.0, halo=1.0, lift=4.0)
_TEXT: Color = (0.93, 0.93, 0.93, 1.0)
_GROUND: Color = (0.07, 0.07, 0.08, 0.8)
"""Dark under light text in every theme, so that the colors look the same everywhere."""


@dataclass(frozen=True)
class Legend:
    lines: tuple[str, ...]  # the title, and further lines of text
    colors: Sequence[Color] = ()  # of a bar, from the least to the most; without them there is no bar
    marks: tuple[tuple[float, str], ...] = ()  # numbers below the bar: each with where it is, 0 to 1
    swatches: tuple[tuple[Color, str], ...] = ()  # colors with what each means, one a line


def draw_legends(
    legends: Sequence[Legend], room: tuple[float, float, float, float], scale: float, on_left: bool = False
) -> None:
    """Draw legends above each other from the lower right or left corner of a room: left, bottom, width, height."""
    left, bottom, width, height = room
    size = gpu_draw.text_size(scale)
    gpu_draw.set_text(size)
    low, right = bottom + 1.1 * size, left + width - 1.2 * size
    for legend in legends:
        texts = [*legend.lines, *(f"      {text}" for _, text in legend.swatches)]
        wide = max(14.0 * size, *(gpu_draw.text_width(text) for text in texts))
        # At the left, the text is aligned with text that has no ground.
        high = _draw_legend(legend, left + 0.7 * size if on_left else right - wide - size, wide, low, size, scale)
        low = high + 0.5 * size
        if low > bottom + height:
            return


def _draw_legend(legend: Legend, x: float, wide: float, low: float, size: float, scale: float) -> float:
    """Draw a legend with its lower left corner at (x, low), and return the height of its upper side."""
    bar = 2.6 * size if len(legend.colors) else 0.0
    high = low + bar + 1.5 * size * (len(legend.lines) + len(legend.swatches)) + 0.6 * size
    gpu_draw.draw_rectangle((x, low), (x + wide + size, high), _GROUND, 4.0 * scale)
    x += 0.5 * size
    if bar:
        step = wide / len(legend.colors)
        for i, color in enumerate(legend.colors):
            # One over the other, so that no gap is left between them.
            gpu_draw.draw_rectangle((x + i * step, low + 1.7 * size), (x + wide, low + 2.5 * size), color)
        for part, text in legend.marks:
            at = x + part * (wide - gpu_draw.text_width(text))
            gpu_draw.draw_text(text, (at, low + 0.55 * size), _TEXT, shadow=False)
    y = high - 1.4 * size
    for line in legend.lines:
        gpu_draw.draw_text(line, (x, y), _TEXT, shadow=False)
        y -= 1.5 * size
    for color, text in legend.swatches:
        gpu_draw.draw_rectangle((x, y - 0.1 * size), (x + 1.1 * size, y + 0.8 * size), color, 2.0 * scale)
        gpu_draw.draw_text(text, (x + 1.6 * size, y), _TEXT, shadow=False)
        y -= 1.5 * size
    return high


class Layer:
    """A layer over one object. This one shows nothing."""

    @property
    def busy(self) -> bool:
        """Whether something is being computed, so that `poll` must be called from time to time."""
        return False

    def follow(self, options: Options, source: End | None, strokes: tuple[object, ...]) -> None:
        """Show what the settings ask for. `strokes` are the library's scribbles.

        Distances are from the source: the seed of the chain, otherwise the active vertex, otherwise the last seed.
        """

    def poll(self) -> bool:
        """Return whether there is something new to see since the last call. Raise what went wrong in a thread."""
        return False

    def repose(self) -> None:
        """Draw everything where the pose has it now."""

    def draw_heat(self, _eye: Eye) -> bool:
        """Color the faces, and return whether there was anything to color. The first layer that does so replaces the islands' tint."""
        return False

    def draw_lines(self, eye: Eye) -> None:
        """Draw everything else."""

    def legends(self) -> list[Legend]:
        """Return the legends, the lowest first."""
        return []

    def close(self) -> None:
        """End all computations."""


class _Summary(NamedTuple):
    """What there is to say of the islands: mean and worst octaves, their number, and whether each triangle, (m,), is part of the worst."""

    mean: float
    value: float
    count: int
    triangles: NDArray[np.bool_]


class StretchHeat(Layer):
    """The stretch of the UV map of an object, as heat over its faces, with its worst island outlined."""

    def __init__(self, arrays: Arrays, islands: IslandMaker, pose: Pose) -> None:
        self._arrays = arrays
        self._pose = pose
        self._islands = islands
        self._kind = "NONE"
        self._stretch: Stretch | None = None
        self._is_known = False
        self._is_missing = False
        self._revision = 0  # counts other maps and kinds
        self._made = gpu_draw.Made()
        self._summary: tuple[object, _Summary | None] = (None, None)

    @property
    def shown(self) -> bool:
        return self._kind != "NONE" and self._stretch is not None and not self._is_missing

    def read(self, obj: bpy.types.Object, kind: str, anew: bool = False) -> bool:
        """Show the stretch of the active UV map of an object in edit mode by a kind of `HEATS`. Return whether UVs were read.

        They are read `anew`, or where that was not yet done. What changes while no stretch is shown is read when it is to be seen again.
        """
        self._revision += kind != self._kind
        self._kind = kind
        self._is_known = self._is_known and not anew
        if kind == "NONE" or self._is_known:
            return False
        arrays = self._arrays
        if self._stretch is None:
            corners, uvs = uv_islands.read_map(obj)
            self._stretch = Stretch(arrays.in_object, arrays.triangles, arrays.polygons, corners.of_triangles(arrays))
        else:
            uvs = uv_islands.read_uvs(obj)
        self._is_missing = uvs is None
        if uvs is not None:
            self._stretch.update(uvs)
        self._revision += 1
        self._is_known = True
        return True

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
        found = self._islands.answer
        return (found.key, self._revision) if self.shown and found is not None and found.count else None

    def poll(self) -> bool:
        """Find what there is to say of the islands, so that drawing does not. Return whether that is new."""
        if not self.busy:
            return False
        found = self._islands.answer
        values, areas = self._stretch.islands(found.labels, self._kind)
        mean = float(np.average(values, weights=areas)) if areas.any() else 0.0
        worst = int(values.argmax())
        part = (found.labels == worst) & (found.count > 1 and values[worst] > 0.0)
        self._summary = self._key(), _Summary(mean, float(values[worst]), found.count, part)
        return True

    def repose(self) -> None:
        self._made.clear()

    def draw_heat(self, eye: Eye) -> bool:
        if not self.shown:
            return False
        faces = self._made.of("faces", None, lambda: gpu_draw.ColoredFaces(self._pose.points))
        self._made.of("colors", self._revision, lambda: self._fill(faces))
        faces.draw_over(eye, heat_colors(_OPACITY))
        lines = self._made.of("outline", self._summary[0], self._outline)
        if lines is not None:
            with gpu_draw.blended("LESS_EQUAL"):
                lines.draw(eye)
        return True

    def _fill(self, faces: gpu_draw.ColoredFaces) -> None:
        number = np.minimum(self.values * (_STEPS / HOT), _STEPS - 1).astype(np.uint8)
        order = np.argsort(number, kind="stable")
        bounds = np.searchsorted(number[order], np.arange(_STEPS + 1))
        faces.fill((step, self._arrays.triangles[order[bounds[step] : bounds[step + 1]]]) for step in range(_STEPS))

    def _outline(self) -> gpu_draw.Lines | None:
        if self.summary is None:
            return None
        triangles = self._arrays.triangles[self.summary.triangles].astype(np.int64)
        sides = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)
        _, first, counts = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
        ends = self._pose.points[sides[first[counts == 1]]]
        return gpu_draw.Lines(_OUTLINE, ends) if len(ends) else None

    def legends(self) -> list[Legend]:
        if self._kind == "NONE":
            return []
        if self._is_missing:
            return [Legend(("No UV map: unwrap to see its stretch",))]
        lines, summary = [HEATS[self._kind].name.capitalize()], self.summary
        if summary is not None:
            lines.append(f"Mean {_times(summary.mean)}")
            if summary.triangles.any():
                lines.append(f"Worst of {summary.count} islands {_times(summary.value)}, outlined")
        marks = tuple((part, _times(part * HOT) + ("+" if part == 1.0 else "")) for part in (0.0, 0.5, 1.0))
        return [Legend(tuple(lines), heat_colors(), marks)]


def heat_colors(opacity: float = 1.0) -> list[Color]:
    return steps(STRETCH, _STEPS, opacity)


def _times(octaves: float) -> str:
    return f"{2.0**octaves:.2f}×"  # noqa: RUF001 - a sign, no letter


class CrestView(Layer):
    """The layer of ridges and valleys. `surface` returns the library's surface of the mesh. A thread calls it, where it may wait."""

    def __init__(self, surface: Callable[[], seamwire_core.Surface], pose: Pose) -> None:
        core = native.load()

        def make(_request: None) -> Crests:
            return Crests.on(core, surface(), lambda _fraction: not self._maker.superseded)

        self._pose = pose
        self._maker: Newest[None, Crests] = Newest(make, "seamwire-crests", (core.Cancelled,))
        self._is_asked = False
        self._seen: Crests | None = None
        self._is_visible = False
        self._made = gpu_draw.Made()
        self.is_wanted = False  # whether the lines are needed even if they are not shown

    @property
    def crests(self) -> Crests | None:
        return self._maker.answer

    def follow(self, options: Options, _source: object, _strokes: object) -> None:
        """Show the lines if the settings say so. Find them the first time that they are needed."""
        self._is_visible = options.show_crests
        if (self._is_visible or self.is_wanted) and not self._is_asked:
            self._is_asked = True
            self._maker.want(None)

    @property
    def busy(self) -> bool:
        return self._maker.busy or self.crests is not self._seen

    def poll(self) -> bool:
        try:
            self._maker.check()
        except Exception:
            self._is_asked = False
            raise
        before, self._seen = self._seen, self.crests
        return self._seen is not before

    def close(self) -> None:
        self._maker.close()

    def repose(self) -> None:
        self._made.clear()

    def draw_lines(self, eye: Eye) -> None:
        crests = self.crests
        if not self._is_visible or crests is None:
            return

        def make() -> tuple[gpu_draw.Lines, ...]:
            is_ridge = crests.ridges[crests.owners[crests.pieces]]
            seen = self._pose.places(crests.segments.reshape(-1, 3)).reshape(-1, 2, 3)
            return gpu_draw.Lines(_VALLEY, seen[~is_ridge]), gpu_draw.Lines(_RIDGE, seen[is_ridge])

        with gpu_draw.blended("LESS_EQUAL"):
            for lines in self._made.of("lines", crests, make):
                lines.draw(eye)

    def legends(self) -> list[Legend]:
        if not self._is_visible:
            return []
        crests = self.crests
        if crests is None:
            return [Legend(("Computing...",))]
        ridges = int(crests.ridges.sum())
        swatches = (_RIDGE.color, count(ridges, "ridge")), (_VALLEY.color, count(len(crests) - ridges, "valley"))
        strongest = float(crests.strengths.max(initial=0.0))
        return [Legend((f"Strength from 1 to {strongest:.3g} radians",) if len(crests) else (), swatches=swatches)]


makers: list[LayerMaker] = []
"""Make the layers of other add-ons for each object that is drawn on."""
