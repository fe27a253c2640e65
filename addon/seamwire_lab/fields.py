# SPDX-License-Identifier: GPL-3.0-or-later
"""What a metric sees of a mesh, as arrays: strengths, concavity, silhouettes, ellipses, distances, paths, invalid triangles.

Functions of the library compute all of it. This module knows neither Blender nor the tool.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import ModuleType

    import seamwire_core
    from numpy.typing import NDArray

Part = Literal["STRENGTH", "CONCAVITY", "SILHOUETTE", "ELLIPSES", "DISTANCE", "PATHS", "ISOLINES", "INVALID"]
"""The fields that can be computed."""
Source = int | tuple[int, tuple[float, float, float]] | tuple[int, ...]
"""Where distances are from: a vertex, a point of a triangle, or several vertices."""

PATHS = 300
"""The number of traced paths. On the meshes of the paper they lie as close as in its figures."""
BANDS = 20
"""The approximate number of distance bands."""
ELLIPSES = 1500
"""The largest number of ellipses."""
_RADIUS, _LONGEST = 0.33, 1.5
"""The mean radius of an ellipse, and the most that its longer semi-axis may have, in distances to the next ellipse."""


@dataclass(frozen=True)
class FieldRequest:
    """The fields to compute, and their metric.

    Parameters
    ----------
    parts
        The names of the fields.
    metric, strength, clamp
        As the tool's settings.
    kind
        Which of the library's metrics, see ``MetricSpec``.
    source
        Where distances are from. Without a source, no distances are computed.
    strokes
        The library's scribbles.
    """

    parts: frozenset[Part]
    metric: str = "feature"
    strength: float = 20.0
    clamp: float = 99.0
    kind: Literal["min", "max", "concave", "euclidean"] = "min"
    source: Source | None = None
    strokes: tuple[object, ...] = ()

    @property
    def metric_key(self) -> tuple[object, ...]:
        """Everything that the metric depends on."""
        return self.metric, self.strength, self.clamp, self.kind, self.strokes


@dataclass(frozen=True)
class Ellipses:
    """The norms at some vertices, see ``Metric.ellipses``.

    Parameters
    ----------
    centres, normals
        (k, 3).
    axes
        (k, 2, 3) the semi-axes, the longer first. They show how far a path of a given length leads.
    anisotropy
        (k,)
    spacing
        The approximate distance between centers.
    """

    centres: NDArray[np.float64]
    normals: NDArray[np.float64]
    axes: NDArray[np.float64]
    anisotropy: NDArray[np.float64]
    spacing: float


@dataclass(frozen=True)
class Paths:
    """Shortest paths. Path i has the points from starts[i] to starts[i + 1]."""

    points: NDArray[np.float64]
    starts: NDArray[np.int32]
    lengths: NDArray[np.float64]

    def segments(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the straight pieces of all paths, (s, 2, 3), and for each piece the length of its path, (s,)."""
        owner = np.repeat(np.arange(len(self.lengths)), np.diff(self.starts))
        same = owner[:-1] == owner[1:]
        return np.stack([self.points[:-1], self.points[1:]], axis=1)[same], self.lengths[owner[:-1]][same]


@dataclass(frozen=True)
class Isolines:
    """Distance bands: the segments of their borders, (k, 2, 3), and their width."""

    segments: NDArray[np.float64]
    spacing: float


@dataclass(frozen=True)
class Invalid:
    """The triangles that fail the triangle inequality, grouped by their repair.

    Parameters
    ----------
    split
        Triangles that bisection alone has made valid.
    repaired
        Triangles with an edge whose length was changed.
    left
        Triangles with a part that stays invalid, which is a hole.
    edges
        (e, 2, 3) the edges of all parts of bisected triangles. Neighbors of invalid triangles are bisected too.
    before, added
        The number of invalid triangles, and the number of added triangles.
    """

    split: NDArray[np.int32]
    repaired: NDArray[np.int32]
    left: NDArray[np.int32]
    edges: NDArray[np.float64]
    before: int
    added: int


