# SPDX-License-Identifier: GPL-3.0-or-later
"""Borders of parts and of flat faces: on a bent plate, a tube, and what has no border."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable, Iterator
from contextlib import suppress

import numpy as np
import pytest
from fake_live import grid_edges, grid_points, grid_triangles
from numpy.typing import NDArray
from seamwire.core.base.half_edges import after
from seamwire.core.base.refused import Refused
from seamwire.core.offers import part_borders
from seamwire.core.offers.part_borders import PartBorders

SIZE = 6
"""Vertices along a side of the plate; vertex SIZE * row + column."""


def plate(bend: float = 0.0) -> PartBorders:
    """Return a plate of quads, bent by an angle in degrees along its third column."""
    points = grid_points(SIZE)
    right = np.maximum(points[:, 0] - points[2, 0], 0.0)
    points[:, 0] += right * (np.cos(np.radians(bend)) - 1.0)
    points[:, 2] += right * np.sin(np.radians(bend))
    return PartBorders(points, grid_triangles(SIZE), grid_edges(SIZE))


def parted(*bounds: int, triangles: NDArray[np.int32] | None = None) -> PartBorders:
    """Return a plate with parts between these columns, once for each amount that is given as a column."""
    faces = grid_triangles(SIZE) if triangles is None else triangles
    labels = [((faces % SIZE).max(axis=1) > bound).astype(np.int32) for bound in bounds]
    found = PartBorders(grid_points(SIZE), faces, grid_edges(SIZE), find_parts=lambda *_: labels)
    assert found.ready()
    return found


def around(columns: range) -> set[int]:
    """Return the vertices around all rows of some columns."""
    return {
        SIZE * row + column
        for row, column in itertools.product(range(SIZE), columns)
        if row in (0, SIZE - 1) or column in (columns[0], columns[-1])
    }


def test_the_borders_beside_an_edge_lead_around_the_parts_there() -> None:
    left, right = around(range(3)), around(range(2, SIZE))
    assert [set(border) for border in parted(2).borders((2 + SIZE, 2))] == [left, right], "the shorter one first"
    assert [set(border) for border in parted(2).borders((4, 5))] == [right]
    assert list(parted(2).borders((7, 8))) == [], "inside of a part"
    assert [set(border) for border in parted(2, 3).borders((4, 5))] == [right, around(range(3, SIZE))]


def test_a_whole_piece_has_no_border_but_the_boundary() -> None:
    assert list(parted(SIZE).borders((0, 1))) == []
    assert list(parted(SIZE).around(0)) == [()]
    assert parted(SIZE).rims((7, 8)) == (), "a plate is no tube"


def test_around_a_triangle_lie_the_borders_of_its_part_for_each_amount() -> None:
    found = list(parted(2, 3).around(0))
    assert [[set(border) for border in borders] for borders in found] == [[around(range(3))], [around(range(4))]]


def test_without_parts_there_are_no_borders() -> None:
    borders = plate()
    assert borders.ready()
    assert list(borders.borders((0, 1))) == list(borders.around(0)) == []
    assert borders.rims((7, 8)) == ()


def ring(size: int) -> PartBorders:
    """Return a plate with a hole of one face in its middle."""
    triangles = grid_triangles(SIZE)
    kept = triangles[[not set(triangle) <= {14, 15, 20, 21} for triangle in triangles.tolist()]]
    return parted(size, triangles=kept)


def test_a_ring_is_a_tube_and_the_edges_inside_of_it_lead_on_from_each_other() -> None:
    rims = ring(SIZE).rims((7, 8))
    assert {frozenset(rim) for rim in rims} == {frozenset((14, 15, 20, 21)), frozenset(around(range(SIZE)))}
    assert ring(SIZE).rims((0, 1)) == ring(SIZE).rims((14, 15)) == (), "edges of the rims lie not inside"
    assert set(ring(SIZE).beside((7, 8))) == {(7, 1), (7, 6), (7, 13), (8, 2), (8, 9), (8, 14)}
    assert ring(2).rims((10, 16)) == (), "half a ring is no tube"


def test_a_part_ends_beside_faces_that_are_turned_inside_out() -> None:
    triangles = grid_triangles(SIZE)
    left = (triangles % SIZE).max(axis=1) <= 2
    turned = np.where(left[:, None], triangles[:, ::-1], triangles).astype(np.int32)
    borders = parted(2, triangles=turned).borders((2, 2 + SIZE))
    assert [set(border) for border in borders] == [around(range(3)), around(range(2, SIZE))]


def test_around_a_polygon_lies_the_border_of_all_in_its_plane() -> None:
    bent = plate(20.0)
    for triangle, columns in ((0, range(3)), (2 * (SIZE - 2), range(2, SIZE))):
        assert set(bent.flat_face(triangle)) == around(columns)
    assert set(plate().flat_face(7)) == around(range(SIZE))


def test_around_a_face_with_a_hole_its_outer_border_counts() -> None:
    triangles = grid_triangles(SIZE)
    kept = triangles[[not set(triangle) <= {14, 15, 20, 21} for triangle in triangles.tolist()]]
    ring = PartBorders(grid_points(SIZE), kept, grid_edges(SIZE))
    assert set(ring.flat_face(0)) == around(range(SIZE))


def test_a_border_that_is_too_long_is_given_up_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    count = 20_100
    turns = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    ring = np.stack([np.cos(turns), np.sin(turns), np.zeros(count)], axis=1)
    here = np.arange(count, dtype=np.int32) + 1
    following = np.roll(here, -1)
    disc = PartBorders(
        np.concatenate([np.zeros((1, 3)), ring]),
        np.stack([np.zeros_like(here), here, following], axis=1),
        np.stack([here, following], axis=1),
    )
    steps = itertools.count()

    def counted(half_edge: int) -> int:
        assert next(steps) < 3 * count
        return after(half_edge)

    monkeypatch.setattr(part_borders, "after", counted)
    assert disc.flat_face(0) == ()


def test_parts_are_found_anew_only_with_other_seams() -> None:
    seams, given = [np.array([[0, 1]], dtype=np.int32)], []

    def find(known: NDArray[np.int32], _: object) -> list[NDArray[np.int32]]:
        given.append(known.tolist())
        return [(grid_triangles(SIZE) % SIZE).max(axis=1) > 2]

    parts = PartBorders(grid_points(SIZE), grid_triangles(SIZE), grid_edges(SIZE), lambda: seams[0], find)
    for _ in range(2):
        parts.renew()
        assert parts.ready()
    parts.stop()
    assert parts.ready()
    assert given == [[[0, 1]]], "a search that has ended is not stopped"
    seams[0] = np.array([[1, 2]], dtype=np.int32)
    parts.renew()
    assert not parts.is_complete
    assert not list(parts.around(0))
    assert parts.ready()
    assert parts.is_complete
    assert given == [[[0, 1]], [[1, 2]]]


def test_a_search_that_was_stopped_leaves_nothing_behind(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(part_borders, "AT_ONCE", 0)
    begun, counts = threading.Event(), []

    def find(_: object, goes_on: Callable[[], bool]) -> Iterator[NDArray[np.int32]]:
        begun.set()
        yield ((grid_triangles(SIZE) % SIZE).max(axis=1) > 2).astype(np.int32)
        while goes_on():
            pass
        counts.append(threading.active_count())

    parts = PartBorders(grid_points(SIZE), grid_triangles(SIZE), grid_edges(SIZE), find_parts=find)
    parts.ready()
    thread = parts._thread
    assert thread is not None
    assert begun.wait(10.0)
    parts.stop()
    parts.stop()
    thread.join(10.0)
    assert not thread.is_alive()
    assert len(counts) == 1
    assert not parts.is_complete
    assert not list(parts.around(0))


@pytest.mark.parametrize("at_once", [True, False])
def test_an_error_ends_the_preparation_with_its_reason(at_once: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail() -> None:
        raise MemoryError("too large")

    monkeypatch.setattr(part_borders, "AT_ONCE", 5_000 if at_once else 0)
    parts = PartBorders(grid_points(SIZE), grid_triangles(SIZE), grid_edges(SIZE))
    with monkeypatch.context() as broken:
        broken.setattr(parts.half_edges, "prepare", fail)
        if not at_once:
            with suppress(Refused):
                parts.ready()
            parts.wait()
        for _ in range(2):
            with pytest.raises(Refused, match="too large"):
                parts.ready()
    assert parts.is_complete


def test_an_error_while_parts_are_found_leaves_flat_faces() -> None:
    def find(*_: object) -> Iterator[NDArray[np.int32]]:
        raise RuntimeError("broken")
        yield

    parts = PartBorders(grid_points(SIZE), grid_triangles(SIZE), grid_edges(SIZE), find_parts=find)
    assert parts.ready()
    assert parts.is_complete
    assert not list(parts.around(0))
