# SPDX-License-Identifier: GPL-3.0-or-later
"""An animation that plays while wires are drawn: the edit mesh stays as it is, so it is not read again."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import pytest
from desk import Desk
from scene import animate, chain, seams
from seamwire.mesh import edit_mesh


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
