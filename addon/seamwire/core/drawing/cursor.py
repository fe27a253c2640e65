# SPDX-License-Identifier: GPL-3.0-or-later
"""The gestures of a session that are not done: at the cursor, held, or waiting."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

from ..network.network import Snap
from .extension import Extension
from .gesture import Gesture
from .line import LineGesture
from .loop import LoopGesture
from .seed_drag import SeedDrag
from .wire import WireGesture

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..fields.crests import Crests
    from ..network.network import Seed
    from ..network.picks import Pick
    from ..network.wires import Wire
    from ..solver.solver import LiveWire
    from .drawing import Drawing


@dataclass(frozen=True)
class Waiting:
    """A committed gesture that waits for the library, and the pick that it was committed at."""

    gesture: Gesture
    target: Snap | None


Kind = TypeVar("Kind", bound=Gesture)


class Cursor:
    """The gestures that are not done, and what of them is shown. It never changes the kept wires.

    Attributes
    ----------
    live, loops, extension
        The live wire, the loops and the way to the end that a click would keep.
    held
        The seed or the line that a button holds. A released seed stays here until its wires are computed.
    queue
        Committed gestures that wait, the oldest first. They are committed in this order.
    retraces
        Kept wires that take another course once it is computed. Nothing waits for them.
    """

    def __init__(self, drawing: Drawing) -> None:
        self._drawing = drawing
        self.live = WireGesture(drawing)
        self.loops = LoopGesture(drawing, self.live)
        self.extension = Extension(drawing, self.live)
        self.held: Gesture | None = None
        self.queue: list[Waiting] = []
        self.retraces: list[Gesture] = []

    @property
    def target(self) -> Snap | None:
        """The pick under the cursor, or that of the oldest waiting gesture."""
        return self.live.target

    def holds(self, kind: type[Kind]) -> Kind | None:
        """Return the held gesture if it is of a kind, otherwise None."""
        return self.held if isinstance(self.held, kind) else None

    @property
    def drag(self) -> SeedDrag | None:
        """The seed that is being moved."""
        return self.holds(SeedDrag)

    @property
    def moved(self) -> tuple[Wire, ...]:
        """The wires that follow a seed that is held, as they run now."""
        drag = self.drag
        return () if drag is None or drag.ending else drag.moved

    @property
    def gestures(self) -> list[Gesture]:
        """All gestures that wait or are held."""
        held = [] if self.held is None else [self.held]
        return [*(one.gesture for one in self.queue), *self.retraces, *held]

    @property
    def waiting(self) -> int:
        """The number of committed gestures that wait for their wires."""
        drag = self.drag
        return len(self.queue) + len(self.retraces) + (drag is not None and drag.ending)

    @property
    def computing(self) -> bool:
        """Whether the library still works on the picture."""
        drag = self.drag
        return self.live.computing or not self.loops.final or (drag is not None and not drag.final)

    @property
    def will_be_live(self) -> bool:
        """Whether a chain is live as soon as everything that waits is done."""
        live = self._drawing.network.seed is not None
        for one in self.queue:
            live = one.gesture.leaves_live(live, one.target)
        return live

    def lives(self) -> list[LiveWire]:
        """Return the live wires that compute something for what is shown or waits."""
        shown = [self.live, self.loops] if self.loops.cuts.wanted else [self.live]
        return [live for gesture in (*shown, *self.gestures) for live in gesture.lives()]

    def read_progress(self) -> None:
        """Read how much is computed. Wires that are not final after all work is done stay so, so this comes before asking."""
        self._drawing.progress = min(live.progress() for live in self.lives())

    # Wires and offers

    def next_candidate(self) -> bool:
        """Show the next candidate, or the next offer if offers are shown. Return whether there is one."""
        offers, drawing = self.loops.offers, self._drawing
        why = (offers if offers.wanted else self.live).advance()
        if why:
            return drawing.refuse(why)
        drawing.message = ""
        if not offers.wanted:
            self.show_extension()
        drawing.revision += 1
        return True

    def stop_preview(self) -> bool:
        """Hide the way to the end. Return whether it was shown."""
        if not self.extension.wanted:
            return False
        self.extension.cancel()
        self._drawing.revision += 1
        return True

    def use_crests(self, crests: Crests | None, first: bool) -> None:
        """Offer wires along the mesh's ridges and valleys: as the `first` of what a click offers, or as the last."""
        if self.loops.use_crests(crests, first) and self.target is not None:
            self.show_offers()

    def sow(self, seed: Seed) -> bool:
        """Start the wires of a seed. If it is refused, the wires are those of the seed before."""
        before = self._drawing.network.seed
        try:
            self.live.sow(seed, self._drawing.options.along)
        except ValueError as error:
            if before is not None and before != seed:
                self.sow(before)
            return self._drawing.refuse(str(error))
        finally:
            self.read_progress()
        return True

    def aim(self, target: Snap | None, again: bool = False, is_read: bool = False) -> None:
        """Find the wires to a target; `again` if it is the same as before, too. `is_read`: the caller has just read the progress."""
        live, drawing = self.live, self._drawing
        same = live.is_aimed_at(target, drawing.options.straight) and live.final
        if same and not again and self.loops.final:
            return
        before = (live.shown, drawing.message)
        if not is_read:
            self.read_progress()
        drawing.message = self.live.aim(target)
        # Asking again while nothing is ready shows nothing new, and must not cost a redraw each time.
        drawing.revision += before != (live.shown, drawing.message)
        self.show_extension()

    def aim_again(self) -> None:
        """Find the wires to the target once more: they may be others now."""
        self.aim(self.target, again=True)

    def show_offers(self, is_read: bool = False) -> None:
        """Show the offers at the cursor, as soon as they are computed. `is_read` is that of `aim`."""
        if self.loops.offers.unfinished and not is_read:
            self.read_progress()
        before = self._drawing.message
        is_awaited = any(one.gesture.needs_offers for one in self.queue)
        changed, self._drawing.message = self.loops.show(before, is_awaited)
        self._drawing.revision += changed or self._drawing.message != before

    def show_extension(self) -> None:
        """Show the live wire with its way to the end, while that is asked for."""
        if self.extension.wanted:
            self._drawing.revision += self.extension.poll()
            self._drawing.message = self.extension.message or self._drawing.message

    def compute_anew(self) -> None:
        """Compute live wires with the current settings. While a seed is dragged, its wires keep their metric."""
        options, engines = self._drawing.options, self._drawing.engines
        if self.drag is not None:
            return
        if options.metric != engines.metric:
            self.live.reset()
        engines.use(options.metric, options.strengths, options.clamp)
        self._drawing.message = ""
        self.loops.offers.clear()
        self.aim_again()
        self.show_offers()

    def settle(self) -> None:
        """Let the gestures at the cursor follow a new network."""
        self.live.chosen = None
        self.loops.offers.clear()
        self.extension.cancel()
        self._drawing.message = ""
        self.aim_again()

    # A held seed or line

    def hold(self, kind: type[SeedDrag] | type[LineGesture], *given: object) -> bool:
        """Take hold of a new gesture, in place of wires and offers. Return whether it was not refused."""
        drawing = self._drawing
        try:
            self.held = kind(drawing, *given)
        except ValueError as error:
            return drawing.refuse(str(error))
        self.live.seedless = kind is SeedDrag
        self.read_progress()
        self.live.cancel()
        self.loops.offers.clear()
        self.extension.cancel()
        drawing.message = ""
        drawing.revision += 1
        return True

    def let_go(self, kind: type[Gesture] = Gesture, again: bool = True) -> bool:
        """Cancel the held gesture if it is of a kind, and find the live wire `again`. Return whether it was held.

        A dragged seed goes back, and a line vanishes.
        """
        drawing = self._drawing
        if self.holds(kind) is None:
            return False
        self.held = None
        self.live.seedless = False
        drawing.revision += 1
        # While a seed was dragged, its wires kept their metric.
        if drawing.engines.computes != drawing.options.computes:
            self.compute_anew()
        if again:
            self.aim_again()
        return True

    def drag_to(self, snap: Snap | Pick | None) -> bool:
        """Move the dragged seed; its wires follow as soon as they are computed. None leaves it in place."""
        drag, drawing = self.drag, self._drawing
        if drag is None:
            return drawing.refuse("No seed is being moved")
        if snap is None or drag.ending:
            return False
        before = (drag.target, drag.network, drawing.message)
        self.live.target = Snap.of(snap)
        drawing.message = drag.aim(Snap.of(snap))
        self.read_progress()
        drawing.revision += before != (drag.target, drag.network, drawing.message)
        return drag.solved and not drag.message

    def line_to(self, points: NDArray[np.float64], triangles: NDArray[np.int32], snap: Snap | Pick | None) -> bool:
        """Draw the line on: all its points (k, 3), the triangle of each (k,), and the pick under the cursor."""
        line = self.holds(LineGesture)
        if line is None:
            return self._drawing.refuse("No line is being drawn")
        line.draw(points, triangles, None if snap is None else Snap.of(snap))
        self.live.target = line.joined
        self.read_progress()
        self._drawing.message = line.line.message
        self._drawing.revision += 1
        return True

    def line_release(self) -> LineGesture | None:
        """Let go of the line, to keep it with `Session.line_keep`. Return None if no line is drawn."""
        line = self.holds(LineGesture)
        if line is not None:
            self.held = None
            self._drawing.revision += 1
        return line
