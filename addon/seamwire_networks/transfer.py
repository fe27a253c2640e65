# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks on other meshes than they were drawn on: their seeds are placed there, and wires drawn between them.

If a wire would run elsewhere than its original, it gets as few further seeds as keep it near. The result tells how sure each seed is, and
names the seeds, wires and strokes that cannot be placed.
"""

from __future__ import annotations

import functools
import itertools
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from .network_file import FileCourse, NetworkFile, NetworkFileError
from .placing import (
    DOUBTFUL,
    PLACED,
    Landmarks,
    Moments,
    NearestSurface,
    Placed,
    Progress,
    Shape,
    Similarity,
    tell,
    within,
)
from .tool import (
    CLAMP_PERCENTILE,
    DEFAULT_FINISH,
    LOOP_KINDS,
    STRENGTHS,
    Drawn,
    LiveMaker,
    MirrorImages,
    Stroke,
    Symmetry,
    Wire,
    by_number,
    final,
    for_library,
    groups,
    load,
    nearest_on_segments,
    on_mesh,
    unpacked,
)

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray
    from seamwire_core import LiveCandidate, LiveWire, NearestPoints

    from .tool import Edge

Place = Literal["AUTO", "NUMBERS", "SURFACE", "PAIRS"]
"""How seeds are placed: by vertex numbers, on the nearest surface, or by distances to pairs of vertices. AUTO takes numbers if the topology
is the same, otherwise pairs if there are any, otherwise the surface."""

_TURNED = 0.5
"""The confidence of the surest seed if the network might as well lie elsewhere: doubtful."""

STRAY = 1.0
"""How many edges a wire may run beside where it is to run before it gets a seed more."""

_MOST_LOST = 0.3
"""The part of a wire's course that may have no place."""

_SLICE = 0.05
"""Seconds for which live wires are waited for before the progress is told again."""

DEGREES = ((0.9, "sure"), (0.6, "likely"), (DOUBTFUL, "doubtful"), (0.0, "not placed"))
"""The least confidence of each degree of a seed."""


@dataclass(frozen=True)
class PlacedSeed:
    """A seed of the network on another mesh."""

    source: int  # its vertex on the mesh that it comes from
    mirrored: tuple[int, ...]  # the axes over which it was mirrored before, 0 to 2
    vertex: int | None  # its vertex on the target, or None if it has no place
    confidence: float  # from 0 to 1, see `DEGREES`

    @property
    def degree(self) -> str:
        return next(degree for least, degree in DEGREES if self.confidence >= least)

    @property
    def text(self) -> str:
        """Where it is, and how sure that is."""
        where = "" if self.vertex is None else f" at vertex {self.vertex}"
        return f"seed {self.source}{where}: {self.degree} ({self.confidence:.2f})"


@dataclass
class Transfer:
    """A network on another mesh."""

    wires: list[Wire] = field(default_factory=list)  # connected as in the source
    strokes: list[Stroke] = field(default_factory=list)
    seeds: list[PlacedSeed] = field(default_factory=list)  # all seeds of the network, each once
    lost: list[str] = field(default_factory=list)  # what could not be placed, and why
    doubts: list[str] = field(default_factory=list)  # what else the artist should check
    added: int = 0  # the number of seeds between those of the network

    @property
    def degrees(self) -> dict[str, int]:
        """The number of seeds of each degree that occurs, the surest first."""
        counts = Counter(seed.degree for seed in self.seeds)
        return {degree: counts[degree] for _, degree in DEGREES if degree in counts}

    @property
    def problems(self) -> list[str]:
        """Everything that the artist should check: doubts, what is lost, and seeds that are not even likely."""
        unsure = (seed.text for seed in self.seeds if seed.confidence < DEGREES[1][0])
        return [*self.doubts, *self.lost, *unsure]

    @property
    def seams(self) -> NDArray[np.int32]:
        """(k, 2) the edges that wires mark, sorted, each once."""
        edges = sorted({edge for wire in self.wires for edge in wire.claims()})
        return np.array(edges, dtype=np.int32).reshape(-1, 2)


