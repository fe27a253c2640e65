# SPDX-License-Identifier: GPL-3.0-or-later
"""Feature detection by geodesics, which Section 7 of the paper proposes: where shortest paths gather."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from figure_sheet import Bar, Key, Panel, sheet
from mathutils.kdtree import KDTree
from path_traffic import (
    Paths,
    feature_lines,
    feature_score,
    highest,
    part_count,
    shortest_paths,
    traffic,
    vertex_areas,
)
from seamwire.view.theme import colors
from seamwire_lab.color_tables import PURPLE_ORANGE
from seamwire_lab.fields import spread

if TYPE_CHECKING:
    import seamwire_core
    from figure_models import Model
    from figure_studio import Studio
    from numpy.typing import NDArray
    from PIL import Image

MODELS = ("armadillo", "rocker-arm")
"""Models of the picture. The constants below were chosen on rocker-arm."""
SOURCES, TARGETS = 100, 300
"""About how many vertices paths start from and lead to."""
GAMMA = 0.1
SHARES = (0.05, 0.10)
"""Parts of the area that are compared with feature lines: those with the highest values."""
LEAST = 10.0
"""The length of the shortest line, in mean edges."""
SHARP = 30.0
"""Edges with a larger dihedral angle, degrees, are features that do not depend on curvature."""
_HEIGHT = 0.86
"""Of pictures, as a part of their width."""
_BRIGHT = 97
"""The percentile at the color map's end."""
LINE, CREST = (0.08, 0.18, 0.75), (1.0, 0.70, 0.35)


def feature_detection(studio: Studio) -> Image.Image:
    """Show s, the traffic of Euclidean paths and of ours, and lines of ours over crest lines; print how well each finds features."""
    made = [Detection(model) for model in studio.models.values() if model.name not in {"suzanne", "sphere"}]
    for one in made:
        for line in one.report():
            print(f"   {line}", flush=True)
    made = made or [Detection(studio.model())]
    shown = [one for name in MODELS for one in made if one.model.name == name] or made[:1]
    return sheet([_panels(studio, one) for one in shown])


def _panels(studio: Studio, made: Detection) -> list[Panel]:
    model, panels = made.model, []
    for values, title, label in (
        (model.strength, "feature strength s", "s"),
        (made.euclidean, "Euclidean traffic", "multiple of the mean"),
        (made.score, "our traffic, relative", "score"),
    ):
        top = float(np.percentile(values, _BRIGHT))
        stage = studio.stage(model, 4, _HEIGHT, _heat(values / top))
        panels.append(Panel(studio.render(stage), title, Bar(label, "0", f"{top:.{0 if top > 10.0 else 1}f}", _heat)))
    stage = studio.stage(model, 4, _HEIGHT)
    stage.segments(made.crests, CREST, 0.008)
    # Lines lie over crest lines, which are seen on both sides.
    for line in made.lines:
        normals = made.normals[made.paths.faces[line][[*range(line.stop - line.start - 1), -2]]]
        stage.line(made.paths.points[line] + 0.003 * model.size * normals, LINE, 0.005)
    key = Key((("our paths", LINE), ("crest lines", CREST)))
    panels.append(Panel(studio.render(stage), "lines", key))
    return panels


