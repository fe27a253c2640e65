# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks of wires for the paper's figures: drawn in the tool as a recording says, or suggested by the planner."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from pathlib import Path

    from figure_models import Model
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Drawn:
    """A network, and the mesh that it divides.

    Parameters
    ----------
    wires, scribbles
        Curves, (p, 3) each.
    seeds
        (k, 3).
    points, triangles
        The mesh, (n, 3) and (m, 3). It is cut along the wires if they were drawn.
    islands
        The island of each triangle, (m,).
    """

    wires: list[NDArray[np.float64]]
    scribbles: list[NDArray[np.float64]]
    seeds: NDArray[np.float64]
    points: NDArray[np.float64]
    triangles: NDArray[np.int32]
    islands: NDArray[np.int32]


def network_of(model: Model, folder: Path) -> Drawn:
    """Return the network that play_recording.py left in a folder. Without one, return a network of the planner."""
    file = folder / f"{model.name}.json"
    if not file.exists():
        print(f"   {model.name}: no drawing, so its network is one of the planner")
        return _planned(model)
    network = json.loads(file.read_text(encoding="utf-8"))
    wires = network["wires"]
    ends = [wire["curve"][end] for wire in wires if not wire["closed"] for end in (0, -1)]
    with np.load(file.with_suffix(".npz")) as mesh:
        return Drawn(
            [np.array(wire["curve"]) for wire in wires],
            [np.array(stroke["points"]) for stroke in network["strokes"]],
            np.unique(np.array(ends).reshape(-1, 3), axis=0),
            mesh["points"],
            mesh["triangles"],
            mesh["islands"],
        )


def _planned(model: Model) -> Drawn:
    plan = model.core.SeamPlanner(model.surface, along="surface").plan()
    seeds = sorted({seed for wire in plan.wires for seed in wire.seeds})
    wires = [wire.points for wire in plan.wires]
    return Drawn(wires, [], model.points[seeds], model.points, model.triangles, plan.islands)


def spread_colors(triangles: NDArray[np.int32], regions: NDArray[np.int32], count: int) -> NDArray[np.int64]:
    """Return one of `count` colors for each triangle. Regions that touch have different colors as long as there are enough."""
    corners = np.stack([triangles.ravel(), np.repeat(regions, 3)], axis=1)
    corners = np.unique(corners, axis=0)
    same = corners[1:, 0] == corners[:-1, 0]
    touching: dict[int, set[int]] = {}
    for one, other in np.stack([corners[:-1, 1], corners[1:, 1]], axis=1)[same].tolist():
        touching.setdefault(one, set()).add(other)
        touching.setdefault(other, set()).add(one)
    colors = np.zeros(int(regions.max()) + 1, dtype=np.int64)
    for region in range(len(colors)):
        taken = {int(colors[other]) for other in touching.get(region, ()) if other < region}
        colors[region] = min(set(range(count)) - taken, default=region % count)
    return colors[regions]
