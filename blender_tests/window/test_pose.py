# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn and what is picked follows an armature that bends the edit cage. A played animation reads no mesh again."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import numpy as np
import pytest
import ui as driver
from desk import WHITE, Desk, choose, draw, leave, reset_settings, shows
from scene import add_grid, animate, chain, edit, seams
from seamwire.mesh import edit_mesh
from seamwire.mesh.edit_mesh import Pose
from seamwire.mesh.settings import settings
from seamwire.view.edited_objects import edited

SIDE = 9
ACROSS = 0.6
"""How far the armature moves the mesh along x."""


class Posed(Desk):
    """A grid that an armature moves along x, in edit mode and seen from above."""

    def __init__(self, ui: driver.Ui) -> None:
        self.ui = ui
        obj = add_grid(SIDE)
        self.name = obj.name
        reset_settings()
        armature = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
        bpy.context.collection.objects.link(armature)
        bpy.context.view_layer.objects.active = armature
        with ui.override():
            bpy.ops.object.mode_set(mode="EDIT")
            bone = armature.data.edit_bones.new("Bone")
            bone.head, bone.tail = (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)
            bpy.ops.object.mode_set(mode="OBJECT")
        armature.hide_set(True)
        obj.vertex_groups.new(name="Bone").add(list(range(SIDE * SIDE)), 1.0, "REPLACE")
        modifier = obj.modifiers.new("Rig", "ARMATURE")
        modifier.object = armature
        modifier.show_in_editmode = modifier.show_on_cage = True
        self.bone = armature.pose.bones["Bone"]
        bpy.context.view_layer.objects.active = obj
        obj.select_set(True)
        with ui.override():
            edit()
            bpy.ops.mesh.select_all(action="DESELECT")
        ui.look_from_top(distance=5.0)

    def seen_at(self, vertex: int, moved: float = ACROSS) -> tuple[float, float]:
        """Return where a vertex is seen that the armature has moved."""
        return self.ui.on_screen((vertex % SIDE / 4.0 - 1.0 + moved, vertex // SIDE / 4.0 - 1.0, 0.0))

    def tint_ends(self) -> tuple[float, float]:
        """Return the columns between which the islands above and below the seam differ in color."""
        seen = self.ui.screen()
        above, below = (self.ui.on_screen((0.0, y, 0.0))[1] for y in (0.6, -0.4))  # both lie between rows of edges
        apart = np.abs(seen[round(above) - 2] - seen[round(below) - 2]).max(axis=-1) > 0.04
        left, right = self.ui.on_screen((-1.9, 0.0, 0.0))[0], self.ui.on_screen((1.9, 0.0, 0.0))[0]
        columns = np.flatnonzero(apart[round(left) : round(right)]) + round(left)
        assert len(columns), "nothing is tinted"
        return float(columns.min()), float(columns.max())


@pytest.fixture
def posed(ui: driver.Ui) -> Iterator[Posed]:
    """A grid that an armature moves."""
    yield Posed(ui)
    leave(ui)
    for kind in (bpy.data.actions, bpy.data.armatures):
        bpy.data.batch_remove(list(kind))


def near(found: tuple[float, float], wanted: tuple[float, float]) -> bool:
    return bool(np.abs(np.subtract(found, wanted)).max() < 6.0)


@pytest.mark.smoke
@pytest.mark.oldest_and_newest
def test_tint_wires_and_seeds_lie_where_the_armature_shows_the_mesh(posed: Posed) -> None:
    ui = posed.ui
    choose(ui)
    draw(posed, 36, 44)
    ui.move((3.0, ui.region.height - 3.0))
    ui.wait_until(lambda: near(posed.tint_ends(), (posed.seen_at(36, 0.0)[0], posed.seen_at(44, 0.0)[0])))
    posed.bone.location.x = ACROSS
    ui.wait_until(lambda: near(posed.tint_ends(), (posed.seen_at(36)[0], posed.seen_at(44)[0])))
    pixels = ui.pixels()
    for vertex in (36, 44):
        assert shows(pixels, posed.seen_at(vertex), WHITE), "the seeds are there"
    assert not shows(pixels, posed.seen_at(36, 0.0), WHITE), "and not where the mesh is at rest"


def test_what_is_under_the_mouse_is_picked(posed: Posed) -> None:
    ui = posed.ui
    posed.bone.location.x = ACROSS
    choose(ui)
    ui.wait_until(lambda: edited.front is not None)
    for vertex in (40, 20, 60):
        ui.move(posed.seen_at(vertex))
        assert edited.front.session.target.pick == vertex
    ui.click(posed.seen_at(36))
    session = posed.session
    ui.click(posed.seen_at(44))
    ui.wait_until(lambda: len(session.wires) == 1)
    ui.key("RET")
    assert seams(posed.obj) == chain(*range(36, 45))
    ui.move(posed.seen_at(38))
    assert session.target.to == "WIRE"
    np.testing.assert_allclose(session.wires[0].points[0], (-1.0, 0.0, 0.0), atol=1e-6)


def test_a_stroke_stays_on_the_mesh(posed: Posed) -> None:
    ui = posed.ui
    posed.bone.location.x = ACROSS
    choose(ui)
    ui.wait_until(lambda: edited.front is not None)
    settings().along = "SURFACE"
    first, last = posed.seen_at(20), posed.seen_at(24)
    ui.move(first)
    ui.event("LEFTMOUSE", "PRESS", first, shift=True)
    for part in (0.3, 0.7, 1.0):
        ui.move((first[0] + part * (last[0] - first[0]), first[1]), shift=True)
    ui.event("LEFTMOUSE", "RELEASE", last, shift=True)
    (stroke,) = edited.front.session.network.strokes
    assert abs(stroke.points[:, 0].min() + 0.5) < 0.05
    assert abs(stroke.points[:, 0].max() - 0.5) < 0.05


@pytest.mark.oldest_and_newest
def test_the_drawing_follows_while_the_animation_plays(posed: Posed) -> None:
    ui, scene = posed.ui, bpy.context.scene
    for frame, x in ((1, 0.0), (11, ACROSS)):
        posed.bone.location.x = x
        posed.bone.keyframe_insert("location", frame=frame)
    for curve in getattr(posed.bone.id_data.animation_data.action, "fcurves", ()):
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    scene.frame_set(1)
    choose(ui)
    draw(posed, 36, 44)
    ui.move((3.0, ui.region.height - 3.0))
    view = edited.front
    scene.frame_set(11)
    ui.wait_until(lambda: near(posed.tint_ends(), (posed.seen_at(36)[0], posed.seen_at(44)[0])))
    scene.frame_set(1)
    ui.wait_until(lambda: near(posed.tint_ends(), (posed.seen_at(36, 0.0)[0], posed.seen_at(44, 0.0)[0])))
    assert edited.front is view
    assert not view.stale, "the mesh itself has not changed, so it is not read again"


def remake(posed: Posed) -> None:
    """Let a script remove the object, and make another one of the same name and mesh in another pose."""
    ui = posed.ui
    with ui.override():
        bpy.ops.object.mode_set(mode="OBJECT")
        obj, mesh = posed.obj, posed.obj.data
        made = obj.copy()
        made.data = mesh.copy()
        bpy.data.objects.remove(obj)
        bpy.data.meshes.remove(mesh)
        made.name = posed.name
        bpy.context.collection.objects.link(made)
        bpy.context.view_layer.objects.active = made
        made.select_set(True)
        posed.bone.location.x = ACROSS
        edit()


@pytest.mark.every_blender
def test_another_object_of_the_same_name_is_drawn_on_in_its_pose(posed: Posed) -> None:
    ui = posed.ui
    posed.bone.location.x = 0.5 * ACROSS
    choose(ui)
    ui.wait_until(lambda: edited.front is not None)
    view = edited.front
    remake(posed)
    ui.wait_until(lambda: edited.front is not None and not edited.front.stale and edited.front.exists)
    assert edited.front is view, "what was prepared for the mesh still holds"
    ui.move(posed.seen_at(40))
    assert edited.front.session.target.pick == 40


@pytest.mark.every_blender
def test_all_objects_are_removed_while_a_pose_is_followed(posed: Posed) -> None:
    ui = posed.ui
    choose(ui)
    for begins in (False, True):
        ui.wait_until(lambda: edited.front is not None)
        if begins:
            ui.click(posed.seen_at(36, 0.0))
            ui.move(posed.seen_at(40, 0.0))
        posed.bone.location.x = ACROSS
        posed.bone.id_data.update_tag()
        for obj in tuple(bpy.data.objects):
            bpy.data.objects.remove(obj)
        ui.move((0.5 * ui.region.width, 0.5 * ui.region.height))
        ui.wait(10, redraw=True)
        assert not edited.views()
        if not begins:
            posed.__init__(ui)
            choose(ui)


@pytest.fixture
def playing(desk: Desk) -> Iterator[Desk]:
    """The mesh with an armature that turns it, while its animation plays."""
    ui = desk.ui
    with ui.override():
        animate(desk.obj)
    desk.choose()
    ui.wait(10)
    yield desk
    with ui.override():
        bpy.ops.screen.animation_cancel(restore_frame=True)


@pytest.fixture
def reads(monkeypatch: pytest.MonkeyPatch) -> list[bpy.types.Object]:
    """The objects whose meshes are read, in order."""
    found, read = [], edit_mesh.read

    def noted(obj: bpy.types.Object) -> object:
        found.append(obj)
        return read(obj)

    monkeypatch.setattr(edit_mesh, "read", noted)
    return found


@pytest.mark.every_blender
def test_frames_do_not_read_the_mesh_again(playing: Desk, reads: list[bpy.types.Object]) -> None:
    desk, ui = playing, playing.ui
    frame = bpy.context.scene.frame_current
    with ui.override():
        bpy.ops.screen.animation_play()
    for vertex in (*range(36, 45), *range(36, 45)):
        ui.move(desk.at(vertex))
    assert reads == [], "hovering"
    ui.click(desk.at(36))
    for vertex in (*range(36, 45), *range(36, 45)):
        ui.move(desk.at(vertex))
    assert reads == [], "in a chain"
    ui.click(desk.at(44))
    ui.wait_until(lambda: len(desk.session.wires) == 1)
    assert bpy.context.scene.frame_current != frame, "it plays"
    ui.key("RET")
    assert seams(desk.obj) == chain(*range(36, 45))


def test_an_object_of_another_windows_scene_is_posed_by_its_own_scene(ui: driver.Ui) -> None:
    scene, new = bpy.context.scene, bpy.data.scenes.new("Other")
    with ui.override():
        bpy.ops.wm.window_new_main()
    window = bpy.context.window_manager.windows[-1]
    window.scene = new
    ui.wait(4)
    try:
        with bpy.context.temp_override(window=window):
            obj = add_grid(5)
            bent = obj.modifiers.new("Moved", "DISPLACE")
            bent.show_on_cage = bent.show_in_editmode = True
            bpy.ops.object.mode_set(mode="EDIT")
        with ui.override():
            assert bpy.context.scene == scene
            pose = Pose(edit_mesh.read(obj))
            pose.follow(obj)
        assert pose.is_bent
    finally:
        with bpy.context.temp_override(window=window):
            bpy.ops.object.mode_set(mode="OBJECT")
            bpy.ops.wm.window_close()
        ui.wait(4)
        bpy.data.scenes.remove(new)
