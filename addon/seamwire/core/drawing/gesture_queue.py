# SPDX-License-Identifier: GPL-3.0-or-later
"""The way of gestures to networks, as soon as they are computed, and back."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ..base.messages import NOTHING, Message, Refused, message_of
from ..network.network import Network
from ..network.picks import undirected
from ..network.wires import FOLLOWS
from ..solver.solver import MOST_WAITS
from .gesture import Gesture
from .line import LineGesture
from .seed_drag import SeedDrag
from .under_way import Waiting

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ..network.network import Snap
    from ..network.picks import Pick
    from .cursor import Cursor
    from .drawing import Drawing


class GestureQueue:
    """Commits gestures in the order in which they were made, and goes on to their networks, with steps for undo.

    Parameters
    ----------
    drawing
        The network and its history.
    cursor
        The wires and offers at the cursor, and the gestures that are under way.

    Attributes
    ----------
    last_click
        The pick of the last step, if that was a click, and the number of steps then.
    """

    def __init__(self, drawing: Drawing, cursor: Cursor) -> None:
        self._drawing = drawing
        self._cursor = cursor
        self._under_way = cursor.under_way
        self.last_click: tuple[Pick, int] | None = None

    # Gestures

    def commit(self, gesture: Gesture, target: Snap | None) -> bool:
        """Commit a gesture, or let it wait: for those that wait already, or until it is computed. Return whether it was not refused."""
        if not self._under_way.queue:
            self._drawing.failure = NOTHING
            done = self._attempt(gesture, target)
            if not isinstance(done, Gesture):
                return done
            if done is not gesture:
                return self.commit(done, target)
        self._under_way.queue.append(Waiting(gesture, target))
        self._drawing.revision += 1
        return True

    def _attempt(self, gesture: Gesture, target: Snap | None) -> bool | Gesture:
        """Commit a gesture. Return whether that was done, or the gesture that waits."""
        try:
            done = gesture.commit()
        except ValueError as error:
            self._cursor.aim_again()
            return self._drawing.refuse(message_of(error))
        if isinstance(done, Gesture):
            return done
        if done is None:
            return True
        if not self.step(done, gesture.keeps_active):
            return False
        self._drawing.warning = self._drawing.warning or gesture.take_warning()
        if gesture is self._cursor.live and target is not None:
            self.remember_click(target)
        return True

    def drag_end(self) -> bool:
        """Leave the dragged seed where it is, as soon as its wires are computed; one step for undo."""
        drag = self._under_way.drag
        if drag is None:
            return self._drawing.refuse("no-seed-moves")
        try:
            done = drag.commit()
        except Refused as error:
            self._cursor.let_go(SeedDrag)
            return self._drawing.refuse(error.message)
        if done is drag:
            drag.ending = True
            return True
        self._cursor.let_go(SeedDrag, again=done is None)
        return not isinstance(done, Network) or self.step(done)

    def finish(self) -> None:
        """Do what waits, because what comes now begins with the wires that it makes."""
        self._drawing.failure = NOTHING
        if self._under_way.queue:
            self.wait(until_committed=True)
        self.leave_seed()
        self.calm()

    def leave_seed(self) -> None:
        """Wait for the wires of a seed that was released. A seed that is held still goes back."""
        drag = self._under_way.drag
        if drag is not None and drag.ending:
            self.wait(until_committed=True)
        self._cursor.let_go(SeedDrag)

    def calm(self) -> None:
        """Drop everything under way, except the live wire and the wires that take another course."""
        self._cursor.loops.edges.stop_search()
        self._under_way.queue.clear()
        self.last_click = None
        self._cursor.let_go()
        self._cursor.stop_preview()

    # Computed results

    def poll(self) -> bool:
        """Take in what the library has computed, and commit the gestures that waited for it.

        Returns
        -------
        bool
            Whether the picture has changed.
        """
        under_way, drawing, cursor = self._under_way, self._drawing, self._cursor
        drag, line, queue = under_way.drag, under_way.holds(LineGesture), under_way.queue
        if line is None and not under_way.computing and not queue and not under_way.retraces:
            return False
        before = (drawing.revision, round(drawing.progress, 2))
        under_way.read_progress()
        self.poll_retraces()
        if drag is not None and not drag.final:
            drawing.revision += drag.poll()
            drawing.message = drag.message
            if drag.final and drag.ending:
                self._told(self.drag_end())
        if line is not None:
            drawing.revision += line.poll()
            drawing.message = line.message or drawing.message
        while queue and self._poll_queue():
            pass
        if not queue and not cursor.live.final:
            cursor.aim(cursor.target, again=True, is_read=True)
        cursor.show_offers(is_read=True)
        cursor.show_extension()
        return before != (drawing.revision, round(drawing.progress, 2))

    def _poll_queue(self) -> bool:
        """Commit the gesture that has waited longest, if it is computed. Return whether it was."""
        queue = self._under_way.queue
        head = queue[0]
        if isinstance(head.gesture, LineGesture):
            self._drawing.revision += head.gesture.poll()
        elif head.target is not None:
            self._cursor.aim(head.target, again=True, is_read=True)
            if head.gesture is not self._cursor.live:
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

    def poll_retraces(self) -> None:
        """Let the kept wires whose other ways are computed take them."""
        for retrace in list(self._under_way.retraces):
            done = self._attempt(retrace, None)
            if done is not retrace:
                self._under_way.retraces.remove(retrace)
                self._told(bool(done))

    def _told(self, done: bool) -> None:
        """Remember why a gesture that waited was not done."""
        if not done:
            self._drawing.failure = self._drawing.message

    def wait(self, until_committed: bool = False) -> None:
        """Wait until everything is computed and every waiting gesture is committed.

        If the library has done all its work and a gesture still waits, the gesture is dropped, and the message says so.

        Parameters
        ----------
        until_committed
            Whether to stop as soon as every waiting gesture is committed.
        """
        under_way, drawing = self._under_way, self._drawing
        rounds, before = 0, None
        while rounds < MOST_WAITS:
            for live in under_way.lives():
                try:
                    live.wait()
                except ValueError as error:  # what it is to compute cannot be computed
                    drawing.refuse(message_of(error))
            self._cursor.loops.edges.wait()
            self.poll()
            if not under_way.waiting and (until_committed or not under_way.computing):
                return
            now = (*map(id, under_way.queue), *map(id, under_way.retraces), drawing.progress)
            rounds, before = (rounds + 1 if now == before else 0), now
        if under_way.waiting:
            under_way.queue.clear()
            under_way.retraces.clear()
            self._cursor.let_go(SeedDrag)
            self._told(drawing.refuse("no-result"))

    # Networks

    def step(self, network: Network, chosen: int | None = None) -> bool:
        """Go on to a network, with a step for undo. `chosen`: the candidate that stays the active one."""
        drawing = self._drawing
        seed = network.seed
        if seed is not None and seed != drawing.network.seed and not self._cursor.sow(seed):
            return False
        drawing.history.step(drawing.network)
        lasting = network.lasting()
        drawing.set(drawing.images.complete(lasting))
        gone = Message.of("wire-went") if lasting is not network else NOTHING
        drawing.warning = drawing.images.warning(drawing.network) or gone or drawing.failure
        self._cursor.settle()
        self._cursor.live.chosen = chosen
        return True

    def back(self) -> bool:
        """Take back the last step. Return whether there was one."""
        network = self._drawing.history.back(self._drawing.network)
        return self._drawing.refuse("nothing-to-undo") if network is None else self._restore(network)

    def forth(self) -> bool:
        """Bring back the step that was taken back last. Return whether there was one."""
        network = self._drawing.history.forth(self._drawing.network)
        return self._drawing.refuse("nothing-to-redo") if network is None else self._restore(network)

    def _restore(self, network: Network) -> bool:
        """Go back or forth to a network of the history."""
        now = self._drawing.network
        if network.seed is not None and network.seed != now.seed:
            self._cursor.sow(network.seed)
        back = [stroke.acts_on for stroke in network.strokes if stroke not in now.strokes]
        self._drawing.set(replace(network, mirror=self._drawing.options.mirror))
        self._drawing.warning = NOTHING
        self.last_click = None
        self._cursor.loops.forget_crest()
        self._cursor.settle()
        if network.seed is not None and back and back[-1] != "both":
            # As when it was drawn: the wire that a stroke is for is the active one.
            self._cursor.live.chosen = FOLLOWS.index(back[-1])
        return True

    def adopt(self, network: Network, seams: ArrayLike) -> None:
        """Go on with a network that the mesh has now. `Session.undo` does not lead back behind it.

        Parameters
        ----------
        network
            The wires and strokes. The mirror stays; the live wire begins at the network's seed.
        seams
            (k, 2) the edges that are seams but no wires.
        """
        drawing = self._drawing
        self.calm()
        self._under_way.retraces.clear()
        drawing.stops.set_seams(seams)
        drawing.history.forget()
        # Wires that were just cut do not know their images. Images are the edges that are seams.
        network = drawing.images.complete(network, seams)
        seed = network.seed
        if seed is not None and seed != drawing.network.seed and not self._cursor.sow(seed):
            seed = None
        drawing.set(replace(network, seed=seed, mirror=drawing.network.mirror))
        drawing.warning = NOTHING
        self._cursor.loops.edges.forget()
        self._cursor.settle()

    def remember_click(self, target: Snap) -> None:
        """Let the last step be taken back by `take_back_click`."""
        self.last_click = (undirected(target.pick), self._drawing.history.steps)

    def take_back_click(self, edge: Pick) -> None:
        """Undo the last click if it was on an edge, and forget it."""
        queue = self._under_way.queue
        last = queue[-1] if queue else None
        clicked = last is not None and last.gesture is self._cursor.live
        if clicked and undirected(last.target.pick) == undirected(edge):
            queue.pop()
        elif not queue and self.last_click == (undirected(edge), self._drawing.history.steps):
            self._restore(self._drawing.history.forget_step(self._drawing.network))
        self.last_click = None
