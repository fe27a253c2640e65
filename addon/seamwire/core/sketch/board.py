# SPDX-License-Identifier: GPL-3.0-or-later
"""What there is of a sketch: the network, its courses and wires, the mesh and the settings. Interactions know only this."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING
from weakref import proxy

import numpy as np

from ...terms.choices import DEFAULT_FINISH
from ...terms.options import Options
from ..base import native
from ..network.drawn import Drawn
from ..network.network import Given, How, Network, Sought, Way, linked
from ..network.picks import undirected
from ..network.stops import Stops
from ..network.strokes import Stroke, for_library
from ..network.symmetry import MirrorImages, Symmetry
from ..offers.edge_loops import AMOUNTS
from ..seams.seam_wires import seam_chains, waiting, wires_along
from ..solver.solver import Engines
from .courses import Course, Courses
from .ways import Begin, Ground, heading_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import ArrayLike, NDArray
    from seamwire_core import PartFinder

    from ...terms.choices import Along
    from ..network.network import Request
    from ..network.picks import Pick
    from ..network.wires import Wire
    from ..solver.solver import LiveWire


class Board:
    """The network of one object, with its courses and the wires that are derived from both.

    Only `Sketch` changes it.

    Parameters
    ----------
    make_live
        Makes the live wires for one way of running. Called once for each way that is used, and once for closed cuts.
    points
        (n, 3) coordinates of the mesh's vertices.
    edges
        (e, 2) the visible edges.
    triangles
        (m, 3) the triangles that the surface was made of.
    seams
        (k, 2) the edges that are seams but no wires. Wires that run straight on end there.
    to_object
        (3, 3) takes `points` to object coordinates, where mirroring happens. If None, they are object coordinates.
    topology
        Whether mirrored vertices are found by the connections of the mesh, see `Symmetry`.
    make_parts
        Makes the library's finder of parts: of the axis over which parts come in pairs, the seams, and a function that is told the
        progress and returns whether to go on. If None, there are no parts.

    Attributes
    ----------
    reason
        Why something is not done, until the cursor points at something else.
    reports
        What happened that the artist may not have seen. It is told when the chain ends.
    revision, network_revision
        Grow with every change of the picture, and of the drawn wires.
    progress
        The finished fraction of the running work.
    begin
        Where wires begin now; None between chains.
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
        self.points, self.edges, self.triangles = points, edges, triangles
        self.options = options
        self._make_parts = make_parts
        self._finder: tuple[bytes, PartFinder] | None = None
        self.symmetry = Symmetry(points, edges, to_object, topology, triangles)
        self.images = MirrorImages(self.symmetry)
        self.stops = Stops(seams, self.symmetry)
        self.engines = Engines(make_live, make_stroke)
        self.engines.use(options.metric, options.strengths, options.clamp)
        self.network = Network()
        self.courses = Courses()
        own = proxy(self)
        self.ground = Ground(
            points, self.stops, lambda: own.network, lambda: own.drawn, lambda number: own.wire(number)
        )
        self.progress = 0.0
        self.reason: str = ""
        self.reports: list[str] = []
        self.new_report: str = ""
        self.revision = self.network_revision = 0
        self.drawn = Drawn(mirror=options.mirror)
        self.begin: Begin | None = None
        self._derived: dict[Wire, tuple[object, Wire]] = {}
        self._completed: dict[Wire, Wire] = {}

    @property
    def base(self) -> Network:
        """The network that edits begin with: where the wires of a line or a loop are known, they are separate requests."""
        new = {}
        for own in self.network.requests:
            if isinstance(own, Sought) and (course := self.courses.of(own)).final:
                first, *rest = linked(course.wires) or (None,)
                new[own.id] = () if first is None else (replace(first, goes_on=own.goes_on or first.goes_on), *rest)
        return self.network.replacing(new) if new else self.network

    def wire(self, id: int) -> Wire | None:
        """Return the wire with a number, as it runs now; of a request with several wires the last one."""
        own = self.network.find(id)
        if own is not None and not isinstance(own, (Given, Way)):
            wires = self.courses.of(own).wires
            return wires[-1] if wires else None
        return next((wire for wire in self.drawn.wires if wire.id == id), None)

    def wire_of(self, own: Request) -> Wire | None:
        return own.wire if isinstance(own, Given) else self.wire(own.id)

    def is_final(self, own: Request) -> bool:
        return self.courses.of(own).final

    def how(self, along: str) -> How:
        options = self.options
        finish = options.finish if along == "SURFACE" and options.marking else DEFAULT_FINISH
        return How(options.marking, self.options.mirror, self.engines.strengths[along], finish)

    def draw(self) -> None:
        found = self.courses.follow(self.network.requests)
        last = {own.id: course.wires[-1] for own, course in found if course.wires}
        drawn: list[Wire] = []
        for own, course in found:
            on = None if own.goes_on is None else last.get(own.goes_on[0])
            for row, wire in enumerate(course.wires):
                made_of = row, on, own.goes_on
                known = self._derived.get(wire)
                if known is None or known[0] != made_of:
                    known = self._derived[wire] = made_of, self._complete(wire, row, own, on)
                drawn.append(known[1])
        before, self.drawn = self.drawn, Drawn(tuple(drawn), self.network.strokes, self.options.mirror)
        changed = before.wires != self.drawn.wires or before.mirror != self.drawn.mirror
        self.network_revision += changed
        self.revision += 1
        if not changed and before == self.drawn:
            self.drawn = before
        self.find_begin()

    def _complete(self, wire: Wire, row: int, own: Request, on: Wire | None) -> Wire:
        """Return a wire of a request with its images. The first one heads on from the wire that the request goes `on` from."""
        if row == 0 and wire.along == "EDGES":
            heading = None if on is None or own.goes_on is None else heading_of(on, own.goes_on[1], own.start)
            wire = wire if heading == wire.heading else wire.changed(heading=heading)
        if wire not in self._completed:
            self._completed[wire] = self.images.completed(wire) if wire.images is None else wire
        return self._completed[wire]

    def find_begin(self) -> None:
        seed = self.network.seed
        self.begin = None
        if seed is not None:
            self.begin = Begin.of(seed.pick, self.options.along, self.ground.heading(seed.after, seed.pick))

    @property
    def seed(self) -> Pick | None:
        return None if self.begin is None else self.begin.pick

    @property
    def seed_place(self) -> Pick | None:
        """The place where the live wire's seed is shown; None between chains."""
        seed = self.network.seed
        if seed is None:
            return None
        return undirected(seed.pick if self.options.along == "EDGES" else self.seed)

    def seeds(self) -> list[Pick]:
        ends = [
            pick
            for own in self.network.requests
            for wire in self.courses.of(own).wires or (own,)
            if not wire.closed
            for pick in (wire.start, wire.end)
        ]
        live = self.seed_place
        return list({undirected(pick): None for pick in (*ends, *(() if live is None else (live,)))})

    @property
    def seams(self) -> NDArray[np.int32]:
        """The edges, (k, 2), that are seams, or will be because of the wires and their images. Sorted, the smaller vertex first."""
        marked = [edge for wire in self.drawn.wires if wire.marks for edge in wire.claims()]
        known = np.sort(np.concatenate([self.stops.seams, np.array(marked, dtype=np.int32).reshape(-1, 2)]), axis=1)
        return np.unique(known, axis=0)

    def mirrored(self, wire: Wire, curves: bool = False) -> list[Wire]:
        """Return the images that a wire has, or would have if it were kept now; see `Symmetry.images`."""
        return self.images.of(wire, self.drawn, curves)

    def feature_strength(self) -> NDArray[np.float64] | None:
        return self.engines.get(self.options.along).feature_strength()

    def wires_along(self, seams: NDArray[np.int32]) -> Iterator[Wire]:
        """Yield wires that run along seams, (k, 2), as few as possible. None of them is kept.

        Raises ValueError if an edge is not part of the surface.
        """
        live = self.engines.get("EDGES").fork()
        for chain in seam_chains(seams):
            yield from waiting(live, wires_along(live, chain, self.points, self.engines.strengths["EDGES"]))

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
        self.reason = why
        self.revision += 1
        return False

    def tell(self, what: str) -> None:
        self.new_report = what
        self.reports.append(self.new_report)
        self.revision += 1

    def go_to(self, network: Network) -> None:
        before, self.network = self.network, network
        if before.strokes != network.strokes:
            self.engines.follow(network.strokes)
        self.draw()

    def warn_of_triangles(self, along: Along) -> None:
        warning = self.engines.warning(along)
        if warning:
            self.tell(warning)

    def warn_of_images(self, course: Course) -> None:
        for wire in course.wires:
            warning = self.images.warning(wire)
            if warning:
                self.tell(warning)
