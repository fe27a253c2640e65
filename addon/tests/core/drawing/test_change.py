# SPDX-License-Identifier: GPL-3.0-or-later
"""What a chain has changed, on a mesh that others changed as well."""

from __future__ import annotations

from seamwire.core.network.drawn import Drawn
from seamwire.core.sketch.change import Change
from table import wire


def test_a_change_is_added_to_what_others_have_changed() -> None:
    stays, moved, others = wire(0, 1, 2), wire(6, 7, 8), wire(12, 13, 14)
    now, new = moved.changed(vertices=(6, 7, 13)), wire(18, 19)
    change = Change(Drawn((stays, moved)), Drawn((stays, now, new)))
    assert change.drawn == 1
    assert change.rerouted == 1
    found = change.on(Drawn((stays, moved, others)))
    assert found.wires == (stays, others, now, new)
