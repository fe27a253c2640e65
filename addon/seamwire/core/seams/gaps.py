# SPDX-License-Identifier: GPL-3.0-or-later
"""Gaps in seams: a cut that ends just before it meets another one, or a border, keeps two islands from separating."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ..base import native

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    import seamwire_core
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Gap:
    """Where a cut ends, and the vertex that it nearly meets, with the shortest way there along edges and its length."""

    end: int
    target: int
    length: float
    path: tuple[int, ...] = field(default=(), compare=False)


class GapFinder:
    """Finds the gaps of a mesh's seams, see `seamwire_core.find_gaps`. `surface` returns its surface, on the thread that asks."""

    def __init__(
        self,
        surface: Callable[[], seamwire_core.Surface],
        partly_hidden: NDArray[np.int32] = np.empty((0, 2), dtype=np.int32),  # noqa: B008 - it is not changed
    ) -> None:
        self._surface, self._partly_hidden = surface, partly_hidden

    def find(
        self, seams: NDArray[np.int32], longest: float = 0.5, meant: Collection[int] = (), **options: float
    ) -> list[Gap]:
        """Find the gaps of seams, (k, 2), shortest first. The options are those of `find_gaps`."""
        find, hidden = native.load().find_gaps, self._partly_hidden
        found = find(self._surface(), seams, longest, meant=sorted(meant), partly_hidden=hidden, **options)
        return [Gap(int(path[0]), int(path[-1]), length, tuple(path.tolist())) for path, length in found]
