# SPDX-License-Identifier: GPL-3.0-or-later
"""A drawing session: gestures go in, networks with undo and redo come out.

It knows neither Blender nor the GPU. The tool in the viewport and the headless operators drive the same session.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ..base.messages import NOTHING, Message, Refused, message_of
from ..network.network import Snap
from ..network.strokes import OffMeshError
from .candidates import only_vertices
from .flow import Flow
from .line import LineGesture
from .loop import NextOffer
from .painter import Painter
from .retrace import Retrace, retraced
from .seed_drag import SeedDrag
from .stroke import StrokeGesture

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ..fields.crests import Crests
    from ..network.network import Network
    from ..network.picks import Edge, Pick
    from ..network.strokes import Stroke
    from ..network.wires import Wire
    from ..offers.closed_cuts import TakenCut
    from .drawing import Drawing
    from .gesture import Gesture
    from .options import Options
    from .picture import Picture, Work


class Session:
    """A drawing session on one mesh.

    Parameters
    ----------
    drawing
        The mesh, the settings, and the engines that compute wires.

    Notes
    -----
    A method that changes something returns whether it was done; if not, `message` says why. A gesture that is not computed
    yet counts as done: it waits, and `poll` commits it.
    """

    def __init__(self, drawing: Drawing) -> None:
        self.drawing = drawing
        self._flow = Flow(drawing)
        self._gestures = self._flow.gestures
        self._painter = Painter(drawing, self._gestures)
        # The live wires are made now, because what they compute first takes longest.
        self._gestures.read_progress()

    # Gestures at the cursor

    def hover(self, snap: Snap | Pick | None, loop: bool = False, bend: bool = False) -> None:
        """Move the free end of the live wire.

        Parameters
        ----------
        snap
            The pick under the cursor, or None. A pick alone stands for one on the plain mesh.
        loop
            Whether to show the loop through it instead: along edges through an edge, across the surface through a point.
        bend
            Whether to show the last closed cut, bent to it; across the surface only.
        """
        if self._gestures.queue:
            return
        target = None if snap is None else Snap.of(snap)
        self._flow.aim(target)
        bend = bend and self.options.along == "SURFACE"
        if bend != self._gestures.loop.cuts.bends and self._flow.message:
            self._flow.message = NOTHING
            self._flow.revision += 1
        self._flow.revision += self._gestures.loop.hover(target, loop, bend)
        self._flow.show_offers()

    def click(self, snap: Snap | Pick) -> bool:
        """Place a seed; if a wire is live, keep it and go on from there.

        On the chain's first seed this closes the chain. On another seed, a wire or a seam, the chain joins it and ends.
        While the way to the end or a loop is shown, that is kept.
        """
        target, gestures = Snap.of(snap), self._gestures
        if not gestures.queue:
            if gestures.extension.wanted:
                return self.run_to_end()
            if gestures.loop.takes(target):
                return self.bend(target) if gestures.loop.bends else self.loop(target)
        self._flow.cancel_drag()
        self._flow.forget_click()
        if gestures.queue:
            return self._flow.wait_for(gestures.wire, target)
        if self.drawing.network.seed is None:
            return self.start(target)
        seen = gestures.wire.candidates.active_final and target == self.target
        self._flow.aim(target)
        gestures.wire.seen = seen
        return self._flow.commit(gestures.wire, target)

    def start(self, snap: Snap | Pick) -> bool:
        """Begin a new chain, which ends the one before."""
        target = Snap.of(snap)
        self._flow.calm()
        try:
            network = self._gestures.wire.begun(target)
        except Refused as error:
            return self._flow.refuse(error.message)
        if not self._flow.change(network):
            return False
        self._flow.remember_click(target)
        return True

    def loop(self, snap: Snap | Pick) -> bool:
        """Keep the offer that is shown for a pick, otherwise the first one.

        A click on the same edge just before is taken back, because a double click is a click first.
        """
        target, loop = Snap.of(snap), self._gestures.loop
        why = loop.aim(target)
        if why:
            return self._flow.refuse(why)
        self._flow.cancel_drag()
        if self.options.along == "EDGES":
            if loop.is_crest_taken(target.pick):
                return True  # the first press of a double click took the ridge
            self._flow.take_back_click(target.pick)
        return self._flow.commit(loop, target)

    def bend(self, snap: Snap | Pick) -> bool:
        """Bend the last closed cut to a point."""
        return self.do(self._gestures.bend, snap)

    def do(self, gesture: Gesture, snap: Snap | Pick | None = None) -> bool:
        """Aim a gesture at a pick, and commit it as soon as it is computed; one step for undo."""
        target = None if snap is None else Snap.of(snap)
        why = gesture.aim(target)
        if why:
            return self._flow.refuse(why)
        self._flow.cancel_drag()
        self._flow.forget_click()
        return self._flow.commit(gesture, target)

    def next_candidate(self) -> bool:
        """Show the next candidate, or the next offer if offers are shown."""
        offers, candidates = self._gestures.loop.offers, self._gestures.wire.candidates
        why = (offers if offers.wanted else candidates).advance()
        if why:
            return self._flow.refuse(why)
        self._flow.message = NOTHING
        if not offers.wanted:
            self._flow.show_extension()
        self._flow.revision += 1
        return True

    def close(self, seen_along: tuple[float, float, float] | None = None) -> bool:
        """Lead the live wire back to the chain's first seed, and keep it. `seen_along` is that of `Snap`."""
        first = self.drawing.network.closing_point
        if first is None:
            return self._flow.refuse("no-chain-to-close")
        self._gestures.extension.wanted = False
        return self.click(Snap(first, "SEED", seen_along=seen_along))

    def run_to_end(self, preview: bool = False) -> bool:
        """Let the live wire run straight on until it meets a seam, a wire, the boundary, the mirror or itself.

        Parameters
        ----------
        preview
            Whether to show it first, wherever the cursor goes. A click keeps it, `stop_preview` hides it.
        """
        if self.drawing.network.seed is None:
            return self._flow.refuse("nothing-runs-on")
        if self.options.along == "SURFACE":
            return self._flow.refuse("no-run-across")
        self._flow.cancel_drag()
        extension = self._gestures.extension
        if preview:
            extension.wanted = True
            self._flow.show_extension()
            found = extension.wire is not None or self.computing
            return found or self._flow.refuse(self._flow.message or Message.of("no-way-on"))
        target = self.target
        if not self._gestures.queue:
            self._gestures.wire.seen = True
            return self._flow.commit(extension, target)
        if target is None:
            return self._flow.refuse("no-way-on")
        extension.wanted = False
        return self._flow.wait_for(extension, target)

    def stop_preview(self) -> bool:
        """Hide the way to the end. Return whether it was shown."""
        return self._flow.stop_preview()

    def stop_search(self) -> None:
        """Let the search for parts end, which works for the offers of loops. It begins again when they are asked for."""
        self._flow.stop_search()

    def end_chain(self) -> None:
        """Let go of the live wire, or of a dragged seed. The kept wires stay."""
        self._flow.calm()
        if self.drawing.network.seed is None:
            return
        # This is not a step for undo. Undoing the last wire afterwards makes the chain live again.
        self._flow.set(replace(self.drawing.network, seed=None))
        self._gestures.wire.candidates.chosen = None
        self._flow.aim_again()

    # Gestures on kept wires

    def retrace(self, wire: Wire) -> bool:
        """Let a kept wire take its next way: that of another metric, or the next offer of the click that took it."""
        self._flow.calm()
        own = self.drawing.network.find(wire)
        if own is None:
            return self._flow.refuse("wire-is-gone")
        if own.through is not None:
            return self._flow.commit(NextOffer(self.drawing, self._gestures.loop, own), Snap(own.through, "WIRE", own))
        if own.closed:
            return self._flow.refuse("loop-has-one-way")
        try:
            if own.alternatives:
                return self._flow.change(retraced(self.drawing.network, own, own.alternatives))
            self._gestures.retraces.append(Retrace(self.drawing, own))
        except ValueError as error:
            return self._flow.refuse(message_of(error))
        self._gestures.read_progress()
        self._flow.poll_retraces()
        return not self._flow.message

    def drop(self, wire: Wire) -> bool:
        """Remove a kept wire."""
        self._flow.calm()
        own = self.drawing.network.find(wire)
        if own is None:
            return self._flow.refuse("wire-is-gone")
        return self._flow.change(self.drawing.network.without(own))

    def drag(self, snap: Snap | Pick) -> bool:
        """Take hold of a seed, or of a wire (``Snap.to == "WIRE"``), which gets a seed there. `drag_to` moves it."""
        self._flow.calm()
        try:
            self._gestures.drag = SeedDrag(self.drawing, Snap.of(snap))
        except ValueError as error:
            return self._flow.refuse(message_of(error))
        self._gestures.wire.seedless = True
        self._gestures.read_progress()
        self._flow.clear_shown()
        self._flow.revision += 1
        return True

    def drag_to(self, snap: Snap | Pick | None) -> bool:
        """Move the dragged seed; its wires follow as soon as they are computed. None leaves it in place."""
        drag = self._gestures.drag
        if drag is None:
            return self._flow.refuse("no-seed-moves")
        if snap is None or drag.ending:
            return False
        before = (drag.target, drag.network, self._flow.message)
        self._gestures.wire.candidates.target = Snap.of(snap)
        self._flow.message = drag.aim(Snap.of(snap))
        self._gestures.read_progress()
        self._flow.revision += before != (drag.target, drag.network, self._flow.message)
        return drag.solved and not drag.message

    def drag_end(self) -> bool:
        """Leave the dragged seed where it is, as soon as its wires are computed; one step for undo."""
        drag = self._gestures.drag
        return self._flow.refuse("no-seed-moves") if drag is None else self._flow.end_drag(drag)

    def drag_cancel(self) -> bool:
        """Let the dragged seed go back to where it was."""
        return self._flow.cancel_drag()

    # Lines and strokes

    def goes_on_from(self, snap: Snap | Pick) -> bool:
        """Whether a line that begins at a pick continues the chain, rather than begin a new one."""
        seed, target = self.drawing.network.seed, Snap.of(snap)
        on_seed = seed is not None and target.to == "SEED" and seed.at(target.pick, self.options.along)
        return on_seed and not self._gestures.queue

    def line_begin(self, snap: Snap | Pick) -> bool:
        """Begin a line over the surface, which `line_to` draws. At the live wire's seed it continues the chain."""
        begin = Snap.of(snap)
        if self.options.along == "SURFACE" and isinstance(begin.pick, tuple):
            return self._flow.refuse(only_vertices(begin.pick))
        self._flow.cancel_drag()
        self.stop_preview()
        if self.options.along == "SURFACE" and self.drawing.triangles is None:
            return self._flow.refuse("no-triangles")
        self._gestures.line = LineGesture(self.drawing, begin, self.goes_on_from(begin))
        self._flow.forget_click()
        self._flow.clear_shown()
        self._flow.revision += 1
        return True

    def line_to(self, points: NDArray[np.float64], triangles: NDArray[np.int32], snap: Snap | Pick | None) -> bool:
        """Draw the line on: all its points (k, 3), the triangle of each (k,), and the pick under the cursor."""
        line = self._gestures.line
        if line is None:
            return self._flow.refuse("no-line-drawn")
        line.draw(points, triangles, None if snap is None else Snap.of(snap))
        self._gestures.wire.candidates.target = line.joined
        self._gestures.read_progress()
        self._flow.message = line.message
        self._flow.revision += 1
        return True

    def line_release(self) -> LineGesture | None:
        """Take the line out of the session, to keep it with `line_keep`. Return None if no line is drawn."""
        line, self._gestures.line = self._gestures.line, None
        self._flow.revision += line is not None
        return line

    def line_keep(self, line: LineGesture) -> bool:
        """Keep the wires that follow a released line, as soon as they are computed; one step for undo."""
        line.finish()
        self._gestures.read_progress()
        self._flow.revision += 1
        target = line.end or line.begin
        return self._flow.wait_for(line, target) if self._gestures.queue else self._flow.commit(line, target)

    def line_cancel(self) -> bool:
        """Forget the line that is being drawn."""
        return self._flow.cancel_line()

    def draw_stroke(self, points: ArrayLike | None = None, faces: ArrayLike | None = None, **how: object) -> bool:
        """Draw a stroke that live wires follow or avoid. The parameters are those of `StrokeGesture`."""
        try:
            stroke = StrokeGesture(self.drawing, self._gestures.wire, points, faces, **how)
        except OffMeshError as error:
            return self._flow.refuse(message_of(error))
        return self.do(stroke)

    def erase(self, stroke: Stroke) -> bool:
        """Remove a stroke."""
        network = self.drawing.network
        rest = tuple(own for own in network.strokes if own.id != stroke.id)
        if len(rest) == len(network.strokes):
            return self._flow.refuse("stroke-is-gone")
        self._flow.forget_click()
        self._flow.cancel_drag()
        return self._flow.change(replace(self.drawing.network, strokes=rest), self._gestures.wire.candidates.chosen)

    # Settings and views

    def follow(self, options: Options) -> bool:
        """Draw wires with other settings from here on. Return False if that ends the chain, because the seed is not on the surface."""
        return self._flow.follow(options)

    def use_crests(self, crests: Crests | None, first: bool) -> None:
        """Offer wires along the mesh's ridges and valleys: as the `first` of what a click offers, or as the last."""
        if self._gestures.loop.use_crests(crests, first) and self.target is not None:
            self._flow.show_offers()

    # Undo and redo

    def undo(self) -> bool:
        """Take back what is held, else the last gesture that still waits, else the last step."""
        return self._flow.undo()

    def redo(self) -> bool:
        """Bring back the step that undo took."""
        return self._flow.redo()

    def adopt(self, network: Network, seams: ArrayLike) -> None:
        """Go on with a network that the mesh has now. `undo` does not lead back behind it.

        Parameters
        ----------
        network
            The wires and strokes. The mirror stays; the live wire begins at the network's seed.
        seams
            (k, 2) the edges that are seams but no wires.
        """
        self._flow.adopt(network, seams)

    @property
    def taken_cuts(self) -> tuple[TakenCut, ...]:
        """The closed cuts that are still unchanged, the last one at the end."""
        return self._gestures.loop.cuts.taken(self.drawing.network)

    def recall_cuts(self, cuts: Iterable[TakenCut]) -> None:
        """Let closed cuts of earlier sessions be bent, as far as their wires are here."""
        self._gestures.loop.cuts.recall(cuts)

    # Computed results

    def poll(self) -> bool:
        """Take in what the library has computed, and commit the gestures that waited for it.

        Returns
        -------
        bool
            Whether the picture has changed.
        """
        return self._flow.poll()

    def wait(self) -> None:
        """Wait until everything is computed and every waiting gesture is committed."""
        self._flow.wait()

    # State

    @property
    def message(self) -> Message:
        """The reason why something was not done, or a warning."""
        return self._flow.message

    @property
    def revision(self) -> int:
        """Grows with every change of the picture."""
        return self._flow.revision

    @property
    def options(self) -> Options:
        """The settings."""
        return self.drawing.options

    @property
    def network(self) -> Network:
        """The network as it is shown: the kept wires, those that follow a dragged seed, the live seed, and the mirror."""
        drag = self._gestures.drag
        return self.drawing.network if drag is None else drag.network

    @property
    def kept(self) -> Network:
        """The network without a drag that has not ended."""
        return self.drawing.network

    @property
    def wires(self) -> tuple[Wire, ...]:
        """The wires of the network, oldest first."""
        return self.network.wires

    @property
    def strokes(self) -> tuple[Stroke, ...]:
        """The strokes that live wires follow or avoid, oldest first."""
        return self.network.strokes

    @property
    def network_revision(self) -> int:
        """Grows with every change of the kept wires."""
        return self.drawing.network_revision

    @property
    def seed(self) -> Pick | None:
        """The beginning of the live wire; None between chains."""
        seed = self.drawing.network.seed
        return None if seed is None else seed.begins(self.options.along)

    @property
    def target(self) -> Snap | None:
        """The pick under the cursor, or that of the oldest waiting gesture."""
        return self._gestures.wire.candidates.target

    @property
    def dragging(self) -> bool:
        """Whether a seed is being moved."""
        return self._gestures.drag is not None

    @property
    def draws_line(self) -> bool:
        """Whether a line is being drawn."""
        return self._gestures.line is not None

    @property
    def moved(self) -> tuple[Wire, ...]:
        """The wires that follow a dragged seed, as they run now."""
        return () if self._gestures.drag is None else self._gestures.drag.moved

    @property
    def computing(self) -> bool:
        """Whether the library still works on the picture."""
        return self._gestures.computing

    @property
    def waiting_clicks(self) -> int:
        """The number of committed gestures that wait for their wires."""
        return self._gestures.waiting

    @property
    def wants_crests(self) -> bool:
        """Whether offers are shown, which ridges and valleys belong to."""
        return self._gestures.loop.offers.wanted

    @property
    def picture(self) -> Picture:
        """Everything that is to be seen now."""
        return self._painter.picture(self._flow.revision, self._flow.message)

    @property
    def work(self) -> Work:
        """The running computation."""
        return self._painter.work

    def edges_to_mark(self) -> list[Edge]:
        """Return the edges that the wires make seams, each once, sorted, smaller vertex first."""
        return self.drawing.images.net_effect(self.network)[0]

    def edges_to_clear(self) -> list[Edge]:
        """Return the edges that the wires clear of seams, each once, sorted, smaller vertex first."""
        return self.drawing.images.net_effect(self.network)[1]

    def seeds(self) -> list[Pick]:
        """Return every seed of the network, each once, in the order they were placed."""
        return self.drawing.seeds(self.network)

    def mirrored(self, wire: Wire, curves: bool = False) -> list[Wire]:
        """Return the images that a wire has, or would have if it were kept now; see `Symmetry.images`."""
        return self.drawing.images.of(wire, self.network, curves)

    def part_border(self, edge: Edge) -> set[Edge]:
        """Return the edges of the likeliest border of a part beside an edge, or nothing."""
        return self._gestures.loop.edges.part_border(edge)
