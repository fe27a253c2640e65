# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures of the paper, made again with the project's own code: Blender runs this for ``scripts/figures``.

Arguments after ``--``: the folder to write into, the figures' numbers, models.
"""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING

sys.path.insert(0, str(Path(__file__).parent))

import addon_utils
import bpy
import numpy as np
from figure_models import Model, read, sphere
from figure_stage import CLAY, INK, SEED, Stage, beside, save
from shape_proxies import shape_proxies

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    import seamwire_core
    from numpy.typing import NDArray

ROOT = Path(__file__).parents[2]
PANEL = 300
"""Width of a picture; its height is what the model needs."""
PATHS = 350
ELLIPSES = 1100
METRICS = ("euclidean", "pottmann_kovacs", "campen", "feature")
COLORS = {
    "euclidean": (0.85, 0.12, 0.10),
    "campen": (0.80, 0.15, 0.75),
    "pottmann_kovacs": (0.10, 0.62, 0.20),
    "feature": (0.12, 0.30, 0.90),
}
"""Those of Figure 4."""
INVALID = (0.15, 0.35, 0.95)
RIDGE, VALLEY = (0.85, 0.16, 0.08), (0.10, 0.30, 0.85)
PROXIES = 40
"""Regions of the variational shape approximation in Figure 11."""
ISLANDS = (
    (0.55, 0.70, 0.88),
    (0.95, 0.80, 0.58),
    (0.65, 0.82, 0.66),
    (0.90, 0.66, 0.66),
    (0.76, 0.69, 0.87),
    (0.96, 0.90, 0.62),
)
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


class Figures:
    """Makes each figure as a picture, or as a table.

    Parameters
    ----------
    folder
        Where they go.
    models
        By name; Suzanne and the sphere among them.
    """

    def __init__(self, folder: Path, models: Mapping[str, Model]) -> None:
        from seamwire.core.fields import color_maps, metric_fields

        self._folder, self._models = folder, models
        self._maps, self._fields = color_maps, metric_fields
        self._core = next(iter(models.values())).core
        self._plans: dict[str, seamwire_core.SeamPlan] = {}

    def make(self, number: int) -> str:
        """Make one and return the file's name.

        Raises
        ------
        ValueError
            Where there is none of this number.
        """
        figures: dict[int, Callable[[], NDArray | str]] = {
            1: self.shortest_paths,
            3: self.on_a_sphere,
            4: self.along_ridge_and_valley,
            5: self.feature_strength,
            6: self.four_metrics,
            7: self.embedding,
            8: self.times,
            9: self.campens_invalid,
            10: self.scribble,
            11: self.segmentation,
            12: self.more_segmentations,
        }
        if number not in figures:
            raise ValueError(f"Figure {number} is none of those made again: {', '.join(map(str, figures))}")
        made = figures[number]()
        path = self._folder / f"figure-{number}.{'md' if isinstance(made, str) else 'png'}"
        if isinstance(made, str):
            path.write_text(made, encoding="utf-8")
        else:
            save(made, path)
        return path.name

    def _model(self, *names: str) -> Model:
        """Return the first of some models that is there, else the first of all."""
        return next((self._models[name] for name in names if name in self._models), next(iter(self._models.values())))

    def _stage(self, model: Model, width: int = PANEL) -> Stage:
        return Stage(model.points, model.view, width)

    def _render(self, stage: Stage) -> NDArray[np.float64]:
        return stage.render(self._folder / "render.png")

    def _add_paths(self, stage: Stage, model: Model, field: seamwire_core.DistanceField, width: float = 0.005) -> None:
        """Add shortest paths to many vertices, colored by their lengths, blue to red as in the paper."""
        chosen, _ = self._fields.spread(model.points, PATHS)
        paths = self._fields.Paths(*field.trace_many(chosen))
        pieces, lengths = paths.segments()
        finite = paths.lengths[np.isfinite(paths.lengths)]
        colors = self._maps.colors(lengths / finite.max(), self._maps.STRETCH)
        stage.segments(pieces, colors, width, sides=5)

    def _add_ellipses(self, stage: Stage, model: Model, metric: seamwire_core.Metric) -> None:
        """Add the norms as ellipses along e1 and e2, as the paper does, with the roots of l1 and l2 as axes.

        With l1 and l2 themselves, as its caption has it, those of anisotropy 20 are 400 times as long as wide: none is seen.
        """
        chosen, side = self._fields.spread(model.points, ELLIPSES)
        axes = metric.ellipses("norm")[chosen]
        axes = axes / np.maximum(np.sqrt(np.linalg.norm(axes, axis=2, keepdims=True)), 1e-300)
        sizes = np.linalg.norm(axes, axis=2)
        typical = float(np.median(np.sqrt(sizes.prod(axis=1))))
        # The longest would lie over all others: they shrink, and keep their proportions.
        factor = 0.34 * side / typical * np.minimum(1.0, 2.2 * typical / sizes[:, :1])
        ratio = np.log(sizes[:, 0] / np.maximum(sizes[:, 1], 1e-300))
        # Not from the map's dark end: that is the clay's shade.
        colors = self._maps.colors(0.25 + 0.75 * ratio / np.log(20.0), self._maps.VIRIDIS)
        stage.ellipses(model.points[chosen], metric.normals[chosen], axes * factor[:, :, None], colors)

    # The figures

    def shortest_paths(self) -> NDArray[np.float64]:
        """Figure 1: paths in the Euclidean metric and in ours, and a network of wires."""
        model = self._model("fertility")
        seed = model.vertex_at(0.5, 0.2, 0.95)
        panels = []
        for kind, strength in (("euclidean", {}), ("feature", {"gamma": 0.1})):
            stage = self._stage(model)
            stage.mesh(model.points, model.triangles)
            self._add_paths(stage, model, model.field(kind, seed, **strength))
            stage.balls(model.points[seed], (0.9, 0.1, 0.1), 0.016)
            panels.append(self._render(stage))
        stage = self._stage(model)
        self._add_network(stage, model)
        panels.append(self._render(stage))
        return beside([panels])

    def on_a_sphere(self) -> NDArray[np.float64]:
        """Figure 3: Campen's metric, alpha = 20, and ours, gamma = .1, on a nearly umbilical surface."""
        model = self._models["sphere"]
        seed = model.vertex_at(0.42, 0.06, 0.5)
        rows: list[list[NDArray[np.float64]]] = [[], []]
        for kind, strength in (("campen", {"alpha": 20.0}), ("feature", {"gamma": 0.1})):
            metric = model.metric(kind, **strength)
            stage = self._stage(model, 250)
            stage.mesh(model.points, model.triangles)
            self._add_ellipses(stage, model, metric)
            rows[0].append(self._render(stage))
            stage = self._stage(model, 250)
            stage.mesh(model.points, model.triangles)
            field = self._core.distance_field(model.embed(metric, kind), seed)
            self._add_paths(stage, model, field)
            stage.balls(model.points[seed], (0.9, 0.1, 0.1), 0.014)
            rows[1].append(self._render(stage))
        return beside(rows)

    def along_ridge_and_valley(self) -> NDArray[np.float64]:
        """Figure 4: geodesics of four metrics between points of a curved ridge, and of a curved valley."""
        model = self._model("rocker-arm")
        panels = []
        for sign in (1.0, -1.0):
            start, end = self._ends_on_a_feature(model, sign)
            stage = self._stage(model, 400)
            stage.mesh(model.points, model.triangles)
            for kind in METRICS:
                strength = {} if kind == "euclidean" else {"max_anisotropy": 20.0}
                wire = model.field(kind, start, **strength).trace(end)
                stage.line(wire.points, COLORS[kind], 0.010)
            stage.balls(model.points[[start, end]], INK, 0.014)
            normal = model.curvature.normals[[start, end]].sum(axis=0)
            stage.turn_to(normal)
            stage.look_at(model.points[[start, end]].mean(axis=0), 1.7)
            panels.append(self._render(stage))
        return beside([panels])

    def _ends_on_a_feature(self, model: Model, sign: float) -> tuple[int, int]:
        """Return two vertices on one ridge (sign 1) or valley (-1) that bends: our wire follows it, and is long for it.

        Of the strongest vertices one begins; of those between .25 and .7 away in our metric's wire, the end is that whose
        wire keeps to strong vertices most though the straight path leaves them.
        """
        strength, k1 = model.strength, model.curvature.k1
        strong = np.flatnonzero((strength > np.percentile(strength, 90)) & (sign * k1 > 0.0))
        starts = strong[self._fields.spread(model.points[strong], 12)[0]]
        best, found = -np.inf, (int(strong[0]), int(strong[-1]))
        capped = np.minimum(strength, np.percentile(strength, 97))
        for start in starts.tolist():
            ours, plain = model.field("feature", start, max_anisotropy=20.0), model.field("euclidean", start)
            others = strong[(plain.distances[strong] > 0.2) & (plain.distances[strong] < 0.5)]
            for end in others[self._fields.spread(model.points[others], 25)[0]].tolist() if len(others) else ():
                one, two = ours.trace(end), plain.trace(end)
                score = self._mean_along(model, one.points, capped) - self._mean_along(model, two.points, capped)
                if one.euclidean_length < 2.2 * two.euclidean_length and score > best:
                    best, found = score, (start, end)
        return found

    @staticmethod
    def _mean_along(model: Model, points: NDArray[np.float64], values: NDArray[np.float64]) -> float:
        """Return the mean of values of vertices along a curve, each place with the value of its nearest vertex."""
        along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
        at = np.linspace(0.0, along[-1], 24)
        places = np.stack([np.interp(at, along, column) for column in points.T], axis=1)
        near = [int(((model.points - place) ** 2).sum(axis=1).argmin()) for place in places]
        return float(values[near].mean())

    def feature_strength(self) -> NDArray[np.float64]:
        """Figure 5: s as heat, ridges and valleys, and the signed curvature beside them."""
        model = self._model("armadillo", "suzanne")
        smoothed = self._core.smoothed_curvatures(model.surface, model.curvature)
        limit = float(np.percentile(model.strength, 97))
        bend = float(np.percentile(np.abs(smoothed.k1), 97))
        panels = []
        for parts, colors in (
            (model.strength / limit, self._maps.VIRIDIS),
            (0.5 + 0.5 * smoothed.k1 / bend, self._maps.PURPLE_ORANGE),
        ):
            stage = self._stage(model)
            stage.mesh(model.points, model.triangles, self._maps.colors(parts, colors))
            panels.append(self._render(stage))
        panels.insert(1, self._ridges_and_valleys(model))
        return beside([panels])

    def _ridges_and_valleys(self, model: Model) -> NDArray[np.float64]:
        smoothed = self._core.smoothed_curvatures(model.surface, model.curvature)
        lines = self._core.crest_lines(model.surface, smoothed)
        inside = lines.faces >= 0
        pieces = np.stack([lines.points[:-1], lines.points[1:]], axis=1)[inside[:-1]]
        is_ridge = lines.curvatures[:-1][inside[:-1]] > 0.0
        stage = self._stage(model)
        stage.mesh(model.points, model.triangles)
        stage.segments(pieces, np.where(is_ridge[:, None], RIDGE, VALLEY), 0.006)
        return self._render(stage)

    def four_metrics(self) -> NDArray[np.float64]:
        """Figure 6: norms and paths of four metrics, A = 20."""
        model = self._model("rocker-arm")
        seed = model.vertex_at(0.85, 0.1, 0.6)
        rows: list[list[NDArray[np.float64]]] = [[], []]
        for kind in METRICS:
            strength = {} if kind == "euclidean" else {"max_anisotropy": 20.0}
            metric = model.metric(kind, **strength)
            stage = self._stage(model, 200)
            stage.mesh(model.points, model.triangles)
            self._add_ellipses(stage, model, metric)
            rows[0].append(self._render(stage))
            stage = self._stage(model, 200)
            stage.mesh(model.points, model.triangles)
            self._add_paths(stage, model, self._core.distance_field(model.embed(metric, kind), seed))
            stage.balls(model.points[seed], (0.9, 0.1, 0.1), 0.016)
            rows[1].append(self._render(stage))
        return beside(rows)

    def embedding(self) -> NDArray[np.float64]:
        """Figure 7: invalid triangles, what a part of them looks like before and after subdivision; distances by both ways."""
        model = self._model("nefertiti", "armadillo", "suzanne")
        metric = model.metric("feature", max_anisotropy=20.0)
        embedding = model.embed(metric)
        invalid = self._core.invalid_faces(model.surface, metric)
        colors = np.tile(CLAY, (len(model.triangles), 1))
        colors[invalid] = INVALID
        whole = self._stage(model, 230)
        whole.mesh(model.points, model.triangles, colors)
        place = self._densest(model, invalid)
        panels = [self._render(whole)]
        of_edges = np.unique(np.sort(_sides(model.triangles), axis=1), axis=0)
        for points, triangles, edges, shades in (
            (model.points, model.triangles, of_edges, colors),
            (embedding.points, embedding.triangles, embedding.edges, colors[embedding.source_face]),
        ):
            stage = self._stage(model, 230)
            stage.mesh(points, triangles, shades)
            stage.wireframe(points, edges, 0.0005)
            stage.turn_to(model.curvature.normals[place])
            stage.look_at(model.points[place], 12.0)
            panels.append(self._render(stage))
        start, end = model.vertex_at(0.5, 0.1, 0.4), model.vertex_at(0.5, 0.9, 0.9)
        for one in (self._optimized(model, metric)[1], embedding):
            field = self._core.distance_field(one, start)
            stage = self._stage(model, 230)
            parts = field.distances / field.distances[np.isfinite(field.distances)].max()
            stage.mesh(model.points, model.triangles, self._maps.colors(parts, self._maps.STRETCH))
            segments, _, _ = self._core.isolines(
                model.surface, field.distances, self._fields.band_levels(float(field.distances.max()))
            )
            stage.segments(segments, INK, 0.002, sides=3)
            stage.line(field.trace(end).points, SEED, 0.008)
            panels.append(self._render(stage))
        return beside([panels])

    def _optimized(self, model: Model, metric: seamwire_core.Metric) -> tuple[float, seamwire_core.Embedding]:
        """Return the surface embedded by global optimization [CHK13], and the seconds that it took; in a Python that has the solver."""
        surface = model.surface
        given, made = self._folder / "global-in.npz", self._folder / "global-out.npz"
        lengths = self._core.metric_lengths(surface, metric)
        np.savez(given, triangles=model.triangles, edges=surface.edges, lengths=lengths)
        # Not with Blender's packages, which its environment leads to.
        command = [
            ROOT / ".venv/bin/python",
            "-E",
            ROOT / "native/bench/global_optimization.py",
            "--arrays",
            given,
            made,
        ]
        subprocess.run(command, check=True)
        with np.load(made) as data:
            changed = dict(zip(map(tuple, surface.edges.tolist()), data["lengths"].tolist(), strict=True))
            seconds = float(data["seconds"])
        plain = model.embed(model.metric("euclidean"), "euclidean")
        return seconds, plain.with_lengths([changed[min(a, b), max(a, b)] for a, b in plain.edges.tolist()])

    @staticmethod
    def _densest(model: Model, faces: NDArray[np.int32]) -> int:
        """Return the vertex of such faces around which most others of them are."""
        centres = model.points[model.triangles[faces]].mean(axis=1)
        if not len(centres):
            return int(model.triangles[0, 0])
        some = np.linspace(0, len(centres) - 1, min(len(centres), 300)).astype(int)
        near = [(np.linalg.norm(centres - centres[i], axis=1) < 0.03 * model.size).sum() for i in some]
        return int(model.triangles[faces[some[int(np.argmax(near))]], 0])

    def times(self) -> str:
        """Figure 8: times and counts beside the paper's."""
        lines = [
            "| model (triangles) | A | norms | Opt | subdivision | invalid / added | seeding | exploring |",
            "|---|---|---|---|---|---|---|---|",
        ]
        for name, rows in OTHERS.items():
            for a, norms, optimized, subdivision, invalid, added, seeding in rows:
                counts = f"{invalid}/{added}"
                lines.append(
                    f"| the paper's {name} | {a} | {norms:.3f} | {optimized:.2f} | {subdivision:.3f} | {counts} | {seeding:.2f} | 0.001 |"
                )
        for model in self._models.values():
            if model.name == "sphere":
                continue  # it has no features
            for a in (10, 20, 30):
                lines.append(self._times_of(model, a))
        return "\n".join(lines) + "\n"

    def _times_of(self, model: Model, a: int) -> str:
        core, surface = self._core, model.surface
        norms, curvature = _timed(lambda: core.principal_curvatures(surface))
        more, metric = _timed(lambda: core.feature_metric(surface, curvature, max_anisotropy=float(a)))
        subdivision, embedding = _timed(lambda: core.embed(surface, metric))
        optimized, _ = self._optimized(model, metric)
        seeds = np.linspace(0, len(model.points) - 1, 5).astype(int).tolist()
        core.distance_field(
            embedding, seeds[0], max_distance=0.0
        )  # what the solver needs of the embedding is built once
        seeding, field = _timed(*(lambda seed=seed: core.distance_field(embedding, seed) for seed in seeds))
        targets = np.linspace(0, len(model.points) - 1, 200).astype(int).tolist()
        exploring, _ = _timed(*(lambda v=v: field.trace(v) for v in targets))
        left = f", {embedding.invalid_left} left" if embedding.invalid_left else ""
        return (
            f"| {model.name} ({len(model.triangles) / 1000:.0f}k) | {a} | {norms + more:.3f} | {optimized:.2f} | {subdivision:.4f} | "
            f"{embedding.invalid_before}/{embedding.faces_added}{left} | {seeding:.2f} | {exploring:.5f} |"
        )

    def campens_invalid(self) -> NDArray[np.float64]:
        """Figure 9: invalid triangles in Campen's metric, A = 20, before and after subdivision."""
        model = self._model("armadillo", "suzanne")
        metric = model.metric("campen", max_anisotropy=20.0)
        embedding = model.embed(metric, "campen")
        panels = []
        for faces in (self._core.invalid_faces(model.surface, metric), embedding.hole_faces):
            stage = self._stage(model)
            colors = np.tile(CLAY, (len(model.triangles), 1))
            colors[faces] = INVALID
            stage.mesh(model.points, model.triangles, colors)
            panels.append(self._render(stage))
        return beside([panels])

    def scribble(self) -> NDArray[np.float64]:
        """Figure 10: the metric, a scribble, the metric that it makes, and wires in both."""
        model = self._models["suzanne"]
        start, end = model.vertex_at(0.32, 0.0, 0.80), model.vertex_at(0.68, 0.0, 0.80)
        over = model.vertex_at(0.5, 0.1, 0.97)
        points = self._arc_on(model, start, over, end)
        faces = _faces_at(model, points)
        metric = model.metric("feature", gamma=0.1)
        stroke = self._core.Scribble(points, faces=faces, radius=0.12)
        drawn = self._core.apply_scribbles(model.surface, metric, [stroke])
        place, panels = model.points[over], []
        for of, with_stroke, with_wire in (
            (metric, False, False),
            (metric, True, True),
            (drawn, True, False),
            (drawn, False, True),
        ):
            stage = self._stage(model)
            stage.mesh(model.points, model.triangles)
            if not with_wire:
                self._add_ellipses(stage, model, of)
            if with_stroke:
                stage.line(points, (0.95, 0.45, 0.05), 0.006)
            if with_wire:
                wire = self._core.distance_field(model.embed(of), start).trace(end)
                stage.line(wire.points, INK, 0.009)
                stage.balls(model.points[[start, end]], SEED)
            stage.look_at(place - (0.0, 0.0, 0.1 * model.size), 1.7)
            panels.append(self._render(stage))
        return beside([panels])

    def _arc_on(self, model: Model, start: int, over: int, end: int) -> NDArray[np.float64]:
        """Return a round stroke on a model, (p, 3), from a vertex over one to another, of places on its faces."""
        a, b, c = model.points[[start, over, end]]
        t = np.linspace(0.0, 1.0, 60)[:, None]
        arc = (1 - t) ** 2 * a + 2 * t * (1 - t) * (2 * b - 0.5 * (a + c)) + t**2 * c
        centre = model.points.mean(axis=0)
        tree = self._core.RayTree(model.points, model.triangles)
        places = []
        for place in arc:
            away = place - centre
            hit = tree.first_hit(centre + 4.0 * away, -away)
            if hit is not None:
                places.append(centre + 4.0 * away - hit[1] * away)
        return np.array(places)

    def segmentation(self) -> NDArray[np.float64]:
        """Figure 11: ridges and valleys, variational shape approximation, a network of wires, and what it cuts the model into."""
        model = self._model("rocker-arm", "fandisk")
        panels = [self._ridges_and_valleys(model)]
        stage = self._stage(model)
        regions = shape_proxies(model.points, model.triangles, PROXIES)
        stage.mesh(model.points, model.triangles, np.array(ISLANDS)[_spread_colors(model.triangles, regions)])
        panels.append(self._render(stage))
        return beside([panels + self._network_and_islands(model)])

    def more_segmentations(self) -> NDArray[np.float64]:
        """Figure 12: networks on other models."""
        used = self._model("rocker-arm", "fandisk")
        others = [model for model in self._models.values() if model is not used and model.name != "sphere"][:4]
        panels = []
        for model in others or [used]:
            stage = self._stage(model)
            self._add_network(stage, model)
            panels.append(self._render(stage))
        return beside([panels])

    def _network_and_islands(self, model: Model) -> list[NDArray[np.float64]]:
        panels = []
        for filled in (False, True):
            stage = self._stage(model)
            self._add_network(stage, model, filled)
            panels.append(self._render(stage))
        return panels

    def _add_network(self, stage: Stage, model: Model, filled: bool = False) -> None:
        """Add a network of wires as the planner suggests it: the paper's were drawn by people."""
        if model.name not in self._plans:
            planner = self._core.SeamPlanner(model.surface, along="surface")
            self._plans[model.name] = planner.plan()
        plan = self._plans[model.name]
        colors = np.array(ISLANDS)[plan.islands % len(ISLANDS)] if filled else CLAY
        stage.mesh(model.points, model.triangles, colors)
        for wire in plan.wires:
            stage.line(wire.points, INK, 0.008)
        stage.balls(model.points[sorted({seed for wire in plan.wires for seed in wire.seeds})], SEED, 0.013)


