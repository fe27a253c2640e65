# SPDX-License-Identifier: GPL-3.0-or-later
"""The rooms of the library: a file includes only headers of the same room and of the rooms below."""

import re
from pathlib import Path

import pytest

NATIVE = Path(__file__).resolve().parents[3] / "native"
ROOMS = {
    "seamwire": (
        "detail",
        "numeric",
        "graph",
        "surface",
        "files",
        "picking",
        "cut",
        "metric",
        "embedding",
        "geodesics",
        "edges",
        "wires",
        "context",
        "live",
    ),
    "seamwire_uv": ("maps", "tuning", "prices", "slits", "parts", "search", "decimation", "seams"),
}
"""From below to above. The second library may use all of the first."""
ORDER = [(library, room) for library, rooms in ROOMS.items() for room in rooms]
FILES = sorted(NATIVE.glob("seamwire*/*/**/*.?pp"))
INTERFACE = [path for path in FILES if "include" in path.parts]


def library_of(path: Path) -> str:
    return path.relative_to(NATIVE).parts[0]


def included(path: Path) -> list[tuple[str, str]]:
    """Return library and room of each header that a file includes: the library is empty if the header is internal."""
    found = re.findall(
        r'^#include "(?:(seamwire(?:_uv)?)/)?(?!seamwire)(\w+)/', path.read_text(encoding="utf-8"), flags=re.MULTILINE
    )
    return [(library, room) for library, room in found]


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(NATIVE)))
def test_a_file_includes_its_own_room_and_those_below(path: Path) -> None:
    if path.parent.name == library_of(path):
        return  # headers of no room
    floor = ORDER.index((library_of(path), path.parent.name))
    allowed = ORDER[: floor + 1]
    rooms = [room for _, room in allowed]
    wrong = [
        (library, room)
        for library, room in included(path)
        if room not in rooms or (library and (library, room) not in allowed)
    ]
    assert wrong == []


@pytest.mark.parametrize("path", INTERFACE, ids=lambda path: str(path.relative_to(NATIVE)))
def test_the_interface_includes_nothing_of_the_inside(path: Path) -> None:
    assert [room for library, room in included(path) if not library] == []


@pytest.mark.parametrize("library", ROOMS)
def test_one_header_includes_all_others(library: str) -> None:
    folder = NATIVE / library / "include"
    named = re.findall('#include "(.*)"', (folder / library / f"{library}.hpp").read_text(encoding="utf-8"))
    others = {str(path.relative_to(folder)) for path in folder.rglob("*.hpp")}
    assert named == sorted(others - {f"{library}/{library}.hpp", f"{library}/api.hpp"})


def test_every_room_has_files_and_no_name_is_in_both_libraries() -> None:
    there = {(library_of(path), path.parent.name) for path in FILES}
    assert there - {(library, library) for library in ROOMS} == set(ORDER)
    assert len({room for _, room in ORDER}) == len(ORDER)


def test_functions_of_the_module_have_names_of_their_own() -> None:
    """Packages compile all sources of the module as one. Overloads of a name in a header are meant."""
    folder = NATIVE / "python"
    headers = "\n".join(path.read_text(encoding="utf-8") for path in folder.glob("*.hpp"))
    definition = re.compile(
        r"^(?!return |else |using |namespace |struct |class |template)[A-Za-z_][\w:<>,&* ]* [*&]?(\w+)\(", re.M
    )
    sources: dict[str, set[str]] = {}
    for path in folder.glob("*.cpp"):
        for name in definition.findall(path.read_text(encoding="utf-8")):
            sources.setdefault(name, set()).add(path.name)
    assert len(sources) > 100
    twice = {name: files for name, files in sources.items() if len(files) > 1}
    assert {name: files for name, files in twice.items() if not re.search(rf"\b{name}\(", headers)} == {}


def test_clang_14_can_compile_the_sources() -> None:
    """With GCC 12's library, as in Debian 12, it cannot compile functions of std::ranges that return a subrange."""
    call = re.compile(r"std::ranges::(unique|rotate|equal_range|remove|remove_if|partition|stable_partition|search)\(")
    sources = list(NATIVE.rglob("*.?pp"))
    assert [str(path) for path in sources if call.search(path.read_text(encoding="utf-8"))] == []
    assert len(sources) > len(FILES)
