# SPDX-License-Identifier: GPL-3.0-or-later
"""Imports run one way only, no two modules need each other, and no two modules or classes share a name."""

from __future__ import annotations

import ast
import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
from graphlib import TopologicalSorter
from pathlib import Path

import pytest
from blender_refusal import BLENDERS
from seamwire import interface
from seamwire.terms.choices import FINISHES

ROOT = Path(__file__).parent.parent / "seamwire"
LAB = ROOT.parent / "seamwire_lab"
NETWORKS = ROOT.parent / "seamwire_networks"
BATCH = ROOT.parents[1] / "batch" / "seamwire_batch"
ROOMS = ("base", "network", "solver", "storage", "seams", "islands", "offers", "sketch", "picking")
"""The rooms of the core; each imports from itself and from those before it."""
FLOORS = (
    "terms",
    *(f"core.{room}" for room in ROOMS),
    "words",
    "mesh",
    "view",
    "tool",
    "operators",
    "suggesting",
    "ui",
)


def modules() -> list[Path]:
    return [path for path in sorted(ROOT.rglob("*.py")) if path.parent != ROOT and path.name != "__init__.py"]


def name_of(path: Path) -> str:
    """Return a module's name below the add-on, such as ``core.base.geometry``."""
    return ".".join(path.relative_to(ROOT).with_suffix("").parts)


def floor_of(name: str) -> int:
    """Return the floor of a package or module."""
    return FLOORS.index(next(floor for floor in FLOORS if f"{name}.".startswith(f"{floor}.")))


