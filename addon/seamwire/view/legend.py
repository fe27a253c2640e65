# SPDX-License-Identifier: GPL-3.0-or-later
"""What colors in the 3D view mean: boxes with text, a bar of colors with numbers, and swatches, one over the other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from . import gpu_draw

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .theme import Color

_TEXT: Color = (0.93, 0.93, 0.93, 1.0)
_GROUND: Color = (0.07, 0.07, 0.08, 0.8)
"""Dark under light text in every theme, so that the colors look the same everywhere."""


@dataclass(frozen=True)
class Legend:
    """One box.

    Parameters
    ----------
    lines
        The title, and further lines of text.
    colors
        From the least to the most; none: there is no bar.
    marks
        Numbers below the bar: each with where it is, 0 to 1.
    swatches
        Colors with what each means, one a line.
    """

    lines: tuple[str, ...]
    colors: Sequence[Color] = ()
    marks: tuple[tuple[float, str], ...] = ()
    swatches: tuple[tuple[Color, str], ...] = ()


def draw(legends: Sequence[Legend], room: tuple[float, float, float, float], scale: float) -> None:
    """Draw legends above each other from the lower right corner of a room: left, bottom, width, height."""
    left, bottom, width, height = room
    size = gpu_draw.text_size(scale)
    gpu_draw.set_text(size)
    low, right = bottom + 1.1 * size, left + width - 1.2 * size
    for legend in legends:
        high = _draw_one(legend, right, low, size, scale)
        low = high + 0.5 * size
        if low > bottom + height:
            return


def _draw_one(legend: Legend, right: float, low: float, size: float, scale: float) -> float:
    """Draw one with its lower right corner at a place; return where its upper side is."""
    texts = [*legend.lines, *(f"      {text}" for _, text in legend.swatches)]
    wide = max(14.0 * size, *(gpu_draw.text_width(text) for text in texts))
    bar = 2.6 * size if len(legend.colors) else 0.0
    x, high = right - wide - size, low + bar + 1.5 * size * len(texts) + 0.6 * size
    gpu_draw.draw_rectangle((x, low), (right, high), _GROUND, 4.0 * scale)
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
