# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that stores a view as an attribute of a mesh's vertices, for shaders, geometry nodes and other add-ons."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bmesh
import bpy

from . import tool

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

OPERATOR = "mesh.seamwire_lab_store"
ITEMS = (
    ("STRENGTH", "Feature Strength", "How strongly wires follow the shape, in the attribute 'feature_strength'"),
    ("CONCAVITY", "Concavity", "The larger curvature, smoothed and negative in valleys, in the attribute 'concavity'"),
    (
        "DISTANCE",
        "Distance",
        "Distance in the metric from the active or first selected vertex, in the attribute 'metric_distance'",
    ),
    (
        "CRESTS",
        "Ridges and Valleys",
        "Strength beside ridges and valleys, negative for valleys, in the attribute 'ridges_and_valleys'",
    ),
)
_ATTRIBUTES = {
    "STRENGTH": "feature_strength",
    "CONCAVITY": "concavity",
    "DISTANCE": "metric_distance",
    "CRESTS": "ridges_and_valleys",
}
_TAKEN = "The mesh has another attribute '{}': rename or remove it"


class MESH_OT_seamwire_lab_store(bpy.types.Operator):
    """Store a view with the mesh, for shaders, geometry nodes and other add-ons"""  # noqa: D400 - a tooltip

    bl_idname = OPERATOR
    bl_label = "Store View as Attribute"
    bl_options = {"REGISTER", "UNDO"}

    view: bpy.props.EnumProperty(name="View", description="What to store", items=ITEMS)

    @classmethod
    def description(cls, _context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        """Return the tooltip of a menu entry."""
        return properties.bl_rna.properties["view"].enum_items[properties.view].description

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether a mesh is active, in Object or Edit Mode."""
        obj = context.active_object
        if obj is not None and obj.type == "MESH" and obj.mode in {"OBJECT", "EDIT"}:
            return True
        cls.poll_message_set("Needs a mesh in Object or Edit Mode")
        return False

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Store the view of the active object."""
        try:
            low, high = _store(context.active_object, self.view)
        except (ValueError, ImportError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"Attribute '{_ATTRIBUTES[self.view]}': {low:.4g} to {high:.4g}")
        return {"FINISHED"}


def _store(obj: bpy.types.Object, view: str) -> tuple[float, float]:
    """Store a view, and return its least and largest finite value. Vertices that no path leads to have a distance of -1.

    Raises
    ------
    ValueError
        If nothing is visible, no vertex is selected to measure from, or something else has the attribute's name.
    ImportError
        If there is no compiled library.
    """
    import numpy as np

    from .fields import FieldMaker
    from .views import request_for

    core, arrays = tool.load(), tool.read(obj)
    source = selected_vertex(obj) if view == "DISTANCE" else None
    if view == "DISTANCE" and source is None:
        raise ValueError("Select the vertex that distances are to be measured from")
    maker = FieldMaker(core, lambda: core.Surface(arrays.points, arrays.triangles, arrays.edges))
    if view == "CRESTS":
        values = maker.crests_at_vertices()
    else:
        options = tool.snapshot(tool.settings(), auto=tool.auto_for(obj, arrays))
        made = maker.make(request_for(options, frozenset({view}), source))
        values = np.asarray(getattr(made, view.lower()))
    some = values[np.isfinite(values)]
    _write(obj, _ATTRIBUTES[view], np.where(np.isfinite(values), values, -1.0).astype(np.float32))
    return float(some.min(initial=np.inf)), float(some.max(initial=-np.inf))


def selected_vertex(obj: bpy.types.Object) -> int | None:
    """Return the active vertex of a mesh, or the first selected one, or None.

    If all vertices are selected, as in new meshes, nobody has chosen one.
    """
    if obj.mode == "EDIT":
        bm = tool.edit_bmesh(obj.data)
        active = bm.select_history.active
        if isinstance(active, bmesh.types.BMVert) and not active.hide:
            return active.index
        selected = [vertex.select for vertex in bm.verts]
    else:
        selected = [vertex.select for vertex in obj.data.vertices]
    return selected.index(True) if any(selected) and not all(selected) else None


def _is_taken(bm: bmesh.types.BMesh, name: str) -> bool:
    """Return whether an attribute of any kind has a name."""
    kinds = ("float", "int", "bool", "float_vector", "float_color", "color", "string")
    return any(
        getattr(items.layers, kind).get(name) is not None
        for items in (bm.verts, bm.edges, bm.faces, bm.loops)
        for kind in kinds
        if hasattr(items.layers, kind)
    )


def _write(obj: bpy.types.Object, name: str, values: NDArray[np.float32]) -> None:
    mesh = obj.data
    if obj.mode == "EDIT":
        bm = tool.edit_bmesh(mesh)
        layer = bm.verts.layers.float.get(name)
        if layer is None and _is_taken(bm, name):
            raise ValueError(_TAKEN.format(name))
        if layer is None:
            layer = bm.verts.layers.float.new(name)
        for vertex, value in zip(bm.verts, values.tolist(), strict=True):
            vertex[layer] = value
        bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
        return
    attribute = mesh.attributes.get(name)
    if attribute is not None and (attribute.domain, attribute.data_type) != ("POINT", "FLOAT"):
        raise ValueError(_TAKEN.format(name))
    if attribute is None:
        attribute = mesh.attributes.new(name, "FLOAT", "POINT")
    attribute.data.foreach_set("value", values)
    mesh.update()


register, unregister = bpy.utils.register_classes_factory((MESH_OT_seamwire_lab_store,))
