# SPDX-License-Identifier: GPL-3.0-or-later
"""The films and the picture of a figure with head, arms and legs."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import bpy
import numpy as np
from film_hand import offered
from film_stage import settings, stage, start
from mathutils import Euler, Vector

if TYPE_CHECKING:
    from film_hand import Film

BONES = (
    # A joint, its radius, and the joint that it is connected to. Only the right limbs are listed.
    ((0.0, 0.0, 0.0), 0.26, None),
    ((0.0, 0.0, 0.55), 0.3, 0),
    ((0.0, 0.0, 0.85), 0.11, 1),
    ((0.0, -0.02, 1.1), 0.2, 2),
    ((0.0, -0.02, 1.3), 0.17, 3),
    ((0.34, 0.0, 0.62), 0.12, 1),
    ((0.72, 0.0, 0.36), 0.085, 5),
    ((1.05, -0.08, 0.12), 0.06, 6),
    ((1.2, -0.12, 0.02), 0.085, 7),
    ((0.17, 0.0, -0.25), 0.17, 0),
    ((0.25, -0.03, -0.75), 0.11, 9),
    ((0.28, 0.0, -1.2), 0.075, 10),
    ((0.3, -0.16, -1.3), 0.085, 11),
)


def figure() -> bpy.types.Object:
    """Return a figure with head, arms and legs, remeshed, so that no edges lead around its limbs."""
    places, radii, edges, numbers = [], [], [], {}
    for side in (1.0, -1.0):
        for i, ((x, y, z), radius, on) in enumerate(BONES):
            if side < 0 and x == 0.0:
                continue
            numbers[i, side] = len(places)
            places.append((side * x, y, z))
            radii.append(radius)
            if on is not None:
                edges.append((numbers.get((on, side), numbers.get((on, 1.0))), numbers[i, side]))
    mesh = bpy.data.meshes.new("Figure")
    mesh.from_pydata(places, edges, [])
    obj = bpy.data.objects.new("Figure", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    bpy.ops.object.modifier_add(type="SKIN")
    for vertex, radius in zip(mesh.skin_vertices[0].data, radii, strict=True):
        vertex.radius = (radius, radius)
    mesh.skin_vertices[0].data[0].use_root = True
    obj.modifiers.new("Subdivision", "SUBSURF").levels = 3
    remesh = obj.modifiers.new("Remesh", "REMESH")
    remesh.mode, remesh.voxel_size = "VOXEL", 0.035
    smooth = obj.modifiers.new("Smooth", "SMOOTH")
    smooth.factor, smooth.iterations = 0.5, 4
    for modifier in list(obj.modifiers):
        bpy.ops.object.modifier_apply(modifier=modifier.name)
    bpy.ops.object.shade_smooth()
    return obj


def limbs(film: Film) -> None:
    """Play how a figure is cut into head, arms, legs and body, with a press for each, and how a cut is bent."""
    stage(film)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.object.delete()
    film.obj = figure()
    with film.ui.override():
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="DESELECT")
    settings().along, settings().finish = "SURFACE", "SNAP"
    film.ui.view.view_rotation = Euler((1.4, 0.0, 0.12)).to_quaternion()
    film.ui.view.view_location = (0.0, 0.0, 0.2)
    film.ui.view.view_distance = 4.0
    film.ui.wait(4, redraw=True)
    film.at = film.vertex(0.6, -0.2, 1.0)
    start(film)
    presses = 0
    film.say("Alt: the closed cut that the shape suggests", 6)
    for place in (
        (0.0, -0.12, 0.86),
        (0.36, -0.12, 0.6),
        (-0.36, -0.12, 0.6),
        (0.19, -0.15, -0.3),
        (-0.19, -0.15, -0.3),
    ):
        film.peek(film.vertex(*place), 9)
        film.hold(5)
        presses += 1
        film.caption = f"Presses: {presses}"
        film.take()
    film.say("Shift+Alt: the cut bends to another point")
    film.go(film.vertex(-0.33, -0.1, -0.18), 6)
    for key, held in (("LEFT_SHIFT", {"shift": True}), ("LEFT_ALT", {"shift": True, "alt": True})):
        film.ui.event(key, "PRESS", film.at, **held)
    film.ui.wait_until(lambda: offered() is not None)
    film.settle()
    film.hold(4)
    for place in ((-0.33, -0.1, -0.14), (-0.33, -0.1, -0.1)):
        film.go(film.vertex(*place), 5, shift=True, alt=True)
    film.hold(5)
    presses += 1
    film.caption = f"Presses: {presses}"
    film.click(shift=True, alt=True)
    film.ui.event("LEFT_ALT", "RELEASE", film.at, shift=True)
    film.ui.event("LEFT_SHIFT", "RELEASE", film.at)
    film.settle()
    film.go((film.ui.region.width - 60.0, 60.0), 6)
    film.say(f"Six islands, {presses} presses", 22)
    film.write()


BEHIND, BEFORE = math.pi - 0.45, 0.45
"""How far around the view is turned to see a figure from its back, from its front, and its left side both times."""
CUTS = ((0.0, 0.13, 0.88), (0.37, 0.13, 0.61), (0.19, 0.16, -0.3))
"""Where its closed cuts are taken: the neck, an arm, a leg."""
LINES = (
    # Where a line from its free end, or from one cut, comes to a cut: head, arm, leg, side, shoulder.
    ((0.0, 0.16, 1.14), (0.0, 0.13, 0.88)),
    ((1.22, 0.02, 0.02), (0.37, 0.13, 0.61)),
    ((0.3, 0.1, -1.3), (0.19, 0.16, -0.3)),
    ((0.3, 0.08, -0.16), (0.38, 0.08, 0.5)),
    ((0.36, 0.08, 0.7), (0.1, 0.05, 0.88)),
)
ON_CUTS = tuple(line[0] for line in LINES[3:])
"""Where they do not begin at a free end."""
ARM_BEGINS = (0.366, 0.035, 0.715)
"""Just above the edge that Blender's ring around the arm begins with, as seen from the front. A click there closes the ring."""
STEPS = (
    # What Blender's own hand does: from which side, where, and whether a path begins there.
    (BEFORE, (0.0, -0.13, 0.88), True),
    (BEHIND, (0.0, 0.13, 0.88), False),
    (BEHIND, (0.377, 0.013, 0.705), True),
    (BEHIND, (0.39, 0.08, 0.5), False),
    (BEFORE, (0.37, -0.12, 0.6), False),
    (BEFORE, ARM_BEGINS, False),
    (BEFORE, (0.299, 0.018, -0.105), True),
    (BEFORE, (0.02, -0.14, -0.3), False),
    (BEHIND, (0.02, 0.14, -0.3), False),
    (BEHIND, (0.299, 0.018, -0.105), False),
    *((BEHIND, place, place is line[0]) for line in LINES for place in line),
)


