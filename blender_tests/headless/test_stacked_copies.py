# SPDX-License-Identifier: GPL-3.0-or-later
"""Islands of the same shape that *Unwrap Changed Islands* lays on each other."""

import bmesh
import bpy
import numpy as np
import pytest
from maps import flipped, in_square, overlapping_pairs
from mathutils import Matrix
from scene import add_object, changing, edit


def add_parts() -> bpy.types.Object:
    """Add a bent strip, a turned copy, a mirrored copy, and a square of another shape, without seams, in edit mode."""
    strip = np.array([(0, 0, 0), (1, 0, 0), (2.2, 0, 0.5), (0, 1, 0), (1, 1.2, 0), (2, 1, 0.5)], dtype=float)
    quads = [(0, 1, 4, 3), (1, 2, 5, 4)]
    turn = np.array(Matrix.Rotation(0.7, 3, (1.0, 2.0, 0.5)))
    pieces = [
        (strip, quads),
        (strip @ turn.T + (5.0, 0.0, 0.0), quads),
        (strip * (-1.0, 1.0, 1.0) - (3.0, 0.0, 0.0), [quad[::-1] for quad in quads]),
        (np.array([(0, 5, 0), (1, 5, 0), (1, 6, 0), (0, 6, 0)], dtype=float), [(0, 1, 2, 3)]),
    ]
    points, faces = [], []
    for places, own in pieces:
        faces += [tuple(len(points) + v for v in face) for face in own]
        points += [tuple(place) for place in places.tolist()]
    obj = add_object(points, faces)
    edit()
    return obj


def islands(obj: bpy.types.Object) -> list[np.ndarray]:
    """Return the UVs of the vertices of each piece of `add_parts`, by their numbers."""
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.loops.layers.uv.active
    places = {loop.vert.index: tuple(loop[layer].uv) for face in bm.faces for loop in face.loops}
    found = np.array([places[vertex] for vertex in range(len(places))])
    return np.split(found, [6, 12, 18])


@pytest.mark.every_blender
def test_copies_lie_on_each_other_if_they_are_wanted(capfd: pytest.CaptureFixture[str]) -> None:
    obj = add_parts()
    assert bpy.ops.mesh.seamwire_unwrap() == {"FINISHED"}
    assert overlapping_pairs(obj) == 0, "not by default"
    assert bpy.ops.mesh.seamwire_unwrap(stack=True, changed_only=False) == {"FINISHED"}
    first, *copies, other = islands(obj)
    assert all(np.array_equal(first, each) for each in copies)
    low, high = first.min(axis=0), first.max(axis=0)
    assert (other.max(axis=0) < low).any() or (other.min(axis=0) > high).any()
    assert in_square(obj)
    assert np.ptp(np.concatenate([first, other]), axis=0).max() > 0.9, "what is seen fills the square"
    assert "Warning" not in capfd.readouterr().out
    assert bpy.ops.mesh.seamwire_unwrap(changed_only=False) == {"FINISHED"}
    assert (overlapping_pairs(obj), flipped(obj)) == (0, 0)


def test_new_copies_lie_on_each_other_beside_islands_that_stay() -> None:
    obj = add_parts()
    assert bpy.ops.mesh.seamwire_unwrap() == {"FINISHED"}
    with changing(obj) as bm:
        layer = bm.loops.layers.uv.active
        bm.faces.ensure_lookup_table()
        for number in (2, 3, 4, 5):  # two of the strips get no area in the map, so they are new
            for loop in bm.faces[number].loops:
                loop[layer].uv = 0.0, 0.0
    first, _, _, other = islands(obj)
    assert bpy.ops.mesh.seamwire_unwrap(stack=True) == {"FINISHED"}
    found = islands(obj)
    assert np.array_equal(found[0], first) and np.array_equal(found[3], other)
    assert np.array_equal(found[1], found[2])
    for stays in (first, other):
        assert (found[1].max(axis=0) < stays.min(axis=0)).any() or (found[1].min(axis=0) > stays.max(axis=0)).any()
