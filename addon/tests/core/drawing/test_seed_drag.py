# SPDX-License-Identifier: GPL-3.0-or-later
"""A seed that is dragged, and the wires that follow it."""

from __future__ import annotations

import pytest
from grid import Grid, wire
from seamwire.core.drawing.seed_drag import SeedDrag
from seamwire.core.network.network import Network, Snap

CORNER = wire(0, 1, 7)


def test_a_dragged_seed_takes_its_wires_along_once_they_are_computed() -> None:
    drag = SeedDrag(Grid(fork_ready=(False, False)).drawing(Network((CORNER,))), Snap(7))
    assert str(drag.aim(Snap(2))) == ""
    assert not drag.final
    assert not drag.poll()
    assert drag.commit() is drag
    drag.lives()[0].wait()
    assert drag.poll()
    assert [one.vertices for one in drag.moved] == [(0, 1, 2)]
    assert not drag.poll(), "nothing new"
    assert [one.vertices for one in drag.commit().wires] == [(0, 1, 2)]


def test_only_a_seed_is_dragged() -> None:
    with pytest.raises(ValueError, match="No seed to move at vertex 3"):
        SeedDrag(Grid().drawing(Network((CORNER,))), Snap(3))


def test_a_seed_that_was_not_moved_changes_nothing() -> None:
    assert SeedDrag(Grid().drawing(Network((CORNER,))), Snap(7)).commit() is None
