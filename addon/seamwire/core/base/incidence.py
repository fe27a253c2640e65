# SPDX-License-Identifier: GPL-3.0-or-later
"""Which triangles or edges meet at a vertex."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Collection

    from numpy.typing import NDArray


class Incidence:
    """Finds the rows of a table, (m, k), such as triangles or edges, that contain a vertex. The table must not change afterwards.

    A thread sorts the table; whoever asks before it has finished waits for it.
    """

    def __init__(self, table: NDArray[np.integer], count: int) -> None:
        self._table = table
        self._thread = threading.Thread(target=self._sort, args=(count,), name="Seamwire incidence", daemon=True)
        self._thread.start()

    def _sort(self, count: int) -> None:
        flat = self._table.reshape(-1)
        self._rows = np.argsort(flat, kind="stable") // self._table.shape[1]
        self._starts = np.zeros(count + 1, dtype=np.int64)
        np.cumsum(np.bincount(flat, minlength=count), out=self._starts[1:])

    def wait(self) -> None:
        """Wait until the table is sorted."""
        self._thread.join()

    def rows(self, vertices: Collection[int]) -> NDArray[np.int64]:
        """Return the rows that contain at least one of the vertices, ascending."""
        self.wait()
        found = [self._rows[self._starts[vertex] : self._starts[vertex + 1]] for vertex in vertices]
        return np.unique(np.concatenate(found)) if found else np.empty(0, dtype=np.int64)

    def contain(self, pairs: NDArray[np.integer]) -> NDArray[np.bool_]:
        """Return which pairs of vertices, (e, 2), some row contains both of, (e,)."""
        self.wait()
        found = np.zeros(len(pairs), dtype=bool)
        left = np.arange(len(pairs))
        places, ends, others = self._starts[pairs[:, 0]], self._starts[pairs[:, 0] + 1], pairs[:, 1]
        while len(left):
            some = places < ends
            left, places, ends, others = left[some], places[some], ends[some], others[some]
            rows = self._rows[places]
            hits = np.logical_or.reduce([column[rows] == others for column in self._table.T])
            found[left[hits]] = True
            left, places, ends, others = left[~hits], places[~hits] + 1, ends[~hits], others[~hits]
        return found
