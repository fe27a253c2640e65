# SPDX-License-Identifier: GPL-3.0-or-later
"""The islands that wires and seams cut a mesh into, computed beside the drawing. Knows neither Blender nor the GPU."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..base import native
from ..base.newest import Newest

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..seams.seam_wires import Gap, GapFinder

Label = Callable[["NDArray[np.int32]"], "NDArray[np.int32]"]
"""Takes cut edges, (c, 2), and returns a label for every triangle: 0, 1, ..., largest island first."""
Count = Callable[["NDArray[np.int32]", "NDArray[np.int32]"], "NDArray[np.int32]"]
"""Takes cut edges, (c, 2), and the labels they make; returns how many more cuts each island needs before it can lie flat."""
_Request = tuple[object, "NDArray[np.int32]", frozenset[int]]
"""The key, the cuts, and the vertices where cuts end on purpose."""

_MOST_LOOKED_AT = 3_000
"""Vertices around the end of a cut for what it nearly meets: less than where gaps are to be closed, for this is asked at each change."""
_CLOSE = 0.2
"""The longest gap of several edges, in lengths of the cut that ends there: the artist may go on at an end farther from others."""
AT_ONCE = 20_000
"""Triangles up to which the answer takes a few milliseconds, so that a thread would only make it late."""
HUES = 12
"""How many colors islands are told apart by."""
PLACES = [(4 + 5 * hue) % HUES for hue in range(HUES)]
"""Where each hue lies in the rainbow: hues with numbers next to each other lie far apart in it, and each place comes once."""


@dataclass(frozen=True)
class Islands:
    key: object  # of the request
    count: int
    labels: NDArray[np.int32]  # (m,) the island of each triangle
    hues: NDArray[np.uint8]  # (count,) below `HUES`; those of neighbors across a cut are far apart, see `PLACES`
    missing: NDArray[np.int32]  # (count,) how many more cuts each needs before it can lie flat
    cut: bool  # whether anything was cut
    parted: bool  # whether the cuts part the mesh; otherwise the islands are the parts that it has anyway
    pieces: tuple[tuple[int, NDArray[np.int32]], ...]  # for each hue that is used: it, and its triangles, (k, 3)
    gaps: tuple[Gap, ...] = ()  # where a cut ends just before it meets another one, shortest first

    @cached_property
    def sizes(self) -> NDArray[np.int64]:
        return np.bincount(self.labels, minlength=self.count)


class IslandMaker(Newest[_Request, Islands]):
    """Computes islands in its own thread, where it calls `label` and `count`. Only the newest waiting request is answered."""

    def __init__(
        self,
        triangles: NDArray[np.int32],
        label: Label,
        gaps: GapFinder | None = None,
        count: Count | None = None,
    ) -> None:
        super().__init__(self._islands_of, "seamwire-islands")
        self._triangles = triangles
        self._label = label
        self._gaps = gaps
        self._count = count

    def ask(
        self, key: object, cuts: Iterable[tuple[int, int]] | NDArray[np.int32], meant: frozenset[int] = frozenset()
    ) -> None:
        """Ask for the islands that cut edges make, with a key. Where cuts end at vertices that are `meant`, there are no gaps."""
        edges = np.array(cuts if isinstance(cuts, np.ndarray) else list(cuts), dtype=np.int32).reshape(-1, 2)
        if len(self._triangles) <= AT_ONCE:
            self.answer_now((key, edges, meant))
        else:
            self.want((key, edges, meant))

    def _islands_of(self, request: _Request) -> Islands:
        key, cuts, meant = request
        labels = np.asarray(self._label(cuts), dtype=np.int32)
        if labels.shape != (len(self._triangles),):
            raise ValueError(f"{labels.shape} labels for {len(self._triangles)} triangles")
        count = int(labels.max(initial=-1)) + 1
        before = self.answer
        former = () if before is None or not before.count else (before.labels, before.hues)
        hues = native.load().island_hues(self._triangles, labels, cuts, *former)
        of_triangle = hues[labels]
        pieces = tuple((hue, self._triangles[of_triangle == hue]) for hue in np.unique(of_triangle).tolist())
        missing = np.zeros(count, dtype=np.int32) if self._count is None else self._count(cuts, labels)
        gaps = []
        if self._gaps is not None:
            gaps = self._gaps.find(cuts, most_looked_at=_MOST_LOOKED_AT, longest_of_several=_CLOSE, meant=meant)
        return Islands(key, count, labels, hues, missing, len(cuts) > 0, count > self._parts, pieces, tuple(gaps))

    @cached_property
    def _parts(self) -> int:
        return int(np.max(self._label(np.empty((0, 2), dtype=np.int32)), initial=-1)) + 1
