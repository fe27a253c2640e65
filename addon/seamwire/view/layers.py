# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn on the surface of an edited object, below its wires, and what its colors mean. Other add-ons can add layers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from . import gpu_draw

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import seamwire_core

    from ..core.base.mesh_arrays import Arrays
    from ..core.solver.solver import End
    from ..mesh.pose import Pose
    from ..terms.options import Options
    from .gpu_draw import Eye
    from .theme import Color

    LayerMaker = Callable[[Arrays, Callable[[], seamwire_core.Surface], Pose], "Layer"]
    """Makes a layer of the mesh, a function that waits for the library's surface of it, and the pose in which it is seen."""

_TEXT: Color = (0.93, 0.93, 0.93, 1.0)
_GROUND: Color = (0.07, 0.07, 0.08, 0.8)
"""Dark under light text in every theme, so that the colors look the same everywhere."""


@dataclass(frozen=True)
class Legend:
    """One box."""

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
        wide = _width(legend, size)
        # At the left, the text is aligned with text that has no ground.
        high = _draw_legend(legend, left + 0.7 * size if on_left else right - wide - size, wide, low, size, scale)
        low = high + 0.5 * size
        if low > bottom + height:
            return


def _width(legend: Legend, size: float) -> float:
    texts = [*legend.lines, *(f"      {text}" for _, text in legend.swatches)]
    return max(14.0 * size, *(gpu_draw.text_width(text) for text in texts))


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


makers: list[LayerMaker] = []
"""Make the layers of other add-ons for each object that is drawn on."""
