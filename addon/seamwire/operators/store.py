# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that stores islands or views with the mesh, for shaders, geometry nodes and other add-ons."""

from __future__ import annotations

import bpy

from ..mesh import settings as chosen
from ..words.names import count
from .edit_mesh_operator import EditMeshOperator, changing, description_of_item

ISLAND_ITEMS = (
    ("ATTRIBUTE", "Face Attribute", "Numbers from 0 in the attribute 'island', the largest island first", 0),
    ("MATERIALS", "Materials", "Up to twelve materials in new slots, so that neighbors differ", 2),
)
VIEW_ITEMS = (
    ("STRENGTH", "Feature Strength", "How strongly wires follow the shape, in the attribute 'feature_strength'", 3),
    (
        "CONCAVITY",
        "Concavity",
        "The larger curvature, smoothed and negative in valleys, in the attribute 'concavity'",
        4,
    ),
    (
        "DISTANCE",
        "Distance",
        "Distance in the metric from the active or first selected vertex, in the attribute 'metric_distance'",
        5,
    ),
    (
        "CRESTS",
        "Ridges and Valleys",
        "Strength beside ridges and valleys, negative for valleys, in the attribute 'ridges_and_valleys'",
        6,
    ),
)
VIEW_NAMES = tuple(item[0] for item in VIEW_ITEMS)


class MESH_OT_seamwire_store(EditMeshOperator, bpy.types.Operator):
    """Store islands or a view with the mesh, for shaders, geometry nodes and other add-ons"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_store"
    bl_label = "Store Islands or View"

    what: bpy.props.EnumProperty(
        name="Store",
        description="What to store: the islands that seams make, or a view of the metric",
        items=(*ISLAND_ITEMS, *VIEW_ITEMS),
    )
    description = description_of_item("what")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether a mesh is active, in Object or Edit Mode."""
        obj = context.active_object
        if obj is not None and obj.type == "MESH" and obj.mode in {"OBJECT", "EDIT"}:
            return True
        cls.poll_message_set("Needs a mesh in Object or Edit Mode")
        return False

    def run(self, context: bpy.types.Context) -> set[str]:
        """Store it."""
        return (self._store_view if self.what in VIEW_NAMES else self._store_islands)(context, self.what)

    def _store_islands(self, context: bpy.types.Context, kind: str) -> set[str]:
        """Store the islands of all objects in Edit Mode as an item of `ISLAND_ITEMS`."""
        from ..mesh.seam_islands import store

        if context.mode != "EDIT_MESH":
            raise ValueError("Islands are stored in Edit Mode")
        with changing():
            found = self.for_each_object(context, lambda obj: store(obj, kind))
        if not found:
            return {"CANCELLED"}
        self.report({"INFO"}, f"{count(sum(found.values()), 'island')} stored")
        return {"FINISHED"}

    def _store_view(self, context: bpy.types.Context, view: str) -> set[str]:
        """Store an item of `VIEW_ITEMS` for each vertex of the active object."""
        from ..mesh.view_fields import store

        name, low, high = store(context.active_object, view, chosen.settings(context))
        self.report({"INFO"}, f"Attribute '{name}': {low:.4g} to {high:.4g}")
        return {"FINISHED"}


register, unregister = bpy.utils.register_classes_factory((MESH_OT_seamwire_store,))
