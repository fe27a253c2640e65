# SPDX-License-Identifier: GPL-3.0-or-later
"""What computes wires: the library's live wires, made on threads, one for each way of running, with the metric they share."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Generic, Literal, Protocol, TypeVar

import numpy as np

from .defaults import CLAMP_PERCENTILE, STRENGTHS

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .network import Along, Edge, Pick
    from .strokes import Scribble

MetricName = Literal["feature", "campen", "pottmann_kovacs", "euclidean"]
"""What draws wires to features, as the library calls it."""


class Candidate(Protocol):
    """One of the two wires from the seed to a target, as the library gives it."""

    points: NDArray[np.float64]
    vertices: NDArray[np.int32]
    length: float
    final: bool


class Candidates(Protocol):
    """Both wires and which of them is shorter in its own metric."""

    wires: tuple[Candidate, Candidate]
    shorter: int
    final: bool


class Chain(Protocol):
    """A chain of edges."""

    vertices: NDArray[np.int32]


class Loop(Chain, Protocol):
    """A closed chain of edges; no vertices where there is none, or where it is not `final` yet."""

    final: bool


class Strip(Chain, Protocol):
    """A straight chain of edges; no vertices where it cannot be told yet."""

    closed: bool


class LiveWire(Protocol):
    """What a session asks of ``seamwire_core.LiveWire``."""

    def seed(self, pick: Pick, forward: bool = False) -> None:
        """Start the wires from a pick."""

    def wires(self, target: Pick) -> Candidates:
        """Both wires to a target, as far as they are computed."""

    def loop(self, edge: Edge) -> Loop:
        """Return the closed chain through an edge, as far as it is computed."""

    def run_on(self, edge: Edge, stops: Iterable[int]) -> Chain:
        """Return the straight way on from the end of a directed edge until a stop, a boundary or itself."""

    def strip(self, edge: Edge, stops: Iterable[int]) -> Strip:
        """Return the straight chain through an edge, both ways, until a stop, a pole, a boundary or itself."""

    def fork(self) -> LiveWire:
        """Return live wires with a seed of their own and the same metric."""

    def set_metric(
        self, metric: MetricName, *, max_anisotropy: float | None = None, clamp_percentile: float | None = None
    ) -> None:
        """Compute with another metric from here on; the seed stays, and so do the wires until there are new ones."""

    def set_scribbles(self, scribbles: Sequence[object]) -> None:
        """Compute with these strokes instead of those before; the rest as `set_metric`."""

    def feature_strength(self) -> NDArray[np.float64] | None:
        """Return how strong the features are at the vertices; None as long as that is computed."""

    def progress(self) -> float:
        """Fraction of the running work that is done."""

    def wait(self, seconds: float | None = None) -> bool:
        """Wait for the running work."""


T = TypeVar("T")
Made = TypeVar("Made", covariant=True)


class Making(Protocol[Made]):
    """Something that is being made."""

    @property
    def ready(self) -> bool:
        """Whether `get` returns, or raises, at once."""

    def get(self) -> Made:
        """Return it, waiting for it where need be."""


class Eventually(Generic[T]):
    """What a function returns, called on a thread of its own.

    Parameters
    ----------
    make
        Called once; what it raises, `get` raises.
    """

    def __init__(self, make: Callable[[], T]) -> None:
        self._make = make
        self._made: list[T] = []
        self._error: Exception | None = None
        self._thread = threading.Thread(target=self._run, name="seamwire", daemon=True)
        self._thread.start()

    def _run(self) -> None:
        try:
            self._made.append(self._make())
        except Exception as error:
            self._error = error

    @property
    def ready(self) -> bool:
        """Whether `get` returns, or raises, at once."""
        return not self._thread.is_alive()

    def get(self) -> T:
        """Return what was made, waiting for it where need be; raises what making it raised."""
        self._thread.join()
        if self._error is not None:
            raise self._error
        return self._made[0]


@dataclass(frozen=True)
class _NoCandidate:
    points: NDArray[np.float64]
    vertices: NDArray[np.int32]
    length: float = float("inf")
    closed: bool = False
    final: bool = False


@dataclass(frozen=True)
class _NoWires:
    wires: tuple[_NoCandidate, _NoCandidate]
    shorter: int = 0
    final: bool = False


_NO_CANDIDATE = _NoCandidate(np.empty((0, 3)), np.empty(0, dtype=np.int32))
_NO_WIRES = _NoWires((_NO_CANDIDATE, _NO_CANDIDATE))


class EventualLive:
    """Live wires that answer at once, and say that nothing is final, until they are made.

    Parameters
    ----------
    making
        Makes the library's live wires.

    Notes
    -----
    To be called from one thread. Where making them failed, every call raises what it raised. A seed that turns out not
    to be part of the surface is refused when wires are asked for, with ValueError as the library does.
    """

    def __init__(self, making: Making[LiveWire]) -> None:
        self._making = making
        self._live: LiveWire | None = None
        self._seed: tuple[Pick, bool] | None = None
        self._metric: tuple[MetricName, float | None, float | None] | None = None
        self._scribbles: Sequence[object] = ()
        self._refusal: ValueError | None = None

    def _made(self) -> LiveWire | None:
        return self._adopt() if self._live is not None or self._making.ready else None

    def _adopt(self) -> LiveWire:
        """Return the library's live wires, having told them what was asked for before they were there."""
        if self._live is None:
            live = self._making.get()
            if self._metric is not None:
                metric, max_anisotropy, clamp_percentile = self._metric
                live.set_metric(metric, max_anisotropy=max_anisotropy, clamp_percentile=clamp_percentile)
            if self._scribbles:
                live.set_scribbles(self._scribbles)
            if self._seed is not None:
                try:
                    live.seed(self._seed[0], forward=self._seed[1])
                except ValueError as error:
                    self._refusal = error
            self._live = live
        return self._live

    def seed(self, pick: Pick, forward: bool = False) -> None:
        """Start the wires from a pick."""
        live = self._made()
        if live is None:
            self._seed = (pick, forward)
            return
        live.seed(pick, forward=forward)
        self._refusal = None

    def set_metric(
        self, metric: MetricName, *, max_anisotropy: float | None = None, clamp_percentile: float | None = None
    ) -> None:
        """Compute with another metric from here on; the seed stays."""
        live = self._made()
        if live is None:
            self._metric = (metric, max_anisotropy, clamp_percentile)
        else:
            live.set_metric(metric, max_anisotropy=max_anisotropy, clamp_percentile=clamp_percentile)

    def set_scribbles(self, scribbles: Sequence[object]) -> None:
        """Compute with these strokes from here on."""
        live = self._made()
        if live is None:
            self._scribbles = scribbles
        else:
            live.set_scribbles(scribbles)

    def wires(self, target: Pick) -> Candidates:
        """Both wires to a target, as far as they are computed."""
        live = self._made()
        if self._refusal is not None:
            raise self._refusal
        return _NO_WIRES if live is None else live.wires(target)

    def loop(self, edge: Edge) -> Loop:
        """Return the closed chain through an edge, as far as it is computed."""
        live = self._made()
        return _NO_CANDIDATE if live is None else live.loop(edge)

    def run_on(self, edge: Edge, stops: Iterable[int]) -> Chain:
        """Return the straight way on from a directed edge; no vertices as long as nothing is there."""
        live = self._made()
        return _NO_CANDIDATE if live is None else live.run_on(edge, stops)

    def strip(self, edge: Edge, stops: Iterable[int]) -> Strip:
        """Return the straight chain through an edge; no vertices as long as nothing is there."""
        live = self._made()
        return _NO_CANDIDATE if live is None else live.strip(edge, stops)

    def feature_strength(self) -> NDArray[np.float64] | None:
        """Return how strong the features are at the vertices; None as long as that is computed."""
        live = self._made()
        return None if live is None else live.feature_strength()

    def fork(self) -> EventualLive | LiveWire:
        """Return live wires with a seed of their own and the same metric."""
        live = self._made()
        return EventualLive(_Fork(self)) if live is None else live.fork()

    def progress(self) -> float:
        """Fraction of the running work that is done; 0 while the live wires are made."""
        live = self._made()
        return 0.0 if live is None else live.progress()

    def wait(self, seconds: float | None = None) -> bool:
        """Wait for the running work."""
        return self._adopt().wait(seconds)


