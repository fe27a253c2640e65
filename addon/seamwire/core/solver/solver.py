# SPDX-License-Identifier: GPL-3.0-or-later
"""What computes wires: the library's live wires, one for each way of running, with the metric they share."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Protocol, TypeVar

from ...terms.choices import KINDS, METRICS, Kind, MetricName
from ...terms.options import CLAMP_PERCENTILE, STRENGTHS
from ..base.messages import NOTHING, Message, Refused
from ..network.picks import FacePoint
from ..network.wires import FOLLOWS

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray
    from seamwire_core import Surface

    from ...terms.choices import Along
    from ..network.picks import Edge, Pick
    from ..network.strokes import Stroke

_KINDS: tuple[Kind, ...] = tuple(KINDS)


def kinds_of(metric: MetricName) -> tuple[Kind, ...]:
    """Return what the wires of a metric follow, by `Wire.follow`."""
    return METRICS[metric].follows


class Candidate(Protocol):
    """One of the wires from the seed to a target, as the library gives it."""

    follow: Kind
    points: NDArray[np.float64]
    faces: NDArray[np.int32]
    """The triangle of each segment, across the surface only."""
    vertices: NDArray[np.int32]
    length: float
    final: bool


class Candidates(Protocol):
    """The wires, one for each metric; which of them leads, and whether that will stay so."""

    wires: Sequence[Candidate]
    active: int
    settled: bool
    solved: bool
    """Whether each is the shortest: across the surface they may become more exact until they are `final`."""
    final: bool


def by_number(found: Candidates) -> tuple[tuple[Candidate, ...], int]:
    """Return the wires by `Wire.follow`, and the number of the one that leads."""
    order = sorted(range(len(found.wires)), key=lambda at: _KINDS.index(found.wires[at].follow))
    return tuple(found.wires[at] for at in order), order.index(found.active)


def _meant_for(stroke: Stroke, kinds: tuple[Kind, ...]) -> Stroke | None:
    """Return a stroke for one of the wires as the library names that wire; None if there is no such wire."""
    if stroke.acts_on == "both":
        return stroke
    number = FOLLOWS.index(stroke.acts_on)
    return replace(stroke, acts_on=kinds[number]) if number < len(kinds) else None


class EdgeChain(Protocol):
    """A chain of edges."""

    vertices: NDArray[np.int32]


class Loop(EdgeChain, Protocol):
    """A closed chain of edges. It has no vertices if there is no chain, or if it is not `final` yet."""

    final: bool


class EdgeLoop(EdgeChain, Protocol):
    """A straight chain of edges; no vertices where it cannot be told yet."""

    closed: bool


class Piece(EdgeChain, Protocol):
    """A piece of a closed cut, and the chain of edges that it snaps to."""

    points: NDArray[np.float64]
    faces: NDArray[np.int32]


class ClosedCut(Protocol):
    """A closed cut across the surface: pieces from a point around to it, and where each but the last ends."""

    pieces: Sequence[Piece]
    joints: Sequence[int | tuple[int, Sequence[float]]]
    separates: bool
    id: tuple[int, int]
    """The number of its metric and its number in that, for `LiveWire.bent_wire`."""


class ClosedCuts(Protocol):
    """The closed cuts through a point, best first; none where nothing suggests one, or where they are not `final` yet."""

    cuts: Sequence[ClosedCut]
    final: bool


class FittedChain(EdgeChain, Protocol):
    """The chain of edges that fits a line; no vertices where none does, or where it cannot be told yet."""

    places: NDArray[np.float64]


class EmbeddingReport(Protocol):
    """The library's report about a mesh that wires run across."""

    invalid_left: int


End = int | tuple[int, int] | tuple[int, tuple[float, float, float]]
"""A vertex, an edge by its two vertices, or a triangle and barycentric coordinates in it."""


def for_live(pick: Pick, along: Along) -> End:
    """Return a pick as live wires take it that run one way: along edges, of a point inside a triangle, its nearest vertex."""
    if not isinstance(pick, FacePoint):
        return pick
    return pick.vertex if along == "EDGES" else (pick.triangle, pick.weights)


class LiveWire(Protocol):
    """The part of ``seamwire_core.LiveWire`` that a session uses.

    Only `wait` waits. Until the library has built its surface, the others answer that nothing is there yet and nothing
    final; where it cannot be built, all raise ValueError.
    """

    def seed(self, pick: End, forward: bool = False) -> None:
        """Start the wires from a pick."""

    def wires(self, target: End) -> Candidates:
        """Return the wires to a target, as far as they are computed."""

    def loop(self, edge: Edge) -> Loop:
        """Return the closed chain through an edge, as far as it is computed."""

    def closed_wires(self, through: End) -> ClosedCuts:
        """Return the closed cuts across the surface through a point, as far as they are computed."""

    def bent_wire(self, through: End, second: End, cut: tuple[int, int]) -> ClosedCuts:
        """Return one of these cuts, by its id, bent to a second point, as far as it is computed."""

    def extend_straight(self, edge: Edge, stops: Iterable[int]) -> EdgeChain:
        """Return the straight way on from the end of a directed edge until a stop, a boundary or itself."""

    def edge_loop(self, edge: Edge, stops: Iterable[int]) -> EdgeLoop:
        """Return the straight chain through an edge, both ways, until a stop, a pole, a boundary or itself."""

    def fit_chain(
        self, points: ArrayLike, faces: ArrayLike, begin: int | None = None, end: int | None = None
    ) -> FittedChain:
        """Return the chain of edges that fits a line; along edges only."""

    def fork(self) -> LiveWire:
        """Return live wires with a separate seed and the same metric."""

    def set_metric(
        self, metric: MetricName, *, max_anisotropy: float | None = None, clamp_percentile: float | None = None
    ) -> None:
        """Compute with another metric from here on; the seed stays, and so do the wires until there are new ones."""

    def set_scribbles(self, strokes: Sequence[object]) -> None:
        """Compute with these strokes instead of those before; the rest as `set_metric`."""

    def feature_strength(self) -> NDArray[np.float64] | None:
        """Return how strong the features are at the vertices; None as long as that is computed."""

    def embeddings(self) -> Sequence[EmbeddingReport | None]:
        """Return reports about the embeddings of the metrics. None if there is no embedding yet."""

    @property
    def surface(self) -> Surface | None:
        """The library's surface; None: it is not built yet."""

    def progress(self) -> float:
        """Fraction of the running work that is done."""

    def wait(self, seconds: float | None = None) -> bool:
        """Wait for the running work."""


