# SPDX-License-Identifier: GPL-3.0-or-later
"""Seamwire as a seam tool to be measured: given a polygon mesh, what it offers between picked edges and for a click on an edge.

Wires along edges with both metrics, the shorter one first; the settings are the tool's defaults along edges.
"""

from collections.abc import Iterable

import numpy as np
import seamwire_core as sw

MAX_ANISOTROPY = 10.0
CLAMP_PERCENTILE = 99.0
TURNING = 3.0
LOOP_TURNING = 20.0


def polygon_edges(offsets: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """List the edges (e, 2) of polygons; face f has the corners corners[offsets[f]:offsets[f + 1]]."""
    following = np.arange(1, len(corners) + 1)
    following[offsets[1:] - 1] = offsets[:-1]
    return np.unique(np.sort(np.column_stack((corners, corners[following])), axis=1), axis=0)


def fan_triangles(offsets: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Cut each polygon into triangles (m, 3) around its first corner."""
    counts = np.maximum(np.diff(offsets) - 2, 0)
    first = np.repeat(offsets[:-1], counts)
    step = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    return np.column_stack((corners[first], corners[first + step + 1], corners[first + step + 2]))


class SeamwireEngine:
    """Wires, loops and strips along the edges of one mesh, with the settings of the tool unless told otherwise."""

    def __init__(self, **settings: float) -> None:
        self.anisotropy = settings.get("anisotropy", MAX_ANISOTROPY)
        self.turning = settings.get("turning", TURNING)
        self.loop_turning = settings.get("loop_turning", LOOP_TURNING)

    def prepare(self, points: np.ndarray, offsets: np.ndarray, corners: np.ndarray) -> None:
        """Take a polygon mesh; points (n, 3), and face f has the corners corners[offsets[f]:offsets[f + 1]]."""
        edges = polygon_edges(offsets, corners)
        self.surface = sw.Surface(points, fan_triangles(offsets, corners), edges[edges[:, 0] != edges[:, 1]])
        curvature = sw.principal_curvatures(self.surface)
        self.metrics = [
            sw.feature_metric(
                self.surface,
                curvature,
                follow=follow,
                max_anisotropy=self.anisotropy,
                clamp_percentile=CLAMP_PERCENTILE,
            )
            for follow in ("min", "max")
        ]
        self.live = sw.LiveWire(self.surface, along="edges", max_anisotropy=self.anisotropy)
        self.live.wait()

    def wires(self, seed: tuple[int, int], targets: list[tuple[int, int]], forward: bool) -> list[list[list[int]]]:
        """Offer the wires from a seed edge to each target edge, the shorter first; a wire lists its vertices."""
        fields = [sw.edge_wires(self.surface, m, seed, turning=self.turning, forward=forward) for m in self.metrics]
        offered = []
        for target in targets:
            found = [chain for field in fields if (chain := field.trace(target)) is not None]
            offered.append([list(chain.vertices) for chain in sorted(found, key=lambda chain: chain.length)])
        return offered

    def loop(self, edge: tuple[int, int]) -> list[int] | None:
        """Offer the closed chain that one click on the edge takes, its first vertex not repeated."""
        chains = [sw.shortest_cycle(self.surface, m, edge, turning=self.loop_turning) for m in self.metrics]
        best = min((c for c in chains if c is not None), key=lambda chain: chain.length, default=None)
        return None if best is None else list(best.vertices)

    def strip(self, edge: tuple[int, int], stops: Iterable[int] = ()) -> tuple[list[int], bool]:
        """Offer the straight strip through the edge up to stops: its vertices, and whether it is closed."""
        found = self.live.edge_loop(edge, np.fromiter(stops, dtype=np.int32))
        return list(found.vertices), found.closed
