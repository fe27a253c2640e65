# SPDX-License-Identifier: GPL-3.0-or-later
"""Chains and loops drawn without a hand."""

from __future__ import annotations

from seamwire.words.scripted import draw_chain, draw_loop
from table import Table


def test_drawing_a_chain_waits_for_each_wire() -> None:
    session = Table(ready=(False, False)).session
    assert draw_chain(session, [0, 2, 14]) == []
    assert draw_chain(session, [(20, 21), (23, 24)]) == []
    assert [wire.vertices for wire in session.wires] == [(0, 1, 2), (2, 8, 14), (20, 21, 22, 23, 24)]
    assert session.seed is None


def test_drawing_a_chain_goes_on_past_what_cannot_be_reached() -> None:
    session = Table(islands=(35,)).session
    assert draw_chain(session, [0, 35, 3]) == ["No wire reaches vertex 35: it is not connected to the seed"]
    assert [wire.vertices for wire in session.wires] == [(0, 1, 2, 3)]


def test_a_loop_that_is_there_already_is_said() -> None:
    session = Table().session
    assert draw_loop(session, (25, 26)) == ""
    assert draw_loop(session, (25, 26)) == "The loop through edge 25-26 is there already"
