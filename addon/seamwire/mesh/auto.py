# SPDX-License-Identifier: GPL-3.0-or-later
"""The values that *Auto* stands for on an object."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.seams import placed_edges
from .edit_mesh import column

if TYPE_CHECKING:
    import bpy

    from ..core.base.mesh_arrays import Arrays
    from ..terms.options import Auto


def auto_for(obj: bpy.types.Object, arrays: Arrays) -> Auto:
    """Return the values that Auto stands for on a mesh object, as it was when its mesh, `arrays`, was read."""
    mesh = obj.data
    rigged = len(obj.vertex_groups) > 0 or mesh.shape_keys is not None
    sharp = column(mesh.edges, "use_edge_sharp", np.bool_)
    marks = (len(mesh.uv_layers) > 0, sharp.any(), mesh.has_custom_normals, len(mesh.materials) > 1)
    return placed_edges.auto_for(arrays.points, arrays.triangles, arrays.polygons, rigged, sum(marks))
