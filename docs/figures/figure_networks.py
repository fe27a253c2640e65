# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures 10 to 12 of the paper: a scribble, and networks of wires."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from exoskeleton import exoskeleton
from figure_drawn import spread_colors
from figure_sheet import Key, Panel, sheet
from figure_stage import INK, SEED
from figure_studio import ISLANDS, RIDGE, STROKE, VALLEY, anisotropy_bar
from shape_proxies import shape_proxies

if TYPE_CHECKING:
    from figure_models import Model
    from figure_studio import Studio
    from numpy.typing import NDArray
    from PIL import Image

_FLAT = ((0.285, 0.0, 0.385), (0.58, 0.0, 0.70), (0.878, 0.0, 0.493))
"""Where the stroke of Figure 10 begins, what it leads over and where it ends: on the flat side of fandisk."""
PLAIN = (0.55, 0.55, 0.58)
PROXIES = 40
"""Regions of the automatic segmentations in Figure 11."""
COMPARED = ("rocker-arm", "armadillo", "fertility")
"""Models of Figure 11."""
_COLUMNS = 5
"""Panels in a row of Figure 11."""
_OTHERS = 2
"""Models of Figure 12."""
_VIEWS = {"rocker-arm": (28.0, 20.0), "fandisk": (30.0, 20.0)}
"""Azimuth and elevation from where a network is seen best, if that is not the model's usual view."""


def scribble(studio: Studio) -> Image.Image:
    """Figure 10: the metric on a flat part, a scribble for a part of the way, the metric that it makes, and wires in both."""
    model = studio.model("fandisk")
    start, over, end = (model.vertex_at(*place) for place in _FLAT)
    points, faces = _arc_on(model, start, over, end)
    metric = model.metric("feature", gamma=0.1)
    # The middle of the way alone: wires find the rest.
    part = slice(len(points) // 4, 3 * len(points) // 4)
    stroke = studio.core.Scribble(points[part], faces=faces[part])
    drawn = studio.core.apply_scribbles(model.surface, metric, [stroke])
    panels = []
    for shown, title in (("metric", "metric"), ("stroke", "scribble"), ("drawn", "metric with it"), ("wires", "wires")):
        stage = studio.stage(model, 4)
        if shown in {"metric", "drawn"}:
            studio.add_ellipses(stage, model, metric if shown == "metric" else drawn)
        if shown in {"stroke", "wires"}:
            stage.line(points[part], STROKE, 0.006)
        if shown == "wires":
            for one, color in ((metric, PLAIN), (drawn, INK)):
                field = studio.core.distance_field(model.embed(one, max_error=0.01), start)
                stage.line(field.trace(end).points, color, 0.008)
        if shown in {"stroke", "wires"}:
            stage.balls(model.points[[start, end]], SEED, 0.013)
        bar = anisotropy_bar() if shown in {"metric", "drawn"} else None
        key = {
            "stroke": Key((("scribble", STROKE),)),
            "wires": Key((("without", PLAIN), ("with the scribble", INK))),
        }.get(shown)
        panels.append(Panel(studio.render(stage), title, bar or key))
    return sheet([panels])


def _arc_on(model: Model, start: int, over: int, end: int) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Return a round stroke on a model from a vertex over one to another, (p, 3), and the triangle of each point."""
    a, b, c = model.points[[start, over, end]]
    t = np.linspace(0.0, 1.0, 80)[:, None]
    arc = (1 - t) ** 2 * a + 2 * t * (1 - t) * (2 * b - 0.5 * (a + c)) + t**2 * c
    tree = model.core.RayTree(model.points, model.triangles)
    away = 0.2 * model.size * model.curvature.normals[over]
    hits = [(place + away, tree.first_hit(place + away, -away)) for place in arc]
    places, faces = zip(*((place - hit[1] * away, hit[0]) for place, hit in hits if hit is not None), strict=True)
    return np.array(places), np.array(faces, dtype=np.int32)


def segmentation(studio: Studio) -> Image.Image:
    """Figure 11: feature lines, two automatic segmentations, a network of wires, and the islands that it encloses."""
    names = [name for name in COMPARED if name in studio.models] or [studio.model().name]
    rows = []
    for model in (studio.models[name] for name in names):
        view = _VIEWS.get(model.name, model.view)
        lines = studio.core.crest_lines(model.surface, studio.core.smoothed_curvatures(model.surface, model.curvature))
        stage = studio.stage(model, _COLUMNS, view=view)
        studio.add_crests(stage, lines)
        key = Key((("ridge", RIDGE), ("valley", VALLEY)))
        row = [Panel(studio.render(stage), "feature lines", key)]
        for regions, title in (
            (shape_proxies(model.points, model.triangles, PROXIES, teleport=True), "proxies"),
            (exoskeleton(model.points, model.triangles, PROXIES).regions, "proxies in parts"),
        ):
            colors = np.array(ISLANDS)[spread_colors(model.triangles, regions, len(ISLANDS))]
            row.append(Panel(studio.render(studio.stage(model, _COLUMNS, colors=colors, view=view)), title))
        rows.append([*row, *_network_panels(studio, model, _COLUMNS, view)])
    return sheet(rows)


def more_segmentations(studio: Studio) -> Image.Image:
    """Figure 12: networks on other models, and the islands that they enclose."""
    others = [model for model in studio.models.values() if model.name not in {*COMPARED, "sphere"}]
    drawn = [model for model in others if (studio.folder / f"{model.name}.json").exists()]
    panels = [
        _network_panels(studio, model, 2 * _OTHERS, _VIEWS.get(model.name, model.view), f"{model.name}: ")
        for model in (drawn or others)[:_OTHERS]
    ]
    return sheet([[panel for pair in panels for panel in pair]])


def _network_panels(
    studio: Studio, model: Model, columns: int, view: tuple[float, float], name: str = ""
) -> list[Panel]:
    """Return a picture of a network with its seeds and scribbles, and one of its islands."""
    panels = []
    for filled, title in ((False, "wires"), (True, "islands")):
        stage = studio.empty_stage(model, columns, view=view)
        studio.add_network(stage, model, filled)
        key = None if filled else Key((("seed", SEED), ("scribble", STROKE)))
        panels.append(Panel(studio.render(stage), name + title, key))
    return panels
