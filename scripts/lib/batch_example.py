# SPDX-License-Identifier: GPL-3.0-or-later
"""Ten heads of one base, and the base with seams, for docs/batch.md.

``blender --background --python scripts/lib/batch_example.py -- FOLDER``

Needs the add-on, which marks the base; FOLDER/heads has the ten, no two of the same topology, in several formats.
"""

import sys
from math import radians
from pathlib import Path

import addon_utils
import bpy
from mathutils import Matrix

sys.path.insert(0, str(Path(__file__).parents[2] / "batch"))

from seamwire_batch.assets import EXPORTERS

HEADS = {
    "01-as-it-is.obj": (),
    "02-subdivided.blend": (("SUBSURF", {"levels": 1}),),
    "03-twice.blend": (("SUBSURF", {"levels": 2}),),
    "04-edges-only.glb": (("SUBSURF", {"levels": 1, "subdivision_type": "SIMPLE"}),),
    "05-triangles.obj": (("TRIANGULATE", {}),),
    "06-two-thirds.obj": (("SUBSURF", {"levels": 1}), ("DECIMATE", {"ratio": 0.66})),
    "07-a-third.ply": (("SUBSURF", {"levels": 1}), ("DECIMATE", {"ratio": 0.33})),
    "08-moved.blend": (("SUBSURF", {"levels": 1}),),
    "09-slimmer.fbx": (("SUBSURF", {"levels": 1}), ("DECIMATE", {"ratio": 0.8})),
    "10-few-faces.blend": (("DECIMATE", {"ratio": 0.6}),),
}


def head() -> bpy.types.Object:
    """Return Blender's monkey, alone."""
    bpy.data.batch_remove([*bpy.data.objects, *bpy.data.meshes])
    bpy.ops.mesh.primitive_monkey_add()
    return bpy.context.active_object


def main(folder: Path) -> None:
    """Write all."""
    (folder / "heads").mkdir(parents=True, exist_ok=True)
    addon_utils.enable("seamwire", default_set=True)
    head()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.seamwire_suggest(islands=8)
    bpy.ops.object.mode_set(mode="OBJECT")
    EXPORTERS[".blend"](str(folder / "head.blend"))
    for name, modifiers in HEADS.items():
        obj = head()
        for kind, values in modifiers:
            modifier = obj.modifiers.new(kind, kind)
            for key, value in values.items():
                setattr(modifier, key, value)
            bpy.ops.object.modifier_apply(modifier=modifier.name)
        if "moved" in name:
            obj.data.transform(
                Matrix.Translation((3.0, 0.0, 1.0)) @ Matrix.Rotation(radians(35.0), 4, "Z") @ Matrix.Scale(1.5, 4)
            )
        if "slimmer" in name:
            obj.data.transform(Matrix.Diagonal((0.97, 1.0, 1.03, 1.0)))
        EXPORTERS[Path(name).suffix](str(folder / "heads" / name))


main(Path(sys.argv[sys.argv.index("--") + 1]))
