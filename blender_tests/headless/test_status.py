# SPDX-License-Identifier: GPL-3.0-or-later
"""What the status bar says: what each button and key would do now."""

import bpy
import pytest
from scene import add_grid, edit
from seamwire import drawing, edit_mesh, keymap, ui
from seamwire.session import Session


@pytest.fixture
def session() -> Session:
    obj = add_grid(9)
    edit()
    arrays = edit_mesh.read(obj)
    session = Session(drawing.live_maker(arrays), arrays.points)
    session.wait()
    return session


def said(session: Session, *notes: str) -> str:
    return "; ".join(text for _, text in ui.hints(session, keymap.Bindings(), notes))


def test_every_icon_is_one_of_blenders(session: Session) -> None:
    icons = bpy.types.UILayout.bl_rna.functions["label"].parameters["icon"].enum_items
    session.click(0)
    session.click(4)
    session.wait()
    session.hover(40)
    session.click(4)  # refused, and said
    shown = [icon for icon, _ in ui.hints(session, keymap.Bindings(), ("A note",))]
    session.switch("SURFACE")  # computing
    session.end_chain()
    shown += [icon for icon, _ in ui.hints(session, keymap.Bindings())]
    assert [icon for icon in shown if icon not in icons] == []


def test_the_hints_follow_what_is_going_on(session: Session) -> None:
    assert "Ctrl: Seed on Edge or Vertex" in said(session)
    assert "Keep Wire" not in said(session)
    assert "Finish" in said(session)
    session.click(36)
    session.wait()
    session.hover(44)
    assert "Keep Wire" in said(session)
    assert "End Chain" in said(session)
    assert "Take Back" in said(session)
    session.click(44)
    assert "Mark 8 Edges" in said(session)
    session.wait()
    assert not session.click(44)
    assert "click somewhere else" in said(session)
    assert "Go Across Surface" in said(session)
    session.switch("SURFACE")
    session.wait()
    assert "Go Along Edges" in said(session)
    assert "Loop" not in said(session)
    assert said(session, "Works on the cage").endswith("Works on the cage")
