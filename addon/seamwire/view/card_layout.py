# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the parts of the card of first steps lie in a region. Knows neither Blender nor the GPU."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from ..words.card import Icon

    Measure = Callable[[str, float], float]
    """Returns the width of a text at a size."""

Part = Literal["CLOSE", "LINK"]
"""A part of the card that takes clicks."""

_SMALLEST = 0.7
"""Text is not made smaller than this part of its size: then there is no card."""
_ICON = 6.4
_TEXT = (9.0, 24.0)
_ROW = 2.3
_LINE = 1.4
_BESIDE = 22.0
_ABOVE = 8.0
_NAVIGATION = (8.2, 21.0)
"""Measures in sizes of the text.

In this order: the width of icons, the least and largest width of texts, the height of a row, and the height of a line. Then the width and
height of the text in the corner of the view. Last the width and height of Blender's navigation buttons in the upper right corner.
"""


@dataclass(frozen=True)
class Box:
    """A rectangle, in pixels from the region's bottom left."""

    left: float
    bottom: float
    width: float
    height: float

    @property
    def right(self) -> float:
        """Its right side."""
        return self.left + self.width

    @property
    def top(self) -> float:
        """Its upper side."""
        return self.bottom + self.height

    def contains(self, at: tuple[float, float]) -> bool:
        """Whether a pixel lies in it."""
        return self.left <= at[0] < self.right and self.bottom <= at[1] < self.top


@dataclass(frozen=True)
class Row:
    """One gesture: its icon, and the lines of its text from where each one's base line begins."""

    icon: Icon
    box: Box
    lines: tuple[tuple[str, float, float], ...]


@dataclass(frozen=True)
class Card:
    """The card in its place.

    Parameters
    ----------
    box
        All of it.
    size
        Of the text.
    title
        The title, and where its base line begins.
    rows
        The gestures, from above.
    close, link
        What takes clicks; `link` is None without a guide.
    """

    box: Box
    size: float
    title: tuple[str, float, float]
    rows: tuple[Row, ...]
    close: Box
    link: Box | None

    def part_at(self, at: tuple[float, float]) -> Part | None:
        """Return what of the card takes a click at a pixel; None: the view does."""
        if self.close.contains(at):
            return "CLOSE"
        return "LINK" if self.link is not None and self.link.contains(at) else None


def laid_out(
    title: str,
    steps: Sequence[tuple[Icon, str]],
    link: str,
    room: tuple[float, float, float, float],
    size: float,
    measure: Measure,
) -> Card | None:
    """Place the card in the lower right corner of a room, in smaller text if the room is small.

    Parameters
    ----------
    title
        The first line.
    steps
        Icons and texts of the gestures.
    link
        The text of the link, or an empty text for no link.
    room
        Left, bottom, width and height.
    size
        Of the text where there is room enough; it grows with the display's scale.
    measure
        Returns the width of a text at a size.

    Returns
    -------
    Card or None
        None if the room is too small for a readable card.
    """
    left, bottom, width, height = room
    beside = left, bottom, width - _NAVIGATION[0] * size, height
    smaller = size
    while smaller >= _SMALLEST * size:
        for place in (room, beside):
            card = _at_size(title, steps, link, place, smaller, measure)
            if card is not None and (place is beside or card.box.top <= bottom + height - _NAVIGATION[1] * size):
                return card
        smaller *= 0.94
    return None


def _at_size(
    title: str,
    steps: Sequence[tuple[Icon, str]],
    link: str,
    room: tuple[float, float, float, float],
    size: float,
    measure: Measure,
) -> Card | None:
    left, bottom, width, height = room
    margin, border = 1.0 * size, 1.2 * size
    most = min(_TEXT[1] * size, width - 2.0 * (margin + border) - _ICON * size)
    if most < _TEXT[0] * size:
        return None
    texts = [wrapped(text, most, lambda part: measure(part, size)) for _, text in steps]
    widest = max(measure(line, size) for lines in texts for line in lines)
    if widest > most:
        return None
    wide = 2.0 * margin + _ICON * size + widest
    heights = [max(_ROW, _LINE * len(lines) + 0.6) * size for lines in texts]
    tall = 2.0 * margin + 1.9 * size + sum(heights) + (2.1 * size if link else 0.0)
    if tall > height - 2.0 * border:
        return None
    low = bottom + border
    if width - wide - 2.0 * border < _BESIDE * size and tall + _ABOVE * size <= height - 2.0 * border:
        low += _ABOVE * size  # the text in the corner stays readable
    box = Box(left + width - border - wide, low, wide, tall)
    top = box.top - margin - 1.9 * size
    rows = []
    for (icon, _), lines, high in zip(steps, texts, heights, strict=True):
        first = top - 0.5 * (high - _LINE * size * len(lines)) - 1.05 * size
        x = box.left + margin + _ICON * size
        placed = tuple((line, x, first - _LINE * size * i) for i, line in enumerate(lines))
        place = Box(box.left + margin, top - 0.5 * (high + 1.7 * size), (_ICON - 0.9) * size, 1.7 * size)
        rows.append(Row(icon, place, placed))
        top -= high
    close = Box(box.right - 2.2 * size, box.top - 2.2 * size, 2.0 * size, 2.0 * size)
    at = None
    if link:
        at = Box(box.left + margin - 0.5 * size, box.bottom + 0.6 * size, measure(link, size) + size, 1.8 * size)
    return Card(box, size, (title, box.left + margin, box.top - margin - 0.8 * size), tuple(rows), close, at)


def wrapped(text: str, width: float, measure: Callable[[str], float]) -> tuple[str, ...]:
    """Break a text between words into lines of at most `width`. A longer word gets its own line."""
    lines: list[str] = []
    for word in text.split():
        if lines and measure(f"{lines[-1]} {word}") <= width:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return tuple(lines)
