# SPDX-License-Identifier: GPL-3.0-or-later
"""The hand and the eye for tests in the real window."""

from collections.abc import Iterator

import desk as desks
import pytest
import ui as driver
from seamwire.mesh.settings import preferences
from seamwire.words.reports import Notice, Notices


def watched(hand: driver.Ui) -> Iterator[driver.Ui]:
    """Hand it out; after the test, nothing that the add-on's operators, panels or drawing raised may be left."""
    driver.take_errors()
    preferences().text = "INFORMATION"  # they would lie over what tests look at
    yield hand
    hand.wait()
    errors = driver.take_errors()
    assert not errors, "\n".join(errors)


@pytest.fixture
def ui() -> Iterator[driver.Ui]:
    """Blender's window, driven by simulated events."""
    yield from watched(driver.Ui())


@pytest.fixture
def real_ui() -> Iterator[driver.RealUi]:
    """Blender's window, driven by the display's pointer and keyboard: only in files named ``test_real_*.py``."""
    yield from watched(driver.RealUi())


@pytest.fixture
def desk(ui: driver.Ui) -> Iterator[desks.Desk]:
    """A flat grid to draw on; vertex y * 9 + x is column x of row y."""
    yield desks.grid(ui)
    desks.leave(ui)


@pytest.fixture
def cone(ui: driver.Ui) -> Iterator[desks.Desk]:
    """Half a cone to draw on: the two wires from 20 to 61 differ."""
    yield desks.half_cone(ui)
    desks.leave(ui)


@pytest.fixture
def reports(monkeypatch: pytest.MonkeyPatch) -> list[Notice]:
    """Return what is reported when chains end."""
    found: list[Notice] = []
    take = Notices.take
    monkeypatch.setattr(Notices, "take", lambda own: found.extend(taken := take(own)) or taken)
    return found
