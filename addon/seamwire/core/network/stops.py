# SPDX-License-Identifier: GPL-3.0-or-later
"""Where wires that run straight on end."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import ArrayLike, NDArray

    from .drawn import Drawn
    from .symmetry import Symmetry
    from .wires import Wire


class Stops:
    """The vertices where wires that run straight on end: those of seams, (k, 2), and of wires, and those on the mirror's plane."""

    def __init__(self, seams: ArrayLike, symmetry: Symmetry) -> None:
        self._symmetry = symmetry
        self.set_seams(seams)

    def set_seams(self, seams: ArrayLike) -> None:
        self.seams = np.asarray(seams, dtype=np.int32).reshape(-1, 2)
        self._last: tuple[Drawn, NDArray[np.int32], NDArray[np.int32]] | None = None

    def of(self, network: Drawn, live: Wire | None, begin: Iterable[int]) -> NDArray[np.int32]:
        """Return the stops of a wire, in rising order, in a network that may not have it yet: that is the `live` wire.

        Where all vertices that the wire has before it runs on, `begin`, lie on the mirror's plane, it runs along that.
        """
        images = () if live is None else (live, *self._symmetry.images(live, network.mirror))
        own = np.fromiter(itertools.chain.from_iterable(one.vertices for one in images), dtype=np.int32)
        plane = self._symmetry.on_plane(network.mirror)
        on_plane = self.plane(network) if not plane.issuperset(begin) else own[:0]
        return np.unique(np.concatenate([self.kept(network), own, on_plane]))

    def plane(self, network: Drawn) -> NDArray[np.int32]:
        plane = self._symmetry.on_plane(network.mirror)
        return np.fromiter(plane, dtype=np.int32, count=len(plane))

    def edges(self, network: Drawn) -> NDArray[np.int32]:
        return self._kept(network)[0]

    def kept(self, network: Drawn) -> NDArray[np.int32]:
        """Return the vertices of seams, of kept wires and of their images, in rising order."""
        return self._kept(network)[1]

    def _kept(self, network: Drawn) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        if self._last is None or self._last[0] is not network:
            claims = [edge for wire in network.wires for edge in wire.claims()]
            edges = np.concatenate([self.seams, np.array(claims, dtype=np.int32).reshape(-1, 2)])
            self._last = (network, edges, np.unique(edges))
        return self._last[1:]
