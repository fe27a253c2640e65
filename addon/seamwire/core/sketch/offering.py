# SPDX-License-Identifier: GPL-3.0-or-later
"""The offered loops: a click takes a whole loop, strip, closed cut, ridge or valley."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from ..base.refused import Refused
from ..network.network import Given, How, Snap, Sought
from ..network.picks import FacePoint, pick_name, undirected
from ..network.wires import Wire
from ..offers.crests import CREST_KINDS
from ..offers.edge_loops import EdgeLoops, PartSearch, taken
from ..offers.surface_loops import SurfaceLoops
from .courses import Course, Search
from .interaction import Begun, Edit, Interaction
from .lining import Lining

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from ..network.network import Network
    from ..network.picks import Edge, Pick
    from ..offers.crests import Crests
    from ..offers.surface_loops import TakenCut
    from ..solver.solver import LiveWire
    from .board import Board


NO_CUT = "The shape suggests no closed cut here"


class Offering(Interaction):
    """The loops that a click at the cursor offers, along edges or across the surface.

    Attributes
    ----------
    edges, cuts
        What finds loops along edges, and closed cuts across the surface.
    wanted
        Whether offers are asked for.
    offers, choice
        The offers, no two alike, the likeliest first, and the one that is shown.
    edge
        The pick that they are for, with the smaller vertex of an edge first.
    bends
        Whether the offer is the cut that was taken last, bent to the cursor.
    """

    def __init__(self, board: Board) -> None:
        super().__init__(board)
        points, triangles = board.points, board.triangles
        own, live = self._board, partial(board.engines.get, "EDGES")
        self.parts = PartSearch(live, len(triangles), lambda: own.seams, lambda *asked: own.find_parts(*asked))
        self.edges = EdgeLoops(board.engines, board.stops, points, self.parts)
        self.cuts = SurfaceLoops(board.engines, triangles)
        self.wanted = self.bends = False
        self.clear()
        self._shown: tuple[Wire | None, bool] = (None, False)
        self._crests: Crests | None = None
        self._crests_first = False
        # Nothing is offered where something was taken, until offers are asked for at another place.
        self._taken: Pick | None = None
        self._crest_taken: Pick | None = None

    def clear(self) -> None:
        """Show no offers. `wanted` and `bends` stay."""
        self.edge: Pick | None = None
        self.offers: tuple[Wire, ...] = ()
        self.choice = 0
        self._final = True

    @property
    def wire(self) -> Wire | None:
        return self.offers[self.choice] if self.offers else None

    @property
    def is_final(self) -> bool:
        return self._final

    @property
    def is_idle(self) -> bool:
        """Whether no offers are asked for, and no click has just taken a ridge."""
        return not (self.wanted or self.bends) and self._crest_taken is None

    def lives(self) -> Sequence[LiveWire]:
        board = self._board
        return [board.engines.cuts() if board.options.along == "SURFACE" else board.engines.get("EDGES")]

    def takes(self, target: Snap) -> bool:
        return self.wire is not None and self.edge == undirected(target.pick)

    # Offers

    def hover(self, target: Snap | None, loop: bool, bend: bool) -> bool:
        """Ask for the loops at a target, for the last closed cut bent to it, or for none. Return whether others vanish."""
        self._point_at(target)
        if target is None or undirected(target.pick) != self._crest_taken:
            self._crest_taken = None
        vanish = self._bend(bend)
        vanish = self._ask(target.pick if (loop or bend) and target is not None else None) or vanish
        return self._show() or vanish

    def _point_at(self, target: Snap | None) -> None:
        before, self.target = self.target, target
        if before is None or target is None or self.edge != undirected(target.pick) or not isinstance(self.edge, tuple):
            return
        same = (before.crossing, before.triangle, before.inside) == (target.crossing, target.triangle, target.inside)
        self._final = self._final and same and self.edges.with_parts == self.parts.is_complete

    def _bend(self, bends: bool) -> bool:
        vanish = bends != self.bends and bool(self.offers)
        if bends != self.bends:
            self.bends = bends
            self.clear()
        return vanish

    def _ask(self, pick: Pick | None) -> bool:
        """Ask for the offers at a pick, or for none. Return whether others vanish."""
        if pick is not None and (not self._may_lead_through(pick) or undirected(pick) == self._crest_taken):
            pick = None
        if pick is None:
            self._shown = (None, False)
            self.parts.stop()
        elif self.edge != undirected(pick) and self.wire is not None:
            self._shown = (self.wire, self._shown[1] or self.choice > 0)
        if pick != self._taken:
            self._taken = None
        self.wanted = pick is not None and self._taken is None
        if self.edge is None or (self.wanted and self.edge == undirected(pick)):
            return False
        vanish = bool(self.offers)
        self.clear()
        return vanish

    def _may_lead_through(self, pick: Pick) -> bool:
        return isinstance(pick, tuple) == (self._board.options.along == "EDGES")

    def poll(self) -> bool:
        before = self.reason
        return self._show() or before != self.reason

    def wait(self) -> None:
        """Wait for what the offers need beside the library."""
        self.parts.wait()
        if isinstance(self.edge, tuple):
            self._final = self._final and self.edges.with_parts == self.parts.is_complete

    def _show(self) -> bool:
        """Show the offers at the cursor as soon as they are computed. Return whether they are new."""
        target = self.target
        if target is None or not self.wanted or (self.offers and self._final):
            self._final = self._final or not self.wanted  # compute no offers that nobody asks for any more
            self.reason = self.reason if self.wanted and not self.offers else ""
            return False
        found, self._final = self.find(target.pick)
        before, choice = self.offers, self._choice_among(target.pick, found)
        self.edge, self.offers, self.choice = undirected(target.pick), found, choice
        if not self.reason and not found and self._final and not self.bends and not isinstance(target.pick, tuple):
            self.reason = NO_CUT
        return len(before) != len(found) or not all(map(Wire.like, before, found))

    def _choice_among(self, pick: Pick, offers: tuple[Wire, ...]) -> int:
        """Return which of the offers for a pick is the one that was chosen, wherever it is by now. Until one was, the first."""
        if self.wire is None or self.edge != undirected(pick) or self.choice == 0:
            return 0
        alike = (place for place, offer in enumerate(offers) if offer.like(self.wire))
        return next(alike, min(self.choice, max(len(offers) - 1, 0)))

    def advance(self) -> None:
        if not self.offers:
            raise Refused("No loop found yet")
        if len(self.offers) == 1:
            raise Refused("No other loop through this edge" if self._is_along_edges else "No other closed cut here")
        self.choice = (self.choice + 1) % len(self.offers)

    @property
    def _is_along_edges(self) -> bool:
        return self._board.options.along == "EDGES"

    def use_crests(self, crests: Crests | None, first: bool) -> bool:
        if crests is self._crests and first == self._crests_first:
            return False
        self._crests, self._crests_first = crests, first
        if not self.wanted:
            return False
        self._final = False
        return self.poll()

    def find(self, pick: Pick, kept: Wire | None = None) -> tuple[tuple[Wire, ...], bool]:
        """Return what a click on a pick may take, and whether that is final. The wire that such a click took and `kept` comes first.

        An edge has the offers along edges, even if wires run across the surface.
        """
        self.reason = ""
        board = self._board
        try:
            if isinstance(pick, tuple):
                found, final = self.edges.find(pick, board.drawn, self.target, self._shown, kept)
            else:
                found, final = self.cuts.find(pick, board.drawn, self.bends, board.options.into_faces)
            return self._with_crest(pick, found, final, kept), final
        except ValueError as error:
            self.reason = str(error)
            return (), True

    def _with_crest(self, pick: Pick, offers: tuple[Wire, ...], final: bool, kept: Wire | None) -> tuple[Wire, ...]:
        """Return offers with the ridge or valley at a pick: first if these are shown, otherwise last."""
        if self.bends and not isinstance(pick, tuple):
            return offers
        # A click must not take the first known loop while others are still computed.
        ready = offers or final or self._crests_first
        crest = self._crests.offer(pick) if self._crests is not None and kept is None and ready else None
        if crest is None or undirected(pick) == self._crest_taken:
            return offers
        return (crest, *offers) if self._crests_first else (*offers, crest)

    # Clicks

    def check(self, target: Snap) -> None:
        if not self._may_lead_through(target.pick):
            what = "Loops need an edge" if self._is_along_edges else "Closed cuts need a vertex or a point of a face"
            raise Refused(f"{what}, not {pick_name(target.pick)}")

    def take(self, target: Snap) -> Edit | None:
        """Take the offer that is shown at a target, or the first one. Return None if it is taken already."""
        self.check(target)
        self._bend(False)
        self._point_at(target)
        return self._take_loop(target, target.pick) if isinstance(target.pick, tuple) else self._take_cut(target)

    def _take_loop(self, target: Snap, edge: Edge) -> Edit | None:
        board = self._board
        seen, choice = (self.wire, self.choice) if self.takes(target) else (None, 0)
        if seen is not None and seen.kind in CREST_KINDS:
            return self._take_crest(edge)
        if seen is not None:
            choice -= self.offers[0].kind in CREST_KINDS
        own = self.edges.taken_through(board.drawn, edge)
        if own is not None and own.marks == board.options.marking:
            # The first press of a double click took it already.
            return self.next_offer(own, choice) if choice else None
        # It is read first: offers that are missing when all work is done stay missing.
        progress = board.engines.get("EDGES").progress()
        offers, final = self.find(edge)
        if not offers:
            if progress < 1.0 or not final:
                return self._later(target, _search_loop(board, self, target, choice))
            raise Refused(self.reason or f"No edge continues at {pick_name(edge)}")
        loops = tuple(offer for offer in offers if offer.kind not in CREST_KINDS)
        if not loops or (seen is None and offers[0].kind in CREST_KINDS):
            return self._take_crest(edge)
        wires = taken_loops(loops, choice, board.how("EDGES"))
        self.edges.took(edge, wires[-1])
        return Edit(board.base.adding(*map(Given.of, wires)))

    def _later(self, target: Snap, search: Search) -> Edit:
        board = self._board
        along = board.options.along
        request = Sought(along=along, start=target.pick, end=target.pick, closed=True, what="loop")
        return Edit(board.base.adding(request), (Begun(request, Course(), search),))

    def _take_cut(self, target: Snap) -> Edit:
        offers, final = self.find(target.pick)
        offer = offers[self._choice_among(target.pick, offers)] if offers else None
        if offer is not None and offer.kind in CREST_KINDS:
            return self._take_crest(target.pick)
        if not final:
            return self._later(
                target, _search_cut(self._board, target.pick, self.cuts, None, self._board.how("SURFACE"), offer)
            )
        if offer is None:
            raise Refused(self.reason or NO_CUT)
        return self._with_cut(self._board.base, target.pick, offer, self._board.how("SURFACE"), None)

    def _with_cut(self, network: Network, pick: Pick, offer: Wire, how: How, before: TakenCut | None) -> Edit:
        wires = cut_wires(self.cuts.pieces(offer), how)
        self.cuts.take(self.cuts, pick, offer, wires, before)
        self._taken, self.wanted = pick, False
        return Edit(network.adding(*map(Given.of, wires)))

    def bend_to(self, target: Snap) -> Edit:
        """Bend the last closed cut to a target: the shortest one through its first point and the target that lies around the same.

        The next bend moves the second point.
        """
        board = self._board
        if self._is_along_edges or isinstance(target.pick, tuple):
            raise Refused(f"Closed cuts bend to places on the surface, not to {pick_name(target.pick)}")
        before = self.cuts.bendable(board.drawn)
        if before is None:
            raise Refused("No closed cut to bend: add one first")
        self._bend(True)
        offers, final = self.find(target.pick)
        how = replace(board.how("SURFACE"), marks=before.wires[0].marks, mirror=before.wires[0].mirror)
        how = replace(how, finish=before.wires[0].finish)
        rest = board.base.without(*(wire.id for wire in before.wires))
        if final and not offers:
            raise Refused(self.reason or NO_CUT)
        if final:
            return self._with_cut(rest, target.pick, offers[0], how, before)
        request = Sought(along="SURFACE", start=target.pick, end=target.pick, closed=True, what="loop")
        search = _search_cut(board, target.pick, self.cuts, before, how)
        return Edit(rest.adding(request), (Begun(request, Course(before.wires), search),))

    def next_offer(self, own: Wire, steps: int = 1) -> Edit:
        """Return the edit that replaces the loop which a click on an edge took by another offer of that click."""
        assert own.through is not None
        network = self._board.base.loosened(own.id)
        if not own.offers:
            offers, final = self.find(own.through, own)
            if not final:
                request = Sought(along="EDGES", start=own.start, end=own.end, closed=own.closed, id=own.id, what="loop")
                search = _search_loop(self._board, self, Snap(own.through), steps, own)
                return Edit(
                    network.replacing({own.id: (request,)}),
                    (Begun(request, Course((own,)), search),),
                )
            if not offers[1:]:
                raise Refused(self.reason or "No other loop through this edge")
            own = replace(own, offers=offers[1:])
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
        self._taken, self.wanted = pick, False
        self._crest_taken = undirected(pick)
        return edit

    def is_crest_taken(self, pick: Pick) -> bool:
        return undirected(pick) == self._crest_taken

    def forget_crest(self) -> None:
        self._crest_taken = None

    def cancel(self) -> None:
        self.wanted = self.bends = False
        self.clear()


def taken_loops(loops: tuple[Wire, ...], choice: int, how: How) -> tuple[Wire, ...]:
    choice = min(choice, len(loops) - 1)
    wire = replace(taken(loops, choice, how.marks), mirror=how.mirror)
    return (*(each.anew(marks=how.marks, mirror=how.mirror) for each in loops[choice].beside), wire)


def cut_wires(pieces: tuple[Wire, ...], how: How) -> tuple[Wire, ...]:
    wires = tuple(wire for wire in (how.of(piece.anew()) for piece in pieces) if wire.leaves_trace)
    if not wires:
        raise Refused("No edge is left for the seam of this cut")
    return wires


def _search_loop(board: Board, offering: Offering, target: Snap, choice: int, kept: Wire | None = None) -> Search:
    """Find the loop that a click on an edge took, or, of a wire that is kept, the offer some steps on."""
    engines, edge, how = board.engines.fork("EDGES"), target.pick, board.how("EDGES")
    live, loops = engines.get("EDGES"), EdgeLoops(engines, board.stops, board.points, offering.parts)

    def courses() -> Iterator[Course]:
        while True:
            progress = live.progress()
            offers, final = loops.find(edge, board.drawn, target, kept=kept)
            if not offers and (progress < 1.0 or not final):
                yield Course(() if kept is None else (kept,))
                continue
            if kept is not None:
                if len(offers) < 2:
                    raise Refused("No other loop through this edge")
                yield Course((replace(kept, offers=offers[1:]).next_offer(choice),), final=True)
            if not offers:
                raise Refused(f"No edge continues at {pick_name(edge)}")
            wires = taken_loops(offers, choice, how)
            offering.edges.took(edge, wires[-1])
            yield Course(wires, final=True)

    return Search.of(live, courses())


def _search_cut(
    board: Board, pick: Pick, cuts: SurfaceLoops, before: TakenCut | None, how: How, seen: Wire | None = None
) -> Search:
    """Find the closed cut that a click took, which is the one `seen` there if it stays, or the cut `before` bent to a point."""
    engines, into_faces, drawn = board.engines.fork("CUTS"), board.options.into_faces, board.drawn
    live, own = engines.cuts(), SurfaceLoops(engines, board.triangles)
    if before is not None:
        own.recall((before,))

    def courses() -> Iterator[Course]:
        while True:
            offers, final = own.find(pick, drawn, before is not None, into_faces)
            if not final:
                yield Course(() if before is None else before.wires)
                continue
            if not offers:
                raise Refused(NO_CUT)
            offer = next((each for each in offers if seen is not None and each.like(seen)), offers[0])
            wires = cut_wires(own.pieces(offer), how)
            cuts.take(own, pick, offer, wires, before)
            yield Course(wires, final=True)

    return Search.of(live, courses())
