# SPDX-License-Identifier: GPL-3.0-or-later
"""The search for parts on a real surface: seams part it, it can be stopped, and it goes on with what it has measured."""

from __future__ import annotations

import numpy as np
import pytest
from fake_live import grid_edges, grid_points, grid_triangles
from real_sessions import session_on
from seamwire.core.offers.edge_loops import AMOUNTS
from seamwire.core.sketch.sketch import Sketch

SIZE = 9
COLUMN = np.array([[SIZE * row + 4, SIZE * (row + 1) + 4] for row in range(SIZE - 1)], dtype=np.int32)
"""The edges that divide the plate into a left and a right half."""


def plate(**options: object) -> Sketch:
    return session_on(grid_points(SIZE), grid_triangles(SIZE), grid_edges(SIZE), **options)


def test_a_stopped_search_yields_nothing_more_and_is_not_measured_again(monkeypatch: pytest.MonkeyPatch) -> None:
    drawing = plate(seams=COLUMN)
    assert list(drawing.find_parts(drawing.seams, lambda: False)) == []
    made, make = [], drawing._make_parts

    def noted(*arguments: object) -> object:
        made.append(arguments)
        return make(*arguments)

    monkeypatch.setattr(drawing, "_make_parts", noted)
    goes_on = [True]
    search = drawing.find_parts(drawing.seams, lambda: goes_on[0])
    next(search)
    goes_on[0] = False
    assert list(search) == []
    assert len(made) == 1
    assert len(list(drawing.find_parts(drawing.seams, lambda: True))) == len(AMOUNTS)
    assert len(made) == 1
