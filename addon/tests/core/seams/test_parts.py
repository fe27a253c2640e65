# SPDX-License-Identifier: GPL-3.0-or-later
"""The wheel's steps, what clicks change about parts, and borders as wires."""

from __future__ import annotations

import numpy as np
import pytest
from seamwire.core.seams.seam_plan import PartEdits, border_wires, edges_of, edits_of_text, edits_text, turned

CHAIN = np.array([4, 2, 7], dtype=np.int32)
CIRCLE = np.array([1, 5, 3, 1], dtype=np.int32)


def steps(amount: float) -> int:
    """Return 1 part up to 12 %, 3 up to 57 %, and 8 above."""
    return 1 if amount <= 0.12 else 3 if amount <= 0.57 else 8


@pytest.mark.parametrize(
    ("amount", "notches", "expected"),
    [
        (0.0, 1, 0.15),
        (0.13, 1, 0.6),
        (0.5, 1, 0.6),
        (0.6, -1, 0.55),
        (0.5, -1, 0.1),
        (0.523, -1, 0.1),
        (0.6, 1, 0.6),
        (1.0, 1, 1.0),
        (0.0, -1, 0.0),
        (0.07, -1, 0.07),
    ],
)
def test_a_notch_changes_the_number_of_parts_or_nothing(amount: float, notches: int, expected: float) -> None:
    assert turned(amount, notches, steps) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("amount", "notches", "expected"),
    [(0.5, 1, 0.6), (0.8, -1, 0.55), (0.55, -1, 0.5), (0.6, 1, 0.7), (0.6, -1, 0.55), (0.5, -1, 0.5)],
)
def test_amounts_with_fewer_parts_do_not_answer_a_turn_for_more_if_others_follow(
    amount: float, notches: int, expected: float
) -> None:
    def count(of: float) -> int:
        return 10 if of < 0.52 else 9 if of < 0.58 else 13 if of < 0.68 else 12

    assert turned(amount, notches, count) == pytest.approx(expected)


def test_the_ends_of_the_scale_are_reached_exactly() -> None:
    assert turned(0.95, 1, lambda amount: int(amount == 1.0)) == 1.0
    assert turned(0.05, -1, lambda amount: int(amount == 0.0)) == 0.0


def test_the_wheel_stops_where_it_may_not_look_further() -> None:
    looks = iter((True, False))
    assert turned(0.13, 1, steps, lambda: next(looks)) == pytest.approx(0.2)


def test_the_last_click_on_a_border_decides() -> None:
    edges = edges_of(CHAIN)
    assert edges == {(2, 4), (2, 7)}
    dropped = PartEdits().drop(edges)
    assert (dropped.kept, dropped.dropped) == (frozenset(), edges)
    kept = dropped.keep(edges_of(CHAIN[:2]))
    assert (kept.kept, kept.dropped) == ({(2, 4)}, {(2, 7)})
    assert kept.drop(edges) == dropped
    assert PartEdits().part(9).part(9).parted == (9, 9)


def test_edits_go_into_text_and_back() -> None:
    edits = {'A "name"': PartEdits().drop(edges_of(CHAIN)).part(3).part(8), "Other": PartEdits().keep(edges_of(CIRCLE))}
    assert edits_of_text(edits_text({**edits, "Unchanged": PartEdits()})) == edits
    assert edits_of_text("") == {}
    for text in ("{", "[]", '{"A": {}}', '{"A": {"kept": [1], "dropped": [], "parted": []}}'):
        with pytest.raises(ValueError):
            edits_of_text(text)


def test_edits_that_a_mesh_does_not_have_are_left_out() -> None:
    edits = PartEdits().keep(edges_of(CHAIN)).drop(edges_of(CIRCLE)).part(1).part(4).part(9)
    edges = np.array([(4, 2), (3, 5), (0, 1)], dtype=np.int32)
    polygons = np.array([0, 1, 1, 3], dtype=np.int32)
    found = edits.on(edges, polygons)
    assert {name: array.tolist() for name, array in found.items()} == {
        "kept": [[2, 4]],
        "dropped": [[3, 5]],
        "parted": [1],
    }
    empty = PartEdits().on(edges, polygons)
    assert [array.shape for array in empty.values()] == [(0, 2), (0, 2), (0,)]


def test_borders_become_wires_along_their_edges() -> None:
    points = np.arange(24.0).reshape(8, 3)
    open_one, circle = border_wires([CHAIN, CIRCLE], points)
    assert (open_one.vertices, open_one.start, open_one.end, open_one.closed) == ((4, 2, 7), 4, 7, False)
    assert (circle.vertices, circle.closed) == ((1, 5, 3), True)
    assert set(circle.edges()) == edges_of(CIRCLE)
    assert circle.points.tolist() == points[[1, 5, 3, 1]].tolist()
    assert open_one.planned and circle.planned
