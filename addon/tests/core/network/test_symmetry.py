# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires mirrored over the object's axes."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from fake_live import grid_edges, grid_triangles
from seamwire.core.network.symmetry import Symmetry
from seamwire.core.network.wires import Wire
from seamwire.core.sketch.picture import Role
from setting import insert, use
from table import SIZE, Table, chain
from table import centred_points as centred
from table import wire as wire_of_table

wire = partial(wire_of_table, points=centred())


# The mirror


def test_symmetric_axes_are_those_where_most_have_a_partner() -> None:
    points = centred(8)
    assert Symmetry(points).symmetric_axes == (0, 1), "all lies in the plane of z, which is no symmetry"
    points[:8] += 0.1
    assert Symmetry(points).symmetric_axes == (0, 1), "8 of 64 vertices have none over x, 16 over y"
    points[8] += 0.1
    assert Symmetry(points).symmetric_axes == (0,), "over y it is 18 of them"
    assert Symmetry(np.empty((0, 3))).symmetric_axes == ()


def test_a_wires_image_runs_on_the_other_side() -> None:
    images = Symmetry(centred(), grid_edges(SIZE)).images(wire(0, 1, 7), (0,))
    assert [image.vertices for image in images] == [(5, 4, 10)]
    assert images[0].points.tolist() == centred()[[5, 4, 10]].tolist()


def test_what_is_its_own_image_is_not_doubled() -> None:
    mirror = Symmetry(centred(5), grid_edges(5))
    on_plane = wire(2, 7, 12, points=centred(5))
    across = wire(5, 6, 7, 8, 9, points=centred(5))
    assert mirror.images(on_plane, (0,)) == []
    assert mirror.images(across, (0,)) == []
    assert [image.vertices for image in mirror.images(on_plane, (0, 1))] == [(22, 17, 12)]
    assert mirror.on_plane((0,)) == {2, 7, 12, 17, 22}


def test_a_loops_image_is_a_loop() -> None:
    images = Symmetry(centred(), grid_edges(SIZE)).images(wire(0, 1, 7, 6, closed=True), (0,))
    assert images[0].closed
    assert sorted(images[0].edges()) == chain(5, 4, 10, 11, 5)


def test_where_the_mesh_lacks_edges_the_image_has_a_gap() -> None:
    edges = grid_edges(SIZE)
    without = edges[~((edges == [3, 4]).all(axis=1))]
    images = Symmetry(centred(), without).images(wire(0, 1, 2, 8), (0,))
    assert [image.vertices for image in images] == [(5, 4), (3, 9)]
    points = centred()
    points[4, 2] = 1.0
    images = Symmetry(points, edges).images(wire(0, 1, 2, 8), (0,))
    assert [image.vertices for image in images] == [(3, 9)]


def test_of_a_wire_that_is_cut_the_curve_is_mirrored_where_the_mesh_lacks_edges() -> None:
    points = centred()
    edges = grid_edges(SIZE)
    kept = edges[~(edges == 4).any(axis=1)]  # without those of the image's second vertex
    symmetry = Symmetry(points, kept)
    across = replace(wire(0, 1, 7, 6), points=points[[0, 7, 6]], along="SURFACE", finish="CUT")
    (image,) = symmetry.images(across, (0,), curves=True)
    assert image.vertices == (5, 11)
    assert image.points == pytest.approx(points[[5, 10, 11]])
    assert all(len(part.vertices) < 4 for part in symmetry.images(across, (0,)))
    assert not symmetry.one_sided(across, (0,))
    assert symmetry.one_sided(replace(across, finish="SNAP"), (0,))


@pytest.mark.parametrize("middle", [[1.5, 0.0], [0.0, 1.5], [1.5, 1.0], [0.0, 0.0]])
def test_each_mirror_image_of_a_wire_from_pole_to_pole_is_cut_once(middle: list[float]) -> None:
    # The poles are their own images, and the vertex between them has none.
    places = np.array([[0.0, 0.0, 1.0], [*middle, 0.0], [0.0, 0.0, -1.0]])
    points = places.copy()
    points[1] += (0.3, 0.4, 0.0)
    symmetry = Symmetry(points, np.array([[0, 1], [1, 2]]))
    across = Wire("SURFACE", (0, 1, 2), places, 0, 2, finish="CUT")
    images = symmetry.images(across, (0, 1), curves=True)
    assert all(image.vertices == (0, 2) for image in images)
    found = sorted(image.points[1].tolist() for image in images)
    mirrored = {(a * middle[0] + 0.0, b * middle[1] + 0.0, 0.0) for a in (1, -1) for b in (1, -1)}
    assert found == sorted(map(list, mirrored - {(*middle, 0.0)}))


def test_the_image_of_a_wire_within_a_face_is_another_wire_though_it_has_the_same_vertex() -> None:
    points = centred(3)
    curve = np.array([[0.2, 0.3, 0.0], [0.4, 0.3, 0.0]])  # nearest to the vertex in the middle
    across = Wire("SURFACE", (4,), curve, 4, 4, finish="CUT")
    (image,) = Symmetry(points, grid_edges(3)).images(across, (0,), curves=True)
    assert image.points == pytest.approx(curve * [-1.0, 1.0, 1.0])


