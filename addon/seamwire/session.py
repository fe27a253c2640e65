# SPDX-License-Identifier: GPL-3.0-or-later
"""One drawing session: seeds, wires, what is kept, undo and redo.

Knows neither Blender nor the GPU. The tool in the viewport and the headless operator drive the same session; what it
shows and what it marks is decided here and nowhere else.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, Protocol

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

Along = Literal["EDGES", "SURFACE"]
"""Where wires run: along the mesh's edges, or across its surface."""

Pick = int | tuple[int, int]
"""A vertex, or an edge by its two vertices."""


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


class LiveWire(Protocol):
    """What a session asks of ``seamwire_core.LiveWire``."""

    def seed(self, pick: Pick, forward: bool = False) -> None:
        """Start the wires from a pick."""

    def wires(self, target: Pick) -> Candidates:
        """Both wires to a target, as far as they are computed."""

    def loop(self, edge: tuple[int, int]) -> Chain:
        """Return the closed chain through an edge."""

    def progress(self) -> float:
        """Fraction of the running work that is done."""

    def wait(self, seconds: float | None = None) -> bool:
        """Wait for the running work."""


@dataclass(frozen=True)
class Seed:
    """Where the next wire begins.

    Parameters
    ----------
    pick
        A vertex, or an edge; a directed one where `forward` is set.
    forward
        The wire before this one ended on the edge `pick`, running from its first vertex to its second: the next wire
        goes on from there.
    clicked
        What was clicked, where that is not `pick`.
    """

    pick: Pick
    forward: bool = False
    clicked: Pick | None = None

    @property
    def place(self) -> Pick:
        """Where the seed is shown."""
        return self.pick if self.clicked is None else self.clicked

    @property
    def vertex(self) -> int:
        """The vertex that stands for the seed where wires cannot begin on edges."""
        return self.pick[1] if isinstance(self.pick, tuple) else self.pick


@dataclass(frozen=True, eq=False)
class Wire:
    """A wire from one pick to another, or a closed loop.

    Parameters
    ----------
    along
        How it was found.
    vertices
        The edges that it marks: one between each two neighbours in this list, and between last and first of a loop.
    points
        (k, 3), the curve as it is drawn; for a loop the first point comes again at the end.
    start, end
        The picks at its ends; the same one for a loop.
    closed
        Whether it is a loop.
    """

    along: Along
    vertices: tuple[int, ...]
    points: NDArray[np.float64]
    start: Pick
    end: Pick
    closed: bool = False

    def edges(self) -> list[tuple[int, int]]:
        """Return the edges it marks, smaller vertex first, in order along the wire."""
        following = self.vertices[1:] + (self.vertices[:1] if self.closed else ())
        return [(min(a, b), max(a, b)) for a, b in zip(self.vertices, following, strict=False)]


@dataclass(frozen=True)
class _State:
    """What undo brings back."""

    wires: tuple[Wire, ...] = ()
    seed: Seed | None = None


@dataclass(frozen=True)
class _Queued:
    """A click that came before its wire was computed."""

    kind: Literal["click", "loop"]
    pick: Pick


