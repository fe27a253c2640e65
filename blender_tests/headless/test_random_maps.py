# SPDX-License-Identifier: GPL-3.0-or-later
"""Random polygon meshes are unwrapped and cut by Suggest Seamwires. No map is bad without a warning.

The maps are measured by `maps`, which does not know the add-on. SEAMWIRE_RANDOM_MAPS=2500 takes so many meshes of each kind, and
SEAMWIRE_RANDOM_MAPS=2500:700 begins with number 700. A small sample runs otherwise.
"""

import os
import time
import traceback

import bmesh
import bpy
import pytest
from maps import folded, in_square, overlapping_pairs
from random_meshes import KINDS, add_random
from scene import edit, seams

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
