# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires mirrored over the axes of an object: which vertex is the partner of which, by place or by topology, and the images of wires."""

from __future__ import annotations

import itertools
import threading
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..base.half_edges import HalfEdges, after, among
from ..base.nearest_vertices import NearestVertices
from .drawn import Drawn, net_effect
from .wires import Wire

if TYPE_CHECKING:
    from collections.abc import Collection

    from numpy.typing import NDArray

    from .picks import Edge, Pick

TOLERANCE = 2e-5
"""How far from its mirror image a vertex may be where no edges are known, in object coordinates: as Blender has it."""
REACH = 0.5
"""How far a vertex may be from its mirror image, as a fraction of (sum of 1 / l^2)^(-1/2) over the lengths l of its edges. This is less
than half of the shortest edge, and a quarter of an edge in a regular quad grid."""
ROUNDING = 1e-6
"""How far in any case, as part of its coordinates: those are single precision, and have been transformed."""
SYMMETRIC = 0.75
"""Part of the vertices that have a partner where a mesh is called symmetric. By chance, where the two sides of a mesh that
has no symmetry cross each other, it is a circle's part of an edge's square, a fifth."""
_SAMPLE = 50_000
_MOST_SIDES = 4096
"""Of a polygon that partners are grown over: where faces meet wrongly, walking around one may not come to an end."""
_TRIALS = 6
"""Edges from which growing over the mesh is tried."""
_CREDIBLE = 0.5
"""Part of the pairs found by place that growing has to find as well, where it comes to them."""
_WELL_GROWN = 0.9
"""Part of the pairs found by place that growing has to find as well for no other edge to be tried."""


