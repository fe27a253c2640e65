# SPDX-License-Identifier: GPL-3.0-or-later
"""How far wires between two points of a person's boundary run from that boundary, for several strengths of the metric.

    python native/bench/human_cuts.py PSB_FOLDER [--models N] [--boundaries N] [--seed N]
    python native/bench/human_cuts.py PSB_FOLDER --clicks N [--models N] [--subdivide N] [--seed N]

PSB_FOLDER holds off/N.off and seg/N_k.seg (a segment number per face) of Chen, Golovinskiy, Funkhouser, "A Benchmark for 3D Mesh
Segmentation" (2009). A boundary is a chain of edges between two segments, closed or from junction to junction. On each one sampled a
vertex is joined to those a third and a half of the boundary's length further on, across the surface. Distances are from 200 points evenly
along the wire to the nearest point of the boundary, in percent of the length of the person's boundary between the two vertices. Models are
weighted alike; intervals hold 95 % of 2000 bootstrap samples of models. Needs numpy, and seamwire_core on the path.

With --clicks, it measures the results of one click and of two, from so many vertices of closed boundaries for each model. One click is
`LiveWire.closed_wires` in the concave metric. The second click bends the nearest of its loops to the vertex of the boundary that is
farthest from it. Distances are between closed lines, in thousandths of the unit cube. They are the mean distance to the other line, over
200 points evenly along each of the two. Another person's line is the one of that person that is nearest to the first person's. Times are
processor time of all threads. Either half is every second model.
"""

import argparse
import sys
import time
from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import seamwire_core as sw
from numpy.typing import NDArray

Points = NDArray[np.float64]
Triangles = NDArray[np.int32]
MakeMetric = Callable[[sw.Surface, sw.Curvature, str], sw.Metric]

# Their first wire leads, whichever is shorter in its own metric.
FIRST_LEADS = "concave"
FRACTIONS = (1 / 3, 1 / 2)
# Shorter boundaries leave too few edges between the two points for a distance to say anything but how edges zigzag.
FEWEST_EDGES = 24
WIRE_SAMPLES = 200
# A wire this near (in percent of the arc) is taken to be the one that the person meant.
NEAR = 5.0
DEFAULT = "A = 20, clamp 99"
# The benchmark numbers its models by category, twenty to each; these are things people make, the others are living beings.
CATEGORY_SIZE = 20
MADE = {1, 2, 3, 5, 7, 10, 16, 17, 18}


def feature(**parameters: float) -> MakeMetric:
    """Return a maker of our metric (eq. 5)."""
    return lambda surface, curvature, follow: sw.feature_metric(surface, curvature, follow, **parameters)


def campen(max_anisotropy: float) -> MakeMetric:
    """Return a maker of Campen's metric (eq. 3)."""
    return lambda surface, curvature, follow: sw.campen_metric(
        surface, curvature, follow, max_anisotropy=max_anisotropy
    )


def concave(strength: float, radius: float | None = 0.01) -> MakeMetric:
    """Return a maker of the concave metric, and of the Euclidean one as its second wire."""

    def make(surface: sw.Surface, curvature: sw.Curvature, follow: str) -> sw.Metric:
        if follow == "max":
            return sw.euclidean_metric(surface, curvature)
        smoothed = curvature if radius is None else sw.smoothed_curvatures(surface, curvature, radius)
        return sw.concave_metric(surface, smoothed, strength)

    return make


SETTINGS: dict[str, MakeMetric] = {
    "Euclidean (A = 1)": lambda surface, curvature, _: sw.euclidean_metric(surface, curvature),
    **{f"A = {a}, clamp 99": feature(max_anisotropy=float(a), clamp_percentile=99.0) for a in (5, 10, 20, 40)},
    "A = 20, no clamp": feature(max_anisotropy=20.0),
    **{f"gamma = {g}, no clamp": feature(gamma=g) for g in (0.03, 0.1)},
    **{f"Campen, A = {a}": campen(float(a)) for a in (5, 20)},
    **{f"concave, strength {t}, and Euclidean": concave(t) for t in (0.5, 1.0, 2.0)},
    "concave, not smoothed, and Euclidean": concave(1.0, None),
}


@dataclass(frozen=True)
class Boundary:
    """A chain of vertices between segments; a closed one has its first vertex again at the end."""

    vertices: NDArray[np.int32]
    closed: bool


