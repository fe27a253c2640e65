# SPDX-License-Identifier: GPL-3.0-or-later
"""The global optimization that our embedding is compared with: ``native/bench/global_optimization.py``."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))
from global_optimization import optimized


def test_what_a_triangle_lacks_is_spread_over_its_sides() -> None:
    edges = np.array([[0, 1], [1, 2], [0, 2]], dtype=np.int32)
    lengths = optimized(np.array([[0, 1, 2]], dtype=np.int32), edges, np.array([1.0, 1.0, 3.0]))
    # The nearest point of the plane a + b = c to (1, 1, 3); the margin is a thousandth.
    assert lengths == pytest.approx([4 / 3, 4 / 3, 8 / 3], abs=2e-3)
    assert lengths[0] + lengths[1] > lengths[2]


def test_lengths_that_make_triangles_stay() -> None:
    edges = np.array([[0, 1], [1, 2], [0, 2], [1, 3], [2, 3]], dtype=np.int32)
    lengths = np.array([3.0, 4.0, 5.0, 4.0, 5.0])
    assert optimized(np.array([[0, 1, 2], [1, 3, 2]], dtype=np.int32), edges, lengths) == pytest.approx(
        lengths, abs=1e-4
    )
