# SPDX-License-Identifier: GPL-3.0-or-later
# Made by scripts/lib/python_stub.py.
"""Anisotropic geodesics and live wires on triangle meshes.

The method is that of Zhuang, Zou, Carr, Ju, "Anisotropic geodesics for live-wire mesh segmentation" (2014).

Points and lengths are in the caller's unit, and curvatures in 1 / that unit. Arrays that a result hands out are read-only views of its memory.

Wrong input raises ValueError, and the message names the element. Long functions release the GIL and take `progress`, a
function of the fraction done. If it returns False, the function raises Cancelled. When the interpreter exits, long
functions on other threads stop and raise SystemExit.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from os import PathLike
from typing import Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

class Cancelled(RuntimeError): ...

class SurfaceReport:
    """Unusual parts of a surface's input. The surface works in spite of them."""

    nonmanifold_edges: NDArray[np.int32]
    """(k, 2) int32: edges with three or more faces. Wires cross them; curvature and islands end there."""
    unorientable_edges: NDArray[np.int32]
    """(k, 2) int32: edges whose faces cannot be oriented alike. Wires cross them; curvature and islands end there."""
    flipped_faces: NDArray[np.int32]
    """(k,) int32: faces that were turned over to agree with their neighbors."""
    zero_area_faces: NDArray[np.int32]
    """(k,) int32: faces lower than 1e-9 of their longest side. They are kept, but embeddings remove them or leave holes."""
    low_faces: NDArray[np.int32]
    """(k,) int32: faces lower than 2^-22 of the unit cube, including those without area. They are kept, but normals and curvature ignore them."""
    degenerate_faces: NDArray[np.int32]
    """(k,) int32: faces with two equal corners. They are left out; their edges stay."""
    duplicate_faces: NDArray[np.int32]
    """(k,) int32: faces with the three vertices of an earlier face. They are left out."""
    isolated_vertices: NDArray[np.int32]
    """(k,) int32: vertices in no face and no edge."""
    boundary_edges: int
    """int: how many edges have one face."""
    components: int
    """int: how many parts edges connect. Isolated vertices do not count."""

class Surface:
    """A triangle mesh in any condition.

    A surface may have boundaries, several components, isolated vertices, zero-area and duplicate faces, mixed orientation,
    and edges with three or more faces. `report` lists them. Vertices and faces keep the caller's numbers.

    Parameters
    ----------
    points : (n, 3) array_like of float
        Finite coordinates.
    triangles : (m, 3) array_like of int
        Vertex numbers, of any integer type.
    edges : (e, 2) array_like of int, optional
        The real edges, if the triangles come from polygons, and edges without a face. None: every edge of a triangle.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Raises
    ------
    ValueError
        If an array has the wrong shape or type, or there is no edge. Also if a coordinate is not finite, a vertex number is out
        of range, or an edge joins a vertex to itself. The message names the element. Also if the longest side of the
        bounding box is below 1e-150, but not 0.
    Cancelled
    """

    def __init__(
        self,
        points: ArrayLike,
        triangles: ArrayLike,
        edges: ArrayLike | None = None,
        progress: Callable[[float], bool | None] | None = None,
    ) -> None: ...
    points: NDArray[np.float64]
    """(n, 3) float64: as given."""
    triangles: NDArray[np.int32]
    """(m, 3) int32: as given."""
    edges: NDArray[np.int32]
    """(e, 2) int32: the real edges, each once, sorted. The smaller vertex comes first."""
    scale: float
    """float: the caller's coordinates times this number fit the unit cube."""
    report: SurfaceReport
    """SurfaceReport: unusual parts of the input."""

class FileError: ...

class PolygonMesh:
    """Points and polygons, as a mesh file has them.

    Parameters
    ----------
    points : (n, 3) array_like of float
    corners : (c,) array_like of int
        Vertices, polygon by polygon.
    sizes : (p,) array_like of int
        How many corners each polygon has, at least 3.
    colors : (n, 3) array_like of float, optional
        Red, green and blue of each vertex, in [0, 1].

    Raises
    ------
    ValueError
        If an array has the wrong shape or type, a vertex is out of range, a size is less than 3, or the sizes do not add up to
        the number of corners. Also if there are colors for another number of points.
    """

    def __init__(
        self,
        points: ArrayLike,
        corners: ArrayLike,
        sizes: ArrayLike,
        colors: ArrayLike | None = None,
    ) -> None: ...
    points: NDArray[np.float64]
    """(n, 3) float64: coordinates."""
    corners: NDArray[np.int32]
    """(c,) int32: vertices, polygon by polygon."""
    sizes: NDArray[np.int32]
    """(p,) int32: how many corners each polygon has."""
    colors: NDArray[np.float64] | None
    """(n, 3) float64 or None: red, green and blue of each vertex, in [0, 1]."""
    def surface(self, progress: Callable[[float], bool | None] | None = None) -> Surface:
        """Build the surface of the mesh.

        Its triangles are those of `triangulate`, and its edges those of the polygons, without diagonals.

        Parameters
        ----------
        progress : callable, optional
            Called repeatedly with the fraction done. Returning False cancels.

        Returns
        -------
        Surface

        Raises
        ------
        ValueError
            If `Surface` rejects the mesh.
        Cancelled
        """

def read_mesh(path: str | PathLike[str]) -> PolygonMesh:
    """Read a mesh from an OBJ, PLY, STL or OFF file.

    The ending of its name tells the format. Coordinates have the precision of the file. The locale does not matter. Texture
    coordinates, normals, materials, groups and lines are ignored. Corners of STL files with the same coordinates become one vertex.

    Parameters
    ----------
    path : str or path-like

    Returns
    -------
    PolygonMesh
        With the colors of vertices if an OBJ, PLY or COFF file has them, as they are in the file.

    Raises
    ------
    FileError
        If the file cannot be opened, has another format, or breaks the rules of its format. The message names the line, or in
        binary files the element.
    """

def write_mesh(path: str | PathLike[str], mesh: PolygonMesh) -> None:
    """Write a mesh to an OBJ, PLY, STL or OFF file.

    The ending of its name tells the format. PLY and STL files are binary. STL files have triangles in single precision and no
    colors. All others have double precision. Colors in PLY files have 8 bits. An existing file is replaced once the new one is
    complete.

    Parameters
    ----------
    path : str or path-like
    mesh : PolygonMesh

    Raises
    ------
    FileError
        If the format is unknown, or the file cannot be written.
    ValueError
        If a point is not finite, or too large for single precision in an STL file.
    """

def write_lines(path: str | PathLike[str], lines: Sequence[ArrayLike]) -> None:
    """Write polylines, such as the points of wires, to an OBJ file.

    Parameters
    ----------
    path : str or path-like
        Its name ends in .obj.
    lines : sequence of (k, 3) array_like of float
        The points of each line.

    Raises
    ------
    FileError
        If the name has another ending, or the file cannot be written.
    ValueError
        If the points of a line have the wrong shape or type.
    """

