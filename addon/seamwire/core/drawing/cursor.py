# SPDX-License-Identifier: GPL-3.0-or-later
"""The wires and offers at the cursor, or the seed or the line that a button holds."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ..base.messages import NOTHING, message_of
from ..network.network import Snap
from .extension import Extension
from .gesture import Gesture
from .line import LineGesture
from .loop import LoopGesture
from .seed_drag import SeedDrag
from .under_way import UnderWay
from .wire import WireGesture

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...terms.options import Options
    from ..fields.crests import Crests
    from ..network.network import Seed
    from ..network.picks import Pick
    from .drawing import Drawing


class Cursor:
    """Finds the wires and offers at the cursor, and holds a seed or a line.

    Parameters
    ----------
    drawing
        The state that gestures share.

    Attributes
    ----------
    live, loops, extension
        The live wire, the loops and the way to the end that a click would keep.
    under_way
        The gestures that are held or wait.
    """

    def __init__(self, drawing: Drawing) -> None:
        self._drawing = drawing
        self.live = WireGesture(drawing)
        self.loops = LoopGesture(drawing, self.live)
        self.extension = Extension(drawing, self.live)
        self.under_way = UnderWay(drawing, self.live, self.loops)

    @property
    def target(self) -> Snap | None:
        """The pick under the cursor, or that of the oldest waiting gesture."""
        return self.live.target

    def next_candidate(self) -> bool:
        """Show the next candidate, or the next offer if offers are shown. Return whether there is one."""
        offers, drawing = self.loops.offers, self._drawing
        why = (offers if offers.wanted else self.live).advance()
        if why:
            return drawing.refuse(why)
        drawing.message = NOTHING
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
            return self._drawing.refuse(message_of(error))
        finally:
            self.under_way.read_progress()
        return True

    def aim(self, target: Snap | None, again: bool = False, is_read: bool = False) -> None:
        """Find the wires to a target.

        Parameters
        ----------
        target
            The pick under the cursor, or None.
        again
            Whether to find them also if the target is the same as before.
        is_read
            Whether the caller has just read the progress.
        """
        live, drawing = self.live, self._drawing
        same = live.is_aimed_at(target, drawing.options.straight) and live.final
        if same and not again and self.loops.final:
            return
        before = (live.shown, drawing.message)
        if not is_read:
            self.under_way.read_progress()
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
            self.under_way.read_progress()
        before = self._drawing.message
        is_awaited = any(one.gesture.needs_offers for one in self.under_way.queue)
        changed, self._drawing.message = self.loops.show(before, is_awaited)
        self._drawing.revision += changed or self._drawing.message != before

    def show_extension(self) -> None:
        """Show the live wire with its way to the end, while that is asked for."""
        if self.extension.wanted:
            self._drawing.revision += self.extension.poll()
            self._drawing.message = self.extension.message or self._drawing.message

    def follow(self, options: Options) -> bool:
        """Find wires with other settings from here on. Return False if that ends the chain, see `Session.follow`."""
        drawing = self._drawing
        before, drawing.options = drawing.options, options
        drawing.revision += 1
        done = options.along == before.along or self._switch()
        if options.straight != before.straight:
            self.live.reset()
            self.aim_again()
        if options.computes != before.computes:
            self.compute_anew()
        if options.clear != before.clear:
            drawing.message = NOTHING
        if options.mirror != drawing.network.mirror:
            drawing.set(replace(drawing.network, mirror=options.mirror))
        return done

    def _switch(self) -> bool:
        """Let the live wire run the other way; if it cannot begin there, end the chain."""
        drawing = self._drawing
        self.live.reset()
        self.loops.cancel()
        seed, why = drawing.network.seed, NOTHING
        if seed is not None and not self.sow(seed):
            why = drawing.message
            drawing.set(replace(drawing.network, seed=None))
        self.aim_again()
        drawing.message = why or drawing.message
        return not why

    def compute_anew(self) -> None:
        """Compute live wires with the current settings. While a seed is dragged, its wires keep their metric."""
        options, engines = self._drawing.options, self._drawing.engines
        if self.under_way.drag is not None:
            return
        if options.metric != engines.metric:
            self.live.reset()
        engines.use(options.metric, options.strengths, options.clamp)
        self._drawing.message = NOTHING
        self.loops.offers.clear()
        self.aim_again()
        self.show_offers()

    def settle(self) -> None:
        """Let the gestures at the cursor follow a new network."""
        self.live.chosen = None
        self.loops.offers.clear()
        self.extension.cancel()
        self._drawing.message = NOTHING
        self.aim_again()

    # A held seed or line, in place of wires and offers

    def hold(self, kind: type[SeedDrag] | type[LineGesture], *given: object) -> bool:
        """Take hold of a new gesture. Return whether it was not refused."""
        drawing = self._drawing
        try:
            self.under_way.held = kind(drawing, *given)
        except ValueError as error:
            return drawing.refuse(message_of(error))
        self.live.seedless = kind is SeedDrag
        self.under_way.read_progress()
        self.live.cancel()
        self.loops.offers.clear()
        self.extension.cancel()
        drawing.message = NOTHING
        drawing.revision += 1
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
        drawing = self._drawing
        if self.under_way.holds(kind) is None:
            return False
        self.under_way.held = None
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
        drag, drawing = self.under_way.drag, self._drawing
        if drag is None:
            return drawing.refuse("no-seed-moves")
        if snap is None or drag.ending:
            return False
        before = (drag.target, drag.network, drawing.message)
        self.live.target = Snap.of(snap)
        drawing.message = drag.aim(Snap.of(snap))
        self.under_way.read_progress()
        drawing.revision += before != (drag.target, drag.network, drawing.message)
        return drag.solved and not drag.message

    def line_to(self, points: NDArray[np.float64], triangles: NDArray[np.int32], snap: Snap | Pick | None) -> bool:
        """Draw the line on: all its points (k, 3), the triangle of each (k,), and the pick under the cursor."""
        line = self.under_way.holds(LineGesture)
        if line is None:
            return self._drawing.refuse("no-line-drawn")
        line.draw(points, triangles, None if snap is None else Snap.of(snap))
        self.live.target = line.joined
        self.under_way.read_progress()
        self._drawing.message = line.message
        self._drawing.revision += 1
        return True

    def line_release(self) -> LineGesture | None:
        """Let go of the line, to keep it with `Session.line_keep`. Return None if no line is drawn."""
        line = self.under_way.holds(LineGesture)
        if line is not None:
            self.under_way.held = None
            self._drawing.revision += 1
        return line
