# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks on other meshes than they were drawn on: their seeds are placed there, and wires drawn between them."""

from __future__ import annotations

import functools
from dataclasses import replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from .network_file import Course, NetworkFile, NetworkFileError
from .placing import PLACED, Landmarks, Moments, NearestSurface, Placed, Progress, Shape, Similarity, tell, within
from .tool import LiveMaker, MirrorImages, Network, Symmetry, load
from .tracing import STRAY, PlacedSeed, Tracing, Transfer

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray
    from seamwire_core import NearestPoints

Place = Literal["AUTO", "NUMBERS", "SURFACE", "PAIRS"]
"""How seeds are placed: by vertex numbers, on the nearest surface, or by distances to pairs of vertices. AUTO takes numbers if the topology
is the same, otherwise pairs if there are any, otherwise the surface."""

_TURNED = 0.5
"""The confidence of the surest seed if the network might as well lie elsewhere: doubtful."""


def transfer(
    file: NetworkFile,
    target: Shape,
    *,
    place: Place = "AUTO",
    mirror: int | None = None,
    align: bool = True,
    source: Shape | None = None,
    pairs: ArrayLike = (),
    topology: bool = False,
    live: LiveMaker | None = None,
    progress: Progress = lambda _: True,
) -> Transfer:
    """Find what a network is on a mesh.

    Parameters
    ----------
    mirror
        The axis, 0 to 2, over which the network is mirrored first, or None. Then it is placed on the surface.
    align
        On the surface: whether the network may be turned, scaled and moved onto the mesh, if it does not lie on it.
    source
        The mesh that the network was drawn on. PAIRS needs it.
    pairs
        (k, 2) vertices of the source and of the target that are the same point of the shape, three pairs at least.
    topology
        By numbers: whether mirror images are found by how the mesh is connected, see `Symmetry`.

    Raises
    ------
    ValueError
        If the mesh, the pairs or the choices do not fit.
    seamwire_core.Cancelled
        If `progress` returns False.
    """
    pairs = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    if mirror is not None and place in {"NUMBERS", "PAIRS"}:
        raise ValueError("Mirror needs Place: Nearest Surface")
    if place == "AUTO":
        same = mirror is None and not file.problem_with(target)
        by_pairs = len(pairs) and source is not None and mirror is None
        place = "NUMBERS" if same else "PAIRS" if by_pairs else "SURFACE"
    progress = _Told(progress)
    tell(progress, 0.0)
    if place == "NUMBERS":
        return _by_numbers(file, target, topology)
    live = live or LiveMaker(target)
    if place == "SURFACE":
        return _by_surface(file, target, mirror, align, live, progress)
    if source is None:
        raise ValueError("Pairs need the source object")
    return _by_pairs(file, source, target, pairs, live, progress)


class _Told:
    """A progress that remembers which fraction it was told last."""

    def __init__(self, progress: Progress) -> None:
        self._progress, self._done = progress, 0.0

    def __call__(self, fraction: float) -> bool:
        """Tell the finished fraction of the whole work, and return whether to continue."""
        self._done = fraction
        return self._progress(fraction)

    def go_on(self, _fraction: float) -> bool:
        """Return whether to continue, while work goes on whose part of the whole is not known."""
        return self._progress(self._done)


def _check(file: NetworkFile, shape: Shape) -> None:
    """Raise NetworkFileError if a network was drawn on another mesh."""
    if problem := file.problem_with(shape):
        raise NetworkFileError(problem)


def _by_numbers(file: NetworkFile, target: Shape, topology: bool) -> Transfer:
    """Return a network on a mesh of the same topology, vertex by vertex."""
    _check(file, target)
    symmetry = Symmetry(target.points, target.edges, target.where.to_object, topology, target.triangles)
    network = MirrorImages(symmetry).complete(Network(tuple(file.wires(target))))
    wires = list(network.wires)
    ends = dict.fromkeys(
        vertex for wire in wires if not wire.closed for vertex in (wire.vertices[0], wire.vertices[-1])
    )
    seeds = [PlacedSeed(vertex, (), vertex, 1.0) for vertex in ends]
    return Transfer(wires, file.strokes_on(target), seeds)


def _by_surface(
    file: NetworkFile, target: Shape, mirror: int | None, align: bool, live: LiveMaker, progress: _Told
) -> Transfer:
    """Return a network on a mesh with about the same shape and any topology."""
    surface, doubt = NearestSurface(target, progress.go_on), ""
    way = Similarity.mirroring(*(() if mirror is None else (mirror,)))
    if align and file.courses:
        points = way.of(np.concatenate([course.places for course in file.courses]))
        moments = file.origin.moments
        moved = Moments(way.of(moments.middle[None])[0], way.of_normals(moments.axes))
        aligned, doubt = surface.align(points, moved, progress)
        way = aligned.after(way)

    def place(course: Course, axes: tuple[int, ...], part: int | None = None) -> Placed:
        own = way.after(Similarity.mirroring(*axes))
        spacing = own.scale * course.spacing
        placed = surface.place(own.of(course.places), own.of_normals(course.normals), spacing, part)
        return replace(placed, confidence=np.minimum(placed.confidence, _TURNED)) if doubt else placed

    def stroke(points: NDArray[np.float64]) -> Placed:
        moved = way.of(points)
        return surface.place(moved, np.zeros_like(moved), float(target.spacing.mean()))

    found = Tracing(file, target, surface, live, progress).run(place, stroke, place)
    found.doubts += [doubt] if doubt else []
    return found


def _by_pairs(
    file: NetworkFile, source: Shape, target: Shape, pairs: NDArray[np.int64], live: LiveMaker, progress: _Told
) -> Transfer:
    """Return a network on a mesh with another pose or proportion and any topology."""
    _check(file, source)
    surface = NearestSurface(target, progress.go_on)
    landmarks = Landmarks(source, target, pairs, within(progress, 0.0, PLACED))
    tell(progress, PLACED)

    @functools.cache
    def vertices() -> NearestPoints:
        # Triangles without area, so that vertices without faces are found as well.
        triangles = np.repeat(np.arange(len(source.places)), 3).reshape(-1, 3)
        return load().NearestPoints(source.places, triangles, progress=progress.go_on)

    def nearest(points: NDArray[np.float64]) -> NDArray[np.int64]:
        return vertices().find(points, progress=progress.go_on)[0].astype(np.int64)

    def place(course: Course, axes: tuple[int, ...]) -> Placed:
        if axes:
            return landmarks.place(nearest(Similarity.mirroring(*axes).of(course.places)))
        return landmarks.place(np.array(course.record["vertices"], dtype=np.int64))

    def stroke(points: NDArray[np.float64]) -> Placed:
        return landmarks.place(nearest(points))

    return Tracing(file, target, surface, live, progress, stray=2.0 * STRAY).run(place, stroke)
