# SPDX-License-Identifier: GPL-3.0-or-later
"""Random polygon meshes are flattened, unwrapped and cut by Suggest Seamwires. No map is bad without a warning.

The maps are measured by `maps`, which does not know the add-on. SEAMWIRE_RANDOM_MAPS=2500 takes so many meshes of each kind, and
SEAMWIRE_RANDOM_MAPS=2500:700 begins with number 700. A small sample runs otherwise.
"""

import os
import time
import traceback

import bmesh
import bpy
import numpy as np
import pytest
from maps import areas, folded, folds, in_square, overlapping_pairs, overlaps
from random_meshes import KINDS, add_random
from scene import edit, seams
from seamwire.core.base import native
from seamwire.core.base.mesh_arrays import Arrays
from seamwire.mesh import edit_mesh

COUNT, _, FIRST = os.environ.get("SEAMWIRE_RANDOM_MAPS", "4").partition(":")
NUMBERS = range(int(FIRST or 0), int(FIRST or 0) + int(COUNT))
FOUND = {"slivers": (538, 1870)}
"""Meshes on which the add-on or the measures failed. They always run."""
_DEEP = 2e-6
"""The library calls it touching if islands reach into each other by less than a millionth of the map's size."""
SECONDS = 60.0
"""No mesh may take longer, in time of the processor: all have less than a few thousand faces."""


TOLD = {"folds": ("turned over", "overlap"), "overlap": ("overlap",), "outside": ("outside the UV square",)}
"""The words of which a report on each problem has at least one."""


def problems_of(obj: bpy.types.Object) -> list[str]:
    """Return what is wrong with the active UV map of an edit mesh, by the keys of `TOLD`."""
    found = {"folds": folded(obj), "overlap": overlapping_pairs(obj, deep=_DEEP), "outside": not in_square(obj)}
    return [name for name, is_wrong in found.items() if is_wrong]


def is_told(problem: str, said: str) -> bool:
    """Whether a report tells of a problem."""
    said = said.replace("no overlap", "")
    return any(words in said for words in TOLD[problem])


def _has_doubtful_diagonal(arrays: Arrays) -> bool:
    """Whether a diagonal inside a polygon joins the same two vertices as an edge: the library takes it for that edge."""
    sides = np.sort(arrays.triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=2).reshape(-1, 2)
    inside, counts = np.unique(np.column_stack([np.repeat(arrays.polygons, 3), sides]), axis=0, return_counts=True)
    diagonals = {tuple(ends) for ends in inside[counts == 2, 1:].tolist()}
    return not diagonals.isdisjoint(tuple(ends) for ends in np.sort(arrays.edges, axis=1).tolist())


def flattened_badly(obj: bpy.types.Object) -> list[str]:
    """Return what is wrong with the library's map of an edit mesh: corners of polygons that are torn, folds, and untold overlaps."""
    arrays = edit_mesh.read(obj)
    if _has_doubtful_diagonal(arrays):
        return []
    core = native.load()
    try:
        flat = core.flatten(arrays.in_object, arrays.triangles, arrays.seams, edges=arrays.edges)
    except ValueError:  # it says what cannot be mapped
        return []
    uvs = np.asarray(flat.uvs).reshape(-1, 2)
    keys = np.stack([np.repeat(arrays.polygons, 3), arrays.triangles.ravel()], axis=1)
    _, corner = np.unique(keys, axis=0, return_inverse=True)
    low, high = np.full((corner.max() + 1, 2), np.inf), np.full((corner.max() + 1, 2), -np.inf)
    np.minimum.at(low, corner.ravel(), uvs)
    np.maximum.at(high, corner.ravel(), uvs)
    torn = int(((high - low) > 0.0).any(axis=1).sum())
    found = [f"{torn} corners of polygons have two places"] if torn else []
    told = set(flat.overlapping.tolist())
    # The library leaves out triangles without an area, and those that repeat another one.
    corners = arrays.in_object[arrays.triangles]
    is_mapped = np.zeros(len(corners), dtype=bool)
    is_mapped[np.unique(np.sort(arrays.triangles, axis=1), axis=0, return_index=True)[1]] = True
    is_mapped &= areas(corners) > 0.0
    for number in range(len(flat.island_areas)):
        own = np.flatnonzero((flat.islands == number) & is_mapped)
        if not len(own):
            continue
        placed = uvs.reshape(-1, 3, 2)[own]
        placed = (placed - placed.min(axis=(0, 1))) / max(float(np.ptp(placed, axis=(0, 1)).max()), 1e-300)
        if bent := folds(arrays.triangles[own], placed, corners[own]):
            found.append(f"{bent} folds in island {number}")
        elif number not in told and overlaps(placed, _DEEP):
            found.append(f"island {number} overlaps without a word")
    return found


def run(operator: object, capfd: pytest.CaptureFixture[str], **options: object) -> tuple[bool, str]:
    """Call an operator. Return whether it warned or refused, and what it printed."""
    capfd.readouterr()
    try:
        operator(**options)
    except RuntimeError as error:
        return True, str(error)
    said = capfd.readouterr().out
    return "Warning" in said, said


@pytest.mark.parametrize("kind", KINDS)
def test_no_map_of_a_random_mesh_is_bad_without_a_warning(kind: str, capfd: pytest.CaptureFixture[str]) -> None:
    failures = []
    counts = {"meshes": 0, "warned": 0}
    for number in (*FOUND.get(kind, ()), *NUMBERS):
        started = time.process_time()
        try:
            failures += [f"{number}: {each}" for each in _play(kind, number, capfd, counts)]
        except Exception:
            failures.append(f"{number}: {traceback.format_exc(limit=-2)}")
        taken = time.process_time() - started
        if taken > SECONDS:
            failures.append(f"{number}: {taken:.0f} s")
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.data.batch_remove([*bpy.data.objects, *bpy.data.meshes])
    with capfd.disabled():
        print(f"{kind}: {counts}, {len(failures)} failures", flush=True)
    assert not failures, "\n".join([f"{len(failures)} of {len(NUMBERS)}", *failures[:40]])


def _play(kind: str, number: int, capfd: pytest.CaptureFixture[str], counts: dict[str, int]) -> list[str]:
    failures = []
    counts["meshes"] += 1
    obj = add_random(kind, number)
    edit()
    if not len(bmesh.from_edit_mesh(obj.data).faces):
        return []
    failures += [f"flatten: {each}" for each in flattened_badly(obj)]
    before = seams(obj)
    for name, operator in (("unwrap", bpy.ops.mesh.seamwire_unwrap), ("suggest", bpy.ops.mesh.seamwire_suggest)):
        warned, said = run(operator, capfd)
        counts["warned"] += warned
        if name == "unwrap" and seams(obj) != before:
            failures.append("unwrap: the seams changed")
        wrong = problems_of(obj) if obj.data.uv_layers else []
        if untold := [problem for problem in wrong if not (warned and is_told(problem, said))]:
            failures.append(f"{name}: {', '.join(untold)}, but the report says: {said.strip()}")
        if wrong:  # an operator says nothing of islands that were bad before and that it keeps
            obj.data.uv_layers.remove(obj.data.uv_layers.active)
    return failures
