# SPDX-License-Identifier: GPL-3.0-or-later
"""Films the tool at work in Blender's window, with simulated events and the display's own pixels; scripts/animation runs this.

``blender ... --python scripts/lib/film.py -- PART FOLDER`` takes a part that scripts/animation names. It leaves guide-*.png in the folder,
or writes frames to frames.raw there, which may be a pipe.
The simulated mouse has no pointer on the display, so one is drawn into the frames.

Films run in real time. Each frame is one step of a clock: events are sent for its time, and the display is read when the tool has
answered. When the tool's answer took longer than a frame, the film stands still for that time. Drawing Blender's window is not counted,
because the processor draws it here.
"""

import math
import os
import struct
import subprocess
import sys
import time
import zlib
from functools import partial
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [os.environ["SEAMWIRE_BLENDER_PACKAGES"], str(ROOT / "blender_tests")]

import bpy
import numpy as np
import show
import ui as driver
from enabling import enable_addon
from mathutils import Euler, Vector
from numpy.typing import NDArray
from turns import play_strictly

POINTER = np.array([(0, 0), (0, -17), (4, -13.5), (7, -20), (9.7, -18.8), (6.8, -12.6), (12, -12.3)])
"""The outline of a mouse pointer: pixels to the right of its tip and above it."""
PRESSED = (1.0, 0.8, 0.2)

EYE, EAR = (729, 1606), (317, 1146)
"""Edges of Suzanne, subdivided once, with loops around an eye and an ear; halves of them are in her subdivided twice."""
BAND = (0.05, 0.05, 0.06, 0.78)
WORDS = (1.0, 1.0, 1.0, 1.0)


