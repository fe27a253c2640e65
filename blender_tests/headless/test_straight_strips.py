# SPDX-License-Identifier: GPL-3.0-or-later
"""Strips of quads that *Unwrap Changed Islands* lays out straight, and islands that stand upright."""

import math

import bmesh
import bpy
import numpy as np
import pytest
from maps import energy, flipped, in_square, overlapping_pairs, signed_areas, triangles
from scene import add_object, changing, edit
from seamwire.core.seams.seam_plan import PartChoice
from seamwire.mesh.seam_search import SeamSearch, SearchOptions

SIDES = 12


def add_barrel(rows: int = 4, turned: float = 0.0, bulge: float = 0.08) -> bpy.types.Object:
    """Add a barrel that is thicker in the middle, with seams around both lids and one along the wall, in edit mode.

    `turned`: how far it lies on its side, around the Y axis.
    """
    points = []
    for row in range(rows + 1):
        height = 2.0 * row / rows - 1.0
        radius = 1.0 - bulge * height**2
        for side in range(SIDES):
            angle = 2.0 * math.pi * side / SIDES
            x, y, z = radius * math.cos(angle), radius * math.sin(angle), 1.5 * height
            points.append((x * math.cos(turned) + z * math.sin(turned), y, z * math.cos(turned) - x * math.sin(turned)))
    faces = [
        tuple(SIDES * (row + up) + (side + right) % SIDES for up, right in ((0, 0), (0, 1), (1, 1), (1, 0)))
        for row in range(rows)
        for side in range(SIDES)
    ]
    lids = [tuple(range(SIDES))[::-1], tuple(range(SIDES * rows, SIDES * (rows + 1)))]
    obj = add_object(points, [*faces, *lids])
    edit()
    with changing(obj) as bm:
        for edge in bm.edges:
            one, other = (vertex.index for vertex in edge.verts)
            edge.seam = any(len(face.verts) > 4 for face in edge.link_faces) or (one % SIDES == other % SIDES == 0)
    return obj


def uvs_of(obj: bpy.types.Object, are_lids: bool) -> list[np.ndarray]:
    """Return the UVs of the faces of the wall, or of the lids."""
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.loops.layers.uv.active
    return [np.array([loop[layer].uv[:] for loop in f.loops]) for f in bm.faces if (len(f.verts) > 4) == are_lids]


def lines_of(obj: bpy.types.Object) -> list[int]:
    """Return how many different columns and rows the wall's vertices lie in."""
    places = np.concatenate(uvs_of(obj, False))
    return [len(np.unique(np.round(column, 5))) for column in places.T]


def density(obj: bpy.types.Object, are_lids: bool) -> float:
    """Return the area in the map over the area on the model, of the wall or of the lids."""
    on_model = sum(f.calc_area() for f in bmesh.from_edit_mesh(obj.data).faces if (len(f.verts) > 4) == are_lids)
    in_map = 0.0
    for corners in uvs_of(obj, are_lids):
        after = np.roll(corners, -1, axis=0)
        in_map += 0.5 * float((corners[:, 0] * after[:, 1] - corners[:, 1] * after[:, 0]).sum())
    return in_map / on_model


@pytest.mark.every_blender
def test_the_wall_of_a_barrel_is_laid_out_straight_unless_it_is_not_wanted() -> None:
    obj = add_barrel()
    energies = {}
    for straight in (True, False):
        assert bpy.ops.mesh.seamwire_unwrap(straight=straight, changed_only=False) == {"FINISHED"}
        assert (lines_of(obj) == [SIDES + 1, 5]) == straight
        assert (flipped(obj), overlapping_pairs(obj), in_square(obj)) == (0, 0, True)
        energies[straight] = energy(obj)
        assert density(obj, False) == pytest.approx(density(obj, True), rel=0.02), "texels are even"
    assert energies[False] < energies[True] <= energies[False] + 0.05
    assert bpy.ops.mesh.seamwire_unwrap(changed_only=False) == {"FINISHED"}
    assert lines_of(obj) == [SIDES + 1, 5], "it is the default"