def triangulate(points: ArrayLike, corners: ArrayLike, sizes: ArrayLike) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Cut polygons into triangles.

    Quads are cut as in Blender: from the first corner to the third, unless one of the two triangles would lie on the other, or have no area.
    Larger polygons may have dents.

    Parameters
    ----------
    points : (n, 3) array_like of float
    corners : (c,) array_like of int
        Vertices, polygon by polygon.
    sizes : (p,) array_like of int
        How many corners each polygon has, at least 3.

    Returns
    -------
    triangles : (m, 3) int32
        In the order and the orientation of the polygons.
    polygons : (m,) int32
        The polygon of each triangle.

    Raises
    ------
    ValueError
        If a size is less than 3, the sizes do not add up to the number of corners, or a vertex is out of range.
    """

class Curvature:
    """Principal curvatures at the vertices of a surface.

    k1 and k2 are in 1 / unit of the points: 0.5 on a sphere of radius 2. Vertices without a usable face have
    curvature 0.
    """

    k1: NDArray[np.float64]
    """(n,) float64: the curvature with the larger absolute value."""
    k2: NDArray[np.float64]
    """(n,) float64: the curvature with the smaller absolute value."""
    d1: NDArray[np.float64]
    """(n, 3) float64: the unit tangent direction of k1."""
    d2: NDArray[np.float64]
    """(n, 3) float64: the unit tangent direction of k2."""
    normals: NDArray[np.float64]
    """(n, 3) float64: unit normals."""
    difference: NDArray[np.float64]
    """(n,) float64: |k1| - |k2|. Times the longest side of the box, it is s of eq. 5."""

def principal_curvatures(surface: Surface, progress: Callable[[float], bool | None] | None = None) -> Curvature:
    """Compute the principal curvatures at the vertices of a surface.

    Parameters
    ----------
    surface : Surface
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    Curvature

    Raises
    ------
    Cancelled

    References
    ----------
    Rusinkiewicz, "Estimating Curvatures and Their Derivatives on Triangle Meshes" (2004). Normals are weighted as in Max,
    "Weights for Computing Vertex Normals from Facet Normals" (1999).
    """

def smoothed_curvatures(
    surface: Surface,
    curvature: Curvature,
    radius: float = 0.01,
    progress: Callable[[float], bool | None] | None = None,
) -> Curvature:
    """Average curvatures over a radius, by averaging their tensors over 1-rings repeatedly.

    Parameters
    ----------
    surface : Surface
    curvature : Curvature
        Of that surface.
    radius : float
        Above 0, as a share of the longest side of the box around the surface. It is met approximately.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    Curvature

    Raises
    ------
    ValueError
        If the curvature belongs to another surface, or the radius is not positive.
    Cancelled
    """

class Metric:
    """An anisotropic metric: a tensor on the tangent plane of each vertex.

    Functions such as `feature_metric` make one. The constructor takes your own tensors.

    Parameters
    ----------
    normals : (n, 3) array_like of float
        Unit normals, such as `Curvature.normals`. Zero at vertices without a face.
    tensors : (n, 3, 3) array_like of float
        Symmetric tensors, which map the normal to zero. A tangent vector x at a vertex has the
        length sqrt(x tensor x).

    Raises
    ------
    ValueError
        If a shape is wrong, or a normal is neither a unit vector nor zero. If a tensor is not finite or
        not symmetric, or does not map the normal to zero. If an eigenvalue in the tangent plane is
        not positive, or is above 1e150.

    References
    ----------
    Section 2.1 of the paper, eq. 1.
    """

    def __init__(self, normals: ArrayLike, tensors: ArrayLike) -> None: ...
    normals: NDArray[np.float64]
    """(n, 3) float64: unit normals; zero at vertices without a face."""
    tensors: NDArray[np.float64]
    """(n, 3, 3) float64: symmetric tensors, which map the normal to zero."""
    max_anisotropy: float
    """float: the largest ratio of the lengths of two unit vectors at a vertex."""
    def ellipses(self, of: Literal["norm", "reach"] = "norm") -> NDArray[np.float64]:
        """Return the ellipse of the norm at each vertex (Figures 2, 3 and 6 of the paper).

        Parameters
        ----------
        of : {'norm', 'reach'}
            'norm': l1 e1 and l2 e2 of eq. 2, as in the paper's figures. The ellipse is long across the direction of paths.
            'reach': e2 / sqrt(l2) and e1 / sqrt(l1). This is how far a path of length 1 reaches.

        Returns
        -------
        (n, 2, 3) float64
            The two semi-axes, the longer one first. Zero at vertices without a face.

        Raises
        ------
        ValueError
            If `of` has another value.
        """

def feature_metric(
    surface: Surface,
    curvature: Curvature,
    follow: Literal["min", "max"] = "min",
    gamma: float | None = None,
    max_anisotropy: float | None = None,
    clamp_percentile: float | None = None,
    progress: Callable[[float], bool | None] | None = None,
) -> Metric:
    """Make the metric of the paper, eq. 5: l1 = 1 + gamma s, l2 = 1 / l1.

    Here and in the other metrics, k1, k2 and s are those of `Curvature` times the longest side of the box around the
    surface. Give gamma or max_anisotropy. Without either, gamma is 0.1.

    Parameters
    ----------
    surface : Surface
    curvature : Curvature
        Of that surface.
    follow : {'min', 'max'}
        The principal direction along which paths are short. 'min' follows ridges and valleys.
    gamma : float, optional
        At least 0.
    max_anisotropy : float, optional
        At least 1. It chooses gamma so that this is the largest anisotropy of a vertex.
    clamp_percentile : float, optional
        In (0, 100]. Values of s above this percentile are lowered to it.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    Metric

    Raises
    ------
    ValueError
        If both gamma and max_anisotropy are given, a parameter is out of range, or the curvature belongs to another
        surface.
    Cancelled
    """

def campen_metric(
    surface: Surface,
    curvature: Curvature,
    follow: Literal["min", "max"] = "min",
    alpha: float | None = None,
    max_anisotropy: float | None = None,
    progress: Callable[[float], bool | None] | None = None,
) -> Metric:
    """Make the metric of Campen et al., eq. 3: l1 = alpha, l2 = 1.

    Give either alpha or max_anisotropy.

    Parameters
    ----------
    surface, curvature, follow, progress
        As for `feature_metric`.
    alpha : float, optional
        At least 1.
    max_anisotropy : float, optional
        At least 1. Its square is alpha.

    Returns
    -------
    Metric

    Raises
    ------
    ValueError
        If neither or both of alpha and max_anisotropy are given, or as in `feature_metric`.
    Cancelled
    """

def pottmann_kovacs_metric(
    surface: Surface,
    curvature: Curvature,
    follow: Literal["min", "max"] = "min",
    beta: float | None = None,
    max_anisotropy: float | None = None,
    progress: Callable[[float], bool | None] | None = None,
) -> Metric:
    """Make the metric of Pottmann et al. and Kovacs et al., eq. 4: l1 = k1^2 + beta, l2 = k2^2 + beta.

    Give either beta or max_anisotropy.

    Parameters
    ----------
    surface, curvature, follow, progress
        As for `feature_metric`.
    beta : float, optional
        At least 0.
    max_anisotropy : float, optional
        At least 1. It chooses beta so that this is the largest anisotropy of a vertex.

    Returns
    -------
    Metric

    Raises
    ------
    ValueError
        If neither or both of beta and max_anisotropy are given, or as in `feature_metric`.
    Cancelled
    """

def concave_metric(
    surface: Surface,
    curvature: Curvature,
    strength: float = 1.0,
    progress: Callable[[float], bool | None] | None = None,
) -> Metric:
    """Make a metric in which paths along concave creases are short, as the cuts that people draw.

    Parameters
    ----------
    surface : Surface
        Its normals point outwards.
    curvature : Curvature
        Of that surface, best from `smoothed_curvatures`.
    strength : float
        At least 0. 0 gives the Euclidean metric.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    Metric

    Raises
    ------
    ValueError
        If the strength is negative, or the curvature belongs to another surface.
    Cancelled

    References
    ----------
    docs/method/metric.md.
    """

def euclidean_metric(
    surface: Surface,
    curvature: Curvature,
    progress: Callable[[float], bool | None] | None = None,
) -> Metric:
    """Make the metric in which lengths are those of space.

    Parameters
    ----------
    surface : Surface
    curvature : Curvature
        Of that surface. The metric takes its normals.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    Metric

    Raises
    ------
    ValueError
        If the curvature belongs to another surface.
    Cancelled
    """

class MetricFamily:
    """A family of metrics, and the parameters of its metrics."""

    name: Literal["feature", "campen", "pottmann_kovacs", "concave", "euclidean"]
    parameter: str | None
    """str or None: the name of the parameter, as the functions that make these metrics have it."""
    least_parameter: float
    """float: the smallest parameter."""
    has_directions: bool
    """bool: whether a metric follows one of the principal directions, 'min' or 'max'."""
    has_clamp: bool
    """bool: whether clamp_percentile matters."""

def metric_families() -> tuple[MetricFamily, ...]:
    """Return the families of metrics.

    Returns
    -------
    tuple of MetricFamily
    """

class MetricSpec:
    """A metric as a value: what it takes to compute it on any surface.

    Parameters
    ----------
    family : {'feature', 'campen', 'pottmann_kovacs', 'concave', 'euclidean'}
        One of `metric_families`.
    follow : {'min', 'max'}, optional
        The principal direction that paths follow, exactly in the families that have directions.
    parameter : float, optional
        `MetricFamily.parameter`, as the functions that make the family's metrics have it.
    max_anisotropy : float, optional
        At least 1. Instead of the parameter: the largest anisotropy of a vertex. 'concave' has the strength
        (max_anisotropy - 1) / 19.
    clamp_percentile : float, optional
        As for `feature_metric`.

    Without the last three, the metric has the strength that its family begins with.

    Raises
    ------
    ValueError
        If a parameter is out of range, or the family does not have it.
    """

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
    """{'feature', 'campen', 'pottmann_kovacs', 'concave', 'euclidean'}: the name of the family."""
    follow: Literal["min", "max"] | None
    """{'min', 'max'} or None: None if the family has no directions."""
    kind: Literal["min", "max", "concave", "euclidean"]
    """{'min', 'max', 'concave', 'euclidean'}: what paths follow; 'euclidean' if they follow nothing."""
    parameter: float | None
    max_anisotropy: float | None
    clamp_percentile: float | None
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...

def make_metric(surface: Surface, spec: MetricSpec, progress: Callable[[float], bool | None] | None = None) -> Metric:
    """Make the metric that a `MetricSpec` describes.

    Curvatures are computed at the first call for a surface and kept with it. For 'concave' they are smoothed over 0.01.

    Parameters
    ----------
    surface : Surface
    spec : MetricSpec
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    Metric

    Raises
    ------
    ValueError
        If the metric is too strong for the surface.
    Cancelled
    """

class Scribble:
    """A stroke drawn on a surface. Wires near it follow it.

    Parameters
    ----------
    points : (k, 3) array_like of float
        In the caller's coordinates, in drawing order. A closed stroke repeats its first point. Points may be far apart.
    faces, vertices : (k,) array_like of int, optional
        The triangle that each point lies in, or its vertex. -1 in one of them if the other names the place.
    eta : float
        The eigenvalues of the tensors along the stroke are eta and 1 / eta.
    rings : int
        The stroke changes the metric within fewer rings of vertices than this.
    radius : float, optional
        Use this distance in place of rings, in the caller's units.
    attracts : bool
        False makes wires that cross the stroke short, and wires that follow it long.
    acts_on : {'both', 'min', 'max', 'concave', 'euclidean'}
        The kind of metrics that the stroke changes, as `MetricSpec.kind`. 'both': every metric.

    Raises
    ------
    ValueError
        If an array has the wrong shape or type. Everything else is checked when the stroke is applied to a surface.
    """

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
    """(k,) int32: empty if not given."""
    vertices: NDArray[np.int32]
    """(k,) int32: empty if not given."""
    eta: float
    rings: int
    radius: float | None
    attracts: bool
    acts_on: Literal["both", "min", "max", "concave", "euclidean"]

def apply_scribbles(
    surface: Surface,
    metric: Metric,
    scribbles: Sequence[Scribble],
    follow: Literal["min", "max", "concave", "euclidean"] | None = None,
    progress: Callable[[float], bool | None] | None = None,
) -> Metric:
    """Change a metric by strokes (Section 5 of the paper).

    Strokes are applied in order. Where two strokes cross, the later one decides along its line. Without strokes the result
    equals the metric.

    Parameters
    ----------
    surface : Surface
    metric : Metric
        Of that surface.
    scribbles : sequence of Scribble
    follow : {'min', 'max', 'concave', 'euclidean'}, optional
        Apply only the strokes that act on metrics of this kind.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    Metric

    Raises
    ------
    ValueError
        If a point of a stroke is not on the surface, a parameter is out of range, or the metric belongs to another surface.
        The message has the numbers of the stroke and of the point.
    Cancelled
    """

class Embedding:
    """A surface in a metric: a refined mesh with edge lengths.

    The first vertices are those of the surface, with their numbers. New vertices are midpoints of edges. See Section 4.1 of
    the paper.
    """

    points: NDArray[np.float64]
    """(p, 3) float64: in the caller's coordinates."""
    triangles: NDArray[np.int32]
    """(t, 3) int32: the valid triangles."""
    edges: NDArray[np.int32]
    """(e, 2) int32: each edge once. Edges that paths follow without a triangle come last."""
    lengths: NDArray[np.float64]
    """(e,) float64: lengths of `edges` in the metric."""
    source_face: NDArray[np.int32]
    """(t,) int32: the surface's triangle that each triangle lies in."""
    def with_lengths(self, lengths: ArrayLike) -> Embedding:
        """Return the same triangles with other lengths.

        The lengths may come from another way of embedding, or from your own metric. Attributes that describe the subdivision,
        such as `mean_edge_length`, stay as they are. `estimated_error` and its like are None.

        Parameters
        ----------
        lengths : (e,) array_like of float
            Lengths of `edges`, in their order.

        Returns
        -------
        Embedding

        Raises
        ------
        ValueError
            If the number of lengths differs from the number of edges, a length is not positive or above 1e76, all lengths are
            below 1e-76, or a triangle fails the triangle inequality or has no area.
        """
    unreachable: NDArray[np.int32]
    """(k,) int32: vertices of faces that no path reaches, because they are in no valid triangle and on no edge that paths follow."""
    invalid_before: int
    """int: how many triangles of the surface are invalid."""
    faces_added: int
    """int: how many triangles were added."""
    invalid_left: int
    """int: how many triangles stayed invalid. They are holes."""
    hole_faces: NDArray[np.int32]
    """(k,) int32: the surface's triangles that have holes, ascending."""
    clamped_edges: int
    """int: how many edges have another length than the metric's. These lengths were changed to make triangles valid."""
    repaired_faces: NDArray[np.int32]
    """(k,) int32: the surface's triangles that have such edges, ascending."""
    worst_clamp: float
    """float: the largest factor, up or down, between such a length and the metric's. 1 if there is no such edge."""
    hit_cap: bool
    """bool: whether max_faces_added ended the subdivision."""
    estimated_error: float | None
    """float or None: the max_error that the worst triangle meets, None if max_error was 0. An estimate of the mean relative error of distances, not a bound."""
    unmet: int | None
    """int or None: how many triangles miss the max_error. They are 14 bisections deep, or max_faces_added ended the subdivision."""
    mean_edge_length: float
    """float: the mean length of the surface's edges in the metric."""

def embed(
    surface: Surface,
    metric: Metric,
    max_faces_added: int = 4000000,
    max_error: float = 0.01,
    progress: Callable[[float], bool | None] | None = None,
) -> Embedding:
    """Subdivide a surface until its triangles can have the edge lengths that a metric gives them.

    Parameters
    ----------
    surface : Surface
    metric : Metric
        Of that surface.
    max_faces_added : int
        At least 0. Subdivision stops after adding this many triangles.
    max_error : float
        Between 0 and 1. The mean relative error of distances to aim for: triangles are also subdivided until they resolve
        the metric that well. With 0 only invalid triangles are subdivided, as in the paper.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    Embedding

    Raises
    ------
    ValueError
        If a parameter is out of range, or the metric belongs to another surface.
    Cancelled

    References
    ----------
    Section 4.1 of the paper.
    """

def invalid_faces(surface: Surface, metric: Metric) -> NDArray[np.int32]:
    """Find the triangles that are invalid in a metric before any subdivision (Section 4.1; Figures 7 and 9).

    Parameters
    ----------
    surface : Surface
    metric : Metric
        Of that surface.

    Returns
    -------
    (k,) int32
        Triangles that `embed` has to subdivide, ascending. They include those without area.

    Raises
    ------
    ValueError
        If the metric belongs to another surface.
    """

def metric_lengths(surface: Surface, metric: Metric) -> NDArray[np.float64]:
    """Compute the lengths of a surface's edges in a metric (eq. 2), before any subdivision.

    Parameters
    ----------
    surface : Surface
    metric : Metric
        Of that surface.

    Returns
    -------
    (e,) float64
        Lengths of `Surface.edges`, in the unit of the points.

    Raises
    ------
    ValueError
        If the metric belongs to another surface.
    """

class Wire:
    """A geodesic across a surface."""

    from_vertex: int
    """int: the vertex where it begins; -1 if that point is not a vertex."""
    to_vertex: int
    """int: the vertex where it ends; -1 if that point is not a vertex."""
    points: NDArray[np.float64]
    """(p, 3) float64: in the caller's coordinates."""
    faces: NDArray[np.int32]
    """(p - 1,) int32: the triangle that each segment lies in; -1 along an edge without a face."""
    length: float
    """float: the length in the metric, in the unit of the points."""
    euclidean_length: float
    """float: the Euclidean length, in the unit of the points."""

class ClosedWire:
    """A closed cut through a seed."""

    points: NDArray[np.float64]
    """(p, 3) float64: in the caller's coordinates. The first and the last point are the seed."""
    faces: NDArray[np.int32]
    """(p - 1,) int32: the triangle that each segment lies in; -1 along an edge without a face."""
    length: float
    """float: the length in the metric, in the unit of the points."""
    euclidean_length: float
    """float: the Euclidean length, in the unit of the points."""
    separates: bool
    """bool: whether the cut divides the surface into two parts. False if it runs around or through a handle."""
    turn: float
    """float: the turn at the seed, in radians. 0 if the cut is smooth there, pi if it turns back."""

