# SPDX-License-Identifier: GPL-3.0-or-later
"""Which triangles or edges meet at a vertex."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray


class Incidence:
    """Finds the rows of a table, such as triangles or edges, that contain a vertex.

    A thread sorts the table. Until it has finished, every lookup reads the whole table, with the same result.

    Parameters
    ----------
    table
        (m, k) vertices. It must not change afterwards.
    count
        The number of vertices.
    """

    def __init__(self, table: NDArray[np.integer], count: int) -> None:
        self._table = table
        self._count = count
        self._sorted: tuple[NDArray[np.int64], NDArray[np.int64]] | None = None
        self._thread = threading.Thread(target=self._sort, name="Seamwire incidence", daemon=True)
        self._thread.start()

    @property
    def ready(self) -> bool:
        """Whether the table is sorted."""
        return self._sorted is not None

    def wait(self) -> None:
        """Wait until the table is sorted."""
        self._thread.join()

    def rows(self, vertices: Sequence[int] | NDArray[np.integer]) -> NDArray[np.int64]:
        """Return the rows that contain at least one of the vertices, ascending."""
        if self._sorted is None:
            return np.flatnonzero(np.isin(self._table, vertices).any(axis=1))
        rows, starts = self._sorted
        found = [rows[starts[vertex] : starts[vertex + 1]] for vertex in vertices]
        return np.unique(np.concatenate(found)) if found else np.empty(0, dtype=np.int64)

    def _sort(self) -> None:
        flat = self._table.reshape(-1)
        rows = np.argsort(flat, kind="stable") // self._table.shape[1]
        starts = np.zeros(self._count + 1, dtype=np.int64)
        np.cumsum(np.bincount(flat, minlength=self._count), out=starts[1:])
        self._sorted = rows, starts
