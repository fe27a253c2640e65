# SPDX-License-Identifier: GPL-3.0-or-later
"""Live wires that are made on a thread: at a million faces that takes most of a second, and nothing is to wait for it."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Generic, Protocol, TypeVar

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .live import Candidates, Chain, LiveWire, Loop, MetricName, Strip
    from .network import Edge, Pick

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
