# SPDX-License-Identifier: GPL-3.0-or-later
"""What a drawing session is made of, and what is to be seen of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum, auto
from typing import TYPE_CHECKING, Literal

import numpy as np

from .candidates import CandidateWires
from .edge_loops import LoopOffers
from .extension import Extension
from .history import History
from .mirror_images import MirrorImages
from .network import Network, Snap, Wire, undirected
from .retrace import Retraces
from .solver import Engines
from .stops import Stops
from .strokes import for_library
from .symmetry import Symmetry

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from .network import Along, Edge, LoopKind, Pick
    from .seed_drag import SeedDrag
    from .solver import LiveWire, MetricName
    from .strokes import Scribble


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
class Queued:
    """A click that came before its wire was computed."""

    kind: Literal["click", "loop", "run", "offer"]
    snap: Snap


class State:
    """One drawing session on one mesh, to look at; `session.Session` is what draws.

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
        The edges, by their vertices, that are seams and no wires: wires that run straight on end there.
    strength
        Largest anisotropy of the metric for each way; `make_live` is to make its live wires with the ones of
        `STRENGTHS`.
    to_object
        (3, 3) takes `points` to object coordinates, where mirroring happens; None: they are such.
    triangles
        (m, 3) those that the surface was made of; None: strokes run through vertices only.
    make_scribble
        Makes of a stroke what the live wires take.
    topology
        Whether what is mirrored to what is found by how the mesh hangs together, see `Symmetry`.

    Notes
    -----
    `revision` grows with every change of what is to be seen, `network_revision` with every change of the kept wires.
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
        triangles: NDArray[np.int32] | None = None,
        make_scribble: Callable[[Scribble], object] = for_library,
        topology: bool = False,
    ) -> None:
        self._points = points
        self._triangles = triangles
        self._symmetry = Symmetry(points, edges, to_object, topology, triangles)
        self._images = MirrorImages(self._symmetry)
        self._stops = Stops(seams, self._symmetry)
        self._engines = Engines(make_live, strength or {}, make_scribble)
        self._network = Network()
        self._history = History()
        self._candidates = CandidateWires(self._engines, points)
        self._loops = LoopOffers(self._engines, self._stops, points)
        self._extension = Extension(self._engines, self._stops, points)
        self._drag: SeedDrag | None = None
        self._retraces = Retraces(self._engines, points)
        self._queue: list[Queued] = []
        self._last_click: tuple[Pick, int] | None = None
        # Made at once: what they compute first takes longest.
        self._progress = self._engines.get(along).progress()
        self.along: Along = along
        self.marking = True
        self.message = ""
        self.revision = 0
        self.network_revision = 0

    # What is there to be seen

    @property
    def network(self) -> Network:
        """The kept wires, the seed and the mirror, as they are shown; to be stored with the mesh."""
        return self._network if self._drag is None else self._drag.network

    @property
    def kept(self) -> Network:
        """The same without what is being dragged."""
        return self._network

    @property
    def wires(self) -> tuple[Wire, ...]:
        """The kept wires, oldest first; those that follow a dragged seed as they run now."""
        return self.network.wires

    @property
    def seed(self) -> Pick | None:
        """Where the live wire begins; None between chains."""
        seed = self._network.seed
        return None if seed is None else seed.begins(self.along)

    @property
    def seed_place(self) -> Pick | None:
        """Where that seed is shown, as `seeds` has it."""
        seed = self._network.seed
        return None if seed is None else undirected(seed.shown(self.along))

    @property
    def target(self) -> Snap | None:
        """What is under the cursor, or what the oldest waiting click asked for."""
        return self._candidates.target

    @property
    def active(self) -> Wire | None:
        """The wire that a click would keep."""
        return self._candidates.active

    @property
    def other(self) -> Wire | None:
        """The wire that the wheel would bring forward; None where both run along the same edges."""
        return self._candidates.other

    @property
    def preliminary(self) -> bool:
        """Whether the active wire is still being computed: what is shown is not yet what a click would keep."""
        return self.active is not None and not self._candidates.active_final

    @property
    def loop_preview(self) -> Wire | None:
        """What a click on the edge under the cursor takes as a whole, while that is asked for."""
        return self._loops.wire

    @property
    def loop_offers(self) -> tuple[LoopKind, ...]:
        """What such a click may take, each once, the default first: `toggle` goes from one to the next."""
        return self._loops.kinds

    @property
    def loop_choice(self) -> LoopKind | None:
        """Which of them `loop_preview` is."""
        return None if self._loops.wire is None else self._loops.wire.kind

    @property
    def end_preview(self) -> Wire | None:
        """The live wire with its way on to the end, while it is asked for."""
        return self._extension.wire

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
        target = self._candidates.target
        return None if target is None or target.to != "WIRE" else self.network.find(target.wire)

    @property
    def hovered_seed(self) -> Pick | None:
        """The seed of the network under the cursor."""
        target = self._candidates.target
        return None if target is None or target.to != "SEED" else target.pick

    @property
    def closing_point(self) -> Pick | None:
        """Where the chain began, while a wire may lead back there."""
        return self._network.closing_point

    @property
    def computing(self) -> bool:
        """Whether the library still works on what is shown."""
        return self._progress < 1.0 or not self._loops.final

    @property
    def _wires_computing(self) -> bool:
        """Whether it works on wires: a loop that waits behind a click must not keep that waiting."""
        return self._progress < 1.0

    @property
    def progress(self) -> float:
        """Fraction of that work that is done."""
        return self._progress

    @property
    def waiting_clicks(self) -> int:
        """How many clicks and other deeds wait for their wires."""
        ending = self._drag is not None and self._drag.ending
        return len(self._queue) + len(self._retraces) + ending

    @property
    def can_undo(self) -> bool:
        """Whether undo() has something to take back."""
        return bool(self._queue or self._drag or self._retraces) or self._history.can_undo(self._network)

    @property
    def can_redo(self) -> bool:
        """Whether redo() has something to bring back."""
        return self._history.can_redo

    @property
    def strength(self) -> float:
        """How strongly wires are drawn to features: the metric's largest anisotropy, for the way they run now."""
        return self._engines.strengths[self.along]

    def feature_strength(self) -> NDArray[np.float64] | None:
        """Return how strong the feature is at each vertex; None while that is computed."""
        return self._engines.get(self.along).feature_strength()

    @property
    def clamp(self) -> float:
        """The percentile of feature strengths that counts as the strongest: single noisy vertices are not to decide."""
        return self._engines.clamp

    @property
    def metric(self) -> MetricName:
        """What draws wires to features."""
        return self._engines.metric

    @property
    def scribbles(self) -> tuple[Scribble, ...]:
        """The strokes that live wires follow or keep from, oldest first."""
        return self.network.scribbles

    @property
    def mirror_axes(self) -> tuple[int, ...]:
        """The axes, 0 to 2, over which wires are mirrored."""
        return self.network.mirror

    @property
    def symmetric_axes(self) -> tuple[int, ...]:
        """The axes over which the mesh is symmetric."""
        return self._symmetry.symmetric_axes

    @property
    def intent(self) -> Intent:
        """What a click would do now."""
        live, seed = self._candidates, self._network.seed
        if self._drag is not None:
            return Intent.MOVE
        if self._extension.wire is not None:
            return Intent.RUN
        if self._loops.wire is not None:
            return Intent.LOOP
        if live.target is None or (self.along == "SURFACE" and isinstance(live.target.pick, tuple)):
            return Intent.NOTHING
        if seed is None:
            return {"SEED": Intent.CONTINUE, "WIRE": Intent.BRANCH}.get(live.target.to, Intent.SEED)
        if live.active_final:
            return self._ending(live.target) or Intent.KEEP
        waits = self.computing and not seed.at(live.target.pick, self.along)
        return Intent.WAIT if waits else Intent.NOTHING

    def seeds(self) -> list[Pick]:
        """Return every seed of the network, each once, in the order they were placed."""
        seed = self.network.seed
        ends = self.network.seeds()
        if seed is not None:
            ends.append(seed.shown(self.along))
        return list({undirected(pick): None for pick in ends})

    def edges_to_mark(self) -> list[Edge]:
        """Return the edges that the wires make seams, each once, sorted, smaller vertex first."""
        return self._images.net_effect(self.network)[0]

    def edges_to_clear(self) -> list[Edge]:
        """Return the edges that the wires make cease to be seams, each once, sorted, smaller vertex first."""
        return self._images.net_effect(self.network)[1]

    def mirrored(self, wire: Wire) -> list[Wire]:
        """Return the images that a wire has, or would have if it were kept now, as far as the mesh has their edges."""
        return self._images.of(wire, self.network)

    # For the deeds

    def _ending(self, target: Snap) -> Intent | None:
        """Return how a wire to a target ends the chain; None: it does not."""
        if self._network.closes(target):
            return Intent.CLOSE
        return Intent.JOIN if target.to in {"SEED", "WIRE", "SEAM"} else None
