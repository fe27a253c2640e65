# SPDX-License-Identifier: GPL-3.0-or-later
"""Ridges and valleys, and what is near to them."""

from __future__ import annotations

import numpy as np
import pytest
from seamwire.core.network.picks import FacePoint
from seamwire.core.offers.crests import Crests

sw = pytest.importorskip("seamwire_core")


def waves(n: int = 40) -> tuple[np.ndarray, np.ndarray]:
    """Return the vertices and triangles of a sheet with a top at x = .5 and bottoms at .25 and .75."""
    x, y = (part.ravel() for part in np.meshgrid(np.arange(n + 1), np.arange(n + 1)))
    points = np.stack([x / n, y / n, 0.04 * np.cos(4 * np.pi * x / n)], axis=1)
    i, j = (part.ravel() for part in np.meshgrid(np.arange(n), np.arange(n)))
    a, b, c, d = j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i, (j + 1) * (n + 1) + i + 1
    return points, np.stack([a, b, d, a, d, c], axis=1).reshape(-1, 3)


@pytest.fixture(scope="module")
def crests() -> Crests:
    return Crests.on(sw, sw.Surface(*waves()))


def line_near(crests: Crests, x: float) -> int:
    """Return the line that runs at some x."""
    middles = [crests.line(number)[0][:, 0].mean() for number in range(len(crests))]
    (found,) = np.flatnonzero(np.abs(np.array(middles) - x) < 0.02)
    return int(found)


def test_tops_are_ridges_and_bottoms_valleys(crests: Crests) -> None:
    assert crests.ridges[line_near(crests, 0.5)]
    assert not crests.ridges[line_near(crests, 0.25)]
    assert not crests.ridges[line_near(crests, 0.75)]


def test_pieces_are_those_of_lines_and_of_no_two(crests: Crests) -> None:
    assert len(crests.pieces) == len(crests.points) - len(crests)
    assert np.linalg.norm(np.diff(crests.segments, axis=1), axis=2).max() < 0.06
    for number in range(len(crests)):
        points, triangles = crests.line(number)
        assert len(points) == len(triangles)
        mesh, faces = waves()
        corners = mesh[faces[triangles]]
        assert (points >= corners.min(axis=1) - 1e-9).all()
        assert (points <= corners.max(axis=1) + 1e-9).all()


def test_the_line_at_a_pick_is_the_one_that_crosses_there(crests: Crests) -> None:
    line = line_near(crests, 0.5)
    mine = slice(crests.starts[line] + 5, crests.starts[line + 1] - 5)
    for (a, b), face in zip(crests.edges[mine].tolist(), crests.faces[mine].tolist(), strict=True):
        assert crests.line_at((a, b)) == crests.line_at((b, a)) == line
        assert crests.line_at(a) == line
        assert crests.line_at(FacePoint(face, (0, 1, 2), (1.0, 0.0, 0.0))) == line
    # The middle between top and bottom has no crest.
    assert crests.line_at(20 * 41 + 15) is None
    assert crests.line_at((20 * 41 + 15, 20 * 41 + 16)) is None


def crossed() -> Crests:
    """Return two lines that pass one vertex, 5, the second a valley."""
    return Crests(
        points=np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [0, 2, 0]]),
        edges=np.array([[4, 5], [5, 6], [6, 7], [5, 8], [8, 9]], dtype=np.int32),
        t=np.array([0.9, 0.1, 0.4, 0.0, 1.0]),
        faces=np.array([0, 1, -1, 2, -1], dtype=np.int32),
        curvatures=np.array([2.0, 2.0, 2.0, -1.0, -1.0]),
        starts=np.array([0, 3, 5], dtype=np.int32),
        strengths=np.array([4.0, 1.5]),
    )


def test_where_lines_pass_one_vertex_the_stronger_counts() -> None:
    assert crossed().line_at(5) == 0


def test_an_edge_that_only_leads_away_from_a_line_has_none() -> None:
    # 5 and 6 lie beside the ridge, 9 beside the valley, and 10 beside neither.
    assert crossed().line_at((6, 5)) == 0
    assert crossed().line_at((9, 5)) == 1
    assert crossed().line_at((6, 9)) is None
    assert crossed().line_at((5, 10)) is None
