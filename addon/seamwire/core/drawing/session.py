# SPDX-License-Identifier: GPL-3.0-or-later
"""A drawing session: gestures go in, networks with undo and redo come out.

It knows neither Blender nor the GPU. The tool in the viewport and the headless operators drive the same session.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ..base.messages import NOTHING, Message, Refused, message_of
from ..network.network import Network, Snap
from ..network.picks import undirected
from ..network.strokes import OffMeshError
from ..network.wires import FOLLOWS
from ..solver.solver import MOST_WAITS
from .bend import BendGesture
from .extension import Extension
from .gesture import Gesture, UnderWay, Waiting
from .line import LineGesture
from .loop import LoopGesture, NextOffer
from .painter import Painter
from .picture import Work
from .retrace import Retrace, retraced
from .seed_drag import SeedDrag
from .stroke import StrokeGesture
from .wire import WireGesture

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ...terms.options import Options
    from ..fields.crests import Crests
    from ..network.network import Seed
    from ..network.picks import Edge, Pick
    from ..network.strokes import Stroke
    from ..network.wires import Wire
    from ..solver.solver import LiveWire
    from .drawing import Drawing
    from .picture import Picture


class Session:
    """A drawing session on one mesh.

    Parameters
    ----------
    drawing
        The mesh, the settings, and the engines that compute wires.

    Attributes
    ----------
    live
        The live wire, which knows the pick under the cursor.
    loops, extension
        The loops and the way to the end that a click would keep.
    under_way
        The gestures that are held or wait.
    message
        The reason why something was not done, or a warning.
    failure
        The reason why a gesture that waited was not done, until the next gesture.
    revision
        Grows with every change of the picture.

    Notes
    -----
    A method that changes something returns whether it was done; if not, `message` says why. A gesture that is not computed
    yet counts as done: it waits, and `poll` commits it.
    """

    def __init__(self, drawing: Drawing) -> None:
        self.drawing = drawing
        self.live = WireGesture(drawing)
        self.loops = LoopGesture(drawing, self.live)
        self.extension = Extension(drawing, self.live)
        self._bend = BendGesture(drawing, self.loops)
        self.under_way = UnderWay()
        self.message: Message = NOTHING
        self.failure: Message = NOTHING
        self.revision = 0
        self._last_click: tuple[Pick, int] | None = None
        self._painter = Painter(drawing, self.live, self.loops, self.extension, self.under_way)
        # The live wires are made now, because what they compute first takes longest.
        self._read_progress()

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
        if self.under_way.queue:
            return
        target = None if snap is None else Snap.of(snap)
        self._aim(target)
        bend = bend and self.options.along == "SURFACE"
        if bend != self.loops.cuts.bends and self.message:
            self.message = NOTHING
            self.revision += 1
        self.revision += self.loops.hover(target, loop, bend)
        self._show_offers()

    def click(self, snap: Snap | Pick) -> bool:
        """Place a seed; if a wire is live, keep it and go on from there.

        On the chain's first seed this closes the chain. On another seed, a wire or a seam, the chain joins it and ends.
        While the way to the end or a loop is shown, that is kept.
        """
        target = Snap.of(snap)
        if not self.under_way.queue:
            if self.extension.wanted:
                return self.run_to_end()
            if self.loops.takes(target):
                return self.bend(target) if self.loops.bends else self.loop(target)
        self._leave_seed()
        self._last_click = None
        if self.under_way.queue:
            return self._wait_for(self.live, target)
        if self.drawing.network.seed is None:
            return self.start(target)
        seen = self.live.candidates.active_final and target == self.target
        self._aim(target)
        self.live.seen = seen
        return self._commit(self.live, target)

    def start(self, snap: Snap | Pick) -> bool:
        """Begin a new chain, which ends the one before. Gestures that wait are done first."""
        target = Snap.of(snap)
        self._finish_gestures()
        self._calm()
        try:
            done = self._change(self.live.begun(target))
        except Refused as error:
            return self._refuse(error.message)
        if done:
            self._remember_click(target)
        return done

    def loop(self, snap: Snap | Pick) -> bool:
        """Keep the offer that is shown for a pick, otherwise the first one.

        A click on the same edge just before is taken back, because a double click is a click first.
        """
        target, loops = Snap.of(snap), self.loops
        why = loops.aim(target)
        if why:
            return self._refuse(why)
        self._leave_seed()
        if self.options.along == "EDGES":
            if loops.is_crest_taken(target.pick):
                return True  # the first press of a double click took the ridge
            self._take_back_click(target.pick)
        return self._commit(loops, target)

    def bend(self, snap: Snap | Pick) -> bool:
        """Bend the last closed cut to a point."""
        return self.do(self._bend, snap)

    def do(self, gesture: Gesture, snap: Snap | Pick | None = None) -> bool:
        """Aim a gesture at a pick, and commit it as soon as it is computed; one step for undo."""
        target = None if snap is None else Snap.of(snap)
        why = gesture.aim(target)
        if why:
            return self._refuse(why)
        self._leave_seed()
        self._last_click = None
        return self._commit(gesture, target)

    def next_candidate(self) -> bool:
        """Show the next candidate, or the next offer if offers are shown."""
        offers, candidates = self.loops.offers, self.live.candidates
        why = (offers if offers.wanted else candidates).advance()
        if why:
            return self._refuse(why)
        self.message = NOTHING
        if not offers.wanted:
            self._show_extension()
        self.revision += 1
        return True

    def close(self, seen_along: tuple[float, float, float] | None = None) -> bool:
        """Lead the live wire back to the chain's first seed, and keep it. `seen_along` is that of `Snap`."""
        if self.drawing.network.closing_point is None:
            self._finish_gestures()
        first = self.drawing.network.closing_point
        if first is None:
            return self._refuse("no-chain-to-close")
        self.extension.wanted = False
        return self.click(Snap(first, "SEED", seen_along=seen_along))

    def run_to_end(self, preview: bool = False) -> bool:
        """Let the live wire run straight on until it meets a seam, a wire, the boundary, the mirror or itself.

        Parameters
        ----------
        preview
            Whether to show it first, wherever the cursor goes. A click keeps it, `stop_preview` hides it.
        """
        extension, target = self.extension, self.target
        why = extension.aim(target)
        if why:
            return self._refuse(why)
        self._leave_seed()
        if preview:
            extension.wanted = True
            self._show_extension()
            found = extension.wire is not None or self.computing
            return found or self._refuse(self.message or Message.of("no-way-on"))
        if self.under_way.queue:
            if target is None:
                return self._refuse("no-way-on")
            extension.wanted = False
        else:
            self.live.seen = True
        return self._commit(extension, target)

    def stop_preview(self) -> bool:
        """Hide the way to the end. Return whether it was shown."""
        if not self.extension.wanted:
            return False
        self.extension.cancel()
        self.revision += 1
        return True

    def end_chain(self, wait: bool = True) -> None:
        """Let go of the live wire, or of a held seed. The kept wires stay.

        Parameters
        ----------
        wait
            Whether gestures that wait are done first. Otherwise they are forgotten.
        """
        if not wait:
            self.under_way.retraces.clear()
        elif self.waiting_clicks:
            self.wait(clicks_only=True)
        self._calm()
        if self.drawing.network.seed is None:
            return
        # This is not a step for undo. Undoing the last wire afterwards makes the chain live again.
        self._set(replace(self.drawing.network, seed=None))
        self.live.candidates.chosen = None
        self._aim_again()

    def take_failure(self) -> Message:
        """Return why a gesture that waited was not done, once."""
        failure, self.failure = self.failure, NOTHING
        return failure

    # Gestures on kept wires

    def retrace(self, wire: Wire) -> bool:
        """Let a kept wire take its next way: that of another metric, or the next offer of the click that took it."""
        self._finish_gestures()
        self._calm()
        own = self.drawing.network.find(wire)
        if own is None:
            return self._refuse("wire-is-gone")
        if own.through is not None:
            return self._commit(NextOffer(self.drawing, self.loops, own), Snap(own.through, "WIRE", own))
        if own.closed:
            return self._refuse("loop-has-one-way")
        try:
            if own.alternatives:
                return self._change(retraced(self.drawing.network, own, own.alternatives))
            self.under_way.retraces.append(Retrace(self.drawing, own))
        except ValueError as error:
            return self._refuse(message_of(error))
        self._read_progress()
        self._poll_retraces()
        return not self.message

    def drop(self, wire: Wire) -> bool:
        """Remove a kept wire."""
        self._finish_gestures()
        self._calm()
        own = self.drawing.network.find(wire)
        if own is None:
            return self._refuse("wire-is-gone")
        return self._change(self.drawing.network.without(own))

    def drag(self, snap: Snap | Pick) -> bool:
        """Take hold of a seed, or of a wire (``Snap.to == "WIRE"``), which gets a seed there. `drag_to` moves it."""
        self._finish_gestures()
        self._calm()
        return self._hold(SeedDrag, Snap.of(snap))

    def drag_to(self, snap: Snap | Pick | None) -> bool:
        """Move the dragged seed; its wires follow as soon as they are computed. None leaves it in place."""
        drag = self.under_way.holds(SeedDrag)
        if drag is None:
            return self._refuse("no-seed-moves")
        if snap is None or drag.ending:
            return False
        before = (drag.target, drag.network, self.message)
        self.live.candidates.target = Snap.of(snap)
        self.message = drag.aim(Snap.of(snap))
        self._read_progress()
        self.revision += before != (drag.target, drag.network, self.message)
        return drag.solved and not drag.message

    def drag_end(self) -> bool:
        """Leave the dragged seed where it is, as soon as its wires are computed; one step for undo."""
        drag = self.under_way.holds(SeedDrag)
        if drag is None:
            return self._refuse("no-seed-moves")
        try:
            done = drag.commit()
        except Refused as error:
            self.let_go(SeedDrag)
            return self._refuse(error.message)
        if done is drag:
            drag.ending = True
            return True
        self.let_go(SeedDrag, again=done is None)
        return not isinstance(done, Network) or self._change(done)

    def _hold(self, kind: type[SeedDrag] | type[LineGesture], *given: object) -> bool:
        """Take hold of a new gesture, in place of candidates and offers."""
        try:
            self.under_way.held = kind(self.drawing, *given)
        except ValueError as error:
            return self._refuse(message_of(error))
        self._last_click = None
        self.live.seedless = kind is SeedDrag
        self._read_progress()
        self.live.cancel()
        self.loops.offers.clear()
        self.extension.cancel()
        self.message = NOTHING
        self.revision += 1
        return True

    def let_go(self, kind: type[Gesture] = Gesture, again: bool = True) -> bool:
        """Cancel the held gesture if it is of a kind: a dragged seed goes back, a line vanishes. Return whether it was held.

        Parameters
        ----------
        kind
            A class of gestures.
        again
            Whether to find the live wire again.
        """
        if self.under_way.holds(kind) is None:
            return False
        self.under_way.held = None
        self.live.seedless = False
        self.revision += 1
        # While a seed was dragged, its wires kept their metric.
        if self.drawing.engines.computes != self.options.computes:
            self._compute_anew()
        if again:
            self._aim_again()
        return True

    # Lines and strokes

    def goes_on_from(self, snap: Snap | Pick) -> bool:
        """Whether a line that begins at a pick continues the chain, rather than begin a new one."""
        seed, target = self.drawing.network.seed, Snap.of(snap)
        on_seed = seed is not None and target.to == "SEED" and seed.at(target.pick, self.options.along)
        return on_seed and not self.under_way.queue

    def line_begin(self, snap: Snap | Pick) -> bool:
        """Begin a line over the surface, which `line_to` draws. At the live wire's seed it continues the chain."""
        begin = Snap.of(snap)
        self._leave_seed()
        self.stop_preview()
        return self._hold(LineGesture, begin, self.goes_on_from(begin))

    def line_to(self, points: NDArray[np.float64], triangles: NDArray[np.int32], snap: Snap | Pick | None) -> bool:
        """Draw the line on: all its points (k, 3), the triangle of each (k,), and the pick under the cursor."""
        line = self.under_way.holds(LineGesture)
        if line is None:
            return self._refuse("no-line-drawn")
        line.draw(points, triangles, None if snap is None else Snap.of(snap))
        self.live.candidates.target = line.joined
        self._read_progress()
        self.message = line.message
        self.revision += 1
        return True

    def line_release(self) -> LineGesture | None:
        """Take the line out of the session, to keep it with `line_keep`. Return None if no line is drawn."""
        line = self.under_way.holds(LineGesture)
        if line is not None:
            self.under_way.held = None
            self.revision += 1
        return line

    def line_keep(self, line: LineGesture) -> bool:
        """Keep the wires that follow a released line, as soon as they are computed; one step for undo."""
        line.finish()
        self._read_progress()
        self.revision += 1
        target = line.end or line.begin
        return self._commit(line, target)

    def draw_stroke(self, points: ArrayLike | None = None, faces: ArrayLike | None = None, **how: object) -> bool:
        """Draw a stroke that live wires follow or avoid. The parameters are those of `StrokeGesture`."""
        try:
            stroke = StrokeGesture(self.drawing, self.live, points, faces, **how)
        except OffMeshError as error:
            return self._refuse(message_of(error))
        return self.do(stroke)

    def erase(self, stroke: Stroke) -> bool:
        """Remove a stroke."""
        self._finish_gestures()
        network = self.drawing.network
        rest = tuple(own for own in network.strokes if own.id != stroke.id)
        if len(rest) == len(network.strokes):
            return self._refuse("stroke-is-gone")
        self._last_click = None
        return self._change(replace(network, strokes=rest), self.live.candidates.chosen)

    # Settings

    def follow(self, options: Options) -> bool:
        """Draw wires with other settings from here on. Return False if that ends the chain, because the seed is not on the surface.

        Gestures that wait are done first, because they were meant with the settings before.
        """
        before = self.drawing.options
        if options == before:
            return True
        if options.draws != before.draws and self.waiting_clicks:
            self.wait(clicks_only=True)
        self.drawing.options = options
        self.revision += 1
        done = options.along == before.along or self._switch()
        if options.straight != before.straight:
            self.live.candidates.reset()
            self._aim_again()
        if options.computes != before.computes:
            self._compute_anew()
        if options.clear != before.clear:
            self.message = NOTHING
        if options.mirror != self.drawing.network.mirror:
            self._set(replace(self.drawing.network, mirror=options.mirror))
        return done

    def _switch(self) -> bool:
        """Let the live wire run the other way; if it cannot begin there, end the chain."""
        self._calm()
        self.live.candidates.reset()
        self.loops.cancel()
        seed, why = self.drawing.network.seed, NOTHING
        if seed is not None and not self._sow(seed):
            why = self.message
            self._set(replace(self.drawing.network, seed=None))
        self._aim_again()
        self.message = why or self.message
        return not why

    def _compute_anew(self) -> None:
        """Compute live wires with the current settings. While a seed is dragged, its wires keep their metric."""
        options, engines = self.drawing.options, self.drawing.engines
        if self.dragging:
            return
        if options.metric != engines.metric:
            self.live.candidates.reset()
        engines.use(options.metric, options.strengths, options.clamp)
        self.message = NOTHING
        self.loops.offers.clear()
        self._aim_again()
        self._show_offers()

    def use_crests(self, crests: Crests | None, first: bool) -> None:
        """Offer wires along the mesh's ridges and valleys: as the `first` of what a click offers, or as the last."""
        if self.loops.use_crests(crests, first) and self.target is not None:
            self._show_offers()

    # Networks

    def _set(self, network: Network) -> None:
        """Go on to a network, without a step for undo."""
        strokes = self.drawing.network.strokes
        self.drawing.set(network)
        if network.strokes != strokes:
            self._read_progress()
        self.revision += 1

    def _change(self, network: Network, chosen: int | None = None) -> bool:
        """Go on to a network, with a step for undo. `chosen`: the candidate that stays the active one."""
        drawing = self.drawing
        seed = network.seed
        if seed is not None and seed != drawing.network.seed and not self._sow(seed):
            return False
        strokes = drawing.network.strokes
        warning = drawing.step(network)
        if drawing.network.strokes != strokes:
            self._read_progress()
        self.revision += 1
        self._settle()
        self.message = warning or self.message or self.failure
        self.live.candidates.chosen = chosen
        return True

    def _restore(self, network: Network) -> bool:
        """Go back or forth to a network of the history."""
        now = self.drawing.network
        if network.seed is not None and network.seed != now.seed:
            self._sow(network.seed)
        back = [stroke.acts_on for stroke in network.strokes if stroke not in now.strokes]
        self._set(replace(network, mirror=self.options.mirror))
        self._last_click = None
        self.loops.forget_crest()
        self._settle()
        if network.seed is not None and back and back[-1] != "both":
            # As when it was drawn: the wire that a stroke is for is the active one.
            self.live.candidates.chosen = FOLLOWS.index(back[-1])
        return True

    def _settle(self) -> None:
        """Let the gestures follow a new network."""
        self.live.candidates.chosen = None
        self.loops.offers.clear()
        self.extension.cancel()
        self.message = NOTHING
        self._aim_again()

    def adopt(self, network: Network, seams: ArrayLike) -> None:
        """Go on with a network that the mesh has now. `undo` does not lead back behind it.

        Parameters
        ----------
        network
            The wires and strokes. The mirror stays; the live wire begins at the network's seed.
        seams
            (k, 2) the edges that are seams but no wires.
        """
        drawing = self.drawing
        self._calm()
        drawing.stops.set_seams(seams)
        self.under_way.retraces.clear()
        drawing.history.forget()
        # Wires that were just cut do not know their images. Images are the edges that are seams.
        network = drawing.images.complete(network, seams)
        seed = network.seed
        if seed is not None and seed != drawing.network.seed and not self._sow(seed):
            seed = None
        self._set(replace(network, seed=seed, mirror=drawing.network.mirror))
        self.loops.edges.forget()
        self._settle()

    # Undo and redo

    def undo(self) -> bool:
        """Take back what is held, else the last gesture that still waits, else the last step."""
        under_way = self.under_way
        drag = under_way.holds(SeedDrag)
        if (drag is None or not drag.ending) and self.let_go():
            return True
        if under_way.queue:
            under_way.queue.pop()
            self.loops.forget_crest()
            self.revision += 1
            return True
        if self.let_go(SeedDrag):
            return True
        if under_way.retraces:
            under_way.retraces.pop()
            self.revision += 1
            return True
        network = self.drawing.history.back(self.drawing.network)
        return self._refuse("nothing-to-undo") if network is None else self._restore(network)

    def redo(self) -> bool:
        """Bring back the step that undo took. Gestures that wait are done first, and after a new step there is nothing to redo."""
        self._finish_gestures()
        network = self.drawing.history.forth(self.drawing.network)
        return self._refuse("nothing-to-redo") if network is None else self._restore(network)

    def _remember_click(self, target: Snap) -> None:
        """Let the last step be taken back by `_take_back_click`."""
        self._last_click = (undirected(target.pick), self.drawing.history.steps)

    def _take_back_click(self, edge: Pick) -> None:
        """Undo the last click if it was on an edge, and forget it."""
        queue = self.under_way.queue
        last = queue[-1] if queue else None
        clicked = last is not None and last.gesture is self.live
        if clicked and undirected(last.target.pick) == undirected(edge):
            queue.pop()
        elif not queue and self._last_click == (undirected(edge), self.drawing.history.steps):
            self._restore(self.drawing.history.forget_step(self.drawing.network))
        self._last_click = None

    # The way of a gesture to a network

    def _commit(self, gesture: Gesture, target: Snap | None) -> bool:
        """Commit a gesture, or let it wait: for those that wait already, or until it is computed. Return whether it was not refused."""
        if self.under_way.queue:
            return self._wait_for(gesture, target)
        self.failure = NOTHING
        done = self._attempt(gesture, target)
        if not isinstance(done, Gesture):
            return done
        return self._wait_for(done, target) if done is gesture else self._commit(done, target)

    def _wait_for(self, gesture: Gesture, target: Snap | None) -> bool:
        """Commit a gesture after those that wait already."""
        self.under_way.queue.append(Waiting(gesture, target))
        self.revision += 1
        return True

    def _attempt(self, gesture: Gesture, target: Snap | None) -> bool | Gesture:
        """Commit a gesture. Return whether that was done, or the gesture that waits."""
        try:
            done = gesture.commit()
        except ValueError as error:
            self._aim_again()
            return self._refuse(message_of(error))
        if isinstance(done, Gesture):
            return done
        if done is None:
            return True
        if not self._change(done, gesture.chosen):
            return False
        self.message = self.message or gesture.take_warning()
        if gesture is self.live and target is not None:
            self._remember_click(target)
        return True

    def _refuse(self, why: str | Message, **values: object) -> bool:
        """Tell why something is not done: a message, or its code and values."""
        self.message = Message.of(why, **values) if isinstance(why, str) else why
        self.revision += 1
        return False

    def _finish_gestures(self) -> None:
        """Do what waits, because what comes now begins with the wires that it makes. Only `undo` and `end_chain` forget it."""
        self.failure = NOTHING
        if self.under_way.queue:
            self.wait(clicks_only=True)
        self._leave_seed()

    def _leave_seed(self) -> None:
        """Wait for the wires of a seed that was released. A seed that is held still goes back."""
        drag = self.under_way.holds(SeedDrag)
        if drag is not None and drag.ending:
            self.wait(clicks_only=True)
        self.let_go(SeedDrag)

    def _calm(self) -> None:
        """Drop everything under way, except the live wire."""
        self.loops.edges.stop_search()
        self.under_way.queue.clear()
        self._last_click = None
        self.let_go()
        self.stop_preview()

    # The wires and offers at the cursor

    def _sow(self, seed: Seed) -> bool:
        """Start the wires of a seed. If it is refused, the wires are those of the seed before."""
        before = self.drawing.network.seed
        try:
            self.live.candidates.sow(seed, self.options.along)
        except ValueError as error:
            if before is not None and before != seed:
                self._sow(before)
            return self._refuse(message_of(error))
        finally:
            self._read_progress()
        return True

    def _aim(self, target: Snap | None, again: bool = False) -> None:
        """Find the wires to a target; `again`: also if it is the same as before."""
        candidates = self.live.candidates
        same = candidates.is_aimed_at(target, self.options.straight) and candidates.final
        if same and not again and self.loops.final:
            return
        before = (candidates.shown, self.message)
        self._read_progress()
        self.message = self.live.aim(target)
        # Asking again while nothing is ready shows nothing new, and must not cost a redraw each time.
        self.revision += before != (candidates.shown, self.message)
        self._show_extension()

    def _aim_again(self) -> None:
        """Find the wires to the target once more: they may be others now."""
        self._aim(self.target, again=True)

    def _show_offers(self) -> None:
        """Show the offers at the cursor, as soon as they are computed."""
        if self.loops.offers.unfinished:
            self._read_progress()
        before = self.message
        is_awaited = any(one.gesture.needs_offers for one in self.under_way.queue)
        changed, self.message = self.loops.show(before, is_awaited)
        self.revision += changed or self.message != before

    def _show_extension(self) -> None:
        """Show the live wire with its way to the end, while that is asked for."""
        if self.extension.wanted:
            self.revision += self.extension.poll()
            self.message = self.extension.message or self.message

    # Computed results

    def lives(self) -> list[LiveWire]:
        """Return the live wires that compute something for what is shown or waits."""
        under_way = self.under_way.gestures
        # A loop that waits is computed even if no offers are shown.
        cuts = self.options.along == "SURFACE" and any(one.gesture is self.loops for one in self.under_way.queue)
        return [
            *(live for gesture in (self.live, self.loops, *under_way) for live in gesture.lives()),
            *([self.drawing.engines.cuts()] if cuts else []),
        ]

    def _read_progress(self) -> None:
        """Read how much is computed. Wires that are not final after all work is done stay so, so this comes before asking."""
        self.drawing.progress = min(live.progress() for live in self.lives())

    def poll(self) -> bool:
        """Take in what the library has computed, and commit the gestures that waited for it.

        Returns
        -------
        bool
            Whether the picture has changed.
        """
        drag, line, queue = self.under_way.holds(SeedDrag), self.under_way.holds(LineGesture), self.under_way.queue
        if line is None and not self.computing and not queue and not self.under_way.retraces:
            return False
        before = (self.revision, round(self.drawing.progress, 2))
        self._read_progress()
        self._poll_retraces()
        if drag is not None and not drag.final:
            self.revision += drag.poll()
            self.message = drag.message
            if drag.final and drag.ending and not self.drag_end():
                self.failure = self.message
        if line is not None:
            self.revision += line.poll()
            self.message = line.message or self.message
        while queue and self._poll_queue():
            pass
        if not queue and not self.live.candidates.final:
            self._aim_again()
        self._show_offers()
        self._show_extension()
        return before != (self.revision, round(self.drawing.progress, 2))

    def _poll_queue(self) -> bool:
        """Commit the gesture that has waited longest, if it is computed. Return whether it was."""
        queue = self.under_way.queue
        head = queue[0]
        if isinstance(head.gesture, LineGesture):
            self.revision += head.gesture.poll()
        elif head.target is not None:
            self._aim(head.target, again=True)
            if head.gesture is not self.live:
                head.gesture.aim(head.target)
        done = self._attempt(head.gesture, head.target)
        if done is head.gesture:
            return False
        self.failure = self.failure if done else self.message
        queue.pop(0)
        if isinstance(done, Gesture):
            queue.insert(0, Waiting(done, head.target))
        return True

    def _poll_retraces(self) -> None:
        """Let the kept wires whose other ways are computed take them."""
        for retrace in list(self.under_way.retraces):
            done = self._attempt(retrace, None)
            if done is not retrace:
                self.failure = self.failure if done else self.message
                self.under_way.retraces.remove(retrace)

    def wait(self, clicks_only: bool = False) -> None:
        """Wait until everything is computed and every waiting gesture is committed.

        If the library has done all its work and a gesture still waits, the gesture is dropped, and `message` says so.

        Parameters
        ----------
        clicks_only
            Whether to stop as soon as every waiting gesture is committed.
        """
        queue, retraces = self.under_way.queue, self.under_way.retraces
        rounds, before = 0, None
        while rounds < MOST_WAITS:
            for live in self.lives():
                try:
                    live.wait()
                except ValueError as error:  # what it is to compute cannot be computed
                    self._refuse(message_of(error))
            self.loops.edges.wait()
            self.poll()
            if not self.waiting_clicks and (clicks_only or not self.computing):
                return
            now = (*map(id, queue), *map(id, retraces), self.drawing.progress)
            rounds, before = (rounds + 1 if now == before else 0), now
        if self.waiting_clicks:
            queue.clear()
            retraces.clear()
            self.let_go(SeedDrag)
            self._refuse("no-result")
            self.failure = self.message

    # State

    @property
    def options(self) -> Options:
        """The settings."""
        return self.drawing.options

    @property
    def network(self) -> Network:
        """The network as it is shown: the kept wires, those that follow a dragged seed, the live seed, and the mirror.

        The one of `drawing` is without a drag that has not ended.
        """
        drag = self.under_way.holds(SeedDrag)
        return self.drawing.network if drag is None else drag.network

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
        return self.live.candidates.target

    @property
    def dragging(self) -> bool:
        """Whether a seed is being moved."""
        return self.under_way.holds(SeedDrag) is not None

    @property
    def moved(self) -> tuple[Wire, ...]:
        """The wires that follow a seed that is held, as they run now."""
        drag = self.under_way.holds(SeedDrag)
        return () if drag is None or drag.ending else drag.moved

    @property
    def computing(self) -> bool:
        """Whether the library still works on the picture."""
        drag = self.under_way.holds(SeedDrag)
        return self.live.computing or not self.loops.final or (drag is not None and not drag.final)

    @property
    def waiting_clicks(self) -> int:
        """The number of committed gestures that wait for their wires."""
        drag = self.under_way.holds(SeedDrag)
        return len(self.under_way.queue) + len(self.under_way.retraces) + (drag is not None and drag.ending)

    @property
    def will_be_live(self) -> bool:
        """Whether a chain is live as soon as everything that waits is done."""
        live = self.drawing.network.seed is not None
        for one in self.under_way.queue:
            live = one.gesture.leaves_live(live, one.target)
        return live

    @property
    def picture(self) -> Picture:
        """Everything that is to be seen now."""
        work = Work(self.computing, self.drawing.progress, self.waiting_clicks)
        return self._painter.picture(self.revision, self.message, work)

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
