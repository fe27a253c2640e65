# SPDX-License-Identifier: GPL-3.0-or-later
"""What separates parts, as an artist goes through it."""

from dataclasses import replace

from seamwire.core.seams.seam_plan import PartChoice, PartEdits, parted_by_next
from seamwire.terms.choices import PARTS_BY
from seamwire.words.reports import parts_text


def test_each_row_keeps_its_amount_and_edits_and_limits_are_common() -> None:
    edits = {"Shirt": PartEdits().part(3)}
    made = [PartChoice(0.5, 17.0), PartChoice(0.7, 22.0, islands=2, edits=edits)]
    for _ in PARTS_BY:
        made.append(parted_by_next(made))
    assert [choice.by for choice in made[1:]] == ["AUTO", "RIMS", "LIMBS", "PANELS", "AUTO"]
    assert all((choice.amount, choice.edits) == (0.5, {}) for choice in made[2:5])
    assert {(choice.stretch, choice.islands) for choice in made[1:]} == {(22.0, 2)}
    assert made[-1] == made[1]
    made.append(replace(made[-1], by="LIMBS", amount=0.2))
    made += [parted_by_next(made)]
    assert made[-1] == PartChoice(0.5, 22.0, islands=2, by="PANELS")


def test_the_text_names_what_was_chosen_by_hand() -> None:
    assert parts_text("AUTO", 0.5, 1, 17.0) == "Parts: 50 %, 1 part    Stretch: up to 17 %"
    assert parts_text("PANELS", 0.5, 2, 17.0).startswith("Parts by Front and Back: 50 %, 2 parts")
