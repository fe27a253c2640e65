# SPDX-License-Identifier: GPL-3.0-or-later
"""What goes in as arrays, and what comes out."""

from __future__ import annotations

import gc
import re
from collections.abc import Callable

import meshes
import numpy as np
import pytest
import seamwire_core as sw

POINTS, TRIANGLES = meshes.grid(3)
INTEGERS = [np.int8, np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64, np.uint64, ">i4", ">u8"]


@pytest.mark.parametrize("dtype", INTEGERS)
def test_triangles_of_any_integer_type(dtype: np.dtype) -> None:
    surface = sw.Surface(POINTS, TRIANGLES.astype(dtype), np.array([[0, 1], [5, 4]], dtype))
    np.testing.assert_array_equal(surface.triangles, TRIANGLES)
    np.testing.assert_array_equal(surface.edges, [[0, 1], [4, 5]])


@pytest.mark.parametrize("dtype", [np.float64, np.float32, np.float16, ">f8", np.int64, np.longdouble])
def test_points_of_any_real_type(dtype: np.dtype) -> None:
    points = np.round(POINTS * 3)
    np.testing.assert_array_equal(sw.Surface(points.astype(dtype), TRIANGLES).points, points)


def unaligned(array: np.ndarray) -> np.ndarray:
    memory = np.empty(array.nbytes + 1, np.uint8)[1:]
    copy = np.ndarray(array.shape, array.dtype, memory.data)
    copy[...] = array
    return copy


@pytest.mark.parametrize(
    "layout",
    [
        np.asfortranarray,
        lambda a: np.repeat(a, 2, 0)[::2],
        lambda a: a[::-1].copy()[::-1],
        lambda a: np.concatenate([a, a], 1)[:, :3],
        unaligned,
        np.ndarray.tolist,
        lambda a: tuple(map(tuple, a)),
    ],
)
def test_arrays_of_any_layout(layout: Callable) -> None:
    surface = sw.Surface(layout(POINTS), layout(TRIANGLES))
    np.testing.assert_array_equal(surface.points, POINTS)
    np.testing.assert_array_equal(surface.triangles, TRIANGLES)


def test_the_callers_arrays_are_copied() -> None:
    points, triangles = POINTS.copy(), TRIANGLES.copy()
    surface = sw.Surface(points, triangles)
    points[:] = np.nan
    triangles[:] = -1
    np.testing.assert_array_equal(surface.points, POINTS)
    np.testing.assert_array_equal(surface.triangles, TRIANGLES)


@pytest.mark.parametrize(
    ("points", "triangles", "edges", "message"),
    [
        (POINTS[:, :2], TRIANGLES, None, "points: expected real numbers of shape (n, 3), got shape (16, 2)"),
        (POINTS.ravel(), TRIANGLES, None, "points: expected real numbers of shape (n, 3), got shape (48,)"),
        (POINTS[None], TRIANGLES, None, "points: expected real numbers of shape (n, 3), got shape (1, 16, 3)"),
        ([[0, 0, 0], [1, 1]], TRIANGLES, None, "points: expected real numbers of shape (n, 3), got"),
        (
            POINTS.astype(complex),
            TRIANGLES,
            None,
            "points: expected real numbers of shape (n, 3), got dtype complex128",
        ),
        (POINTS.astype(str), TRIANGLES, None, "points: expected real numbers of shape (n, 3), got dtype <U"),
        (POINTS.astype(object), TRIANGLES, None, "points: expected real numbers of shape (n, 3), got dtype object"),
        (None, TRIANGLES, None, "points: expected real numbers"),
        ({}, TRIANGLES, None, "points: expected real numbers"),
        (POINTS, TRIANGLES.astype(float), None, "triangles: expected integers of shape (n, 3), got dtype float64"),
        (POINTS, TRIANGLES > 2, None, "triangles: expected integers of shape (n, 3), got dtype bool"),
        (POINTS, TRIANGLES[:, :2], None, "triangles: expected integers of shape (n, 3), got shape (18, 2)"),
        (POINTS, [[0, 1, 2], [3, 4]], None, "triangles: expected integers"),
        (POINTS, [[0, 1, 2], [0, 1, 2**31]], None, "triangles: row 1: vertex 2147483648"),
        (POINTS, [[0, 1, -(2**63)]], None, "triangles: row 0: vertex -9223372036854775808"),
        (POINTS, [[0, 1, 2**64]], None, "triangles: expected integers"),
        (POINTS, [[0, 1, 2], [0, 1, 16]], None, "triangle 1: vertex 16"),
        (POINTS, [[0, 1, -1]], None, "triangle 0: vertex -1"),
        (POINTS, TRIANGLES, [[0, 1], [3, 99]], "edge 1: vertex 99"),
        (POINTS, TRIANGLES, [[0, 1], [3, 3]], "edge 1 joins vertex 3 to itself"),
        (POINTS, TRIANGLES, TRIANGLES, "edges: expected integers of shape (n, 2), got shape (18, 3)"),
        (np.where(np.arange(16)[:, None] == 7, np.nan, POINTS), TRIANGLES, None, "vertex 7"),
        (np.where(np.arange(16)[:, None] == 9, np.inf, POINTS), TRIANGLES, None, "vertex 9"),
        ([], [], None, "the mesh is empty"),
        (POINTS, [], None, "the mesh is empty"),
        (np.empty((0, 3)), np.empty((0, 3), int), np.empty((0, 2), int), "the mesh is empty"),
    ],
)
def test_wrong_input_is_a_value_error_that_says_what(
    points: object, triangles: object, edges: object, message: str
) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        sw.Surface(points, triangles, edges)


