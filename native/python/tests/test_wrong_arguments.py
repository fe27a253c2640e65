# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever takes arrays refuses wrong ones with a ValueError that names the argument."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import meshes
import numpy as np
import pytest
import seamwire_core as sw

POINTS, TRIANGLES = meshes.torus(6, 6)
SURFACE = sw.Surface(POINTS, TRIANGLES)
CURVATURE = sw.principal_curvatures(SURFACE)
METRIC = sw.euclidean_metric(SURFACE, CURVATURE)
EMBEDDING = sw.embed(SURFACE, METRIC, max_error=0)
FIELD = sw.distance_field(EMBEDDING, 0)
UVS = POINTS[TRIANGLES][:, :, :2]
POLYGONS = np.arange(len(TRIANGLES), dtype=np.int32)
RAYS = sw.RayTree(POINTS, TRIANGLES)
NEAREST = sw.NearestPoints(POINTS, TRIANGLES)
PICKER = sw.Picker(POINTS, TRIANGLES, POLYGONS, [], np.eye(3))
PARTS = sw.PartFinder(SURFACE)
PLAN = sw.plan_cuts(POINTS, TRIANGLES, POLYGONS, [])
EDGES = sw.LiveWire(POINTS, TRIANGLES, along="edges")
ACROSS = sw.LiveWire(POINTS, TRIANGLES, along="surface")
for live in (EDGES, ACROSS):
    live.wait_for_surface()
    live.seed(0)
CENTER = (1 / 3, 1 / 3, 1 / 3)

Call = Callable[[Any], object]
NO_ARRAYS: dict[str, object] = {
    "nothing": object(),
    "text": "abc",
    "texts": ["a", "b", "c"],
    "a number": 7,
    "no numbers": [None, None, None],
    "complex": np.ones((3, 3), complex),
    "truth values": np.ones((3, 3), bool),
    "times": np.zeros((3, 3), "datetime64[s]"),
    "ragged": [[0, 1, 2], [3]],
    "too deep": np.zeros((2, 2, 2, 2)),
    "a set": {1, 2, 3},
}
NO_PICKS = {what: value for what, value in NO_ARRAYS.items() if what != "a number"}
FLAT: dict[str, object] = {"flat": [3, 5], "flat numbers": np.arange(6.0)}
DEEP: dict[str, object] = {"a table": np.zeros((2, 5), int), "of no dimension": np.array(3)}
HUGE: dict[str, object] = {"beyond 32 bits": 2**40, "beyond 64 bits": 2**70, "negative": -7, "out of range": 10**6}

