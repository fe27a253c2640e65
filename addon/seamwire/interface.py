# SPDX-License-Identifier: GPL-3.0-or-later
"""What other add-ons may use of Seamwire. Seamwire Lab and Seamwire Networks import nothing else of it; a test checks this.

- Settings: `settings` returns Blender's properties. `snapshot` makes `Options` of them. `auto_for` returns what *Auto* stands for.
- Meshes: `read` reads the edit mesh, and `read_evaluated` the mesh with its modifiers. Both return `Arrays`. `edit_bmesh` returns the edit
  mesh itself.
- The compiled library: `load` returns its module, or raises ImportError with the reason. `Newest` runs it in a thread. `kinds_of` returns
  the library's metrics that the candidates minimize. `LiveMaker` makes live wires.
- Networks: wires, strokes, mirror images, and the records that meshes and files keep of them.
- Operators: `EditMeshOperator` and `Stepwise` are their bases. `join` and `leave` register the parts of another add-on.
- Layers: `add_layer` draws something below the wires of each edited object. If a layer has its own settings, it calls `tell_listeners`
  after a change.
- Drawing: `Eye`, `Lines`, `ColoredFaces` and what they need, legends, and colors for numbers.

A name is imported when it is first used, so Blender's start does not wait for NumPy.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .view.layers import LayerMaker

_NAMES = {
    "core.base.geometry": "area_normals groups nearest_on_segments units",
    "core.base.mesh_arrays": "Arrays",
    "core.base.native": "load",
    "core.base.newest": "Newest",
    "core.network.drawn": "Drawn",
    "core.network.picks": "Edge Pick",
    "core.network.strokes": "Stroke for_library on_mesh",
    "core.network.symmetry": "MirrorImages Symmetry",
    "core.network.wires": "LOOP_KINDS Wire",
    "core.solver.solver": "LiveMaker by_number final kinds_of",
    "core.storage.serialization": "DAMAGED Places Record checked_wire packed stored_stroke stroke_record unpacked wire_of wire_record",
    "mesh.edit_mesh": "Pose edit_bmesh read read_evaluated",
    "mesh.object_session": "ObjectSession auto_for",
    "mesh.registration": "classes menu_entry together",
    "mesh.settings": "settings snapshot tell_listeners",
    "operators.edit_mesh_operator": "EditMeshOperator",
    "operators.steps": "Step Stepwise",
    "terms.choices": "DEFAULT_FINISH METRICS",
    "terms.options": "CLAMP_PERCENTILE Options STRENGTHS strength_name",
    "ui.companions": "join leave",
    "view.gpu_draw": "ColoredFaces Eye Lines Within blended draw_over whole",
    "view.layers": "Layer Legend draw_legends",
    "view.overlay": "free_room",
    "view.theme": "Color ColorMap Style colors steps",
    "words.reports": "count",
}
PLACES = {name: module for module, names in _NAMES.items() for name in names.split()}
"""The module of each name."""


def __getattr__(name: str) -> object:
    if name not in PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".{PLACES[name]}", __package__), name)


def add_layer(make: LayerMaker) -> None:
    """Draw a layer below the wires of each object that the tool is used on, see `Layer` and `LayerMaker`."""
    from .view.edited_objects import edited
    from .view.layers import makers

    makers.append(make)
    edited.make_layers()


def remove_layer(make: LayerMaker) -> None:
    """Draw it no longer."""
    from .view.edited_objects import edited
    from .view.layers import makers

    makers.remove(make)
    edited.make_layers()
