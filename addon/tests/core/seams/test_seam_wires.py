# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams taken over as wires: as few as there can be, edge for edge, with the library's own live wires."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from real_sessions import AROUND, RINGS, ball, meridian, tube
from seamwire.core.network.picks import undirected
from seamwire.core.network.wires import Wire
from seamwire.core.seams.seam_wires import wires_between
from seamwire.core.sketch.sketch import Sketch

core = pytest.importorskip("seamwire_core")


def test_wires_between_seeds_that_are_given_end_there_and_circles_are_halved() -> None:
    points = np.zeros((10, 3))
    line = list(itertools.pairwise(range(6)))
    wires = list(wires_between(np.array([*line, (6, 7), (7, 8), (8, 9), (9, 6)]), {2}, points))
    assert sorted((len(wire.vertices), *sorted((wire.start, wire.end))) for wire in wires) == [
        (3, 0, 2), (3, 6, 8), (3, 6, 8), (4, 2, 5),
    ]  # fmt: skip
    assert len({edge for wire in wires for edge in wire.edges()}) == 9


def redrawn(session: Sketch, wires: list[Wire]) -> list[list[int]]:
    """Draw a chain again from the seeds of wires; return what each wire runs along."""
    for wire in wires:
        if wire.heading is None:
            session.end_chain()
            session.start(wire.start)
        session.hover(wire.end)
        session.wait()
        if session.picture.active.vertices != wire.vertices:
            session.next_candidate()
        session.click(wire.end)
        session.wait()
    session.end_chain()
    return [list(wire.vertices) for wire in session.wires]


def ring(row: int) -> list[int]:
    return [row * AROUND + i for i in range(AROUND)]


def test_what_was_drawn_is_found_again_with_as_few_seeds() -> None:
    session = tube()
    session.start(0)
    for end in (4 * AROUND + 5, 7 * AROUND + 2):
        session.click(end)
        session.wait()
    seams = np.array([edge for wire in session.wires for edge in wire.edges()])
    wires = list(tube().wires_along(seams))
    assert len(wires) <= 2
    assert sorted(edge for wire in wires for edge in wire.edges()) == sorted(map(tuple, seams.tolist()))


@pytest.mark.parametrize(("name", "most"), [("staircase", 6), ("ring", 2), ("there and back", 3)])
def test_wires_run_as_the_seams_do_and_can_be_drawn_again_from_their_seeds(name: str, most: int) -> None:
    chain = {
        "staircase": [row * AROUND + i for row in range(1, 7) for i in (row, row + 1)],
        "ring": [*ring(4), 4 * AROUND],
        "there and back": [*meridian(3)[1:6], *meridian(4)[5:0:-1]],
    }[name]
    seams = np.array([undirected(pair) for pair in itertools.pairwise(chain)])
    wires = list(ball().wires_along(seams))
    assert sorted(edge for wire in wires for edge in wire.edges()) == sorted(map(tuple, seams.tolist()))
    assert all(one.end == two.start for one, two in itertools.pairwise(wires))
    assert redrawn(ball(), wires) == [list(wire.vertices) for wire in wires]
    assert len(wires) <= most


def test_straight_seams_take_the_fewest_seeds_there_can_be() -> None:
    seams = np.array([undirected(pair) for pair in zip(meridian(3), meridian(3)[1:], strict=False)])
    assert [(wire.start, wire.end) for wire in tube().wires_along(seams)] == [(meridian(3)[0], meridian(3)[-1])]


def test_a_seam_that_is_no_edge_of_the_surface_is_refused() -> None:
    with pytest.raises(ValueError, match=str(AROUND * RINGS + 50)):
        list(tube().wires_along(np.array([(0, AROUND * RINGS + 50)])))
