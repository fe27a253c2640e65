# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks on other meshes than they were drawn on: their seeds are placed there, and wires drawn between them."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import Moments
from ..base.messages import NOTHING
from ..network.mirror_images import MirrorImages
from ..network.network import Network
from ..network.symmetry import Symmetry
from ..solver.live_maker import LiveMaker
from ..storage.network_file import Course, NetworkFile, NetworkFileError
from .placing import Landmarks, Placed, Shape, Similarity, Surface
from .tracing import STRAY, Tracing, spacing_of
from .transferred import Seed, Transfer

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

_TURNED = 0.5
"""The confidence of the surest seed where the network might as well lie elsewhere: doubtful."""


def by_numbers(file: NetworkFile, target: Shape, *, topology: bool = False) -> Transfer:
    """Return a network on a mesh of the same topology, vertex by vertex.

    Parameters
    ----------
    file
        The network.
    target
        The mesh.
    topology
        Whether mirror images are found by how the mesh hangs together, see `Symmetry`.

    Raises
    ------
    NetworkFileError
        Where it is another mesh.
    """
    problem = file.problem_with(len(target.points), target.edges)
    if problem:
        raise NetworkFileError(problem.code, **dict(problem.values))
    to_object = np.eye(3) if target.to_object is None else target.to_object
    symmetry = Symmetry(target.points, target.edges, to_object, topology, target.triangles)
    network = MirrorImages(symmetry).complete(Network(tuple(file.wires(target.points, to_object))))
    wires = list(network.wires)
    ends = dict.fromkeys(
        vertex for wire in wires if not wire.closed for vertex in (wire.vertices[0], wire.vertices[-1])
    )
    seeds = [Seed(vertex, (), vertex, 1.0) for vertex in ends]
    return Transfer(wires, file.strokes_on(target.points, to_object), seeds)


def by_surface(
    file: NetworkFile, target: Shape, *, mirror: int | None = None, align: bool = True, live: LiveMaker | None = None
) -> Transfer:
    """Return a network on a mesh of about the same shape, whatever its topology.

    Parameters
    ----------
    file
        The network.
    target
        The mesh.
    mirror
        The axis, 0 to 2, over which it is mirrored first; None: it is not.
    align
        Whether it may be turned, scaled and moved onto the mesh, where it does not lie on it as it is.
    live
        Makes live wires on the target; None: made here.

    Raises
    ------
    ValueError
        Where no wire can run on the mesh.
    """
    surface, doubt = Surface(target), NOTHING
    way = Similarity.none() if mirror is None else Similarity.mirroring(mirror)
    if align and file.courses:
        points = way.of(np.concatenate([course.places for course in file.courses]))
        moments = file.origin.moments
        moved = Moments(way.of(moments.middle[None])[0], way.of_normals(moments.axes))
        aligned = surface.align(points, moved)
        way, doubt = aligned.way.after(way), aligned.doubt

    def place(course: Course, axes: tuple[int, ...], part: int | None = None) -> Placed:
        own = way
        for axis in axes:
            own = own.after(Similarity.mirroring(axis))
        spacing = own.scale * spacing_of(course)
        placed = surface.place(own.of(course.places), own.of_normals(course.normals), spacing, part)
        return replace(placed, confidence=np.minimum(placed.confidence, _TURNED)) if doubt else placed

    def stroke(points: NDArray[np.float64]) -> Placed:
        moved = way.of(points)
        return surface.place(moved, np.zeros_like(moved), float(target.spacing.mean()))

    found = Tracing(file, target, surface, live or LiveMaker(target)).run(place, stroke, place)
    found.doubts += [doubt] if doubt else []
    return found


def by_landmarks(
    file: NetworkFile, source: Shape, target: Shape, pairs: ArrayLike, *, live: LiveMaker | None = None
) -> Transfer:
    """Return a network on a mesh of another pose or proportion, of whatever topology.

    Parameters
    ----------
    file
        The network.
    source
        The mesh that it was drawn on.
    target
        The mesh that it is to be on.
    pairs
        (k, 2) vertices of both that are the same point of the shape, three pairs at least.
    live
        As `by_surface` takes it.

    Raises
    ------
    ValueError
        Where pairs are wrong, the network is not the source's, or no wire can run on the mesh.
    """
    problem = file.problem_with(len(source.points), source.edges)
    if problem:
        raise NetworkFileError(problem.code, **dict(problem.values))
    surface = Surface(target)
    landmarks = Landmarks(source, target, pairs)

    def place(course: Course, axes: tuple[int, ...]) -> Placed:
        vertices = np.array(course.record["vertices"], dtype=np.int64)
        if axes:
            own = np.asarray(course.places)
            for axis in axes:
                own = Similarity.mirroring(axis).of(own)
            gaps = ((source.places[None] - own[:, None]) ** 2).sum(axis=2)
            vertices = gaps.argmin(axis=1)
        return landmarks.place(vertices)

    def stroke(points: NDArray[np.float64]) -> Placed:
        gaps = ((source.places[None] - points[:, None]) ** 2).sum(axis=2)
        return landmarks.place(gaps.argmin(axis=1))

    return Tracing(file, target, surface, live or LiveMaker(target), stray=2.0 * STRAY).run(place, stroke)


def seams(transfer: Transfer) -> NDArray[np.int32]:
    """Return the edges that wires mark, (k, 2), sorted, each once."""
    edges = sorted({edge for wire in transfer.wires for edge in wire.claims()})
    return np.array(edges, dtype=np.int32).reshape(-1, 2)


def transferred_seams(
    text: str,
    points: ArrayLike,
    triangles: ArrayLike,
    edges: ArrayLike | None = None,
    *,
    mirror: int | None = None,
    align: bool = True,
) -> tuple[NDArray[np.int32], Transfer]:
    """Return what a network's file marks on a mesh: by numbers where that is the one it was drawn on, else by its surface.

    Parameters
    ----------
    text
        The content of the file.
    points
        (n, 3) vertices.
    triangles
        (m, 3)
    edges
        (e, 2) those that wires may run along; None: all sides of triangles.
    mirror, align
        See `by_surface`; with `mirror` numbers do not count.

    Returns
    -------
    tuple
        (k, 2) the edges, and all there is to know about them.

    Raises
    ------
    ValueError
        Where the file or the mesh cannot be used.
    """
    file = NetworkFile.parse(text)
    corners = np.asarray(triangles, dtype=np.int32).reshape(-1, 3)
    if edges is None:
        edges = np.unique(np.sort(corners[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    target = Shape(
        np.asarray(points, dtype=np.float64).reshape(-1, 3), corners, np.asarray(edges, dtype=np.int32).reshape(-1, 2)
    )
    same = mirror is None and not file.problem_with(len(target.points), target.edges)
    result = by_numbers(file, target) if same else by_surface(file, target, mirror=mirror, align=align)
    return seams(result), result
