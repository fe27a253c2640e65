# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires along ridges and valleys from one click, with the library's own live wires."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray
from real_sessions import session_on
from seamwire.core.network.picks import FacePoint, Pick
from seamwire.core.offers.crests import Crests
from seamwire.core.sketch.offering import NO_CUT
from seamwire.core.sketch.picture import Role
from seamwire.terms.choices import Along
from seamwire.terms.options import Options
from setting import use

core = pytest.importorskip("seamwire_core")

N = 40


def mesh() -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Return a jittered sheet with a top along x = .5 + .06 sin(2 pi y), bottoms beside it."""
    rng = np.random.default_rng(3)
    x, y = (part.ravel().astype(float) for part in np.meshgrid(np.arange(N + 1), np.arange(N + 1)))
    inside = (x > 0) & (x < N) & (y > 0) & (y < N)
    x, y = ((part + inside * rng.uniform(-0.2, 0.2, len(part))) / N for part in (x, y))
    height = 0.04 * np.cos(4 * np.pi * (x - 0.06 * np.sin(2 * np.pi * y)))
    i, j = (part.ravel() for part in np.meshgrid(np.arange(N), np.arange(N)))
    a, b, c, d = j * (N + 1) + i, j * (N + 1) + i + 1, (j + 1) * (N + 1) + i, (j + 1) * (N + 1) + i + 1
    return np.stack([x, y, height], axis=1), np.stack([a, b, d, a, d, c], axis=1).reshape(-1, 3).astype(np.int32)


def top(y: NDArray[np.float64]) -> NDArray[np.float64]:
    return 0.5 + 0.06 * np.sin(2 * np.pi * y)


class Sheet:
    """A session on the sheet, and its ridges and valleys."""

    def __init__(self, along: Along) -> None:
        self.points, self.triangles = mesh()
        self.crests = Crests.on(core, core.Surface(self.points, self.triangles))
        self.session = session_on(self.points, self.triangles, options=Options(along=along))

    @property
    def ridge(self) -> int:
        """The line on top."""
        middles = [self.crests.line(number)[0][:, 0].mean() for number in range(len(self.crests))]
        (found,) = np.flatnonzero(np.abs(np.array(middles) - 0.5) < 0.1)
        return int(found)

    def pick(self) -> Pick:
        """Return a place in the middle of it: a vertex beside it, or along edges an edge."""
        start, end = self.crests.starts[self.ridge : self.ridge + 2]
        place = (start + end) // 2
        if self.session.options.along == "SURFACE":
            return int(self.crests.vertices[place])
        mine = self.crests.vertices[start:end].tolist()
        real = {tuple(edge) for edge in core.Surface(self.points, self.triangles).edges.tolist()}
        return next(
            (a, b) for a, b in zip(mine[len(mine) // 2 :], mine[len(mine) // 2 + 1 :], strict=False) if (a, b) in real
        )


@pytest.fixture(params=["SURFACE", "EDGES"])
def sheet(request: pytest.FixtureRequest) -> Sheet:
    return Sheet(request.param)


@pytest.mark.parametrize("finish", ["SNAP", "CUT"])
def test_one_click_takes_a_ridge_as_far_as_it_is_one(sheet: Sheet, finish: str) -> None:
    session, pick = sheet.session, sheet.pick()
    use(session, finish=finish)
    session.use_crests(sheet.crests, True)
    session.hover(pick, loop=True)
    assert session.picture.offered.kinds[0] == "RIDGE"
    np.testing.assert_array_equal(session.picture.one(Role.OFFER).points, sheet.crests.line(sheet.ridge)[0])
    assert session.picture.one(Role.OFFER).edges() == []
    assert session.click(pick)
    session.wait()
    wires = session.wires
    assert wires
    curve = np.concatenate([wire.points for wire in wires])
    inside = (curve[:, 1] > 0.06) & (curve[:, 1] < 0.94)
    assert (
        np.abs(curve[inside, 0] - top(curve[inside, 1])).max()
        < (1.0 if sheet.session.options.along == "SURFACE" else 1.5) / N
    )
    whole = sheet.crests.line(sheet.ridge)[0]
    assert np.ptp(curve[:, 1]) > np.ptp(whole[:, 1]) - 2.0 / N
    # Wires as any other: one after the other, with seeds, of no chain, one step for undo.
    assert session.seed is None
    for one, other in pairwise(wires):
        assert one.end == other.start
    assert {wire.kind for wire in wires} == {None}
    assert {wire.along for wire in wires} == {session.options.along}
    assert len(session.seeds()) == len(wires) + 1
    if session.options.along == "SURFACE":
        assert {wire.finish for wire in wires} == {finish}
        assert isinstance(wires[0].start, FacePoint) == (finish == "CUT")
    assert session.edges_to_mark()
    assert session.undo()
    assert session.wires == ()


def test_where_ridges_are_not_seen_they_come_last(sheet: Sheet) -> None:
    session = sheet.session
    session.use_crests(sheet.crests, False)
    session.hover(sheet.pick(), loop=True)
    session.wait()
    assert session.picture.offered.kinds[-1] == "RIDGE"
    assert session.picture.offered.kinds.count("RIDGE") == 1
    if sheet.session.options.along == "EDGES":
        assert len(session.picture.offered.kinds) > 1
        # Wires before it do not depend on it.
        session.click(sheet.pick())
        session.wait()
        (wire,) = session.wires
        assert wire.kind not in {"RIDGE", "VALLEY"}
        assert not {offer.kind for offer in wire.offers} & {"RIDGE", "VALLEY"}


def test_a_loop_that_is_kept_does_not_become_a_ridge() -> None:
    sheet = Sheet("EDGES")
    session, edge = sheet.session, sheet.pick()
    assert session.loop(edge)
    session.wait()
    session.use_crests(sheet.crests, False)
    # Stored, it has lost what else was offered: that is found anew.
    session.adopt(replace(session.drawn, wires=tuple(replace(wire, offers=()) for wire in session.wires)), [])
    for _ in range(4):
        session.retrace(session.wires[0])
        session.wait()
        (wire,) = session.wires
        assert not {offer.kind for offer in wire.all_offers()} & {"RIDGE", "VALLEY"}


@pytest.mark.parametrize("steps", [1, 2])
@pytest.mark.parametrize("kept", [False, True], ids=["", "a loop is kept"])
def test_toggling_goes_through_what_is_offered_beside_a_ridge(steps: int, kept: bool) -> None:
    sheet = Sheet("EDGES")
    session = sheet.session
    if kept:
        assert session.loop(sheet.pick())
        session.wait()
    session.use_crests(sheet.crests, True)
    session.hover(sheet.pick(), loop=True)
    session.wait()
    kinds = session.picture.offered.kinds
    assert len(kinds) > 2
    assert kinds[0] == "RIDGE"
    for _ in range(steps):
        session.next_candidate()
    shown = session.picture.one(Role.OFFER)
    assert session.picture.offered.kind == kinds[steps]
    assert session.click(sheet.pick())
    session.wait()
    assert session.edges_to_mark() == sorted(shown.edges())


def test_a_ridge_that_is_seen_does_not_wait_for_what_else_is_offered() -> None:
    sheet = Sheet("SURFACE")
    session, pick = sheet.session, sheet.pick()
    session.use_crests(sheet.crests, True)
    session.hover(pick, loop=True)
    assert session.picture.offered.kind == "RIDGE"
    assert session.click(pick)
    session.wait()
    assert session.wires
    assert {wire.closed for wire in session.wires} == {False}


def test_where_neither_a_ridge_nor_a_cut_is_offered_it_is_said_however_late_ridges_are_known() -> None:
    sheet = Sheet("SURFACE")
    session = sheet.session
    session.hover(20 * (N + 1) + 26, loop=True)
    while session.computing:
        for live in session._lives():
            live.wait()
        # Its result is final before the session has looked.
        session.use_crests(sheet.crests, False)
        session.poll()
    assert session.picture.one(Role.OFFER) is None
    assert session.reason == NO_CUT


def test_ridges_that_are_known_later_are_offered_then(sheet: Sheet) -> None:
    session = sheet.session
    assert not session.offering.wanted
    session.hover(sheet.pick(), loop=True)
    session.wait()
    assert session.offering.wanted
    assert "RIDGE" not in session.picture.offered.kinds
    before = session.revision
    session.use_crests(sheet.crests, True)
    assert session.picture.offered.kinds[0] == "RIDGE"
    assert session.revision > before
    session.use_crests(None, True)
    assert "RIDGE" not in session.picture.offered.kinds
    session.hover(sheet.pick())
    assert not session.offering.wanted


def test_what_was_taken_is_not_offered_again_until_the_cursor_was_elsewhere(sheet: Sheet) -> None:
    session, pick = sheet.session, sheet.pick()
    session.use_crests(sheet.crests, True)
    session.hover(pick, loop=True)
    session.click(pick)
    session.wait()
    session.hover(pick, loop=True)
    assert "RIDGE" not in session.picture.offered.kinds
    session.hover(3 * (N + 1) + 3, loop=True)
    session.hover(pick, loop=True)
    assert session.picture.offered.kinds[0] == "RIDGE"


@pytest.mark.parametrize("computed", [False, True], ids=["while it is computed", "then"])
def test_the_second_press_of_a_double_click_on_a_ridge_takes_nothing_more(computed: bool) -> None:
    sheet = Sheet("EDGES")
    session, edge = sheet.session, sheet.pick()
    session.use_crests(sheet.crests, True)
    session.hover(edge, loop=True)
    session.click(edge)
    if computed:
        session.wait()
    assert session.loop(edge)
    session.wait()
    assert session.wires
    assert {wire.kind for wire in session.wires} == {None}
    assert session.undo()
    assert session.wires == (), "it was taken once"
    assert session.loop(edge)
    assert session.undo(), "it waits still"
    assert session.loop(edge)
    session.wait()
    assert session.wires


def test_a_ridge_leaves_the_chain_that_is_drawn_as_it_is(sheet: Sheet) -> None:
    session, pick = sheet.session, sheet.pick()
    session.use_crests(sheet.crests, True)
    session.click(2 * (N + 1) + 3)
    session.hover(pick, loop=True)
    session.click(pick)
    session.wait()
    assert session.wires
    assert session.seed == 2 * (N + 1) + 3