class Film:
    """A hand that moves as people do, and a camera on the display. A time of 1 is a frame of a GIF, 80 ms."""

    STEP = 0.08

    def __init__(self, folder: Path) -> None:
        self.ui = driver.Ui()
        # Pictures have more pixels than films, and not smaller letters.
        bpy.context.preferences.view.ui_scale = max(1.0, self.ui.window.width / 1280.0)
        self.folder = folder
        self.rate = 1
        """How many frames a step has."""
        self.bare = 0.0
        """The seconds that an event takes when the tool has nothing to do: Blender's own time."""
        self.frames: list[NDArray[np.uint8]] = []
        self.late: list[int] = []
        """For how many frames the film stood still each time the tool was late."""
        self.at = (200.0, 120.0)
        self.pressed = False
        self.filming = True
        self.obj: bpy.types.Object | None = None
        self.caption = ""
        self.is_subtitle = False
        bpy.types.SpaceView3D.draw_handler_add(self._draw_caption, (), "WINDOW", "POST_PIXEL")

    def _draw_caption(self) -> None:
        """Write what is being done, under the headers or as a subtitle."""
        if not self.caption:
            return
        from seamwire.view import gpu_draw as paint
        from seamwire.view import overlay

        left, bottom, width, height = overlay.free_room(bpy.context.area, bpy.context.region)
        size = paint.text_size(1.0, 1.9)
        paint.set_text(size)
        wide = paint.text_width(self.caption)
        x, y = left + (width - wide) / 2.0, bottom + (1.6 * size if self.is_subtitle else height - 2.6 * size)
        with paint.blended("NONE"):
            paint.draw_rectangle((x - size, y - 0.65 * size), (x + wide + size, y + 1.25 * size), BAND, 0.5 * size)
            paint.draw_text(self.caption, (x, y), WORDS, shadow=False)

    def say(self, caption: str, steps: int = 0) -> None:
        """Write something else, and let it be read."""
        self.caption = caption
        self.hold(steps)

    def shot(self) -> NDArray[np.uint8]:
        """Return the display as it is, with the pointer: (height, width, 3), top row first."""
        self.ui.wait(2, redraw=True)
        window = self.ui.window
        picture = driver.display_bytes()[: window.height, : window.width].copy()
        x, y = self.at
        draw_pointer(picture, (self.ui.region.x + x, self.ui.region.y + y), self.pressed)
        return picture[::-1]

    def hold(self, steps: int) -> None:
        """Let the picture stand."""
        self._film(steps * self.rate)

    def _film(self, frames: int) -> None:
        if self.filming and frames:
            self.frames += [self.shot()] * frames

    def go(self, to: tuple[float, float], steps: int = 10, **modifiers: bool) -> None:
        """Move the pointer, slowly at both ends."""
        start, frames = self.at, steps * self.rate
        for i in range(1, frames + 1) if self.filming else [1]:
            share = i / frames if self.filming else 1.0
            share = share * share * (3.0 - 2.0 * share)
            self.at = (start[0] + share * (to[0] - start[0]), start[1] + share * (to[1] - start[1]))
            began = time.perf_counter()
            self.ui.move(self.at, **modifiers)
            self.settle(began)
            self._film(1)

    def settle(self, began: float | None = None) -> None:
        """Wait until what is shown is final. If the film shows the time since it began, stand still for it."""
        began = began or time.perf_counter()
        if session() is not None:
            self.ui.wait_until(lambda: session() is None or not session().computing, 60.0)
        late = int((time.perf_counter() - began - self.bare) / self.STEP * self.rate)
        if self.filming and self.frames and late > 0:
            self.late.append(late)
            self.frames += [self.frames[-1]] * late

    def send(self, kind: str, value: str, **modifiers: bool) -> None:
        """Send an event where the pointer is, and let the tool answer."""
        began = time.perf_counter()
        self.ui.event(kind, value, self.at, **modifiers)
        self.settle(began)

    def click(self, button: str = "LEFTMOUSE", **modifiers: bool) -> None:
        """Press and release a button where the pointer is."""
        self.pressed = True
        self.send(button, "PRESS", **modifiers)
        self.hold(1)
        self.pressed = False
        self.send(button, "RELEASE", **modifiers)
        self.hold(2)

    def peek(self, to: tuple[float, float], steps: int = 10) -> None:
        """Point at an edge and hold Alt, which shows the loop that a click takes."""
        self.go(to, steps)
        began = time.perf_counter()
        self.ui.event("LEFT_ALT", "PRESS", self.at, alt=True)
        self.ui.wait_until(lambda: offered() is not None)
        self.settle(began)

    def take(self) -> None:
        """Take the loop that is shown, and let go of Alt."""
        self.click(alt=True)
        self.send("LEFT_ALT", "RELEASE")

    def key(self, name: str, **modifiers: bool) -> None:
        """Press a key."""
        began = time.perf_counter()
        self.ui.key(name, **modifiers)
        self.settle(began)
        self.hold(2)

    def seen(self, point: Vector) -> tuple[float, float]:
        """Return where a point of the object is seen."""
        return self.ui.on_screen(tuple(self.obj.matrix_world @ point))

    def vertex(self, *near: float) -> tuple[float, float]:
        """Return where the vertex nearest to a place is seen."""
        place = Vector(near)
        return self.seen(min((v.co for v in self.obj.data.vertices), key=lambda co: (co - place).length))

    def edge(self, pair: tuple[int, int]) -> tuple[float, float]:
        """Return where one of the halves that subdivision makes of an edge is seen, at its middle."""
        one, two = (self.obj.data.vertices[v].co for v in pair)
        half = min(
            (v.co for v in self.obj.data.vertices if v.index not in pair), key=lambda co: (co - (one + two) / 2).length
        )
        return self.seen((one + half) / 2)

    def middle_edge(self, *near: float) -> tuple[float, float]:
        """Return where the edge on the plane of symmetry that is nearest to a place is seen."""
        vertices = self.obj.data.vertices
        edges = [[vertices[v].co for v in edge.vertices] for edge in self.obj.data.edges]
        middles = [(one + two) / 2 for one, two in edges if abs(one.x) + abs(two.x) < 1e-4]
        return self.seen(min(middles, key=lambda co: (co - Vector(near)).length))

    def seams(self) -> set[tuple[int, int]]:
        """Return the edges that are seams, by their vertices."""
        self.obj.update_from_editmode()
        return {tuple(edge.vertices) for edge in self.obj.data.edges if edge.use_seam}

    def islands(self) -> int:
        """Return into how many islands seams part the mesh."""
        from seamwire.core.base.native import load

        core, seams = load(), np.array(sorted(self.seams()))
        mesh = self.obj.data  # as it is now: the seams were read from it
        mesh.calc_loop_triangles()
        triangles = np.array([triangle.vertices for triangle in mesh.loop_triangles])
        surface = core.Surface(np.array([vertex.co for vertex in mesh.vertices]), triangles)
        return int(core.face_segments(surface, seams).max()) + 1

    def beside_selected(self) -> list[Vector]:
        """Return the middles of edges that lead away from those that are selected."""
        self.obj.update_from_editmode()
        mesh = self.obj.data
        taken = {vertex for edge in mesh.edges if edge.select for vertex in edge.vertices}
        beside = (edge.vertices for edge in mesh.edges if len(taken.intersection(edge.vertices)) == 1)
        return [(mesh.vertices[a].co + mesh.vertices[b].co) / 2 for a, b in beside]

    def seam(self, *near: float) -> tuple[float, float]:
        """Return where the vertex of a seam that is nearest to a place is seen."""
        points, place = self.obj.data.vertices, Vector(near)
        vertices = {vertex for edge in self.seams() for vertex in edge}
        return self.seen(min((points[v].co for v in vertices), key=lambda co: (co - place).length))

    def write(self) -> None:
        """Keep the film: its frames one after the other, three bytes a pixel."""
        late = sum(self.late) / self.rate * self.STEP
        print(
            f"{len(self.frames) / self.rate * self.STEP:.1f} s, of which the tool was late for {late:.1f} s", flush=True
        )
        with (self.folder / "frames.raw").open("wb") as file:
            for frame in self.frames:
                file.write(np.ascontiguousarray(frame[:, :, :3]).tobytes())

    def picture(self, name: str) -> None:
        """Keep the window as a picture of the guide."""
        write_png(self.folder / f"guide-{name}.png", self.shot())


