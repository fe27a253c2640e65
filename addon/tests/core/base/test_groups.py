# SPDX-License-Identifier: GPL-3.0-or-later
"""What hangs together is in one group."""

from __future__ import annotations

from itertools import pairwise

from seamwire.core.base.geometry import groups


def test_groups_are_what_keys_lead_to() -> None:
    assert groups([(0, 1), (2, 3), (1, 4), (5,), (3, 4)]) == [[0, 1, 2, 4], [3]]
    assert groups([(7, 8), (1, 2), (8, 9)]) == [[0, 2], [1]]
    assert groups([(5, 1), (1, 3), (6, 5), (2, 4), (0, 0)]) == [[0, 1, 2], [3], [4]]
    assert groups([(0,), (), (0,)]) == [[0, 2], [1]], "a thing without keys is alone"
    assert groups([]) == []


def test_a_chain_is_one_group_from_either_end() -> None:
    chain = list(pairwise(range(5_000)))
    assert groups(chain) == groups(chain[::-1]) == [list(range(4_999))]
