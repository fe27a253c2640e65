# SPDX-License-Identifier: GPL-3.0-or-later
"""The text over the viewport: a few lines in its corner that say how wires are drawn, and the table of keys."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..words.names import LOOP_NAMES
from . import gpu_draw

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..core.drawing.picture import Picture
    from ..core.islands.islands import Islands
    from .theme import Color

_METRICS = {
    "feature": "",
    "campen": "Campen's metric",
    "pottmann_kovacs": "Pottmann and Kovacs' metric",
    "concave": "concave creases",
    "euclidean": "shortest paths",
}
_FOLLOWS = ("Least curvature", "Most curvature", "Concave creases")
_FOLLOWS_IN = {"concave": ("Concave creases", "Shortest path"), "euclidean": ("Shortest path",)}


def _islands(islands: Islands) -> str:
    """Say how many islands there are, and, once something is cut, which do not unwrap yet."""
    found = f"{islands.count} island" + ("s" if islands.count != 1 else "")
    if islands.gaps:
        found += f", {len(islands.gaps)} gap{'s' if len(islands.gaps) != 1 else ''} in seams"
    no_discs = int((islands.missing > 0).sum())
    if not islands.cut or not no_discs:
        return found
    cuts = int(islands.missing.sum())
    return f"{found}, {no_discs} still need{'s' if no_discs == 1 else ''} {cuts} cut{'s' if cuts != 1 else ''}"


def _island(islands: Islands, number: int) -> str:
    """Say which island that is, and what it needs."""
    size, cuts = int(islands.sizes[number]), int(islands.missing[number])
    needs = f"needs {cuts} more cut{'s' if cuts != 1 else ''}" if cuts else "a disc"
    return f"Island {number + 1}: {size} triangle{'s' if size != 1 else ''}, {needs}"


def lines(picture: Picture) -> list[str]:
    """Return what is to be read, top line first."""
    found = []
    options, offered, choice, islands = picture.options, picture.offered, picture.choice, picture.islands
    if offered.kind is not None:
        which = f" ({offered.number + 1} of {len(offered.kinds)})" if len(offered.kinds) > 1 else ""
        found.append(LOOP_NAMES[offered.kind].capitalize() + which)
    if picture.active is not None and choice.count > 1:
        follows = _FOLLOWS_IN.get(options.metric, _FOLLOWS)
        which = follows[picture.active.follow]
        if choice.straight:
            which = "Straight in the view"
        elif choice.around:
            which = "Around the limb"
        found.append(f"{which} ({choice.number + 1} of {choice.count})")
    if islands is not None:
        found.append(_islands(islands))
        if picture.pointed_island is not None:
            found.append(_island(islands, picture.pointed_island))
    way = "Along edges" if options.along == "EDGES" else "Across the surface"
    metric = _METRICS.get(options.metric, options.metric)
    strength = "" if options.metric == "euclidean" else f"strength {picture.strength:.3g}"
    found.append(", ".join(part for part in (way, strength, metric) if part))
    modes = [
        "" if options.marking else "Clearing seams",
        "Mirror " + " ".join("XYZ"[axis] for axis in options.mirror) if options.mirror else "",
        "X-ray" if options.xray else "",
        "Snapping to features" if options.snap else "",
    ]
    said = ", ".join(mode for mode in modes if mode)
    return [*found, said] if said else found


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
    """Place rows in as many columns as they need; where they do not fit, in smaller text.

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


def draw_table(rows: Sequence[Row], room: tuple[float, float, float, float], scale: float) -> None:
    """Draw the table in the middle of the room there is.

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
    top = bottom + (height + table.height) / 2
    gpu_draw.draw_rectangle((x, top - table.height), (x + table.width, top), BACKGROUND, 6.0 * scale)
    gpu_draw.set_text(table.size)
    for place in table.rows:
        key, what = place.row
        y = top - place.y
        if key:
            gpu_draw.draw_text(key, (x + place.key_end - gpu_draw.text_width(key), y), _KEY, shadow=False)
        gpu_draw.draw_text(what, (x + place.what, y), _WHAT if key else _HEADING, shadow=False)
