# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires mirrored over the axes of an object: which vertex is the partner of which, by place or by topology, and the images of wires."""

from __future__ import annotations

import itertools
import threading
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..base import native
from .drawn import Drawn, net_effect
from .wires import Wire

if TYPE_CHECKING:
    from collections.abc import Collection

    from numpy.typing import NDArray

    from .picks import Edge, Pick

SYMMETRIC = 0.75
"""A mesh is symmetric if at least this part of its vertices off the plane has a partner. If the two sides of a mesh without symmetry
cross each other, a fifth has one by chance."""
_SAME_PLACE = 1e-6
"""Two points of a curve are the same if they are nearer than this part of its coordinates, which are single precision."""


class Symmetry:
    """The mirror images of vertices and edges. The library computes them on first use, in any thread. See `mirror_partners`.

    Parameters
    ----------
    points
        (n, 3) vertices; those that are not finite have no partners.
    edges
        (e, 2) edges, the only ones that images may have; None: images may have any edge.
    to_object
        (3, 3) takes `points` to object coordinates; None: they are object coordinates.
    topology
        Whether partners are found by the connections of the mesh, beginning with partners by place. Needs `triangles` and `edges`.
    triangles
        (m, 3) with one orientation. Sides that are not in `edges` lie inside a polygon.
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
        self._partners: dict[tuple[int, ...], NDArray[np.int32]] = {}
        self._on_plane: dict[tuple[int, ...], frozenset[int]] = {}
        # Other threads wait for the thread that computes.
        self._lock = threading.RLock()

    @cached_property
    def _edge_keys(self) -> NDArray[np.int64] | None:
        return None if self._edges is None else np.sort(self._key(self._edges.astype(np.int64)))

    def _key(self, pairs: NDArray[np.int64]) -> NDArray[np.int64]:
        return pairs.min(axis=-1) * len(self._points) + pairs.max(axis=-1)

    @cached_property
    def symmetric_axes(self) -> tuple[int, ...]:
        found = []
        for axis in range(3):
            partners = self.partners((axis,))
            # A vertex in the plane is its own image, and says nothing.
            aside = partners[partners != np.arange(len(partners))]
            if len(aside) and (aside >= 0).mean() >= SYMMETRIC:
                found.append(axis)
        if found:
            # Sorted here, on the thread that asks for symmetry, rather than when the first image is drawn.
            _ = self._edge_keys
        return tuple(found)

    def partners(self, axes: tuple[int, ...]) -> NDArray[np.int32]:
        """Return the vertex that each is mirrored to over all of the axes at once, (n,), or -1."""
        with self._lock:
            if axes not in self._partners:
                with np.errstate(all="ignore"):  # points may not be finite
                    places = self._points @ self._to_object.T
                self._partners[axes] = native.load().mirror_partners(places, axes, self._edges, self._triangles)
            return self._partners[axes]

    def on_plane(self, axes: tuple[int, ...]) -> frozenset[int]:
        """Return the vertices that are their own images over one of the axes."""
        if axes not in self._on_plane:
            numbers = np.arange(len(self._points))
            own = (np.flatnonzero(self.partners((axis,)) == numbers).tolist() for axis in axes)
            self._on_plane[axes] = frozenset().union(*own)
        return self._on_plane[axes]

    def images(self, wire: Wire, axes: tuple[int, ...], curves: bool = False) -> list[Wire]:
        """Return the images of a wire over each of the axes and their combinations.

        An image that runs along the wire itself, or along another image, is left out. If vertices have no partners, or the
        mesh lacks an edge of an image, the image falls into several, each drawn along its edges: see `one_sided`.

        If only `curves` matter, because they are cut into the faces, an image across the surface stays whole if its ends have
        partners. If the mesh lacks edges of it, it has only these two vertices.
        """
        if not axes:
            return []
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
        mapped, keys = self.partners(axes)[around].astype(np.int64), self._edge_keys
        pairs = np.stack([mapped[:-1], mapped[1:]], axis=1)
        if len(mapped) == 1:  # a wire without edges, between points of one face
            return mapped, mapped >= 0
        there = (pairs >= 0).all(axis=1) & (pairs[:, 0] != pairs[:, 1])
        if keys is not None and len(keys):
            found = self._key(pairs)
            there &= keys[np.minimum(np.searchsorted(keys, found), len(keys) - 1)] == found
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
        signs = np.where(np.isin(np.arange(3), axes), -1.0, 1.0)
        return (points @ self._to_object.T * signs) @ np.linalg.pinv(
            self._to_object
        ).T  # an object may be scaled to nothing along an axis

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
        )


def _is_same_curve(one: Wire, other: Wire) -> bool:
    if one.points.shape != other.points.shape:
        return False
    tolerance = _SAME_PLACE * float(np.abs(one.points).max())
    return any(np.allclose(one.points, way, 0.0, tolerance) for way in (other.points, other.points[::-1]))


def _combinations(axes: tuple[int, ...]) -> list[tuple[int, ...]]:
    return [some for count in range(1, len(axes) + 1) for some in itertools.combinations(axes, count)]


class MirrorImages:
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
