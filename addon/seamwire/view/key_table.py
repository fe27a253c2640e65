# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of keys that the tool shows over the viewport."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from . import gpu_draw as paint
from .theme import Colour

if TYPE_CHECKING:
    from collections.abc import Callable

Row = tuple[str, str]
"""The keys as they are bound, and what they do. Without keys it is a heading."""

BACKGROUND: Colour = (0.07, 0.07, 0.08, 0.98)
_KEY: Colour = (1.0, 0.83, 0.35, 1.0)
_WHAT: Colour = (0.93, 0.93, 0.93, 1.0)
_HEADING: Colour = (1.0, 1.0, 1.0, 1.0)


@dataclass(frozen=True)
class Placed:
    """One row in its place: pixels from the panel's left and top, to the text's base line."""

    row: Row
    key_end: float
    what: float
    y: float


@dataclass(frozen=True)
class Table:
    """A laid-out table; sizes in pixels."""

    width: float
    height: float
    size: float
    rows: tuple[Placed, ...]


def laid_out(
    rows: Sequence[Row], room: tuple[float, float], size: float, measure: Callable[[str, float], float]
) -> Table:
    """Place rows in as many columns as they need; where they do not fit, in smaller text.

    Parameters
    ----------
    rows
        What is to be read.
    room
        Width and height there are.
    size
        Of the text where there is room enough.
    measure
        Returns the width of a text at a size.
    """
    smallest = max(0.5 * size, 6.0)
    while True:
        table = _columns(rows, room[1], size, measure)
        if (table.width <= room[0] and table.height <= room[1]) or size <= smallest:
            return table
        size = max(0.92 * size, smallest)


def _columns(rows: Sequence[Row], height: float, size: float, measure: Callable[[str, float], float]) -> Table:
    margin, gap, pitch = 1.8 * size, 1.0 * size, 1.75 * size
    fit = max(1, int((height - 2.0 * margin) // pitch))
    count = -(-len(rows) // fit)
    long = -(-len(rows) // count) if count else 0
    placed, left, tallest = [], margin, 0.0
    for start in range(0, len(rows), max(long, 1)):
        column = rows[start : start + long]
        keys = max((measure(key, size) for key, _ in column if key), default=0.0)
        whats = max(
            max((measure(what, size) for key, what in column if key), default=0.0),
            max((measure(what, size) - keys - gap for key, what in column if not key), default=0.0),
        )
        for i, row in enumerate(column):
            y = margin + pitch * i + size
            placed.append(Placed(row, left + keys, left + keys + gap if row[0] else left, y))
        tallest = max(tallest, pitch * (len(column) - 1) + size)
        left += keys + gap + whats + 2.0 * margin
    return Table(max(left - margin, 0.0), tallest + 2.0 * margin, size, tuple(placed))


def draw(rows: Sequence[Row], room: tuple[float, float, float, float], scale: float) -> None:
    """Draw the table in the middle of the room there is.

    Parameters
    ----------
    rows
        What is to be read.
    room
        Left, bottom, width and height in the region.
    scale
        Of the display.
    """

    def measure(text: str, size: float) -> float:
        paint.set_text(size)
        return paint.text_width(text)

    left, bottom, width, height = room
    border = 12.0 * scale
    table = laid_out(rows, (width - 2.0 * border, height - 2.0 * border), paint.text_size(scale, 1.1), measure)
    x = left + max(0.0, (width - table.width) / 2)
    top = bottom + (height + table.height) / 2
    paint.draw_rectangle((x, top - table.height), (x + table.width, top), BACKGROUND, 6.0 * scale)
    paint.set_text(table.size)
    for place in table.rows:
        key, what = place.row
        y = top - place.y
        if key:
            paint.draw_text(key, (x + place.key_end - paint.text_width(key), y), _KEY, shadow=False)
        paint.draw_text(what, (x + place.what, y), _WHAT if key else _HEADING, shadow=False)
