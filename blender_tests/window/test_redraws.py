# SPDX-License-Identifier: GPL-3.0-or-later
"""What a chain asks of Blender's window and of the library: no picture and no computation more than it needs."""

from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import bpy
import pytest
from desk import Desk, draw
from seamwire.core.islands import islands
from seamwire.core.islands.islands import IslandMaker
from seamwire.core.islands.uv_maps import Stretch
from seamwire.core.sketch.sketch import Sketch
from seamwire.core.solver.solver import LiveMaker
from seamwire.mesh import edit_mesh
from seamwire.mesh.edit_mesh import Pose
from seamwire.mesh.object_session import ObjectSession
from seamwire.mesh.settings import settings
from seamwire.view.edited_objects import EditedObjects, edited
from seamwire.view.layers import CrestView, StretchHeat
from seamwire.view.object_view import ObjectView


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> Counter[str]:
    """Count the calls that read the mesh, make live wires, ask for islands and ask for redraws."""
    found: Counter[str] = Counter()

    def count(owner: object, name: str) -> None:
        function = getattr(owner, name)

        def counted(*arguments: object, **options: object) -> object:
            found[name] += 1
            return function(*arguments, **options)

        monkeypatch.setattr(owner, name, staticmethod(counted) if name == "redraw" else counted)

    for owner, name in ((edit_mesh, "read"), (LiveMaker, "__call__"), (IslandMaker, "want"), (EditedObjects, "redraw")):
        count(owner, name)
    return found


@pytest.fixture
def on_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let islands be computed on a thread, as those of a large mesh are."""
    monkeypatch.setattr(islands, "AT_ONCE", 0)


def settled() -> bool:
    """Whether nothing is left to be computed."""
    return not any(view.busy for view in edited.views())


@contextmanager
def pictures(tell: Callable[[], object]) -> Iterator[list[object]]:
    """Collect what a function tells at each picture of the viewport, when it is drawn."""
    told: list[object] = []
    handle = bpy.types.SpaceView3D.draw_handler_add(lambda: told.append(tell()), (), "WINDOW", "POST_PIXEL")
    try:
        yield told
    finally:
        bpy.types.SpaceView3D.draw_handler_remove(handle, "WINDOW")


@pytest.mark.smoke
@pytest.mark.usefixtures("on_threads")
def test_the_first_picture_after_a_chain_shows_all_of_its_end(desk: Desk, calls: Counter[str]) -> None:
    session, ui = desk.choose(), desk.ui
    ui.click(desk.at(36))
    ui.click(desk.at(44))
    ui.wait_until(lambda: len(session.wires) == 1 and settled())
    assert edited.front.islands.newest.count == 2
    wanted = calls["want"]
    with pictures(lambda: (desk.running, settled())) as told:
        ui.key("RET")
        ui.wait_until(lambda: (False, True) in told)
    after = [is_settled for is_running, is_settled in told if not is_running]
    assert after[0], "no other picture is needed"
    assert calls["want"] == wanted, "the seams cut what the wires cut before"
    assert edited.front.islands.newest.count == 2


def test_progress_is_told_without_a_picture(desk: Desk, calls: Counter[str], monkeypatch: pytest.MonkeyPatch) -> None:
    session, ui = desk.choose(), desk.ui
    ui.click(desk.at(36))
    ui.wait_until(lambda: not session.computing and settled())
    ui.wait(2)
    told: list[float] = []
    monkeypatch.setattr("seamwire.tool.chain.show_status", lambda _hints: told.append(session.progress))
    redraws = calls["redraw"]
    for percent in (10, 20, 30):
        monkeypatch.setattr(session, "progress", percent / 100.0)
        desk.chain.show()
        desk.chain.show()
    assert told == [0.1, 0.2, 0.3]
    assert calls["redraw"] == redraws
    session.hover(None)
    desk.chain.show()
    assert calls["redraw"] > redraws, "what is under the mouse is to be seen"
    monkeypatch.undo()


def test_islands_are_told_of_once_where_nothing_tints_them(desk: Desk) -> None:
    desk.choose()
    own = bpy.context.preferences.addons["seamwire"].preferences
    own.tint, before = 0.0, own.tint
    try:
        draw(desk, 36, 44)
        view = edited.front
        desk.ui.wait_until(settled)
        edited.poll()
        assert not view.poll(), "nothing is new"
    finally:
        own.tint = before


@pytest.mark.smoke
@pytest.mark.parametrize("in_chain", [False, True])
def test_a_picture_reads_no_mesh_and_computes_nothing(
    desk: Desk, monkeypatch: pytest.MonkeyPatch, in_chain: bool
) -> None:
    """All work that a view may need is due while it is drawn, and is left to the timer."""
    session, ui = desk.choose(), desk.ui
    draw(desk, 36, 44)
    if in_chain:
        ui.click(desk.at(4))
    ui.wait_until(settled)
    drawing: list[str] = []
    drawn: list[str] = []
    worked: list[str] = []
    draw_part = EditedObjects.draw

    def noted(own: EditedObjects, part: str) -> None:
        drawing.append(part)
        try:
            draw_part(own, part)
        finally:
            drawn.append(drawing.pop())

    monkeypatch.setattr(EditedObjects, "draw", noted)
    for owner, name in (
        (edit_mesh, "read"),
        (ObjectView, "__init__"),
        (ObjectView, "refresh"),
        (ObjectView, "poll"),
        (ObjectSession, "follow"),
        (Pose, "follow"),
        (LiveMaker, "__call__"),
        (IslandMaker, "want"),
        (StretchHeat, "read"),
        (Stretch, "islands"),
        (CrestView, "poll"),
        *((Sketch, name) for name in ("follow", "hover", "poll", "adopt")),
        (Sketch, "use_crests"),
    ):
        function = getattr(owner, name)

        def working(*given: object, function: Callable = function, name: str = name, **options: object) -> object:
            if drawing:
                worked.append(name)
            return function(*given, **options)

        monkeypatch.setattr(owner, name, working)
    for make_due in (
        lambda: session.drop(session.wires[0]),
        lambda: edited.front.has_moved(),
        lambda: setattr(edited.front, "stale", True),
        lambda: setattr(settings(), "show_crests", True),
        lambda: setattr(settings(), "heat", "ANGLE"),
        *([] if in_chain else [edited.clear]),
    ):
        make_due()
        drawn.clear()
        ui.area.tag_redraw()
        ui.wait_until(lambda: len(drawn) > 1)
        ui.wait(3, redraw=True)
    assert worked == []
