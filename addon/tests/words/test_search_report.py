# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of Suggest Seamwires."""

from dataclasses import replace

import pytest
from seamwire.core.islands.uv_maps import MapFaults, SquareUse
from seamwire.words.reports import Outcome, in_words, is_beyond, not_reached, percent


def test_a_good_result_is_told_in_numbers() -> None:
    outcome = Outcome(12, 340, 6, stretch=14.2, stretches=[14.2], stretch_wanted=17.0, unwrapped=6)
    assert outcome.is_good
    assert outcome.text == "12 wires, 340 edges marked, 6 islands, stretch 14 %, no overlap"
    in_view = "12 wires, 2 in full view, 340 edges marked, 6 islands, stretch 14 %, no overlap"
    assert replace(outcome, exposed=2).text == in_view
    assert replace(outcome, used=SquareUse(0.164)).text == outcome.text + ", 16 % of the UV square used"


def test_what_was_not_reached_is_told_and_no_good_result() -> None:
    for outcome, text in (
        (Outcome(1, 0, 1, islands_wanted=4), "1 island, fewer than 4 because no island can be cut further"),
        (Outcome(1, 0, 1, stretch=21.0, stretches=[21.0], stretch_wanted=17.0), "stretch 21 %, 17 % was not reached"),
        (Outcome(1, 0, 2, unwrapped=2, faults=MapFaults(overlapping=2)), "2 islands, 2 islands overlap"),
    ):
        assert not outcome.is_good
        assert text in outcome.text
        assert "no overlap" not in outcome.text


@pytest.mark.parametrize(
    ("stretches", "mean", "told"),
    [
        ([13.0], 13.0, "stretch 13 %"),
        ([17.4], 17.4, "stretch 17 %"),
        ([17.6], 17.6, "stretch 18 %, 17 % was not reached"),
        ([9.0, 21.0], 13.0, "stretch 13 %, 1 of 2 objects above 17 %"),
    ],
)
def test_the_stretch_in_the_report_and_the_verdict_on_it_never_disagree(
    stretches: list[float], mean: float, told: str
) -> None:
    outcome = Outcome(1, 0, 1, stretch=mean, stretches=stretches, stretch_wanted=17.0)
    assert outcome.text == f"1 wire, 1 island, {told}"
    assert outcome.is_good == ("17 %," not in told and "above" not in told and "not" not in told)


def test_a_map_that_could_not_be_made_has_no_stretch_and_no_verdict_on_overlap() -> None:
    assert Outcome(2, 5, 1, stretch_wanted=17.0).text == "2 wires, 5 edges marked, 1 island"


def test_without_new_seams_the_report_tells_why() -> None:
    flat = {"stretch": 0.0, "stretches": [0.0], "stretch_wanted": 17.0}
    far = {"stretch": 30.0, "stretches": [30.0], "stretch_wanted": 17.0}
    assert Outcome(0, 0, 1, unwrapped=1, **flat).text == "No seam needed: 1 island unwrapped"
    assert Outcome(0, 0, 1, unwrapped=0, **flat).text == "Nothing to add: all islands already unwrap within the limit"
    assert Outcome(0, 0, 1, **far).text == "No useful seam found: stretch 30 %, 17 % was not reached"
    overlapping = Outcome(0, 0, 1, unwrapped=1, faults=MapFaults(overlapping=1), **flat)
    assert overlapping.text == "No seam needed: 1 island unwrapped, 1 island overlaps"
    assert not overlapping.is_good


def test_small_stretches_are_told_with_a_decimal_place() -> None:
    assert [percent(stretch) for stretch in (0.0, 0.46, 9.0, 9.96, 17.2, 172660.0)] == [
        "0 %", "0.5 %", "9 %", "10 %", "17 %", "172660 %",
    ]  # fmt: skip
    assert not is_beyond(0.54, 0.5)
    assert is_beyond(0.56, 0.5)
    assert is_beyond(float("inf"), 1000.0)
    assert not_reached([], 17.0) == ""


def test_what_is_wrong_with_a_map_is_told_and_nothing_if_nothing_is_wrong() -> None:
    assert in_words(MapFaults()) == []
    assert in_words(MapFaults(3, 2, 1)) == [
        "2 islands overlap",
        "3 faces turned over",
        "1 island outside the UV square",
    ]
    assert in_words(MapFaults(1, 1)) == ["1 island overlaps", "1 face turned over"]
