# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheets that show maps of one model side by side: seams from two sides, a checkerboard, and the islands."""

from __future__ import annotations

import colorsys
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from uv_maps import Frame, UvMap, triangle_areas
from uv_measures import seam_samples
from uv_rasters import coverage, front_view

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Integers = NDArray[np.int64]

_GOLDEN = 0.61803
_SMOOTH = 2
"""Pictures are drawn this many times larger and averaged."""
_CHECKS = 0.025
"""Size of a checkerboard's field on the surface, of the diagonal."""
_SEAM = np.array([0.75, 0.0, 0.0])
_DARK_SEAM = np.array([0.1, 0.1, 0.15])
_DARK, _LIGHT = 0.3, 0.95
_TRIED = 200
"""Pixels along a side of the pictures in which the best view is looked for."""
_HEAD = 24
"""Pixels above the first row for the titles of columns."""
_FRONT, _BACK = (25.0, 12.0), (205.0, 12.0)
"""Azimuth and elevation of the two views, in degrees; 0, 0 looks at the front."""
_GAP = 0.02


class Surface(NamedTuple):
    """A surface with seams: points (n, 3), triangles (m, 3), the island of each triangle, and the seams as vertex pairs (k, 2)."""

    points: Floats
    triangles: Integers
    islands: Integers
    seams: Integers


class Row(NamedTuple):
    """A row of a sheet: what is written on it, and the map."""

    label: str
    uv_map: UvMap


def arranged(uv_map: UvMap) -> UvMap:
    """Return the map with its islands side by side, in rows from the tallest to the lowest, neither scaled nor turned."""
    islands = uv_map.islands
    count = int(islands.max()) + 1
    low, high = np.full((count, 2), np.inf), np.full((count, 2), -np.inf)
    np.minimum.at(low, islands, uv_map.uvs.min(axis=1))
    np.maximum.at(high, islands, uv_map.uvs.max(axis=1))
    size = high - low
    gap = _GAP * np.sqrt(size.prod(axis=1).sum())
    width = max(1.1 * np.sqrt((size + gap).prod(axis=1).sum()), (size[:, 0] + gap).max())
    place, corner, tallest = np.zeros((count, 2)), np.zeros(2), 0.0
    for island in np.argsort(-size[:, 1], kind="stable"):
        if corner[0] + size[island, 0] > width:
            corner = np.array([0.0, corner[1] + tallest + gap])
            tallest = 0.0
        place[island] = corner
        tallest = max(tallest, size[island, 1])
        corner[0] += size[island, 0] + gap
    return UvMap(uv_map.points, uv_map.triangles, uv_map.uvs + (place - low)[islands][:, None], uv_map.info)


def island_colors(count: int) -> Floats:
    """Return colors (count, 3) of which neighbors differ."""
    hues = np.arange(count) * _GOLDEN % 1
    return np.array(
        [colorsys.hsv_to_rgb(h, (0.35, 0.45, 0.55)[i % 3], (0.95, 0.85)[i % 2]) for i, h in enumerate(hues)]
    )


def on_screen(points: Floats, frame: Frame, view: tuple[float, float], size: int) -> tuple[Floats, Floats]:
    """Return points (n, 3) as column, row and depth in pixels, and the direction to the viewer.

    view: azimuth and elevation in degrees; size: pixels along a side of the picture.
    """
    right, up, front = frame.axes
    azimuth, elevation = np.radians(view)
    toward = np.cos(elevation) * (np.cos(azimuth) * front + np.sin(azimuth) * right) + np.sin(elevation) * up
    across = np.cross(up, toward)
    across /= np.linalg.norm(across)
    turned = points @ np.stack([across, -np.cross(toward, across), toward], axis=1)
    low, high = turned.min(axis=0), turned.max(axis=0)
    scale = 0.94 * size / (high - low)[:2].max()
    return (turned - (low + high) / 2) * scale + [size / 2, size / 2, 0.0], toward


def surface_picture(
    uv_map: UvMap | Surface, frame: Frame, view: tuple[float, float], size: int, *, checks: bool = False
) -> Floats:
    """Draw a model in the colors of its islands, with seams or with a checkerboard: (size, size, 3), 0 to 1."""
    large = size * _SMOOTH
    screen, toward = on_screen(uv_map.points, frame, view, large)
    drawn = front_view(screen, uv_map.triangles, large, large)
    face = np.maximum(drawn.triangle, 0)
    a, b, c = (uv_map.points[uv_map.triangles[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None]
    light = 0.75 * toward + 0.45 * frame.axes[1] + 0.25 * frame.axes[0]
    shade = 0.4 + 0.6 * np.abs(normals @ (light / np.linalg.norm(light)))
    color = island_colors(int(uv_map.islands.max()) + 1)[uv_map.islands[face]]
    if checks:
        assert isinstance(uv_map, UvMap)
        uv = (uv_map.uvs[face] * drawn.weights[..., None]).sum(axis=2)
        odd = np.floor(uv / _check_size(uv_map)).sum(axis=2) % 2 > 0
        color = 0.4 * color + 0.6 * np.where(odd, _LIGHT, _DARK)[..., None]
    picture = np.where((drawn.triangle >= 0)[..., None], color * shade[face][..., None], 1.0)
    if not checks:
        _draw_seams(picture, uv_map, screen, drawn.depth, _SEAM if isinstance(uv_map, UvMap) else _DARK_SEAM)
    return _averaged(picture)


def _check_size(uv_map: UvMap) -> float:
    """Return the size of a checkerboard's field in the map, alike on the surface for all maps."""
    one, other = uv_map.uvs[:, 1] - uv_map.uvs[:, 0], uv_map.uvs[:, 2] - uv_map.uvs[:, 0]
    in_map = np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]).sum() / 2
    on_surface = triangle_areas(uv_map.points, uv_map.triangles).sum()
    diagonal = np.linalg.norm(np.ptp(uv_map.points, axis=0))
    return float(_CHECKS * diagonal * np.sqrt(in_map / on_surface))