ROWS: dict[tuple[str, str], Call] = {
    ("Surface", "points"): lambda bad: sw.Surface(bad, TRIANGLES),
    ("Surface", "triangles"): lambda bad: sw.Surface(POINTS, bad),
    ("Surface", "edges"): lambda bad: sw.Surface(POINTS, TRIANGLES, bad),
    ("LiveWire", "points"): lambda bad: sw.LiveWire(bad, TRIANGLES),
    ("LiveWire", "triangles"): lambda bad: sw.LiveWire(POINTS, bad),
    ("LiveWire", "edges"): lambda bad: sw.LiveWire(POINTS, TRIANGLES, bad),
    ("RayTree", "points"): lambda bad: sw.RayTree(bad, TRIANGLES),
    ("RayTree", "triangles"): lambda bad: sw.RayTree(POINTS, bad),
    ("Picker", "points"): lambda bad: sw.Picker(bad, TRIANGLES, POLYGONS, [], np.eye(3)),
    ("Picker", "triangles"): lambda bad: sw.Picker(POINTS, bad, POLYGONS, [], np.eye(3)),
    ("Picker", "edges"): lambda bad: sw.Picker(POINTS, TRIANGLES, POLYGONS, bad, np.eye(3)),
    ("Picker", "to_object"): lambda bad: sw.Picker(POINTS, TRIANGLES, POLYGONS, [], bad),
    ("Picker.set_layer", "ends"): lambda bad: PICKER.set_layer(0, bad, [], 1.0),
    ("Picker.pick", "perspective"): lambda bad: PICKER.pick(bad, np.eye(4), (9, 9), (1, 1)),
    ("Picker.pick", "matrix"): lambda bad: PICKER.pick(np.eye(4), bad, (9, 9), (1, 1)),
    ("Picker.pick", "clip_planes"): lambda bad: PICKER.pick(np.eye(4), np.eye(4), (9, 9), (1, 1), bad),
    ("NearestPoints", "points"): lambda bad: sw.NearestPoints(bad, TRIANGLES),
    ("NearestPoints", "triangles"): lambda bad: sw.NearestPoints(POINTS, bad),
    ("NearestPoints.find", "places"): lambda bad: NEAREST.find(bad),
    ("NearestPoints.find", "normals"): lambda bad: NEAREST.find(POINTS, bad),
    ("Scribble", "points"): lambda bad: sw.Scribble(bad),
    ("CutCurve", "points"): lambda bad: sw.CutCurve(bad, 0),
    ("plan_cuts", "points"): lambda bad: sw.plan_cuts(bad, TRIANGLES, POLYGONS, []),
    ("plan_cuts", "triangles"): lambda bad: sw.plan_cuts(POINTS, bad, POLYGONS, []),
    ("PolygonMesh", "points"): lambda bad: sw.PolygonMesh(bad, [0, 1, 2], [3]),
    ("PolygonMesh", "colors"): lambda bad: sw.PolygonMesh(POINTS, [0, 1, 2], [3], bad),
    ("write_lines", "lines"): lambda bad: sw.write_lines("never.obj", [bad]),
    ("triangulate", "points"): lambda bad: sw.triangulate(bad, [0, 1, 2], [3]),
    ("has_scanned_edges", "points"): lambda bad: sw.has_scanned_edges(bad, TRIANGLES),
    ("has_scanned_edges", "triangles"): lambda bad: sw.has_scanned_edges(POINTS, bad),
    ("face_segments", "cut_edges"): lambda bad: sw.face_segments(SURFACE, bad),
    ("missing_cuts", "cut_edges"): lambda bad: sw.missing_cuts(SURFACE, bad, POLYGONS),
    ("flatten", "points"): lambda bad: sw.flatten(bad, TRIANGLES),
    ("flatten", "triangles"): lambda bad: sw.flatten(POINTS, bad),
    ("flatten", "cuts"): lambda bad: sw.flatten(POINTS, TRIANGLES, bad),
    ("flatten", "edges"): lambda bad: sw.flatten(POINTS, TRIANGLES, edges=bad),
    ("flatten", "start"): lambda bad: sw.flatten(POINTS, TRIANGLES, start=bad),
    ("measure_map", "points"): lambda bad: sw.measure_map(bad, TRIANGLES, UVS),
    ("measure_map", "triangles"): lambda bad: sw.measure_map(POINTS, bad, UVS),
    ("measure_map", "uvs"): lambda bad: sw.measure_map(POINTS, TRIANGLES, bad),
    ("measure_map", "edges"): lambda bad: sw.measure_map(POINTS, TRIANGLES, UVS, edges=bad),
    ("pack_islands", "uvs"): lambda bad: sw.pack_islands(bad, [0] * len(TRIANGLES)),
    ("map_energy", "uvs"): lambda bad: sw.map_energy(POINTS, TRIANGLES, bad),
    ("fit_chain", "points"): lambda bad: sw.fit_chain(SURFACE, bad, [0, 1]),
    ("LiveWire.fit_chain", "points"): lambda bad: EDGES.fit_chain(bad, [0, 1]),
    ("PartFinder", "marked"): lambda bad: sw.PartFinder(SURFACE, marked=bad),
    ("PartFinder", "seams"): lambda bad: sw.PartFinder(SURFACE, seams=bad),
    ("PartFinder.find", "kept"): lambda bad: PARTS.find(kept=bad),
    ("PartFinder.find", "dropped"): lambda bad: PARTS.find(dropped=bad),
    ("SeamPlanner", "seams"): lambda bad: sw.SeamPlanner(SURFACE, seams=bad),
}
LISTS: dict[tuple[str, str], Call] = {
    ("Scribble", "faces"): lambda bad: sw.Scribble(POINTS[:2], bad),
    ("Scribble", "vertices"): lambda bad: sw.Scribble(POINTS[:2], vertices=bad),
    ("CutCurve", "faces"): lambda bad: sw.CutCurve(POINTS[:2], 0, faces=bad),
    ("plan_cuts", "polygons"): lambda bad: sw.plan_cuts(POINTS, TRIANGLES, bad, []),
    ("PolygonMesh", "corners"): lambda bad: sw.PolygonMesh(POINTS, bad, [3]),
    ("PolygonMesh", "sizes"): lambda bad: sw.PolygonMesh(POINTS, [0, 1, 2], bad),
    ("triangulate", "corners"): lambda bad: sw.triangulate(POINTS, bad, [3]),
    ("triangulate", "sizes"): lambda bad: sw.triangulate(POINTS, [0, 1, 2], bad),
    ("has_scanned_edges", "polygons"): lambda bad: sw.has_scanned_edges(POINTS, TRIANGLES, bad),
    ("missing_cuts", "segments"): lambda bad: sw.missing_cuts(SURFACE, [], bad),
    ("measure_map", "islands"): lambda bad: sw.measure_map(POINTS, TRIANGLES, UVS, bad),
    ("pack_islands", "islands"): lambda bad: sw.pack_islands(UVS, bad),
    ("pack_islands", "aspects"): lambda bad: sw.pack_islands(UVS, [0] * len(TRIANGLES), aspects=bad),
    ("map_energy", "islands"): lambda bad: sw.map_energy(POINTS, TRIANGLES, UVS, bad),
    ("fit_chain", "faces"): lambda bad: sw.fit_chain(SURFACE, POINTS[:2], bad),
    ("LiveWire.fit_chain", "faces"): lambda bad: EDGES.fit_chain(POINTS[:2], bad),
    ("isolines", "values"): lambda bad: sw.isolines(SURFACE, bad, [0.5]),
    ("isolines", "levels"): lambda bad: sw.isolines(SURFACE, np.zeros(len(POINTS)), bad),
    ("DistanceField.trace_many", "vertices"): lambda bad: FIELD.trace_many(bad),
    ("Embedding.with_lengths", "lengths"): lambda bad: EMBEDDING.with_lengths(bad),
    ("Picker", "polygons"): lambda bad: sw.Picker(POINTS, TRIANGLES, bad, [], np.eye(3)),
    ("Picker.set_layer", "owners"): lambda bad: PICKER.set_layer(0, POINTS[:2], bad, 1.0),
    ("Picker.set_vertices", "strengths"): lambda bad: PICKER.set_vertices(bad, 0.0, []),
    ("Picker.set_vertices", "preferred"): lambda bad: PICKER.set_vertices([], 0.0, bad),
    ("Picker.pick", "layers"): lambda bad: PICKER.pick(np.eye(4), np.eye(4), (9, 9), (1, 1), layers=bad),
    ("PartFinder.find", "parted"): lambda bad: PARTS.find(parted=bad),
    ("SeamPlanner", "weights"): lambda bad: sw.SeamPlanner(SURFACE, weights=bad),
}
THREES: dict[tuple[str, str], Call] = {
    ("plane_section", "direction"): lambda bad: sw.plane_section(SURFACE, 0, 3, bad),
    ("RayTree.first_hit", "origin"): lambda bad: RAYS.first_hit(bad, [0, 0, 1]),
    ("RayTree.first_hit", "direction"): lambda bad: RAYS.first_hit([0, 0, 1], bad),
    ("CutPlan.node_at", "corners"): lambda bad: PLAN.node_at(bad, CENTER),
    ("CutPlan.node_at", "barycentric"): lambda bad: PLAN.node_at([0, 1, 7], bad),
    ("flatten", "up"): lambda bad: sw.flatten(POINTS, TRIANGLES, up=bad),
    ("SeamPlanner", "front"): lambda bad: sw.SeamPlanner(SURFACE, front=bad),
    ("DistanceField.distance", "barycentric"): lambda bad: FIELD.distance(0, bad),
    ("DistanceField.trace_to", "barycentric"): lambda bad: FIELD.trace_to(0, bad),
}
OBJECTS: dict[tuple[str, str], Call] = {
    ("apply_scribbles", "scribbles"): lambda bad: sw.apply_scribbles(SURFACE, METRIC, bad),
    ("LiveWire.set_scribbles", "scribbles"): lambda bad: ACROSS.set_scribbles(bad),
    ("plan_cuts", "curves"): lambda bad: sw.plan_cuts(POINTS, TRIANGLES, POLYGONS, bad),
}
PICKS: dict[tuple[str, str], Call] = {
    ("distance_field", "seed"): lambda bad: sw.distance_field(EMBEDDING, bad),
    ("distance_field", "target"): lambda bad: sw.distance_field(EMBEDDING, 0, targets=bad),
    ("plane_section", "from_point"): lambda bad: sw.plane_section(SURFACE, bad, 3, [0, 0, 1]),
    ("edge_wires", "seed"): lambda bad: sw.edge_wires(SURFACE, METRIC, bad),
    ("EdgeWires.trace", "target"): lambda bad: sw.edge_wires(SURFACE, METRIC, 0).trace(bad),
    ("shortest_cycle", "edge"): lambda bad: sw.shortest_cycle(SURFACE, METRIC, bad),
    ("DistanceField.trace", "vertex"): lambda bad: FIELD.trace(bad),
    ("LiveWire.seed", "pick"): lambda bad: EDGES.seed(bad),
    ("LiveWire.wires", "target"): lambda bad: EDGES.wires(bad),
    ("LiveWire.loop", "edge"): lambda bad: EDGES.loop(bad),
    ("LiveWire.closed_wires", "through"): lambda bad: ACROSS.closed_wires(bad),
    ("LiveWire.bent_wire", "second"): lambda bad: ACROSS.bent_wire(0, bad),
    ("LiveWire.bent_wire", "cut"): lambda bad: ACROSS.bent_wire(0, 3, bad),
    ("LiveWire.extend_straight", "edge"): lambda bad: EDGES.extend_straight(bad),
    ("SeamPlanner", "mirror"): lambda bad: sw.SeamPlanner(SURFACE, mirror=bad),
    ("PartFinder", "mirror"): lambda bad: sw.PartFinder(SURFACE, mirror=bad),
    ("fit_chain", "begin"): lambda bad: sw.fit_chain(SURFACE, POINTS[:2], [0, 1], bad),
}