def views(surface: sw.Surface) -> list[tuple[object, str]]:
    """Every array of every kind of result, as (owner, attribute)."""
    curvature = sw.principal_curvatures(surface)
    metric = sw.feature_metric(surface, curvature)
    embedding = sw.embed(surface, metric, max_error=0)
    field = sw.distance_field(embedding, 0)
    live = sw.LiveWire(surface)
    live.seed(0)
    live.wait()
    owners = [
        (surface, "points triangles edges"),
        (
            surface.report,
            "nonmanifold_edges unorientable_edges flipped_faces zero_area_faces low_faces degenerate_faces "
            "duplicate_faces isolated_vertices",
        ),
        (curvature, "k1 k2 d1 d2 normals difference"),
        (metric, "normals tensors"),
        (embedding, "points triangles edges lengths source_face unreachable"),
        (field, "distances"),
        (field.trace(50), "points faces"),
        (sw.edge_wires(surface, metric, 0).trace(50), "vertices"),
        (live.wires(50).wires[1], "points faces vertices"),
    ]
    return [(owner, name) for owner, names in owners for name in names.split()]


def test_arrays_are_read_only_views_without_a_copy(surface: sw.Surface) -> None:
    for owner, name in views(surface):
        array = getattr(owner, name)
        assert not array.flags.writeable, name
        if array.size:
            with pytest.raises(ValueError, match="WRITEABLE"):
                array.setflags(write=True)
            assert array.base is owner, name
            assert array.ctypes.data == getattr(owner, name).ctypes.data, name


def test_arrays_outlive_their_owners() -> None:
    owners = views(sw.Surface(*meshes.torus(40, 24)))
    arrays = [getattr(owner, name) for owner, name in owners]
    copies = [array.copy() for array in arrays]
    del owners
    gc.collect()
    np.random.default_rng(0).random(1_000_000)  # memory to write over what had been freed
    for array, copy in zip(arrays, copies, strict=True):
        np.testing.assert_array_equal(array, copy)


def test_shapes_and_types(surface: sw.Surface) -> None:
    n = len(surface.points)
    shapes = {"points": (3,), "triangles": (3,), "normals": (3,), "d1": (3,), "d2": (3,), "tensors": (3, 3)}
    for owner, name in views(surface):
        array = getattr(owner, name)
        if "edges" in name:
            assert array.shape[1:] == (2,)
        else:
            assert array.shape[1:] == shapes.get(name, ()), name
        assert array.dtype in (np.float64, np.int32)
        if isinstance(owner, sw.Curvature | sw.Metric | sw.DistanceField):
            assert len(array) == n


def test_tensors_are_those_of_the_metric(curvature: sw.Curvature, metric: sw.Metric) -> None:
    """That is, rows and columns of the views are where they belong: M d1 and M d2 are multiples of d1 and d2."""
    for direction in (curvature.d1, curvature.d2):
        mapped = np.einsum("nij,nj->ni", metric.tensors, direction)
        assert np.abs(np.cross(mapped, direction)).max() < 1e-9 * np.abs(mapped).max()
    assert np.abs(np.einsum("nij,nj->ni", metric.tensors, metric.normals)).max() < 1e-9


def test_polygons_are_cut_into_triangles() -> None:
    points = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.3, 0.3, 0.0), (0.0, 1.0, 0.0)]
    triangles, polygons = sw.triangulate(points, [0, 1, 2, 3, 1, 2, 3], [4, 3])
    assert triangles.dtype == polygons.dtype == np.int32
    assert triangles.tolist() == [[0, 1, 2], [0, 2, 3], [1, 2, 3]], (
        "the second quad would fold along the other diagonal"
    )
    assert polygons.tolist() == [0, 0, 1]
    turned, _ = sw.triangulate(points, [1, 2, 3, 0], [4])
    assert turned.tolist() == [[1, 2, 0], [2, 3, 0]]
    assert sw.triangulate([], [], [])[0].shape == (0, 3)
    with pytest.raises(ValueError, match=r"^sizes: they add up to 4, but there are 3 corners"):
        sw.triangulate(points, [0, 1, 2], [4])
    with pytest.raises(ValueError, match=r"^points: expected real numbers of shape \(n, 3\)"):
        sw.triangulate([(0.0, 0.0)], [0, 1, 2], [3])


@pytest.mark.parametrize("edge", [np.array(3), np.array(3.5), np.array("ab"), np.array([1]), 5, "abc", None, [1, 2, 3]])
def test_what_is_no_edge_is_said(surface: sw.Surface, metric: sw.Metric, edge: object) -> None:
    """An array without dimensions is a sequence to Python, but has no length."""
    live = sw.LiveWire(surface, along="edges")
    for call in (
        lambda: sw.shortest_cycle(surface, metric, edge),
        lambda: live.loop(edge),
        lambda: live.edge_loop(edge),
    ):
        with pytest.raises(ValueError, match="edge: expected an edge as two vertex numbers"):
            call()


def test_a_mesh_too_small_for_squares_of_lengths_is_refused() -> None:
    points, triangles = meshes.grid(2)
    assert sw.Surface(1e-149 * points, triangles).scale == pytest.approx(1e149)
    with pytest.raises(ValueError, match="the longest side of the box around the mesh is 1e-160"):
        sw.Surface(1e-160 * points, triangles)
    assert sw.Surface(0.0 * points, triangles).scale == 1.0
