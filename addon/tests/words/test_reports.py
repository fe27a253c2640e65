# SPDX-License-Identifier: GPL-3.0-or-later
"""What is reported of a chain or an edit: only what has happened."""

from __future__ import annotations

from dataclasses import replace

import pytest
from seamwire.core.islands.uv_maps import CostlyIsland, SquareUse
from seamwire.core.network.drawn import Drawn
from seamwire.core.network.strokes import Stroke, through_vertices
from seamwire.core.network.wires import split
from seamwire.core.sketch.change import Change
from seamwire.words.reports import square_used, summary
from seamwire.words.scripted import draw_chain
from table import SIZE, Table, grid_points


def drawn() -> Drawn:
    """Return a network of two wires."""
    session = Table().session
    assert draw_chain(session, [0, 2, 14]) == []
    return session.drawn


def test_drawn_wires_are_counted_with_their_edges() -> None:
    network = drawn()
    change = Change(Drawn(), network)
    assert summary(change, 4, 0) == "2 wires, 4 edges marked"
    assert summary(change, 0, 0) == "2 wires, 0 edges marked", "all of them were seams already"
    assert summary(change, 0, 3) == "2 wires, 3 edges cleared"
    clearing = Change(Drawn(), replace(network, wires=tuple(replace(wire, marks=False) for wire in network.wires)))
    assert summary(clearing, 0, 0) == "2 wires, 0 edges cleared"


def test_a_wire_with_another_path_is_changed_and_not_drawn() -> None:
    before = drawn()
    first, second = before.wires
    other = replace(second, vertices=(2, 3, 9, 8, 14))
    change = Change(before, replace(before, wires=(replace(first), other)))
    assert summary(change, 18, 12) == "1 wire changed, 18 edges marked, 12 edges cleared"


@pytest.mark.parametrize("closed", [False, True])
def test_a_wire_that_is_split_is_neither_drawn_nor_changed(closed: bool) -> None:
    before = drawn()
    first, second = before.wires
    if closed:
        around = (2, 3, 4, 10, 16, 15, 14, 8)
        second = replace(second, vertices=around, points=grid_points(SIZE)[list(around)], closed=True)
        before = replace(before, wires=(first, second))
    parts = split(second, second.vertices[len(second.vertices) // 2], grid_points(SIZE))
    assert parts is not None
    change = Change(before, replace(before, wires=(first, *parts)))
    assert summary(change, 0, 0) == "no edge has changed"


def test_a_removed_wire_is_told() -> None:
    before = drawn()
    assert summary(Change(before, replace(before, wires=before.wires[:1])), 0, 2) == "1 wire removed, 2 edges cleared"


def test_strokes_are_told_without_edges() -> None:
    before = drawn()
    stroke = Stroke(*through_vertices([0, 1], grid_points(SIZE)))
    after = replace(before, strokes=(stroke,))
    assert summary(Change(before, after), 0, 0) == "1 stroke"
    assert summary(Change(after, before), 0, 0) == "1 stroke removed"


@pytest.mark.parametrize(
    ("costly", "cause"),
    [
        (None, ""),
        (CostlyIsland(2), ": island 3 is long"),
        (CostlyIsland(2, side="+z"), ": island 3 (top) is long"),
        (CostlyIsland(0, others=1, name="Shirt", side="-x"), ": island 1 of Shirt (left) and 1 other are long"),
        (CostlyIsland(0, empty=0.784, is_only=True), ": the box around the only island is 78 % empty"),
    ],
)
def test_if_little_of_the_square_is_used_the_cause_is_told(costly: CostlyIsland | None, cause: str) -> None:
    assert square_used(SquareUse(0.313, costly)) == "31 % of the UV square used" + cause
    assert square_used(SquareUse(0.45, costly)) == "45 % of the UV square used"
