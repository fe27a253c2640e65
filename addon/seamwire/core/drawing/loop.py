# SPDX-License-Identifier: GPL-3.0-or-later
"""The loop gesture: a click keeps a whole loop, strip, closed cut, ridge or valley."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from ..base.refused import Refused
from ..fields.crests import CREST_KINDS
from ..network.network import Snap
from ..network.picks import FacePoint, pick_name, undirected
from ..offers.edge_loops import LoopOffers, taken
from ..offers.part_search import PartSearch
from ..offers.surface_loops import SurfaceLoops
from .gesture import Gesture
from .line import LineGesture

if TYPE_CHECKING:
    from ..fields.crests import Crests
    from ..network.picks import Edge, Pick
    from ..network.wires import Wire
    from ..offers.offers import Offers
    from ..solver.solver import LiveWire
    from .drawing import Drawing
    from .gesture import Committed
    from .wire import WireGesture


class LoopGesture(Gesture):
    """The loops that a click at the cursor offers, along edges or across the surface.

    Attributes
    ----------
    edges, cuts
        The offers along edges, and across the surface.
    problem
        Why there were no offers when they were last looked for, if that is known.
    """

    needs_offers = True

    def __init__(self, drawing: Drawing, live: WireGesture) -> None:
        self._drawing = drawing
        self._live = live
        points, triangles = drawing.points, drawing.triangles
        live_edges = partial(drawing.engines.get, "EDGES")
        parts = PartSearch(live_edges, len(triangles), lambda: drawing.seams, drawing.find_parts)
        self.edges = LoopOffers(drawing.engines, drawing.stops, points, parts)
        self.cuts = SurfaceLoops(drawing.engines, triangles)
        self.problem = ""
        self._crests: Crests | None = None
        self._crests_first = False
        self._crest_taken: Pick | None = None
        self._target: Snap | None = None
        self._seen: Wire | None = None
        self._choice = 0
        self._told_none = False

    @property
    def offers(self) -> Offers:
        """The offers for the way that wires run."""
        return self.edges if self._drawing.options.along == "EDGES" else self.cuts

    @property
    def final(self) -> bool:
        """Whether all offers are computed."""
        return self.edges.final and self.cuts.final

    @property
    def bends(self) -> bool:
        """Whether a click would take the last closed cut, bent."""
        return self.cuts.bends and self.cuts.wanted

    def takes(self, target: Snap) -> bool:
        """Whether a click at a target takes the offer that is shown."""
        return self.offers.wire is not None and self.offers.edge == undirected(target.pick)

    # Offers

    def hover(self, target: Snap | None, loop: bool, bend: bool) -> bool:
        """Ask for offers at a target, or for the last closed cut bent to it. Return whether others vanish."""
        if target is None or undirected(target.pick) != self._crest_taken:
            self._crest_taken = None
        vanish = self.cuts.bend(bend)
        asked = target.pick if (loop or bend) and target is not None and self.offers.takes(target.pick) else None
        if asked is not None and undirected(asked) == self._crest_taken:
            asked = None
        self.edges.point_at(target)
        return self.offers.aim(asked) or vanish

    def poll(self) -> bool:
        """Show the offers at the cursor as soon as they are computed. Return whether they are new."""
        offers, target = self.offers, self._live.target
        self.problem = ""
        if target is None:
            return False
        if offers.wanted and not offers.takes(target.pick):
            # A click may have moved the target since. Nothing would ever be found for it.
            vanish = bool(offers.offers)
            offers.wanted = False
            offers.clear()
            return vanish
        return offers.unfinished and offers.show(target.pick, self.find(target.pick))

    def show(self, message: str, is_awaited: bool) -> tuple[bool, str]:
        """Show the offers at the cursor once they are computed. Return whether others are to be seen, and the message from here on.

        `is_awaited`: whether a committed gesture waits for offers.
        """
        if not is_awaited:
            # Compute no offers that nobody asks for any more, in both ways of running.
            self.edges.stop_waiting()
            self.cuts.stop_waiting()
        changed = self.poll()
        message = self.problem or message
        offers = self.offers
        none = bool(offers.NONE) and offers.missing and offers.final and not self.cuts.bends
        if none != self._told_none and (not none or not message):
            self._told_none = none
            if none or message == self.cuts.NONE:
                message = offers.NONE if none else ""
        return changed, message

    def use_crests(self, crests: Crests | None, first: bool) -> bool:
        """Offer ridges and valleys, as the first or as the last offer. Return whether offers have to be found again."""
        if crests is self._crests and first == self._crests_first:
            return False
        self._crests, self._crests_first = crests, first
        if self.offers.wanted:
            self.offers.final = False
        return self.offers.wanted

    def find(self, pick: Pick, kept: Wire | None = None) -> tuple[Wire, ...]:
        """Return what a click on a pick may take, or nothing while it is computed. The wire that such a click took and `kept` comes first.

        An edge has the offers along edges, even if wires run across the surface.
        """
        self.problem = ""
        offers = self.edges if isinstance(pick, tuple) else self.cuts
        self.cuts.into_faces = self._drawing.options.into_faces
        try:
            return self._with_crest(pick, offers.find(pick, self._drawing.network, kept), kept)
        except ValueError as error:
            self.problem = str(error)
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

    def aim(self, target: Snap | None) -> str:
        """Choose the offer that is shown at a target, or the first one if none is shown."""
        if target is None:
            return ""
        if not self.offers.takes(target.pick):
            along_edges = self._drawing.options.along == "EDGES"
            what = "Loops need an edge" if along_edges else "Closed cuts need a vertex or a point of a face"
            return f"{what}, not {pick_name(target.pick)}"
        self._target = target
        self.cuts.bend(False)
        self.edges.point_at(target)
        shown = self.edges
        self._seen, self._choice = None, 0
        if shown.edge == undirected(target.pick) and shown.wire is not None:
            self._seen, self._choice = shown.wire, shown.choice
            if self._seen.kind not in CREST_KINDS:
                self._choice -= shown.offers[0].kind in CREST_KINDS
        return ""

    def commit(self) -> Committed:
        """Return the network with what is offered at the target."""
        assert self._target is not None
        pick = self._target.pick
        return self._along_edges(pick) if isinstance(pick, tuple) else self.commit_cut(self._target)

    def _along_edges(self, edge: Edge) -> Committed:
        options, network = self._drawing.options, self._drawing.network
        if self._seen is not None and self._seen.kind in CREST_KINDS:
            return self._along_crest(edge)
        own = self.edges.taken_through(network, edge)
        if own is not None and own.marks == options.marking:
            # The first press of a double click took it already.
            return NextOffer(self._drawing, self, own, self._choice).commit() if self._choice else None
        # It is read first: offers that are missing when all work is done stay missing.
        progress = self._drawing.engines.get("EDGES").progress()
        offers = self.find(edge)
        if not offers:
            if progress < 1.0 or not self.edges.final:
                return self
            raise Refused(self.problem or f"No edge continues at {pick_name(edge)}")
        loops = tuple(offer for offer in offers if offer.kind not in CREST_KINDS)
        if not loops or (self._seen is None and offers[0].kind in CREST_KINDS):
            return self._along_crest(edge)
        choice = min(self._choice, len(loops) - 1)
        wire = replace(taken(loops, choice, options.marking), mirror=network.mirror)
        beside = (each.anew(marks=options.marking, mirror=network.mirror) for each in loops[choice].beside)
        self.edges.took(edge, wire)
        return self._drawing.with_wires(*beside, wire)

    def commit_cut(self, target: Snap) -> Committed:
        """Return the network with the closed cut through a target, or with the last one bent to it."""
        pick, network = target.pick, self._drawing.network
        offers = self.find(pick)
        offer = offers[self.cuts.choice_among(pick, offers)] if offers else None
        if offer is not None and offer.kind in CREST_KINDS:
            return self._along_crest(pick)
        if not self.cuts.final:
            return self
        if offer is None:
            raise Refused(self.problem or self.cuts.NONE)
        before = self.cuts.bendable(network) if self.cuts.bends else None
        like = None if before is None else before.wires[0]
        wires = tuple(self._drawing.as_drawn(piece.anew(), like) for piece in self.cuts.pieces(offer))
        wires = tuple(wire for wire in wires if wire.leaves_trace)
        if not wires:
            raise Refused("No edge is left for the seam of this cut")
        for wire in () if before is None else before.wires:
            network = network.without(wire)
        self.cuts.take(pick, offer, wires, before)
        return replace(network, wires=(*network.wires, *wires))

    def _along_crest(self, pick: Pick) -> Committed:
        """Return the line along the ridge or valley at a pick, which waits in place of the loop."""
        drawing = self._drawing
        number = None if self._crests is None else self._crests.line_at(pick)
        if self._crests is None or number is None:
            raise Refused(f"No ridge or valley runs at {pick_name(pick)}")
        points, triangles = self._crests.line(number)
        first = FacePoint.at(points[0], int(triangles[0]), drawing.triangles, drawing.points)
        begin: Pick = first if drawing.options.into_faces and drawing.options.along == "SURFACE" else first.vertex
        line = LineGesture(drawing, Snap(begin), apart=True)
        line.draw(points, triangles, None)
        line.line.finish()
        self.cuts.was_taken(pick)
        self.edges.wanted = False
        self._crest_taken = undirected(pick)
        return line

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

    def lives(self) -> list[LiveWire]:
        """Return the live wires that compute closed cuts. Loops along edges come from the live wire's."""
        return [self._drawing.engines.cuts()] if self._drawing.options.along == "SURFACE" else []


class NextOffer(Gesture):
    """Replaces the wire that a click on an edge took by another offer of that click, `steps` further in their order."""

    needs_offers = True

    def __init__(self, drawing: Drawing, loops: LoopGesture, wire: Wire, steps: int = 1) -> None:
        self._drawing = drawing
        self._loops = loops
        self._wire = wire
        self._steps = steps

    def commit(self) -> Committed:
        """Return the network with the next offer in place of the wire."""
        network = self._drawing.network
        own = network.find(self._wire)
        if own is None:
            raise Refused("This wire no longer exists")
        assert own.through is not None
        if not own.offers:
            offers = self._loops.find(own.through, own)[1:]
            if not self._loops.edges.final:
                return self
            if not offers:
                raise Refused(self._loops.problem or "No other loop through this edge")
            own = replace(own, offers=offers)
        return network.with_wire(own).with_next_offer(own, self._steps)

    def lives(self) -> list[LiveWire]:
        """Return the live wires that compute for it. Offers at an edge are found along edges."""
        return [self._drawing.engines.get("EDGES")]
