# SPDX-License-Identifier: GPL-3.0-or-later
"""Where wires that run straight on end."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np

from ..base.half_edges import among
from .picks import undirected

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import ArrayLike, NDArray

    from .drawn import Drawn
    from .picks import Edge
    from .symmetry import Symmetry
    from .wires import Wire

_BITS = 32
_LOW = (1 << _BITS) - 1


class Stops:
    """The vertices where wires that run straight on end: those of seams, (k, 2), and of wires, and those on the mirror's plane."""

    def __init__(self, seams: ArrayLike, symmetry: Symmetry) -> None:
        self._symmetry = symmetry
        self.set_seams(seams)
        self._plane: tuple[tuple[int, ...], frozenset[int], NDArray[np.int64]] | None = None

    def set_seams(self, seams: ArrayLike) -> None:
        """Go on with other seams, (k, 2)."""
        self._seams = ranked(_keys(np.asarray(seams, dtype=np.int64).reshape(-1, 2)))
        self._seam_vertices = ranked(np.concatenate([self._seams >> _BITS, self._seams & _LOW]))
        self._last: tuple[Drawn, NDArray[np.int64], frozenset[Edge]] | None = None

    @property
    def seams(self) -> NDArray[np.int32]:
        """The edges, (k, 2), that are seams already."""
        return np.stack([self._seams >> _BITS, self._seams & _LOW], axis=1).astype(np.int32)

    def of(self, network: Drawn, live: Wire | None, begin: Iterable[int]) -> NDArray[np.int64]:
        """Return the stops of a wire, in rising order, in a network that may not have it yet: that is the `live` wire.

        Where all vertices that the wire has before it runs on, `begin`, lie on the mirror's plane, it runs along that.
        """
        stops = self._kept(network)[0]
        if live is not None:
            images = self._symmetry.images(live, network.mirror)
            stops = _joined(stops, itertools.chain(*(one.vertices for one in (live, *images))))
        if not network.mirror:
            return stops
        if self._plane is None or self._plane[0] != network.mirror:
            plane = self._symmetry.on_plane(network.mirror)
            self._plane = (network.mirror, plane, np.fromiter(plane, dtype=np.int64, count=len(plane)))
        _, plane, vertices = self._plane
        return stops if plane.issuperset(begin) else ranked(np.concatenate([stops, vertices]))

    def kept(self, network: Drawn) -> NDArray[np.int64]:
        """Return the vertices of seams, of kept wires and of their images, in rising order."""
        return self._kept(network)[0]

    def taken(self, network: Drawn, edge: Edge) -> bool:
        """Whether an edge belongs already to a seam, to a kept wire or to an image of one."""
        if undirected(edge) in self._kept(network)[1]:
            return True
        key = _keys(np.array([edge], dtype=np.int64))
        return bool(among(key, self._seams)[0])

    def _kept(self, network: Drawn) -> tuple[NDArray[np.int64], frozenset[Edge]]:
        """Return the vertices of seams, kept wires and their images, in rising order, and the edges of those wires."""
        if self._last is None or self._last[0] is not network:
            edges = frozenset(edge for wire in network.wires for edge in wire.claims())
            vertices = _joined(self._seam_vertices, itertools.chain.from_iterable(edges))
            self._last = (network, vertices, edges)
        return self._last[1:]


def _keys(edges: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return a number for each edge, (k, 2): its smaller vertex above its larger one."""
    return (edges.min(axis=1) << _BITS) | edges.max(axis=1)


def ranked(numbers: Iterable[int]) -> NDArray[np.int64]:
    """Return numbers in rising order, each once."""
    numbers = np.sort(numbers if isinstance(numbers, np.ndarray) else np.fromiter(numbers, dtype=np.int64))
    return numbers[np.diff(numbers, prepend=-1) > 0]


def _joined(numbers: NDArray[np.int64], more: Iterable[int]) -> NDArray[np.int64]:
    """Return numbers in rising order with a few more among them."""
    more = ranked(more)
    more = more[~among(more, numbers)]
    return np.insert(numbers, np.searchsorted(numbers, more), more) if len(more) else numbers
