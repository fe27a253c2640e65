# SPDX-License-Identifier: GPL-3.0-or-later
"""Scribbles through the module: what they change, and what is refused."""

from __future__ import annotations

import meshes
import numpy as np
import pytest
import seamwire_core as sw


@pytest.fixture(scope="module")
def flat() -> tuple[sw.Surface, sw.Metric]:
    surface = sw.Surface(*meshes.grid(30))
    return surface, sw.euclidean_metric(surface, sw.principal_curvatures(surface))


def half_circle(**options: object) -> sw.Scribble:
    """Return one of twelve cells' radius about the middle of the tenth row, at the vertices nearest to it."""
    angle = np.linspace(np.pi, 0, 60)
    points = np.stack([0.5 + 0.4 * np.cos(angle), 1 / 3 + 0.4 * np.sin(angle), 0 * angle], 1)
    column, row = np.rint(points[:, 0] * 30).astype(int), np.rint(points[:, 1] * 30).astype(int)
    return sw.Scribble(points, vertices=row * 31 + column, **options)


def wire(surface: sw.Surface, metric: sw.Metric) -> sw.Wire:
    return sw.distance_field(sw.embed(surface, metric, max_error=0), 10 * 31 + 3).trace(10 * 31 + 27)


def test_a_wire_follows_a_scribble(flat: tuple[sw.Surface, sw.Metric]) -> None:
    surface, metric = flat
    changed = sw.apply_scribbles(surface, metric, [half_circle()])
    off = np.abs(np.hypot(*(wire(surface, changed).points - [0.5, 1 / 3, 0]).T[:2]) - 0.4) * 30
    assert off.max() < 0.3
    assert changed.max_anisotropy == pytest.approx(20)
    straight = wire(surface, metric).points
    assert np.ptp(straight[:, 1]) < 1e-9


def test_without_scribbles_the_metric_is_the_former_one(flat: tuple[sw.Surface, sw.Metric]) -> None:
    surface, metric = flat
    assert np.array_equal(sw.apply_scribbles(surface, metric, []).tensors, metric.tensors)
    meant_for_max = [half_circle(acts_on="max")]
    assert np.array_equal(sw.apply_scribbles(surface, metric, meant_for_max, follow="min").tensors, metric.tensors)
    assert not np.array_equal(sw.apply_scribbles(surface, metric, meant_for_max, "max").tensors, metric.tensors)


def test_a_scribble_tells_what_it_is() -> None:
    scribble = half_circle(eta=5, rings=3, radius=0.25, attracts=False, acts_on="max")
    assert (scribble.eta, scribble.rings, scribble.radius) == (5, 3, 0.25)
    assert (scribble.attracts, scribble.acts_on) == (False, "max")
    assert scribble.points.shape == (60, 3)
    assert scribble.vertices.shape == (60,)
    assert scribble.faces.size == 0
    assert repr(scribble) == "<Scribble: 60 points, repels>"
    assert half_circle().radius is None


WRONG = [
    ({"points": [[0.1, 0.1]], "faces": [0]}, "points"),
    ({"points": [[0.1, 0.1, 0]], "faces": [[0]]}, "faces"),
    ({"points": [[0.1, 0.1, 0]], "faces": [0.5]}, "faces"),
    ({"points": [[0.1, 0.1, 0]], "vertices": ["a"]}, "vertices"),
    ({"points": [[0.1, 0.1, 0]], "faces": [0], "acts_on": "none"}, "acts_on"),
    ({"points": [[0.01, 0.01, 0], [0.5, 0.5, 0]], "faces": [0, 0]}, "point 1 of scribble 0"),
    ({"points": [[0.01, 0.01, 0]], "faces": [-1]}, "point 0 of scribble 0"),
    ({"points": [[0.01, 0.01, 0]], "faces": [1800]}, "face 1800"),
    ({"points": [[0.01, 0.01, 0]], "faces": [0], "eta": 0}, "eta"),
    ({"points": [[0.01, 0.01, 0]], "faces": [0], "rings": 0}, "rings"),
    ({"points": [[0.01, 0.01, 0]], "faces": [0], "radius": -1}, "radius"),
]


@pytest.mark.parametrize(("arguments", "words"), WRONG, ids=[words for _, words in WRONG])
def test_what_is_wrong_is_said(arguments: dict, words: str, flat: tuple[sw.Surface, sw.Metric]) -> None:
    with pytest.raises(ValueError, match=words):
        sw.apply_scribbles(*flat, [sw.Scribble(**arguments)])
    with pytest.raises(ValueError, match="follow"):
        sw.apply_scribbles(*flat, [], follow="both")
