# SPDX-License-Identifier: GPL-3.0-or-later
"""What the paper's figures share: models, their stages, paths and ellipses on them, color bars."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
import numpy as np
from figure_drawn import Drawn, network_of, spread_colors
from figure_models import Model
from figure_sheet import Bar, with_inset
from figure_stage import INK, SEED, Stage
from seamwire.view.theme import STRETCH, colors
from seamwire_lab.color_tables import VIRIDIS
from seamwire_lab.fields import Paths, spread

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    import seamwire_core
    from numpy.typing import NDArray

SHEET = 2400
"""Width of a figure, with the gaps between panels, pixels."""
GAP = 24
RIDGE, VALLEY = (0.85, 0.16, 0.08), (0.10, 0.30, 0.85)
STROKE = (0.95, 0.45, 0.05)
START = (0.9, 0.1, 0.1)
ISLANDS = (
    (0.55, 0.70, 0.88),
    (0.95, 0.80, 0.58),
    (0.65, 0.82, 0.66),
    (0.90, 0.66, 0.66),
    (0.76, 0.69, 0.87),
    (0.96, 0.90, 0.62),
)
_PATHS = 300
_ELLIPSES = 1100
_MOST = 20.0
"""Anisotropy of the color map's end."""


def anisotropy_bar(label: str = "anisotropy") -> Bar:
    """Return the color bar of ellipses."""
    return Bar(label, "1", f"{_MOST:.0f}", _anisotropy_colors)


