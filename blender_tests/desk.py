# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh with known numbers on a desk: in edit mode, seen from above, to be drawn on in the real window."""

import math

import bmesh
import bpy
import numpy as np
import ui as driver
from bl_ui.space_statusbar import STATUSBAR_HT_header
from bpy_extras.view3d_utils import location_3d_to_region_2d
from numpy.typing import NDArray
from scene import add_grid, add_layers, edit, snapshot
from seamwire.core.session import Session
from seamwire.operators import modal as drawing

ORANGE, RED, GREEN, WHITE = (1.0, 0.72, 0.05), (1.0, 0.25, 0.15), (0.3, 1.0, 0.55), (1.0, 1.0, 1.0)


class Desk:
    """A grid in edit mode seen from above, with the tool running on it. Vertex y * 9 + x is column x of row y."""

    def __init__(self, ui: driver.Ui, obj: bpy.types.Object) -> None:
        self.ui = ui
        self.obj = obj
        settings = bpy.context.window_manager.seamwire
        for name in settings.bl_rna.properties.keys():  # noqa: SIM118 - Blender's collections give their items otherwise
            settings.property_unset(name)
        add_layers(obj)
        ui.wait()
        with ui.override():
            edit()
        ui.look_from_top(distance=4.0)
        self.before = snapshot(obj)

    def start(self, **options: str) -> Session:
        """Start the tool."""
        with self.ui.override():
            assert bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT", **options) == {"RUNNING_MODAL"}
        self.ui.wait()
        return self.session

    @property
    def session(self) -> Session:
        """The running drawing's session."""
        return drawing.running[0].session

    @property
    def running(self) -> bool:
        """Whether the tool runs."""
        return bool(drawing.running)

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
        """Whether the tool has ended, and the status bar and the handlers are as they were."""
        status = getattr(STATUSBAR_HT_header, "_draw_orig", STATUSBAR_HT_header.draw)
        handlers = [handler for handler in bpy.app.handlers.depsgraph_update_post if "Drawing" in str(handler)]
        return not self.running and STATUSBAR_HT_header.draw is status and not handlers

    def unchanged(self) -> bool:
        """Whether the mesh is as it was when it came."""
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


def leave(ui: driver.Ui) -> None:
    """End the tool, however it stands."""
    drawing.close_all()
    ui.move((ui.region.width * 0.5, ui.region.height * 0.5))
    ui.wait()


def near(pixels: NDArray[np.float32], at: tuple[float, float], radius: int = 2) -> NDArray[np.float32]:
    """Return the colours around a position."""
    x, y = round(at[0]), round(at[1])
    return pixels[y - radius : y + radius + 1, x - radius : x + radius + 1, :3].reshape(-1, 3)


def shows(pixels: NDArray[np.float32], at: tuple[float, float], colour: tuple[float, float, float]) -> bool:
    """Whether a pixel within two of a position has a colour, up to what antialiasing and blending take from it."""
    return bool((np.abs(near(pixels, at) - colour).max(axis=1) < 0.12).any())
