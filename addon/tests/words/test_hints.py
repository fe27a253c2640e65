# SPDX-License-Identifier: GPL-3.0-or-later
"""What the status bar says: what each button and key would do now."""

from dataclasses import replace

import pytest
from polygon_meshes import arrays_of, grid_places, grid_polygons
from seamwire.core.network.network import Snap
from seamwire.core.sketch.picture import Offered
from seamwire.core.sketch.sketch import Sketch
from seamwire.core.solver.solver import LiveMaker
from seamwire.words.hints import MOST, hints, idle_hints
from seamwire.words.keys import Action, Bindings, Key
from setting import use

pytest.importorskip("seamwire_core")


@pytest.fixture
def session() -> Sketch:
    """A session on a grid; vertex y * 9 + x is column x of row y."""
    arrays = arrays_of(grid_places(9), grid_polygons(9))
    session = Sketch(LiveMaker(arrays), arrays.points, edges=arrays.edges, triangles=arrays.triangles)
    session.wait()
    return session


def first(session: Sketch, number: int | None = None, **more: str) -> list[str]:
    return [text for _, text in hints(session.picture, Bindings(), **more)][:number]


def said(session: Sketch, **more: str) -> str:
    return "; ".join(first(session, **more))


def test_the_hints_follow_what_is_going_on(session: Sketch) -> None:
    assert "Add Seed" not in said(session), "nothing is under the cursor"
    session.hover(36)
    assert "Add Seed" in said(session)
    assert "Keep Wire" not in said(session)
    session.click(36)
    session.wait()
    session.hover(44)
    assert "Keep Wire" in said(session)
    assert "End Chain" in said(session)
    assert "Undo" in said(session)
    assert "Loop" not in said(session)
    session.click(44)
    session.wait()
    session.hover(76)
    assert "Close" in said(session)
    session.end_chain()
    assert "Loop" not in said(session), "a vertex is under the cursor"
    session.hover((76, 77))
    assert "Loop" in said(session)
    session.hover(Snap(36, "SEED"))
    assert "Begin at This Seed" in said(session)
    session.hover(Snap(40, "WIRE", session.wires[0]))
    assert "Begin on This Wire" in said(session)
    assert "Remove Wire" in said(session)
    assert "Swap Path" in said(session)
    assert "Switch to Clear" in said(session)
    use(session, clear=not session.options.clear)
    assert "Switch to Mark" in said(session)
    session.hover(None)
    assert "Across Surface" in said(session)
    use(session, along="SURFACE")
    session.wait()
    assert "Along Edges" in said(session)
    assert "Loop" not in said(session)


def test_what_could_not_be_done_is_said(session: Sketch) -> None:
    assert not session.close()
    assert "draw a wire first" in said(session)


def test_the_mirror_is_offered_and_told(session: Sketch) -> None:
    assert "Mirror? Symmetric on XY" in said(session, mirror_offer="XY")
    use(session, mirror=(0,))
    assert said(session, mirror_offer="XY").endswith("Mirror X")


def test_there_are_at_most_eight_hints_and_the_mirror_is_offered_among_them(session: Sketch) -> None:
    session.click(36)
    session.wait()
    session.click(44)
    session.wait()
    session.hover(76)
    shown = first(session, mirror_offer="X", message="Something was done")
    assert len(shown) == MOST == 8
    assert "Mirror? Symmetric on X" in shown


def test_before_the_first_click_the_hints_teach_the_gestures() -> None:
    keys = {
        "CLICK": Key("LEFTMOUSE"),
        "LOOP": Key("LEFTMOUSE", alt=1),
        "GUIDE": Key("LEFTMOUSE", shift=1),
        "REMOVE": Key("X"),
    }
    assert idle_hints(keys) == [
        ("MOUSE_LMB_DRAG", "Draw Line"),
        ("MOUSE_LMB", "Alt: Add Loop"),
        ("MOUSE_LMB_DRAG", "Shift: Draw Stroke"),
    ]


def test_the_hints_name_the_keys_as_they_are_bound(session: Sketch) -> None:
    keys = Bindings([(Action.CLEAR, Key("J", shift=1))])
    shown = hints(session.picture, keys)
    assert ("EVENT_J", "Shift: Switch to Clear") in shown
    assert not any("Keys" in text for _, text in shown), "what has no key is not offered"


def test_what_a_click_does_comes_first_then_the_way_out_and_the_keys(session: Sketch) -> None:
    session.hover((36, 37))
    assert first(session, 3) == ["Add Seed, Drag: Draw Line", "End Chain", "Keys"]
    session.click(36)
    session.wait()
    session.hover(44)
    assert first(session, 3) == ["Keep Wire", "End Chain", "Keys"]
    assert first(session, 2, message="Something was done") == ["Something was done", "Keep Wire"]
    session.end_chain()
    session.hover((40, 49), loop=True)
    session.wait()
    assert len(session.picture.offered.kinds) > 1
    said_first = first(session, 4)
    assert said_first[0].startswith("Alt: Add ")
    assert said_first[0].endswith(f", 1 of {len(session.picture.offered.kinds)}")
    assert said_first[1].endswith(" Instead")
    assert said_first[2:] == ["End Chain", "Keys"]


def test_what_does_not_apply_is_not_hinted_at(session: Sketch) -> None:
    shown = said(session)
    for text in ("Stroke", "Undo", "Loop", "Mirror", "Candidate", "Close", "Remove", "Seed", "Extend"):
        assert text not in shown, text
    assert "Strength" in shown
    session.hover(36)
    assert "Guide Stroke" in said(session)
    assert "Avoid Stroke" in said(session)
    use(session, metric="euclidean")
    assert "Strength" not in said(session), "straight ways have none"


@pytest.mark.parametrize(("kind", "text"), [("HANDLE", "Add Cut of a Handle"), ("PAST", "Add Strip Past Poles")])
def test_offers_are_in_title_case_as_blender_has_it(session: Sketch, kind: str, text: str) -> None:
    picture = replace(session.picture, offered=Offered((kind,)))
    assert text in "; ".join(said for _, said in hints(picture, Bindings()))
