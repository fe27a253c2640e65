# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheets of the paper's figures: pictures with letters, titles, insets and color bars, saved as small PNG files."""

from __future__ import annotations

from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from string import ascii_lowercase
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw, ImageFont

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from numpy.typing import NDArray

WIDTH = 2400
"""Of every sheet, pixels, at least."""
LIMIT = 600_000
"""The size that a file should have at most, bytes."""
_SEEN = 1.5
"""Mean difference of colors in smooth parts, of 255, from where on the eye may see it."""
_STEEP = 4
"""What pixels differ by at edges, at least."""
_BAYER = np.zeros((1, 1))
for _ in range(3):
    _BAYER = np.block([[4 * _BAYER, 4 * _BAYER + 2], [4 * _BAYER + 3, 4 * _BAYER + 1]])
_BAYER = (_BAYER + 0.5) / 64.0
"""Thresholds of ordered dithering, (8, 8)."""
_ROUNDS = 5
"""Of Lloyd's iteration."""
_TEXT = 36
_GAP = 24
_BAR = 26
_INK = (20, 20, 26)


@dataclass(frozen=True)
class Bar:
    """A color bar: what its colors mean, the numbers at its ends, and the color of each fraction of the way."""

    label: str
    low: str
    high: str
    colors: Callable[[NDArray[np.float64]], NDArray[np.float64]]


@dataclass(frozen=True)
class Key:
    """Colors that have names."""

    names: tuple[tuple[str, tuple[float, float, float]], ...]


@dataclass(frozen=True)
class Panel:
    """A picture, (height, width, 3), with what is written over and under it."""

    picture: NDArray[np.float64]
    title: str = ""
    legend: Bar | Key | None = None


