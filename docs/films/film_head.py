# SPDX-License-Identifier: GPL-3.0-or-later
"""The films of a head that gets its seams: the README's film, and a whole job with subtitles."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import bpy
import numpy as np
from film_stage import EAR, EYE, drag, settings, stage, start, unwrap
from mathutils import Euler

if TYPE_CHECKING:
    from film_hand import Film


def animation(film: Film) -> None:
    """Play what the README shows."""
    stage(film)
    film.obj.data.use_mirror_x = True
    film.at = film.vertex(0.55, -0.55, 0.9)
    start(film)
    film.say("Click, move, click", 1)
    film.go(film.vertex(0.0, -0.6, 0.80), 5)
    film.click()
    film.go(film.vertex(0.45, -0.60, 0.72), 4)
    film.go(film.vertex(0.80, -0.40, 0.40), 6)
    film.click()
    film.go(film.vertex(0.55, -0.40, -0.30), 7)
    film.click()
    film.go(film.vertex(0.0, -0.75, -0.08), 7)
    film.click()
    film.click("RIGHTMOUSE")
    film.say("Drag a seed")
    film.go(film.vertex(0.55, -0.40, -0.30), 5)
    drag(film, film.vertex(0.62, -0.40, -0.10))
    film.say("Alt-click: a whole loop")
    film.peek(film.edge(EYE), 6)
    film.hold(3)
    film.take()
    film.peek(film.edge(EAR), 7)
    film.hold(2)
    film.take()
    film.peek(film.middle_edge(0.0, -0.45, 0.9), 7)
    film.hold(2)
    film.take()
    film.say("Unwrapped")
    film.go(film.vertex(0.9, -0.4, -0.6), 4)
    unwrap(film)
    film.hold(14)
    film.write()


def job(film: Film) -> None:
    """Play a whole job, from a mesh without seams to its UV map."""
    stage(film)
    film.rate, film.is_subtitle = 2, True
    with film.ui.override():
        bpy.ops.wm.tool_set_by_id(name="builtin.select_box")
    film.at = film.vertex(0.9, -0.4, -0.6)
    film.ui.move(film.at)
    film.say("This head needs a UV map. It has no seams yet.", 40)
    film.say("Ctrl+Alt+W chooses the tool.", 20)
    film.key("W", ctrl=True, alt=True)
    start(film)
    film.hold(16)
    film.obj.data.use_mirror_x = True
    film.say("Mirror X: the other side gets the same seams.", 40)
    film.say("A click begins a wire.")
    film.go(film.vertex(0.0, -0.6, 0.80), 12)
    film.hold(8)
    film.click()
    film.say("Wires follow the cursor along the shape.")
    film.go(film.vertex(0.45, -0.60, 0.72), 10)
    film.go(film.vertex(0.80, -0.40, 0.40), 14)
    film.hold(18)
    film.say("W shows the other candidate. W again goes back.", 10)
    film.key("W")
    film.hold(16)
    film.key("W")
    film.hold(14)
    film.say("A click keeps the wire, and the next one begins there.", 8)
    film.click()
    film.go(film.vertex(0.55, -0.40, -0.30), 16)
    film.hold(4)
    film.click()
    film.go(film.vertex(0.25, -0.65, -0.25), 9)
    film.go(film.vertex(0.0, -0.75, -0.08), 9)
    film.hold(4)
    film.click()
    film.say("A right-click ends the chain. Its wires are seams.", 12)
    film.click("RIGHTMOUSE")
    film.hold(24)
    film.say("A seed can be dragged. Its wires follow.", 6)
    film.go(film.vertex(0.55, -0.40, -0.30), 12)
    film.hold(4)
    drag(film, film.vertex(0.60, -0.40, -0.20), film.vertex(0.62, -0.40, -0.10), film.vertex(0.50, -0.45, -0.22))
    film.hold(14)
    film.say("Alt shows the loop around the eye. A click adds it.", 8)
    film.peek(film.edge(EYE), 14)
    film.hold(18)
    film.take()
    film.hold(10)
    film.say("The hollow of the ear gets a loop as well.", 6)
    film.peek(film.edge(EAR), 14)
    film.hold(16)
    film.take()
    film.hold(10)
    film.say("The last loop is a strip. It divides the head in the middle.", 12)
    film.peek(film.middle_edge(0.0, -0.45, 0.9), 14)
    film.hold(12)
    film.take()
    film.hold(12)
    film.say("Each island has its own color, on the other side too.", 6)
    film.go(film.vertex(0.9, -0.4, -0.6), 10)
    film.hold(14)
    for around in (*np.linspace(0.46, math.pi - 0.5, 30)[1:], None, *np.linspace(math.pi - 0.5, 0.46, 24)[1:]):
        if around is None:
            film.hold(14)
            continue
        film.ui.view.view_rotation = Euler((1.24, 0.0, around)).to_quaternion()
        film.hold(1)
    film.say("Unwrap as usual in Blender.", 20)
    # The view is narrow in this workspace, and its legend lies at the bottom.
    film.is_subtitle = False
    unwrap(film)
    film.hold(44)
    film.say("Heat: how the map stretches areas")
    with film.ui.override():
        bpy.ops.wm.tool_set_by_id(name="seamwire.draw")
    settings().heat = "AREA"
    film.ui.wait(20, redraw=True)
    film.hold(34)
    film.say("Blue: no stretch. Red: a lot.", 34)
    film.say("Done: every island lies flat.", 44)
    film.write()
