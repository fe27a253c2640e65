# SPDX-License-Identifier: GPL-3.0-or-later
"""A script, a timer or another add-on changes the mesh while a chain is being drawn."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import bmesh
import bpy
import pytest
from desk import RED, Desk, draw, shows, undo_steps
from scene import chain, changing, seams
from seamwire.mesh.settings import settings
from seamwire.words.reports import Notice

FIRST = chain(*range(18, 27))
ROW = chain(*range(36, 45))


def open_chain(desk: Desk) -> None:
    """Draw a chain, and keep a wire of another one that stays open."""
    desk.choose()
    draw(desk, 18, 26)
    ui = desk.ui
    ui.click(desk.at(36))
    ui.click(desk.at(44))
    session = desk.session
    ui.wait_until(lambda: len(session.wires) == 2)
    assert desk.running


def add_apart(desk: Desk) -> None:
    """Add a triangle beside the grid: all other vertices keep their numbers."""
    with changing(desk.obj) as bm:
        bm.faces.new([bm.verts.new((x, y, 0.0)) for x, y in ((3.0, 0.0), (4.0, 0.0), (3.0, 1.0))])


def delete_apart(desk: Desk) -> None:
    """Delete a vertex of the first row: all others have other numbers."""
    with changing(desk.obj) as bm:
        bmesh.ops.delete(bm, geom=[bm.verts[0]], context="VERTS")


def move_apart(desk: Desk) -> None:
    """Move a corner."""
    with changing(desk.obj) as bm:
        bm.verts[80].co.z += 0.3


def delete_edge_of_wire(desk: Desk) -> None:
    """Delete an edge of the wire that is not in the mesh yet."""
    with changing(desk.obj) as bm:
        bmesh.ops.delete(bm, geom=[bm.edges.get((bm.verts[40], bm.verts[41]))], context="EDGES")


def settled(desk: Desk) -> None:
    """Wait until the chain has ended and the mesh is read anew. The mouse rests."""
    desk.ui.wait_until(lambda: not desk.running, 8.0)
    desk.ui.wait(30)


@pytest.mark.every_blender
@pytest.mark.parametrize("change", [add_apart, move_apart])
def test_the_chain_ends_and_its_wires_are_kept(
    desk: Desk, change: Callable[[Desk], None], reports: list[Notice]
) -> None:
    open_chain(desk)
    change(desk)
    settled(desk)
    assert reports[-1] == Notice("WARNING", "The mesh was changed: the chain has ended")
    assert seams(desk.obj) == sorted(FIRST + ROW)
    ui = desk.ui
    ui.move(desk.at(60))
    ui.wait_until(lambda: len(desk.session.wires) == 2)
    pixels = ui.pixels()
    assert shows(pixels, desk.at(37, 38), RED)
    assert shows(pixels, desk.at(19, 20), RED)
    assert len(desk.session.points) == len(bmesh.from_edit_mesh(desk.obj.data).verts)


@pytest.mark.parametrize("change", [delete_apart, delete_edge_of_wire])
def test_wires_that_cannot_be_kept_are_told_of_and_all_others_are_seen(
    desk: Desk, change: Callable[[Desk], None], reports: list[Notice]
) -> None:
    open_chain(desk)
    change(desk)
    settled(desk)
    assert reports[-1].level == "WARNING"
    assert reports[-1].text.endswith("the wires of this chain were not kept")
    assert len(seams(desk.obj)) == len(FIRST)
    ui = desk.ui
    ui.move(desk.at(60))
    ui.wait_until(lambda: len(desk.session.wires) == 1)
    assert shows(ui.pixels(), desk.at(*desk.session.wires[0].vertices[:2]), RED)


@pytest.mark.parametrize("change", [delete_apart, delete_edge_of_wire])
def test_wires_that_a_file_was_saved_with_stay_and_are_told_of(
    desk: Desk, tmp_path: Path, change: Callable[[Desk], None], reports: list[Notice], capfd: pytest.CaptureFixture[str]
) -> None:
    open_chain(desk)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "open.blend"), copy=True)
    change(desk)
    settled(desk)
    assert reports[-1].level == "WARNING"
    assert reports[-1].text.endswith("the wires of this chain are in the mesh as they were last saved")
    left = len(FIRST + ROW) - (change is delete_edge_of_wire)
    assert len(seams(desk.obj)) == left
    assert undo_steps(capfd)[-1] == "Draw Seamwires"
    ui = desk.ui
    ui.move(desk.at(60))
    ui.wait_until(lambda: len(desk.session.wires) == (1 if change is delete_edge_of_wire else 2))
    ui.key("Z", ctrl=True)
    ui.wait(5)
    assert seams(desk.obj) == FIRST


def test_wires_that_are_not_finished_are_told_of(desk: Desk, reports: list[Notice]) -> None:
    settings().along, settings().finish = "SURFACE", "CUT"
    desk.choose()
    ui, session = desk.ui, desk.session
    ui.click(desk.at(36))
    ui.click(desk.at(44))
    ui.wait_until(lambda: len(session.wires) == 1)
    assert desk.running
    move_apart(desk)
    settled(desk)
    assert any(
        notice.text.endswith("1 wire kept along edges, because the mesh was changed meanwhile") for notice in reports
    )
    assert seams(desk.obj) == sorted(ROW)
