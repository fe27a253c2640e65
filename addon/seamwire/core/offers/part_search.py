# SPDX-License-Identifier: GPL-3.0-or-later
"""The search for the parts that *Suggest Seamwires* makes islands of, and the library's finder of loops that knows them."""

from __future__ import annotations

import threading
import traceback
from typing import TYPE_CHECKING

import numpy as np

from ..base import native
from ..base.refused import Refused

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    import seamwire_core
    from numpy.typing import NDArray

    from ..solver.solver import LiveWire

NO_SEAMS = np.empty((0, 2), dtype=np.int32)
AMOUNTS = (0.5, 0.75, 1.0, 0.25)
"""How many parts there are, on the scale of *Suggest Seamwires*: the default, then more parts, then fewer."""
AT_ONCE = 5_000
"""Triangles up to which finding parts takes some ten milliseconds, so that a thread would only make it late."""


class PartSearch:
    """Finds parts on a thread, for the loops that an edge offers.

    `count` is how many triangles the mesh has, and `seams` returns the edges, (k, 2), that part it already. `find_parts` yields the part of
    each triangle, (m,), for each of `AMOUNTS`, on the thread. It takes the seams, and a function that returns whether to search further.
    """

    def __init__(
        self,
        live: Callable[[], LiveWire],
        count: int,
        seams: Callable[[], NDArray[np.int32]] = lambda: NO_SEAMS,
        find_parts: Callable[[NDArray[np.int32], Callable[[], bool]], Iterable[NDArray[np.int32]]] = lambda *_: (),
    ) -> None:
        self._live, self._count = live, count
        self._seams_now, self._find_parts = seams, find_parts
        self._seams = NO_SEAMS
        self._without_parts: seamwire_core.LoopOffers | None = None
        self._thread: threading.Thread | None = None
        self._stop = threading.Event()
        self._working = threading.Lock()
        self._error: Exception | None = None
        self.finder: seamwire_core.LoopOffers | None = None  # finds loops; None until it is prepared
        self.is_complete = False  # whether the parts are known; until then the finder knows only flat faces

    def ready(self) -> bool:
        """Begin to search, and return whether loops can be found. Raises Refused if an error has ended that."""
        if self._thread is None:
            self._error = None
            self._stop = threading.Event()
            self._seams = self._seams_now()
            self._thread = threading.Thread(
                target=self._search, args=(self._live(), self._seams, self._stop), name="seamwire parts", daemon=True
            )
            self._thread.start()
            if self._count <= AT_ONCE:
                self._thread.join()
        if self._error is not None:
            raise Refused(f"Loops could not be found: {self._error}")
        return self.finder is not None

    def stop(self) -> None:
        """Let the search for parts end soon. The next call of `ready` begins it again, with what it has measured."""
        if self._thread is not None and not self.is_complete:
            self._stop.set()
            self._thread = None

    def renew(self) -> None:
        if self._thread is not None and not np.array_equal(self._seams, self._seams_now()):
            self._stop.set()
            self._thread = None
            self.finder, self.is_complete = self._without_parts, False

    def wait(self) -> None:
        if self._thread is not None:
            self._thread.join()

    def _search(self, live: LiveWire, seams: NDArray[np.int32], stop: threading.Event) -> None:
        with self._working:  # a search that was stopped ends first
            found = None
            try:
                live.wait_for_surface()
                make = native.load().LoopOffers
                if self._without_parts is None:
                    self.finder = self._without_parts = make(live.surface)
                for labels in () if stop.is_set() else self._find_parts(seams, lambda: not stop.is_set()):
                    found = found or make(live.surface)
                    found.add_parts(labels)
            except Exception as error:
                traceback.print_exc()
                # Without parts there are other loops.
                self._error = None if self._without_parts is not None or stop.is_set() else error
            finally:
                if not stop.is_set():
                    self.finder, self.is_complete = found or self._without_parts, True
