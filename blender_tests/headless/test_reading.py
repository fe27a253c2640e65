# SPDX-License-Identifier: GPL-3.0-or-later
"""What is read of an edit mesh: the same as Blender itself tells of it, whatever its faces are like."""

import bmesh
import bpy
import numpy as np
import pytest
from scene import add_grid, add_object, add_suzanne, changing, edit
from seamwire.mesh import edit_mesh
from stored import island_count as islands

pytestmark = pytest.mark.every_blender


def add_mixed() -> bpy.types.Object:
    """Triangles and quads in turns, one of them bent in, one not flat."""
    points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.2, 0.2, 0), (2, 0, 0), (2, 1, 0.4), (3, 0.5, 0)]
    return add_object(points, [(0, 1, 4), (1, 2, 3, 4), (1, 5, 6, 2), (5, 7, 6), (0, 4, 3)])


def add_ngons() -> bpy.types.Object:
    bpy.ops.mesh.primitive_cylinder_add(vertices=7, end_fill_type="NGON")
    return bpy.context.active_object


def blenders_triangles(mesh: bpy.types.Mesh) -> list[tuple[int, ...]]:
    mesh.calc_loop_triangles()
    return [tuple(triangle.vertices) for triangle in mesh.loop_triangles]


def turned(triangle: tuple[int, ...]) -> tuple[int, ...]:
    """Return a triangle with its smallest vertex first, the same way around."""
    first = triangle.index(min(triangle))
    return triangle[first:] + triangle[:first]


@pytest.mark.parametrize("add", [lambda: add_grid(5), add_mixed, add_ngons, add_suzanne])
def test_faces_are_cut_as_blender_cuts_them(add: object) -> None:
    obj = add()
    edit()
    arrays = edit_mesh.read(obj)
    found = [turned(tuple(map(int, triangle))) for triangle in arrays.triangles]
    assert found == [turned(triangle) for triangle in blenders_triangles(obj.data)]
    assert arrays.edges.tolist() == [list(edge.vertices) for edge in obj.data.edges]
    assert np.allclose(arrays.points, [vertex.co for vertex in obj.data.vertices])


@pytest.mark.parametrize("bent", ["first", "second", "third", "fourth"])
def test_quads_bent_in_at_any_corner_are_cut_there(bent: str) -> None:
    corners = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)]
    index = ["first", "second", "third", "fourth"].index(bent)
    x, y, _ = corners[index]
    corners[index] = (0.5 + 0.2 * (0.5 - x), 0.5 + 0.2 * (0.5 - y), 0.0)  # beyond the middle
    obj = add_object(corners, [(0, 1, 2, 3)])
    edit()
    arrays = edit_mesh.read(obj)
    assert [turned(tuple(map(int, t))) for t in arrays.triangles] == [turned(t) for t in blenders_triangles(obj.data)]


def test_edges_are_marked_that_are_sharp_or_between_materials() -> None:
    obj = add_grid(5)  # vertex y * 5 + x is column x of row y
    for name in ("Wood", "Iron"):
        obj.data.materials.append(bpy.data.materials.new(name))
    for face in obj.data.polygons:
        face.material_index = int(face.center.x > 0.0)
    sharp = next(edge for edge in obj.data.edges if set(edge.vertices) == {5, 6})
    sharp.use_edge_sharp = True
    edit()
    column = [(2 + 5 * y, 7 + 5 * y) for y in range(4)]
    found = [sorted(tuple(sorted(pair)) for pair in kind.tolist()) for kind in edit_mesh.read(obj).marked]
    assert found == [[(5, 6)], sorted(column)]


@pytest.mark.parametrize("more", [(), ((0.5, 2.0), (0.5, -2.0))], ids=["quads", "pentagons"])
def test_seams_past_a_vertex_in_the_middle_of_an_edge_part_islands(more: tuple[tuple[float, float], ...]) -> None:
    points = [(0, 0), (1, 0), (2, 0), (1.5, 2), (1.5, -2), *more]
    faces = [(0, 1, 2, 3, 5), (2, 1, 0, 6, 4)] if more else [(0, 1, 2, 3), (2, 1, 0, 4)]
    obj = add_object([(*point, 0.0) for point in points], faces)
    edit()
    assert islands(obj) == 1
    with changing(obj) as bm:
        for edge in bm.verts[1].link_edges:
            edge.seam = True
    assert islands(obj) == 2
    arrays = edit_mesh.read(obj)
    corners = arrays.points[arrays.triangles]
    assert np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2].min() > 0.1


def test_what_is_hidden_is_left_out_and_seams_are_told() -> None:
    obj = add_grid(5)
    edit()
    with changing(obj) as bm:
        bm.faces[0].hide_set(True)
        bm.edges.get((bm.verts[11], bm.verts[12])).seam = True
    arrays = edit_mesh.read(obj)
    assert len(arrays.triangles) == 30
    assert [sorted(edge) for edge in arrays.seams.tolist()] == [[11, 12]]
    hidden = [edge.index for edge in bm.edges if edge.hide]
    assert hidden
    assert len(arrays.edges) == len(bm.edges) - len(hidden)


def test_reading_leaves_no_mesh_behind() -> None:
    obj = add_grid(5)
    edit()
    before = len(bpy.data.meshes)
    edit_mesh.read(obj)
    assert len(bpy.data.meshes) == before
    assert obj.mode == "EDIT"
    assert obj.data.users == 1


def test_a_mesh_of_edges_alone_is_read() -> None:
    obj = add_object([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [], [(0, 1), (1, 2)])
    edit()
    arrays = edit_mesh.read(obj)
    assert arrays.triangles.shape == (0, 3)
    assert arrays.edges.tolist() == [[0, 1], [1, 2]]


def test_numbers_that_other_operators_leave_in_the_mesh_do_not_count() -> None:
    obj = add_grid(5)
    edit()
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    bm.select_history.clear()
    bm.select_history.add(bm.verts[7])
    cage = edit_mesh.Cage(obj)
    cage.write([(6, 7)], labels={(6, 7): 1})

    def renumber() -> None:
        # What Camera Selected does to vertices that are not selected.
        for v in bm.verts:
            v.index = -1

    renumber()
    assert cage.active_vertex() == 7
    renumber()
    assert np.sort(cage.labels().pairs).tolist() == [[6, 7]]
    renumber()
    assert [12, 13] in np.sort(edit_mesh.read(obj).edges).tolist()
