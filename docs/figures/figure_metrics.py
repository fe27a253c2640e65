# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures 1 to 6 of the paper: metrics, their norms and their paths."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from figure_models import PATH_ERROR
from figure_sheet import Bar, Key, Panel, sheet
from figure_stage import INK
from figure_studio import RIDGE, VALLEY, anisotropy_bar
from seamwire.view.theme import colors
from seamwire_lab.color_tables import PURPLE_ORANGE, VIRIDIS
from seamwire_lab.fields import spread

if TYPE_CHECKING:
    import seamwire_core
    from figure_models import Model
    from figure_studio import Studio
    from numpy.typing import NDArray
    from PIL import Image

METRICS = ("euclidean", "pottmann_kovacs", "campen", "feature")
NAMES = {"euclidean": "Euclidean", "campen": "Campen", "pottmann_kovacs": "Pottmann-Kovacs", "feature": "ours"}
COLORS = {
    "euclidean": (0.85, 0.12, 0.10),
    "campen": (0.80, 0.15, 0.75),
    "pottmann_kovacs": (0.10, 0.62, 0.20),
    "feature": (0.12, 0.30, 0.90),
}
"""Colors of wires in Figure 4."""
ANISOTROPY = 20.0
_CANDIDATES = 40
"""Vertices of ridges and of valleys between which Figure 4 looks for the ends of its wires."""
_APART = (0.3, 0.9)
"""How far these ends are apart, in sides of the unit cube."""
_ONE_SIDE = 0.85
"""Length of the mean normal along the wires, at least: they are all seen from one side."""
_RIM = (0.98, 0.30, 0.43)
"""Where Figure 6 looks closer: a ridge beside a flat part of rocker-arm."""


def _strength(kind: str) -> dict[str, float]:
    return {} if kind == "euclidean" else {"max_anisotropy": ANISOTROPY}


def shortest_paths(studio: Studio) -> Image.Image:
    """Figure 1: paths in the Euclidean metric and in ours, and a network of wires."""
    model = studio.model("fertility")
    seed = model.vertex_at(0.5, 0.2, 0.95)
    panels = []
    for kind, strength, title in (("euclidean", {}, "Euclidean"), ("feature", {"gamma": 0.1}, "ours, γ = 0.1")):
        stage = studio.stage(model, 3)
        bar = studio.add_paths(stage, model, model.field(kind, seed, **strength))
        panels.append(Panel(studio.render(stage), title, bar))
    stage = studio.empty_stage(model, 3)
    studio.add_network(stage, model)
    panels.append(Panel(studio.render(stage), "a network of wires"))
    return sheet([panels])


def on_a_sphere(studio: Studio) -> Image.Image:
    """Figure 3: Campen's metric, alpha = 20, and ours, gamma = .1, on a nearly umbilical surface."""
    model = studio.models["sphere"]
    seed = model.vertex_at(0.42, 0.06, 0.5)
    panels: list[Panel] = []
    for kind, strength, name in (
        ("campen", {"alpha": 20.0}, "Campen, α = 20"),
        ("feature", {"gamma": 0.1}, "ours, γ = 0.1"),
    ):
        stage = studio.stage(model, 4)
        studio.add_ellipses(stage, model, model.metric(kind, **strength))
        panels.append(Panel(studio.render(stage), f"{name}: norms", anisotropy_bar()))
        stage = studio.stage(model, 4)
        bar = studio.add_paths(stage, model, model.field(kind, seed, **strength))
        panels.append(Panel(studio.render(stage), "paths", bar))
    return sheet([panels])


def along_ridge_and_valley(studio: Studio) -> Image.Image:
    """Figure 4: geodesics of four metrics between points of a curved ridge, and of a curved valley."""
    model = studio.model("rocker-arm")
    panels = []
    for sign, title in ((1.0, "along a ridge"), (-1.0, "along a valley")):
        wires = _most_different(model, sign)
        stage = studio.stage(model, 2, 0.8)
        normal = _mean_normal(model, wires)
        for height, (kind, wire) in enumerate(wires.items()):
            # Each wire lies over the wire before it. Campen's is wider, so that it is seen on both sides of ours.
            lift = 0.003 * height * model.size * normal
            stage.line(wire.points + lift, COLORS[kind], 0.010 if kind == "campen" else 0.006)
        places = np.concatenate([wire.points for wire in wires.values()])
        stage.balls(places[[0, len(wires["euclidean"].points) - 1]], INK, 0.011)
        stage.turn_to(normal)
        low, top = places.min(axis=0), places.max(axis=0)
        stage.look_at(0.5 * (low + top), min(2.0, 0.75 * model.size / float(np.linalg.norm(top - low))))
        panels.append(Panel(studio.render(stage), title, Key(tuple((NAMES[kind], COLORS[kind]) for kind in METRICS))))
    return sheet([panels])


