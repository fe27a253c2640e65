# SPDX-License-Identifier: GPL-3.0-or-later
"""How many clicks reproduce artists' seams, edge for edge: with Seamwire, and with Blender's own tools.

    python native/bench/seam_clicks.py SEAMS

SEAMS is a folder with data/*.npz, a mesh and its seams each, and measure.py, whose simulated expert finds how far one wire reaches.
Needs SciPy. Presses of a mouse button are counted:

- Blender, edge mode: a click for the first edge of a chain, one for each shortest path from there on, and one for an edge loop, wherever
  one lies in the seams as a whole. A path may begin where an edge loop was clicked.
- Blender with all it has: a path by topology distance too; the border of linked flat faces (15, 30 and 50 degrees) for one click, where
  all of it belongs to the seams, the two commands and the angle for nothing; and Select Sharp Edges (30 degrees) for one, where all that
  it takes does.
- Seamwire: a click for a chain's seed, one for each wire, and one for each offer of the loop gesture: a closed loop, a strip or a way
  past poles up to seams drawn before, a whole strip, the border of a part, wherever one lies in the seams as a whole, and a
  single edge.
- Beside the presses, the turns from one candidate to the next: of wires, and of the loop gesture's offers as below.
- How often the wanted loop is the first offer of the loop gesture, and how many notches of the wheel it takes. This is measured over about
  twelve edges of each wanted loop, after the loops before it.
- With --drags: a press for a line that is drawn by dragging along the seams, as far as a hand can in one view, wherever that takes fewer
  presses than clicks: with an exact hand, and with one that wobbles by a fifth of an edge (`seam_drags.py`).
- The same, mirrored: where the mesh is symmetric, edges whose images are seams too are drawn once, if that takes fewer clicks. Blender's
  Select Mirror is counted as if it did the same.
"""

from __future__ import annotations

import argparse
import functools
import importlib
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from blender_engine import BlenderEngine
from seam_drags import Hand
from seams_engine import SeamwireEngine
from seamwire_core import PartFinder

sys.path.insert(0, str(Path(__file__).parents[2] / "addon"))
from seamwire.core.network.drawn import Drawn  # these know no Blender
from seamwire.core.network.stops import Stops
from seamwire.core.network.strokes import for_library
from seamwire.core.network.symmetry import Symmetry
from seamwire.core.network.wires import Wire
from seamwire.core.offers.edge_loops import AMOUNTS, EdgeLoops, PartSearch
from seamwire.core.solver.solver import Engines

if TYPE_CHECKING:
    from seamwire.terms.choices import LoopKind

Pair = tuple[int, int]
Edges = frozenset[Pair]
Mesh = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Points, offsets of the faces, their corners."""

_EDGES_TRIED = 12
_FLAT = (15.0, 30.0, 50.0)
_SHARP = 30.0


@functools.total_ordering
@dataclass(frozen=True)
class Count:
    """Presses of a button, turns from one candidate to the next, and how many of the presses draw lines."""

    presses: int = 0
    turns: float = 0.0
    drags: int = 0

    def __add__(self, other: Count) -> Count:
        """Return both together."""
        return Count(self.presses + other.presses, self.turns + other.turns, self.drags + other.drags)

    def __lt__(self, other: Count) -> bool:
        """Whether it is fewer presses, or as many and fewer turns."""
        return (self.presses, self.turns) < (other.presses, other.turns)


def edges_of(chain: list[int], closed: bool) -> Edges:
    """Return the edges of a chain, smaller vertex first."""
    following = chain[1:] + (chain[:1] if closed else [])
    return frozenset((min(a, b), max(a, b)) for a, b in zip(chain, following, strict=False))


class Blender:
    """Blender's edge mode on one mesh; `everything`: with all it has."""

    stops_at_seams = False
    path_begins_at_loop = True
    hand: Hand | None = None

    def __init__(self, mesh: Mesh, everything: bool) -> None:
        self.engine = BlenderEngine(topology=everything)
        self.engine.prepare(*mesh)
        self._everything = everything

    def offers(self, edge: Pair, _stops: frozenset[int]) -> Iterable[Edges]:
        """Return what one click on an edge can take, besides wires."""
        yield edges_of(*self.engine.strip(edge))
        if self._everything:
            for degrees in _FLAT:
                yield from self.engine.flat_borders(edge, degrees)

    def at_once(self) -> Edges:
        """Return what can be taken of the whole mesh by one command."""
        return self.engine.sharp_edges(_SHARP) if self._everything else frozenset()


