# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables with a row for every action, or for every kind of loop."""

from __future__ import annotations

from seamwire.words.keys import GROUPS, NUMBERS, Action, Bindings, Key


def test_each_action_has_a_number() -> None:
    assert set(NUMBERS) == set(Action)
    assert len(set(NUMBERS.values())) == len(NUMBERS)


def test_each_action_is_in_one_group_of_the_table_of_keys() -> None:
    grouped = [action for group in GROUPS.values() for action in group]
    assert len(grouped) == len(set(grouped))
    assert set(grouped) == set(Action)


def test_the_groups_have_all_rows_of_the_table_of_keys() -> None:
    groups = Bindings().groups()
    assert list(groups) == list(GROUPS)
    assert sorted(row for rows in groups.values() for row in rows) == sorted(Bindings().rows())
    assert Bindings([(Action.CLEAR, Key("J"))]).groups()["Set"] == [("J", Action.CLEAR.value)]