def _draw_seams(picture: Floats, uv_map: UvMap | Surface, screen: Floats, depth: Floats, color: Floats) -> None:
    """Draw the seams that are not hidden into a picture."""
    pixel = _seen_pixels(uv_map.seams, screen, depth)
    for column in (-1, 0, 1):
        for row in (-1, 0, 1):
            picture[pixel[:, 1] + row, pixel[:, 0] + column] = color


def _seen_pixels(seams: Integers, screen: Floats, depth: Floats) -> Integers:
    """Return the pixels (k, 2) of even samples of the seams that are not hidden."""
    size = len(depth)
    samples = seam_samples(screen, seams, 0.6)[0]
    pixel = np.floor(samples[:, :2]).astype(np.int64)
    inside = ((pixel >= 1) & (pixel < size - 1)).all(axis=1)
    pixel, near = pixel[inside], samples[inside, 2]
    return pixel[near >= depth[pixel[:, 1], pixel[:, 0]] - 0.012 * size]


def best_view(surface: Surface, frame: Frame) -> tuple[float, float]:
    """Return the azimuth and elevation, in degrees, from which most of the seams are seen."""
    seen = {}
    for azimuth in range(0, 360, 45):
        view = (float(azimuth) + 20.0, 20.0)
        screen, _ = on_screen(surface.points, frame, view, _TRIED)
        drawn = front_view(screen, surface.triangles, _TRIED, _TRIED)
        seen[view] = len(_seen_pixels(surface.seams, screen, drawn.depth))
    return max(seen, key=lambda view: seen[view])


def draw_columns(
    file: Path,
    titles: Sequence[str],
    rows: Sequence[tuple[str, Frame, Sequence[tuple[tuple[float, float], Surface | None]]]],
    size: int,
) -> None:
    """Write a picture with a column for each title.

    Each row has a label, the model's frame, and a view and a surface for each column. A surface that is missing leaves a gap.
    """
    from matplotlib.figure import Figure  # only sheets need it

    empty = np.ones((size, size, 3))
    whole = np.vstack(
        [np.ones((_HEAD, size * len(titles), 3))]
        + [
            np.hstack([empty if shown is None else surface_picture(shown, frame, view, size) for view, shown in cells])
            for _, frame, cells in rows
        ]
    )
    height, width = whole.shape[:2]
    figure = Figure(figsize=(width / 100, height / 100), dpi=100)
    figure.figimage(whole)
    for i, title in enumerate(titles):
        figure.text((i + 0.5) / len(titles), 1 - 4 / height, title, va="top", ha="center", fontsize=10)
    for i, (label, _, _) in enumerate(rows):
        figure.text(6 / width, 1 - (_HEAD + i * size + 2) / height, label, va="top", fontsize=7)
    figure.savefig(file, dpi=100)


def layout_picture(uv_map: UvMap, size: int) -> Floats:
    """Draw the islands side by side, what an island covers twice in red: (size, size, 3), 0 to 1."""
    large = size * _SMOOTH
    beside = arranged(uv_map)
    uvs = beside.uvs - beside.uvs.min(axis=(0, 1))
    uvs = uvs * (0.97 * large / uvs.max()) + 0.015 * large
    uvs[..., 1] = large - uvs[..., 1]
    corners = np.concatenate([uvs, np.zeros((*uvs.shape[:2], 1))], axis=2).reshape(-1, 3)
    face = front_view(corners, np.arange(len(corners)).reshape(-1, 3), large, large).triangle
    island = np.where(face >= 0, uv_map.islands[np.maximum(face, 0)], -1)
    picture = np.where((face >= 0)[..., None], island_colors(int(uv_map.islands.max()) + 1)[island], 1.0)
    picture[coverage(uvs, large, large) > 1] = [1.0, 0.0, 0.0]
    outline = np.zeros_like(island, dtype=bool)
    outline[:, 1:] |= island[:, 1:] != island[:, :-1]
    outline[1:] |= island[1:] != island[:-1]
    picture[outline] *= 0.4
    return _averaged(picture)


def _averaged(picture: Floats) -> Floats:
    """Return a picture (s, s, 3) made smaller by the factor at which it was drawn."""
    size = len(picture) // _SMOOTH
    return picture.reshape(size, _SMOOTH, size, _SMOOTH, 3).mean(axis=(1, 3))


def draw_sheet(file: Path, rows: Sequence[Row], frame: Frame, size: int = 260) -> None:
    """Write a picture (PNG or JPG) with a row for each map: seams from the front and the back, a checkerboard, the islands."""
    from matplotlib.figure import Figure  # only sheets need it

    pictures = [
        np.hstack(
            [
                surface_picture(row.uv_map, frame, _FRONT, size),
                surface_picture(row.uv_map, frame, _BACK, size),
                surface_picture(row.uv_map, frame, _FRONT, size, checks=True),
                layout_picture(row.uv_map, size),
            ]
        )
        for row in rows
    ]
    whole = np.vstack(pictures)
    height, width = whole.shape[:2]
    figure = Figure(figsize=(width / 100, height / 100), dpi=100)
    figure.figimage(whole)
    for i, row in enumerate(rows):
        figure.text(6 / width, 1 - (i * size + 6) / height, row.label, va="top", fontsize=9)
    figure.savefig(file, dpi=100)
