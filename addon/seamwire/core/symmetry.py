# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires mirrored over the axes of an object."""

from __future__ import annotations

import itertools
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from .network import Wire
from .spatial_hash import SpatialHash

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .network import Pick

TOLERANCE = 2e-5
"""How far from its mirror image a vertex may be, in object coordinates: as far as Blender takes it in edit mode."""
SYMMETRIC = 0.95
"""Part of the vertices that have a partner where a mesh is called symmetric."""
_SAMPLE = 50_000


class Symmetry:
    """What the mesh's vertices and edges are mirrored to; found out when it is first asked for.

    Parameters
    ----------
    points
        (n, 3) vertices.
    edges
        (e, 2) edges, the only ones that images may have; None: all that are asked for.
    to_object
        (3, 3) takes `points` to object coordinates; None: they are such.
    """

    def __init__(
        self,
        points: NDArray[np.float64],
        edges: NDArray[np.int32] | None = None,
        to_object: NDArray[np.float64] | None = None,
    ) -> None:
        self._points = points
        self._edges = edges
        self._to_object = np.eye(3) if to_object is None else np.asarray(to_object, dtype=np.float64)
        self._partners: dict[tuple[int, ...], NDArray[np.int64]] = {}

    @cached_property
    def _places(self) -> NDArray[np.float64]:
        return self._points @ self._to_object.T

    @cached_property
    def _cells(self) -> SpatialHash:
        return SpatialHash(self._places, TOLERANCE)

    @cached_property
    def _edge_keys(self) -> NDArray[np.int64] | None:
        if self._edges is None:
            return None
        return np.unique(self._key(np.asarray(self._edges, dtype=np.int64)))

    def _key(self, pairs: NDArray[np.int64]) -> NDArray[np.int64]:
        return pairs.min(axis=-1) * len(self._points) + pairs.max(axis=-1)

    @cached_property
    def symmetric_axes(self) -> tuple[int, ...]:
        """The axes over which nearly all vertices have a partner; of a large mesh a sample is asked."""
        rows = np.arange(0, len(self._places), max(1, len(self._places) // _SAMPLE))
        sample = self._places[rows]
        found = []
        for axis in range(3):
            # What lies in the plane is its own image, and says nothing.
            aside = sample[np.abs(sample[:, axis]) > TOLERANCE]
            partners = self._cells.nearest(self._flipped(aside, (axis,)))
            if len(aside) and (partners >= 0).mean() >= SYMMETRIC:
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
        """Return the vertex that each is mirrored to over all of the axes at once; -1: none."""
        if axes not in self._partners:
            self._partners[axes] = self._cells.nearest(self._flipped(self._places, axes))
        return self._partners[axes]

    def _partners_of(self, vertices: NDArray[np.int64], axes: tuple[int, ...]) -> NDArray[np.int64]:
        """Return what a few vertices are mirrored to; of a large mesh not all are looked for because of them."""
        if axes in self._partners or len(self._places) <= _SAMPLE:
            return self.partners(axes)[vertices]
        return self._cells.nearest(self._flipped(self._places[vertices], axes))

    def on_plane(self, axes: tuple[int, ...]) -> frozenset[int]:
        """Return the vertices that are their own images over one of the axes."""
        own = [np.flatnonzero(np.abs(self._places[:, axis]) <= 0.5 * TOLERANCE).tolist() for axis in axes]
        return frozenset(itertools.chain.from_iterable(own))

    def images(self, wire: Wire, axes: tuple[int, ...]) -> list[Wire]:
        """Return the images of a wire over each of the axes and their combinations.

        One that runs along the wire itself, or along another image, is left out. Where the mesh lacks an edge of an
        image, that falls into several, each drawn along its edges.
        """
        images = []
        taken = {frozenset(wire.edges())}
        for count in range(1, len(axes) + 1):
            for combination in itertools.combinations(axes, count):
                for image in self._image(wire, combination):
                    edges = frozenset(image.edges())
                    if edges not in taken:
                        taken.add(edges)
                        images.append(image)
        return images

    def _image(self, wire: Wire, axes: tuple[int, ...]) -> list[Wire]:
        around = np.array(wire.vertices + wire.vertices[:1] if wire.closed else wire.vertices, dtype=np.int64)
        mapped = self._partners_of(around, axes)
        pairs = np.stack([mapped[:-1], mapped[1:]], axis=1)
        there = (pairs >= 0).all(axis=1) & (pairs[:, 0] != pairs[:, 1])
        keys = self._edge_keys
        if keys is not None and len(keys):
            wanted = self._key(pairs)
            there &= keys[np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)] == wanted
        if there.all():
            vertices = tuple(mapped[:-1].tolist() if wire.closed else mapped.tolist())
            return [self._as_image(wire, vertices, self._mirrored_points(wire.points, axes), wire.closed)]
        # Runs of edges that are there; True where one begins, and where it has ended.
        borders = np.flatnonzero(np.diff(np.concatenate([[False], there, [False]]).astype(np.int8)))
        runs = [tuple(mapped[a : b + 1].tolist()) for a, b in zip(borders[::2], borders[1::2], strict=True)]
        return [self._as_image(wire, run, self._points[list(run)], False) for run in runs]

    def _mirrored_points(self, points: NDArray[np.float64], axes: tuple[int, ...]) -> NDArray[np.float64]:
        flipped = self._flipped(points @ self._to_object.T, axes)
        return flipped @ np.linalg.inv(self._to_object).T

    @staticmethod
    def _as_image(wire: Wire, vertices: tuple[int, ...], points: NDArray[np.float64], closed: bool) -> Wire:
        start: Pick = vertices[0]
        return replace(
            wire,
            vertices=vertices,
            points=points,
            start=start,
            end=start if closed else vertices[-1],
            closed=closed,
            heading=None,
            alternative=None,
        )
