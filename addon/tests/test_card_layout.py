# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the card of first steps lies, and what of it takes clicks."""

from __future__ import annotations

import pytest
from seamwire.view.card_layout import Card, laid_out, wrapped
from seamwire.words.card import LINK, STEPS, TITLE


def measure(text: str, size: float) -> float:
    return 0.55 * size * len(text)


def card(room: tuple[float, float, float, float], size: float = 11.0, link: str = LINK) -> Card | None:
    return laid_out(TITLE, STEPS, link, room, size, measure)


ROOMS = [(0.0, 0.0, 1900.0, 900.0), (60.0, 30.0, 500.0, 400.0), (0.0, 0.0, 340.0, 300.0), (20.0, 0.0, 260.0, 420.0)]


@pytest.mark.parametrize("room", ROOMS)
@pytest.mark.parametrize("scale", [1.0, 2.0])
def test_all_of_the_card_lies_within_the_room(room: tuple[float, float, float, float], scale: float) -> None:
    left, bottom, width, height = (scale * side for side in room)
    found = card((left, bottom, width, height), 11.0 * scale)
    assert found is not None
    box = found.box
    assert left < box.left
    assert box.right < left + width
    assert bottom < box.bottom
    assert box.top < bottom + height
    for part in (found.close, found.link, *(row.box for row in found.rows)):
        assert box.left <= part.left
        assert part.right <= box.right
        assert box.bottom <= part.bottom
        assert part.top <= box.top
    for row in found.rows:
        for text, x, y in row.lines:
            assert row.box.right < x
            assert x + measure(text, found.size) <= box.right
            assert box.bottom < y < found.title[2]


def test_on_a_display_of_twice_the_scale_everything_is_twice_as_large() -> None:
    one, two = card((0.0, 0.0, 900.0, 600.0)), card((0.0, 0.0, 1800.0, 1200.0), 22.0)
    assert two.box.width == pytest.approx(2.0 * one.box.width)
    assert two.box.height == pytest.approx(2.0 * one.box.height)
    assert two.close.left == pytest.approx(2.0 * one.close.left)


def test_in_small_rooms_text_breaks_and_gets_smaller_and_in_tiny_ones_there_is_no_card() -> None:
    wide, narrow = card((0.0, 0.0, 900.0, 600.0)), card((0.0, 0.0, 260.0, 600.0))
    assert narrow.box.width < wide.box.width
    assert max(len(row.lines) for row in narrow.rows) > max(len(row.lines) for row in wide.rows)
    assert card((0.0, 0.0, 900.0, 170.0)).size < wide.size
    assert card((0.0, 0.0, 120.0, 600.0)) is None
    assert card((0.0, 0.0, 900.0, 90.0)) is None


def test_rows_do_not_overlap_and_their_icons_stand_beside_their_text() -> None:
    for width in (900.0, 260.0):
        found = card((0.0, 0.0, width, 600.0))
        for above, below in zip(found.rows, found.rows[1:], strict=False):
            assert below.box.top <= above.box.bottom
            assert below.lines[0][2] < above.lines[-1][2]
        assert found.rows[-1].lines[-1][2] > found.link.top


def test_in_narrow_rooms_the_card_leaves_the_text_in_the_corner_free() -> None:
    assert card((0.0, 0.0, 900.0, 600.0)).box.bottom < 20.0
    assert card((0.0, 0.0, 450.0, 600.0)).box.bottom > 80.0


@pytest.mark.parametrize("room", ROOMS)
def test_the_navigation_buttons_in_the_upper_right_corner_stay_free(room: tuple[float, float, float, float]) -> None:
    box = card(room).box
    assert box.top <= room[1] + room[3] - 220.0 or box.right <= room[0] + room[2] - 90.0


def test_only_the_close_button_and_the_link_take_clicks() -> None:
    found = card((0.0, 0.0, 900.0, 600.0))

    def middle(box: object) -> tuple[float, float]:
        return box.left + 0.5 * box.width, box.bottom + 0.5 * box.height

    assert found.part_at(middle(found.close)) == "CLOSE"
    assert found.part_at(middle(found.link)) == "LINK"
    assert found.part_at(middle(found.box)) is None
    assert found.part_at((1.0, 1.0)) is None
    for row in found.rows:
        assert found.part_at(middle(row.box)) is None


def test_without_a_guide_there_is_no_link_and_the_card_is_lower() -> None:
    found, plain = card((0.0, 0.0, 900.0, 600.0)), card((0.0, 0.0, 900.0, 600.0), link="")
    assert plain.link is None
    assert plain.box.height < found.box.height


def test_text_breaks_between_words() -> None:
    assert wrapped("one two three", 7.0, len) == ("one two", "three")
    assert wrapped("incomprehensible", 7.0, len) == ("incomprehensible",)
