# SPDX-License-Identifier: GPL-3.0-or-later
"""One drawing session: the live wire, what is kept, undo and redo.

Knows neither Blender nor the GPU. The tool in the viewport and the headless operator drive the same session; what it
shows and what it marks is decided here and nowhere else.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum, auto
from typing import TYPE_CHECKING, Literal

import numpy as np

from .drag import Courses, Drag, Leg
from .mirror import Mirror
from .network import Network, Seed, Snap, Wire, name, net_effect, undirected

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from .live import Candidate, LiveWire, MetricName
    from .network import Along, Edge, Pick

STRENGTHS: Mapping[Along, float] = {"EDGES": 10.0, "SURFACE": 20.0}
"""The metric's largest anisotropy to begin with: how strongly wires are drawn to features; docs/method.md says why."""
CLAMP_PERCENTILE = 99.0
_STRENGTH_STEP = 1.25
_STRENGTH_RANGE = (1.0, 100.0)


class Intent(Enum):
    """What a click would do now."""

    NOTHING = auto()
    SEED = auto()
    """Begin a chain on the mesh."""
    CONTINUE = auto()
    """Begin a chain at a seed of the network."""
    BRANCH = auto()
    """Begin a chain on a wire."""
    KEEP = auto()
    """Keep the active wire and go on from its end."""
    JOIN = auto()
    """Keep the active wire, which ends on another seed or wire or on a seam, and end the chain."""
    CLOSE = auto()
    """Keep the active wire, which leads to the chain's first seed, and end the chain."""
    LOOP = auto()
    """Keep the loop that is shown."""
    RUN = auto()
    """Keep the wire that runs to the end."""
    WAIT = auto()
    """Keep a wire as soon as it is computed."""
    MOVE = auto()
    """Leave the dragged seed here."""


@dataclass(frozen=True)
class _Queued:
    """A click that came before its wire was computed."""

    kind: Literal["click", "loop", "run"]
    snap: Snap


@dataclass
class _Live:
    """The wires to what is under the cursor."""

    target: Snap | None = None
    wires: tuple[Wire | None, Wire | None] = (None, None)
    finals: tuple[bool, bool] = (True, True)
    shorter: int = 0
    loop: Wire | None = None
    loop_wanted: bool = False
    loop_final: bool = True
    end: Wire | None = None
    end_wanted: bool = False
    chosen: int | None = None

    @property
    def final(self) -> bool:
        return all(self.finals) and self.loop_final


@dataclass
class _Job:
    """A kept wire that is drawn anew between its seeds, and what to do with both courses then."""

    leg: Leg
    apply: Callable[[Wire, Courses], None] = field(repr=False)