def show_figure(film: Film) -> None:
    """Put the figure in place of the mesh, in Edit Mode, symmetric and with its mirror on."""
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.object.delete()
    film.obj = figure()
    with film.ui.override():
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.symmetrize(direction="POSITIVE_X")
        bpy.ops.mesh.select_all(action="DESELECT")
    film.obj.data.use_mirror_x = True


def figure_pictures(film: Film) -> None:
    """Take the preview of a mirrored wire on a figure."""
    film.filming = False
    stage(film)
    show_figure(film)
    settings().along, settings().finish = "SURFACE", "SNAP"
    film.ui.view.view_rotation = Euler((1.45, 0.0, 0.12)).to_quaternion()
    film.ui.view.view_location = (0.0, 0.0, 0.4)
    film.ui.view.view_distance = 2.9
    film.ui.wait(4, redraw=True)
    film.at = film.vertex(0.12, -0.3, -0.2)
    start(film)
    film.click()
    film.go(film.vertex(0.34, -0.1, 0.48))
    film.picture("mirror")


def character(film: Film) -> None:
    """Play how a figure gets its seams from nothing: on the left with the tool, on the right with Blender's own."""
    stage(film)
    sides = []
    seams: set[tuple[int, int]] = set()
    for draw, around in ((draw_with_seamwire, BEHIND), (draw_with_blender, STEPS[0][0])):
        show_figure(film)
        film.ui.view.view_rotation = Euler((1.4, 0.0, around)).to_quaternion()
        film.ui.view.view_location = (0.0, 0.0, 0.16)
        film.ui.view.view_distance = 4.0
        film.ui.wait(4, redraw=True)
        film.at = film.vertex(0.0, 0.0, 1.9)
        film.frames = []
        draw(film, seams)
        seams = film.seams()
        assert film.islands() == 6, f"{film.islands()} islands, not head, arms, legs and body"
        sides.append(film.frames)
    longest, middle = max(map(len, sides)), film.ui.region.x + film.ui.region.width // 2
    film.frames = []
    for frame in range(longest):
        pair = (side[min(frame, len(side) - 1)][:, middle - 300 : middle + 300] for side in sides)
        film.frames.append(np.concatenate(tuple(pair), axis=1))
    film.write()


