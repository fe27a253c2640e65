# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool at work on a large mesh in Blender's window: ``scripts/bench-blender --window LEVELS`` runs this.

Suzanne, subdivided several times, with simulated events. It measures the time from the first click to the first wire and from a move of
the mouse to the redraw. It also measures our share of both, how long our code blocks the interface, and the memory of the tool. Our share
is processor time of Blender's thread. Other times are elapsed times, which mostly consist of Blender's own drawing if the processor draws
the display.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [os.environ["SEAMWIRE_BLENDER_PACKAGES"], str(ROOT / "blender_tests"), str(ROOT / "addon/bench")]

import addon_utils
import bmesh
import bpy
import numpy as np
import ui as driver
from mathutils import Euler
from measures import Laps, Memory, Pictures
from numpy.typing import NDArray
from turns import play_strictly

MOVES = 24
SECONDS = 120.0
SAMPLES = 10
"""Turns in which Blender has drawn a picture to its end: it smooths with eight samples, one in each turn."""
HELD = 0.1
"""Seconds from which on a stop of the interface is told of."""


class Holds:
    """How long our code held the interface, call by call.

    In processor time of Blender's thread: other work on the machine does not count.
    """

    def __init__(self) -> None:
        self.doing = "start"
        self.calls: list[tuple[str, str, float]] = []
        self._depth = 0

    def watch(self, owner: object, name: str, what: str) -> None:
        """Time every call of a method or function, from the outermost."""
        method = getattr(owner, name)

        def timed(*arguments: object, **options: object) -> object:
            start = time.thread_time()
            self._depth += 1
            try:
                return method(*arguments, **options)
            finally:
                self._depth -= 1
                if self._depth == 0:
                    self.calls.append((self.doing, what, time.thread_time() - start))

        setattr(owner, name, timed)

    def watch_events(self) -> None:
        """Time what Blender calls: the operator's methods count their arguments, so the drawing is watched below them."""
        from seamwire.tool import acts
        from seamwire.tool.chain import Chain
        from seamwire.view.edited_objects import EditedObjects

        self.watch(Chain, "__init__", "start")
        self.watch(acts, "act_first", "start")
        self.watch(acts, "act", "event")
        for name in ("trouble", "finish"):
            self.watch(Chain, name, "event")
        for name in ("hover", "on_update", "tick"):
            self.watch(EditedObjects, name, "event")
        self.watch(EditedObjects, "draw", "draw")

    @contextmanager
    def during(self, what: str) -> Iterator[None]:
        """Say what is being done."""
        before, self.doing = self.doing, what
        try:
            yield
        finally:
            self.doing = before

    def longest(self) -> Iterator[tuple[str, str, float]]:
        """Yield the longest stop of each kind, longest first."""
        most: dict[tuple[str, str], float] = {}
        for doing, what, took in self.calls:
            most[doing, what] = max(took, most.get((doing, what), 0.0))
        for (doing, what), took in sorted(most.items(), key=lambda item: -item[1]):
            yield doing, what, took


def lives_made() -> int:
    """Return how many live wires the library was asked for."""
    return _made[0]


_made = [0]


def count_lives() -> None:
    """Count the calls that make live wires."""
    from seamwire.core.solver.solver import LiveMaker

    make = LiveMaker.__call__

    def counted(maker: LiveMaker, along: str) -> object:
        _made[0] += 1
        return make(maker, along)

    LiveMaker.__call__ = counted


def settle(ui: driver.Ui) -> None:
    """Wait until nothing is computed and Blender has drawn its last picture."""
    ui.wait_until(lambda: not (session() is not None and session().computing) and not overlay_busy(), SECONDS)
    ui.wait(SAMPLES)


def leave(ui: driver.Ui) -> None:
    """End what is being drawn without keeping it."""
    ui.key("ESC")
    ui.key("ESC")
    ui.wait_until(lambda: session() is None, SECONDS)


def session() -> object | None:
    """Return the session of the chain that is being drawn."""
    from seamwire.tool.running import chains as running

    return running[0].session if running else None


def stage(ui: driver.Ui, levels: int) -> bpy.types.Object:
    """Put Suzanne, subdivided, into the window, in edit mode."""
    if bpy.context.mode != "OBJECT":
        with ui.override():
            bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.active_object
    modifier = obj.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = levels
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    with ui.override():
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_mode(type="EDGE")
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.wm.tool_set_by_id(name=TOOL)
    ui.view.view_perspective = "PERSP"
    ui.view.view_rotation = Euler((1.24, 0.0, 0.46)).to_quaternion()
    ui.view.view_location = (0.08, 0.0, -0.02)
    ui.view.view_distance = 3.75
    ui.wait(4, redraw=True)
    return obj


def redraws(ui: driver.Ui, count: int) -> list[float]:
    """Return how long Blender takes to draw the viewport."""
    found = []
    for _ in range(count):
        start = time.perf_counter()
        drawn(ui, lambda: ui.area.tag_redraw())
        found.append(time.perf_counter() - start)
    return found


