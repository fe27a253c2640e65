# SPDX-License-Identifier: GPL-3.0-or-later
"""The hand and the eye for tests in the real window."""

from collections.abc import Iterator

import pytest
import ui as driver


@pytest.fixture
def ui() -> Iterator[driver.Ui]:
    """Blender's window; after the test, nothing that the add-on's operators, panels or drawing raised may be left."""
    driver.take_errors()
    hand = driver.Ui()
    yield hand
    hand.wait()
    errors = driver.take_errors()
    assert not errors, "\n".join(errors)
