# SPDX-License-Identifier: GPL-3.0-or-later
"""Edge loops: what one click on an edge offers, and the search for the parts whose borders are among that."""

from __future__ import annotations

import threading
import traceback
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..base import native
from ..base.refused import Refused
from ..network.picks import is_same, undirected
from ..network.wires import Wire

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    import seamwire_core
    from numpy.typing import NDArray
    from seamwire_core import LiveLoop, LoopOffer

    from ...terms.choices import LoopKind
    from ..network.drawn import Drawn
    from ..network.network import Snap
    from ..network.picks import Edge, Pick
    from ..network.stops import Stops
    from ..solver.solver import Engines, LiveWire

KINDS: tuple[LoopKind, ...] = ("CLOSED", "PAST", "STRIP", "WHOLE", "FLAT")
"""What leads through an edge, see `seamwire_core.LoopOffer`."""
_MOST_KNOWN = 64
"""So many edges whose loops are remembered."""
NO_SEAMS = np.empty((0, 2), dtype=np.int32)
AMOUNTS = (0.5, 0.75, 1.0, 0.25)
"""How many parts there are, on the scale of *Suggest Seamwires*: the default, then more parts, then fewer."""
AT_ONCE = 5_000
"""Triangles up to which finding parts takes some ten milliseconds, so that a thread would only make it late."""


class PartSearch:
    """Finds parts on a thread, for the loops that an edge offers.

    `count` is how many triangles the mesh has, and `seams` returns the edges, (k, 2), that part it already. `find_parts` yields the part of
    each triangle, (m,), for each of `AMOUNTS`, on the thread. It takes the seams, and a function that returns whether to search further.
    """

    def __init__(
        self,
        live: Callable[[], LiveWire],
        count: int,
        seams: Callable[[], NDArray[np.int32]] = lambda: NO_SEAMS,
        find_parts: Callable[[NDArray[np.int32], Callable[[], bool]], Iterable[NDArray[np.int32]]] = lambda *_: (),
    ) -> None:
        self._live, self._count = live, count
        self._seams_now, self._find_parts = seams, find_parts
        self._seams = NO_SEAMS
        self._without_parts: seamwire_core.LoopOffers | None = None
        self._thread: threading.Thread | None = None
        self._stop = threading.Event()
        self._working = threading.Lock()
        self._error: Exception | None = None
        self.finder: seamwire_core.LoopOffers | None = None  # finds loops; None until it is prepared
        self.is_complete = False  # whether the parts are known; until then the finder knows only flat faces

    def ready(self) -> bool:
        """Begin to search, and return whether loops can be found. Raises Refused if an error has ended that."""
        if self._thread is None:
            self._error = None
            self._stop = threading.Event()
            self._seams = self._seams_now()
            self._thread = threading.Thread(
                target=self._search, args=(self._live(), self._seams, self._stop), name="seamwire parts", daemon=True
            )
            self._thread.start()
            if self._count <= AT_ONCE:
                self._thread.join()
        if self._error is not None:
            raise Refused(f"Loops could not be found: {self._error}")
        return self.finder is not None

    def stop(self) -> None:
        """Let the search for parts end soon. The next call of `ready` begins it again, with what it has measured."""
        if self._thread is not None and not self.is_complete:
            self._stop.set()
            self._thread = None

    def renew(self) -> None:
        if self._thread is not None and not np.array_equal(self._seams, self._seams_now()):
            self._stop.set()
            self._thread = None
            self.finder, self.is_complete = self._without_parts, False

    def wait(self) -> None:
        if self._thread is not None:
            self._thread.join()

    def _search(self, live: LiveWire, seams: NDArray[np.int32], stop: threading.Event) -> None:
        with self._working:  # a search that was stopped ends first
            found = None
            try:
                live.wait_for_surface()
                make = native.load().LoopOffers
                if self._without_parts is None:
                    self.finder = self._without_parts = make(live.surface)
                for labels in () if stop.is_set() else self._find_parts(seams, lambda: not stop.is_set()):
                    found = found or make(live.surface)
                    found.add_parts(labels)
            except Exception as error:
                traceback.print_exc()
                # Without parts there are other loops.
                self._error = None if self._without_parts is not None or stop.is_set() else error
            finally:
                if not stop.is_set():
                    self.finder, self.is_complete = found or self._without_parts, True