class BentWires:
    """A closed cut that can be bent to a second point."""

    def through(
        self,
        second: int | tuple[int, ArrayLike],
        progress: Callable[[float], bool | None] | None = None,
    ) -> tuple[Wire, Wire] | None:
        """Find the shortest closed wire through both points that goes around what the cut goes around.

        Parameters
        ----------
        second : int or (int, (3,) array_like)
            A vertex, or a face and three barycentric coordinates.
        progress : callable, optional
            Called repeatedly with 0. Returning False cancels.

        Returns
        -------
        (Wire, Wire) or None
            From the seed to the second point, and back. None if no such wire leads there.

        Raises
        ------
        ValueError
            If the point is not part of the surface, its face has no area, or the embedding has a hole there.
        Cancelled
        """

def snap_to_edges(
    surface: Surface,
    wire: Wire,
    progress: Callable[[float], bool | None] | None = None,
) -> NDArray[np.int32]:
    """Find the path of real edges that stays closest to a wire, from its start to its end.

    Candidates run along edges of the faces that the wire crosses, and of their neighbors. The path has the least integral
    of its distance to the wire.

    Parameters
    ----------
    surface : Surface
    wire : Wire
        On that surface.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    (k,) int32
        Vertices, each once. Empty if there is no such path.

    Raises
    ------
    ValueError
        If the wire is not on the surface.
    Cancelled
    """

class DistanceField:
    """Distances from a seed to every vertex."""

    seed: int
    """int: the vertex that distances start from; -1 for several seeds, or a seed that is not a vertex."""
    radius: float
    """float: the distance at which the solver stopped, or inf. Larger distances are inf."""
    method: str
    """str: 'exact' or 'heat', the method that computed the distances."""
    distances: NDArray[np.float64]
    """(n,) float64: the distance of each of the surface's vertices, in the metric. inf if no path reaches the vertex."""
    def trace(self, vertex: int, progress: Callable[[float], bool | None] | None = None) -> Wire | None:
        """Trace the path from the seed to a vertex.

        The path of an exact field is the shortest one. The path of a heat field is locally shortest.

        Parameters
        ----------
        vertex : int
        progress : callable, optional
            Called repeatedly with 0. Returning False cancels.

        Returns
        -------
        Wire or None
            In an exact field, its length is the vertex's distance. None if the vertex is unreachable.

        Raises
        ------
        ValueError
            If the vertex is out of range.
        Cancelled
        """
    def trace_many(
        self,
        vertices: ArrayLike,
        progress: Callable[[float], bool | None] | None = None,
    ) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.float64]]:
        """Trace the paths from the seed to several vertices, as `trace` does (Figure 1).

        Parameters
        ----------
        vertices : (k,) array_like of int
        progress : callable, optional
            Called repeatedly with the fraction done. Returning False cancels.

        Returns
        -------
        points : (p, 3) float64
            The points of all paths, one path after the other, in the caller's coordinates.
        starts : (k + 1,) int32
            Path i has the points starts[i] to starts[i + 1]. It has no points if its vertex is unreachable.
        lengths : (k,) float64
            Lengths in the metric; inf if the vertex is unreachable.

        Raises
        ------
        ValueError
            If a vertex is out of range.
        Cancelled
        """
    def distance(
        self,
        face: int,
        barycentric: ArrayLike,
        progress: Callable[[float], bool | None] | None = None,
    ) -> float:
        """Compute the distance of any point of a face.

        In an exact field, the distance is exact on the embedding. In a heat field, it is
        interpolated from the corners, or straight on the face of a seed.

        Parameters
        ----------
        face : int
            A triangle of the surface.
        barycentric : (3,) array_like
            One coordinate for each corner, 0 or more, with the sum 1. A coordinate of exactly 0 puts the point on the edge
            opposite to that corner.
        progress : callable, optional
            Called repeatedly with 0. Returning False cancels.

        Returns
        -------
        float
            In the metric; inf if no path leads there, or beyond the field's radius.

        Raises
        ------
        ValueError
            If the face is out of range or has no area, the coordinates are invalid, or the embedding has a hole there.
        Cancelled
        """
    def trace_to(
        self,
        face: int,
        barycentric: ArrayLike,
        progress: Callable[[float], bool | None] | None = None,
    ) -> Wire | None:
        """Trace the path from the nearest seed to any point of a face, as `trace` does.

        Parameters
        ----------
        face, barycentric, progress
            As for `distance`.

        Returns
        -------
        Wire or None
            As from `trace`. The number of an end that is not a vertex is -1.

        Raises
        ------
        ValueError
            As `distance`.
        Cancelled
        """
    def closed_wires(self, count: int = 3, progress: Callable[[float], bool | None] | None = None) -> list[ClosedWire]:
        """Find the closed cuts through the seed that the surface suggests, best first.

        Each cut consists of two shortest wires and the edge of the embedding at whose ends they meet on the far side. Good cuts
        are short and turn little at the seed. In a `concave_metric` they are nearest to the cuts that people draw.

        Parameters
        ----------
        count : int
            The largest number of cuts to return, at least 0.
        progress : callable, optional
            Called repeatedly with the fraction done. Returning False cancels.

        Returns
        -------
        list of ClosedWire
            Empty if the surface suggests no cut. Examples are planes, and spheres, where all wires meet in one place.

        Raises
        ------
        ValueError
            If the field has several seeds, or count is negative.
        Cancelled

        References
        ----------
        docs/method/closed-cuts.md.
        """
    def bend(self, cut: ClosedWire, progress: Callable[[float], bool | None] | None = None) -> BentWires:
        """Prepare a closed wire of the field, so that it can be bent to a second point.

        Parameters
        ----------
        cut : ClosedWire
            A result of `closed_wires`.
        progress : callable, optional
            Called repeatedly with the fraction done. Returning False cancels.

        Returns
        -------
        BentWires

        Raises
        ------
        ValueError
            If the cut does not lead through the seed of the field.
        Cancelled
        """

def distance_field(
    embedding: Embedding,
    seed: int | tuple[int, ArrayLike] | Sequence[int | tuple[int, ArrayLike]],
    progress: Callable[[float], bool | None] | None = None,
    targets: int | tuple[int, ArrayLike] | Sequence[int | tuple[int, ArrayLike]] | None = None,
    max_distance: float | None = None,
    method: Literal["exact", "heat"] = "exact",
) -> DistanceField:
    """Compute distances over an embedding from a point, or from the nearest of several points.

    Distances are exact on the embedding, or approximated by the heat method.

    Parameters
    ----------
    embedding : Embedding
        The first call with each method builds a solver, and the embedding keeps it.
    seed : int, (int, (3,) array_like), or sequence of int or (int, (3,) array_like)
        A vertex of the surface, or a triangle and barycentric coordinates, as for `DistanceField.distance`; or several.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.
    targets : int, (int, (3,) array_like), or sequence of int or (int, (3,) array_like), optional
        Stop when the distances and paths of these points are known. Other distances may be missing (inf). The heat method
        does not stop.
    max_distance : float, optional
        At least 0. Stop at this distance; larger distances are inf.
    method : {'exact', 'heat'}
        'exact' propagates windows. 'heat' solves two linear systems with matrices that the first call factors. Each
        further call with any seeds then takes about the same time.

    Returns
    -------
    DistanceField

    Raises
    ------
    ValueError
        If a seed or a target is out of range, has wrong coordinates, or lies in a hole of the embedding, or if
        max_distance or method is not valid.
    Cancelled

    References
    ----------
    docs/method/heat.md.
    """

class EdgeChain:
    """A chain of edges."""

    vertices: NDArray[np.int32]
    """(p,) int32: the vertices in order, including picked edges. Empty if a live wire has no chain."""
    length: float
    """float: lengths in the metric plus the cost of turning. inf if a live wire has no chain."""

class EdgeLoop:
    """A run of edges straight through a mesh."""

    vertices: NDArray[np.int32]
    """(k,) int32: the vertices in order. A closed loop does not repeat its first vertex."""
    closed: bool
    """bool: whether the loop ends where it begins."""

class FittedChain:
    """The chain of edges that fits a line."""

    vertices: NDArray[np.int32]
    """(k,) int32: the vertices in the line's order. Empty if no edge fits."""
    places: NDArray[np.float64]
    """(k,) float64: where on the line each vertex is. i + x is the fraction x of the way from point i to the next point."""

class EdgeWires:
    """The cheapest chains of edges from a vertex or an edge."""

    def trace(self, target: int | tuple[int, int]) -> EdgeChain | None:
        """Trace the cheapest chain to a vertex, or to an edge (a, b).

        Parameters
        ----------
        target : int or (int, int)

        Returns
        -------
        EdgeChain or None
            Includes both picks. None if there is no chain.

        Raises
        ------
        ValueError
            If the target is not a vertex or an edge of the surface.
        """

def edge_wires(
    surface: Surface,
    metric: Metric,
    seed: int | tuple[int, int],
    turning: float = 3.0,
    forward: bool = False,
    progress: Callable[[float], bool | None] | None = None,
) -> EdgeWires:
    """Find the cheapest chains of real edges from a pick. A chain costs its metric length plus its turning.

    Parameters
    ----------
    surface : Surface
    metric : Metric
        Of that surface. The first call builds a graph of the surface's edges, and the metric keeps it.
    seed : int or (int, int)
        A vertex, or an edge by its two vertices.
    turning : float
        q, at least 0: the cost of turning, in mean edge lengths.
    forward : bool
        Whether the seed edge has just been drawn from its first vertex to its second, so that chains leave it at the second.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    EdgeWires

    Raises
    ------
    ValueError
        If the seed is not a vertex or an edge of the surface, turning is out of range, or the metric belongs to another
        surface.
    Cancelled

    References
    ----------
    docs/method/edges.md.
    """

def shortest_cycle(
    surface: Surface,
    metric: Metric,
    edge: tuple[int, int],
    turning: float = 20.0,
    progress: Callable[[float], bool | None] | None = None,
) -> EdgeChain | None:
    """Find the cheapest closed chain through an edge.

    Parameters
    ----------
    surface, metric
        As for `edge_wires`.
    edge : (int, int)
        Its two vertices.
    turning : float
        q, at least 0: the cost of turning, in mean edge lengths.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    EdgeChain or None
        Does not repeat its first vertex. None if there is no closed chain.

    Raises
    ------
    ValueError
        If the edge is not part of the surface, turning is out of range, or the metric belongs to another surface.
    Cancelled
    """

def fit_chain(
    surface: Surface,
    points: ArrayLike,
    faces: ArrayLike,
    begin: int | None = None,
    end: int | None = None,
    progress: Callable[[float], bool | None] | None = None,
) -> FittedChain:
    """Find the chain of edges that fits a line drawn on a surface best.

    The chain begins at the vertex nearest to the line's first point, and ends at the vertex nearest to its last. Among all
    chains along the line it minimizes the sum of l (1 + 32 d^2 / h^2) + h / 4 (1 - cos kappa). Here l is the length of an
    edge, and kappa the turn onto it. d^2 is the mean square distance of its ends and midpoint to the line. h is the median
    length of the edges at the line's faces. The chain turns back where the line does, and ends where edges end.

    Parameters
    ----------
    surface : Surface
    points : (k, 3) array_like of float
        In the caller's coordinates, in drawing order.
    faces : (k,) array_like of int
        The triangle that each point lies in.
    begin, end : int, optional
        Vertices near the line's ends where the chain begins and ends instead.
    progress : callable, optional
        Called repeatedly with 0.0. Returning False cancels.

    Returns
    -------
    FittedChain
        Has no vertices if no edge fits.

    Raises
    ------
    ValueError
        If the arrays have the wrong shape or type or differ in length, a coordinate is not finite, or a face or a vertex is
        not part of the surface.
    Cancelled
    """

class LoopOffer:
    """A chain of edges that a click on an edge may take."""

    kind: Literal["closed", "past", "strip", "whole", "flat", "crossing"]
    """{'closed', 'past', 'strip', 'whole', 'flat', 'crossing'}: the cheapest closed chain in the metric, the straight way past poles, the edge loop up to kept edges and without them, the border of a part or of a flat face, and a loop through the crossing edge."""
    vertices: NDArray[np.int32]
    """(k,) int32: the vertices in order. A closed chain does not repeat its first vertex."""
    closed: bool
    """bool: whether an edge joins the last vertex to the first."""
    through: tuple[int, int]
    """(int, int): the picked edge, or the edge of the chain that stands for it. The smaller vertex comes first."""
    beside: tuple[LoopOffer, ...]
    """tuple of LoopOffer: other chains that the same click takes."""

