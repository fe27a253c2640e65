# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the library's arrays lie in memory."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

# Prints how many megabytes the system is asked to give in large pages: "hg" among the flags of a mapping.
SCRIPT = """
import re
import numpy as np
import seamwire_core as sw

def asked():
    maps = open("/proc/self/smaps").read().split("VmFlags:")
    sizes = [int(re.findall(r"^Size: +([0-9]+) kB", part, re.M)[-1]) for part in maps[:-1]]
    return sum(size for size, part in zip(sizes, maps[1:]) if " hg" in part.split("\\n")[0]) / 1024

n = 400
x, y = np.meshgrid(np.arange(n, dtype=float), np.arange(n, dtype=float))
points = np.stack([x.ravel(), y.ravel(), np.zeros(n * n)], axis=1)
i = np.arange(n * n).reshape(n, n)
a, b, c, d = (part.ravel() for part in (i[:-1, :-1], i[:-1, 1:], i[1:, 1:], i[1:, :-1]))
triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]).astype(np.int32)
before = asked()
surface = sw.Surface(points, triangles)
embedding = sw.embed(surface, sw.euclidean_metric(surface, sw.principal_curvatures(surface)), max_error=0)
field = sw.distance_field(embedding, 0, max_distance=0.0)
print(before, asked())
"""


@pytest.mark.skipif(
    not sys.platform.startswith("linux") or not Path("/sys/kernel/mm/transparent_hugepage").exists(),
    reason="the system has no large pages",
)
def test_large_arrays_ask_for_large_pages() -> None:
    ran = subprocess.run([sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=True, timeout=120)
    before, after = map(float, ran.stdout.split())
    # The half-edges of the solver's own mesh alone are 61 MB.
    assert after - before > 60.0
