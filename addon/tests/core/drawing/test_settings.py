# SPDX-License-Identifier: GPL-3.0-or-later
"""Marking and clearing, strength, metric and clamp."""

from __future__ import annotations

import pytest
from seamwire.core.drawing.session import Intent
from table import Table, chain, corner, courses


def test_a_clearing_wire_takes_edges_from_those_before_it() -> None:
    session = corner().session
    session.toggle_marking()
    session.start(2)
    session.click(9)
    assert session.wires[-1].marks is False
    assert session.edges_to_mark() == chain(0, 1, 2) + chain(9, 15, 21)
    assert session.edges_to_clear() == chain(2, 3, 9)
    session.toggle_marking()
    session.start(2)
    session.click(3)
    assert session.edges_to_clear() == [(3, 9)], "the later wire counts"


def test_strength_goes_in_steps_between_its_limits() -> None:
    table = Table()
    session = table.session
    assert session.strength == 10.0
    session.change_strength(2)
    assert session.strength == pytest.approx(15.625)
    assert table.lives["EDGES"].metrics == [("feature", 15.625, 99.0)]
    session.change_strength(50)
    assert session.strength == 100.0
    assert not session.change_strength(1)
    assert "most" in session.message
    session.change_strength(-100)
    assert session.strength == 1.0


def test_each_way_of_running_has_its_own_strength_and_both_the_metric() -> None:
    table = Table()
    session = table.session
    session.change_strength(1)
    session.set_metric("campen")
    session.switch("SURFACE")
    assert session.strength == 20.0
    assert table.lives["SURFACE"].metrics == [("campen", 20.0, 99.0)]
    session.switch("EDGES")
    assert session.strength == 12.5


def test_another_clamp_is_another_metric_for_both_ways() -> None:
    table = Table()
    session = table.session
    assert session.set_clamp(99.0)
    assert table.lives["EDGES"].metrics == []
    session.set_clamp(95.0)
    assert session.clamp == 95.0
    assert table.lives["EDGES"].metrics == [("feature", 10.0, 95.0)]
    session.switch("SURFACE")
    assert table.lives["SURFACE"].metrics == [("feature", 20.0, 95.0)]
    session.set_clamp(200.0)
    assert session.clamp == 100.0


def test_while_another_strength_is_computed_the_wires_stay_to_be_seen() -> None:
    table = Table(metric_ready=(False, False))
    session = table.session
    session.click(0)
    session.hover(7)
    session.change_strength(1)
    assert session.computing
    assert session.active.vertices == (0, 1, 7)
    assert session.intent is Intent.WAIT
    session.click(7)
    assert session.wires == (), "but a click waits for the new ones"
    table.compute()
    assert courses(session) == [(0, 1, 7)]
    assert session.wires[0].strength == 12.5
    assert not session.computing


def test_a_kept_wire_remembers_the_strength_it_was_drawn_with() -> None:
    session = corner().session
    session.change_strength(1)
    assert [wire.strength for wire in session.wires] == [10.0, 10.0]


def test_nothing_is_changed_about_the_metric_while_a_seed_moves() -> None:
    session = corner().session
    session.drag(3)
    assert not session.change_strength(1)
    assert session.strength == 10.0
