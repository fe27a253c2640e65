# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the tool's icon, addon/seamwire/icons/seamwire.draw.dat: ``python3 scripts/lib/make_icon.py``.

The format is that of Blender's own toolbar icons: "VCO", a zero, width and height (255), and two bytes for where it starts. Then follow the
corners of all triangles, with a byte for x and y each and y upwards, and a color of four bytes for each corner. Like theirs, it is a cube
of grey lines with what the tool does in green: a wire that runs over the cube's edge from one seed to another.
"""

from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

PATH = Path(__file__).parents[2] / "addon" / "seamwire" / "icons" / "seamwire.draw.dat"
GREY, GREEN = (229, 229, 229, 255), (117, 255, 175, 255)
LINE, WIRE, SEED, GAP = 9.0, 14.0, 17.0, 11.0

Triangles = list[tuple[NDArray[np.float64], tuple[int, int, int, int]]]


def stroke(points: NDArray[np.float64], width: float, color: tuple[int, int, int, int]) -> Triangles:
    """Return a line through points, mitred at the corners."""
    along = np.diff(points, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    sides = np.stack([-along[:, 1], along[:, 0]], axis=1)
    joint = np.concatenate([sides[:1], sides[:-1] + sides[1:], sides[-1:]])
    joint /= np.linalg.norm(joint, axis=1, keepdims=True)
    # A mitre is longer than half the width, the more so the sharper the corner.
    length = 0.5 * width / np.concatenate([[1.0], np.einsum("ij,ij->i", joint[1:-1], sides[1:]), [1.0]])
    left, right = points + joint * length[:, None], points - joint * length[:, None]
    found: Triangles = []
    for i in range(len(points) - 1):
        found.append((np.array([left[i], right[i], right[i + 1]]), color))
        found.append((np.array([left[i], right[i + 1], left[i + 1]]), color))
    return found


def disc(centre: NDArray[np.float64], radius: float, color: tuple[int, int, int, int]) -> Triangles:
    """Return a disc."""
    angles = np.linspace(0.0, 2.0 * np.pi, 17)
    rim = centre + radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return [(np.array([centre, rim[i], rim[i + 1]]), color) for i in range(16)]


def away_from(line: NDArray[np.float64], wire: NDArray[np.float64], gap: float) -> list[NDArray[np.float64]]:
    """Cut a line where it comes near the wire, so that the two can be told apart at the size of a toolbar."""
    steps = np.concatenate([np.linspace(a, b, 60, endpoint=False) for a, b in pairwise(line)])
    steps = np.concatenate([steps, line[-1:]])
    free = np.linalg.norm(steps[:, None] - wire[None], axis=2).min(axis=1) > gap
    parts, begin = [], None
    for i, is_free in enumerate([*free.tolist(), False]):
        if is_free and begin is None:
            begin = i
        elif not is_free and begin is not None:
            # Corners of the line within the part keep their places; all else between its ends is straight.
            corners = [j for j in range(begin + 1, i - 1) if j % 60 == 0]
            if i - 1 > begin:
                parts.append(steps[[begin, *corners, i - 1]])
            begin = None
    return parts


def bezier(*points: tuple[float, float]) -> NDArray[np.float64]:
    """Return a cubic curve."""
    t = np.linspace(0.0, 1.0, 15)[:, None]
    a, b, c, d = map(np.array, points)
    return (1 - t) ** 3 * a + 3 * (1 - t) ** 2 * t * b + 3 * (1 - t) * t**2 * c + t**3 * d


def icon() -> Triangles:
    """Return the icon's triangles."""
    front = np.array([(52, 52), (52, 156), (156, 156), (156, 52), (52, 52), (52, 156)], dtype=float)[:-1]
    top = np.array([(52, 156), (99, 203), (203, 203), (203, 99), (156, 52)], dtype=float)
    fold = np.array([(156, 156), (203, 203)], dtype=float)
    wire = np.concatenate(
        [bezier((76, 68), (84, 118), (120, 90), (122, 156)), bezier((122, 156), (123, 178), (140, 186), (168, 186))[1:]]
    )
    found: Triangles = []
    for line in (front, top, fold):
        for part in away_from(line, wire, GAP + 0.5 * WIRE):
            found += stroke(part, LINE, GREY)
    found += stroke(wire, WIRE, GREEN)
    return found + disc(wire[0], SEED, GREEN) + disc(wire[-1], SEED, GREEN)


def main() -> None:
    """Write it."""
    triangles = icon()
    corners = np.array([corner for corner, _ in triangles]).round().clip(0, 255).astype(np.uint8)
    colors = np.array([[color] * 3 for _, color in triangles], dtype=np.uint8)
    PATH.parent.mkdir(exist_ok=True)
    PATH.write_bytes(b"VCO\x00\xff\xff\x00\x00" + corners.tobytes() + colors.tobytes())


if __name__ == "__main__":
    main()
