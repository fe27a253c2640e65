# SPDX-License-Identifier: GPL-3.0-or-later
"""Plays a recorded drawing in Blender's window with simulated events. docs/figures/make runs this for Figures 1, 11 and 12.

Arguments after ``--``: a model, its recording, and a folder. recordings/README.md describes recordings.

The folder gets NAME.json, the network of wires, and NAME.npz, the mesh cut along the wires with its islands. `Played` is printed.

The time of a person is an estimate. The keystroke-level model gives seconds for thinking, pointing, buttons and keys (Card, Moran, Newell:
The keystroke-level model for user performance time with interactive systems, CACM 23(7), 1980). The time of the tool is measured.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [
    os.environ["SEAMWIRE_BLENDER_PACKAGES"],
    str(ROOT / "blender_tests"),
    str(Path(__file__).parent),
    str(ROOT / "docs/films"),
]
# Pillow; Blender's own packages come first.
sys.path += map(str, (ROOT / ".venv/lib").glob("python*/site-packages"))

import bpy
import numpy as np
import ui as driver
from enabling import enable_addons
from figure_models import read
from figure_stage import turn
from film_hand import session
from mathutils import Vector
from PIL import Image, ImageDraw
from turns import play_strictly

if TYPE_CHECKING:
    from collections.abc import Sequence

THINK, POINT, BUTTON, KEY = 1.35, 1.1, 0.2, 0.28
"""Seconds of the keystroke-level model: to think, to point, to press and release a button, and to press a key."""
DRAW = 0.9
"""Seconds for each straight piece of a line that is drawn by hand."""


@dataclass
class Played:
    """Measures of a drawing: acts of the hand, and seconds.

    Parameters
    ----------
    presses
        Presses of buttons and keys.
    strokes
        Scribbles among them.
    turns
        Turns of the view.
    hand
        Seconds of the person, by the keystroke-level model.
    tool
        Seconds that the tool took to answer, on the clock.
    """

    presses: int = 0
    strokes: int = 0
    turns: int = 0
    hand: float = 0.0
    tool: float = 0.0


class Player:
    """Draws on a model as a recording says.

    Parameters
    ----------
    model
        The file of the model.
    folder
        Where pictures go.
    """

    def __init__(self, model: Path, folder: Path) -> None:
        self.folder, self.name = folder, model.stem.lower()
        self.played = Played()
        # The display's own pointer stays where it is: out of sight.
        subprocess.run(["xdotool", "mousemove", "5000", "5000"], check=True)
        with driver.Ui().override():
            bpy.ops.screen.screen_full_area(use_hide_panels=True)
        self.ui = driver.Ui()
        self.ui.wait(8)
        self.ui = driver.Ui()
        points, triangles = read(model)
        low, top = points.min(axis=0), points.max(axis=0)
        self.size, self.middle = float((top - low).max()), 0.5 * (low + top)
        self.obj = self._put(points, triangles)
        self.right, self.up = np.eye(3)[:2]
        self.at = (20.0, 20.0)
        self.bare = 0.0

    def _time_of_redraw(self) -> float:
        """Return the seconds that an event takes when the tool has nothing to do: the processor draws Blender's window."""
        seconds, self.at = [], (20.0, 20.0)
        for _ in range(5):
            began = time.perf_counter()
            self.ui.move(self.at)
            seconds.append(time.perf_counter() - began)
        return float(np.median(seconds))

    def _put(self, points: np.ndarray, triangles: np.ndarray) -> bpy.types.Object:
        """Put the model into the scene alone, in Edit Mode, with the tool set to draw across the surface."""
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        mesh = bpy.data.meshes.new(self.name)
        mesh.from_pydata(points.tolist(), [], triangles.tolist())
        mesh.polygons.foreach_set("use_smooth", np.ones(len(triangles), dtype=bool))
        obj = bpy.data.objects.new(self.name, mesh)
        bpy.context.scene.collection.objects.link(obj)
        bpy.context.view_layer.objects.active = obj
        obj.select_set(True)
        space = self.ui.space
        space.overlay.show_floor = space.overlay.show_axis_x = space.overlay.show_axis_y = False
        space.overlay.show_cursor = space.overlay.show_text = space.show_gizmo = False
        space.shading.light, space.shading.studio_light = "MATCAP", "basic_1.exr"
        space.clip_start, space.clip_end = 0.001 * self.size, 100.0 * self.size
        with self.ui.override():
            bpy.ops.object.mode_set(mode="EDIT")
            bpy.ops.mesh.select_all(action="DESELECT")
            bpy.ops.mesh.select_mode(type="VERT")
            bpy.ops.wm.tool_set_by_id(name="seamwire.draw")
        bpy.context.preferences.system.viewport_aa = "OFF"
        # A dense mesh is not black with its edges.
        colors = bpy.context.preferences.themes[0].view_3d
        colors.wire_edit, colors.vertex, colors.vertex_size = (0.55, 0.55, 0.55), (0.55, 0.55, 0.55), 1
        from seamwire.mesh.settings import preferences, settings

        preferences().text = "INFORMATION"
        settings().along, settings().finish, settings().snap = "SURFACE", "SNAP", True
        return obj

    def pixel(self, u: float, v: float) -> tuple[float, float]:
        """Return where a place of the view's plane is on the screen."""
        return self.ui.on_screen(tuple(self.middle + self.size * (u * self.right + v * self.up)))

    def send(self, kind: str, value: str, **modifiers: bool) -> None:
        """Send an event where the pointer is, wait until what is shown is final, and count the time of the tool."""
        began = time.perf_counter()
        self.ui.event(kind, value, self.at, **modifiers)
        self.ui.wait_until(lambda: session() is None or not session().computing, 120.0)
        self.played.tool += max(0.0, time.perf_counter() - began - self.bare)

    def view(self, azimuth: float, elevation: float, zoom: float = 1.0, u: float = 0.0, v: float = 0.0) -> None:
        """Look from another side."""
        rotation = turn(azimuth, elevation).to_quaternion()
        self.right, self.up = (np.array(rotation @ Vector(axis)) for axis in ((1, 0, 0), (0, 1, 0)))
        place = self.middle + self.size * (u * self.right + v * self.up)
        self.ui.look(rotation, tuple(self.middle), self.size)
        # Blender's distance depends on the shape of the window: the model's longest side takes most of the height.
        ends = (np.array(self.pixel(0.0, side)) for side in (-0.5, 0.5))
        seen = float(np.linalg.norm(np.subtract(*ends)))
        self.ui.look(rotation, tuple(place), self.size * seen / (0.86 * zoom * self.ui.region.height))
        self.bare = self._time_of_redraw()
        if self.played.presses:
            self.played.turns += 1
            self.played.hand += THINK + POINT + BUTTON

    def point(self, x: float, y: float, **modifiers: bool) -> None:
        """Move the pointer to a place on the screen."""
        self.at = (x, y)
        self.send("MOUSEMOVE", "NOTHING", **modifiers)

    def press(self, kind: str, button: bool = True, **modifiers: bool) -> None:
        """Press and release a button or a key, after a thought."""
        self.send(kind, "PRESS", **modifiers)
        self.send(kind, "RELEASE", **modifiers)
        self.played.presses += 1
        self.played.hand += THINK + (POINT + BUTTON if button else KEY)

    def click(self, u: float, v: float) -> None:
        """Set a seed, or keep the wire."""
        self.point(*self.pixel(u, v))
        self.press("LEFTMOUSE")

    def drag(self, *places: float) -> None:
        """Move a seed."""
        self._line(places, 1)

    def stroke(self, *places: float) -> None:
        """Draw a scribble through some places."""
        self._line(places, 6, shift=True)
        self.played.strokes += 1

    def _line(self, places: Sequence[float], steps: int, **modifiers: bool) -> None:
        corners = np.reshape(places, (-1, 2))
        self.point(*self.pixel(*corners[0]))
        self.send("LEFTMOUSE", "PRESS", **modifiers)
        for one, two in pairwise(corners):
            for part in np.linspace(0.0, 1.0, steps + 1)[1:]:
                self.point(*self.pixel(*(one + part * (two - one))), **modifiers)
        self.send("LEFTMOUSE", "RELEASE", **modifiers)
        self.played.presses += 1
        self.played.hand += THINK + POINT + BUTTON + DRAW * (len(corners) - 1)

    def loop(self, u: float, v: float) -> None:
        """Take the loop or the closed cut that is shown under the pointer."""
        self.point(*self.pixel(u, v))
        began = time.perf_counter()
        self.ui.event("LEFT_ALT", "PRESS", self.at, alt=True)
        self.ui.wait_until(lambda: session() is not None and session().picture.offered.kind is not None, 120.0)
        self.played.tool += max(0.0, time.perf_counter() - began - self.bare)
        self.press("LEFTMOUSE", alt=True)
        self.send("LEFT_ALT", "RELEASE")
        self.played.hand += KEY

    def candidate(self, u: float, v: float) -> None:
        """Take the next candidate of the wire to a place."""
        self.point(*self.pixel(u, v))
        self.press("W", button=False)

    def close(self) -> None:
        """Close the chain."""
        self._need_chain()
        self.press("C", button=False)

    def end(self) -> None:
        """End the chain."""
        self._need_chain()
        self.press("RIGHTMOUSE")

    @staticmethod
    def _need_chain() -> None:
        """Raise ValueError if the chain has ended before, as on a wire: then the same key or button does something else in Blender."""
        from seamwire.tool.running import chains as running

        if not running:
            raise ValueError("the chain has ended before")

    def look(self, name: str) -> None:
        """Leave a picture with a grid of places."""
        self.ui.wait(2, redraw=True)
        picture = Image.fromarray(driver.display_bytes()[: self.ui.window.height, : self.ui.window.width][::-1])
        draw = ImageDraw.Draw(picture)
        for line in range(-7, 8):
            x, y = self.pixel(0.1 * line, 0.1 * line)
            x, y = x + self.ui.region.x, picture.height - 1 - y - self.ui.region.y
            color = (120, 110, 60) if line % 5 else (150, 60, 60)
            draw.line((x, 0, x, picture.height), color)
            draw.line((0, y, picture.width, y), color)
            draw.text((x + 2, 40), f"{0.1 * line:.1f}", (255, 255, 255))
            draw.text((40, y - 11), f"{0.1 * line:.1f}", (255, 255, 255))
        picture.save(self.folder / f"{self.name}-{name}.png")

    def play(self, recording: Path) -> None:
        """Do all acts of a recording.

        Raises
        ------
        ValueError
            Where a line is no act, with its number.
        """
        acts = {name: getattr(self, name) for name in ACTS}
        for number, line in enumerate(recording.read_text(encoding="utf-8").splitlines(), 1):
            name, *words = line.split("#")[0].split() or [""]
            if not name:
                continue
            if name not in acts:
                raise ValueError(f"{recording.name}, line {number}: {name} is no act; there are: {', '.join(ACTS)}")
            try:
                acts[name](*(words if name == "look" else map(float, words)))
            except (TypeError, ValueError) as error:
                raise ValueError(f"{recording.name}, line {number}: {error}") from error

    def save(self) -> None:
        """Write the network, and the mesh that is cut along it."""
        from seamwire.core.base import native

        with self.ui.override():
            bpy.ops.mesh.seamwire_save_network(filepath=str(self.folder / f"{self.name}.json"))
            bpy.ops.mesh.seamwire_finish(finish="CUT")
            bpy.ops.object.mode_set(mode="OBJECT")
        mesh = self.obj.data
        mesh.calc_loop_triangles()
        points, triangles = np.empty(3 * len(mesh.vertices)), np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
        mesh.vertices.foreach_get("co", points)
        mesh.loop_triangles.foreach_get("vertices", triangles)
        seams = np.array([edge.vertices[:] for edge in mesh.edges if edge.use_seam], dtype=np.int32).reshape(-1, 2)
        points, triangles = points.reshape(-1, 3), triangles.reshape(-1, 3)
        core = native.load()
        islands = core.face_segments(core.Surface(points, triangles), seams)
        np.savez(
            self.folder / f"{self.name}.npz",
            points=points,
            triangles=triangles,
            islands=islands,
        )
        print(f"   {self.name}: {self.played}, {islands.max() + 1} islands", flush=True)


ACTS = ("view", "click", "drag", "candidate", "stroke", "loop", "close", "end", "look")


def main(model: str, recording: str, folder: str) -> None:
    """Play one recording."""
    player = Player(Path(model), Path(folder))
    player.play(Path(recording))
    player.save()


enable_addons()
arguments = sys.argv[sys.argv.index("--") + 1 :]
play_strictly(lambda: main(*arguments))
