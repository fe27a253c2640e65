# SPDX-License-Identifier: GPL-3.0-or-later
"""The steps that undo and redo go back and forth."""

from __future__ import annotations

from seamwire.core.network.network import History, Network
from table import wire

EMPTY = Network()
ONE = Network((wire(0, 1),))


def test_a_step_that_changed_nothing_is_passed_over() -> None:
    history = History()
    history.step(EMPTY)
    history.step(ONE)
    assert history.back(ONE) == EMPTY
    history.forget()
    history.step(ONE)
    assert not history.can_undo(ONE)


def test_a_new_step_ends_what_was_taken_back() -> None:
    history = History()
    history.step(EMPTY)
    history.back(ONE)
    assert history.can_redo
    history.step(EMPTY)
    assert not history.can_redo
