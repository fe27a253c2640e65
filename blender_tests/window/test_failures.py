# SPDX-License-Identifier: GPL-3.0-or-later
"""After an error a part of the drawing is told of once, and tried again after the mode, the tool or the mesh has changed."""

from collections.abc import Callable, Iterator
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
import ui as driver
from desk import Desk, choose, draw
from scene import changing, seams
from seamwire import interface
from seamwire.core.islands.islands import IslandMaker
from seamwire.mesh import settings as chosen
from seamwire.view import plan_preview
from seamwire.view.edited_objects import EditedObjects, edited
from seamwire.view.overlay import Overlay
from seamwire.view.plan_preview import Curves, PlanPreview


class Broken:
    """A method that raises until it is mended."""

    def __init__(self, owner: type, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
        self.is_broken, self.calls = True, 0
        method = getattr(owner, name)

        def call(own: object, *arguments: object) -> object:
            self.calls += 1
            if self.is_broken:
                raise RuntimeError("broken")
            return method(own, *arguments)

        monkeypatch.setattr(owner, name, call)


@pytest.fixture
def told() -> Iterator[Callable[[], int]]:
    """Return how many errors were told of since the last call."""
    yield lambda: sum("broken" in error for error in driver.take_errors())
    driver.take_errors()
    chosen.notices.take()


def change_mode(desk: Desk) -> None:
    for mode in ("OBJECT", "EDIT"):
        with desk.ui.override():
            bpy.ops.object.mode_set(mode=mode)
        desk.ui.wait(redraw=True)


def change_tool(desk: Desk) -> None:
    choose(desk.ui, "builtin.select_box")
    choose(desk.ui)


def change_mesh(desk: Desk) -> None:
    with changing(desk.obj) as bm:
        bm.edges[0].seam = not bm.edges[0].seam
    desk.ui.wait(redraw=True)


@pytest.mark.smoke
@pytest.mark.parametrize("change", [change_mode, change_tool, change_mesh])
def test_what_a_click_takes_is_lit_again_after_an_error(
    desk: Desk, monkeypatch: pytest.MonkeyPatch, told: Callable[[], int], change: Callable[[Desk], None]
) -> None:
    desk.choose()
    broken = Broken(EditedObjects, "find", monkeypatch)
    for vertex in (20, 21, 22, 23):
        desk.ui.move(desk.at(vertex))
    assert told() == 1
    assert broken.calls == 1
    broken.is_broken = False
    change(desk)
    desk.ui.move(desk.at(40))
    desk.ui.wait_until(lambda: edited.front is not None and edited.front.session.target is not None)
    assert desk.session.target.pick == 40
    (notice,) = chosen.notices.take()
    assert "tried again" in notice.text


@pytest.mark.parametrize("change", [change_mode, change_tool, change_mesh])
def test_the_overlay_is_drawn_again_after_an_error(
    desk: Desk, monkeypatch: pytest.MonkeyPatch, told: Callable[[], int], change: Callable[[Desk], None]
) -> None:
    desk.choose()
    broken = Broken(Overlay, "draw_in_scene", monkeypatch)
    desk.ui.wait(4, redraw=True)
    assert told() == 1
    assert broken.calls == 1
    change(desk)
    desk.ui.wait_until(lambda: broken.calls > 1)
    assert told() == 0, "it is the same error"
    broken.is_broken = False
    before = broken.calls
    change(desk)
    desk.ui.wait_until(lambda: broken.calls > before)
    desk.ui.wait(4, redraw=True)
    assert broken.calls > before + 1


def test_wires_are_drawn_while_islands_fail_and_islands_are_back_after_a_change(
    desk: Desk, monkeypatch: pytest.MonkeyPatch, told: Callable[[], int]
) -> None:
    desk.choose()
    draw(desk, 36, 44)
    view = edited.front
    desk.ui.wait_until(lambda: view.islands.newest is not None and view.islands.newest.count == 2)
    broken = Broken(IslandMaker, "ask", monkeypatch)
    draw(desk, 4, 13)
    desk.ui.wait(4, redraw=True)
    assert told() == 1
    assert view.islands.newest is None
    assert len(view.picture.wires) == 2
    drawn = Broken(Overlay, "draw_in_scene", monkeypatch)
    drawn.is_broken = False
    desk.ui.wait(3, redraw=True)
    assert drawn.calls > 0
    broken.is_broken = False
    change_mesh(desk)
    desk.ui.wait_until(lambda: edited.front.islands.newest is not None)
    assert len(seams(desk.obj)) > 8


def test_a_preview_that_failed_is_tried_again_with_the_next_plan(
    desk: Desk, monkeypatch: pytest.MonkeyPatch, told: Callable[[], int]
) -> None:
    desk.choose()
    arrays = edited.front.mesh.arrays
    broken = Broken(plan_preview._ObjectPreview, "draw", monkeypatch)  # the only class that draws plans
    preview = PlanPreview()
    try:
        for _ in range(2):
            preview.show(
                desk.obj, arrays, Curves(slits=[arrays.in_object[36:45]]), np.array([(36, 37)], dtype=np.int32)
            )
            desk.ui.wait(3, redraw=True)
        assert broken.calls == 2
        assert told() == 1
        broken.is_broken = False
        preview.show(desk.obj, arrays, Curves(slits=[arrays.in_object[36:45]]), np.array([(36, 37)], dtype=np.int32))
        desk.ui.wait(3, redraw=True)
        assert broken.calls > 3
    finally:
        preview.close()


def layer(**methods: Callable) -> SimpleNamespace:
    """Return a layer that draws nothing."""
    nothing = {name: lambda *_: None for name in ("follow", "poll", "repose", "draw_heat", "draw_lines", "close")}
    return SimpleNamespace(busy=False, **{**nothing, "legends": list, **methods})


@pytest.fixture
def layers() -> Iterator[list[Callable]]:
    """Return the list of makers of layers that are added, to be removed after the test."""
    added: list[Callable] = []
    yield added
    for make in added:
        interface.remove_layer(make)


@pytest.mark.smoke
@pytest.mark.parametrize("method", ["draw_heat", "draw_lines", "legends"])
def test_a_layer_that_cannot_be_drawn_stops_neither_others_nor_the_chain(
    desk: Desk, told: Callable[[], int], layers: list[Callable], method: str
) -> None:
    def fail(*_: object) -> None:
        raise RuntimeError("broken")

    desk.choose()
    calls: list[str] = []
    other = layer(**{name: lambda *_, name=name: calls.append(name) for name in ("draw_heat", "draw_lines", "legends")})
    for made in (layer(**{method: fail}), other):
        layers.append(lambda *_, made=made: made)
        interface.add_layer(layers[-1])
    desk.ui.wait(4, redraw=True)
    assert set(calls) == {"draw_heat", "draw_lines", "legends"}
    desk.start()
    desk.ui.click(desk.at(36))
    desk.ui.click(desk.at(44))
    desk.ui.wait_until(lambda: len(desk.session.wires) == 1)
    assert desk.running
    desk.ui.key("RET")
    assert seams(desk.obj) != []
    assert told() == 1, "once, although it was drawn many times"


def test_a_layer_that_cannot_be_made_leaves_those_that_are_there(
    desk: Desk, told: Callable[[], int], layers: list[Callable]
) -> None:
    def fail(*_: object) -> None:
        raise RuntimeError("broken")

    desk.choose()
    calls: list[str] = []
    layers.append(lambda *_: layer(draw_lines=lambda *_: calls.append("drawn")))
    interface.add_layer(layers[0])
    layers.append(fail)
    interface.add_layer(fail)
    assert told() == 1
    calls.clear()
    desk.ui.wait(3, redraw=True)
    assert calls
