# SPDX-License-Identifier: GPL-3.0-or-later
"""What hangs together has one number, or is in one group."""

from __future__ import annotations

import numpy as np
from seamwire.core.base.components import components, groups


def test_components_are_what_pairs_lead_to() -> None:
    found = components(7, np.array([[5, 1], [1, 3], [6, 5], [2, 4], [0, 0]]))
    assert found.tolist() == [0, 1, 2, 1, 2, 1, 1]
    assert components(3, []).tolist() == [0, 1, 2]
    chain = np.stack([np.arange(99), np.arange(1, 100)], axis=1)[::-1]
    assert not components(100, chain).any()


def test_groups_are_what_keys_lead_to() -> None:
    assert groups([(0, 1), (2, 3), (1, 4), (5,), (3, 4)]) == [[0, 1, 2, 4], [3]]
    assert groups([(7, 8), (1, 2), (8, 9)]) == [[0, 2], [1]]
    assert groups([]) == []
