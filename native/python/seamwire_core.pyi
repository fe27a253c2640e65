# SPDX-License-Identifier: GPL-3.0-or-later
"""Anisotropic geodesics and live wires on triangle meshes.

The method is that of Zhuang, Zou, Carr, Ju, "Anisotropic geodesics for live-wire mesh segmentation" (2014).

Points are in the caller's coordinates. Lengths and curvatures are those of the model scaled to the unit cube (Section 3 of the paper),
unless the name says otherwise. Arrays that a result hands out are read-only views of its memory.

Wrong input raises ValueError, and the message names the element. Long functions release the GIL and take `progress`, a function of the
fraction done. If it returns False, the function raises Cancelled. When the interpreter exits, long functions on other threads stop and
raise SystemExit.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

Pick = int | tuple[int, int]
"""A vertex, or an edge by its two vertices."""
SurfacePoint = int | tuple[int, ArrayLike]
"""A vertex, or a triangle and three barycentric coordinates in it."""
Progress = Callable[[float], bool | None]

class Cancelled(RuntimeError): ...  # noqa: N818

class SurfaceReport:
    """Unusual parts of a surface's input. The surface works in spite of them."""

    nonmanifold_edges: NDArray[np.int32]  # (k, 2)
    unorientable_edges: NDArray[np.int32]  # (k, 2)
    flipped_faces: NDArray[np.int32]
    zero_area_faces: NDArray[np.int32]  # lower than 1e-9 of their longest side
    low_faces: NDArray[np.int32]  # lower than 2^-22 of the unit cube, including zero-area faces
    degenerate_faces: NDArray[np.int32]
    duplicate_faces: NDArray[np.int32]
    isolated_vertices: NDArray[np.int32]
    boundary_edges: int
    components: int

class Surface:
    """A triangle mesh in any condition: points (n, 3), triangles (m, 3), real edges (e, 2) or None for every edge of a triangle."""

    def __init__(
        self,
        points: ArrayLike,
        triangles: ArrayLike,
        edges: ArrayLike | None = None,
        progress: Progress | None = None,
    ) -> None: ...
    points: NDArray[np.float64]
    triangles: NDArray[np.int32]
    edges: NDArray[np.int32]
    scale: float  # caller's coordinates * scale fit the unit cube
    report: SurfaceReport

class Curvature:
    k1: NDArray[np.float64]
    k2: NDArray[np.float64]
    d1: NDArray[np.float64]  # (n, 3)
    d2: NDArray[np.float64]
    normals: NDArray[np.float64]
    difference: NDArray[np.float64]  # s of eq. 5

class Metric:
    normals: NDArray[np.float64]  # (n, 3)
    tensors: NDArray[np.float64]  # (n, 3, 3)
    max_anisotropy: float
    def ellipses(self, of: Literal["norm", "reach"] = "norm") -> NDArray[np.float64]:
        """Return the semi-axes at each vertex, (n, 2, 3), the longer one first: as in Figures 3 and 6, or how far length 1 reaches."""

class Scribble:
    """A stroke on a surface. Each point is in the triangle of `faces` or at the vertex of `vertices`; -1 in one refers to the other."""

    def __init__(
        self,
        points: ArrayLike,
        faces: ArrayLike | None = None,
        vertices: ArrayLike | None = None,
        eta: float = 20.0,
        rings: int = 10,
        radius: float | None = None,
        attracts: bool = True,
        acts_on: Literal["both", "min", "max", "concave", "euclidean"] = "both",
    ) -> None: ...
    points: NDArray[np.float64]
    faces: NDArray[np.int32]
    vertices: NDArray[np.int32]
    eta: float
    rings: int
    radius: float | None
    attracts: bool
    acts_on: Literal["both", "min", "max", "concave", "euclidean"]

class Embedding:
    points: NDArray[np.float64]
    triangles: NDArray[np.int32]
    edges: NDArray[np.int32]  # (e, 2)
    lengths: NDArray[np.float64]  # (e,)
    source_face: NDArray[np.int32]
    invalid_before: int
    faces_added: int
    invalid_left: int
    hole_faces: NDArray[np.int32]  # the surface's triangles that have holes
    clamped_edges: int  # edges with another length than the metric's
    repaired_faces: NDArray[np.int32]  # the surface's triangles with such edges
    worst_clamp: float
    hit_cap: bool
    unreachable: NDArray[np.int32]
    estimated_error: float | None  # of distances, on average (None if max_error was 0)
    unmet: int | None  # triangles that miss the max_error (None if it was 0)
    largest_deviation: float | None  # eta: distances are within a factor of e^eta (None if max_error was 0)
    mean_edge_length: float  # of the surface, in the metric
    def with_lengths(self, lengths: ArrayLike) -> Embedding:
        """Return the same triangles with other lengths of `edges`, (e,)."""

