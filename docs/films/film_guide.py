# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of the guide and of the installation."""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import bpy
import numpy as np
import show
import ui as driver
from film_hand import session, write_png
from film_stage import EAR, EYE, FACE, aside, settings, show_first_steps, stage, start, unwrap
from lab import enable_lab, part
from mathutils import Euler, Vector

if TYPE_CHECKING:
    from film_hand import Film


def guide(film: Film) -> None:
    """Take what the guide shows, one picture after the other."""
    film.filming = False
    stage(film)
    film.at = film.vertex(0.0, -0.6, 0.80)
    start(film)
    film.go(film.vertex(0.1, -0.75, 0.1))
    film.click()
    film.go(film.vertex(0.95, 0.1, 0.1))
    film.picture("wires")
    film.key("ESC")
    film.go(film.vertex(0.0, -0.6, 0.80))
    film.click()
    film.go(film.vertex(0.80, -0.40, 0.40))
    film.key("E")
    start_of, end_of = film.vertex(0.0, -0.6, 0.80), film.at
    film.go(end_of)
    film.picture("stroke-before")
    over = film.vertex(0.40, -0.10, 1.0)
    draw_stroke(film, [bend(start_of, over, end_of, part) for part in np.linspace(0.05, 0.95, 30)])
    film.go(end_of)
    film.picture("stroke-after")
    film.key("BACK_SPACE")
    film.key("E")
    film.go(end_of)
    film.click()
    film.go(film.vertex(0.55, -0.40, -0.30))
    film.click()
    film.go(film.vertex(0.0, -0.75, -0.08))
    film.click()
    film.click("RIGHTMOUSE")
    film.go(film.vertex(0.55, -0.40, -0.30))
    film.ui.event("LEFTMOUSE", "PRESS", film.at)
    film.go(film.vertex(0.40, -0.65, -0.12))
    film.ui.wait_until(lambda: session().moved[0] and not session().computing)
    film.picture("drag")
    film.ui.event("LEFTMOUSE", "RELEASE", film.at)
    film.settle()
    film.peek(film.edge(EYE))
    film.picture("loop")
    film.take()
    film.obj.data.use_mirror_x = True
    film.peek(film.edge(EAR))
    film.take()
    film.peek(film.middle_edge(0.0, -0.45, 0.9))
    film.picture("strip")
    film.take()
    film.go(film.vertex(0.9, -0.4, -0.6))
    film.picture("segments")
    film.click()
    film.key("F1")
    film.picture("keys")
    film.key("ESC")
    film.click("RIGHTMOUSE")
    unwrap(film)
    film.picture("unwrapped")


def tool(film: Film) -> None:
    """Take the tool before the first click, with its menu and its views open, and in a chain. The names have Blender's version."""
    version = ".".join(map(str, bpy.app.version[:2]))
    film.filming = False
    bpy.context.preferences.view.show_tooltips = False
    stage(film)
    film.at = film.vertex(0.0, -0.6, 0.80)
    show_first_steps(True)
    for _ in range(20):  # the tool is at the end of the toolbar
        film.ui.wheel(up=False, at=(30.0, 300.0))
    film.ui.space.show_gizmo = True
    start(film)
    film.ui.wait(20, redraw=True)
    film.picture(f"tool-{version}-first")
    film.ui.space.show_gizmo = False
    show_first_steps(False)
    film.ui.wait(20, redraw=True)
    film.picture(f"tool-{version}-before")
    for kind, name in (("menu", "VIEW3D_MT_seamwire"), ("panel", "VIEW3D_PT_seamwire_overlays")):
        with film.ui.override():
            getattr(bpy.ops.wm, f"call_{kind}")(name=name)
        film.ui.wait(6)
        film.picture(f"tool-{version}-{kind}")
        film.ui.key("ESC")
        film.ui.wait(6)
    film.click()
    film.go(film.vertex(0.80, -0.40, 0.40))
    film.ui.wait(20, redraw=True)
    film.picture(f"tool-{version}-chain")
    film.key("ESC")


def cut(film: Film) -> None:
    """Take what becomes of a wire over irregular triangles: snapped to edges, and cut into the faces."""
    import seamwire

    film.filming = False
    stage(film)
    bpy.ops.object.mode_set(mode="OBJECT")
    modifier = film.obj.modifiers.new("Scan", "DECIMATE")
    modifier.ratio = 0.25
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    bpy.ops.object.shade_flat()
    bpy.ops.object.mode_set(mode="EDIT")
    vertices = film.obj.data.vertices
    around_eye = ((0.2, -0.8, 0.55), (0.05, -0.75, 0.1), (0.55, -0.6, -0.1), (0.75, -0.5, 0.35), (0.5, -0.75, 0.5))
    places = [Vector(place) for place in (*around_eye, around_eye[0])]
    seeds = [min(vertices, key=lambda v: (v.co - place).length).index for place in places]
    film.ui.view.view_rotation = Euler((1.3, 0.0, 0.3)).to_quaternion()
    film.ui.view.view_location = (0.2, 0.0, 0.12)
    film.ui.view.view_distance = 1.7
    with film.ui.override():
        seamwire.mark(bpy.context.object, [seeds], along="SURFACE")
    settings().along = "SURFACE"
    film.at = aside(film)
    for name, what in (("snapped", None), ("cut", partial(bpy.ops.mesh.seamwire_finish, finish="CUT"))):
        if what is not None:
            with film.ui.override():
                what()
        start(film)
        film.ui.wait(10, redraw=True)
        film.picture(name)


