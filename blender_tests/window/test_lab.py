# SPDX-License-Identifier: GPL-3.0-or-later
"""The views of Seamwire Lab over the model: in Edit Mode with the tool, and in Object Mode."""

from __future__ import annotations

import gc
import weakref
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
import traces
import ui as driver
from desk import Desk, draw, grid, half_cone, leave, near
from lab import disable_lab, enable_lab, of_lab, part
from mathutils import Vector
from scene import add_suzanne
from seamwire.view.edited_objects import edited
from seamwire.view.theme import colors

VIEWS = (
    ("heat", "STRENGTH"),
    ("heat", "CONCAVITY"),
    ("heat", "DISTANCE"),
    ("show_ellipses", True),
    ("show_paths", True),
    ("show_bands", True),
    ("show_invalid", True),
)


@pytest.fixture(autouse=True)
def lab(ui: driver.Ui) -> Iterator[bpy.types.PropertyGroup]:
    """The settings of the enabled add-on."""
    enable_lab()
    yield settings()
    disable_lab()
    ui.wait(3)


def settings() -> bpy.types.PropertyGroup:
    return bpy.context.window_manager.seamwire_lab


def follower() -> object:
    return part("follower").follower


@pytest.fixture
def desk(ui: driver.Ui) -> Iterator[Desk]:
    bpy.context.scene.cursor.location = (0.0, 0.0, 0.0)
    made = Desk(ui, add_suzanne(1))
    ui.look((0.7071, 0.7071, 0.0, 0.0), (0.0, 0.0, 0.0), 4.0)
    yield made
    leave(ui)


def views() -> object:
    """Return the lab's layer over the edited object. It lies above the tool's own layer."""
    return edited.front.overlay._layers[2]


def shown(found: object | None = None) -> bool:
    """Return whether everything is computed that the layer over the edited object, or other views, should show."""
    if found is None:
        layers = edited.front.overlay._layers if edited.front is not None else []
        if len(layers) < 3:
            return False  # it is added by a timer, soon after the first view is switched on
        found = layers[2]
    return found.is_complete and not found.busy


def screen(desk: Desk) -> np.ndarray:
    desk.ui.move((desk.ui.region.width * 0.5, 30.0))
    desk.ui.wait(3)
    return desk.ui.screen()


def alike(one: np.ndarray, two: np.ndarray) -> bool:
    """Whether two pictures are the same but for what Blender lights up under the mouse."""
    return bool((np.abs(one - two).max(axis=2) > 0.05).mean() < 0.001)