class Wire:
    from_vertex: int
    to_vertex: int
    points: NDArray[np.float64]  # (p, 3)
    faces: NDArray[np.int32]  # (p - 1,)
    length: float
    euclidean_length: float

class ClosedWire:
    points: NDArray[np.float64]  # the first and the last one are the seed
    faces: NDArray[np.int32]
    length: float
    euclidean_length: float
    separates: bool  # False if it runs around or through a handle
    turn: float  # at the seed, in radians; 0 if the cut is smooth there

class BentWires:
    def through(
        self, second: int | tuple[int, ArrayLike], progress: Progress | None = None
    ) -> tuple[Wire, Wire] | None:
        """Return the cut through a second point as well, from the seed there and back, or None if no cut leads there."""

class DistanceField:
    seed: int  # -1 for several seeds, or a seed that is not a vertex
    is_exact: bool
    radius: float  # larger distances are inf
    distances: NDArray[np.float64]  # (n,) at the caller's vertices
    def trace(self, vertex: int, progress: Progress | None = None) -> Wire: ...
    def trace_many(
        self, vertices: ArrayLike, progress: Progress | None = None
    ) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.float64]]:
        """Return the points of all paths, (p, 3), where each begins, (k + 1,), and their lengths, (k,)."""
    def distance(self, face: int, barycentric: ArrayLike, progress: Progress | None = None) -> float:
        """Return the distance of a point of a face, as exact as the field. barycentric is (3,), 0 or more, with the sum 1."""
    def trace_to(self, face: int, barycentric: ArrayLike, progress: Progress | None = None) -> Wire:
        """Return the shortest path to such a point."""
    def closed_wires(self, count: int = 3, progress: Progress | None = None) -> list[ClosedWire]:
        """Return the closed cuts through the seed that the surface suggests, at most `count`, best first."""
    def bend(self, cut: ClosedWire, progress: Progress | None = None) -> BentWires:
        """Prepare a closed cut, so that it can be bent to a second point."""

class EdgeChain:
    vertices: NDArray[np.int32]
    length: float

class EdgeWires:
    def trace(self, target: Pick) -> EdgeChain: ...

class LiveCandidate:
    follow: Literal["min", "max", "concave", "euclidean"]
    metric: MetricSpec
    points: NDArray[np.float64]
    faces: NDArray[np.int32]
    vertices: NDArray[np.int32]  # the edges that the wire would mark
    length: float
    solved: bool  # the shortest in the embedding of the whole surface, or along edges
    final: bool  # False while it is still being computed

class LiveEmbedding:
    invalid_left: int  # triangles; wires lead around them
    hit_cap: bool
    clamped_edges: int
    worst_clamp: float

class LiveLoop:
    vertices: NDArray[np.int32]  # without repeating the first; empty if there is no chain, or not yet
    length: float
    final: bool

class LivePiece:
    points: NDArray[np.float64]
    faces: NDArray[np.int32]
    vertices: NDArray[np.int32]  # the edges that it snaps to

class LiveClosedWire:
    pieces: list[LivePiece]  # from the point around to it
    joints: list[int | tuple[int, tuple[float, float, float]]]  # where one piece ends and the next begins
    separates: bool
    turn: float
    length: float
    id: tuple[int, int]  # of the metric and of the cut in it, for bent_wire

class LiveClosedWires:
    cuts: list[LiveClosedWire]  # best first; empty if the surface suggests no cut, or not yet
    final: bool

class EdgeLoop:
    vertices: NDArray[np.int32]  # in order; a closed loop does not repeat its first vertex
    closed: bool

class FittedChain:
    vertices: NDArray[np.int32]  # in the line's order; empty if no edge fits
    places: NDArray[np.float64]  # where on the line: i + x is the fraction x of the way from point i to the next

class LiveWires:
    wires: tuple[LiveCandidate, ...]
    active: int
    settled: bool
    solved: bool
    final: bool

