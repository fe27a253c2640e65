# SPDX-License-Identifier: GPL-3.0-or-later
"""Chains of seeds, as text and drawn without a hand."""

from __future__ import annotations

import pytest
from seamwire.words.seed_text import draw_chains, parse_chains
from table import Table


@pytest.mark.parametrize(
    ("text", "chains"),
    [
        ("0 512 88; 7-9 40 7-9", [[0, 512, 88], [(7, 9), 40, (7, 9)]]),
        ("0, 1", [[0, 1]]),
        (" 3-1   2 ;", [[(3, 1), 2]]),
        ("0 (.5 -2e-1, 1);(0,0,0) (1 2 3)7", [[0, (0.5, -0.2, 1.0)], [(0.0, 0.0, 0.0), (1.0, 2.0, 3.0), 7]]),
    ],
)
def test_chains_are_read(text: str, chains: list) -> None:
    assert parse_chains(text, tuple) == chains


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "no chains"),
        (" ; ", "no chains"),
        ("0 x", "'x'"),
        ("0 -1", "'-1'"),
        ("0 1; 2 3-", "Chain 2"),
        ("0 4-4", "the same"),
        ("7", "at least two"),
        ("0 1.5", "'1.5'"),
        ("0 ²", "'²'"),
        ("0 (1 2)", r"'\(1 2\)' is neither"),
        ("0 (1 2 nan)", "neither"),
        ("0 (1 2 3", r"'\(' is neither"),
        ("(1 2 3) (1 2 3)", "twice in a row"),
    ],
)
def test_what_is_not_a_chain_is_said(text: str, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        parse_chains(text, tuple)


def test_drawing_chains_waits_for_each_wire() -> None:
    table = Table(ready=(False, False))
    assert draw_chains(table.session, [[0, 2, 14], [(20, 21), (23, 24)]]) == []
    assert [wire.vertices for wire in table.session.wires] == [(0, 1, 2), (2, 8, 14), (20, 21, 22, 23, 24)]
    assert table.session.seed is None


def test_drawing_chains_goes_on_past_what_cannot_be_reached() -> None:
    table = Table(islands=(35,))
    problems = draw_chains(table.session, [[0, 35, 3], [6, 8]])
    assert problems == ["Chain 1: No wire reaches vertex 35"]
    assert [wire.vertices for wire in table.session.wires] == [(0, 1, 2, 3), (6, 7, 8)]
