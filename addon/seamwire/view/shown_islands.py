# SPDX-License-Identifier: GPL-3.0-or-later
"""The islands that the seams of a drawing make, as soon as they are computed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.network.network import edges_after
from .failures import failures

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ..core.drawing.session import Session
    from ..core.islands.islands import IslandMaker, Islands


class ShownIslands:
    """Follows the cuts of a session.

    Parameters
    ----------
    maker
        Computes islands.
    session
        Its wires are cuts.
    seams
        (s, 2) the edges that are seams.
    """

    def __init__(self, maker: IslandMaker, session: Session, seams: ArrayLike) -> None:
        self._maker = maker
        self._session = session
        self._seams = np.asarray(seams, dtype=np.int32).reshape(-1, 2)
        self._seams_read = 0
        self._asked: object = None
        self._cuts: NDArray[np.int32] | None = None
        self._meant: frozenset[int] = frozenset()
        self._told: object = None
        self._part = ("islands", object())
        self.pointed: int | None = None
        """The triangle under the mouse; None: it is elsewhere."""

    @property
    def newest(self) -> Islands | None:
        """The islands that were computed last. None if computing them failed."""
        return None if self._failed else self._maker.newest

    @property
    def busy(self) -> bool:
        """Whether islands are being computed: `poll` is to be called now and then."""
        return not self._failed and (self._maker.busy or self._stale)

    @property
    def _failed(self) -> bool:
        return failures.has(*self._part)

    @property
    def _stale(self) -> bool:
        return self._asked != (self._session.drawing.network_revision, self._seams_read)

    @property
    def pointed_island(self) -> int | None:
        """The island under the mouse. None if there is no island, or only one."""
        found = self.newest
        if found is None or not found.cut or found.count < 2 or self.pointed is None:
            return None
        return int(found.labels[self.pointed])

    def set_seams(self, seams: NDArray[np.int32]) -> None:
        """Go on with other seams."""
        if not np.array_equal(self._seams, seams):
            self._seams = np.asarray(seams, dtype=np.int32).reshape(-1, 2)
            self._seams_read += 1

    def poll(self) -> bool:
        """Ask for the islands of a network whose cuts have changed.

        Returns
        -------
        bool
            Whether there are islands to be seen that no call before told of.
        """
        failures.attempt(self._part, self._ask)
        newest = self.newest
        before, self._told = self._told, None if newest is None else newest.key
        return self._told != before

    def _ask(self) -> None:
        try:
            self._maker.check()
            self._want()
        except Exception:
            self._asked = self._cuts = None  # the next attempt asks anew
            raise

    def _want(self) -> None:
        if self._stale:
            self._asked = (self._session.drawing.network_revision, self._seams_read)
            session = self._session
            wanted = edges_after(self._seams, session.edges_to_mark(), session.edges_to_clear())
            planned = (wire for wire in session.wires if wire.planned)
            meant = frozenset(vertex for wire in planned for edge in wire.claims() for vertex in edge)
            # A chain that ends turns cuts of wires into seams: the islands stay the same.
            if self._cuts is None or meant != self._meant or not np.array_equal(wanted, self._cuts):
                self._cuts, self._meant = wanted, meant
                self._maker.want(self._asked, wanted, meant)