@dataclass(frozen=True)
class Arc:
    """A line that a person drew between two vertices of a boundary."""

    start: int
    end: int
    length: float


def read_off(file: Path) -> tuple[Points, Triangles]:
    """Read a triangle mesh: (n, 3) points and (m, 3) triangles."""
    words = file.read_text().split()
    n, m = int(words[1]), int(words[2])
    points = np.array(words[4 : 4 + 3 * n], dtype=np.float64).reshape(n, 3)
    faces = np.array(words[4 + 3 * n : 4 + 3 * n + 4 * m], dtype=np.int32).reshape(m, 4)
    return points, np.ascontiguousarray(faces[:, 1:])


def boundaries(triangles: Triangles, labels: NDArray[np.int32]) -> list[Boundary]:
    """Chain up the edges between faces of different labels, from junction to junction or all around."""
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    edges, faces = edges[order], order // 3
    pairs = np.flatnonzero((edges[1:] == edges[:-1]).all(axis=1))
    cut = edges[pairs[labels[faces[pairs]] != labels[faces[pairs + 1]]]]
    around: dict[int, list[int]] = defaultdict(list)
    for a, b in cut.tolist():
        around[a].append(b)
        around[b].append(a)
    unused = {frozenset(edge) for edge in cut.tolist()}
    junctions = [v for v, ends in around.items() if len(ends) != 2]
    chains = []
    for first in (*junctions, *around):
        for second in around[first]:
            if frozenset((first, second)) not in unused:
                continue
            chain = [first, second]
            unused.remove(frozenset(chain))
            while chain[-1] != first and len(around[chain[-1]]) == 2:
                a, b = around[chain[-1]]
                chain.append(b if a == chain[-2] else a)
                unused.remove(frozenset(chain[-2:]))
            chains.append(Boundary(np.array(chain, dtype=np.int32), chain[-1] == first))
    return chains


def arcs(points: Points, boundary: Boundary, random: np.random.Generator) -> list[Arc]:
    """Choose a vertex of the boundary, and those that lie the FRACTIONS of its length further on."""
    at = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(points[boundary.vertices], axis=0), axis=1))))
    whole = at[-1]
    start = int(np.abs(at - random.uniform(0, whole * (1 if boundary.closed else 1 - max(FRACTIONS)))).argmin())
    chosen = []
    for fraction in FRACTIONS:
        wanted = at[start] + fraction * whole
        end = int(np.abs(at - (wanted % whole if boundary.closed else wanted)).argmin())
        length = (at[end] - at[start]) % whole
        chosen.append(Arc(int(boundary.vertices[start]), int(boundary.vertices[end]), float(length)))
    return chosen


def distances(wire: Points, chain: Points) -> NDArray[np.float64]:
    """Return how far points evenly along a wire are from a chain of segments."""
    at = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(wire, axis=0), axis=1))))
    samples = np.stack([np.interp(np.linspace(0, at[-1], WIRE_SAMPLES), at, wire[:, i]) for i in range(3)], axis=1)
    return to_chain(samples, chain)


def to_chain(places: Points, chain: Points) -> NDArray[np.float64]:
    """Return how far each of some places is from a chain of segments (in space)."""
    start, along = chain[:-1], np.diff(chain, axis=0)
    squares = np.maximum((along**2).sum(axis=1), np.finfo(float).tiny)
    t = np.clip(((places[:, None] - start) * along).sum(axis=2) / squares, 0, 1)
    return np.linalg.norm(places[:, None] - start - t[:, :, None] * along, axis=2).min(axis=1)


def measure(
    points: Points, surface: sw.Surface, chosen: list[tuple[Boundary, list[Arc]]], make: MakeMetric, first_leads: bool
) -> Points:
    """Return (wires, 5): mean and largest distance of the leading wire, mean of the better one; whether either mean is NEAR.

    The shorter wire leads, or the first one.

    Distances are in percent of the arcs' lengths.
    """
    curvature = sw.principal_curvatures(surface)
    embeddings = [sw.embed(surface, make(surface, curvature, follow), max_error=0) for follow in ("min", "max")]
    rows = []
    for boundary, pairs in chosen:
        fields = [sw.distance_field(embedding, pairs[0].start) for embedding in embeddings]
        for arc in pairs:
            wires = [field.trace(arc.end) for field in fields]
            if not first_leads:
                wires.sort(key=lambda wire: wire.length)
            off = [100 / arc.length * distances(wire.points, points[boundary.vertices]) for wire in wires]
            better = min(o.mean() for o in off)
            rows.append((off[0].mean(), off[0].max(), better, 100 * (off[0].mean() < NEAR), 100 * (better < NEAR)))
    return np.array(rows)


