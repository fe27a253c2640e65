# SPDX-License-Identifier: GPL-3.0-or-later
"""Islands of polygon meshes: their colors, changes, faults, copies and places in a UV map."""

from __future__ import annotations

import numpy as np
import pytest
import seamwire_core as sw

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


def test_new_islands_are_placed_beside_what_stays() -> None:
    before = np.concatenate([0.25 * SQUARE + (0.5, 0.25), 0.25 * SQUARE + (0.5, 0.25)])
    after = np.concatenate([3.0 * SQUARE, SQUARE])
    triangles = [(0, 1, 2), (0, 2, 3), (4, 5, 6), (4, 6, 7)]
    islands = [0, 0, 2, 2]
    placements = sw.place_islands(
        before, after, triangles, islands, [0.0625, 0.0, 0.0625], taken=[(0, 0, 0.1, 1)], straight=[True, False, False]
    )
    assert placements.shape == (3, 2, 3)
    assert (placements[1] == 0.0).all()
    first = after[:4] @ placements[0, :, :2].T + placements[0, :, 2]
    second = after[4:] @ placements[2, :, :2].T + placements[2, :, 2]
    assert np.ptp(first, axis=0) == pytest.approx(0.25)
    assert first == pytest.approx(before[:4], abs=2.0 / 512)
    assert (second.min(axis=0) > first.max(axis=0)).any() or (second.max(axis=0) < first.min(axis=0)).any()


def test_a_new_island_without_a_finite_place_is_refused() -> None:
    with pytest.raises(ValueError, match="corner 2 has no finite UV"):
        sw.place_islands(SQUARE[:3], [(0, 0), (1, 0), (1, np.nan)], [(0, 1, 2)], [0], [1.0])
    with pytest.raises(ValueError, match="straight: expected booleans"):
        sw.place_islands(SQUARE[:3], SQUARE[:3], [(0, 1, 2)], [0], [1.0], straight=[1])
