# SPDX-License-Identifier: GPL-3.0-or-later
"""The result of a transfer: wires on another mesh, and how sure each of their seeds is."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ..base.messages import Message
from .placing import DOUBTFUL

if TYPE_CHECKING:
    from ..network.strokes import Stroke
    from ..network.wires import Wire

DEGREES = ((0.9, "SURE"), (0.6, "LIKELY"), (DOUBTFUL, "DOUBTFUL"), (0.0, "LOST"))
"""From which confidence on a seed counts as what."""


def degree_of(confidence: float) -> str:
    """Return how sure a seed is, as `DEGREES` has it."""
    return next(degree for least, degree in DEGREES if confidence >= least)


@dataclass(frozen=True)
class Seed:
    """A seed that was to be placed.

    Parameters
    ----------
    source
        Its vertex on the mesh that it comes from.
    mirrored
        Over which axes it was mirrored before, 0 to 2.
    vertex
        Its vertex on the target; None: it has no place.
    confidence
        From 0 to 1, see `DEGREES`.
    """

    source: int
    mirrored: tuple[int, ...]
    vertex: int | None
    confidence: float

    @property
    def message(self) -> Message:
        """What there is to say of it."""
        degree = degree_of(self.confidence)
        if self.vertex is None:
            return Message.of("seed-lost", seed=self.source, degree=degree, confidence=self.confidence)
        return Message.of(
            "seed-placed", seed=self.source, vertex=self.vertex, degree=degree, confidence=self.confidence
        )


@dataclass
class Transfer:
    """A network on another mesh.

    Attributes
    ----------
    wires, strokes
        The placed wires, connected as in the source.
    seeds
        All of the network's, each once.
    lost
        What could not be placed, and why.
    doubts
        What else there is to look at.
    added
        How many seeds lie between those of the network.
    """

    wires: list[Wire] = field(default_factory=list)
    strokes: list[Stroke] = field(default_factory=list)
    seeds: list[Seed] = field(default_factory=list)
    lost: list[Message] = field(default_factory=list)
    doubts: list[Message] = field(default_factory=list)
    added: int = 0

    @property
    def degrees(self) -> dict[str, int]:
        """How many seeds are how sure, the surest first; those that there are."""
        counts = Counter(degree_of(seed.confidence) for seed in self.seeds)
        return {degree: counts[degree] for _, degree in DEGREES if degree in counts}