def stretch(film: Film) -> None:
    """Take the stretch of a UV map before and after loops around the face, the eyes and the ears. The islands that change are unwrapped."""
    film.filming = False
    stage(film)
    settings().heat, settings().unwrap = "AREA", True
    film.obj.data.use_mirror_x = True
    start(film)
    middle = film.middle_edge(0.0, -0.45, 0.9)
    for edges, name in (((middle,), "before"), ((film.edge(FACE), film.edge(EYE), film.edge(EAR)), "after")):
        for edge in edges:
            film.peek(edge)
            film.take()
        film.go(aside(film))
        film.ui.wait(30, redraw=True)
        film.picture(f"stretch-{name}")


def lab(film: Film) -> None:
    """Take the panel of Seamwire Lab in Object Mode, over a view. The name has Blender's version."""
    enable_lab()
    of_lab, follower = part("settings").settings(), part("follower").follower
    film.filming = False
    bpy.context.preferences.view.ui_scale = 1.4
    bpy.context.preferences.view.show_tooltips = False
    stage(film)
    bpy.ops.object.mode_set(mode="OBJECT")
    film.obj.select_set(False)
    place = Vector((0.0, -0.6, 0.80))
    min(film.obj.data.vertices, key=lambda vertex: (vertex.co - place).length).select = True
    settings().along, of_lab.heat, of_lab.show_bands = "SURFACE", "DISTANCE", True
    film.ui.wait_until(lambda: follower.views is not None and follower.views.is_complete, 60.0)
    film.ui.move((film.ui.region.width * 0.78, film.ui.region.height * 0.75))
    with film.ui.override():
        bpy.ops.wm.call_panel(name="VIEW3D_PT_seamwire_lab")
    film.ui.wait(8)
    film.picture(f"lab-{'.'.join(map(str, bpy.app.version[:2]))}")
    film.ui.key("ESC")


def views(film: Film) -> None:
    """Take views of Seamwire Lab in Object Mode, six in one picture. The window has about the size of one of the six."""
    enable_lab()
    follower, of_lab = part("follower").follower, part("settings").settings()
    film.filming = False
    # The guide shows the picture at half its size.
    bpy.context.preferences.view.ui_scale = 1.7
    stage(film)
    space, view = film.ui.space, film.ui.view
    space.show_region_header = space.show_region_tool_header = space.show_region_toolbar = False
    bpy.ops.object.mode_set(mode="OBJECT")
    subdivision = film.obj.modifiers.new("Subdivision", "SUBSURF")
    film.obj.select_set(False)
    place = Vector((0.0, -0.6, 0.80))
    min(film.obj.data.vertices, key=lambda vertex: (vertex.co - place).length).select = True
    settings().along = "SURFACE"
    film.ui.wait(8, redraw=True)
    film.at = (-100.0, -100.0)
    head, nose = ((0.25, 0.0, -0.02), 2.7), ((0.12, -0.9, -0.16), 0.42)
    shots = []
    for (centre, distance), levels, shown in (
        (head, 1, {"heat": "STRENGTH"}),
        (head, 1, {"heat": "DISTANCE", "show_bands": True}),
        (head, 1, {"show_ellipses": True}),
        (head, 1, {"show_paths": True}),
        (nose, 0, {"show_invalid": True}),
        (head, 1, {"heat": "CONCAVITY", "show_silhouette": True}),
    ):
        view.view_location, view.view_distance = centre, distance
        subdivision.levels = levels
        for name, value in shown.items():
            setattr(of_lab, name, value)
        film.ui.wait(3, redraw=True)  # all of them are asked for by then
        film.ui.wait_until(lambda: follower.views is not None and follower.views.is_complete, 60.0)
        picture = film.shot()[:, :, :3]
        region = film.ui.region
        # Arrows that bring hidden regions back lie at the top and at the right.
        right, top = region.x + region.width - 14, picture.shape[0] - region.y - region.height + 20
        shot = picture[top : top + region.height - 20, right - 800 : right].copy()
        shot[-3:], shot[:, -3:] = 20, 20
        shots.append(shot)
        for name in shown:
            of_lab.property_unset(name)
    rows = [np.concatenate(shots[i : i + 2], axis=1) for i in (0, 2, 4)]
    write_png(film.folder / "guide-views.png", np.concatenate(rows))
    film.ui.wait(20)


def bend(
    one: tuple[float, float], over: tuple[float, float], two: tuple[float, float], part: float
) -> tuple[float, float]:
    """Return a place on an arc that is drawn towards a point between its ends."""
    a, b, c = map(np.array, (one, over, two))
    x, y = (1.0 - part) ** 2 * a + 2.0 * part * (1.0 - part) * b + part**2 * c
    return float(x), float(y)


