# SPDX-License-Identifier: GPL-3.0-or-later
"""What `seamwire.mark` takes beside chains: strips, and strokes that lead its wires."""

import bpy
import pytest
import seamwire
from scene import (
    GATE_RIDGE,
    GATE_SEEDS,
    GATE_STRAIGHT,
    add_gate,
    add_grid,
    add_object,
    chain,
    edit,
    ends,
    mark_wires,
    seams,
)
from seamwire.mesh.object_session import ObjectSession


@pytest.fixture
def grid() -> bpy.types.Object:
    """A grid in edit mode; vertex y * 9 + x is column x of row y."""
    obj = add_grid(9)
    edit()
    return obj


def mark(**options: object) -> set[str]:
    return mark_wires(**options)


def test_strips_are_taken_too(grid: bpy.types.Object) -> None:
    assert mark(loops="40-41", take="STRIP")
    assert seams(grid) == chain(*range(36, 45))
    assert mark(loops="13-22", take="STRIP")
    assert seams(grid) == sorted(chain(*range(36, 45)) + chain(4, 13, 22, 31, 40)), "up to the seam"
    assert mark(loops="13-22", take="WHOLE")
    assert seams(grid) == sorted(chain(*range(36, 45)) + chain(*range(4, 81, 9))), "across the seam"


def test_what_is_the_same_as_something_else_is_taken_all_the_same() -> None:
    bpy.ops.mesh.primitive_cylinder_add(vertices=8, end_fill_type="NOTHING")
    edit()
    obj = bpy.context.active_object
    ring = [(0, 2), (2, 4), (4, 6), (6, 8), (8, 10), (10, 12), (12, 14), (0, 14)]
    for take in ("FIRST", "CLOSED", "STRIP", "WHOLE"):
        assert mark(loops="0-2", take=take, clear=False)
        assert seams(obj) == sorted(ring), take
        mark(loops="0-2", take=take, clear=True)
        assert seams(obj) == []


def test_the_border_of_a_part_is_taken() -> None:
    bpy.ops.mesh.primitive_cube_add()
    edit()
    bpy.ops.mesh.subdivide(number_cuts=2)
    obj = bpy.context.active_object
    obj.update_from_editmode()
    top = [edge.vertices[:] for edge in obj.data.edges if all(obj.data.vertices[v].co.z > 0.99 for v in edge.vertices)]
    around = sorted(
        tuple(sorted(pair)) for pair in top if all(max(map(abs, obj.data.vertices[v].co[:2])) > 0.99 for v in pair)
    )
    assert len(around) == 12
    first, second = around[0]
    assert mark(loops=f"{first}-{second}", take="FLAT")
    marked = seams(obj)
    assert len(marked) == 12, "one of the two faces beside the edge"
    assert (first, second) in marked
    with pytest.raises(ValueError, match="No border of part runs through edge"):
        mark(loops=next(f"{a}-{b}" for a, b in map(sorted, top) if (a, b) not in around), take="FLAT")


def test_what_there_is_not_is_said() -> None:
    obj = add_object([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [], [(0, 1), (1, 2)])
    obj.data.edges[0].use_seam = True
    edit()
    with pytest.raises(ValueError, match="No closed loop runs through edge 0-1"):
        mark(loops="0-1", take="CLOSED")


def test_strokes_lead_wires() -> None:
    # Up from the left seed, across, and down to the right one: row 15 to row 23 of a finer grid.
    grid = add_grid(31)
    edit()
    left, right = 15 * 31 + 5, 15 * 31 + 25
    gate = [*range(left, 23 * 31 + 5, 31), *range(23 * 31 + 5, 23 * 31 + 25), *range(23 * 31 + 25, right - 1, -31)]
    assert mark(chains=f"{left} {right}", strokes=" ".join(map(str, gate)))
    assert seams(grid) == chain(*gate), "it runs where the stroke does"
    mark(chains=f"{left} {right}", strokes=" ".join(map(str, gate)), clear=True)
    assert seams(grid) == []
    assert mark(chains=f"{left} {right}")
    assert seams(grid) == chain(*gate), "the stroke stays with the mesh"
    bpy.ops.object.mode_set(mode="OBJECT")
    grid.select_set(False)
    other = add_grid(31)
    edit()
    assert mark(chains=f"{left} {right}")
    assert seams(other) == chain(*range(left, right + 1)), "and leads nothing on another one"


def test_strokes_stay_when_the_wires_are_cut() -> None:
    obj = add_grid(9)
    edit()
    seamwire.mark(obj, [[1, 79]], strokes=[[2, 11, 20]], avoid=[[40, 41]], along="SURFACE", finish="CUT")
    kept = ObjectSession(obj)
    assert [stroke.attracts for stroke in kept.session.network.strokes] == [True, False]
    assert len(kept.arrays.points) > 81
    assert ends(seams(obj)) == [1, 79]


def test_wires_keep_off_strokes_that_repel(grid: bpy.types.Object) -> None:
    assert mark(chains="36 44", strokes="~37 43")
    kept_off = seams(grid)
    assert ends(kept_off) == [36, 44]
    assert len(set(kept_off) & set(chain(*range(36, 45)))) < 4


@pytest.mark.parametrize(
    ("options", "course"),
    [
        ({}, GATE_RIDGE),
        ({"strength": 100.0}, GATE_RIDGE),
        ({"strength": 1.0}, GATE_STRAIGHT),
        ({"metric": "feature"}, GATE_RIDGE),
        ({"metric": "euclidean"}, GATE_STRAIGHT),
        ({"metric": "euclidean", "strength": 100.0}, GATE_STRAIGHT),
    ],
)
def test_metric_and_strength_lead_wires(options: dict[str, object], course: list[int]) -> None:
    obj = add_gate()
    edit()
    assert mark(chains="{} {}".format(*GATE_SEEDS), **options)
    assert seams(obj) == chain(*course)
