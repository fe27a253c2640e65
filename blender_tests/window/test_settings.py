# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool's settings while a wire is live: it follows them at once, and what is kept stays as it is."""

from collections.abc import Iterator

import pytest
import ui as driver
from desk import Desk, leave
from scene import GATE_RIDGE, GATE_SEEDS, GATE_STRAIGHT, add_gate, chain, seams
from seamwire.core.sketch.picture import Role
from seamwire.mesh.settings import settings


@pytest.fixture
def gate(ui: driver.Ui) -> Iterator[Desk]:
    """A ridge in the shape of a gate, seen from above."""
    desk = Desk(ui, add_gate())
    ui.look_from_top(distance=3.0)
    yield desk
    leave(ui)


def test_metric_clamp_and_strength_change_the_live_wire(gate: Desk) -> None:
    session, ui = gate.start(), gate.ui
    chosen = settings()
    ridge, straight = chain(*GATE_RIDGE), chain(*GATE_STRAIGHT)

    def runs(edges: list[tuple[int, int]]) -> bool:
        active = session.picture.active
        return active is not None and session.picture.one(Role.COMPUTING) is None and sorted(active.edges()) == edges

    ui.click(gate.at(GATE_SEEDS[0]), ctrl=True)
    ui.move(gate.at(GATE_SEEDS[1]))
    ui.wait_until(lambda: runs(ridge))
    for name, value, before in (
        ("metric", "euclidean", "feature"),
        ("clamp", 50.0, 99.0),
        ("strength_edges", 2.0, 10.0),
    ):
        assert getattr(chosen, name) == before
        setattr(chosen, name, value)
        ui.wait_until(lambda: runs(straight))
        setattr(chosen, name, before)
        ui.wait_until(lambda: runs(ridge))
    chosen.strength_surface = 50.0
    ui.wait()
    assert runs(ridge), "the other way's strength is the other way's"
    ui.click(gate.at(GATE_SEEDS[1]))
    chosen.metric = "euclidean"
    ui.wait_until(lambda: not session.computing)
    ui.key("RET")
    assert seams(gate.obj) == ridge, "a kept wire stays"
