# SPDX-License-Identifier: GPL-3.0-or-later
"""Seamwire Networks joins Seamwire in whatever order both are enabled, and leaves with it."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator

import addon_utils
import bpy
import pytest
import traces
from scene import ADDON
from seamwire.ui import companions

NETWORKS = f"{ADDON}_networks"
pytestmark = pytest.mark.every_blender


@pytest.fixture(autouse=True)
def both() -> Iterator[None]:
    """Leave both enabled, as they were."""
    before = traces.traces()
    yield
    for name in (ADDON, NETWORKS):
        assert addon_utils.enable(name, default_set=True) is not None
    assert traces.difference(before, traces.traces()) == {}


def disable(name: str) -> None:
    addon_utils.disable(name, default_set=True)


def enable(name: str) -> None:
    assert addon_utils.enable(name, default_set=True) is not None


def is_there() -> bool:
    """Return whether its operators are registered, all or nothing."""
    names = ("transfer", "repeat", "load_network", "save_network")
    (found,) = {hasattr(bpy.types, f"MESH_OT_seamwire_{name}") for name in names}
    return found


def test_it_comes_and_goes_with_itself_and_with_the_tool() -> None:
    assert is_there()
    disable(NETWORKS)
    assert not is_there()
    enable(NETWORKS)
    assert is_there()
    disable(ADDON)
    assert not is_there()
    assert traces.ours(traces.traces()) == []
    enable(ADDON)
    assert is_there()


def test_enabled_before_the_tool_it_waits() -> None:
    disable(NETWORKS)
    disable(ADDON)
    enable(NETWORKS)
    assert not is_there()
    enable(ADDON)
    assert is_there()


def test_disabled_without_the_tool_it_stays_away() -> None:
    disable(ADDON)
    disable(NETWORKS)
    enable(ADDON)
    assert not is_there()


@pytest.mark.parametrize("first", [ADDON, NETWORKS])
def test_another_version_does_not_join_and_says_so(
    first: str, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    disable(NETWORKS)
    disable(ADDON)
    with monkeypatch.context() as patched:
        patched.setattr(sys.modules[NETWORKS], "VERSION", (0, 0, 9))
        for name in (first, ({ADDON, NETWORKS} - {first}).pop()):
            enable(name)
        assert not is_there()
        assert "update both" in capfd.readouterr().out
        disable(NETWORKS)
    enable(NETWORKS)
    assert is_there()


def test_after_an_update_of_the_tool_it_uses_the_new_one(monkeypatch: pytest.MonkeyPatch) -> None:
    parts = [name for name in sys.modules if name.startswith(f"{NETWORKS}.")]
    before = {name: sys.modules[name] for name in parts}
    addon = sys.modules[NETWORKS]
    companions.leave(addon)
    monkeypatch.setattr(before[f"{NETWORKS}.tool"], "interface", sys.modules[ADDON])  # stands for the old interface
    companions.join(addon)
    assert sys.modules[f"{NETWORKS}.network_operators"] is not before[f"{NETWORKS}.network_operators"]
    assert sys.modules[f"{NETWORKS}.tool"].interface is sys.modules[f"{ADDON}.interface"]
    assert is_there()
    companions.leave(addon)
    monkeypatch.undo()
    sys.modules.update(before)  # tests of other files know these
    companions.join(addon)


def test_enabling_it_does_not_read_numpy() -> None:
    if not bpy.app.binary_path:
        pytest.skip("Blender as a Python module cannot be started again")
    code = f"""
import addon_utils, sys
loaded = set(sys.modules)
for name in {(NETWORKS, ADDON)!r}:
    assert addon_utils.enable(name) is not None
print("Read:", *sorted(set(sys.modules) - loaded))
"""
    command = [
        bpy.app.binary_path,
        "--background",
        "--factory-startup",
        "--python-exit-code",
        "3",
        "--python-expr",
        code,
    ]
    output = subprocess.run(command, check=True, capture_output=True, text=True, timeout=120).stdout
    read = next(line for line in output.splitlines() if line.startswith("Read:"))
    assert "network_operators" in read
    assert "numpy" not in read, "Blender's start would wait for it"
