# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the card of first steps."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from ..words import card as words
from . import gpu_draw
from .card_layout import Box, Card, laid_out
from .overlay import free_room

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from .card_layout import Part
    from .theme import Color

_GROUND: Color = (0.09, 0.09, 0.10, 0.94)
_RIM: Color = (0.36, 0.36, 0.39, 1.0)
_TEXT: Color = (0.90, 0.90, 0.90, 1.0)
_TITLE: Color = (1.0, 1.0, 1.0, 1.0)
_QUIET: Color = (0.62, 0.62, 0.65, 1.0)
_LINK: Color = (0.45, 0.72, 1.0, 1.0)
_LIT: Color = (0.26, 0.26, 0.29, 1.0)
_ACCENT: Color = (1.0, 0.72, 0.05, 1.0)
_LOOP: Color = (0.30, 1.0, 0.55, 1.0)
_BAND: Color = (0.12, 0.62, 0.50, 1.0)
_CAP: Color = (0.82, 0.82, 0.84, 1.0)
_CAP_TEXT: Color = (0.08, 0.08, 0.09, 1.0)


def placed(area: bpy.types.Area, region: bpy.types.Region) -> Card | None:
    """Return the card in a region of a 3D view; None if there is no room for it."""
    room = free_room(area, region)
    size = gpu_draw.text_size(bpy.context.preferences.system.ui_scale)
    link = words.LINK if words.guide() else ""
    return laid_out(words.TITLE, words.STEPS, link, room, size, _measure)


def _measure(text: str, size: float) -> float:
    gpu_draw.set_text(size)
    return gpu_draw.text_width(text)


def draw(card: Card, lit: Part | None) -> None:
    """Draw the card; `lit` is the part under the mouse."""
    size, box = card.size, card.box
    with gpu_draw.blended("NONE"):
        edge = max(1.0, 0.09 * size)
        _fill(
            Box(box.left - edge, box.bottom - edge, box.width + 2.0 * edge, box.height + 2.0 * edge), _RIM, 0.6 * size
        )
        _fill(box, (*_GROUND[:3], 1.0), 0.55 * size)
        _draw_close(card.close, size, lit == "CLOSE")
        for row in card.rows:
            _ICONS[row.icon](row.box, size)
        gpu_draw.set_text(1.1 * size)
        gpu_draw.draw_text(card.title[0], card.title[1:], _TITLE, shadow=False)
        gpu_draw.set_text(size)
        for row in card.rows:
            for text, x, y in row.lines:
                gpu_draw.draw_text(text, (x, y), _TEXT, shadow=False)
        if card.link is not None:
            _draw_link(card.link, size, lit == "LINK")


def _draw_close(box: Box, size: float, is_lit: bool) -> None:
    if is_lit:
        _fill(box, _LIT, 0.4 * size)
    x, y, arm = box.left + 0.5 * box.width, box.bottom + 0.5 * box.height, 0.36 * size
    for way in (1.0, -1.0):
        _line([(x - arm, y - way * arm), (x + arm, y + way * arm)], _TITLE if is_lit else _QUIET, 0.13 * size)


def _draw_link(box: Box, size: float, is_lit: bool) -> None:
    if is_lit:
        _fill(box, _LIT, 0.4 * size)
    x, y = box.left + 0.5 * size, box.bottom + 0.5 * size
    gpu_draw.draw_text(words.LINK, (x, y), _LINK, shadow=False)
    width = gpu_draw.text_width(words.LINK)
    _line([(x, y - 0.22 * size), (x + width, y - 0.22 * size)], _LINK, 0.08 * size)


# Icons


def _click(box: Box, size: float) -> None:
    _mouse(box.left + 0.75 * size, box, size)


def _drag(box: Box, size: float) -> None:
    _mouse(box.left + 0.75 * size, box, size)
    _ribbon(_wave(box, box.left + 2.0 * size, box.left + 4.9 * size), _ACCENT, 0.16 * size)