class Seamwire:
    """The tool on one mesh, with its defaults.

    Parameters
    ----------
    mesh
        The mesh to draw on.
    past_poles, parts
        The way past poles, borders of parts are offered too.
    wobble
        How far a hand that draws lines is off them, in edges; None: none are drawn.
    """

    stops_at_seams = True
    path_begins_at_loop = False

    def __init__(self, mesh: Mesh, past_poles: bool, parts: bool, wobble: float | None = None) -> None:
        self.engine = SeamwireEngine()
        self.engine.prepare(*mesh)
        self.hand = None if wobble is None else Hand(self.engine.surface, wobble)
        self._points, self._past_poles = mesh[0], past_poles
        surface = self.engine.surface
        finder = PartFinder(surface) if parts else None
        labels = [] if finder is None else [finder.find(amount).of_face for amount in AMOUNTS]
        self._parts = PartSearch(lambda: self.engine.live, len(surface.triangles), find_parts=lambda *_: labels)
        self._parts.ready()
        self._parts.wait()
        self._loops: dict[Pair, list[int] | None] = {}
        self._engines = Engines(lambda _: self.engine.live, for_library)
        self._symmetry = Symmetry(mesh[0])

    def offers(self, edge: Pair, stops: frozenset[int]) -> Iterable[Edges]:
        """Return what one click on an edge can take, besides wires."""
        if edge not in self._loops:
            self._loops[edge] = self.engine.loop(edge)
        loop = self._loops[edge]
        if loop is not None:
            yield edges_of(loop, True)
        yield edges_of(*self.engine.strip(edge))
        yield edges_of(*self.engine.strip(edge, stops))
        if self._past_poles and not stops.issuperset(edge):
            for offer in self._parts.finder.find(edge, plane=list(stops)):
                if offer.kind == "past":
                    yield edges_of(offer.vertices.tolist(), offer.closed)
        for border in self._parts.finder.borders(edge):
            yield edges_of(border.tolist(), True)

    def at_once(self) -> Edges:
        """Return nothing: there is no such command."""
        return frozenset()

    def notches(self, wanted: Edges, taken: Edges, last: LoopKind | None) -> tuple[list[int], LoopKind | None]:
        """Return the turns from the first offer to the wanted one, for each edge that offers it, and its kind.

        The edges of loops `taken` before are seams, and `last` is the kind of the last one. The tool shows the crossing loop second, so
        every later offer takes one more turn.
        """
        stops = Stops(np.array(sorted(taken)), self._symmetry)
        loops = EdgeLoops(self._engines, stops, self._points, self._parts)
        # The last loop tells its kind. It has no edges here, because loops of other parts of the seams are no stops.
        drawn = Drawn() if last is None else Drawn((Wire("EDGES", (), self._points[:0], 0, 0, kind=last),))
        places, kind = [], None
        for edge in sorted(wanted)[:: max(1, len(wanted) // _EDGES_TRIED)]:
            offers, final = loops.find(edge, drawn)
            while not final:
                self.engine.live.wait()
                offers, final = loops.find(edge, drawn)
            place = next((i for i, offer in enumerate(offers) if set(offer.edges()) == wanted), None)
            if place is not None:
                places.append(place + (place > 0))
                kind = kind or offers[place].kind
        return places, kind


def clicks(
    measure: Any,  # noqa: ANN401
    near: dict[int, set[int]],
    tool: Blender | Seamwire | _Without,
    seams: Edges,
    notches: list[list[int]] | None = None,
) -> Count:
    """Count the clicks for a set of seams: loops and strips where each saves the most, and wires for what is left.

    The places of what is taken among the offers, for some of its edges, are appended to `notches`.
    """
    known: dict[tuple[tuple[int, ...], bool], Count] = {}

    def chain_clicks(chain: list[int], closed: bool) -> Count:
        key = (tuple(chain), closed)
        if key not in known:
            if not closed and len(chain) == 2:
                known[key] = Count(1)  # marked as soon as it is selected
            else:
                wires, turns, _ = measure.Expert(tool.engine, near, chain, closed).measure()[0]
                known[key] = Count(1 + wires, turns)
            if tool.hand is not None:
                drags = tool.hand.drags(chain, closed)
                known[key] = min(known[key], Count(drags, 0.0, drags))
        return known[key]

    def wire_clicks(left: Edges) -> Count:
        chains = measure.chains(sorted(left))
        total = sum((chain_clicks(chain, closed) for chain, closed in chains), Count())
        if tool.hand is not None:
            alone = [chain for chain, closed in chains if not closed and chain_clicks(chain, closed).presses == 1]
            through = tool.hand.through_junctions(alone)
            single = sum(chain_clicks(chain, False).drags == 0 for chain in alone)
            total += Count(-through, 0.0, -min(through, max(0, len(alone) - single)))
        return total

    at_once = tool.at_once()
    if at_once and at_once <= seams:
        rest = seams - at_once
        with_it, without = clicks(measure, near, _Without(tool), rest), clicks(measure, near, _Without(tool), seams)
        return min(Count(1) + with_it, without)
    total, last = Count(), None
    for left in connected(seams):
        whole, taken, drawn, stops = left, 0, frozenset(), frozenset()
        while left:
            offered = {some for edge in left for some in tool.offers(edge, stops) if some <= whole}
            costs = {some: wire_clicks(left - some) for some in offered}
            best = min(costs, key=costs.__getitem__, default=None)
            if best is None or costs[best].presses + 1 >= wire_clicks(left).presses:
                break
            if isinstance(tool, Seamwire):
                places, last = tool.notches(best, drawn, last)
                if notches is not None and places:
                    notches.append(places)
                total += Count(0, float(np.mean(places)) if places else 0.0)
            left, taken, drawn = left - best, taken + 1, drawn | best
            if tool.stops_at_seams:
                stops |= {vertex for edge in best for vertex in edge}
        spared = min(taken, len(measure.chains(sorted(left)))) if tool.path_begins_at_loop else 0
        total += wire_clicks(left) + Count(taken - spared)
    return total


class _Without:
    """A tool without what it can do at once."""

    def __init__(self, tool: Blender | Seamwire) -> None:
        self._tool = tool

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401
        return getattr(self._tool, name)

    def at_once(self) -> Edges:
        return frozenset()


def connected(seams: Edges) -> list[Edges]:
    """Split edges into parts that share no vertex."""
    part: dict[int, int] = {}

    def root(vertex: int) -> int:
        while part.setdefault(vertex, vertex) != vertex:
            part[vertex] = part[part[vertex]]
            vertex = part[vertex]
        return vertex

    for a, b in seams:
        part[root(a)] = root(b)
    groups: dict[int, set[Pair]] = {}
    for edge in seams:
        groups.setdefault(root(edge[0]), set()).add(edge)
    return [frozenset(group) for group in groups.values()]


def drawn_once(points: np.ndarray, seams: Edges) -> list[Edges]:
    """Return what is drawn with mirroring on, and what without."""
    mirror = Symmetry(points)
    if not mirror.symmetric_axes:
        return [seams]
    axis = mirror.symmetric_axes[0]
    images = {edge: image_of(mirror, axis, edge) for edge in seams}
    both = {edge for edge, image in images.items() if image in seams}
    kept = frozenset(edge for edge in both if points[list(edge), axis].mean() > 0 or images[edge] == edge)
    return [kept, seams - both]


def image_of(mirror: Symmetry, axis: int, edge: Pair) -> Pair | None:
    """Return the mirror image of an edge; None where it has none."""
    image = mirror.partners((axis,))[list(edge)]
    return None if (image < 0).any() else (int(image.min()), int(image.max()))


def mirrored(measure: Any, near: dict[int, set[int]], tool: Blender | Seamwire, mesh: Mesh, seams: Edges) -> Count:  # noqa: ANN401
    """Count the clicks where one side is drawn, unless that takes more: who sees that leaves mirroring off."""
    parts = drawn_once(mesh[0], seams)
    return sum((clicks(measure, near, tool, part) for part in parts), Count())


def mean_ratio(clicked: np.ndarray, beside: np.ndarray) -> str:
    """Return the geometric mean of ratios with the interval that holds 95 % of what other choices of the models would give."""
    logs = np.log(clicked / beside)
    again = np.random.default_rng(0).choice(logs, (10_000, len(logs))).mean(axis=1)
    low, high = np.exp(np.quantile(again, (0.025, 0.975)))
    return f"{np.exp(logs.mean()):.2f} [{low:.2f}, {high:.2f}]"


ROWS = {
    "Blender": lambda mesh: Blender(mesh, everything=False),
    "Blender, all it has": lambda mesh: Blender(mesh, everything=True),
    "Seamwire": lambda mesh: Seamwire(mesh, past_poles=False, parts=False),
    "Seamwire, past poles": lambda mesh: Seamwire(mesh, past_poles=True, parts=False),
    "Seamwire, borders of parts": lambda mesh: Seamwire(mesh, past_poles=True, parts=True),
}
DRAGGING = {
    "Seamwire, drags, wobble 0.2": lambda mesh: Seamwire(mesh, past_poles=True, parts=True, wobble=0.2),
    "Seamwire, drags, exact": lambda mesh: Seamwire(mesh, past_poles=True, parts=True, wobble=0.0),
}
"""With --drags."""
WITHOUT = {
    "Blender, all it has": "Blender",
    "Seamwire, past poles": "Seamwire",
    "Seamwire, borders of parts": "Seamwire, past poles",
    "Seamwire, drags, wobble 0.2": "Seamwire, borders of parts",
    "Seamwire, drags, exact": "Seamwire, borders of parts",
}
"""Who has more need not use it: what is chosen here, where it saves the most at once, may end with more clicks."""


def main() -> None:
    """Print a line a model, then the table: presses, turns, and ratios to Blender's presses, not mirrored and mirrored."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seams", type=Path)
    parser.add_argument("--models", nargs="*")
    parser.add_argument("--drags", action="store_true", help="lines drawn by dragging too")
    chosen = parser.parse_args()
    sys.path.insert(0, str(chosen.seams))
    measure = importlib.import_module("measure")
    rows = ROWS | DRAGGING if chosen.drags else ROWS
    table: dict[str, list[Count]] = {f"{row}{way}": [] for way in ("", ", mirrored") for row in rows}
    offered = []
    for path in sorted((chosen.seams / "data").glob("*.npz")):
        if chosen.models and path.stem not in chosen.models:
            continue
        points, offsets, corners, near, listed = measure.load(str(path))
        seams, mesh = frozenset(listed), (points, offsets, corners)
        for row, make in rows.items():
            tool = make(mesh)
            notches: list[list[int]] = []
            plain = clicks(measure, near, tool, seams, notches)
            for way, count in (("", plain), (", mirrored", min(mirrored(measure, near, tool, mesh, seams), plain))):
                less = table[f"{WITHOUT[row]}{way}"][-1:] if row in WITHOUT else []
                table[f"{row}{way}"].append(min([count, *less]))
        offered += notches  # of the last row, the tool as it is
        presses = " ".join(f"{counts[-1].presses:4d}" for counts in table.values())
        print(f"{path.stem:40s} {len(seams):5d} edges, clicks: {presses}", flush=True)
    presses = {row: np.array([count.presses for count in counts], dtype=float) for row, counts in table.items()}
    print(f"{len(presses['Blender'])} models: presses, turns, presses that draw lines")
    print("and presses to those of Blender, Blender mirrored, all of Blender mirrored")
    for row, counts in table.items():
        ratios = [
            mean_ratio(presses[row], presses[other])
            for other in ("Blender", "Blender, mirrored", "Blender, all it has, mirrored")
        ]
        turns = sum(count.turns for count in counts)
        drags = sum(count.drags for count in counts)
        print(f"{row:38s} {presses[row].sum():6.0f} {turns:6.0f} {drags:6d}  " + "  ".join(ratios))
    first = np.mean([np.mean(np.array(places) == 0) for places in offered])
    turned = np.mean([np.mean(places) for places in offered])
    print(f"{len(offered)} loops and strips: offered first {first:.3f}, notches of the wheel {turned:.3f}")


if __name__ == "__main__":
    main()
