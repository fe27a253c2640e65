# SPDX-License-Identifier: GPL-3.0-or-later
"""What a drawing session does, without Blender and without the library."""

from __future__ import annotations

import contextlib
import importlib
import pkgutil

import pytest
from blender_refusal import BlenderRefusal
from fake_live import FakeLive, FakeWires
from seamwire import core
from seamwire.core.network.network import Snap
from seamwire.terms.choices import Along
from setting import use
from table import Table


@pytest.mark.parametrize("name", [module.name for module in pkgutil.walk_packages(core.__path__, "seamwire.core.")])
def test_no_module_asks_for_blender(name: str, blender_refusal: BlenderRefusal) -> None:
    # What functions ask for when they are called is noticed in all other tests, too.
    importlib.import_module(name)
    assert blender_refusal.asked == []


def test_who_asks_for_blender_is_noticed_even_if_that_may_fail(blender_refusal: BlenderRefusal) -> None:
    with contextlib.suppress(ImportError):
        importlib.import_module("bpy.types")
    assert blender_refusal.asked == ["bpy"]
    blender_refusal.asked.clear()


def test_a_click_does_not_wait_for_wires_that_do_not_lead() -> None:
    table = Table(ready=(False, False, True))
    session = table.session
    session.click(0)
    session.click(14)
    assert session.waiting == 0
    assert session.wires[0].follow == 2


def test_toggling_makes_the_other_active_until_a_wire_is_kept() -> None:
    session = Table().session
    session.click(0)
    session.hover(7)
    assert session.next_candidate()
    assert session.picture.active.vertices == (0, 6, 7)
    session.hover(8)
    assert session.picture.active.vertices == (0, 6, 7, 8), "the choice holds while the cursor moves"
    assert session.next_candidate()
    assert session.picture.active.vertices == (0, 1, 2, 8)
    session.next_candidate()
    session.click(8)
    assert session.wires[0].vertices == (0, 6, 7, 8)
    session.hover(15)
    assert session.picture.active.vertices == (8, 9, 15), "the next wire is the shorter one again"


def test_where_no_other_wire_comes_forward_the_reason_is_said() -> None:
    session = Table().session
    session.click(0)
    session.hover(1)
    assert not session.next_candidate()
    assert session.reason == "All wires run along the same edges here"
    session = Table(ready=(False, False, False)).session
    session.click(0)
    session.hover(14)
    assert not session.next_candidate()
    assert session.reason == "No other candidate found yet"


def test_a_click_keeps_the_active_wire_and_goes_on_along_its_last_edge() -> None:
    table = Table()
    session = table.session
    session.click(0)
    session.click(8)
    assert [wire.vertices for wire in session.wires] == [(0, 1, 2, 8)]
    assert table.lives["EDGES"].seeded == ((2, 8), True)
    session.click(20)
    assert session.wires[1].vertices == (8, 14, 20), "the edge before the seed is the first wire's"
    assert session.edges_to_mark() == [(0, 1), (1, 2), (2, 8), (8, 14), (14, 20)]
    assert session.seeds() == [0, 8, 20]


def test_clicking_the_seed_again_keeps_nothing() -> None:
    session = Table().session
    session.click(0)
    assert not session.click(0)
    assert session.wires == ()
    session.click(3)
    assert not session.click(3)
    assert len(session.wires) == 1
    assert "somewhere else" in session.reason


def test_clicking_the_seeds_own_edge_again_keeps_nothing() -> None:
    session = Table().session
    session.click((0, 1))
    assert not session.click((1, 0))
    session.click((3, 4))
    assert not session.click((3, 4))
    assert not session.click(4), "the wire's end"
    assert len(session.wires) == 1


def test_ending_a_chain_leaves_the_kept_wires_and_no_live_one() -> None:
    session = Table().session
    session.click(0)
    session.click(3)
    session.hover(9)
    session.end_chain()
    assert session.seed is None
    assert session.picture.active is None
    assert len(session.wires) == 1
    session.click(30)
    assert session.seed == 30
    assert len(session.wires) == 1, "the click began a new chain"


def test_undo_takes_back_wires_then_seeds_and_redo_brings_them_again() -> None:
    session = Table().session
    session.click(0)
    session.click(2)
    session.click(4)
    assert session.undo()
    assert [wire.end for wire in session.wires] == [2]
    session.hover(10)
    assert session.picture.active.vertices == (2, 3, 4, 10), "the live wire begins where the lost one did"
    assert session.undo()
    assert session.wires == ()
    assert session.seed == 0
    assert session.undo()
    assert session.seed is None
    assert not session.picture.can_undo
    assert not session.undo()
    assert session.redo()
    assert session.redo()
    assert session.redo()
    assert [wire.end for wire in session.wires] == [2, 4]
    assert not session.redo()


