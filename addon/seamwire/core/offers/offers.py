# SPDX-License-Identifier: GPL-3.0-or-later
"""What one click offers to take as a whole: which of it is shown, and whether more is computed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..network.picks import undirected
from ..network.wires import Wire

if TYPE_CHECKING:
    from ...terms.choices import LoopKind
    from ..network.drawn import Drawn
    from ..network.picks import Pick


class Offers:
    """The loops that a click under the cursor may add. Who finds it, and how, is for the classes made of this."""

    SINGLE = ""
    """Says that there is only one offer."""
    NONE = ""
    """The message if there is no offer."""

    def __init__(self) -> None:
        self.wanted = False
        """Whether the offers are asked for."""
        self.edge: Pick | None = None
        """The pick, with the smaller vertex of an edge first."""
        self.offers: tuple[Wire, ...] = ()
        """No two alike, the likeliest first; empty: not computed."""
        self.choice = 0
        """The one that is shown."""
        self.final = True
        """Whether nothing is computed for them any more."""

    @property
    def wire(self) -> Wire | None:
        return self.offers[self.choice] if self.offers else None

    @property
    def kinds(self) -> tuple[LoopKind, ...]:
        return tuple(offer.kind for offer in self.offers if offer.kind is not None)

    @property
    def missing(self) -> bool:
        return self.wanted and not self.offers

    @property
    def unfinished(self) -> bool:
        """Return whether requested offers are missing, or may still be replaced."""
        return self.wanted and not (self.offers and self.final)

    def takes(self, pick: Pick) -> bool:
        raise NotImplementedError

    def find(self, pick: Pick, network: Drawn, kept: Wire | None = None) -> tuple[Wire, ...]:
        """Return what a click on a pick may take; nothing, too, while it is computed, see `final`."""
        raise NotImplementedError

    def clear(self) -> None:
        """Show none, and forget what was chosen; what is asked for is asked for still."""
        self.edge, self.offers, self.choice, self.final = None, (), 0, True

    def stop_waiting(self) -> None:
        """Let nothing be computed any more, unless it is asked for and not finished."""
        self.final = self.final or not self.unfinished

    def aim(self, pick: Pick | None) -> bool:
        """Ask for the offers for a pick, or for none; return whether others vanish because of that."""
        self.wanted = pick is not None
        if self.edge is None or (pick is not None and self.edge == undirected(pick)):
            return False
        vanish = bool(self.offers)
        self.clear()
        return vanish

    def show(self, pick: Pick, offers: tuple[Wire, ...]) -> bool:
        """Show what was found for a pick; return whether it is anything else."""
        choice = self.choice_among(pick, offers)
        before, self.edge, self.offers, self.choice = self.offers, undirected(pick), offers, choice
        return len(before) != len(offers) or not all(map(Wire.like, before, offers))

    def choice_among(self, pick: Pick, offers: tuple[Wire, ...]) -> int:
        """Return which of the offers for a pick is the one that was chosen, wherever it is by now; until one was, the first."""
        if self.wire is None or self.edge != undirected(pick) or self.choice == 0:
            return 0
        alike = (place for place, offer in enumerate(offers) if offer.like(self.wire))
        return next(alike, min(self.choice, max(len(offers) - 1, 0)))

    def advance(self) -> str:
        """Show the next offer; return why that cannot be, else nothing."""
        if not self.offers:
            return "No loop found yet"
        if len(self.offers) == 1:
            return self.SINGLE
        self.choice = (self.choice + 1) % len(self.offers)
        return ""