def settings() -> bpy.types.PropertyGroup:
    """Return the tool's settings."""
    from seamwire.mesh.settings import settings as of_tool

    return of_tool()


def show_card(shown: bool) -> None:
    """Show the card of first steps, or not."""
    from seamwire.mesh.settings import preferences

    preferences().show_card = shown


def session() -> object | None:
    """Return the session of the chain that is drawn, or of what is pointed at."""
    from seamwire.operators.report import running
    from seamwire.view.edited_objects import edited

    if running:
        return running[0].session
    return edited.front.session if edited.front is not None else None


def offered() -> str | None:
    """Return the kind of the loop that a click would add, if one is shown."""
    return session().picture.offered.kind


def draw_pointer(picture: NDArray[np.uint8], tip: tuple[float, float], pressed: bool) -> None:
    """Draw a pointer, white with a dark rim, yellow while a button is down; the picture has its bottom row first."""
    x0, y0 = int(tip[0]) - 4, int(tip[1]) - 25
    height, width = picture.shape[:2]
    rows, columns = np.mgrid[max(y0, 0) : min(y0 + 32, height), max(x0, 0) : min(x0 + 24, width)]
    inside, near = np.zeros(rows.shape), np.full(rows.shape, np.inf)
    for dx, dy in ((0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)):
        x, y = columns + dx - tip[0], rows + dy - tip[1]
        odd = np.zeros(rows.shape, dtype=bool)
        for (ax, ay), (bx, by) in zip(POINTER, np.roll(POINTER, -1, axis=0), strict=True):
            crosses = (ay > y) != (by > y)
            odd ^= crosses & (x < (bx - ax) * (y - ay) / (by - ay if by != ay else 1.0) + ax)
            along = np.array([bx - ax, by - ay])
            part = np.clip(((x - ax) * along[0] + (y - ay) * along[1]) / (along @ along), 0.0, 1.0)
            near = np.minimum(near, np.hypot(x - ax - part * along[0], y - ay - part * along[1]))
        inside += 0.25 * odd
    rim = np.clip(1.8 - near, 0.0, 1.0)[..., None]
    part = picture[rows, columns] / 255.0
    part = part * (1.0 - rim) + rim * 0.05
    part = part * (1.0 - inside[..., None]) + inside[..., None] * (PRESSED if pressed else (1.0, 1.0, 1.0))
    picture[rows, columns] = (part * 255.0).astype(np.uint8)


