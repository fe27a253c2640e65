# SPDX-License-Identifier: GPL-3.0-or-later
"""Times of measuring a UV map's stretch, in Blender: ``scripts/bench-blender --stretch`` runs this.

A grid of 99,856 quads; milliseconds, medians of five runs.
"""

import statistics
import time
from collections.abc import Callable

import addon_utils
import bpy
import numpy as np

SIDE = 316
REPEATS = 5


def main() -> None:
    """Measure and print."""
    from seamwire.core.islands.uv_maps import Stretch
    from seamwire.mesh import edit_mesh, unwrap, uv_islands

    bpy.ops.mesh.primitive_grid_add(x_subdivisions=SIDE, y_subdivisions=SIDE)
    obj = bpy.context.active_object
    bpy.ops.object.mode_set(mode="EDIT")
    arrays = edit_mesh.read(obj)
    labels = (arrays.polygons * 50 // len(arrays.triangles)).astype(np.int32)  # bands of faces for islands

    def show(what: str, work: Callable[[], object]) -> None:
        times = []
        for _ in range(REPEATS):
            begun = time.perf_counter()
            work()
            times.append(1e3 * (time.perf_counter() - begun))
        print(f"    {what:45s} {statistics.median(times):7.1f} ms", flush=True)

    def fixed() -> Stretch:
        corners, _ = uv_islands.read_map(obj)
        return Stretch(arrays.points, arrays.triangles, arrays.polygons, corners.of_triangles(arrays))

    stretch, uvs = fixed(), uv_islands.read_uvs(obj)
    rng = np.random.default_rng(0)

    def all_anew() -> None:
        stretch.update(uvs * np.float32(rng.uniform(0.5, 2.0)))

    show("what of the mesh stays: corners and lengths", fixed)
    show("Blender's UV map read in edit mode", lambda: uv_islands.read_uvs(obj))
    show("the stretch of all faces", all_anew)
    show("its means by islands", lambda: stretch.islands(labels, "ANGLE"))
    show("the islands that have changed are found", lambda: unwrap._Map(obj, every=False, by_library=True))


if __name__ == "__main__":
    addon_utils.enable("seamwire", default_set=True)
    main()
