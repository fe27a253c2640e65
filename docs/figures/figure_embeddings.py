# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures 7 to 9 of the paper: invalid triangles, subdivision, and what they cost."""

from __future__ import annotations

import subprocess
import time
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING

import numpy as np
from figure_models import Model
from figure_sheet import Bar, Key, Panel, sheet
from figure_stage import CLAY, INK, SEED
from figure_studio import length_colors, resampled
from seamwire_lab.fields import band_levels

if TYPE_CHECKING:
    from collections.abc import Callable

    import seamwire_core
    from figure_studio import Studio
    from numpy.typing import NDArray
    from PIL import Image

ROOT = Path(__file__).parents[2]
INVALID, MENDED = (0.15, 0.35, 0.95), (0.62, 0.78, 1.0)
SIZES = {"rocker-arm": 50_000, "armadillo": 100_000, "nefertiti": 200_000}
"""Triangles of the models in Figure 8: as many as the paper's have."""
OTHERS = {
    "Rocker (50k)": (
        (10, 0.065, 10.72, 0.003, 45, 100, 0.43),
        (20, 0.065, 11.00, 0.008, 420, 1088, 0.45),
        (30, 0.065, 10.93, 0.019, 1144, 3102, 0.45),
    ),
    "Feline (100k)": (
        (10, 0.149, 22.49, 0.007, 135, 306, 1.080),
        (20, 0.149, 22.68, 0.016, 760, 1742, 1.081),
        (30, 0.150, 23.55, 0.031, 1890, 4632, 1.001),
    ),
    "Buddha (200k)": (
        (10, 0.305, 51.71, 0.019, 648, 1380, 2.003),
        (20, 0.305, 51.62, 0.050, 2866, 6440, 2.138),
        (30, 0.305, 52.18, 0.098, 6157, 14850, 1.990),
    ),
}
"""Figure 8 of the paper: A, norms, global optimization, subdivision, invalid, added, seeding."""


def embedding(studio: Studio) -> Image.Image:
    """Figure 7: invalid triangles, what a part of them looks like before and after subdivision; distances by both ways."""
    model = studio.model("nefertiti", "armadillo", "suzanne")
    metric = model.metric("feature", max_anisotropy=20.0)
    made = model.embed(metric)
    invalid = studio.core.invalid_faces(model.surface, metric)
    before = np.tile(CLAY, (len(model.triangles), 1))
    before[invalid] = INVALID
    place = _densest(model, invalid)
    stage = studio.stage(model, 5)
    stage.balls(model.points[model.triangles[invalid]].mean(axis=1), INVALID, 0.003)
    panels = [Panel(studio.render(stage), f"{len(invalid)} invalid", _key(INVALID))]
    after = np.tile(CLAY, (len(made.triangles), 1))
    after[np.isin(made.source_face, invalid)] = MENDED
    left = invalid_in(made)
    after[left] = INVALID
    of_edges = model.surface.edges
    for points, triangles, edges, colors, title, key in (
        (model.points, model.triangles, of_edges, before, "before", _key(INVALID)),
        (made.points, made.triangles, made.edges, after, f"after: {len(left)} invalid", _key(MENDED, "cut up, valid")),
    ):
        stage = studio.empty_stage(model, 5, len(panels[0].picture) / panels[0].picture.shape[1])
        stage.mesh(points, triangles, colors)
        stage.wireframe(points, edges, 0.0002)
        stage.turn_to(model.curvature.normals[place])
        stage.look_at(model.points[place], 28.0)
        panels.append(Panel(studio.render(stage), title, key))
    start, end = model.vertex_at(0.5, 0.1, 0.4), model.vertex_at(0.5, 0.9, 0.9)
    for one, title in ((optimized(studio, model, metric)[1], "optimized [CHK13]"), (made, "subdivided")):
        field = studio.core.distance_field(one, start)
        farthest = float(field.distances[np.isfinite(field.distances)].max())
        stage = studio.stage(model, 5, colors=length_colors(field.distances / farthest))
        levels = band_levels(farthest)
        pieces, faces, _ = studio.core.isolines(model.surface, field.distances, levels)
        # Flat triangles are shown rounded by their normals: lines in their planes would sink in.
        above = 0.001 * model.size * model.curvature.normals[model.triangles[faces]].mean(axis=1)
        stage.segments(pieces + above[:, None], INK, 0.0016, sides=3)
        stage.line(field.trace(end).points, SEED, 0.008)
        panels.append(
            Panel(studio.render(stage), title, Bar("distance", "0", f"{farthest / model.size:.2f}", length_colors))
        )
    return sheet([panels])


def _key(color: tuple[float, float, float], name: str = "invalid") -> Key:
    return Key(((name, color),))


def invalid_in(made: seamwire_core.Embedding) -> NDArray[np.intp]:
    """Return the triangles of an embedding whose longest side is longer than both others."""
    count = len(made.points)
    codes = np.sort(made.edges, axis=1).astype(np.int64) @ (count, 1)
    order = np.argsort(codes)
    corners = np.stack([made.triangles, np.roll(made.triangles, -1, axis=1)], axis=2)
    sides = np.sort(corners, axis=2).astype(np.int64) @ (count, 1)
    lengths = made.lengths[order[np.searchsorted(codes[order], sides)]]
    return np.flatnonzero(2.0 * lengths.max(axis=1) > lengths.sum(axis=1) * (1.0 + 1e-12))


