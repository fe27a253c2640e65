# SPDX-License-Identifier: GPL-3.0-or-later
"""The limits of the stretch that the wheel goes through."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from seamwire.core.seams.seam_plan import LIMITS, turned_limit


def test_each_notch_goes_to_the_next_limit_and_back() -> None:
    for less, more in itertools.pairwise(LIMITS):
        assert turned_limit(less, 1) == more
        assert turned_limit(more, -1) == less


@pytest.mark.parametrize(
    ("limit", "notches", "after"), [(18.0, 1, 22.0), (18.0, -1, 17.0), (0.5, -1, 0.5), (1000.0, 1, 1000.0)]
)
def test_between_and_at_the_ends(limit: float, notches: int, after: float) -> None:
    assert turned_limit(limit, notches) == after


def test_rounded_properties_count_as_the_limit() -> None:
    for limit in LIMITS[:-1]:
        assert turned_limit(float(np.float32(limit * 1.00001)), 1) > limit * 1.1
