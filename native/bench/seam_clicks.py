# SPDX-License-Identifier: GPL-3.0-or-later
"""How many clicks reproduce artists' seams, edge for edge: with Seamwire, and with Blender's own tools.

    python native/bench/seam_clicks.py SEAMS

SEAMS is a folder with data/*.npz, a mesh and its seams each, and measure.py, whose simulated expert finds how far one wire reaches.
Needs SciPy. Presses of a mouse button are counted:

- Blender, edge mode: a click for the first edge of a chain, one for each shortest path from there on, and one for an edge loop, wherever
  one lies in the seams as a whole. A path may begin where an edge loop was clicked.
- Seamwire: a click for a chain's seed, one for each wire, and one for each offer of the loop gesture: a closed loop, a strip or a way
  past poles up to seams drawn before, a whole strip, wherever one lies in the seams as a whole, and a single edge.
- How often what the loop gesture is to take is what it offers first, and how many notches of the wheel it takes: over the edges of what is
  taken, about twelve of each, after what was taken before.
- The same, mirrored: where the mesh is symmetric, edges whose images are seams too are drawn once, if that takes fewer clicks. Blender's
  Select Mirror is counted as if it did the same.
"""

from __future__ import annotations

import argparse
import importlib
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from blender_engine import BlenderEngine
from seams_engine import SeamwireEngine

sys.path.insert(0, str(Path(__file__).parents[2] / "addon"))
from seamwire.core.edge_loops import find_offers, past_poles  # these know no Blender
from seamwire.core.symmetry import Symmetry

if TYPE_CHECKING:
    from seamwire.core.network import LoopKind

Pair = tuple[int, int]
Edges = frozenset[Pair]

_EDGES_TRIED = 12


def edges_of(chain: list[int], closed: bool) -> Edges:
    """Return the edges of a chain, smaller vertex first."""
    following = chain[1:] + (chain[:1] if closed else [])
    return frozenset((min(a, b), max(a, b)) for a, b in zip(chain, following, strict=False))


class Blender:
    """Blender's edge mode on one mesh."""

    single_edge = 1
    """Clicks for a chain of one edge: it is marked as soon as it is selected."""
    stops_at_seams = False
    path_begins_at_loop = True

    def __init__(self, points: np.ndarray, offsets: np.ndarray, corners: np.ndarray) -> None:
        self.engine = BlenderEngine()
        self.engine.prepare(points, offsets, corners)

    def offers(self, edge: Pair, _stops: frozenset[int]) -> Iterable[Edges]:
        """Return what one click on an edge can take, besides wires."""
        yield edges_of(*self.engine.strip(edge))


