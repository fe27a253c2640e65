# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the add-on's folder importable; no Blender here."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from blender_refusal import BlenderRefusal, refusal

if TYPE_CHECKING:
    from collections.abc import Iterator

sys.path.insert(0, str(Path(__file__).parent.parent))


@pytest.fixture(autouse=True)
def blender_refusal() -> Iterator[BlenderRefusal]:
    """Fail each test during which, or before which, something asked for a module of Blender."""
    yield refusal
    asked = refusal.asked.copy()
    refusal.asked.clear()
    assert asked == []
