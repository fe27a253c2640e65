# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams of one model by each method of the benchmark of parts.

Every function returns `Seams`. `cached` keeps them in a folder, because some methods take minutes.
"""

from __future__ import annotations

import importlib.util
import json
import sys
import time
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import seamwire_core as sw
from seam_measures import CRUMB
from seam_planning import cut_edges, triangulated
from uv_maps import Model, UvMap, triangle_areas
from uv_pictures import arranged

sys.path.insert(0, str(Path(__file__).parents[2] / "addon"))
from seamwire.core.network.symmetry import Symmetry  # this knows no Blender

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray
    from seam_measures import SeamMesh

    Floats = NDArray[np.float64]
    Integers = NDArray[np.int64]

_SAME = 1e-6
_FLAT = 2.0
"""Degrees between triangles of a flat face."""
_STRENGTH = 10.0
"""The add-on's strength for wires along edges."""
_AXES = (0, 2, 1)
"""Mirror axes in the order in which the add-on tries them. Its y is the file's z."""


@dataclass(frozen=True)
class Seams:
    """Seams of a model.

    Attributes
    ----------
    pairs
        (k, 2) edges as vertex pairs.
    info
        Facts about the run: seconds to the end (``sec``) and to the first picture (``first``).
    uv_map
        The map of the method itself. None: the benchmark flattens the seams.
    of_triangles
        Whether seams may run along the diagonals of polygons.
    is_cut
        Whether the method cut faces. The seams then lie on the triangles of its map, which have more points than the model.
    """

    pairs: Integers
    info: dict[str, Any] = field(default_factory=dict)
    uv_map: UvMap | None = None
    of_triangles: bool = False
    is_cut: bool = False


def cached(file: Path, find: Callable[[], Seams]) -> Seams:
    """Return the seams in a file, or find and write them."""
    if file.is_file():
        with np.load(file) as arrays:
            info = json.loads(str(arrays["info"]))
            return Seams(arrays["pairs"].astype(np.int64), info, of_triangles=info.get("of_triangles", False))
    began = time.perf_counter()
    seams = find()
    info = {"sec": time.perf_counter() - began, "of_triangles": seams.of_triangles} | seams.info
    file.parent.mkdir(parents=True, exist_ok=True)
    np.savez_compressed(file, pairs=seams.pairs, info=json.dumps(info))
    return replace(seams, info=info, uv_map=None)


def ours(model: Model, amount: float) -> Seams:
    """Return the seams that *Suggest Seamwires* finds along edges: parts first, then slits inside of them."""
    began = time.perf_counter()
    symmetric = Symmetry(model.points, model.edges.astype(np.int32)).symmetric_axes
    mirror = next((axis for axis in _AXES if axis in symmetric), None)
    surface = sw.Surface(model.points, triangulated(model).astype(np.int32), model.edges.astype(np.int32))
    borders = np.zeros((0, 2), dtype=np.int64)
    if hasattr(sw, "PartFinder"):
        chains = sw.PartFinder(surface, by="shape", mirror=mirror).find(amount).borders
        borders = np.concatenate([borders, *(pairs_of(np.asarray(chain)) for chain in chains)])
    first = time.perf_counter() - began
    planner = sw.SeamPlanner(
        surface,
        along="edges",
        max_anisotropy=_STRENGTH,
        front=model.frame.axes[2],
        mirror=mirror,
        seams=borders.astype(np.int32),
    )
    plan = planner.plan()
    pairs = np.unique(np.concatenate([np.sort(borders, axis=1), cut_edges(plan)]), axis=0)
    return Seams(pairs, {"first": first, "sec": time.perf_counter() - began, "is_reached": bool(plan.is_reached)})


def pairs_of(chain: Integers) -> Integers:
    """Return the edges (k, 2) of a chain of vertices."""
    return np.stack([chain[:-1], chain[1:]], axis=1).astype(np.int64)


def from_blender(model: Model, file: Path) -> Seams:
    """Read the map that *Suggest Seamwires* made in Blender by default, as addon/bench/blender_maps.py writes it."""
    uv_map = UvMap.read(file)
    # Cutting faces only adds points within the box.
    uv_map = replace(uv_map, points=centered(uv_map.points))
    info = uv_map.info | {"is_packed": True}
    return Seams(uv_map.seams, info, uv_map, is_cut=len(uv_map.points) != len(model.points))


def centered(points: Floats) -> Floats:
    """Move points (n, 3) to the origin, and scale them so that the longest side of their box is 2."""
    low, high = points.min(axis=0), points.max(axis=0)
    return (points - (low + high) / 2) * 2 / (high - low).max()


def sharp(mesh: SeamMesh, angle: float) -> Seams:
    """Return all edges sharper than an angle in degrees."""
    return Seams(mesh.edges[mesh.angles > angle])