class LiveWire:
    @overload
    def __init__(
        self,
        surface: Surface,
        gamma: float | None = None,
        max_anisotropy: float | None = None,
        clamp_percentile: float | None = None,
        along: Literal["surface", "edges"] = "surface",
        turning: float = 3.0,
        loop_turning: float | None = None,
        metric: Literal["feature", "campen", "pottmann_kovacs", "concave", "euclidean"] = "feature",
        max_error: float = 0.01,
    ) -> None:
        """Start preparing metrics. Defaults: gamma = 0.1 across the surface, max_anisotropy = 10 with clamp_percentile = 99 along edges."""
    @overload
    def __init__(
        self,
        points: ArrayLike,
        triangles: ArrayLike,
        edges: ArrayLike | None = None,
        *,
        gamma: float | None = None,
        max_anisotropy: float | None = None,
        clamp_percentile: float | None = None,
        along: Literal["surface", "edges"] = "surface",
        turning: float = 3.0,
        loop_turning: float | None = None,
        metric: Literal["feature", "campen", "pottmann_kovacs", "concave", "euclidean"] = "feature",
        max_error: float = 0.01,
    ) -> None:
        """Copy the arrays, return at once and build the surface in the background. If that fails, the other methods raise the error."""
    surface: Surface | None  # None until it is built
    def wait_for_surface(self, seconds: float | None = None) -> bool:
        """Wait until the surface is built, and return whether it is. Any thread may wait."""
    def fork(self) -> LiveWire:
        """Return another live wire with the same metrics and no seed. `set_metric` of one does not change the other."""
    def sibling(
        self,
        *,
        gamma: float | None = None,
        max_anisotropy: float | None = None,
        clamp_percentile: float | None = None,
        along: Literal["surface", "edges"] = "surface",
        turning: float = 3.0,
        loop_turning: float | None = None,
        metric: Literal["feature", "campen", "pottmann_kovacs", "concave", "euclidean"] = "feature",
        max_error: float = 0.01,
    ) -> LiveWire:
        """Return another live wire on the same surface, with its own metrics, no strokes and no seed."""
    def set_metric(
        self,
        metric: Literal["feature", "campen", "pottmann_kovacs", "concave", "euclidean"] = "feature",
        max_anisotropy: float | None = None,
        gamma: float | None = None,
        clamp_percentile: float | None = None,
    ) -> None:
        """Change the metric in the background, and start from the seed again. Until then, wires are the former ones and not final."""
    def set_scribbles(self, scribbles: Sequence[Scribble]) -> None:
        """Replace the strokes, as `set_metric`, which keeps them. If a stroke is not on the surface, later calls raise ValueError."""
    def seed(self, pick: Pick | SurfacePoint, forward: bool = False) -> None:
        """Start wires from a pick and return at once."""
    def wires(self, target: Pick | SurfacePoint) -> LiveWires:
        """Return the wires to a target, as far as they are computed. Work goes on for the newest target: ask again until they are final."""
    def loop(self, edge: tuple[int, int]) -> LiveLoop:
        """Return the closed chain through an edge. Found in the background: call again until the answer is final."""
    def closed_wires(self, through: int | tuple[int, ArrayLike]) -> LiveClosedWires:
        """Return at most three closed cuts through a point, found as `loop` is."""
    def bent_wire(
        self, through: int | tuple[int, ArrayLike], second: int | tuple[int, ArrayLike], cut: tuple[int, int] = (0, 0)
    ) -> LiveClosedWires:
        """Bend one of these cuts to a second point, as `closed_wires` finds them."""
    def extend_straight(self, edge: tuple[int, int], stops: Iterable[int] = ()) -> EdgeChain:
        """Continue an edge straight, from its second vertex on. Empty before the surface is built."""
    def edge_loop(self, edge: tuple[int, int], stops: Iterable[int] = ()) -> EdgeLoop:
        """Find the edge loop through an edge, as modelers select it. Empty before the surface is built."""
    def fit_chain(
        self, points: ArrayLike, faces: ArrayLike, begin: int | None = None, end: int | None = None
    ) -> FittedChain:
        """Find the chain that fits a line, as the function `fit_chain`. Empty before the surface is built."""
    def embeddings(self) -> tuple[LiveEmbedding | None, ...]:
        """Return summaries of the embeddings; None for one that is not prepared, and along edges."""
    def feature_strength(self) -> NDArray[np.float64] | None:
        """Return s of eq. 5 at each vertex, or None while it is being computed."""
    def progress(self) -> float:
        """Return the fraction of the preparation and the seed's work that is done."""
    def wait(self, seconds: float | None = None) -> bool:
        """Wait for all running work, including loops, and return whether it is done."""