def edge_chains(edges: ArrayLike, ends: ArrayLike = ()) -> list[NDArray[np.int32]]:
    """Join edges to chains, which end where other than two edges meet, and at some vertices.

    Parameters
    ----------
    edges : (k, 2) array_like of int
        Pairs of different vertices.
    ends : (e,) array_like of int
        Vertices where chains end as well.

    Returns
    -------
    list of (c,) int32
        The vertices of each chain. A closed chain ends with its first vertex. Open chains come first.

    Raises
    ------
    ValueError
        If a vertex is negative, or an edge joins a vertex to itself.
    """

def find_gaps(
    surface: Surface,
    seams: ArrayLike,
    longest: float = 0.5,
    longest_of_several: float | None = None,
    most_looked_at: int = 50000,
    meant: ArrayLike = (),
    partly_hidden: ArrayLike = (),
) -> list[tuple[NDArray[np.int32], float]]:
    """Find where seams end just before they meet another seam or the boundary.

    A gap leads from the end of a seam to the nearest vertex of a seam or of the boundary, unless these lead there within
    four times that distance. Two ends that face each other have one gap.

    Parameters
    ----------
    surface : Surface
    seams : (k, 2) array_like of int
        Vertex pairs. Pairs that are not real edges are ignored.
    longest : float
        The longest gap, in lengths of the seam that ends there, up to where it meets other seams.
    longest_of_several : float, optional
        The same for gaps of more than one edge. None: as long as gaps of one edge.
    most_looked_at : int
        How many vertices around an end are looked at.
    meant : (m,) array_like of int
        Vertices where seams end on purpose.
    partly_hidden : (h, 2) array_like of int
        Edges where the mesh goes on, though no triangle of the surface does.

    Returns
    -------
    list of ((p,) int32, float)
        The vertices from the end of the seam along edges to what it nearly meets, and the length in the caller's unit. The
        shortest gap comes first.

    Raises
    ------
    ValueError
        If a vertex is out of range.
    """

class LoopOffers:
    """Finds the loops that a click on an edge may take.

    They are closed chains in a metric, edge loops, straight ways past poles, and borders of parts and flat faces.

    Parameters
    ----------
    surface : Surface
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Raises
    ------
    Cancelled

    References
    ----------
    docs/method/edges.md.
    """

    def __init__(self, surface: Surface, progress: Callable[[float], bool | None] | None = None) -> None: ...
    def add_parts(self, labels: ArrayLike) -> None:
        """Add one way to divide the surface into parts.

        The borders of the first way come first. No other thread may use the object meanwhile.

        Parameters
        ----------
        labels : (m,) array_like of int
            The part of each triangle, as from `PartFinder.find`.

        Raises
        ------
        ValueError
            If there are not as many labels as triangles, or a label is negative or not below their number.
        """
    def find(
        self,
        edge: tuple[int, int],
        loop: ArrayLike = (),
        corners: int = 0,
        *,
        kept: ArrayLike = (),
        plane: ArrayLike = (),
        last: str | None = None,
        triangle: int | None = None,
        inside: bool = False,
        crossing: tuple[int, int] | None = None,
        crossing_loop: ArrayLike = (),
        crossing_corners: int = 0,
        close_call: bool = False,
        shown: ArrayLike = (),
        chosen: bool = False,
    ) -> list[LoopOffer]:
        """Find what a click on an edge may take.

        Parameters
        ----------
        edge : (int, int)
            The edge under the cursor.
        loop : (k,) array_like of int
            The cheapest closed chain through the edge, as from `shortest_cycle`. It may be empty.
        corners : int
            How often that chain turns off, as in `LiveLoop.corners`.
        kept : (e, 2) array_like of int
            The edges of seams and wires. Straight ways end at their vertices.
        plane : (p,) array_like of int
            Vertices where straight ways end unless both ends of their edge are among these, such as those in a mirror plane.
        last : str, optional
            The kind of the loop that was taken last, as in `LoopOffer.kind`.
        triangle : int, optional
            The triangle under the cursor.
        inside : bool
            Whether the cursor is inside a face. The borders of the part there come first.
        crossing : (int, int), optional
            The edge that crosses the picked edge at the cursor.
        crossing_loop : (k,) array_like of int
        crossing_corners : int
            As `loop` and `corners`, of the crossing edge.
        close_call : bool
            Whether edges are so short that the crossing edge may be meant.
        shown : (s,) array_like of int
            The loop that was shown last. A closed loop repeats its first vertex. In a close call it decides between loops that are
            as likely and as long.
        chosen : bool
            Whether the user asked for the loop that was shown last. Then it decides before all else.

        Returns
        -------
        list of LoopOffer
            No two run along the same edges. The likeliest comes first.

        Raises
        ------
        ValueError
            If an edge is not part of the surface, or a vertex or a triangle is out of range.
        """
    def borders(self, edge: tuple[int, int]) -> list[NDArray[np.int32]]:
        """Find the borders between parts that lead through an edge.

        Parameters
        ----------
        edge : (int, int)

        Returns
        -------
        list of (k,) int32
            Closed chains, which do not repeat their first vertices: for each way to divide the surface, the shortest first.

        Raises
        ------
        ValueError
            If the edge is not part of the surface.
        """

class LiveCandidate:
    """One of the wires from the seed to a target."""

    follow: Literal["min", "max", "concave", "euclidean"]
    """{'min', 'max', 'concave', 'euclidean'}: what the metric's paths follow; 'euclidean' if they follow nothing."""
    metric: MetricSpec
    """MetricSpec: the metric in which the wire is short."""
    points: NDArray[np.float64]
    """(p, 3) float64: in the caller's coordinates. There are no rows if there is no such wire."""
    faces: NDArray[np.int32]
    """(p - 1,) int32: the triangle of each segment. Only across the surface."""
    vertices: NDArray[np.int32]
    """(k,) int32: the chain of edges that the wire would mark."""
    length: float
    """float: the length in its own metric."""
    solved: bool
    """bool: True once the wire is the shortest in the embedding of the whole surface, or along edges. Across the surface, it may become more exact until it is final."""
    final: bool
    """bool: False while the wire is still being computed. A later answer will replace what is here."""

class LiveWires:
    """The wires from the seed to a target."""

    wires: tuple[LiveCandidate, ...]
    """tuple of LiveCandidate: the wires in M_min and M_max. Across the surface, the family 'feature' has the wire in `concave_metric` before them."""
    active: int
    """int: the index of the wire to offer first. This is the first wire, or of M_min and M_max the wire that is shorter in its own metric (Section 5 of the paper). If it does not reach the target, it is the shortest of all wires."""
    settled: bool
    """bool: whether the active wire is final and stays active, even if other wires change."""
    solved: bool
    """bool: whether all wires are solved. What follows a moving cursor need not wait for more."""
    final: bool
    """bool: whether all wires are final."""

class LiveEmbedding:
    """A summary of the embedding of one metric."""

    invalid_left: int
    """int: how many triangles stayed invalid. Wires lead around them."""
    hit_cap: bool
    """bool: whether the cap ended the subdivision."""
    clamped_edges: int
    """int: how many edges have another length than the metric's."""
    worst_clamp: float
    """float: the largest factor between such a length and the metric's, at least 1."""

class LiveLoop:
    """A closed chain of edges."""

    vertices: NDArray[np.int32]
    """(k,) int32: the vertices, without repeating the first. Empty if there is no such chain, or not yet."""
    length: float
    """float: the length in its metric plus the cost of turning."""
    corners: int
    """int: how often the chain turns off by 60 degrees or more, although straight ways go on there."""
    final: bool
    """bool: False while it is still being computed."""

class LivePiece:
    """A piece of a closed cut."""

    points: NDArray[np.float64]
    """(p, 3) float64: in the caller's coordinates."""
    faces: NDArray[np.int32]
    """(p - 1,) int32: the triangle that each segment lies in; -1 along an edge without a face."""
    vertices: NDArray[np.int32]
    """(k,) int32: the chain of edges that the piece snaps to. One vertex if both ends are nearest to the same vertex."""

class LiveClosedWire:
    """A closed cut through a point of the surface."""

    pieces: list[LivePiece]
    """list of LivePiece: the pieces in order, from the point around and back to it."""
    joints: list[int | tuple[int, tuple[float, float, float]]]
    """list of int or (int, (float, float, float)): the point where each piece but the last ends, as a triangle and barycentric coordinates. The second point may be a vertex."""
    separates: bool
    """bool: as `ClosedWire.separates`."""
    turn: float
    """float: as `ClosedWire.turn`."""
    length: float
    """float: the length in its metric, in the unit of the points."""
    id: tuple[int, int]
    """(int, int): the number of the cut's metric and of the cut in it, for `LiveWire.bent_wire`. They may change until the cuts are final."""

class LiveClosedWires:
    """The closed cuts through a point."""

    cuts: list[LiveClosedWire]
    """list of LiveClosedWire: the best cut first. Empty if the surface suggests no cut, or not yet."""
    final: bool
    """bool: False while they are still being computed."""