def write_png(path: Path, picture: NDArray[np.uint8]) -> None:
    """Write a picture, (height, width, 3), top row first."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    height, width = picture.shape[:2]
    rows = np.concatenate([np.zeros((height, 1), dtype=np.uint8), picture.reshape(height, -1)], axis=1)
    header = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
    body = chunk(b"IDAT", zlib.compress(rows.tobytes(), 9))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + header + body + chunk(b"IEND", b""))


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


def aside(film: Film) -> tuple[float, float]:
    """Return a place beside the mesh where the pointer covers nothing."""
    return film.ui.region.width - 120.0, 0.6 * film.ui.region.height


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
    before = film.ui.view
    turn, centre, distance = before.view_rotation.copy(), before.view_location.copy(), before.view_distance
    with film.ui.override():
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.uv.unwrap(method="ANGLE_BASED", margin=0.01)
        bpy.ops.mesh.select_all(action="DESELECT")
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


def job(film: Film) -> None:
    """Play a whole job, from a mesh without seams to its UV map."""
    stage(film)
    film.rate, film.is_subtitle = 2, True
    with film.ui.override():
        bpy.ops.wm.tool_set_by_id(name="builtin.select_box")
    film.at = film.vertex(0.9, -0.4, -0.6)
    film.ui.move(film.at)
    film.say("This head needs a UV map. It has no seams yet.", 30)
    film.say("Ctrl Alt W takes the tool.")
    film.hold(12)
    film.key("W", ctrl=True, alt=True)
    start(film)
    film.hold(16)
    film.say("Mirror X: the other side gets the same seams.")
    film.obj.data.use_mirror_x = True
    film.hold(24)
    film.say("A click begins a wire.")
    film.go(film.vertex(0.0, -0.6, 0.80), 12)
    film.hold(5)
    film.click()
    film.say("Wires follow the cursor along the shape.")
    film.go(film.vertex(0.45, -0.60, 0.72), 10)
    film.go(film.vertex(0.80, -0.40, 0.40), 14)
    film.hold(8)
    film.say("W takes the other wire, and the first one again.")
    film.key("W")
    film.hold(14)
    film.key("W")
    film.hold(12)
    film.say("A click keeps the wire, and the next one begins there.")
    film.click()
    film.go(film.vertex(0.55, -0.40, -0.30), 16)
    film.hold(4)
    film.click()
    film.go(film.vertex(0.25, -0.65, -0.25), 9)
    film.go(film.vertex(0.0, -0.75, -0.08), 9)
    film.hold(4)
    film.click()
    film.say("A right click ends the chain. Its wires are seams.")
    film.click("RIGHTMOUSE")
    film.hold(20)
    film.say("A seed can be dragged. Its wires follow.")
    film.go(film.vertex(0.55, -0.40, -0.30), 12)
    film.hold(4)
    drag(film, film.vertex(0.60, -0.40, -0.20), film.vertex(0.62, -0.40, -0.10), film.vertex(0.50, -0.45, -0.22))
    film.hold(14)
    film.say("Alt shows the loop around the eye. A click takes it.")
    film.peek(film.edge(EYE), 14)
    film.hold(16)
    film.take()
    film.hold(6)
    film.say("The ear gets one as well.")
    film.peek(film.edge(EAR), 14)
    film.hold(12)
    film.take()
    film.hold(6)
    film.say("The last loop opens the head in the middle. The wheel makes it longer.")
    film.peek(film.middle_edge(0.0, -0.45, 0.9), 14)
    film.hold(12)
    while offered() != "WHOLE":
        film.ui.wheel(up=True, alt=True)
        film.settle()
        film.hold(9)
    film.take()
    film.say("Every island has its own color. We look at the other side.")
    film.go(film.vertex(0.9, -0.4, -0.6), 10)
    film.hold(10)
    for around in (*np.linspace(0.46, math.pi - 0.5, 30)[1:], None, *np.linspace(math.pi - 0.5, 0.46, 24)[1:]):
        if around is None:
            film.hold(14)
            continue
        film.ui.view.view_rotation = Euler((1.24, 0.0, around)).to_quaternion()
        film.hold(1)
    film.say("Unwrap, as always in Blender.")
    film.hold(16)
    unwrap(film)
    film.hold(30)
    film.say("The view shows how much the map stretches: red is twice the mean.")
    with film.ui.override():
        bpy.ops.wm.tool_set_by_id(name="seamwire.draw")
    settings().heat = "AREA"
    film.ui.wait(20, redraw=True)
    film.hold(50)
    film.say("Done: 12 presses, and every island lies flat.", 36)
    film.write()


def guide(film: Film) -> None:
    """Take what the guide shows, one picture after the other."""
    film.filming = False
    stage(film)
    film.at = film.vertex(0.0, -0.6, 0.80)
    start(film)
    film.click()
    film.go(film.vertex(0.80, -0.40, 0.40))
    film.picture("wires")
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
    film.ui.wait_until(lambda: session().moved and not session().computing)
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
    film.key("F1")
    film.click("RIGHTMOUSE")
    unwrap(film)
    film.picture("unwrapped")


def tool(film: Film) -> None:
    """Take the tool before the first click, with its menu and its views open, and in a chain. The names have Blender's version."""
    version = ".".join(map(str, bpy.app.version[:2]))
    film.filming = False
    stage(film)
    film.at = film.vertex(0.0, -0.6, 0.80)
    show_card(True)
    for _ in range(20):  # the tool is at the end of the toolbar
        film.ui.wheel(up=False, at=(30.0, 300.0))
    film.ui.space.show_gizmo = True
    start(film)
    film.ui.wait(20, redraw=True)
    film.picture(f"tool-{version}-card")
    film.ui.space.show_gizmo = False
    show_card(False)
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
    film.filming = False
    stage(film)
    bpy.ops.object.mode_set(mode="OBJECT")
    modifier = film.obj.modifiers.new("Scan", "DECIMATE")
    modifier.ratio = 0.25
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    bpy.ops.object.shade_flat()
    bpy.ops.object.mode_set(mode="EDIT")
    vertices = film.obj.data.vertices
    places = (
        Vector(place) for place in ((-0.55, -0.45, -0.3), (0.0, -0.75, 0.1), (0.6, -0.55, -0.25), (0.3, -0.6, -0.75))
    )
    seeds = [min(vertices, key=lambda v: (v.co - place).length).index for place in places]
    film.ui.view.view_rotation = Euler((1.24, 0.0, 0.2)).to_quaternion()
    film.ui.view.view_distance = 2.2
    with film.ui.override():
        bpy.ops.mesh.seamwire_mark(chains=" ".join(map(str, seeds)), along="SURFACE")
    film.at = aside(film)
    film.ui.move(film.at)
    for name, what in (("snapped", None), ("cut", partial(bpy.ops.mesh.seamwire_finish, finish="CUT"))):
        if what is not None:
            with film.ui.override():
                what()
        film.ui.wait(20, redraw=True)
        film.picture(name)