def _most_different(model: Model, sign: float) -> dict[str, seamwire_core.Wire]:
    """Return a wire in each metric, between the two vertices of a ridge (1) or a valley (-1) where ours and Campen's beat the others most.

    The gain is a difference of means of s along the wires: the smaller one of ours and Campen's, less the larger one of the others. Only
    vertices that bend like the feature count, so that no wire gains by a ridge beside a valley.

    Raises
    ------
    ValueError
        If the model has no such vertices.
    """
    smoothed = model.core.smoothed_curvatures(model.surface, model.curvature)
    strength = np.where(sign * smoothed.k1 > 0.0, model.strength, 0.0)
    strong = np.flatnonzero(strength >= np.percentile(strength[strength > 0.0], 90))
    ends = strong[spread(model.points[strong], _CANDIDATES)[0]]
    embeddings = {kind: model.embed(model.metric(kind, **_strength(kind)), PATH_ERROR) for kind in METRICS}
    best: dict[str, seamwire_core.Wire] = {}
    best_gain, best_means, pairs = -np.inf, {}, 0
    for start in ends.tolist():
        away = np.linalg.norm(model.points[ends] - model.points[start], axis=1) / model.size
        targets = ends[(ends > start) & (away > _APART[0]) & (away < _APART[1])].tolist()
        fields = {kind: model.core.distance_field(one, start) for kind, one in embeddings.items()} if targets else {}
        pairs += len(targets)
        for target in targets:
            wires = {kind: field.trace(target) for kind, field in fields.items()}
            means = {kind: _mean_along(model, wire, strength) for kind, wire in wires.items()}
            gain = min(means["feature"], means["campen"]) - max(means["pottmann_kovacs"], means["euclidean"])
            if gain > best_gain and np.linalg.norm(_mean_normal(model, wires)) > _ONE_SIDE:
                best_gain, best_means, best = gain, means, wires
    what = "ridge" if sign > 0.0 else "valley"
    if not best:
        raise ValueError(f"{model.name} has no two points on a {what} that are far enough apart")
    text = ", ".join(f"{NAMES[kind]} {mean:.0f}" for kind, mean in best_means.items())
    print(f"   Figure 4: {what}, the best of {pairs} pairs; mean of s along the wires: {text}")
    return best


def _mean_along(model: Model, wire: seamwire_core.Wire, values: NDArray[np.float64]) -> float:
    """Return the mean of values at the vertices, (n,), along a wire."""
    lengths = np.linalg.norm(np.diff(wire.points, axis=0), axis=1)
    return float(np.average(values[model.triangles[wire.faces]].mean(axis=1), weights=lengths))


def _mean_normal(model: Model, wires: dict[str, seamwire_core.Wire]) -> NDArray[np.float64]:
    """Return the mean of the unit normals along wires, (3,)."""
    faces = np.concatenate([wire.faces for wire in wires.values()])
    return model.curvature.normals[model.triangles[faces]].mean(axis=(0, 1))


def feature_strength(studio: Studio) -> Image.Image:
    """Figure 5: s as heat, ridges and valleys with the largest values of s, and the signed curvature beside them."""
    model = studio.model("armadillo", "suzanne")
    smoothed = studio.core.smoothed_curvatures(model.surface, model.curvature)
    limit = float(np.percentile(model.strength, 97))
    bends = smoothed.k1 * model.size
    bend = float(np.percentile(np.abs(bends), 97))
    lines = studio.core.crest_lines(model.surface, smoothed)
    viridis = partial(colors, of=VIRIDIS)
    signed = partial(colors, of=PURPLE_ORANGE)
    stage = studio.stage(model, 3, colors=viridis(model.strength / limit))
    panels = [Panel(studio.render(stage), "feature strength s", Bar("s", "0", f"{limit:.0f}", viridis))]
    stage = studio.stage(model, 3)
    studio.add_crests(stage, lines)
    key = Key((("ridge", RIDGE), ("valley", VALLEY)))
    panels.append(Panel(studio.render(stage), "ridges and valleys [YBS05]", key))
    stage = studio.stage(model, 3, colors=signed(0.5 + 0.5 * bends / bend))
    panels.append(Panel(studio.render(stage), "larger curvature", Bar("κ₁", f"{-bend:.0f}", f"{bend:.0f}", signed)))
    print(f"   Figure 5: {maxima_and_crests(model, lines)}")
    return sheet([panels])


def maxima_and_crests(model: Model, lines: seamwire_core.CrestLines) -> str:
    """Return how far vertices where s is largest, and all vertices, are from crest lines."""
    a, b = model.surface.edges.T
    highest = model.strength.copy()
    np.maximum.at(highest, a, model.strength[b])
    np.maximum.at(highest, b, model.strength[a])
    top = np.flatnonzero((highest == model.strength) & (model.strength >= np.percentile(model.strength, 90)))
    every = np.arange(0, len(model.points), max(1, len(model.points) // 3000))
    edge = float(np.linalg.norm(model.points[a] - model.points[b], axis=1).mean())
    texts = []
    for name, vertices in ((f"{len(top)} local maxima of s in its top tenth", top), ("all vertices", every)):
        away = [
            float(np.sqrt(((lines.points - place) ** 2).sum(axis=1).min())) / edge for place in model.points[vertices]
        ]
        within = 100.0 * np.mean(np.array(away) <= 1.0)
        texts.append(f"{name}: median {np.median(away):.2f} edges from a crest line, {within:.0f} % within one edge")
    return "; ".join(texts)


def four_metrics(studio: Studio) -> Image.Image:
    """Figure 6: norms and paths of four metrics, A = 20, and a part of each close by."""
    model = studio.model("rocker-arm")
    seed, place = model.vertex_at(0.85, 0.1, 0.6), model.points[model.vertex_at(*_RIM)]
    rows: list[list[Panel]] = [[], []]
    for kind in METRICS:
        stage = studio.stage(model, 4)
        studio.add_ellipses(stage, model, model.metric(kind, **_strength(kind)))
        picture = studio.render_with_inset(stage, place)
        rows[0].append(Panel(picture, f"{NAMES[kind]}: norms", anisotropy_bar()))
        stage = studio.stage(model, 4)
        bar = studio.add_paths(stage, model, model.field(kind, seed, **_strength(kind)))
        rows[1].append(Panel(studio.render_with_inset(stage, place), f"{NAMES[kind]}: paths", bar))
    return sheet(rows)
