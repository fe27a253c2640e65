# SPDX-License-Identifier: GPL-3.0-or-later
"""What the status bar says: what each button and key would do now."""

import bpy
import pytest
from scene import add_grid, edit
from seamwire.core.network import Snap
from seamwire.core.session import Session
from seamwire.mesh import edit_mesh
from seamwire.mesh import object_session as board
from seamwire.ui import keymap
from seamwire.ui import menus as ui


@pytest.fixture
def session() -> Session:
    obj = add_grid(9)
    edit()
    arrays = edit_mesh.read(obj)
    session = Session(board.live_maker(arrays), arrays.points)
    session.wait()
    return session


def said(session: Session, *notes: str) -> str:
    return "; ".join(
        text
        for _, text in ui.hints(ui.Status(session, keymap.Bindings(), notes=notes, marks=len(session.edges_to_mark())))
    )


def test_every_icon_is_one_of_blenders(session: Session) -> None:
    icons = bpy.types.UILayout.bl_rna.functions["label"].parameters["icon"].enum_items
    session.click(0)
    session.click(4)
    session.wait()
    session.hover(40)
    session.click(4)  # refused, and said
    shown = [icon for icon, _ in ui.hints(ui.Status(session, keymap.Bindings(), notes=("A note",)))]
    session.switch("SURFACE")  # computing
    session.end_chain()
    shown += [icon for icon, _ in ui.hints(ui.Status(session, keymap.Bindings()))]
    assert [icon for icon in shown if icon not in icons] == []


def test_the_hints_follow_what_is_going_on(session: Session) -> None:
    assert "Seed" not in said(session), "nothing is under the cursor"
    session.hover(36)
    assert "Seed" in said(session)
    assert "Keep Wire" not in said(session)
    assert "Finish" in said(session)
    session.click(36)
    session.wait()
    session.hover(44)
    assert "Keep Wire" in said(session)
    assert "End Chain" in said(session)
    assert "Undo" in said(session)
    assert "Loop" not in said(session)
    session.click(44)
    assert "Mark 8 Edges" in said(session)
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
    assert "Drop Wire" in said(session)
    session.toggle_marking()
    assert "Mark Instead" in said(session)
    assert "Across Surface" in said(session)
    session.switch("SURFACE")
    session.wait()
    assert "Along Edges" in said(session)
    assert "Loop" not in said(session)
    assert said(session, "Works on the cage").endswith("Works on the cage")


def test_the_hints_name_the_keys_as_they_are_bound(session: Session) -> None:
    keys = keymap.Bindings([(keymap.Action.MARKING, keymap.Key("J", shift=1))])
    shown = ui.hints(ui.Status(session, keys))
    assert ("EVENT_J", "Shift: Clear Instead") in shown
    assert not any("Keys" in text for _, text in shown), "what has no key is not offered"


def first(session: Session, number: int, **more: object) -> list[str]:
    return [text for _, text in ui.hints(ui.Status(session, keymap.Bindings(), **more))][:number]


def test_what_a_click_does_comes_first_then_the_ways_out_and_the_keys(session: Session) -> None:
    session.hover((36, 37))
    assert first(session, 4) == ["Seed", "Finish", "Leave", "Keys"]
    assert first(session, 5, resume_offer=True)[4] == "Go On with the Wires Kept Before"
    session.click(36)
    session.wait()
    session.hover(44)
    assert first(session, 4) == ["Keep Wire", "Finish", "Drop Wire", "Keys"]
    assert first(session, 5, message="Something was done")[:2] == ["Something was done", "Keep Wire"]
    session.end_chain()
    session.hover((40, 49), loop=True)
    session.wait()
    assert len(session.loop_offers) > 1
    said_first = first(session, 5)
    assert said_first[0].startswith("Alt: Take ")
    assert said_first[0].endswith(f", 1 of {len(session.loop_offers)}")
    assert said_first[1].endswith(" Instead")
    assert said_first[2:] == ["Finish", "Leave", "Keys"]


def test_what_does_not_apply_is_not_hinted_at(session: Session) -> None:
    shown = said(session)
    for text in ("Stroke", "Keep Off", "Undo", "Loop", "Mirror", "Other", "End Chain", "Close", "Drop Wire", "Go On"):
        assert text not in shown, text
    assert "Strength" in shown
    session.hover(36)
    assert "Stroke" in said(session)
    session.set_metric("euclidean")
    assert "Strength" not in said(session), "straight ways have none"
