# SPDX-License-Identifier: GPL-3.0-or-later
"""A network as text that is kept with the mesh, and found again on a mesh that has changed."""

from __future__ import annotations

import itertools
import json
from typing import TYPE_CHECKING, Any

import numpy as np

from .network import LOOP_NAMES, Network, Wire, undirected, vertices_of
from .spatial_hash import SpatialHash
from .strokes import Scribble

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .network import Along, Edge, LoopKind, Pick
    from .strokes import ActsOn

FORMAT = "seamwire network"
VERSION = 1
_TOLERANCE = 1e-4
"""How far a vertex may have moved and still be found by its place, as part of the mesh's size."""


def dump(network: Network, points: NDArray[np.float64]) -> str:
    """Write the wires and strokes of a network; the live wire's seed is left out.

    Parameters
    ----------
    network
        Of vertices below n.
    points
        (n, 3) vertices.
    """
    used = {vertex for wire in network.wires for vertex in wire.vertices}
    for wire in network.wires:
        used.update(vertices_of(wire.start), vertices_of(wire.end), wire.heading or (), wire.through or ())
    for scribble in network.scribbles:
        used.update(scribble.corners.ravel().tolist())
    numbers = sorted(used)
    data = {
        "format": FORMAT,
        "version": VERSION,
        "vertex_count": len(points),
        "vertices": numbers,
        "coordinates": points[numbers].tolist(),
        "mirror": list(network.mirror),
        "wires": [_wire_data(wire) for wire in network.wires],
        "scribbles": [_scribble_data(scribble) for scribble in network.scribbles],
    }
    return json.dumps(data, separators=(",", ":"))


def _wire_data(wire: Wire) -> dict[str, Any]:
    data = {
        "along": wire.along,
        "vertices": list(wire.vertices),
        "start": wire.start,
        "end": wire.end,
        "closed": wire.closed,
        "marks": wire.marks,
        "heading": wire.heading,
        "follow": wire.follow,
        "strength": wire.strength,
    }
    if wire.kind is not None:
        data["kind"], data["through"] = wire.kind, wire.through
    if wire.along == "SURFACE":
        data["curve"] = wire.points.tolist()
    return data


def _scribble_data(scribble: Scribble) -> dict[str, Any]:
    return {
        "points": scribble.points.tolist(),
        "corners": scribble.corners.tolist(),
        "attracts": scribble.attracts,
        "acts_on": scribble.acts_on,
        "eta": scribble.eta,
        "rings": scribble.rings,
        "radius": scribble.radius,
    }


def load(text: str, points: NDArray[np.float64], edges: NDArray[np.int32]) -> tuple[Network, list[str]]:
    """Read a network, and find its vertices on the mesh as it is now.

    A vertex is the one with its number where that has its place, else the nearest to its place; where the mesh has as
    many vertices as before, and none is there, the one with its number has moved.

    Parameters
    ----------
    text
        What `dump` wrote.
    points
        (n, 3) vertices.
    edges
        (e, 2) visible edges.

    Returns
    -------
    network
        With the wires whose edges are all there; those whose seeds alone are there are its `lost` ones. Of its strokes
        only the corners say where they lie: see `scribbles.on_mesh`.
    problems
        In words, what could not be found; nothing is raised for a text that is not a network.
    """
    try:
        data = json.loads(text)
        if data["format"] != FORMAT:
            raise ValueError
        version = int(data["version"])
    except (ValueError, TypeError, KeyError, RecursionError):
        return Network(), ["The stored network cannot be read: it is damaged, or something else"]
    if version > VERSION:
        return Network(), ["The stored network was written by a newer Seamwire: this one cannot read it"]
    try:
        return _found(data, points, edges)
    except (ValueError, TypeError, KeyError, IndexError, OverflowError, AttributeError):
        return Network(), ["The stored network cannot be read: it is damaged"]


def _found(data: dict[str, Any], points: NDArray[np.float64], edges: NDArray[np.int32]) -> tuple[Network, list[str]]:
    numbers = np.array(data["vertices"], dtype=np.int64).reshape(-1)
    places = np.array(data["coordinates"], dtype=np.float64).reshape(len(numbers), 3)
    mapped, stayed = _matched(numbers, places, points, int(data["vertex_count"]) == len(points))
    number_of = dict(zip(numbers.tolist(), mapped.tolist(), strict=True))
    unmoved = {number for number, same in zip(numbers.tolist(), stayed.tolist(), strict=True) if same}
    mesh_edges = {(min(a, b), max(a, b)) for a, b in _edges_of(edges, mapped)}
    reader = _Reader(number_of, unmoved, mesh_edges, points)
    wires, lost, gone = [], [], 0
    for item in data["wires"]:
        wire = reader.wire(item)
        if wire is None:
            gone += 1
        else:
            (wires if wire.vertices else lost).append(wire)
    mirror = tuple(sorted({axis for axis in map(int, data["mirror"]) if 0 <= axis <= 2}))
    total = len(data["wires"])
    problems = []
    if lost:
        problems.append(
            f"{len(lost)} of {total} stored wires ran where edges are gone or hidden: drawn anew between their seeds"
        )
    if gone:
        problems.append(f"{gone} of {total} stored wires are left out: what they ran on is gone or hidden")
    scribbles, cut = [], 0
    stored = data.get("scribbles", [])  # there were none at first
    for item in stored:
        scribble = _scribble(item, number_of)
        cut += scribble is None or len(scribble.points) < len(item["points"])
        if scribble is not None:
            scribbles.append(scribble)
    if cut:
        problems.append(
            f"{cut} of {len(stored)} stored strokes are cut short or left out: what they were drawn on is gone or hidden"
        )
    return Network(tuple(wires), None, mirror, tuple(lost), tuple(scribbles)), problems