class MetricFamily:
    """A family of metrics, and the parameters of its metrics."""

    name: Literal["feature", "campen", "pottmann_kovacs", "concave", "euclidean"]
    parameter: str | None
    least_parameter: float
    has_directions: bool
    has_clamp: bool

def metric_families() -> tuple[MetricFamily, ...]:
    """Return the families of metrics."""

class MetricSpec:
    """A metric as a value: what it takes to compute it on any surface."""

    def __init__(
        self,
        family: Literal["feature", "campen", "pottmann_kovacs", "concave", "euclidean"],
        follow: Literal["min", "max"] | None = None,
        *,
        parameter: float | None = None,
        max_anisotropy: float | None = None,
        clamp_percentile: float | None = None,
    ) -> None: ...
    family: Literal["feature", "campen", "pottmann_kovacs", "concave", "euclidean"]
    follow: Literal["min", "max"] | None
    kind: Literal["min", "max", "concave", "euclidean"]  # what paths follow
    parameter: float | None
    max_anisotropy: float | None
    clamp_percentile: float | None
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...

def make_metric(surface: Surface, spec: MetricSpec, progress: Progress | None = None) -> Metric:
    """Make the metric that a spec describes. Curvatures are kept with the surface."""

def principal_curvatures(surface: Surface, progress: Progress | None = None) -> Curvature: ...
def feature_metric(
    surface: Surface,
    curvature: Curvature,
    follow: Literal["min", "max"] = "min",
    gamma: float | None = None,
    max_anisotropy: float | None = None,
    clamp_percentile: float | None = None,
    progress: Progress | None = None,
) -> Metric:
    """Make the metric of the paper, eq. 5. Without gamma and max_anisotropy, gamma is 0.1."""

def campen_metric(
    surface: Surface,
    curvature: Curvature,
    follow: Literal["min", "max"] = "min",
    alpha: float | None = None,
    max_anisotropy: float | None = None,
    progress: Progress | None = None,
) -> Metric: ...
def smoothed_curvatures(
    surface: Surface, curvature: Curvature, radius: float = 0.01, progress: Progress | None = None
) -> Curvature: ...
def concave_metric(
    surface: Surface, curvature: Curvature, strength: float = 1.0, progress: Progress | None = None
) -> Metric: ...
def pottmann_kovacs_metric(
    surface: Surface,
    curvature: Curvature,
    follow: Literal["min", "max"] = "min",
    beta: float | None = None,
    max_anisotropy: float | None = None,
    progress: Progress | None = None,
) -> Metric: ...
def euclidean_metric(surface: Surface, curvature: Curvature, progress: Progress | None = None) -> Metric: ...
def apply_scribbles(
    surface: Surface,
    metric: Metric,
    scribbles: Sequence[Scribble],
    follow: Literal["min", "max", "concave", "euclidean"] | None = None,
    progress: Progress | None = None,
) -> Metric: ...
def embed(
    surface: Surface,
    metric: Metric,
    sigma: float = 0.0,
    perimeter: Literal["metric", "euclidean"] = "metric",
    max_faces_added: int = 4_000_000,
    max_error: float = 0.0,
    progress: Progress | None = None,
) -> Embedding:
    """Subdivide until triangles are valid and, if max_error is above 0, resolve the metric about that well."""

def distance_field(
    embedding: Embedding,
    seed: SurfacePoint | Sequence[SurfacePoint],
    progress: Progress | None = None,
    windows: int | None = None,
    targets: SurfacePoint | Sequence[SurfacePoint] | None = None,
    max_distance: float | None = None,
) -> DistanceField:
    """Compute distances from the nearest of several seeds. Stop when the targets' distances are known, or at max_distance."""

def invalid_faces(surface: Surface, metric: Metric) -> NDArray[np.int32]:
    """Find the triangles that are invalid in a metric before any subdivision."""

def metric_lengths(surface: Surface, metric: Metric) -> NDArray[np.float64]:
    """Compute the lengths of a surface's edges in a metric, (e,), before any subdivision."""

