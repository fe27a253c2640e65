# SPDX-License-Identifier: GPL-3.0-or-later
"""The hand and the camera of films: move the mouse in Blender's window as a person does, and keep what the display shows."""

from __future__ import annotations

import struct
import time
import zlib
from typing import TYPE_CHECKING

import bpy
import numpy as np
import ui as driver
from mathutils import Vector

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

POINTER = np.array([(0, 0), (0, -17), (4, -13.5), (7, -20), (9.7, -18.8), (6.8, -12.6), (12, -12.3)])
"""The outline of a mouse pointer: pixels to the right of its tip and above it."""
PRESSED = (1.0, 0.8, 0.2)
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
        size = 1.9 * paint.text_size(1.0)
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


def session() -> object | None:
    """Return the session of the chain that is drawn, or of what is pointed at."""
    from seamwire.tool.running import chains as running
    from seamwire.view.edited_objects import edited

    if running:
        return running[0].session
    return edited.front.session if edited.front is not None else None


def offered() -> str | None:
    """Return the kind of the loop that a click would add, if one is shown."""
    return session().picture.offered.kind


def draw_pointer(picture: NDArray[np.uint8], tip: tuple[float, float], pressed: bool) -> None:
    """Draw a pointer if it lies in the picture, which has its bottom row first. It is white, or yellow while a button is down."""
    x0, y0 = int(tip[0]) - 4, int(tip[1]) - 25
    height, width = picture.shape[:2]
    if not (0 <= tip[0] < width and 0 <= tip[1] < height):
        return
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