@dataclass(frozen=True)
class _Fork:
    """A fork of live wires that are not there yet, made in the caller's thread as soon as they are."""

    parent: EventualLive

    @property
    def ready(self) -> bool:
        return self.parent._made() is not None

    def get(self) -> LiveWire:
        return self.parent._adopt().fork()


class Engines:
    """Live wires, each made when it is first asked for.

    Parameters
    ----------
    make
        Makes those of one way, with that way's strength of `STRENGTHS` and `CLAMP_PERCENTILE`.
    strengths
        Largest anisotropy of the metric, where it is to be another one.
    make_scribble
        Makes of a stroke what the live wires take.
    """

    def __init__(
        self,
        make: Callable[[Along], LiveWire],
        strengths: Mapping[Along, float],
        make_scribble: Callable[[Scribble], object],
    ) -> None:
        self._make = make
        self._lives: dict[Along, LiveWire] = {}
        self.strengths: dict[Along, float] = {**STRENGTHS, **strengths}
        self.metric: MetricName = "feature"
        self.clamp = CLAMP_PERCENTILE
        self._make_scribble = make_scribble
        self._scribbles: list[object] = []

    def get(self, along: Along) -> LiveWire:
        """Return the live wires of one way."""
        if along not in self._lives:
            self._lives[along] = self._make(along)
            if (self.metric, self.strengths[along], self.clamp) != ("feature", STRENGTHS[along], CLAMP_PERCENTILE):
                self._tell_metric(along)
            if self._scribbles:
                self._lives[along].set_scribbles(self._scribbles)
        return self._lives[along]

    def use(self, metric: MetricName, strengths: Mapping[Along, float], clamp: float) -> None:
        """Compute with another metric from here on; forks that were made before keep theirs."""
        before = self.metric, self.strengths, self.clamp
        self.metric, self.strengths, self.clamp = metric, dict(strengths), clamp
        for along in self._lives:
            if (metric, strengths[along], clamp) != (before[0], before[1][along], before[2]):
                self._tell_metric(along)

    def follow(self, scribbles: Sequence[Scribble]) -> None:
        """Compute with other strokes from here on; forks that were made before keep theirs."""
        self._scribbles = [self._make_scribble(scribble) for scribble in scribbles]
        for live in self._lives.values():
            live.set_scribbles(self._scribbles)

    def _tell_metric(self, along: Along) -> None:
        self._lives[along].set_metric(self.metric, max_anisotropy=self.strengths[along], clamp_percentile=self.clamp)