@pytest.mark.oldest_and_newest
def test_each_view_is_seen_with_its_legend_and_gone_when_it_is_switched_off(desk: Desk) -> None:
    desk.choose()
    draw(desk, 20, 300)
    before = screen(desk)
    for name, value in VIEWS:
        setattr(settings(), name, value)
        desk.ui.wait_until(shown)
        changed = np.abs(screen(desk) - before).max(axis=2) > 0.05
        # Lines lie over little of the view; the legend is text in the lower right corner.
        assert changed[:, : changed.shape[1] * 2 // 3].mean() > 0.003, name
        assert changed[: changed.shape[0] // 3, changed.shape[1] * 2 // 3 :].mean() > 0.02, name
        assert len(views().legends()) == 1
        settings().property_unset(name)
        assert alike(screen(desk), before), name
        assert views().legends() == []


def test_a_flattened_object_has_no_silhouette(desk: Desk) -> None:
    settings().show_silhouette = True
    desk.obj.scale.z = 0.0
    desk.choose()
    desk.ui.wait_until(shown)
    desk.start()
    screen(desk)
    assert desk.running, "drawing it ended nothing"
    assert len(views()._made["silhouette"][1][1]._ends) == 0
    desk.ui.key("ESC")
    desk.obj.scale.z = 1.0
    desk.ui.wait_until(shown)
    screen(desk)
    assert len(views()._made["silhouette"][1][1]._ends) > 0
    settings().property_unset("show_silhouette")


@pytest.mark.parametrize("perspective", ["ORTHO", "PERSP"])
@pytest.mark.oldest_and_newest
def test_the_silhouette_follows_the_view(desk: Desk, perspective: str) -> None:
    desk.ui.view.view_perspective = perspective
    desk.choose()
    before = screen(desk)
    settings().show_silhouette = True
    desk.ui.wait_until(shown)
    assert (np.abs(screen(desk) - before).max(axis=2) > 0.05).mean() > 0.002
    assert [legend.swatches[0][1] for legend in views().legends()] == ["Silhouette of this view"]
    eye = np.array(desk.ui.view.view_matrix.inverted() @ Vector((0.0, 0.0, 0.0)))
    along = np.array(desk.ui.view.view_matrix.inverted().to_3x3() @ Vector((0.0, 0.0, 1.0)))
    place = np.append(along, 0.0) if perspective == "ORTHO" else np.append(eye, 1.0)
    lines = views()._made["silhouette"][1][1]
    expected = views().fields.silhouette.seen_from(place)
    np.testing.assert_allclose(np.sort(lines._ends, axis=1), np.sort(expected, axis=1), atol=1e-4)
    desk.ui.look((0.5, 0.5, 0.5, 0.5), (0.0, 0.0, 0.0), 4.0)
    desk.ui.wait(3, redraw=True)
    turned = views()._made["silhouette"][1][1]
    assert turned is not lines
    desk.ui.wait(3, redraw=True)
    assert views()._made["silhouette"][1][1] is turned
    settings().property_unset("show_silhouette")


@pytest.mark.oldest_and_newest
@pytest.mark.parametrize("names", [("heat",), ("show_bands", "show_paths")])
def test_beyond_the_clipping_border_nothing_is_colored(ui: driver.Ui, names: tuple[str, ...]) -> None:
    desk = grid(ui)
    desk.choose()
    draw(desk, 36, 44)
    (x, y), (right, top) = desk.at(4), desk.at(80)
    try:
        with ui.override():
            bpy.ops.view3d.clip_border(
                xmin=round(x), xmax=ui.region.width - 5, ymin=5, ymax=ui.region.height - 5, wait_for_input=False
            )
        plain = screen(desk)
        for name in names:
            setattr(settings(), name, "DISTANCE" if name == "heat" else True)
        ui.wait_until(shown)
        colored = (np.abs(screen(desk) - plain).max(axis=2) > 0.02)[round(y) : round(top)]
        assert not colored[:, round(desk.at(0)[0]) : round(x) - 4].any()
        assert colored[:, round(x) + 4 : round(right)].mean() > (0.5 if names == ("heat",) else 0.02)
    finally:
        ui.view.use_clip_planes = False
        leave(ui)


@pytest.mark.oldest_and_newest
def test_convex_is_orange_and_concave_purple(ui: driver.Ui) -> None:
    desk = half_cone(ui)
    try:
        desk.choose()
        settings().heat = "CONCAVITY"
        desk.ui.wait_until(shown)
        assert (views().fields.concavity[36:45] > 0.0).all()
        seen = near(screen(desk), desk.at(31, 41)).mean(axis=0)
        orange, purple = colors(np.array([0.85, 0.15]), part("color_tables").PURPLE_ORANGE)
        assert np.linalg.norm(seen - orange) < np.linalg.norm(seen - purple)
        assert seen[0] > seen[2] + 0.1
    finally:
        leave(ui)


def test_distances_are_from_the_seed_of_the_chain_and_from_a_selected_vertex_before(ui: driver.Ui) -> None:
    desk = grid(ui)
    try:
        desk.choose()
        settings().show_bands = settings().show_paths = True
        desk.ui.wait_until(lambda: len(edited.front.overlay._layers) == 3)
        assert "select a vertex" in " ".join(views().legends()[-1].lines)
        assert views().fields is None or views().fields.isolines is None
        desk.ui.click(desk.at(40))
        desk.ui.wait_until(lambda: shown() and views().fields.request.source == 40)
        segments = views().fields.isolines.segments
        ends = np.linalg.norm(segments.reshape(-1, 3) - (0.0, 0.0, 0.0), axis=1)
        assert ends.max() < 1.5
        # A plane has no features: paths are straight.
        paths = views().fields.paths
        lasts = paths.points[paths.starts[1:] - 1]
        assert paths.lengths == pytest.approx(np.linalg.norm(lasts, axis=1), abs=1e-6)
        desk.ui.click(desk.at(44))
        desk.ui.wait_until(lambda: shown() and views().fields.request.source == 44)
        desk.ui.click(desk.at(44), button="RIGHTMOUSE")
    finally:
        leave(ui)


@pytest.mark.smoke
@pytest.mark.every_blender
def test_in_object_mode_what_is_shown_follows_the_active_object_and_its_mesh(desk: Desk) -> None:
    ui = desk.ui
    bpy.ops.object.mode_set(mode="OBJECT")
    desk.obj.shape_key_clear()  # they, not the vertices, say where all is
    ui.wait(3, redraw=True)
    before = screen(desk)
    settings().heat = "STRENGTH"
    ui.wait_until(lambda: follower().views is not None and shown(follower().views))
    assert np.abs(screen(desk) - before).max(axis=2).mean() > 0.02
    strength = follower().views.fields.strength
    desk.obj.data.vertices[20].co.z += 0.2
    desk.obj.data.update()
    ui.wait_until(
        lambda: (
            follower().views is not None
            and shown(follower().views)
            and not np.array_equal(follower().views.fields.strength, strength)
        )
    )
    desk.obj.data.vertices[20].co.z -= 0.2
    desk.obj.data.update()
    settings().heat = "NONE"
    ui.wait_until(lambda: follower().views is None)
    assert alike(screen(desk), before)


def test_object_mode_shows_nothing_of_a_mesh_without_edges_and_says_why(ui: driver.Ui) -> None:
    mesh = bpy.data.meshes.new("Empty")
    obj = bpy.data.objects.new("Empty", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    settings().heat = "STRENGTH"
    ui.wait_until(lambda: "No face is visible" in follower().problem)
    ui.wait(5, redraw=True)


def test_what_fails_in_object_mode_is_said_once_and_tried_again_on_another_object(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls = []

    def fail(*_: object) -> None:
        calls.append(1)
        raise RuntimeError("broken")

    with desk.ui.override():
        bpy.ops.object.mode_set(mode="OBJECT")
    with monkeypatch.context() as patched:
        patched.setattr(part("views").Views, "follow", fail)
        settings().show_bands = True
        desk.ui.wait_until(lambda: "broken" in follower().problem)
        desk.ui.wait(20, redraw=True)
        assert len(calls) == 1
    (error,) = driver.take_errors()
    assert "broken" in error
    with desk.ui.override():
        bpy.ops.object.duplicate()
    desk.ui.wait_until(lambda: not follower().problem and follower().views is not None)


@pytest.mark.every_blender
def test_disabled_with_the_tool_it_draws_nothing_until_both_are_back(desk: Desk) -> None:
    ui = desk.ui
    bpy.ops.object.mode_set(mode="OBJECT")
    settings().heat = "STRENGTH"
    ui.wait_until(lambda: follower().views is not None and shown(follower().views))
    traces.disable()
    try:
        assert of_lab() == []
        ui.wait(5, redraw=True)
    finally:
        traces.enable()
    settings().heat = "STRENGTH"
    ui.wait_until(lambda: follower().views is not None and shown(follower().views))


@pytest.mark.parametrize("load_ui", [False, True])
def test_views_follow_another_file(desk: Desk, tmp_path: Path, load_ui: bool) -> None:
    bpy.ops.object.mode_set(mode="OBJECT")
    path = str(tmp_path / "a.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    settings().heat = "STRENGTH"
    desk.ui.wait_until(lambda: follower().views is not None and shown(follower().views))
    before = follower().views
    bpy.ops.wm.open_mainfile(filepath=path, load_ui=load_ui)
    driver.Ui.__init__(desk.ui)  # the file may have brought another window
    if load_ui:  # the settings came with the window manager of the file
        desk.ui.wait_until(lambda: part("lab_settings").is_any_shown() or not follower()._handles)
    else:
        desk.ui.wait_until(lambda: follower().views not in {None, before} and shown(follower().views))
    desk.ui.wait(3, redraw=True)


def test_what_was_prepared_for_a_mesh_is_freed_with_it(desk: Desk) -> None:
    desk.choose()
    settings().show_paths = True
    desk.ui.wait_until(shown)
    gone = weakref.ref(views())
    gc.collect()
    gc.disable()
    try:
        edited.forget(edited.front)
        assert gone() is None
    finally:
        gc.enable()


@pytest.mark.every_blender
def test_disabled_while_it_shows_views_it_leaves_nothing_behind(desk: Desk) -> None:
    desk.choose()
    before = traces.traces()
    settings().heat = "STRENGTH"
    desk.ui.wait_until(shown)
    disable_lab()
    try:
        assert len(edited.front.overlay._layers) == 2
        assert of_lab() == []
        desk.ui.wait(5, redraw=True)
    finally:
        enable_lab()
    assert traces.difference(before, traces.traces()) == {}


@pytest.mark.smoke
@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_its_panel_shows_the_tools_settings_in_object_mode(desk: Desk, mode: str) -> None:
    drawn: list[str] = []
    panel = part("panel").VIEW3D_PT_seamwire_lab
    bpy.ops.object.mode_set(mode=mode)
    assert panel.poll(bpy.context)
    layout = SimpleNamespace(
        prop=lambda _owner, name, **_: drawn.append(name), menu=drawn.append, column=lambda **_: layout
    )
    panel.draw(SimpleNamespace(layout=layout), bpy.context)
    assert {"heat", "show_ellipses", "shown_metric", "VIEW3D_MT_seamwire_lab_store"} <= set(drawn)
    assert ("metric" in drawn) == (mode == "OBJECT")


def test_after_an_error_the_views_go_on_and_it_is_told_once(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    with desk.ui.override():
        bpy.ops.object.mode_set(mode="OBJECT")
    own = part("follower")
    calls: list[object] = []

    def fail(_: object) -> None:
        calls.append(None)
        raise RuntimeError("broken")

    with monkeypatch.context() as broken:
        broken.setattr(own.tool, "add_layer", fail)
        settings().heat = "STRENGTH"
        desk.ui.wait_until(lambda: len(calls) > 3)
    assert sum("broken" in error for error in driver.take_errors()) == 1
    desk.ui.wait_until(lambda: follower().views is not None and shown(follower().views))
    settings().property_unset("heat")
