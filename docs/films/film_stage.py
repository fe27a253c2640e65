# SPDX-License-Identifier: GPL-3.0-or-later
"""What films and pictures share: the model and the view that they begin with, the tool's settings, and the end in the UV editor."""

from __future__ import annotations

import subprocess
import time
from typing import TYPE_CHECKING

import bpy
import numpy as np
import ui as driver
from film_hand import session
from mathutils import Euler

if TYPE_CHECKING:
    from film_hand import Film

EYE, EAR, FACE = (729, 1606), (1382, 1948), (317, 1146)
"""Edges of Suzanne, subdivided once, with loops around an eye, the hollow of an ear, and the face. Films click a half of such an edge in
the mesh that is subdivided twice."""


def settings() -> bpy.types.PropertyGroup:
    """Return the tool's settings."""
    from seamwire.mesh.settings import settings as of_tool

    return of_tool()


def show_first_steps(shown: bool) -> None:
    """Show the first steps, or not."""
    from seamwire.mesh.settings import preferences

    preferences().text = "STEPS" if shown else "INFORMATION"


def stage(film: Film) -> None:
    """Put Suzanne, subdivided twice, into the window, in edit mode with the tool in the toolbar."""
    # The display's own pointer stays where it is: out of sight.
    subprocess.run(["xdotool", "mousemove", "5000", "5000"], check=True)
    ui = film.ui
    with ui.override():
        bpy.ops.screen.screen_full_area(use_hide_panels=False)
    ui.wait(8)
    film.ui = ui = driver.Ui()
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    bpy.ops.mesh.primitive_monkey_add()
    film.obj = obj = bpy.context.active_object
    for _ in range(2):  # one after the other: so vertices keep their numbers
        modifier = obj.modifiers.new("Subdivision", "SUBSURF")
        bpy.ops.object.modifier_apply(modifier=modifier.name)
    bpy.ops.object.shade_smooth()
    space = ui.space
    space.overlay.show_floor = space.overlay.show_axis_x = space.overlay.show_axis_y = False
    space.overlay.show_cursor = space.overlay.show_text = False
    space.show_gizmo = False
    space.shading.show_cavity = True
    space.shading.cavity_type = "BOTH"
    with ui.override():
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_mode(type="EDGE")
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.wm.tool_set_by_id(name="seamwire.draw")
    ui.view.view_perspective = "PERSP"
    ui.view.view_rotation = Euler((1.24, 0.0, 0.46)).to_quaternion()
    ui.view.view_location = (0.1, 0.0, -0.06)
    ui.view.view_distance = 2.85
    ui.wait(4, redraw=True)


def start(film: Film) -> None:
    """Point at the mesh with the tool, which reads it."""
    film.ui.move(film.at)
    film.ui.wait_until(lambda: session() is not None, 60.0)
    film.settle()
    seconds = []
    for _ in range(7):
        film.ui.area.tag_redraw()
        began = time.perf_counter()
        film.ui.move((20.0, 20.0))
        seconds.append(time.perf_counter() - began)
    film.bare = float(np.median(seconds))
    film.ui.move(film.at)
    film.settle()


def aside(film: Film) -> tuple[float, float]:
    """Return a place beside the mesh where the pointer covers nothing."""
    return film.ui.region.width - 120.0, 0.3 * film.ui.region.height


def drag(film: Film, *places: tuple[float, float]) -> None:
    """Drag what is under the pointer past some places, and let go of it."""
    film.pressed = True
    film.send("LEFTMOUSE", "PRESS")
    for place in places:
        film.go(place, 6)
    film.pressed = False
    film.send("LEFTMOUSE", "RELEASE")
    film.hold(2)


def unwrap(film: Film) -> None:
    """Unwrap along the seams, and look at it in Blender's workspace for that."""
    with film.ui.override():
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.uv.unwrap(method="ANGLE_BASED", margin=0.01)
        bpy.ops.mesh.select_all(action="DESELECT")
    show_map(film)


def show_map(film: Film) -> None:
    """Look at the UV map in Blender's workspace for that."""
    before = film.ui.view
    turn, centre, distance = before.view_rotation.copy(), before.view_location.copy(), before.view_distance
    bpy.context.scene.tool_settings.use_uv_select_sync = True  # all of it is seen, selected or not
    window = film.ui.window
    with film.ui.override():
        bpy.ops.screen.back_to_previous()
    film.ui.wait(6)
    window.workspace = bpy.data.workspaces["UV Editing"]
    film.ui.wait(8)
    film.ui = ui = driver.Ui()
    space = ui.space
    space.overlay.show_floor = space.overlay.show_axis_x = space.overlay.show_axis_y = False
    space.overlay.show_cursor = space.overlay.show_text = space.show_gizmo = False
    space.show_region_toolbar = False
    ui.view.view_perspective = "PERSP"
    ui.view.view_rotation, ui.view.view_location, ui.view.view_distance = turn, centre, 1.2 * distance
    for area in window.screen.areas:
        if area.type == "IMAGE_EDITOR":
            area.spaces.active.show_region_toolbar = False
            region = next(region for region in area.regions if region.type == "WINDOW")
            with bpy.context.temp_override(window=window, area=area, region=region):
                bpy.ops.image.view_all(fit_view=True)
    film.at = (ui.region.width - 60.0, 60.0)
    ui.wait(6, redraw=True)
