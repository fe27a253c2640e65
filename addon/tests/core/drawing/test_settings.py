# SPDX-License-Identifier: GPL-3.0-or-later
"""Marking and clearing, strength, metric and clamp."""

from __future__ import annotations

import pytest
from seamwire.core.sketch.picture import Intent
from seamwire.terms.choices import METRICS
from seamwire.terms.options import SETTINGS
from setting import stronger, use
from table import Table, chain, corner, courses


def test_a_clearing_wire_takes_edges_from_those_before_it() -> None:
    session = corner().session
    use(session, clear=not session.options.clear)
    session.start(2)
    session.click(9)
    assert session.wires[-1].marks is False
    assert session.edges_to_mark() == chain(0, 1, 2) + chain(9, 15, 21)
    assert session.edges_to_clear() == chain(2, 3, 9)
    use(session, clear=not session.options.clear)
    session.start(2)
    session.click(3)
    assert session.edges_to_clear() == [(3, 9)], "the later wire counts"


def test_strength_goes_in_steps_between_its_limits() -> None:
    table = Table()
    session = table.session
    assert session.picture.strength == 10.0
    stronger(session, 2)
    assert session.picture.strength == pytest.approx(15.625)
    assert table.lives["EDGES"].metrics == [("feature", 15.625, 99.0)]
    stronger(session, 50)
    assert session.picture.strength == 100.0
    assert not stronger(session, 1)
    stronger(session, -100)
    assert session.picture.strength == 1.0


def test_each_way_of_running_has_its_own_strength_and_both_the_metric() -> None:
    table = Table()
    session = table.session
    stronger(session, 1)
    use(session, metric="concave")
    use(session, along="SURFACE")
    assert session.picture.strength == 20.0
    assert table.lives["SURFACE"].metrics == [("concave", 20.0, 99.0)]
    use(session, along="EDGES")
    assert session.picture.strength == 12.5


def test_another_clamp_is_another_metric_for_both_ways() -> None:
    table = Table()
    session = table.session
    assert use(session, clamp=99.0)
    assert table.lives["EDGES"].metrics == []
    use(session, clamp=95.0)
    assert session.options.clamp == 95.0
    assert table.lives["EDGES"].metrics == [("feature", 10.0, 95.0)]
    use(session, along="SURFACE")
    assert table.lives["SURFACE"].metrics == [("feature", 20.0, 95.0)]
    use(session, clamp=200.0)
    assert session.options.clamp == 100.0


def test_while_another_strength_is_computed_the_wires_stay_to_be_seen() -> None:
    table = Table(metric_ready=(False, False))
    session = table.session
    session.click(0)
    session.hover(7)
    stronger(session, 1)
    assert session.computing
    assert session.picture.active.vertices == (0, 1, 7)
    assert session.picture.intent is Intent.KEEP
    session.click(7)
    assert session.waiting == 1
    table.compute()
    assert courses(session) == [(0, 1, 7)]
    assert session.wires[0].strength == 12.5
    assert not session.computing


def test_a_kept_wire_remembers_the_strength_it_was_drawn_with() -> None:
    session = corner().session
    stronger(session, 1)
    assert [wire.strength for wire in session.wires] == [10.0, 10.0]


def test_the_metric_stays_while_a_seed_moves() -> None:
    session = corner().session
    session.drag(3)
    stronger(session, 1)
    assert session.picture.strength == 10.0
    session.cancel()
    assert session.picture.strength == 12.5, "it is taken over when the seed is let go"


def test_the_percentile_matters_where_the_library_clamps() -> None:
    families = pytest.importorskip("seamwire_core").metric_families()
    clamped = {family.name for family in families if family.has_clamp and family.name in METRICS}
    assert {name for name in METRICS if SETTINGS["clamp"].matters("SURFACE", name)} == clamped


def test_a_chain_that_goes_on_across_the_surface_begins_at_the_vertex() -> None:
    table = corner()
    assert table.session.seed == (15, 21)
    use(table.session, along="SURFACE")
    assert table.session.seed == 21
    assert table.lives["SURFACE"].seeded == (21, False)
    use(table.session, along="EDGES")
    assert table.session.seed == (15, 21)