def _spread_colors(triangles: NDArray[np.int32], regions: NDArray[np.int32]) -> NDArray[np.int64]:
    """Return a color's number for each triangle: regions that touch have others, as far as there are enough."""
    corners = np.stack([triangles.ravel(), np.repeat(regions, 3)], axis=1)
    corners = np.unique(corners, axis=0)
    same = corners[1:, 0] == corners[:-1, 0]
    touching: dict[int, set[int]] = {}
    for one, other in np.stack([corners[:-1, 1], corners[1:, 1]], axis=1)[same].tolist():
        touching.setdefault(one, set()).add(other)
        touching.setdefault(other, set()).add(one)
    colors = np.zeros(int(regions.max()) + 1, dtype=np.int64)
    for region in range(len(colors)):
        taken = {int(colors[other]) for other in touching.get(region, ()) if other < region}
        colors[region] = min(set(range(len(ISLANDS))) - taken, default=region % len(ISLANDS))
    return colors[regions]


def _sides(triangles: NDArray[np.int32]) -> NDArray[np.int32]:
    return np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])


def _faces_at(model: Model, points: NDArray[np.float64]) -> NDArray[np.int32]:
    """Return the triangle that each place on a model lies in, by rays along its normal."""
    tree = model.core.RayTree(model.points, model.triangles)
    faces = []
    for place in points:
        normal = model.curvature.normals[np.linalg.norm(model.points - place, axis=1).argmin()]
        hit = tree.first_hit(place + 0.01 * model.size * normal, -normal)
        faces.append(-1 if hit is None else hit[0])
    return np.array(faces, dtype=np.int32)


