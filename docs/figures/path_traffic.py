# SPDX-License-Identifier: GPL-3.0-or-later
"""Traffic of shortest paths between many pairs of vertices, and the feature lines where paths gather."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable
    from types import ModuleType

    import seamwire_core
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Paths:
    """Curves on a surface, one after the other.

    Parameters
    ----------
    points
        (p, 3).
    faces
        (p,) the triangle between each point and the next one, -1 for the last point of a path.
    """

    points: NDArray[np.float64]
    faces: NDArray[np.int32]

    def pieces(self) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
        """Return the straight pieces, (s, 2, 3), and the triangle of each, (s,)."""
        inside = np.flatnonzero(self.faces >= 0)
        return np.stack([self.points[inside], self.points[inside + 1]], axis=1), self.faces[inside]


def joined(curves: Iterable[tuple[NDArray[np.float64], NDArray[np.int32]]]) -> Paths:
    """Join curves: the points of each, (p, 3), and the triangle of each piece, (p - 1,)."""
    points, faces = [np.zeros((0, 3))], [np.zeros(0, dtype=np.int32)]
    for places, triangles in curves:
        points.append(places)
        faces.append(np.append(triangles, -1).astype(np.int32))
    return Paths(np.concatenate(points), np.concatenate(faces))


def shortest_paths(
    core: ModuleType, embedding: seamwire_core.Embedding, sources: NDArray[np.integer], targets: NDArray[np.integer]
) -> Paths:
    """Trace the exact shortest path from each source to each target that it reaches.

    Parameters
    ----------
    core
        The library's module.
    embedding
        The surface in a metric.
    sources, targets
        Numbers of vertices.
    """
    curves = []
    for source in sources.tolist():
        field = core.distance_field(embedding, source)
        for target in targets.tolist():
            if target != source and np.isfinite(field.distances[target]):
                wire = field.trace(target)
                curves.append((wire.points, wire.faces))
    return joined(curves)


def traffic(points: NDArray[np.float64], triangles: NDArray[np.int32], paths: Paths) -> NDArray[np.float64]:
    """Return the length of paths per area in the triangles around each vertex, (n,), as a multiple of the surface's mean.

    Parameters
    ----------
    points, triangles
        (n, 3) and (m, 3).
    paths
        Curves on these triangles.
    """
    ends, faces = paths.pieces()
    lengths = np.bincount(faces, np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1), len(triangles))
    areas = face_areas(points, triangles)
    passing, area = (np.bincount(triangles.ravel(), np.repeat(part, 3), len(points)) for part in (lengths, areas))
    return passing / np.maximum(area, 1e-300) * (areas.sum() / lengths.sum())


def feature_score(in_metric: NDArray[np.float64], euclidean: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compare the traffic in a metric with the Euclidean traffic between the same vertices.

    The quotient removes what every metric does: the middle of a model has more traffic than its ends. The mean traffic, 1, is added to
    the divisor, because Euclidean paths leave some places empty.
    """
    return in_metric / (1.0 + euclidean)


def face_areas(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> NDArray[np.float64]:
    """Return the areas of triangles, (m,)."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)


def vertex_areas(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> NDArray[np.float64]:
    """Return a third of the area around each vertex, (n,)."""
    return np.bincount(triangles.ravel(), np.repeat(face_areas(points, triangles) / 3.0, 3), len(points))


def highest(values: NDArray[np.float64], areas: NDArray[np.float64], share: float) -> NDArray[np.bool_]:
    """Mark the vertices with the largest values that have this share of the area together, (n,)."""
    order = np.argsort(-values, kind="stable")
    sums = np.cumsum(areas[order])
    marked = np.zeros(len(values), dtype=bool)
    marked[order[: np.searchsorted(sums, share * sums[-1]) + 1]] = True
    return marked


def part_count(edges: NDArray[np.int32], marked: NDArray[np.bool_], areas: NDArray[np.float64], share: float) -> int:
    """Count how many of the largest connected parts of marked vertices have this share of the marked area together."""
    inside = edges[marked[edges].all(axis=1)]
    part = np.arange(len(marked))
    # Both ends of an edge take the smaller number, and numbers of numbers are looked up, until nothing changes.
    while True:
        least = part.copy()
        np.minimum.at(least, part[inside].ravel(), np.repeat(part[inside].min(axis=1), 2))
        least = least[least]
        if (least == part).all():
            break
        part = least
    sizes = np.sort(np.bincount(part[marked], areas[marked], len(marked)))[::-1]
    return int(np.searchsorted(np.cumsum(sizes), (share - 1e-9) * sizes.sum())) + 1


def feature_lines(
    triangles: NDArray[np.int32], paths: Paths, strong: NDArray[np.bool_], least: float, rings: int = 2
) -> list[slice]:
    """Choose few pieces of paths that cover the strong triangles where paths gather.

    Takes the longest pieces first. Each covers the triangles around it, and later pieces lose the parts that are covered.

    Parameters
    ----------
    triangles
        (m, 3).
    paths
        Shortest paths on them.
    strong
        (m,) where lines may run.
    least
        The length of the shortest line.
    rings
        How many rings of triangles a line covers on each side.

    Returns
    -------
    lines : list of slices
        The points of each line, as parts of `paths.points`.
    """
    steps = np.zeros(len(paths.points))
    steps[:-1] = np.linalg.norm(np.diff(paths.points, axis=0), axis=1)
    sums = np.concatenate([[0.0], np.cumsum(steps)])
    begins, ends = _runs((paths.faces >= 0) & strong[paths.faces])
    lengths = sums[ends] - sums[begins]
    free, lines = np.ones(len(triangles), dtype=bool), []
    for run in np.argsort(-lengths, kind="stable").tolist():
        if lengths[run] < least:
            break
        faces = paths.faces[begins[run] : ends[run]]
        for begin, end in zip(*_runs(free[faces]), strict=True):
            first, last = begins[run] + begin, begins[run] + end
            if sums[last] - sums[first] < least:
                continue
            lines.append(slice(first, last + 1))
            near = np.zeros(int(triangles.max()) + 1, dtype=bool)
            near[triangles[faces[begin:end]]] = True
            for _ in range(rings - 1):
                near[triangles[near[triangles].any(axis=1)]] = True
            free &= ~near[triangles].any(axis=1)
    return lines


def _runs(marked: NDArray[np.bool_]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return where each run of marked elements begins, and where it ends (exclusive)."""
    changes = np.diff(np.concatenate([[False], marked, [False]]).astype(np.int8))
    return np.flatnonzero(changes > 0), np.flatnonzero(changes < 0)
