# SPDX-License-Identifier: GPL-3.0-or-later
"""What is ready is drawn, without a motion of the mouse and without another redraw than Blender's own."""

from collections import Counter
from types import SimpleNamespace

import bmesh
import bpy
import numpy as np
import pytest
import ui as driver
from desk import Desk, choose, leave, second_window
from numpy.typing import NDArray
from scene import add_grid, changing, edit, seams
from seamwire.core.islands import islands
from seamwire.mesh import edit_mesh, uv_islands
from seamwire.view import edited_objects, object_view
from seamwire.view.edited_objects import edited
from seamwire.view.overlay import Overlay
from seamwire.view.viewport import place_in

ABOVE, BELOW = (49, 59), (13, 23)
"""Opposite corners of a face on each side of the seam in the middle."""


@pytest.fixture
def halves(desk: Desk) -> Desk:
    """A grid with a seam across its middle, the tool chosen, and the mouse beside the mesh."""
    with changing(desk.obj) as bm:
        for edge in bm.edges:
            edge.seam = all(v.index // 9 == 4 for v in edge.verts)
            edge.select = False
        bm.select_flush(False)
    desk.ui.move((3.0, desk.ui.region.height - 3.0))
    choose(desk.ui)
    return desk


def region(ui: driver.Ui) -> NDArray[np.float32]:
    """Return the viewport as it is on the display; nothing is asked to be drawn."""
    whole, x, y = driver.display(), ui.window.x + ui.region.x, ui.window.y + ui.region.y
    return whole[y : y + ui.region.height, x : x + ui.region.width]


def is_tinted(desk: Desk) -> bool:
    """Whether the faces on both sides of the seam have different colors."""
    seen = region(desk.ui)
    above, below = (seen[round(y), round(x)] for x, y in (desk.at(*ABOVE), desk.at(*BELOW)))
    return float(np.abs(above - below).max()) > 0.04


def into(ui: driver.Ui, mode: str) -> None:
    with ui.override():
        bpy.ops.object.mode_set(mode=mode)
    ui.wait()


@pytest.mark.smoke
@pytest.mark.every_blender
def test_the_tint_is_there_after_tab_and_when_the_tool_is_chosen(halves: Desk) -> None:
    halves.ui.wait_until(lambda: is_tinted(halves))
    assert edited.front.name == halves.name, "its text is in the corner"
    for _ in range(2):
        into(halves.ui, "OBJECT")
        into(halves.ui, "EDIT")
        halves.ui.wait_until(lambda: is_tinted(halves))
    choose(halves.ui, "builtin.select_box")
    halves.ui.wait_until(lambda: not is_tinted(halves))
    halves.obj.data.update_tag()
    halves.ui.wait(10)
    choose(halves.ui)
    halves.ui.wait_until(lambda: is_tinted(halves))


def test_the_tint_is_there_on_a_duplicate(halves: Desk) -> None:
    ui = halves.ui
    ui.wait_until(lambda: is_tinted(halves))
    into(ui, "OBJECT")
    with ui.override():
        bpy.ops.object.duplicate()
    halves.name = bpy.context.view_layer.objects.active.name
    halves.obj.location.z = 0.5
    into(ui, "EDIT")
    ui.wait_until(lambda: is_tinted(halves))
    assert edited.front.name == halves.name


def test_the_tint_is_there_after_undo_and_redo(halves: Desk) -> None:
    ui = halves.ui
    bpy.ops.ed.undo_push(message="Seams")
    with changing(halves.obj) as bm:
        for edge in bm.edges:
            edge.seam = False
    bpy.ops.ed.undo_push(message="No seams")
    ui.wait_until(lambda: not is_tinted(halves))
    ui.key("Z", ctrl=True)
    assert len(seams(halves.obj)) == 8
    ui.wait_until(lambda: is_tinted(halves))
    ui.key("Z", ctrl=True, shift=True)
    ui.wait_until(lambda: not is_tinted(halves))
    ui.key("Z", ctrl=True)
    ui.wait_until(lambda: is_tinted(halves))


def test_the_tint_is_there_on_a_mesh_with_other_vertices(halves: Desk) -> None:
    ui = halves.ui
    ui.wait_until(lambda: is_tinted(halves))
    for _ in range(2):
        with changing(halves.obj) as bm:
            bmesh.ops.poke(bm, faces=[bm.faces[0]])
        ui.wait(2)
        ui.wait_until(lambda: len(edited.views()) == 1 and is_tinted(halves))


def test_islands_of_a_thread_are_drawn_when_they_are_found(halves: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(islands, "AT_ONCE", 0)
    into(halves.ui, "OBJECT")
    into(halves.ui, "EDIT")
    halves.ui.wait_until(lambda: is_tinted(halves))


def test_a_new_window_draws(halves: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    drawn: Counter[int] = Counter()
    draw = Overlay.draw_in_scene

    def counted(overlay: Overlay, *given: object) -> None:
        drawn[bpy.context.window.as_pointer()] += 1
        draw(overlay, *given)

    monkeypatch.setattr(Overlay, "draw_in_scene", counted)
    with second_window(halves.ui) as other:
        halves.ui.wait_until(lambda: drawn[other["window"].as_pointer()] > 0)


def test_the_drawing_is_back_when_suggest_has_cut_the_mesh(ui: driver.Ui) -> None:
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3)
    ui.move((3.0, ui.region.height - 3.0))
    with ui.override():
        edit()
    choose(ui)
    try:
        ui.wait_until(lambda: len(edited.views()) == 1)
        with ui.override():
            done = bpy.ops.mesh.seamwire_suggest(along="SURFACE", finish="CUT", symmetric=False)
        assert done == {"FINISHED"}
        ui.wait_until(lambda: bool(edited.views()) and edited.front is not None and edited.front.islands.newest.cut)
        assert edited.front.islands.newest.count >= 1
    finally:
        leave(ui)


def test_pointing_reads_and_copies_nothing_that_has_not_changed(ui: driver.Ui, monkeypatch: pytest.MonkeyPatch) -> None:
    add_grid(5, size=1.0, name="Hidden").location.x = 0.8
    add_grid(5, size=1.0, name="Shown").location.x = -0.8
    with ui.override():
        edit()
    with changing(bpy.data.objects["Hidden"]) as bm:
        for item in (*bm.verts, *bm.edges, *bm.faces):
            item.hide = True
    ui.look_from_top(distance=4.0)
    choose(ui)
    try:
        ui.wait_until(lambda: edited.front is not None and edited.front.name == "Shown")
        at = [(round(x), round(y)) for x, y in (ui.on_screen((side * 0.8, 0.03, 0.0)) for side in (-1, 1))]
        for place in at:
            edited.hover(place_in(ui.area, ui.region, place))
        calls: Counter[str] = Counter()

        def count(owner: object, name: str) -> None:
            function = getattr(owner, name)

            def counted(*arguments: object) -> object:
                calls[name] += 1
                return function(*arguments)

            monkeypatch.setattr(owner, name, counted)

        count(edit_mesh, "read")
        count(uv_islands, "read_uvs")
        count(object_view, "let_blender_tell")
        for step in range(20):
            for x, y in at:
                edited.hover(place_in(ui.area, ui.region, (x + step, y)))
        assert edited.front.name == "Shown"
        assert calls == {}
        monkeypatch.undo()
        with ui.override():
            bpy.ops.mesh.reveal()
        ui.wait_until(lambda: len(edited.views()) == 2)
    finally:
        leave(ui)


def test_drawing_does_not_look_at_the_objects_of_the_scene(halves: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    halves.ui.wait_until(lambda: is_tinted(halves))

    class Context:
        """Blender's context without what leads to all objects."""

        def __getattr__(self, name: str) -> object:
            assert name not in {"view_layer", "scene"}, "drawing looks at all objects"
            return getattr(bpy.context, name)

    proxy = SimpleNamespace(context=Context(), types=bpy.types, app=bpy.app, data=bpy.data)
    with monkeypatch.context() as patch:
        patch.setattr(edited_objects, "bpy", proxy)
        halves.ui.wait(3, redraw=True)
        assert is_tinted(halves)
