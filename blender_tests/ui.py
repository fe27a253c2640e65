# SPDX-License-Identifier: GPL-3.0-or-later
"""A hand and an eye for tests in Blender's real window: events, waits, and the pixels of the viewport.

``Ui`` sends Blender's own simulated events, which need ``--enable-event-simulate``. ``RealUi`` moves the X display's pointer and presses
its keys with xdotool: slower, but it is all that a person's hand is, double clicks and the motion in between included.
"""

import os
import struct
import subprocess
import sys
import time
import traceback
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path
from types import TracebackType

import bpy
import gpu
import numpy as np
from numpy.typing import NDArray
from scene import ADDON

_switch_to_blender: Callable[[], object] | None = None
_errors: list[str] = []


def prepare_blender(switch_to_blender: Callable[[], object]) -> None:
    """Quieten what would come between the tests and the tool, and collect the errors that Blender would only print."""
    global _switch_to_blender
    _switch_to_blender = switch_to_blender
    preferences = bpy.context.preferences
    preferences.view.show_splash = False
    preferences.view.smooth_view = 0
    preferences.view.use_save_prompt = False
    preferences.filepaths.use_auto_save_temporary_files = False
    sys.excepthook = _collect_unhandled
    for name in dir(bpy.types):
        cls = getattr(bpy.types, name)
        if getattr(cls, "__module__", "").startswith((f"{ADDON}.", f"{ADDON}_networks.")):
            _collect_from_methods(cls)