def test_a_double_click_may_find_its_edge_the_other_way_round() -> None:
    session = Table().session
    session.click((15, 14))
    session.loop((14, 15))  # by now a seed is under the cursor
    assert session.seed is None
    assert session.loop((15, 14))
    assert len(session.wires) == 1


def test_across_the_surface_picks_are_vertices() -> None:
    table = Table("SURFACE")
    session = table.session
    assert not session.click((0, 1))
    assert "vertices" in session.reason
    session.click(0)
    session.click(8)
    assert table.lives["SURFACE"].seeded == (8, False)
    assert session.wires[0].along == "SURFACE"
    assert len(session.wires[0].points) == 4


def test_switching_forth_and_back_keeps_the_direction() -> None:
    table = Table()
    session = table.session
    session.click(0)
    session.click(2)
    use(session, along="SURFACE")
    use(session, along="EDGES")
    assert table.lives["EDGES"].seeded == ((1, 2), True)


def test_a_wire_that_is_not_computed_is_not_shown_and_then_is() -> None:
    table = Table(ready=(False, False))
    session = table.session
    session.click(0)
    session.hover(7)
    assert session.picture.active is None
    assert session.computing
    table.lives["EDGES"].ready = (False, True)
    assert session.poll()
    assert session.picture.active.vertices == (0, 6, 7), "the one there is, though it may be the longer"
    table.lives["EDGES"].ready = (True, True)
    session.poll()
    assert session.picture.active.vertices == (0, 1, 7)
    assert not session.computing
    assert not session.poll(), "nothing is new"


def test_waiting_shows_nothing_new_until_there_is_a_wire() -> None:
    table = Table(ready=(False, False))
    session = table.session
    session.click(0)
    session.hover(7)
    before = session.revision
    for _ in range(5):
        session.poll()
    assert session.revision == before
    session.click(7)
    before = session.revision
    for _ in range(5):
        session.poll()
    assert session.revision == before
    table.lives["EDGES"].ready = (True, True)
    session.poll()
    assert session.revision > before


def test_a_click_before_anything_is_seen_keeps_the_wire_that_is_shorter_in_the_end() -> None:
    table = Table(ready=(False, False))
    session = table.session
    session.click(0)
    session.click(7)
    table.lives["EDGES"].ready = (False, True)
    session.poll()
    assert [wire.vertices for wire in session.wires] == [(0, 6, 7)]
    assert session.waiting == 1
    table.lives["EDGES"].ready = (True, True)
    session.poll()
    assert [wire.vertices for wire in session.wires] == [(0, 1, 7)]


def test_a_click_keeps_the_wire_that_is_seen_though_the_other_one_is_not_computed() -> None:
    table = Table(ready=(False, True))
    session = table.session
    session.click(0)
    session.hover(7)
    session.click(7)
    assert [wire.vertices for wire in session.wires] == [(0, 6, 7)]


def test_what_no_wire_reaches_is_said() -> None:
    session = Table(islands=(35,)).session
    session.click(0)
    assert not session.click(35)
    why = "No wire reaches vertex 35: it is not connected to the seed"
    assert session.reason == why
    assert session.seed == 0
    session.hover(35)
    assert not session.next_candidate()
    assert session.reason == why, "there is no other to wait for"
    session.hover(3)
    assert session.reason == ""


def test_a_refused_seed_leaves_the_one_before() -> None:
    table = Table()
    session = table.session
    session.click(0)
    assert not session.start(99)
    assert "99" in session.reason
    assert table.lives["EDGES"].seeded == (0, False)
    session.click(2)
    assert session.wires[0].vertices == (0, 1, 2)


def test_every_change_of_what_is_seen_counts_the_revision_up() -> None:
    session = Table().session
    actions = [
        lambda: session.click(0),
        lambda: session.hover(7),
        session.next_candidate,
        lambda: session.click(7),
        lambda: session.loop((14, 15)),
        lambda: session.hover((14, 15), loop=True),
        session.undo,
        session.redo,
        lambda: use(session, along="SURFACE"),
        session.end_chain,
    ]
    for action in actions:
        before = session.revision
        action()
        assert session.revision > before
    before = session.revision
    session.hover(None)
    session.hover(None)
    assert session.revision <= before + 1


@pytest.mark.parametrize("along", ["EDGES", "SURFACE"])
def test_a_click_asks_the_library_for_no_wires_and_a_motion_asks_once(
    along: Along, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[object] = []
    wires = FakeLive.wires

    def counting(live: FakeLive, target: object) -> FakeWires:
        asked.append(target)
        return wires(live, target)

    monkeypatch.setattr(FakeLive, "wires", counting)
    session = Table(along).session
    for pick, asks in ((0, 0), (3, 1), (21, 1)):
        session.hover(pick)
        session.hover(pick)
        assert len(asked) == asks
        session.click(pick)
        session.hover(Snap(pick, "SEED"))  # what is under the mouse after the click
        assert len(asked) == asks
        asked.clear()
