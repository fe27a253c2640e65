# SPDX-License-Identifier: GPL-3.0-or-later
"""Chains of edges that fit lines drawn on a surface; what fits best is tried in native/tests/fit_chain_test.cpp."""

from __future__ import annotations

import meshes
import numpy as np
import pytest
import seamwire_core as sw


def line(count: int = 30) -> tuple[np.ndarray, np.ndarray]:
    """Return points along the row y = 0.5 of `meshes.grid(10)`, from x = 0.2 to 0.8, a little above it, and their triangles."""
    x = np.linspace(0.2, 0.8, count)
    cells = 10 * 5 + np.minimum((x * 10).astype(int), 9)
    return np.stack([x, np.full(count, 0.505), np.zeros(count)], 1), (2 * cells).astype(np.int32)


ROW = [5 * 11 + x for x in range(2, 9)]


def test_a_line_gives_its_chain_and_where_on_the_line_its_vertices_are() -> None:
    points, faces = line()
    chain = sw.fit_chain(sw.Surface(*meshes.grid(10)), points, faces)
    assert chain.vertices.tolist() == ROW
    np.testing.assert_allclose(chain.places, np.linspace(0, 29, 7), atol=1e-9)
    assert chain.vertices.dtype == np.int32
    assert not chain.vertices.flags.writeable
    assert repr(chain) == "<FittedChain: 7 vertices>"


def test_it_begins_and_ends_where_it_is_told_to() -> None:
    points, faces = line()
    chain = sw.fit_chain(sw.Surface(*meshes.grid(10)), points, faces, begin=ROW[0] - 1, end=ROW[-1] + 1)
    assert chain.vertices.tolist() == [ROW[0] - 1, *ROW, ROW[-1] + 1]


def test_a_live_wire_fits_the_same_chain() -> None:
    points, faces = line()
    live = sw.LiveWire(sw.Surface(*meshes.grid(10)), along="edges")
    live.wait()
    assert live.fit_chain(points, faces).vertices.tolist() == ROW
    assert live.fit_chain(points, faces, begin=ROW[1], end=ROW[-2]).vertices.tolist() == ROW[1:-1]


def test_a_live_wire_has_no_chain_as_long_as_its_surface_is_built() -> None:
    points, faces = line()
    live = sw.LiveWire(*meshes.grid(400), along="edges")
    faces = faces % 2
    found = live.fit_chain(points, faces).vertices.tolist()
    assert found == [] or live.surface is not None


def test_across_the_surface_there_are_no_chains() -> None:
    live = sw.LiveWire(sw.Surface(*meshes.grid(10)))
    with pytest.raises(ValueError, match="along edges, not across the surface"):
        live.fit_chain(*line())


@pytest.mark.parametrize(
    ("points", "faces", "more", "message"),
    [
        (np.zeros((2, 3)), [0], {}, "2 points, but 1 faces"),
        (np.zeros((2, 3)), [0, 200], {}, "point 1: face 200 is out of range: there are 200"),
        ([[0, 0, 0], [np.inf, 0, 0]], [0, 0], {}, "point 1 is not finite"),
        (np.zeros((2, 2)), [0, 0], {}, "points"),
        (np.zeros((2, 3)), [0, 0], {"begin": 121}, "begin"),
        (np.zeros((2, 3)), [0, 0], {"end": -1}, "end"),
    ],
)
def test_what_is_wrong_is_said(points: object, faces: object, more: dict[str, int], message: str) -> None:
    surface = sw.Surface(*meshes.grid(10))
    with pytest.raises(ValueError, match=message):
        sw.fit_chain(surface, points, faces, **more)
    live = sw.LiveWire(surface, along="edges")
    live.wait()
    with pytest.raises(ValueError, match=message):
        live.fit_chain(points, faces, **more)
