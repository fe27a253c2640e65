# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a UV map is torn."""

from __future__ import annotations

import numpy as np
import pytest
from seamwire.core.islands.uv_islands import split_edges


@pytest.mark.parametrize("flipped", [False, True])
def test_an_edge_is_torn_where_either_end_is(flipped: bool) -> None:
    # Two squares side by side, 0 1 4 3 and 1 2 5 4; the edge 1-4 is number 1.
    second = [4, 5, 2, 1] if flipped else [1, 2, 5, 4]
    vertices = np.array([0, 1, 4, 3, *second])
    edges = np.array([0, 1, 2, 3, 4, 5, 6, 1])
    following = np.array([1, 2, 3, 0, 5, 6, 7, 4])
    places = np.array([[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1]], dtype=np.float32)
    uvs = places[vertices]
    pairs, torn = split_edges(vertices, edges, following, uvs)
    assert pairs.tolist() == [[1, 7]]
    assert torn.tolist() == [False]
    for end in (1, 4):
        moved = uvs.copy()
        moved[4 + second.index(end)] += (0.0, 0.01)
        assert split_edges(vertices, edges, following, moved)[1].tolist() == [True]
    left_out = np.where(np.arange(8) < 4, edges, -1)
    assert len(split_edges(vertices, left_out, following, uvs)[0]) == 0
