# SPDX-License-Identifier: GPL-3.0-or-later
"""A drawing session: gestures go in, networks with undo and redo come out.

It knows neither Blender nor the GPU. The tool in the viewport and the headless operators drive the same session.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ..base.messages import NOTHING, Message, Refused, message_of
from ..network.network import Network, Snap
from ..network.strokes import OffMeshError
from .bend import BendGesture
from .cursor import Cursor
from .gesture_queue import GestureQueue
from .line import LineGesture
from .loop import NextOffer
from .painter import Painter
from .picture import Work
from .retrace import Retrace, retraced
from .seed_drag import SeedDrag
from .stroke import StrokeGesture

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ...terms.options import Options
    from ..network.picks import Edge, Pick
    from ..network.strokes import Stroke
    from ..network.wires import Wire
    from .drawing import Drawing
    from .gesture import Gesture
    from .picture import Picture


class Session:
    """A drawing session on one mesh.

    Parameters
    ----------
    drawing
        The mesh, the settings, and the engines that compute wires.

    Attributes
    ----------
    cursor
        Finds the wires and offers at the cursor, and holds a seed or a line.
    under_way
        The gestures that are held or wait.
    queue
        Commits gestures as soon as they are computed, and goes on to their networks.

    Notes
    -----
    A method that changes something returns whether it was done; if not, the message of the drawing says why. A gesture that is not computed
    yet counts as done: it waits, and `queue.poll` commits it.
    """

    def __init__(self, drawing: Drawing) -> None:
        self.drawing = drawing
        self.cursor = Cursor(drawing)
        self.under_way = self.cursor.under_way
        self.queue = GestureQueue(drawing, self.cursor)
        self._bend = BendGesture(drawing, self.cursor.loops)
        self._painter = Painter(drawing, self.cursor)
        # The live wires are made now, because what they compute first takes longest.
        self.under_way.read_progress()

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
        drawing, cursor, target = self.drawing, self.cursor, None if snap is None else Snap.of(snap)
        cursor.aim(target)
        bend = bend and self.options.along == "SURFACE"
        if bend != cursor.loops.cuts.bends and drawing.message:
            drawing.message = NOTHING
            drawing.revision += 1
        drawing.revision += cursor.loops.hover(target, loop, bend)
        cursor.show_offers()

    def click(self, snap: Snap | Pick) -> bool:
        """Place a seed; if a wire is live, keep it and go on from there.

        On the chain's first seed this closes the chain. On another seed, a wire or a seam, the chain joins it and ends.
        While the way to the end or a loop is shown, that is kept.
        """
        target = Snap.of(snap)
        if not self.under_way.queue:
            if self.cursor.extension.wanted:
                return self.run_to_end()
            if self.cursor.loops.takes(target):
                return self.bend(target) if self.cursor.loops.bends else self.loop(target)
        self.queue.leave_seed()
        self.queue.last_click = None
        if not self.under_way.queue:
            if self.drawing.network.seed is None:
                return self.start(target)
            seen = self.cursor.live.active_final and target == self.cursor.target
            self.cursor.aim(target)
            self.cursor.live.seen = seen
        return self.queue.commit(self.cursor.live, target)

    def start(self, snap: Snap | Pick) -> bool:
        """Begin a new chain, which ends the one before. Gestures that wait are done first."""
        target = Snap.of(snap)
        self.queue.finish()
        try:
            done = self.queue.step(self.cursor.live.begun(target))
        except Refused as error:
            return self.drawing.refuse(error.message)
        if done:
            self.queue.remember_click(target)
        return done

    def loop(self, snap: Snap | Pick) -> bool:
        """Keep the offer that is shown for a pick, otherwise the first one.

        A click on the same edge just before is taken back, because a double click is a click first.
        """
        target, loops = Snap.of(snap), self.cursor.loops
        why = loops.aim(target)
        if why:
            return self.drawing.refuse(why)
        self.queue.leave_seed()
        if self.options.along == "EDGES":
            if loops.is_crest_taken(target.pick):
                return True  # the first press of a double click took the ridge
            self.queue.take_back_click(target.pick)
        return self.queue.commit(loops, target)

    def bend(self, snap: Snap | Pick) -> bool:
        """Bend the last closed cut to a point."""
        return self.do(self._bend, snap)

    def do(self, gesture: Gesture, snap: Snap | Pick | None = None) -> bool:
        """Aim a gesture at a pick, and commit it as soon as it is computed; one step for undo."""
        target = None if snap is None else Snap.of(snap)
        why = gesture.aim(target)
        if why:
            return self.drawing.refuse(why)
        self.queue.leave_seed()
        self.queue.last_click = None
        return self.queue.commit(gesture, target)

    def close(self, seen_along: tuple[float, float, float] | None = None) -> bool:
        """Lead the live wire back to the chain's first seed, and keep it. `seen_along` is that of `Snap`."""
        if self.drawing.network.closing_point is None:
            self.queue.finish()
        first = self.drawing.network.closing_point
        if first is None:
            return self.drawing.refuse("no-chain-to-close")
        self.cursor.extension.wanted = False
        return self.click(Snap(first, "SEED", seen_along=seen_along))

    def run_to_end(self, preview: bool = False) -> bool:
        """Let the live wire run straight on until it meets a seam, a wire, the boundary, the mirror or itself.

        Parameters
        ----------
        preview
            Whether to show it first, wherever the cursor goes. A click keeps it, `Cursor.stop_preview` hides it.
        """
        extension, target = self.cursor.extension, self.cursor.target
        why = extension.aim(target)
        if why:
            return self.drawing.refuse(why)
        self.queue.leave_seed()
        if preview:
            extension.wanted = True
            self.cursor.show_extension()
            found = extension.wire is not None or self.under_way.computing
            return found or self.drawing.refuse(self.drawing.message or Message.of("no-way-on"))
        if self.under_way.queue:
            if target is None:
                return self.drawing.refuse("no-way-on")
            extension.wanted = False
        else:
            self.cursor.live.seen = True
        return self.queue.commit(extension, target)

    def end_chain(self, wait: bool = True) -> None:
        """Let go of the live wire, or of a held seed. The kept wires stay.

        Parameters
        ----------
        wait
            Whether gestures that wait are done first. Otherwise they are forgotten.
        """
        if not wait:
            self.under_way.retraces.clear()
        elif self.under_way.waiting:
            self.queue.wait(until_committed=True)
        self.queue.calm()
        if self.drawing.network.seed is None:
            return
        # This is not a step for undo. Undoing the last wire afterwards makes the chain live again.
        self.drawing.set(replace(self.drawing.network, seed=None))
        self.cursor.live.chosen = None
        self.cursor.aim_again()

    # Gestures on kept wires

    def retrace(self, wire: Wire) -> bool:
        """Let a kept wire take its next way: that of another metric, or the next offer of the click that took it."""
        self.queue.finish()
        own = self.drawing.network.find(wire)
        if own is None:
            return self.drawing.refuse("wire-is-gone")
        if own.through is not None:
            return self.queue.commit(NextOffer(self.drawing, self.cursor.loops, own), Snap(own.through, "WIRE", own))
        if own.closed:
            return self.drawing.refuse("loop-has-one-way")
        try:
            if own.alternatives:
                return self.queue.step(retraced(self.drawing.network, own, own.alternatives))
            self.under_way.retraces.append(Retrace(self.drawing, own))
        except ValueError as error:
            return self.drawing.refuse(message_of(error))
        self.under_way.read_progress()
        self.queue.poll_retraces()
        return not self.drawing.message

    def drop(self, wire: Wire) -> bool:
        """Remove a kept wire."""
        self.queue.finish()
        own = self.drawing.network.find(wire)
        if own is None:
            return self.drawing.refuse("wire-is-gone")
        return self.queue.step(self.drawing.network.without(own))

    def drag(self, snap: Snap | Pick) -> bool:
        """Take hold of a seed, or of a wire (``Snap.to == "WIRE"``), which gets a seed there. `Cursor.drag_to` moves it."""
        self.queue.finish()
        return self.cursor.hold(SeedDrag, Snap.of(snap))

    # Lines and strokes

    def goes_on_from(self, snap: Snap | Pick) -> bool:
        """Whether a line that begins at a pick continues the chain, rather than begin a new one."""
        seed, target = self.drawing.network.seed, Snap.of(snap)
        on_seed = seed is not None and target.to == "SEED" and seed.at(target.pick, self.options.along)
        return on_seed and not self.under_way.queue

    def line_begin(self, snap: Snap | Pick) -> bool:
        """Begin a line over the surface, which `Cursor.line_to` draws. At the live wire's seed it continues the chain."""
        begin = Snap.of(snap)
        self.queue.leave_seed()
        self.queue.last_click = None
        self.cursor.stop_preview()
        return self.cursor.hold(LineGesture, begin, self.goes_on_from(begin))

    def line_keep(self, line: LineGesture) -> bool:
        """Keep the wires that follow a released line, as soon as they are computed; one step for undo."""
        line.finish()
        self.under_way.read_progress()
        self.drawing.revision += 1
        return self.queue.commit(line, line.end or line.begin)

    def draw_stroke(self, points: ArrayLike | None = None, faces: ArrayLike | None = None, **how: object) -> bool:
        """Draw a stroke that live wires follow or avoid. The parameters are those of `StrokeGesture`."""
        try:
            stroke = StrokeGesture(self.drawing, self.cursor.live, points, faces, **how)
        except OffMeshError as error:
            return self.drawing.refuse(message_of(error))
        return self.do(stroke)

    def erase(self, stroke: Stroke) -> bool:
        """Remove a stroke."""
        self.queue.finish()
        network = self.drawing.network
        rest = tuple(own for own in network.strokes if own.id != stroke.id)
        if len(rest) == len(network.strokes):
            return self.drawing.refuse("stroke-is-gone")
        return self.queue.step(replace(network, strokes=rest), self.cursor.live.chosen)

    # Settings

    def follow(self, options: Options) -> bool:
        """Draw wires with other settings from here on. Return False if that ends the chain, because the seed is not on the surface.

        Gestures that wait are done first, because they were meant with the settings before.
        """
        before = self.drawing.options
        if options == before:
            return True
        if options.draws != before.draws and self.under_way.waiting:
            self.queue.wait(until_committed=True)
        if options.along != before.along:
            self.queue.calm()
        return self.cursor.follow(options)

    # Undo and redo

    def undo(self) -> bool:
        """Take back what is held, else the last gesture that still waits, else the last step."""
        under_way = self.under_way
        drag = under_way.drag
        if (drag is None or not drag.ending) and self.cursor.let_go():
            return True
        if under_way.queue:
            under_way.queue.pop()
            self.cursor.loops.forget_crest()
            self.drawing.revision += 1
            return True
        if self.cursor.let_go(SeedDrag):
            return True
        if under_way.retraces:
            under_way.retraces.pop()
            self.drawing.revision += 1
            return True
        return self.queue.back()

    def redo(self) -> bool:
        """Bring back the step that undo took. Gestures that wait are done first, and after a new step there is nothing to redo."""
        self.queue.finish()
        return self.queue.forth()

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
        drag = self.under_way.drag
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
        work = Work(self.under_way.computing, self.drawing.progress, self.under_way.waiting)
        return self._painter.picture(work)

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
