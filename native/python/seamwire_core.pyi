# SPDX-License-Identifier: GPL-3.0-or-later
"""Anisotropic geodesics and live wires on triangle meshes.

After Zhuang, Zou, Carr, Ju, "Anisotropic geodesics for live-wire mesh segmentation" (2014).

Lengths and curvatures are of the model scaled to the unit cube (Section 3 of the paper) unless the name says otherwise; points are in
the caller's coordinates. Wrong input raises ValueError with the numbers of the elements; an index out of range too. Long functions release
the GIL and take `progress`, called now and then with the fraction done; returning False cancels, and Cancelled is raised.
When the interpreter exits, long functions that other threads are in are told to stop and raise SystemExit. Arrays that a
result hands out are read-only views of its memory.
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
    """What was odd about the input; nothing here is an error."""

    nonmanifold_edges: NDArray[np.int32]  # (k, 2)
    unorientable_edges: NDArray[np.int32]  # (k, 2)
    flipped_faces: NDArray[np.int32]
    zero_area_faces: NDArray[np.int32]  # lower than 1e-9 of their longest side
    low_faces: NDArray[np.int32]  # lower than 2^-22 of the unit cube, those among them
    degenerate_faces: NDArray[np.int32]
    duplicate_faces: NDArray[np.int32]
    isolated_vertices: NDArray[np.int32]
    boundary_edges: int
    components: int

class Surface:
    """A triangle mesh as people have it: points (n, 3), triangles (m, 3), real edges (e, 2) or None for every edge of a triangle."""

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
        """Return (n, 2, 3), the semi-axes at each vertex, the longer one first: as in Figures 3 and 6, or how far length 1 reaches."""

class Scribble:
    """A stroke on a surface, its points each in the triangle of `faces` or at the vertex of `vertices` (-1: see the other)."""

    def __init__(
        self,
        points: ArrayLike,
        faces: ArrayLike | None = None,
        vertices: ArrayLike | None = None,
        eta: float = 20.0,
        rings: int = 10,
        radius: float | None = None,
        attracts: bool = True,
        acts_on: Literal["both", "min", "max", "concave"] = "both",
    ) -> None: ...
    points: NDArray[np.float64]
    faces: NDArray[np.int32]
    vertices: NDArray[np.int32]
    eta: float
    rings: int
    radius: float | None
    attracts: bool
    acts_on: Literal["both", "min", "max", "concave"]

class Embedding:
    points: NDArray[np.float64]
    triangles: NDArray[np.int32]
    edges: NDArray[np.int32]  # (e, 2)
    lengths: NDArray[np.float64]  # (e,)
    source_face: NDArray[np.int32]
    invalid_before: int
    faces_added: int
    invalid_left: int
    hole_faces: NDArray[np.int32]  # the surface's triangles in which some stayed invalid
    clamped_edges: int
    repaired_faces: NDArray[np.int32]  # those with such an edge
    worst_clamp: float
    hit_cap: bool
    unreachable: NDArray[np.int32]
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
    separates: bool  # False: it runs around or through a handle
    turn: float  # at the seed, radians: 0 where it runs smoothly through it

class BentWires:
    def through(
        self, second: int | tuple[int, ArrayLike], progress: Progress | None = None
    ) -> tuple[Wire, Wire] | None:
        """Return the cut through a second point as well, from the seed there and back; None where none leads there."""

class DistanceField:
    seed: int  # -1: several, or a point that is no vertex
    is_exact: bool
    radius: float  # distances beyond it are inf
    distances: NDArray[np.float64]  # (n,) at the caller's vertices
    def trace(self, vertex: int, progress: Progress | None = None) -> Wire: ...
    def trace_many(
        self, vertices: ArrayLike, progress: Progress | None = None
    ) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.float64]]:
        """Return the points of all paths, (p, 3), where each begins, (k + 1,), and their lengths, (k,)."""
    def distance(self, face: int, barycentric: ArrayLike, progress: Progress | None = None) -> float:
        """Return the exact distance of a point of a face; barycentric is (3,), 0 or more, its sum 1."""
    def trace_to(self, face: int, barycentric: ArrayLike, progress: Progress | None = None) -> Wire:
        """Return the shortest path to such a point."""
    def closed_wires(self, count: int = 3, progress: Progress | None = None) -> list[ClosedWire]:
        """Return the closed cuts through the seed that the surface suggests, at most `count`, best first; empty: none."""
    def bend(self, cut: ClosedWire, progress: Progress | None = None) -> BentWires:
        """Return what bends one of them to a second point."""

class EdgeChain:
    vertices: NDArray[np.int32]
    length: float

class EdgeWires:
    def trace(self, target: Pick) -> EdgeChain: ...

class LiveCandidate:
    follow: Literal["min", "max", "concave"]
    points: NDArray[np.float64]
    faces: NDArray[np.int32]
    vertices: NDArray[np.int32]  # the edges that would be marked
    length: float
    final: bool  # False: still being computed; what is here, if anything, will be replaced

class LiveEmbedding:
    invalid_left: int  # triangles that wires lead around
    hit_cap: bool
    clamped_edges: int
    worst_clamp: float

class LiveLoop:
    vertices: NDArray[np.int32]  # the first one not given twice; empty: none, or not yet
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
    which: int  # what bent_wire calls it

class LiveClosedWires:
    cuts: list[LiveClosedWire]  # best first; empty: nothing suggests one, or not yet
    final: bool

class EdgeLoop:
    vertices: NDArray[np.int32]  # in order; where it is closed, the first one is not given twice
    closed: bool

class FittedChain:
    vertices: NDArray[np.int32]  # in the line's order; empty: no edge fits
    places: NDArray[np.float64]  # where on the line each is: i + x, the part x of the way from point i to the next

class LiveWires:
    wires: tuple[LiveCandidate, ...]
    active: int
    settled: bool
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
    ) -> None:
        """Neither gamma nor max_anisotropy: gamma = 0.1 across the surface, max_anisotropy = 10 and clamp_percentile = 99 along edges."""
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
    ) -> None:
        """Copy the arrays, return at once and build the surface in the background; what that raises, the other methods raise."""
    surface: Surface | None  # None until it is built
    def wait_for_surface(self, seconds: float | None = None) -> bool:
        """Return whether it is built; any thread may wait."""
    def fork(self) -> LiveWire:
        """Another with the same metrics, those still being computed too, and no seed; metrics set later are each one's own."""
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
    ) -> LiveWire:
        """Another on the same surface, which is built once; metrics of its own, no strokes, no seed."""
    def set_metric(
        self,
        metric: Literal["feature", "campen", "pottmann_kovacs", "concave", "euclidean"] = "feature",
        max_anisotropy: float | None = None,
        gamma: float | None = None,
        clamp_percentile: float | None = None,
    ) -> None:
        """In the background, and seeds again; until then wires are the former ones, and not final."""
    def set_scribbles(self, scribbles: Sequence[Scribble]) -> None:
        """Instead of those before; as set_metric, which keeps them. One that is off the surface: ValueError at the next call."""
    def seed(self, pick: Pick | SurfacePoint, forward: bool = False) -> None: ...
    def wires(self, target: Pick | SurfacePoint) -> LiveWires: ...
    def loop(self, edge: tuple[int, int]) -> LiveLoop:
        """In the background, the newest edge asked for; ask again until the answer is final. A seed goes first."""
    def closed_wires(self, through: int | tuple[int, ArrayLike]) -> LiveClosedWires:
        """As `loop`, the closed cuts through a point of the surface, at most three."""
    def bent_wire(
        self, through: int | tuple[int, ArrayLike], second: int | tuple[int, ArrayLike], which: int = 0
    ) -> LiveClosedWires:
        """As `closed_wires`, one of these cuts bent to a second point."""
    def extend_straight(self, edge: tuple[int, int], stops: Iterable[int] = ()) -> EdgeChain:
        """Return the straightest way on, from the edge's second vertex; its length is that in the unit cube. No vertices: not ready."""
    def edge_loop(self, edge: tuple[int, int], stops: Iterable[int] = ()) -> EdgeLoop:
        """Return the edge loop through an edge, as modellers select it, up to poles, boundaries and stops. No vertices: not ready."""
    def fit_chain(
        self, points: ArrayLike, faces: ArrayLike, begin: int | None = None, end: int | None = None
    ) -> FittedChain:
        """As the function, along edges only. No vertices: none fit, or not ready."""
    def embeddings(self) -> tuple[LiveEmbedding | None, ...]:
        """Return what became of them across the surface; None where one is not prepared, and along edges."""
    def feature_strength(self) -> NDArray[np.float64] | None:
        """Return s of eq. 5 per vertex, None while it is computed."""
    def progress(self) -> float:
        """Of the preparation and the seed's work."""
    def wait(self, seconds: float | None = None) -> bool:
        """For all running work, loops too."""

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
    """Eq. 5. Neither gamma nor max_anisotropy: gamma = 0.1."""

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
    follow: Literal["min", "max"] | None = None,
    progress: Progress | None = None,
) -> Metric: ...
def embed(
    surface: Surface,
    metric: Metric,
    sigma: float = 0.0,
    perimeter: Literal["metric", "euclidean"] = "metric",
    max_faces_added: int = 4_000_000,
    progress: Progress | None = None,
) -> Embedding: ...
def distance_field(
    embedding: Embedding,
    seed: SurfacePoint | Sequence[SurfacePoint],
    progress: Progress | None = None,
    windows: int | None = None,
    targets: SurfacePoint | Sequence[SurfacePoint] | None = None,
    max_distance: float | None = None,
) -> DistanceField:
    """Of several seeds the nearest one counts. Stops when the targets' distances are known, or at max_distance."""