@dataclass
class _Live:
    """The wires to what is under the cursor."""

    target: Pick | None = None
    wires: tuple[Wire | None, Wire | None] = (None, None)
    shorter: int = 0
    final: bool = True
    loop: Wire | None = None
    loop_wanted: bool = False
    chosen: int | None = None


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

    Notes
    -----
    Methods that do something return whether it was done; where it was not, `message` says why, in words for the
    artist. `revision` grows with every change of what is to be seen.
    """

    def __init__(
        self, make_live: Callable[[Along], LiveWire], points: NDArray[np.float64], along: Along = "EDGES"
    ) -> None:
        self._make_live = make_live
        self._points = points
        self._lives: dict[Along, LiveWire] = {}
        self._state = _State()
        self._undo: list[_State] = []
        self._redo: list[_State] = []
        self._live = _Live()
        self._queue: list[_Queued] = []
        self._last_click: tuple[Pick, int] | None = None
        self._progress = 1.0
        self.along: Along = along
        self.message = ""
        self.revision = 0
        self._engine()

    # What is there to be seen

    @property
    def wires(self) -> tuple[Wire, ...]:
        """The kept wires, oldest first."""
        return self._state.wires

    @property
    def seed(self) -> Pick | None:
        """Where the live wire begins; None between chains."""
        seed = self._state.seed
        if seed is None:
            return None
        return seed.vertex if self.along == "SURFACE" else seed.pick

    @property
    def target(self) -> Pick | None:
        """What is under the cursor, or what the oldest waiting click asked for."""
        return self._live.target

    @property
    def active(self) -> Wire | None:
        """The wire that a click would keep."""
        return self._live.wires[self._active_index()]

    @property
    def other(self) -> Wire | None:
        """The wire that the wheel would bring forward; None where both run along the same edges."""
        other = self._live.wires[1 - self._active_index()]
        active = self.active
        if other is None or (active is not None and self._alike(active, other)):
            return None
        return other

    @property
    def loop_preview(self) -> Wire | None:
        """The loop through the edge under the cursor, while it is asked for."""
        return self._live.loop

    @property
    def computing(self) -> bool:
        """Whether the library still works on what is shown."""
        return self._progress < 1.0

    @property
    def progress(self) -> float:
        """Fraction of that work that is done."""
        return self._progress

    @property
    def waiting_clicks(self) -> int:
        """How many clicks wait for their wire."""
        return len(self._queue)

    @property
    def can_undo(self) -> bool:
        """Whether undo() has something to take back."""
        return bool(self._queue) or any(state != self._state for state in self._undo)

    @property
    def can_redo(self) -> bool:
        """Whether redo() has something to bring back."""
        return bool(self._redo)

    def seeds(self) -> list[Pick]:
        """Return every seed of the network, each once, in the order they were placed."""
        ends = [pick for wire in self.wires if not wire.closed for pick in (wire.start, wire.end)]
        seed = self._state.seed
        if seed is not None:
            ends.append(seed.vertex if self.along == "SURFACE" else seed.place)
        return list({_undirected(pick): None for pick in ends})

    def edges(self) -> list[tuple[int, int]]:
        """Return the edges that finishing will mark, each once, sorted, smaller vertex first."""
        return sorted({edge for wire in self.wires for edge in wire.edges()})

    # What can be done

    def hover(self, target: Pick | None, loop: bool = False) -> None:
        """Move the free end of the live wire.

        Parameters
        ----------
        target
            What is under the cursor; None: nothing.
        loop
            Show the loop through `target` instead, where it is an edge and wires run along edges.
        """
        if self._queue:
            return
        self._aim(target)
        live = self._live
        live.loop_wanted = loop and self.along == "EDGES" and isinstance(target, tuple)
        if live.loop is not None and not (live.loop_wanted and live.loop.start == target):
            live.loop = None
            self.revision += 1
        self._preview_loop()

    def click(self, pick: Pick) -> bool:
        """Place a seed; where a wire is live, keep it and go on from there.

        Before the wire is computed the click waits for it, see `poll`.
        """
        if self._state.seed is None and not self._queue:
            return self.start(pick)
        self._last_click = None
        if self._queue:
            self._queue.append(_Queued("click", pick))
            return True
        self._aim(pick)
        if self.active is None and self.computing:
            self._queue.append(_Queued("click", pick))
            self.revision += 1
            return True
        return self._keep(pick)

    def start(self, pick: Pick) -> bool:
        """Begin a new chain at a pick, ending the one before."""
        self._queue.clear()
        if self.along == "SURFACE" and isinstance(pick, tuple):
            return self._refuse(f"Across the surface wires begin and end at vertices, not at edge {_name(pick)}")
        if not self._change(_State(self.wires, Seed(pick))):
            return False
        self._last_click = (pick, len(self._undo))
        return True

    def loop(self, edge: Pick) -> bool:
        """Keep the closed loop through an edge.

        A click on the same edge just before is taken back: a double click is a click first.
        """
        if self.along != "EDGES" or not isinstance(edge, tuple):
            return self._refuse("Loops are taken along edges: double-click on an edge")
        if self._queue and self._queue[-1] == _Queued("click", edge):
            self._queue.pop()
        elif self._last_click == (edge, len(self._undo)):
            self._undo_state(self._undo.pop())
        self._last_click = None
        last = self.wires[-1] if self.wires else None
        if last is not None and last.closed and edge in last.edges():
            return True  # the first click of the two took it already
        wire = self._find_loop(edge)
        if wire is None:
            if self.computing:
                self._queue.append(_Queued("loop", edge))
                self.revision += 1
                return True
            return self._refuse(f"No closed loop of edges runs through edge {_name(edge)}")
        return self._change(_State((*self.wires, wire), self._state.seed))

    def end_chain(self) -> None:
        """Let go of the live wire; the kept ones stay."""
        self._queue.clear()
        self._last_click = None
        if self._state.seed is None:
            return
        # No step of its own for undo: taking back the last wire after this brings the chain back to life.
        self._state = _State(self.wires, None)
        self._live.chosen = None
        self._aim(self._live.target, again=True)
        self.revision += 1

    def toggle(self) -> bool:
        """Make the other of the two wires the active one, until it is kept."""
        if self.other is None:
            same = self._live.final and self.active is not None
            return self._refuse("Both wires run along the same edges here" if same else "There is no other wire yet")
        self._live.chosen = 1 - self._active_index()
        self.message = ""
        self.revision += 1
        return True

    def switch(self, along: Along) -> bool:
        """Run wires along edges or across the surface from here on; kept wires stay as they are."""
        if along == self.along:
            return True
        self._queue.clear()
        self._last_click = None
        before = self.along
        self.along = along
        self._live = _Live()
        if self._state.seed is not None and not self._sow(self._state.seed):
            self.along = before
            return False
        self._engine()
        self.message = ""
        self.revision += 1
        return True

    def undo(self) -> bool:
        """Take back the last wire, loop or seed."""
        if self._queue:
            self._queue.pop()
            self.revision += 1
            return True
        while self._undo:
            state = self._undo.pop()
            if state != self._state:
                self._redo.append(self._state)
                self._undo_state(state)
                return True
        return self._refuse("Nothing to undo in this drawing")

    def redo(self) -> bool:
        """Bring back what undo took."""
        if not self._redo:
            return self._refuse("Nothing to redo in this drawing")
        self._undo.append(self._state)
        self._undo_state(self._redo.pop())
        return True

    def poll(self) -> bool:
        """Take in what the library has computed since, and do the clicks that waited for it.

        Returns
        -------
        bool
            Whether there is something new to be seen.
        """
        if not self.computing and not self._queue and self._live.final:
            return False
        before = (self.revision, round(self._progress, 2))
        self._read_progress()
        while self._queue:
            head = self._queue[0]
            self._aim(head.pick, again=True)
            blocked = self._find_loop(head.pick) is None if head.kind == "loop" else self.active is None
            if blocked and self.computing:
                break
            del self._queue[0]
            rest, self._queue = self._queue, []
            (self.loop if head.kind == "loop" else self.click)(head.pick)
            self._queue += rest
        if not self._queue and not self._live.final:
            self._aim(self._live.target, again=True)
        self._preview_loop()
        return before != (self.revision, round(self._progress, 2))

    def wait(self) -> None:
        """Wait until everything is computed and every waiting click is done."""
        while True:
            self._engine().wait()
            self.poll()
            if not self._queue and not self.computing:
                return

    # How it is done

    def _engine(self) -> LiveWire:
        if self.along not in self._lives:
            self._lives[self.along] = self._make_live(self.along)
        self._read_progress()
        return self._lives[self.along]

    def _read_progress(self) -> None:
        self._progress = self._lives[self.along].progress()

    def _refuse(self, why: str) -> bool:
        self.message = why
        self.revision += 1
        return False

    def _active_index(self) -> int:
        live = self._live
        index = live.shorter if live.chosen is None else live.chosen
        # While one wire is computed and the other is not, show the one there is.
        return index if live.wires[index] is not None or live.wires[1 - index] is None else 1 - index

    @staticmethod
    def _alike(one: Wire, two: Wire) -> bool:
        if one.along == "EDGES":
            return one.vertices == two.vertices
        return one.points.shape == two.points.shape and bool(np.allclose(one.points, two.points, rtol=1e-6))

    def _sow(self, seed: Seed) -> bool:
        """Start the wires of a seed; on refusal the wires are those of the seed before."""
        engine = self._engine()
        try:
            if self.along == "SURFACE":
                engine.seed(seed.vertex)
            else:
                engine.seed(seed.pick, forward=seed.forward)
        except ValueError as error:
            if self._state.seed is not None and self._state.seed != seed:
                self._sow(self._state.seed)
            return self._refuse(str(error))
        self._read_progress()
        return True

    def _change(self, state: _State) -> bool:
        """Go on to a new state, with a step for undo."""
        if state.seed is not None and state.seed != self._state.seed and not self._sow(state.seed):
            return False
        self._undo.append(self._state)
        self._redo.clear()
        self._state = state
        self._live.chosen = None
        self._live.loop = None
        self.message = ""
        self._aim(self._live.target, again=True)
        self.revision += 1
        return True

    def _preview_loop(self) -> None:
        live = self._live
        if live.loop_wanted and live.loop is None and live.target is not None:
            live.loop = self._find_loop(live.target)
            self.revision += live.loop is not None

    def _undo_state(self, state: _State) -> None:
        if state.seed is not None and state.seed != self._state.seed:
            self._sow(state.seed)
        self._state = state
        self._last_click = None
        self._live.chosen = None
        self.message = ""
        self._aim(self._live.target, again=True)
        self.revision += 1

    def _keep(self, pick: Pick) -> bool:
        wire = self.active
        if wire is None:
            if self._at_seed(pick):
                return self._refuse("The wire ends where it begins: click somewhere else")
            return self._refuse(self.message or f"No wire reaches {_name(pick)}")
        seed = Seed(pick)
        if self.along == "EDGES":
            seed = Seed((wire.vertices[-2], wire.vertices[-1]), forward=True, clicked=pick)
        if not self._change(_State((*self.wires, wire), seed)):
            return False
        self._last_click = (pick, len(self._undo))
        return True

    def _aim(self, target: Pick | None, again: bool = False) -> None:
        """Find both wires to a target; `again`: also where it is the same as before."""
        live = self._live
        if target == live.target and not again and live.final:
            return
        before = (live.target, live.shorter, [wire is None for wire in live.wires], self.message)
        live.target = target
        self._find_wires(target)
        after = (live.target, live.shorter, [wire is None for wire in live.wires], self.message)
        # Asking again while nothing is ready shows nothing new, and must not cost a redraw each time.
        self.revision += before != after

    def _find_wires(self, target: Pick | None) -> None:
        live = self._live
        live.wires = (None, None)
        live.final = True
        self.message = ""
        self._read_progress()
        seed = self._state.seed
        if seed is None or target is None or self._at_seed(target):
            return
        if self.along == "SURFACE" and isinstance(target, tuple):
            self.message = f"Across the surface wires begin and end at vertices, not at edge {_name(target)}"
            return
        try:
            found = self._engine().wires(target)
        except ValueError as error:
            self.message = str(error)
            return
        live.final = found.final
        live.shorter = found.shorter
        live.wires = (self._wire(found.wires[0], target), self._wire(found.wires[1], target))
        if live.final and live.wires == (None, None):
            self.message = f"No wire reaches {_name(target)}"

    def _at_seed(self, pick: Pick) -> bool:
        seed = self._state.seed
        return seed is not None and (
            _undirected(pick) == _undirected(self.seed) or (seed.forward and pick == seed.vertex)
        )

    def _wire(self, candidate: Candidate, target: Pick) -> Wire | None:
        seed = self._state.seed
        if seed is None or not candidate.final:
            return None
        vertices = tuple(int(v) for v in candidate.vertices)
        if self.along == "SURFACE":
            if len(candidate.points) < 2 or len(vertices) < 2:
                return None
            return Wire("SURFACE", vertices, np.array(candidate.points, dtype=np.float64), seed.vertex, target)
        if seed.forward:
            vertices = vertices[1:]  # the edge before the seed belongs to the wire before
        if len(vertices) < 2:
            return None
        return Wire("EDGES", vertices, self._points[list(vertices)], seed.place, target)

    def _find_loop(self, edge: Pick) -> Wire | None:
        if not isinstance(edge, tuple):
            return None
        try:
            vertices = tuple(int(v) for v in self._engine().loop(edge).vertices)
        except ValueError as error:
            self.message = str(error)
            return None
        if len(vertices) < 3:
            return None
        points = self._points[[*vertices, vertices[0]]]
        return Wire("EDGES", vertices, points, edge, edge, closed=True)


def _undirected(pick: Pick | None) -> Pick | None:
    return (min(pick), max(pick)) if isinstance(pick, tuple) else pick


def _name(pick: Pick) -> str:
    return f"{pick[0]}-{pick[1]}" if isinstance(pick, tuple) else f"vertex {pick}"


_TOKEN = re.compile(r"(\d+)(?:-(\d+))?")


def parse_chains(text: str) -> list[list[Pick]]:
    """Read chains of seeds, such as ``"0 512 88; 7-9 40 7-9"``.

    Parameters
    ----------
    text
        Chains separated by semicolons; in each, seeds separated by spaces or commas: a vertex number, or an edge as its
        two vertex numbers with a hyphen between them.

    Raises
    ------
    ValueError
        Where a seed is neither, where a chain has fewer than two seeds, or where there is no chain.
    """
    chains: list[list[Pick]] = []
    for number, part in enumerate((p for p in text.split(";") if p.strip()), start=1):
        chain: list[Pick] = []
        for token in part.replace(",", " ").split():
            match = _TOKEN.fullmatch(token)
            if match is None:
                raise ValueError(f"Chain {number}: '{token}' is neither a vertex number nor an edge such as 7-9")
            first, second = match.groups()
            if second is not None and int(first) == int(second):
                raise ValueError(f"Chain {number}: '{token}' is not an edge: both its vertices are the same")
            chain.append(int(first) if second is None else (int(first), int(second)))
        if len(chain) < 2:
            raise ValueError(f"Chain {number}: a chain needs at least two seeds, not only '{part.strip()}'")
        chains.append(chain)
    if not chains:
        raise ValueError("There are no chains of seeds: give vertex numbers such as '0 512 88; 7-9 40'")
    return chains


def draw_chains(session: Session, chains: Iterable[Sequence[Pick]]) -> list[str]:
    """Draw chains of seeds without a hand, waiting for each wire.

    Returns
    -------
    list of str
        What could not be done, in words. A chain goes on from the last seed that was reached.
    """
    problems = []
    for number, chain in enumerate(chains, start=1):
        session.end_chain()
        for pick in chain:
            done = session.click(pick)
            session.wait()
            if not done or session.message:
                problems.append(f"Chain {number}: {session.message}")
    session.end_chain()
    return problems
