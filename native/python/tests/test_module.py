# SPDX-License-Identifier: GPL-3.0-or-later
"""The module against its stub, and what its functions refuse."""

from __future__ import annotations

import runpy
from pathlib import Path

import meshes
import numpy as np
import pytest
import seamwire_core as sw

ROOT = Path(__file__).parents[3]


def test_the_stub_is_that_of_the_module() -> None:
    made = runpy.run_path(str(ROOT / "scripts/lib/python_stub.py"))["stub"]()
    assert (
        Path(sw.__file__).with_name("seamwire_core-stubs").joinpath("__init__.pyi").read_text(encoding="utf-8") == made
    )


def test_everything_says_what_it_is(surface: sw.Surface, metric: sw.Metric, field: sw.DistanceField) -> None:
    chains = sw.edge_wires(surface, metric, 0)
    live = sw.LiveWire(surface)
    live.seed(0)
    for thing in (surface, surface.report, metric, field, field.trace(5), chains, chains.trace(5), live, live.wires(5)):
        assert repr(thing).startswith(f"<{type(thing).__name__}: ")
    assert repr(surface) == "<Surface: 960 vertices, 1920 triangles, 2880 edges>"


def test_embeddings_say_which_lengths_are_not_the_metrics(embedding: sw.Embedding) -> None:
    assert (embedding.clamped_edges, embedding.worst_clamp) == (0, 1)
    assert "clamped" not in repr(embedding)
    points, triangles = meshes.torus(24, 12)
    flat = sw.Surface(points * [1, 1, 0.05], triangles)
    metric = sw.feature_metric(flat, sw.principal_curvatures(flat), follow="max", max_anisotropy=1000)
    clamped = sw.embed(flat, metric, max_error=0)
    assert clamped.clamped_edges > 0
    assert clamped.worst_clamp > 1
    assert f"{clamped.clamped_edges} lengths clamped, by up to {clamped.worst_clamp:.6g} times" in repr(clamped)


def test_results_cannot_be_made_or_changed_by_hand(surface: sw.Surface) -> None:
    for kind in (sw.Metric, sw.Embedding, sw.Wire, sw.EdgeChain):
        with pytest.raises(TypeError):
            kind()
    with pytest.raises(AttributeError):
        surface.points = None


WRONG_VERTICES = [-1, 960, 2**31, 2**70, -(2**70), 1.0, "1", None, True, np.float64(1), np.array([1.5]), [], {}]
WRONG_EDGES = [(0, -1), (0, 960), (0, 2), (0, 0), (0, 1, 2), (0,), ("a", "b"), (0, None), (0, 1.0), np.array([[0, 1]])]


@pytest.mark.parametrize("wrong", WRONG_VERTICES, ids=repr)
def test_a_wrong_vertex_is_a_value_error(
    wrong: object, surface: sw.Surface, metric: sw.Metric, embedding: sw.Embedding, field: sw.DistanceField
) -> None:
    live = sw.LiveWire(surface)
    live.seed(0)
    calls = [
        lambda: sw.distance_field(embedding, wrong),
        lambda: field.trace(wrong),
        lambda: sw.edge_wires(surface, metric, wrong),
        lambda: sw.edge_wires(surface, metric, 0).trace(wrong),
        lambda: live.seed(wrong),
        lambda: live.wires(wrong),
    ]
    for call in calls:
        with pytest.raises(ValueError, match=r"expected|out of range"):
            call()


@pytest.mark.parametrize("wrong", WRONG_EDGES, ids=repr)
def test_a_wrong_edge_is_a_value_error(wrong: object, surface: sw.Surface, metric: sw.Metric) -> None:
    live = sw.LiveWire(surface, along="edges")
    live.seed(0)
    calls = [
        lambda: sw.edge_wires(surface, metric, wrong),
        lambda: sw.edge_wires(surface, metric, 0).trace(wrong),
        lambda: sw.shortest_cycle(surface, metric, wrong),
        lambda: live.seed(wrong),
        lambda: live.wires(wrong),
        lambda: live.loop(wrong),
    ]
    for call in calls:
        with pytest.raises(ValueError, match=r"expected|out of range|no edge"):
            call()


def test_vertices_and_edges_of_any_integer_kind(
    surface: sw.Surface, metric: sw.Metric, field: sw.DistanceField
) -> None:
    for five in (5, np.int8(5), np.uint64(5), np.array(5)):
        assert field.trace(five).to_vertex == 5
    for edge in ((5, 6), [6, 5], np.array([5, 6]), surface.edges[0]):
        chain = sw.edge_wires(surface, metric, 100).trace(edge).vertices
        assert set(map(int, edge)) <= set(chain.tolist())


def test_wrong_parameters_are_value_errors(surface: sw.Surface, curvature: sw.Curvature, metric: sw.Metric) -> None:
    other = sw.Surface(*meshes.grid(3))
    nan = float("nan")
    calls = [
        lambda: sw.feature_metric(surface, curvature, follow="both"),
        lambda: sw.feature_metric(surface, curvature, gamma=0.1, max_anisotropy=10),
        lambda: sw.feature_metric(surface, curvature, gamma=-0.1),
        lambda: sw.feature_metric(surface, curvature, gamma=nan),
        lambda: sw.feature_metric(surface, curvature, max_anisotropy=0.5),
        lambda: sw.feature_metric(surface, curvature, clamp_percentile=0),
        lambda: sw.campen_metric(surface, curvature),
        lambda: sw.pottmann_kovacs_metric(surface, curvature),
        lambda: sw.feature_metric(other, curvature),
        lambda: sw.campen_metric(other, curvature, alpha=4),
        lambda: sw.pottmann_kovacs_metric(other, curvature, beta=1),
        lambda: sw.euclidean_metric(other, curvature),
        lambda: sw.concave_metric(other, curvature),
        lambda: sw.concave_metric(surface, curvature, strength=-1),
        lambda: sw.smoothed_curvatures(other, curvature),
        lambda: sw.smoothed_curvatures(surface, curvature, radius=0),
        lambda: sw.embed(other, metric, max_error=0),
        lambda: sw.embed(surface, metric, max_faces_added=-1, max_error=0),
        lambda: sw.embed(surface, metric, max_error=-0.01),
        lambda: sw.embed(surface, metric, max_error=nan),
        lambda: sw.embed(surface, metric, progress=1, max_error=0),
        lambda: sw.edge_wires(other, metric, 0),
        lambda: sw.edge_wires(surface, metric, 0, turning=-1),
        lambda: sw.edge_wires(surface, metric, 0, turning=nan),
        lambda: sw.shortest_cycle(other, metric, (0, 1)),
        lambda: sw.shortest_cycle(surface, metric, (0, 1), turning=-1),
        lambda: sw.LiveWire(surface, along="both"),
        lambda: sw.LiveWire(surface, gamma=-1),
        lambda: sw.LiveWire(surface, gamma=1, max_anisotropy=2),
        lambda: sw.LiveWire(surface, turning=nan),
        lambda: sw.LiveWire(surface.points, surface.triangles, turning=nan),
        lambda: sw.LiveWire(surface).sibling(turning=nan),
    ]
    for call in calls:
        with pytest.raises(ValueError, match=r"\w"):
            call()