def isolines(
    surface: Surface, values: ArrayLike, levels: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int32]]:
    """Find the segments (k, 2, 3) where values at the vertices reach levels, with the triangle and the level of each."""

class CrestLines:
    """Ridges and valleys. Line i has the points starts[i] to starts[i + 1]. A closed line repeats its first point."""

    points: NDArray[np.float64]  # (p, 3)
    edges: NDArray[np.int32]  # (p, 2), the edge that each point lies on
    parts: NDArray[np.float64]  # (p,), position on it, 0 to 1
    curvatures: NDArray[np.float64]  # (p,), above 0 along ridges
    faces: NDArray[np.int32]  # (p,), the triangle to the next point, -1 for a line's last
    starts: NDArray[np.int32]  # (k + 1,)
    strengths: NDArray[np.float64]  # (k,), integrals of |k1|, radians, descending

def crest_lines(
    surface: Surface,
    curvature: Curvature,
    least_strength: float = 1.0,
    least_drop: float = 0.15,
    progress: Progress | None = None,
) -> CrestLines:
    """Find the curves across which the surface bends most sharply (Yoshizawa, Belyaev, Seidel 2005)."""

def plane_section(
    surface: Surface, from_point: SurfacePoint, to_point: SurfacePoint, direction: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.int32], float]:
    """Find the curve (p, 3) between two points in the plane along a direction, with its triangles and its length."""

def snap_to_edges(surface: Surface, wire: Wire, progress: Progress | None = None) -> NDArray[np.int32]: ...
def edge_wires(
    surface: Surface,
    metric: Metric,
    seed: Pick,
    turning: float = 3.0,
    forward: bool = False,
    progress: Progress | None = None,
) -> EdgeWires: ...
def shortest_cycle(
    surface: Surface,
    metric: Metric,
    edge: Sequence[int],
    turning: float = 20.0,
    progress: Progress | None = None,
) -> EdgeChain: ...
def fit_chain(
    surface: Surface,
    points: ArrayLike,
    faces: ArrayLike,
    begin: int | None = None,
    end: int | None = None,
    progress: Progress | None = None,
) -> FittedChain:
    """Find the chain of edges that fits a line drawn on a surface best."""

class RayTree:
    """Finds the first triangle that a ray meets. A tree is built in the background; answers are the same without it."""

    def __init__(self, points: ArrayLike, triangles: ArrayLike) -> None: ...
    def first_hit(self, origin: ArrayLike, direction: ArrayLike) -> tuple[int, float] | None:
        """Return the triangle's number, and its distance in lengths of `direction`. None if the ray meets no triangle."""
    ready: bool
    def wait(self) -> None: ...

class NearestPoints:
    """Finds the nearest points of triangles."""

    def __init__(self, points: ArrayLike, triangles: ArrayLike, progress: Progress | None = None) -> None: ...
    def find(
        self, places: ArrayLike, normals: ArrayLike | None = None, progress: Progress | None = None
    ) -> tuple[NDArray[np.int32], NDArray[np.float64], NDArray[np.float64]]:
        """Return the nearest triangle for each place, (k,), the point there, (k, 3), and its distance, (k,)."""

