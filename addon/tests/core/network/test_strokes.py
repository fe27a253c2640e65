# SPDX-License-Identifier: GPL-3.0-or-later
"""Strokes that wires follow or keep from: as the hand draws them, as steps of a drawing, as they are stored."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from fake_live import grid_points, grid_triangles
from numpy.typing import NDArray
from seamwire.core.network.strokes import OffMeshError, drawn, into_triangles, on_mesh, through_vertices
from seamwire.core.sketch.picture import Role
from seamwire.core.storage.serialization import Archive
from table import SIZE, Table, paper

MESH, TRIANGLES = grid_points(SIZE), grid_triangles(SIZE)


def line(start: tuple[float, float], end: tuple[float, float], count: int = 20) -> NDArray[np.float64]:
    path = np.linspace(start, end, count)
    return np.column_stack([path, np.zeros(count)])


def faces_under(points: NDArray[np.float64]) -> NDArray[np.int32]:
    """Return the triangle of the grid below each point."""
    cells = np.minimum(np.floor(points[:, :2]).astype(int), SIZE - 2)
    above = (points[:, 1] - cells[:, 1]) > (points[:, 0] - cells[:, 0])
    return (2 * (cells[:, 1] * (SIZE - 1) + cells[:, 0]) + above).astype(np.int32)


def stroke(session: object, *ends: tuple[float, float], **how: object) -> bool:
    points = line(*ends)
    return session.draw_stroke(points, faces_under(points), **how)


# As the hand draws them


def test_a_straight_stroke_stays_as_it_is() -> None:
    points = line((0.5, 0.2), (4.5, 3.2))
    path, corners, faces = drawn(points, faces_under(points), MESH, TRIANGLES)
    assert np.allclose(path[[0, -1]], points[[0, -1]], atol=1e-12)
    # A point leaves the line only where smoothing would take it into the next triangle.
    assert np.abs(np.cross(path - points[0], (points[-1] - points[0]) / 5.0)).max() < 0.05
    assert (corners == TRIANGLES[faces]).all()


def test_a_shaking_hand_is_smoothed() -> None:
    points = line((0.1, 1.5), (4.9, 1.5), 200)
    points[:, 1] += np.random.default_rng(0).uniform(-0.05, 0.05, 200)
    path, _, _ = drawn(points, faces_under(points), MESH, TRIANGLES)

    def turning(way: NDArray[np.float64]) -> float:
        steps = np.diff(way[:, :2], axis=0)
        return float(np.abs(np.diff(np.unwrap(np.arctan2(steps[:, 1], steps[:, 0])))).sum())

    assert turning(path) < 0.5 * turning(points)
    assert np.abs(path[:, 1] - 1.5).max() <= 0.05 + 1e-12


def test_points_stay_in_their_triangles() -> None:
    rng = np.random.default_rng(1)
    points = np.column_stack([rng.uniform(0.0, SIZE - 1.0, (300, 2)), np.zeros(300)])
    path, corners, _ = drawn(points, faces_under(points), MESH, TRIANGLES)
    assert np.allclose(into_triangles(path, MESH[corners]), path, atol=1e-12)


def test_a_closed_stroke_stays_closed() -> None:
    angles = np.linspace(0.0, 2.0 * np.pi, 60)
    points = np.column_stack([2.5 + 1.3 * np.cos(angles), 2.5 + 1.3 * np.sin(angles), np.zeros(60)])
    points[-1] = points[0]
    path, _, faces = drawn(points, faces_under(points), MESH, TRIANGLES)
    assert path[0].tolist() == path[-1].tolist()
    assert faces[0] == faces[-1]


def test_ten_thousand_points_are_thinned_to_what_a_mesh_can_tell() -> None:
    points = line((0.1, 0.1), (0.2, 0.1), 10_000)
    path, _, _ = drawn(points, faces_under(points), MESH, TRIANGLES)
    assert 70 <= len(path) <= 90, "a stroke of a fiftieth of the longest side, in steps of a four thousandth"
    assert np.allclose(path[-1], points[-1], atol=1e-12)


@pytest.mark.parametrize(
    ("points", "faces", "why"),
    [
        ([[0.5, 0.2, 0.0]], [0], "direction"),
        ([[0.5, 0.2, 0.0]] * 9, [0] * 9, "direction"),
        ([], [], "direction"),
        ([[0.5, 0.2, 0.0], [np.nan, 0.0, 0.0]], [0, 0], "damaged"),
        ([[0.5, 0.2, 0.0], [0.6, 0.2, 0.0]], [0], "damaged"),
        ([[0.5, 0.2, 0.0], [0.6, 0.2, 0.0]], [0, -1], "leaves"),
        ([[0.5, 0.2, 0.0], [0.6, 0.2, 0.0]], [0, 50], "leaves"),
        ([[0.5, 0.2, 0.0], [0.6, 0.2, 2.0]], [0, 0], "leaves"),
    ],
)
def test_what_is_no_stroke_is_refused_in_words(points: list, faces: list, why: str) -> None:
    with pytest.raises(OffMeshError, match=why):
        drawn(points, faces, MESH, TRIANGLES)
    session = Table().session
    revision = session.revision
    assert not session.draw_stroke(points, faces)
    assert why in session.reason
    assert session.network.strokes == ()
    assert not session.picture.can_undo
    assert session.revision > revision


def test_triangles_without_an_area_take_a_point_to_their_corner() -> None:
    flat = np.array([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], [[3.0, 0.0, 0.0]] * 3])
    assert into_triangles(np.array([[0.5, 1.0, 0.0], [0.0, 0.0, 0.0]]), flat).tolist() == flat[:, 0].tolist()


# Steps of a drawing


def test_an_erased_stroke_is_gone_until_undo() -> None:
    table = Table()
    session = table.session
    stroke(session, (0.5, 0.2), (4.5, 0.2))
    stroke(session, (0.5, 1.2), (4.5, 1.2))
    one, two = session.network.strokes
    assert session.erase(one)
    assert session.network.strokes == (two,)
    assert table.lives["EDGES"].strokes[-1] == (two,)
    assert not session.erase(one)
    assert "no longer exists" in session.reason
    assert session.undo()
    assert session.network.strokes == (one, two)


def test_a_stroke_is_for_the_active_wire_while_one_is_live() -> None:
    session = Table().session
    session.click(0)
    session.hover(7)
    stroke(session, (0.5, 0.2), (4.5, 0.2))
    session.next_candidate()
    stroke(session, (0.5, 0.2), (4.5, 0.2))
    assert [one.acts_on for one in session.network.strokes] == ["min", "max"]
    assert session.picture.active.vertices == (0, 6, 7), "the wire that it is for stays the active one"
    session.end_chain()
    stroke(session, (0.5, 0.2), (4.5, 0.2))
    assert session.network.strokes[-1].acts_on == "both"


def test_a_stroke_that_comes_back_brings_its_wire_forward() -> None:
    session = Table().session
    session.click(0)
    session.hover(7)
    session.next_candidate()
    stroke(session, (0.5, 0.2), (4.5, 0.2))
    session.undo()
    session.redo()
    assert session.picture.active.vertices == (0, 6, 7), "as when it was drawn"
    session.erase(session.network.strokes[0])
    session.next_candidate()
    assert session.picture.active.vertices == (0, 1, 7)
    session.undo()
    assert session.picture.active.vertices == (0, 6, 7)


def test_the_live_wire_follows_and_kept_ones_stay() -> None:
    table = Table(metric_ready=(False, False))
    session = table.session
    session.click(0)
    session.click(3)
    session.hover(9)
    kept = session.wires
    stroke(session, (0.5, 0.2), (4.5, 0.2))
    assert session.computing
    assert session.picture.active is not None, "the former wire is seen until there is another"
    assert session.picture.one(Role.COMPUTING) is not None
    table.compute()
    assert not session.picture.one(Role.COMPUTING) is not None
    assert session.wires == kept
    assert session.seed == (2, 3)


# As they are stored


def test_strokes_are_stored_and_found_again() -> None:
    session = Table().session
    stroke(session, (0.5, 0.2), (4.5, 3.2), radius=0.5)
    session.draw_stroke(vertices=[1, 8, 20], attracts=False)
    mesh = paper()
    mesh.write(session)
    again = Table().session
    mesh.open(again)
    for before, after in zip(session.network.strokes, again.network.strokes, strict=True):
        assert np.allclose(before.points, after.points, atol=1e-6)
        assert (before.faces == after.faces).all()
        assert (before.vertices == after.vertices).all()
        assert (before.attracts, before.acts_on, before.radius) == (after.attracts, after.acts_on, after.radius)
    assert not again.picture.can_undo
    assert again.erase(again.network.strokes[0])
    mesh.write(again)
    assert len(mesh.read().network.strokes) == 1


def test_strokes_on_renumbered_vertices_are_found_by_their_places() -> None:
    session = Table().session
    stroke(session, (0.5, 0.2), (4.5, 3.2))
    mesh = paper()
    mesh.write(session)
    mesh.renumber(np.random.default_rng(2).permutation(len(MESH)))
    found = on_mesh(mesh.read().network.strokes[0], mesh.points, mesh.triangles)
    assert np.allclose(found.points, session.network.strokes[0].points, atol=1e-6)
    assert (found.faces == session.network.strokes[0].faces).all()


def test_of_a_stroke_over_what_is_gone_the_longest_part_stays() -> None:
    session = Table().session
    stroke(session, (0.1, 0.2), (4.9, 0.2))
    mesh = paper()
    mesh.write(session)
    mesh.delete_vertices([35])
    mesh.places[[1, 7]] += 0.4
    (left,) = mesh.read().network.strokes
    assert (left.points[:, 0] >= 2.0).all(), "the first two squares are no more what they were"
    assert len(left.points) > 10


def test_a_stroke_whose_triangles_are_gone_runs_through_vertices() -> None:
    session = Table().session
    stroke(session, (0.1, 0.2), (4.9, 0.2))
    flipped = TRIANGLES.copy()
    flipped[0::2, 2], flipped[1::2, 0] = TRIANGLES[1::2, 2], TRIANGLES[0::2, 1]
    mesh = paper()
    mesh.write(session)
    found = on_mesh(mesh.read().network.strokes[0], MESH, flipped)
    assert (found.faces == -1).all()
    assert (found.points == MESH[found.vertices]).all()
    assert set(found.vertices.tolist()) == {0, 1, 2, 3, 4, 5}


def test_a_stroke_on_a_mesh_that_moved_by_a_cell_goes_with_its_vertices() -> None:
    session = Table().session
    stroke(session, (0.5, 0.2), (3.5, 0.2))
    mesh = paper()
    mesh.write(session)
    mesh.places[:, 0] -= 1.0
    (found,) = mesh.read().network.strokes
    assert (found.corners == session.network.strokes[0].corners).all()


@pytest.mark.parametrize(
    "spoil",
    [
        lambda record: record.update(acts_on="none"),
        lambda record: record.update(acts_on=["both"]),
        lambda record: record.update(eta=0.5),
        lambda record: record.update(rings="x"),
        lambda record: record["corners"].__setitem__(0, [7]),
        lambda record: record.update(corners=3),
        lambda record: record.update(corners=[]),
        lambda record: record.update(points="!"),
        lambda record: record.update(places=record["points"]),
        lambda record: record.update(vertex_count=None),
        lambda record: record.pop("vertices"),
        lambda record: record.update(vertices=[10**30]),
        lambda record: record.clear(),
    ],
)
def test_damaged_strokes_raise_nothing_and_are_no_strokes(spoil: Callable[[dict[str, object]], object]) -> None:
    session = Table().session
    stroke(session, (0.5, 0.2), (4.5, 0.2))
    session.click(12)
    session.click(15)
    mesh = paper()
    mesh.write(session)
    archive = Archive()
    archive.merge(mesh.archive)
    spoil(next(iter(archive.strokes.values())))
    mesh.text = archive.text(mesh.labels.values())
    found = mesh.read()
    assert found.network.strokes == ()
    assert len(found.network.wires) == 1


# Through vertices


def test_strokes_are_drawn_without_a_hand() -> None:
    session = Table().session
    assert session.draw_stroke(vertices=[0, 3], attracts=True, acts_on="both")
    assert not session.draw_stroke(vertices=[4, 4], attracts=False, acts_on="both")
    assert not session.draw_stroke(vertices=[0, 99], attracts=True, acts_on="both")
    assert "no vertex 99" in session.reason
    assert [one.vertices.tolist() for one in session.network.strokes] == [[0, 3]]


def test_strokes_run_through_vertices_in_their_order() -> None:
    points, corners, faces = through_vertices([5, 0, 3], MESH)
    assert points.tolist() == MESH[[5, 0, 3]].tolist()
    assert corners[1].tolist() == [0, 0, 0]
    assert (faces == -1).all()