def transfer(
    file: NetworkFile,
    target: Shape,
    *,
    place: Place = "AUTO",
    mirror: int | None = None,
    align: bool = True,
    source: Shape | None = None,
    pairs: ArrayLike = (),
    topology: bool = False,
    live: LiveMaker | None = None,
    progress: Progress = lambda _: True,
) -> Transfer:
    """Find what a network is on a mesh.

    Parameters
    ----------
    mirror
        The axis, 0 to 2, over which the network is mirrored first, or None. Then it is placed on the surface.
    align
        On the surface: whether the network may be turned, scaled and moved onto the mesh, if it does not lie on it.
    source
        The mesh that the network was drawn on. PAIRS needs it.
    pairs
        (k, 2) vertices of the source and of the target that are the same point of the shape, three pairs at least.
    topology
        By numbers: whether mirror images are found by how the mesh is connected, see `Symmetry`.

    Raises
    ------
    ValueError
        If the mesh, the pairs or the choices do not fit.
    seamwire_core.Cancelled
        If `progress` returns False.
    """
    pairs = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    if mirror is not None and place in {"NUMBERS", "PAIRS"}:
        raise ValueError("Mirror needs Place: Nearest Surface")
    if place == "AUTO":
        same = mirror is None and not file.problem_with(target)
        by_pairs = len(pairs) and source is not None and mirror is None
        place = "NUMBERS" if same else "PAIRS" if by_pairs else "SURFACE"
    progress = _Told(progress)
    tell(progress, 0.0)
    if place == "NUMBERS":
        return _by_numbers(file, target, topology)
    live = live or LiveMaker(target)
    if place == "SURFACE":
        return _by_surface(file, target, mirror, align, live, progress)
    if source is None:
        raise ValueError("Pairs need the source object")
    return _by_pairs(file, source, target, pairs, live, progress)


class _Told:
    """A progress that remembers which fraction it was told last."""

    def __init__(self, progress: Progress) -> None:
        self._progress, self._done = progress, 0.0

    def __call__(self, fraction: float) -> bool:
        """Tell the finished fraction of the whole work, and return whether to continue."""
        self._done = fraction
        return self._progress(fraction)

    def go_on(self, _fraction: float) -> bool:
        """Return whether to continue, while work goes on whose part of the whole is not known."""
        return self._progress(self._done)


def _check(file: NetworkFile, shape: Shape) -> None:
    if problem := file.problem_with(shape):
        raise NetworkFileError(problem)


def _by_numbers(file: NetworkFile, target: Shape, topology: bool) -> Transfer:
    _check(file, target)
    symmetry = Symmetry(target.points, target.edges, target.where.to_object, topology, target.triangles)
    network = Drawn(tuple(map(MirrorImages(symmetry).completed, file.wires(target))))
    wires = list(network.wires)
    ends = dict.fromkeys(
        vertex for wire in wires if not wire.closed for vertex in (wire.vertices[0], wire.vertices[-1])
    )
    seeds = [PlacedSeed(vertex, (), vertex, 1.0) for vertex in ends]
    return Transfer(wires, file.strokes_on(target), seeds)


def _by_surface(
    file: NetworkFile, target: Shape, mirror: int | None, align: bool, live: LiveMaker, progress: _Told
) -> Transfer:
    """Return a network on a mesh with about the same shape and any topology."""
    surface, doubt = NearestSurface(target, progress.go_on), ""
    way = Similarity.mirroring(*(() if mirror is None else (mirror,)))
    if align and file.courses:
        points = way.of(np.concatenate([course.places for course in file.courses]))
        moments = file.origin.moments
        moved = Moments(way.of(moments.middle[None])[0], way.of_normals(moments.axes))
        aligned, doubt = surface.align(points, moved, progress)
        way = aligned.after(way)

    def place(course: FileCourse, axes: tuple[int, ...], part: int | None = None) -> Placed:
        own = way.after(Similarity.mirroring(*axes))
        spacing = own.scale * course.spacing
        placed = surface.place(own.of(course.places), own.of_normals(course.normals), spacing, part)
        return replace(placed, confidence=np.minimum(placed.confidence, _TURNED)) if doubt else placed

    def stroke(points: NDArray[np.float64]) -> Placed:
        moved = way.of(points)
        return surface.place(moved, np.zeros_like(moved), float(target.spacing.mean()))

    found = Tracing(file, target, surface, live, progress).run(place, stroke, place)
    found.doubts += [doubt] if doubt else []
    return found


