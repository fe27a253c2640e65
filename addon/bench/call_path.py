# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts what one act of the artist calls in the core: calls, functions, modules, and changes from one module to another.

Run it as `python addon/bench/call_path.py`. It needs the compiled library, and no Blender. Comprehensions and lambdas count as part of the
function that has them. The mesh is a hilly grid, and everything is computed before each act.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from types import FrameType

import numpy as np

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from seamwire.core.base.mesh_arrays import Arrays  # noqa: E402
from seamwire.core.network.network import Snap  # noqa: E402
from seamwire.core.sketch.sketch import Sketch  # noqa: E402
from seamwire.core.solver.solver import LiveMaker  # noqa: E402

SIZE = 40
"""Vertices along a side of the grid; vertex y * SIZE + x."""


class CallPath:
    """The functions that were called, in order."""

    def __init__(self) -> None:
        self.calls: list[tuple[str, str]] = []
        self._stack: list[str] = []
        self.changes = 0

    def __call__(self, frame: FrameType, event: str, _arg: object) -> None:
        """Take note of an event, as `sys.setprofile` tells it."""
        file = frame.f_code.co_filename
        if "/seamwire/core/" not in file or frame.f_code.co_name.startswith("<"):
            return
        module = file.rsplit("/seamwire/", 1)[1]
        if event == "call":
            self.calls.append(
                (module, frame.f_code.co_qualname if sys.version_info >= (3, 11) else frame.f_code.co_name)
            )
            self.changes += bool(self._stack) and self._stack[-1] != module
            self._stack.append(module)
        elif event == "return" and self._stack:
            self._stack.pop()

    def row(self) -> tuple[int, int, int, int]:
        """Return how many calls, functions, modules, and calls into another module there were."""
        return len(self.calls), len(set(self.calls)), len({module for module, _ in self.calls}), self.changes


def grid() -> Arrays:
    """Return a hilly grid of quads."""
    x, y = np.meshgrid(np.arange(SIZE), np.arange(SIZE))
    points = np.stack([x, y, np.cos(0.4 * x) * np.sin(0.3 * y)], axis=-1).reshape(-1, 3).astype(np.float64)
    numbers = np.arange(SIZE * SIZE, dtype=np.int32).reshape(SIZE, SIZE)
    a, b, c, d = (part.ravel() for part in (numbers[:-1, :-1], numbers[:-1, 1:], numbers[1:, 1:], numbers[1:, :-1]))
    across = np.stack([numbers[:, :-1].ravel(), numbers[:, 1:].ravel()], axis=1)
    up = np.stack([numbers[:-1].ravel(), numbers[1:].ravel()], axis=1)
    triangles = np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3).astype(np.int32)
    polygons = np.repeat(np.arange(len(a), dtype=np.int32), 2)
    none = np.empty((0, 2), dtype=np.int32)
    edges = np.concatenate([across, up]).astype(np.int32)
    return Arrays(points, triangles, polygons, edges, np.eye(3), none, none)


def sketch() -> Sketch:
    """Return a sketch with two kept wires and a live one, all computed."""
    arrays = grid()
    own = Sketch(LiveMaker(arrays), arrays.points, edges=arrays.edges, triangles=arrays.triangles)
    for pick in (0, 5 * SIZE + 5, 5 * SIZE + 20):
        own.click(pick)
        own.wait()
    own.hover(20 * SIZE + 20)
    own.wait()
    return own


def dragging(own: Sketch) -> None:
    """Hold a seed whose wires are computed."""
    own.end_chain()
    own.drag(Snap(5 * SIZE + 5, "SEED"))
    own.drag_to(6 * SIZE + 5)
    while own.poll() or own.computing:
        pass


ACTS: dict[str, tuple[Callable[[Sketch], object], Callable[[Sketch], object]]] = {
    "hover": (lambda own: None, lambda own: own.hover(20 * SIZE + 21)),
    "click": (lambda own: None, lambda own: own.click(20 * SIZE + 20)),
    "stroke": (lambda own: None, lambda own: own.draw_stroke(vertices=[7 * SIZE + 7, 7 * SIZE + 8])),
    "drag, a move": (dragging, lambda own: own.drag_to(7 * SIZE + 5)),
    "drag, the release": (dragging, lambda own: own.drag_end()),
    "W on a kept wire": (lambda own: own.end_chain(), lambda own: own.retrace(own.wires[0])),
    "undo": (lambda own: None, lambda own: own.undo()),
    "redo": (lambda own: own.undo(), lambda own: own.redo()),
}
"""What comes before each act, and the act."""


def main() -> None:
    """Print the table."""
    print("| act | calls | functions | modules | changes of module |\n|---|---|---|---|---|")
    for name, (prepare, act) in ACTS.items():
        own = sketch()
        prepare(own)
        path = CallPath()
        sys.setprofile(path)
        try:
            act(own)
        finally:
            sys.setprofile(None)
        print(f"| {name} |", " | ".join(map(str, path.row())), "|")


if __name__ == "__main__":
    main()
