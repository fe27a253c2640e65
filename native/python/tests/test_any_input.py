# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever is handed over is taken or refused: with ValueError, or TypeError where it is of no type that could be meant."""

from __future__ import annotations

from collections.abc import Callable

import hypothesis.extra.numpy as hnp
import meshes
import numpy as np
import pytest
import seamwire_core as sw
from hypothesis import given, settings
from hypothesis import strategies as st

REFUSALS = (ValueError, TypeError)
settings.register_profile("seamwire", deadline=None, max_examples=300, derandomize=True)
settings.load_profile("seamwire")

scalars = st.none() | st.booleans() | st.integers() | st.integers(-2, 30) | st.floats() | st.text(max_size=3)
nested = st.recursive(scalars, lambda inner: st.lists(inner, max_size=4) | st.tuples(inner, inner), max_leaves=12)
dtypes = hnp.integer_dtypes(endianness="?") | hnp.floating_dtypes(endianness="?") | hnp.scalar_dtypes()
arrays = hnp.arrays(dtypes, hnp.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=4))
rows_of_three = hnp.arrays(dtypes, st.tuples(st.integers(0, 6), st.just(3)))
anything = nested | arrays | rows_of_three
numbers = st.floats() | st.sampled_from([0.0, 1.0, 2.0, 10.0, 100.0, 1e160, 1e-320])

POINTS, TRIANGLES = meshes.torus(6, 6)
SURFACE = sw.Surface(POINTS, TRIANGLES)
CURVATURE = sw.principal_curvatures(SURFACE)
EUCLIDEAN = sw.euclidean_metric(SURFACE, CURVATURE)
EMBEDDING = sw.embed(SURFACE, EUCLIDEAN, max_error=0)
FIELD = sw.distance_field(EMBEDDING, 0)


def taken_or_refused(call: Callable[[], object]) -> None:
    """Call it, whatever comes of it but other errors."""
    try:
        call()
    except REFUSALS as refusal:
        assert str(refusal)


@given(points=anything, triangles=anything, edges=anything)
def test_a_mesh(points: object, triangles: object, edges: object) -> None:
    taken_or_refused(lambda: sw.Surface(points, triangles, edges))
    taken_or_refused(lambda: sw.Surface(POINTS, triangles, edges))
    taken_or_refused(lambda: sw.Surface(POINTS, TRIANGLES, edges))
    taken_or_refused(lambda: sw.RayTree(points, triangles))
    taken_or_refused(lambda: sw.RayTree(POINTS, triangles))


@given(points=anything, corners=anything, sizes=anything, cut=anything)
def test_polygons_and_cuts(points: object, corners: object, sizes: object, cut: object) -> None:
    taken_or_refused(lambda: sw.triangulate(points, corners, sizes))
    taken_or_refused(lambda: sw.triangulate(POINTS, corners, sizes))
    taken_or_refused(lambda: sw.face_segments(SURFACE, cut))


@given(points=anything, triangles=anything, cuts=anything, uvs=anything, islands=anything)
def test_maps(points: object, triangles: object, cuts: object, uvs: object, islands: object) -> None:
    taken_or_refused(lambda: sw.flatten(points, triangles, cuts))
    taken_or_refused(lambda: sw.flatten(POINTS, TRIANGLES, cuts, start=uvs))
    taken_or_refused(lambda: sw.measure_map(POINTS, TRIANGLES, uvs, islands))
    taken_or_refused(lambda: sw.measure_map(POINTS, TRIANGLES, POINTS[TRIANGLES][:, :, :2], islands))
    taken_or_refused(lambda: sw.pack_islands(uvs, islands))
    taken_or_refused(lambda: sw.pack_islands(POINTS[TRIANGLES][:, :, :2], islands, aspects=uvs))


@given(pick=anything, stops=anything, number=numbers)
def test_picks(pick: object, stops: object, number: float) -> None:
    taken_or_refused(lambda: sw.distance_field(EMBEDDING, pick))
    taken_or_refused(lambda: FIELD.trace(pick))
    taken_or_refused(lambda: sw.edge_wires(SURFACE, EUCLIDEAN, pick, turning=number).trace(pick))
    taken_or_refused(lambda: sw.shortest_cycle(SURFACE, EUCLIDEAN, pick, turning=number))
    for call in (LIVE.seed, LIVE.wires, LIVE.loop):
        taken_or_refused(lambda call=call: call(pick))
    for call in (LIVE.extend_straight, LIVE.edge_loop):
        taken_or_refused(lambda call=call: call(pick, stops))
        taken_or_refused(lambda call=call: call((0, 1), stops))


LIVE = sw.LiveWire(SURFACE, along="edges")