def _heat(parts: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return colors from white to purple."""
    return colors(0.5 - 0.5 * np.clip(parts, 0.0, 1.0), PURPLE_ORANGE)


@dataclass(frozen=True, eq=False)
class Detection:
    """Features of one model, and how well they agree with crest lines and sharp edges."""

    model: Model

    @cached_property
    def edge(self) -> float:
        """The mean length of edges."""
        ends = self.model.points[self.model.surface.edges]
        return float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).mean())

    @cached_property
    def areas(self) -> NDArray[np.float64]:
        """The area of each vertex, (n,)."""
        return vertex_areas(self.model.points, self.model.triangles)

    def _paths(self, kind: str, **strength: float) -> Paths:
        model = self.model
        sources, targets = (spread(model.points, count)[0] for count in (SOURCES, TARGETS))
        return shortest_paths(model.core, model.embed(model.metric(kind, **strength)), sources, targets)

    @cached_property
    def paths(self) -> Paths:
        """Shortest paths in our metric."""
        return self._paths("feature", gamma=GAMMA)

    @cached_property
    def euclidean(self) -> NDArray[np.float64]:
        """The traffic of Euclidean paths, (n,)."""
        return traffic(self.model.points, self.model.triangles, self._paths("euclidean"))

    @cached_property
    def score(self) -> NDArray[np.float64]:
        """The traffic in our metric in comparison, (n,)."""
        return feature_score(traffic(self.model.points, self.model.triangles, self.paths), self.euclidean)

    @cached_property
    def lines(self) -> list[slice]:
        """Pieces of paths in our metric along the highest scores, as parts of the paths' points."""
        strong = highest(self.score, self.areas, SHARES[-1])[self.model.triangles].any(axis=1)
        return feature_lines(self.model.triangles, self.paths, strong, LEAST * self.edge)

    @cached_property
    def crest_lines(self) -> seamwire_core.CrestLines:
        """Ridges and valleys."""
        model = self.model
        return model.core.crest_lines(model.surface, model.core.smoothed_curvatures(model.surface, model.curvature))

    @property
    def crests(self) -> NDArray[np.float64]:
        """The straight pieces of crest lines, (k, 2, 3)."""
        return Paths(self.crest_lines.points, self.crest_lines.faces).pieces()[0]

    @cached_property
    def normals(self) -> NDArray[np.float64]:
        """The normals of triangles, (m, 3)."""
        a, b, c = self.model.points[self.model.triangles].transpose(1, 0, 2)
        cross = np.cross(b - a, c - a)
        return cross / np.maximum(np.linalg.norm(cross, axis=1, keepdims=True), 1e-300)

    @cached_property
    def sharp_edges(self) -> NDArray[np.float64]:
        """Sharp edges, (k, 2, 3)."""
        points, triangles, normals = self.model.points, self.model.triangles, self.normals
        sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
        order = np.lexsort((sides[:, 1], sides[:, 0]))
        same = np.flatnonzero((sides[order][1:] == sides[order][:-1]).all(axis=1))
        one, other = order[same], order[same + 1]
        bend = (normals[one % len(triangles)] * normals[other % len(triangles)]).sum(axis=1)
        return points[sides[one[bend < np.cos(np.radians(SHARP))]]]

    # How well it works

    def report(self) -> list[str]:
        """Return how well s, both kinds of traffic and the lines agree with crest lines and sharp edges."""
        values = {"s": self.model.strength, "Euclidean": self.euclidean, "ours": self.score}
        truths = {"crest lines": self.crests}
        if self.model.name == "fandisk":
            truths["sharp edges"] = self.sharp_edges
        texts = [text for truth, pieces in truths.items() for text in self._agreement(truth, pieces, values)]
        texts += [self._parts(values), self._beyond_strength(), self._line_lengths()]
        return [f"{self.model.name}: {text}" for text in texts]

    def _agreement(self, truth: str, pieces: NDArray[np.float64], values: dict[str, NDArray[np.float64]]) -> list[str]:
        """Return how near the highest values lie to features, and how much of the features they find."""
        samples = _samples(pieces)
        near = self._is_near(self.model.points, samples)
        texts = [f"{truth}: all area: {_percent(near, self.areas)} near"]
        for name, field in values.items():
            for share in SHARES:
                top = highest(field, self.areas, share)
                found = self._covered(pieces, self.model.points[top])
                texts.append(
                    f"{truth}: {name}, top {share:.0%}: {_percent(near[top], self.areas[top])} near, {found} found"
                )
        ends, _ = self.paths.pieces()
        number = np.cumsum(self.paths.faces >= 0) - 1
        drawn = np.concatenate(
            [ends[:0], *(ends[number[line.start] : number[line.stop - 2] + 1] for line in self.lines)]
        )
        found = self._covered(pieces, _samples(drawn))
        return [*texts, f"{truth}: lines: {self._covered(drawn, samples)} near, {found} found"]

    def _line_lengths(self) -> str:
        """Return how many lines there are, and how long they are."""
        crests, paths = self.crest_lines, self.paths.points
        ours = [paths[line] for line in self.lines]
        others = [crests.points[i:j] for i, j in zip(crests.starts[:-1], crests.starts[1:], strict=True)]
        texts = []
        for name, lines in (("lines of ours", ours), ("crest lines", others)):
            lengths = [np.linalg.norm(np.diff(line, axis=0), axis=1).sum() / self.edge for line in lines]
            texts.append(f"{len(lines)} {name}, median length {np.median(lengths or [0.0]):.0f} edges")
        return "; ".join(texts)

    def _parts(self, values: dict[str, NDArray[np.float64]]) -> str:
        """Return how many parts the highest values lie in."""
        edges = self.model.surface.edges
        values = {**values, "s averaged": self._averaged(self.model.strength)}
        texts = []
        for name, field in values.items():
            top = highest(field, self.areas, SHARES[0])
            counts = (part_count(edges, top, self.areas, share) for share in (1.0, 0.9))
            texts.append("{} {} ({})".format(name, *counts))
        return f"parts of the top {SHARES[0]:.0%} (of nine tenths of it): {', '.join(texts)}"

    def _averaged(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return means over each vertex and its neighbors, (n,)."""
        a, b = self.model.surface.edges.T
        count = len(values)
        sums = values + np.bincount(a, values[b], count) + np.bincount(b, values[a], count)
        return sums / (1 + np.bincount(a, minlength=count) + np.bincount(b, minlength=count))

    def _beyond_strength(self) -> str:
        """Return how near crest lines the highest scores are where s is not among the highest."""
        share = SHARES[-1]
        near = self._is_near(self.model.points, _samples(self.crests))
        strong = highest(self.model.strength, self.areas, share)
        top = highest(self.score, self.areas, share)
        only = top & ~strong
        more = share + self.areas[only].sum() / self.areas.sum()
        following = highest(self.model.strength, self.areas, more) & ~strong
        parts = (_percent(near[part], self.areas[part]) for part in (only, following, ~strong))
        return (
            f"outside the top {share:.0%} of s lies {_percent(only[top], self.areas[top])} of the top {share:.0%} of ours: "
            "{} near crest lines; as much area that follows by s: {}; all area there: {}".format(*parts)
        )

    def _is_near(self, places: NDArray[np.float64], others: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Return whether each place has another one within the mean edge length."""
        tree = KDTree(len(others))
        for i, other in enumerate(others.tolist()):
            tree.insert(other, i)
        tree.balance()
        return np.array([len(others) > 0 and tree.find(place)[2] <= self.edge for place in places.tolist()], dtype=bool)

    def _covered(self, pieces: NDArray[np.float64], places: NDArray[np.float64]) -> str:
        """Return how much of the length of pieces, (k, 2, 3), has a place within the mean edge length."""
        return _percent(self._is_near(pieces.mean(axis=1), places), np.linalg.norm(pieces[:, 1] - pieces[:, 0], axis=1))


def _samples(pieces: NDArray[np.float64], count: int = 5) -> NDArray[np.float64]:
    """Return points along straight pieces, (k, 2, 3)."""
    parts = np.linspace(0.0, 1.0, count)[:, None, None]
    return ((1.0 - parts) * pieces[:, 0] + parts * pieces[:, 1]).reshape(-1, 3)


def _percent(marked: NDArray[np.bool_], weights: NDArray[np.float64]) -> str:
    return f"{100.0 * weights[marked].sum() / max(float(weights.sum()), 1e-300):.0f} %"