def _by_pairs(
    file: NetworkFile, source: Shape, target: Shape, pairs: NDArray[np.int64], live: LiveMaker, progress: _Told
) -> Transfer:
    """Return a network on a mesh with another pose or proportion and any topology."""
    _check(file, source)
    surface = NearestSurface(target, progress.go_on)
    landmarks = Landmarks(source, target, pairs, within(progress, 0.0, PLACED))
    tell(progress, PLACED)

    @functools.cache
    def vertices() -> NearestPoints:
        # Triangles without area, so that vertices without faces are found as well.
        triangles = np.repeat(np.arange(len(source.places)), 3).reshape(-1, 3)
        return load().NearestPoints(source.places, triangles, progress=progress.go_on)

    def nearest(points: NDArray[np.float64]) -> NDArray[np.int64]:
        return vertices().find(points, progress=progress.go_on)[0].astype(np.int64)

    def place(course: FileCourse, axes: tuple[int, ...]) -> Placed:
        if axes:
            return landmarks.place(nearest(Similarity.mirroring(*axes).of(course.places)))
        return landmarks.place(np.array(course.record["vertices"], dtype=np.int64))

    def stroke(points: NDArray[np.float64]) -> Placed:
        return landmarks.place(nearest(points))

    return Tracing(file, target, surface, live, progress, stray=2.0 * STRAY).run(place, stroke)


@dataclass(frozen=True)
class _CoursePart:
    """A part of a wire between two seeds of the network: its vertices on the source, and where they are on the target."""

    course: FileCourse
    axes: tuple[int, ...]
    vertices: list[int]
    triangles: NDArray[np.int64]
    places: NDArray[np.float64]
    confidence: NDArray[np.float64]
    creases: NDArray[np.float64]

    def at(self, rows: Sequence[int]) -> _CoursePart:
        return replace(
            self,
            vertices=[self.vertices[row] for row in rows],
            triangles=self.triangles[rows],
            places=self.places[rows],
            confidence=self.confidence[rows],
            creases=self.creases[rows],
        )

    def part(self, begin: int, end: int) -> _CoursePart:
        return self.at(range(begin, end + 1))

    @property
    def name(self) -> str:
        name = self.course.name
        return f"{name}, mirrored" if self.axes else name


Key = tuple[tuple[int, ...], int]
"""A seed: the axes over which it was mirrored, and its vertex on the source."""


