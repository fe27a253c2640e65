# SPDX-License-Identifier: GPL-3.0-or-later
"""The text over the viewport: a few lines in its corner, and the table of keys."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from . import gpu_draw

if TYPE_CHECKING:
    from collections.abc import Callable

    from .theme import Color


def draw(text: Sequence[str], corner: tuple[float, float], scale: float, color: Sequence[float]) -> None:
    """Draw lines of text above a corner.

    Parameters
    ----------
    text
        Top line first.
    corner
        Left and bottom of where there is room, in pixels.
    scale
        Of the display.
    color
        Red, green, blue.
    """
    size = gpu_draw.text_size(scale)
    gpu_draw.set_text(size)
    x = corner[0] + 1.2 * size
    y = corner[1] + 1.1 * size
    for line in reversed(text):
        gpu_draw.draw_text(line, (x, y), (*color[:3], 1.0))
        y += 1.5 * size


Row = tuple[str, str]
"""The keys as they are bound, and what they do. Without keys it is a heading."""

BACKGROUND: Color = (0.07, 0.07, 0.08, 0.98)
_KEY: Color = (1.0, 0.83, 0.35, 1.0)
_WHAT: Color = (0.93, 0.93, 0.93, 1.0)
_HEADING: Color = (1.0, 1.0, 1.0, 1.0)


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
    """Place rows in two columns, so that the table is low, or in as many as they need; where they do not fit, in smaller text.

    Parameters
    ----------
    rows
        The rows of the table.
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
    long = -(-len(rows) // max(2, -(-len(rows) // fit)))
    columns: list[list[Row]] = []
    for row in rows:
        # A group stays together if the height allows it.
        if not columns or len(columns[-1]) >= fit or (len(columns[-1]) >= long and not row[0]):
            columns.append([])
        columns[-1].append(row)
    placed, left, tallest = [], margin, 0.0
    for column in columns:
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


def draw_table(rows: Sequence[Row], room: tuple[float, float, float, float], scale: float) -> None:
    """Draw the table at the bottom of the room there is, so that it leaves the middle to the model.

    Parameters
    ----------
    rows
        The rows of the table.
    room
        Left, bottom, width and height in the region.
    scale
        Of the display.
    """

    def measure(text: str, size: float) -> float:
        gpu_draw.set_text(size)
        return gpu_draw.text_width(text)

    left, bottom, width, height = room
    border = 12.0 * scale
    table = laid_out(rows, (width - 2.0 * border, height - 2.0 * border), gpu_draw.text_size(scale, 1.1), measure)
    x = left + max(0.0, (width - table.width) / 2)
    top = bottom + min(border + table.height, (height + table.height) / 2)
    gpu_draw.draw_rectangle((x, top - table.height), (x + table.width, top), BACKGROUND, 6.0 * scale)
    gpu_draw.set_text(table.size)
    for place in table.rows:
        key, what = place.row
        y = top - place.y
        if key:
            gpu_draw.draw_text(key, (x + place.key_end - gpu_draw.text_width(key), y), _KEY, shadow=False)
        gpu_draw.draw_text(what, (x + place.what, y), _WHAT if key else _HEADING, shadow=False)
