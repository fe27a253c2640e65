# SPDX-License-Identifier: GPL-3.0-or-later
"""How wires, seeds and islands look: one table, made from the theme and the add-on's preferences. And colors for numbers."""

from __future__ import annotations

import colorsys
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from ..core.islands.islands import HUES, PLACES

if TYPE_CHECKING:
    import bpy
    from numpy.typing import ArrayLike, NDArray

Color = tuple[float, float, float, float]

HALO: Color = (0.02, 0.02, 0.03, 0.75)
"""The dark rim around lines and dots: what keeps them apart from bright meshes and from each other."""
_BRIGHTNESS = 0.5
"""Of the islands' colors."""
ColorMap = tuple[tuple[float, float, float], ...]
"""A few published colors at equal distances, with straight ways in between."""
STRETCH: ColorMap = (
    (0.13, 0.22, 0.78),
    (0.10, 0.66, 0.86),
    (0.30, 0.76, 0.32),
    (0.98, 0.86, 0.16),
    (0.74, 0.04, 0.12),
)
"""From blue to red, as the stretch of UV maps is shown elsewhere. Yellow is the lightest: where it turns to red is seen without
color too. The red is darker than that of seams, which are seen on it."""


def colors(parts: ArrayLike, of: ColorMap) -> NDArray[np.float64]:
    """Return the colors, (..., 3), at parts of a map, from 0 to 1; what is below 0 or above 1 has the color of the end."""
    parts = np.asarray(parts, dtype=np.float64)
    at = np.linspace(0.0, 1.0, len(of))
    return np.stack([np.interp(parts, at, column) for column in zip(*of, strict=True)], axis=-1)


def steps(of: ColorMap, count: int, opacity: float = 1.0) -> list[Color]:
    return [(r, g, b, opacity) for r, g, b in colors(np.linspace(0.0, 1.0, count), of).tolist()]


@dataclass(frozen=True)
class Style:
    """How a line or a dot looks; sizes in pixels at a display scale of 1."""

    color: Color  # red, green, blue, opacity
    width: float
    halo: float = 0.0  # how much wider the dark rim is
    hidden: float = 0.25  # how much of the opacity is left where the mesh lies before it
    lift: float = 4.0  # by how many pixels it is drawn before the surface
    dash: float = 0.0  # the length of a dash and of the gap after it; 0: a plain line
    ring: tuple[float, Color] | None = None  # of this width and color around a dot, inside the rim
    soft: bool = False  # whether it is a band that fades towards its sides