def _anisotropy_colors(parts: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return colors at fractions of the logarithm; not from the map's dark end."""
    return colors(0.25 + 0.75 * parts, VIRIDIS)


def length_colors(parts: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return colors from blue to red, as the paper has lengths."""
    return colors(parts, STRETCH)


def resampled(model: Model, count: int) -> Model:
    """Return a model with about so many triangles: subdivided by Blender, then decimated."""
    mesh = bpy.data.meshes.new(model.name)
    mesh.from_pydata(model.points.tolist(), [], model.triangles.tolist())
    obj = bpy.data.objects.new(model.name, mesh)
    bpy.context.scene.collection.objects.link(obj)
    obj.modifiers.new("Subdivision", "SUBSURF").levels = 1
    obj.modifiers.new("Triangles", "TRIANGULATE")
    # A triangle becomes three quads.
    obj.modifiers.new("Decimate", "DECIMATE").ratio = count / (6 * len(model.triangles))
    points, triangles = evaluated(obj)
    bpy.data.objects.remove(obj)
    return Model(model.core, model.name, points, triangles)


def evaluated(obj: bpy.types.Object) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Return the points and triangles of an object as its modifiers leave it."""
    mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    mesh.calc_loop_triangles()
    points = np.empty(3 * len(mesh.vertices))
    triangles = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
    mesh.vertices.foreach_get("co", points)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    return points.reshape(-1, 3), triangles.reshape(-1, 3)


class Studio:
    """Renders stages of models.

    Parameters
    ----------
    folder
        For files while they are needed.
    models
        By name; Suzanne and the sphere among them.
    """

    def __init__(self, folder: Path, models: Mapping[str, Model]) -> None:
        self.folder, self.models = folder, models
        self.core = next(iter(models.values())).core
        self._networks: dict[str, Drawn] = {}

    def model(self, *names: str) -> Model:
        """Return the first of some models that is there, else the first of all."""
        return next((self.models[name] for name in names if name in self.models), next(iter(self.models.values())))

    def stage(
        self,
        model: Model,
        columns: int,
        ratio: float | None = None,
        colors: NDArray | None = None,
        view: tuple[float, float] | None = None,
    ) -> Stage:
        """Return a stage with a model on it, so wide that `columns` of its pictures fill a sheet."""
        stage = self.empty_stage(model, columns, ratio, view)
        if colors is None:
            stage.mesh(model.points, model.triangles)
        else:
            stage.mesh(model.points, model.triangles, colors)
        return stage

    @staticmethod
    def empty_stage(
        model: Model, columns: int, ratio: float | None = None, view: tuple[float, float] | None = None
    ) -> Stage:
        """Return a stage for a model that is not on it yet, seen from the model's own view or another one."""
        return Stage(model.points, view or model.view, (SHEET - GAP * (columns - 1)) // columns, ratio)

    def render(self, stage: Stage) -> NDArray[np.float64]:
        """Return the stage's picture."""
        return stage.render(self.folder / "render.png")

    def render_with_inset(self, stage: Stage, place: NDArray[np.float64], zoom: float = 2.5) -> NDArray[np.float64]:
        """Return the stage's picture with the surroundings of a place, enlarged, in its upper left corner."""
        picture = self.render(stage)
        inset = stage.render_part(self.folder / "render.png", place, zoom, round(0.3 * picture.shape[1]))
        return with_inset(picture, inset, stage.pixel(place), zoom, (0, 0))

    @staticmethod
    def add_paths(stage: Stage, model: Model, field: seamwire_core.DistanceField, width: float = 0.005) -> Bar:
        """Add shortest paths to many vertices, colored by their lengths as in the paper; return the color bar."""
        chosen, _ = spread(model.points, _PATHS)
        paths = Paths(*field.trace_many(chosen))
        pieces, lengths = paths.segments()
        longest = paths.lengths[np.isfinite(paths.lengths)].max()
        stage.segments(pieces, length_colors(lengths / longest), width, sides=6)
        stage.balls(model.points[field.seed], START, 0.016)
        return Bar("length in the metric", "0", f"{longest / model.size:.2f}", length_colors)

    @staticmethod
    def add_ellipses(stage: Stage, model: Model, metric: seamwire_core.Metric) -> None:
        """Add the norms as ellipses along e1 and e2, as the paper does, with the roots of l1 and l2 as axes.

        With l1 and l2 themselves, as its caption has it, those of anisotropy 20 are 400 times as long as wide: none is seen.
        """
        chosen, side = spread(model.points, _ELLIPSES)
        axes = metric.ellipses("norm")[chosen]
        axes = axes / np.maximum(np.sqrt(np.linalg.norm(axes, axis=2, keepdims=True)), 1e-300)
        sizes = np.linalg.norm(axes, axis=2)
        typical = float(np.median(np.sqrt(sizes.prod(axis=1))))
        # The longest would lie over all others: they shrink, and keep their proportions.
        factor = 0.34 * side / typical * np.minimum(1.0, 2.2 * typical / sizes[:, :1])
        ratio = np.log(sizes[:, 0] / np.maximum(sizes[:, 1], 1e-300)) / np.log(_MOST)
        colors = _anisotropy_colors(ratio)
        stage.ellipses(model.points[chosen], metric.normals[chosen], axes * factor[:, :, None], colors)

    @staticmethod
    def add_crests(stage: Stage, lines: seamwire_core.CrestLines) -> None:
        """Add ridges and valleys in their colors."""
        inside = lines.faces[:-1] >= 0
        pieces = np.stack([lines.points[:-1], lines.points[1:]], axis=1)[inside]
        is_ridge = lines.curvatures[:-1][inside] > 0.0
        stage.segments(pieces, np.where(is_ridge[:, None], RIDGE, VALLEY), 0.005)

    def network(self, model: Model) -> Drawn:
        """Return the network of a model, drawn or planned."""
        if model.name not in self._networks:
            self._networks[model.name] = network_of(model, self.folder)
        return self._networks[model.name]

    def add_network(self, stage: Stage, model: Model, filled: bool = False) -> None:
        """Add a model with its network: with its seeds and scribbles, or with a color for each island."""
        drawn = self.network(model)
        if filled:
            colors = np.array(ISLANDS)[spread_colors(drawn.triangles, drawn.islands, len(ISLANDS))]
            stage.mesh(drawn.points, drawn.triangles, colors)
        else:
            stage.mesh(model.points, model.triangles)
            for scribble in drawn.scribbles:
                stage.line(scribble, STROKE, 0.014)
            stage.balls(drawn.seeds, SEED, 0.013)
        for wire in drawn.wires:
            stage.line(wire, INK, 0.008)