class LiveWire:
    """Wires from a seed to any target, one in each metric of a family.

    ``LiveWire(surface, ...)`` runs on a surface. ``LiveWire(points, triangles, edges=None, *, ...)`` copies the arrays,
    returns at once, and builds the surface in the background. Until the surface is built, methods other than `wait` and
    `wait_for_surface` return empty answers that are not final. They keep the seed, the metric and the strokes. If the
    surface cannot be built, every method raises what `Surface` would raise.

    Each metric has its own thread.

    Parameters
    ----------
    surface : Surface
    points, triangles, edges : array_like
        (n, 3), (m, 3), (e, 2) or None, as for `Surface`.
    gamma, max_anisotropy, clamp_percentile : float, optional
        As for `feature_metric`; only 'feature' has gamma and clamp_percentile. Without gamma and max_anisotropy, 'feature'
        has gamma = 0.1 across the surface, and max_anisotropy = 10 with clamp_percentile = 99 along edges. 'concave' has
        max_anisotropy = 20, and other families have 10.
    along : {'surface', 'edges'}
        Whether wires are geodesics across the surface or chains of real edges.
    turning : float
        The cost of turning, as for `edge_wires`.
    loop_turning : float, optional
        The cost of turning in closed chains, as for `shortest_cycle`. None: 20, and more on meshes with over 6400 edges, so
        that they have rings, too.
    metric : {'feature', 'campen', 'pottmann_kovacs', 'concave', 'euclidean'}
        The family of metrics. Across the surface, the first wire of 'feature' is in `concave_metric`. Its strength is
        gamma / 0.1 or (max_anisotropy - 1) / 19, and its curvatures are smoothed over 0.01. 'concave' has two wires: one in
        that metric, with strength (max_anisotropy - 1) / 19, and the shortest path.
    max_error : float
        The mean relative error of lengths to aim for, in [0, 1], across the surface: the `max_error` of `embed` for the
        faces around a wire. The wire is final once it is the shortest there. 0: the wire of the embedding is final.

    Raises
    ------
    ValueError
        If a parameter is out of range, or an array has the wrong shape or type.
    """

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
    ) -> None: ...
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
    ) -> None: ...
    def fork(self) -> LiveWire:
        """Return another live wire with the same metrics and no seed.

        The two share metrics, including those that are still being computed. `set_metric` of one does not change the other.

        Returns
        -------
        LiveWire
        """
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
        """Return another live wire on the same surface, with its own metrics.

        It shares the surface and the curvatures. It has no strokes and no seed.

        Parameters
        ----------
        gamma, max_anisotropy, clamp_percentile, along, turning, loop_turning, metric
            As for the class.

        Returns
        -------
        LiveWire

        Raises
        ------
        ValueError
            If a parameter is out of range.
        """
    def set_metric(
        self,
        metric: Literal["feature", "campen", "pottmann_kovacs", "concave", "euclidean"] = "feature",
        max_anisotropy: float | None = None,
        gamma: float | None = None,
        clamp_percentile: float | None = None,
    ) -> None:
        """Change the metric in the background, and start from the seed again.

        Until that is done, wires are those of the former metric and not final.

        Parameters
        ----------
        metric, max_anisotropy, gamma, clamp_percentile
            As for the class.

        Raises
        ------
        ValueError
            If a parameter is out of range.
        """
    def set_scribbles(self, scribbles: Sequence[Scribble]) -> None:
        """Replace the strokes that change the metric, in the background as `set_metric`.

        Later calls of `set_metric` keep the strokes. If a stroke is not on the surface, the methods that return results raise
        ValueError.

        Parameters
        ----------
        scribbles : sequence of Scribble
        """
    def feature_strength(self) -> NDArray[np.float64] | None:
        """Return how strong a ridge or valley is at each vertex.

        Returns
        -------
        (n,) float64 or None
            `Curvature.difference`. None while it is being computed.
        """
    def embeddings(self) -> tuple[LiveEmbedding | None, ...]:
        """Return summaries of the embeddings across the surface.

        Returns
        -------
        tuple of LiveEmbedding or None
            In the order of the wires. None for an embedding that is not prepared yet, and along edges.
        """
    def seed(self, pick: int | tuple[int, int] | tuple[int, ArrayLike], forward: bool = False) -> None:
        """Start wires from a pick and drop those of an earlier pick. Returns at once.

        Parameters
        ----------
        pick : int, (int, int) or (int, (3,) array_like)
            A vertex. Along edges, it may also be an edge, by its two vertices. Across the surface, it may also be a face and
            three barycentric coordinates, each 0 or more, with the sum 1.
        forward : bool
            As for `edge_wires`.

        Raises
        ------
        ValueError
            If the pick is not part of the surface, or if it is a point in a face and wires run along edges. Before the
            surface is built, an edge is checked later, by `wires`.
        """
    def wires(self, target: int | tuple[int, int] | tuple[int, ArrayLike]) -> LiveWires:
        """Return the wires to a target, as far as they are computed.

        Along edges, wires near the seed are final first. Across the surface, the work goes on for the newest target. Later calls
        for it return a path that may be slightly too long, then the shortest wire of the embedding, then the final wire, which
        is as exact as `max_error` says. `wait` waits for the final wire of the newest target.

        Parameters
        ----------
        target : int, (int, int) or (int, (3,) array_like)
            As for `seed`.

        Returns
        -------
        LiveWires

        Raises
        ------
        ValueError
            If the target or the seed is not part of the surface, or there is no seed. As for `seed` otherwise.
        """
    def loop(self, edge: tuple[int, int]) -> LiveLoop:
        """Return the closed chain through an edge. Only along edges.

        It is the cheapest among all metrics. The first call for an edge starts the search in the background, and replaces a
        search for another edge. Call again until the answer is final.

        Parameters
        ----------
        edge : (int, int)

        Returns
        -------
        LiveLoop

        Raises
        ------
        ValueError
            If the edge is not part of the surface, or wires do not run along edges.
        """
    def closed_wires(self, through: int | tuple[int, ArrayLike]) -> LiveClosedWires:
        """Return at most three closed cuts through a point, best first. Only across the surface.

        Cuts are short in the first metric of the family. The family 'concave' is made for cuts. Its second cut is the best in
        the Euclidean metric, unless that is like the first cut. The first call for a point starts the search in the background,
        and replaces a search for another point. Call again until the answer is final.

        Parameters
        ----------
        through : int or (int, (3,) array_like)
            A vertex, or a face and three barycentric coordinates.

        Returns
        -------
        LiveClosedWires

        Raises
        ------
        ValueError
            If the point is not part of the surface, or wires do not run across it.
        """
    def bent_wire(
        self,
        through: int | tuple[int, ArrayLike],
        second: int | tuple[int, ArrayLike],
        cut: tuple[int, int] = (0, 0),
    ) -> LiveClosedWires:
        """Bend one of the closed cuts through a point, so that it leads through a second point as well.

        The result is the shortest closed wire through both points that goes around what the cut goes around. It has two pieces
        each way.

        Parameters
        ----------
        through, second : int or (int, (3,) array_like)
            A vertex, or a face and three barycentric coordinates.
        cut : (int, int)
            `LiveClosedWire.id` of the cut, as `closed_wires` returns it for the first point.

        Returns
        -------
        LiveClosedWires
            At most one. Final and empty if there is no such cut, or if none leads to the second point.

        Raises
        ------
        ValueError
            If a point is not part of the surface, wires do not run across it, or the id is no pair of numbers that are not
            negative.
        """
    def extend_straight(self, edge: tuple[int, int], stops: Iterable[int] = ()) -> EdgeChain:
        """Continue an edge straight, from its second vertex on. Only along edges.

        At each vertex the chain takes the edge that turns least. A chain along a boundary stays on it; other chains end there.
        A chain also ends at a vertex of `stops`, at a vertex that it has visited, and if every edge turns 60 degrees or more.

        Parameters
        ----------
        edge : (int, int)
        stops : iterable of int
            Vertices. The vertex where the chain begins does not count.

        Returns
        -------
        EdgeChain
            It begins with the edge's second vertex. Only its last vertex may be an earlier vertex, or the edge's first. The
            length is Euclidean, in the unit of the points. It has no vertices before the surface is built.

        Raises
        ------
        ValueError
            If the edge is not part of the surface, or wires run across it.
        """
    def edge_loop(self, edge: tuple[int, int], stops: Iterable[int] = ()) -> EdgeLoop:
        """Find the edge loop through an edge, as modelers select it: straight on, both ways.

        The loop continues with the opposite edge at vertices with four edges whose faces are not all triangles. So it does at
        vertices with six edges whose faces are all triangles. From an edge of the boundary it follows the
        boundary. It ends at all other vertices, at vertices of `stops`, which may be ends of the edge, and where it meets
        itself.

        Parameters
        ----------
        edge : (int, int)
            Its direction is that of the loop.
        stops : iterable of int
            Vertices.

        Returns
        -------
        EdgeLoop
            Closed if its ends are one vertex. If it crosses itself, its first or last vertex is also an inner vertex. It has no
            vertices before the surface is built.

        Raises
        ------
        ValueError
            If the edge is not part of the surface, or wires run across it.
        """
    def fit_chain(
        self,
        points: ArrayLike,
        faces: ArrayLike,
        begin: int | None = None,
        end: int | None = None,
    ) -> FittedChain:
        """Find the chain of edges that fits a line. Only along edges.

        Parameters
        ----------
        points, faces, begin, end
            As for the function `fit_chain`.

        Returns
        -------
        FittedChain
            Has no vertices if no edge fits, and before the surface is built.

        Raises
        ------
        ValueError
            As the function `fit_chain`, and if wires do not run along edges.
        """
    surface: Surface | None
    """Surface or None: the surface that wires run on; None until it is built."""
    def wait_for_surface(self, seconds: float | None = None) -> bool:
        """Wait until the surface is built. Any thread may wait.

        Parameters
        ----------
        seconds : float, optional
            The longest time to wait. None: no limit.

        Returns
        -------
        bool
            Whether the surface is built.
        """
    def progress(self) -> float:
        """Return the fraction of the preparation and the seed's work that is done.

        Returns
        -------
        float
            0 until the surface is built, 1 when all work is done.
        """
    def wait(self, seconds: float | None = None) -> bool:
        """Wait for all running work, including loops.

        Parameters
        ----------
        seconds : float, optional
            The longest time to wait. None: no limit.

        Returns
        -------
        bool
            Whether all work is done.
        """

class NearestPoints:
    """Finds the nearest points of triangles.

    Parameters
    ----------
    points : (n, 3) array_like of float
    triangles : (m, 3) array_like of int
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Raises
    ------
    ValueError
        If there is no triangle, a triangle has a vertex that does not exist, or a coordinate is not finite.
    Cancelled
    """

    def __init__(
        self,
        points: ArrayLike,
        triangles: ArrayLike,
        progress: Callable[[float], bool | None] | None = None,
    ) -> None: ...
    def find(
        self,
        places: ArrayLike,
        normals: ArrayLike | None = None,
        progress: Callable[[float], bool | None] | None = None,
    ) -> tuple[NDArray[np.int32], NDArray[np.float64], NDArray[np.float64]]:
        """Find the point that is nearest to each place.

        Parameters
        ----------
        places : (k, 3) array_like of float
        normals : (k, 3) array_like of float, optional
            Triangles that face away from these do not count, unless all do.
        progress : callable, optional
            Called repeatedly with the fraction done. Returning False cancels.

        Returns
        -------
        triangles : (k,) int32
        points : (k, 3) float64
        distances : (k,) float64

        Raises
        ------
        ValueError
            If there are not as many normals as places, or a coordinate is not finite.
        Cancelled
        """

def nearest_vertices(points: ArrayLike, places: ArrayLike, reach: float | ArrayLike) -> NDArray[np.int32]:
    """Find the nearest vertex of each place, within a distance.

    Parameters
    ----------
    points : (n, 3) array_like of float
        The vertices. Vertices that are not finite are never found.
    places : (k, 3) array_like of float
        A place that is not finite has no nearest vertex.
    reach : float or (k,) array_like of float
        How far away a vertex may be: one distance, or one for each place.

    Returns
    -------
    (k,) int32
        The vertex, usually the first of several at the same distance, or -1.

    Raises
    ------
    ValueError
        If an array has the wrong shape or type, or there are not as many distances as places.
    """

def mirror_partners(
    points: ArrayLike,
    axes: ArrayLike,
    edges: ArrayLike | None = None,
    triangles: ArrayLike | None = None,
) -> NDArray[np.int32]:
    """Find the vertex that is the mirror image of each vertex.

    Partners are one to one: each vertex is the partner of its partner. By place, each is the nearest to the mirror image of
    the other. Vertices in one place have different partners.

    Parameters
    ----------
    points : (n, 3) array_like of float
        The vertices. Vertices that are not finite have no partners.
    axes : (a,) array_like of int
        The coordinates that change their sign: 0, 1 or 2.
    edges : (e, 2) array_like of int, optional
        The edges of the mesh. A vertex may be as far from its partner's image as half of (sum of 1 / l^2)^(-1/2), over the
        lengths l of its edges. None: as far as 2e-5.
    triangles : (m, 3) array_like of int, optional
        Triangles with one orientation. If given, partners are grown over the polygons that `edges` bound, from edges whose
        ends have partners by place. This finds the partners of a mesh in a pose.

    Returns
    -------
    (n,) int32
        The partner of each vertex, or -1.

    Raises
    ------
    ValueError
        If an array has the wrong shape or type, or a vertex or an axis is out of range.
    """

class RayTree:
    """Finds the first triangle that a ray meets, from either side.

    A tree is built in the background. Before it is built, each query tests all triangles and has the same answer.

    Parameters
    ----------
    points : (n, 3) array_like of float
    triangles : (m, 3) array_like of int

    Raises
    ------
    ValueError
        If an array has the wrong shape or type, or a triangle has a vertex that does not exist.
    """

    def __init__(self, points: ArrayLike, triangles: ArrayLike) -> None: ...
    def first_hit(self, origin: ArrayLike, direction: ArrayLike) -> tuple[int, float] | None:
        """Find the first triangle that a ray meets.

        Parameters
        ----------
        origin, direction : (3,) array_like of float

        Returns
        -------
        (int, float) or None
            The triangle's number, and its distance in lengths of `direction`. None if the ray meets no triangle.

        Raises
        ------
        ValueError
            If an array has the wrong shape or type.
        """
    ready: bool
    """bool: whether the tree is built."""
    def wait(self) -> None:
        """Wait until the tree is built."""

class Picked:
    """What is seen at a pixel."""

    layer: int
    """int: the layer that it is in. -1 for the mesh."""
    owner: int
    """int: the owner of the piece of a layer."""
    pick: int | tuple[int, int] | None
    """int, (int, int) or None: the vertex or the edge. None for a place."""
    triangle: int
    """int: the triangle of the place, or the one seen there, or -1."""
    place: NDArray[np.float64]
    """(3,) float64: in the coordinates of the points."""
    depth: float
    """float: how far a piece or the surface is from the near plane."""
    is_feature: bool
    """bool: whether it is a corner, a strong feature or a crest."""
    crossing: tuple[int, int] | None
    """(int, int) or None: the edge that crosses the edge at its end nearer to the cursor."""
    is_close_call: bool
    """bool: whether one of both edges is too short to point at."""
    is_inside: bool
    """bool: whether the cursor is inside a face, away from the edge."""

