# SPDX-License-Identifier: GPL-3.0-or-later
"""The rooms of the library: a file includes only headers of the same room and of the rooms below."""

import re
from pathlib import Path

import pytest

NATIVE = Path(__file__).resolve().parents[3] / "native"
ROOMS = (
    "detail",
    "surface",
    "picking",
    "cut",
    "metric",
    "embedding",
    "geodesics",
    "edges",
    "wires",
    "parameterization",
    "context",
    "tuning",
    "prices",
    "slits",
    "parts",
    "search",
    "decimation",
    "seams",
    "live",
)
"""From below to above."""
INTERFACE = NATIVE / "include" / "seamwire"
FILES = sorted(path for folder in (NATIVE / "src", INTERFACE) for path in folder.glob("*/*.?pp"))


def included(path: Path) -> list[tuple[bool, str]]:
    """Return for each room whose headers a file includes whether that is a header of the interface, and the room."""
    found = re.findall(
        r'^#include "(seamwire/)?(?!seamwire/)(\w+)/', path.read_text(encoding="utf-8"), flags=re.MULTILINE
    )
    return [(bool(interface), room) for interface, room in found]


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(NATIVE)))
def test_a_file_includes_its_own_room_and_those_below(path: Path) -> None:
    floor = ROOMS.index(path.parent.name)
    assert [room for _, room in included(path) if ROOMS.index(room) > floor] == []


@pytest.mark.parametrize("path", sorted(INTERFACE.glob("*/*.hpp")), ids=lambda path: f"{path.parent.name}/{path.name}")
def test_the_interface_includes_nothing_of_the_inside(path: Path) -> None:
    assert [room for interface, room in included(path) if not interface] == []


def test_every_room_has_files() -> None:
    assert {path.parent.name for path in FILES} == set(ROOMS)