def _alt(box: Box, size: float) -> None:
    end = _cap("Alt", box, size)
    x, y = end + 0.5 * (box.right - end) + 0.1 * size, box.bottom + 0.5 * box.height
    turn = np.linspace(0.0, 2.0 * np.pi, 33)
    loop = np.stack([x + 0.95 * size * np.cos(turn), y + 0.5 * size * np.sin(turn)], axis=1)
    _ribbon(loop, _LOOP, 0.16 * size, is_closed=True)


def _shift(box: Box, size: float) -> None:
    end = _cap("Shift", box, size)
    _ribbon(_wave(box, end + 0.5 * size, box.right + 0.2 * size), _BAND, 0.55 * size)


_ICONS = {"CLICK": _click, "DRAG": _drag, "ALT": _alt, "SHIFT": _shift}


def _mouse(x: float, box: Box, size: float) -> None:
    """Draw a mouse with its left button pressed."""
    y, half, high = box.bottom + 0.5 * box.height, 0.55 * size, 0.85 * size
    _fill(Box(x - half, y - high, 2.0 * half, 2.0 * high), _CAP, half)
    rim = 0.12 * size
    _fill(Box(x - half + rim, y - high + rim, 2.0 * (half - rim), 2.0 * (high - rim)), _GROUND, half - rim)
    _fill(Box(x - half + rim, y + 0.1 * size, half - 1.5 * rim, high - 0.1 * size - 1.2 * rim), _ACCENT, 0.22 * size)
    _line([(x - half, y), (x + half, y)], _CAP, 0.1 * size)
    _line([(x, y), (x, y + high)], _CAP, 0.1 * size)


def _cap(text: str, box: Box, size: float) -> float:
    """Draw a key with its name, and return where its right side is."""
    small = 0.85 * size
    width, height = _measure(text, small) + 0.9 * size, 1.5 * size
    bottom = box.bottom + 0.5 * (box.height - height)
    _fill(Box(box.left, bottom, width, height), _QUIET, 0.35 * size)
    _fill(Box(box.left, bottom + 0.16 * size, width, height - 0.16 * size), _CAP, 0.35 * size)
    gpu_draw.set_text(small)
    gpu_draw.draw_text(text, (box.left + 0.45 * size, bottom + 0.55 * size), _CAP_TEXT, shadow=False)
    return box.left + width


def _wave(box: Box, left: float, right: float) -> ArrayLike:
    x = np.linspace(left, right, 25)
    y = box.bottom + 0.5 * box.height + 0.22 * box.height * np.sin((x - left) / (right - left) * 2.0 * np.pi)
    return np.stack([x, y], axis=1)


def _fill(box: Box, color: Color, round_by: float) -> None:
    gpu_draw.draw_rectangle((box.left, box.bottom), (box.right, box.top), color, round_by)


def _ribbon(points: ArrayLike, color: Color, width: float, is_closed: bool = False) -> None:
    """Draw a smooth curve as one surface with a soft rim: pieces of a line would overlap where they meet."""
    middle = np.asarray(points, dtype=np.float64)
    if is_closed:
        around = np.concatenate([middle[-2:-1], middle, middle[1:2]])
        along = around[2:] - around[:-2]
    else:
        along = np.gradient(middle, axis=0)
    normals = np.stack([-along[:, 1], along[:, 0]], axis=1) / np.linalg.norm(along, axis=1, keepdims=True)
    sides = [middle + 0.5 * width * normals, middle - 0.5 * width * normals]
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    shader.bind()
    shader.uniform_float("color", color)
    strip = np.stack(sides, axis=1).reshape(-1, 2).astype(np.float32)
    batch_for_shader(shader, "TRI_STRIP", {"pos": strip}).draw(shader)
    for side in sides:
        _line(side, color, 1.0)


def _line(points: ArrayLike, color: Color, width: float) -> None:
    flat = np.asarray(points, dtype=np.float32)
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    shader.bind()
    shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
    shader.uniform_float("lineWidth", max(1.0, width))
    shader.uniform_float("color", color)
    places = np.concatenate([flat, np.zeros((len(flat), 1), dtype=np.float32)], axis=1)
    batch_for_shader(shader, "LINE_STRIP", {"pos": places}).draw(shader)
