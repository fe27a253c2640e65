# SPDX-License-Identifier: GPL-3.0-or-later
"""A sketch: what the artist draws on one object. The tool in the viewport and the headless operators drive the same sketch."""

from __future__ import annotations

import traceback
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from ...terms.options import Options
from ..base.refused import Refused
from ..network.drawn import Drawn
from ..network.network import CourseKey, History, How, Network, Snap, Way, linked
from ..network.picks import undirected
from ..network.strokes import Stroke, drawn, through_vertices
from ..network.wires import FOLLOWS
from ..solver.solver import MOST_WAITS
from .board import Board
from .courses import Course
from .dragging import Dragging
from .interaction import Begun, Edit, Interaction
from .lining import Lining
from .offering import Offering
from .paint import paint
from .picture import Work
from .ways import search_way, turned
from .wiring import Wiring

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import ArrayLike, NDArray

    from ..network.network import Request
    from ..network.picks import Edge, Pick
    from ..network.strokes import ActsOn
    from ..network.wires import Wire
    from ..offers.crests import Crests
    from ..solver.solver import LiveWire
    from .picture import Picture

    Kind = TypeVar("Kind", bound=Interaction)


class Sketch(Board):
    """The network with its history, the courses, and the one interaction.

    A method that changes something returns whether that was done. If not, `reason` says why. The parameters are those of `Board`.
    """

    def __init__(self, *mesh: object, **more: object) -> None:
        super().__init__(*mesh, **more)
        self.history = History()
        self.wiring = Wiring(self)
        self.offering = Offering(self)
        self.interaction: Interaction = self.wiring
        self._last_click: tuple[Pick, int] | None = None  # its pick, and the number of steps then
        self._painted: tuple[object, Picture] | None = None
        # The live wires are made now, because what they compute first takes longest.
        self._read_progress()

    # What there is

    @property
    def wires(self) -> tuple[Wire, ...]:
        return self.shown.wires

    def edges_to_mark(self) -> list[Edge]:
        """Return the edges that the wires make seams, each once, sorted, smaller vertex first."""
        return self.images.net_effect(self.shown)[0]

    def edges_to_clear(self) -> list[Edge]:
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

    @property
    def picture(self) -> Picture:
        return self._newest_picture()

    def _newest_picture(self) -> Picture:
        key = (self.revision, self.told, self.computing, self.progress, self.waiting)
        if self._painted is None or self._painted[0] != key:
            self._painted = (
                key,
                paint(
                    self,
                    self.wiring,
                    self.offering,
                    self.interaction,
                    self._work,
                    (self.can_undo, self.history.can_redo),
                ),
            )
        return self._painted[1]

    @property
    def _work(self) -> Work:
        return Work(self.computing, self.progress, self.waiting)

    @property
    def told(self) -> str:
        return self.reason or self.new_report

    # Work

    def holds(self, kind: type[Kind]) -> Kind | None:
        return self.interaction if isinstance(self.interaction, kind) else None

    @property
    def is_held(self) -> bool:
        return self.interaction not in (self.wiring, self.offering)

    @property
    def waiting(self) -> int:
        return len(self.courses.unfinished)

    @property
    def computing(self) -> bool:
        return self.progress < 1.0 or not self.interaction.is_final or self.waiting > 0

    def _lives(self) -> list[LiveWire]:
        return [self.engines.get(self.options.along), *self.interaction.lives(), *self.courses.lives()]

    def _read_progress(self) -> None:
        """Read how much is computed. Wires that are not final after all work is done stay so, so this comes before asking."""
        self.progress = min(live.progress() for live in self._lives())

    def poll(self) -> bool:
        """Take in what the library has computed, and return whether the picture has changed."""
        if not self.computing and self.holds(Lining) is None:
            return False
        before = (self.revision, round(self.progress, 2))
        self._read_progress()
        while self.courses.unfinished:
            own, is_new = self.courses.step()
            if is_new:
                self.draw()  # the next request may go on from there
            if not self.is_final(own):
                break
            self._told_of(own)
        self._poll_interaction()
        return before != (self.revision, round(self.progress, 2))

    def _told_of(self, own: Request) -> None:
        """Tell what is to be known of a final course. Each new one passes here once."""
        course = self.courses.of(own)
        if course.reason:
            self.tell(course.reason)
            return
        if isinstance(own, Way):
            self.warn_of_triangles(own.along)
        self.warn_of_images(course)

    def _poll_interaction(self) -> None:
        own = self.interaction
        before = own.reason
        with self._guarded():
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
            self.offering.wait()
            self.poll()
            if not self.computing:
                return
            now = (*map(id, self.courses.unfinished), self.progress)
            rounds, before = (rounds + 1 if now == before else 0), now
        if self.courses.unfinished:
            why = self.reason or "The computation ended without a result: this step was dropped"
            self.courses.give_up(why)
            self.tell(why)
            self.draw()

    # Edits

    @contextmanager
    def _guarded(self) -> Iterator[None]:
        """Let an unexpected error end the interaction, and not the chain. The network stays as it was."""
        try:
            yield
        except ValueError:
            raise
        except Exception as error:
            traceback.print_exc()
            self.interaction = self.wiring
            self.wiring.runs = False
            self.wiring.aim(None)
            self.offering.cancel()
            self.tell(f"This step ended on an error, and nothing was changed: {error}")

    def _do(self, find: Callable[[], Edit | None]) -> bool:
        """Go on to the network of an edit, unless it is refused."""
        self.new_report = ""
        try:
            with self._guarded():
                edit = find()
                if edit is not None:
                    return self.edit(edit)
                self._look_again()
                return True
        except ValueError as error:
            self._look_again()
            return self.refuse(str(error))
        return False

    def edit(self, edit: Edit) -> bool:
        before = self.network
        for request, course, search in edit.begun:
            self.courses.begin(request, course, search)
        for own in self.courses.unknown(edit.network.requests):
            if isinstance(own, Way):  # a part of a wire that is not final
                shown = () if own.was is None else (own.was,)
                self.courses.begin(own, Course(shown), search_way(own, self.ground, self.engines.get(own.along).fork()))
        try:
            self.go_to(edit.network)
            self.wiring.sow()
        except ValueError as error:
            self.go_to(before)
            return self.refuse(str(error))
        self.history.step(before)
        self._settle(edit.chosen)
        if edit.report:
            self.tell(edit.report)
        known = {own.key for own in before.requests}
        for own in self.network.requests:
            if own.key not in known and self.is_final(own):
                self._told_of(own)
        return True

    def _settle(self, chosen: int | None = None) -> None:
        self.wiring.chosen = chosen
        self.wiring.runs = False
        self.offering.clear()
        self.reason = ""
        self._look_again()

    def _look_again(self) -> None:
        """Find what is under the cursor once more: it may be another wire now."""
        self._read_progress()
        self.wiring.aim(self.wiring.target)
        self.reason = self.wiring.reason
        self.revision += 1

    # At the cursor

    @property
    def target(self) -> Snap | None:
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
        before, vanish = (self.wiring.shown, self.reason, self.interaction), False
        with self._guarded():
            if is_offering or not self.offering.is_idle:
                vanish = self.offering.hover(target, loop, bend)
            self.interaction = own
            if is_offering:
                self.wiring.target = target
            else:
                self.wiring.aim(target)
        self.reason = own.reason
        self.revision += vanish or before != (self.wiring.shown, self.reason, own)

    def next_candidate(self) -> bool:
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
        return self._do(lambda: self.offering.take(target))

    def bend(self, snap: Snap | Pick) -> bool:
        target = Snap.of(snap)
        self.cancel()
        self._last_click = None
        return self._do(lambda: self.offering.bend_to(target))

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
        self.go_to(replace(self.network, seed=None))
        self._settle()

    def finish(self, wait: bool = True) -> None:
        """End the chain, and `wait` until every wire is final. Otherwise wires stay as drawn. Wires without a course are dropped."""
        self.end_chain()
        if wait and self.waiting:
            self.wait()
        if any(not self.courses.of(own).wires for own in self.courses.unfinished):
            self.tell("Wires were dropped that had not been computed yet")
        self.courses.give_up()
        lost = [own.id for own in self.network.requests if not self.courses.of(own).wires]
        if lost:
            self.go_to(self.network.without(*lost))

    def _calm(self) -> None:
        self.offering.parts.stop()
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
            way = replace(own, turns=own.turns + 1, was=own.was if own.turns else drawn, key=CourseKey())
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
        live = self.engines.get(way.along).fork()
        shown = turned(way, self.ground, live, course.choices) if course.choices else Course(course.wires)
        begun = Begun(way, shown, search_way(way, self.ground, live))
        return Edit(network.replacing({own.id: (way,)}), (begun,))

    def drop(self, wire: Wire) -> bool:
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
        try:
            self.interaction = begin()
        except ValueError as error:
            return self.refuse(str(error))
        self._read_progress()
        self.wiring.clear()
        self.offering.clear()
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
        with self._guarded():
            drag.aim(Snap.of(snap))
        self.reason = drag.reason
        self._read_progress()
        self.revision += before != (drag.target, drag.moved, self.reason)
        return drag.is_solved

    def drag_end(self) -> bool:
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
        seed, target, begin = self.network.seed, Snap.of(snap), self.begin
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
        with self._guarded():
            line.draw(points, triangles, None if snap is None else Snap.of(snap))
        self._read_progress()
        self.reason = line.reason
        self.revision += 1
        return True

    def line_end(self) -> bool:
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
        if options.mirror != before.mirror:
            self.draw()
        return done

    def _compute_anew(self) -> None:
        """Compute live wires with the current settings. While a seed is dragged, its wires keep their metric."""
        if self.holds(Dragging) is not None:
            return
        if self.options.metric != self.engines.metric:
            self.wiring.forget()
        self.engines.use(self.options.metric, self.options.strengths, self.options.clamp)
        self.offering.clear()
        self._look_again()

    def _switch(self) -> bool:
        """Let the live wire run the other way; if it cannot begin there, end the chain."""
        self.wiring.forget()
        self.offering.cancel()
        why: str = ""
        self.find_begin()
        try:
            self.wiring.sow()
        except ValueError as error:
            why = str(error)
            self.go_to(replace(self.network, seed=None))
        self._look_again()
        self.reason = why or self.reason
        return not why

    # Undo and redo

    def undo(self) -> bool:
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
        back = [stroke.acts_on for stroke in network.strokes if stroke not in self.network.strokes]
        self.go_to(network)
        self.new_report = ""
        self._last_click = None
        self.offering.forget_crest()
        # As when it was drawn: the wire that a stroke is for is the active one.
        is_for_one = network.seed is not None and bool(back) and back[-1] != "both"
        self._settle(FOLLOWS.index(back[-1]) if is_for_one else None)
        return True

    def adopt(self, own: Drawn, seams: ArrayLike) -> None:
        """Go on with the wires and strokes that the mesh has now. `undo` does not lead back behind it.

        `seams`, (k, 2), are the edges that are seams but no wires.
        """
        self._calm()
        self.stops.set_seams(seams)
        self.history.forget()
        self._derived.clear()
        self._completed.clear()
        # Wires that were just cut do not know their images. Images are the edges that are seams.
        among = {tuple(sorted(pair)) for pair in np.asarray(seams, dtype=np.int64).reshape(-1, 2).tolist()}
        known = tuple(wire if wire.images is not None else self.images.completed(wire, among) for wire in own.wires)
        self.go_to(Network(linked(known), strokes=own.strokes))
        self.new_report = ""
        self.offering.parts.renew()
        self._settle()

    def _take_back_click(self, edge: Pick) -> None:
        """Undo the last click if it was on an edge, and forget it."""
        if self._last_click == (undirected(edge), self.history.steps):
            self._restore(self.history.forget_step())
        self._last_click = None
