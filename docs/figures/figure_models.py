# SPDX-License-Identifier: GPL-3.0-or-later
"""Models of the paper's figures: read from files, or made; and what the library makes of them."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from pathlib import Path
    from types import ModuleType

    import seamwire_core
    from numpy.typing import NDArray

PATH_ERROR = 0.01
"""The mean error of lengths that is asked for where paths are drawn."""
UP_IS_Z = {"nefertiti"}
"""Models whose files have z up; the others' is y."""
VIEWS = {
    "rocker-arm": (-62.0, 25.0),
    "fertility": (-75.0, 12.0),
    "fandisk": (-35.0, 25.0),
    "armadillo": (-90.0, 8.0),
    "nefertiti": (-60.0, 8.0),
    "suzanne": (-72.0, 8.0),
    "sphere": (-60.0, 20.0),
}
"""From where models are seen that are known: azimuth and elevation."""


class Model:
    """A triangle mesh with what is computed of it, each once.

    Parameters
    ----------
    core
        The library's module.
    name
        The file's, without its ending.
    points, triangles
        (n, 3) and (m, 3); up is z.
    """

    def __init__(self, core: ModuleType, name: str, points: NDArray[np.float64], triangles: NDArray[np.int32]) -> None:
        self.core, self.name = core, name
        self.points, self.triangles = points, triangles
        self.view = VIEWS.get(name, (-60.0, 18.0))

    @cached_property
    def surface(self) -> seamwire_core.Surface:
        """The library's surface."""
        return self.core.Surface(self.points, self.triangles)

    @cached_property
    def curvature(self) -> seamwire_core.Curvature:
        """Its curvatures."""
        return self.core.principal_curvatures(self.surface)

    @property
    def strength(self) -> NDArray[np.float64]:
        """The feature strength s of eq. 5, (n,)."""
        return self.curvature.difference * self.size

    @property
    def size(self) -> float:
        """The longest side of its box: the side of the unit cube."""
        return 1.0 / self.surface.scale

    def metric(self, kind: str, follow: str = "min", **strength: float) -> seamwire_core.Metric:
        """Return a metric by the name of its function: feature, campen, pottmann_kovacs or euclidean."""
        function = getattr(self.core, f"{kind}_metric")
        if kind == "euclidean":
            return function(self.surface, self.curvature)
        return function(self.surface, self.curvature, follow, **strength)

    def embed(self, metric: seamwire_core.Metric, max_error: float = 0.0) -> seamwire_core.Embedding:
        """Return the paper's embedding; a `max_error` resolves the metric about that well."""
        return self.core.embed(self.surface, metric, max_error=max_error)

    def field(self, kind: str, seed: int, follow: str = "min", **strength: float) -> seamwire_core.DistanceField:
        """Return the distances from a vertex in a metric, which the embedding resolves: paths are smooth."""
        embedding = self.embed(self.metric(kind, follow, **strength), PATH_ERROR)
        return self.core.distance_field(embedding, seed)

    def vertex_at(self, x: float, y: float, z: float) -> int:
        """Return the vertex that is nearest to a place in its box, 0 to 1 along each side."""
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        return int(np.linalg.norm(self.points - (low + (high - low) * (x, y, z)), axis=1).argmin())


def read(path: Path) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Read an OBJ or OFF file; polygons are cut into fans, and up becomes z, as Blender's importers have it.

    Raises
    ------
    ValueError
        Where it is neither, or has no faces.
    """
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    if path.suffix.lower() == ".obj":
        points = [line.split()[1:4] for line in lines if line.startswith("v ")]
        polygons = [[int(part.split("/")[0]) for part in line.split()[1:]] for line in lines if line.startswith("f ")]
        polygons = [[number - 1 if number > 0 else len(points) + number for number in one] for one in polygons]
    elif path.suffix.lower() == ".off":
        words = " ".join(line.split("#")[0] for line in lines).split()[1:]
        count, faces = int(words[0]), int(words[1])
        points = np.array(words[3 : 3 + 3 * count]).reshape(-1, 3)
        at, polygons = 3 + 3 * count, []
        for _ in range(faces):
            sides = int(words[at])
            polygons.append([int(word) for word in words[at + 1 : at + 1 + sides]])
            at += 1 + sides
    else:
        raise ValueError(f"{path.name}: neither .obj nor .off")
    triangles = [(one[0], one[i], one[i + 1]) for one in polygons for i in range(1, len(one) - 1)]
    if not triangles:
        raise ValueError(f"{path.name} has no faces")
    x, y, z = np.array(points, dtype=np.float64).T
    places = (x, y, z) if path.stem.lower() in UP_IS_Z else (x, -z, y)
    return np.stack(places, axis=1), np.array(triangles, dtype=np.int32)


def sphere(rings: int = 48, jitter: float = 0.25) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Make a sphere whose vertices lie irregularly on it, as scanned and remeshed ones do: nearly umbilical, never quite.

    A grid of latitudes and longitudes, every other row turned by half a cell, with fewer cells towards the poles.
    """
    rng = np.random.default_rng(1)
    points = [(0.0, 0.0, 1.0)]
    starts, counts = [0], [1]
    for ring in range(1, rings):
        polar = np.pi * ring / rings
        count = max(6, round(2 * rings * np.sin(polar)))
        turn = 2 * np.pi * (np.arange(count) + 0.5 * (ring % 2) + rng.uniform(-jitter, jitter, count)) / count
        off = polar + rng.uniform(-jitter, jitter, count) * np.pi / rings
        starts.append(len(points))
        counts.append(count)
        points += list(zip(np.sin(off) * np.cos(turn), np.sin(off) * np.sin(turn), np.cos(off), strict=True))
    starts.append(len(points))
    counts.append(1)
    points.append((0.0, 0.0, -1.0))
    places = np.array(points)
    turns = np.arctan2(places[:, 1], places[:, 0])
    triangles: list[tuple[int, int, int]] = []
    for (first, few), (second, many) in zip(
        list(zip(starts, counts, strict=True))[:-1], list(zip(starts, counts, strict=True))[1:], strict=True
    ):
        triangles += _band(turns, first, few, second, many)
    return 0.5 * places, np.array(triangles, dtype=np.int32)


def _band(turns: NDArray[np.float64], first: int, few: int, second: int, many: int) -> list[tuple[int, int, int]]:
    """Join two rings by triangles, going around both at once, always on where less has been gone."""
    if few == 1:
        return [(first, second + i, second + (i + 1) % many) for i in range(many)]
    if many == 1:
        return [(second, first + (i + 1) % few, first + i) for i in range(few)]
    one = first + np.argsort(turns[first : first + few])
    two = second + np.argsort(turns[second : second + many])
    triangles, i, j = [], 0, 0
    while i < few or j < many:
        ahead = turns[one[i % few]] + 2 * np.pi * (i // few), turns[two[j % many]] + 2 * np.pi * (j // many)
        if j >= many or (i < few and ahead[0] <= ahead[1]):
            triangles.append((int(one[i % few]), int(two[j % many]), int(one[(i + 1) % few])))
            i += 1
        else:
            triangles.append((int(one[i % few]), int(two[j % many]), int(two[(j + 1) % many])))
            j += 1
    return triangles
