# SPDX-License-Identifier: GPL-3.0-or-later
"""With Alt held, both directions are offered."""

from __future__ import annotations

import numpy as np
import pytest
from polygon_meshes import arrays_of, grid_places, grid_polygons
from seamwire.core.base.mesh_arrays import Arrays
from seamwire.core.network.network import Snap
from seamwire.core.picking.picker import Camera, Picker
from seamwire.core.sketch.sketch import Sketch
from seamwire.core.solver.solver import LiveMaker

pytest.importorskip("seamwire_core")

AROUND, RINGS = 16, 40
"""Of the limbs; vertex ring * AROUND + i."""


def limb(shift: float = 0.0) -> Arrays:
    """Return a closed limb along y with round ends; `shift` twists its rings, so that lengthwise edges run aslant."""
    turns = 2.0 * np.pi * np.arange(AROUND) / AROUND
    heights = np.linspace(-2.0, 2.0, RINGS)
    radii = 0.5 * np.sqrt(1.0 - (np.maximum(np.abs(heights) - 1.6, 0.0) / 0.45) ** 2)
    rings = [
        (r * np.sin(turns + shift * i), np.full(AROUND, h), r * np.cos(turns + shift * i))
        for i, (h, r) in enumerate(zip(heights, radii, strict=True))
    ]
    places = np.concatenate([np.stack(ring, axis=1) for ring in rings])
    places = np.vstack([places, [0.0, -2.05, 0.0], [0.0, 2.05, 0.0]])
    after = [(i, (i + 1) % AROUND) for i in range(AROUND)]
    polygons = [
        (AROUND * k + a, AROUND * k + b, AROUND * (k + 1) + b, AROUND * (k + 1) + a)
        for k in range(RINGS - 1)
        for a, b in after
    ]
    low, high = AROUND * RINGS, AROUND * RINGS + 1
    polygons += [(low, b, a) for a, b in after]
    polygons += [(high, low - AROUND + a, low - AROUND + b) for a, b in after]
    return arrays_of(places, polygons)


class Alt:
    """A session on a mesh that is seen along z, and a cursor with Alt held."""

    def __init__(self, arrays: Arrays, pixels_a_unit: float) -> None:
        self.arrays = arrays
        make = LiveMaker(arrays)
        self.session = Sketch(
            make, arrays.points, edges=arrays.edges, triangles=arrays.triangles, make_parts=make.part_finder
        )
        half = 200.0 / pixels_a_unit
        self.view = Camera(400.0, 400.0, np.diag([1.0 / half, 1.0 / half, -0.1, 1.0]))
        self.picker = Picker(arrays)

    def snap(self, x: float, y: float) -> Snap:
        """Return what is under the cursor at a place of the scene."""
        at = self.view.to_pixels(np.array([[x, y, 0.0]]))[0]
        found = self.picker.snap(
            self.view, np.eye(4), (float(at[0]), float(at[1])), vertices_only=False, edges_only=True
        )
        assert found is not None
        return found

    def over(self, x: float, y: float) -> list[set[int]]:
        """Point at a place and return the vertices of the first two offers."""
        self.session.hover(self.snap(x, y), loop=True)
        self.session.wait()
        return [set(offer.vertices) for offer in self.session.offering.offers[:2]]


def ring(number: int) -> set[int]:
    return set(range(AROUND * number, AROUND * (number + 1)))


def spots(count: int = 40) -> list[tuple[float, float]]:
    """Return places all over the front of the limb's straight part."""
    dice = np.random.default_rng(3)
    return np.stack([dice.uniform(-0.35, 0.35, count), dice.uniform(-1.4, 1.4, count)], axis=1).tolist()


def test_zoomed_out_the_ring_around_a_limb_comes_first_wherever_the_cursor_is() -> None:
    alt = Alt(limb(), 40.0)
    picked = set()
    for x, y in spots():
        snap = alt.snap(x, y)
        assert snap.is_close_call
        picked.add(abs(snap.pick[0] - snap.pick[1]) == AROUND)
        first, second = alt.over(x, y)
        assert first == ring(min(first) // AROUND)
        assert not second <= first
    assert picked == {False, True}, "edges of both directions were nearest to the cursor"


def test_a_chosen_direction_stays_while_the_cursor_moves_over_short_edges() -> None:
    alt = Alt(limb(), 40.0)
    alt.over(0.0, 0.0)
    assert alt.session.next_candidate()
    for x, y in spots():
        first, second = alt.over(x, y)
        assert second == ring(min(second) // AROUND)
        assert first != second
    alt.session.hover(alt.snap(0.0, 0.0))
    first, _ = alt.over(0.1, 0.0)
    assert first == ring(min(first) // AROUND), "Alt was released: the likelier one again"


def test_a_click_on_a_large_mesh_waits_for_the_faces() -> None:
    alt = Alt(arrays_of(grid_places(81), grid_polygons(81)), 150.0)
    alt.session.loop(alt.snap(0.013, 0.0))
    assert alt.session.waiting == 1
    alt.session.wait()
    assert len(alt.session.wires) == 1


def test_a_crossing_loop_is_kept_as_a_loop_through_its_own_edge_and_a_second_press_changes_nothing() -> None:
    alt = Alt(limb(), 200.0)
    session = alt.session
    snap = next(one for one in (alt.snap(x, y) for x, y in spots()) if abs(one.pick[0] - one.pick[1]) == AROUND)
    session.hover(snap, loop=True)
    session.wait()
    assert session.next_candidate()
    assert session.picture.offered.kind == "CROSSING"
    assert session.loop(snap)
    (wire,) = session.wires
    assert wire.kind == "CLOSED"
    assert wire.through in wire.edges()
    assert set(wire.vertices) == ring(min(wire.vertices) // AROUND)
    session.hover(snap, loop=True)
    session.wait()
    assert session.loop(snap)
    assert session.wires == (wire,)
    assert session.retrace(wire)
    assert set(session.wires[0].vertices) != set(wire.vertices)


def test_of_a_click_that_nothing_was_shown_for_the_first_offer_is_kept() -> None:
    alt = Alt(limb(), 40.0)
    snap = next(one for one in (alt.snap(x, y) for x, y in spots()) if abs(one.pick[0] - one.pick[1]) == AROUND)
    alt.session.loop(snap)
    alt.session.wait()
    (wire,) = alt.session.wires
    assert set(wire.vertices) == ring(min(wire.vertices) // AROUND)
