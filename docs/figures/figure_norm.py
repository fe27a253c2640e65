# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 2 of the paper: an isotropic and an anisotropic norm at a point."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from figure_sheet import Panel, font, sheet
from figure_stage import INK
from figure_studio import RIDGE, VALLEY
from PIL import Image, ImageDraw

if TYPE_CHECKING:
    from collections.abc import Sequence

    from figure_studio import Studio
    from numpy.typing import NDArray

PLACE = (0.98, 0.30, 0.43)
"""On a ridge of rocker-arm, in its box."""
ROUND, LONG = (0.45, 0.45, 0.48), (0.12, 0.30, 0.90)
_FINE = 2
"""Plots are drawn so many times larger, then reduced."""


def norm_at_a_point(studio: Studio) -> Image.Image:
    """Figure 2: unit balls of both norms on the surface and in the tangent plane, and the norm of unit vectors."""
    model = studio.model("rocker-arm")
    vertex = model.vertex_at(*PLACE)
    metric = model.metric("feature", max_anisotropy=20.0)
    place, normal = model.points[vertex], metric.normals[vertex]
    # Vectors of norm 1 reach 1 / sqrt(l): far along e2, where l is small.
    reach = metric.ellipses("reach")[vertex]
    far, near = np.linalg.norm(reach, axis=1)
    e2, e1 = reach[0] / far, reach[1] / near
    size = 0.03 * model.size
    stage = studio.stage(model, 3, 1.0)
    circle = size * np.stack([e2, e1])
    for axes, color, lift in ((size * np.stack([far * e2, near * e1]), LONG, 0.012), (circle, ROUND, 0.010)):
        stage.ellipses(place[None], normal[None], axes[None], np.array([color]), lift)
    raised = place + 0.014 * model.size * normal
    for axis, length, color in ((e2, far, VALLEY), (e1, max(near, 1.0), RIDGE)):
        stage.line(raised + size * length * 1.25 * np.array([-1.0, 1.0])[:, None] * axis, color, 0.003)
    stage.turn_to(normal)
    stage.look_at(place, 4.0)
    side = studio.render(stage).shape[0]
    panels = [Panel(studio.render(stage), "a point of a ridge")]
    panels.append(Panel(_balls(side, far, near), "unit balls: g(v) = 1"))
    panels.append(Panel(_over_angle(side, far, near), "g(v) of unit vectors"))
    return sheet([panels])


class _Plot:
    """A square plot with its own units."""

    def __init__(self, side: int, low: tuple[float, float], high: tuple[float, float]) -> None:
        self._side, self._low = _FINE * side, np.array(low)
        self._scale = self._side / (np.array(high) - self._low)
        self.image = Image.new("RGB", (self._side, self._side), "white")
        self.draw = ImageDraw.Draw(self.image)

    def _at(self, points: NDArray[np.float64]) -> list[tuple[float, float]]:
        x, y = ((np.atleast_2d(points) - self._low) * self._scale).T
        return list(zip(x.tolist(), (self._side - y).tolist(), strict=True))

    def line(self, points: NDArray[np.float64], color: Sequence[float], width: int = 4) -> None:
        """Draw a curve, (n, 2)."""
        self.draw.line(self._at(points), _rgb(color), _FINE * width, joint="curve")

    def arrow(self, end: NDArray[np.float64], color: Sequence[float]) -> None:
        """Draw an arrow from the origin, in plots with equal units."""
        along = end / np.linalg.norm(end)
        side, head = np.array([-along[1], along[0]]), 16 * _FINE / self._scale[0]
        self.line(np.array([[0.0, 0.0], end - 0.8 * head * along]), color)
        tip = np.array([end, end - head * along + 0.4 * head * side, end - head * along - 0.4 * head * side])
        self.draw.polygon(self._at(tip), _rgb(color))

    def text(self, place: tuple[float, float], text: str, color: Sequence[float] = INK, anchor: str = "mm") -> None:
        """Write at a place."""
        self.draw.text(self._at(np.array(place))[0], text, _rgb(color), font(30 * _FINE), anchor=anchor)

    def picture(self) -> NDArray[np.float64]:
        """Return it in its final size."""
        return np.asarray(self.image.reduce(_FINE)) / 255.0


def _rgb(color: Sequence[float]) -> tuple[int, ...]:
    return tuple(round(255 * part) for part in color)


def _balls(side: int, far: float, near: float) -> NDArray[np.float64]:
    """Draw the vectors of norm 1 in the tangent plane, e2 to the right."""
    reach = 1.35 * far
    plot = _Plot(side, (-reach, -reach), (reach, reach))
    angle = np.linspace(0.0, 2.0 * np.pi, 721)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    plot.line(circle, ROUND)
    plot.line(circle * (far, near), LONG, 6)
    plot.arrow(np.array([far, 0.0]), VALLEY)
    plot.arrow(np.array([0.0, near]), RIDGE)
    turn = 0.6
    plot.arrow(np.array([np.cos(turn), np.sin(turn)]), INK)
    plot.text((np.cos(turn) * 1.15, np.sin(turn) * 1.2), "v")
    plot.text((0.0, 1.22), "Euclidean: radius 1", ROUND)
    plot.text((0.7 * far, -0.09 * reach), "e₂", VALLEY)
    plot.text((0.08 * reach, 0.5 * near), "e₁", RIDGE)
    below = (
        (f"along e₁: 1/√λ₁ = {near:.2f}", RIDGE),
        (f"along e₂: 1/√λ₂ = {far:.2f}", VALLEY),
        (f"anisotropy √(λ₁/λ₂) = {far / near:.1f}", LONG),
    )
    for i, (text, color) in enumerate(below):
        plot.text((0.0, -(0.62 + 0.12 * i) * reach), text, color)
    return plot.picture()


def _over_angle(side: int, far: float, near: float) -> NDArray[np.float64]:
    """Draw eq. 2 over the angle between v and e1."""
    most = 1.0 / near
    plot = _Plot(side, (-32.0, -0.2 * most), (205.0, 1.15 * most))
    angle = np.linspace(0.0, 180.0, 361)
    turn = np.radians(angle)
    norm = np.sqrt((np.cos(turn) / near) ** 2 + (np.sin(turn) / far) ** 2)
    plot.line(np.array([[0.0, 1.1 * most], [0.0, 0.0], [183.0, 0.0]]), INK, 3)
    plot.line(np.stack([angle, np.ones_like(angle)], axis=1), ROUND)
    plot.line(np.stack([angle, norm], axis=1), LONG, 6)
    for tick in (0, 90, 180):
        plot.text((tick, -0.06 * most), f"{tick}°")
    plot.text((90.0, -0.15 * most), "angle θ between v and e₁")
    for value, name in ((most, "√λ₁"), (1.0 / far, "√λ₂"), (1.0, "1")):
        plot.text((-4.0, value), name, anchor="rm")
    plot.text((90.0, 1.0 + 0.06 * most), "Euclidean", ROUND)
    plot.text((90.0, 0.75 * most), "ours", LONG)
    return plot.picture()