@dataclass(frozen=True)
class Click:
    """The result of one click, in thousandths of the unit cube."""

    first: float  # distance of the first loop from the person's line; inf without loops
    best: float  # of the best of three
    bent: float  # of the nearest one, after a second click where the person's line is farthest from it
    others: tuple[float, ...]  # of each other person's nearest line
    shown_time: float  # milliseconds until there are loops
    final_time: float  # and until they are final
    bend_time: float  # with what is the same wherever the second click is
    second_time: float  # for another second click


def apart(one: Points, two: Points) -> float:
    """Return how far two lines are from each other, on average both ways."""
    return float((distances(one, two).mean() + distances(two, one).mean()) / 2)


def subdivided(points: Points, triangles: Triangles) -> tuple[Points, Triangles]:
    """Cut each triangle in four at the middles of its edges."""
    sides = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, of_side = np.unique(sides, axis=0, return_inverse=True)
    ab, bc, ca = (of_side.reshape(-1, 3) + len(points)).T
    a, b, c = triangles.T
    finer = np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1).reshape(-1, 3)
    return np.vstack([points, points[edges].mean(axis=1)]), finer.astype(np.int32)


def line_of(cut: sw.LiveClosedWire) -> Points:
    """Return the points around a cut."""
    return np.vstack([piece.points[:-1] for piece in cut.pieces] + [cut.pieces[-1].points[-1:]])


def answer(ask: Callable[[], sw.LiveClosedWires]) -> tuple[sw.LiveClosedWires, float, float]:
    """Ask until the answer is final; return it, and the milliseconds until there were cuts, and until it was final."""
    began = time.process_time()
    shown = None
    while True:
        found = ask()
        taken = 1000 * (time.process_time() - began)
        if shown is None and found.cuts:
            shown = taken
        if found.final:
            return found, taken if shown is None else shown, taken
        time.sleep(0.001)


def click_on(
    live: sw.LiveWire,
    scale: float,
    vertices: NDArray[np.int32],
    vertex: int,
    line: Points,
    others: list[list[Points]],
) -> Click:
    """Ask for the loops through a vertex of a person's line, then bend the nearest to another vertex of it."""
    found, shown_time, final_time = answer(lambda: live.closed_wires(vertex))
    loops = [line_of(cut) for cut in found.cuts]
    off = [1000 * scale * apart(loop, line) for loop in loops]
    peers = tuple(1000 * scale * min(apart(other, line) for other in theirs) for theirs in others if theirs)
    bent_off, bend_time, second_time = np.inf, 0.0, 0.0
    if off:
        nearest = int(np.argmin(off))
        second = int(vertices[np.argmax(to_chain(line, loops[nearest]))])
        cut = found.cuts[nearest].id
        bent, _, bend_time = answer(lambda: live.bent_wire(vertex, second, cut))
        _, _, second_time = answer(lambda: live.bent_wire(vertex, int(vertices[0]), cut))
        bent_off = min((1000 * scale * apart(line_of(cut), line) for cut in bent.cuts), default=np.inf)
    return Click(
        off[0] if off else np.inf,
        min(off, default=np.inf),
        bent_off,
        peers,
        shown_time,
        final_time,
        bend_time,
        second_time,
    )


def clicks(
    file: Path, labels: list[Path], count: int, levels: int, random: np.random.Generator
) -> tuple[list[Click], int]:
    """Click on vertices of people's closed boundaries of one model; return what that gave, and the number of triangles."""
    points, triangles = read_off(file)
    lines = {
        seg.stem: [
            (b.vertices, points[b.vertices])
            for b in boundaries(triangles, np.loadtxt(seg, dtype=np.int32))
            if b.closed and len(b.vertices) > FEWEST_EDGES
        ]
        for seg in labels
    }
    pool = [(person, vertices, line) for person, own in lines.items() for vertices, line in own]
    if not pool:
        return [], len(triangles)
    for _ in range(levels):
        points, triangles = subdivided(points, triangles)
    surface = sw.Surface(points, triangles)
    live = sw.LiveWire(surface, metric="concave")
    live.wait()  # what all have in common is not a click's
    found = []
    for _ in range(count):
        person, vertices, line = pool[random.integers(len(pool))]
        others = [[other for _, other in own] for name, own in lines.items() if name != person]
        found.append(click_on(live, surface.scale, vertices, int(random.choice(vertices)), line, others))
    return found, len(triangles)