@dataclass(frozen=True, eq=False)
class Silhouette:
    """The curves across faces where a smooth surface turns away from a viewer. Its normals are interpolated from the vertices.

    Parameters
    ----------
    core
        The library's module.
    surface
        The surface.
    points, normals
        (n, 3) each, those of its vertices.
    """

    core: ModuleType
    surface: seamwire_core.Surface
    points: NDArray[np.float64]
    normals: NDArray[np.float64]

    def seen_from(self, eye: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the straight pieces, (k, 2, 3), seen from an eye, (4,): x, y, z and 1, or the direction to it and 0."""
        towards = eye[:3] - eye[3] * self.points
        facing = np.einsum("ij,ij->i", self.normals, towards)
        return self.core.isolines(self.surface, facing, [0.0])[0]


@dataclass(frozen=True)
class Fields:
    """The results for a request. A field is None if it was not requested or has no source."""

    request: FieldRequest
    strength: NDArray[np.float64] | None = None
    concavity: NDArray[np.float64] | None = None
    silhouette: Silhouette | None = None
    ellipses: Ellipses | None = None
    distance: NDArray[np.float64] | None = None
    paths: Paths | None = None
    isolines: Isolines | None = None
    invalid: Invalid | None = None


def spread(points: NDArray[np.float64], count: int) -> tuple[NDArray[np.int64], float]:
    """Return at most `count` points that are spread over all, and the side of the cubes that hold one point each.

    Parameters
    ----------
    points
        (n, 3).
    count
        1 or more.

    Returns
    -------
    chosen : (k,) array
        Their numbers, ascending: in each cube of a regular grid that has points, that nearest to its middle.
    side : float
        0 where all are chosen.
    """
    if len(points) <= count:
        return np.arange(len(points)), 0.0
    low, size = points.min(axis=0), float(np.ptp(points, axis=0).max())
    if size == 0.0:
        return np.zeros(1, dtype=np.int64), 0.0
    small, large, best = 0.0, 2.0 * size, None
    # A surface has about (size / side)^2 cubes; halving finds the least side that has few enough.
    for _ in range(24):
        side = 0.5 * (small + large)
        cells = np.floor((points - low) / side).astype(np.int64)
        keys = (cells[:, 0] * 2_097_152 + cells[:, 1]) * 2_097_152 + cells[:, 2]
        if len(np.unique(keys)) > count:
            small = side
            continue
        large, best = side, (side, cells, keys)
        if large - small < 0.02 * large:
            break
    assert best is not None
    side, cells, keys = best
    off = np.linalg.norm(points - low - (cells + 0.5) * side, axis=1)
    order = np.lexsort((off, keys))
    _, first = np.unique(keys[order], return_index=True)
    return np.sort(order[first]), side


def band_levels(largest: float, bands: int = BANDS) -> NDArray[np.float64]:
    """Return levels at a round distance from each other (1, 2 or 5 times a power of ten), about `bands` of them, below the largest."""
    if not largest > 0.0:
        return np.zeros(0)
    wish = largest / bands
    power = 10.0 ** np.floor(np.log10(wish))
    step = power * min((1.0, 2.0, 5.0, 10.0), key=lambda factor: abs(np.log(factor * power / wish)))
    return step * np.arange(1, int(np.floor(largest / step)) + 1)


def at_vertices(lines: seamwire_core.CrestLines, count: int) -> NDArray[np.float64]:
    """Return for each of so many vertices the strength of the strongest ridge beside it, or minus that of a valley, or 0."""
    values = np.zeros(count)
    is_ridge = lines.curvatures[lines.starts[:-1]] > 0.0
    signed = np.repeat(np.where(is_ridge, lines.strengths, -lines.strengths), np.diff(lines.starts))
    vertices = lines.edges[np.arange(len(lines.edges)), np.round(lines.t).astype(np.int64)]
    # The library returns the strongest lines first, so they are written last.
    values[vertices[::-1]] = signed[::-1]
    return values


class FieldMaker:
    """Computes fields of one mesh, with shared parts computed once.

    Parameters
    ----------
    core
        The library's module.
    surface
        Returns the surface. It may wait.
    goes_on
        Returns False to end a running computation with the library's ``Cancelled``.
    """

    def __init__(
        self,
        core: ModuleType,
        surface: Callable[[], seamwire_core.Surface],
        goes_on: Callable[[], bool] = lambda: True,
    ) -> None:
        self._core = core
        self._make_surface = surface
        self._goes_on = goes_on
        self._kept: dict[str, tuple[object, object]] = {}

    def _go_on(self, _fraction: float) -> bool:
        return self._goes_on()

    def _once(self, name: str, key: object, make: Callable[[], object]) -> object:
        if name not in self._kept or self._kept[name][0] != key:
            self._kept[name] = key, make()
        return self._kept[name][1]

    def make(self, request: FieldRequest) -> Fields:
        """Compute fields now.

        Raises
        ------
        ValueError
            If wires cannot run on the mesh.
        seamwire_core.Cancelled
            If `goes_on` says so.
        """
        parts = request.parts
        far = bool(parts & {"DISTANCE", "PATHS", "ISOLINES"}) and request.source is not None
        return Fields(
            request,
            strength=self._strength() if "STRENGTH" in parts else None,
            concavity=self._concavity() if "CONCAVITY" in parts else None,
            silhouette=self._silhouette() if "SILHOUETTE" in parts else None,
            ellipses=self._ellipses(request) if "ELLIPSES" in parts else None,
            distance=self._distance(request) if far else None,
            paths=self._paths(request) if far and "PATHS" in parts else None,
            isolines=self._isolines(request) if far and "ISOLINES" in parts else None,
            invalid=self._invalid(request) if "INVALID" in parts else None,
        )

    def surface(self) -> seamwire_core.Surface:
        """Return the surface."""
        return self._once("surface", None, self._make_surface)

    def _curvature(self) -> seamwire_core.Curvature:
        return self._once("curvature", None, lambda: self._core.principal_curvatures(self.surface(), self._go_on))

    def _smoothed(self) -> seamwire_core.Curvature:
        def make() -> seamwire_core.Curvature:
            return self._core.smoothed_curvatures(self.surface(), self._curvature(), progress=self._go_on)

        return self._once("smoothed", None, make)

    # The same arrays each time, so that what is drawn of them stays.

    def _strength(self) -> NDArray[np.float64]:
        return self._once("strength", None, lambda: self._curvature().difference)

    def _concavity(self) -> NDArray[np.float64]:
        return self._once("concavity", None, lambda: self._smoothed().k1)

    def crests_at_vertices(self) -> NDArray[np.float64]:
        """Return for each vertex the strength of the strongest ridge beside it, or minus that of the strongest valley, or 0."""
        surface = self.surface()
        lines = self._core.crest_lines(surface, self._smoothed(), progress=self._go_on)
        return at_vertices(lines, len(surface.points))

    def _silhouette(self) -> Silhouette:
        def make() -> Silhouette:
            surface = self.surface()
            return Silhouette(self._core, surface, surface.points, self._curvature().normals)

        return self._once("silhouette", None, make)

    def _distance(self, request: FieldRequest) -> NDArray[np.float64]:
        return self._once("distance", (request.metric_key, request.source), lambda: self._field(request).distances)

    def metric(self, request: FieldRequest) -> seamwire_core.Metric:
        """Return the metric that wires are short in, as the library's live wires have it."""

        def make() -> seamwire_core.Metric:
            plain = self._plain_metric(request)
            if not request.strokes:
                return plain
            strokes = list(request.strokes)
            return self._core.apply_scribbles(self.surface(), plain, strokes, request.kind, progress=self._go_on)

        return self._once("metric", request.metric_key, make)

    def _plain_metric(self, request: FieldRequest) -> seamwire_core.Metric:
        """Return the metric without strokes."""
        return self._core.make_metric(self.surface(), self._spec(request), progress=self._go_on)

    def _spec(self, request: FieldRequest) -> seamwire_core.MetricSpec:
        if request.kind == "euclidean":
            return self._core.MetricSpec("euclidean")
        if request.kind == "concave":
            return self._core.MetricSpec("concave", max_anisotropy=request.strength)
        clamp = request.clamp if request.metric == "feature" else None
        return self._core.MetricSpec(
            request.metric, request.kind, max_anisotropy=request.strength, clamp_percentile=clamp
        )

    def embedding(self, request: FieldRequest) -> seamwire_core.Embedding:
        """Return the surface embedded in that metric."""
        metric = self.metric(request)
        return self._once(
            "embedding",
            request.metric_key,
            lambda: self._core.embed(self.surface(), metric, progress=self._go_on, max_error=0),
        )

    def _field(self, request: FieldRequest) -> seamwire_core.DistanceField:
        source = request.source
        seeds = list(source) if isinstance(source, tuple) and not isinstance(source[1], tuple) else source
        embedding = self.embedding(request)
        return self._once(
            "field",
            (request.metric_key, source),
            lambda: self._core.distance_field(embedding, seeds, progress=self._go_on),
        )

    def _ellipses(self, request: FieldRequest) -> Ellipses:
        def make() -> Ellipses:
            metric, surface = self.metric(request), self.surface()
            used = np.unique(surface.triangles)
            chosen, side = spread(surface.points[used], ELLIPSES)
            chosen = used[chosen]
            axes = metric.ellipses("reach")[chosen]
            sizes = np.linalg.norm(axes, axis=2)
            some = sizes[:, 1] > 0.0
            chosen, axes, sizes = chosen[some], axes[some], sizes[some]
            centres = surface.points[chosen]
            if side == 0.0:
                # All vertices: as far apart as edges are long.
                ends = surface.points[surface.edges]
                side = float(np.median(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)))
            # A circle of the mean area fills two thirds of the way to the next one; none reaches over more than two.
            scale = (
                side * min(_RADIUS / float(np.median(np.sqrt(sizes.prod(axis=1)))), _LONGEST / float(sizes.max()))
                if len(sizes)
                else 1.0
            )
            return Ellipses(
                centres,
                metric.normals[chosen],
                axes * scale,
                sizes[:, 0] / sizes[:, 1],
                side,
            )

        return self._once("ellipses", request.metric_key, make)

    def _paths(self, request: FieldRequest) -> Paths:
        def make() -> Paths:
            used = np.unique(self.surface().triangles)
            targets = used[spread(self.surface().points[used], PATHS)[0]]
            return Paths(*self._field(request).trace_many(targets))

        return self._once("paths", (request.metric_key, request.source), make)

    def _isolines(self, request: FieldRequest) -> Isolines:
        def make() -> Isolines:
            distances = self._field(request).distances
            levels = band_levels(float(distances[np.isfinite(distances)].max(initial=0.0)))
            segments, _, _ = self._core.isolines(self.surface(), distances, levels)
            return Isolines(segments, float(levels[0]) if len(levels) else 0.0)

        return self._once("isolines", (request.metric_key, request.source), make)

    def _invalid(self, request: FieldRequest) -> Invalid:
        def make() -> Invalid:
            embedding, surface = self.embedding(request), self.surface()
            before = self._core.invalid_faces(surface, self.metric(request))
            others = np.union1d(embedding.hole_faces, embedding.repaired_faces)
            parts = np.bincount(embedding.source_face, minlength=len(surface.triangles))
            inside = embedding.triangles[parts[embedding.source_face] > 1]
            sides = np.sort(np.concatenate([inside[:, [0, 1]], inside[:, [1, 2]], inside[:, [2, 0]]]), axis=1)
            return Invalid(
                split=np.setdiff1d(before, others),
                repaired=np.setdiff1d(embedding.repaired_faces, embedding.hole_faces),
                left=embedding.hole_faces,
                edges=embedding.points[np.unique(sides, axis=0)],
                before=len(before),
                added=embedding.faces_added,
            )

        return self._once("invalid", request.metric_key, make)
