# SPDX-License-Identifier: GPL-3.0-or-later
"""Seam length beside stretch and visibility, of the results that auto_seams.py --json wrote.

    python native/bench/auto_seams_plot.py RESULTS.json PLOT.svg

A small mark is a model, a large one the median of a method. The lower left corner is best. Needs matplotlib.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

mpl.use("svg")
from matplotlib import pyplot as plt

SHOWN = {
    "ours": ("ours, default", "black", "o"),
    "artist": ("artist's seams, our map", "tab:green", "s"),
    "optcuts": ("OptCuts, E_d 4.1", "tab:blue", "^"),
    "xatlas": ("xatlas", "tab:orange", "D"),
    "before": ("before", "tab:red", "v"),
    "smart": ("Smart UV Project", "tab:gray", "P"),
}
"""Label, color and mark of each method that is drawn."""
ISOMETRY = 4.0
MOST_EXCESS = 100.0
"""Energies farther above an isometry's are drawn at the upper edge."""


def main() -> None:
    """Draw the results of the first file into the second one."""
    results, file = map(Path, sys.argv[1:])
    rows = json.loads(results.read_text())
    figure, panels = plt.subplots(1, 2, figsize=(11, 4.6), sharex=True)
    for method, (label, color, mark) in SHOWN.items():
        chosen = [row for row in rows if row["method"] == method and row["visibility"] is not None]
        if not chosen:
            continue
        for panel, heights in zip(panels, (excess(chosen), [row["visibility"] for row in chosen]), strict=True):
            lengths = [row["seam"] for row in chosen]
            panel.plot(lengths, heights, mark, color=color, alpha=0.35, markersize=4, markeredgewidth=0)
            panel.plot(np.median(lengths), np.median(heights), mark, color=color, markersize=11, label=label)
    panels[0].set(xscale="log", yscale="log", ylabel="E_d above an isometry's")
    panels[1].set(ylabel="visibility; 1: as the whole surface", ylim=(0, None))
    for panel in panels:
        panel.set_xlabel("seam length / square root of the area")
        panel.grid(alpha=0.3)
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=6, frameon=False)
    figure.tight_layout(rect=(0, 0.08, 1, 1))
    figure.savefig(file)


def excess(rows: list[dict[str, Any]]) -> list[float]:
    """Return how far above an isometry's the energies are, at most MOST_EXCESS."""
    return [min(row["energy"] - ISOMETRY, MOST_EXCESS) for row in rows]


if __name__ == "__main__":
    main()
