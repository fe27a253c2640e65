# SPDX-License-Identifier: GPL-3.0-or-later
"""What the metric sees, as views over the model: in edit mode with the tool, and in object mode."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import numpy as np
import pytest
import ui as driver
from desk import Desk, draw, grid, half_cone, leave, near
from mathutils import Vector
from scene import add_suzanne
from seamwire.core.fields.color_maps import PURPLE_ORANGE, colors
from seamwire.mesh.settings import settings
from seamwire.view import gpu_draw, metric_views
from seamwire.view.edited_objects import edited
from seamwire.view.metric_views import MetricViews
from seamwire.view.object_mode import object_mode

VIEWS = (
    ("heat", "STRENGTH"),
    ("heat", "CONCAVITY"),
    ("heat", "DISTANCE"),
    ("show_crests", True),
    ("show_ellipses", True),
    ("show_paths", True),
    ("show_bands", True),
    ("show_invalid", True),
)


@pytest.fixture
def desk(ui: driver.Ui) -> Iterator[Desk]:
    bpy.context.scene.cursor.location = (0.0, 0.0, 0.0)
    made = Desk(ui, add_suzanne(1))
    ui.look((0.7071, 0.7071, 0.0, 0.0), (0.0, 0.0, 0.0), 4.0)
    yield made
    settings().views_in_object_mode = False
    ui.wait(10)
    leave(ui)


def views() -> MetricViews:
    return edited.front.overlay._views


def shown(found: MetricViews) -> bool:
    """Whether what is asked for is all there."""
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
        desk.ui.wait_until(lambda: shown(views()))
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
    desk.ui.wait_until(lambda: shown(views()))
    desk.start()
    screen(desk)
    assert desk.running, "drawing it ended nothing"
    assert len(views()._made["silhouette"][1][1]._ends) == 0
    desk.ui.key("ESC")
    desk.obj.scale.z = 1.0
    desk.ui.wait_until(lambda: shown(views()))
    screen(desk)
    assert len(views()._made["silhouette"][1][1]._ends) > 0
    settings().property_unset("show_silhouette")


def test_a_sheet_seen_from_above_has_no_silhouette(ui: driver.Ui) -> None:
    desk = grid(ui)
    settings().show_silhouette = True
    desk.choose()
    desk.ui.wait_until(lambda: shown(views()))
    screen(desk)
    assert len(views()._made["silhouette"][1][1]._ends) == 0
    settings().property_unset("show_silhouette")


@pytest.mark.parametrize("perspective", ["ORTHO", "PERSP"])
@pytest.mark.oldest_and_newest
def test_the_silhouette_follows_the_view(desk: Desk, perspective: str) -> None:
    desk.ui.view.view_perspective = perspective
    desk.choose()
    before = screen(desk)
    settings().show_silhouette = True
    desk.ui.wait_until(lambda: shown(views()))
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


def test_turning_the_view_hands_nothing_to_the_gpu_again(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[str] = []
    for name in ("ShadedFaces", "ColoredLines", "Lines", "Faces"):
        kind = getattr(gpu_draw, name)

        def counted(*arguments: object, kind: type = kind, name: str = name, **options: object) -> object:
            made.append(name)
            return kind(*arguments, **options)

        monkeypatch.setattr(metric_views, name, counted)
    desk.choose()
    draw(desk, 20, 300)
    for name, value in VIEWS:
        setattr(settings(), name, value)
    desk.ui.wait_until(lambda: shown(views()))
    screen(desk)
    assert set(made) == {"ShadedFaces", "ColoredLines", "Lines", "Faces"}
    made.clear()
    for step in range(8):
        desk.ui.view.view_rotation = (0.7, 0.7, 0.02 * step, 0.0)
        desk.ui.wait(redraw=True)
    assert made == []
    # Nor what is switched off and on again, or what others change.
    for name in ("show_paths", "show_bands"):
        setattr(settings(), name, False)
        desk.ui.wait(redraw=True)
        setattr(settings(), name, True)
        desk.ui.wait_until(lambda: shown(views()))
        screen(desk)
    assert made == []


@pytest.mark.oldest_and_newest
def test_convex_is_orange_and_concave_purple(ui: driver.Ui) -> None:
    desk = half_cone(ui)
    try:
        desk.choose()
        settings().heat = "CONCAVITY"
        desk.ui.wait_until(lambda: shown(views()))
        assert (views().fields.concavity[36:45] > 0.0).all()
        seen = near(screen(desk), desk.at(31, 41)).mean(axis=0)
        orange, purple = colors(np.array([0.85, 0.15]), PURPLE_ORANGE)
        assert np.linalg.norm(seen - orange) < np.linalg.norm(seen - purple)
        assert seen[0] > seen[2] + 0.1
    finally:
        leave(ui)


def test_distances_are_from_the_seed_of_the_chain_and_from_a_selected_vertex_before(ui: driver.Ui) -> None:
    desk = grid(ui)
    try:
        desk.choose()
        settings().show_bands = settings().show_paths = True
        desk.ui.wait_until(lambda: "select a vertex" in " ".join(views().legends()[-1].lines))
        assert views().fields is None or views().fields.isolines is None
        desk.ui.click(desk.at(40))
        desk.ui.wait_until(lambda: shown(views()) and views().fields.request.source == 40)
        segments = views().fields.isolines.segments
        ends = np.linalg.norm(segments.reshape(-1, 3) - (0.0, 0.0, 0.0), axis=1)
        assert ends.max() < 1.5
        # A plane has no features: paths are straight, and as long as they are in the unit cube.
        paths = views().fields.paths
        lasts = paths.points[paths.starts[1:] - 1]
        assert paths.lengths == pytest.approx(np.linalg.norm(lasts, axis=1) / 2.0, abs=1e-6)
        desk.ui.click(desk.at(44))
        desk.ui.wait_until(lambda: shown(views()) and views().fields.request.source == 44)
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
    settings().heat = "STRENGTH"
    before = screen(desk)
    settings().views_in_object_mode = True
    ui.wait_until(lambda: object_mode.views is not None and shown(object_mode.views))
    assert np.abs(screen(desk) - before).max(axis=2).mean() > 0.02
    strength = object_mode.views.fields.strength
    desk.obj.data.vertices[20].co.z += 0.2
    desk.obj.data.update()
    ui.wait_until(
        lambda: (
            object_mode.views is not None
            and shown(object_mode.views)
            and not np.array_equal(object_mode.views.fields.strength, strength)
        )
    )
    desk.obj.data.vertices[20].co.z -= 0.2
    desk.obj.data.update()
    settings().views_in_object_mode = False
    ui.wait_until(lambda: object_mode.views is None)
    assert alike(screen(desk), before)


def test_object_mode_shows_nothing_of_a_mesh_without_edges_and_says_why(ui: driver.Ui) -> None:
    mesh = bpy.data.meshes.new("Empty")
    obj = bpy.data.objects.new("Empty", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    settings().heat, settings().views_in_object_mode = "STRENGTH", True
    try:
        ui.wait_until(lambda: object_mode._shown is not None)
        assert "nothing to draw on" in object_mode._shown.problem
        ui.wait(5, redraw=True)
    finally:
        settings().views_in_object_mode, settings().heat = False, "NONE"
        ui.wait_until(lambda: object_mode._shown is None)
        bpy.data.objects.remove(obj)