class Session:
    """One drawing session on one mesh.

    Parameters
    ----------
    make_live
        Makes the live wires for one way of running; called once for each way that is used.
    points
        (n, 3) coordinates of the mesh's vertices.
    along
        The way to begin with.
    edges
        (e, 2) the visible edges; None: whatever two vertices a mirrored edge would have, they have an edge.
    seams
        The edges, by their vertices, that are seams already: wires that run to the end stop there.
    strength
        Largest anisotropy of the metric for each way; `make_live` is to make its live wires with the ones of
        `STRENGTHS`.
    to_object
        (3, 3) takes `points` to object coordinates, where mirroring happens; None: they are such.

    Notes
    -----
    Methods that do something return whether it was done; where it was not, `message` says why, in words for the
    artist. `revision` grows with every change of what is to be seen, `network_revision` with every change of the kept
    wires.
    """

    def __init__(
        self,
        make_live: Callable[[Along], LiveWire],
        points: NDArray[np.float64],
        along: Along = "EDGES",
        *,
        edges: NDArray[np.int32] | None = None,
        seams: ArrayLike = (),
        strength: Mapping[Along, float] | None = None,
        to_object: NDArray[np.float64] | None = None,
    ) -> None:
        self._make_live = make_live
        self._points = points
        self._mirror = Mirror(points, edges, to_object)
        self._seam_vertices = np.unique(np.asarray(seams, dtype=np.int64))
        self._strengths: dict[Along, float] = {**STRENGTHS, **(strength or {})}
        self._lives: dict[Along, LiveWire] = {}
        self._network = Network()
        self._undo: list[Network] = []
        self._redo: list[Network] = []
        self._live = _Live()
        self._drag: Drag | None = None
        self._jobs: list[_Job] = []
        self._queue: list[_Queued] = []
        self._last_click: tuple[Pick, int] | None = None
        self._progress = 1.0
        self._effect: tuple[Network, list[Edge], list[Edge]] | None = None
        self.along: Along = along
        self.metric: MetricName = "feature"
        self.marking = True
        self.message = ""
        self.revision = 0
        self.network_revision = 0
        self._engine()

    # What is there to be seen

    @property
    def network(self) -> Network:
        """The kept wires, the seed and the mirror, as they are shown; to be stored with the mesh."""
        return self._network if self._drag is None else self._drag.network

    @property
    def wires(self) -> tuple[Wire, ...]:
        """The kept wires, oldest first; those that follow a dragged seed as they run now."""
        return self.network.wires

    @property
    def seed(self) -> Pick | None:
        """Where the live wire begins; None between chains."""
        seed = self._network.seed
        if seed is None:
            return None
        return seed.vertex if self.along == "SURFACE" else seed.pick

    @property
    def seed_place(self) -> Pick | None:
        """Where that seed is shown, as `seeds` has it."""
        seed = self._network.seed
        return None if seed is None else undirected(seed.vertex if self.along == "SURFACE" else seed.place)

    @property
    def target(self) -> Snap | None:
        """What is under the cursor, or what the oldest waiting click asked for."""
        return self._live.target

    @property
    def active(self) -> Wire | None:
        """The wire that a click would keep."""
        return None if self._drag else self._live.wires[self._active_index()]

    @property
    def other(self) -> Wire | None:
        """The wire that the wheel would bring forward; None where both run along the same edges."""
        other = None if self._drag else self._live.wires[1 - self._active_index()]
        active = self.active
        if other is None or (active is not None and active.like(other)):
            return None
        return other

    @property
    def preliminary(self) -> bool:
        """Whether the active wire is still being computed: what is shown is not yet what a click would keep."""
        return self.active is not None and not self._active_final()

    @property
    def loop_preview(self) -> Wire | None:
        """The loop through the edge under the cursor, while it is asked for."""
        return self._live.loop

    @property
    def end_preview(self) -> Wire | None:
        """The live wire with its way on to the end, while it is asked for."""
        return self._live.end

    @property
    def dragging(self) -> bool:
        """Whether a seed is being moved."""
        return self._drag is not None

    @property
    def moved(self) -> tuple[Wire, ...]:
        """The wires that follow the dragged seed, as they run now."""
        return () if self._drag is None else self._drag.moved

    @property
    def dragged_seed(self) -> Pick | None:
        """The seed that is being moved, where it is now."""
        return None if self._drag is None else undirected(self._drag.place)

    @property
    def hovered_wire(self) -> Wire | None:
        """The kept wire under the cursor."""
        target = self._live.target
        return None if target is None or target.to != "WIRE" else self.network.find(target.wire)

    @property
    def hovered_seed(self) -> Pick | None:
        """The seed of the network under the cursor."""
        target = self._live.target
        return None if target is None or target.to != "SEED" else target.pick

    @property
    def closing_point(self) -> Pick | None:
        """Where the chain began, while a wire may lead back there."""
        seed = self._network.seed
        if seed is None or seed.first is None or undirected(seed.first) == undirected(seed.place):
            return None
        return seed.first if self._network.at(seed.first) else None

    @property
    def computing(self) -> bool:
        """Whether the library still works on what is shown."""
        return self._progress < 1.0 or not self._live.loop_final

    @property
    def progress(self) -> float:
        """Fraction of that work that is done."""
        return self._progress

    @property
    def waiting_clicks(self) -> int:
        """How many clicks and other deeds wait for their wires."""
        ending = self._drag is not None and self._drag.ending
        return len(self._queue) + len(self._jobs) + ending

    @property
    def can_undo(self) -> bool:
        """Whether undo() has something to take back."""
        return bool(self._queue or self._drag or self._jobs) or any(network != self._network for network in self._undo)

    @property
    def can_redo(self) -> bool:
        """Whether redo() has something to bring back."""
        return bool(self._redo)

    @property
    def strength(self) -> float:
        """How strongly wires are drawn to features: the metric's largest anisotropy, for the way they run now."""
        return self._strengths[self.along]

    def feature_strength(self) -> NDArray[np.float64] | None:
        """Return how strong the feature is at each vertex; None while that is computed."""
        return self._engine().feature_strength()

    @property
    def mirror_axes(self) -> tuple[int, ...]:
        """The axes, 0 to 2, over which wires are mirrored."""
        return self.network.mirror

    @property
    def symmetric_axes(self) -> tuple[int, ...]:
        """The axes over which the mesh is symmetric."""
        return self._mirror.symmetric_axes

    @property
    def intent(self) -> Intent:
        """What a click would do now."""
        live, seed = self._live, self._network.seed
        if self._drag is not None:
            return Intent.MOVE
        if live.end is not None:
            return Intent.RUN
        if live.loop is not None:
            return Intent.LOOP
        if live.target is None or (self.along == "SURFACE" and isinstance(live.target.pick, tuple)):
            return Intent.NOTHING
        if seed is None:
            return {"SEED": Intent.CONTINUE, "WIRE": Intent.BRANCH}.get(live.target.to, Intent.SEED)
        if self._active_final():
            return self._ending(live.target) or Intent.KEEP
        waits = self.computing and not self._at_seed(live.target.pick)
        return Intent.WAIT if waits else Intent.NOTHING

    def seeds(self) -> list[Pick]:
        """Return every seed of the network, each once, in the order they were placed."""
        seed = self.network.seed
        ends = self.network.seeds()
        if seed is not None:
            ends.append(seed.vertex if self.along == "SURFACE" else seed.place)
        return list({undirected(pick): None for pick in ends})

    def edges_to_mark(self) -> list[Edge]:
        """Return the edges that finishing will make seams, each once, sorted, smaller vertex first."""
        return self._net_effect()[0]

    def edges_to_clear(self) -> list[Edge]:
        """Return the edges that finishing will make cease to be seams, each once, sorted, smaller vertex first."""
        return self._net_effect()[1]

    def mirrored(self, wire: Wire) -> list[Wire]:
        """Return the images of a wire, kept or live, over the mirror's axes, as far as the mesh has their edges."""
        return self._mirror.images(wire, self.mirror_axes)

    # What can be done

    def hover(self, snap: Snap | Pick | None, loop: bool = False) -> None:
        """Move the free end of the live wire.

        Parameters
        ----------
        snap
            What is under the cursor; None: nothing. A pick alone stands for one on the plain mesh.
        loop
            Show the loop through it instead, where it is an edge and wires run along edges.
        """
        if self._queue:
            return
        target = None if snap is None else Snap.of(snap)
        self._aim(target)
        live = self._live
        live.loop_wanted = loop and self.along == "EDGES" and target is not None and isinstance(target.pick, tuple)
        if live.loop is not None and not (live.loop_wanted and target is not None and live.loop.start == target.pick):
            live.loop = None
            self.revision += 1
        self._preview_loop()

    def click(self, snap: Snap | Pick) -> bool:
        """Place a seed; where a wire is live, keep it and go on from there.

        On the chain's first seed this closes the chain; on another seed, a wire or a seam it joins there and ends the
        chain. While the way to the end is shown, that is kept. Before the wire is computed the click waits, see `poll`.
        """
        target = Snap.of(snap)
        if self._live.end_wanted and not self._queue:
            return self.run_to_end()
        self.drag_cancel()
        if self._network.seed is None and not self._queue:
            return self.start(target)
        self._last_click = None
        if self._queue:
            self._queue.append(_Queued("click", target))
            return True
        self._aim(target)
        if not self._active_final() and self.computing:
            self._queue.append(_Queued("click", target))
            self.revision += 1
            return True
        return self._keep(target)

    def start(self, snap: Snap | Pick) -> bool:
        """Begin a new chain, ending the one before."""
        target = Snap.of(snap)
        self._calm()
        if self.along == "SURFACE" and isinstance(target.pick, tuple):
            return self._refuse(_only_vertices(target.pick))
        network = self._joined(replace(self._network, seed=None), target)
        if not self._change(replace(network, seed=self._seed_at(network, target))):
            return False
        self._last_click = (undirected(target.pick), len(self._undo))
        return True

    def loop(self, snap: Snap | Pick) -> bool:
        """Keep the closed loop through an edge.

        A click on the same edge just before is taken back: a double click is a click first.
        """
        target = Snap.of(snap)
        edge = target.pick
        if self.along != "EDGES" or not isinstance(edge, tuple):
            return self._refuse("Loops are taken along edges: double-click on an edge")
        self.drag_cancel()
        if (
            self._queue
            and self._queue[-1].kind == "click"
            and undirected(self._queue[-1].snap.pick) == undirected(edge)
        ):
            self._queue.pop()
        elif self._last_click == (undirected(edge), len(self._undo)):
            self._restore(self._undo.pop())
        self._last_click = None
        last = self.wires[-1] if self.wires else None
        if last is not None and last.closed and undirected(edge) in last.edges():
            return True  # the first click of the two took it already
        wire = self._find_loop(edge)
        if wire is None:
            if self.computing:
                self._queue.append(_Queued("loop", target))
                self.revision += 1
                return True
            return self._refuse(f"No closed loop of edges runs through {name(edge)}")
        return self._change(replace(self._network, wires=(*self.wires, replace(wire, marks=self.marking))))

    def end_chain(self) -> None:
        """Let go of the live wire, or of a dragged seed; the kept wires stay."""
        self._calm()
        if self._network.seed is None:
            return
        # No step of its own for undo: taking back the last wire after this brings the chain back to life.
        self._set(replace(self._network, seed=None))
        self._live.chosen = None
        self._aim(self._live.target, again=True)

    def close(self) -> bool:
        """Lead the live wire back to the chain's first seed, keep it and end the chain."""
        first = self.closing_point
        if first is None:
            return self._refuse("There is no chain to close: draw a wire first")
        self._live.end_wanted = False
        return self.click(Snap(first, "SEED"))

    def toggle(self) -> bool:
        """Make the other of the two wires the active one, until it is kept."""
        if self.other is None:
            same = all(self._live.finals) and self.active is not None
            return self._refuse("Both wires run along the same edges here" if same else "There is no other wire yet")
        self._live.chosen = 1 - self._active_index()
        self.message = ""
        self._preview_end()
        self.revision += 1
        return True

    def toggle_kept(self, wire: Wire) -> bool:
        """Let a kept wire take its other way, that of the other metric."""
        self._calm()
        own = self._network.find(wire)
        if own is None:
            return self._refuse("This wire is not there any more")
        if own.closed:
            return self._refuse("A loop has no other way")
        if own.alternative is not None:
            return self._take_other_way(own, own.alternative)
        return self._redraw(own, self._toggle_when_computed)

    def drop(self, wire: Wire) -> bool:
        """Remove a kept wire."""
        self._calm()
        own = self._network.find(wire)
        if own is None:
            return self._refuse("This wire is not there any more")
        return self._change(self._network.without(own))

    def insert(self, wire: Wire, pick: Pick) -> bool:
        """Put a seed into a kept wire, which makes two wires of it; a loop is cut opposite to the seed as well."""
        self._calm()
        network = self._network.with_seed_in(wire, pick, self._points)
        if network is None:
            return self._refuse(f"No seed can be put into the wire at {name(pick)}")
        return self._change(network)

    def drag(self, snap: Snap | Pick) -> bool:
        """Take hold of a seed of the network; `drag_to` moves it, and its wires with it.

        On a wire (``Snap.to == "WIRE"``) a seed is put there first, in one step for undo with the move.
        """
        target = Snap.of(snap)
        self._calm()
        network = self._network
        if target.to == "WIRE":
            network = self._joined(network, target)
        seed = network.seed
        if not network.at(target.pick) and (seed is None or undirected(seed.place) != undirected(target.pick)):
            return self._refuse(f"There is no seed to move at {name(target.pick)}")
        try:
            self._drag = Drag(network, target.pick, self._fork, self._points)
        except ValueError as error:
            return self._refuse(str(error))
        self._read_progress()
        self._live.loop = self._live.end = None
        self._live.end_wanted = False
        self.message = ""
        self.revision += 1
        return True

    def drag_to(self, snap: Snap | Pick | None) -> bool:
        """Move the dragged seed; its wires follow as soon as they are computed. None: over nothing, it stays."""
        drag = self._drag
        if drag is None:
            return self._refuse("No seed is being moved")
        if snap is None or drag.ending:
            return False
        before = (drag.target, drag.network, self.message)
        self._live.target = Snap.of(snap)
        moved = drag.to(Snap.of(snap))
        self._read_progress()
        self.message = drag.message
        self.revision += before != (drag.target, drag.network, self.message)
        return moved

    def drag_end(self) -> bool:
        """Leave the dragged seed where it is, as soon as its wires are computed; one step for undo."""
        drag = self._drag
        if drag is None:
            return self._refuse("No seed is being moved")
        if not drag.final:
            drag.ending = True
            return True
        self._drag = None
        self.revision += 1
        if drag.message or drag.target is None:
            why = drag.message
            self._aim(self._live.target, again=True)
            return self._refuse(why) if why else True
        network = drag.network
        if drag.target.to == "WIRE":
            network = self._joined(network, drag.target)
        return self._change(network)

    def drag_cancel(self) -> bool:
        """Let the dragged seed go back to where it was."""
        if self._drag is None:
            return False
        self._drag = None
        self._aim(self._live.target, again=True)
        self.revision += 1
        return True

    def run_to_end(self, preview: bool = False) -> bool:
        """Let the live wire run straight on until it meets a seam, a wire, the boundary, the mirror or itself.

        Parameters
        ----------
        preview
            Show it, for wherever the cursor goes; a click, or this without `preview`, keeps it. `stop_preview` ends that.
        """
        if self._network.seed is None:
            return self._refuse("Nothing runs on: place a seed first")
        if self.along == "SURFACE":
            return self._refuse("Wires run on along edges, not across the surface")
        self.drag_cancel()
        live = self._live
        if preview:
            live.end_wanted = True
            self._preview_end()
            return live.end is not None or self.computing or self._refuse(self.message or _NOWHERE)
        if self._queue or (live.target is not None and not self._active_final() and self.computing):
            if live.target is None:
                return self._refuse(_NOWHERE)
            live.end_wanted = False
            self._queue.append(_Queued("run", live.target))
            self.revision += 1
            return True
        wire = self._find_end()
        if wire is None:
            return self._refuse(self.message or _NOWHERE)
        live.end_wanted = False
        return self._change(replace(self._network, wires=(*self.wires, wire), seed=None))

    def stop_preview(self) -> bool:
        """Stop showing the way to the end."""
        live = self._live
        if not live.end_wanted:
            return False
        live.end_wanted, live.end = False, None
        self.revision += 1
        return True

    def switch(self, along: Along) -> bool:
        """Run wires along edges or across the surface from here on; kept wires stay as they are."""
        if along == self.along:
            return True
        self._calm()
        before = self.along
        self.along = along
        self._live = _Live(target=self._live.target)
        if self._network.seed is not None and not self._sow(self._network.seed):
            self.along = before
            return False
        self._engine()
        self.message = ""
        self._aim(self._live.target, again=True)
        self.revision += 1
        return True

    def toggle_marking(self) -> bool:
        """Let the wires that are kept from here on clear seams instead of marking them, or mark again."""
        self.marking = not self.marking
        self.message = ""
        self.revision += 1
        return True

    def change_strength(self, steps: int) -> bool:
        """Draw wires more or less strongly to features, a quarter a step; kept wires stay as they are."""
        low, high = _STRENGTH_RANGE
        strength = min(max(self.strength * _STRENGTH_STEP**steps, low), high)
        if strength == self.strength:
            return self._refuse(
                f"The strength is {strength:g} already, the {'most' if steps > 0 else 'least'} there is"
            )
        return self._use_metric(self.metric, {**self._strengths, self.along: strength})

    def set_strength(self, along: Along, strength: float) -> bool:
        """Draw wires that run one way so strongly to features; kept wires stay as they are."""
        low, high = _STRENGTH_RANGE
        strength = min(max(strength, low), high)
        # What comes from Blender's properties is of single precision.
        if abs(strength - self._strengths[along]) <= 1e-4 * strength:
            return True
        return self._use_metric(self.metric, {**self._strengths, along: strength})

    def set_metric(self, metric: MetricName) -> bool:
        """Draw wires by another metric; kept wires stay as they are."""
        return metric == self.metric or self._use_metric(metric, self._strengths)

    def set_mirror(self, axes: Iterable[int]) -> bool:
        """Mirror all wires over axes, 0 to 2; none: not at all."""
        mirror = tuple(sorted(set(axes)))
        if mirror == self._network.mirror:
            return True
        self._calm()
        network = replace(self._network, mirror=mirror)
        if self._undo or self._redo:
            return self._change(network)
        # Nothing was drawn: this is how drawing begins, and no step of it.
        self._set(network)
        return True

    def resume(self, network: Network) -> bool:
        """Go on with a stored network; its lost wires are drawn anew between their seeds, as far as they can be."""
        self._calm()
        return self._change(network) and all([self._redraw(wire, self._add_when_computed) for wire in network.lost])

    def undo(self) -> bool:
        """Take back the last step: a wire, a loop, a seed, a move, whatever was done; first what still waits."""
        if self._queue:
            self._queue.pop()
            self.revision += 1
            return True
        toggles = [job for job in self._jobs if job.apply == self._toggle_when_computed]
        if self.drag_cancel():
            return True
        if toggles:
            self._jobs.remove(toggles[-1])
            self.revision += 1
            return True
        while self._undo:
            network = self._undo.pop()
            if network != self._network:
                self._redo.append(self._network)
                self._restore(network)
                return True
        return self._refuse("Nothing to undo in this drawing")

    def redo(self) -> bool:
        """Bring back what undo took."""
        self.drag_cancel()
        if not self._redo:
            return self._refuse("Nothing to redo in this drawing")
        self._undo.append(self._network)
        self._restore(self._redo.pop())
        return True

    def poll(self) -> bool:
        """Take in what the library has computed since, and do the clicks that waited for it.

        Returns
        -------
        bool
            Whether there is something new to be seen.
        """
        drag = self._drag
        idle = self._live.final and not self._queue and not self._jobs and (drag is None or drag.final)
        if not self.computing and idle:
            return False
        before = (self.revision, round(self._progress, 2))
        self._read_progress()
        self._poll_jobs()
        if drag is not None and not drag.final and drag.target is not None:
            self._poll_drag(drag)
        while self._queue and self._poll_queue():
            pass
        if not self._queue and not all(self._live.finals):
            self._aim(self._live.target, again=True)
        self._preview_loop()
        self._preview_end()
        return before != (self.revision, round(self._progress, 2))

    def wait(self) -> None:
        """Wait until everything is computed and every waiting click is done."""
        while True:
            for live in self._working():
                live.wait()
            self.poll()
            if not self._queue and not self._jobs and not self.computing:
                return

    # How it is done: the library

    def _engine(self, along: Along | None = None) -> LiveWire:
        way = along or self.along
        if way not in self._lives:
            self._lives[way] = self._make_live(way)
            if self.metric != "feature" or self._strengths[way] != STRENGTHS[way]:
                self._set_metric(self._lives[way], way)
        self._read_progress()
        return self._lives[way]

    def _set_metric(self, live: LiveWire, along: Along) -> None:
        live.set_metric(self.metric, max_anisotropy=self._strengths[along], clamp_percentile=CLAMP_PERCENTILE)

    def _fork(self, along: Along) -> LiveWire:
        return self._engine(along).fork()

    def _working(self) -> list[LiveWire]:
        legs = [*(job.leg for job in self._jobs), *(self._drag.legs if self._drag else ())]
        return [self._lives[self.along], *(leg.live for leg in legs)]

    def _read_progress(self) -> None:
        if self.along in self._lives:
            self._progress = min(live.progress() for live in self._working())

    def _use_metric(self, metric: MetricName, strengths: dict[Along, float]) -> bool:
        if self._drag is not None:
            return self._refuse("Leave the seed first, then change what draws the wires")
        before = self.metric, self._strengths
        self.metric, self._strengths = metric, strengths
        for along, live in self._lives.items():
            if metric != before[0] or strengths[along] != before[1][along]:
                self._set_metric(live, along)
        self.message = ""
        self._live.loop = None
        self._aim(self._live.target, again=True)
        self._preview_loop()
        self.revision += 1
        return True

    def _sow(self, seed: Seed) -> bool:
        """Start the wires of a seed; on refusal the wires are those of the seed before."""
        engine = self._engine()
        try:
            if self.along == "SURFACE":
                engine.seed(seed.vertex)
            else:
                engine.seed(seed.pick, forward=seed.forward)
        except ValueError as error:
            if self._network.seed is not None and self._network.seed != seed:
                self._sow(self._network.seed)
            return self._refuse(str(error))
        self._read_progress()
        return True

    # How it is done: steps

    def _refuse(self, why: str) -> bool:
        self.message = why
        self.revision += 1
        return False

    def _calm(self) -> None:
        """Let go of all that is under way but the live wire."""
        self._queue.clear()
        self._last_click = None
        self.drag_cancel()
        self.stop_preview()

    def _set(self, network: Network) -> None:
        before, self._network = self._network, network
        self.revision += 1
        self.network_revision += before.wires != network.wires or before.mirror != network.mirror

    def _change(self, network: Network) -> bool:
        """Go on to a new network, with a step for undo."""
        seed = network.seed
        if seed is not None and seed != self._network.seed and not self._sow(seed):
            return False
        self._undo.append(self._network)
        self._redo.clear()
        self._set(network)
        self._settle()
        return True

    def _restore(self, network: Network) -> None:
        if network.seed is not None and network.seed != self._network.seed:
            self._sow(network.seed)
        self._set(network)
        self._last_click = None
        self._settle()

    def _settle(self) -> None:
        live = self._live
        live.chosen = None
        live.loop = live.end = None
        live.end_wanted = False
        self.message = ""
        self._aim(live.target, again=True)

    def _net_effect(self) -> tuple[list[Edge], list[Edge]]:
        network = self.network
        if self._effect is None or self._effect[0] is not network:
            claims = (
                (edge, wire.marks)
                for wire in network.wires
                for image in (wire, *self.mirrored(wire))
                for edge in image.edges()
            )
            self._effect = (network, *net_effect(claims))
        return self._effect[1:]

    def _joined(self, network: Network, target: Snap) -> Network:
        """Return the network with a seed where a wire is met; at its ends there is one."""
        if target.to != "WIRE" or target.wire is None:
            return network
        own = network.find(target.wire)
        if own is None or own.closed:
            return network
        return network.with_seed_in(own, target.pick, self._points) or network

    def _seed_at(self, network: Network, target: Snap) -> Seed:
        """Return the seed of a chain that begins at a target; where one wire ends there, the chain goes on from it."""
        pick = target.pick
        wires = network.at(pick) if target.to == "SEED" else []
        if len(wires) != 1 or self.along == "SURFACE" or wires[0][0].along == "SURFACE":
            return Seed(pick)
        wire, end = wires[0]
        edge = wire.last_edge if end == "end" else (wire.vertices[1], wire.vertices[0])
        return Seed(edge, forward=True, clicked=pick)

    # How it is done: the live wire

    def _active_index(self) -> int:
        live = self._live
        index = live.shorter if live.chosen is None else live.chosen
        # While one wire is computed and the other is not, show the one there is.
        return index if live.wires[index] is not None or live.wires[1 - index] is None else 1 - index

    def _active_final(self) -> bool:
        return self.active is not None and self._live.finals[self._active_index()]

    def _ending(self, target: Snap) -> Intent | None:
        """Return how a wire to a target ends the chain; None: it does not."""
        first = self.closing_point
        if target.to == "SEED" and first is not None and undirected(first) == undirected(target.pick):
            return Intent.CLOSE
        return Intent.JOIN if target.to in {"SEED", "WIRE", "SEAM"} else None

    def _keep(self, target: Snap) -> bool:
        wire = self.active
        if wire is None:
            if self._at_seed(target.pick):
                return self._refuse("The wire ends where it begins: click somewhere else")
            return self._refuse(self.message or f"No wire reaches {name(target.pick)}")
        ending = self._ending(target)
        if ending is Intent.CLOSE and {edge for own in self.wires for edge in own.edges()}.issuperset(wire.edges()):
            return self._refuse("The way back runs along the chain itself: place another seed first")
        other = self.other
        wire = replace(
            wire, marks=self.marking, strength=self.strength, alternative=other if all(self._live.finals) else None
        )
        network = self._joined(self._network, target)
        seed = None
        if ending is None:
            before = self._network.seed
            first = None if before is None else before.began
            seed = Seed(target.pick, first=first)
            if self.along == "EDGES":
                seed = Seed(wire.last_edge, forward=True, clicked=target.pick, first=first)
        if not self._change(replace(network, wires=(*network.wires, wire), seed=seed)):
            return False
        self._last_click = (undirected(target.pick), len(self._undo))
        return True

    def _aim(self, target: Snap | None, again: bool = False) -> None:
        """Find both wires to a target; `again`: also where it is the same as before."""
        live = self._live
        if target == live.target and not again and live.final:
            return
        before = (live.target, live.shorter, live.finals, [id(wire) for wire in live.wires], self.message)
        live.target = target
        self._find_wires(target)
        after = (live.target, live.shorter, live.finals, [id(wire) for wire in live.wires], self.message)
        # Asking again while nothing is ready shows nothing new, and must not cost a redraw each time.
        self.revision += before != after
        self._preview_end()

    def _find_wires(self, target: Snap | None) -> None:
        live = self._live
        seed = self._network.seed
        live.wires, live.finals = (None, None), (True, True)
        self.message = ""
        self._read_progress()
        if seed is None or target is None or self._drag is not None or self._at_seed(target.pick):
            return
        if self.along == "SURFACE" and isinstance(target.pick, tuple):
            self.message = _only_vertices(target.pick)
            return
        goal = self._goal(target)
        try:
            found = self._engine().wires(goal[0])
        except ValueError as error:
            self.message = str(error)
            return
        live.finals = (found.wires[0].final, found.wires[1].final)
        live.shorter = found.shorter
        one, two = (self._wire(found.wires[index], index, target.pick, goal[1]) for index in (0, 1))
        live.wires = (one, two)
        if all(live.finals) and live.wires == (None, None):
            self.message = f"No wire reaches {name(target.pick)}"

    def _goal(self, target: Snap) -> tuple[Pick, int | None]:
        """Return where the wires to a target lead, and a vertex where they may end before."""
        if self.along == "EDGES" and isinstance(target.pick, tuple) and self._ending(target) is Intent.CLOSE:
            # The chain left its first edge over one end: the wire that closes it arrives at the other.
            for wire, end in self._network.at(target.pick):
                if end == "start" and wire.heading is None:
                    return wire.vertices[0], wire.vertices[1]
        return target.pick, None

    def _at_seed(self, pick: Pick) -> bool:
        seed = self._network.seed
        return seed is not None and (
            undirected(pick) in (undirected(self.seed), undirected(seed.place))
            or (seed.forward and pick == seed.vertex)
        )

    def _wire(self, candidate: Candidate, follow: int, target: Pick, avoid: int | None) -> Wire | None:
        seed = self._network.seed
        vertices = tuple(int(v) for v in candidate.vertices)
        if seed is None or len(vertices) < 2:
            return None
        if self.along == "SURFACE":
            if len(candidate.points) < 2:
                return None
            points = np.array(candidate.points, dtype=np.float64)
            return Wire("SURFACE", vertices, points, seed.vertex, target, follow=follow)
        if seed.forward:
            vertices = vertices[1:]  # the edge before the seed belongs to the wire before
        if avoid in vertices:
            vertices = vertices[: vertices.index(avoid) + 1]
        if len(vertices) < 2:
            return None
        heading = seed.pick if seed.forward and isinstance(seed.pick, tuple) else None
        points = self._points[list(vertices)]
        return Wire("EDGES", vertices, points, seed.place, target, heading=heading, follow=follow)

    # How it is done: loops and ends

    def _find_loop(self, edge: Pick) -> Wire | None:
        live = self._live
        live.loop_final = True
        if not isinstance(edge, tuple):
            return None
        try:
            found = self._engine().loop(edge)
        except ValueError as error:
            self.message = str(error)
            return None
        live.loop_final = found.final
        vertices = tuple(int(v) for v in found.vertices)
        if not found.final or len(vertices) < 3:
            return None
        return Wire(
            "EDGES", vertices, self._points[[*vertices, vertices[0]]], edge, edge, closed=True, strength=self.strength
        )

    def _preview_loop(self) -> None:
        live = self._live
        if not live.loop_wanted and not any(queued.kind == "loop" for queued in self._queue):
            live.loop_final = True
        if live.loop_wanted and live.loop is None and live.target is not None:
            live.loop = self._find_loop(live.target.pick)
            self.revision += live.loop is not None

    def _preview_end(self) -> None:
        live = self._live
        if not live.end_wanted:
            return
        before, live.end = live.end, self._find_end()
        same = before is not None and live.end is not None and before.like(live.end)
        self.revision += before is not live.end and not same

    def _find_end(self) -> Wire | None:
        """Return the live wire with its way on; None where there is no way, or no direction yet."""
        seed, active = self._network.seed, self.active
        if seed is None:
            return None
        if active is not None:
            edge = active.last_edge
        elif seed.forward and isinstance(seed.pick, tuple):
            edge = seed.pick
        else:
            self.message = "Point where the wire is to run"
            return None
        try:
            way = tuple(int(v) for v in self._engine().run_on(edge, self._stops(edge[1])).vertices)
        except ValueError as error:
            self.message = str(error)
            return None
        if len(way) < 2:
            return None
        vertices = way if active is None else active.vertices + way[1:]
        heading = active.heading if active is not None else edge
        return Wire(
            "EDGES",
            vertices,
            self._points[list(vertices)],
            seed.place,
            vertices[-1],
            marks=self.marking,
            heading=heading,
            strength=self.strength,
        )

    def _stops(self, begin: int) -> list[int]:
        """Return the vertices where a wire that runs on from one ends."""
        stops = set(self._seam_vertices.tolist())
        for wire in (*self.wires, *([self.active] if self.active else [])):
            stops.update(wire.vertices)
            for image in self.mirrored(wire):
                stops.update(image.vertices)
        plane = self._mirror.on_plane(self.mirror_axes)
        if begin not in plane:
            stops |= plane
        return sorted(stops - {begin})

    # How it is done: kept wires that take another course

    def _redraw(self, wire: Wire, apply: Callable[[Wire, Courses], None]) -> bool:
        """Draw a kept wire anew between its seeds, as soon as it is computed."""
        try:
            self._jobs.append(_Job(Leg(self._fork(wire.along), self._network, wire, "end", self._points), apply))
        except ValueError as error:
            return self._refuse(str(error))
        self._read_progress()
        self._poll_jobs()
        return not self.message

    def _poll_jobs(self) -> None:
        for job in list(self._jobs):
            wire = job.leg.wire
            try:
                courses = job.leg.trace(wire.end, wire.end)
            except ValueError as error:
                self._jobs.remove(job)
                self._refuse(str(error))
                continue
            if courses.final:
                self._jobs.remove(job)
                job.apply(wire, courses)

    def _toggle_when_computed(self, wire: Wire, courses: Courses) -> None:
        own = self._network.find(wire)
        if own is None:
            return  # it was dropped in the meantime
        others = [way for way in courses.ways if way is not None and not way.like(own)]
        if not others:
            self._refuse("Both wires run along the same edges here")
        else:
            self._take_other_way(own, others[-1] if own.follow == 0 else others[0])

    def _take_other_way(self, own: Wire, other: Wire) -> bool:
        after = self._network.after(own)
        if after is not None and isinstance(own.end, tuple) and other.last_edge == own.last_edge[::-1]:
            # What goes on from the edge leaves it over this vertex: arriving there is enough.
            other = replace(other, vertices=other.vertices[:-1], points=other.points[:-1])
            if len(other.vertices) < 2:
                return self._refuse("There is no other way to this seed")
        return self._change(self._network.with_courses({own.id: replace(own, alternative=other).toggled()}))

    def _add_when_computed(self, wire: Wire, courses: Courses) -> None:
        found = courses.following(courses.shorter)

        def with_it(network: Network) -> Network:
            if wire not in network.lost:
                return network
            lost = tuple(one for one in network.lost if one is not wire)
            return replace(network, lost=lost, wires=(*network.wires, *([found] if found else [])))

        # Part of what resume() did, and of all that was done since: no step of its own.
        self._undo = [with_it(network) for network in self._undo]
        self._redo = [with_it(network) for network in self._redo]
        self._set(with_it(self._network))
        self._aim(self._live.target, again=True)
        if found is None:
            self._refuse(f"A stored wire could not be drawn again: none reaches {name(wire.end)}")

    # How it is done: what waits

    def _poll_drag(self, drag: Drag) -> None:
        assert drag.target is not None
        before = drag.network
        drag.to(drag.target)
        self.message = drag.message
        self.revision += drag.network is not before
        if drag.final and drag.ending:
            self.drag_end()

    def _poll_queue(self) -> bool:
        """Do the oldest waiting click if its wire is there; returns whether it was done."""
        head = self._queue[0]
        self._aim(head.snap, again=True)
        blocked = self._find_loop(head.snap.pick) is None if head.kind == "loop" else not self._active_final()
        if blocked and self.computing:
            return False
        del self._queue[0]
        rest, self._queue = self._queue, []
        if head.kind == "run":
            self.run_to_end()
        elif head.kind == "loop":
            self.loop(head.snap)
        else:
            self.click(head.snap)
        self._queue += rest
        return True


_NOWHERE = "The wire cannot run on from here"


def _only_vertices(edge: Pick) -> str:
    return f"Across the surface wires begin and end at vertices, not at {name(edge)}"
