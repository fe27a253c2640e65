# SPDX-License-Identifier: GPL-3.0-or-later
"""How near to their wires seams lie, and how much they turn: snapped to edges, and with their vertices slid onto the wires.

    python native/bench/slide.py MESH.obj...

24 wires on each mesh between random vertices (M_min, A = 20, seeds 1 to 4), one after another, each on the original mesh. Distances are
from nine points of each edge to the wire, in mean edge lengths. Turning is in radians for each mean edge length. "Off the surface" is the
largest distance of a new edge from the original surface, in mean edge lengths.
"""

from __future__ import annotations

import argparse
import itertools
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import seamwire_core as sw
from scipy.spatial import KDTree

sys.path.insert(0, str(Path(__file__).parents[2] / "docs/figures"))
sys.path.insert(0, str(Path(__file__).parents[2] / "addon"))
from figure_models import read
from seamwire.core.base.geometry import barycentric, nearest_on_segments  # these know no Blender
from seamwire.core.seams.slide_plan import SlidFaces, places, plan

if TYPE_CHECKING:
    from numpy.typing import NDArray

_FIELDS, _WIRES = 4, 6
_PARTS = np.linspace(0.0, 1.0, 9)[:, None]
_NEAREST = 12


def main() -> None:
    """Print a line a mesh."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+", type=Path)
    for path in parser.parse_args().meshes:
        points, triangles = read(path)
        sides = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        edges = np.unique(sides, axis=0)
        unit = float(np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1).mean())
        mesh = SlidFaces(points, triangles, np.arange(len(triangles)), dict(enumerate(triangles.tolist())))
        surface = sw.Surface(points, triangles, edges)
        embedding = sw.embed(surface, sw.feature_metric(surface, sw.principal_curvatures(surface)), max_error=0)
        centers = KDTree(points[triangles].mean(axis=1))
        rows, moved, chained, spent = [], 0, 0, 0.0
        for number in range(_FIELDS):
            draw = np.random.default_rng(number + 1)
            seed, *targets = draw.choice(len(points), _WIRES + 1, replace=False).tolist()
            field = sw.distance_field(embedding, seed)
            for target in targets:
                wire = field.trace(target)
                chain = sw.snap_to_edges(surface, wire)
                begun = time.perf_counter()
                moves = plan(mesh, [(chain.tolist(), wire.points)])
                spent += time.perf_counter() - begun
                slid = points.copy()
                slid[list(moves)] = places(points, moves.values())
                off = max(_off_surface(points, triangles, centers, place) for place in _along(slid[chain]))
                rows.append(
                    (
                        *_measured(points[chain], wire.points, unit),
                        *_measured(slid[chain], wire.points, unit),
                        off / unit,
                    )
                )
                moved, chained = moved + len(moves), chained + len(chain) - 2
        near, turning, near_slid, turning_slid, _ = np.mean(rows, axis=0)
        print(
            f"{path.stem:20s} distance {near:.3f} -> {near_slid:.3f} (x {near_slid / near:.2f}), turning {turning:.3f} -> "
            f"{turning_slid:.3f} (x {turning_slid / turning:.2f}); {moved / chained:.0%} of vertices moved; off the surface "
            f"{np.max(rows, axis=0)[4]:.2f}, in the mean of wires {np.mean(rows, axis=0)[4]:.2f}; {1e3 * spent / len(rows):.0f} ms",
            flush=True,
        )


def _along(chain: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.concatenate([a + _PARTS * (b - a) for a, b in itertools.pairwise(chain)])


def _measured(chain: NDArray[np.float64], curve: NDArray[np.float64], unit: float) -> tuple[float, float]:
    """Return the mean distance from a curve, and the turning, both for edges of length 1."""
    distance = np.mean([nearest_on_segments(place, curve[:-1], curve[1:])[1].min() for place in _along(chain)])
    steps = np.diff(chain, axis=0)
    lengths = np.linalg.norm(steps, axis=1)
    cosines = np.einsum("ij,ij->i", steps[1:], steps[:-1]) / np.maximum(lengths[1:] * lengths[:-1], 1e-300)
    return distance / unit, float(np.arccos(np.clip(cosines, -1.0, 1.0)).sum()) * unit / lengths.sum()


def _off_surface(
    points: NDArray[np.float64], triangles: NDArray[np.int32], centers: KDTree, place: NDArray[np.float64]
) -> float:
    corners = points[triangles[centers.query(place, _NEAREST)[1]]]
    weights, _ = barycentric(corners, place)
    return float(np.linalg.norm(np.einsum("ij,ijk->ik", weights, corners) - place, axis=1).min())


if __name__ == "__main__":
    main()
