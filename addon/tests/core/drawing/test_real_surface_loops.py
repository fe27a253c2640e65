# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed cuts across the surface with the library's own live wires, around a limb with a waist."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from numpy.typing import NDArray
from real_sessions import caps, circles, halves, quads_between_rings, session_on
from seamwire.core.network.network import Snap
from seamwire.core.network.picks import Edge, FacePoint
from seamwire.core.sketch.offering import NO_CUT
from seamwire.core.sketch.picture import Role
from seamwire.core.sketch.sketch import Sketch
from seamwire.terms.options import Options
from setting import use

core = pytest.importorskip("seamwire_core")

AROUND, ROWS = 24, 41
WAIST = 20 * AROUND
"""A vertex of the waist, in the middle of the rows; the last two vertices are the tips."""


@pytest.fixture
def triangles() -> NDArray[np.int32]:
    return np.concatenate([halves(quads_between_rings(ROWS, AROUND)), caps(ROWS, AROUND)])


@pytest.fixture
def session(triangles: NDArray[np.int32]) -> Sketch:
    along = np.linspace(-1.0, 1.0, ROWS)
    radius = 0.3 - 0.1 * np.exp(-((along / 0.25) ** 2))
    points = np.concatenate([circles(along, radius, AROUND), [[0.0, 0.0, -1.15], [0.0, 0.0, 1.15]]])
    return session_on(points, triangles, options=Options(along="SURFACE"))


def is_closed(edges: list[Edge]) -> bool:
    return bool(edges) and set(Counter(vertex for edge in edges for vertex in edge).values()) == {2}


def islands(session: Sketch, triangles: NDArray[np.int32]) -> int:
    cuts = np.array(session.edges_to_mark(), dtype=np.int32)
    surface = core.Surface(session.points, triangles)
    return len(np.unique(core.face_segments(surface, cuts)))


def test_one_click_cuts_the_limb_in_two(session: Sketch, triangles: NDArray[np.int32]) -> None:
    session.hover(WAIST, loop=True)
    session.wait()
    assert session.picture.offered.kinds[0] == "ACROSS"
    preview = session.picture.one(Role.OFFER)
    assert np.abs(preview.points[:, 2]).max() < 0.06
    assert session.click(WAIST)
    assert session.edges_to_mark() == sorted(preview.edges())
    assert is_closed(session.edges_to_mark())
    assert islands(session, triangles) == 2
    assert len(session.seeds()) == 3
    assert session.undo()
    assert session.wires == (), "one step"


def test_a_click_within_a_face_does_so_too(session: Sketch, triangles: NDArray[np.int32]) -> None:
    triangle = 2 * AROUND * 10 + 3
    place = FacePoint(triangle, tuple(triangles[triangle].tolist()), (0.2, 0.3, 0.5))
    assert session.loop(place)
    session.wait()
    assert session.wires[0].start == session.wires[-1].end == place
    assert islands(session, triangles) == 2


def shows(session: Sketch, vertex: int, **how: bool) -> bool:
    """Return whether a cut is shown at a vertex once it is computed."""
    session.hover(vertex, **how)
    session.wait()
    return session.picture.one(Role.OFFER) is not None


def test_from_a_tip_nothing_is_suggested_and_it_says_so_until_it_is_not_asked_for_any_more(session: Sketch) -> None:
    tip = AROUND * ROWS
    assert not shows(session, tip, loop=True)
    assert session.reason == NO_CUT
    revision = session.revision
    assert not shows(session, tip, loop=True)
    assert session.revision == revision, "nothing new to be seen"
    assert shows(session, WAIST, loop=True)
    assert session.reason == ""
    shows(session, tip, loop=True)
    session.hover(tip)
    assert session.reason == ""
    assert not session.loop(tip)
    assert session.reason == NO_CUT


def test_after_it_was_taken_it_is_not_offered_again_until_another_point(session: Sketch) -> None:
    assert shows(session, WAIST, loop=True)
    session.click(WAIST)
    assert not shows(session, WAIST, loop=True)
    assert shows(session, WAIST + AROUND, loop=True)
    assert shows(session, WAIST, loop=True)


def test_a_cut_clears_seams_where_wires_do(session: Sketch) -> None:
    session.loop(WAIST)
    session.wait()
    ring = session.edges_to_mark()
    session.undo()
    session.adopt(session.drawn, ring)
    use(session, clear=True)
    session.loop(WAIST)
    session.wait()
    assert session.edges_to_clear() == ring


def test_edges_have_none_across_the_surface_and_points_none_along_edges(session: Sketch) -> None:
    assert not session.loop((WAIST, WAIST + 1))
    assert f"not edge {WAIST}-{WAIST + 1}" in session.reason
    use(session, along="EDGES")
    assert not session.loop(WAIST)
    assert f"not vertex {WAIST}" in session.reason


