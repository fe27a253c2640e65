# SPDX-License-Identifier: GPL-3.0-or-later
"""What of closed cuts outlives a session: on a mesh that was cut they are bent all the same."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from fake_live import FakeCuts, FakeLive
from seamwire.core.network.drawn import Drawn
from seamwire.core.network.wires import Wire
from seamwire.core.offers import surface_loops
from seamwire.core.offers.surface_loops import CutMemory, is_same
from seamwire.core.sketch.sketch import Sketch
from seamwire.core.storage.serialization import Places
from table import Table

SCALE = np.diag([2.0, 1.0, 1.0])


def taken(left: bool = False) -> Sketch:
    session = Table("SURFACE").session
    session.hover(8, loop=True)
    if left:
        session.next_candidate()
    session.click(8)
    return session


def as_cut(session: Sketch) -> list[Wire]:
    """The wires as they are along edges, of which one seed has gone, with the numbers under which a mesh knows them."""
    first, second, third = session.wires
    middle = (*first.vertices, *second.vertices[1:])
    ways = [(middle, np.vstack([first.points, second.points[1:]])), (third.vertices[::-1], third.points[::-1])]
    return [
        Wire("EDGES", way, points, way[0], way[-1], finish="CUT", stored=10 + number)
        for number, (way, points) in enumerate(ways)
    ]


def after_cutting(session: Sketch, wires: list[Wire]) -> Table:
    """A new session on a mesh that was cut, and that has these wires then."""
    it = Table("SURFACE")
    places = Places(it.points, SCALE)
    memory = CutMemory()
    cuts = [cut.of(Drawn(tuple(wires))) for cut in session.offering.cuts.taken(session.drawn)]
    memory.keep([cut for cut in cuts if cut is not None], Drawn(tuple(wires)), places)
    it.session.adopt(Drawn(tuple(replace(wire.anew(), stored=wire.stored) for wire in wires)), [])
    it.session.offering.cuts.recall(memory.recall(it.session.drawn, places))
    return it


@pytest.mark.parametrize("left", [False, True])
def test_a_cut_is_bent_in_the_session_after_it_was_cut(left: bool) -> None:
    session = taken(left)
    it = after_cutting(session, as_cut(session))
    assert it.session.picture.can_bend
    it.session.hover(28, bend=True)
    it.session.poll()
    assert it.lives["SURFACE"].bent[-1] == (8, 28, (1, 1) if left else (0, 0)), (
        "the one of those through the point that ran there"
    )
    assert it.session.click(28)
    assert it.session.seeds() == [8, 28]
    assert {wire.finish for wire in it.session.wires} == {"CUT"}
    assert it.session.undo()
    assert len(it.session.wires) == 2


def test_it_is_the_one_that_runs_there_whatever_the_library_calls_it(monkeypatch: pytest.MonkeyPatch) -> None:
    session = taken()
    squares = FakeLive.closed_wires

    def renamed(self: FakeLive, through: object) -> FakeCuts:
        found = squares(self, through)
        return FakeCuts([replace(cut, id=(cut.id[0] + 1, cut.id[1])) for cut in reversed(found.cuts)], found.final)

    monkeypatch.setattr(FakeLive, "closed_wires", renamed)
    it = after_cutting(session, as_cut(session))
    assert it.session.bend(28)
    assert it.lives["SURFACE"].bent[-1] == (8, 28, (1, 0))


def circle(radius: float, x: float, towards: int) -> np.ndarray:
    """Return a circle around a place on the x axis, in the xy plane or the xz plane."""
    turns = np.linspace(0.0, 2.0 * np.pi, 65)
    points = np.zeros((65, 3))
    points[:, 0], points[:, towards] = x + radius * np.cos(turns), radius * np.sin(turns)
    return points


def test_cuts_through_a_point_around_other_limbs_are_others_and_one_that_strays_is_the_same() -> None:
    limb, neighbor = circle(1.0, 1.0, 1), circle(1.0, -1.0, 1)
    assert is_same(limb, neighbor) is None, "limbs that touch"
    tube = circle(1.0, 1.0, 2)
    around = circle(3.0, -1.0, 1)
    assert is_same(tube, around) is None, "a torus, from outside"
    assert is_same(around, tube) is None
    strays = limb + (1.0 - np.cos(np.linspace(0.0, 2.0 * np.pi, 65)))[:, None] * (0.0, 0.0, 0.4)
    assert is_same(limb, strays) is not None


def test_where_none_runs_there_it_says_so() -> None:
    session = taken()
    it = after_cutting(session, as_cut(session))
    it.lives["SURFACE"] = it.session.engines.cuts()
    it.lives["SURFACE"].islands = (8,)
    assert not it.session.bend(28)
    assert it.session.reason == "The mesh has changed too much to find this cut again: undo, or add another cut"
    assert len(it.session.wires) == 2


def test_what_is_not_all_there_is_forgotten() -> None:
    session = taken()
    for wires in (as_cut(session)[:1], [replace(wire, stored=0) for wire in as_cut(session)]):
        it = after_cutting(session, wires)
        assert not it.session.bend(28)
        assert it.session.reason == "No closed cut to bend: add one first"


def test_what_was_changed_since_it_was_taken_is_not_handed_on() -> None:
    session = taken()
    assert len(session.offering.cuts.taken(session.drawn)) == 1
    session.drop(session.wires[1])
    assert session.offering.cuts.taken(session.drawn) == ()


def test_the_memory_of_cuts_is_bounded_and_forgets_the_oldest(monkeypatch: pytest.MonkeyPatch) -> None:
    session = taken()
    wires = as_cut(session)
    places = Places(Table("SURFACE").points, SCALE)
    (cut,) = (
        cut
        for cut in (cut.of(Drawn(tuple(wires))) for cut in session.offering.cuts.taken(session.drawn))
        if cut is not None
    )
    monkeypatch.setattr(surface_loops, "_MOST_BYTES", 2 * cut.course.nbytes)
    memory, networks = CutMemory(), []
    for number in (100, 200, 300):
        own = tuple(replace(wire, stored=number + place) for place, wire in enumerate(cut.wires))
        networks.append(Drawn(own))
        memory.keep([cut], networks[-1], places)
    assert [len(list(memory.recall(network, places))) for network in networks] == [0, 1, 1]
    memory.clear()
    assert not list(memory.recall(networks[-1], places))
