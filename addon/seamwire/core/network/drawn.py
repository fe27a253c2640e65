# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires and strokes as they run: what is drawn, and what a mesh stores."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from .picks import undirected

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from .picks import Edge, Pick
    from .strokes import Stroke
    from .wires import Wire


@dataclass(frozen=True)
class Drawn:
    """Wires, oldest first, strokes, and the axes that later wires are mirrored over."""

    wires: tuple[Wire, ...] = ()
    strokes: tuple[Stroke, ...] = ()
    mirror: tuple[int, ...] = ()

    def find(self, wire: Wire | None) -> Wire | None:
        return None if wire is None else next((own for own in self.wires if own.id == wire.id), None)

    def taken_through(self, edge: Pick) -> Wire | None:
        """Return the newest wire that a click on an edge took."""
        pair = undirected(edge)
        return next((wire for wire in reversed(self.wires) if wire.through == pair), None)

    def without(self, wire: Wire) -> Drawn:
        return replace(self, wires=tuple(own for own in self.wires if own.id != wire.id))


def net_effect(claims: Iterable[tuple[Edge, bool]]) -> tuple[list[Edge], list[Edge]]:
    """Return the edges to mark and those to clear, each sorted; of several claims to an edge the last one counts."""
    effect = dict(claims)
    return sorted(e for e, marks in effect.items() if marks), sorted(e for e, marks in effect.items() if not marks)


def edges_after(edges: NDArray[np.int32], added: Iterable[Edge], removed: Iterable[Edge]) -> NDArray[np.int32]:
    """Return (k, 2) edges with some more and without others, each once, smaller vertex first."""
    more = np.array(list(added), dtype=np.int32).reshape(-1, 2)
    less = np.array(list(removed), dtype=np.int64).reshape(-1, 2)
    both = np.sort(np.concatenate([np.asarray(edges, dtype=np.int32).reshape(-1, 2), more]), axis=1).astype(np.int64)
    count = int(max(both.max(initial=0), less.max(initial=0))) + 1
    keys = np.setdiff1d(both @ (count, 1), np.sort(less, axis=1) @ (count, 1))
    return np.stack([keys // count, keys % count], axis=1).astype(np.int32)
