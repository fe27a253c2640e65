# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed cuts across the surface: what one click on a point offers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from fake_live import FakeCuts, FakeLive
from seamwire.core.sketch.picture import Intent, Role
from setting import use
from table import Table, chain

RIGHT = (8, 9, 10, 16, 22, 21, 20, 14)
LEFT = (8, 7, 6, 12, 18, 19, 20, 14)
"""The squares through vertex 8."""


def table(**options: object) -> Table:
    return Table("SURFACE", **options)


def edges(*ring: int) -> list[tuple[int, int]]:
    return chain(*ring, ring[0])


def test_the_best_cut_is_shown_and_toggling_goes_through_the_others() -> None:
    session = table().session
    session.hover(8, loop=True)
    assert session.picture.offered.kinds == ("ACROSS", "HANDLE")
    preview = session.picture.one(Role.OFFER)
    assert preview.vertices == RIGHT
    assert preview.closed
    np.testing.assert_array_equal(preview.points[0], preview.points[-1])
    assert session.picture.intent is Intent.LOOP
    assert session.next_candidate()
    assert (session.picture.one(Role.OFFER).vertices, session.picture.offered.kind) == (LEFT, "HANDLE")
    assert session.next_candidate()
    assert session.picture.one(Role.OFFER).vertices == RIGHT
    session.hover(8)
    assert session.picture.one(Role.OFFER) is None


@pytest.mark.parametrize(("finish", "count"), [("SNAP", 2), ("SLIDE", 2), ("CUT", 3)])
def test_cuts_that_run_apart_along_the_same_edges_are_two_where_they_are_to_be_cut(
    monkeypatch: pytest.MonkeyPatch, finish: str, count: int
) -> None:
    squares = FakeLive.closed_wires

    def one_beside_it(self: FakeLive, through: object) -> FakeCuts:
        found = squares(self, through)
        first = found.cuts[0]
        pieces = [replace(piece, points=piece.points + 0.1) for piece in first.pieces]
        return FakeCuts([first, replace(first, pieces=pieces), *found.cuts], found.final)

    monkeypatch.setattr(FakeLive, "closed_wires", one_beside_it)
    session = table().session
    use(session, finish=finish)
    session.hover(8, loop=True)
    assert len(session.picture.offered.kinds) == count
    session.next_candidate()
    shown = session.picture.one(Role.OFFER)
    session.click(8)
    np.testing.assert_array_equal(session.wires[0].points[0], shown.points[0])


def test_what_is_there_early_is_shown_and_refined_while_the_cursor_rests() -> None:
    it = table(metric_ready=(False, False), early=True)
    session = it.session
    session.hover(8, loop=True)
    assert session.picture.one(Role.OFFER).vertices == LEFT
    assert session.computing
    revision = session.revision
    session.poll()
    assert session.revision == revision, "the same is not drawn anew"
    it.compute()
    assert session.picture.one(Role.OFFER).vertices == RIGHT
    assert not session.computing


@pytest.mark.parametrize("clicks_early", [False, True])
def test_the_cut_that_was_chosen_stays_the_one_though_another_comes_before_it(
    monkeypatch: pytest.MonkeyPatch, clicks_early: bool
) -> None:
    def later_one_more(self: FakeLive, through: object) -> FakeCuts:
        first, last = self._square(through, 1), self._square(through, -1)
        if not all(self.ready):
            return FakeCuts([first, last], False)
        return FakeCuts([first, *self.bent_wire(through, 28, 3).cuts, last], True)

    monkeypatch.setattr(FakeLive, "closed_wires", later_one_more)
    it = table(metric_ready=(False, False))
    session = it.session
    session.hover(8, loop=True)
    session.next_candidate()
    assert session.picture.one(Role.OFFER).vertices == LEFT
    if clicks_early:
        session.click(8)
    it.compute()
    if not clicks_early:
        assert session.picture.offered.kinds == ("ACROSS", "HANDLE", "HANDLE")
        assert session.picture.one(Role.OFFER).vertices == LEFT
        session.click(8)
    assert session.edges_to_mark() == edges(*LEFT)


def test_a_cut_that_meets_no_edge_is_kept_only_where_it_is_to_be_cut(monkeypatch: pytest.MonkeyPatch) -> None:
    squares = FakeLive.closed_wires

    def within_faces(self: FakeLive, through: object) -> FakeCuts:
        found = squares(self, through)
        for cut in found.cuts:
            cut.pieces[:] = [replace(piece, vertices=piece.vertices[:1]) for piece in cut.pieces]
        return found

    monkeypatch.setattr(FakeLive, "closed_wires", within_faces)
    session = table().session
    assert not session.loop(8)
    assert session.reason == "No edge is left for the seam of this cut"
    assert session.wires == ()
    assert not session.picture.can_undo
    assert not session.picture.can_bend
    use(session, finish="CUT")
    assert session.loop(8)
    assert len(session.wires) == 3
    assert session.picture.can_bend


def test_cuts_are_found_in_the_concave_metric_whatever_wires_are() -> None:
    it = table()
    use(it.session, metric="concave")
    it.session.hover(8, loop=True)
    assert it.lives["SURFACE"].metrics == [("concave", 20.0, None)]
    use(it.session, strength_surface=40.0)
    assert it.lives["SURFACE"].metrics[-1] == ("concave", 40.0, None)


def taken_at_8() -> Table:
    it = table()
    it.session.hover(8, loop=True)
    it.session.click(8)
    return it


def test_the_one_of_several_cuts_that_was_taken_is_the_one_that_is_bent() -> None:
    it = table()
    session = it.session
    session.hover(8, loop=True)
    session.next_candidate()
    session.click(8)
    session.bend(22)
    assert it.lives["SURFACE"].bent[-1] == (8, 22, (1, 1)), "by what the library calls it"


def test_where_none_leads_it_says_so_and_the_cut_stays() -> None:
    session = taken_at_8().session
    session.hover(11, bend=True)
    assert session.reason == "No closed cut leads through both points"
    revision = session.revision
    session.poll()
    assert session.revision == revision, "nothing new to be seen"
    assert not session.bend(11)
    assert session.edges_to_mark() == edges(*RIGHT)
    session.hover(16)
    assert session.reason == ""


def test_bending_waits_until_it_is_computed() -> None:
    it = taken_at_8()
    session = it.session
    it.lives["SURFACE"].ready = (False, False)
    session.hover(28, bend=True)
    assert session.picture.one(Role.OFFER) is None
    assert session.bend(28)
    assert session.waiting == 1
    assert session.edges_to_mark() == edges(*RIGHT)
    it.compute()
    assert session.waiting == 0
    assert session.seeds() == [8, 28]