def invalid_faces(surface: Surface, metric: Metric) -> NDArray[np.int32]:
    """Return the triangles that are invalid in a metric before any bisection."""

def metric_lengths(surface: Surface, metric: Metric) -> NDArray[np.float64]:
    """Return the lengths of a surface's edges in a metric, (e,), before any bisection."""

def isolines(
    surface: Surface, values: ArrayLike, levels: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int32]]:
    """Return segments (k, 2, 3) where values at the vertices, (n,), reach levels, with the triangle and the level of each."""

class CrestLines:
    """Ridges and valleys: line i has the points starts[i] to starts[i + 1]; a closed one ends with its first point."""

    points: NDArray[np.float64]  # (p, 3)
    edges: NDArray[np.int32]  # (p, 2), the edge that each point lies on
    parts: NDArray[np.float64]  # (p,), where on it, 0 to 1
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
    """Return the curves along which the surface bends most sharply across (Yoshizawa, Belyaev, Seidel 2005)."""

def plane_section(
    surface: Surface, from_point: SurfacePoint, to_point: SurfacePoint, direction: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.int32], float]:
    """Return the curve (p, 3) in the plane through two points and along a direction, the triangles it crosses, its length."""

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
    """Return the chain of edges that fits a line drawn on a surface best, from its beginning to its end, or to where edges end."""

