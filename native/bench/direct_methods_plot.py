# SPDX-License-Identifier: GPL-3.0-or-later
"""Error over time of the methods that direct_methods_bench measured, one point a method and mesh, a panel an anisotropy.

    python native/bench/direct_methods_plot.py RESULTS.tsv PLOT.svg

Time: what is built once a metric, and a solve.
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import matplotlib as mpl

mpl.use("svg")
from matplotlib import pyplot as plt


def main() -> None:
    """Draw the results of the first file into the second one."""
    results, file = map(Path, sys.argv[1:])
    with results.open() as lines:
        rows = [row for row in csv.reader(lines, delimiter="\t") if not row[3].startswith("reference")]
    rows = [row for row in rows if not row[3].endswith("beside ours")]
    methods = list(dict.fromkeys(row[3] for row in rows))
    grays = {"ours": "0.6", "ours, 2 %": "0.45", "ours, 1 %": "0.2", "ours, 0.5 %": "0"}
    colors = {method: grays.get(method, f"C{i}") for i, method in enumerate(methods)}
    meshes = list(dict.fromkeys(row[0] for row in rows))
    anisotropies = sorted({float(row[2]) for row in rows})
    figure, panels = plt.subplots(1, len(anisotropies), figsize=(13, 4.4), sharex=True, sharey=True, squeeze=False)
    for panel, anisotropy in zip(panels[0], anisotropies, strict=True):
        for mesh, _, a, method, building, solving, mean, _ in rows:
            if float(a) == anisotropy:
                panel.loglog(
                    float(building) + float(solving),
                    float(mean),
                    "os^Dv*P"[meshes.index(mesh) % 7],
                    color=colors[method],
                    alpha=0.8,
                )
        panel.set(title=f"A = {anisotropy:g}", xlabel="milliseconds")
        panel.grid(alpha=0.3)
    panels[0][0].set_ylabel("mean error, %")
    for method, color in colors.items():
        panels[0][0].plot([], [], "o", color=color, label=method)
    for i, mesh in enumerate(meshes):
        panels[0][0].plot([], [], "os^Dv*P"[i % 7], color="black", fillstyle="none", label=Path(mesh).stem)
    figure.legend(loc="lower center", ncols=7, frameon=False)
    figure.tight_layout(rect=(0, 0.12, 1, 1))
    figure.savefig(file)


if __name__ == "__main__":
    main()