def draw_stroke(film: Film, places: list[tuple[float, float]]) -> None:
    """Draw a stroke that wires are to follow, and take its picture before the button is let go."""
    film.go(places[0])
    film.ui.event("LEFTMOUSE", "PRESS", film.at, shift=True)
    for place in places[1:]:
        film.go(place, 1, shift=True)
    film.picture("stroke")
    film.ui.event("LEFTMOUSE", "RELEASE", film.at, shift=True)
    film.settle()


def install(film: Film) -> None:
    """Take how the add-on is installed from a file: the menu, the file, and the result."""
    film.filming = False
    # Blender warns of extensions with short module names. Only enable_addon() adds such names.
    for name in [name for name in sys.modules if name.split(".")[0] == "seamwire"]:
        del sys.modules[name]
    preferences = bpy.context.preferences
    preferences.view.ui_scale = 1.6
    preferences.view.filebrowser_display_type = "SCREEN"
    with film.ui.override():
        bpy.ops.screen.screen_full_area(use_hide_panels=False)
    film.ui.wait(8)
    film.ui = driver.Ui()
    window, area = film.ui.window, film.ui.area
    area.ui_type = "PREFERENCES"
    preferences.active_section = "EXTENSIONS"
    bpy.context.window_manager.extension_show_panel_installed = False
    film.ui.wait(10, redraw=True)
    film.ui.region = next(region for region in area.regions if region.type == "WINDOW")
    film.ui.wait(10, redraw=True)
    film.at = (film.ui.region.width - 30.0, film.ui.region.height - 30.0)
    film.ui.click(film.at)
    film.ui.wait(10)
    version = ".".join(map(str, bpy.app.version[:2]))
    write_png(film.folder / f"install-{version}-menu.png", film.shot())
    film.ui.key("ESC")
    # The picture shows the folder's name.
    package = Path(os.environ["SEAMWIRE_PACKAGE"])
    downloads = Path(tempfile.gettempdir()) / "Downloads"
    downloads.mkdir()
    copy = shutil.copy(package, downloads)
    film.ui.wait(10, redraw=True)
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=window, area=area, region=region):
        bpy.ops.extensions.package_install_files("INVOKE_DEFAULT", filepath=str(copy))
    film.ui.wait(30)
    area.spaces.active.show_region_toolbar = False  # it lists the volumes of this computer
    film.ui.wait(10, redraw=True)
    write_png(film.folder / f"install-{version}-file.png", film.shot())
    film.ui.key("ESC")
    shutil.rmtree(downloads)
    film.ui.wait(10)
    preferences.active_section = "ADDONS"
    bpy.context.window_manager.addon_search = "Seamwire"
    film.ui.wait(20, redraw=True)
    write_png(film.folder / f"install-{version}-done.png", film.shot())


def looks(film: Film) -> None:
    """Take all that the overlay draws in Blender's themes, shadings and display scales, to be looked at."""
    film.filming = False
    stage(film)
    film.at = film.vertex(0.0, -0.6, 0.80)
    start(film)
    for one, two, held in (
        ((-0.05, -0.9, 0.05), (0.5, -0.7, 0.62), {"shift": True}),
        ((0.1, -0.9, 0.15), (0.45, -0.6, 0.8), {"shift": True, "ctrl": True}),
    ):
        film.go(film.vertex(*one))
        film.ui.event("LEFTMOUSE", "PRESS", film.at, **held)
        film.go(film.vertex(*two), 10, **held)
        film.ui.event("LEFTMOUSE", "RELEASE", film.at, **held)
    film.go(film.vertex(0.0, -0.6, 0.80))
    film.click()
    film.go(film.vertex(0.80, -0.40, 0.40))
    film.click()
    film.go(film.vertex(0.55, -0.40, -0.30))
    film.click()
    film.click("RIGHTMOUSE")
    film.obj.data.use_mirror_x = True
    film.go(film.edge(EYE), alt=True)
    film.take()
    settings().clear = True
    film.go(film.edge(EAR), alt=True)
    film.take()
    settings().clear = False
    film.go(film.vertex(0.55, -0.40, -0.30))
    film.click()
    film.go(film.vertex(0.0, -0.75, -0.08))
    for theme in ("DARK", "LIGHT"):
        show.theme(theme)
        for shading in show.SHADINGS:
            show.shading(film.ui, shading)
            film.ui.wait(4, redraw=True)
            write_png(film.folder / f"looks-{theme}-{shading}.png".lower(), film.shot())
        show.shading(film.ui, "SOLID")
    show.theme("DARK")
    bpy.context.preferences.view.ui_scale = 2.0
    film.ui.wait(8, redraw=True)
    write_png(film.folder / "looks-scale-2.png", film.shot())
    bpy.context.preferences.view.ui_scale = 1.0
    film.click("RIGHTMOUSE")
    film.go(film.edge(EYE), alt=True)
    write_png(film.folder / "looks-loop.png", film.shot())
    film.key("ESC")
