# SPDX-License-Identifier: GPL-3.0-or-later
"""The base of all gestures."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from ..network.network import Network

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..network.network import Snap
    from ..solver.solver import LiveWire


class Gesture:
    """One way to change the network with the cursor. It knows the drawing and no session.

    The session or its cursor aims it. The session polls it while the library computes, and goes on to its network.
    """

    keeps_active: int | None = None
    """The number of the candidate that stays the active one after the commit; None: the leading one."""
    needs_offers = False
    """Whether it waits for the offers of loops."""

    def take_warning(self) -> str:
        """Return what to tell after its network was committed. The warning about triangles comes only once."""
        return ""

    def aim(self, target: Snap | None) -> str:
        """Point at a target, or at nothing. Return why nothing can be done there, or an empty message."""
        return ""

    def poll(self) -> bool:
        """Take in what was computed. Return whether the picture has changed."""
        return False

    def commit(self) -> Committed:
        """Return the network with what the gesture does. Raises ValueError if it cannot be done."""
        raise NotImplementedError

    def leaves_live(self, live: bool, target: Snap | None) -> bool:
        """Return whether a chain is live after the commit at a target, if one is `live` before."""
        return live

    def cancel(self) -> None:
        """Show nothing, and ask for nothing."""

    def lives(self) -> Sequence[LiveWire]:
        """Return the live wires that compute for it."""
        return ()


Committed: TypeAlias = Network | Gesture | None
"""The next network. While it is computed, the gesture that waits for it. None if nothing is left to do."""