MOST_WAITS = 50
"""So often in a row the library may say that all its work is done although an answer is not final."""
_SLICE = 0.005
"""Seconds of one wait."""


class Final(Protocol):
    """An answer of live wires that may become better until it is `final`."""

    final: bool


Answer = TypeVar("Answer", bound=Final)


def final(live: LiveWire, ask: Callable[[], Answer]) -> Answer:
    """Ask live wires again and again, and return the answer that is final.

    Raises
    ------
    Refused
        If all work is done and the answer is still not final.
    """
    done = 0
    while not (found := ask()).final:
        done = done + 1 if live.wait(_SLICE) else 0
        if done > MOST_WAITS:
            raise Refused("no-result")
    return found


class Engines:
    """Live wires, each made when it is first asked for.

    Parameters
    ----------
    make
        Makes those of one way, with that way's strength of `STRENGTHS` and `CLAMP_PERCENTILE`.
    make_stroke
        Makes of a stroke what the live wires take.
    """

    def __init__(
        self,
        make: Callable[[Along], LiveWire],
        make_stroke: Callable[[Stroke], object],
    ) -> None:
        self._make = make
        self._lives: dict[Along, LiveWire] = {}
        self._cuts: LiveWire | None = None
        self.strengths: dict[Along, float] = dict(STRENGTHS)
        self.metric: MetricName = "feature"
        self.clamp = CLAMP_PERCENTILE
        self._make_stroke = make_stroke
        self._strokes: tuple[Stroke, ...] = ()
        self._made: dict[MetricName, list[object]] = {}
        self._told: int = 0

    def get(self, along: Along) -> LiveWire:
        """Return the live wires of one way."""
        if along not in self._lives:
            self._lives[along] = self._make(along)
            if (self.metric, self.strengths[along], self.clamp) != ("feature", STRENGTHS[along], CLAMP_PERCENTILE):
                self._tell_metric(along)
            if self._strokes:
                self._lives[along].set_scribbles(self._library_strokes(self.metric))
        return self._lives[along]

    def cuts(self) -> LiveWire:
        """Return the live wires that find closed cuts across the surface: in the metric of concave creases, whatever wires are."""
        if self._cuts is None:
            self._cuts = self._make("SURFACE")
            self._tell_cuts()
            if self._strokes:
                self._cuts.set_scribbles(self._library_strokes("concave"))
        return self._cuts

    def use(self, metric: MetricName, strengths: Mapping[Along, float], clamp: float) -> None:
        """Compute with another metric from here on; forks that were made before keep theirs."""
        before = self.metric, self.strengths, self.clamp
        self.metric, self.strengths, self.clamp = metric, dict(strengths), clamp
        for along in self._lives:
            if (metric, strengths[along], clamp) != (before[0], before[1][along], before[2]):
                self._tell_metric(along)
                if self._strokes and kinds_of(metric) != kinds_of(before[0]):
                    self._lives[along].set_scribbles(self._library_strokes(metric))
        if strengths["SURFACE"] != before[1]["SURFACE"]:
            self._tell_cuts()

    @property
    def computes(self) -> tuple[object, ...]:
        """What wires are computed with, as `Options.computes` has it."""
        return self.metric, self.strengths["EDGES"], self.strengths["SURFACE"], self.clamp

    def follow(self, strokes: Sequence[Stroke]) -> None:
        """Compute with other strokes from here on; forks that were made before keep theirs."""
        self._strokes, self._made = tuple(strokes), {}
        for live in self._lives.values():
            live.set_scribbles(self._library_strokes(self.metric))
        if self._cuts is not None:
            self._cuts.set_scribbles(self._library_strokes("concave"))

    @property
    def strokes(self) -> tuple[object, ...]:
        """What live wires are told of strokes now: the same objects as long as the strokes are."""
        return tuple(self._library_strokes(self.metric))

    def _library_strokes(self, metric: MetricName) -> list[object]:
        """Return the strokes as live wires with a metric take them: without those for a wire that it does not have."""
        if metric not in self._made:
            meant = (_meant_for(stroke, kinds_of(metric)) for stroke in self._strokes)
            self._made[metric] = [self._make_stroke(stroke) for stroke in meant if stroke is not None]
        return self._made[metric]

    def warning(self, along: Along) -> Message:
        """Return a message if wires must lead around invalid triangles. Empty if not, or if it was returned before."""
        reports = (report for report in self.get(along).embeddings() if report is not None)
        count = max((report.invalid_left for report in reports), default=0)
        if count <= self._told:
            return NOTHING
        self._told = count
        return Message.of("invalid-triangles", count=count)

    def _tell_cuts(self) -> None:
        if self._cuts is not None:
            self._cuts.set_metric("concave", max_anisotropy=self.strengths["SURFACE"])

    def _tell_metric(self, along: Along) -> None:
        self._lives[along].set_metric(self.metric, max_anisotropy=self.strengths[along], clamp_percentile=self.clamp)
