# SPDX-License-Identifier: GPL-3.0-or-later
"""The table with a row for every action."""

from __future__ import annotations

from seamwire.words.keys import Action, Bindings, Key


def test_no_two_actions_have_the_same_number() -> None:
    assert len({action.number for action in Action}) == len(Action)


def test_no_two_actions_have_the_same_key() -> None:
    keys = [key for action in Action for key in action.keys]
    assert len(set(keys)) == len(keys)


def test_the_groups_have_each_action_once() -> None:
    groups = Bindings().groups()
    assert [text for rows in groups.values() for _, text in rows] == [action.text for action in Action]
    assert Bindings([(Action.CLEAR, Key("J"))]).groups()["Set"] == [("J", Action.CLEAR.text)]