class Picker:
    """Finds what is under the cursor on a mesh.

    Threads build its tables. A query before they are built waits for them.

    Parameters
    ----------
    points : (n, 3) array_like of float
    triangles : (m, 3) array_like of int
    polygons : (m,) array_like of int
        The polygon of each triangle. Triangles of a polygon follow one another.
    edges : (e, 2) array_like of int
        The edges of the polygons, without diagonals, and edges without a polygon.
    to_object : (3, 3) array_like of float
        Takes points to object coordinates.

    Raises
    ------
    ValueError
        If an array has the wrong shape or type, a vertex does not exist, or the numbers of triangles and polygons differ.
    """

    def __init__(
        self,
        points: ArrayLike,
        triangles: ArrayLike,
        polygons: ArrayLike,
        edges: ArrayLike,
        to_object: ArrayLike,
    ) -> None: ...
    def set_layer(
        self,
        number: int,
        ends: ArrayLike,
        owners: ArrayLike,
        reach: float,
        vertices: ArrayLike = (),
    ) -> None:
        """Set the straight pieces of one layer.

        Parameters
        ----------
        number : int
            Of the layer, below 64.
        ends : (2k, 3) array_like of float
            Two for each piece, twice the same for a point.
        owners : (k,) array_like of int
            The number of each piece's curve. For crest lines, the triangle of each piece.
        reach : float
            Pixels beside a piece in which it is found.
        vertices : (k, 2) array_like of int
            For crest lines, the vertices nearest to the ends of each piece.
        """
    def set_vertices(self, strengths: ArrayLike, least_strength: float, preferred: ArrayLike) -> None:
        """Set which vertices are features, and which are preferred to others.

        Parameters
        ----------
        strengths : (n,) array_like of float
            How strong the feature is at each vertex, or nothing.
        least_strength : float
            Only vertices above it are features.
        preferred : (k,) array_like of int
        """
    def pick(
        self,
        perspective: ArrayLike,
        matrix: ArrayLike,
        size: tuple[float, float],
        cursor: tuple[float, float],
        clip_planes: ArrayLike = (),
        scale: float = 1.0,
        xray: bool = False,
        *,
        layers: ArrayLike = (),
        layers_only: bool = False,
        surface_only: bool = False,
        vertices_only: bool = False,
        edges_only: bool = False,
        anywhere: bool = False,
        preferred: bool = False,
        features: bool = False,
        crests: int = -1,
    ) -> Picked | None:
        """Find what a click would take.

        Parameters
        ----------
        perspective, matrix : (4, 4) array_like of float
            Take world coordinates to clip space, and object coordinates to world coordinates.
        size, cursor : (float, float)
            The size of the picture, and a place in it from the bottom left, in pixels.
        clip_planes : (k, 4) array_like of float
            Nothing on the negative side of a plane is shown.
        scale : float
            Of the display. Distances in pixels are multiplied by it.
        xray : bool
            Whether to find what lies behind faces too.
        layers : (k,) array_like of int
            Layers that are found before the mesh, in this order.
        layers_only, surface_only : bool
            Find only these, or only the point of the surface.
        vertices_only, edges_only : bool
            Of the plain mesh, find vertices alone, or edges with the edge that crosses them.
        anywhere : bool
            Find the point of the surface if no vertex is meant.
        preferred, features : bool
            Find preferred vertices, or corners of sharp edges and otherwise the strongest feature nearby.
        crests : int
            The layer of crest lines, or -1.

        Returns
        -------
        Picked or None

        Raises
        ------
        ValueError
            If what was set does not belong to the mesh.
        """
    def wait(self) -> None:
        """Wait until the tables are built."""

def face_segments(surface: Surface, cut_edges: ArrayLike) -> NDArray[np.int32]:
    """Find the segments into which cuts along edges divide a surface.

    Edges with three or more triangles, and edges whose triangles cannot be oriented alike, join nothing.

    Parameters
    ----------
    surface : Surface
    cut_edges : (k, 2) array_like of int
        Vertex pairs. Pairs that are not real edges, such as diagonals of polygons, cut nothing.

    Returns
    -------
    (m,) int32
        The segment of each triangle. Segment 0 has the most triangles, and so on.

    Raises
    ------
    ValueError
        If a vertex is out of range.
    """

def missing_cuts(surface: Surface, cut_edges: ArrayLike, segments: ArrayLike) -> NDArray[np.int32]:
    """Count how many more cuts each segment needs before it can lie flat with little stretch.

    Each cut leads from border to border. A segment without a border, such as a ball, needs another cut first to get one.
    A hole in a nearly flat place needs no cut.
    Edges with three or more triangles are borders. So are edges whose triangles cannot be oriented alike.

    Parameters
    ----------
    surface : Surface
    cut_edges : (k, 2) array_like of int
        Vertex pairs, as for `face_segments`.
    segments : (m,) array_like of int
        The segment of each triangle, as from `face_segments`.

    Returns
    -------
    (count,) int32
        0 for a disc, and 1 for a tube or a closed ball. 2 for a disc with a handle, and 3 for a torus.

    Raises
    ------
    ValueError
        If a vertex is out of range, or the segments belong to another surface or to other cuts.
    """

class CutCurve:
    """A curve to be cut into a mesh, see `plan_cuts`.

    Parameters
    ----------
    points : (k, 3) array_like of float
        At least two, on the mesh or near it.
    start : int or (int, (3,) array_like)
        Where it begins: a vertex, or a triangle and barycentric coordinates. If the first point does not lie there, a
        vertex only names the polygons in which the curve may begin.
    end : int or (int, (3,) array_like), optional
        Where it ends. None: wherever the last point lies.
    faces : (k - 1,) array_like of int, optional
        The triangle that each segment lies in. If the curve does not run there, they are found instead.
    image_of : int, optional
        The number of an earlier curve that this one is a mirror image of. It is skipped if that one is left out.

    Raises
    ------
    ValueError
        If a value has another form.
    """

    def __init__(
        self,
        points: ArrayLike,
        start: int | tuple[int, ArrayLike],
        end: int | tuple[int, ArrayLike] | None = None,
        faces: ArrayLike | None = None,
        image_of: int | None = None,
    ) -> None: ...

class CutPlan:
    """The changes to a mesh that cut curves into it, see `plan_cuts`."""

    vertices: NDArray[np.int32]
    """(k, 3) int32: the vertices between which each node lies, ascending. Unused ones are -1, and come last."""
    weights: NDArray[np.float64]
    """(k, 3) float64: the weight of each of these vertices. The sum is 1."""
    polygons: NDArray[np.int32]
    """(k,) int32: the polygon that each node lies inside. -1 if it is a vertex or lies on an edge."""
    splits: list[tuple[tuple[int, int], list[int]]]
    """list of ((int, int), list of int): the edges that get new vertices, the smaller vertex
    first, and the nodes on each, from that vertex on.
    """
    along: NDArray[np.int32]
    """(s, 2) int32: cuts between two neighboring vertices or nodes of one edge."""
    across: list[tuple[int, NDArray[np.int32], bool]]
    """list of (int, (s, 2) int32, bool): each polygon that is cut, and the cuts from node to
    node inside it. True if the polygon is folded or has no area. Its cuts were planned on a
    regular polygon then.
    """
    left_out: list[tuple[int, int]]
    """list of (int, int): the curves that do not run over the mesh, without their images, and
    a vertex near where each leaves the mesh.
    """
    def node_at(self, corners: ArrayLike, barycentric: ArrayLike) -> int | None:
        """Find the node at a point of a triangle.

        Parameters
        ----------
        corners : (3,) array_like of int
            The vertices of the triangle.
        barycentric : (3,) array_like of float

        Returns
        -------
        int or None
            The node there, or the one that was moved away from there. None if no cut passes.

        Raises
        ------
        ValueError
            If an array has the wrong shape or type.
        """

def plan_cuts(
    points: ArrayLike,
    triangles: ArrayLike,
    polygons: ArrayLike,
    curves: Sequence[CutCurve],
    progress: Callable[[float], bool | None] | None = None,
) -> CutPlan:
    """Plan how to cut curves into polygons.

    If a curve ends inside a polygon and no other curve continues from there, it is cut only as far as the last edge that it
    crosses. Curves that cross or run close to each other meet in common nodes. A cut that passes a vertex or an edge at
    less than 0.05, as a fraction of an edge's length or a triangle's height, goes through it.

    Parameters
    ----------
    points : (n, 3) array_like of float
    triangles : (m, 3) array_like of int
        The polygons, cut into triangles.
    polygons : (m,) array_like of int
        The polygon of each triangle, ascending.
    curves : sequence of CutCurve
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    CutPlan

    Raises
    ------
    ValueError
        If sizes do not fit, a number is out of range, or the triangles of a polygon do not form a polygon.
    Cancelled
    """

class Flattening:
    """A UV map of a surface."""

    uvs: NDArray[np.float64]
    """(m, 3, 2) float64: the UVs of each triangle's corners, in the points' unit of length. Islands may lie on each other."""
    islands: NDArray[np.int32]
    """(m,) int32: the island of each triangle."""
    energy: float
    """float: as `MapReport.energy`."""
    island_energies: NDArray[np.float64]
    """(k,) float64: the symmetric Dirichlet energy of each island, averaged over its area; 4 for an isometry."""
    island_areas: NDArray[np.float64]
    """(k,) float64: areas on the surface, in the points' unit squared."""
    overlapping: NDArray[np.int32]
    """(j,) int32: the islands that cover a part of the plane twice. Crossings by less than 5e-7 of the square root of the area may not count."""
    straight: NDArray[np.int32]
    """(j,) int32: the islands that were laid out straight."""
    opened: NDArray[np.int32]
    """(k,) int32: how many edges of each island the map is opened along in addition to the cuts."""
    steps: NDArray[np.int32]
    """(k,) int32: how many Newton steps each island took."""

class MapReport:
    """The distortion, flips and overlaps of a UV map."""

    energy: float
    """float: the symmetric Dirichlet energy, averaged over the area at the best uniform scale. Flipped triangles are left out, and then the worst .1 % of the area. 4 for an isometry."""
    energies: NDArray[np.float64]
    """(m,) float64: the energy of each triangle at that scale; infinite if it is flipped, 0 if it is left out. Triangles lower than 1e-4 of their longest side count as if they were that high."""
    flipped: NDArray[np.int32]
    """(j,) int32: triangles that are turned over against their island, or have no area in the map."""
    overlapping: NDArray[np.int32]
    """(k,) int32: islands that cover a part of the plane twice, or have a flipped triangle."""
    colliding: NDArray[np.int32]
    """(k,) int32: islands that cover a part of another island, and those other islands."""

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
    max_steps: int = 100,
    tolerance: float = 1e-06,
    progress: Callable[[float], bool | None] | None = None,
) -> Flattening:
    """Map each island of a surface to the plane.

    No triangle is flipped. The symmetric Dirichlet energy is at a local minimum (Smith and Schaefer, "Bijective
    Parameterization with Free Boundaries", 2015). `overlapping` lists islands that overlap themselves in spite of
    `keep_apart`. Islands are the segments of `face_segments`. An island without a boundary or with handles is opened along
    short paths of real edges.

    Parameters
    ----------
    points : (n, 3) array_like of float
        Finite coordinates.
    triangles : (m, 3) array_like of int
        Vertex numbers.
    cuts : (k, 2) array_like of int
        Vertex pairs: the edges that are seams. Pairs without an edge cut nothing.
    start : (m, 3, 2) array_like of float, optional
        A former map, of any scale. Islands start from it if it is continuous there and flips no triangle. They start
        without it if its energy is above 1e12.
    keep_apart : bool
        Whether an island that overlaps itself is solved again with a barrier along its outline.
    straighten : float, optional
        Lay an island that is a rectangle of quads out straight along the axes if that adds at most this to its energy:
        finite, 0 or more. None: islands stay as they are flattened.
    up : (3,) array_like of float, optional
        A direction of the model, not zero. Islands are turned such that it points to +v in the mean. An island without a
        clear up lies with its longer side along v. None: islands are not turned.
    edges : (e, 2) array_like of int, optional
        The real edges, if the triangles come from polygons. The map is continuous across all other edges of triangles. None:
        every edge of a triangle is real.
    max_steps : int
        The largest number of Newton steps of one solve, 0 or more. An island may be solved several times.
    tolerance : float
        The predicted decrease of the mean energy below which an island is finished, 0 or more.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    Flattening

    Raises
    ------
    ValueError
        If an array has the wrong shape or type, a number is not finite, a vertex is out of range, there is no edge, or
        `straighten`, `max_steps` or `tolerance` is negative. Also if an island cannot be mapped.
    Cancelled
    """

def measure_map(
    points: ArrayLike,
    triangles: ArrayLike,
    uvs: ArrayLike,
    islands: ArrayLike | None = None,
    *,
    edges: ArrayLike | None = None,
    progress: Callable[[float], bool | None] | None = None,
) -> MapReport:
    """Measure any UV map of a surface.

    Parameters
    ----------
    points : (n, 3) array_like of float
        Finite coordinates.
    triangles : (m, 3) array_like of int
        Vertex numbers.
    uvs : (m, 3, 2) array_like of float
        The UVs of each triangle's corners.
    islands : (m,) array_like of int, optional
        The island of each triangle, numbered from 0. By default, triangles that agree on the UVs of an edge are in one
        island.
    edges : (e, 2) array_like of int, optional
        The real edges, if the triangles come from polygons. None: every edge of a triangle is real.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    MapReport

    Raises
    ------
    ValueError
        If an array has the wrong shape or type, a number is not finite, or a vertex or an island is out of range.
    Cancelled
    """

