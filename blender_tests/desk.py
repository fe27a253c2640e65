# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh with known numbers on a desk: in edit mode, seen from above, to be drawn on in the real window."""

import ctypes
import math
import re
from collections.abc import Iterator
from contextlib import contextmanager

import bmesh
import bpy
import numpy as np
import pytest
import ui as driver
from bl_ui.space_statusbar import STATUSBAR_HT_header
from bpy_extras.view3d_utils import location_3d_to_region_2d
from numpy.typing import NDArray
from scene import add_grid, add_layers, edit, snapshot
from seamwire.core.sketch.sketch import Sketch
from seamwire.mesh.settings import TOOL, settings
from seamwire.operators import steps
from seamwire.tool.chain import Chain
from seamwire.tool.running import chains as running
from seamwire.view.edited_objects import edited

ORANGE, RED, GREEN, WHITE = (1.0, 0.72, 0.05), (1.0, 0.25, 0.15), (0.3, 1.0, 0.55), (1.0, 1.0, 1.0)


class Desk:
    """A grid in edit mode seen from above, with the tool running on it. Vertex y * 9 + x is column x of row y."""

    def __init__(self, ui: driver.Ui, obj: bpy.types.Object) -> None:
        self.ui = ui
        self.name = obj.name
        reset_settings()
        add_layers(obj)
        ui.wait()
        with ui.override():
            edit()
        ui.look_from_top(distance=4.0)
        self.before = snapshot(obj)
        bpy.ops.ed.undo_push(message="Before")  # calls from Python leave no undo steps

    @property
    def obj(self) -> bpy.types.Object:
        """The object; Blender's undo makes another one of it."""
        return bpy.data.objects[self.name]

    def start(self, **options: str) -> Sketch:
        """Begin a chain that waits for its first click."""
        with self.ui.override():
            assert bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT", **options) == {"RUNNING_MODAL"}
        self.ui.wait()
        return self.session

    def choose(self) -> Sketch:
        """Choose the tool in the toolbar, and point at the middle of the mesh."""
        choose(self.ui)
        self.ui.move(self.ui.on_screen((0.03, 0.04, 0.0)))
        self.ui.wait_until(lambda: edited.front is not None)
        return self.session

    @property
    def chain(self) -> Chain:
        """The chain that is being drawn."""
        return running[0]

    @property
    def session(self) -> Sketch:
        """The session of the object that was pointed at last. A timer may have to read its mesh first."""
        if running:
            return running[0].session
        self.ui.wait_until(lambda: edited.front is not None)
        return edited.front.session

    @property
    def running(self) -> bool:
        """Whether a chain is being drawn."""
        return bool(running)

    def at(self, *vertices: int) -> tuple[float, float]:
        """Return where a vertex is seen, or the middle of an edge."""
        found = self.seen(*vertices)
        assert found is not None, f"{vertices} are behind the viewer"
        return found

    def seen(self, *vertices: int) -> tuple[float, float] | None:
        """Return the same, and None where that is behind the viewer."""
        bm = bmesh.from_edit_mesh(self.obj.data)
        bm.verts.ensure_lookup_table()
        points = np.array([self.obj.matrix_world @ bm.verts[v].co for v in vertices])
        at = location_3d_to_region_2d(self.ui.region, self.ui.view, points.mean(axis=0))
        return None if at is None else (at.x, at.y)

    def left_clean(self) -> bool:
        """Whether no chain is being drawn, and the status bar is unchanged."""
        status = getattr(STATUSBAR_HT_header, "_draw_orig", STATUSBAR_HT_header.draw)
        return not self.running and STATUSBAR_HT_header.draw is status

    def unchanged(self) -> bool:
        """Whether the mesh is unchanged."""
        return snapshot(self.obj) == self.before


def grid(ui: driver.Ui) -> Desk:
    """Put a flat grid there."""
    return Desk(ui, add_grid(9))


def half_cone(ui: driver.Ui) -> Desk:
    """Half a cone along y, seen from above: the two wires from 20 to 61 differ, and neither has an equal beside it."""
    obj = add_grid(9)
    for v in obj.data.vertices:
        angle = v.co.x * 0.5 * math.pi * 0.9
        radius = 1.0 - 0.25 * v.co.y
        v.co.x, v.co.z = radius * math.sin(angle), radius * math.cos(angle)
    return Desk(ui, obj)


def choose(ui: driver.Ui, tool: str = TOOL) -> None:
    """Choose a tool of edit mode."""
    with ui.override():
        bpy.ops.wm.tool_set_by_id(name=tool)
    ui.wait(redraw=True)


