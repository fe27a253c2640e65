# SPDX-License-Identifier: GPL-3.0-or-later
"""A session stays sound whatever is done to it, and undo brings back where it began."""

from __future__ import annotations

import random
from collections.abc import Callable

import numpy as np
import pytest
from fake_live import grid_edges, grid_points, grid_triangles
from numpy.typing import NDArray
from paper_mesh import PaperMesh
from seamwire.core.network.drawn import Drawn
from seamwire.core.network.network import Snap
from seamwire.core.network.picks import Edge, Pick
from seamwire.core.sketch.dragging import Dragging
from seamwire.core.sketch.picture import Intent
from seamwire.core.sketch.sketch import Sketch
from seamwire.core.storage.wire_labels import Plan
from seamwire.terms.options import CLAMP_PERCENTILE, STRENGTHS
from setting import end_line, insert, stronger, use

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

        def live(along: str) -> object:
            mesh = self.points, grid_triangles(SIZE), EDGES
            return core.LiveWire(
                *mesh, along=along.lower(), max_anisotropy=STRENGTHS[along], clamp_percentile=CLAMP_PERCENTILE
            )

        self.session = Sketch(
            live,
            self.points,
            edges=EDGES,
            seams=[(40, 41), (41, 53)],
            triangles=grid_triangles(SIZE),
        )
        self.mesh = PaperMesh(self.points, EDGES, triangles=grid_triangles(SIZE), seams={(40, 41), (41, 53)})
        self.plain: set[Edge] = set(self.mesh.seams)
        """The edges that are seams with or without wires."""
        self.begun = Drawn()
        """The state of the session after everything is undone."""
        self.saved = [(self.mesh.snapshot(), set(self.plain))]
        session = self.session
        self.deeds: list[Callable[[], object]] = [
            *[lambda: session.click(self.snap())] * 6,
            *[lambda: session.hover(self.snap(), loop=self.dice.random() < 0.3)] * 6,
            *[lambda: session.loop(self.snap())] * 3,
            *[self.stroke] * 3,
            *[session.next_candidate, session.poll, session.undo] * 3,
            *[session.redo, session.wait] * 2,
            lambda: session.start(self.snap()),
            lambda: session.drag(self.snap()),
            lambda: session.drag_to(self.snap()),
            session.drag_end,
            session.cancel,
            lambda: session.line_begin(self.snap()),
            *[self.line_on] * 3,
            *[lambda: end_line(session)] * 2,
            session.cancel,
            session.end_chain,
            session.close,
            lambda: session.run_to_end(preview=self.dice.random() < 0.5),
            lambda: use(session, along=self.dice.choice(["EDGES", "EDGES", "SURFACE"])),
            lambda: stronger(session, self.dice.choice([-1, 1])),
            lambda: use(session, metric=self.dice.choice(["feature", "concave", "euclidean"])),
            lambda: use(session, mirror=self.dice.choice([(), (0,), (0, 1)])),
            lambda: use(session, clear=not session.options.clear),
            self.with_wire(session.retrace),
            self.with_wire(session.drop),
            self.with_wire(lambda wire: insert(session, wire, self.dice.choice(wire.vertices))),
            self.erase,
            *[self.store] * 2,
            self.undo_in_mesh,
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
            self.session.draw_stroke(vertices=vertices, attracts=attracts)
            return
        faces = [self.dice.randrange(2 * (SIZE - 1) ** 2) for _ in range(self.dice.randrange(1, 20))]
        middles = self.points[grid_triangles(SIZE)[faces]].mean(axis=1)
        self.session.draw_stroke(middles, faces, attracts=attracts)

    def line_on(self) -> None:
        start, step = self.dice.randrange(2 * (SIZE - 1) ** 2), self.dice.choice([1, 2, 2 * (SIZE - 1)])
        faces = np.arange(start, 2 * (SIZE - 1) ** 2, step, dtype=np.int32)[: self.dice.randrange(1, 20)]
        middles = self.points[grid_triangles(SIZE)[faces]].mean(axis=1)
        self.session.line_to(middles, faces, self.snap() if self.dice.random() < 0.5 else None)

    def erase(self) -> None:
        if self.session.network.strokes:
            self.session.erase(self.dice.choice(self.session.network.strokes))

    def store(self) -> None:
        session, mesh = self.session, self.mesh
        if session.holds(Dragging):
            return
        session.wait()
        cleared = set(session.edges_to_clear())
        self.plain -= cleared
        for wire in session.wires:
            if wire.marks and not cleared.isdisjoint(wire.edges()):
                self.plain |= set(wire.claims()) - cleared
        plan = mesh.write(session)
        assert mesh.seams == self.plain | set(session.edges_to_mark())
        again = mesh.write(session)
        assert (again.mark, again.clear, again.labels) == ([], [], {}), "done once, it is done"
        self.check_stored(plan)
        if self.dice.random() < 0.3:
            self.open()
            self.saved.append((mesh.snapshot(), set(self.plain)))

    def check_stored(self, plan: Plan) -> None:
        """Whether a Blender that was just started finds in the mesh what there is."""
        mesh, expected = self.mesh, plan.network
        found = mesh.read()
        assert found.known == plan.known
        assert (found.broken, mesh.unknown()) == (set(), 0)
        assert looks(found.network) == looks(expected)
        assert len(found.network.strokes) == len(expected.strokes)
        marked = {edge for wire in found.network.wires for edge in wire.claims()}
        assert mesh.plain_seams() == mesh.seams - marked
        assert marked <= mesh.seams
        assert self.plain | marked == mesh.seams

    def open(self) -> None:
        self.mesh.open(self.session, self.mesh.archive)
        self.begun = self.session.drawn
        assert not self.session.picture.can_undo

    def undo_in_mesh(self) -> None:
        """Let Blender take back what was written, while no chain is drawn."""
        if self.session.seed is not None or self.dice.random() < 0.5:
            return
        snapshot, plain = self.dice.choice(self.saved)
        self.mesh.undo(snapshot)
        self.plain = set(plain)
        self.mesh.open(self.session, self.mesh.archive)
        self.begun = self.session.drawn
        assert self.mesh.unknown(self.mesh.archive) == 0
        assert self.mesh.seams == self.plain | set(self.session.edges_to_mark())

    def check(self) -> None:
        session = self.session
        assert set(session.edges_to_mark()).isdisjoint(session.edges_to_clear())
        for wire in session.wires:
            assert PAIRS.issuperset(wire.edges())
            if wire.along == "EDGES":
                around = [*wire.vertices, *wire.vertices[:1]] if wire.closed else list(wire.vertices)
                assert np.array_equal(wire.points, self.points[around])
        assert (session.picture.offered.kind is None) == (session.picture.offered.kinds == ())
        offers = session.offering.offers
        assert len({frozenset(offer.edges()) for offer in offers}) == len(offers)
        assert (session.picture.intent is Intent.MOVE) == (session.holds(Dragging) is not None)


def looks(network: Drawn) -> set[tuple[object, ...]]:
    """Return what there is to be seen of wires; of several that are the same, one is."""
    return {
        (wire.along, wire.vertices, wire.closed, wire.follow, wire.mirror, frozenset(wire.images or ()))
        for wire in network.wires
    }


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_whatever_is_done_the_network_is_sound_and_undo_leads_back(seed: int) -> None:
    monkey = Monkey(seed)
    session = monkey.session
    for _ in range(400):
        monkey.dice.choice(monkey.deeds)()
        monkey.check()
    session.cancel()
    session.end_chain()
    session.wait()
    left = 1000
    while session.picture.can_undo and left:
        session.undo()
        left -= 1
    assert left
    assert looks(session.drawn) == looks(monkey.begun)
    assert [one.id for one in session.network.strokes] == [one.id for one in monkey.begun.strokes]
    for stroke in session.network.strokes:
        session.erase(stroke)
    use(session, along="EDGES")
    use(session, metric="feature")
    use(session, strength_edges=STRENGTHS["EDGES"])
    session.start(0)
    session.hover(SIZE**2 - 1)
    session.wait()
    fresh = Monkey(seed).session
    fresh.start(0)
    fresh.hover(SIZE**2 - 1)
    fresh.wait()
    assert session.picture.active.vertices == fresh.picture.active.vertices, "the strokes left no trace"
