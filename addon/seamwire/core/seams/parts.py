# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts that the library finds, the borders between them as wires, and what an artist changes about them. Knows no Blender."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from ..network.picks import undirected
from ..network.wires import Wire

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..network.picks import Edge

STEP = 0.05
"""The amount of parts that a notch of the wheel adds, or several times as much if the number of parts stays the same."""


def edges_of(chain: NDArray[np.int32]) -> frozenset[Edge]:
    """Return the edges of a chain of vertices, each with the smaller vertex first."""
    return frozenset(undirected(pair) for pair in pairwise(chain.tolist()))


@dataclass(frozen=True)
class PartEdits:
    """An artist's changes to the parts of one mesh.

    Parameters
    ----------
    kept
        Edges that have to be borders.
    dropped
        Edges that must not be borders.
    parted
        A polygon for each part that is cut in two, one after another.
    """

    kept: frozenset[Edge] = frozenset()
    dropped: frozenset[Edge] = frozenset()
    parted: tuple[int, ...] = ()

    def keep(self, edges: frozenset[Edge]) -> PartEdits:
        """Return the edits with edges that have to be borders."""
        return replace(self, kept=self.kept | edges, dropped=self.dropped - edges)

    def drop(self, edges: frozenset[Edge]) -> PartEdits:
        """Return the edits with edges that must not be borders."""
        return replace(self, kept=self.kept - edges, dropped=self.dropped | edges)

    def part(self, polygon: int) -> PartEdits:
        """Return the edits with one more cut of the part that has a polygon."""
        return replace(self, parted=(*self.parted, polygon))

    def on(self, edges: NDArray[np.int32], polygons: NDArray[np.int32]) -> dict[str, NDArray[np.int32]]:
        """Return the edits as arguments of the library's finder, as far as a mesh has their edges and polygons.

        Parameters
        ----------
        edges
            (e, 2) the mesh's edges.
        polygons
            (m,) the polygon of each triangle, ascending.
        """
        rows = np.searchsorted(polygons, self.parted)
        parted = [row for row, at in zip(rows, self.parted, strict=True) if row < len(polygons) and polygons[row] == at]
        there = set(map(tuple, np.sort(edges, axis=1).tolist())) if self.kept or self.dropped else set()
        kept, dropped = (
            np.array(sorted(own & there), dtype=np.int32).reshape(-1, 2) for own in (self.kept, self.dropped)
        )
        return {"kept": kept, "dropped": dropped, "parted": np.array(parted, dtype=np.int32)}


def edits_text(edits: Mapping[str, PartEdits]) -> str:
    """Return the edits of several meshes as text, which `edits_of_text` reads."""
    return json.dumps(
        {
            name: {"kept": sorted(own.kept), "dropped": sorted(own.dropped), "parted": own.parted}
            for name, own in edits.items()
            if own != PartEdits()
        }
    )


def edits_of_text(text: str) -> dict[str, PartEdits]:
    """Return the edits of each mesh.

    Raises
    ------
    ValueError
        If the text is not from `edits_text`.
    """
    try:
        return {
            name: PartEdits(
                *(frozenset(undirected((int(a), int(b))) for a, b in own[kind]) for kind in ("kept", "dropped")),
                tuple(map(int, own["parted"])),
            )
            for name, own in (json.loads(text) if text else {}).items()
        }
    except (KeyError, TypeError, AttributeError) as error:
        raise ValueError(str(error)) from error


def turned(
    amount: float, notches: int, count: Callable[[float], int], may_go_on: Callable[[], bool] = lambda: True
) -> float:
    """Return the amount of parts after a turn of the wheel by one notch. It stays if the number of parts cannot change that way.

    Parameters
    ----------
    amount
        From 0 to 1.
    notches
        1 for more parts, -1 for fewer.
    count
        Returns the number of parts for an amount.
    may_go_on
        Whether to look further for another number of parts. Otherwise the wheel stops at the amount that was looked at last.
    """
    before = count(amount)
    place = round(amount / STEP, 6)
    # From between two steps to the nearest one in this direction.
    place = np.floor(place) + 1 if notches > 0 else np.ceil(place) - 1
    while 0 <= place <= round(1.0 / STEP):
        found = min(float(place) * STEP, 1.0)
        if count(found) != before or not may_go_on():
            return found
        place += notches
    return amount


def border_wires(borders: list[NDArray[np.int32]], points: NDArray[np.float64]) -> list[Wire]:
    """Return the borders of parts as wires.

    Parameters
    ----------
    borders
        Chains of vertices. A closed chain ends with its first vertex.
    points
        (n, 3) vertices of the mesh.
    """
    wires = []
    for chain in borders:
        vertices = chain.tolist()
        closed = vertices[0] == vertices[-1]
        own = tuple(vertices[:-1] if closed else vertices)
        wires.append(Wire("EDGES", own, points[vertices], vertices[0], vertices[-1], closed=closed, planned=True))
    return wires
