# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams of artists, transferred to the same models with another topology: ``scripts/bench MODELS SEAMS transfer`` runs this in Blender.

Each model of the folder, as ``native/bench/seam_clicks.py`` expects it, gets its seams as a network. The network goes to variants of the
model: decimated to a half and to a quarter of its triangles, remeshed with voxels, and subdivided. The first variant is also tried
moved, rotated and scaled, and bent by a sixth of a circle, with eight pairs of vertices.

Each line has four numbers. The first is the share of marked edges whose middles lie within one edge of the artist's seams. The second is
the share of the artist's edges within one edge of the marked ones. Then come the number of wires without a place, and the seconds.
"One edge" is the longer of the target's edge there and the artist's mean edge.
"""

import itertools
import sys
import time
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

CHANGES = ("half", "quarter", "voxels", "subdivided", "half, moved", "half, bent")
PAIRS = 8
BEND = np.pi / 3.0


def add(path: Path) -> tuple[bpy.types.Object, list[tuple[int, int]]]:
    """Add a model; return it and its seams."""
    with np.load(path) as data:
        points, corners, offsets, seams = (data[name] for name in ("points", "corners", "offsets", "seams"))
    faces = [corners[a:b].tolist() for a, b in itertools.pairwise(offsets)]
    mesh = bpy.data.meshes.new(path.stem)
    mesh.from_pydata(points.tolist(), [], faces)
    obj = bpy.data.objects.new(path.stem, mesh)
    bpy.context.collection.objects.link(obj)
    wanted = {(min(pair), max(pair)) for pair in seams.tolist()}
    for edge in mesh.edges:
        edge.use_seam = tuple(sorted(edge.vertices)) in wanted
    return obj, sorted(wanted)


def changed(source: bpy.types.Object, change: str) -> bpy.types.Object:
    """Return a copy without seams and with another topology."""
    obj = bpy.data.objects.new(change, source.data.copy())
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.data.edges.foreach_set("use_seam", np.zeros(len(obj.data.edges), dtype=bool))
    if change == "subdivided":
        modifier = obj.modifiers.new("change", "SUBSURF")
        modifier.levels, modifier.subdivision_type = 1, "SIMPLE"
    elif change == "voxels":
        modifier = obj.modifiers.new("change", "REMESH")
        modifier.mode, modifier.voxel_size = "VOXEL", max(obj.dimensions) / 120.0
    else:
        modifier = obj.modifiers.new("change", "DECIMATE")
        modifier.ratio = 0.25 if change == "quarter" else 0.5
    with bpy.context.temp_override(object=obj, active_object=obj):
        bpy.ops.object.modifier_apply(modifier=modifier.name)
    if change.endswith("moved"):
        turn = Matrix.Rotation(0.7, 4, (1.0, 2.0, 3.0))
        obj.data.transform(Matrix.Translation((7.0, -3.0, 1.0)) @ turn @ Matrix.Scale(1.7, 4))
    return obj


def bent(places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return places bent along the longest of the axes' directions, by `BEND` over the whole length."""
    sizes = np.ptp(places, axis=0)
    along, up = np.argsort(-sizes)[:2]
    middle = 0.5 * (places.min(axis=0) + places.max(axis=0))
    radius = sizes[along] / BEND
    angle, height = (places[:, along] - middle[along]) / radius, radius - (places[:, up] - middle[up])
    result = places.copy()
    result[:, along], result[:, up] = height * np.sin(angle), radius - height * np.cos(angle)
    return result


def spread_pairs(
    source: NDArray[np.float64], target: NDArray[np.float64], used: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Return pairs of vertices far from each other that are at about the same place, (PAIRS, 2)."""
    chosen = [int(used[np.linalg.norm(target[used] - target[used].mean(axis=0), axis=1).argmax()])]
    while len(chosen) < PAIRS:
        gaps = np.linalg.norm(target[used][:, None] - target[chosen][None], axis=2).min(axis=1)
        chosen.append(int(used[gaps.argmax()]))
    return np.array([(np.linalg.norm(source - target[one], axis=1).argmin(), one) for one in chosen])


def near(places: NDArray, starts: NDArray, ends: NDArray, reach: NDArray) -> float:
    """Return the share of places that are within reach of some segments."""
    from seamwire.core.base.geometry import nearest_on_segments

    if not len(places) or not len(starts):
        return 0.0
    gaps = np.array([nearest_on_segments(place, starts, ends)[1].min() for place in places])
    return float((gaps <= reach).mean())


def measure(path: Path) -> None:
    """Print a line for each change."""
    from seamwire.mesh.object_session import ObjectSession
    from seamwire.mesh.settings import settings
    from seamwire_networks.carry import network_of, seam_wires, shape_of
    from seamwire_networks.placing import Shape
    from seamwire_networks.transfer import transfer

    source, wanted = add(path)
    drawn = ObjectSession(source)
    file = network_of(drawn, settings(), seam_wires(drawn))
    own = shape_of(drawn)
    artist = drawn.arrays.points[np.array(wanted)]
    for change in CHANGES:
        target = changed(source, change)
        if not len(target.data.polygons):
            continue
        shape = shape_of(ObjectSession(target))
        pairs: NDArray | tuple = ()
        if change.endswith("bent"):
            straight = shape.places
            pairs = spread_pairs(drawn.arrays.points, straight, np.unique(shape.triangles))
            shape = Shape(bent(straight), shape.triangles, shape.edges)
        began = time.perf_counter()
        place = "PAIRS" if len(pairs) else "SURFACE"
        found = transfer(file, shape, place=place, source=own, pairs=pairs)
        seconds = time.perf_counter() - began
        marked = found.seams
        places = shape.places
        if change.endswith("moved"):
            back = np.array(Matrix.Rotation(-0.7, 3, (1.0, 2.0, 3.0)))
            places = (places - (7.0, -3.0, 1.0)) @ back.T / 1.7
        if len(pairs):
            places = straight
        edges = places[marked]
        edge = shape.spacing[marked].mean(axis=1) / (1.7 if change.endswith("moved") else 1.0)
        middles = artist.mean(axis=1)
        edge = np.maximum(edge, np.linalg.norm(artist[:, 0] - artist[:, 1], axis=1).mean())
        within = near(edges.mean(axis=1), artist[:, 0], artist[:, 1], edge)
        reached = near(middles, edges[:, 0], edges[:, 1], np.full(len(middles), edge.mean() if len(edge) else 0.0))
        wires = len(file.courses)
        print(
            f"   {path.stem[:30]:30} {change:12} {len(shape.triangles):7} triangles, {within:6.1%} within, {reached:6.1%} reached, "
            f"{len(found.lost):3} of {wires:3} lost, {found.added:4} seeds added, {seconds:6.2f} s"
        )
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)


if __name__ == "__main__":
    import addon_utils

    addon_utils.enable("seamwire", default_set=True)
    for name in sys.argv[sys.argv.index("--") + 1 :]:
        measure(Path(name))
