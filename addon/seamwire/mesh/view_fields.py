# SPDX-License-Identifier: GPL-3.0-or-later
"""What the metric sees, stored as attributes of a mesh's vertices."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bmesh
import bpy
import numpy as np

from ..core.base import native
from ..core.fields.crests import Crests
from ..core.fields.metric_fields import FieldMaker, Request
from . import edit_mesh
from .auto import auto_for
from .settings import snapshot

if TYPE_CHECKING:
    from typing import Literal

    from numpy.typing import NDArray

    from .settings import SeamwireSettings

NAMES = {
    "STRENGTH": "feature_strength",
    "CONCAVITY": "concavity",
    "DISTANCE": "metric_distance",
    "CRESTS": "ridges_and_valleys",
}
"""The attributes."""

_TAKEN = "The mesh has another attribute '{}': rename or remove it"


def store(
    obj: bpy.types.Object, view: Literal["STRENGTH", "CONCAVITY", "DISTANCE", "CRESTS"], settings: SeamwireSettings
) -> tuple[str, float, float]:
    """Store a view of an object, in Object or Edit Mode, as an attribute of its vertices (float, one for each).

    Vertices that no path leads to have a distance of -1.

    Returns
    -------
    tuple of str, float, float
        The name of the attribute, and its least and largest finite value.

    Raises
    ------
    ValueError
        Where nothing is visible, no vertex is selected to measure from, or the name is taken by something else.
    native.NativeError
        Where there is nothing to compute with.
    """
    core = native.load()
    arrays = edit_mesh.read(obj)
    source = selected_vertex(obj) if view == "DISTANCE" else None
    if view == "DISTANCE" and source is None:
        raise ValueError("Select the vertex that distances are to be measured from")
    options = snapshot(settings, auto=auto_for(obj, arrays))
    request = Request(
        frozenset({view}), options.metric, options.strength, options.clamp, options.shown_metric.lower(), source
    )
    maker = FieldMaker(core, lambda: core.Surface(arrays.points, arrays.triangles, arrays.edges))
    made = getattr(maker.make(request), view.lower())
    values = made.at_vertices(len(arrays.points)) if isinstance(made, Crests) else np.asarray(made)
    some = values[np.isfinite(values)]
    _write(obj, NAMES[view], np.where(np.isfinite(values), values, -1.0))
    return NAMES[view], float(some.min(initial=np.inf)), float(some.max(initial=-np.inf))


def selected_vertex(obj: bpy.types.Object) -> int | None:
    """Return the active vertex of a mesh, or the first selected one, or None.

    Where all are selected, as new meshes are, none was chosen.
    """
    if obj.mode == "EDIT":
        active = edit_mesh.Cage(obj).active_vertex()
        if active is not None:
            return active
        bm = edit_mesh.edit_bmesh(obj.data)
        selected = np.fromiter((v.select for v in bm.verts), dtype=bool, count=len(bm.verts))
    else:
        selected = np.empty(len(obj.data.vertices), dtype=bool)
        obj.data.vertices.foreach_get("select", selected)
    return int(selected.argmax()) if selected.any() and not selected.all() else None


def _is_taken(bm: bmesh.types.BMesh, name: str) -> bool:
    """Whether an attribute of any kind has a name: two of one name are one too many."""
    kinds = ("float", "int", "bool", "float_vector", "float_color", "color", "string")
    return any(
        getattr(items.layers, kind).get(name) is not None
        for items in (bm.verts, bm.edges, bm.faces, bm.loops)
        for kind in kinds
        if hasattr(items.layers, kind)
    )


def _write(obj: bpy.types.Object, name: str, values: NDArray[np.float64]) -> None:
    mesh = obj.data
    if obj.mode == "EDIT":
        bm = edit_mesh.edit_bmesh(mesh)
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
    attribute.data.foreach_set("value", values.astype(np.float32))
    mesh.update()