STOPS: dict[tuple[str, str], Call] = {
    ("LiveWire.extend_straight", "stops"): lambda bad: EDGES.extend_straight((0, 1), bad),
    ("LiveWire.edge_loop", "stops"): lambda bad: EDGES.edge_loop((0, 1), bad),
}
NO_STOPS = {what: value for what, value in NO_ARRAYS.items() if what != "a set"}
# The library checks how large these numbers are, once it knows the mesh.
ANY_NUMBERS: dict[tuple[str, str], Call] = {
    ("CutCurve", "start"): lambda bad: sw.CutCurve(POINTS[:2], bad),
    ("CutCurve", "end"): lambda bad: sw.CutCurve(POINTS[:2], 0, bad),
    ("CutCurve", "image_of"): lambda bad: sw.CutCurve(POINTS[:2], 0, image_of=bad),
    ("DistanceField.closed_wires", "count"): lambda bad: FIELD.closed_wires(bad),
    ("flatten", "max_steps"): lambda bad: sw.flatten(POINTS, TRIANGLES, max_steps=bad),
    ("embed", "max_faces_added"): lambda bad: sw.embed(SURFACE, METRIC, max_faces_added=bad, max_error=0),
}


def cases(of: dict[tuple[str, str], Call], values: dict[str, object]) -> list[Any]:
    return [
        pytest.param(call, argument, value, id=f"{function}-{argument}-{what}")
        for (function, argument), call in of.items()
        for what, value in values.items()
    ]


