# SPDX-License-Identifier: GPL-3.0-or-later
"""The values that *Auto* stands for on an object."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.seams import placed_edges

if TYPE_CHECKING:
    import bpy

    from ..core.base.mesh_arrays import Arrays
    from ..terms.options import Auto


def auto_for(obj: bpy.types.Object, arrays: Arrays) -> Auto:
    """Return the values that Auto stands for on a mesh object.

    Parameters
    ----------
    obj
        As it was when its mesh was read.
    arrays
        Its mesh.
    """
    others = _other_signs(obj)
    return placed_edges.auto_for(arrays.points, arrays.triangles, arrays.polygons, others)


def _other_signs(obj: bpy.types.Object) -> placed_edges.OtherSigns:
    mesh = obj.data
    sharp = np.empty(len(mesh.edges), dtype=bool)
    mesh.edges.foreach_get("use_edge_sharp", sharp)
    return placed_edges.OtherSigns(
        rigged=len(obj.vertex_groups) > 0 or mesh.shape_keys is not None,
        marks=sum((len(mesh.uv_layers) > 0, sharp.any(), mesh.has_custom_normals, len(mesh.materials) > 1)),
    )