def imported(path: Path) -> tuple[set[str], set[str]]:
    """Return the add-on's modules that one imports, types included, and other top-level ones."""
    own, others = set(), set()
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            others.update(name.name.split(".")[0] for name in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            others.add(node.module.split(".")[0])
        elif isinstance(node, ast.ImportFrom):
            above = path.relative_to(ROOT).parts[: -node.level]
            parts = (*above, *(node.module.split(".") if node.module else ()))
            if ROOT.joinpath(*parts).is_dir():
                own.update(".".join((*parts, name.name)) for name in node.names)
            else:
                own.add(".".join(parts))
    return own, others


@pytest.mark.parametrize("path", modules(), ids=name_of)
def test_a_module_imports_from_its_own_package_or_room_and_those_below(path: Path) -> None:
    own, others = imported(path)
    name = name_of(path)
    assert [other for other in own if floor_of(other) > floor_of(name)] == []
    if name.startswith(("core.", "words.")):
        assert not others & BLENDERS


def shared(named: Iterable[tuple[str, str]]) -> dict[str, list[str]]:
    """Return the names that are given in several places, with these places."""
    places = defaultdict(list)
    for name, place in named:
        places[name].append(place)
    return {name: found for name, found in places.items() if len(found) > 1}


def named_files() -> list[Path]:
    """Return the modules of all add-ons and of the command for batches. Each folder has an `__init__`, and each other add-on
    has its access to the tool."""
    files = [path for folder in (ROOT, LAB, NETWORKS, BATCH) for path in sorted(folder.rglob("*.py"))]
    return [path for path in files if path.name not in {"__init__.py", "tool.py"}]


def test_no_two_modules_share_a_name() -> None:
    assert len(named_files()) > 100
    assert shared((path.stem, str(path.parent)) for path in named_files()) == {}


def test_no_two_classes_share_a_name() -> None:
    named = [
        (node.name, path.name)
        for path in named_files()
        for node in ast.parse(path.read_text(encoding="utf-8")).body
        if isinstance(node, ast.ClassDef)
    ]
    assert len(named) > 100
    assert shared(named) == {}


def test_the_page_of_words_names_what_there_is() -> None:
    text = (ROOT.parents[1] / "docs/development/words.md").read_text(encoding="utf-8")
    named = re.findall(r"^\| .* \| `(\S+)` `(\w+)` \|$", text, re.MULTILINE)
    assert len(named) == text.count("\n| ") - 1 > 20
    missing = [
        f"{path} {name}"
        for path, name in named
        if not re.search(rf"^(class )?{name}\b", (ROOT / path).read_text(encoding="utf-8"), re.MULTILINE)
    ]
    assert missing == []


@pytest.mark.parametrize("page", ["recipes", "design", "structure"])
def test_pages_of_the_development_name_what_there_is(page: str) -> None:
    native = ROOT.parents[1] / "native"
    top = ROOT.parents[1]
    folders = (
        ROOT,
        LAB,
        NETWORKS,
        ROOT.parent,
        top,
        top / "scripts",
        native,
        *(native / library / part for library in ("seamwire", "seamwire_uv") for part in ("", "src", "include")),
    )
    named = re.findall(r"`([^`\s]+)`", (ROOT.parents[1] / f"docs/development/{page}.md").read_text(encoding="utf-8"))
    paths = [name for name in named if re.fullmatch(r"[\w/-]+\.(py|pyi|cpp|hpp|json|md)|[\w-]+(/[\w-]+)+", name)]
    assert [path for path in paths if not any((folder / path).exists() for folder in folders)] == []
    files = [*named_files(), *native.glob("*/**/*.?pp")]
    code = "\n".join(path.read_text(encoding="utf-8") for path in files)
    words = [match for name in named if name not in paths if (match := re.fullmatch(r"(\w+)(?:(?:\.|::)(\w+))?", name))]
    assert len(paths) > 15
    assert len(words) > 30

    def exists(owner: str, member: str | None) -> bool:
        if member is None or not owner.strip("_")[0].isupper():
            return re.search(rf"\b{member or owner}\b", code) is not None
        body = rf"^(class|struct)( SEAMWIRE_(UV_)?API)? {owner}\b(?:(?!^(?:class|struct) ).)*?\b{member} ?[(:=;{{]"
        return re.search(body, code, re.MULTILINE | re.DOTALL) is not None

    missing = [match[0] for match in words if not exists(*match.groups())]
    assert [name for name in missing if not any((folder / name).exists() for folder in folders)] == []


def test_a_finish_is_named_by_its_table_and_by_what_carries_it_out_only() -> None:
    trees = {name_of(path): ast.parse(path.read_text(encoding="utf-8")) for path in modules()}
    named = {name for name, tree in trees.items() for node in strings(tree) if node.value in FINISHES}
    assert named == {"terms.choices", "terms.options", "mesh.finishes", "operators.seam_operators"}


def test_the_core_has_rooms_only() -> None:
    core = ROOT / "core"
    assert {path.name for path in core.iterdir() if path.is_dir() and path.name != "__pycache__"} == set(ROOMS)
    assert [path.name for path in core.glob("*.py")] == ["__init__.py"]


@pytest.mark.parametrize("folder", [LAB, NETWORKS], ids=lambda folder: folder.name)
def test_another_add_on_uses_nothing_of_the_tool_but_its_interface(folder: Path) -> None:
    used, calls = set(), set()
    for path in folder.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                assert not [name.name for name in node.names if name.name.split(".")[0] == "seamwire"], path.name
            elif isinstance(node, ast.ImportFrom) and (node.level, node.module) == (1, "tool"):
                used.update(name.name for name in node.names)
            elif isinstance(node, ast.ImportFrom):
                assert node.level < 2 and (node.module or "").split(".")[0] != "seamwire", path.name
            elif isinstance(node, ast.Attribute) and ast.unparse(node.value) == "tool":
                used.add(node.attr)
            elif isinstance(node, ast.Call) and ast.unparse(node.func).split(".")[-1] in {
                "import_module",
                "__import__",
            }:
                calls.add((path.name, ast.unparse(node.args[0])))
    assert used <= set(interface_names())
    assert calls == {("__init__.py", "f'{name}.interface'"), ("tool.py", "'seamwire.interface'")}


def test_the_other_add_ons_join_the_tool_in_the_same_way() -> None:
    def common(folder: Path) -> str:
        return (folder / "__init__.py").read_text("utf-8").partition("\n# After an update")[2]

    assert (LAB / "tool.py").read_text("utf-8") == (NETWORKS / "tool.py").read_text("utf-8")
    assert common(LAB) == common(NETWORKS) != ""


def interface_names() -> list[str]:
    """Return the names that the tool's interface offers."""
    return [*interface.PLACES, "add_layer", "remove_layer"]


def test_the_interface_names_what_there_is() -> None:
    missing = [
        name
        for name, module in interface.PLACES.items()
        if not re.search(
            rf"^(def |class |    )?{name}\b", (ROOT / f"{module.replace('.', '/')}.py").read_text("utf-8"), re.MULTILINE
        )
    ]
    assert missing == []


def test_the_other_add_ons_use_all_of_the_interface() -> None:
    text = "".join(path.read_text(encoding="utf-8") for folder in (LAB, NETWORKS) for path in folder.glob("*.py"))
    assert [name for name in interface_names() if not re.search(rf"\b{name}\b", text)] == []


def test_edit_meshes_are_had_from_one_place_which_numbers_their_items() -> None:
    readers = {path.name for path in modules() if "from_edit_mesh" in path.read_text(encoding="utf-8")}
    assert readers == {"edit_mesh.py"}


def test_no_modules_need_each_other() -> None:
    graph = {name_of(path): imported(path)[0] for path in modules()}
    assert len(graph) > 30
    TopologicalSorter(graph).prepare()  # raises CycleError


def strings(tree: ast.Module) -> Iterator[ast.Constant]:
    """Yield the strings of a module except its docstrings."""
    docs = {
        id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docs:
            yield node


def names_in(tree: ast.ClassDef) -> set[str]:
    """Return the private names that a class gives to its methods and attributes."""
    names = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    for node in ast.walk(tree):
        own = isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store) and ast.unparse(node.value) == "self"
        names |= {node.attr} if own else set()
    return {name for name in names if name.startswith("_") and not name.startswith("__")}


def test_no_class_takes_a_private_name_of_a_class_that_it_inherits() -> None:
    trees = [ast.parse(path.read_text(encoding="utf-8")) for path in modules()]
    classes = {node.name: node for tree in trees for node in ast.walk(tree) if isinstance(node, ast.ClassDef)}

    def inherited(node: ast.ClassDef) -> Iterator[ast.ClassDef]:
        for base in node.bases:
            above = classes.get(ast.unparse(base).split(".")[-1])
            if above is not None:
                yield above
                yield from inherited(above)

    taken = {
        f"{node.name}.{name} of {above.name}"
        for node in classes.values()
        for above in inherited(node)
        for name in names_in(node) & names_in(above)
    }
    assert taken == set()


READERS = {"read", "refresh", "follow", "follow_pose", "poll", "to_mesh", "from_edit_mesh", "hover", "aim", "show"} | {
    "column",
    "edit_bmesh",
    "auto_for",
}
"""Functions that read a mesh, or ask for work."""


def is_property(node: ast.FunctionDef) -> bool:
    return any(ast.unparse(one).split(".")[-1] in {"property", "cached_property"} for one in node.decorator_list)


def test_no_property_sets_anything_or_reads_a_mesh() -> None:
    found = []
    for path in modules():
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.FunctionDef) and is_property(node):
                for inner in ast.walk(node):
                    sets = isinstance(inner, ast.Attribute) and not isinstance(inner.ctx, ast.Load)
                    if sets or (isinstance(inner, ast.Call) and ast.unparse(inner.func).split(".")[-1] in READERS):
                        found.append(f"{name_of(path)}.{node.name}: {ast.unparse(inner)}")
    assert found == []


