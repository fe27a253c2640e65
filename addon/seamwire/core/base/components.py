# SPDX-License-Identifier: GPL-3.0-or-later
"""Things that hang together."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterable

    from numpy.typing import ArrayLike, NDArray


def components(count: int, pairs: ArrayLike) -> NDArray[np.int64]:
    """Return a number for each of some things, (count,), the same for those that pairs, (k, 2), lead to one from the other."""
    found = np.arange(count)
    pairs = np.unique(np.sort(np.asarray(pairs, dtype=np.int64).reshape(-1, 2), axis=1), axis=0)
    while len(pairs):
        one, two = found[pairs].T
        low = np.minimum(one, two)
        if (one == two).all():
            break
        np.minimum.at(found, one, low)
        np.minimum.at(found, two, low)
        found = found[found]
    return found


def groups(keys: Iterable[Iterable[Hashable]]) -> list[list[int]]:
    """Return the rows of things in groups. Things that share a key are in one group. Groups are in the order of their first rows."""
    first: dict[Hashable, int] = {}
    pairs = [(first.setdefault(key, row), row) for row, own in enumerate(keys) for key in own]
    numbers = components(max((row for _, row in pairs), default=-1) + 1, pairs).tolist()
    found: dict[int, list[int]] = {}
    for row, number in enumerate(numbers):
        found.setdefault(number, []).append(row)
    return list(found.values())