def optimized(studio: Studio, model: Model, metric: seamwire_core.Metric) -> tuple[float, seamwire_core.Embedding]:
    """Return the surface embedded by global optimization [CHK13], and the seconds that it took; in a Python that has the solver."""
    surface = model.surface
    given, made = studio.folder / "global-in.npz", studio.folder / "global-out.npz"
    lengths = studio.core.metric_lengths(surface, metric)
    np.savez(given, triangles=model.triangles, edges=surface.edges, lengths=lengths)
    # Not with Blender's packages, which its environment leads to.
    program = ROOT / "native/bench/global_optimization.py"
    subprocess.run([ROOT / ".venv/bin/python", "-E", program, "--arrays", given, made], check=True)
    with np.load(made) as data:
        changed = dict(zip(map(tuple, surface.edges.tolist()), data["lengths"].tolist(), strict=True))
        seconds = float(data["seconds"])
    plain = model.embed(model.metric("euclidean"))
    return seconds, plain.with_lengths([changed[min(a, b), max(a, b)] for a, b in plain.edges.tolist()])


def _densest(model: Model, faces: NDArray[np.int32]) -> int:
    """Return the vertex of such faces around which most others of them are."""
    centres = model.points[model.triangles[faces]].mean(axis=1)
    if not len(centres):
        return int(model.triangles[0, 0])
    some = np.linspace(0, len(centres) - 1, min(len(centres), 300)).astype(int)
    near = [(np.linalg.norm(centres - centres[i], axis=1) < 0.03 * model.size).sum() for i in some]
    return int(model.triangles[faces[some[int(np.argmax(near))]], 0])


def times(studio: Studio) -> str:
    """Figure 8: times and counts beside the paper's."""
    lines = [
        "| model (triangles), A | norms | Opt | subdivision | invalid / added | seeding | exploring |",
        "|---|---|---|---|---|---|---|",
    ]
    for name, rows in OTHERS.items():
        for a, norms, solved, subdivision, invalid, added, seeding in rows:
            lines.append(
                f"| the paper's {name}, {a} | {norms:.3f} | {solved:.2f} | {subdivision:.3f} | {invalid}/{added} | {seeding:.2f} | 0.001 |"
            )
    for name, count in SIZES.items():
        model = resampled(studio.models[name], count) if name in studio.models else None
        lines += [_times_of(studio, model, a) for a in (10, 20, 30) if model is not None]
    return "\n".join(lines) + "\n"


def _times_of(studio: Studio, model: Model, a: int) -> str:
    core = studio.core
    # A surface keeps its curvature.
    fresh = [core.Surface(model.points, model.triangles) for _ in range(3)]
    norms, curvature = _timed(*(lambda one=one: core.principal_curvatures(one) for one in fresh))
    surface = fresh[-1]
    more, metric = _timed(lambda: core.feature_metric(surface, curvature, max_anisotropy=float(a)))
    subdivision, made = _timed(lambda: core.embed(surface, metric, max_error=0))
    solved, _ = optimized(studio, model, metric)
    seeds = np.linspace(0, len(model.points) - 1, 5).astype(int).tolist()
    core.distance_field(made, seeds[0], max_distance=0.0)  # what the solver needs of the embedding is built once
    seeding, field = _timed(*(lambda seed=seed: core.distance_field(made, seed) for seed in seeds))
    targets = np.linspace(0, len(model.points) - 1, 200).astype(int).tolist()
    exploring, _ = _timed(*(lambda v=v: field.trace(v) for v in targets))
    left = f", {made.invalid_left} left" if made.invalid_left else ""
    seconds = [f"{value:#.3g}" for value in (norms + more, solved, subdivision, seeding, exploring)]
    counts = f"{made.invalid_before}/{made.faces_added}{left}"
    return (
        f"| {model.name} ({len(model.triangles) / 1000:.0f}k), {a} | {seconds[0]} | {seconds[1]} | {seconds[2]} | {counts} | "
        f"{seconds[3]} | {seconds[4]} |"
    )


def _timed(*calls: Callable[[], object]) -> tuple[float, object]:
    """Return the median of the seconds that calls take, or of three of the only one, and what the last returned."""
    calls = calls * 3 if len(calls) == 1 else calls
    seconds, made = [], None
    for call in calls:
        begin = time.perf_counter()
        made = call()
        seconds.append(time.perf_counter() - begin)
    return median(seconds), made


def campens_invalid(studio: Studio) -> Image.Image:
    """Figure 9: invalid triangles in Campen's metric, A = 20, before and after triangles are cut."""
    panels = []
    for names in (("armadillo", "suzanne"), ("rocker-arm",)):
        model = studio.model(*names)
        metric = model.metric("campen", max_anisotropy=20.0)
        faces = studio.core.invalid_faces(model.surface, metric)
        made = model.embed(metric)
        for color, text in (
            (INVALID, f"before: {len(faces):,} invalid"),
            (MENDED, f"{made.faces_added:,} added: {made.invalid_left} invalid"),
        ):
            colors = np.tile(CLAY, (len(model.triangles), 1))
            colors[faces] = color
            panels.append(Panel(studio.render(studio.stage(model, 4, colors=colors)), text))
    return sheet([panels])