def cut_polygons(
    points: ArrayLike, corners: ArrayLike, sizes: ArrayLike
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Cut triangles and quads into triangles, as Blender does. Return the triangles, and the polygon of each."""

def face_segments(surface: Surface, cut_edges: ArrayLike) -> NDArray[np.int32]:
    """Find the segment of each triangle. Segment 0 has the most triangles."""

def missing_cuts(surface: Surface, cut_edges: ArrayLike, segments: ArrayLike) -> NDArray[np.int32]:
    """Count how many more cuts each segment needs to become a disc."""

class Flattening:
    """A UV map of a surface: `uvs`, (m, 3, 2), in the points' unit, and the island of each triangle, (m,)."""

    uvs: NDArray[np.float64]
    islands: NDArray[np.int32]
    energy: float  # as in MapReport
    island_energies: NDArray[np.float64]  # symmetric Dirichlet energy of each island, 4 for an isometry
    island_areas: NDArray[np.float64]
    overlapping: NDArray[np.int32]  # islands
    straight: NDArray[np.int32]  # islands that were laid out straight
    opened: NDArray[np.int32]  # edges opened in addition to the cuts, for each island
    steps: NDArray[np.int32]  # Newton steps, for each island

class MapReport:
    """The distortion, flips and overlaps of a UV map."""

    energy: float  # symmetric Dirichlet energy at the best uniform scale, 4 for an isometry
    energies: NDArray[np.float64]  # of each triangle
    flipped: NDArray[np.int32]  # triangles
    overlapping: NDArray[np.int32]  # islands that cover themselves
    colliding: NDArray[np.int32]  # islands that cover each other

def flatten(
    points: ArrayLike,
    triangles: ArrayLike,
    cuts: ArrayLike = (),
    *,
    start: ArrayLike | None = None,
    keep_apart: bool = True,
    straighten: float | None = None,
    up: ArrayLike | None = None,
    edges: ArrayLike | None = None,
    progress: Progress | None = None,
) -> Flattening:
    """Map each island of a surface to the plane, without flips and with as little stretch as possible."""

def measure_map(
    points: ArrayLike,
    triangles: ArrayLike,
    uvs: ArrayLike,
    islands: ArrayLike | None = None,
    *,
    edges: ArrayLike | None = None,
    progress: Progress | None = None,
) -> MapReport:
    """Measure the stretch of any UV map, its flipped triangles and its overlapping islands."""

class PlannedWire:
    """One wire of a plan: the vertices between which it runs, its metric, the edges that it marks, and its curve, (p, 3)."""

    seeds: tuple[int, int]
    follow: Literal["min", "max"]
    vertices: NDArray[np.int32]
    points: NDArray[np.float64]
    faces: NDArray[np.int32]

class SeamPlan:
    """Seams that cut a surface into islands: `islands`, (m,), has the island of each triangle."""

    wires: list[PlannedWire]
    islands: NDArray[np.int32]
    island_count: int
    not_discs: int
    cost: float
    energy: float
    is_reached: bool
    steps: float
    uvs: NDArray[np.float64] | None

class CutCurve:
    """A curve to be cut into a mesh."""

    def __init__(
        self,
        points: ArrayLike,
        start: SurfacePoint,
        end: SurfacePoint | None = None,
        faces: ArrayLike | None = None,
        image_of: int | None = None,
    ) -> None: ...

class CutPlan:
    """The changes to a mesh that cut curves into it."""

    vertices: NDArray[np.int32]
    weights: NDArray[np.float64]
    polygons: NDArray[np.int32]
    splits: list[tuple[tuple[int, int], list[int]]]
    along: NDArray[np.int32]
    across: list[tuple[int, NDArray[np.int32], bool]]
    left_out: list[tuple[int, int]]
    def node_at(self, corners: Sequence[int], barycentric: Sequence[float]) -> int | None:
        """Find the node at a point of a triangle."""

def plan_cuts(points: ArrayLike, triangles: ArrayLike, polygons: ArrayLike, curves: Sequence[CutCurve]) -> CutPlan:
    """Plan how to cut curves into polygons."""

class Parts:
    """The parts of a surface."""

    of_face: NDArray[np.int32]
    count: int
    borders: list[NDArray[np.int32]]

class PartFinder:
    """Finds the parts that an artist would make islands of."""

    def __init__(
        self,
        surface: Surface,
        *,
        mirror: Literal[0, 1, 2] | None = None,
        marked: ArrayLike | None = None,
        seams: ArrayLike | None = None,
        progress: Progress | None = None,
    ) -> None: ...
    def find(
        self,
        amount: float = 0.5,
        *,
        kept: ArrayLike | None = None,
        dropped: ArrayLike | None = None,
        parted: ArrayLike | None = None,
        progress: Progress | None = None,
    ) -> Parts:
        """Find the parts."""

class SeamPlanner:
    """Plans few, short, and hidden seams whose map stays within a bound on distortion."""

    def __init__(
        self,
        surface: Surface,
        *,
        along: Literal["surface", "edges"] = "surface",
        max_anisotropy: float = 20.0,
        clamp_percentile: float = 99.0,
        front: ArrayLike | None = None,
        mirror: Literal[0, 1, 2] | None = None,
        weights: ArrayLike | None = None,
        seams: ArrayLike | None = None,
        progress: Progress | None = None,
    ) -> None: ...
    def plan(
        self,
        *,
        distortion: float = 4.2,
        islands: int = 0,
        steps: int = 0,
        progress: Progress | None = None,
    ) -> SeamPlan:
        """Plan seams."""

    best_so_far: SeamPlan | None
