# SPDX-License-Identifier: GPL-3.0-or-later
"""Seamwire Lab in the background: views stored as attributes of the vertices."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
import traces
from lab import disable_lab, enable_lab, of_lab
from scene import add_object, add_suzanne, edit
from seamwire.core.base import native
from seamwire.mesh import edit_mesh

pytestmark = pytest.mark.usefixtures("lab_settings")


def stored(obj: bpy.types.Object, name: str) -> np.ndarray:
    obj.update_from_editmode()
    mesh = obj.data.copy()
    values = np.empty(len(mesh.vertices), dtype=np.float32)
    mesh.attributes[name].data.foreach_get("value", values)
    assert (mesh.attributes[name].domain, mesh.attributes[name].data_type) == ("POINT", "FLOAT")
    bpy.data.meshes.remove(mesh)
    return values


def expected(obj: bpy.types.Object) -> tuple[object, object]:
    sw, arrays = native.load(), edit_mesh.read(obj)
    surface = sw.Surface(arrays.points, arrays.triangles, arrays.edges)
    return surface, sw.principal_curvatures(surface)


@pytest.mark.every_blender
@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_strengths_and_concavity_are_stored_as_the_library_has_them(mode: str) -> None:
    obj = add_suzanne(1)
    bpy.ops.object.mode_set(mode=mode)
    surface, curvature = expected(obj)
    smoothed = native.load().smoothed_curvatures(surface, curvature)
    for view, name, values in (
        ("STRENGTH", "feature_strength", curvature.difference),
        ("CONCAVITY", "concavity", smoothed.k1),
    ):
        for _ in range(2):  # again: over what is there
            assert bpy.ops.mesh.seamwire_lab_store(view=view) == {"FINISHED"}
            assert stored(obj, name) == pytest.approx(values.astype(np.float32), rel=1e-6)
    assert smoothed.k1.min() < 0.0 < smoothed.k1.max()


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_ridges_and_valleys_are_stored_beside_them_with_their_strength(mode: str) -> None:
    obj = add_suzanne(1)
    bpy.ops.object.mode_set(mode=mode)
    surface, curvature = expected(obj)
    lines = native.load().crest_lines(surface, native.load().smoothed_curvatures(surface, curvature))
    assert bpy.ops.mesh.seamwire_lab_store(view="CRESTS") == {"FINISHED"}
    found = stored(obj, "ridges_and_valleys")
    assert found.max() == pytest.approx(lines.strengths[lines.curvatures[lines.starts[:-1]] > 0.0].max())
    assert found.min() == pytest.approx(-lines.strengths[lines.curvatures[lines.starts[:-1]] < 0.0].max())
    assert set(np.flatnonzero(found)) <= set(lines.edges.ravel())


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_distances_are_from_the_selected_vertex_and_minus_one_where_nothing_leads(mode: str) -> None:
    points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (5, 5, 5), (6, 5, 5), (5, 6, 5)]
    obj = add_object(points, [(0, 1, 2, 3), (4, 5, 6)])
    # By the operator: to set it of edges crashes Blender 5.0.
    edit()
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    with pytest.raises(RuntimeError, match="Select the vertex"):
        bpy.ops.mesh.seamwire_lab_store(view="DISTANCE")
    assert "metric_distance" not in obj.data.attributes
    obj.data.vertices[1].select = True
    bpy.ops.object.mode_set(mode=mode)
    assert bpy.ops.mesh.seamwire_lab_store(view="DISTANCE") == {"FINISHED"}
    values = stored(obj, "metric_distance")
    assert values == pytest.approx([1, 0, 1, 2**0.5, -1, -1, -1], abs=1e-6)


@pytest.mark.every_blender
def test_an_attribute_of_that_name_and_another_kind_is_left_alone() -> None:
    obj = add_suzanne()
    obj.data.attributes.new("concavity", "INT", "FACE")
    with pytest.raises(RuntimeError, match="another attribute 'concavity'"):
        bpy.ops.mesh.seamwire_lab_store(view="CONCAVITY")
    bpy.ops.object.mode_set(mode="EDIT")
    with pytest.raises(RuntimeError, match="another attribute 'concavity'"):
        bpy.ops.mesh.seamwire_lab_store(view="CONCAVITY")
    bpy.ops.object.mode_set(mode="OBJECT")
    assert obj.data.attributes["concavity"].data_type == "INT"


def test_a_mesh_without_edges_is_refused() -> None:
    obj = add_object([(0, 0, 0)], [])
    with pytest.raises(RuntimeError, match="No face is visible"):
        bpy.ops.mesh.seamwire_lab_store(view="STRENGTH")
    assert not [name for name in obj.data.attributes.keys() if name == "feature_strength"]  # noqa: SIM118


@pytest.mark.every_blender
def test_disabled_it_leaves_nothing_behind() -> None:
    with_lab = traces.traces()
    assert len(of_lab()) > 5
    bpy.context.window_manager.seamwire_lab.show_paths = True
    disable_lab()
    assert of_lab() == []
    enable_lab()
    assert not bpy.context.window_manager.seamwire_lab.show_paths
    assert traces.difference(with_lab, traces.traces()) == {}