def print_clicks(per_model: list[list[Click]], faces: list[int], random: np.random.Generator) -> None:
    """Print what clicks gave, models weighted alike."""
    draws = random.integers(0, len(per_model), (2000, len(per_model)))

    def share(value: Callable[[Click], float]) -> str:
        means = np.array([np.mean([value(click) for click in clicks]) for clicks in per_model])
        low, high = np.percentile(means[draws].mean(axis=1), (2.5, 97.5))
        return f"{100 * means.mean():.0f} % ({100 * low:.0f} to {100 * high:.0f})"

    def within(other: tuple[float, ...], limit: float) -> float:
        return float(np.mean(np.array(other) <= limit)) if other else 0.0

    everything = [click for clicks in per_model for click in clicks]
    rows: dict[str, tuple[Callable[[Click, float], float], list[float]]] = {
        "first loop": (lambda click, limit: click.first <= limit, [click.first for click in everything]),
        "best of three": (lambda click, limit: click.best <= limit, [click.best for click in everything]),
        "two clicks": (lambda click, limit: click.bent <= limit, [click.bent for click in everything]),
        "another person": (
            lambda click, limit: within(click.others, limit),
            [other for click in everything for other in click.others],
        ),
    }
    print(f"{len(everything)} clicks on {len(per_model)} models of {np.median(faces):.0f} triangles")
    print("| | within 10 | within 20 | median |")
    print("|---|---|---|---|")
    for name, (is_within, off) in rows.items():
        near, fair = (
            share(lambda click, limit=limit, is_within=is_within: is_within(click, limit)) for limit in (10.0, 20.0)
        )
        print(f"| {name} | {near} | {fair} | {np.median(off):.1f} |")
    nearer = share(lambda click: bool(click.others) and click.first < np.mean(click.others))
    print(
        f"the first loop is nearer than the mean other person: {nearer}; none: {share(lambda c: not np.isfinite(c.first))}"
    )
    times = {
        "loops shown": "shown_time",
        "final": "final_time",
        "bent": "bend_time",
        "to another second click": "second_time",
    }
    medians = []
    for name, attribute in times.items():
        taken = np.array([getattr(click, attribute) for click in everything])
        medians.append(f"{name} {np.median(taken):.1f} ({np.percentile(taken, 90):.1f})")
    print(f"milliseconds, medians (90th percentiles): {', '.join(medians)}")


def measure_clicks(options: argparse.Namespace) -> None:
    """Click on models, print."""
    per_model, faces = [], []
    for file in sample(options.folder, options.models, np.random.default_rng(options.seed)):
        random = np.random.default_rng((options.seed, int(file.stem)))
        labels = sorted((options.folder / "seg").glob(f"{file.stem}_*.seg"))
        found, count = clicks(file, labels, options.clicks, options.subdivide, random)
        if not found:
            print(f"{file.name}: no closed boundary of {FEWEST_EDGES} edges", file=sys.stderr)
            continue
        per_model.append(found)
        faces.append(count)
        near = [np.mean([getattr(c, name) <= 10 for c in found]) for name in ("first", "best")]
        print(f"{file.name}: {count} triangles, first {near[0]:.2f}, best {near[1]:.2f}", file=sys.stderr, flush=True)
    print_clicks(per_model, faces, np.random.default_rng(options.seed))
    for half in (per_model[::2], per_model[1::2]):
        first, best = (
            100 * np.mean([np.mean([getattr(click, name) <= 10 for click in found]) for found in half])
            for name in ("first", "best")
        )
        print(f"{len(half)} models of them: within 10 first loop {first:.1f} %, best of three {best:.1f} %")


