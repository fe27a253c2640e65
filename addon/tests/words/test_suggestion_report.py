# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of Suggest Seamwires."""

from seamwire.words.suggestion import Outcome


def test_a_good_result_is_told_in_numbers() -> None:
    outcome = Outcome(wires=12, marked=340, missing=[0] * 6, stretch=14.2, overlapping=0)
    assert outcome.is_good
    assert outcome.text == "12 wires, 340 edges marked, 6 islands, stretch 14 %, no overlap"


def test_what_was_not_reached_is_told_and_no_good_result() -> None:
    for outcome, text in (
        (
            Outcome(1, 0, [0], islands_wanted=4),
            "1 wire, 1 island, fewer than 4 because no island can be cut further",
        ),
        (Outcome(1, 0, [0], stretch=21.0, stretch_wanted=17.0), "stretch 21 %, 17 % was not reached"),
        (Outcome(1, 0, [0], overlapping=2), "2 islands overlapping"),
        (Outcome(3, 9, [0, 2, 1], discs_wanted=True), "3 islands, 2 islands still need 3 cuts"),
        (Outcome(3, 9, [0, 0, 1], discs_wanted=True), "3 islands, 1 island still needs 1 cut"),
    ):
        assert not outcome.is_good
        assert text in outcome.text


def test_holes_are_told_and_good_where_discs_were_not_asked_for() -> None:
    outcome = Outcome(3, 9, [0, 2, 1])
    assert outcome.is_good
    assert "3 islands, 2 with holes" in outcome.text