def told(node: ast.AST) -> Iterator[str]:
    """Yield how each text begins that a call may tell the artist."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.value
    elif isinstance(node, ast.JoinedStr):
        if isinstance(node.values[0], ast.Constant):
            yield node.values[0].value
    elif isinstance(node, (ast.IfExp, ast.BoolOp)):
        for part in (node.body, node.orelse) if isinstance(node, ast.IfExp) else node.values:
            yield from told(part)


def test_what_the_artist_is_told_are_sentences_where_they_are_sent() -> None:
    sent = {"Refused", "ValueError", "refuse", "tell"}
    found = []
    for path in (*modules(), *sorted(NETWORKS.rglob("*.py")), *sorted(LAB.rglob("*.py"))):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.Call) or not node.args:
                continue
            if getattr(node.func, "id", getattr(node.func, "attr", "")) in sent:
                found += [(path.name, text) for text in told(node.args[0])]
    assert len(found) > 60
    codes = [(name, text) for name, text in found if text and not (text[0].isupper() and " " in text)]
    assert not codes


def defined(path: Path) -> set[str]:
    """Return the names that a module has at its top, those that it imports too."""
    body = list(ast.parse(path.read_text(encoding="utf-8")).body)
    body += [node for own in body if isinstance(own, (ast.If, ast.Try)) for node in own.body]
    found = set()
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found.add(node.name)
        elif isinstance(node, (ast.Import, ast.ImportFrom)):
            found.update(name.asname or name.name for name in node.names)
        elif isinstance(node, (ast.Assign, ast.AnnAssign)):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            found.update(name.id for target in targets for name in ast.walk(target) if isinstance(name, ast.Name))
    return found


def test_what_runs_in_blender_imports_what_there_is() -> None:
    top = ROOT.parents[1]
    folders = (top / "blender_tests", top / "docs", top / "addon/bench", top / "native", top / "scripts", BATCH)
    missing, count = [], 0
    for path in (path for folder in folders for path in sorted(folder.rglob("*.py"))):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            name = getattr(node, "module", None) or ""
            if not isinstance(node, ast.ImportFrom) or name.split(".")[0] not in {
                "seamwire",
                "seamwire_networks",
                "seamwire_lab",
            }:
                continue
            count += 1
            place = ROOT.parent / name.replace(".", "/")
            module = place.with_suffix(".py") if place.with_suffix(".py").exists() else place / "__init__.py"
            names = defined(module) if module.exists() else set()
            missing += [
                f"{path.relative_to(top)}: {name}.{one.name}"
                for one in node.names
                if one.name not in names and not ((place / one.name).is_dir() or (place / f"{one.name}.py").exists())
            ]
    assert count > 100
    assert missing == []
