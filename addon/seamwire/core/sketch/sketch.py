# SPDX-License-Identifier: GPL-3.0-or-later
"""A sketch: what the artist draws on one object. The tool in the viewport and the headless operators drive the same sketch."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from ...terms.choices import DEFAULT_FINISH
from ...terms.options import Options
from ..base import native
from ..base.refused import Refused
from ..network.network import Drawn
from ..network.picks import undirected
from ..network.stops import Stops
from ..network.strokes import Stroke, drawn, for_library, through_vertices
from ..network.symmetry import MirrorImages, Symmetry
from ..network.wires import FOLLOWS
from ..offers.part_borders import AMOUNTS
from ..seams.seam_wires import seam_chains, waiting, wires_along
from ..solver.solver import MOST_WAITS, Engines
from .courses import Course, Courses
from .dragging import Dragging
from .interaction import Begun, Edit, Interaction
from .lining import Lining
from .network import Given, History, How, Key, Network, Snap, Way, linked
from .offering import Offering
from .paint import paint
from .ways import Ground, WaySearch, heading_of
from .wiring import Wiring

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import ArrayLike, NDArray
    from seamwire_core import PartFinder

    from ...terms.choices import Along
    from ..fields.crests import Crests
    from ..network.picks import Edge, Pick
    from ..network.strokes import ActsOn
    from ..network.wires import Wire
    from ..solver.solver import LiveWire
    from .network import Request
    from .picture import Picture

    Kind = TypeVar("Kind", bound=Interaction)


class Sketch:
    """The network with its history, the courses, and the one interaction.

    A method that changes something returns whether that was done. If not, `reason` says why.

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
        self.network = Network(mirror=options.mirror)
        self.history = History()
        self.courses = Courses()
        self.ground = Ground(points, self.stops, lambda: self.network, lambda: self.drawn, self.wire)
        self.progress = 0.0
        self.reason: str = ""
        self.reports: list[str] = []
        self._new_report: str = ""
        self.revision = self.network_revision = 0
        self.drawn = Drawn(mirror=options.mirror)
        self._completed: dict[Wire, Wire] = {}
        self.wiring = Wiring(self)
        self.offering = Offering(self)
        self.interaction: Interaction = self.wiring
        self._last_click: tuple[Pick, int] | None = (
            None  # the pick of the last step, if that was a click, and the number of steps then
        )
        self._picture: tuple[object, Picture] | None = None
        # The live wires are made now, because what they compute first takes longest.
        self._read_progress()

    # What there is

    @property
    def wires(self) -> tuple[Wire, ...]:
        """The wires as they are shown now, oldest first."""
        return self.shown.wires

    @property
    def base(self) -> Network:
        """The network that edits begin with: where the wires of a line or a loop are known, they are separate requests."""
        new = {}
        for own in self.network.requests:
            course = self.courses.of(own)
            if course.final and not isinstance(own, (Given, Way)):
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
        """Return the wire of a request that may not be in the network yet."""
        return own.wire if isinstance(own, Given) else self.wire(own.id)

    def is_final(self, own: Request) -> bool:
        return self.courses.of(own).final

    def how(self, along: str) -> How:
        """Return the settings of a new wire."""
        options = self.options
        finish = options.finish if along == "SURFACE" and options.marking else DEFAULT_FINISH
        return How(options.marking, self.network.mirror, self.engines.strengths[along], finish)

    def _draw(self) -> None:
        """Derive the wires from the network and the courses."""
        found = {own: self.courses.of(own).wires for own in self.network.requests}
        last = {own.id: wires[-1] for own, wires in found.items() if wires}
        drawn: list[Wire] = []
        for own, wires in found.items():
            for row, wire in enumerate(wires):
                if row == 0 and wire.along == "EDGES":
                    before = None if own.goes_on is None else last.get(own.goes_on[0])
                    heading = None if before is None else heading_of(before, own.goes_on[1], own.start)
                    wire = wire if heading == wire.heading else self._with_heading(wire, heading)
                drawn.append(self._with_images(wire))
        before, self.drawn = self.drawn, Drawn(tuple(drawn), self.network.strokes, self.network.mirror)
        changed = before.wires != self.drawn.wires or before.mirror != self.drawn.mirror
        self.network_revision += changed
        self.revision += 1
        if not changed and before == self.drawn:
            self.drawn = before

    def _with_heading(self, wire: Wire, heading: Edge | None) -> Wire:
        known = self._completed.get(wire)
        if known is None or known.heading != heading:
            known = self._completed[wire] = wire.changed(heading=heading)
        return known

    def _with_images(self, wire: Wire) -> Wire:
        if wire.images is not None:
            return wire
        if wire not in self._completed:
            self._completed[wire] = self.images.completed(wire)
        return self._completed[wire]

    @property
    def seed(self) -> Pick | None:
        """The beginning of the live wire; None between chains."""
        begin = self.wiring.begin()
        return None if begin is None else begin.pick

    @property
    def seed_place(self) -> Pick | None:
        """The place where the live wire's seed is shown; None between chains."""
        seed = self.network.seed
        if seed is None:
            return None
        return undirected(seed.pick if self.options.along == "EDGES" else self.seed)

    def seeds(self) -> list[Pick]:
        """Return every seed, each once, in the order they were placed."""
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

    def edges_to_mark(self) -> list[Edge]:
        """Return the edges that the wires make seams, each once, sorted, smaller vertex first."""
        return self.images.net_effect(self.shown)[0]

    def edges_to_clear(self) -> list[Edge]:
        """Return the edges that the wires clear of seams, each once, sorted, smaller vertex first."""
        return self.images.net_effect(self.shown)[1]

    @property
    def shown(self) -> Drawn:
        """The drawn wires, with those that follow a dragged seed where they are now."""
        drag = self.holds(Dragging)
        return self.drawn if drag is None else drag.shown

    @property
    def moved(self) -> tuple[frozenset[int], frozenset[Pick]]:
        """The numbers of the wires that follow a dragged seed, and their ends. The cursor does not find them."""
        drag = self.holds(Dragging)
        return (frozenset(), frozenset()) if drag is None else (frozenset(drag.ids), drag.ends)

    def mirrored(self, wire: Wire, curves: bool = False) -> list[Wire]:
        """Return the images that a wire has, or would have if it were kept now; see `Symmetry.images`."""
        return self.images.of(wire, self.drawn, curves)

    def feature_strength(self) -> NDArray[np.float64] | None:
        """Return the feature strength of each vertex, (n,), or None while it is computed."""
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

    @property
    def picture(self) -> Picture:
        """Everything that is to be seen now."""
        key = (self.revision, self.told, self.computing, self.progress, self.waiting)
        if self._picture is None or self._picture[0] != key:
            self._picture = key, paint(self)
        return self._picture[1]

    @property
    def told(self) -> str:
        """The reason or the new report that the artist sees now."""
        return self.reason or self._new_report

    # Work

    def holds(self, kind: type[Kind]) -> Kind | None:
        """Return the interaction if it is of a kind, otherwise None."""
        return self.interaction if isinstance(self.interaction, kind) else None

    @property
    def is_held(self) -> bool:
        """Whether a button holds a seed or a line."""
        return self.interaction not in (self.wiring, self.offering)

    @property
    def waiting(self) -> int:
        """The number of requests whose courses are not final."""
        return len(self.courses.unfinished(self.network))

    @property
    def computing(self) -> bool:
        """Whether the library still works on the picture."""
        return self.progress < 1.0 or not self.interaction.is_final or self.waiting > 0

    def _lives(self) -> list[LiveWire]:
        return [self.engines.get(self.options.along), *self.interaction.lives(), *self.courses.lives(self.network)]

    def _read_progress(self) -> None:
        """Read how much is computed. Wires that are not final after all work is done stay so, so this comes before asking."""
        self.progress = min(live.progress() for live in self._lives())

    def poll(self) -> bool:
        """Take in what the library has computed, and return whether the picture has changed."""
        if not self.computing and self.holds(Lining) is None:
            return False
        before = (self.revision, round(self.progress, 2))
        self._read_progress()
        done, is_new = self.courses.poll(self.network)
        if done or is_new:
            self._draw()
        for own in done:
            self._told_of(own)
        self._poll_interaction()
        return before != (self.revision, round(self.progress, 2))

    def _told_of(self, own: Request) -> None:
        course = self.courses.of(own)
        if course.reason:
            self.tell(course.reason)
        elif isinstance(own, Way):
            self._warn_of_triangles(own.along)
            self._warn_of_images(course)

    def _poll_interaction(self) -> None:
        own = self.interaction
        before = own.reason
        self.revision += own.poll()
        if own.reason != before:
            self.reason = own.reason
            self.revision += 1

    def wait(self) -> None:
        """Wait until everything is computed. What never comes to a result stays as it is drawn, and the report says so."""
        rounds, before = 0, None
        while rounds < MOST_WAITS:
            for live in self._lives():
                try:
                    live.wait()
                except ValueError as error:  # what it is to compute cannot be computed
                    self.refuse(str(error))
            self.offering.edges.wait()
            self.poll()
            if not self.computing:
                return
            now = (*map(id, self.courses.unfinished(self.network)), self.progress)
            rounds, before = (rounds + 1 if now == before else 0), now
        unfinished = self.courses.unfinished(self.network)
        if unfinished:
            why = self.reason or "The computation ended without a result: this step was dropped"
            self.courses.give_up(unfinished, why)
            self.tell(why)
            self._draw()

    # Edits

    def refuse(self, why: str) -> bool:
        """Tell why something is not done."""
        self.reason = why
        self.revision += 1
        return False

    def tell(self, what: str) -> None:
        """Report something that happened."""
        self._new_report = what
        self.reports.append(self._new_report)
        self.revision += 1

    def _do(self, find: Callable[[], Edit | None]) -> bool:
        """Go on to the network of an edit, unless it is refused."""
        self._new_report = ""
        try:
            edit = find()
        except ValueError as error:
            self._look_again()
            return self.refuse(str(error))
        return edit is None or self.edit(edit)

    def edit(self, edit: Edit) -> bool:
        """Go on to a network, with a step for undo."""
        before = self.network
        for request, course, search in edit.begun:
            self.courses.begin(request, course, search)
        for own in edit.network.requests:
            if isinstance(own, Way) and not self.courses.knows(own):  # a part of a wire that is not final
                shown = () if own.was is None else (own.was,)
                self.courses.begin(own, Course(shown), WaySearch(own, self.ground, self.engines.get(own.along).fork()))
        try:
            self._go_to(edit.network)
            self.wiring.sow()
        except ValueError as error:
            self._go_to(before)
            return self.refuse(str(error))
        self.history.step(before)
        self._settle()
        self.wiring.chosen = edit.chosen
        if edit.report:
            self.tell(edit.report)
        for begun in edit.begun:
            if begun.course.final and isinstance(begun.request, Way):
                self._told_of(begun.request)
        return True

    def _go_to(self, network: Network) -> None:
        """Go on to a network, without a step for undo."""
        before, self.network = self.network, network
        if before.strokes != network.strokes:
            self.engines.follow(network.strokes)
        self._draw()

    def _settle(self) -> None:
        """Let the interactions follow a new network."""
        self.wiring.chosen = None
        self.wiring.runs = False
        self.offering.offers.clear()
        self.reason = ""
        self._look_again()

    def _look_again(self) -> None:
        """Find what is under the cursor once more: it may be another wire now."""
        self._read_progress()
        self.wiring.aim(self.wiring.target)
        self.reason = self.wiring.reason
        self.revision += 1

    def _warn_of_triangles(self, along: Along) -> None:
        warning = self.engines.warning(along)
        if warning:
            self.tell(warning)

    def _warn_of_images(self, course: Course) -> None:
        for wire in course.wires:
            warning = self.images.warning(wire)
            if warning:
                self.tell(warning)

    # At the cursor

    @property
    def target(self) -> Snap | None:
        """The pick under the cursor."""
        return self.interaction.target

    def hover(self, snap: Snap | Pick | None, loop: bool = False, bend: bool = False) -> None:
        """Move the free end of the live wire to a pick, or to nothing. A pick alone stands for a snap on the plain mesh.

        Parameters
        ----------
        loop
            Whether to show the loop through it instead: along edges through an edge, across the surface through a point.
        bend
            Whether to show the last closed cut, bent to it; across the surface only.
        """
        if self.is_held:
            return
        target = None if snap is None else Snap.of(snap)
        bend = bend and self.options.along == "SURFACE"
        is_offering = loop or bend
        own: Interaction = self.offering if is_offering else self.wiring
        same = own is self.interaction and self.wiring.is_aimed_at(target) and self.wiring.is_final
        if same and not is_offering:
            return
        self._read_progress()
        before = self.wiring.shown, self.reason, self.interaction
        vanish = self.offering.hover(target, loop, bend)
        self.interaction = own
        if is_offering:
            self.wiring.target = target
        else:
            self.wiring.aim(target)
        self.reason = own.reason
        self.revision += vanish or before != (self.wiring.shown, self.reason, own)

    def next_candidate(self) -> bool:
        """Show the next candidate, or the next offer if offers are shown. Return whether there is one."""
        own = self.offering if self.interaction is self.offering else self.wiring
        try:
            own.advance()
        except ValueError as error:
            return self.refuse(str(error))
        self.reason = own.reason
        self.revision += 1
        return True

    def use_crests(self, crests: Crests | None, first: bool) -> None:
        """Offer wires along the mesh's ridges and valleys: as the `first` of what a click offers, or as the last."""
        before = self.offering.reason
        self.revision += self.offering.use_crests(crests, first)
        if self.interaction is self.offering and self.offering.reason != before:
            self.reason = self.offering.reason

    def stop_preview(self) -> bool:
        """Hide the way to the end. Return whether it was shown."""
        was, self.wiring.runs, self.wiring.extended = self.wiring.runs, False, None
        self.revision += was
        return was

    def cancel(self) -> bool:
        """Let go of what a button holds: a dragged seed goes back, and a line vanishes. Return whether something was held."""
        was = self.is_held
        if was:
            self.interaction = self.wiring
            if self.engines.computes != self.options.computes:
                self._compute_anew()
            self._look_again()
        return was

    # Clicks

    def click(self, snap: Snap | Pick) -> bool:
        """Place a seed; if a wire is live, keep it and go on from there.

        On the chain's first seed this closes the chain. On another seed, a wire or a seam, the chain joins it and ends.
        While the way to the end or a loop is shown, that is kept.
        """
        target = Snap.of(snap)
        self.cancel()
        if self.wiring.runs:
            return self.run_to_end()
        if self.interaction is self.offering and self.offering.takes(target):
            return self.bend(target) if self.offering.bends else self.loop(target)
        self.interaction = self.wiring
        self._last_click = None
        if not self._do(lambda: self.wiring.click(target)):
            return False
        self._last_click = undirected(target.pick), self.history.steps
        return True

    def start(self, snap: Snap | Pick) -> bool:
        """Begin a new chain, which ends the one before."""
        target = Snap.of(snap)
        self._calm()
        if not self._do(lambda: self.wiring.start(target)):
            return False
        self._last_click = undirected(target.pick), self.history.steps
        return True

    def loop(self, snap: Snap | Pick) -> bool:
        """Keep the offer that is shown for a pick, otherwise the first one.

        A click on the same edge just before is taken back, because a double click is a click first.
        """
        target = Snap.of(snap)
        try:
            self.offering.check(target)
        except Refused as error:
            return self.refuse(str(error))
        self.cancel()
        if self.options.along == "EDGES":
            if self.offering.is_crest_taken(target.pick):
                return True  # the first press of a double click took the ridge
            self._take_back_click(target.pick)
        return self._do(lambda: self.offering.take(target)) and self._warned()

    def bend(self, snap: Snap | Pick) -> bool:
        """Bend the last closed cut to a point."""
        target = Snap.of(snap)
        self.cancel()
        self._last_click = None
        return self._do(lambda: self.offering.bend_to(target)) and self._warned()

    def _warned(self) -> bool:
        newest = self.network.requests[-1] if self.network.requests else None
        if newest is not None and self.is_final(newest):
            self._warn_of_images(self.courses.of(newest))
        return True

    def close(self, seen_along: tuple[float, float, float] | None = None) -> bool:
        """Lead the live wire back to the chain's first seed, and keep it. `seen_along` is that of `Snap`."""
        first = self.network.closing_point
        if first is None:
            return self.refuse("No chain to close: draw a wire first")
        self.stop_preview()
        return self.click(Snap(first, "SEED", seen_along=seen_along))

    def run_to_end(self, preview: bool = False) -> bool:
        """Let the live wire run straight on until it meets a seam, a wire, the boundary, the mirror or itself.

        A `preview` only shows it, wherever the cursor goes. A click keeps it, and `stop_preview` hides it.
        """
        if self.network.seed is None:
            return self.refuse("Nothing to extend: place a seed first")
        if self.options.along == "SURFACE":
            return self.refuse("Extend to End works along edges, not across the surface")
        self.cancel()
        self.interaction = self.wiring
        if not preview:
            self._last_click = None
            return self._do(self.wiring.run_to_end)
        self.wiring.runs = True
        self._look_again()
        return (
            self.wiring.extended is not None
            or not self.wiring.is_final
            or self.refuse(self.reason or "The wire cannot be extended from here")
        )

    def end_chain(self) -> None:
        """Let go of the live wire, or of a held seed. The kept wires stay."""
        self._calm()
        if self.network.seed is None:
            return
        # This is not a step for undo. Undoing the last wire afterwards makes the chain live again.
        self._go_to(replace(self.network, seed=None))
        self._settle()

    def _calm(self) -> None:
        """Drop what is held or previewed, and stop looking for loops."""
        self.offering.edges.stop_search()
        self._last_click = None
        self.stop_preview()
        self.cancel()

    # Kept wires

    def retrace(self, wire: Wire) -> bool:
        """Let a kept wire take its next way: that of another metric, or the next offer of the click that took it."""
        self._calm()
        return self._do(lambda: self._retraced(wire))

    def _retraced(self, wire: Wire) -> Edit:
        network = self.base
        own, drawn = network.find(wire.id), self.drawn.find(wire)
        if own is None or drawn is None:
            raise Refused("This wire no longer exists")
        if drawn.through is not None:
            return self.offering.next_offer(drawn)
        if own.closed:
            raise Refused("A loop has no other path")
        course = self.courses.of(own)
        if isinstance(own, Way):
            way = replace(own, turns=own.turns + 1, was=own.was if own.turns else drawn, key=Key())
        else:
            uncut = drawn.uncut()
            way = Way(
                along=uncut.along,
                start=uncut.start,
                end=uncut.end,
                goes_on=own.goes_on if uncut.along == own.along else None,
                how=How.like(uncut),
                follow=uncut.follow,
                turns=1,
                was=uncut,
                id=own.id,
            )
        search = WaySearch(way, self.ground, self.engines.get(way.along).fork())
        begun = Begun(way, search.turned(course.choices) if course.choices else Course(course.wires), search)
        return Edit(network.replacing({own.id: (way,)}), (begun,))

    def drop(self, wire: Wire) -> bool:
        """Remove a kept wire."""
        self._calm()
        network = self.base
        own = network.find(wire.id) or next(
            (each for each in network.requests if any(one.id == wire.id for one in self.courses.of(each).wires)), None
        )
        if own is None:
            return self.refuse("This wire no longer exists")
        return self._do(lambda: Edit(network.without(own.id)))

    def drag(self, snap: Snap | Pick) -> bool:
        """Take hold of a seed, or of a wire (``Snap.to == "WIRE"``), which gets a seed there. `drag_to` moves it."""
        self._calm()
        return self._hold(lambda: Dragging(self, Snap.of(snap)))

    def _hold(self, begin: Callable[[], Interaction]) -> bool:
        """Take hold of a new interaction, in place of wires and offers. Return whether it was not refused."""
        try:
            self.interaction = begin()
        except ValueError as error:
            return self.refuse(str(error))
        self._read_progress()
        self.wiring.clear()
        self.offering.offers.clear()
        self.reason = ""
        self.revision += 1
        return True

    def drag_to(self, snap: Snap | Pick | None) -> bool:
        """Move the dragged seed. Its wires follow as soon as they are computed. None leaves it in place."""
        drag = self.holds(Dragging)
        if drag is None:
            return self.refuse("No seed is being moved")
        if snap is None:
            return False
        before = (drag.target, drag.moved, self.reason)
        drag.aim(Snap.of(snap))
        self.reason = drag.reason
        self._read_progress()
        self.revision += before != (drag.target, drag.moved, self.reason)
        return drag.is_solved

    def drag_end(self) -> bool:
        """Leave the dragged seed where it is; one step for undo."""
        drag = self.holds(Dragging)
        if drag is None:
            return self.refuse("No seed is being moved")
        self.interaction = self.wiring
        if self.engines.computes != self.options.computes:
            self._compute_anew()
        return self._do(drag.keep)

    # Lines and strokes

    def goes_on_from(self, snap: Snap | Pick) -> bool:
        """Whether a line that begins at a pick continues the chain, rather than begin a new one."""
        seed, target, begin = self.network.seed, Snap.of(snap), self.wiring.begin()
        return seed is not None and begin is not None and target.to == "SEED" and begin.is_at(target.pick, seed.pick)

    def line_begin(self, snap: Snap | Pick) -> bool:
        """Begin a line over the surface, which `line_to` draws. At the live wire's seed it continues the chain."""
        begin = Snap.of(snap)
        self.cancel()
        self._last_click = None
        self.stop_preview()
        return self._hold(lambda: Lining(self, begin, self.goes_on_from(begin)))

    def line_to(self, points: NDArray[np.float64], triangles: NDArray[np.int32], snap: Snap | Pick | None) -> bool:
        """Draw the line on: all its points (k, 3), the triangle of each (k,), and the pick under the cursor."""
        line = self.holds(Lining)
        if line is None:
            return self.refuse("No line is being drawn")
        line.draw(points, triangles, None if snap is None else Snap.of(snap))
        self._read_progress()
        self.reason = line.reason
        self.revision += 1
        return True

    def line_end(self) -> bool:
        """Keep the wires that follow the line; one step for undo."""
        line = self.holds(Lining)
        if line is None:
            return self.refuse("No line is being drawn")
        self.interaction = self.wiring
        return self._do(line.keep)

    def draw_stroke(
        self,
        points: ArrayLike | None = None,
        faces: ArrayLike | None = None,
        *,
        vertices: ArrayLike | None = None,
        attracts: bool = True,
        acts_on: ActsOn | None = None,
        radius: float | None = None,
    ) -> bool:
        """Draw a stroke that live wires follow or avoid from here on. Kept wires stay as they are.

        Parameters
        ----------
        points, faces
            (n, 3) the points that a hand drew on the surface, and the triangle of each. They are smoothed a little.
        vertices
            (n,) the vertices that the stroke runs through, instead of both.
        acts_on
            The wires that it is meant for. If None, the active one while a wire is live, otherwise both.
        radius
            How far it reaches, in the points' units. If None, ten rings of vertices.
        """
        self.cancel()
        self._last_click = None

        def stroke() -> Edit:
            if vertices is not None:
                course = through_vertices(vertices, self.points)
            elif points is None or faces is None:
                raise TypeError("neither points nor vertices")
            else:
                course = drawn(points, faces, self.points, self.triangles)
            # The wire that the stroke is for stays the active one, even if another is shorter now.
            live, chosen, meant = self.wiring, self.wiring.chosen, acts_on
            index = live.active_index
            # A wire that is straight in the view follows no stroke.
            if meant is None and self.network.seed is not None and index < len(FOLLOWS) and not live.is_straight:
                chosen, meant = index, FOLLOWS[index]
            own = Stroke(*course, acts_on=meant or "both", attracts=attracts, radius=radius)
            return Edit(replace(self.base, strokes=(*self.network.strokes, own)), chosen=chosen)

        return self._do(stroke)

    def erase(self, stroke: Stroke) -> bool:
        """Remove a stroke."""
        self._calm()
        rest = tuple(own for own in self.network.strokes if own.id != stroke.id)
        if len(rest) == len(self.network.strokes):
            return self.refuse("This stroke no longer exists")
        chosen = self.wiring.chosen
        return self._do(lambda: Edit(replace(self.base, strokes=rest), chosen=chosen))

    # Settings

    def follow(self, options: Options) -> bool:
        """Draw wires with other settings from here on. Return False if that ends the chain, because the seed is not on the surface."""
        before = self.options
        if options == before:
            return True
        if options.along != before.along:
            self._calm()
        self.options = options
        self.revision += 1
        done = options.along == before.along or self._switch()
        if options.straight != before.straight:
            self.wiring.forget()
            self._look_again()
        if options.computes != before.computes:
            self._compute_anew()
        if options.clear != before.clear:
            self.reason = ""
        if options.mirror != self.network.mirror:
            self._go_to(replace(self.network, mirror=options.mirror))
        return done

    def _compute_anew(self) -> None:
        """Compute live wires with the current settings. While a seed is dragged, its wires keep their metric."""
        if self.holds(Dragging) is not None:
            return
        if self.options.metric != self.engines.metric:
            self.wiring.forget()
        self.engines.use(self.options.metric, self.options.strengths, self.options.clamp)
        self.offering.offers.clear()
        self._look_again()

    def _switch(self) -> bool:
        """Let the live wire run the other way; if it cannot begin there, end the chain."""
        self.wiring.forget()
        self.offering.cancel()
        why: str = ""
        try:
            self.wiring.sow()
        except ValueError as error:
            why = str(error)
            self._go_to(replace(self.network, seed=None))
        self._look_again()
        self.reason = why or self.reason
        return not why

    # Undo and redo

    def undo(self) -> bool:
        """Take back what is held, else the last step."""
        if self.cancel():
            return True
        network = self.history.back(self.network)
        return self.refuse("Nothing to undo in this drawing") if network is None else self._restore(network)

    def redo(self) -> bool:
        """Bring back the step that undo took. After a new step there is nothing to redo."""
        self._calm()
        network = self.history.forth(self.network)
        return self.refuse("Nothing to redo in this drawing") if network is None else self._restore(network)

    @property
    def can_undo(self) -> bool:
        return self.is_held or self.history.can_undo(self.network)

    def _restore(self, network: Network) -> bool:
        """Go back or forth to a network of the history."""
        back = [stroke.acts_on for stroke in network.strokes if stroke not in self.network.strokes]
        self._go_to(replace(network, mirror=self.options.mirror))
        self._new_report = ""
        self._last_click = None
        self.offering.forget_crest()
        self._settle()
        if network.seed is not None and back and back[-1] != "both":
            # As when it was drawn: the wire that a stroke is for is the active one.
            self.wiring.chosen = FOLLOWS.index(back[-1])
        return True

    def adopt(self, own: Drawn, seams: ArrayLike) -> None:
        """Go on with the wires and strokes that the mesh has now, but with the mirror as it is. `undo` does not lead back behind it.

        `seams`, (k, 2), are the edges that are seams but no wires.
        """
        self._calm()
        self.stops.set_seams(seams)
        self.history.forget()
        self._completed.clear()
        # Wires that were just cut do not know their images. Images are the edges that are seams.
        among = {tuple(sorted(pair)) for pair in np.asarray(seams, dtype=np.int64).reshape(-1, 2).tolist()}
        known = tuple(wire if wire.images is not None else self.images.completed(wire, among) for wire in own.wires)
        self._go_to(Network(linked(known), mirror=self.network.mirror, strokes=own.strokes))
        self._new_report = ""
        self.offering.edges.forget()
        self._settle()

    def _take_back_click(self, edge: Pick) -> None:
        """Undo the last click if it was on an edge, and forget it."""
        if self._last_click == (undirected(edge), self.history.steps):
            self._restore(self.history.forget_step(self.network))
        self._last_click = None