def test_bent_to_a_second_point_it_parts_the_limb_all_the_same(session: Sketch, triangles: NDArray[np.int32]) -> None:
    session.loop(WAIST)
    session.wait()
    cut = session.edges_to_mark()
    for second in (WAIST + 5 * AROUND + 12, WAIST - 4 * AROUND + 7):
        assert session.bend(second)
        session.wait()
        assert session.wires[0].start == session.wires[-1].end == WAIST
        assert second in session.seeds()
        assert len(session.wires) == 4
        assert islands(session, triangles) == 2
    assert session.undo()
    assert session.undo()
    assert session.edges_to_mark() == cut
    assert session.redo()
    assert session.undo()
    assert session.bend(WAIST - 3 * AROUND + 12), "it can be bent elsewhere"
    session.wait()
    assert islands(session, triangles) == 2
    assert session.edges_to_mark() != cut
    assert session.undo()
    assert session.undo()
    assert session.wires == ()


@pytest.mark.parametrize("drawn", ["marking", "clearing", "cutting", "mirroring"])
def test_a_bent_cut_does_to_the_mesh_what_the_cut_did(session: Sketch, drawn: str) -> None:
    changes = {"clearing": {"clear": True}, "cutting": {"finish": "CUT"}, "mirroring": {"mirror": (0,)}}
    before = session.options
    use(session, **changes.get(drawn, {}))
    session.loop(WAIST)
    session.wait()
    cut = session.wires[0]
    session.follow(before)
    if drawn == "marking":
        use(session, clear=True)
    assert session.bend(WAIST + 5 * AROUND + 12)
    session.wait()
    assert {(wire.marks, wire.finish, wire.mirror) for wire in session.wires} == {(cut.marks, cut.finish, cut.mirror)}


def test_what_is_not_there_as_it_was_taken_is_not_bent(session: Sketch) -> None:
    second = WAIST + 5 * AROUND + 12
    assert not session.bend(second)
    session.wait()
    assert session.reason == "No closed cut to bend: add one first"
    session.loop(WAIST)
    session.wait()
    assert session.picture.can_bend
    session.drop(session.wires[1])
    assert not session.picture.can_bend
    assert not shows(session, second, bend=True)
    assert session.reason == "No closed cut to bend: add one first"
    session.undo()
    assert session.picture.can_bend, "it is there again"
    use(session, strength_surface=40.0)
    assert not session.picture.can_bend, "other cuts would be found by now"


def test_what_is_said_of_bending_goes_with_it_where_a_wire_is_live(session: Sketch) -> None:
    second = WAIST + 5 * AROUND + 12
    session.click(WAIST)
    assert not shows(session, second, bend=True)
    assert session.reason == "No closed cut to bend: add one first"
    revision = session.revision
    session.hover(second)
    assert session.reason == ""
    assert session.revision > revision


def test_edges_are_not_bent_to_and_along_edges_nothing_is(session: Sketch) -> None:
    second = WAIST + 5 * AROUND + 12
    session.loop(WAIST)
    session.wait()
    cut = session.edges_to_mark()
    assert not session.bend((second, second + 1))
    use(session, along="EDGES")
    assert not session.bend(second)
    assert not session.picture.can_bend
    assert session.edges_to_mark() == cut


def test_a_bent_cut_is_dragged_by_its_second_point(session: Sketch, triangles: NDArray[np.int32]) -> None:
    second, to = WAIST + 3 * AROUND + 12, WAIST + 5 * AROUND + 12
    session.loop(WAIST)
    session.wait()
    session.bend(second)
    session.wait()
    assert session.drag(Snap(second, "SEED"))
    session.drag_to(to)
    session.drag_end()
    session.wait()
    assert to in session.seeds()
    assert islands(session, triangles) == 2


def test_w_on_a_piece_of_a_cut_takes_its_other_paths_between_the_same_seeds(
    session: Sketch, triangles: NDArray[np.int32]
) -> None:
    session.loop(WAIST)
    session.wait()
    session.bend(WAIST + 4 * AROUND + 12)
    session.wait()
    before = session.wires
    paths = set()
    for _ in range(4):
        session.retrace(session.wires[1])
        session.wait()
        paths.add(session.wires[1].vertices)
        ends = [(wire.start, wire.end) for wire in session.wires]
        assert ends == [(wire.start, wire.end) for wire in before], "seeds stay"
        assert islands(session, triangles) == 2
    assert session.wires[0] is before[0], "the other pieces stay"
    while session.wires[1] is not before[1]:
        assert session.undo()
