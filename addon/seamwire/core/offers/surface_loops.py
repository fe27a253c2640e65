# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed cuts across the surface: what one click on a point offers."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..base.messages import Message, Refused
from ..network.picks import FacePoint
from ..network.wires import Wire
from ..solver.solver import for_live
from .closed_cuts import TakenCut, is_same
from .offers import Offers

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from ...terms.choices import LoopKind
    from ..network.network import Network
    from ..network.picks import Pick
    from ..solver.solver import ClosedCut, Engines, LiveWire


NOTHING_TO_BEND = "nothing-to-bend"
CUT_IS_GONE = "cut-is-gone"


class SurfaceLoops(Offers):
    """The closed cuts through the point under the cursor, while they are asked for; or, to be bent, the one taken last through it too.

    Parameters
    ----------
    engines
        Find them.
    triangles
        (m, 3) those of the surface; None: nothing is offered.
    """

    SINGLE = Message.of("nothing-else-here")
    NONE = Message.of("no-closed-cut")

    def __init__(self, engines: Engines, triangles: NDArray[np.int32] | None) -> None:
        super().__init__()
        self._engines = engines
        self._triangles = triangles
        self._found: dict[int, tuple[tuple[Wire, ...], tuple[int, int]]] = {}
        self._taken: Pick | None = None
        self._cuts: list[TakenCut] = []
        self.bends = False
        """Whether the offer is the cut that was taken last, bent to the pick."""
        self.into_faces = False
        """Whether what is taken is to be cut into the faces: else two cuts that go to the same edges are one."""

    def takes(self, pick: Pick) -> bool:
        """Whether it is a point of the surface."""
        return self._triangles is not None and not isinstance(pick, tuple)

    def find(self, pick: Pick, network: Network, kept: Wire | None = None) -> tuple[Wire, ...]:
        """Return the closed cuts through a pick, each as one wire to be shown; nothing, too, while they are computed.

        Raises
        ------
        ValueError
            Where the pick is not part of the surface, or there is no cut that can be bent to it.
        """
        self.final = True
        if not self.takes(pick):
            return ()
        live = self._engines.cuts()
        begin = pick
        if self.bends:
            cut = self.bendable(network)
            if cut is None:
                raise Refused(NOTHING_TO_BEND)
            begin = cut.through
            number = self._id_of(cut, live)
            if number is None:
                self.final = False
                return ()
            found = live.bent_wire(for_live(begin, "SURFACE"), for_live(pick, "SURFACE"), number)
            if found.final and not found.cuts:
                raise Refused("no-cut-through-both")
        else:
            found = live.closed_wires(for_live(pick, "SURFACE"))
        self.final = found.final
        self._found = {}
        shown: list[Wire] = []
        for each in found.cuts:
            pieces = self._pieces_of(each, begin)
            if len(pieces) < 2:
                continue
            whole = _whole(pieces, each.separates)
            if not any(self._alike(whole, other) for other in shown):
                shown.append(whole)
                self._found[whole.id] = pieces, each.id
        return tuple(shown)

    def _alike(self, one: Wire, other: Wire) -> bool:
        # On a coarse mesh, cuts apart from each other may go to the same edges.
        return one.like(other) or (not self.into_faces and set(one.edges()) == set(other.edges()))

    def bend(self, bends: bool) -> bool:
        """Offer the cut that was taken last, bent to the pick, or those through the pick again; return whether others vanish."""
        if bends == self.bends:
            return False
        self.bends = bends
        vanish = bool(self.offers)
        self.clear()
        return vanish

    def bendable(self, network: Network) -> TakenCut | None:
        """Return the last cut that the network still has unchanged, and that would be found again."""
        metric = self._metric
        known = (cut for cut in reversed(self._cuts) if cut.id is None or cut.metric == metric)
        return next((cut for cut in known if cut.is_in(network)), None)

    def taken(self, network: Network) -> tuple[TakenCut, ...]:
        """Return the cuts that a network still has unchanged, in the order in which they were added or recalled."""
        return tuple(cut for cut in self._cuts if cut.is_in(network))

    def recall(self, cuts: Iterable[TakenCut]) -> None:
        """Go on from cuts that were taken in other sessions, in place of those taken in this one."""
        self._cuts = list(cuts)

    def _id_of(self, cut: TakenCut, live: LiveWire) -> tuple[int, int] | None:
        """Return what the library calls a cut that is bent; None while that is computed, where it was taken on another mesh.

        On a mesh that was cut the numbers are others: it is the one that runs as the cut ran.
        """
        if cut.id is not None:
            return cut.id
        found = live.closed_wires(for_live(cut.through, "SURFACE"))
        if not found.final:
            return None
        apart = {each.id: is_same(cut.course, _course(each)) for each in found.cuts}
        same = {number: gap for number, gap in apart.items() if gap is not None}
        if not same:
            raise Refused(CUT_IS_GONE)
        nearest = min(same, key=same.__getitem__)
        self._cuts[self._cuts.index(cut)] = replace(cut, id=nearest, metric=self._metric)
        return nearest

    @property
    def _metric(self) -> tuple[object, ...]:
        return self._engines.strengths["SURFACE"], self._engines.strokes

    def aim(self, pick: Pick | None) -> bool:
        """Request the offers for a pick, or stop. After a cut was added, the next offers need another pick."""
        if pick != self._taken:
            self._taken = None
        return super().aim(None if self._taken is not None else pick)

    def pieces(self, offer: Wire) -> tuple[Wire, ...]:
        """Return the wires that an offer found last consists of: a closed chain with seeds where they meet."""
        return self._found[offer.id][0]

    def take(self, pick: Pick, offer: Wire, wires: tuple[Wire, ...], before: TakenCut | None) -> None:
        """Remember that an offer found last for a pick is kept now, as these wires; `before`: in place of a cut."""
        through, course = (pick, offer.points) if before is None else (before.through, before.course)
        self._cuts.append(TakenCut(through, course, wires, self._found[offer.id][1], self._metric))
        self.was_taken(pick)

    def was_taken(self, pick: Pick) -> None:
        """Offer nothing until another pick: something was taken at this one."""
        self._taken, self.wanted = pick, False

    def _pieces_of(self, cut: ClosedCut, pick: Pick) -> tuple[Wire, ...]:
        assert self._triangles is not None
        joints: list[Pick] = []
        for joint in cut.joints:
            if isinstance(joint, int):
                joints.append(joint)
                continue
            triangle, (a, b, c) = joint
            one, two, three = self._triangles[triangle].tolist()
            joints.append(FacePoint(int(triangle), (one, two, three), (float(a), float(b), float(c))))
        return tuple(
            Wire(
                "SURFACE",
                tuple(int(vertex) for vertex in piece.vertices),
                np.array(piece.points, dtype=np.float64),
                start,
                end,
                np.array(piece.faces),
            )
            for piece, start, end in zip(cut.pieces, [pick, *joints], [*joints, pick], strict=True)
        )


def _course(cut: ClosedCut) -> NDArray[np.float64]:
    """Return how a cut runs, (k, 3), from its point around to it."""
    return np.concatenate([np.asarray(piece.points, dtype=np.float64) for piece in cut.pieces])


def _whole(pieces: tuple[Wire, ...], separates: bool) -> Wire:
    """Return wires that lead around as one loop."""
    kind: LoopKind = "ACROSS" if separates else "HANDLE"
    return replace(
        pieces[0].anew(
            vertices=sum((piece.vertices[:-1] for piece in pieces), ()),
            points=np.concatenate([piece.points[:-1] for piece in pieces] + [pieces[0].points[:1]]),
            faces=None,
        ),
        end=pieces[0].start,
        closed=True,
        kind=kind,
    )