def test_an_object_is_mirrored_in_its_own_coordinates() -> None:
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    points = centred() * [3.0, 1.0, 1.0]
    to_object = turn / 3.0
    images = Symmetry(points, grid_edges(SIZE), to_object).images(wire(0, 1, points=points), (0,))
    assert [image.vertices for image in images] == [(30, 31)], "the object's x runs along y here"
    assert np.allclose(images[0].points, points[[30, 31]])


# Meshes that are not quite symmetric


def noisy(size: int, by: float) -> np.ndarray:
    """Return the grid with its vertices off their places by up to `by` edges along each axis."""
    return centred(size) + np.random.default_rng(3).uniform(-by, by, (size**2, 3))


def test_what_has_no_partner_is_drawn_on_one_side_and_can_be_asked_for() -> None:
    points = noisy(SIZE, 0.05)
    points[4] += [0.0, 0.0, 1.0]  # the partner of vertex 1
    symmetry = Symmetry(points, grid_edges(SIZE))
    along = wire(0, 6, 7, 8, points=points)
    across = wire(6, 7, 1, 2, 8, 14, points=points)
    assert not symmetry.one_sided(along, (0,))
    assert symmetry.one_sided(across, (0,))
    assert not symmetry.one_sided(across, ())
    assert not symmetry.one_sided(along, (0, 1))
    assert symmetry.one_sided(across, (0, 1))
    images = symmetry.images(across, (0,))
    assert [image.vertices for image in images] == [(11, 10), (3, 9, 15)]
    assert all((image.points == points[list(image.vertices)]).all() for image in images), "on the mesh, not beside it"


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("place", [np.nan, np.inf, 1e300])
def test_vertices_without_a_place_have_no_partners_and_say_nothing(place: float) -> None:
    points = centred()
    points[[3, 20]] = place
    points[7] = points[8]
    symmetry = Symmetry(points, grid_edges(SIZE), np.diag([1.0, 0.0, 1.0]))
    assert symmetry.partners((0,))[[3, 20]].tolist() == [-1, -1]
    symmetry.on_plane((0, 1, 2))
    _ = symmetry.symmetric_axes
    symmetry.images(wire(2, 3, 4, points=points), (0, 1, 2))
    symmetry.images(replace(wire(0, 1), along="SURFACE"), (0, 1, 2))


# Partners by topology


def bent(size: int) -> np.ndarray:
    """Return the grid with what is right of the middle turned up, as an arm in a pose."""
    points = centred(size)
    right = np.maximum(points[:, 0] - 0.5, 0.0)
    points[:, 0] -= 0.7 * right
    points[:, 2] += 0.7 * right
    return points


def test_in_a_pose_images_of_wires_across_the_surface_lie_on_the_mesh() -> None:
    points = bent(16)
    symmetry = Symmetry(points, grid_edges(16), topology=True, triangles=grid_triangles(16))
    (image,) = symmetry.images(replace(wire(1, 2, 3, points=points), along="SURFACE"), (0,))
    assert (image.points == points[[14, 13, 12]]).all()


# In a session


def test_mirroring_is_for_wires_kept_from_then_on_and_no_step() -> None:
    session = Table(centred=True).session
    assert use(session, mirror=(0,))
    assert not session.picture.can_undo
    session.click(0)
    session.click(1)
    session.end_chain()
    assert use(session, mirror=())
    assert session.edges_to_mark() == [(0, 1), (4, 5)], "the kept wire keeps its images"
    session.click(12)
    session.click(13)
    assert session.edges_to_mark() == [(0, 1), (4, 5), (12, 13)]
    session.undo()
    assert session.options.mirror == ()
    assert session.edges_to_mark() == [(0, 1), (4, 5)]
    session.redo()
    assert session.edges_to_mark() == [(0, 1), (4, 5), (12, 13)]


def test_after_the_mirror_was_set_undo_does_not_stop_at_steps_that_changed_nothing() -> None:
    session = Table(centred=True).session
    session.click(0)
    session.adopt(session.drawn, [])
    assert not session.picture.can_undo
    use(session, mirror=(0,))
    assert not session.picture.can_undo
    assert not session.undo()


def test_a_wires_images_are_those_of_when_it_was_kept_and_follow_its_course() -> None:
    session = Table(centred=True).session
    use(session, mirror=(0,))
    session.click(0)
    session.click(8)
    session.end_chain()
    use(session, mirror=(1,))
    (wire,) = session.wires
    assert wire.mirror == (0,)
    assert sorted(wire.images) == chain(5, 4, 3, 9)
    assert session.retrace(wire)
    assert sorted(session.wires[0].images) == chain(5, 11, 10, 9)
    assert insert(session, session.wires[0], 6)
    assert [sorted(one.images) for one in session.wires] == [chain(5, 11), chain(11, 10, 9)]
    assert [one.mirror for one in session.wires] == [(0,), (0,)]
    assert [image.vertices for image in session.mirrored(session.wires[0])] == [(5, 11)]
    session.drag(8)
    session.drag_to(7)
    assert [image.vertices for image in session.mirrored(session.wires[1])] == [(11, 10)], "and are shown meanwhile"


def test_running_on_ends_where_the_wire_meets_its_image() -> None:
    table = Table(centred=True)
    session = table.session
    use(session, mirror=(0,))
    session.click(12)
    session.hover(13)
    session.run_to_end(preview=True)
    assert session.picture.one(Role.EXTENSION).vertices == (12, 13, 14, 15, 16), (
        "its image begins at 17 and leads to 16"
    )
