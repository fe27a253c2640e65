# SPDX-License-Identifier: GPL-3.0-or-later
"""What another add-on may use of Seamwire. `seamwire_lab` imports this module and nothing else of it; a test checks this.

- Settings: `settings` returns Blender's properties. `snapshot` makes `Options` of them. `auto_for` returns what *Auto* stands for.
- Meshes: `read` reads the edit mesh, and `read_evaluated` the mesh with its modifiers. Both return `Arrays`. `edit_bmesh` returns the edit
  mesh itself.
- The compiled library: `load` returns its module, or raises ImportError with the reason. `Newest` runs it in a thread. `kinds_of` returns
  the library's metrics that the candidates minimize.
- Layers: `add_layer` draws something below the wires of each edited object. If a layer has its own settings, it calls `tell_listeners`
  after a change.
- Drawing: `Eye`, `Lines`, `ColoredFaces` and what they need, legends, and colors for numbers.
"""

# ruff: noqa: F401 - the names are for another add-on
from __future__ import annotations

from typing import TYPE_CHECKING

from .core.base.mesh_arrays import Arrays
from .core.base.native import load
from .core.base.newest import Newest
from .core.fields.color_maps import ColorMap, colors, steps
from .core.solver.solver import kinds_of
from .mesh.edit_mesh import edit_bmesh, read, read_evaluated
from .mesh.object_session import auto_for
from .mesh.pose import Pose
from .mesh.settings import settings, snapshot, tell_listeners
from .terms.options import Options, strength_name
from .view.edited_objects import edited
from .view.gpu_draw import ColoredFaces, Eye, Lines, Within, blended, draw_over, whole
from .view.layers import Layer, Legend, draw_legends, makers
from .view.overlay import free_room
from .view.theme import Color, Style

if TYPE_CHECKING:
    from .view.layers import LayerMaker


def add_layer(make: LayerMaker) -> None:
    """Draw a layer below the wires of each object that the tool is used on, see `Layer` and `LayerMaker`."""
    makers.append(make)
    edited.make_layers()


def remove_layer(make: LayerMaker) -> None:
    """Draw it no longer."""
    makers.remove(make)
    edited.make_layers()
