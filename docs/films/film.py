# SPDX-License-Identifier: GPL-3.0-or-later
"""Films the tool at work in Blender's window, with simulated events and the display's own pixels; docs/films/make runs this.

``blender ... --python docs/films/film.py -- PART FOLDER`` takes a part that docs/films/make names. It leaves guide-*.png in the folder,
or writes frames to frames.raw there, which may be a pipe.
The simulated mouse has no pointer on the display, so one is drawn into the frames.

Films run in real time. Each frame is one step of a clock: events are sent for its time, and the display is read when the tool has
answered. When the tool's answer took longer than a frame, the film stands still for that time. Drawing Blender's window is not counted,
because the processor draws it here.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [os.environ["SEAMWIRE_BLENDER_PACKAGES"], str(ROOT / "blender_tests"), str(Path(__file__).parent)]

from enabling import enable_addons
from film_figure import character, figure_pictures, limbs
from film_guide import cut, guide, install, lab, looks, stretch, tool, views
from film_hand import Film
from film_head import animation, job
from film_prop import wheel
from film_stage import show_first_steps
from turns import play_strictly

enable_addons()
show_first_steps(False)
kind, target = sys.argv[sys.argv.index("--") + 1 :]
parts = (
    animation,
    job,
    limbs,
    character,
    wheel,
    guide,
    tool,
    lab,
    cut,
    stretch,
    views,
    figure_pictures,
    install,
    looks,
)
part = next(part for part in parts if part.__name__ == kind)
play_strictly(lambda: part(Film(Path(target))))
