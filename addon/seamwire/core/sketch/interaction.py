# SPDX-License-Identifier: GPL-3.0-or-later
"""The base of what the mouse can do, and the edit that it leads to."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple
from weakref import ProxyTypes, proxy

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..network.network import Network, Request, Snap
    from ..solver.solver import LiveWire
    from .board import Board
    from .courses import Course, Search


class Begun(NamedTuple):
    """A new request with the course that is shown now. A search goes on from there unless that is final."""

    request: Request
    course: Course
    search: Search | None = None


class Edit(NamedTuple):
    """The network that an interaction leads to, its new requests, the number of the candidate that stays the active one, and a report."""

    network: Network
    begun: tuple[Begun, ...] = ()
    chosen: int | None = None
    report: str = ""


class Interaction:
    """What the mouse is doing on a board. It changes nothing of the board, which goes on to the network that it keeps.

    Attributes
    ----------
    target
        The pick under the cursor.
    reason
        Why nothing can be done there.
    """

    def __init__(self, board: Board) -> None:
        # The board holds its interactions.
        self._board: Board = board if isinstance(board, ProxyTypes) else proxy(board)
        self.target: Snap | None = None
        self.reason: str = ""

    def poll(self) -> bool:
        """Take in what was computed. Return whether there is something else to be seen."""
        return False

    @property
    def is_final(self) -> bool:
        return True

    def lives(self) -> Sequence[LiveWire]:
        return ()