class Seamwire:
    """The tool on one mesh, with its defaults."""

    single_edge = 1
    stops_at_seams = True
    path_begins_at_loop = False

    def __init__(self, points: np.ndarray, offsets: np.ndarray, corners: np.ndarray) -> None:
        self.engine = SeamwireEngine()
        self.engine.prepare(points, offsets, corners)
        self._points = points
        self._loops: dict[Pair, list[int] | None] = {}

    def offers(self, edge: Pair, stops: frozenset[int]) -> Iterable[Edges]:
        """Return what one click on an edge can take, besides wires."""
        if edge not in self._loops:
            self._loops[edge] = self.engine.loop(edge)
        loop = self._loops[edge]
        if loop is not None:
            yield edges_of(loop, True)
        yield edges_of(*self.engine.strip(edge))
        yield edges_of(*self.engine.strip(edge, stops))
        chain, closed = past_poles(self.engine.live, edge, list(stops))
        yield edges_of(list(chain), closed)

    def notches(self, wanted: Edges, stops: frozenset[int], last: LoopKind | None) -> tuple[list[int], LoopKind | None]:
        """Return the place of what is taken among what its edges offer, for each edge that offers it, and what it is."""
        places, kind = [], None
        for edge in sorted(wanted)[:: max(1, len(wanted) // _EDGES_TRIED)]:
            final = False
            while not final:
                offers, final = find_offers(self.engine.live, edge, list(stops), self._points, 0.0, stops, last)
                self.engine.live.wait()
            place = next((i for i, offer in enumerate(offers) if set(offer.edges()) == wanted), None)
            if place is not None:
                places.append(place)
                kind = kind or offers[place].kind
        return places, kind


def clicks(
    measure: Any,  # noqa: ANN401
    near: dict[int, set[int]],
    tool: Blender | Seamwire,
    seams: Edges,
    notches: list[list[int]] | None = None,
) -> int:
    """Count the clicks for a set of seams: loops and strips where each saves the most, and wires for what is left.

    The places of what is taken among the offers, for some of its edges, are appended to `notches`.
    """
    known: dict[tuple[tuple[int, ...], bool], int] = {}

    def chain_clicks(chain: list[int], closed: bool) -> int:
        key = (tuple(chain), closed)
        if key not in known:
            single = not closed and len(chain) == 2
            expert = None if single else measure.Expert(tool.engine, near, chain, closed)
            known[key] = tool.single_edge if expert is None else 1 + expert.measure()[0][0]
        return known[key]

    def wire_clicks(left: Edges) -> int:
        return sum(chain_clicks(chain, closed) for chain, closed in measure.chains(sorted(left)))

    total, last = 0, None
    for left in connected(seams):
        whole, taken, stops = left, 0, frozenset()
        while left:
            offered = {some for edge in left for some in tool.offers(edge, stops) if some <= whole}
            costs = {some: wire_clicks(left - some) for some in offered}
            best = min(costs, key=costs.__getitem__, default=None)
            if best is None or costs[best] + 1 >= wire_clicks(left):
                break
            if notches is not None and isinstance(tool, Seamwire):
                places, last = tool.notches(best, stops, last)
                notches += [places] if places else []
            left, taken = left - best, taken + 1
            if tool.stops_at_seams:
                stops |= {vertex for edge in best for vertex in edge}
        spared = min(taken, len(measure.chains(sorted(left)))) if tool.path_begins_at_loop else 0
        total += wire_clicks(left) + taken - spared
    return total


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


def main() -> None:
    """Print a line a model, and the geometric mean of the ratios."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seams", type=Path)
    parser.add_argument("--models", nargs="*")
    chosen = parser.parse_args()
    sys.path.insert(0, str(chosen.seams))
    measure = importlib.import_module("measure")
    rows, offered = [], []
    for path in sorted((chosen.seams / "data").glob("*.npz")):
        if chosen.models and path.stem not in chosen.models:
            continue
        points, offsets, corners, near, listed = measure.load(str(path))
        seams = frozenset(listed)
        mesh = (points, offsets, corners)
        tools = Blender(*mesh), Seamwire(*mesh)
        notches: list[list[int]] = []
        plain = [clicks(measure, near, tool, seams, notches) for tool in tools]
        offered += notches
        parts = drawn_once(points, seams)
        # Whoever sees that mirroring costs more than it saves leaves it off.
        mirrored = [
            min(sum(clicks(measure, near, tool, part) for part in parts), most)
            for tool, most in zip(tools, plain, strict=True)
        ]
        row = [*plain, *mirrored]
        rows.append(row)
        print(
            "{:40s} {:5d} edges, clicks: {:4d} {:4d} mirrored: {:4d} {:4d}".format(path.stem, len(seams), *row),
            flush=True,
        )
    table = np.array(rows, dtype=float)
    ratios = np.exp(np.log(table[:, 1:] / table[:, :1]).mean(axis=0))
    print(
        "{} models, ratio to Blender: Seamwire {:.3f}; mirrored: Blender {:.3f}, Seamwire {:.3f}".format(
            len(rows), *ratios
        )
    )
    first = np.mean([np.mean(np.array(places) == 0) for places in offered])
    turned = np.mean([np.mean(places) for places in offered])
    print(f"{len(offered)} loops and strips: offered first {first:.3f}, notches of the wheel {turned:.3f}")


if __name__ == "__main__":
    main()
