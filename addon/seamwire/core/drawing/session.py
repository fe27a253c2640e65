# SPDX-License-Identifier: GPL-3.0-or-later
"""A drawing session: gestures go in, networks with undo and redo come out.

It knows neither Blender nor the GPU. The tool in the viewport and the headless operators drive the same session.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ..base.refused import Refused
from ..network.network import Snap
from ..network.picks import undirected
from ..network.strokes import OffMeshError
from ..network.wires import FOLLOWS
from ..solver.solver import MOST_WAITS
from .bend import BendGesture
from .cursor import Cursor, Waiting
from .gesture import Gesture
from .line import LineGesture
from .loop import NextOffer
from .painter import Painter
from .retrace import Retrace, retraced
from .seed_drag import SeedDrag
from .stroke import StrokeGesture

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ...terms.options import Options
    from ..network.network import Network
    from ..network.picks import Edge, Pick
    from ..network.strokes import Stroke
    from ..network.wires import Wire
    from .drawing import Drawing
    from .picture import Picture


class Session:
    """A drawing session on one mesh. `cursor` has the gestures that are not done, and `drawing` everything else.

    A method that changes something returns whether it was done; if not, the message of the drawing says why. A gesture that is not computed
    yet counts as done: it waits, and `poll` commits it. Gestures are committed in their order.
    """

    def __init__(self, drawing: Drawing) -> None:
        self.drawing = drawing
        self.cursor = Cursor(drawing)
        self._painter = Painter(drawing, self.cursor)
        self._last_click: tuple[Pick, int] | None = None
        """The pick of the last step, if that was a click, and the number of steps then."""
        # The live wires are made now, because what they compute first takes longest.
        self.cursor.read_progress()

    # Gestures at the cursor

    def hover(self, snap: Snap | Pick | None, loop: bool = False, bend: bool = False) -> None:
        """Move the free end of the live wire to a pick, or to nothing. A pick alone stands for a snap on the plain mesh.

        Parameters
        ----------
        loop
            Whether to show the loop through it instead: along edges through an edge, across the surface through a point.
        bend
            Whether to show the last closed cut, bent to it; across the surface only.
        """
        if self.cursor.queue:
            return
        drawing, cursor, target = self.drawing, self.cursor, None if snap is None else Snap.of(snap)
        cursor.aim(target)
        bend = bend and self.options.along == "SURFACE"
        if bend != cursor.loops.cuts.bends and drawing.message:
            drawing.message = ""
            drawing.revision += 1
        drawing.revision += cursor.loops.hover(target, loop, bend)
        cursor.show_offers()

    def click(self, snap: Snap | Pick) -> bool:
        """Place a seed; if a wire is live, keep it and go on from there.

        On the chain's first seed this closes the chain. On another seed, a wire or a seam, the chain joins it and ends.
        While the way to the end or a loop is shown, that is kept.
        """
        target = Snap.of(snap)
        if not self.cursor.queue:
            if self.cursor.extension.wanted:
                return self.run_to_end()
            if self.cursor.loops.takes(target):
                return self.bend(target) if self.cursor.loops.bends else self.loop(target)
        self._leave_seed()
        self._last_click = None
        if not self.cursor.queue:
            if self.drawing.network.seed is None:
                return self.start(target)
            seen = self.cursor.live.active_final and target == self.cursor.target
            self.cursor.aim(target)
            self.cursor.live.seen = seen
        return self.commit(self.cursor.live, target)

    def start(self, snap: Snap | Pick) -> bool:
        """Begin a new chain, which ends the one before. Gestures that wait are done first."""
        target = Snap.of(snap)
        self._finish()
        try:
            done = self.step(self.cursor.live.begun(target))
        except Refused as error:
            return self.drawing.refuse(str(error))
        if done:
            self._remember_click(target)
        return done

    def loop(self, snap: Snap | Pick) -> bool:
        """Keep the offer that is shown for a pick, otherwise the first one.

        A click on the same edge just before is taken back, because a double click is a click first.
        """
        target, loops = Snap.of(snap), self.cursor.loops
        why = loops.aim(target)
        if why:
            return self.drawing.refuse(why)
        self._leave_seed()
        if self.options.along == "EDGES":
            if loops.is_crest_taken(target.pick):
                return True  # the first press of a double click took the ridge
            self._take_back_click(target.pick)
        return self.commit(loops, target)

    def bend(self, snap: Snap | Pick) -> bool:
        """Bend the last closed cut to a point."""
        return self.do(BendGesture(self.drawing, self.cursor.loops), snap)

    def do(self, gesture: Gesture, snap: Snap | Pick | None = None) -> bool:
        """Aim a gesture at a pick, and commit it as soon as it is computed; one step for undo."""
        target = None if snap is None else Snap.of(snap)
        why = gesture.aim(target)
        if why:
            return self.drawing.refuse(why)
        self._leave_seed()
        self._last_click = None
        return self.commit(gesture, target)

    def close(self, seen_along: tuple[float, float, float] | None = None) -> bool:
        """Lead the live wire back to the chain's first seed, and keep it. `seen_along` is that of `Snap`."""
        if self.drawing.network.closing_point is None:
            self._finish()
        first = self.drawing.network.closing_point
        if first is None:
            return self.drawing.refuse("No chain to close: draw a wire first")
        self.cursor.extension.wanted = False
        return self.click(Snap(first, "SEED", seen_along=seen_along))

    def run_to_end(self, preview: bool = False) -> bool:
        """Let the live wire run straight on until it meets a seam, a wire, the boundary, the mirror or itself.

        A `preview` only shows it, wherever the cursor goes. A click keeps it, and `Cursor.stop_preview` hides it.
        """
        extension, target = self.cursor.extension, self.cursor.target
        why = extension.aim(target)
        if why:
            return self.drawing.refuse(why)
        self._leave_seed()
        if preview:
            extension.wanted = True
            self.cursor.show_extension()
            found = extension.wire is not None or self.cursor.computing
            return found or self.drawing.refuse(self.drawing.message or "The wire cannot be extended from here")
        if self.cursor.queue:
            if target is None:
                return self.drawing.refuse("The wire cannot be extended from here")
            extension.wanted = False
        else:
            self.cursor.live.seen = True
        return self.commit(extension, target)

    def end_chain(self, wait: bool = True) -> None:
        """Let go of the live wire, or of a held seed. The kept wires stay. Gestures that wait are done first, or forgotten."""
        if not wait:
            self.cursor.retraces.clear()
        elif self.cursor.waiting:
            self.wait(until_committed=True)
        self.calm()
        if self.drawing.network.seed is None:
            return
        # This is not a step for undo. Undoing the last wire afterwards makes the chain live again.
        self.drawing.set(replace(self.drawing.network, seed=None))
        self.cursor.live.chosen = None
        self.cursor.aim_again()

    # Gestures on kept wires

    def retrace(self, wire: Wire) -> bool:
        """Let a kept wire take its next way: that of another metric, or the next offer of the click that took it."""
        self._finish()
        own = self.drawing.network.find(wire)
        if own is None:
            return self.drawing.refuse("This wire no longer exists")
        if own.through is not None:
            return self.commit(NextOffer(self.drawing, self.cursor.loops, own), Snap(own.through, "WIRE", own))
        if own.closed:
            return self.drawing.refuse("A loop has no other path")
        try:
            if own.alternatives:
                return self.step(retraced(self.drawing.network, own, own.alternatives))
            self.cursor.retraces.append(Retrace(self.drawing, own))
        except ValueError as error:
            return self.drawing.refuse(str(error))
        self.cursor.read_progress()
        self._poll_retraces()
        return not self.drawing.message

    def drop(self, wire: Wire) -> bool:
        """Remove a kept wire."""
        self._finish()
        own = self.drawing.network.find(wire)
        if own is None:
            return self.drawing.refuse("This wire no longer exists")
        return self.step(self.drawing.network.without(own))

    def drag(self, snap: Snap | Pick) -> bool:
        """Take hold of a seed, or of a wire (``Snap.to == "WIRE"``), which gets a seed there. `Cursor.drag_to` moves it."""
        self._finish()
        return self.cursor.hold(SeedDrag, Snap.of(snap))

    def drag_end(self) -> bool:
        """Leave the dragged seed where it is, as soon as its wires are computed; one step for undo."""
        drag = self.cursor.drag
        if drag is None:
            return self.drawing.refuse("No seed is being moved")
        try:
            done = drag.commit()
        except Refused as error:
            self.cursor.let_go(SeedDrag)
            return self.drawing.refuse(str(error))
        if done is drag:
            drag.ending = True
            return True
        self.cursor.let_go(SeedDrag, again=done is None)
        return done is None or self.step(done)

    # Lines and strokes

    def goes_on_from(self, snap: Snap | Pick) -> bool:
        """Whether a line that begins at a pick continues the chain, rather than begin a new one."""
        seed, target = self.drawing.network.seed, Snap.of(snap)
        on_seed = seed is not None and target.to == "SEED" and seed.at(target.pick, self.options.along)
        return on_seed and not self.cursor.queue

    def line_begin(self, snap: Snap | Pick) -> bool:
        """Begin a line over the surface, which `Cursor.line_to` draws. At the live wire's seed it continues the chain."""
        begin = Snap.of(snap)
        self._leave_seed()
        self._last_click = None
        self.cursor.stop_preview()
        return self.cursor.hold(LineGesture, begin, self.goes_on_from(begin))

    def line_keep(self, line: LineGesture) -> bool:
        """Keep the wires that follow a released line, as soon as they are computed; one step for undo."""
        line.line.finish()
        self.cursor.read_progress()
        self.drawing.revision += 1
        return self.commit(line, line.end or line.begin)

    def draw_stroke(self, points: ArrayLike | None = None, faces: ArrayLike | None = None, **how: object) -> bool:
        """Draw a stroke that live wires follow or avoid. The parameters are those of `StrokeGesture`."""
        try:
            stroke = StrokeGesture(self.drawing, self.cursor.live, points, faces, **how)
        except OffMeshError as error:
            return self.drawing.refuse(str(error))
        return self.do(stroke)

    def erase(self, stroke: Stroke) -> bool:
        """Remove a stroke."""
        self._finish()
        network = self.drawing.network
        rest = tuple(own for own in network.strokes if own.id != stroke.id)
        if len(rest) == len(network.strokes):
            return self.drawing.refuse("This stroke no longer exists")
        return self.step(replace(network, strokes=rest), self.cursor.live.chosen)

    # Commits

    def commit(self, gesture: Gesture, target: Snap | None) -> bool:
        """Commit a gesture, or let it wait: for those that wait already, or until it is computed. Return whether it was not refused."""
        if not self.cursor.queue:
            self.drawing.failure = ""
            done = self._attempt(gesture, target)
            if not isinstance(done, Gesture):
                return done
            if done is not gesture:
                return self.commit(done, target)
        self.cursor.queue.append(Waiting(gesture, target))
        self.drawing.revision += 1
        return True

    def _attempt(self, gesture: Gesture, target: Snap | None) -> bool | Gesture:
        """Commit a gesture. Return whether that was done, or the gesture that waits."""
        try:
            done = gesture.commit()
        except ValueError as error:
            self.cursor.aim_again()
            return self.drawing.refuse(str(error))
        if isinstance(done, Gesture):
            return done
        if done is None:
            return True
        if not self.step(done, gesture.keeps_active):
            return False
        self.drawing.warning = self.drawing.warning or gesture.take_warning()
        if gesture is self.cursor.live and target is not None:
            self._remember_click(target)
        return True

    def step(self, network: Network, chosen: int | None = None) -> bool:
        """Go on to a network, with a step for undo. `chosen`: the candidate that stays the active one."""
        drawing = self.drawing
        seed = network.seed
        if seed is not None and seed != drawing.network.seed and not self.cursor.sow(seed):
            return False
        drawing.history.step(drawing.network)
        lasting = network.lasting()
        drawing.set(drawing.images.complete(lasting))
        gone = "A wire was removed: no edge is left for its seam" if lasting is not network else ""
        drawing.warning = drawing.images.warning(drawing.network) or gone or drawing.failure
        self.cursor.settle()
        self.cursor.live.chosen = chosen
        return True

    # What waits

    def _finish(self) -> None:
        """Do what waits, because what comes now begins with the wires that it makes."""
        self.drawing.failure = ""
        if self.cursor.queue:
            self.wait(until_committed=True)
        self._leave_seed()
        self.calm()

    def _leave_seed(self) -> None:
        """Wait for the wires of a seed that was released. A seed that is still held goes back."""
        drag = self.cursor.drag
        if drag is not None and drag.ending:
            self.wait(until_committed=True)
        self.cursor.let_go(SeedDrag)

    def calm(self) -> None:
        """Drop everything under way, except the live wire and the wires that take another course."""
        self.cursor.loops.edges.stop_search()
        self.cursor.queue.clear()
        self._last_click = None
        self.cursor.let_go()
        self.cursor.stop_preview()

    def poll(self) -> bool:
        """Take in what the library has computed, commit the gestures that waited for it, and return whether the picture has changed."""
        drawing, cursor = self.drawing, self.cursor
        drag, line, queue = cursor.drag, cursor.holds(LineGesture), cursor.queue
        if line is None and not cursor.computing and not queue and not cursor.retraces:
            return False
        before = (drawing.revision, round(drawing.progress, 2))
        cursor.read_progress()
        self._poll_retraces()
        if drag is not None and not drag.final:
            drawing.revision += drag.poll()
            drawing.message = drag.message
            if drag.final and drag.ending:
                self._told(self.drag_end())
        if line is not None:
            drawing.revision += line.poll()
            drawing.message = line.line.message or drawing.message
        while queue and self._poll_queue():
            pass
        if not queue and not cursor.live.final:
            cursor.aim(cursor.target, again=True, is_read=True)
        cursor.show_offers(is_read=True)
        cursor.show_extension()
        return before != (drawing.revision, round(drawing.progress, 2))

    def _poll_queue(self) -> bool:
        """Commit the gesture that has waited longest, if it is computed. Return whether it was."""
        queue = self.cursor.queue
        head = queue[0]
        if isinstance(head.gesture, LineGesture):
            self.drawing.revision += head.gesture.poll()
        elif head.target is not None:
            self.cursor.aim(head.target, again=True, is_read=True)
            if head.gesture is not self.cursor.live:
                head.gesture.aim(head.target)
        done = self._attempt(head.gesture, head.target)
        if done is head.gesture:
            return False
        queue.pop(0)
        if isinstance(done, Gesture):
            queue.insert(0, Waiting(done, head.target))
        else:
            self._told(done)
        return True

    def _poll_retraces(self) -> None:
        """Let the kept wires whose other ways are computed take them."""
        for retrace in list(self.cursor.retraces):
            done = self._attempt(retrace, None)
            if done is not retrace:
                self.cursor.retraces.remove(retrace)
                self._told(bool(done))

    def _told(self, done: bool) -> None:
        """Remember why a gesture that waited was not done."""
        if not done:
            self.drawing.failure = self.drawing.message

    def wait(self, until_committed: bool = False) -> None:
        """Wait until everything is computed, or only until every waiting gesture is committed.

        If the library has done all its work and a gesture still waits, the gesture is dropped, and the message says so.
        """
        drawing, cursor = self.drawing, self.cursor
        rounds, before = 0, None
        while rounds < MOST_WAITS:
            for live in cursor.lives():
                try:
                    live.wait()
                except ValueError as error:  # what it is to compute cannot be computed
                    drawing.refuse(str(error))
            self.cursor.loops.edges.wait()
            self.poll()
            if not cursor.waiting and (until_committed or not cursor.computing):
                return
            now = (*map(id, cursor.queue), *map(id, cursor.retraces), drawing.progress)
            rounds, before = (rounds + 1 if now == before else 0), now
        if cursor.waiting:
            cursor.queue.clear()
            cursor.retraces.clear()
            self.cursor.let_go(SeedDrag)
            self._told(drawing.refuse("The computation ended without a result: this step was dropped"))

    # Settings

    def follow(self, options: Options) -> bool:
        """Draw wires with other settings from here on. Return False if that ends the chain, because the seed is not on the surface.

        Gestures that wait are done first, because they were meant with the settings before.
        """
        drawing, cursor, before = self.drawing, self.cursor, self.drawing.options
        if options == before:
            return True
        if options.draws != before.draws and cursor.waiting:
            self.wait(until_committed=True)
        if options.along != before.along:
            self.calm()
        drawing.options = options
        drawing.revision += 1
        done = options.along == before.along or self._switch()
        if options.straight != before.straight:
            cursor.live.reset()
            cursor.aim_again()
        if options.computes != before.computes:
            cursor.compute_anew()
        if options.clear != before.clear:
            drawing.message = ""
        if options.mirror != drawing.network.mirror:
            drawing.set(replace(drawing.network, mirror=options.mirror))
        return done

    def _switch(self) -> bool:
        """Let the live wire run the other way; if it cannot begin there, end the chain."""
        drawing, cursor = self.drawing, self.cursor
        cursor.live.reset()
        cursor.loops.cancel()
        seed, why = drawing.network.seed, ""
        if seed is not None and not cursor.sow(seed):
            why = drawing.message
            drawing.set(replace(drawing.network, seed=None))
        cursor.aim_again()
        drawing.message = why or drawing.message
        return not why

    # Undo and redo

    def undo(self) -> bool:
        """Take back what is held, else the last gesture that still waits, else the last step."""
        cursor, drawing = self.cursor, self.drawing
        drag = cursor.drag
        if (drag is None or not drag.ending) and cursor.let_go():
            return True
        if cursor.queue:
            cursor.queue.pop()
            cursor.loops.forget_crest()
            drawing.revision += 1
            return True
        if cursor.let_go(SeedDrag):
            return True
        if cursor.retraces:
            cursor.retraces.pop()
            drawing.revision += 1
            return True
        network = drawing.history.back(drawing.network)
        return drawing.refuse("Nothing to undo in this drawing") if network is None else self._restore(network)

    def redo(self) -> bool:
        """Bring back the step that undo took. Gestures that wait are done first, and after a new step there is nothing to redo."""
        self._finish()
        network = self.drawing.history.forth(self.drawing.network)
        return self.drawing.refuse("Nothing to redo in this drawing") if network is None else self._restore(network)

    def _restore(self, network: Network) -> bool:
        """Go back or forth to a network of the history."""
        now = self.drawing.network
        if network.seed is not None and network.seed != now.seed:
            self.cursor.sow(network.seed)
        back = [stroke.acts_on for stroke in network.strokes if stroke not in now.strokes]
        self.drawing.set(replace(network, mirror=self.drawing.options.mirror))
        self.drawing.warning = ""
        self._last_click = None
        self.cursor.loops.forget_crest()
        self.cursor.settle()
        if network.seed is not None and back and back[-1] != "both":
            # As when it was drawn: the wire that a stroke is for is the active one.
            self.cursor.live.chosen = FOLLOWS.index(back[-1])
        return True

    def adopt(self, network: Network, seams: ArrayLike) -> None:
        """Go on with a network that the mesh has now, but with the mirror as it is. `undo` does not lead back behind it.

        `seams`, (k, 2), are the edges that are seams but no wires.
        """
        drawing = self.drawing
        self.calm()
        self.cursor.retraces.clear()
        drawing.stops.set_seams(seams)
        drawing.history.forget()
        # Wires that were just cut do not know their images. Images are the edges that are seams.
        network = drawing.images.complete(network, seams)
        seed = network.seed
        if seed is not None and seed != drawing.network.seed and not self.cursor.sow(seed):
            seed = None
        drawing.set(replace(network, seed=seed, mirror=drawing.network.mirror))
        drawing.warning = ""
        self.cursor.loops.edges.forget()
        self.cursor.settle()

    def _remember_click(self, target: Snap) -> None:
        """Let the last step be taken back by `_take_back_click`."""
        self._last_click = (undirected(target.pick), self.drawing.history.steps)

    def _take_back_click(self, edge: Pick) -> None:
        """Undo the last click if it was on an edge, and forget it."""
        queue = self.cursor.queue
        last = queue[-1] if queue else None
        clicked = last is not None and last.gesture is self.cursor.live
        if clicked and undirected(last.target.pick) == undirected(edge):
            queue.pop()
        elif not queue and self._last_click == (undirected(edge), self.drawing.history.steps):
            self._restore(self.drawing.history.forget_step(self.drawing.network))
        self._last_click = None

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
        drag = self.cursor.drag
        return self.drawing.network if drag is None else drag.network

    @property
    def wires(self) -> tuple[Wire, ...]:
        """The wires of the network, oldest first."""
        return self.network.wires

    @property
    def seed(self) -> Pick | None:
        """The beginning of the live wire; None between chains."""
        seed = self.drawing.network.seed
        return None if seed is None else seed.begins(self.options.along)

    @property
    def picture(self) -> Picture:
        """Everything that is to be seen now."""
        return self._painter.picture()

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