def map_energy(
    points: ArrayLike,
    triangles: ArrayLike,
    uvs: ArrayLike,
    islands: ArrayLike | None = None,
    *,
    edges: ArrayLike | None = None,
    progress: Callable[[float], bool | None] | None = None,
) -> float:
    """Compute only `MapReport.energy` of any UV map of a surface, in less time than `measure_map`.

    Parameters
    ----------
    points : (n, 3) array_like of float
        Finite coordinates.
    triangles : (m, 3) array_like of int
        Vertex numbers.
    uvs : (m, 3, 2) array_like of float
        The UVs of each triangle's corners.
    islands : (m,) array_like of int, optional
        As in `measure_map`.
    edges : (e, 2) array_like of int, optional
        As in `measure_map`.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    float
        The energy: 4 for an isometry, infinite if no triangle remains.

    Raises
    ------
    ValueError
        If an array has the wrong shape or type, a number is not finite, or a vertex or an island is out of range.
    Cancelled
    """

class Packing:
    """Places of islands in the unit square."""

    placements: NDArray[np.float64]
    """(k, 2, 3) float64: the map of each island to the square. A point (x, y) of the island lies at placement @ (x, y, 1). Zero for an island without triangles."""
    scale: float
    """float: the factor from the islands' lengths to heights in the square, the same for all islands."""
    used: float
    """float: the share of the square that triangles cover."""

def pack_islands(
    uvs: ArrayLike,
    islands: ArrayLike,
    *,
    margin: float = 0.00390625,
    turns: Literal["none", "quarters", "any"] = "quarters",
    aspects: ArrayLike | None = None,
    progress: Callable[[float], bool | None] | None = None,
) -> Packing:
    """Pack islands into the unit square, at one scale that is as large as possible.

    Islands do not overlap. They may lie in notches and holes of other islands. The scale is found by search in a bounded
    time. The result does not depend on the number of threads.

    Parameters
    ----------
    uvs : (m, 3, 2) array_like of float
        The corners of triangles, in one unit of length for all islands, at most 1e100.
    islands : (m,) array_like of int
        The island of each triangle, numbered from 0.
    margin : float
        The least distance between islands, in parts of the square's side: 0 to 0.25. The sides of the square keep half of
        it. It is at most 0.15 over the square root of the number of islands.
    turns : {'none', 'quarters', 'any'}, optional
        How islands may be turned. 'quarters': by multiples of 90 degrees. An island is turned only if it has no place without
        a turn in the packing that was found. Of more than 64 turned islands, this holds for the largest 64. 'any': islands
        with at least 1/40 of the area may lie in several directions. Other islands, and islands that nearly fill the smallest
        rectangle around them, lie along the axes.
    aspects : (k,) array_like of float, optional
        For each island, the width over the height of the image on which it lies, 0.001 to 1000. None: all images are square.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    Packing

    Raises
    ------
    ValueError
        If an array has the wrong shape or type, or a value is out of range or not finite.
    Cancelled
    """

class UnwrapMesh:
    """The polygons of a mesh with their islands, for UV maps.

    Corners are numbered polygon by polygon. UVs of all corners are (c, 2) array_like of float. Methods raise ValueError if
    an array has the wrong shape or type, or a number is out of range.

    A vertex in the middle of a straight side of two polygons may be in a triangle without area on both sides. Maps are made
    without it. Then it is put on the straight line between its neighbors.

    Parameters
    ----------
    points : (n, 3) array_like of float
        Finite coordinates.
    vertices : (c,) array_like of int
        The vertex of each corner.
    edges : (c,) array_like of int
        The edge from each corner to the next corner of its polygon.
    sizes : (p,) array_like of int
        How many corners each polygon has.
    triangles : (t, 3) array_like of int
        Corners: how polygons are drawn.
    islands : (p,) array_like of int
        The island of each polygon, from 0, or -1 if it is hidden.
    seams : (e,) array_like of bool
        Whether each edge is a seam.

    Raises
    ------
    ValueError
        If arrays do not fit together.
    """

    def __init__(
        self,
        points: ArrayLike,
        vertices: ArrayLike,
        edges: ArrayLike,
        sizes: ArrayLike,
        triangles: ArrayLike,
        islands: ArrayLike,
        seams: ArrayLike,
    ) -> None: ...
    def changes(self, uvs: ArrayLike, memory: ArrayLike) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
        """Find the islands that no longer are what the seams say.

        The map is torn at an edge without a seam of such an island, is whole at a seam, or has no area. Or it has a polygon
        without area, a part that is folded over, or a new island that overlaps.

        Parameters
        ----------
        uvs : (c, 2) array_like of float
            The map.
        memory : (e,) array_like of int
            What each edge was when it was unwrapped last: 0 not known, 1 no seam, 2 a seam. 3: its polygons were joined later,
            so that the map may be torn inside them. An edge that still is what it was does not count.

        Returns
        -------
        changed : (k,) bool
            Whether each island has changed.
        densities : (k,) float64
            Lengths in the map over lengths on the model, the same for islands that are one in the map. 0 if it is not known.
        """
    def flatten(
        self,
        islands: ArrayLike,
        *,
        start: ArrayLike | None = None,
        straighten: float | None = None,
        up: ArrayLike | None = None,
        progress: Callable[[float], bool | None] | None = None,
    ) -> tuple[NDArray[np.int32], NDArray[np.float64], NDArray[np.int32], NDArray[np.bool_]]:
        """Map some islands to the plane, as `flatten` does.

        Parameters
        ----------
        islands : (j,) array_like of int
            Their numbers.
        start : (c, 2) array_like of float, optional
            A former map, of any scale. It is not used if it has places that are not finite.
        straighten, up, progress
            As for the function `flatten`.

        Returns
        -------
        corners : (i,) int32
            The corners of these islands, ascending.
        uvs : (i, 2) float64
            Their places, in the points' unit of length.
        parts : (i,) int32
            Which of them hang together in the map. Parts may lie on each other.
        straight : (k,) bool
            Whether each island of the mesh was laid out straight.
        """
    def turn_back(self, uvs: ArrayLike, islands: ArrayLike) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
        """Turn back triangles of some islands that rounding to single precision has turned over.

        Parameters
        ----------
        uvs : (c, 2) array_like of float
            The map, in single precision.
        islands : (j,) array_like of int
            The numbers of the islands.

        Returns
        -------
        corners : (j,) int32
            The corners that move.
        uvs : (j, 2) float64
            Their new UVs.
        """
    def count_unmapped(self, uvs: ArrayLike) -> int:
        """Count the hidden polygons that have an area on the model, but none in the map.

        Parameters
        ----------
        uvs : (c, 2) array_like of float
            The map.

        Returns
        -------
        int
        """

def island_copies(
    islands: Sequence[tuple[UnwrapMesh, ArrayLike]],
) -> list[tuple[int, int, NDArray[np.int32], int, NDArray[np.int32]]]:
    """Find the islands that are copies of earlier ones: the same polygons with the same lengths, mirrored or not.

    Parameters
    ----------
    islands : sequence of (UnwrapMesh, (j,) array_like of int)
        Meshes with the numbers of islands.

    Returns
    -------
    list of (int, int, (c,) int32, int, (c,) int32)
        For each copy: the place of its mesh in the sequence, its island, its corners, the place of the mesh of the first
        island of this shape, and the corners there that correspond.

    Raises
    ------
    ValueError
        If an item is no such pair, or an island is out of range.
    """

def map_faults(
    maps: Sequence[tuple[UnwrapMesh, ArrayLike, ArrayLike, ArrayLike | None]],
    *,
    may_stack: bool = False,
    progress: Callable[[float], bool | None] | None = None,
) -> tuple[int, int, int]:
    """Count what is wrong with islands in a UV map that meshes share.

    Parameters
    ----------
    maps : sequence of (UnwrapMesh, (j,) array_like of int, (c, 2) array_like of float, (c, 2) array_like of float or None)
        All that lies in the map: meshes, the islands whose faults count, UVs, and UVs in the former map. Other islands are
        what these may overlap. A polygon has no place if a UV is not finite.
    may_stack : bool
        Whether islands may lie exactly on each other.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    flipped : int
        Polygons that are turned over against their island, or have no area or no place in the map.
    overlapping : int
        Islands that cover a part of themselves or of another island.
    outside : int
        Islands that lie neither in the UV square nor in the unit square where they were.

    Raises
    ------
    ValueError
        If an item is no such tuple, an array has the wrong shape or type, or a number is out of range.
    Cancelled
    """