@pytest.mark.parametrize(
    ("call", "argument", "value"),
    cases(ROWS, NO_ARRAYS | FLAT | DEEP)
    + cases(LISTS, NO_ARRAYS | DEEP)
    + cases(THREES, NO_ARRAYS | FLAT | DEEP)
    + cases(OBJECTS, NO_ARRAYS | FLAT | DEEP)
    + cases(PICKS, NO_PICKS | HUGE)
    + cases(STOPS, NO_STOPS | HUGE)
    + cases(ANY_NUMBERS, NO_PICKS),
)
def test_the_error_names_the_argument(call: Call, argument: str, value: object) -> None:
    with pytest.raises(ValueError, match=rf"\b{argument}\b"):
        call(value)


def test_sets_of_stops_and_empty_lists_are_right() -> None:
    assert EDGES.extend_straight((0, 1), {3, 4}).vertices[0] == 1
    assert sw.apply_scribbles(SURFACE, METRIC, []).tensors.shape == METRIC.tensors.shape
    assert sw.apply_scribbles(SURFACE, METRIC, ()).tensors.shape == METRIC.tensors.shape
    ACROSS.set_scribbles([])
    assert len(sw.face_segments(SURFACE, [])) == len(TRIANGLES)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_coordinates_that_are_not_finite_are_named(bad: float) -> None:
    points = POINTS.copy()
    points[5, 1] = bad
    with pytest.raises(ValueError, match=r"\b5\b.*not finite"):
        sw.Surface(points, TRIANGLES)
    with pytest.raises(ValueError, match="not finite"):
        sw.apply_scribbles(SURFACE, METRIC, [sw.Scribble([[bad, 0, 0]], [0])])


def test_arrays_of_any_layout_are_the_same() -> None:
    origin = np.array([[0.0, 9.0], [0.0, 9.0], [5.0, 9.0]])[:, 0]
    assert RAYS.first_hit(origin, [0, 0, -1]) == RAYS.first_hit([0, 0, 5], np.array([0, 0, -1], ">i2"))
