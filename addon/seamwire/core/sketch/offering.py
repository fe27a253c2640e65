# SPDX-License-Identifier: GPL-3.0-or-later
"""The offered loops: a click takes a whole loop, strip, closed cut, ridge or valley."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from ..base.refused import Refused
from ..network.network import Given, How, Snap, Sought
from ..network.picks import FacePoint, pick_name, undirected
from ..offers.crests import CREST_KINDS
from ..offers.edge_loops import LoopOffers, taken
from ..offers.part_search import PartSearch
from ..offers.surface_loops import SurfaceLoops
from .courses import Course, Search, patiently
from .interaction import Begun, Edit, Interaction
from .lining import Lining

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..network.picks import Edge, Pick
    from ..network.wires import Wire
    from ..offers.crests import Crests
    from ..offers.offers import Offers
    from ..offers.surface_loops import TakenCut
    from ..solver.solver import LiveWire
    from .board import Board


class Offering(Interaction):
    """The loops that a click at the cursor offers, along edges or across the surface.

    Attributes
    ----------
    edges, cuts
        The offers along edges, and across the surface.
    """

    def __init__(self, board: Board) -> None:
        super().__init__(board)
        points, triangles = board.points, board.triangles
        own, live = self._board, partial(board.engines.get, "EDGES")
        self.parts = PartSearch(live, len(triangles), lambda: own.seams, lambda *asked: own.find_parts(*asked))
        self.edges = LoopOffers(board.engines, board.stops, points, self.parts)
        self.cuts = SurfaceLoops(board.engines, triangles)
        self._crests: Crests | None = None
        self._crests_first = False
        self._crest_taken: Pick | None = None
        self._seen: Wire | None = None
        self._choice = 0

    @property
    def offers(self) -> Offers:
        """The offers for the way that wires run."""
        return self.edges if self._board.options.along == "EDGES" else self.cuts

    @property
    def is_final(self) -> bool:
        return self.edges.final and self.cuts.final

    @property
    def bends(self) -> bool:
        """Whether a click would take the last closed cut, bent."""
        return self.cuts.bends and self.cuts.wanted

    def lives(self) -> Sequence[LiveWire]:
        board = self._board
        return [board.engines.cuts() if board.options.along == "SURFACE" else board.engines.get("EDGES")]

    def takes(self, target: Snap) -> bool:
        """Whether a click at a target takes the offer that is shown."""
        return self.offers.wire is not None and self.offers.edge == undirected(target.pick)

    # Offers

    def hover(self, target: Snap | None, loop: bool, bend: bool) -> bool:
        """Ask for the loops at a target, for the last closed cut bent to it, or for none. Return whether others vanish."""
        self.target = target
        if target is None or undirected(target.pick) != self._crest_taken:
            self._crest_taken = None
        vanish = self.cuts.bend(bend)
        asked = target.pick if (loop or bend) and target is not None and self.offers.takes(target.pick) else None
        if asked is not None and undirected(asked) == self._crest_taken:
            asked = None
        self.edges.point_at(target)
        vanish = self.offers.aim(asked) or vanish
        return self._show() or vanish

    def poll(self) -> bool:
        before = self.reason
        return self._show() or before != self.reason

    def _show(self) -> bool:
        """Show the offers at the cursor as soon as they are computed. Return whether they are new."""
        offers, target = self.offers, self.target
        for own in (self.edges, self.cuts):
            own.stop_waiting()  # compute no offers that nobody asks for any more
        if target is None or not offers.unfinished:
            self.reason = "" if not offers.missing else self.reason
            return False
        changed = offers.show(target.pick, self.find(target.pick))
        if not self.reason and offers.NONE and offers.missing and offers.final and not self.cuts.bends:
            self.reason = offers.NONE
        return changed

    def advance(self) -> None:
        """Show the next offer. Raise Refused if there is none."""
        why = self.offers.advance()
        if why:
            raise Refused(why)

    def use_crests(self, crests: Crests | None, first: bool) -> bool:
        """Offer ridges and valleys, as the first or as the last offer. Return whether other offers are shown."""
        if crests is self._crests and first == self._crests_first:
            return False
        self._crests, self._crests_first = crests, first
        if not self.offers.wanted:
            return False
        self.offers.final = False
        return self.poll()

    def find(self, pick: Pick, kept: Wire | None = None) -> tuple[Wire, ...]:
        """Return what a click on a pick may take, or nothing while it is computed. The wire that such a click took and `kept` comes first.

        An edge has the offers along edges, even if wires run across the surface.
        """
        self.reason = ""
        offers = self.edges if isinstance(pick, tuple) else self.cuts
        self.cuts.into_faces = self._board.options.into_faces
        try:
            return self._with_crest(pick, offers.find(pick, self._board.drawn, kept), kept)
        except ValueError as error:
            self.reason = str(error)
            return ()

    def _with_crest(self, pick: Pick, offers: tuple[Wire, ...], kept: Wire | None) -> tuple[Wire, ...]:
        """Return offers with the ridge or valley at a pick: first if these are shown, otherwise last."""
        if self.cuts.bends and not isinstance(pick, tuple):
            return offers
        # A click must not take the first known loop while others are still computed.
        ready = offers or (self.edges if isinstance(pick, tuple) else self.cuts).final or self._crests_first
        crest = self._crests.offer(pick) if self._crests is not None and kept is None and ready else None
        if crest is None or undirected(pick) == self._crest_taken:
            return offers
        return (crest, *offers) if self._crests_first else (*offers, crest)

    # Clicks

    def check(self, target: Snap) -> None:
        """Raise Refused if no loop can lead through a target."""
        if not self.offers.takes(target.pick):
            along_edges = self._board.options.along == "EDGES"
            what = "Loops need an edge" if along_edges else "Closed cuts need a vertex or a point of a face"
            raise Refused(f"{what}, not {pick_name(target.pick)}")

    def take(self, target: Snap) -> Edit | None:
        """Take the offer that is shown at a target, or the first one. Return None if it is taken already."""
        self.check(target)
        self.cuts.bend(False)
        self.edges.point_at(target)
        self._seen, self._choice = None, 0
        if self.edges.edge == undirected(target.pick) and self.edges.wire is not None:
            self._seen, self._choice = self.edges.wire, self.edges.choice
            if self._seen.kind not in CREST_KINDS:
                self._choice -= self.edges.offers[0].kind in CREST_KINDS
        if isinstance(target.pick, tuple):
            return self._take_loop(target, target.pick)
        return self._take_cut(target)

    def _take_loop(self, target: Snap, edge: Edge) -> Edit | None:
        board = self._board
        if self._seen is not None and self._seen.kind in CREST_KINDS:
            return self._take_crest(edge)
        own = self.edges.taken_through(board.drawn, edge)
        if own is not None and own.marks == board.options.marking:
            # The first press of a double click took it already.
            return self.next_offer(own, self._choice) if self._choice else None
        # It is read first: offers that are missing when all work is done stay missing.
        progress = board.engines.get("EDGES").progress()
        offers = self.find(edge)
        if not offers:
            if progress < 1.0 or not self.edges.final:
                return self._later(target, LoopSearch(board, self, target, self._choice))
            raise Refused(self.reason or f"No edge continues at {pick_name(edge)}")
        loops = tuple(offer for offer in offers if offer.kind not in CREST_KINDS)
        if not loops or (self._seen is None and offers[0].kind in CREST_KINDS):
            return self._take_crest(edge)
        wires = taken_loops(loops, self._choice, board.how("EDGES"))
        self.edges.took(edge, wires[-1])
        return Edit(board.base.adding(*map(Given.of, wires)))

    def _later(self, target: Snap, search: Search) -> Edit:
        """Take what is offered at a target as soon as it is known."""
        board = self._board
        along = board.options.along
        request = Sought(along=along, start=target.pick, end=target.pick, closed=True, what="loop")
        return Edit(board.base.adding(request), (Begun(request, Course(), search),))

    def _take_cut(self, target: Snap) -> Edit:
        offers = self.find(target.pick)
        offer = offers[self.cuts.choice_among(target.pick, offers)] if offers else None
        if offer is not None and offer.kind in CREST_KINDS:
            return self._take_crest(target.pick)
        if not self.cuts.final:
            return self._later(target, CutSearch(self._board, target.pick, self.cuts, None, seen=offer))
        if offer is None:
            raise Refused(self.reason or self.cuts.NONE)
        wires = cut_wires(self.cuts.pieces(offer), self._board.how("SURFACE"))
        self.cuts.take(target.pick, offer, wires, None)
        return Edit(self._board.base.adding(*map(Given.of, wires)))

    def bend_to(self, target: Snap) -> Edit:
        """Bend the last closed cut to a target: the shortest one through its first point and the target that lies around the same.

        The next bend moves the second point.
        """
        board = self._board
        if board.options.along == "EDGES" or not self.cuts.takes(target.pick):
            raise Refused(f"Closed cuts bend to places on the surface, not to {pick_name(target.pick)}")
        before = self.cuts.bendable(board.drawn)
        if before is None:
            raise Refused("No closed cut to bend: add one first")
        self.cuts.bend(True)
        offers = self.find(target.pick)
        how = replace(board.how("SURFACE"), marks=before.wires[0].marks, mirror=before.wires[0].mirror)
        how = replace(how, finish=before.wires[0].finish)
        ids = [wire.id for wire in before.wires]
        rest = board.base.without(*ids)
        if self.cuts.final:
            if not offers:
                raise Refused(self.reason or self.cuts.NONE)
            wires = cut_wires(self.cuts.pieces(offers[0]), how)
            self.cuts.take(target.pick, offers[0], wires, before)
            return Edit(rest.adding(*map(Given.of, wires)))
        request = Sought(along="SURFACE", start=target.pick, end=target.pick, closed=True, what="loop")
        search = CutSearch(board, target.pick, self.cuts, before, how)
        return Edit(rest.adding(request), (Begun(request, Course(before.wires), search),))

    def next_offer(self, own: Wire, steps: int = 1) -> Edit:
        """Return the edit that replaces the loop which a click on an edge took by another offer of that click."""
        assert own.through is not None
        network = self._board.base.loosened(own.id)
        if not own.offers:
            offers = self.find(own.through, own)[1:]
            if not self.edges.final:
                request = Sought(along="EDGES", start=own.start, end=own.end, closed=own.closed, id=own.id, what="loop")
                search = LoopSearch(self._board, self, Snap(own.through), steps, own)
                return Edit(
                    network.replacing({own.id: (request,)}),
                    (Begun(request, Course((own,)), search),),
                )
            if not offers:
                raise Refused(self.reason or "No other loop through this edge")
            own = replace(own, offers=offers)
        return Edit(network.replacing({own.id: (Given.of(own.next_offer(steps)),)}))

    def _take_crest(self, pick: Pick) -> Edit:
        """Return the edit that draws a line along the ridge or valley at a pick."""
        board = self._board
        number = None if self._crests is None else self._crests.line_at(pick)
        if self._crests is None or number is None:
            raise Refused(f"No ridge or valley runs at {pick_name(pick)}")
        points, triangles = self._crests.line(number)
        first = FacePoint.at(points[0], int(triangles[0]), board.triangles, board.points)
        begin: Pick = first if board.options.into_faces and board.options.along == "SURFACE" else first.vertex
        line = Lining(board, Snap(begin), apart=True)
        line.draw(points, triangles, None)
        edit = line.keep()
        self.cuts.was_taken(pick)
        self.edges.wanted = False
        self._crest_taken = undirected(pick)
        return edit

    def is_crest_taken(self, pick: Pick) -> bool:
        """Whether the last loop was a ridge or valley at a pick."""
        return undirected(pick) == self._crest_taken

    def forget_crest(self) -> None:
        """Offer the ridge or valley again that was taken last: it may be gone."""
        self._crest_taken = None

    def cancel(self) -> None:
        """Show no offers, and ask for none."""
        for offers in (self.edges, self.cuts):
            offers.wanted = False
            offers.clear()
        self.cuts.bend(False)


def taken_loops(loops: tuple[Wire, ...], choice: int, how: How) -> tuple[Wire, ...]:
    """Return the wires of an offered loop, those beside it first."""
    choice = min(choice, len(loops) - 1)
    wire = replace(taken(loops, choice, how.marks), mirror=how.mirror)
    return (*(each.anew(marks=how.marks, mirror=how.mirror) for each in loops[choice].beside), wire)


def cut_wires(pieces: tuple[Wire, ...], how: How) -> tuple[Wire, ...]:
    """Return the wires of a closed cut. Raise Refused if nothing of it leaves a trace."""
    wires = tuple(wire for wire in (how.of(piece.anew()) for piece in pieces) if wire.leaves_trace)
    if not wires:
        raise Refused("No edge is left for the seam of this cut")
    return wires


class LoopSearch(Search):
    """Finds the loop that a click on an edge took, or, of a wire that is kept, the offer some steps on."""

    def __init__(self, board: Board, offering: Offering, target: Snap, choice: int, kept: Wire | None = None) -> None:
        engines = board.engines.fork("EDGES")
        self._board, self._offering = board, offering
        self._target, self._choice, self._kept = target, choice, kept
        self._live = engines.get("EDGES")
        self._offers = LoopOffers(engines, board.stops, board.points, offering.parts)
        self._offers.point_at(target)
        self._how = board.how("EDGES")
        self._waits = 0

    def lives(self) -> Sequence[LiveWire]:
        return (self._live,)

    def __next__(self) -> Course:
        edge, kept = self._target.pick, self._kept
        progress = self._live.progress()
        offers = self._offers.find(edge, self._board.drawn, kept)
        if not offers and (progress < 1.0 or not self._offers.final):
            self._waits = patiently(self._live, progress < 1.0, self._waits)
            return Course(() if kept is None else (kept,))
        if kept is not None:
            if len(offers) < 2:
                raise Refused("No other loop through this edge")
            return Course((replace(kept, offers=offers[1:]).next_offer(self._choice),), final=True)
        if not offers:
            raise Refused(f"No edge continues at {pick_name(edge)}")
        wires = taken_loops(offers, self._choice, self._how)
        self._offering.edges.took(edge, wires[-1])
        return Course(wires, final=True)


class CutSearch(Search):
    """Finds the closed cut that a click took, which is the one `seen` there if it stays, or the cut `before` bent to a point."""

    def __init__(
        self,
        board: Board,
        pick: Pick,
        cuts: SurfaceLoops,
        before: TakenCut | None,
        how: How | None = None,
        seen: Wire | None = None,
    ) -> None:
        engines = board.engines.fork("CUTS")
        self._board, self._pick, self._cuts, self._before = board, pick, cuts, before
        self._live = engines.cuts()
        self._own = SurfaceLoops(engines, board.triangles)
        self._own.into_faces = board.options.into_faces
        if before is not None:
            self._own.recall((before,))
            self._own.bend(True)
        self._how, self._seen = how or board.how("SURFACE"), seen
        self._drawn = board.drawn
        self._waits = 0

    def lives(self) -> Sequence[LiveWire]:
        return (self._live,)

    def __next__(self) -> Course:
        progress = self._live.progress()
        offers = self._own.find(self._pick, self._drawn)
        if not self._own.final:
            self._waits = patiently(self._live, progress < 1.0, self._waits)
            return Course(() if self._before is None else self._before.wires)
        if not offers:
            raise Refused(self._own.NONE)
        offer = next((each for each in offers if self._seen is not None and each.like(self._seen)), offers[0])
        wires = cut_wires(self._own.pieces(offer), self._how)
        self._cuts.take_from(self._own, self._pick, offer, wires, self._before)
        return Course(wires, final=True)