def draw_with_seamwire(film: Film, _: object) -> None:
    """Draw the figure's seams with the tool."""
    settings().along, settings().finish = "SURFACE", "SNAP"
    start(film)
    count = Presses(film, "Seamwire")
    for place in CUTS:
        film.peek(film.vertex(*place), 9)
        film.hold(3)
        count.add()
        film.take()
    for line in LINES:
        for place in line:
            film.go(film.seam(*place) if place is line[1] or place in ON_CUTS else film.vertex(*place), 9)
            count.add()
            film.click()
    film.go((film.ui.region.width / 2.0 + 240.0, 60.0), 6)
    count.done("six islands")
    film.ui.wait(5)


def draw_with_blender(film: Film, seams: set[tuple[int, int]]) -> None:
    """Draw seams in the places of others: shortest paths in edge mode on one side, the others by *Select Mirror*."""
    with film.ui.override():
        bpy.ops.wm.tool_set_by_id(name="builtin.select")
    points = [vertex.co for vertex in film.obj.data.vertices]
    drawn_before = [(points[a] + points[b]) / 2 for a, b in seams]
    count = Presses(film, "Blender")
    side = STEPS[0][0]
    for around, place, begins in STEPS:
        if around != side:
            count.turn(around)
        side, near = around, Vector(place)
        # To begin at an edge that is selected would take it away: the one beside it is clicked.
        middles = film.beside_selected() if begins and place in ON_CUTS else drawn_before
        film.go(film.seen(near if place is ARM_BEGINS else min(middles, key=lambda co: (co - near).length)), 9)
        count.add()
        film.click(**({"shift": True} if begins else {"ctrl": True}))
    with film.ui.override():
        bpy.ops.mesh.select_mirror(extend=True)
        film.say("Select Mirror, Mark Seam", 12)
        bpy.ops.mesh.mark_seam()
        bpy.ops.mesh.select_all(action="DESELECT")
    count.done("six islands")


class Presses:
    """Tells in a film how many presses of the button it took so far, and how often the view was turned."""

    def __init__(self, film: Film, tool: str) -> None:
        self._film, self._tool = film, tool
        self._presses = self._turns = 0
        self._say("")

    def _say(self, more: str) -> None:
        turns = f", {self._turns} {'turn' if self._turns == 1 else 'turns'} of the view" if self._turns else ""
        self._film.caption = (
            f"{self._tool}: {self._presses} {'press' if self._presses == 1 else 'presses'}{turns}{more}"
        )

    def add(self) -> None:
        """Count one more."""
        self._presses += 1
        self._say("")

    def turn(self, around: float) -> None:
        """Turn the view to see the other side."""
        self._turns += 1
        self._say("")
        view = self._film.ui.view
        before = view.view_rotation.to_euler().z
        for part in np.linspace(0.0, 1.0, 9)[1:]:
            view.view_rotation = Euler((1.4, 0.0, before + part * (around - before))).to_quaternion()
            self._film.ui.wait(1, redraw=True)
            self._film.hold(1)

    def done(self, what: str) -> None:
        """Tell that all is drawn."""
        self._say(f": {what}")
        self._film.hold(12)