def drawn(ui: driver.Ui, do: Callable[[], object]) -> float:
    """Do something and return the moment at which the next picture of the viewport was there."""
    moments: list[float] = []
    handle = bpy.types.SpaceView3D.draw_handler_add(
        lambda: moments.append(time.perf_counter()), (), "WINDOW", "POST_PIXEL"
    )
    try:
        do()
        ui.wait_until(lambda: bool(moments), SECONDS)
    finally:
        bpy.types.SpaceView3D.draw_handler_remove(handle, "WINDOW")
    return moments[0]


def move_and_redraw(ui: driver.Ui, place: tuple[float, float]) -> None:
    """Move the mouse, and ask for a redraw in any case: where nothing changes the tool asks for none."""
    ui.event("MOUSEMOVE", "NOTHING", place, ticks=0)
    ui.area.tag_redraw()


def path(ui: driver.Ui) -> NDArray[np.float64]:
    """Return positions over the forehead and down to the chin: nowhere beside the mesh."""
    turn = np.linspace(0.0, 2.0 * np.pi, MOVES)
    places = np.stack([0.42 + 0.20 * np.sin(turn), -0.62 - 0.0 * turn, 0.35 + 0.30 * np.cos(turn)], axis=1)
    return np.array([ui.on_screen(tuple(place)) for place in places])


