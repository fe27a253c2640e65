# SPDX-License-Identifier: GPL-3.0-or-later
"""Times of the views of Seamwire Lab in Blender's window: ``scripts/bench-blender --views LEVELS`` runs this.

Suzanne, subdivided several times (4: 126,000 faces). Each view has three times. The first is
the time to compute it in its thread. The second is the processor time of Blender's thread to switch it on and to draw it. The third is the
elapsed time of a redraw, with and without the view in the same run. All are medians of nine.
"""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path
from statistics import median

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [os.environ["SEAMWIRE_BLENDER_PACKAGES"], str(ROOT / "blender_tests")]

import addon_utils
import bpy
import ui as driver
from lab import enable_lab, part
from turns import play_strictly

VIEWS = (
    ("heat", "STRENGTH"),
    ("heat", "CONCAVITY"),
    ("heat", "DISTANCE"),
    ("show_silhouette", True),
    ("show_ellipses", True),
    ("show_paths", True),
    ("show_bands", True),
    ("show_invalid", True),
)
REPEATS = 9
SECONDS = 120.0


def redraw(ui: driver.Ui, step: int) -> float:
    """Turn the view a little, and return how long Blender takes to draw it."""
    begin = time.perf_counter()
    ui.view.view_rotation = (0.8, 0.55, 0.1 + 0.002 * step, 0.2)
    ui.area.tag_redraw()
    ui.wait(1)
    bpy.ops.wm.redraw_timer(type="DRAW_WIN", iterations=1)
    return time.perf_counter() - begin


def main(levels: int) -> None:
    """Measure and print."""
    from seamwire.mesh.settings import TOOL, settings
    from seamwire.view.edited_objects import EditedObjects, edited

    spent: list[float] = []
    plain = EditedObjects.draw

    def timed(self: EditedObjects, part: str) -> None:
        begin = time.thread_time()
        plain(self, part)
        spent.append(time.thread_time() - begin)

    EditedObjects.draw = timed
    ui = driver.Ui()
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.active_object
    obj.modifiers.new("Subdivision", "SUBSURF").levels = levels
    bpy.ops.object.modifier_apply(modifier="Subdivision")
    with ui.override():
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.wm.tool_set_by_id(name=TOOL)
    settings().along = "SURFACE"
    ui.view.view_distance = 4.0
    ui.wait(4, redraw=True)
    middle = ui.on_screen((0.0, -0.5, 0.3))
    ui.move(middle)
    ui.wait_until(lambda: edited.front is not None and not edited.front.busy, SECONDS)
    ui.click(middle)
    ui.wait_until(lambda: not edited.front.busy, SECONDS)
    print(f"    {len(obj.data.polygons)} faces", flush=True)
    enable_lab()
    chosen = part("settings").settings()

    def views() -> object:
        return edited.front.overlay._layers[2]

    def is_complete() -> bool:
        return len(edited.front.overlay._layers) > 2 and views().is_complete  # a timer adds the layer

    for name, value in VIEWS:
        begin = time.perf_counter()
        setattr(chosen, name, value)
        ui.wait_until(is_complete, SECONDS)
        computed = time.perf_counter() - begin
        on, with_view, without, ours = [], [], [], []
        for step in range(REPEATS):
            chosen.property_unset(name)
            ui.wait(1)
            redraw(ui, 3 * step)
            without.append(redraw(ui, 3 * step + 1))
            views()._made.clear()  # as when it is first seen
            spent.clear()
            begin = time.thread_time()
            setattr(chosen, name, value)
            took = time.thread_time() - begin
            ui.wait_until(is_complete, SECONDS)
            redraw(ui, 3 * step + 2)
            on.append(took + sum(spent[:2]))
            spent.clear()
            with_view.append(redraw(ui, 3 * step + 1))
            ours.append(sum(spent[:2]))
        chosen.property_unset(name)
        print(
            f"    {name if value is True else value:14} computed in {1e3 * computed:6.0f} ms, switched on in "
            f"{1e3 * median(on):6.1f} ms, drawn in {1e3 * median(ours):5.1f} ms; a redraw {1e3 * median(with_view):6.1f} ms, "
            f"{median(with_view) / median(without):.2f} of one without",
            flush=True,
        )
    ui.key("ESC")
    ui.key("ESC")
    ui.wait(4)


addon_utils.enable("seamwire", default_set=True)
levels = int(sys.argv[sys.argv.index("--") + 1])
play_strictly(lambda: main(levels))
