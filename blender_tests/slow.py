# SPDX-License-Identifier: GPL-3.0-or-later
"""Lets tests say when courses are computed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
from seamwire.core.sketch.courses import Course, Courses
from seamwire.core.sketch.dragging import Dragging
from seamwire.core.sketch.sketch import Sketch
from seamwire.core.sketch.wiring import Wiring

if TYPE_CHECKING:
    import pytest
    from seamwire.core.network.network import Request
    from seamwire.core.sketch.interaction import Edit


class Slow:
    """Lets no course become final while `is_slow`, until something waits for them."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.is_slow = False
        done, keep, step, wait = Wiring.is_done.fget, Dragging.keep, Courses.step, Sketch.wait

        def slow_keep(drag: Dragging) -> Edit | None:
            edit = keep(drag)
            if edit is None or not self.is_slow:
                return edit
            return edit._replace(begun=tuple(one._replace(course=Course(one.course.wires)) for one in edit.begun))

        def slow_step(courses: Courses) -> tuple[Request, bool]:
            return (courses.unfinished[0], False) if self.is_slow else step(courses)

        def waited(sketch: Sketch) -> None:
            self.is_slow = False
            wait(sketch)

        monkeypatch.setattr(Wiring, "is_done", property(lambda wiring: not self.is_slow and done(wiring)))
        monkeypatch.setattr(Dragging, "keep", slow_keep)
        monkeypatch.setattr(Courses, "step", slow_step)
        monkeypatch.setattr(Sketch, "wait", waited)
        monkeypatch.setattr(bpy.context.preferences.inputs, "mouse_double_click_time", 1)
