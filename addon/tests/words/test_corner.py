# SPDX-License-Identifier: GPL-3.0-or-later
"""What the corner of the view says of islands: nothing before the first seam, and nothing that sounds wrong while nothing is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from seamwire.core.islands.islands import Islands
from seamwire.core.islands.uv_maps import SquareUse
from seamwire.core.seams.seam_plan import PartChoice
from seamwire.core.seams.seam_wires import Gap
from seamwire.terms.choices import KINDS
from seamwire.words.hints import FoundMap, lines, rows_of_parts
from table import Table


def said(count: int, missing: int = 0, gaps: int = 0, parted: bool = True, pointed: int | None = None) -> list[str]:
    """Return the lines about islands; each has three triangles."""
    islands = Islands(
        key=None,
        count=count,
        labels=np.repeat(np.arange(count, dtype=np.int32), 3),
        hues=np.zeros(count, dtype=np.uint8),
        missing=np.full(count, missing, dtype=np.int32),
        cut=True,
        parted=parted,
        pieces=(),
        gaps=tuple(Gap(i, i + 1, 1.0) for i in range(gaps)),
    )
    picture = replace(Table().session.picture, islands=islands, pointed_island=pointed)
    return [line for line in lines(picture) if "sland" in line]


def test_before_seams_part_a_mesh_nothing_is_said_of_its_parts() -> None:
    assert said(3, parted=False, pointed=0) == []


def test_after_a_first_open_wire_neither_cuts_nor_gaps_are_named() -> None:
    assert said(1, missing=2, gaps=1, parted=False, pointed=0) == []


@pytest.mark.parametrize(("gaps", "text"), [(0, "4 islands"), (1, "4 islands, 1 gap in seams")])
def test_islands_and_gaps_are_counted(gaps: int, text: str) -> None:
    assert said(4, missing=1, gaps=gaps) == [text]


def test_the_island_under_the_mouse_says_what_it_needs_once_the_mesh_is_parted() -> None:
    assert said(2, missing=1, pointed=1)[1] == "Island 2: 3 triangles, flat with 1 more cut"
    assert said(2, pointed=1)[1] == "Island 2: 3 triangles"


def test_candidates_have_names_of_what_is_seen() -> None:
    assert not any("curvature" in name for name in KINDS.values())


def test_while_parts_are_shown_each_value_has_its_keys() -> None:
    choice = PartChoice(0.55, 17.0, islands=3)
    assert rows_of_parts(choice, 12, {}, None, False) == [
        ("Parts by: Auto", "W"),
        ("Parts: 12, amount 55 %", "Wheel"),
        ("Islands: at least 3", "Shift Wheel"),
        ("Stretch: at most 17 %", "Ctrl Wheel"),
    ]
    found = FoundMap(stretch=9.5, islands=14, length="2.3 m", used=SquareUse(0.58))
    assert rows_of_parts(choice, 12, {}, None, False, {"RIMS", "LIMBS"})[0] == ("Parts by: Auto (Limbs, Rims)", "W")
    rows = rows_of_parts(choice, 12, {"amount": 2, "stretch": -1}, found, True)
    assert rows == [
        ("Parts by: Auto", "W"),
        ("Parts: 12, amount 55 %, 2 notches past the end", "Wheel"),
        ("Islands: 14, at least 3", "Shift Wheel"),
        ("Stretch: 9.5 %, at most 17 %, 1 notch past the end", "Ctrl Wheel"),
        ("58 % of the UV square used", ""),
        ("Seams: 2.3 m", ""),
        ("Search ended", "Enter: Keep"),
    ]
    assert "best map so far" in rows_of_parts(choice, 12, {}, found, False)[-1][0]
