# SPDX-License-Identifier: GPL-3.0-or-later
"""Points found by their place, and wires mirrored over the object's axes."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from fake_live import grid_edges, grid_triangles
from seamwire.core.base.nearest_vertices import NearestVertices
from seamwire.core.network.symmetry import TOLERANCE, Symmetry
from seamwire.core.network.wires import Wire
from seamwire.core.sketch.picture import Role
from setting import insert, use
from table import SIZE, Table, chain
from table import centred_points as centred
from table import wire as wire_of_table

wire = partial(wire_of_table, points=centred())


# Places


def test_of_points_in_one_place_the_first_is_found() -> None:
    assert NearestVertices(np.zeros((500, 3))).find(np.zeros((2, 3)), 1e-3).tolist() == [0, 0]
    assert NearestVertices(np.empty((0, 3))).find(np.zeros((1, 3)), 1e-3).tolist() == [-1]


def test_every_place_has_a_reach_of_its_own() -> None:
    generator = np.random.default_rng(2)
    points = generator.uniform(-1.0, 1.0, (300, 3))
    places = np.concatenate([points + generator.normal(0.0, 0.02, points.shape), generator.uniform(-1, 1, (300, 3))])
    reach = 10.0 ** generator.uniform(-3.0, -0.5, len(places))
    gaps = np.linalg.norm(places[:, None] - points[None], axis=2)
    expected = np.where(gaps.min(axis=1) <= reach, gaps.argmin(axis=1), -1)
    assert (NearestVertices(points).find(places, reach) == expected).all()
    assert 100 < (expected >= 0).sum() < 500


@pytest.mark.parametrize("far", [1e4, 1e30, np.inf, np.nan])
def test_a_point_far_from_all_others_does_not_hide_them(far: float) -> None:
    points = np.vstack([centred(40) * 1e-3, [[far, 0.0, -far]]])
    with np.errstate(all="raise"):
        found = NearestVertices(points).find(points + 1e-4, 2e-4)
    assert (found[:-1] == np.arange(1600)).all()


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("place", [0.0, 1e30, np.inf, -np.inf, np.nan, 1e300])
def test_points_without_a_place_or_all_in_one_are_no_fault(place: float) -> None:
    points = np.full((5, 3), place)
    found = NearestVertices(points).find(points, np.array([0.0, 1.0, np.inf, np.nan, -1.0]))
    assert found.tolist() == ([0, 0, 0, -1, -1] if abs(place) < 1e100 else [-1] * 5)


# The mirror


def test_vertices_have_partners_within_blenders_tolerance() -> None:
    points = centred()
    points[0, 1] += 0.9 * TOLERANCE
    points[6, 1] += 1.1 * TOLERANCE
    partners = Symmetry(points).partners((0,))
    assert partners[0] == 5
    assert partners[6] == -1
    assert partners[12] == 17


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


def test_ninety_thousand_vertices_are_mirrored() -> None:
    size = 300
    x, y = np.meshgrid(np.linspace(-1.0, 1.0, size), np.linspace(-1.0, 1.0, size))
    half = np.stack([x.ravel(), y.ravel(), np.sin(3.0 * y.ravel()) * np.abs(x.ravel())], axis=1)
    points = half[np.random.default_rng(0).permutation(len(half))].astype(np.float32).astype(np.float64)
    mirror = Symmetry(points)
    partners = mirror.partners((0,))
    assert np.allclose(points[partners], points * [-1.0, 1.0, 1.0], atol=TOLERANCE)
    assert mirror.symmetric_axes == (0,)


# Partners of meshes that are not quite symmetric


def noisy(size: int, by: float) -> np.ndarray:
    """Return the grid with its vertices off their places by up to `by` edges along each axis."""
    return centred(size) + np.random.default_rng(3).uniform(-by, by, (size**2, 3))


def mirrored_numbers(size: int) -> np.ndarray:
    return np.arange(size**2).reshape(size, size)[:, ::-1].ravel()


@pytest.mark.parametrize("scale", [1e-4, 1.0, 1e4])
def test_partners_are_found_within_a_part_of_the_edges_around(scale: float) -> None:
    points = noisy(20, 0.06) * scale
    assert (Symmetry(points, grid_edges(20)).partners((0,)) == mirrored_numbers(20)).all()
    points[7] += [0.5 * scale, 0.0, 0.0]
    partners = Symmetry(points, grid_edges(20)).partners((0,))
    assert partners[[7, 12]].tolist() == [-1, -1]
    assert (partners >= 0).sum() == 398


def test_what_counts_are_the_edges_at_the_vertex() -> None:
    coarse, fine = centred(6), centred(6) * 0.1 + [0.0, 100.0, 0.0]
    points = np.vstack([coarse, fine])
    points[[0, 36]] += [0.0, 0.0, 0.1]  # a tenth of an edge there, a whole one here
    edges = np.vstack([grid_edges(6), grid_edges(6) + 36])
    partners = Symmetry(points, edges).partners((0,))
    assert partners[0] == 5
    assert partners[36] == -1


def test_partners_are_one_to_one() -> None:
    points = noisy(20, 0.15)
    symmetry = Symmetry(points, grid_edges(20))
    for axes in ((0,), (1,), (0, 1)):
        partners = symmetry.partners(axes)
        own = np.flatnonzero(partners >= 0)
        assert (partners[partners[own]] == own).all()
        assert 100 < len(own) < 400


@pytest.mark.parametrize("few", [False, True])
def test_vertices_in_one_place_have_partners_of_their_own(few: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    count, edges = SIZE**2, grid_edges(SIZE)
    symmetry = Symmetry(np.vstack([centred()] * 3), np.vstack([edges, edges + count, edges + 2 * count]))
    if few:
        monkeypatch.setattr("seamwire.core.network.symmetry._SAMPLE", 0)
    images = symmetry.images(wire(count, count + 1, count + 7, points=np.vstack([centred()] * 3)), (0,))
    assert [image.vertices for image in images] == [(count + 5, count + 4, count + 10)]
    assert (np.sort(symmetry.partners((0,))) == np.arange(3 * count)).all()


def test_of_a_large_mesh_that_is_not_quite_symmetric_a_few_have_the_partners_that_all_have(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    points = noisy(20, 0.15)
    expected = Symmetry(points, grid_edges(20)).partners((0,))
    monkeypatch.setattr("seamwire.core.network.symmetry._SAMPLE", 0)
    monkeypatch.setattr(Symmetry, "partners", lambda *_: pytest.fail("all vertices were looked for"))
    few = Symmetry(points, grid_edges(20))._partners_of(np.arange(0, 400, 3), (0,))
    assert (few == expected[::3]).all()


@pytest.mark.parametrize("share", [0.01, 0.15])
def test_a_mesh_with_vertices_that_have_no_partners_is_symmetric_still(share: float) -> None:
    points = noisy(20, 0.05)
    moved = np.random.default_rng(4).permutation(400)[: int(200 * share)]
    points[moved, 2] += 1.0
    assert Symmetry(points, grid_edges(20)).symmetric_axes == (0, 1)


def test_what_has_no_symmetry_is_not_symmetric() -> None:
    points = centred(40)
    points[:, :2] = points[:, :2] @ [[0.96, 0.28], [-0.28, 0.96]]
    points[:, 2] = 1.0 + 0.05 * (points[:, 0] + 3.0) ** 2
    assert Symmetry(points, grid_edges(40)).symmetric_axes == ()


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


def test_in_a_pose_partners_are_found_by_topology() -> None:
    by_place = Symmetry(bent(16), grid_edges(16))
    assert (by_place.partners((0,)) >= 0).sum() == 32, "beside the plane alone"
    for points in (bent(16), bent(15)):
        size = int(len(points) ** 0.5)
        symmetry = Symmetry(points, grid_edges(size), topology=True, triangles=grid_triangles(size))
        assert (symmetry.partners((0,)) == mirrored_numbers(size)).all()
        assert symmetry.symmetric_axes == (0, 1)
        flat = points[:, 2] == 0.0
        assert (symmetry.partners((2,)) == np.where(flat, np.arange(size**2), -1)).all()
        assert symmetry.on_plane((0,)) == set(range(size // 2, size**2, size) if size % 2 else [])
        assert (symmetry.partners((0, 1)) == np.arange(size**2)[::-1]).all()


def test_topology_needs_faces_of_any_kind_and_goes_around_what_is_different() -> None:
    size = 16
    triangles, edges = grid_triangles(size), grid_edges(size)
    # On the right, a quad is two triangles, and another is missing.
    edges = np.vstack([edges, [[3 * size + 12, 4 * size + 13]]])
    missing = 2 * (8 * (size - 1) + 11)
    triangles = np.delete(triangles, [missing, missing + 1], axis=0)
    symmetry = Symmetry(bent(size), edges, topology=True, triangles=triangles)
    assert (symmetry.partners((0,)) == mirrored_numbers(size)).all()


def test_where_places_lie_about_a_part_topology_does_not() -> None:
    size = 16
    points = centred(size)
    # On top, the right side has moved by an edge: what lies at the image of a vertex there is its partner's neighbor.
    points[(points[:, 0] > 0.0) & (points[:, 1] > 4.0), 0] += 1.0
    by_place = Symmetry(points, grid_edges(size)).partners((0,))
    assert ((by_place >= 0) & (by_place != mirrored_numbers(size))).sum() >= 30
    symmetry = Symmetry(points, grid_edges(size), topology=True, triangles=grid_triangles(size))
    assert (symmetry.partners((0,)) == mirrored_numbers(size)).all()


@pytest.mark.parametrize("diagonal", [(0, 2), (1, 3)])
def test_topology_ends_where_faces_differ(diagonal: tuple[int, int]) -> None:
    length = 10
    x = np.arange(length) - 4.5
    rails = np.column_stack([np.concatenate([x, x]), np.repeat([0.0, 1.0], length), np.zeros(2 * length)])
    rails[rails[:, 0] > 1.0] += [0.3, 0.0, 0.4]
    low = np.arange(length - 1)
    quads = np.stack([low, low + 1, low + 1 + length, low + length], axis=1)
    sides = np.sort(np.vstack([quads[:, [0, 1]], quads[:, [1, 2]], quads[:, [2, 3]], quads[:, [3, 0]]]), axis=1)
    split = quads[6]  # next to the last but one
    triangles = np.vstack([np.delete(quads, 6, axis=0)[:, [0, 1, 2]], np.delete(quads, 6, axis=0)[:, [0, 2, 3]]])
    a, b = diagonal
    cut = [np.roll(split, -a)[:3], np.roll(split, -b)[:3]]
    edges = np.vstack([np.unique(sides, axis=0), np.sort(split[list(diagonal)])[None]])
    symmetry = Symmetry(rails, edges, topology=True, triangles=np.vstack([triangles, cut]).astype(np.int32))
    partners = symmetry.partners((0,)).reshape(2, length)
    assert (partners[:, 3:7] == np.arange(2 * length).reshape(2, length)[:, ::-1][:, 3:7]).all()
    assert (partners[:, [0, 1, 2, 7, 8, 9]] == -1).all()


def test_in_a_pose_images_of_wires_across_the_surface_lie_on_the_mesh() -> None:
    points = bent(16)
    symmetry = Symmetry(points, grid_edges(16), topology=True, triangles=grid_triangles(16))
    (image,) = symmetry.images(replace(wire(1, 2, 3, points=points), along="SURFACE"), (0,))
    assert (image.points == points[[14, 13, 12]]).all()


def test_parts_that_growing_does_not_come_to_are_mirrored_by_place() -> None:
    size, count = 8, 64
    left = centred(size) * 0.3 - [20.0, 0.0, 5.0]
    points = np.vstack([bent(size), left, left * [-1.0, 1.0, 1.0], [[30.0, 0.0, 0.0], [-30.0, 0.0, 0.0]]])
    edges = np.vstack([grid_edges(size) + count * part for part in range(3)])
    triangles = grid_triangles(size)
    triangles = np.vstack([triangles, triangles + count, triangles[:, ::-1] + 2 * count])
    partners = Symmetry(points, edges, topology=True, triangles=triangles).partners((0,))
    assert (partners[:count] == mirrored_numbers(size)).all()
    assert (partners[count : 3 * count] == np.roll(np.arange(count, 3 * count), count)).all()
    assert partners[3 * count :].tolist() == [3 * count + 1, 3 * count]


@pytest.mark.filterwarnings("error")
def test_topology_of_nothing_and_of_broken_meshes() -> None:
    none = np.empty((0, 2), dtype=np.int32), np.empty((0, 3), dtype=np.int32)
    assert Symmetry(np.empty((0, 3)), none[0], topology=True, triangles=none[1]).symmetric_axes == ()
    assert (Symmetry(centred(), none[0], topology=True, triangles=none[1]).partners((0,)) == mirrored_numbers(6)).all()
    generator = np.random.default_rng(5)
    triangles = generator.integers(0, 36, (200, 3)).astype(np.int32)
    partners = Symmetry(centred(), grid_edges(SIZE), topology=True, triangles=triangles).partners((0,))
    assert (partners[partners] == np.arange(36)).all()


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