def map_stretch(
    points: ArrayLike,
    triangles: ArrayLike,
    polygons: ArrayLike,
    uvs: ArrayLike,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Measure how much a UV map stretches polygons, in octaves (powers of two).

    Let s1 >= s2 be the singular values of the map from a triangle to its UVs. Octaves above 5 count as 5. Polygons without
    area have zero.

    Parameters
    ----------
    points : (n, 3) array_like of float
        Vertices.
    triangles : (m, 3) array_like of int
        Vertex numbers.
    polygons : (m,) array_like of int
        The polygon that each triangle is part of, ascending.
    uvs : (m, 3, 2) array_like of float
        The UVs of each triangle's corners.

    Returns
    -------
    angle : (m,) float64
        log2(s1 / s2) of each triangle's polygon.
    area : (m,) float64
        log2(s1 s2) of each triangle's polygon, where the mean of all is zero: positive where the map enlarges.

    Raises
    ------
    ValueError
        If an array has the wrong shape or type, or a vertex is out of range.
    """

def island_hues(
    triangles: ArrayLike,
    islands: ArrayLike,
    cuts: ArrayLike,
    former_islands: ArrayLike = (),
    former_hues: ArrayLike = (),
) -> NDArray[np.uint8]:
    """Choose a hue for each island, far in the rainbow from those of its neighbors.

    Hue h is the color at (4 + 5 h) mod 12 twelfths of the rainbow. Neighbors meet at a cut edge. Their hues are 3 twelfths
    apart where possible. If there are more than 4096 islands, neighbors may have equal hues.

    Parameters
    ----------
    triangles : (m, 3) array_like of int
        Vertex numbers.
    islands : (m,) array_like of int
        The island of each triangle, from 0. The largest island comes first.
    cuts : (k, 2) array_like of int
        Vertex pairs.
    former_islands : (m,) array_like of int, optional
        The islands that there were before. An island keeps the hue of the one to which most of it belonged, unless a larger
        neighbor has one that is too near.
    former_hues : (j,) array_like of int, optional
        Their hues.

    Returns
    -------
    (count,) uint8
        The hue of each island, from 0 to 11.

    Raises
    ------
    ValueError
        If an array has the wrong shape or type, or a number is out of range.
    """

def place_islands(
    before: ArrayLike,
    after: ArrayLike,
    triangles: ArrayLike,
    islands: ArrayLike,
    areas: ArrayLike,
    *,
    taken: ArrayLike = (),
    aspects: ArrayLike | None = None,
    straight: ArrayLike | None = None,
    progress: Callable[[float], bool | None] | None = None,
) -> NDArray[np.float64]:
    """Find a place for new islands among parts of a UV map that stay.

    Each island is turned as it was, and gets the nearest free place of its former unit square. Islands for which that
    square has no room lie to the right of everything.

    Parameters
    ----------
    before : (c, 2) array_like of float
        Each corner's UV in the old map. An island with a UV that is not finite had no place.
    after : (c, 2) array_like of float
        Each corner's place now, of any scale, as the image shows it: u is multiplied by the aspect. Finite for the corners
        of triangles.
    triangles : (t, 3) array_like of int
        Corners.
    islands : (t,) array_like of int
        The island of each triangle, numbered from 0.
    areas : (k,) array_like of float
        The wanted area of each island in the map. 0 keeps its scale.
    taken : (b, 4) array_like of float, optional
        Boxes around what stays: low u, low v, high u, high v.
    aspects : (k,) array_like of float, optional
        As in `pack_islands`.
    straight : (k,) array_like of bool, optional
        Whether an island's sides run along the axes, and stay so.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    (k, 2, 3) float64
        The map of each island to its place, as `Packing.placements`.

    Raises
    ------
    ValueError
        If an array has the wrong shape or type, or a value is out of range or not finite.
    Cancelled
    """

class PlannedWire:
    """One wire of a `SeamPlan`."""

    seeds: tuple[int, int]
    """(int, int): the vertices between which it runs."""
    follow: Literal["min", "max"]
    """{'min', 'max'}: the metric in which a wire across the surface is short."""
    vertices: NDArray[np.int32]
    """(k,) int32: the chain of edges that it marks, from seed to seed."""
    points: NDArray[np.float64]
    """(p, 3) float64: its curve, in the caller's coordinates."""
    faces: NDArray[np.int32]
    """(p - 1,) int32: the triangle of each segment, -1 along an edge without one. Only across the surface."""

class SeamPlan:
    """Seams that cut a surface into islands."""

    wires: list[PlannedWire]
    """list of PlannedWire: without the seams that were there."""
    islands: NDArray[np.int32]
    """(m,) int32: the island of each triangle, numbered as by `face_segments`."""
    island_count: int
    """int: how many islands there are."""
    islands_to_cut: int
    """int: how many islands need more cuts, see `missing_cuts`."""
    exposed_wires: int
    """int: how many wires run through exposed places, such as the eyes, nose and lips of a head. There are some only if an island needs them to lie flat within the bound, or if the bound is below 4.15."""
    cost: float
    """float: the price of the slits that the search worked on, for a surface of area 1. Lower is better. Each slit costs the prices of its edges, plus a fixed amount unless the island needs it to lie flat. Wires across the surface may run beside their slits, and are not priced again."""
    energy: float
    """float: the symmetric Dirichlet energy of the planned map, as `MapReport.energy`; infinite if an island has no map. Pieces in which no seam may run do not count. 4 for an isometry, and if no piece counts."""
    is_reached: bool
    """bool: whether the energy is within the bound, and no island that may be cut overlaps itself."""
    steps: float
    """float: Newton steps that planning took, each times the share of the surface."""
    uvs: NDArray[np.float64] | None
    """(m, 3, 2) float64 or None: the planned map, in the caller's unit of length. None for a plan that
    was found on the way.
    """

class SeamPlanner:
    """Plans seams like an artist's: few, short, and hidden.

    A seam costs its length times how visible it is, and pays by lowering the distortion of the map. The planner starts with
    a tree of slits to the tips of limbs. It adds slits where the map is distorted. Then it shortens and exchanges slits
    while the distortion stays within a bound.

    Parameters
    ----------
    surface : Surface
    along : {'surface', 'edges'}
        Where wires run.
    max_anisotropy, clamp_percentile : float
        Of the feature metric in which wires across the surface are short, as for `feature_metric`.
    front : (3,) array_like of float, optional
        The direction from the surface towards a viewer. Seams hide from there. None: they hide from ambient light only.
    mirror : {0, 1, 2}, optional
        The axis along which a plane mirrors the surface: through the origin, or else through the middle of its box. On a
        symmetric surface, most seams run along the plane or come in mirrored pairs.
    weights : (n,) array_like of float, optional
        The cost of seams at each vertex, as a factor. Infinity keeps seams away.
    seams : (k, 2) array_like of int, optional
        Vertex pairs: the edges that are seams already. They stay.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Raises
    ------
    ValueError
        If a parameter is out of range.
    Cancelled
    """

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
        progress: Callable[[float], bool | None] | None = None,
    ) -> None: ...
    def plan(
        self,
        *,
        distortion: float = 4.2,
        islands: int = 0,
        steps: int = 0,
        progress: Callable[[float], bool | None] | None = None,
    ) -> SeamPlan:
        """Plan seams.

        Parameters
        ----------
        distortion : float
            The bound on `SeamPlan.energy`; above 4, the energy of an isometry. Infinity: islands only have to be discs.
        islands : int
            The smallest number of islands. Limbs are separated first, then large islands are cut into halves. There are fewer
            islands only if no seam may run inside of any.
        steps : int
            The number of Newton steps after which the search in a piece ends. It finishes what it has begun, so a small number
            may be exceeded many times. A piece that misses the bound is searched again, with as many steps. 0: 4000,
            or 0.04 for each triangle of a surface of 9,000 to 100,000.
        progress : callable, optional
            Called repeatedly with the fraction done. Returning False cancels, and `best_so_far` keeps the best plan.

        Returns
        -------
        SeamPlan

        Raises
        ------
        ValueError
            If a parameter is out of range.
        Cancelled
        """
    best_so_far: SeamPlan | None
    """SeamPlan or None: the best plan that a running or cancelled `plan` has found; None before the first. Any thread may read it."""

def has_scanned_edges(points: ArrayLike, triangles: ArrayLike, polygons: ArrayLike | None = None) -> bool:
    """Tell whether the edges of a mesh come from a scan, a sculpt or a remesher.

    Wires should then run across the surface. Artists let edges run along and across the bends of the surface, and make
    faces small where the shape needs it. Scans have edges in all directions, and remeshed surfaces have edges of one
    length. Meshes of fewer than 2,000 triangles, or mostly of quads, count as an artist's.

    Parameters
    ----------
    points : (n, 3) array_like of float
    triangles : (m, 3) array_like of int
    polygons : (m,) array_like of int, optional
        The polygon of each triangle. If not given, each triangle is one.

    Returns
    -------
    bool

    Raises
    ------
    ValueError
        If a vertex is out of range, or the arrays do not fit.
    """

class Parts:
    """The parts of a surface."""

    of_face: NDArray[np.int32]
    """(m,) int32: the part of each triangle, numbered as by `face_segments`."""
    count: int
    """int: how many parts there are."""
    borders: list[NDArray[np.int32]]
    """list of (k,) int32: chains of vertices between parts, from junction to junction. A closed
    chain ends with its first vertex. Existing seams are left out.
    """

class PartFinder:
    """Finds the parts that an artist would make islands of.

    Parameters
    ----------
    surface : Surface
    by : {'rims', 'limbs', 'panels', 'shape'}
        What separates parts. 'rims': sharp edges, as of props and machines. 'limbs': narrow and concave places, as between
        head, arms and body of a figure. 'panels': the sides, as between front and back of a shirt, and sharp edges.
        'shape' chooses one of the others. Figures have few limbs: at most 8 % of their area is flat, and they are scans,
        sculpts, or soft shapes whose rims take off details only. Up to 1,000 quads are smoothed first. A connected piece
        has panels if at most 15 % of the edge length bends by more than 30 degrees, and at least three boundaries are open.
        Everything else has rims.
    scan : bool, optional
        For 'shape': whether the edges come from a scan. If not given, `has_scanned_edges` decides. From 20,000 triangles, a
        mesh counts as a sculpt anyway.
    nets : bool
        For rims: whether flat faces that unfold into the plane together are one part, as those of a box.
    front : (3,) array_like, optional
        The direction to the viewer. For 'panels', it is the direction to the front. Without it, and for 'shape', the front
        is where a piece is thinnest. For 'shape', no border of limbs runs around a face that the viewer sees.
    mirror : {0, 1, 2}, optional
        The axis along which a plane mirrors the surface, as for `SeamPlanner`. Rims are then symmetric wherever the
        triangles are mirrored. Limbs are symmetric if at least 95 % of the edges are mirrored.
    marked : list of (k, 2) array_like of int, optional
        Edges where an artist expects a border, for each kind of mark: marked sharp, or between materials. A kind counts
        only on connected pieces where it marks at most 80 % of the inner edges. Marks that are everywhere say nothing.
    seams : (k, 2) array_like of int, optional
        The edges that are seams already. They part the surface.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Raises
    ------
    ValueError
        If a parameter is out of range.
    Cancelled
    """

    def __init__(
        self,
        surface: Surface,
        *,
        by: Literal["rims", "limbs", "panels", "shape"] = "rims",
        scan: bool | None = None,
        nets: bool = True,
        front: ArrayLike | None = None,
        mirror: Literal[0, 1, 2] | None = None,
        marked: list[ArrayLike] | None = None,
        seams: ArrayLike | None = None,
        progress: Callable[[float], bool | None] | None = None,
    ) -> None: ...
    def find(
        self,
        amount: float = 0.5,
        *,
        kept: ArrayLike | None = None,
        dropped: ArrayLike | None = None,
        parted: ArrayLike | None = None,
        progress: Callable[[float], bool | None] | None = None,
    ) -> Parts:
        """Find the parts.

        Parameters
        ----------
        amount : float
            From 0, which joins all that is connected, to 1, which parts at all sharp edges.
        kept, dropped : (k, 2) array_like of int, optional
            Edges that have to be borders, and edges that must not be.
        parted : array_like of int, optional
            A triangle for each part that is cut in two, one after another. The cut through a symmetric part is symmetric if
            such a cut leaves each half a fifth of the area.
        progress : callable, optional
            Called repeatedly with the fraction done. Returning False cancels.

        Returns
        -------
        Parts

        Raises
        ------
        ValueError
            If a parameter is out of range.
        Cancelled
        """
    by: Literal["rims", "limbs", "panels"]
    """{'rims', 'limbs', 'panels'}: what separates parts."""

class CrestLines:
    """Ridges and valleys, the strongest first."""

    points: NDArray[np.float64]
    """(p, 3) float64: the points of all lines, one line after the other. A closed line repeats its first point."""
    edges: NDArray[np.int32]
    """(p, 2) int32: the edge that each point lies on."""
    t: NDArray[np.float64]
    """(p,) float64: the position on that edge, from 0 at its first vertex to 1 at its second."""
    curvatures: NDArray[np.float64]
    """(p,) float64: k1, in 1 / unit of the points. Above 0 on ridges, below 0 in valleys."""
    faces: NDArray[np.int32]
    """(p,) int32: the triangle between a point and the next; -1 for a line's last point."""
    starts: NDArray[np.int32]
    """(k + 1,) int32: line i has the points starts[i] to starts[i + 1]."""
    strengths: NDArray[np.float64]
    """(k,) float64: the integral of |k1| along each line, in radians; descending."""

def crest_lines(
    surface: Surface,
    curvature: Curvature,
    least_strength: float = 1.0,
    least_drop: float = 0.15,
    progress: Callable[[float], bool | None] | None = None,
) -> CrestLines:
    """Find ridges and valleys: the curves across which the surface bends most sharply (Figures 5 and 11).

    Parameters
    ----------
    surface : Surface
    curvature : Curvature
        Of that surface, best from `smoothed_curvatures`.
    least_strength : float
        At least 0. The smallest integral of |k1| along a line, in radians.
    least_drop : float
        In [0, 1). The smallest relative drop of the larger curvature at one radius of curvature on both sides. With 0,
        noise creates lines on cylinders and tori.
    progress : callable, optional
        Called repeatedly with the fraction done. Returning False cancels.

    Returns
    -------
    CrestLines

    Raises
    ------
    ValueError
        If the curvature belongs to another surface, or a number is out of range.
    Cancelled

    References
    ----------
    Yoshizawa, Belyaev, Seidel, "Fast and robust detection of crest lines on meshes" (2005), with derivatives of curvature
    as in Rusinkiewicz (2004). docs/method/curvature.md describes the differences.
    """

def isolines(
    surface: Surface,
    values: ArrayLike,
    levels: ArrayLike,
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int32]]:
    """Find where a function on a surface has given values. The function is linear on each triangle.

    Parameters
    ----------
    surface : Surface
    values : (n,) array_like of float
        The function's values at the vertices. Triangles with an infinite value are left out.
    levels : (l,) array_like of float
        Finite, ascending.

    Returns
    -------
    segments : (k, 2, 3) float64
        Straight pieces, each across one triangle, in the caller's coordinates. Neighbors share their ends.
    faces : (k,) int32
        The triangle that each piece lies in.
    levels : (k,) int32
        The number of each piece's level.

    Raises
    ------
    ValueError
        If the number of values differs from the number of vertices, a value is not a number, or the levels are not finite
        and ascending.
    """

def plane_section(
    surface: Surface,
    from_point: int | tuple[int, ArrayLike],
    to_point: int | tuple[int, ArrayLike],
    direction: ArrayLike,
) -> tuple[NDArray[np.float64], NDArray[np.int32], float]:
    """Find the curve in which a plane cuts a surface between two of its points.

    The plane contains both points and a direction. With the direction of a view, the curve is straight in that view. The
    curve is straight in each triangle, and exact except for rounding.

    Parameters
    ----------
    surface : Surface
    from_point, to_point : int, or (int, (3,) array_like)
        Vertices, or triangles with barycentric coordinates.
    direction : (3,) array_like of float
        In the caller's coordinates, of any length.

    Returns
    -------
    points : (p, 3) float64
        In the caller's coordinates, including both points. If there are two ways, the shorter one. (0, 3) if the plane's
        curve through one point ends or closes before it reaches the other point.
    faces : (p - 1,) int32
        The triangle that each segment lies in.
    length : float
        In the caller's units; inf if there is no such curve.

    Raises
    ------
    ValueError
        If a point is not on the surface, the points are equal, or the direction leads from one point to the other.
    """
