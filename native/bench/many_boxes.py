# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams and maps of one mesh of many boxes: how long they take, and whether the map is valid.

    python native/bench/many_boxes.py [COUNT...]

The boxes have different sizes and do not touch. The program prints a row of a Markdown table for each count.
"""

from __future__ import annotations

import sys

import numpy as np
from auto_seams_report import markdown, shown
from seam_methods import map_measures, ours
from uv_maps import Frame, Model

_CORNERS = np.array([[x, y, z] for z in (-0.5, 0.5) for y in (-0.5, 0.5) for x in (-0.5, 0.5)])
_SIDES = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])


def boxes(count: int) -> Model:
    """Return boxes of different sizes on a grid in space."""
    side = int(np.ceil(count ** (1 / 3)))
    places = np.stack(np.unravel_index(np.arange(count), (side, side, side)), axis=1)
    sizes = np.random.default_rng(0).uniform(0.2, 0.9, (count, 1, 3))
    points = (_CORNERS * sizes + places[:, None]).reshape(-1, 3)
    corners = (_SIDES + 8 * np.arange(count)[:, None, None]).reshape(-1)
    return Model(f"{count} boxes", points, np.arange(0, len(corners) + 1, 4), corners, Frame())


def main() -> None:
    """Print the table."""
    rows = []
    for count in map(int, sys.argv[1:] or ["100", "1000", "3000"]):
        model = boxes(count)
        seams = ours(model, 0.5)
        found = map_measures(model, seams)
        cells = (found["energy"], seams.info["first"], seams.info["sec"])
        rows.append([str(count), *map(shown, cells), shown(found["overlapping"], 0), shown(found["flips"], 0)])
    print(markdown(["boxes", "E_d", "first s", "s", "overlap", "flips"], rows))


if __name__ == "__main__":
    main()
