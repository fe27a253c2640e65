# SPDX-License-Identifier: GPL-3.0-or-later
"""How often the wheel would be turned for the other wire, and how often for the view, while artists' seams are drawn.

    python native/bench/wheel_motions.py SEAMS

SEAMS is as for seam_clicks.py. Each seam is drawn as there: from one edge to the farthest that a wire reaches exactly. Two kinds of
motions are counted while a wire is live:

- a candidate: the second of the two wires is the artist's, so one notch or one press of W brings it forward;
- notches of zooming: the view begins with the whole object in a window 1080 pixels high, seen from the front of each edge. An edge can
  be clicked if it is so many pixels long. The edge clicked before is the middle of the view. For an edge outside the view, the hand zooms
  out and then in again. A notch is a factor of 1.2, as in Blender. Turning and moving the view are not counted.
"""

from __future__ import annotations

import argparse
import importlib
import math
import sys
from pathlib import Path
from typing import Any

import numpy as np
from seams_engine import SeamwireEngine

_HALF_HEIGHT = 540.0
_NOTCH = math.log(1.2)
_LONG_ENOUGH = (6.0, 12.0, 24.0)


class Zoom:
    """A view that is zoomed no more than a click asks for.

    Parameters
    ----------
    radius
        Half of the object, which the whole window shows.
    pixels
        From what length on an edge can be clicked.
    """

    def __init__(self, radius: float, pixels: float) -> None:
        self._radius, self._pixels = radius, pixels
        self._level = 0
        self._middle: np.ndarray | None = None

    def click(self, ends: np.ndarray) -> int:
        """Return the notches that it takes to click an edge (2, 3)."""
        length, middle = float(np.linalg.norm(ends[1] - ends[0])), ends.mean(axis=0)
        shown = length / self._radius * _HALF_HEIGHT
        needed = max(0, math.ceil(math.log(self._pixels / max(shown, 1e-9)) / _NOTCH))
        seen_to = self._level
        if self._middle is not None:
            away = float(np.linalg.norm(middle - self._middle))
            seen_to = min(self._level, max(0, math.floor(math.log(self._radius / max(away, 1e-9)) / _NOTCH)))
        notches = self._level - seen_to + max(0, needed - seen_to)
        self._level, self._middle = max(seen_to, needed), middle
        return notches


def wires_of(expert: Any) -> list[tuple[int, bool]]:  # noqa: ANN401
    """Return where each wire of a chain ends, as a place in the chain, and whether it is the second of the two."""
    at, found = 0, []
    while at < expert.n:
        step, choice = expert.reach(at, at == 0, expert.n - at)[0]
        at += step
        found.append((at, choice > 0))
    return found


def main() -> None:
    """Print a line a model, and the sums."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seams", type=Path)
    parser.add_argument("--models", nargs="*")
    chosen = parser.parse_args()
    sys.path.insert(0, str(chosen.seams))
    measure = importlib.import_module("measure")
    totals = np.zeros(2 + len(_LONG_ENOUGH), dtype=int)
    for path in sorted((chosen.seams / "data").glob("*.npz")):
        if chosen.models and path.stem not in chosen.models:
            continue
        points, offsets, corners, near, seams = measure.load(str(path))
        engine = SeamwireEngine()
        engine.prepare(points, offsets, corners)
        radius = float(np.linalg.norm(np.ptp(points, axis=0))) / 2.0
        zooms = [Zoom(radius, pixels) for pixels in _LONG_ENOUGH]
        row = np.zeros_like(totals)
        for chain, closed in measure.chains(seams):
            if not closed and len(chain) == 2:
                continue
            expert = measure.Expert(engine, near, chain, closed)
            for zoom in zooms:
                zoom.click(points[expert.chain[:2]])  # no wire is live yet
            for end, second in wires_of(expert):
                notches = [zoom.click(points[expert.chain[end - 1 : end + 1]]) for zoom in zooms]
                row += np.array([1, int(second), *notches])
        totals += row
        print(
            "{:44s} {:4d} wires, the other one {:3d}, notches of zooming {}".format(path.stem, *row[:2], row[2:]),
            flush=True,
        )
    wires, others, *notches = totals.tolist()
    print(
        f"{wires} wires, the other one for {others} ({others / wires:.3f}); notches of zooming where edges can be clicked from"
    )
    for pixels, turned in zip(_LONG_ENOUGH, notches, strict=True):
        print(f"{pixels:4.0f} pixels on: {turned} ({turned / wires:.3f} a wire)")


if __name__ == "__main__":
    main()
