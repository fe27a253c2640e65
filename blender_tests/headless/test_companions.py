# SPDX-License-Identifier: GPL-3.0-or-later
"""Seamwire Lab and Seamwire Networks join Seamwire in whatever order they are enabled, and leave with it."""

from __future__ import annotations

import sys
from collections.abc import Iterator

import addon_utils
import bpy
import pytest
import traces
from fresh import run_fresh
from scene import ADDON
from seamwire.ui import companions

LAB, NETWORKS = f"{ADDON}_lab", f"{ADDON}_networks"
OPERATORS = {
    LAB: ("lab_store",),
    NETWORKS: ("transfer", "repeat", "load_network", "save_network"),
}
pytestmark = [pytest.mark.every_blender, pytest.mark.parametrize("name", OPERATORS)]


@pytest.fixture(autouse=True)
def enabled(name: str) -> Iterator[None]:
    """Have the add-on enabled, and leave everything as it was."""
    was_there = addon_utils.check(name)[1]
    before = traces.traces()
    enable(name)
    yield
    enable(ADDON)
    enable(name) if was_there else disable(name)
    assert traces.difference(before, traces.traces()) == {}


def disable(name: str) -> None:
    addon_utils.disable(name, default_set=True)


def enable(name: str) -> None:
    assert addon_utils.enable(name, default_set=True) is not None


def is_there(name: str) -> bool:
    """Return whether its operators are registered, all or nothing."""
    (found,) = {hasattr(bpy.types, f"MESH_OT_seamwire_{operator}") for operator in OPERATORS[name]}
    return found


def test_it_comes_and_goes_with_itself_and_with_the_tool(name: str) -> None:
    assert is_there(name)
    disable(name)
    assert not is_there(name)
    enable(name)
    assert is_there(name)
    disable(ADDON)
    assert not is_there(name)
    assert traces.ours(traces.traces()) == []
    enable(ADDON)
    assert is_there(name)


def test_enabled_before_the_tool_it_waits(name: str) -> None:
    disable(name)
    disable(ADDON)
    enable(name)
    assert not is_there(name)
    enable(ADDON)
    assert is_there(name)


def test_disabled_without_the_tool_it_stays_away(name: str) -> None:
    disable(ADDON)
    disable(name)
    enable(ADDON)
    assert not is_there(name)


@pytest.mark.parametrize("is_first", [False, True])
def test_another_version_does_not_join_and_says_so(
    name: str, is_first: bool, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    disable(name)
    disable(ADDON)
    with monkeypatch.context() as patched:
        patched.setattr(sys.modules[name], "VERSION", (0, 0, 9))
        for addon in (name, ADDON) if is_first else (ADDON, name):
            enable(addon)
        assert not is_there(name)
        assert "update both" in capfd.readouterr().out
        disable(name)
    enable(name)
    assert is_there(name)


def test_after_an_update_of_the_tool_it_uses_the_new_one(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    addon = sys.modules[name]
    before = {module: sys.modules[module] for module in sys.modules if module.startswith(f"{name}.")}
    part = f"{name}.{addon.SEAMWIRE_PARTS[0]}"
    companions.leave(addon)
    monkeypatch.setattr(before[f"{name}.tool"], "interface", sys.modules[ADDON])  # stands for the old interface
    companions.join(addon)
    assert sys.modules[part] is not before[part]
    assert sys.modules[f"{name}.tool"].interface is sys.modules[f"{ADDON}.interface"]
    assert is_there(name)
    companions.leave(addon)
    monkeypatch.undo()
    for module, old in before.items():  # tests of other files know these
        sys.modules[module] = old
        setattr(addon, module.rpartition(".")[2], old)
    companions.join(addon)


def test_enabling_it_does_not_read_numpy(name: str) -> None:
    output = run_fresh(f"""
import sys
loaded = set(sys.modules)
for name in {(name, ADDON)!r}:
    enable(name)
print("Read:", *sorted(set(sys.modules) - loaded))
""")
    read = next(line for line in output.splitlines() if line.startswith("Read:"))
    assert f"{name}.{sys.modules[name].SEAMWIRE_PARTS[-1]}" in read
    assert "numpy" not in read, "Blender's start would wait for it"
