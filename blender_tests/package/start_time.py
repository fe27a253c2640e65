# SPDX-License-Identifier: GPL-3.0-or-later
"""What the enabled add-on adds to Blender's start: ``python start_time.py PROGRAM NAME PACKAGE [STARTS]``, arguments as in blender.py.

Starts Blender in the background, again and again, in turns with the add-on enabled and in user folders without it.
"""

import os
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

from blender import Blender


def start(blender: Blender) -> tuple[float, float]:
    """Start it and let it end; return seconds by the clock, and of the processor."""
    before, clock = os.times(), time.perf_counter()
    blender.start("--background", "--python-expr", "pass")
    after, clock = os.times(), time.perf_counter() - clock
    return clock, after.children_user + after.children_system - before.children_user - before.children_system


def main() -> None:
    """Print the medians."""
    program, name, package = Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3])
    starts = int(sys.argv[4]) if len(sys.argv) > 4 else 15
    if name.startswith("bpy-"):
        sys.exit("Blender as a Python module enables no add-on by itself")
    with tempfile.TemporaryDirectory() as folder:
        without, enabled = (Blender(program, name, Path(folder) / each) for each in ("without", "enabled"))
        enabled.install(package)
        for blender in (without, enabled):  # the first reads from the disk, and writes what Python compiled
            start(blender)
        pairs = [(start(without), start(enabled)) for _ in range(starts)]
    for i, what in enumerate(("by the clock", "of the processor")):
        off, on = ([1000.0 * pair[j][i] for pair in pairs] for j in (0, 1))
        more = median(b - a for a, b in zip(off, on, strict=True))
        print(
            f"{name}: {what}: {median(off):.0f} ms without, {median(on):.0f} ms enabled, {more:+.0f} ms (median of {starts} pairs)"
        )


if __name__ == "__main__":
    main()
