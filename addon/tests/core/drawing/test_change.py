# SPDX-License-Identifier: GPL-3.0-or-later
"""A chain's change, made on the network that undo has left."""

from __future__ import annotations

from dataclasses import replace

from seamwire.core.sketch.change import Change
from seamwire.core.network.network import Drawn
from seamwire.words.scripted import draw_chain
from table import Table

COURSES = ((2, 8, 14), (2, 3, 9, 8, 14), (2, 1, 7, 8, 14))


def drawn() -> Drawn:
    """Return a network of two wires, the second on the first of the courses."""
    session = Table().session
    assert draw_chain(session, [0, 2, 14]) == []
    first, second = session.drawn.wires
    return replace(session.network, wires=(first, replace(second, vertices=COURSES[0])))


def with_course(network: Drawn, number: int) -> Drawn:
    first, second = network.wires
    return replace(network, wires=(first, replace(second, vertices=COURSES[number])))


def test_a_wire_has_one_course_even_if_undo_leads_to_an_older_one() -> None:
    oldest = drawn()
    before = with_course(oldest, 1)
    found = Change(before, with_course(before, 2)).on(oldest)
    assert [wire.vertices for wire in found.wires] == [oldest.wires[0].vertices, COURSES[2]]
    assert found.wires[1].id == oldest.wires[1].id


def test_a_wire_that_undo_removed_does_not_return_because_another_was_joined_to_it() -> None:
    before = drawn()
    first, second = before.wires
    after = replace(before, wires=(first, replace(second, heading=(0, 1))))
    undone = replace(before, wires=(first,))
    assert Change(before, after).on(undone).wires == (first,)
    assert len(Change(before, after).on(before).wires) == 2
