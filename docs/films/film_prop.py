# SPDX-License-Identifier: GPL-3.0-or-later
"""The film of a flask whose parts are suggested, turned with the mouse wheel, and changed by clicks."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING

import bpy
from film_stage import aside, show_map, stage, start
from mathutils import Euler, Vector

if TYPE_CHECKING:
    from film_hand import Film

PROFILE = (
    # Radius and height, from the bottom to the top.
    (0.52, -1.0), (0.6, -0.94), (0.6, -0.5), (0.6, 0.0), (0.6, 0.4), (0.52, 0.58), (0.36, 0.66), (0.28, 0.7),
    (0.28, 0.8), (0.4, 0.8), (0.4, 0.9), (0.34, 0.9), (0.34, 1.2), (0.3, 1.24),
)  # fmt: skip
AROUND = 32
FRONT = 0.46 - 0.5 * math.pi
"""The angle of the direction to the viewer."""


def flask() -> bpy.types.Object:
    """Return a flask with a neck, a ring and a cap, in one piece."""
    points = [
        (radius * math.cos(2.0 * math.pi * i / AROUND), radius * math.sin(2.0 * math.pi * i / AROUND), height)
        for radius, height in PROFILE
        for i in range(AROUND)
    ]
    rings = [range(AROUND * row, AROUND * (row + 1)) for row in range(len(PROFILE))]
    faces = [
        (low[i], low[(i + 1) % AROUND], high[(i + 1) % AROUND], high[i])
        for low, high in itertools.pairwise(rings)
        for i in range(AROUND)
    ]
    mesh = bpy.data.meshes.new("Flask")
    mesh.from_pydata(points, [], [*faces, tuple(reversed(rings[0])), tuple(rings[-1])])
    obj = bpy.data.objects.new("Flask", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    return obj


def live() -> object | None:
    """Return the parts that are shown."""
    from seamwire.tool.running import steps as running

    return running[0]._step.hand if running else None


def turn(film: Film, up: bool, notches: int) -> None:
    """Turn the wheel, and tell the number of parts."""
    for _ in range(notches):
        film.send("WHEELUPMOUSE" if up else "WHEELDOWNMOUSE", "PRESS")
        film.caption = f"Wheel: more or fewer parts. {live().title}"
        film.hold(6)


def in_front(film: Film, radius: float, height: float, beside: float = 0.0) -> tuple[float, float]:
    """Return where a place of the flask that faces the viewer is seen."""
    angle = FRONT + beside
    return film.seen(Vector((radius * math.cos(angle), radius * math.sin(angle), height)))


def wheel(film: Film) -> None:
    """Play how parts are suggested, turned, clicked and kept."""
    stage(film)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.object.delete()
    film.obj = flask()
    ui = film.ui
    with ui.override():
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="DESELECT")
    ui.view.view_rotation = Euler((1.05, 0.0, 0.46)).to_quaternion()
    ui.view.view_location, ui.view.view_distance = (0.0, 0.0, 0.22), 3.8
    ui.wait(4, redraw=True)
    film.at = aside(film)
    start(film)
    film.say("Suggest Seamwires", 6)
    with ui.override():
        bpy.ops.mesh.seamwire_suggest("INVOKE_DEFAULT")
    ui.wait_until(lambda: live() is not None)
    film.say(f"Suggest Seamwires. {live().title}", 8)
    film.go(in_front(film, 0.6, 0.1, 0.5), 6)
    turn(film, True, 2)
    turn(film, False, 3)
    turn(film, True, 1)
    film.go(in_front(film, 0.4, 0.9), 7)
    film.say("Click on a border: drop it, or keep it again", 4)
    film.click()
    film.hold(6)
    film.click()
    film.hold(4)
    film.go(aside(film), 6)
    ui.wait_until(lambda: all(suggestion.layout is not None for suggestion in live()._search), 60.0)
    film.say("Slits follow when the hand rests. The checker shows the map", 14)
    film.say("Enter keeps the parts, and unwraps them")
    film.ui.key("RET")
    ui.wait_until(lambda: live() is None, 60.0)
    film.hold(6)
    show_map(film)
    film.hold(16)
    film.write()
