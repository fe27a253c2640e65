# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed cuts across the surface: what one click on a point offers."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from .network import FacePoint, Wire
from .offers import Offers
from .solver import for_live

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .network import LoopKind, Network, Pick
    from .solver import ClosedCut, Engines


class SurfaceLoops(Offers):
    """The closed cuts through the point under the cursor, while they are asked for.

    Parameters
    ----------
    engines
        Find them.
    triangles
        (m, 3) those of the surface; None: nothing is offered.
    """

    SINGLE = "Nothing else is suggested here"
    NONE = "The shape suggests no closed cut here"

    def __init__(self, engines: Engines, triangles: NDArray[np.int32] | None) -> None:
        super().__init__()
        self._engines = engines
        self._triangles = triangles
        self._pieces: dict[int, tuple[Wire, ...]] = {}
        self._taken: Pick | None = None

    def takes(self, pick: Pick) -> bool:
        """Whether it is a point of the surface."""
        return self._triangles is not None and not isinstance(pick, tuple)

    def find(self, pick: Pick, network: Network, kept: Wire | None = None) -> tuple[Wire, ...]:
        """Return the closed cuts through a pick, each as one wire to be shown; nothing, too, while they are computed.

        Raises
        ------
        ValueError
            Where the pick is not part of the surface.
        """
        self.final = True
        if not self.takes(pick):
            return ()
        found = self._engines.cuts().closed_wires(for_live(pick, "SURFACE"))
        self.final = found.final
        cuts = [(self._pieces_of(cut, pick), cut.separates) for cut in found.cuts]
        shown = [(pieces, _whole(pieces, separates)) for pieces, separates in cuts if len(pieces) > 1]
        self._pieces = {whole.id: pieces for pieces, whole in shown}
        return tuple(whole for _, whole in shown)

    def aim(self, pick: Pick | None) -> bool:
        """Ask for the offers for a pick, or for none; where a cut was taken just now, there are none until another pick."""
        if pick != self._taken:
            self._taken = None
        return super().aim(None if self._taken is not None else pick)

    def take(self, pick: Pick, offer: Wire) -> tuple[Wire, ...]:
        """Return the wires that an offer found last consists of: a closed chain with seeds where they meet."""
        self.was_taken(pick)
        return self._pieces[offer.id]

    def was_taken(self, pick: Pick) -> None:
        """Offer nothing until another pick: something was taken at this one."""
        self._taken, self.wanted = pick, False

    def _pieces_of(self, cut: ClosedCut, pick: Pick) -> tuple[Wire, ...]:
        assert self._triangles is not None
        joints: list[Pick] = []
        for triangle, (a, b, c) in cut.joints:
            one, two, three = self._triangles[triangle].tolist()
            joints.append(FacePoint(int(triangle), (one, two, three), (float(a), float(b), float(c))))
        return tuple(
            Wire(
                "SURFACE",
                tuple(int(vertex) for vertex in piece.vertices),
                np.array(piece.points, dtype=np.float64),
                start,
                end,
            )
            for piece, start, end in zip(cut.pieces, [pick, *joints], [*joints, pick], strict=True)
        )


def _whole(pieces: tuple[Wire, ...], separates: bool) -> Wire:
    """Return wires that lead around as one loop."""
    kind: LoopKind = "ACROSS" if separates else "HANDLE"
    return replace(
        pieces[0].anew(
            vertices=sum((piece.vertices[:-1] for piece in pieces), ()),
            points=np.concatenate([piece.points[:-1] for piece in pieces] + [pieces[0].points[:1]]),
        ),
        end=pieces[0].start,
        closed=True,
        kind=kind,
    )
