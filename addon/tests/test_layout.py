# SPDX-License-Identifier: GPL-3.0-or-later
"""The five packages: arrows run downwards only, no two modules need each other, and the core knows no Blender."""

from __future__ import annotations

import ast
from graphlib import TopologicalSorter
from pathlib import Path

import pytest
from blender_refusal import BLENDERS

ROOT = Path(__file__).parent.parent / "seamwire"
FLOORS = ("core", "mesh", "view", "operators", "ui")
KNOWN_CYCLES = {
    ("operators.report", "operators.modal"): {
        "operators.cut",
        "operators.modal",
        "operators.report",
        "operators.slide",
        "operators.unwrap",
    },
}
"""Imports of types that lead back to the module itself, and all modules on the way."""


def modules() -> list[Path]:
    return [path for path in sorted(ROOT.rglob("*.py")) if path.parent != ROOT and path.name != "__init__.py"]


def imported(path: Path) -> tuple[set[str], set[str]]:
    """Return the add-on's modules that one imports, types included, as ``package.module``, and other top-level ones."""
    own, others = set(), set()
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            others.update(name.name.split(".")[0] for name in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            others.add(node.module.split(".")[0])
        elif isinstance(node, ast.ImportFrom):
            package = [path.parent.name] if node.level == 1 else []
            parts = package + (node.module.split(".") if node.module else [])
            if len(parts) == 2:
                own.add(".".join(parts))
            else:
                own.update(f"{parts[0]}.{name.name}" for name in node.names)
    return own, others


@pytest.mark.parametrize("path", modules(), ids=lambda path: f"{path.parent.name}.{path.stem}")
def test_a_module_imports_from_its_own_package_and_those_below(path: Path) -> None:
    own, others = imported(path)
    floor = FLOORS.index(path.parent.name)
    assert [name for name in own if FLOORS.index(name.split(".")[0]) > floor] == []
    if path.parent.name == "core":
        assert not others & BLENDERS


def test_edit_meshes_are_had_from_one_place_which_numbers_their_items() -> None:
    readers = {path.name for path in modules() if "from_edit_mesh" in path.read_text(encoding="utf-8")}
    assert readers == {"edit_mesh.py"}


def reached(graph: dict[str, set[str]], start: str) -> set[str]:
    """Return the modules that one needs, itself only if one of them needs it."""
    found: set[str] = set()
    waiting = [start]
    while waiting:
        new = graph[waiting.pop()] - found
        found |= new
        waiting += new
    return found


def test_no_modules_need_each_other_but_the_known_ones() -> None:
    graph = {f"{path.parent.name}.{path.stem}": imported(path)[0] for path in modules()}
    assert len(graph) > 30
    for (module, other), cycle in KNOWN_CYCLES.items():
        assert other in graph[module]
        assert {one for one in reached(graph, module) if module in reached(graph, one)} == cycle
    for module, other in KNOWN_CYCLES:
        graph[module].remove(other)
    TopologicalSorter(graph).prepare()  # raises CycleError