class Looks:
    """The styles of all that the overlay draws: the color of `kept` wires, and values of the preferences."""

    def __init__(
        self, kept: Color = (1.0, 0.2, 0.1, 1.0), line_width: float = 1.0, tint: float = 0.22, text: str = "INFORMATION"
    ) -> None:
        active, other, loop = (1.0, 0.72, 0.05, 1.0), (0.45, 0.8, 1.0, 0.9), (0.3, 1.0, 0.55, 1.0)
        clear, white = (0.82, 0.86, 0.95, 1.0), (1.0, 1.0, 1.0, 1.0)
        will_mark = tuple(0.75 * a + 0.25 * b for a, b in zip(kept, active, strict=True))
        attracts, repels = (0.15, 0.95, 0.75, 1.0), (1.0, 0.3, 0.75, 1.0)
        self.active = Style(active, 5.0, halo=2.5, lift=6.0)
        # The wire that is still being computed: paler than what a click would keep.
        self.computing = Style(faint(active, 0.45), 5.0, halo=1.5, hidden=0.15, lift=6.0)
        self.other = Style(other, 2.0, halo=2.0, hidden=0.15, lift=5.0)
        self.kept = Style(kept, 3.5, halo=2.0)
        # Edges that will become seams, where the wire itself runs beside them.
        self.marked = Style(faint(kept, 0.9), 2.5, halo=1.0, hidden=0.15, lift=3.0)
        # Edges that the live wire will make seams.
        self.will_mark = Style(faint(will_mark, 0.9), 2.5, halo=1.0, hidden=0.15, lift=3.0)
        # Wires and edges that will cease to be seams.
        self.clear = Style(clear, 3.5, halo=2.0, dash=7.0, lift=5.0)
        self.mirrored = Style(faint(kept, 0.8), 2.0, halo=1.5, hidden=0.2, lift=3.5)
        # The line that the hand draws. Wires that follow it look like live wires.
        self.line = Style(faint(white, 0.45), 1.5, hidden=0.4, lift=8.0)
        self.mirrored_live = Style(faint(active, 0.95), 3.5, halo=2.0, hidden=0.2, lift=5.0)
        # Laid under a kept wire that is pointed at.
        self.hovered = Style(white, 9.5, halo=2.0, hidden=0.15, lift=3.0)
        self.loop = Style(loop, 3.5, halo=2.5, lift=6.0)
        self.end = Style(faint(active, 0.9), 3.0, halo=2.0, dash=9.0, lift=6.0)
        # The edge under the cursor.
        self.target = Style(white, 3.0, halo=2.0, lift=7.0)
        self.seed = Style(white, 9.0, halo=3.5, hidden=0.12, lift=10.0)
        self.live_seed = Style(white, 7.0, halo=3.0, hidden=0.35, lift=10.0, ring=(3.5, active))
        self.hovered_seed = Style(white, 12.0, halo=3.5, hidden=0.35, lift=11.0, ring=(4.0, active))
        self.closing = Style(white, 9.0, halo=3.5, hidden=0.35, lift=11.0, ring=(5.5, loop))
        # The vertex under the cursor; the next two where it lies on a wire or a seam, and on a feature.
        self.dot = Style(white, 7.0, halo=3.0, lift=11.0)
        self.dot_on_seam = Style(white, 7.0, halo=3.0, lift=11.0, ring=(5.0, kept))
        self.dot_on_feature = Style(white, 5.0, halo=3.0, lift=11.0, ring=(6.0, other))
        # The band of a stroke that wires follow.
        self.attracting = Style(faint(attracts, 0.4), 16.0, hidden=0.2, lift=8.0, soft=True)
        # The band of one that they keep from: in cross bars, not in its color alone.
        self.repelling = Style(faint(repels, 0.5), 16.0, hidden=0.2, lift=8.0, dash=5.0, soft=True)
        # From the end of a seam to what it nearly meets.
        self.gap = Style(faint(kept, 0.9), 2.5, halo=1.5, hidden=0.15, dash=4.0, lift=5.0)
        # Where it ends: larger than a seed, which is drawn over it.
        self.open_end = Style(kept, 14.0, halo=2.5, hidden=0.3, lift=9.0)
        self.tint, self.text = tint, text
        dots = {"seed", "live_seed", "hovered_seed", "closing", "open_end"}
        for name, style in vars(self).items():
            if isinstance(style, Style):
                # Dots grow half as fast as lines.
                by = 0.5 * (1.0 + line_width) if name in dots or name.startswith("dot") else line_width
                setattr(self, name, replace(style, width=style.width * by))


_looks = lru_cache(maxsize=2)(Looks)


def looks_of(theme: bpy.types.ThemeView3D, preferences: object | None = None) -> Looks:
    """Return the styles for the theme of the 3D view and the add-on's preferences, the same object until one of them changes."""
    # Blender 5 has shortened the name.
    seam = theme.seam if hasattr(theme, "seam") else theme.edge_seam
    hue, saturation, value = colorsys.rgb_to_hsv(*seam[:3])
    # As bright as it can be in its hue: on a surface thin lines look darker than they are.
    kept = (*colorsys.hsv_to_rgb(hue, min(saturation, 0.85), 1.0 if saturation > 0.1 else value), 1.0)
    names = ("line_width", "tint", "text")
    return _looks(kept, **{name: getattr(preferences, name) for name in names if hasattr(preferences, name)})


def faint(color: Color, opacity: float) -> Color:
    return (*color[:3], color[3] * opacity)


def hue_colors(opacity: float) -> list[Color]:
    """Return the islands' colors, each far from the next in hue, without red and orange, which are left to wires and seams."""
    hues = np.linspace(0.24, 0.88, HUES)
    return [(*_light(float(hues[place])), opacity) for place in PLACES]


def _light(hue: float) -> tuple[float, float, float]:
    """Return a hue as bright as the others: blue in full would make a mesh dark, and its edges colored."""
    rgb = np.array(colorsys.hsv_to_rgb(hue, 0.85, 1.0))
    brightness = float(rgb @ (0.2126, 0.7152, 0.0722))
    white = max(0.0, (_BRIGHTNESS - brightness) / (1.0 - brightness))
    red, green, blue = ((rgb + white * (1.0 - rgb)) * min(1.0, _BRIGHTNESS / brightness)).tolist()
    return red, green, blue
