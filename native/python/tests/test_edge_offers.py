# SPDX-License-Identifier: GPL-3.0-or-later
"""The loops that a click on an edge may take, on a grid of quads with 6 x 6 vertices: vertex 6 row + column."""

from __future__ import annotations

import meshes
import numpy as np
import pytest
import seamwire_core as sw
from test_mirror_partners import centred, grid_edges, grid_triangles

SIZE = 6
ROW = list(range(12, 18))


def grid() -> sw.Surface:
    return sw.Surface(centred(SIZE), grid_triangles(SIZE), grid_edges(SIZE))


def halves() -> np.ndarray:
    """Return two parts, on both sides of the third column."""
    return ((grid_triangles(SIZE) % SIZE).max(axis=1) > 2).astype(int)


def found(offers: list[sw.LoopOffer]) -> list[tuple[str, list[int]]]:
    return [(offer.kind, sorted(offer.vertices.tolist())) for offer in offers]


def test_offers_are_chains_with_kinds_and_no_two_are_alike() -> None:
    (strip, border) = sw.LoopOffers(grid()).find((15, 14), triangle=0)
    assert (strip.kind, strip.vertices.tolist(), strip.closed, strip.through) == ("strip", ROW[::-1], False, (14, 15))
    assert (border.kind, border.closed) == ("flat", True)
    assert border.through in {(2, 3), (3, 2), (0, 6), (12, 18), (6, 12)}, "the side of the plate next to the edge"
    assert repr(strip) == "<LoopOffer: strip, 6 vertices>"


def test_straight_ways_end_at_kept_edges_and_at_the_plane_but_run_along_it() -> None:
    offers = sw.LoopOffers(grid())
    assert found(offers.find((13, 14), kept=[(15, 21)])) == [("strip", [12, 13, 14, 15]), ("whole", ROW)]
    assert found(offers.find((13, 14), kept=[(13, 14)])) == [("whole", ROW)]
    plane = range(3, 36, 6)
    assert found(offers.find((13, 14), plane=plane))[0] == ("strip", [12, 13, 14, 15])
    assert found(offers.find((15, 21), plane=plane))[0] == ("strip", list(plane))


def test_a_loop_with_corners_comes_later_and_the_last_kind_earlier() -> None:
    offers, face = sw.LoopOffers(grid()), [14, 15, 21, 20]
    box = [8, 9, 10, 16, 22, 21, 20, 14]
    kinds = [kind for kind, _ in found(offers.find((8, 14), box, 0, last="closed"))]
    assert kinds == ["closed", "strip"]
    assert [kind for kind, _ in found(offers.find((8, 14), box, 4, last="strip"))] == ["strip", "closed"]
    assert found(offers.find((14, 15), face, 0, last="strip")) == [("strip", ROW), ("closed", sorted(face))]


def test_the_crossing_loop_is_second_or_first_in_a_close_call() -> None:
    offers, column = sw.LoopOffers(grid()), list(range(2, 36, 6))
    crossing = {"crossing": (14, 20), "crossing_corners": 0}
    assert found(offers.find((14, 15), **crossing)) == [("strip", ROW), ("crossing", column)]
    shown = {"close_call": True, "shown": column}
    assert found(offers.find((14, 15), **crossing, **shown)) == [("crossing", column), ("strip", ROW)]
    assert found(offers.find((14, 15), **crossing, close_call=True, shown=ROW))[0] == ("strip", ROW)
    kept = {"kept": [(20, 21)], "close_call": True}
    assert found(offers.find((14, 15), **crossing, **kept, shown=column, chosen=True))[0][0] == "crossing"


def test_inside_a_face_the_border_of_its_part_comes_first() -> None:
    offers = sw.LoopOffers(grid())
    offers.add_parts(halves())
    left = sorted({*range(3), *range(30, 33), *range(0, 36, 6), *range(2, 36, 6)})
    first = offers.find((7, 13), triangle=0, inside=True)[0]
    assert found([first]) == [("flat", left)]
    assert offers.borders((2, 8))[0].tolist() == first.vertices.tolist()


def test_of_a_part_with_two_borders_one_offer_takes_both() -> None:
    around, along = 12, 8
    points, triangles = meshes.torus(around, along)
    offers = sw.LoopOffers(sw.Surface(points, triangles))
    offers.add_parts(np.repeat(np.arange(around * along) % around // 4, 2))
    near, slit, both, far = offers.find((0, 1), triangle=0, inside=True)[:4]
    columns = [list(range(column, around * along, around)) for column in (0, 4)]
    assert found([near, both, far]) == [("flat", columns[0]), ("flat", columns[0]), ("flat", columns[1])]
    assert found(both.beside) == [("flat", columns[1])]
    assert near.beside == ()
    assert (slit.kind, slit.closed) == ("strip", False)
    assert sorted(slit.vertices[[0, -1]] % around) == [0, 4], "from rim to rim"


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        (((0, 7),), {}, "there is no edge between the vertices 0 and 7"),
        (((0, 99),), {}, "edge: vertex 99 is out of range"),
        (((0, 1), [1, 99]), {}, "loop: vertex 99 is out of range"),
        (((0, 1),), {"kept": [(0, -1)]}, "kept: vertex -1 is out of range"),
        (((0, 1),), {"plane": [36]}, "plane: vertex 36 is out of range"),
        (((0, 1),), {"shown": [0, 36]}, "shown: vertex 36 is out of range"),
        (((0, 1),), {"triangle": 50}, "triangle 50 is out of range: there are 50 triangles"),
        (((0, 1),), {"last": "round"}, "last: unknown kind 'round'"),
        (((0, 1),), {"crossing": (0, 8)}, "there is no edge between the vertices 0 and 8"),
    ],
)
def test_what_is_not_part_of_the_surface_is_refused(arguments: tuple, options: dict, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        sw.LoopOffers(grid()).find(*arguments, **options)


def test_labels_that_do_not_fit_are_refused() -> None:
    offers = sw.LoopOffers(grid())
    with pytest.raises(ValueError, match="There are 3 labels for 50 triangles"):
        offers.add_parts([0, 1, 2])
    with pytest.raises(ValueError, match="part 50 is out of range"):
        offers.add_parts(np.full(50, 50))