def stretch(film: Film) -> None:
    """Take the stretch of a UV map before and after a cut, with the islands unwrapped that it changed."""
    film.filming = False
    stage(film)
    settings().heat, settings().unwrap = "AREA", True
    film.obj.data.use_mirror_x = True
    start(film)
    for edges, name in (((film.edge(EYE), film.middle_edge(0.0, -0.45, 0.9)), "before"), ((film.edge(EAR),), "after")):
        for edge in edges:
            film.peek(edge)
            film.take()
        film.click("RIGHTMOUSE")
        film.go(aside(film))
        film.ui.wait(30, redraw=True)
        film.picture(f"stretch-{name}")


def views(film: Film) -> None:
    """Take each view of the metric in object mode, six in one picture. Take wires behind the surface in one of them."""
    from seamwire.view.object_mode import object_mode

    film.filming = False
    stage(film)
    bpy.ops.object.mode_set(mode="OBJECT")
    film.obj.modifiers.new("Subdivision", "SUBSURF").levels = 2
    film.obj.select_set(False)
    place = Vector((0.0, -0.6, 0.80))
    min(film.obj.data.vertices, key=lambda vertex: (vertex.co - place).length).select = True
    settings().along, settings().views_in_object_mode = "SURFACE", True
    shots = []
    for shown in (
        {"heat": "STRENGTH"},
        {"heat": "DISTANCE", "show_bands": True},
        {"show_ellipses": True},
        {"show_paths": True},
        {"show_invalid": True},
        {"heat": "CONCAVITY", "show_crests": True},
    ):
        for name, value in shown.items():
            setattr(settings(), name, value)
        film.ui.wait(3, redraw=True)  # all of them are asked for by then
        film.ui.wait_until(lambda: object_mode.views is not None and object_mode.views.is_complete, 60.0)
        film.at = (30.0, 30.0)  # the pointer lies beside what is taken
        picture = film.shot()[:, :, :3]
        region = film.ui.region
        top = film.ui.window.height - region.y - region.height
        right = region.x + region.width
        # The right part, where the legend is, at half the size.
        part = picture[top + 75 : top + 75 + 800, right - 1068 : right]
        shots.append(part.reshape(400, 2, 534, 2, 3).mean(axis=(1, 3)).astype(np.uint8))
        for name in shown:
            settings().property_unset(name)
    whole = np.concatenate([np.concatenate(shots[:3], axis=1), np.concatenate(shots[3:], axis=1)])
    write_png(film.folder / "guide-views.png", whole[:, :1600])
    settings().property_unset("views_in_object_mode")
    film.ui.wait(20)


