# SPDX-License-Identifier: GPL-3.0-or-later
"""What the UV map holds after *Unwrap Changed Islands*, measured without the add-on, and what the reports say of it."""

import math
import re
from types import SimpleNamespace

import bmesh
import bpy
import numpy as np
import pytest
from maps import flipped, folded, in_square, overlapping_pairs, signed_areas, triangles
from mathutils.kdtree import KDTree
from scene import add_grid, add_object, add_suzanne, changing, edit, snapshot
from seamwire.core.base import native
from seamwire.mesh import edit_mesh
from seamwire.mesh import unwrap as unwrapping
from seamwire.mesh.uv_islands import labels_of
from seamwire.tool.chain import unwrap_after_chain


def add_torus() -> None:
    bpy.ops.mesh.primitive_torus_add(major_segments=12, minor_segments=8)


SHAPES = {
    "cube": bpy.ops.mesh.primitive_cube_add,
    "cylinder": bpy.ops.mesh.primitive_cylinder_add,
    "torus": add_torus,
    "ball": lambda: bpy.ops.mesh.primitive_uv_sphere_add(segments=12, ring_count=8),
}


def add_shape(name: str) -> bpy.types.Object:
    """Add one of the shapes without seams and without a UV map, in edit mode."""
    SHAPES[name]()
    obj = bpy.context.active_object
    while obj.data.uv_layers:
        obj.data.uv_layers.remove(obj.data.uv_layers[0])
    edit()
    return obj


def unwrap(**options: object) -> set[str]:
    return bpy.ops.mesh.seamwire_unwrap(**options)


@pytest.mark.every_blender
@pytest.mark.parametrize("shape", SHAPES)
def test_a_closed_mesh_of_polygons_without_seams_gets_a_valid_map(
    shape: str, capfd: pytest.CaptureFixture[str]
) -> None:
    obj = add_shape(shape)
    assert unwrap() == {"FINISHED"}
    assert (flipped(obj), overlapping_pairs(obj), in_square(obj)) == (0, 0, True)
    assert "Info: 1 island unwrapped, 0 kept, " in capfd.readouterr().out


@pytest.mark.every_blender
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("is_joined", [False, True], ids=["split edges", "edges into the middle of sides"])
def test_vertices_in_the_middle_of_sides_leave_the_map_valid_as_blender_cuts_the_faces(
    shape: str, is_joined: bool
) -> None:
    obj = add_shape(shape)
    for edge in bmesh.from_edit_mesh(obj.data).edges:
        edge.seam = edge.index % 11 == 0
    with changing(obj) as bm:
        for number, edge in enumerate(bm.edges[:][::3]):
            _, vertex = bmesh.utils.edge_split(edge, edge.verts[0], (0.5, 0.3, 0.01)[number % 3])
            face = vertex.link_faces[0]
            neighbors = {each.other_vert(vertex) for each in vertex.link_edges}
            others = [each for each in face.verts if each is not vertex and each not in neighbors]
            if is_joined and others:
                bmesh.utils.face_split(face, vertex, others[0])
    assert unwrap() == {"FINISHED"}
    assert (folded(obj), overlapping_pairs(obj, deep=1e-6)) == (0, 0)


def add_capped_columns(caps: int = 12, width: float = 4e-5, height: float = 6e-8) -> bpy.types.Object:
    """Add narrow quads side by side with triangles at both ends, without area or thinner than the UV square can hold."""
    ends = (-0.5, 0.5)
    points = [(width * i, y, 0.0) for y in ends for i in range(caps + 1)]
    points += [(width * (i + 0.5), y + math.copysign((i % 3) * height, y), 0.0) for y in ends for i in range(caps)]
    quads = [(i, i + 1, caps + 2 + i, caps + 1 + i) for i in range(caps)]
    below = [(i + 1, i, 2 * (caps + 1) + i) for i in range(caps)]
    above = [(caps + 1 + i, caps + 2 + i, 2 * (caps + 1) + caps + i) for i in range(caps)]
    return add_object(points, [*quads, *below, *above])


def turned_over(obj: bpy.types.Object) -> int:
    """Return how many triangles are turned over in the map or have no area there, however small they are on the model."""
    return int((signed_areas(triangles(obj)[0]) <= 0.0).sum())