@pytest.mark.parametrize("metric", [sw.feature_metric, sw.campen_metric, sw.pottmann_kovacs_metric])
@given(
    strength=st.dictionaries(
        st.sampled_from(["gamma", "alpha", "beta", "max_anisotropy", "clamp_percentile"]), numbers, max_size=2
    ),
    follow=st.sampled_from(["min", "max", "", "both"]),
)
@settings(max_examples=100)
def test_strengths(metric: Callable[..., sw.Metric], strength: dict[str, float], follow: str) -> None:
    try:
        found = metric(SURFACE, CURVATURE, follow=follow, **strength)
    except REFUSALS as refusal:
        assert str(refusal)
        return
    embedding = sw.embed(SURFACE, found, max_faces_added=2000, max_error=0)
    distances = sw.distance_field(embedding, 0).distances
    assert not np.isnan(distances).any()
    assert (distances >= 0.0).all()


@given(points=anything, faces=anything, eta=numbers, radius=st.none() | numbers, rings=st.integers())
def test_strokes(points: object, faces: object, eta: float, radius: float | None, rings: int) -> None:
    def stroke() -> object:
        scribble = sw.Scribble(points, faces, eta=eta, rings=rings, radius=radius)
        return sw.apply_scribbles(SURFACE, EUCLIDEAN, [scribble])

    taken_or_refused(stroke)


@given(value=anything)
@settings(max_examples=100)
def test_seams_parts_and_cuts(value: object) -> None:
    for name in ("front", "mirror", "weights", "seams"):
        taken_or_refused(lambda name=name: sw.SeamPlanner(SURFACE, along="edges", **{name: value}))
    for name in ("mirror", "marked", "seams"):
        taken_or_refused(lambda name=name: sw.PartFinder(SURFACE, **{name: value}))
    for name in ("kept", "dropped", "parted"):
        taken_or_refused(lambda name=name: PARTS.find(0.5, **{name: value}))
    for name in ("end", "faces", "image_of"):
        taken_or_refused(lambda name=name: sw.CutCurve(POINTS[:2], 0, **{name: value}))


PARTS = sw.PartFinder(SURFACE)


@pytest.mark.parametrize(
    ("name", "call"),
    [
        ("image_of", lambda value: sw.CutCurve(POINTS[:2], 0, image_of=value)),
        ("mirror", lambda value: sw.SeamPlanner(SURFACE, along="edges", mirror=value)),
        ("mirror", lambda value: sw.PartFinder(SURFACE, mirror=value)),
        ("parted", lambda value: PARTS.find(0.5, parted=[value])),
    ],
)
def test_what_is_no_number_is_named(name: str, call: Callable[[object], object]) -> None:
    for value in ("x", 1.5, 1 << 40):
        with pytest.raises(ValueError, match=name):
            call(value)


@given(point=st.tuples(anything, anything), number=numbers | anything)
def test_surface_points(point: tuple[object, object], number: object) -> None:
    taken_or_refused(lambda: sw.distance_field(EMBEDDING, point))
    taken_or_refused(lambda: sw.distance_field(EMBEDDING, [point, 0], targets=point))
    taken_or_refused(lambda: sw.distance_field(EMBEDDING, (0, point[1])))
    taken_or_refused(lambda: sw.distance_field(EMBEDDING, 0, max_distance=number))
    for call in (FIELD.distance, FIELD.trace_to):
        taken_or_refused(lambda call=call: call(*point))
        taken_or_refused(lambda call=call: call(0, point[1]))


@given(rays=st.tuples(anything, anything))
def test_rays(rays: tuple[object, object]) -> None:
    taken_or_refused(lambda: RAYS.first_hit(*rays))


RAYS = sw.RayTree(POINTS, TRIANGLES)


@given(one=anything, other=anything, number=numbers)
def test_pickers(one: object, other: object, number: float) -> None:
    taken_or_refused(lambda: sw.Picker(POINTS, TRIANGLES, one, other, np.eye(3)))
    taken_or_refused(lambda: sw.Picker(POINTS, TRIANGLES, FACES, [], one))
    taken_or_refused(lambda: PICKER.set_layer(0, one, other, number, vertices=one))
    taken_or_refused(lambda: PICKER.set_vertices(one, number, other))
    taken_or_refused(lambda: PICKER.pick(*SIGHT, layers=(0,), preferred=True, features=True, crests=0))
    taken_or_refused(lambda: PICKER.pick(*SIGHT, layers=one))
    taken_or_refused(lambda: PICKER.pick(one, other, (9, 9), (1, 1)))
    taken_or_refused(lambda: PICKER.pick(np.eye(4), np.eye(4), one, other, other, number))


FACES = np.arange(len(TRIANGLES))
PICKER = sw.Picker(POINTS, TRIANGLES, FACES, TRIANGLES[:, :2], np.eye(3))
SIGHT = np.diag([1.0, 1.0, 0.1, 1.0]), np.eye(4), (9, 9), (4.5, 8)