BONES = (
    # A joint and its radius, and which joint it hangs on; right limbs only.
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
    film.ui.view.view_location = (0.0, 0.0, 0.12)
    film.ui.view.view_distance = 3.6
    film.ui.wait(4, redraw=True)
    film.at = film.vertex(0.6, -0.2, 1.0)
    start(film)
    presses = 0
    film.say("Alt over a point: the cut that the shape suggests there", 6)
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
    film.say("Shift Alt: that cut, bent to another point")
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
STEPS = (
    # What Blender's own hand does: from which side, where, and whether a path begins there.
    (BEFORE, (0.0, -0.13, 0.88), True),
    (BEHIND, (0.0, 0.13, 0.88), False),
    (BEHIND, (0.377, 0.013, 0.705), True),
    (BEHIND, (0.39, 0.08, 0.5), False),
    (BEFORE, (0.37, -0.12, 0.6), False),
    (BEFORE, (0.377, 0.013, 0.705), False),
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
        film.go(film.seen(min(middles, key=lambda co: (co - near).length)), 9)
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
    preferences = bpy.context.preferences
    preferences.view.ui_scale = 1.6
    preferences.view.filebrowser_display_type = "SCREEN"
    with film.ui.override():
        bpy.ops.screen.screen_full_area(use_hide_panels=True)
    film.ui.wait(8)
    film.ui = driver.Ui()
    window, area = film.ui.window, film.ui.area
    area.ui_type = "PREFERENCES"
    preferences.active_section = "EXTENSIONS"
    film.ui.wait(10, redraw=True)
    film.ui.region = next(region for region in area.regions if region.type == "WINDOW")
    film.at = (film.ui.region.width - 30.0, film.ui.region.height - 30.0)
    film.ui.click(film.at)
    film.ui.wait(10)
    version = ".".join(map(str, bpy.app.version[:2]))
    write_png(film.folder / f"install-{version}-menu.png", film.shot())
    film.ui.key("ESC")
    with bpy.context.temp_override(window=window, area=area, region=film.ui.region):
        bpy.ops.extensions.package_install_files("INVOKE_DEFAULT", filepath=os.environ["SEAMWIRE_PACKAGE"])
    film.ui.wait(30)
    write_png(film.folder / f"install-{version}-file.png", film.shot())
    film.ui.key("ESC")
    film.ui.wait(10)
    preferences.active_section = "ADDONS"
    bpy.context.window_manager.extension_search = "Seamwire"
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


enable_addon()
show_card(False)
kind, target = sys.argv[sys.argv.index("--") + 1 :]
parts = (animation, job, limbs, character, guide, tool, cut, stretch, views, figure_pictures, install, looks)
part = next(part for part in parts if part.__name__ == kind)
play_strictly(lambda: part(Film(Path(target))))
