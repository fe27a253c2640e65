# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of the UV square packers fill with the same islands.

    python native/bench/packing.py FOLDER [--blender PATH]...

FOLDER/NAME.npz has the corners of triangles in the plane, ``uvs`` (m, 3, 2), and the island of each triangle, ``islands`` (m,). The program
prints a row of a Markdown table for each packer:

- pack_islands of the library, with each kind of turns
- the packer of each Blender given, with its ways to turn islands; from 3.6 on with concave shapes
- xatlas with brute force, at the largest scale that fits, if its Python package can be imported

All get the same margin between islands, except Blender before 3.6, whose margin depends on the sizes of the islands. It gets the value .01
there. *Gap* is the least distance between two islands that was found in the maps, in parts of the square.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    Map = tuple[NDArray[np.float64], NDArray[np.int64]]

MARGIN = 1.0 / 256.0
_SIDE = 1024
"""The pixels along a side of xatlas's square."""
_STEP = 0.001
"""The distance between points on outlines from which gaps are measured."""


def read(file: Path) -> Map:
    """Read a map: the corners of triangles, (m, 3, 2), and their islands, (m,)."""
    with np.load(file) as arrays:
        return arrays["uvs"].astype(np.float64), arrays["islands"].astype(np.int64)


def welded(uvs: NDArray[np.float64], islands: NDArray[np.int64]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return the vertices of a map, (n, 2), and its triangles. Corners at one place of one island are one vertex."""
    places = np.round(uvs.reshape(-1, 2) / max(float(np.ptp(uvs)), 1e-300) * 1e7).astype(np.int64)
    keys = np.concatenate([np.repeat(islands, 3)[:, None], places], axis=1)
    _, first, triangles = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    return uvs.reshape(-1, 2)[first], triangles.reshape(-1, 3)


def used_share(uvs: NDArray[np.float64]) -> float:
    """Return the area of the triangles, that is the covered share of the unit square."""
    one, two = uvs[:, 1] - uvs[:, 0], uvs[:, 2] - uvs[:, 0]
    return float(0.5 * np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]).sum())


def least_gap(uvs: NDArray[np.float64], islands: NDArray[np.int64]) -> float:
    """Return the least distance between points on the outlines of two islands."""
    from scipy.spatial import cKDTree

    points, triangles = welded(uvs, islands)
    ends = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)
    _, inverse, counts = np.unique(np.sort(ends, axis=1), axis=0, return_inverse=True, return_counts=True)
    outline = counts[inverse.reshape(-1)] == 1
    begin, end = points[ends[outline]].swapaxes(0, 1)
    steps = np.maximum(1, np.ceil(np.linalg.norm(end - begin, axis=1) / _STEP).astype(np.int64))
    sides = np.repeat(np.arange(len(steps)), steps)
    along = (np.arange(len(sides)) - np.repeat(np.cumsum(steps) - steps, steps)) / steps[sides]
    places = begin[sides] + along[:, None] * (end - begin)[sides]
    labels = np.repeat(islands, 3)[outline][sides]
    return min(
        (
            float(cKDTree(places[labels != island]).query(places[labels == island])[0].min())
            for island in np.unique(labels)
            if (labels != island).any()
        ),
        default=np.inf,
    )


def by_library(uvs: NDArray[np.float64], islands: NDArray[np.int64], turns: str) -> NDArray[np.float64]:
    """Pack by the library."""
    import seamwire_core as sw

    placements = sw.pack_islands(uvs, islands.astype(np.int32), margin=MARGIN, turns=turns).placements[islands]
    return np.einsum("mij,mkj->mki", placements[:, :, :2], uvs) + placements[:, None, :, 2]


def by_xatlas(uvs: NDArray[np.float64], islands: NDArray[np.int64]) -> NDArray[np.float64]:
    """Pack by xatlas, at the largest scale at which the atlas fits into the square."""
    import xatlas

    points, triangles = welded(uvs, islands)
    points = (points / np.ptp(points) * _SIDE).astype(np.float32)
    options = xatlas.PackOptions()
    options.padding = round(MARGIN * _SIDE / 2)
    options.bruteForce = True
    options.bilinear = False
    low, high, best = 0.0, 2.0, None
    while high - low > 0.005 * high:
        options.texels_per_unit = 0.5 * (low + high)
        atlas = xatlas.Atlas()
        atlas.add_uv_mesh(points, triangles.astype(np.uint32), islands.astype(np.uint32)[:, None])
        atlas.generate(xatlas.ChartOptions(), options)
        if max(atlas.width, atlas.height) <= _SIDE:
            low, best = options.texels_per_unit, atlas
        else:
            high = options.texels_per_unit
    _, corners, placed = best[0]
    return (placed * [best.width, best.height] / _SIDE)[corners.reshape(-1, 3)].astype(np.float64)


def by_blender(program: Path, files: list[Path]) -> Iterator[tuple[str, list[NDArray[np.float64]], list[float]]]:
    """Pack all maps by a Blender; yield for each way to turn islands its name, the maps and the seconds."""
    with tempfile.TemporaryDirectory() as folder:
        command = [str(program), "--background", "--factory-startup", "--python", __file__, "--", folder]
        subprocess.run([*command, *map(str, files)], check=True, stdout=subprocess.DEVNULL)
        for way in sorted(Path(folder).iterdir()):
            results = [np.load(way / file.name) for file in files]
            yield f"Blender {way.name}", [each["uvs"] for each in results], [float(each["seconds"]) for each in results]


def in_blender(folder: Path, files: list[Path]) -> None:
    """Pack maps by this Blender, in each of its ways to turn islands. Write them to folders named after the version and the way."""
    import bpy

    is_old = bpy.app.version < (3, 6)
    if is_old:
        ways = {"no turns": {"rotate": False}, "turns": {"rotate": True}}
    else:
        ways = {"no turns": {"rotate": False}}
        ways |= {name: {"rotate": True, "rotate_method": name.upper()} for name in ("cardinal", "any")}
    for file in files:
        uvs, islands = read(file)
        points, triangles = welded(uvs, islands)
        for name, options in ways.items():
            for mesh in list(bpy.data.meshes):
                bpy.data.meshes.remove(mesh)
            mesh = bpy.data.meshes.new("map")
            # Islands that touch in the plane stay apart.
            heights = np.zeros(len(points))
            heights[triangles] = islands[:, None]
            mesh.from_pydata(np.column_stack([points, heights]).tolist(), [], triangles.tolist())
            layer = mesh.uv_layers.new()
            corners = triangles.reshape(-1)
            layer.data.foreach_set("uv", points[corners].astype(np.float32).ravel())
            obj = bpy.data.objects.new("map", mesh)
            bpy.context.collection.objects.link(obj)
            bpy.context.view_layer.objects.active = obj
            bpy.ops.object.mode_set(mode="EDIT")
            bpy.ops.mesh.select_all(action="SELECT")
            bpy.context.tool_settings.use_uv_select_sync = True
            # Newer versions keep the margin around each island.
            margin = {"margin": 0.01} if is_old else {"margin": MARGIN / 2, "margin_method": "FRACTION"}
            shape = {} if is_old else {"shape_method": "CONCAVE"}
            began = time.perf_counter()
            bpy.ops.uv.pack_islands(**options, **margin, **shape)
            seconds = time.perf_counter() - began
            bpy.ops.object.mode_set(mode="OBJECT")
            packed = np.zeros(2 * len(corners), dtype=np.float32)
            mesh.uv_layers.active.data.foreach_get("uv", packed)
            target = folder / f"{'.'.join(map(str, bpy.app.version[:2]))}, {name}" / file.name
            target.parent.mkdir(exist_ok=True)
            np.savez(target, uvs=packed.reshape(-1, 3, 2).astype(np.float64), seconds=seconds)


def row(name: str, packed: list[NDArray[np.float64]], islands: list[NDArray[np.int64]], seconds: list[float]) -> str:
    """Return a row of the table."""
    used = [used_share(uvs) for uvs in packed]
    gap = min(map(least_gap, packed, islands))
    low, high = min(float(uvs.min()) for uvs in packed), max(float(uvs.max()) for uvs in packed)
    inside = "yes" if low >= 0.0 and high <= 1.0 else "no"
    cells = [f"{np.median(used):.3f}", f"{min(used):.3f}", f"{gap:.4f}", inside]
    return f"| {' | '.join([name, *cells, f'{np.median(seconds):.3f}', f'{max(seconds):.2f}'])} |"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--blender", type=Path, action="append", default=[])
    arguments = parser.parse_args()
    files = sorted(arguments.folder.glob("*.npz"))
    maps = [read(file) for file in files]
    print("| packer | used, median | least | gap | in the square | s, median | most |")
    print("| --- | --- | --- | --- | --- | --- | --- |")

    packers = {
        f"ours, {turns}": lambda *map_, turns=turns: by_library(*map_, turns) for turns in ("none", "quarters", "any")
    }
    try:
        import xatlas  # noqa: F401 - only asked for

        packers["xatlas, brute force"] = by_xatlas
    except ImportError:
        pass
    islands = [labels for _, labels in maps]
    for name, pack in packers.items():
        packed, seconds = [], []
        for uvs, labels in maps:
            began = time.perf_counter()
            packed.append(pack(uvs, labels))
            seconds.append(time.perf_counter() - began)
        print(row(name, packed, islands, seconds), flush=True)
    for program in arguments.blender:
        for name, packed, seconds in by_blender(program, files):
            print(row(name, packed, islands, seconds), flush=True)


if __name__ == "__main__":
    if "bpy" in sys.modules:
        folder, *given = sys.argv[sys.argv.index("--") + 1 :]
        in_blender(Path(folder), [Path(file) for file in given])
    else:
        main()