class EdgeLoops:
    """Finds what a click on an edge may add: loops, strips and borders of parts, in the order of the library."""

    def __init__(self, engines: Engines, stops: Stops, points: NDArray[np.float64], parts: PartSearch) -> None:
        self._engines = engines
        self._stops = stops
        self._points = points
        self._parts = parts
        self._metric: tuple[object, ...] = ()
        self._loops: dict[Edge, LiveLoop] = {}
        self._taken: tuple[Pick | None, Wire | None] = (None, None)
        self.with_parts = False  # whether all parts of the mesh were known to the last `find`

    def took(self, edge: Edge, wire: Wire) -> None:
        self._taken = undirected(edge), wire

    def taken_through(self, network: Drawn, edge: Edge) -> Wire | None:
        pick, wire = self._taken
        last = network.find(wire) if pick == undirected(edge) else None
        return network.taken_through(edge) if last is None or last.through is None else last

    def part_border(self, edge: Edge) -> set[Edge]:
        borders = [] if self._parts.finder is None else self._parts.finder.borders(edge)
        chain = borders[0].tolist() if borders else []
        return {undirected(pair) for pair in zip(chain, chain[1:] + chain[:1], strict=True)}

    def find(
        self,
        edge: Edge,
        network: Drawn,
        snap: Snap | None = None,
        shown: tuple[Wire | None, bool] = (None, False),
        kept: Wire | None = None,
    ) -> tuple[tuple[Wire, ...], bool]:
        """Return what a click on an edge may take, and whether that is final. Raise ValueError if the edge is not part of the surface.

        `shown` is the loop that was shown last, and whether the artist asked for it in place of the first one. The wire that such a click
        took comes first: `kept`, or the newest one.
        """
        own = kept or self.taken_through(network, edge)
        if own is not None and own.offers:
            return own.all_offers(), True
        # Wires that were stored have lost their offers: they are those of a click made without them.
        if own is not None:
            offers, final = self._offers(edge, network.without(own), None, shown)
            return (replace(own, offers=()), *others(own, offers)) if final else (), final
        return self._offers(edge, network, snap if snap and is_same(snap.pick, edge) else None, shown)

    def _offers(
        self, edge: Edge, network: Drawn, snap: Snap | None, before: tuple[Wire | None, bool]
    ) -> tuple[tuple[Wire, ...], bool]:
        self._parts.ready()  # begins the search again if it was stopped
        self.with_parts = self._parts.is_complete
        crossing = None if snap is None else snap.crossing
        loop = self._loop(edge, network)
        across = None if crossing is None or loop is None else self._loop(crossing, network)
        final = loop is not None and self._parts.finder is not None and (across is None) == (crossing is None)
        if loop is None or self._parts.finder is None or (across is None and snap is not None and snap.is_close_call):
            return (), final
        last = next((own.kind for own in reversed(network.wires) if own.kind is not None), "CLOSED")
        shown, chosen = before
        found = self._parts.finder.find(
            edge, loop.vertices, loop.corners,
            kept=self._stops.edges(network), plane=self._stops.plane(network),
            last=last.lower() if last in KINDS else None,
            triangle=None if snap is None else snap.triangle, inside=snap is not None and snap.inside,
            crossing=None if across is None else crossing,
            crossing_loop=() if across is None else across.vertices,
            crossing_corners=0 if across is None else across.corners,
            close_call=snap is not None and snap.is_close_call,
            shown=() if shown is None else shown.vertices + shown.vertices[: shown.closed], chosen=chosen,
        )  # fmt: skip
        return tuple(self._wire(offer, edge) for offer in found), final

    def _loop(self, edge: Edge, network: Drawn) -> LiveLoop | None:
        """Return the closed loop through an edge, or None while the library computes it, one at a time."""
        engines = self._engines
        metric = network.strokes, engines.metric, engines.strengths["EDGES"], engines.clamp
        if metric != self._metric or len(self._loops) > _MOST_KNOWN:
            self._metric = metric
            self._loops.clear()
        if edge not in self._loops:
            loop = engines.get("EDGES").loop(edge)
            if not loop.final:
                return None
            self._loops[edge] = loop
        return self._loops[edge]

    def _wire(self, offer: LoopOffer, edge: Edge) -> Wire:
        """Return an offer as a wire. If it is closed, it begins and ends at the picked edge, or at the edge that stands for it."""
        vertices, kind = tuple(offer.vertices.tolist()), offer.kind.upper()
        through = edge if undirected(edge) == offer.through else offer.through
        is_loop = kind in {"CLOSED", "FLAT"} or (kind == "CROSSING" and offer.closed)
        return Wire(
            "EDGES", vertices, self._points[[*vertices, *vertices[: offer.closed]]],
            *((through, through) if offer.closed else (vertices[0], vertices[-1])),
            closed=offer.closed, strength=self._engines.strengths["EDGES"] if is_loop else 0.0,
            kind=kind, through=offer.through, beside=tuple(self._wire(other, edge) for other in offer.beside),
        )  # fmt: skip


def taken(offers: tuple[Wire, ...], choice: int, marks: bool) -> Wire:
    """Return an offer as a wire to be kept, with the others, the next one first. A crossing loop becomes a closed loop or a strip."""
    offers = tuple(
        replace(offer, kind="CLOSED" if offer.closed else "STRIP") if offer.kind == "CROSSING" else offer
        for offer in offers
    )
    others = tuple(offer for offer in offers[choice + 1 :] + offers[:choice] if not offer.beside)
    return offers[choice].anew(marks=marks, offers=others, beside=())


def others(kept: Wire, offers: tuple[Wire, ...]) -> tuple[Wire, ...]:
    """Return what else is offered where a wire is kept, in order: what comes after its kind first."""
    at = next((i for i, offer in enumerate(offers) if offer.kind == kept.kind), -1)
    edges = set(kept.edges())
    return tuple(offer for offer in offers[at + 1 :] + offers[: max(at, 0)] if set(offer.edges()) != edges)