def sheet(rows: Sequence[Sequence[Panel]]) -> Image.Image:
    """Return rows of panels with letters on white; pictures of a row stand on one line."""
    letters = iter(ascii_lowercase)
    made = [_row(row, letters) for row in rows]
    width = max(WIDTH, *(row.width for row in made))
    image = Image.new("RGB", (width, sum(row.height for row in made) + _GAP * (len(made) - 1)), "white")
    top = 0
    for row in made:
        image.paste(row, ((width - row.width) // 2, top))
        top += row.height + _GAP
    return image


def _row(panels: Sequence[Panel], letters: Iterator[str]) -> Image.Image:
    head, high = 2 * _TEXT, max(len(panel.picture) for panel in panels)
    foot = max((_BAR + 2 * _TEXT for panel in panels if panel.legend is not None), default=0)
    width = sum(panel.picture.shape[1] for panel in panels) + _GAP * (len(panels) - 1)
    image = Image.new("RGB", (width, head + high + foot), "white")
    draw, left = ImageDraw.Draw(image), 0
    for panel in panels:
        rows, columns = panel.picture.shape[:2]
        image.paste(_pixels(panel.picture), (left, head + high - rows))
        letter = next(letters)
        draw.text((left + 8, 8), letter, _INK, font(1.2 * _TEXT, bold=True))
        draw.text((left + 8 + 1.4 * _TEXT, 14), panel.title, _INK, font(_TEXT))
        if isinstance(panel.legend, Bar):
            _draw_bar(image, panel.legend, left, head + high + _GAP // 2, columns)
        elif panel.legend is not None:
            _draw_key(draw, panel.legend, left, head + high + _GAP // 2, columns)
        left += columns + _GAP
    return image


def font(size: float, bold: bool = False) -> ImageFont.FreeTypeFont:
    """Return the letters of all figures, from Matplotlib's folder: they have Greek and roots."""
    name = f"mpl-data/fonts/ttf/DejaVuSans{'-Bold' if bold else ''}.ttf"
    folder = Path(Image.__file__).parents[1] / "matplotlib"
    return ImageFont.truetype(str(folder / name), round(size), layout_engine=ImageFont.Layout.BASIC)


def _draw_bar(image: Image.Image, bar: Bar, left: int, top: int, width: int) -> None:
    draw, inset = ImageDraw.Draw(image), width // 12
    columns = width - 2 * inset
    colors = np.broadcast_to(bar.colors(np.linspace(0.0, 1.0, columns)), (_BAR, columns, 3))
    image.paste(_pixels(colors), (left + inset, top))
    below = top + _BAR + 6
    draw.text((left + inset, below), bar.low, _INK, font(0.8 * _TEXT))
    draw.text((left + width // 2, below), bar.label, _INK, font(0.8 * _TEXT), anchor="ma")
    draw.text((left + width - inset, below), bar.high, _INK, font(0.8 * _TEXT), anchor="ra")


def _draw_key(draw: ImageDraw.ImageDraw, key: Key, left: int, top: int, width: int) -> None:
    letters = font(0.8 * _TEXT)
    sizes = [_BAR + 10 + draw.textlength(name, letters) for name, _ in key.names]
    at = left + (width - sum(sizes) - 2 * _GAP * (len(sizes) - 1)) / 2
    for (name, color), size in zip(key.names, sizes, strict=True):
        draw.rectangle((at, top, at + _BAR, top + _BAR), tuple(round(255 * part) for part in color))
        draw.text((at + _BAR + 10, top - 3), name, _INK, letters)
        at += size + 2 * _GAP


def with_inset(
    picture: NDArray[np.float64],
    inset: NDArray[np.float64],
    about: tuple[int, int],
    zoom: float,
    corner: tuple[int, int] = (1, 1),
) -> NDArray[np.float64]:
    """Return a picture with an enlarged part in a corner; both have a frame.

    Parameters
    ----------
    picture, inset
        (height, width, 3) each.
    about
        The row and column of the picture that the inset's middle shows.
    zoom
        How many times larger the inset is.
    corner
        0 or 1 each: top or bottom, left or right.
    """
    image = _pixels(picture)
    draw, (high, wide) = ImageDraw.Draw(image), inset.shape[:2]
    row, column = about
    box = (column - wide / zoom / 2, row - high / zoom / 2, column + wide / zoom / 2, row + high / zoom / 2)
    draw.rectangle(box, outline=_INK, width=4)
    left, top = corner[1] * (image.width - wide), corner[0] * (image.height - high)
    image.paste(_pixels(inset), (left, top))
    draw.rectangle((left, top, left + wide - 1, top + high - 1), outline=_INK, width=4)
    return np.asarray(image) / 255.0


def _pixels(picture: NDArray[np.float64]) -> Image.Image:
    return Image.fromarray(np.round(np.clip(picture, 0.0, 1.0) * 255.0).astype(np.uint8))


def save(image: Image.Image, path: Path) -> str:
    """Write a PNG and return what it took: all colors, or at most 256 if that saves enough bytes and the eye does not see it.

    A picture that stays larger than LIMIT is written with all colors, and the text says so.
    """
    data, how = _bytes(image), "all colors"
    if len(data) > LIMIT:
        colors, fewer = _Colors(np.asarray(image)), None
        for count in (256, 176, 128, 96):
            made, off = colors.reduced(count)
            fewer = _bytes(made)
            if len(fewer) <= LIMIT or off > _SEEN:
                break
        if len(fewer) <= LIMIT and off <= _SEEN:
            data, how = fewer, f"{count} colors, smooth parts {off:.2f} off"
        else:
            how = f"all colors, because {LIMIT // 1000} kB would need too few"
    path.write_bytes(data)
    return f"{image.width} x {image.height}, {len(data) // 1000} kB, {how}"


class _Colors:
    """The colors of a picture, and how often each is in smooth parts, where the eye sees steps, and elsewhere."""

    def __init__(self, pixels: NDArray[np.uint8]) -> None:
        signed, steep = pixels.astype(np.int16), np.zeros(pixels.shape[:2], dtype=bool)
        right = np.abs(np.diff(signed, axis=1)).max(axis=2) > _STEEP
        below = np.abs(np.diff(signed, axis=0)).max(axis=2) > _STEEP
        steep[:, :-1] |= right
        steep[:, 1:] |= right
        steep[:-1] |= below
        steep[1:] |= below
        self._steep = steep
        codes = pixels.astype(np.int32) @ (65536, 256, 1)
        found, self._at, counts = np.unique(codes, return_inverse=True, return_counts=True)
        self._shape = pixels.shape[:2]
        self._smooth = np.bincount(self._at.ravel(), ~steep.ravel(), len(found))
        self._weights = np.sqrt(self._smooth) + 0.1 * np.sqrt(counts - self._smooth)
        self._colors = np.stack([found >> 16, found >> 8 & 255, found & 255], axis=1).astype(np.float32)

    def reduced(self, count: int) -> tuple[Image.Image, float]:
        """Return the picture in so many colors, and how far those of smooth parts are off in the mean, of 255."""
        palette = self._palette(count)
        near = self._nearest(self._colors, palette)
        off = np.abs(palette[near] - self._colors).mean(axis=1)
        pixels = near[self._at].reshape(self._shape)
        # Steps that could be seen are dithered: some pixels get a color from beyond the right one.
        coarse = np.flatnonzero((off > 0.7) & (self._smooth > 0.0))
        if len(coarse):
            second, share = self._mixed(self._colors[coarse], palette, near[coarse])
            others, shares = near.copy(), np.zeros(len(near))
            others[coarse], shares[coarse] = second, share
            rows, columns = np.indices(self._shape)
            order = _BAYER[rows % 8, columns % 8]
            dithered = (shares[self._at].reshape(self._shape) > order) & ~self._steep
            pixels = np.where(dithered, others[self._at].reshape(self._shape), pixels)
        image = Image.fromarray(pixels.astype(np.uint8), "P")
        image.putpalette(palette.astype(np.uint8).tobytes())
        return image, float(off @ self._smooth / self._smooth.sum())

    @staticmethod
    def _mixed(
        colors: NDArray[np.float32], palette: NDArray[np.float32], near: NDArray[np.intp]
    ) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
        """Return for each color the one of the palette that, mixed with the nearest, comes nearest to it, and its share."""
        away = colors - palette[near]
        along = palette[None] - palette[near][:, None]
        squares = (along**2).sum(axis=2)
        share = np.clip(np.einsum("nkc,nc->nk", along, away) / np.maximum(squares, 1e-9), 0.0, 0.5)
        # Colors far from each other would be seen as dots.
        left = ((share[..., None] * along - away[:, None]) ** 2).sum(axis=2) + 0.02 * share * squares
        best = left.argmin(axis=1)
        return best, share[np.arange(len(best)), best]

    def _palette(self, count: int) -> NDArray[np.float32]:
        """Return the colors that Lloyd's iteration finds, (count, 3), white among them."""
        often = np.argsort(-self._weights)[:8_000]
        colors, weights = self._colors[often], self._weights[often]
        # Begin with the colors that are farthest from those before, weighed by how often they are.
        chosen, far = [np.full(3, 255.0, dtype=np.float32)], np.full(len(colors), np.inf)
        for _ in range(count - 1):
            far = np.minimum(far, ((colors - chosen[-1]) ** 2).sum(axis=1))
            chosen.append(colors[int(np.argmax(far * weights))])
        palette = np.array(chosen)
        for _ in range(_ROUNDS):
            near = self._nearest(colors, palette)
            total = np.bincount(near, weights, count)
            means = np.stack([np.bincount(near, weights * column, count) for column in colors.T], axis=1)
            used = total > 0.0
            palette[used] = means[used] / total[used, None]
            palette[0] = 255.0
        return np.round(palette)

    @staticmethod
    def _nearest(colors: NDArray[np.float32], palette: NDArray[np.float32]) -> NDArray[np.intp]:
        """Return the number of the palette's color nearest to each, (n,)."""
        squares = (palette**2).sum(axis=1)
        parts = (colors[i : i + 20_000] for i in range(0, len(colors), 20_000))
        return np.concatenate([(squares - 2.0 * part @ palette.T).argmin(axis=1) for part in parts])


def _bytes(image: Image.Image) -> bytes:
    data = BytesIO()
    image.save(data, "PNG", optimize=True)
    return data.getvalue()