def uvgami(model: Model, folder: Path) -> Seams:
    """Return the seams of UVgami in hard-surface mode; the folder has its sources, with ``src/seams``."""
    if "seams" not in sys.modules:
        package = folder / "src/seams"
        spec = importlib.util.spec_from_file_location(
            "seams", package / "__init__.py", submodule_search_locations=[str(package)]
        )
        assert spec is not None
        assert spec.loader is not None
        sys.modules["seams"] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(sys.modules["seams"])
    polygons = [part.tolist() for part in np.split(model.corners, model.start[1:-1])]
    found = sys.modules["seams"].seam_edges(model.points.tolist(), polygons)
    return Seams(np.array(sorted(found), dtype=np.int64).reshape(-1, 2))


def has_xatlas() -> bool:
    """Return whether the Python package of xatlas is installed."""
    return importlib.util.find_spec("xatlas") is not None


def xatlas(model: Model) -> Seams:
    """Return the seams of xatlas with its defaults, from the Python package."""
    import xatlas as package

    triangles = triangulated(model)
    vertices, corners, uvs = package.parametrize(model.points.astype(np.float32), triangles.astype(np.uint32))
    mapped = vertices[corners].astype(np.int64)
    if not np.array_equal(mapped, triangles):
        raise ValueError("xatlas changed the triangles")
    uv_map = UvMap(model.points, triangles, uvs[corners].astype(np.float64))
    return Seams(uv_map.seams, {"is_packed": True}, of_triangles=True)


def flattened(model: Model, seams: Seams) -> tuple[UvMap, Integers]:
    """Return the map of a model that is cut along seams, with islands side by side, and the island of each triangle.

    Raises ValueError if an island cannot be mapped.
    """
    triangles = triangulated(model)
    edges = None if seams.of_triangles else model.edges.astype(np.int32)
    flat = sw.flatten(model.points, triangles.astype(np.int32), seams.pairs.astype(np.int32), edges=edges)
    return arranged(UvMap(model.points, triangles, flat.uvs)), np.asarray(flat.islands, dtype=np.int64)


def map_measures(model: Model, seams: Seams) -> dict[str, float | None]:
    """Return the energy of the map of seams, how many islands overlap, triangles are flipped and UVs lie outside, and the used share.

    A map that does not exist has no numbers. Only packed maps can lie outside the tile, and use a share of it.
    """
    try:
        uv_map, islands = (seams.uv_map, None) if seams.uv_map else flattened(model, seams)
        report = sw.measure_map(
            uv_map.points,
            uv_map.triangles.astype(np.int32),
            uv_map.uvs,
            islands,
            edges=None if seams.of_triangles else model.edges.astype(np.int32),
        )
    except ValueError as error:
        print(f"{model.name}: no map: {error}", file=sys.stderr)
        return {"energy": None, "overlapping": None, "flips": None, "outside": None, "used": None}
    is_out = (uv_map.uvs < -_SAME) | (uv_map.uvs > 1 + _SAME)
    return {
        "energy": float(report.energy),
        "overlapping": len(report.overlapping) + (len(report.colliding) if seams.uv_map else 0),
        "flips": len(report.flipped),
        "outside": int(is_out.any(axis=(1, 2)).sum()) if seams.uv_map else None,
        "used": used_share(uv_map) if seams.uv_map else None,
    }


def scan_measures(uv_map: UvMap) -> dict[str, float]:
    """Return the islands of a packed map, its crumbs, its used share, the share of slits in flat faces, and its milliseconds a triangle."""
    areas = triangle_areas(uv_map.points, uv_map.triangles)
    of_island = np.bincount(uv_map.islands, areas)
    inner = uv_map.inner_edges
    corners = uv_map.points[uv_map.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), np.finfo(float).tiny)[:, None]
    cosines = (normals[inner.faces[:, 0]] * normals[inner.faces[:, 1]]).sum(axis=1)
    bends = np.zeros(len(areas))
    for side in inner.faces.T:
        np.maximum.at(bends, side, np.degrees(np.arccos(np.clip(cosines, -1, 1))))
    is_slit = inner.torn & (np.diff(uv_map.islands[inner.faces], axis=1)[:, 0] == 0)
    is_flat = is_slit & (bends[inner.faces].max(axis=1) < _FLAT)
    lengths = np.linalg.norm(np.diff(uv_map.points[inner.vertices], axis=1)[:, 0], axis=1)
    return {
        "triangles": len(areas),
        "islands": len(of_island),
        "crumbs": int((of_island < CRUMB * areas.sum()).sum()),
        "used": used_share(uv_map),
        "flat": float(lengths[is_flat].sum() / max(lengths[is_slit].sum(), np.finfo(float).tiny)),
        "ms": 1e3 * uv_map.info["cpu"] / len(areas),
    }


def used_share(uv_map: UvMap) -> float:
    """Return the area of a packed map, as a share of the UV square."""
    one, other = (uv_map.uvs[:, k] - uv_map.uvs[:, 0] for k in (1, 2))
    return float(np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]).sum() / 2)
