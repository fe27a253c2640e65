# SPDX-License-Identifier: GPL-3.0-or-later
"""From one network to the next: gestures are aimed, committed or wait, and everything shown follows."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ..base.messages import NOTHING, Message, Refused, message_of
from ..network.network import Network
from ..network.picks import undirected
from ..network.wires import FOLLOWS
from ..solver.solver import MOST_WAITS
from .gesture import Gesture, Waiting
from .gestures import Gestures
from .line import LineGesture

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ..network.network import Seed, Snap
    from ..network.picks import Pick
    from .drawing import Drawing
    from .options import Options
    from .seed_drag import SeedDrag


class Flow:
    """Carries a drawing from one network to the next.

    Parameters
    ----------
    drawing
        The drawing.

    Attributes
    ----------
    gestures
        All gestures that work on it.
    message
        Why something was not done, or a warning.
    revision
        Grows with every change of the picture.
    """

    def __init__(self, drawing: Drawing) -> None:
        self.drawing = drawing
        self.gestures = Gestures(drawing)
        self.message: Message = NOTHING
        self.revision = 0
        self._last_click: tuple[Pick, int] | None = None

    # Gestures

    def commit(self, gesture: Gesture, target: Snap | None) -> bool:
        """Commit a gesture, or let it wait until it is computed. Return whether it was not refused."""
        done = self._attempt(gesture, target)
        if not isinstance(done, Gesture):
            return done
        if done is not gesture and not self.gestures.queue:
            return self.commit(done, target)
        return self.wait_for(done, target)

    def wait_for(self, gesture: Gesture, target: Snap | None) -> bool:
        """Commit a gesture after those that wait already."""
        self.gestures.queue.append(Waiting(gesture, target))
        self.revision += 1
        return True

    def _attempt(self, gesture: Gesture, target: Snap | None) -> bool | Gesture:
        """Commit a gesture. Return whether that was done, or the gesture that waits."""
        try:
            done = gesture.commit()
        except ValueError as error:
            self.aim_again()
            return self.refuse(message_of(error))
        if isinstance(done, Gesture):
            return done
        if done is None:
            return True
        if not self.change(done, gesture.chosen):
            return False
        self.message = self.message or gesture.take_warning()
        if gesture is self.gestures.wire and target is not None:
            self.remember_click(target)
        return True

    def refuse(self, why: str | Message, **values: object) -> bool:
        """Tell why something is not done: a message, or its code and values."""
        self.message = Message.of(why, **values) if isinstance(why, str) else why
        self.revision += 1
        return False

    def take_back_click(self, edge: Pick) -> None:
        """Undo the last click if it was on an edge, and forget it."""
        queue = self.gestures.queue
        last = queue[-1] if queue else None
        clicked = last is not None and last.gesture is self.gestures.wire
        if clicked and undirected(last.target.pick) == undirected(edge):
            queue.pop()
        elif self._last_click == (undirected(edge), self.drawing.history.steps):
            self.restore(self.drawing.history.forget_step(self.drawing.network))
        self._last_click = None

    def remember_click(self, target: Snap) -> None:
        """Let the last step be taken back by `take_back_click`."""
        self._last_click = (undirected(target.pick), self.drawing.history.steps)

    def forget_click(self) -> None:
        """Let the last click not be taken back by the next one."""
        self._last_click = None

    # Networks

    def set(self, network: Network) -> None:
        """Go on to a network, without a step for undo."""
        strokes = self.drawing.network.strokes
        self.drawing.set(network)
        if network.strokes != strokes:
            self.gestures.read_progress()
        self.revision += 1

    def change(self, network: Network, chosen: int | None = None) -> bool:
        """Go on to a network, with a step for undo. `chosen`: the candidate that stays the active one."""
        drawing = self.drawing
        seed = network.seed
        if seed is not None and seed != drawing.network.seed and not self.sow(seed):
            return False
        strokes = drawing.network.strokes
        warning = drawing.step(network)
        if drawing.network.strokes != strokes:
            self.gestures.read_progress()
        self.revision += 1
        self._settle()
        self.message = warning or self.message
        self.gestures.wire.candidates.chosen = chosen
        return True

    def restore(self, network: Network) -> bool:
        """Go back or forth to a network of the history."""
        now = self.drawing.network
        if network.seed is not None and network.seed != now.seed:
            self.sow(network.seed)
        back = [stroke.acts_on for stroke in network.strokes if stroke not in now.strokes]
        self.set(replace(network, mirror=self.drawing.options.mirror))
        self._last_click = None
        self.gestures.loop.forget_crest()
        self._settle()
        if network.seed is not None and back and back[-1] != "both":
            # As when it was drawn: the wire that a stroke is for is the active one.
            self.gestures.wire.candidates.chosen = FOLLOWS.index(back[-1])
        return True

    def _settle(self) -> None:
        """Let the gestures follow a new network."""
        self.gestures.wire.candidates.chosen = None
        self.gestures.loop.offers.clear()
        self.gestures.extension.cancel()
        self.message = NOTHING
        self.aim_again()

    # Undo and redo

    def undo(self) -> bool:
        """Take back what is held, else the last gesture that still waits, else the last step."""
        gestures = self.gestures
        if self.cancel_line() or (gestures.drag is not None and not gestures.drag.ending and self.cancel_drag()):
            return True
        if gestures.queue:
            gestures.queue.pop()
            gestures.loop.forget_crest()
            self.revision += 1
            return True
        if self.cancel_drag():
            return True
        if gestures.retraces:
            gestures.retraces.pop()
            self.revision += 1
            return True
        network = self.drawing.history.back(self.drawing.network)
        return self.refuse("nothing-to-undo") if network is None else self.restore(network)

    def redo(self) -> bool:
        """Bring back the step that undo took."""
        self.cancel_drag()
        network = self.drawing.history.forth(self.drawing.network)
        return self.refuse("nothing-to-redo") if network is None else self.restore(network)

    def adopt(self, network: Network, seams: ArrayLike) -> None:
        """Go on with a network that the mesh has now; see `Session.adopt`."""
        drawing = self.drawing
        self.calm()
        drawing.stops.set_seams(seams)
        self.gestures.retraces.clear()
        drawing.history.forget()
        # Wires that were just cut do not know their images. Images are the edges that are seams.
        network = drawing.images.complete(network, seams)
        seed = network.seed
        if seed is not None and seed != drawing.network.seed and not self.sow(seed):
            seed = None
        self.set(replace(network, seed=seed, mirror=drawing.network.mirror))
        self.gestures.loop.edges.forget()
        self._settle()

    # The live wire and the offers

    def sow(self, seed: Seed) -> bool:
        """Start the wires of a seed. If it is refused, the wires are those of the seed before."""
        before = self.drawing.network.seed
        try:
            self.gestures.wire.candidates.sow(seed, self.drawing.options.along)
        except ValueError as error:
            if before is not None and before != seed:
                self.sow(before)
            return self.refuse(message_of(error))
        finally:
            self.gestures.read_progress()
        return True

    def aim(self, target: Snap | None, again: bool = False) -> None:
        """Find the wires to a target; `again`: also if it is the same as before."""
        candidates = self.gestures.wire.candidates
        same = candidates.is_aimed_at(target, self.drawing.options.straight) and candidates.final
        if same and not again and self.gestures.loop.final:
            return
        before = (candidates.shown, self.message)
        self.gestures.read_progress()
        self.message = self.gestures.wire.aim(target)
        # Asking again while nothing is ready shows nothing new, and must not cost a redraw each time.
        self.revision += before != (candidates.shown, self.message)
        self.show_extension()

    def aim_again(self) -> None:
        """Find the wires to the target once more: they may be others now."""
        self.aim(self.gestures.wire.candidates.target, again=True)

    def show_offers(self) -> None:
        """Show the offers at the cursor, as soon as they are computed."""
        if self.gestures.loop.offers.unfinished:
            self.gestures.read_progress()
        changed, message = self.gestures.poll_offers(self.message)
        self.revision += changed or message != self.message
        self.message = message

    def show_extension(self) -> None:
        """Show the live wire with its way to the end, while that is asked for."""
        changed, self.message = self.gestures.poll_extension(self.message)
        self.revision += changed

    def clear_shown(self) -> None:
        """Show neither candidates nor offers, because something else is drawn."""
        self.gestures.wire.cancel()
        self.gestures.loop.offers.clear()
        self.gestures.extension.cancel()
        self.message = NOTHING

    # Settings

    def follow(self, options: Options) -> bool:
        """Draw wires with other settings; see `Session.follow`."""
        before, self.drawing.options = self.drawing.options, options
        if options == before:
            return True
        self.revision += 1
        done = options.along == before.along or self._switch()
        if options.straight != before.straight:
            self.gestures.wire.candidates.reset()
            self.aim_again()
        if options.computes != before.computes:
            self._compute_anew()
        if options.clear != before.clear:
            self.message = NOTHING
        if options.mirror != self.drawing.network.mirror:
            self.set(replace(self.drawing.network, mirror=options.mirror))
        return done

    def _switch(self) -> bool:
        """Let the live wire run the other way; if it cannot begin there, end the chain."""
        self.calm()
        self.gestures.wire.candidates.reset()
        self.gestures.loop.cancel()
        seed, why = self.drawing.network.seed, NOTHING
        if seed is not None and not self.sow(seed):
            why = self.message
            self.set(replace(self.drawing.network, seed=None))
        self.aim_again()
        self.message = why or self.message
        return not why

    def _compute_anew(self) -> None:
        """Compute live wires with the current settings. While a seed is dragged, its wires keep their metric."""
        options, engines = self.drawing.options, self.drawing.engines
        if self.gestures.drag is not None:
            return
        if options.metric != engines.metric:
            self.gestures.wire.candidates.reset()
        engines.use(options.metric, options.strengths, options.clamp)
        self.message = NOTHING
        self.gestures.loop.offers.clear()
        self.aim_again()
        self.show_offers()

    # Drags, lines and previews

    def calm(self) -> None:
        """Drop everything under way, except the live wire."""
        self.stop_search()
        self.gestures.queue.clear()
        self._last_click = None
        self.cancel_drag()
        self.cancel_line()
        self.stop_preview()

    def stop_search(self) -> None:
        """Let the search for parts end. It begins again if offers are asked for."""
        self.gestures.loop.edges.stop_search()

    def end_drag(self, drag: SeedDrag) -> bool:
        """Leave the dragged seed where it is, as soon as its wires are computed."""
        try:
            done = drag.commit()
        except Refused as error:
            self.cancel_drag()
            return self.refuse(error.message)
        if done is drag:
            drag.ending = True
            return True
        self._leave_drag()
        if isinstance(done, Network):
            return self.change(done)
        self.aim_again()
        return True

    def cancel_drag(self) -> bool:
        """Let the dragged seed go back to where it was."""
        if self.gestures.drag is None:
            return False
        self._leave_drag()
        self.aim_again()
        return True

    def _leave_drag(self) -> None:
        """Let go of the dragged seed, and follow settings that changed meanwhile."""
        self.gestures.drag = None
        self.gestures.wire.seedless = False
        self.revision += 1
        if self.drawing.engines.computes != self.drawing.options.computes:
            self._compute_anew()

    def cancel_line(self) -> bool:
        """Forget the line that is being drawn."""
        if self.gestures.line is None:
            return False
        self.gestures.line = None
        self.aim_again()
        self.revision += 1
        return True

    def stop_preview(self) -> bool:
        """Hide the way to the end. Return whether it was shown."""
        if not self.gestures.extension.wanted:
            return False
        self.gestures.extension.cancel()
        self.revision += 1
        return True

    # Computed results

    def poll(self) -> bool:
        """Take in what the library has computed, and commit the gestures that waited; see `Session.poll`."""
        gestures = self.gestures
        if gestures.settled:
            return False
        before = (self.revision, round(self.drawing.progress, 2))
        gestures.read_progress()
        self.poll_retraces()
        drag, line = gestures.drag, gestures.line
        if drag is not None and not drag.final:
            self.revision += drag.poll()
            self.message = drag.message
            if drag.final and drag.ending:
                self.end_drag(drag)
        if line is not None:
            self.revision += line.poll()
            self.message = line.message or self.message
        while gestures.queue and self._poll_queue():
            pass
        if not gestures.queue and not gestures.wire.candidates.final:
            self.aim_again()
        self.show_offers()
        self.show_extension()
        return before != (self.revision, round(self.drawing.progress, 2))

    def wait(self) -> None:
        """Wait until everything is computed and every waiting gesture is committed.

        If the library has done all its work and a gesture still waits, the gesture is dropped, and `message` says so.
        """
        gestures = self.gestures
        rounds, before = 0, None
        while rounds < MOST_WAITS:
            for live in gestures.lives():
                try:
                    live.wait()
                except ValueError as error:  # what it is to compute cannot be computed
                    self.refuse(message_of(error))
            gestures.loop.edges.wait()
            self.poll()
            if not gestures.queue and not gestures.retraces and not gestures.computing:
                return
            now = (*map(id, gestures.queue), *map(id, gestures.retraces), self.drawing.progress)
            rounds, before = (rounds + 1 if now == before else 0), now
        if gestures.waiting:
            gestures.queue.clear()
            gestures.retraces.clear()
            self.cancel_drag()
            self.refuse("no-result")

    def _poll_queue(self) -> bool:
        """Commit the gesture that has waited longest, if it is computed. Return whether it was."""
        queue = self.gestures.queue
        head = queue[0]
        if isinstance(head.gesture, LineGesture):
            self.revision += head.gesture.poll()
        elif head.target is not None:
            self.aim(head.target, again=True)
            if head.gesture is not self.gestures.wire:
                head.gesture.aim(head.target)
        done = self._attempt(head.gesture, head.target)
        if done is head.gesture:
            return False
        queue.pop(0)
        if isinstance(done, Gesture):
            queue.insert(0, Waiting(done, head.target))
        return True

    def poll_retraces(self) -> None:
        """Let the kept wires whose other ways are computed take them."""
        for retrace in list(self.gestures.retraces):
            if self._attempt(retrace, None) is not retrace:
                self.gestures.retraces.remove(retrace)
