# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables with a row for every action, or for every kind of loop."""

from __future__ import annotations

from typing import get_args

from seamwire.core.network.wires import LoopKind
from seamwire.words.keys import NUMBERS, Action
from seamwire.words.names import LOOP_NAMES


def test_each_action_has_a_number() -> None:
    assert set(NUMBERS) == set(Action)
    assert len(set(NUMBERS.values())) == len(NUMBERS)


def test_each_loop_has_a_name() -> None:
    assert set(LOOP_NAMES) == set(get_args(LoopKind))
