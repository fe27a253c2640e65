# SPDX-License-Identifier: GPL-3.0-or-later
"""The gestures that are under way."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

from .gesture import Gesture
from .seed_drag import SeedDrag

if TYPE_CHECKING:
    from ..network.network import Snap
    from ..network.wires import Wire
    from ..solver.solver import LiveWire
    from .drawing import Drawing
    from .loop import LoopGesture
    from .wire import WireGesture


@dataclass(frozen=True)
class Waiting:
    """A committed gesture that waits for the library, and the pick that it was committed at."""

    gesture: Gesture
    target: Snap | None


Kind = TypeVar("Kind", bound=Gesture)


class UnderWay:
    """The gestures of a session that are neither done nor cancelled.

    Parameters
    ----------
    drawing
        The state that gestures share.
    live, loops
        The gestures at the cursor, which compute too.

    Attributes
    ----------
    held
        The gesture while a button is held. A released seed stays here until its wires are computed.
    queue
        Committed gestures that wait, the oldest first. They are committed in this order.
    retraces
        Kept wires that take another course once it is computed. Nothing waits for them.
    """

    def __init__(self, drawing: Drawing, live: WireGesture, loops: LoopGesture) -> None:
        self._drawing = drawing
        self._live = live
        self._loops = loops
        self.held: Gesture | None = None
        self.queue: list[Waiting] = []
        self.retraces: list[Gesture] = []

    @property
    def gestures(self) -> list[Gesture]:
        """All of them."""
        held = [] if self.held is None else [self.held]
        return [*(one.gesture for one in self.queue), *self.retraces, *held]

    def holds(self, kind: type[Kind]) -> Kind | None:
        """Return the held gesture if it is of a kind, otherwise None."""
        return self.held if isinstance(self.held, kind) else None

    @property
    def moved(self) -> tuple[Wire, ...]:
        """The wires that follow a seed that is held, as they run now."""
        drag = self.drag
        return () if drag is None or drag.ending else drag.moved

    @property
    def drag(self) -> SeedDrag | None:
        """The seed that is being moved."""
        return self.holds(SeedDrag)

    @property
    def waiting(self) -> int:
        """The number of committed gestures that wait for their wires."""
        drag = self.drag
        return len(self.queue) + len(self.retraces) + (drag is not None and drag.ending)

    @property
    def computing(self) -> bool:
        """Whether the library still works on the picture."""
        drag = self.drag
        return self._live.computing or not self._loops.final or (drag is not None and not drag.final)

    @property
    def will_be_live(self) -> bool:
        """Whether a chain is live as soon as everything that waits is done."""
        live = self._drawing.network.seed is not None
        for one in self.queue:
            live = one.gesture.leaves_live(live, one.target)
        return live

    def lives(self) -> list[LiveWire]:
        """Return the live wires that compute something for what is shown or waits."""
        shown = [self._live, self._loops] if self._loops.cuts.wanted else [self._live]
        return [live for gesture in (*shown, *self.gestures) for live in gesture.lives()]

    def read_progress(self) -> None:
        """Read how much is computed. Wires that are not final after all work is done stay so, so this comes before asking."""
        self._drawing.progress = min(live.progress() for live in self.lives())
