# SPDX-License-Identifier: GPL-3.0-or-later
"""The mirror images of a network's wires, and which edges the wires make seams together with them."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..base.messages import NOTHING, Message
from .network import Network, net_effect
from .wires import Wire

if TYPE_CHECKING:
    from collections.abc import Collection

    from numpy.typing import ArrayLike

    from .picks import Edge
    from .symmetry import Symmetry


class MirrorImages:
    """Finds the images of wires by the symmetry of their mesh, each when it is first needed."""

    def __init__(self, symmetry: Symmetry) -> None:
        self._symmetry = symmetry
        self._warned = False
        self._effect: tuple[Network, list[Edge], list[Edge]] | None = None

    def of(self, wire: Wire, network: Network, curves: bool = False) -> list[Wire]:
        """Return the images that a wire has, or would have if a network kept it now; see `Symmetry.images`."""
        kept = wire.images is not None or network.find(wire) is not None
        return self._symmetry.images(wire, wire.mirror if kept else network.mirror, curves)

    def complete(self, network: Network, seams: ArrayLike | None = None) -> Network:
        """Return a network whose wires all know the edges of their images.

        Parameters
        ----------
        network
            Some of its wires may not know them.
        seams
            (k, 2) the only edges that images found now may have; None: any of the mesh.
        """
        if all(wire.images is not None for wire in network.wires):
            return network
        among = None
        if seams is not None:
            pairs = np.sort(np.asarray(seams, dtype=np.int64).reshape(-1, 2), axis=1)
            among = set(map(tuple, pairs.tolist()))
        wires = (wire if wire.images is not None else self._with_images(wire, among) for wire in network.wires)
        return replace(network, wires=tuple(wires))

    def _with_images(self, wire: Wire, among: Collection[Edge] | None) -> Wire:
        edges = dict.fromkeys(edge for image in self._symmetry.images(wire, wire.mirror) for edge in image.edges())
        return replace(wire, images=tuple(edge for edge in edges if among is None or edge in among))

    def net_effect(self, network: Network) -> tuple[list[Edge], list[Edge]]:
        """Return the edges that wires and images mark and those that they clear, sorted, smaller vertex first."""
        if self._effect is None or self._effect[0] is not network:
            # Wires that follow a dragged seed have not found their images yet.
            claims = ((edge, wire.marks) for wire in self.complete(network).wires for edge in wire.claims())
            self._effect = (network, *net_effect(claims))
        return self._effect[1:]

    def warning(self, network: Network) -> Message:
        """Return, the first time only, that part of a network's newest wire has no image; empty where it has."""
        if self._warned or not network.wires:
            return NOTHING
        wire = network.wires[-1]
        if not wire.mirror or not self._symmetry.one_sided(wire, wire.mirror):
            return NOTHING
        self._warned = True
        return Message.of("no-mirror-image")