def sample(folder: Path, count: int, random: np.random.Generator) -> list[Path]:
    """Choose models, from as many categories as there are."""
    by_category: dict[int, list[Path]] = defaultdict(list)
    for file in sorted((folder / "off").glob("*.off")):
        by_category[category(file)].append(file)
    ranked = [(rank, file) for files in by_category.values() for rank, file in enumerate(random.permutation(files))]
    random.shuffle(ranked)
    return [file for _, file in sorted(ranked, key=lambda entry: entry[0])[:count]]


def category(file: Path) -> int:
    """Return the number of a model's category."""
    return (int(file.stem) - 1) // CATEGORY_SIZE


def print_table(per_model: dict[str, Points], made: NDArray[np.bool_], random: np.random.Generator) -> None:
    """Print a line for each setting; per_model has its (models, 5) means."""
    draws = random.integers(0, len(made), (2000, len(made)))
    print("| metric | leading | of it made / living | largest | near | to default | better | near | to default |")
    print("|---|---|---|---|---|---|---|---|---|")
    for name, values in per_model.items():
        shorter, largest, better, near, better_near = values.mean(axis=0)
        low, high = np.percentile(values[draws, 0].mean(axis=1), (2.5, 97.5))
        groups = " / ".join(f"{values[of, 0].mean():.1f}" if of.any() else "-" for of in (made, ~made))
        to_default = (
            ["", ""] if name == DEFAULT else [ratio(values[:, i], per_model[DEFAULT][:, i], draws) for i in (0, 2)]
        )
        print(
            f"| {name} | {shorter:.1f} ({low:.1f} to {high:.1f}) | {groups} | {largest:.1f} | {near:.0f} % | {to_default[0]} |"
            f" {better:.1f} | {better_near:.0f} % | {to_default[1]} |"
        )


def ratio(ours: Points, default: Points, draws: NDArray[np.int64]) -> str:
    """Say how many times as far a setting's wires are as the default's, both on the same models."""
    low, high = np.percentile(ours[draws].mean(axis=1) / default[draws].mean(axis=1), (2.5, 97.5))
    return f"{ours.mean() / default.mean():.2f} ({low:.2f} to {high:.2f})"


def main() -> None:
    """Read the options, measure, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--models", type=int, default=38)
    parser.add_argument("--boundaries", type=int, default=3, help="of each model")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--clicks", type=int, default=0, help="on each model: measure loops from one click instead")
    parser.add_argument("--subdivide", type=int, default=0, help="each triangle in four, so often, for --clicks")
    options = parser.parse_args()
    if options.clicks:
        measure_clicks(options)
        return

    per_model: dict[str, list[Points]] = defaultdict(list)
    made, wires, edges = [], 0, []
    for file in sample(options.folder, options.models, np.random.default_rng(options.seed)):
        # A model's boundaries depend on the seed and the model alone, not on how many other models are taken.
        random = np.random.default_rng((options.seed, int(file.stem)))
        began = time.process_time()
        points, triangles = read_off(file)
        pool = [
            boundary
            for labels in sorted((options.folder / "seg").glob(f"{file.stem}_*.seg"))
            for boundary in boundaries(triangles, np.loadtxt(labels, dtype=np.int32))
            if len(boundary.vertices) > FEWEST_EDGES
        ]
        taken = random.permutation(len(pool))[: options.boundaries]
        chosen = [(pool[i], arcs(points, pool[i], random)) for i in taken]
        if not chosen:
            print(f"{file.name}: no boundary of {FEWEST_EDGES} edges", file=sys.stderr)
            continue
        surface = sw.Surface(points, triangles)
        for name, make in SETTINGS.items():
            per_model[name].append(measure(points, surface, chosen, make, name.startswith(FIRST_LEADS)).mean(axis=0))
        made.append(category(file) in MADE)
        wires += sum(len(pairs) for _, pairs in chosen)
        edge = np.linalg.norm(points[triangles[:, 0]] - points[triangles[:, 1]], axis=1).mean()
        edges.append(np.mean([100 * edge / arc.length for _, pairs in chosen for arc in pairs]))
        print(
            f"{file.name}: {len(chosen)} boundaries, {time.process_time() - began:.1f} s", file=sys.stderr, flush=True
        )
    print(f"{len(made)} models, {wires} pairs of points; an edge of the mesh is {np.mean(edges):.1f} % of an arc")
    print_table(
        {name: np.array(v) for name, v in per_model.items()}, np.array(made), np.random.default_rng(options.seed)
    )


if __name__ == "__main__":
    main()