class Symmetry:
    """The mirror images of vertices and edges. They are computed on first use, in any thread.

    Partners are one to one: each vertex is the partner of its partner. By place, that is where each is the nearest to the
    mirror image of the other, within a part of the length of the edges around both.

    Parameters
    ----------
    points
        (n, 3) vertices; those that are not finite have no partners.
    edges
        (e, 2) edges, the only ones that images may have; None: all that are asked for.
    to_object
        (3, 3) takes `points` to object coordinates; None: they are such.
    topology
        Whether partners are found by how the mesh hangs together, beginning where they are by place: in a pose, places
        say little. Needs `triangles` and `edges`.
    triangles
        (m, 3), alike oriented; what of their sides is not in `edges` lies inside a polygon.
    """

    def __init__(
        self,
        points: NDArray[np.float64],
        edges: NDArray[np.int32] | None = None,
        to_object: NDArray[np.float64] | None = None,
        topology: bool = False,
        triangles: NDArray[np.int32] | None = None,
    ) -> None:
        self._points = points
        self._edges = edges
        self._to_object = np.eye(3) if to_object is None else np.asarray(to_object, dtype=np.float64)
        self._triangles = triangles if topology and edges is not None else None
        self._partners: dict[tuple[int, ...], NDArray[np.int64]] = {}
        self._on_plane: dict[tuple[int, ...], frozenset[int]] = {}
        # Other threads wait for the thread that prepares.
        self._lock = threading.RLock()

    @cached_property
    def _places(self) -> NDArray[np.float64]:
        with np.errstate(all="ignore"):  # they may not be finite
            return self._points @ self._to_object.T

    @cached_property
    def _reach(self) -> NDArray[np.float64]:
        """How far from its mirror image each vertex may be, (n,)."""
        count, places = len(self._places), self._places
        if self._edges is None:
            return np.full(count, TOLERANCE)
        with np.errstate(all="ignore"):
            least = ROUNDING * np.abs(places).max(axis=1, initial=0.0)
            one, two = np.asarray(self._edges, dtype=np.int64).reshape(-1, 2).T
            off = places[one] - places[two]
            squares = np.einsum("ij,ij->i", off, off)
            # Edges without a length say nothing, nor do those that have no place.
            sound = (squares > least[one] ** 2) & np.isfinite(squares)
            weights = np.where(sound, 1.0 / squares, 0.0)
            sums = np.bincount(one, weights, count) + np.bincount(two, weights, count)
            lengths = np.where(sums > 0.0, 1.0 / np.sqrt(sums), 0.0)
        return np.maximum(REACH * lengths, np.where(np.isfinite(least), least, 0.0))

    @cached_property
    def _vertices(self) -> NearestVertices:
        return NearestVertices(self._places)

    @cached_property
    def _edge_keys(self) -> NDArray[np.int64] | None:
        if self._edges is None:
            return None
        return np.sort(self._key(np.asarray(self._edges, dtype=np.int64)))

    def _key(self, pairs: NDArray[np.int64]) -> NDArray[np.int64]:
        return pairs.min(axis=-1) * len(self._points) + pairs.max(axis=-1)

    @cached_property
    def symmetric_axes(self) -> tuple[int, ...]:
        """The axes over which most vertices have a partner; of a large mesh a sample is asked."""
        found = []
        with self._lock, np.errstate(invalid="ignore"):
            rows = np.arange(0, len(self._places), max(1, len(self._places) // _SAMPLE))
            for axis in range(3):
                # What lies in the plane is its own image, and says nothing.
                aside = rows[np.abs(self._places[rows, axis]) > 0.5 * self._reach[rows]]
                if len(aside) and (self._partners_of(aside, (axis,)) >= 0).mean() >= SYMMETRIC:
                    found.append(axis)
            if found:
                # Sorted here, on the thread that asks for symmetry, rather than when the first image is drawn.
                _ = self._edge_keys
        return tuple(found)

    @staticmethod
    def _flipped(places: NDArray[np.float64], axes: tuple[int, ...]) -> NDArray[np.float64]:
        signs = np.ones(3)
        signs[list(axes)] = -1.0
        return places * signs

    def partners(self, axes: tuple[int, ...]) -> NDArray[np.int64]:
        """Return the vertex that each is mirrored to over all of the axes at once, (n,); -1: none."""
        with self._lock:
            if axes not in self._partners:
                self._partners[axes] = self._all_partners(axes)
            return self._partners[axes]

    def _all_partners(self, axes: tuple[int, ...]) -> NDArray[np.int64]:
        if self._triangles is None:
            return self._by_place(axes)
        if len(axes) == 1:
            return grown_partners(self._triangles, np.asarray(self._edges), self._by_place(axes))
        first, rest = self.partners(axes[:1]), self.partners(axes[1:])
        return np.where(rest >= 0, first[rest], -1)

    def _by_place(self, axes: tuple[int, ...]) -> NDArray[np.int64]:
        near = self._vertices.find(self._flipped(self._places, axes), self._reach)
        numbers = np.arange(len(near))
        back = np.where(near >= 0, near[near], -1)
        partners = np.where(back == numbers, near, -1)
        # Of several vertices in one place the search finds the first. The second's partner is the second of those where the
        # partner of the first is, and so on: halves that mirror each other have most often the same order.
        rows = np.flatnonzero((back >= 0) & (back != numbers))
        rows = rows[(self._places[back[rows]] == self._places[rows]).all(axis=1)]
        if len(rows):
            rows = rows[np.argsort(back[rows], kind="stable")]
            firsts = back[rows]
            ranks = np.arange(len(rows)) - np.searchsorted(firsts, firsts)
            span = int(ranks.max()) + 1
            keys, wanted = firsts * span + ranks, near[rows] * span + ranks
            at = np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)
            partners[rows] = np.where(keys[at] == wanted, rows[at], -1)
        return partners

    def _partners_of(self, vertices: NDArray[np.int64], axes: tuple[int, ...]) -> NDArray[np.int64]:
        """Return what a few vertices are mirrored to; of a large mesh not all are looked for because of them."""
        if axes in self._partners or len(self._points) <= _SAMPLE or self._triangles is not None:
            return self.partners(axes)[vertices]
        near = self._vertices.find(self._flipped(self._places[vertices], axes), self._reach[vertices])
        found = near[near >= 0]
        back = np.full(len(vertices), -1)
        back[near >= 0] = self._vertices.find(self._flipped(self._places[found], axes), self._reach[found])
        other = (back >= 0) & (back != vertices)
        if (self._places[back[other]] == self._places[vertices[other]]).all(axis=1).any():
            # Which of the vertices in one place, only all of them can tell.
            return self.partners(axes)[vertices]
        return np.where(back == vertices, near, -1)

    def on_plane(self, axes: tuple[int, ...]) -> frozenset[int]:
        """Return the vertices that are their own images over one of the axes."""
        with self._lock, np.errstate(invalid="ignore"):
            if axes not in self._on_plane:
                self._on_plane[axes] = frozenset().union(*(self._on_plane_of(axis) for axis in axes))
            return self._on_plane[axes]

    def _on_plane_of(self, axis: int) -> frozenset[int]:
        if (axis,) not in self._on_plane:
            if self._triangles is None:
                near = np.flatnonzero(np.abs(self._places[:, axis]) <= 0.5 * self._reach)
            else:
                near = np.arange(len(self._points))
            own = self._partners_of(near, (axis,)) == near
            self._on_plane[(axis,)] = frozenset(near[own].tolist())
        return self._on_plane[(axis,)]

    def images(self, wire: Wire, axes: tuple[int, ...], curves: bool = False) -> list[Wire]:
        """Return the images of a wire over each of the axes and their combinations.

        An image that runs along the wire itself, or along another image, is left out. If vertices have no partners, or the
        mesh lacks an edge of an image, the image falls into several, each drawn along its edges: see `one_sided`.

        If only `curves` matter, because they are cut into the faces, an image across the surface stays whole if its ends have
        partners. If the mesh lacks edges of it, it has only these two vertices.
        """
        by_curve = curves and self._is_across(wire)
        images: list[Wire] = []
        taken = {frozenset(wire.edges()) or wire.vertices}
        for combination in _combinations(axes):
            for image in self._image(wire, combination, curves):
                edges = frozenset(image.edges()) or image.vertices
                # An image may have only its two ends, which do not tell where its curve runs.
                is_known = edges in taken and not (by_curve and len(image.vertices) <= 2)
                if is_known or (by_curve and any(_is_same_curve(image, other) for other in (wire, *images))):
                    continue
                taken.add(edges)
                images.append(image)
        return images

    def one_sided(self, wire: Wire, axes: tuple[int, ...]) -> bool:
        """Whether part of a wire has no image over the axes or one of their combinations, so that it stays alone."""
        curves = wire.cuts
        return not all(self._is_whole(wire, combination, curves) for combination in _combinations(axes))

    def _is_whole(self, wire: Wire, axes: tuple[int, ...], curves: bool) -> bool:
        """Whether an image does not fall into several; see `images`."""
        mapped, there = self._mapped(wire, axes)
        return bool(there.all()) or (curves and self._is_across(wire) and min(mapped[0], mapped[-1]) >= 0)

    def _is_across(self, wire: Wire) -> bool:
        """Whether the points of a wire are mirrored, and not only its vertices."""
        return wire.along == "SURFACE" and self._triangles is None

    def _mapped(self, wire: Wire, axes: tuple[int, ...]) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
        """Return the partners of a wire's vertices, of a loop the first one's again at the end, and which edges are there."""
        around = np.array(wire.vertices + wire.vertices[:1] if wire.closed else wire.vertices, dtype=np.int64)
        with self._lock:
            mapped, keys = self._partners_of(around, axes), self._edge_keys
        pairs = np.stack([mapped[:-1], mapped[1:]], axis=1)
        if len(mapped) == 1:  # a wire without edges, between points of one face
            return mapped, mapped >= 0
        there = (pairs >= 0).all(axis=1) & (pairs[:, 0] != pairs[:, 1])
        if keys is not None and len(keys):
            there &= among(self._key(pairs), keys)
        return mapped, there

    def _image(self, wire: Wire, axes: tuple[int, ...], curves: bool) -> list[Wire]:
        mapped, there = self._mapped(wire, axes)
        if there.all():
            vertices = tuple(mapped[:-1].tolist() if wire.closed else mapped.tolist())
            points = self._mirrored_points(wire.points, axes) if self._is_across(wire) else self._points[mapped]
            return [self._as_image(wire, vertices, points, wire.closed)]
        if self._is_whole(wire, axes, curves):
            ends = (int(mapped[0]), int(mapped[-1]))
            return [self._as_image(wire, ends, self._mirrored_points(wire.points, axes), False)]
        # Runs of edges that are there; True where one begins, and where it has ended.
        borders = np.flatnonzero(np.diff(np.concatenate([[False], there, [False]]).astype(np.int8)))
        runs = [tuple(mapped[a : b + 1].tolist()) for a, b in zip(borders[::2], borders[1::2], strict=True)]
        return [self._as_image(wire, run, self._points[list(run)], False) for run in runs]

    def _mirrored_points(self, points: NDArray[np.float64], axes: tuple[int, ...]) -> NDArray[np.float64]:
        flipped = self._flipped(points @ self._to_object.T, axes)
        return flipped @ np.linalg.pinv(self._to_object).T  # an object may be scaled to nothing along an axis

    @staticmethod
    def _as_image(wire: Wire, vertices: tuple[int, ...], points: NDArray[np.float64], closed: bool) -> Wire:
        start: Pick = vertices[0]
        return replace(
            wire,
            vertices=vertices,
            points=points,
            faces=None,
            start=start,
            end=start if closed else vertices[-1],
            closed=closed,
            heading=None,
            alternatives=(),
        )


def _is_same_curve(one: Wire, other: Wire) -> bool:
    """Whether two images of a wire, or the wire and its image, have the same points, in either order."""
    if one.points.shape != other.points.shape:
        return False
    tolerance = ROUNDING * float(np.abs(one.points).max())
    return any(np.allclose(one.points, way, 0.0, tolerance) for way in (other.points, other.points[::-1]))


def _combinations(axes: tuple[int, ...]) -> list[tuple[int, ...]]:
    return [some for count in range(1, len(axes) + 1) for some in itertools.combinations(axes, count)]


class _PolygonEdges(HalfEdges):
    """The half-edges of the polygons that triangles make up. The triangles are alike oriented.

    `following` and `preceding`, (3m,), are those beside each in its polygon, past the diagonals, or -1. `sides`, (3m,), is the number of
    half-edges of the polygon of each, or 0 if it is not closed, or has too many.
    """

    def __init__(self, triangles: NDArray[np.int32], edges: NDArray[np.int32], count: int) -> None:
        super().__init__(triangles, edges, count)
        numbers, inner = np.arange(len(self.tails)), ~self.visible
        self.following = after(numbers)
        left = numbers[inner[self.following]]
        for _ in range(_MOST_SIDES):
            if not len(left):
                break
            across = self.twins[self.following[left]]
            self.following[left] = np.where(across >= 0, after(across), -1)
            left = left[(self.following[left] >= 0) & inner[self.following[left]]]
        self.following[left] = -1
        self.following[inner] = -1
        self.preceding = np.full(len(numbers), -1)
        known = numbers[self.following >= 0]
        self.preceding[self.following[known]] = known
        self.sides = self._sides(known)

    def _sides(self, left: NDArray[np.int64]) -> NDArray[np.int64]:
        """Count the half-edges of each polygon."""
        sides = np.zeros(len(self.tails), dtype=np.int64)
        at = self.following[left]
        for count in range(1, _MOST_SIDES + 1):
            done = at == left
            sides[left[done]] = count
            left, at = left[~done], self.following[at[~done]]
            left, at = left[at >= 0], at[at >= 0]
            if not len(left):
                break
        return sides


def grown_partners(
    triangles: NDArray[np.int32], edges: NDArray[np.int32], by_place: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Return the partners of vertices, grown over the polygons of a mesh from edges whose images are known.

    The image of a half-edge from a to b leads from the partner of b to that of a, since mirroring turns faces over. So the
    image of what comes after it in its polygon comes before its image, and that of its twin is its image's twin.

    Triangles, (m, 3), are alike oriented, and edges, (e, 2), are those of the polygons. `by_place`, (n,), has the partners where they
    can be told otherwise, each its partner's partner, or -1. They stay where growing does not come.
    """
    half = _PolygonEdges(triangles, edges, len(by_place))
    known = np.flatnonzero((by_place[half.tails] >= 0) & (by_place[half.tips] >= 0) & (half.sides > 0))
    images = half.between(by_place[half.tips[known]], by_place[half.tails[known]])
    known, images = known[images >= 0], images[images >= 0]
    partners = np.full(len(by_place), -1)
    told = by_place >= 0
    most = 0
    # In a pose, some edges are by chance where the image of another would be: what grows from them is not what places say
    # elsewhere, and soon meets itself.
    for at in np.unique(np.linspace(0, len(known) - 1, min(_TRIALS, len(known)), dtype=np.int64)):
        grown = np.full(len(by_place), -1)
        _grow(half, known[at : at + 1], images[at : at + 1], grown)
        came = told & (grown >= 0)
        agreed = int((grown[came] == by_place[came]).sum())
        if agreed > max(most, _CREDIBLE * came.sum()):
            most, partners = agreed, grown
        if most >= _WELL_GROWN * told.sum():
            break
    # Other parts of the mesh, from wherever places say something.
    _grow(half, known, images, partners)
    free = np.flatnonzero((partners < 0) & (by_place >= 0))
    free = free[partners[by_place[free]] < 0]
    partners[free] = by_place[free]
    return partners


def _grow(half: _PolygonEdges, ones: NDArray[np.int64], images: NDArray[np.int64], partners: NDArray[np.int64]) -> None:
    """Enter the partners of all vertices that half-edges and their images lead to, unless they have others already."""
    image_of = np.full(len(half.tails), -1)
    while len(ones):
        fits = (ones >= 0) & (images >= 0)
        ones, images = ones[fits], images[fits]
        fits = (image_of[ones] < 0) & (image_of[images] < 0)
        # The rims of holes have no polygon to agree in.
        fits &= half.sides[ones] == half.sides[images]
        ones, images = ones[fits], images[fits]
        order = np.argsort(ones, kind="stable")
        ones, images = ones[order], images[order]
        fits = np.diff(ones, prepend=-1) > 0
        ones, images = ones[fits], images[fits]
        vertices = np.concatenate([half.tails[ones], half.tips[ones]])
        others = np.concatenate([half.tips[images], half.tails[images]])
        new = (partners[vertices] < 0) & (partners[others] < 0)
        _enter(partners, vertices[new], others[new])
        both = (partners[vertices] == others).reshape(2, -1).all(axis=0)
        ones, images = ones[both], images[both]
        image_of[ones] = images
        image_of[images] = ones
        ones, images = (
            np.concatenate([half.following[ones], half.preceding[ones], half.twins[ones]]),
            np.concatenate([half.preceding[images], half.following[images], half.twins[images]]),
        )


def _enter(partners: NDArray[np.int64], vertices: NDArray[np.int64], others: NDArray[np.int64]) -> None:
    """Make vertices the partners of others as far as that is one to one."""
    pairs = np.sort(np.minimum(vertices, others) * len(partners) + np.maximum(vertices, others))
    pairs = pairs[np.diff(pairs, prepend=-1) > 0]
    low, high = pairs // len(partners), pairs % len(partners)
    # Each vertex in one pair: a pair counts where it is the first of both.
    _, first, where = np.unique(np.stack([low, high], axis=1).ravel(), return_index=True, return_inverse=True)
    good = (first[where].reshape(-1, 2) // 2 == np.arange(len(pairs))[:, None]).all(axis=1)
    partners[low[good]] = high[good]
    partners[high[good]] = low[good]


class MirrorImages:
    """Finds the images of wires by the symmetry of their mesh, each when it is first needed."""

    def __init__(self, symmetry: Symmetry) -> None:
        self._symmetry = symmetry
        self._warned = False
        self._effect: tuple[Drawn, list[Edge], list[Edge]] | None = None

    def of(self, wire: Wire, network: Drawn, curves: bool = False) -> list[Wire]:
        """Return the images that a wire has, or would have if a network kept it now; see `Symmetry.images`."""
        kept = wire.images is not None or network.find(wire) is not None
        return self._symmetry.images(wire, wire.mirror if kept else network.mirror, curves)

    def completed(self, wire: Wire, among: Collection[Edge] | None = None) -> Wire:
        """Return a wire that knows the edges of its images. If edges are given, its images have only these."""
        if wire.images is not None:
            return wire
        edges = dict.fromkeys(edge for image in self._symmetry.images(wire, wire.mirror) for edge in image.edges())
        return replace(wire, images=tuple(edge for edge in edges if among is None or edge in among))

    def net_effect(self, network: Drawn) -> tuple[list[Edge], list[Edge]]:
        """Return the edges that wires and images mark and those that they clear, sorted, smaller vertex first."""
        if self._effect is None or self._effect[0] is not network:
            claims = ((edge, wire.marks) for wire in map(self.completed, network.wires) for edge in wire.claims())
            self._effect = (network, *net_effect(claims))
        return self._effect[1:]

    def warning(self, wire: Wire) -> str:
        """Return, the first time only, that part of a wire has no image; empty where it has."""
        if self._warned or not wire.mirror or not self._symmetry.one_sided(wire, wire.mirror):
            return ""
        self._warned = True
        return "Part of this wire has no mirror image: the mesh is not symmetric there"
