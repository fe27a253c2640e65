# SPDX-License-Identifier: GPL-3.0-or-later
"""One drawing session: the live wire, what is kept, undo and redo.

Knows neither Blender nor the GPU. The tool in the viewport and the headless operator drive the same session; what it
shows and what it marks is decided here and nowhere else.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..base.messages import NOTHING, Message, message_of
from ..fields.crests import CREST_KINDS
from ..network.history import History
from ..network.mirror_images import MirrorImages
from ..network.network import FOLLOWS, FacePoint, Network, Seed, Snap, Wire, undirected
from ..network.stops import Stops
from ..network.strokes import OffMeshError, Stroke, drawn, for_library, through_vertices
from ..network.symmetry import Symmetry
from ..offers.edge_loops import LoopOffers, taken
from ..offers.flat_regions import FlatRegions
from ..offers.surface_loops import SurfaceLoops
from ..seams.seam_wires import seam_chains, waiting, wires_along
from ..solver.solver import Engines
from .drawn_line import DrawnLine
from .extension import Extension
from .intent import Intent
from .line import EdgeLine, SurfaceLine
from .options import Options
from .picture import Choice, Offered, Picture, ShownWire, Work, kept_wires, shown_seeds, shown_wires
from .retrace import Retraces, retraced
from .seed_drag import SeedDrag
from .wire import CandidateWires, only_vertices

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ..fields.crests import Crests
    from ..network.network import Along, Edge, Pick
    from ..network.strokes import ActsOn
    from ..offers.closed_cuts import TakenCut
    from ..offers.offers import Offers
    from ..solver.solver import LiveWire
    from .line import Line

Waiting = Literal["click", "loop", "bend", "run", "offer", "line"]
"""What waits: a click, a loop, a cut to be bent, a run to the end, the next offer for a kept wire, a line that was drawn."""


@dataclass(frozen=True)
class Queued:
    """A click that came before its wire was computed, or what else waits for one."""

    kind: Waiting
    snap: Snap
    line: DrawnLine | None = None


class Session:
    """One drawing session on one mesh.

    Parameters
    ----------
    make_live
        Makes the live wires for one way of running; called once for each way that is used, and once for closed cuts.
    points
        (n, 3) coordinates of the mesh's vertices.
    options
        The settings to begin with.
    edges
        (e, 2) the visible edges; None: whatever two vertices a mirrored edge would have, they have an edge.
    seams
        The edges, by their vertices, that are seams and no wires: wires that run straight on end there.
    to_object
        (3, 3) takes `points` to object coordinates, where mirroring happens; None: they are such.
    triangles
        (m, 3) those that the surface was made of; None: strokes run through vertices only.
    make_stroke
        Makes of a stroke what the live wires take.
    topology
        Whether what is mirrored to what is found by how the mesh hangs together, see `Symmetry`.

    Notes
    -----
    Each part (candidate wires, loop offers, extension, seed drag, retraces, history, mirror images) finds what is its own and
    knows no session. The session tells the parts what is under the cursor, makes of what they found the next network, and
    lets them follow that.

    Methods that do something return whether it was done; where it was not, `message` says why. `revision` grows with every
    change of what is to be seen, `network_revision` with every change of the kept wires.
    """

    def __init__(
        self,
        make_live: Callable[[Along], LiveWire],
        points: NDArray[np.float64],
        options: Options = Options(),  # noqa: B008 - it cannot be changed
        *,
        edges: NDArray[np.int32] | None = None,
        seams: ArrayLike = (),
        to_object: NDArray[np.float64] | None = None,
        triangles: NDArray[np.int32] | None = None,
        make_stroke: Callable[[Stroke], object] = for_library,
        topology: bool = False,
    ) -> None:
        self._points = points
        self._triangles = triangles
        self._symmetry = Symmetry(points, edges, to_object, topology, triangles)
        self._images = MirrorImages(self._symmetry)
        self._stops = Stops(seams, self._symmetry)
        self._engines = Engines(make_live, make_stroke)
        self._engines.use(options.metric, options.strengths, options.clamp)
        self._network = Network(mirror=options.mirror)
        self._history = History()
        self._candidates = CandidateWires(self._engines, points, edges)
        flat = None if triangles is None or edges is None else FlatRegions(points, triangles, edges)
        self._edge_loops = LoopOffers(self._engines, self._stops, points, flat)
        self._cuts = SurfaceLoops(self._engines, triangles)
        self._told_none = False
        self._crests: Crests | None = None
        self._crests_first = False
        self._crest_taken: Pick | None = None
        self._extension = Extension(self._engines, self._stops, points)
        self._drag: SeedDrag | None = None
        self._line: DrawnLine | None = None
        self._retraces = Retraces(self._engines, points)
        self._queue: list[Queued] = []
        self._last_click: tuple[Pick, int] | None = None
        # Made at once: what they compute first takes longest.
        self._progress = self._engines.get(options.along).progress()
        self.options = options
        self.message: Message = NOTHING
        self._picture: tuple[object, Picture] | None = None
        self._shown_kept: tuple[Network, tuple[ShownWire, ...]] | None = None
        self.revision = 0
        self.network_revision = 0

    # Drawing wires

    def hover(self, snap: Snap | Pick | None, loop: bool = False, bend: bool = False) -> None:
        """Move the free end of the live wire.

        Parameters
        ----------
        snap
            The pick under the cursor, or None. A pick alone stands for one on the plain mesh.
        loop
            Show the loop through it instead. Along edges the pick must be an edge, across the surface any other place.
        bend
            Show the closed cut that was taken last, bent to it; across the surface only.
        """
        if self._queue:
            return
        target = None if snap is None else Snap.of(snap)
        self._aim(target)
        if target is None or undirected(target.pick) != self._crest_taken:
            self._crest_taken = None
        bend = bend and self.options.along == "SURFACE"
        if bend != self._cuts.bends and self.message:
            self.message = NOTHING
            self.revision += 1
        self.revision += self._cuts.bend(bend)
        asked = target.pick if (loop or bend) and target is not None and self._loops.takes(target.pick) else None
        if asked is not None and undirected(asked) == self._crest_taken:
            asked = None
        self._edge_loops.point_at(target)
        self.revision += self._loops.aim(asked)
        self._show_offers()

    def click(self, snap: Snap | Pick) -> bool:
        """Place a seed; where a wire is live, keep it and go on from there.

        On the chain's first seed this closes the chain; on another seed, a wire or a seam it joins there and ends the
        chain. While the way to the end or a loop is shown, that is kept. Before the wire is computed the click waits, see `poll`.
        """
        target = Snap.of(snap)
        if self._extension.wanted and not self._queue:
            return self.run_to_end()
        if self._loops.wire is not None and self._loops.edge == undirected(target.pick) and not self._queue:
            return self.bend(target) if self._bends else self.loop(target)
        self.drag_cancel()
        if self._network.seed is None and not self._queue:
            return self.start(target)
        self._last_click = None
        if self._queue:
            self._queue.append(Queued("click", target))
            return True
        seen = self._candidates.active_final and target == self.target
        self._aim(target)
        # Keep the candidate that was shown. If none was shown yet, do not pick one merely because it finished first.
        if not (self._candidates.decided or (seen and self._candidates.active_final)) and self._wires_computing:
            return self._postpone("click", target)
        return self._keep(target)

    def start(self, snap: Snap | Pick) -> bool:
        """Begin a new chain, ending the one before."""
        target = Snap.of(snap)
        self._calm()
        if self.options.along == "SURFACE" and isinstance(target.pick, tuple):
            return self._refuse(only_vertices(target.pick))
        network = replace(self._network, seed=None).joined(target, self._points)
        if not self._change(replace(network, seed=network.seed_at(target, self.options.along))):
            return False
        self._last_click = (undirected(target.pick), self._history.steps)
        return True

    def loop(self, snap: Snap | Pick) -> bool:
        """Keep what is offered for an edge: the one that is shown, else the closed loop through it or, if none, the strip.

        A click on the same edge just before is taken back: a double click is a click first.
        """
        target = Snap.of(snap)
        edge = target.pick
        if not self._loops.takes(edge):
            code = "no-loop-through" if self.options.along == "EDGES" else "no-cut-through"
            return self._refuse(code, pick=edge)
        self.drag_cancel()
        self._cuts.bend(False)
        if self.options.along == "SURFACE":
            return self._cut_around(target)
        if undirected(edge) == self._crest_taken:
            return True  # of a double click, the first press took the ridge
        self._edge_loops.point_at(target)
        shown = self._loops
        seen, choice = (shown.wire, shown.choice) if shown.edge == undirected(edge) else (None, 0)
        on_crest = seen is not None and seen.kind in CREST_KINDS
        if seen is not None and not on_crest:
            choice -= shown.offers[0].kind in CREST_KINDS
        self._take_back_click(edge)
        if on_crest:
            return self._along_crest(edge)
        own = self._edge_loops.taken_through(self._network, edge)
        if own is not None and own.marks == self.options.marking:
            # Of a double click, the first press took it already.
            return not choice or self._retrace_offer(own, choice)
        offers = self._find_offers(edge)
        if not offers:
            if self.computing:
                return self._postpone("loop", target)
            return self._refuse(self.message or Message.of("no-edges-run-on", pick=edge))
        loops = tuple(offer for offer in offers if offer.kind not in CREST_KINDS)
        if not loops or (seen is None and offers[0].kind in CREST_KINDS):
            return self._along_crest(edge)
        wire = replace(taken(loops, min(choice, len(loops) - 1), self.options.marking), mirror=self._network.mirror)
        self._edge_loops.took(edge, wire)
        return self._change(replace(self._network, wires=(*self.wires, wire)))

    def _cut_around(self, target: Snap) -> bool:
        """Keep a closed cut through a point, or wires along a ridge: what is shown, else the best."""
        offers = self._find_offers(target.pick)
        offer = offers[self._cuts.choice_among(target.pick, offers)] if offers else None
        if offer is not None and offer.kind in CREST_KINDS:
            return self._along_crest(target.pick)
        if not self._cuts.final:
            return self._postpone("bend" if self._cuts.bends else "loop", target)
        if offer is None:
            return self._refuse(self.message or self._cuts.NONE)
        network = self._network
        before = self._cuts.bendable(network) if self._cuts.bends else None
        like = None if before is None else before.wires[0]
        wires = tuple(self._as_drawn(piece.anew(), like) for piece in self._cuts.pieces(offer))
        wires = tuple(wire for wire in wires if wire.leaves_trace)
        if not wires:
            return self._refuse("cut-meets-no-edge")
        for wire in () if before is None else before.wires:
            network = network.without(wire)
        self._cuts.take(target.pick, offer, wires, before)
        return self._change(replace(network, wires=(*network.wires, *wires)))

    def bend(self, snap: Snap | Pick) -> bool:
        """Bend the closed cut that was taken last: the shortest through its first point and this one that lies around the same.

        Once more, it is its second point that moves. One step for undo, which restores the old cut.
        """
        target = Snap.of(snap)
        if self.options.along == "EDGES" or not self._cuts.takes(target.pick):
            return self._refuse("no-bend-to", pick=target.pick)
        self.drag_cancel()
        self._cuts.bend(True)
        return self._cut_around(target)

    def _along_crest(self, pick: Pick) -> bool:
        """Keep wires that follow the ridge or valley at a pick, as soon as they are computed; one step for undo."""
        number = None if self._crests is None else self._crests.line_at(pick)
        if self._crests is None or number is None or self._triangles is None:
            return self._refuse("no-crest-at", pick=pick)
        points, triangles = self._crests.line(number)
        first = FacePoint.at(points[0], int(triangles[0]), self._triangles, self._points)
        begin: Pick = first if self._into_faces and self.options.along == "SURFACE" else first.vertex
        line = self._new_line(begin, None, None)
        line.to(points, triangles, None, self._stops.kept(self._network))
        self._cuts.was_taken(pick)
        self._edge_loops.wanted = False
        self._crest_taken = undirected(pick)
        return self.line_keep(DrawnLine(line, Snap(begin), False, apart=True))

    def next_candidate(self) -> bool:
        """Make the next of the wires the active one, until it is kept; of what is offered for an edge, the next."""
        part = self._loops if self._loops.wanted else self._candidates
        why = part.advance()
        if why:
            return self._refuse(why)
        self.message = NOTHING
        if part is self._candidates:
            self._show_extension()
        self.revision += 1
        return True

    def close(self, seen_along: tuple[float, float, float] | None = None) -> bool:
        """Lead the live wire back to the chain's first seed, keep it and end the chain; `seen_along`: as a snap has it."""
        first = self.closing_point
        if first is None:
            return self._refuse("no-chain-to-close")
        self._extension.wanted = False
        return self.click(Snap(first, "SEED", seen_along=seen_along))

    def run_to_end(self, preview: bool = False) -> bool:
        """Let the live wire run straight on until it meets a seam, a wire, the boundary, the mirror or itself.

        Parameters
        ----------
        preview
            Show it, for wherever the cursor goes; a click, or this without `preview`, keeps it. `stop_preview` ends that.
        """
        if self._network.seed is None:
            return self._refuse("nothing-runs-on")
        if self.options.along == "SURFACE":
            return self._refuse("no-run-across")
        self.drag_cancel()
        if preview:
            self._extension.wanted = True
            self._show_extension()
            return (
                self._extension.wire is not None
                or self.computing
                or self._refuse(self.message or Message.of("no-way-on"))
            )
        target = self.target
        if self._queue or (target is not None and not self._candidates.active_final and self._wires_computing):
            if target is None:
                return self._refuse("no-way-on")
            self._extension.wanted = False
            return self._postpone("run", target)
        wire = self._find_extension()
        if wire is None:
            return self._refuse(self.message or Message.of("no-way-on"))
        self._extension.wanted = False
        return self._change(replace(self._network, wires=(*self.wires, wire), seed=None))

    def stop_preview(self) -> bool:
        """Stop showing the way to the end."""
        if not self._extension.wanted:
            return False
        self._extension.clear()
        self.revision += 1
        return True

    def end_chain(self) -> None:
        """Let go of the live wire, or of a dragged seed; the kept wires stay."""
        self._calm()
        if self._network.seed is None:
            return
        # This is not a step for undo. Undoing the last wire afterwards makes the chain live again.
        self._set(replace(self._network, seed=None))
        self._candidates.chosen = None
        self._aim_again()

    # Changing kept wires

    def retrace(self, wire: Wire) -> bool:
        """Let a kept wire take its next way, that of another metric; one from a click on an edge, what is next there."""
        self._calm()
        own = self._network.find(wire)
        if own is None:
            return self._refuse("wire-is-gone")
        if own.through is not None:
            return self._retrace_offer(own)
        if own.closed:
            return self._refuse("loop-has-one-way")
        if own.alternatives:
            return self._take_way(own, own.alternatives)
        try:
            self._retraces.add(self._network, own.uncut())
        except ValueError as error:
            return self._refuse(message_of(error))
        self._read_progress()
        self._poll_retraces()
        return not self.message

    def drop(self, wire: Wire) -> bool:
        """Remove a kept wire."""
        self._calm()
        own = self._network.find(wire)
        if own is None:
            return self._refuse("wire-is-gone")
        return self._change(self._network.without(own))

    def insert(self, wire: Wire, pick: Pick) -> bool:
        """Put a seed into a kept wire, which makes two wires of it; a loop is cut opposite to the seed as well."""
        self._calm()
        network = self._network.with_seed_in(wire, pick, self._points)
        if network is None:
            return self._refuse("no-seed-into-wire", pick=pick)
        return self._change(network)

    def drag(self, snap: Snap | Pick) -> bool:
        """Take hold of a seed of the network; `drag_to` moves it, and its wires with it.

        On a wire (``Snap.to == "WIRE"``) a seed is put there first, in one step for undo with the move.
        """
        target = Snap.of(snap)
        self._calm()
        network = self._network.joined(target, self._points)
        try:
            self._drag = SeedDrag(self._engines, network, target.pick, self._points)
        except ValueError as error:
            return self._refuse(message_of(error))
        self._read_progress()
        self._candidates.clear()
        self._loops.clear()
        self._extension.clear()
        self.message = NOTHING
        self.revision += 1
        return True

    def drag_to(self, snap: Snap | Pick | None) -> bool:
        """Move the dragged seed; its wires follow as soon as they are computed. None: over nothing, it stays."""
        drag = self._drag
        if drag is None:
            return self._refuse("no-seed-moves")
        if snap is None or drag.ending:
            return False
        before = (drag.target, drag.network, self.message)
        self._candidates.target = Snap.of(snap)
        moved = drag.to(Snap.of(snap))
        self._read_progress()
        self.message = drag.message
        self.revision += before != (drag.target, drag.network, self.message)
        return moved

    def drag_end(self) -> bool:
        """Leave the dragged seed where it is, as soon as its wires are computed; one step for undo."""
        drag = self._drag
        if drag is None:
            return self._refuse("no-seed-moves")
        if not drag.final:
            drag.ending = True
            return True
        self._leave_drag()
        if drag.message or drag.target is None:
            why = drag.message
            self._aim_again()
            return self._refuse(why) if why else True
        # The mirror may have changed while the seed was dragged.
        network = replace(drag.network, mirror=self.options.mirror)
        return self._change(network.joined(drag.target, self._points))

    def drag_cancel(self) -> bool:
        """Let the dragged seed go back to where it was."""
        if self._drag is None:
            return False
        self._leave_drag()
        self._aim_again()
        return True

    def _leave_drag(self) -> None:
        """Let go of the dragged seed, and take over what was set meanwhile."""
        self._drag = None
        self.revision += 1
        if self._engines.computes != self.options.computes:
            self._compute_anew()

    # Ridges and valleys

    @property
    def wants_crests(self) -> bool:
        """Whether `use_crests` is to be told of ridges and valleys: what a click offers is asked for."""
        return self._loops.wanted

    def use_crests(self, crests: Crests | None, first: bool) -> None:
        """Offer wires along the mesh's ridges and valleys: where they are seen as the `first` of what a click offers, else as the last."""
        if crests is self._crests and first == self._crests_first:
            return
        self._crests, self._crests_first = crests, first
        if self._loops.wanted and self.target is not None:
            self._loops.final = False
            self._show_offers()

    # Drawing by dragging

    def goes_on_from(self, snap: Snap | Pick) -> bool:
        """Whether a line that begins at a place goes on from the live wire's seed, rather than begin a chain."""
        seed, target = self._network.seed, Snap.of(snap)
        return seed is not None and not self._queue and target.to == "SEED" and seed.at(target.pick, self.options.along)

    def line_begin(self, snap: Snap | Pick) -> bool:
        """Begin a line over the surface, `line_to` draws it. At the live wire's seed it goes on from there."""
        begin = Snap.of(snap)
        if self.options.along == "SURFACE" and isinstance(begin.pick, tuple):
            return self._refuse(only_vertices(begin.pick))
        self.drag_cancel()
        self.stop_preview()
        goes_on = self.goes_on_from(begin)
        seed = self._network.seed if goes_on else None
        if self.options.along == "SURFACE" and self._triangles is None:
            return self._refuse("no-triangles")
        vertex: int | None = None
        if seed is not None:
            vertex = seed.vertex
        elif isinstance(begin.pick, int):
            vertex = begin.pick
        before = seed.pick if seed is not None and seed.forward and isinstance(seed.pick, tuple) else None
        place = begin.pick if seed is None else seed.begins("SURFACE")
        self._line = DrawnLine(self._new_line(place, vertex, before), begin, goes_on)
        self._last_click = None
        self._candidates.clear()
        self._loops.clear()
        self.message = NOTHING
        self.revision += 1
        return True

    def _new_line(self, place: Pick, vertex: int | None, before: Edge | None) -> Line:
        """Return a line from a place across the surface; along edges from a vertex, None: the nearest one, after an edge."""
        if self.options.along == "EDGES":
            return EdgeLine(self._engines, self._points, vertex, before)
        assert self._triangles is not None
        return SurfaceLine(self._engines, self._points, self._triangles, place, self._into_faces)

    def line_to(self, points: NDArray[np.float64], triangles: NDArray[np.int32], snap: Snap | Pick | None) -> bool:
        """Draw the line on.

        Parameters
        ----------
        points
            (k, 3) all of it, from its beginning.
        triangles
            (k,) the triangle that each point lies in.
        snap
            The pick under the cursor.
        """
        drawn = self._line
        if drawn is None:
            return self._refuse("no-line-drawn")
        drawn.end = None if snap is None else Snap.of(snap)
        self._candidates.target = drawn.joined
        if len(points):
            end = None if drawn.joined is None else drawn.joined.pick
            drawn.line.to(points, triangles, end, self._stops.kept(self._network))
        self._read_progress()
        self.message = drawn.line.message
        self.revision += 1
        return True

    def line_end(self) -> bool:
        """Keep the wires that follow the line, as soon as they are computed; one step for undo."""
        drawn = self.line_release()
        return self._refuse("no-line-drawn") if drawn is None else self.line_keep(drawn)

    def line_release(self) -> DrawnLine | None:
        """Release the line that is being drawn, to keep it with `line_keep`. Return None if no line is drawn."""
        drawn, self._line = self._line, None
        self.revision += drawn is not None
        return drawn

    def line_keep(self, drawn: DrawnLine) -> bool:
        """Keep the wires that follow a line, as soon as they are computed; one step for undo."""
        drawn.line.finish()
        self._read_progress()
        self.revision += 1
        if self._queue or not drawn.line.poll():
            self._queue.append(Queued("line", drawn.end or drawn.begin, drawn))
            return True
        return self._keep_line(drawn)

    def line_cancel(self) -> bool:
        """Forget the line that is being drawn."""
        if self._line is None:
            return False
        self._line = None
        self._aim_again()
        self.revision += 1
        return True

    def _keep_line(self, drawn: DrawnLine) -> bool:
        """Go on to the network with the wires of a line."""
        wires = drawn.line.wires
        if not wires:
            self._aim_again()
            none = Message.of("no-wire-follows-line" if drawn.apart else "line-too-short")
            return self._refuse(drawn.line.message or none)
        told = drawn.line.message
        drawn_as = tuple(self._as_drawn(wire) for wire in wires)
        if not self._change(drawn.kept_in(self._network, drawn_as, self._points, self._stops)):
            return False
        self.message = self.message or told or self._engines.warning(self.options.along)
        return True

    def wires_along(self, seams: NDArray[np.int32]) -> Iterator[Wire]:
        """Yield wires that run along the mesh's edges as seams do, as few as there can be; keeps none of them.

        Parameters
        ----------
        seams
            (k, 2) edges, each once.

        Raises
        ------
        ValueError
            Where one is not part of the surface.
        """
        live = self._engines.get("EDGES").fork()
        for chain in seam_chains(seams):
            yield from waiting(live, wires_along(live, chain, self._points, self._engines.strengths["EDGES"]))

    # What leads the wires that are drawn from here on; kept wires stay as they are

    def follow(self, options: Options) -> bool:
        """Draw wires by other settings from here on; kept wires stay as they are.

        Returns
        -------
        bool
            False where the live wire's seed is no part of the surface the other way: then the chain ends.
        """
        before, self.options = self.options, options
        if options == before:
            return True
        self.revision += 1
        done = options.along == before.along or self._switched()
        if options.straight != before.straight:
            self._candidates.reset()
            self._aim_again()
        if options.computes != before.computes:
            self._compute_anew()
        if options.clear != before.clear:
            self.message = NOTHING
        if options.mirror != self._network.mirror:
            self._set(replace(self._network, mirror=options.mirror))
        return done

    def _switched(self) -> bool:
        """Let the live wire run the other way; where it cannot begin there, end the chain."""
        self._calm()
        self._candidates.reset()
        for offers in (self._edge_loops, self._cuts):
            offers.wanted = False
            offers.clear()
        seed, why = self._network.seed, NOTHING
        if seed is not None and not self._sow(seed):
            why = self.message
            self._set(replace(self._network, seed=None))
        self._aim_again()
        self.message = why or self.message
        return not why

    def _compute_anew(self) -> None:
        """Let the live wires be those of the metric that is set; while a seed is moved, its wires stay as they are."""
        options = self.options
        if self._drag is not None:
            return
        if options.metric != self._engines.metric:
            self._candidates.reset()
        self._engines.use(options.metric, options.strengths, options.clamp)
        self.message = NOTHING
        self._loops.clear()
        self._aim_again()
        self._show_offers()

    def draw_stroke(
        self,
        points: ArrayLike | None = None,
        faces: ArrayLike | None = None,
        *,
        vertices: ArrayLike | None = None,
        attracts: bool = True,
        acts_on: ActsOn | None = None,
        radius: float | None = None,
    ) -> bool:
        """Draw a stroke that live wires follow, or keep from; kept wires stay as they are.

        Parameters
        ----------
        points
            (n, 3) as a hand drew them on the surface, to be smoothed a little.
        faces
            (n,) the triangle of the surface that each lies in.
        vertices
            (n,) instead of both: the vertices that the stroke runs through.
        attracts
            Whether wires follow it; else crossing it is short, and following it long.
        acts_on
            Which of the wires it is meant for; None: the active one while a wire is live, else both.
        radius
            How far it reaches, in the points' units; None: ten rings of vertices.
        """
        try:
            if vertices is not None:
                stroke = through_vertices(vertices, self._points)
            elif points is None or faces is None or self._triangles is None:
                raise TypeError("neither points nor vertices")
            else:
                stroke = drawn(points, faces, self._points, self._triangles)
        except OffMeshError as error:
            return self._refuse(message_of(error))
        self._last_click = None
        self.drag_cancel()
        chosen = self._candidates.chosen
        if acts_on is None and self._network.seed is not None and not self._candidates.straight_active:
            # The wire that the stroke is for stays the active one, even where another is shorter now.
            chosen = self._candidates.active_index
            acts_on = FOLLOWS[chosen]
        stroke = Stroke(*stroke, attracts=attracts, acts_on=acts_on or "both", radius=radius)
        return self._with_strokes((*self._network.strokes, stroke), chosen)

    def erase(self, stroke: Stroke) -> bool:
        """Remove a stroke."""
        rest = tuple(own for own in self._network.strokes if own.id != stroke.id)
        if len(rest) == len(self._network.strokes):
            return self._refuse("stroke-is-gone")
        self._last_click = None
        self.drag_cancel()
        return self._with_strokes(rest, self._candidates.chosen)

    # Undo and redo

    def undo(self) -> bool:
        """Take back the last step: a wire, a loop, a seed, a move, whatever was done; first what still waits."""
        if self._queue:
            self._queue.pop()
            self._crest_taken = None
            self.revision += 1
            return True
        if self.drag_cancel() or self.line_cancel():
            return True
        if self._retraces.drop_last():
            self.revision += 1
            return True
        network = self._history.back(self._network)
        if network is None:
            return self._refuse("nothing-to-undo")
        self._restore(network)
        return True

    def redo(self) -> bool:
        """Bring back what undo took."""
        self.drag_cancel()
        network = self._history.forth(self._network)
        if network is None:
            return self._refuse("nothing-to-redo")
        self._restore(network)
        return True

    def adopt(self, network: Network, seams: ArrayLike) -> None:
        """Go on with what the mesh has now; what was done before is not for `undo` any more.

        Parameters
        ----------
        network
            Its wires and strokes. The mirror stays what it is; the live wire begins at the network's seed.
        seams
            (k, 2) the edges that are seams and no wires.
        """
        self._calm()
        self._stops.set_seams(seams)
        self._edge_loops.forget()
        self._retraces.clear()
        self._history.forget()
        # Wires of the first version do not know their images: they are what is a seam of them still.
        network = self._images.complete(network, seams)
        seed = network.seed
        if seed is not None and seed != self._network.seed and not self._sow(seed):
            seed = None
        self._set(replace(network, seed=seed, mirror=self._network.mirror))
        self._settle()

    @property
    def taken_cuts(self) -> tuple[TakenCut, ...]:
        """The closed cuts that are still unchanged, the last one at the end."""
        return self._cuts.taken(self._network)

    def recall_cuts(self, cuts: Iterable[TakenCut]) -> None:
        """Let closed cuts that were taken elsewhere be those that may be bent, as far as their wires are here."""
        self._cuts.recall(cuts)

    # Taking in what was computed

    def poll(self) -> bool:
        """Take in what the library has computed since, and do the clicks that waited for it.

        Returns
        -------
        bool
            Whether there is something new to be seen.
        """
        drag = self._drag
        still = self._candidates.final and self._offers_final and (drag is None or drag.final) and self._line is None
        if still and not self.computing and not self._queue and not self._retraces:
            return False
        before = (self.revision, round(self._progress, 2))
        self._read_progress()
        self._poll_retraces()
        if drag is not None and not drag.final:
            self.revision += drag.poll()
            self.message = drag.message
            if drag.final and drag.ending:
                self.drag_end()
        self._poll_line()
        while self._queue and self._poll_queue():
            pass
        if not self._queue and not self._candidates.final:
            self._aim_again()
        self._show_offers()
        self._show_extension()
        return before != (self.revision, round(self._progress, 2))

    def wait(self) -> None:
        """Wait until everything is computed and every waiting click is done."""
        while True:
            for live in self._working():
                try:
                    live.wait()
                except ValueError as error:  # what it is to compute cannot be computed
                    self._refuse(message_of(error))
            self.poll()
            if not self._queue and not self._retraces and not self.computing:
                return

    # Shown state

    @property
    def network(self) -> Network:
        """The kept wires, the seed and the mirror, as they are shown; to be stored with the mesh."""
        return self._network if self._drag is None else self._drag.network

    @property
    def kept(self) -> Network:
        """The same without what is being dragged."""
        return self._network

    @property
    def wires(self) -> tuple[Wire, ...]:
        """The kept wires, oldest first; those that follow a dragged seed as they run now."""
        return self.network.wires

    @property
    def seed(self) -> Pick | None:
        """Where the live wire begins; None between chains."""
        seed = self._network.seed
        return None if seed is None else seed.begins(self.options.along)

    @property
    def seed_place(self) -> Pick | None:
        """Where that seed is shown, as `seeds` has it."""
        seed = self._network.seed
        return None if seed is None else undirected(seed.shown(self.options.along))

    @property
    def target(self) -> Snap | None:
        """The pick under the cursor, or the pick of the oldest waiting click."""
        return self._candidates.target

    def flat_border(self, edge: Edge) -> set[Edge]:
        """Return the edges of the likeliest border of a flat region beside an edge, or nothing."""
        return self._edge_loops.flat_border(edge)

    @property
    def dragging(self) -> bool:
        """Whether a seed is being moved."""
        return self._drag is not None

    @property
    def drawing(self) -> bool:
        """Whether a line is being drawn."""
        return self._line is not None

    @property
    def closing_point(self) -> Pick | None:
        """Where the chain began, while a wire may lead back there."""
        return self._network.closing_point

    @property
    def computing(self) -> bool:
        """Whether the library still works on what is shown."""
        return self._wires_computing or not self._offers_final

    @property
    def _wires_computing(self) -> bool:
        """Whether it works on wires: a loop that waits behind a click must not keep that waiting."""
        drag = self._drag
        return self._progress < 1.0 or not self._candidates.final or (drag is not None and not drag.final)

    @property
    def waiting_clicks(self) -> int:
        """How many clicks and other deeds wait for their wires."""
        ending = self._drag is not None and self._drag.ending
        return len(self._queue) + len(self._retraces) + ending

    def feature_strength(self) -> NDArray[np.float64] | None:
        """Return how strong the feature is at each vertex; None while that is computed."""
        return self._engines.get(self.options.along).feature_strength()

    @property
    def strokes(self) -> tuple[Stroke, ...]:
        """The strokes that live wires follow or keep from, oldest first."""
        return self.network.strokes

    @property
    def metric_strokes(self) -> tuple[object, ...]:
        """Those strokes as the library has them."""
        return self._engines.strokes

    @property
    def symmetric_axes(self) -> tuple[int, ...]:
        """The axes over which the mesh is symmetric."""
        return self._symmetry.symmetric_axes

    def on_mirror(self) -> frozenset[int]:
        """Return the vertices on the planes over which wires are mirrored."""
        return self._symmetry.on_plane(self.options.mirror)

    def partners(self, axes: tuple[int, ...]) -> NDArray[np.int64]:
        """Return the vertex that each is mirrored to over all of the axes at once, (n,); -1: none."""
        return self._symmetry.partners(axes)

    @property
    def picture(self) -> Picture:
        """Everything that is to be seen now."""
        key = (self.revision, self.network_revision, self.message, self.work)
        if self._picture is None or self._picture[0] != key:
            self._picture = (key, self._painted())
        return self._picture[1]

    def _painted(self) -> Picture:
        live, drag, network = self._candidates, self._drag, self.network
        lines = [queued.line for queued in self._queue if queued.line is not None]
        lines += [] if self._line is None else [self._line]
        target = live.target
        hovered = target.pick if target is not None and target.to == "SEED" else None
        begins = [wire.start for drawn in lines for wire in drawn.line.wires]
        return Picture(
            self.options,
            self.revision,
            self.network_revision,
            shown_wires(
                self._kept_wires(),
                network,
                self.options,
                live,
                drag,
                lines,
                self._loops.wire,
                self._extension.wire,
                self.mirrored,
            ),
            shown_seeds(
                self.seeds(),
                self.seed_place,
                self.closing_point,
                hovered if drag is None else undirected(drag.place),
                begins,
            ),
            network.strokes,
            None if self._line is None else self._line.line.points,
            target,
            self.seed,
            Choice(live.number, 1 + len(live.others), live.straight_active, live.ring_active),
            Offered(self._loops.kinds, self._loops.choice, self._bends),
            self._intent,
            self.closing_point is not None,
            self.options.along == "SURFACE" and self._cuts.bendable(network) is not None,
            bool(self._queue or drag or self._line or self._retraces) or self._history.can_undo(self._network),
            self._history.can_redo,
            self.strength,
            self.work,
            self.message,
        )

    def _kept_wires(self) -> tuple[ShownWire, ...]:
        network = self.network
        if self._shown_kept is None or self._shown_kept[0] is not network:
            self._shown_kept = (network, kept_wires(network, self.moved))
        return self._shown_kept[1]

    @property
    def moved(self) -> tuple[Wire, ...]:
        """The wires that follow a dragged seed, as they run now."""
        return () if self._drag is None else self._drag.moved

    @property
    def work(self) -> Work:
        """The running computation for the picture."""
        return Work(self.computing, self._progress, self.waiting_clicks)

    @property
    def strength(self) -> float:
        """How strongly the wires that are shown are drawn to features: the metric's largest anisotropy."""
        return self._engines.strengths[self.options.along]

    @property
    def _bends(self) -> bool:
        """Whether what a click would take is the closed cut taken last, bent."""
        return self._cuts.bends and self._cuts.wanted

    @property
    def _intent(self) -> Intent:
        live, seed = self._candidates, self._network.seed
        if self._drag is not None:
            return Intent.MOVE
        if self._line is not None:
            return Intent.DRAW
        if self._extension.wire is not None:
            return Intent.RUN
        if self._loops.wire is not None:
            return Intent.LOOP
        if live.target is None or (self.options.along == "SURFACE" and isinstance(live.target.pick, tuple)):
            return Intent.NOTHING
        if seed is None:
            return {"SEED": Intent.CONTINUE, "WIRE": Intent.BRANCH}.get(live.target.to, Intent.SEED)
        if live.active_final:
            return self._ending(live.target) or Intent.KEEP
        waits = self.computing and not seed.at(live.target.pick, self.options.along)
        return Intent.WAIT if waits else Intent.NOTHING

    def seeds(self) -> list[Pick]:
        """Return every seed of the network, each once, in the order they were placed."""
        seed = self.network.seed
        ends = self.network.seeds()
        if seed is not None:
            ends.append(seed.shown(self.options.along))
        return list({undirected(pick): None for pick in ends})

    def edges_to_mark(self) -> list[Edge]:
        """Return the edges that the wires make seams, each once, sorted, smaller vertex first."""
        return self._images.net_effect(self.network)[0]

    def edges_to_clear(self) -> list[Edge]:
        """Return the edges that the wires make cease to be seams, each once, sorted, smaller vertex first."""
        return self._images.net_effect(self.network)[1]

    def mirrored(self, wire: Wire, curves: bool = False) -> list[Wire]:
        """Return the images that a wire has, or would have if it were kept now; see `Symmetry.images`."""
        return self._images.of(wire, self.network, curves)

    @property
    def _loops(self) -> Offers:
        """The loops that a click offers, along edges or across the surface."""
        return self._edge_loops if self.options.along == "EDGES" else self._cuts

    @property
    def _into_faces(self) -> bool:
        """Whether wires across the surface that are kept from here on are to be cut into the faces."""
        return self.options.marking and self.options.finish == "CUT"

    @property
    def _offers_final(self) -> bool:
        return self._edge_loops.final and self._cuts.final

    # From one network to the next

    def _refuse(self, why: str | Message, **values: object) -> bool:
        """Say why something is not done, with a message or its code and values."""
        self.message = Message.of(why, **values) if isinstance(why, str) else why
        self.revision += 1
        return False

    def _set(self, network: Network) -> None:
        """Go on to a new network, without a step for undo."""
        before, self._network = self._network, network
        if before.strokes != network.strokes:
            self._engines.follow(network.strokes)
            self._read_progress()
        self.revision += 1
        self.network_revision += before.wires != network.wires or before.mirror != network.mirror

    def _change(self, network: Network) -> bool:
        """Go on to a new network, with a step for undo."""
        seed = network.seed
        if seed is not None and seed != self._network.seed and not self._sow(seed):
            return False
        self._history.step(self._network)
        lasting = network.lasting()
        self._set(self._images.complete(lasting))
        self._settle()
        gone = Message.of("wire-went") if lasting is not network else NOTHING
        self.message = self._images.warning(self._network) or gone or self.message
        return True

    def _with_strokes(self, strokes: tuple[Stroke, ...], chosen: int | None) -> bool:
        self._change(replace(self._network, strokes=strokes))
        self._candidates.chosen = chosen
        return True

    def _restore(self, network: Network) -> None:
        """Go back or on to a network that there was."""
        if network.seed is not None and network.seed != self._network.seed:
            self._sow(network.seed)
        network = replace(network, mirror=self.options.mirror)
        back = [stroke.acts_on for stroke in network.strokes if stroke not in self._network.strokes]
        self._set(network)
        self._last_click, self._crest_taken = None, None
        self._settle()
        if network.seed is not None and back and back[-1] != "both":
            # As when it was drawn: the wire that a stroke is for is the active one.
            self._candidates.chosen = FOLLOWS.index(back[-1])

    def _settle(self) -> None:
        """Let the parts follow a new network."""
        self._candidates.chosen = None
        self._loops.clear()
        self._extension.clear()
        self.message = NOTHING
        self._aim_again()

    def _calm(self) -> None:
        """Let go of all that is under way but the live wire."""
        self._queue.clear()
        self._last_click = None
        self.drag_cancel()
        self.line_cancel()
        self.stop_preview()

    # The live wire

    def _sow(self, seed: Seed) -> bool:
        """Start the wires of a seed; on refusal the wires are those of the seed before."""
        before = self._network.seed
        try:
            self._candidates.sow(seed, self.options.along)
        except ValueError as error:
            if before is not None and before != seed:
                self._sow(before)
            return self._refuse(message_of(error))
        finally:
            self._read_progress()
        return True

    def _aim(self, target: Snap | None, again: bool = False) -> None:
        """Find the wires to a target; `again`: also where it is the same as before."""
        live = self._candidates
        if live.is_aimed_at(target, self.options.straight) and not again and live.final and self._offers_final:
            return
        before = (live.shown, self.message)
        self._read_progress()
        # A seed that is dragged has no live wire.
        network = self._network if self._drag is None else replace(self._network, seed=None)
        self.message = live.aim(target, network, self.options)
        # Asking again while nothing is ready shows nothing new, and must not cost a redraw each time.
        self.revision += before != (live.shown, self.message)
        self._show_extension()

    def _aim_again(self) -> None:
        """Find the wires to the target once more: they may be others now."""
        self._aim(self.target, again=True)

    def _keep(self, target: Snap) -> bool:
        """Keep the active wire, which leads to a target."""
        live = self._candidates
        wire = live.active
        seed = self._network.seed
        if wire is None:
            if seed is not None and seed.at(target.pick, self.options.along):
                return self._refuse("ends-where-it-begins")
            return self._refuse(self.message or Message.of("no-wire-reaches", pick=target.pick))
        ending = self._ending(target)
        known = {edge for own in self.wires for edge in own.edges()}
        # Of what is cut the snapped edges say nothing.
        if ending is Intent.CLOSE and known.issuperset(wire.edges()) and not isinstance(wire.end, FacePoint):
            return self._refuse("way-back-along-chain")
        wire = replace(self._as_drawn(wire), alternatives=live.others if live.final else ())
        if not wire.leaves_trace:
            return self._refuse("wire-too-short")
        network = self._network.joined(target, self._points).with_drawn(wire, target.pick, ending is not None)
        for joint in reversed(live.ring.joints if live.ring_active else ()):
            network = network.with_seed_in(wire, joint, self._points) or network
        if not self._change(network):
            return False
        self.message = self.message or self._engines.warning(self.options.along)
        self._last_click = (undirected(target.pick), self._history.steps)
        return True

    def _as_drawn(self, wire: Wire, like: Wire | None = None) -> Wire:
        """Return a new wire as one that is kept now: what it does to seams, its images, its metric's strength, its finish.

        `like`: the kept wire that it comes in place of, and does the same as.
        """
        if like is not None:
            return replace(wire, marks=like.marks, mirror=like.mirror, strength=self.strength, finish=like.finish)
        return replace(
            wire,
            marks=self.options.marking,
            mirror=self._network.mirror,
            strength=self.strength,
            finish=self.options.finish if wire.along == "SURFACE" and self.options.marking else "SNAP",
        )

    def _ending(self, target: Snap) -> Intent | None:
        """Return how a wire to a target ends the chain; None: it does not."""
        if self._network.closes(target):
            return Intent.CLOSE
        return Intent.JOIN if target.ends_chains else None

    # Offers, extension, other ways

    def _find_offers(self, pick: Pick, kept: Wire | None = None) -> tuple[Wire, ...]:
        """Return what a click on an edge may take, first what one has `kept`; nothing, too, while it is computed."""
        self._read_progress()
        try:
            # Offers at an edge are found along edges, even if wires run across the surface.
            offers = self._edge_loops if isinstance(pick, tuple) else self._cuts
            self._cuts.into_faces = self._into_faces
            return self._with_crest(pick, offers.find(pick, self._network, kept), kept)
        except ValueError as error:
            self.message = message_of(error)
            return ()

    def _with_crest(self, pick: Pick, offers: tuple[Wire, ...], kept: Wire | None) -> tuple[Wire, ...]:
        """Return what is offered with the ridge or valley at a pick: first where these are seen, else last."""
        if self._cuts.bends and not isinstance(pick, tuple):
            return offers
        # A click must not take the first known loop while others are still computed.
        ready = offers or (self._edge_loops if isinstance(pick, tuple) else self._cuts).final or self._crests_first
        crest = self._crests.offer(pick) if self._crests is not None and kept is None and ready else None
        if crest is None or undirected(pick) == self._crest_taken:
            return offers
        return (crest, *offers) if self._crests_first else (*offers, crest)

    def _show_offers(self) -> None:
        """Show what a click on the edge under the cursor may take, as soon as it is asked for and computed."""
        before = self.message
        if not any(queued.kind in {"loop", "bend", "offer"} for queued in self._queue):
            # Of both ways: an offer for a wire along edges may have been asked for across the surface, and given up.
            self._edge_loops.stop_waiting()
            self._cuts.stop_waiting()
        loops = self._loops
        if loops.wanted and self.target is not None and not loops.takes(self.target.pick):
            # A click may have moved the target since. Nothing would ever be found for it.
            self.revision += bool(loops.offers)
            loops.wanted = False
            loops.clear()
        if loops.unfinished and self.target is not None:
            self.revision += loops.show(self.target.pick, self._find_offers(self.target.pick))
        none = bool(loops.NONE) and loops.missing and loops.final and not self._cuts.bends
        if none != self._told_none and (not none or not self.message):
            self._told_none = none
            if none or self.message == self._cuts.NONE:
                self.message = loops.NONE if none else NOTHING
        self.revision += before != self.message

    def _retrace_offer(self, own: Wire, steps: int = 1) -> bool:
        """Let a wire that a click on an edge took be what that offers next, or some steps on."""
        assert own.through is not None
        if not own.offers:
            offers = self._find_offers(own.through, own)[1:]
            if not self._edge_loops.final:
                return self._postpone("offer", Snap(own.through, "WIRE", own))
            if not offers:
                return self._refuse(self.message or Message.of("nothing-else-through-edge"))
            own = replace(own, offers=offers)
        return self._change(self._network.with_wire(own).with_next_offer(own, steps))

    def _find_extension(self) -> Wire | None:
        """Return the live wire with its way on; None where there is no way, or no direction yet."""
        self._read_progress()
        try:
            return self._extension.find(self._network, self._candidates.active, self.options.marking)
        except ValueError as error:
            self.message = message_of(error)
            return None

    def _show_extension(self) -> None:
        """Show the live wire with its way on, while that is asked for."""
        if self._extension.wanted:
            self.revision += self._extension.show(self._find_extension())

    def _poll_line(self) -> None:
        """Let the wires of the line that is being drawn be those that are computed by now."""
        if self._line is None:
            return
        line = self._line.line
        before = line.wires
        line.poll()
        self.message = line.message or self.message
        self.revision += before is not line.wires

    def _poll_retraces(self) -> None:
        """Let the kept wires whose other ways are computed take them."""
        for wire, courses in self._retraces.poll():
            own = self._network.find(wire)
            if isinstance(courses, ValueError):
                self._refuse(message_of(courses))
            elif own is not None:  # else it was dropped in the meantime
                self._take_way(own, courses.others(own))

    def _take_way(self, own: Wire, others: tuple[Wire, ...]) -> bool:
        try:
            network = retraced(self._network, own, others)
        except ValueError as error:
            return self._refuse(message_of(error))
        return self._change(network)

    # What waits until it is computed

    def _postpone(self, kind: Waiting, snap: Snap) -> bool:
        """Do it when its wire is computed."""
        self._queue.append(Queued(kind, snap))
        self.revision += 1
        return True

    def _take_back_click(self, edge: Pick) -> None:
        """Undo the last click where that was on an edge, and forget it."""
        last = self._queue[-1] if self._queue else None
        if last is not None and last.kind == "click" and undirected(last.snap.pick) == undirected(edge):
            self._queue.pop()
        elif self._last_click == (undirected(edge), self._history.steps):
            self._restore(self._history.forget_step(self._network))
        self._last_click = None

    def _poll_queue(self) -> bool:
        """Do the oldest waiting click if its wire is there; returns whether it was done."""
        head = self._queue[0]
        if head.line is not None:
            return self._poll_waiting_line(head.line)
        self._aim(head.snap, again=True)
        if head.kind in {"loop", "bend", "offer"}:
            self._cuts.bend(head.kind == "bend")
            waits = not (self._find_offers(head.snap.pick) and self._offers_final) and self.computing
        else:
            waits = not self._candidates.decided and self._wires_computing
        if waits:
            return False
        del self._queue[0]
        rest, self._queue = self._queue, []
        if head.kind == "run":
            self.run_to_end()
        elif head.kind == "loop":
            self.loop(head.snap)
        elif head.kind == "bend":
            self.bend(head.snap)
        elif head.kind == "offer" and head.snap.wire is not None:
            self.retrace(head.snap.wire)
        else:
            self.click(head.snap)
        self._queue += rest
        return True

    def _poll_waiting_line(self, drawn: DrawnLine) -> bool:
        """Keep the wires of a line that has ended, if they are computed; returns whether they were."""
        if not drawn.line.poll():
            return False
        del self._queue[0]
        rest, self._queue = self._queue, []
        self._keep_line(drawn)
        self._queue += rest
        return True

    def _working(self) -> list[LiveWire]:
        """Return the live wires that compute something for what is shown or waits."""
        drag = [] if self._drag is None else self._drag.lives()
        # Offers at an edge are found along edges, even if wires run across the surface.
        offers = [self._engines.get("EDGES")] if any(queued.kind == "offer" for queued in self._queue) else []
        asks = [queued.snap.pick for queued in self._queue if queued.kind in {"loop", "bend"}]
        waits = any(self._cuts.takes(pick) for pick in asks)
        cuts = [self._engines.cuts()] if self._cuts.wanted or waits else []
        lines = [queued.line for queued in self._queue if queued.line is not None]
        lines += [] if self._line is None else [self._line]
        drawn = [live for one in lines for live in one.line.lives()]
        ring = self._candidates.ring.lives
        return [self._engines.get(self.options.along), *ring, *offers, *cuts, *self._retraces.lives(), *drag, *drawn]

    def _read_progress(self) -> None:
        """Look how much is computed; before wires are asked for: what is not final after the work is done stays so."""
        self._progress = min(live.progress() for live in self._working())