def test_a_plan_that_is_laid_out_has_the_stretch_of_its_straight_strips() -> None:
    obj = add_barrel(bulge=0.2)
    with changing(obj) as bm:
        for edge in bm.edges:
            edge.seam = False
    search = SeamSearch([obj], SearchOptions(None, None, True, None, 17.0, 1, True), False)
    search.choose(PartChoice(0.5, 17.0))
    search.plan(lambda _: True)
    (suggestion,) = search
    planned = suggestion.energy_of(suggestion.best)
    assert suggestion.layout_of(suggestion.best, lambda _: True) is not None
    laid_out = suggestion.energy_of(suggestion.best)
    search.write(before_cuts=False)
    search.unwrap(bpy.context)
    assert lines_of(obj) == [SIDES + 1, 5]
    assert laid_out == pytest.approx(energy(obj), abs=2e-4)
    assert laid_out > planned + 1e-3, "straight strips stretch more"


def up_of(obj: bpy.types.Object) -> np.ndarray:
    """Return the direction in which the Z axis runs in the map of the wall."""
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.loops.layers.uv.active
    moved = np.zeros(2)
    for face in bm.faces:
        heights = np.array([loop.vert.co.z for loop in face.loops])
        places = np.array([loop[layer].uv[:] for loop in face.loops])
        if len(face.verts) == 4:
            moved += (heights - heights.mean()) @ (places - places.mean(axis=0))
    return moved / np.linalg.norm(moved)


@pytest.mark.every_blender
@pytest.mark.parametrize("straight", [True, False])
@pytest.mark.parametrize("turned", [0.0, math.pi])
def test_up_is_up(straight: bool, turned: float) -> None:
    obj = add_barrel(turned=turned)
    assert bpy.ops.mesh.seamwire_unwrap(straight=straight) == {"FINISHED"}
    assert up_of(obj) == pytest.approx((0.0, 1.0), abs=1e-3)


def test_slanted_directions_make_a_long_island_larger_if_upright_is_not_wanted() -> None:
    kite = add_object([(0.0, 0.0, -1.0), (0.05, 0.0, 0.0), (0.0, 0.0, 1.0), (-0.05, 0.0, 0.0)], [(0, 1, 2, 3)])
    edit()
    areas = []
    for upright in (True, False):
        assert bpy.ops.mesh.seamwire_unwrap(upright=upright, changed_only=False) == {"FINISHED"}
        assert in_square(kite)
        areas.append(np.abs(signed_areas(triangles(kite)[0])).sum())
    assert areas[1] > 1.7 * areas[0], "the diagonal is 1.41 times as long as a side"


def test_a_straight_island_stays_along_the_axes_beside_islands_that_stay() -> None:
    obj = add_barrel()
    assert bpy.ops.mesh.seamwire_unwrap() == {"FINISHED"}
    with changing(obj) as bm:
        layer = bm.loops.layers.uv.active
        turn = np.array([[math.cos(0.3), math.sin(0.3)], [-math.sin(0.3), math.cos(0.3)]])
        for face in bm.faces:
            for loop in face.loops:
                loop[layer].uv = 0.5 * (np.array(loop[layer].uv) - 0.5) @ turn + 0.5
        # The wall in two halves.
        for edge in bm.edges:
            edge.seam |= all(vertex.index % SIDES == SIDES // 2 for vertex in edge.verts)
    lids = uvs_of(obj, True)
    assert bpy.ops.mesh.seamwire_unwrap() == {"FINISHED"}
    assert np.array_equal(uvs_of(obj, True), lids)
    for corners in uvs_of(obj, False):
        sides = np.abs(np.roll(corners, -1, axis=0) - corners)
        assert (sides.min(axis=1) < 1e-6).all()
    assert (flipped(obj), overlapping_pairs(obj)) == (0, 0)