def _timed(*calls: Callable[[], object]) -> tuple[float, object]:
    """Return the median of the seconds that calls take, or of three of the only one, and what the last returned."""
    calls = calls * 3 if len(calls) == 1 else calls
    seconds, made = [], None
    for call in calls:
        begin = time.perf_counter()
        made = call()
        seconds.append(time.perf_counter() - begin)
    return median(seconds), made


def suzanne(core: object) -> Model:
    """Return Blender's monkey, subdivided."""
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.object
    obj.modifiers.new("Subdivision", "SUBSURF").levels = 3
    mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    mesh.calc_loop_triangles()
    points = np.empty(3 * len(mesh.vertices))
    triangles = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
    mesh.vertices.foreach_get("co", points)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    return Model(core, "suzanne", points.reshape(-1, 3), triangles.reshape(-1, 3))


def main(arguments: Sequence[str]) -> None:
    """Make the figures that are asked for."""
    folder, only, *files = arguments
    addon_utils.enable("seamwire", default_set=True)
    from seamwire.core.base import native

    core = native.load()
    models = {path.stem.lower(): Model(core, path.stem.lower(), *read(path)) for path in map(Path, files)}
    models.setdefault("suzanne", suzanne(core))
    models["sphere"] = Model(core, "sphere", *sphere())
    figures = Figures(Path(folder), models)
    for number in only.split(","):
        begin = time.perf_counter()
        name = figures.make(int(number))
        print(f"   {Path(folder) / name}, {time.perf_counter() - begin:.0f} s", flush=True)


if __name__ == "__main__":
    main(sys.argv[sys.argv.index("--") + 1 :])
