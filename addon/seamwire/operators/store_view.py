# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that stores what a view shows as an attribute of the vertices."""

from __future__ import annotations

import bpy

from ..mesh import settings as chosen

VIEW_ITEMS = (
    ("STRENGTH", "Feature Strength", "s of the metric, in the attribute 'feature_strength'", 0),
    (
        "CONCAVITY",
        "Concavity",
        "The larger curvature, smoothed: below zero in valleys, in the attribute 'concavity'",
        1,
    ),
    (
        "DISTANCE",
        "Distance",
        "From the active or first selected vertex, in the metric, in the attribute 'metric_distance'",
        2,
    ),
    (
        "CRESTS",
        "Ridges and Valleys",
        "At the vertices beside one its strength, below zero for valleys, in the attribute 'ridges_and_valleys'",
        3,
    ),
)


class MESH_OT_seamwire_store_view(bpy.types.Operator):
    """Store what a view shows as a number for each vertex, for shaders, geometry nodes and other add-ons"""  # noqa: D400 - a tooltip

    bl_idname = "mesh.seamwire_store_view"
    bl_label = "Store View as Attribute"
    bl_options = {"REGISTER", "UNDO"}

    view: bpy.props.EnumProperty(
        name="View",
        description="What is stored; where not given, what is shown as heat, or else feature strength",
        items=VIEW_ITEMS,
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether a mesh is active, in Object or Edit Mode."""
        obj = context.active_object
        if obj is not None and obj.type == "MESH" and obj.mode in {"OBJECT", "EDIT"}:
            return True
        cls.poll_message_set("Needs a mesh in Object or Edit Mode")
        return False

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Compute it of the active object, and store it; nothing is changed where that cannot be."""
        from ..core.base.native import NativeError
        from ..mesh.view_fields import store

        settings = chosen.settings(context)
        if not self.properties.is_property_set("view") and settings.heat in {item[0] for item in VIEW_ITEMS}:
            self.view = settings.heat
        try:
            name, low, high = store(context.active_object, self.view, settings)
        except (NativeError, ValueError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"Attribute '{name}': {low:.4g} to {high:.4g}")
        return {"FINISHED"}


def register() -> None:
    """Add the operator."""
    bpy.utils.register_class(MESH_OT_seamwire_store_view)


def unregister() -> None:
    """Remove it."""
    bpy.utils.unregister_class(MESH_OT_seamwire_store_view)
