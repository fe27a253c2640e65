# SPDX-License-Identifier: GPL-3.0-or-later
"""The plots of docs/benchmarks/index.md, drawn from the tables of the other pages of that folder.

    python native/bench/summary_plots.py docs/benchmarks docs/images

Writes benchmarks-speed.svg, -exactness.svg, -clicks.svg and -blender.svg to the second folder. Needs matplotlib.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib as mpl

mpl.use("svg")
from matplotlib import pyplot as plt

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.figure import Figure

Table = list[list[str]]

METRICS = (("Euclidean", "tab:orange", "s"), ("M_min", "tab:blue", "o"), ("M_max", "tab:purple", "^"))
"""Name, color and mark of each metric."""


def main() -> None:
    """Draw all plots from the pages of the first folder into the second one."""
    pages, images = map(Path, sys.argv[1:])
    plots: dict[str, tuple[str, Callable[[str], Figure]]] = {
        "speed": ("speed.md", speed),
        "exactness": ("exactness.md", exactness),
        "clicks": ("clicks.md", clicks),
        "blender": ("blender.md", blender),
    }
    mpl.rcParams.update(
        {"svg.hashsalt": "seamwire", "font.size": 10, "axes.spines.top": False, "axes.spines.right": False}
    )
    for name, (page, draw) in plots.items():
        figure = draw((pages / page).read_text(encoding="utf-8"))
        figure.savefig(
            images / f"benchmarks-{name}.svg", metadata={"Date": None}, bbox_inches="tight", facecolor="white"
        )
        plt.close(figure)


def table(page: str, heading: str, number: int = 0) -> Table:
    """Return the rows of a table of the section with a heading. Raises ValueError if the page has no such table."""
    section = re.split(r"^#+ ", page.partition(f"# {heading}\n")[2], maxsplit=1, flags=re.MULTILINE)[0]
    found = re.findall(r"(?:^\|.*\n)+", section, flags=re.MULTILINE)
    if number >= len(found):
        raise ValueError(f"no table {number} under the heading {heading!r}")
    return [[cell.strip() for cell in line[1:-1].split("|")] for line in found[number].splitlines()[2:]]


def first_number(cell: str) -> float:
    """Return the first number of a cell. Raises ValueError if the cell has no number."""
    found = re.search(r"[\d,]*\.?\d+", cell)
    if not found:
        raise ValueError(f"no number in the cell {cell!r}")
    return float(found.group().replace(",", ""))


def speed(page: str) -> Figure:
    """Draw how many times as long another exact solver takes, over the faces, in each metric."""
    figure, axes = plt.subplots(figsize=(7, 3.2))
    rows = table(page, "In the tool's metrics")
    for metric, color, mark in METRICS:
        chosen = [row for row in rows if metric in row[0]]
        faces = [first_number(row[0].rpartition("(")[2]) for row in chosen]
        axes.loglog(faces, [float(row[3]) for row in chosen], mark, color=color, label=metric)
    axes.axhline(1, color="gray", linewidth=1)
    axes.set(xlabel="faces after embedding", ylabel="Kirsanov's time / ours", ylim=(0.8, 40))
    axes.set_yticks([1, 2, 5, 10, 20], ["1", "2", "5", "10", "20"])
    axes.set_xticks([20_000, 50_000, 100_000, 200_000], ["20,000", "50,000", "100,000", "200,000"])
    axes.minorticks_off()
    axes.legend(frameon=False, loc="center left", bbox_to_anchor=(1, 0.5))
    return figure


def exactness(page: str) -> Figure:
    """Draw the mean error of each model without a max_error and with two of them, a panel for each metric."""
    figure, panels = plt.subplots(1, 2, figsize=(9, 3.6), sharey=True, sharex=True)
    rows = table(page, "Ten models, and max_error")[::-1]
    for panel, metric, first in zip(panels, ("M_min", "M_max"), (1, 4), strict=True):
        errors = [[first_number(cell) for cell in row[first : first + 3]] for row in rows]
        for height, row in enumerate(errors):
            panel.plot([min(row), max(row)], [height, height], color="0.85", linewidth=2, zorder=0)
        for i, (label, color, mark) in enumerate(
            (("no max_error", "tab:gray", "o"), ("2 %", "tab:orange", "s"), ("1 %", "tab:blue", "D"))
        ):
            panel.plot([row[i] for row in errors], range(len(rows)), mark, color=color, label=label, markersize=6 - i)
        panel.axvline(1, color="gray", linewidth=1, linestyle=":")
        panel.set(title=metric, xlabel="mean error, %")
    panels[0].set_xlim(left=0, right=1.05 * max(first_number(row[column]) for row in rows for column in (1, 4)))
    panels[0].set_yticks(range(len(rows)), [row[0] for row in rows])
    panels[1].legend(frameon=False, loc="center left", bbox_to_anchor=(1, 0.5))
    return figure


def clicks(page: str) -> Figure:
    """Draw the presses for artists' seams as a ratio to Blender's, with intervals and the goals."""
    figure, axes = plt.subplots(figsize=(7, 3.2))
    rows = table(page, "Seams of artists", 1)
    heights = range(len(rows))[::-1]
    columns = ((4, 0.12, "tab:blue", "Blender's shortest paths"), (6, -0.12, "tab:orange", "all of Blender's tools"))
    for column, shift, color, label in columns:
        for height, row in zip(heights, rows, strict=True):
            middle, low, high = (float(number) for number in re.findall(r"\d?\.\d+", row[column]))
            axes.plot([low, high], [height + shift] * 2, color=color, linewidth=2)
            axes.plot(middle, height + shift, "o", color=color, label=f"ratio to {label}" if height == 0 else None)
    goals = [(float(row[5]), height + columns[0][1]) for height, row in zip(heights, rows, strict=True) if row[5]]
    axes.plot(
        *zip(*goals, strict=True), "|", color="black", markersize=16, markeredgewidth=2, label="goal, shortest paths"
    )
    axes.axvline(1, color="gray", linewidth=1)
    axes.set_yticks(heights, [row[0].replace(", mirrored", "").replace(", by", ",\nby") for row in rows])
    axes.set(
        xlabel="presses / Blender's presses, mirrored (95 % intervals)", xlim=(0, 1.15), ylim=(-0.5, len(rows) - 0.5)
    )
    axes.legend(frameon=False, loc="center left", bbox_to_anchor=(1, 0.5))
    return figure


def blender(page: str) -> Figure:
    """Draw the milliseconds from the tool's start to the first wire, step by step."""
    rows = [
        (row[0], [first_number(cell) for cell in row[1:5]])
        for row in table(page, "From the tool's start to the first wire")
    ]
    million = table(page, "A million triangles")[:4]
    for column, name in ((1, "along edges"), (2, "across")):
        rows.append((f"suzanne (a million), {name}", [first_number(row[column]) for row in million]))
    figure, axes = plt.subplots(figsize=(8, 3.6))
    left = [0.0] * len(rows)
    steps = ("reading", "beginning", "until ready for a seed", "from the click to the first wire")
    for step, (label, color) in enumerate(zip(steps, ("tab:red", "tab:orange", "0.75", "tab:blue"), strict=True)):
        widths = [times[step] for _, times in rows]
        hatch = "//" if step < 2 else None
        axes.barh(range(len(rows)), widths, left=left, color=color, label=label, hatch=hatch, edgecolor="white")
        left = [a + b for a, b in zip(left, widths, strict=True)]
    axes.set_yticks(range(len(rows)), [name for name, _ in rows])
    axes.invert_yaxis()
    axes.set(xlabel="milliseconds on the clock; hatched: the interface stops")
    axes.legend(frameon=False, loc="upper right")
    return figure


if __name__ == "__main__":
    main()
