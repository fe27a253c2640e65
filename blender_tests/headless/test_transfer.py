# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams of other objects and files on meshes of another topology: ``mesh.seamwire_transfer``, ``mesh.seamwire_load_network``."""

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from scene import add_grid, add_suzanne, edit, head, mark_wires, seams, snapshot
from stored import agree, chains

Pair = tuple[bpy.types.Object, bpy.types.Object]


def leave() -> None:
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.object.select_all(action="DESELECT")


def choose(source: bpy.types.Object, target: bpy.types.Object) -> None:
    leave()
    source.select_set(True)
    target.select_set(True)
    bpy.context.view_layer.objects.active = target
    edit()


@pytest.fixture
def heads() -> Pair:
    """Suzanne with wires, and a subdivided one."""
    source = add_suzanne()
    edit()
    a, b, c = head(source, 3)
    mark_wires(chains=f"{a} {b} {c}")
    leave()
    target = add_suzanne(levels=1)
    choose(source, target)
    return source, target


def middles(obj: bpy.types.Object) -> np.ndarray:
    obj.update_from_editmode()
    points = np.array([vertex.co for vertex in obj.data.vertices])
    return np.array([points[list(edge.vertices)].mean(axis=0) for edge in obj.data.edges if edge.use_seam])


def off(target: bpy.types.Object, source: bpy.types.Object) -> float:
    """Return how far the target's seams are from the source's at most."""
    there, here = middles(target), middles(source)
    return float(np.linalg.norm(there[:, None] - here[None], axis=2).min(axis=1).max())


def test_seams_come_to_a_finer_mesh(heads: Pair) -> None:
    source, target = heads
    before = snapshot(source)
    assert bpy.ops.mesh.seamwire_transfer() == {"FINISHED"}
    assert len(seams(target)) >= 1.5 * len(middles(source))
    assert agree(target)
    assert off(target, source) < 0.2, "an edge of the source is about as long"
    assert snapshot(source) == before


def test_seams_without_wires_come_too_and_stay_as_they_are(heads: Pair) -> None:
    source, target = heads
    leave()
    source.data.attributes.remove(source.data.attributes[".seamwire"])
    choose(source, target)
    wanted = middles(source)
    assert bpy.ops.mesh.seamwire_transfer(source=source.name) == {"FINISHED"}
    assert off(target, source) < 0.2
    assert np.array_equal(middles(source), wanted)
    leave()
    assert ".seamwire" not in source.data.attributes


@pytest.mark.every_blender
def test_a_mesh_that_was_moved_and_scaled_is_found_and_one_undo_takes_it_back(heads: Pair) -> None:
    source, target = heads
    leave()
    target.data.transform(Matrix.Translation((4.0, 0.0, 1.0)) @ Matrix.Rotation(0.4, 4, "Z") @ Matrix.Scale(2.0, 4))
    choose(source, target)
    with pytest.raises(RuntimeError, match="No wire could be placed"):
        bpy.ops.mesh.seamwire_transfer(align=False)
    before = snapshot(target)
    bpy.ops.ed.undo_push(message="Before")
    assert bpy.ops.mesh.seamwire_transfer() == {"FINISHED"}
    count = len(seams(target))
    assert count >= 1.5 * len(middles(source))
    bpy.ops.ed.undo_push(message="After")
    bpy.ops.ed.undo()
    assert snapshot(bpy.context.active_object) == before


def test_the_other_side_gets_its_mirror_image(heads: Pair) -> None:
    source, target = heads
    bpy.ops.mesh.seamwire_transfer(mirror="X")
    mirrored = middles(target) * (-1.0, 1.0, 1.0)
    gaps = np.linalg.norm(mirrored[:, None] - middles(source)[None], axis=2).min(axis=1)
    assert gaps.max() < 0.2


def test_the_same_topology_goes_by_numbers_in_whatever_shape(heads: Pair) -> None:
    source, _ = heads
    leave()
    target = add_suzanne()
    for vertex in target.data.vertices:
        vertex.co.z += vertex.co.x**2
    choose(source, target)
    assert bpy.ops.mesh.seamwire_transfer() == {"FINISHED"}
    leave()
    assert [edge.use_seam for edge in target.data.edges] == [edge.use_seam for edge in source.data.edges]
    edit()
    assert len(chains(target)) == 2


def test_pairs_of_vertex_groups_find_another_pose() -> None:
    """A strip and a finer one that is bent upwards: a half circle."""
    source = add_grid(21, 9)
    for vertex in source.data.vertices:
        vertex.co.x *= 3.0
    edit()
    mark_wires(chains=f"{4 * 21 + 2} {4 * 21 + 18}; {1 * 21 + 10} {7 * 21 + 10}")
    leave()
    target = add_grid(31, 13)
    flat = [(3.0 * vertex.co.x, vertex.co.y) for vertex in target.data.vertices]
    for vertex, (x, _) in zip(target.data.vertices, flat, strict=True):
        vertex.co.x, vertex.co.z = 2.0 * np.sin(x / 2.0), 2.0 - 2.0 * np.cos(x / 2.0)
    for obj, columns, rows in ((source, 21, 9), (target, 31, 13)):
        corners = (0, columns - 1, columns * (rows - 1), columns * rows - 1)
        for number, corner in enumerate(corners):
            obj.vertex_groups.new(name=f"corner {number}").add([corner], 1.0, "REPLACE")
    choose(source, target)
    assert bpy.ops.mesh.seamwire_transfer(place="PAIRS") == {"FINISHED"}
    marked = np.array([np.mean([flat[v] for v in edge], axis=0) for edge in seams(target)])
    along, across = np.abs(marked[:, 1]) < 0.2, np.abs(marked[:, 0]) < 0.3
    assert (along | across).all()
    assert np.ptp(marked[along, 0]) > 4.2 and np.ptp(marked[across, 1]) > 1.1


def test_what_is_wrong_is_said_and_nothing_changes(heads: Pair) -> None:
    _, target = heads
    before = snapshot(target)
    for options, message in (
        ({"source": "Nobody"}, "No object is named Nobody"),
        ({"source": target.name}, "Select one other mesh object"),
        ({"place": "NUMBERS"}, "to a mesh with 507 vertices, but this one has"),
        ({"place": "PAIRS"}, "the objects share 0 vertex groups"),
        ({"pairs": "1-2 3"}, "'3' is not a pair"),
        ({"pairs": "1-2 3-4 5-999999"}, "vertex 999999 is not on"),
        ({"place": "NUMBERS", "mirror": "X"}, "Mirror needs Place: Nearest Surface"),
    ):
        with pytest.raises(RuntimeError, match=message):
            bpy.ops.mesh.seamwire_transfer(**options)
    assert snapshot(target) == before