def measure(ui: driver.Ui, along: str, holds: Holds) -> dict[str, object]:
    """Start the tool, draw, and leave; return what was measured: seconds, bytes and counts."""
    found: dict[str, object] = {"empty redraw": np.median(redraws(ui, 3))}
    before = Memory.now()
    places = path(ui)
    ui.move(tuple(places[0]))
    measure_first_chain(ui, along, holds, places, found)
    found["memory"] = Memory.now() - before
    with holds.during("second seed"):
        measure_second_seed(ui, places, found)
    with holds.during("move"):
        found["move"], found["move, ours"] = moves(ui, places, holds)
    # The tint draws all faces once more: by the processor here, elsewhere by the graphics card.
    own = bpy.context.preferences.addons["seamwire"].preferences
    own.tint, before_tint = 0.0, own.tint
    with holds.during("move, no tint"):
        _, found["move, ours, no tint"] = moves(ui, places[: MOVES // 2], holds)
    own.tint = before_tint
    found["memory at the end"] = Memory.now() - before
    with holds.during("end"):
        measure_end(ui, holds, places, found)
    with holds.during("second chain"):
        measure_second_chain(ui, places, found)
    with holds.during("another tool's edit"):
        change(bpy.context.edit_object)
        ui.wait(4, redraw=True)
        start = time.perf_counter()
        with ui.override():
            assert bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT", along=along) == {"RUNNING_MODAL"}
        found["start after an edit"] = time.perf_counter() - start
        leave(ui)
    return found


def measure_first_chain(
    ui: driver.Ui, along: str, holds: Holds, places: NDArray[np.float64], found: dict[str, object]
) -> None:
    """From the start of the tool to the wires of its first seed."""
    start = time.perf_counter()
    with holds.during("start"), ui.override():
        assert bpy.ops.mesh.seamwire_draw("INVOKE_DEFAULT", along=along) == {"RUNNING_MODAL"}
    found["tool runs"] = time.perf_counter() - start
    with holds.during("first seed and wire"):
        ui.event("LEFTMOUSE", "PRESS", tuple(places[0]), ticks=1)
        ui.event("LEFTMOUSE", "RELEASE", tuple(places[0]), ticks=1)
        ui.wait_until(lambda: session().seed is not None, SECONDS)
        ui.event("MOUSEMOVE", "NOTHING", tuple(places[MOVES // 2]), ticks=1)
        ui.wait_until(lambda: session().wiring.active is not None, SECONDS)
        found["first wire shown"] = time.perf_counter() - start
        ui.wait_until(lambda: session().wiring.active_final, SECONDS)
        found["first wire final"] = time.perf_counter() - start
        ui.wait_until(lambda: not session().computing, SECONDS)
        found["both wires"] = time.perf_counter() - start


def measure_second_seed(ui: driver.Ui, places: NDArray[np.float64], found: dict[str, object]) -> None:
    """From the click that keeps a wire to the next one."""
    ui.event("LEFTMOUSE", "PRESS", tuple(places[MOVES // 2]), ticks=1)
    clicked = time.perf_counter()
    ui.event("LEFTMOUSE", "RELEASE", tuple(places[MOVES // 2]), ticks=1)
    ui.event("MOUSEMOVE", "NOTHING", tuple(places[MOVES // 4]), ticks=1)
    ui.wait_until(lambda: session().wiring.active is not None, SECONDS)
    found["next wire shown"] = time.perf_counter() - clicked
    ui.wait_until(lambda: session().wiring.active_final, SECONDS)
    found["next wire final"] = time.perf_counter() - clicked
    settle(ui)


def measure_end(ui: driver.Ui, holds: Holds, places: NDArray[np.float64], found: dict[str, object]) -> None:
    """From the key that ends a chain to the first picture in which nothing of it is left to be done."""
    from seamwire.tool import running as undo_steps

    ui.click(tuple(places[3 * MOVES // 4]))
    settle(ui)
    pushed, first = Laps(undo_steps, "push"), len(holds.calls)
    with pushed, Pictures() as pictures:
        start = time.perf_counter()
        ui.event("RET", "PRESS", ticks=0)
        ui.event("RET", "RELEASE", ticks=0)
        ui.wait_until(lambda: pictures.first(lambda: session() is None and not overlay_busy()) is not None, SECONDS)
        found["end"] = pictures.moment - start
        found["end, redraws"] = pictures.count
    found["end, ours"] = sum(spent for _, what, spent in holds.calls[first:] if what != "draw") - pushed.seconds
    found["end, Blender's undo step"] = pushed.seconds
    settle(ui)


def measure_second_chain(ui: driver.Ui, places: NDArray[np.float64], found: dict[str, object]) -> None:
    """From the click of the tool that begins a chain to the first picture of its wire; nothing has changed since the last chain."""
    lives = lives_made()
    at, then = tuple(places[MOVES // 8]), tuple(places[MOVES // 4])
    ui.move(at)
    settle(ui)
    with Pictures() as pictures:
        start = time.perf_counter()
        ui.event("LEFTMOUSE", "PRESS", at, ticks=0)
        ui.event("LEFTMOUSE", "RELEASE", at, ticks=0)
        ui.event("MOUSEMOVE", "NOTHING", then, ticks=0)
        ui.wait_until(lambda: session() is not None and session().wiring.active is not None, SECONDS)
        found["second chain, wire computed"] = time.perf_counter() - start
        found["second chain, redraws before"] = pictures.count
        ui.wait_until(lambda: pictures.first(lambda: session().wiring.active is not None) is not None, SECONDS)
        found["second chain, wire shown"] = pictures.moment - start
    found["second chain, live wires made"] = lives_made() - lives
    leave(ui)


def change(obj: bpy.types.Object) -> None:
    """Move a vertex, as another tool would."""
    mesh = bmesh.from_edit_mesh(obj.data)
    mesh.verts.ensure_lookup_table()
    mesh.verts[0].co.x += 1e-3
    bmesh.update_edit_mesh(obj.data)


def moves(ui: driver.Ui, places: NDArray[np.float64], holds: Holds) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Move from place to place; return how long each took until it was drawn, and how much of that was ours."""
    took, ours = [], []
    for place in places:
        first = len(holds.calls)
        seen = session().revision
        start = time.perf_counter()
        end = drawn(ui, lambda place=place: move_and_redraw(ui, tuple(place)))
        if session().revision != seen:  # else the cursor is where it was, and nothing was to be done
            took.append(end - start)
            ours.append(sum(spent for _, _, spent in holds.calls[first:]))
    return np.array(took), np.array(ours)


def overlay_busy() -> bool:
    """Whether islands are being computed."""
    from seamwire.view.edited_objects import edited

    return any(view.busy for view in edited.views())


def report(along: str, found: dict[str, object], holds: Holds, triangles: int) -> None:
    """Print what was measured, memory for each of some triangles too."""
    for name, value in found.items():
        if isinstance(value, Memory):
            for what, held in (("resident", value.resident), ("allocated", value.allocated)):
                kilobytes = held / triangles / 1e3
                print(
                    f"{along:8} {f'{name}, {what}':32} {held / 1e6:8.0f} MB, {kilobytes:.2f} kB a triangle", flush=True
                )
        elif isinstance(value, int):
            print(f"{along:8} {name:32} {value:8}", flush=True)
        elif isinstance(value, np.ndarray):
            middle, high = np.percentile(1e3 * value, (50, 95))
            print(
                f"{along:8} {name:32} {middle:8.1f} ms median, {high:.1f} ms 95 %, {1e3 * value.max():.1f} ms most",
                flush=True,
            )
        else:
            print(f"{along:8} {name:32} {1e3 * value:8.1f} ms", flush=True)
    for doing, what, took in holds.longest():
        if took >= HELD or doing == "move":
            print(f"{along:8} held during {doing:20} by our {what:6} {1e3 * took:8.1f} ms", flush=True)


def main(levels: int) -> None:
    """Measure both ways of running."""
    ui = driver.Ui()
    with ui.override():
        bpy.ops.screen.screen_full_area(use_hide_panels=True)
    ui.wait(8)
    ui = driver.Ui()
    holds = Holds()
    holds.watch_events()
    count_lives()
    for along in ("EDGES", "SURFACE"):
        obj = stage(ui, levels)
        print(f"{obj.name}: {len(obj.data.polygons)} faces, {len(obj.data.vertices)} vertices", flush=True)
        triangles = len(obj.data.loops) - 2 * len(obj.data.polygons)
        report(along, measure(ui, along, holds), holds, triangles)
        holds.calls.clear()


addon_utils.enable("seamwire", default_set=True)
from seamwire.mesh.settings import TOOL

levels = int(sys.argv[sys.argv.index("--") + 1])
play_strictly(lambda: main(levels))