def reset_settings() -> None:
    """Set the tool as it comes."""
    chosen = settings()
    for name in chosen.bl_rna.properties.keys():  # noqa: SIM118 - Blender's collections give their items otherwise
        if name != "rna_type":
            chosen.property_unset(name)


def draw(desk: Desk, *vertices: int, at_vertices: bool = True) -> Sketch:
    """With the tool chosen, draw a chain with clicks, and end it."""
    ui = desk.ui
    ui.click(desk.at(vertices[0]), ctrl=not at_vertices)
    session = desk.session
    before = len(session.wires)
    for number, vertex in enumerate(vertices[1:], start=1):
        ui.click(desk.at(vertex))
        ui.wait_until(lambda number=number: not desk.running or len(session.wires) >= before + number)
    if desk.running:
        ui.click(desk.at(vertices[-1]), button="RIGHTMOUSE")
    ui.wait_until(lambda: not desk.running)
    return session


def drag(desk: Desk, start: tuple[float, float], end: tuple[float, float]) -> None:
    """Press, move in steps, release."""
    ui = desk.ui
    ui.move(start)
    ui.event("LEFTMOUSE", "PRESS", start)
    for part in (0.3, 0.7, 1.0):
        ui.move((start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1])))
    ui.event("LEFTMOUSE", "RELEASE", end)


def leave(ui: driver.Ui) -> None:
    """End what is drawn, however it stands, and forget what was prepared."""
    for chain in tuple(running):
        chain.finish()
    steps.end_all()
    edited.clear()
    if bpy.context.mode == "EDIT_MESH":
        choose(ui, "builtin.select_box")
    ui.move((ui.region.width * 0.5, ui.region.height * 0.5))
    ui.wait()


@contextmanager
def second_window(ui: driver.Ui, scene: str = "") -> Iterator[dict[str, object]]:
    """Open another window, return what to override the context with for its view, and close it.

    If a scene is named, the window shows a new scene of this name, which is removed too.
    """
    with ui.override():
        (bpy.ops.wm.window_new_main if scene else bpy.ops.wm.window_new)()
    window = bpy.context.window_manager.windows[-1]
    if scene:
        window.scene = bpy.data.scenes.new(scene)
    ui.wait(5)
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    try:
        yield {"window": window, "area": area, "region": region}
    finally:
        with bpy.context.temp_override(window=window):
            bpy.ops.wm.window_close()
        ui.wait(4)
        if scene:
            bpy.data.scenes.remove(bpy.data.scenes[scene])


def send(
    ui: driver.Ui, other: dict[str, object], kind: str, at: tuple[float, float] | None = None, **held: bool
) -> None:
    """Press and release a key or a button in another window, in the middle of its view or at another place of its region."""
    region = other["region"]
    x, y = at or (0.5 * region.width, 0.5 * region.height)
    place = {"x": region.x + round(x), "y": region.y + round(y)}
    other["window"].event_simulate(type="MOUSEMOVE", value="NOTHING", **place)
    for value in ("PRESS", "RELEASE"):
        other["window"].event_simulate(type=kind, value=value, **place, **held)
        ui.wait(3)


def dismiss(ui: driver.Ui) -> None:
    """Move away from a message of Blender's, which closes it."""
    for step in range(3):
        ui.move((ui.region.width - 150.0 + step, ui.region.height - 130.0))
        ui.wait(3)
    ui.key("ESC")  # newer Blenders keep it open
    ui.wait(3)


def said() -> str:
    """Return what the status bar says of the chain."""
    return "; ".join(text for _, text in running[0].hints())


def undo_steps(capfd: pytest.CaptureFixture[str]) -> list[str]:
    """Return the names of the steps in Blender's undo history, which it tells nobody but the terminal; its own are left out."""
    capfd.readouterr()
    bpy.context.window_manager.print_undo_steps()
    ctypes.CDLL(None).fflush(None)
    names = re.findall(r"name='([^']*)'", capfd.readouterr().out)
    assert names, "there is a history"
    return [name for name in names if not name.startswith("MemFile Internal")]  # Ctrl+Z does not stop at these


def near(pixels: NDArray[np.float32], at: tuple[float, float], radius: int = 2) -> NDArray[np.float32]:
    """Return the colors around a position."""
    x, y = round(at[0]), round(at[1])
    return pixels[y - radius : y + radius + 1, x - radius : x + radius + 1, :3].reshape(-1, 3)


def shows(pixels: NDArray[np.float32], at: tuple[float, float], color: tuple[float, float, float]) -> bool:
    """Whether a pixel within two of a position has a color, up to what antialiasing and blending take from it."""
    return bool((np.abs(near(pixels, at) - color).max(axis=1) < 0.12).any())