class Tracing:
    """Draws the wires of a network on another mesh. They may `stray` so many edges from their courses."""

    def __init__(
        self,
        file: NetworkFile,
        target: Shape,
        surface: NearestSurface,
        live: LiveMaker,
        progress: Progress,
        stray: float = STRAY,
    ) -> None:
        self._file, self._target, self._surface, self._make = file, target, surface, live
        self._stray, self._done, self._progress = stray, PLACED, progress
        self._lives: dict[tuple[str, float], LiveWire] = {}
        self._result = Transfer()
        self._library_strokes: list[object] = []
        self._vertex_of: dict[Key, int | None] = {}

    def run(
        self,
        place: Callable[[FileCourse, tuple[int, ...]], Placed],
        place_stroke: Callable[[NDArray[np.float64]], Placed],
        place_on: Callable[[FileCourse, tuple[int, ...], int], Placed] | None = None,
    ) -> Transfer:
        """Draw all wires.

        `place` and `place_stroke` return where the vertices of a course and the points of a stroke are on the target. `place_on` returns
        where a course is on one part of it, unless all of it counts.
        """
        result = self._result
        for number, record in enumerate(self._file.strokes, start=1):
            stroke = self._stroke(record, place_stroke(unpacked(record["points"])))
            if stroke is None:
                result.lost.append(f"stroke {number}: could not be placed")
            else:
                result.strokes.append(stroke)
        self._library_strokes = [for_library(stroke) for stroke in result.strokes]
        runs = [(course, axes) for course in self._file.courses for axes in _images(course.record["mirror"])]
        placed = []
        for run in runs:
            tell(self._progress, self._done)
            placed.append(place(*run))
        if place_on is not None:
            # Courses that share a vertex hang together on the mesh that they come from.
            for group in groups([[(axes, vertex) for vertex in course.record["vertices"]] for course, axes in runs]):
                self._keep_together(group, runs, placed, place_on)
        pieces = [_placed(*run, found) for run, found in zip(runs, placed, strict=True)]
        for piece in pieces:  # each vertex where wires end is placed once, so that what met meets
            for row in () if piece.course.record["closed"] else (0, -1):
                self._seed(piece, row)
        pieces = list(self._cut(pieces))
        for number, piece in enumerate(pieces):
            self._done = PLACED + (1.0 - PLACED) * number / len(pieces)
            result.wires += self._wires(piece)
        return result

    def _keep_together(
        self,
        group: list[int],
        runs: list[tuple[FileCourse, tuple[int, ...]]],
        placed: list[Placed],
        place_on: Callable[[FileCourse, tuple[int, ...], int], Placed],
    ) -> None:
        """Place what hangs together on the one part of the target that has most of it, as far as it has a place there."""
        parts = self._surface.parts
        known = [placed[row].triangles[placed[row].confidence >= DOUBTFUL] for row in group]
        counts = np.bincount(parts[np.concatenate(known)])
        if np.count_nonzero(counts) < 2:
            return
        part = int(counts.argmax())
        for row in group:
            before = placed[row]
            if (parts[before.triangles] == part).all():
                continue
            there = place_on(*runs[row], part)
            moved = (parts[before.triangles] != part) & (there.confidence >= DOUBTFUL)
            placed[row] = Placed(
                np.where(moved, there.triangles, before.triangles),
                np.where(moved[:, None], there.places, before.places),
                np.where(moved, there.confidence, before.confidence),
            )

    # Seeds

    def _seed(self, piece: _CoursePart, row: int) -> int | None:
        key = piece.axes, piece.vertices[row]
        if key not in self._vertex_of:
            confidence = float(piece.confidence[row])
            vertex = self._vertex(piece, row) if confidence >= DOUBTFUL else None
            self._vertex_of[key] = vertex
            self._result.seeds.append(PlacedSeed(key[1], key[0], vertex, confidence))
        return self._vertex_of[key]

    def _vertex(self, piece: _CoursePart, row: int) -> int:
        return self._surface.vertex(int(piece.triangles[row]), piece.places[row], float(piece.creases[row]))

    def _cut(self, pieces: Iterable[_CoursePart]) -> Iterable[_CoursePart]:
        """Yield the pieces, cut wherever another one ends within them."""
        for piece in pieces:
            last = len(piece.vertices) - 1
            inner = [row for row in range(1, last) if (piece.axes, piece.vertices[row]) in self._vertex_of]
            closed = piece.course.record["closed"]
            if closed and (inner or (piece.axes, piece.vertices[0]) in self._vertex_of):
                # Opened where something meets it; the seam is the same.
                begin = ([0] if (piece.axes, piece.vertices[0]) in self._vertex_of else inner)[0]
                around = [*range(begin, last), *range(begin + 1)]
                piece = piece.at(around)
                inner = [row for row in range(1, last) if (piece.axes, piece.vertices[row]) in self._vertex_of] or [
                    last // 2
                ]
            for begin, end in itertools.pairwise([0, *inner, last]):
                yield piece.part(begin, end)

    # Wires

    def _wires(self, piece: _CoursePart) -> list[Wire]:
        lost = float((piece.confidence < DOUBTFUL).mean())
        if lost > _MOST_LOST:
            return self._lose(piece, f"{lost:.0%} of its course could not be placed on this mesh")
        if piece.vertices[0] == piece.vertices[-1]:
            return self._loop(piece)
        ends = [self._seed(piece, row) for row in (0, -1)]
        if None in ends:
            return self._lose(piece, "one of its seeds could not be placed on this mesh")
        start, end = ends
        if start == end:
            return self._lose(piece, f"both its seeds would be at vertex {start} of this mesh")
        live = self._live(piece)
        found = self._between(live, piece, start, end)
        if found is None:
            return self._lose(piece, f"no wire leads from vertex {start} to vertex {end}")
        self._result.added += len(found) - 1
        return found

    def _lose(self, piece: _CoursePart, why: str) -> list[Wire]:
        self._result.lost.append(f"{piece.name}: {why}")
        return []

    def _between(self, live: LiveWire, piece: _CoursePart, start: int, end: int) -> list[Wire] | None:
        """Return wires between two vertices that run where a piece does, in order, or None if there is no way."""
        tell(self._progress, self._done)
        live.seed(start)
        best = self._best(live, end, piece.places)
        if best is None:
            return None
        follow, candidate, off, worst = best
        middle = self._vertex(piece, worst) if 0 < worst < len(piece.vertices) - 1 else start
        near = self._stray * max(float(self._target.spacing[candidate.vertices].mean()), piece.course.spacing / 2.0)
        if off > near and middle not in (start, end) and middle not in candidate.vertices:
            first = self._between(live, piece.part(0, worst), start, middle)
            second = self._between(live, piece.part(worst, len(piece.vertices) - 1), middle, end)
            if first is not None and second is not None:
                return [*first, *second]
        return [self._wire(piece, candidate, follow)]

    def _final(self, live: LiveWire, ask: Callable[[], Any]) -> Any:  # noqa: ANN401 - what it asks for
        """Return the final answer of live wires. Raise `seamwire_core.Cancelled` if the work is to stop meanwhile."""

        def ask_unless_stopped() -> object:
            tell(self._progress, self._done)
            return ask()

        return final(live, ask_unless_stopped)

    def _best(
        self, live: LiveWire, end: int, places: NDArray[np.float64]
    ) -> tuple[int, LiveCandidate, float, int] | None:
        """Return which of both wires runs nearer to a course, it, how far it strays, and from which place most."""
        found = self._final(live, lambda: live.wires(end))
        best = None
        for follow, candidate in enumerate(by_number(found)[0]):
            if len(candidate.vertices) < 2:
                continue
            off, worst = _strays(self._target.in_object(candidate.points), places)
            if best is None or off < best[2]:
                best = follow, candidate, off, worst
        return best

    def _wire(self, piece: _CoursePart, candidate: LiveCandidate, follow: int) -> Wire:
        record = piece.course.record
        vertices = tuple(candidate.vertices.tolist())
        return Wire(
            record["along"], vertices, np.array(candidate.points), vertices[0], vertices[-1],
            faces=np.array(candidate.faces) if record["along"] == "SURFACE" else None, follow=follow,
            strength=float(record["strength"]), finish=record.get("finish", DEFAULT_FINISH), images=(),
            planned=record.get("planned", False),
        )  # fmt: skip

    def _loop(self, piece: _CoursePart) -> list[Wire]:
        """Return a closed wire: the loop of its kind where that runs there, else wires around it."""
        live = self._live(piece)
        whole = self._closed(live, piece)
        if whole is not None:
            return [whole]
        count = len(piece.vertices) - 1
        rows = [0, count // 3, 2 * count // 3] if count >= 3 else [0]
        corners = list(dict.fromkeys(self._vertex(piece, row) for row in rows))
        if len(corners) < 3:
            return self._lose(piece, "smaller than an edge of this mesh")
        wires: list[Wire] = []
        for (begin, one), (end, other) in itertools.pairwise(zip([*rows, count], [*corners, corners[0]], strict=True)):
            found = self._between(live, piece.part(begin, end), one, other)
            if found is None:
                return self._lose(piece, f"no wire leads from vertex {one} to vertex {other}")
            wires += found
        self._result.added += len(wires)
        return wires

    def _closed(self, live: LiveWire, piece: _CoursePart) -> Wire | None:
        record = piece.course.record
        if record["along"] != "EDGES" or record.get("kind") not in LOOP_KINDS:
            return None
        edge = self._edge(piece)
        if edge is None:
            return None
        if record["kind"] == "CLOSED":
            loop = self._final(live, lambda: live.loop(edge))
            closed = len(loop.vertices) > 2
        else:
            while not live.wait(_SLICE):
                tell(self._progress, self._done)
            loop = live.edge_loop(edge, ())
            closed = loop.closed
        if not closed:
            return None
        chain = loop.vertices.tolist()
        around = [*chain, chain[0]]
        points = self._target.points[around]
        off, _ = _strays(self._target.in_object(points), piece.places)
        back, _ = _strays(piece.places, self._target.in_object(points))
        if max(off, back) > self._stray * max(float(self._target.spacing[chain].mean()), piece.course.spacing):
            return None
        return Wire(
            "EDGES", tuple(chain), points, edge, edge, closed=True, kind=record["kind"], through=edge, images=(),
            follow=record["follow"], strength=float(record["strength"]),
        )  # fmt: skip

    def _edge(self, piece: _CoursePart) -> Edge | None:
        """Return the edge of the target through which a loop runs, along its course."""
        vertex = self._vertex(piece, 0)
        along = piece.places[1] - piece.places[-2]
        places, best = self._target.places, None
        for other in self._target.around.get(vertex, []):
            step = places[other] - places[vertex]
            fits = abs(float(step @ along)) / max(float(np.linalg.norm(step)), 1e-300)
            if best is None or fits > best[0]:
                best = fits, (min(vertex, other), max(vertex, other))
        return None if best is None else best[1]

    def _live(self, piece: _CoursePart) -> LiveWire:
        """Return live wires that run as those of a piece did."""
        record = piece.course.record
        key = record["along"], float(record["strength"])
        if key not in self._lives:
            live = self._make(key[0])
            self._make.wait(lambda _fraction: self._progress(self._done))
            metric = self._file.metric, key[1] or STRENGTHS[key[0]], self._file.clamp
            if metric != ("feature", STRENGTHS[key[0]], CLAMP_PERCENTILE):
                live.set_metric(metric[0], max_anisotropy=metric[1], clamp_percentile=metric[2])
            if self._library_strokes:
                live.set_scribbles(self._library_strokes)
            self._lives[key] = live
        return self._lives[key]

    def _stroke(self, record: dict, placed: Placed) -> Stroke | None:
        rows = np.flatnonzero(placed.confidence >= DOUBTFUL)
        if len(rows) < 2:
            return None
        runs = np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1)
        rows = max(runs, key=len)
        if len(rows) < 2:
            return None
        shape = self._target
        points = shape.where.from_object(placed.places[rows])
        triangles = placed.triangles[rows]
        stroke = Stroke(
            points, shape.triangles[triangles], triangles.astype(np.int32), bool(record["attracts"]), record["acts_on"],
            float(record["eta"]), int(record["rings"]), None if record["radius"] is None else float(record["radius"]),
        )  # fmt: skip
        return on_mesh(stroke, shape.points, shape.triangles)


def _placed(course: FileCourse, axes: tuple[int, ...], placed: Placed) -> _CoursePart:
    """Return the whole of a wire. A closed one ends at the vertex where it begins."""
    vertices = list(course.record["vertices"])
    whole = _CoursePart(course, axes, vertices, placed.triangles, placed.places, placed.confidence, course.creases)
    return whole.at([*range(len(vertices)), 0]) if course.record["closed"] else whole


def _images(axes: Sequence[int]) -> list[tuple[int, ...]]:
    """Return over which axes a wire and its mirror images are mirrored."""
    return [some for count in range(len(axes) + 1) for some in itertools.combinations(axes, count)]


def _strays(curve: NDArray[np.float64], places: NDArray[np.float64]) -> tuple[float, int]:
    """Return how far the farthest of some places is from a curve, and which one that is."""
    gaps = [float(nearest_on_segments(place, curve[:-1], curve[1:])[1].min()) for place in places]
    worst = int(np.argmax(gaps))
    return gaps[worst], worst