class RayTree:
    """Finds the first triangle that a ray meets; the tree is built on a thread, with the same answers before it is there."""

    def __init__(self, points: ArrayLike, triangles: ArrayLike) -> None: ...
    def first_hit(self, origin: ArrayLike, direction: ArrayLike) -> tuple[int, float] | None:
        """Return the triangle's number and how far away it is, in lengths of `direction`; None: there is none."""
    ready: bool
    def wait(self) -> None: ...

def cut_polygons(
    points: ArrayLike, corners: ArrayLike, sizes: ArrayLike
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return the triangles of triangles and quads, cut as Blender cuts them, and the polygon of each."""

def face_segments(surface: Surface, cut_edges: ArrayLike) -> NDArray[np.int32]:
    """Return a segment number per triangle, 0 the one of the most triangles."""

def missing_cuts(surface: Surface, cut_edges: ArrayLike, segments: ArrayLike) -> NDArray[np.int32]:
    """Return how many more cuts each segment needs to become a disc."""

class Flattening:
    """A UV map of a surface: `uvs`, (m, 3, 2), in the points' unit, and the island of each triangle, (m,)."""

    uvs: NDArray[np.float64]
    islands: NDArray[np.int32]
    energy: float  # as in MapReport
    island_energies: NDArray[np.float64]  # symmetric Dirichlet energy of each island, 4 for an isometry
    island_areas: NDArray[np.float64]
    overlapping: NDArray[np.int32]  # islands
    opened: NDArray[np.int32]  # edges opened in addition to the cuts, for each island
    steps: NDArray[np.int32]  # Newton steps, for each island

class MapReport:
    """What a UV map does to a surface."""

    energy: float  # symmetric Dirichlet energy at the best uniform scale, 4 for an isometry
    energies: NDArray[np.float64]  # of each triangle
    flipped: NDArray[np.int32]  # triangles
    overlapping: NDArray[np.int32]  # islands

def flatten(
    points: ArrayLike,
    triangles: ArrayLike,
    cuts: ArrayLike = (),
    *,
    start: ArrayLike | None = None,
    keep_apart: bool = True,
    progress: Progress | None = None,
) -> Flattening:
    """Map each island of a surface to the plane, without flips and with as little stretch as possible."""

def measure_map(points: ArrayLike, triangles: ArrayLike, uvs: ArrayLike, islands: ArrayLike | None = None) -> MapReport:
    """Measure the stretch of any UV map, its flipped triangles and its overlapping islands."""

class PlannedWire:
    """One wire of a plan: the vertices between which it runs, its metric, the edges that it marks, and its curve, (p, 3)."""

    seeds: tuple[int, int]
    follow: Literal["min", "max"]
    vertices: NDArray[np.int32]
    points: NDArray[np.float64]

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
        parts: bool = False,
        steps: int = 0,
        progress: Progress | None = None,
    ) -> SeamPlan:
        """Plan seams."""

    best_so_far: SeamPlan | None
