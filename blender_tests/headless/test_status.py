# SPDX-License-Identifier: GPL-3.0-or-later
"""The icons in the status bar. The texts are tested without Blender."""

from dataclasses import replace

import bpy
import pytest
from scene import add_grid, edit
from seamwire.core.drawing.drawing import Drawing
from seamwire.core.drawing.session import Session
from seamwire.core.solver.solver import LiveMaker
from seamwire.mesh import edit_mesh
from seamwire.words.hints import Status, hints
from seamwire.words.keys import Bindings

pytestmark = pytest.mark.every_blender


@pytest.fixture
def session() -> Session:
    obj = add_grid(9)
    edit()
    arrays = edit_mesh.read(obj)
    session = Session(Drawing(LiveMaker(arrays), arrays.points))
    session.queue.wait()
    return session


def test_every_icon_is_one_of_blenders(session: Session) -> None:
    icons = bpy.types.UILayout.bl_rna.functions["label"].parameters["icon"].enum_items
    session.click(0)
    session.click(4)
    session.queue.wait()
    session.hover(40)
    session.click(4)  # refused, and said
    shown = [icon for icon, _ in hints(Status(session.picture, Bindings(), message="A message"))]
    session.follow(replace(session.options, along="SURFACE"))  # computing
    session.end_chain()
    shown += [icon for icon, _ in hints(Status(session.picture, Bindings(), mirror_offer="X"))]
    assert [icon for icon in shown if icon not in icons] == []
