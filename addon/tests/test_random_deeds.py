# SPDX-License-Identifier: GPL-3.0-or-later
"""A session stays sound whatever is done to it, and undo brings back where it began."""

from __future__ import annotations

import random
from collections.abc import Callable

import numpy as np
import pytest
from fake_live import grid_edges, grid_points, grid_triangles
from numpy.typing import NDArray
from seamwire.core.eventual import EventualLive, Eventually
from seamwire.core.network import Pick, Snap
from seamwire.core.serialization import dump, load
from seamwire.core.session import CLAMP_PERCENTILE, STRENGTHS, Session

core = pytest.importorskip("seamwire_core")

SIZE = 12
EDGES = grid_edges(SIZE)
PAIRS = {tuple(sorted(pair)) for pair in EDGES.tolist()}


def hills() -> NDArray[np.float64]:
    points = grid_points(SIZE)
    points[:, :2] -= (SIZE - 1) / 2
    points[:, 2] = np.cos(points[:, 0]) * np.sin(points[:, 1])
    return points


class Monkey:
    """Does things at random to a session on a grid."""

    def __init__(self, seed: int) -> None:
        self.dice = random.Random(seed)
        self.points = hills()
        surface = core.Surface(self.points, grid_triangles(SIZE), EDGES)

        def live(along: str) -> object:
            return core.LiveWire(
                surface, along=along.lower(), max_anisotropy=STRENGTHS[along], clamp_percentile=CLAMP_PERCENTILE
            )

        self.session = Session(
            lambda along: EventualLive(Eventually(lambda: live(along))),
            self.points,
            edges=EDGES,
            seams=[(40, 41), (41, 53)],
            triangles=grid_triangles(SIZE),
        )
        session = self.session
        self.deeds: list[Callable[[], object]] = [
            *[lambda: session.click(self.snap())] * 6,
            *[lambda: session.hover(self.snap(), loop=self.dice.random() < 0.3)] * 6,
            *[lambda: session.loop(self.snap())] * 3,
            *[self.stroke] * 3,
            *[session.toggle, session.poll, session.undo] * 3,
            *[session.redo, session.wait] * 2,
            lambda: session.start(self.snap()),
            lambda: session.drag(self.snap()),
            lambda: session.drag_to(self.snap()),
            session.drag_end,
            session.drag_cancel,
            session.end_chain,
            session.close,
            lambda: session.run_to_end(preview=self.dice.random() < 0.5),
            lambda: session.switch(self.dice.choice(["EDGES", "EDGES", "SURFACE"])),
            lambda: session.change_strength(self.dice.choice([-1, 1])),
            lambda: session.set_metric(self.dice.choice(["feature", "campen", "euclidean"])),
            lambda: session.set_mirror(self.dice.choice([(), (0,), (0, 1)])),
            session.toggle_marking,
            self.with_wire(session.toggle_kept),
            self.with_wire(session.drop),
            self.with_wire(lambda wire: session.insert(wire, self.dice.choice(wire.vertices))),
            self.erase,
            self.store,
        ]

    def snap(self) -> Snap:
        session, dice = self.session, self.dice
        kind = dice.random()
        if kind < 0.2 and session.seeds():
            return Snap(dice.choice(session.seeds()), "SEED")
        if kind < 0.4 and session.wires:
            wire = dice.choice(session.wires)
            return Snap(dice.choice([*wire.vertices, *wire.edges()]), "WIRE", wire)
        pick: Pick = dice.randrange(SIZE**2)
        return Snap(tuple(dice.choice(EDGES.tolist())) if dice.random() < 0.6 else pick)

    def with_wire(self, deed: Callable[[object], object]) -> Callable[[], object]:
        return lambda: deed(self.dice.choice(self.session.wires)) if self.session.wires else None

    def stroke(self) -> None:
        attracts = self.dice.random() < 0.7
        if self.dice.random() < 0.3:
            vertices = [self.dice.randrange(SIZE**2) for _ in range(self.dice.randrange(1, 5))]
            self.session.scribble(vertices=vertices, attracts=attracts)
            return
        faces = [self.dice.randrange(2 * (SIZE - 1) ** 2) for _ in range(self.dice.randrange(1, 20))]
        middles = self.points[grid_triangles(SIZE)[faces]].mean(axis=1)
        self.session.scribble(middles, faces, attracts=attracts)

    def erase(self) -> None:
        if self.session.scribbles:
            self.session.erase(self.dice.choice(self.session.scribbles))

    def store(self) -> None:
        if self.session.dragging:
            return
        network, problems = load(dump(self.session.network, self.points), self.points, EDGES)
        assert problems == []
        assert [wire.edges() for wire in network.wires] == [wire.edges() for wire in self.session.wires]
        assert len(network.scribbles) == len(self.session.scribbles)
        if self.dice.random() < 0.3:
            self.session.resume(network)

    def check(self) -> None:
        session = self.session
        assert set(session.edges_to_mark()).isdisjoint(session.edges_to_clear())
        for wire in session.wires:
            assert PAIRS.issuperset(wire.edges())
            if wire.along == "EDGES":
                around = [*wire.vertices, *wire.vertices[:1]] if wire.closed else list(wire.vertices)
                assert np.array_equal(wire.points, self.points[around])
        assert (session.loop_choice is None) == (session.loop_offers == ())
        assert len(set(session.loop_offers)) == len(session.loop_offers)
        assert session.intent is not None


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_whatever_is_done_the_network_is_sound_and_undo_leads_back(seed: int) -> None:
    monkey = Monkey(seed)
    session = monkey.session
    for _ in range(400):
        monkey.dice.choice(monkey.deeds)()
        monkey.check()
    session.drag_cancel()
    session.end_chain()
    session.wait()
    left = 1000
    while session.can_undo and left:
        session.undo()
        left -= 1
    assert left
    assert session.wires == ()
    assert session.scribbles == ()
    session.switch("EDGES")
    session.set_metric("feature")
    session.set_strength("EDGES", STRENGTHS["EDGES"])
    session.start(0)
    session.hover(SIZE**2 - 1)
    session.wait()
    fresh = Monkey(seed).session
    fresh.start(0)
    fresh.hover(SIZE**2 - 1)
    fresh.wait()
    assert session.active.vertices == fresh.active.vertices, "the strokes left no trace"
