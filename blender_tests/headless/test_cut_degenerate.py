# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires cut into meshes with faces that have no area."""

import random

import bmesh
import bpy
import numpy as np
import pytest
from scene import add_object, add_suzanne, edit, seams
from seamwire.mesh import finishes
from test_cut import cut, is_sound, joined


def add_flat_faces(subdivisions: int, share: float, seed: int) -> bpy.types.Object:
    """Add a ball of which about a share of the faces have no area: caps and needles, alone and beside each other."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=subdivisions)
    obj = bpy.context.active_object
    dice = random.Random(seed)
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    for _ in range(int(share * len(bm.faces) / 2)):
        bm.faces.ensure_lookup_table()
        face = dice.choice(bm.faces)
        a, b, _ = (vert.co.copy() for vert in dice.sample(list(face.verts), 3))
        if dice.random() < 0.5:
            # A vertex on a side of the face, and the triangle between them.
            (middle,) = bmesh.ops.poke(bm, faces=[face])["verts"]
            middle.co = a.lerp(b, dice.choice((0.0, 0.2, 0.5, 0.9)))
        else:
            dice.choice(face.verts).co = a.lerp(b, dice.choice((0.0, 0.0, 0.4)))
    bm.to_mesh(obj.data)
    bm.free()
    return obj


def add_folded_faces(share: float, seed: int) -> bpy.types.Object:
    """Add Suzanne with a share of her quads folded, by corners moved to a side, to a diagonal or to another corner."""
    obj = add_suzanne()
    dice = random.Random(seed)
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    bm.faces.ensure_lookup_table()
    for _ in range(int(share * len(bm.faces))):
        corners = list(dice.choice(bm.faces).verts)
        corner = dice.choice(corners)
        one, two = dice.sample(corners, 2)
        corner.co = one.co.lerp(two.co, dice.choice((0.0, 0.0, 0.5, 0.3)))
    bm.to_mesh(obj.data)
    bm.free()
    return obj


@pytest.mark.every_blender
@pytest.mark.parametrize(
    ("share", "seed", "chains"), [(0.1, 3, "174 130"), (0.3, 4, "505 147; 364 137"), (0.3, 4, "364 137")]
)
def test_folded_faces_are_cut(share: float, seed: int, chains: str, capfd: pytest.CaptureFixture[str]) -> None:
    obj = add_folded_faces(share, seed)
    edit()
    assert cut(chains)
    assert "could not be cut" not in capfd.readouterr().out
    for chain in chains.split(";"):
        start, end = map(int, chain.split())
        assert end in joined(obj, start)
    assert is_sound(obj)


@pytest.mark.every_blender
@pytest.mark.parametrize("seed", range(6))
def test_all_chains_over_faces_without_area_are_cut_and_join(seed: int, capfd: pytest.CaptureFixture[str]) -> None:
    obj = add_flat_faces(2, 0.1 + 0.1 * seed, seed)
    dice = random.Random(seed)
    edit()
    for _ in range(4):
        start, end = dice.sample(range(42), 2)
        assert cut(f"{start} {end}")
        assert end in joined(obj, start)
    assert "could not be cut" not in capfd.readouterr().out
    assert is_sound(obj)


SPIKE = ([(0, 0, 0), (2, 0, 0), (2, 0, 3), (2, 0, 2), (0, 0, 2)], [(0, 1, 2, 3, 4)])


@pytest.mark.every_blender
@pytest.mark.parametrize("split", [True, False], ids=["", "not split"])
def test_a_face_cut_on_a_drawing_has_its_own_normal(split: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    obj = add_object(*SPIKE)
    edit()
    if not split:
        monkeypatch.setattr(finishes, "_split", lambda _face, _edges: False)
    assert cut("0 3")
    bm = bmesh.from_edit_mesh(obj.data)
    assert len(bm.faces) == (2 if split else 1)
    for face in bm.faces:
        assert abs(face.normal.y) == pytest.approx(1.0)


@pytest.mark.every_blender
def test_normals_are_right_after_a_cut() -> None:
    obj = add_folded_faces(0.3, 4)
    edit()
    assert cut("505 147; 364 137")
    bm = bmesh.from_edit_mesh(obj.data)
    found = np.array([item.normal for item in (*bm.faces, *bm.verts)])
    bm.normal_update()
    assert found == pytest.approx(np.array([item.normal for item in (*bm.faces, *bm.verts)]), abs=1e-6)


def test_suggested_wires_are_cut_where_faces_have_no_area() -> None:
    obj = add_flat_faces(3, 0.5, 3)
    edit()
    assert bpy.ops.mesh.seamwire_suggest(along="SURFACE", finish="CUT") == {"FINISHED"}
    assert seams(obj)
    assert is_sound(obj)