@pytest.mark.every_blender
def test_faces_that_rounding_turns_over_are_turned_back(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    obj = add_capped_columns()
    edit()
    with monkeypatch.context() as without:
        without.setattr(unwrapping._Map, "turn_back", lambda _: False)
        assert unwrap(straight=False, upright=False) == {"FINISHED"}
    left = turned_over(obj)
    assert left > 0
    told = capfd.readouterr().out
    assert re.search(
        rf"Warning: 1 island unwrapped, 0 kept, 1 island overlaps, {left} faces? turned over, \d+ % of the UV square used: .* is long\n",
        told,
    )
    assert unwrap(changed_only=False, straight=False, upright=False) == {"FINISHED"}
    assert turned_over(obj) == 0
    assert "Info: 1 island unwrapped, 0 kept, " in capfd.readouterr().out


@pytest.fixture
def piled_up(monkeypatch: pytest.MonkeyPatch) -> None:
    """All islands are laid out at one place, and not packed."""

    def packed(uvs: np.ndarray, islands: np.ndarray, **_: object) -> SimpleNamespace:
        size = 4.0 * np.ptp(uvs)
        placement = np.array([[1.0 / size, 0.0, 0.5], [0.0, 1.0 / size, 0.5]])
        return SimpleNamespace(placements=np.repeat(placement[None], islands.max() + 1, axis=0))

    monkeypatch.setattr(native.load(), "pack_islands", packed)


@pytest.mark.usefixtures("piled_up")
def test_islands_that_overlap_after_packing_are_told_as_a_warning(capfd: pytest.CaptureFixture[str]) -> None:
    obj = add_grid(5)
    edit()
    for edge in bmesh.from_edit_mesh(obj.data).edges:
        edge.seam = all(abs(vertex.co.x) < 1e-6 for vertex in edge.verts)
    assert unwrap() == {"FINISHED"}
    assert overlapping_pairs(obj)
    assert "Warning: 2 islands unwrapped, 0 kept, 2 islands overlap, " in capfd.readouterr().out
    assert unwrap_after_chain(bpy.context) == ""


def test_islands_that_stay_do_not_count_even_if_they_overlap(capfd: pytest.CaptureFixture[str]) -> None:
    obj = add_grid(5)
    edit()
    with changing(obj) as bm:
        for edge in bm.edges:
            edge.seam = all(abs(vertex.co.x) in {0.0, 0.5} for vertex in edge.verts) and edge.calc_length() < 0.6
            edge.seam &= abs(edge.verts[0].co.x - edge.verts[1].co.x) < 1e-6
        assert unwrap() == {"FINISHED"}
        assert "4 islands unwrapped" in capfd.readouterr().out
        layer = bm.loops.layers.uv.active
        for face in bm.faces:  # the two islands at the sides onto each other, as an artist stacks them
            if abs(face.calc_center_median().x) > 0.5:
                for loop in face.loops:
                    loop[layer].uv = 0.1 + 0.1 * abs(loop.vert.co.x), 0.1 + 0.1 * loop.vert.co.y
        for edge in bm.edges:
            edge.seam &= abs(edge.verts[0].co.x) > 0.1
    assert unwrap() == {"FINISHED"}
    assert overlapping_pairs(obj)
    assert "Info: 1 island unwrapped, 2 kept, " in capfd.readouterr().out


def test_an_island_outside_the_uv_square_is_told(capfd: pytest.CaptureFixture[str]) -> None:
    obj = add_grid(5)
    edit()
    with changing(obj) as bm:
        for edge in bm.edges:
            edge.seam = all(abs(vertex.co.x) < 1e-6 for vertex in edge.verts)
        assert unwrap() == {"FINISHED"}
        layer = bm.loops.layers.uv.active
        left = [face for face in bm.faces if face.calc_center_median().x < 0.0]
        for face in left:  # it fills the square
            for loop in face.loops:
                loop[layer].uv = loop.vert.co.x + 1.0, 0.5 * loop.vert.co.y + 0.5
        bm.edges.ensure_lookup_table()
        for edge in bm.edges:
            edge.seam |= all(abs(vertex.co.y) < 1e-6 and vertex.co.x >= 0.0 for vertex in edge.verts)
    assert unwrap() == {"FINISHED"}
    assert not in_square(obj)
    assert "Warning: 2 islands unwrapped, 1 kept, 2 islands outside the UV square, " in capfd.readouterr().out


@pytest.mark.parametrize("with_map", [False, True])
@pytest.mark.parametrize("where", ["_place", "_faults", "_pile_up"])
def test_any_error_leaves_all_uvs_as_they_were(where: str, with_map: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    obj = add_grid(5)
    for vertex in obj.data.vertices:
        vertex.co.z = vertex.co.x * vertex.co.y
    edit()
    if with_map:
        assert unwrap() == {"FINISHED"}
        bmesh.from_edit_mesh(obj.data).edges.ensure_lookup_table()
        bmesh.from_edit_mesh(obj.data).edges[7].seam = True
    before = snapshot(obj)

    def fail(*_: object, **__: object) -> None:
        raise TypeError("as the test wants it")

    monkeypatch.setattr(unwrapping, where, fail)
    with pytest.raises(TypeError, match="as the test wants it"):
        unwrapping.unwrap_changed(bpy.context, every=True)
    assert snapshot(obj) == before


def test_many_corners_are_written_where_they_belong() -> None:
    obj = add_object(
        [*((math.cos(0.01 * i), math.sin(0.01 * i), 0.0) for i in range(600)), (0.0, 0.0, 0.0), (2.0, 0.0, 0.0)],
        [(*range(300), 600), (0, 601, 1)],
    )
    edit()
    assert unwrap() == {"FINISHED"}
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.loops.layers.uv.active
    uvs = np.array([tuple(loop[layer].uv) for face in bm.faces for loop in face.loops])
    places = np.array([tuple(loop.vert.co.xy) for face in bm.faces for loop in face.loops])
    lengths = [np.linalg.norm(column[:, None] - column, axis=2) for column in (uvs, places)]
    assert lengths[0] / lengths[0].max() == pytest.approx(lengths[1] / lengths[1].max(), abs=1e-4)


def outline(uvs: np.ndarray) -> np.ndarray:
    """Return points on the sides of triangles, (t, 3, 2), that no two of them share."""
    sides = np.stack([uvs, np.roll(uvs, -1, axis=1)], axis=2).reshape(-1, 2, 2)
    keys = np.sort(np.round(sides * 1e5) @ (1.0, 1e6), axis=1)
    _, inverse, counts = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    begin, end = sides[counts[inverse.reshape(-1)] == 1].swapaxes(0, 1)
    steps = np.linspace(0.0, 1.0, 9)[:, None, None]
    return ((1.0 - steps) * begin + steps * end).reshape(-1, 2)


def least_gap(maps: list[np.ndarray]) -> float:
    """Return the least distance between the outlines of islands."""
    least = np.inf
    points = [outline(uvs) for uvs in maps]
    for number, one in enumerate(points):
        tree = KDTree(len(one))
        for index, (u, v) in enumerate(one):
            tree.insert((u, v, 0.0), index)
        tree.balance()
        least = min([least, *(tree.find((u, v, 0.0))[2] for two in points[:number] for u, v in two)])
    return least


@pytest.mark.every_blender
@pytest.mark.parametrize("upright", [True, False])
def test_packed_islands_of_several_objects_fill_the_square_with_a_margin(upright: bool) -> None:
    image = bpy.data.images.new("Wide", 200, 100)
    material = bpy.data.materials.new("Wide")
    material.use_nodes = True
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    material.node_tree.nodes.active = node
    objects = [add_suzanne(1), add_suzanne()]
    objects[0].data.materials.append(material)
    for obj in objects:
        obj.select_set(True)
        obj.data.uv_layers.remove(obj.data.uv_layers[0])
    edit()
    for obj in objects:
        with changing(obj) as bm:
            for edge in bm.edges:
                sides = [face.calc_center_median() for face in edge.link_faces]
                edge.seam = len(sides) == 2 and any(sides[0][axis] * sides[1][axis] < 0.0 for axis in range(3))
    assert unwrap(upright=upright) == {"FINISHED"}
    maps = []
    for obj in objects:
        assert in_square(obj)
        arrays = edit_mesh.read(obj)
        of_face = dict(zip(arrays.polygons.tolist(), labels_of(arrays).tolist(), strict=True))
        bm = bmesh.from_edit_mesh(obj.data)
        labels = np.array([of_face[each[0].face.index] for each in bm.calc_loop_triangles()])
        uvs = triangles(obj)[0]
        maps += [uvs[labels == label] for label in range(labels.max() + 1)]
    assert not overlapping_pairs(*objects)
    assert len(maps) > 16
    assert 0.99 / 256.0 < least_gap(maps) < 4.0 / 256.0
    assert np.abs(signed_areas(np.concatenate(maps))).sum() > 0.55
