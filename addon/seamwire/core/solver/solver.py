# SPDX-License-Identifier: GPL-3.0-or-later
"""What computes wires: the library's live wires, one for each way of running, with the metric they share."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Literal, TypeVar

from ...terms.choices import KINDS, METRICS, Kind, MetricName
from ...terms.options import CLAMP_PERCENTILE, STRENGTHS
from ..base import native
from ..base.refused import Refused
from ..network.picks import FacePoint
from ..network.wires import FOLLOWS

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    import numpy as np
    import seamwire_core
    from numpy.typing import NDArray

    from ...terms.choices import Along
    from ..base.mesh_arrays import Arrays
    from ..network.picks import Pick
    from ..network.strokes import Stroke

    LiveWire = seamwire_core.LiveWire
    Candidate = seamwire_core.LiveCandidate
    Candidates = seamwire_core.LiveWires
    ClosedCut = seamwire_core.LiveClosedWire

_KINDS: tuple[Kind, ...] = tuple(KINDS)


def kinds_of(metric: MetricName) -> tuple[Kind, ...]:
    """Return what the wires of a metric follow, by `Wire.follow`."""
    return METRICS[metric].follows


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


End = int | tuple[int, int] | tuple[int, tuple[float, float, float]]
"""A vertex, an edge by its two vertices, or a triangle and barycentric coordinates in it."""


def for_live(pick: Pick, along: Along) -> End:
    """Return a pick as live wires take it that run one way: along edges, of a point inside a triangle, its nearest vertex."""
    if not isinstance(pick, FacePoint):
        return pick
    return pick.vertex if along == "EDGES" else (pick.triangle, pick.weights)


MOST_WAITS = 50
"""So often in a row the library may say that all its work is done although an answer is not final."""
_SLICE = 0.005
"""Seconds of one wait."""
_SURFACE_SLICE = 0.05
"""Seconds of one wait for a surface: less than an artist notices."""


Answer = TypeVar("Answer")


def final(live: LiveWire, ask: Callable[[], Answer]) -> Answer:
    """Ask live wires again and again, and return the answer that is final.

    Raises Refused if all work is done and the answer is still not final.
    """
    done = 0
    while not (found := ask()).final:
        done = done + 1 if live.wait(_SLICE) else 0
        if done > MOST_WAITS:
            raise Refused("The computation ended without a result: this step was dropped")
    return found


class Engines:
    """Live wires, each made when it is first asked for, with its way's strength of `STRENGTHS` and `CLAMP_PERCENTILE`.

    `make_stroke` makes of a stroke what the live wires take.
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
        if along not in self._lives:
            self._lives[along] = self._make(along)
            if (self.metric, self.strengths[along], self.clamp) != ("feature", STRENGTHS[along], CLAMP_PERCENTILE):
                self._tell_metric(along)
            if self._strokes:
                self._lives[along].set_scribbles(self._library_strokes(self.metric))
        return self._lives[along]

    def hand_over(self, along: Along) -> LiveWire:
        """Return the live wires of one way for somebody who goes on with them as they are. `get` returns others from here on."""
        live = self.get(along)
        self._lives[along] = live.fork()
        return live

    def fork(self, which: Along | Literal["CUTS"]) -> Engines:
        """Return engines that have other live wires of one kind, and keep their metric and strokes."""
        own = Engines(self._make, self._make_stroke)
        own.metric, own.strengths, own.clamp = self.metric, dict(self.strengths), self.clamp
        own._strokes, own._made = self._strokes, dict(self._made)
        if which == "CUTS":
            own._cuts = self.cuts().fork()
        else:
            own._lives[which] = self.get(which).fork()
        return own

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

    def warning(self, along: Along) -> str:
        """Return a message if wires must lead around invalid triangles. Empty if not, or if it was returned before."""
        reports = (report for report in self.get(along).embeddings() if report is not None)
        count = max((report.invalid_left for report in reports), default=0)
        if count <= self._told:
            return ""
        self._told = count
        found, them = ("1 triangle", "it") if count == 1 else (f"{count} triangles", "them")
        return f"{found} could not be made valid: wires go around {them}"

    def _tell_cuts(self) -> None:
        if self._cuts is not None:
            self._cuts.set_metric("concave", max_anisotropy=self.strengths["SURFACE"])

    def _tell_metric(self, along: Along) -> None:
        self._lives[along].set_metric(self.metric, max_anisotropy=self.strengths[along], clamp_percentile=self.clamp)


class LiveMaker:
    """Makes the library's live wires on a mesh. They share one surface, which they build in their own threads.

    The mesh has `points`, `triangles` and `edges`. Finding parts also needs the edges that are `marked`.
    """

    def __init__(self, mesh: Arrays) -> None:
        self._core = native.load()
        self._mesh = mesh
        self._first: seamwire_core.LiveWire | None = None

    def __call__(self, along: Along) -> LiveWire:
        if self._first is not None:
            return self._first.sibling(**_options(along))
        mesh = self._mesh
        self._first = self._core.LiveWire(mesh.points, mesh.triangles, mesh.edges, **_options(along))
        return self._first

    def wait(self, progress: Callable[[float], bool] = lambda _fraction: True) -> seamwire_core.Surface:
        """Wait for the surface, once there are live wires, and return it; any thread may.

        Raises ValueError if wires cannot run on the mesh, and `seamwire_core.Cancelled` where `progress` returns False.
        """
        assert self._first is not None
        while not self._first.wait_for_surface(_SURFACE_SLICE):
            if not progress(0.0):
                raise self._core.Cancelled
        return self._first.surface

    def part_finder(
        self, mirror: int | None, seams: NDArray[np.int32], progress: Callable[[float], bool]
    ) -> seamwire_core.PartFinder:
        """Return a finder of parts by rims. Each face of a box is a part. It waits for the surface.

        Parts come in pairs over the axis `mirror`, if there is one. The seams, (k, 2), part the mesh already. `seamwire_core.Cancelled` is
        raised where `progress` returns False.
        """
        return self._core.PartFinder(
            self.wait(progress), nets=False, mirror=mirror, marked=self._mesh.marked, seams=seams, progress=progress
        )

    def face_segments(
        self, cuts: NDArray[np.int32], progress: Callable[[float], bool] = lambda _fraction: True
    ) -> NDArray[np.int32]:
        """Return the island of each triangle where edges are cut; it waits for the surface as `wait` does."""
        return self._core.face_segments(self.wait(progress), cuts)

    def missing_cuts(self, cuts: NDArray[np.int32], islands: NDArray[np.int32]) -> NDArray[np.int32]:
        """Return how many more cuts each island needs before it can lie flat; it waits for the surface."""
        return self._core.missing_cuts(self.wait(), cuts, islands)


def _options(along: Along) -> dict[str, object]:
    return {"along": along.lower(), "max_anisotropy": STRENGTHS[along], "clamp_percentile": CLAMP_PERCENTILE}
