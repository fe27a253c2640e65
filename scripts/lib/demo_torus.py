# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a bumpy torus of triangles for the demo: ``demo_torus.py FILE.ply``."""

import sys
from math import cos, pi, sin
from pathlib import Path

AROUND, ACROSS = 64, 24

points = []
for i in range(AROUND):
    for j in range(ACROSS):
        u, v = 2 * pi * i / AROUND, 2 * pi * j / ACROSS
        tube = 0.4 * (1.0 + 0.15 * cos(5 * u))
        points.append(((1.0 + tube * cos(v)) * cos(u), (1.0 + tube * cos(v)) * sin(u), tube * sin(v)))
triangles = []
for i in range(AROUND):
    for j in range(ACROSS):
        after, beside = (i + 1) % AROUND * ACROSS, (j + 1) % ACROSS
        a, b, c, d = i * ACROSS + j, after + j, after + beside, i * ACROSS + beside
        triangles += [(a, b, c), (a, c, d)]
lines = [
    "ply",
    "format ascii 1.0",
    f"element vertex {len(points)}",
    *(f"property float {axis}" for axis in "xyz"),
    f"element face {len(triangles)}",
    "property list uchar int vertex_indices",
    "end_header",
    *(f"{x:.6f} {y:.6f} {z:.6f}" for x, y, z in points),
    *(f"3 {a} {b} {c}" for a, b, c in triangles),
]
Path(sys.argv[1]).write_text("\n".join(lines) + "\n")
