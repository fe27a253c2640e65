# SPDX-License-Identifier: GPL-3.0-or-later
"""The network that is drawn, with the mesh, the settings, and the engines that compute wires."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ...terms.choices import DEFAULT_FINISH
from ...terms.options import Options
from ..base import native
from ..network.network import History, Network
from ..network.picks import undirected
from ..network.stops import Stops
from ..network.strokes import for_library
from ..network.symmetry import MirrorImages, Symmetry
from ..offers.part_search import AMOUNTS
from ..seams.seam_wires import seam_chains, waiting, wires_along
from ..solver.solver import Engines

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import ArrayLike, NDArray
    from seamwire_core import PartFinder

    from ...terms.choices import Along
    from ..network.picks import Pick
    from ..network.strokes import Stroke
    from ..network.wires import Wire
    from ..solver.solver import LiveWire


class Drawing:
    """The state that all gestures of a session share.

    Parameters
    ----------
    make_live
        Makes the live wires for one way of running; called once for each way that is used, and once for closed cuts.
    points
        (n, 3) coordinates of the mesh's vertices.
    edges
        (e, 2) the visible edges.
    triangles
        (m, 3) the triangles that the surface was made of.
    seams
        (k, 2) the edges that are seams but no wires: wires that run straight on end there.
    to_object
        (3, 3) takes `points` to object coordinates, where mirroring happens. If None, they are object coordinates.
    topology
        Whether mirrored vertices are found by the connections of the mesh, see `Symmetry`.
    make_parts
        Makes the library's finder of parts: of the axis over which parts come in pairs, the seams, and a function that is told the
        progress and returns whether to go on. If None, there are no parts.

    Attributes
    ----------
    message
        The reason why something is not done, until the cursor points at something else.
    warning
        A warning about the last step, until the next one. It is shown where there is no `message`.
    failure
        The reason why a gesture that waited was not done, until the next gesture.
    revision, network_revision
        Grow with every change of the picture, and of the kept wires.
    progress
        The finished fraction of the running work. `Cursor.read_progress` reads it before wires are asked for.
    """

    def __init__(
        self,
        make_live: Callable[[Along], LiveWire],
        points: NDArray[np.float64],
        options: Options = Options(),  # noqa: B008 - it cannot be changed
        *,
        edges: NDArray[np.int32],
        triangles: NDArray[np.int32],
        seams: ArrayLike = (),
        to_object: NDArray[np.float64] | None = None,
        make_stroke: Callable[[Stroke], object] = for_library,
        topology: bool = False,
        make_parts: Callable[[int | None, NDArray[np.int32], Callable[[float], bool]], PartFinder] | None = None,
    ) -> None:
        self.points = points
        self.edges = edges
        self.triangles = triangles
        self.options = options
        self._make_parts = make_parts
        self._finder: tuple[bytes, PartFinder] | None = None
        self.symmetry = Symmetry(points, edges, to_object, topology, triangles)
        self.images = MirrorImages(self.symmetry)
        self.stops = Stops(seams, self.symmetry)
        self.engines = Engines(make_live, make_stroke)
        self.engines.use(options.metric, options.strengths, options.clamp)
        self.network = Network(mirror=options.mirror)
        self.history = History()
        self.progress = 0.0
        self.message: str = ""
        self.warning: str = ""
        self.failure: str = ""
        self.revision = 0
        self.network_revision = 0

    @property
    def told(self) -> str:
        """The message or warning that the artist sees now."""
        return self.message or self.warning

    @property
    def strength(self) -> float:
        """How strongly wires follow the shape now: the metric's largest anisotropy."""
        return self.engines.strengths[self.options.along]

    @property
    def seed_place(self) -> Pick | None:
        """The place where the live wire's seed is shown; None between chains."""
        seed = self.network.seed
        return None if seed is None else undirected(seed.shown(self.options.along))

    def as_drawn(self, wire: Wire, like: Wire | None = None) -> Wire:
        """Return a wire with the settings of a new one, or, except the strength, with those of the kept wire that it replaces."""
        if like is not None:
            return replace(wire, marks=like.marks, mirror=like.mirror, strength=self.strength, finish=like.finish)
        return replace(
            wire,
            marks=self.options.marking,
            mirror=self.network.mirror,
            strength=self.strength,
            finish=self.options.finish if wire.along == "SURFACE" and self.options.marking else DEFAULT_FINISH,
        )

    def with_wires(self, *wires: Wire) -> Network:
        """Return the network with more wires."""
        return replace(self.network, wires=(*self.network.wires, *wires))

    def seeds(self, network: Network) -> list[Pick]:
        """Return every seed of a network, each once, in the order they were placed."""
        ends = network.seeds()
        if network.seed is not None:
            ends.append(network.seed.shown(self.options.along))
        return list({undirected(pick): None for pick in ends})

    def wires_along(self, seams: NDArray[np.int32]) -> Iterator[Wire]:
        """Yield wires that run along seams, (k, 2), as few as possible. None of them is kept.

        Raises ValueError if an edge is not part of the surface.
        """
        live = self.engines.get("EDGES").fork()
        for chain in seam_chains(seams):
            yield from waiting(live, wires_along(live, chain, self.points, self.engines.strengths["EDGES"]))

    def feature_strength(self) -> NDArray[np.float64] | None:
        """Return the feature strength of each vertex, (n,), or None while it is computed."""
        return self.engines.get(self.options.along).feature_strength()

    @property
    def seams(self) -> NDArray[np.int32]:
        """The edges, (k, 2), that are seams, or will be because of the kept wires and their images. Sorted, the smaller vertex first."""
        drawn = [edge for wire in self.network.wires if wire.marks for edge in wire.claims()]
        known = np.sort(np.concatenate([self.stops.seams, np.array(drawn, dtype=np.int32).reshape(-1, 2)]), axis=1)
        return np.unique(known, axis=0)

    def find_parts(self, seams: NDArray[np.int32], goes_on: Callable[[], bool]) -> Iterator[NDArray[np.int32]]:
        """Yield the part of each triangle, (m,), for each of `AMOUNTS`, while `goes_on()`; nothing if there are no parts. Any thread may.

        `seams`, (k, 2), part the mesh already. The next search with the same seams uses the measurements of a search that was stopped.
        """
        if self._make_parts is None:
            return

        def progress(_: float) -> bool:
            return goes_on()

        with suppress(native.load().Cancelled):
            if self._finder is None or self._finder[0] != seams.tobytes():
                axes = self.symmetry.symmetric_axes
                preferred = [axis for axis in self.options.mirror if axis in axes]
                axis = next(iter((*preferred, *axes)), None)
                self._finder = seams.tobytes(), self._make_parts(axis, seams, progress)
            for amount in AMOUNTS:
                yield self._finder[1].find(amount, progress=progress).of_face

    def refuse(self, why: str) -> bool:
        """Tell why something is not done."""
        self.message = why
        self.revision += 1
        return False

    def set(self, network: Network) -> None:
        """Go on to a network, without a step for undo."""
        before, self.network = self.network, network
        if before.strokes != network.strokes:
            self.engines.follow(network.strokes)
        self.revision += 1
        self.network_revision += before.wires != network.wires or before.mirror != network.mirror