def _collect_unhandled(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    # Blender hands what a draw handler or a timer raised to sys.excepthook.
    _errors.append("".join(traceback.format_exception(kind, error, trace)))
    sys.__excepthook__(kind, error, trace)


def _collect_from_methods(cls: type) -> None:
    # Blender only prints errors of operators and panels. Blender looks these methods up at each call, so it finds the wrappers, and it
    # counts the arguments that they name.
    for name in ("invoke", "modal"):
        if name in cls.__dict__:
            setattr(cls, name, _collecting_event(cls.__dict__[name]))
    for name in ("execute", "cancel", "draw"):
        parts = getattr(cls.__dict__.get(name), "_draw_funcs", None)
        if parts is not None:  # a menu with entries of another add-on
            parts[0] = _collecting(parts[0])
        elif name in cls.__dict__:
            setattr(cls, name, _collecting(cls.__dict__[name]))


def _collecting_event(method: Callable) -> Callable:
    def collecting(self: object, context: bpy.types.Context, event: bpy.types.Event) -> object:
        try:
            return method(self, context, event)
        except Exception:
            _errors.append(traceback.format_exc())
            raise

    return collecting


def _collecting(method: Callable) -> Callable:
    def collecting(self: object, context: bpy.types.Context) -> object:
        try:
            return method(self, context)
        except Exception:
            _errors.append(traceback.format_exc())
            raise

    return collecting


def take_errors() -> list[str]:
    """Return the errors collected since the last call."""
    errors = _errors.copy()
    _errors.clear()
    return errors


class Ui:
    """Blender's one window and its biggest 3D viewport. Positions are pixels of the viewport's region, from its bottom left."""

    def __init__(self) -> None:
        self.window = bpy.context.window_manager.windows[0]
        viewports = [area for area in self.window.screen.areas if area.type == "VIEW_3D"]
        self.area = max(viewports, key=lambda area: area.width * area.height)
        self.region = next(region for region in self.area.regions if region.type == "WINDOW")
        self.space = self.area.spaces.active
        self.view = self.space.region_3d

    def override(self) -> AbstractContextManager[None]:
        """``with ui.override(): bpy.ops...`` runs an operator in the viewport. Do not wait inside it."""
        return bpy.context.temp_override(window=self.window, area=self.area, region=self.region)

    def wait(self, ticks: int = 2, redraw: bool = False) -> None:
        """Let Blender handle its events, and redraw what asks for it; or the viewport in any case."""
        for _ in range(ticks):
            if redraw:
                self.area.tag_redraw()
            _switch_to_blender()

    def wait_until(self, condition: Callable[[], bool], seconds: float = 30.0) -> None:
        """Wait until the condition holds; fail when it does not within some seconds."""
        end = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < end, f"still not so after {seconds} seconds: {condition}"
            self.wait(1)

    def event(
        self,
        kind: str,
        value: str,
        at: tuple[float, float] | None = None,
        *,
        shift: bool = False,
        ctrl: bool = False,
        alt: bool = False,
        text: str | None = None,
        ticks: int = 2,
    ) -> None:
        """Send one event, at the last position of the mouse or at a new one, and wait until it was handled."""
        if at is not None:
            self._position = (self.region.x + round(at[0]), self.region.y + round(at[1]))
        x, y = self._position
        more = {} if text is None else {"unicode": text}
        self.window.event_simulate(type=kind, value=value, x=x, y=y, shift=shift, ctrl=ctrl, alt=alt, **more)
        self.wait(ticks)

    _position: tuple[int, int] = (0, 0)

    def move(self, at: tuple[float, float], **modifiers: bool) -> None:
        """Move the mouse to a position in the viewport."""
        self.event("MOUSEMOVE", "NOTHING", at, **modifiers)

    def click(self, at: tuple[float, float], button: str = "LEFTMOUSE", **modifiers: bool) -> None:
        """Move to a position, then press and release a button there."""
        self.move(at, **modifiers)
        self.event(button, "PRESS", at, **modifiers)
        self.event(button, "RELEASE", at, **modifiers)

    def wheel(self, up: bool, at: tuple[float, float] | None = None, **modifiers: bool) -> None:
        """Turn the wheel by one notch."""
        self.event("WHEELUPMOUSE" if up else "WHEELDOWNMOUSE", "PRESS", at, **modifiers)

    def key(self, kind: str, text: str | None = None, **modifiers: bool) -> None:
        """Press and release a key, named as in ``bpy.types.Event.type``."""
        self.event(kind, "PRESS", text=text, **modifiers)
        self.event(kind, "RELEASE", **modifiers)

    def on_screen(self, point: tuple[float, float, float]) -> tuple[float, float]:
        """Return where a point in the scene's coordinates is seen in the viewport."""
        from bpy_extras.view3d_utils import location_3d_to_region_2d

        at = location_3d_to_region_2d(self.region, self.view, point)
        assert at is not None, f"{point} is behind the viewer"
        return at.x, at.y

    def look(
        self, rotation: tuple[float, float, float, float], centre: tuple[float, float, float], distance: float
    ) -> None:
        """Look at a point in orthographic projection, with the view rotation as a quaternion."""
        self.view.view_perspective = "ORTHO"
        self.view.view_rotation = rotation
        self.view.view_location = centre
        self.view.view_distance = distance
        self.wait(redraw=True)

    def look_from_top(self, centre: tuple[float, float, float] = (0.0, 0.0, 0.0), distance: float = 5.0) -> None:
        """Look straight down: the scene's x to the right, its y up."""
        self.look((1.0, 0.0, 0.0, 0.0), centre, distance)

    def pixels(self) -> NDArray[np.float32]:
        """Return what is drawn over the viewport's objects: (height, width, 4), bottom row first, colors as the screen gets them."""
        taken: list[NDArray[np.float32]] = []

        def read() -> None:
            x, y, width, height = gpu.state.viewport_get()
            buffer = gpu.state.active_framebuffer_get().read_color(x, y, width, height, 4, 0, "FLOAT")
            buffer.dimensions = width * height * 4
            taken.append(np.array(buffer, dtype=np.float32).reshape(height, width, 4))

        handle = bpy.types.SpaceView3D.draw_handler_add(read, (), "WINDOW", "POST_PIXEL")
        try:
            self.area.tag_redraw()
            self.wait_until(lambda: bool(taken))
        finally:
            bpy.types.SpaceView3D.draw_handler_remove(handle, "WINDOW")
        return taken[-1]

    def screen(self) -> NDArray[np.float32]:
        """Return the viewport as it is seen, mesh and all: (height, width, 3), bottom row first."""
        self.wait(3, redraw=True)
        whole = display()
        x, y = self.window.x + self.region.x, self.window.y + self.region.y
        return whole[y : y + self.region.height, x : x + self.region.width]


def display() -> NDArray[np.float32]:
    """Return what is on the virtual display: (height, width, 3), bottom row first."""
    return display_bytes().astype(np.float32) / 255.0


def display_bytes() -> NDArray[np.uint8]:
    """As `display`, with colors from 0 to 255."""
    data = Path(os.environ["SEAMWIRE_SCREEN"]).read_bytes()
    # An X window dump: 25 numbers, the window's name, the color map, then rows of blue, green, red and a byte without meaning.
    header = struct.unpack(">25I", data[:100])
    size, width, height, row, colors = header[0], header[4], header[5], header[12], header[19]
    pixels = np.frombuffer(data, dtype=np.uint8, offset=size + 12 * colors, count=row * height)
    pixels = pixels.reshape(height, row)[::-1, : 4 * width].reshape(height, width, 4)
    return pixels[..., 2::-1]


class RealUi(Ui):
    """The same hand, on the real pointer and keyboard of the display."""

    BUTTONS = {"LEFTMOUSE": "1", "MIDDLEMOUSE": "2", "RIGHTMOUSE": "3", "WHEELUPMOUSE": "4", "WHEELDOWNMOUSE": "5"}
    KEYS = {"RET": "Return", "ESC": "Escape", "TAB": "Tab", "SPACE": "space", "LEFT_ALT": "alt", "LEFT_CTRL": "ctrl"}

    def event(
        self,
        kind: str,
        value: str,
        at: tuple[float, float] | None = None,
        *,
        shift: bool = False,
        ctrl: bool = False,
        alt: bool = False,
        text: str | None = None,
        ticks: int = 4,
    ) -> None:
        """Do what the event tells of; ``text`` is what the keyboard makes of the key."""
        commands: list[str] = []
        if at is not None:
            commands += ["mousemove", *self._on_display(at)]
        held = [name for name, is_held in (("shift", shift), ("ctrl", ctrl), ("alt", alt)) if is_held]
        for name in held:
            commands += ["keydown", name]
        if kind.startswith("WHEEL"):
            commands += ["click", self.BUTTONS[kind]]
        elif kind in self.BUTTONS:
            commands += ["mousedown" if value == "PRESS" else "mouseup", self.BUTTONS[kind]]
        elif kind != "MOUSEMOVE":
            commands += ["keydown" if value == "PRESS" else "keyup", self.KEYS.get(kind, kind.lower())]
        for name in held:
            commands += ["keyup", name]
        self._do(commands, ticks)

    def double_click(self, at: tuple[float, float], button: str = "LEFTMOUSE") -> None:
        """Click twice within the time that Blender takes for a double click."""
        self._do(["mousemove", *self._on_display(at)], ticks=4)
        self._do(["click", "--repeat", "2", "--delay", "40", self.BUTTONS[button]], ticks=6)

    def _on_display(self, at: tuple[float, float]) -> tuple[str, str]:
        # X counts rows from the top of the display, Blender from its bottom; without a window manager the window has no frame.
        geometry = subprocess.run(["xdotool", "getdisplaygeometry"], check=True, capture_output=True, text=True)
        height = int(geometry.stdout.split()[1])
        x = self.window.x + self.region.x + round(at[0])
        y = height - 1 - (self.window.y + self.region.y + round(at[1]))
        return str(x), str(y)

    def _do(self, commands: list[str], ticks: int) -> None:
        subprocess.run(["xdotool", *commands], check=True)
        time.sleep(0.05)  # the X server hands the events on in its own time
        self.wait(ticks)