def _scribble(item: dict[str, Any], number_of: dict[int, int]) -> Scribble | None:
    """Return a stroke, as much of it in one piece as is there; None where that is nothing."""
    points = np.array(item["points"], dtype=np.float64).reshape(-1, 3)
    stored = np.array(item["corners"], dtype=np.int64).reshape(len(points), 3)
    acts_on: ActsOn = item["acts_on"]
    eta, rings = float(item["eta"]), int(item["rings"])
    radius = None if item["radius"] is None else float(item["radius"])
    sound = np.isfinite(points).all() and 1.0 <= eta < np.inf and rings >= 1 and (radius is None or 0 < radius < np.inf)
    if not sound or acts_on not in {"both", "min", "max"}:
        raise ValueError
    corners = np.array([[number_of[vertex] for vertex in triple] for triple in stored.tolist()], dtype=np.int32)
    corners = corners.reshape(-1, 3)
    there = (corners >= 0).all(axis=1)
    borders = np.flatnonzero(np.diff(np.concatenate([[False], there, [False]]).astype(np.int8)))
    begin, end = max(zip(borders[::2], borders[1::2], strict=True), key=lambda run: run[1] - run[0], default=(0, 0))
    if end - begin < 2:
        return None
    faces = np.full(end - begin, -1, dtype=np.int32)
    return Scribble(points[begin:end], corners[begin:end], faces, bool(item["attracts"]), acts_on, eta, rings, radius)


def _matched(
    numbers: NDArray[np.int64], places: NDArray[np.float64], points: NDArray[np.float64], same_count: bool
) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Return each stored vertex's number now, -1 where there is none, and whether it is where it was."""
    if not len(numbers) or not len(points) or not np.isfinite(places).all():
        return np.full(len(numbers), -1), np.zeros(len(numbers), dtype=bool)
    tolerance = max(_TOLERANCE * float(np.ptp(points, axis=0).max()), 1e-12)
    known = (numbers >= 0) & (numbers < len(points))
    here = points[np.where(known, numbers, 0)]
    stayed = known & (np.linalg.norm(here - places, axis=1) <= tolerance)
    mapped = np.where(stayed, numbers, -1)
    if not stayed.all():
        mapped[~stayed] = SpatialHash(points, tolerance).nearest(places[~stayed])
        stayed = mapped >= 0
        if same_count:
            mapped = np.where((mapped < 0) & known, numbers, mapped)
    return mapped, stayed


def _edges_of(edges: NDArray[np.int32], vertices: NDArray[np.int64]) -> list[list[int]]:
    """Return those edges whose ends are both among some vertices."""
    return edges[np.isin(edges, vertices).all(axis=1)].tolist()


class _Reader:
    """Reads wires, with the numbers that their vertices have now."""

    def __init__(
        self,
        number_of: dict[int, int],
        unmoved: set[int],
        edges: set[tuple[int, int]],
        points: NDArray[np.float64],
    ) -> None:
        self._number_of = number_of
        self._unmoved = unmoved
        self._edges = edges
        self._points = points

    def wire(self, item: dict[str, Any]) -> Wire | None:
        """Return a wire; one without vertices where only its seeds are there, None where not even they are."""
        along: Along = item["along"]
        if along not in {"EDGES", "SURFACE"}:
            raise ValueError
        closed = bool(item["closed"])
        stored = [int(vertex) for vertex in item["vertices"]]
        if len(stored) < (3 if closed else 2):
            raise ValueError
        start, end = self._pick(item["start"]), self._pick(item["end"])
        if start is None or end is None:
            return None
        vertices = tuple(self._number_of[vertex] for vertex in stored)
        around = vertices + vertices[:1] if closed else vertices
        whole = all(self._is_edge(a, b) for a, b in itertools.pairwise(around))
        if not whole and (closed or start == end):
            return None
        points = self._points[list(around)] if whole else np.empty((0, 3))
        if whole and "curve" in item and self._unmoved.issuperset(stored):
            points = np.array(item["curve"], dtype=np.float64).reshape(-1, 3)
            if len(points) < 2 or not np.isfinite(points).all():
                raise ValueError
        kind, through = self._clicked(item) if whole else (None, None)
        heading = None if item["heading"] is None else self._pick(item["heading"])
        return Wire(
            along,
            vertices if whole else (),
            points,
            start,
            end,
            closed=closed,
            marks=bool(item["marks"]),
            heading=heading if isinstance(heading, tuple) else None,
            follow=1 if item["follow"] else 0,
            strength=float(item["strength"]),
            kind=kind,
            through=through,
        )

    def _clicked(self, item: dict[str, Any]) -> tuple[LoopKind | None, Edge | None]:
        """Return what a wire is of what a click offered, and that click's edge; neither where it was drawn."""
        kind, stored = item.get("kind"), item.get("through")  # there were none at first
        if kind is None or kind == "EDGE":  # a single edge was an offer once; it is a wire like any other
            return None, None
        if kind not in LOOP_NAMES or not isinstance(stored, list):
            raise ValueError
        through = undirected(self._pick(stored))
        return (kind, through) if isinstance(through, tuple) else (None, None)

    def _is_edge(self, a: int, b: int) -> bool:
        return (min(a, b), max(a, b)) in self._edges

    def _pick(self, stored: int | list[int]) -> Pick | None:
        """Return a pick with the numbers of now; None where it is not there."""
        if isinstance(stored, list):
            a, b = (self._number_of[int(vertex)] for vertex in stored)
            return (a, b) if self._is_edge(a, b) else None
        vertex = self._number_of[int(stored)]
        return None if vertex < 0 else vertex
