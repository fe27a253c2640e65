# SPDX-License-Identifier: GPL-3.0-or-later
"""The live wires of a session, one for each way of running, and the metric they share."""

from __future__ import annotations

from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
from fake_live import FakeLive, grid_points
from polygon_meshes import arrays_of, grid_places, grid_polygons
from seamwire.core.base import native
from seamwire.core.network.strokes import ActsOn, Stroke, through_vertices
from seamwire.core.solver.solver import Engines, LiveMaker
from seamwire.terms.choices import METRICS, Along
from seamwire.terms.options import CLAMP_PERCENTILE, STRENGTHS
from table import SIZE


class Made:
    """Engines, and the live wires that they made."""

    def __init__(self, strengths: dict[Along, float] | None = None) -> None:
        self.lives: list[FakeLive] = []
        self.engines = Engines(self._make, lambda stroke: ("stroke", stroke))
        self.engines.use("feature", {**STRENGTHS, **(strengths or {})}, CLAMP_PERCENTILE)

    def _make(self, along: Along) -> FakeLive:
        self.lives.append(FakeLive(SIZE, along))
        return self.lives[-1]


def stroke(acts_on: ActsOn) -> Stroke:
    return Stroke(*through_vertices([0, 1], grid_points(SIZE)), acts_on=acts_on)


def test_live_wires_are_made_once_for_each_way_when_they_are_asked_for() -> None:
    made = Made()
    assert not made.lives
    edges = made.engines.get("EDGES")
    assert made.engines.get("EDGES") is edges
    across = made.engines.get("SURFACE")
    assert [live.along for live in made.lives] == ["EDGES", "SURFACE"]
    assert made.lives == [edges, across]


def test_what_they_are_made_with_is_not_told_again() -> None:
    made = Made()
    made.engines.get("EDGES")
    made.engines.use("feature", STRENGTHS, CLAMP_PERCENTILE)
    assert made.lives[0].metrics == []
    assert made.lives[0].strokes == []


def test_those_that_are_made_later_hear_of_metric_and_strokes() -> None:
    made = Made({"SURFACE": 7.0})
    made.engines.get("EDGES")
    one, two = stroke("both"), stroke("both")
    made.engines.follow([one, two])
    made.engines.get("SURFACE")
    assert [live.metrics for live in made.lives] == [[], [("feature", 7.0, CLAMP_PERCENTILE)]]
    assert [live.strokes for live in made.lives] == [[(("stroke", one), ("stroke", two))]] * 2


def test_triangles_that_wires_lead_around_are_told_of_once() -> None:
    made = Made()
    for along in ("EDGES", "SURFACE"):
        made.engines.get(along)
        made.lives[-1].holes = (1, 3)
    made.lives[-1].ready = (True, False)
    assert not made.engines.warning("EDGES")
    assert str(made.engines.warning("SURFACE")) == "1 triangle could not be made valid: wires go around it"
    assert not made.engines.warning("SURFACE")
    made.lives[-1].ready = (True, True)
    assert str(made.engines.warning("SURFACE")).startswith("3 triangles could not")
    assert not made.engines.warning("SURFACE")


def told(made: Made) -> list[list[str]]:
    """Return for each live wire which metrics the strokes act on that it was told last."""
    return [[stroke.acts_on for _, stroke in live.strokes[-1]] for live in made.lives]


@pytest.mark.parametrize(
    ("metric", "kinds"),
    [
        ("feature", ["both", "min", "max", "concave"]),
        ("concave", ["both", "concave", "euclidean"]),
        ("euclidean", ["both", "euclidean"]),
    ],
)
def test_a_stroke_for_one_wire_acts_on_the_metric_of_the_wire_with_that_number(metric: str, kinds: list[str]) -> None:
    made = Made()
    made.engines.get("SURFACE")
    made.engines.follow([stroke(acts_on) for acts_on in ("both", "min", "max", "concave")])
    made.engines.use(metric, STRENGTHS, CLAMP_PERCENTILE)
    assert told(made) == [kinds]


def test_for_closed_cuts_strokes_are_for_the_wires_of_the_concave_metric() -> None:
    made = Made()
    made.engines.cuts()
    made.engines.follow([stroke("min"), stroke("max"), stroke("concave")])
    assert told(made) == [["concave", "euclidean"]]


def test_metrics_have_the_names_that_the_library_gives_them() -> None:
    families = pytest.importorskip("seamwire_core").metric_families()
    assert set(METRICS) <= {family.name for family in families}


def test_a_wait_for_the_surface_ends_when_it_is_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("seamwire_core")
    make = LiveMaker(arrays_of(grid_places(10), grid_polygons(10)))
    live = make("EDGES")
    answers = iter([False] * 4)

    def wait_for_surface(_seconds: float) -> bool:
        return next(answers, True) and live.wait_for_surface()

    monkeypatch.setattr(make, "_first", SimpleNamespace(wait_for_surface=wait_for_surface, surface="surface"))
    seams = np.empty((0, 2), dtype=np.int32)
    stopped = native.load().Cancelled
    for wait in (make.wait, partial(make.face_segments, seams), partial(make.part_finder, None, seams)):
        with pytest.raises(stopped):
            wait(lambda _fraction: False)
    told = []
    assert make.wait(lambda fraction: not told.append(fraction)) == "surface"
    assert told, "it is asked while it waits"
