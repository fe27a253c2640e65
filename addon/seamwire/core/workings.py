# SPDX-License-Identifier: GPL-3.0-or-later
"""How a drawing session goes from one network to the next, and how its live wires, loops and ends follow."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from .network import Network, Seed, Snap, Wire
from .retrace import other_way, with_other_way
from .state import Queued, State
from .strokes import FOR_WIRES

if TYPE_CHECKING:
    from .network import Along, Pick
    from .solver import LiveWire, MetricName


class Workings(State):
    """What the deeds of a session are made of."""

    # How it is done: the library

    def _working(self) -> list[LiveWire]:
        drag = [] if self._drag is None else self._drag.lives()
        # What a click on an edge offers is found along edges, however wires run now.
        offers = [self._engines.get("EDGES")] if any(queued.kind == "offer" for queued in self._queue) else []
        return [self._engines.get(self.along), *offers, *self._retraces.lives(), *drag]

    def _read_progress(self) -> None:
        # Before wires are asked for: what is not final after the work is done stays so.
        self._progress = min(live.progress() for live in self._working())

    def _use_metric(self, metric: MetricName, strengths: Mapping[Along, float], clamp: float | None = None) -> bool:
        if self._drag is not None:
            return self._refuse("Finish moving the seed first")
        self._engines.use(metric, strengths, self.clamp if clamp is None else clamp)
        self.message = ""
        self._loops.clear()
        self._aim(self._candidates.target, again=True)
        self._show_offers()
        self.revision += 1
        return True

    def _sow(self, seed: Seed) -> bool:
        """Start the wires of a seed; on refusal the wires are those of the seed before."""
        before = self._network.seed
        try:
            self._candidates.sow(seed, self.along)
        except ValueError as error:
            if before is not None and before != seed:
                self._sow(before)
            return self._refuse(str(error))
        finally:
            self._read_progress()
        return True

    # How it is let go

    def drag_cancel(self) -> bool:
        """Let the dragged seed go back to where it was."""
        if self._drag is None:
            return False
        self._drag = None
        self._aim(self._candidates.target, again=True)
        self.revision += 1
        return True

    def stop_preview(self) -> bool:
        """Stop showing the way to the end."""
        if not self._extension.wanted:
            return False
        self._extension.clear()
        self.revision += 1
        return True

    def _calm(self) -> None:
        """Let go of all that is under way but the live wire."""
        self._queue.clear()
        self._last_click = None
        self.drag_cancel()
        self.stop_preview()

    # How it is done: steps

    def _refuse(self, why: str) -> bool:
        self.message = why
        self.revision += 1
        return False

    def _set(self, network: Network) -> None:
        before, self._network = self._network, network
        if before.scribbles != network.scribbles:
            self._engines.follow(network.scribbles)
            self._read_progress()
        self.revision += 1
        self.network_revision += before.wires != network.wires or before.mirror != network.mirror

    def _change(self, network: Network) -> bool:
        """Go on to a new network, with a step for undo."""
        seed = network.seed
        if seed is not None and seed != self._network.seed and not self._sow(seed):
            return False
        self._history.step(self._network)
        self._set(self._images.complete(network))
        self._settle()
        self.message = self._images.warning(self._network) or self.message
        return True

    def _restore(self, network: Network) -> None:
        if network.seed is not None and network.seed != self._network.seed:
            self._sow(network.seed)
        back = [stroke.acts_on for stroke in network.scribbles if stroke not in self._network.scribbles]
        self._set(network)
        self._last_click = None
        self._settle()
        if network.seed is not None and back and back[-1] != "both":
            # As when it was drawn: the wire that a stroke is for is the active one.
            self._candidates.chosen = FOR_WIRES.index(back[-1])

    def _settle(self) -> None:
        self._candidates.chosen = None
        self._loops.clear()
        self._extension.clear()
        self.message = ""
        self._aim(self._candidates.target, again=True)

    # How it is done: the live wire

    def _aim(self, target: Snap | None, again: bool = False) -> None:
        """Find both wires to a target; `again`: also where it is the same as before."""
        live = self._candidates
        if target == live.target and not again and live.final and self._loops.final:
            return
        before = (live.shown, self.message)
        self._read_progress()
        # A seed that is dragged has no live wire.
        network = self._network if self._drag is None else replace(self._network, seed=None)
        self.message = live.aim(target, network, self.along)
        # Asking again while nothing is ready shows nothing new, and must not cost a redraw each time.
        self.revision += before != (live.shown, self.message)
        self._show_extension()

    # How it is done: loops and ends

    def _find_offers(self, pick: Pick, kept: Wire | None = None) -> tuple[Wire, ...]:
        """Return what a click on an edge may take, first what one has `kept`; nothing, too, while it is computed."""
        self._read_progress()
        try:
            return self._loops.find(pick, self._network, kept)
        except ValueError as error:
            self.message = str(error)
            return ()

    def _next_kept(self, own: Wire, steps: int = 1) -> bool:
        """Let a wire that a click on an edge took be what that offers next, or some steps on."""
        assert own.through is not None
        if not own.offers:
            offers = self._find_offers(own.through, own)[1:]
            if not self._loops.final:
                self._queue.append(Queued("offer", Snap(own.through, "WIRE", own)))
                self.revision += 1
                return True
            if not offers:
                return self._refuse(self.message or "Nothing else runs through this edge")
            own = replace(own, offers=offers)
        return self._change(self._network.with_wire(own).with_next_offer(own, steps))

    def _show_offers(self) -> None:
        loops, target = self._loops, self._candidates.target
        if not loops.missing and not any(queued.kind in {"loop", "offer"} for queued in self._queue):
            loops.final = True
        if loops.missing and target is not None:
            self.revision += loops.show(target.pick, self._find_offers(target.pick))

    def _show_extension(self) -> None:
        if self._extension.wanted:
            self.revision += self._extension.show(self._find_extension())

    def _find_extension(self) -> Wire | None:
        """Return the live wire with its way on; None where there is no way, or no direction yet."""
        self._read_progress()
        try:
            return self._extension.find(self._network, self.active, self.marking)
        except ValueError as error:
            self.message = str(error)
            return None

    # How it is done: kept wires that take another course

    def _poll_retraces(self) -> None:
        for wire, courses in self._retraces.poll():
            own = self._network.find(wire)
            if isinstance(courses, ValueError):
                self._refuse(str(courses))
            elif own is not None:  # else it was dropped in the meantime
                self._take_other_way(own, other_way(own, courses))

    def _take_other_way(self, own: Wire, other: Wire | None) -> bool:
        if other is None:
            return self._refuse("Both wires run along the same edges here")
        network = with_other_way(self._network, own, other)
        return self._refuse("There is no other way to this seed") if network is None else self._change(network)
