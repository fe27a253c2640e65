# SPDX-License-Identifier: GPL-3.0-or-later
"""How the compiled part is found, and the message if it is missing."""

from __future__ import annotations

import gc
import sys
import sysconfig
import weakref
from collections.abc import Iterator
from pathlib import Path

import pytest
from seamwire.core.base import native


@pytest.fixture(autouse=True)
def nothing_installed() -> Iterator[None]:
    """Begin without the module, whatever is installed beside the tests; leave none behind."""
    # Not the tests' own monkeypatch: what it remembers of the path at its first syspath_prepend is the shortened one.
    with pytest.MonkeyPatch.context() as patch:
        patch.delitem(sys.modules, native.NAME, raising=False)
        patch.setattr(sys, "path", [entry for entry in sys.path if not list(Path(entry).glob(f"{native.NAME}*"))])
        yield
        sys.modules.pop(native.NAME, None)


def test_an_installed_module_comes_first(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("installed", "own"):
        (tmp_path / name).mkdir()
        (tmp_path / name / f"{native.NAME}.py").write_text(f"where = '{name}'\n")
    before = list(sys.path)
    assert native.load(tmp_path / "own").where == "own"
    assert sys.path == before
    sys.modules.pop(native.NAME)
    monkeypatch.syspath_prepend(tmp_path / "installed")
    assert native.load(tmp_path / "own").where == "installed"


def test_importing_keeps_no_caller_in_memory(tmp_path: Path) -> None:
    (tmp_path / f"{native.NAME}.py").write_text("")

    class Held:
        """The files that a caller has made."""

    def call() -> weakref.ref[Held]:
        held = Held()
        native.load(tmp_path)
        return weakref.ref(held)

    gc.disable()
    try:
        assert call()() is None
    finally:
        gc.enable()


def test_without_the_module_the_sentence_says_what_to_install(tmp_path: Path) -> None:
    before = list(sys.path)
    with pytest.raises(native.NativeError, match="is missing: install the Seamwire package made for Python 3"):
        native.load(tmp_path / "none")
    assert sys.path == before


@pytest.mark.parametrize("name", ["seamwire_core.cpython-399-x86_64-linux-gnu.so", "seamwire_core.cp27-win_amd64.pyd"])
def test_a_module_for_another_python_is_named(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_bytes(b"")
    with pytest.raises(native.NativeError, match="built for another Python or system") as raised:
        native.load(tmp_path)
    assert name in str(raised.value)
    assert f"Python {sys.version_info.major}.{sys.version_info.minor}" in str(raised.value)


def test_a_module_that_does_not_load_says_why(tmp_path: Path) -> None:
    (tmp_path / f"{native.NAME}{sysconfig.get_config_var('EXT_SUFFIX')}").write_bytes(b"no library")
    with pytest.raises(native.NativeError, match="does not load in this Blender"):
        native.load(tmp_path)


def test_what_the_module_itself_misses_is_said(tmp_path: Path) -> None:
    (tmp_path / f"{native.NAME}.py").write_text("import a_library_that_is_not_there\n")
    with pytest.raises(native.NativeError, match="a_library_that_is_not_there"):
        native.load(tmp_path)


def test_an_extension_takes_what_blender_installed_and_puts_nothing_on_the_path(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(native, "IS_EXTENSION", True)
    (tmp_path / f"{native.NAME}.py").write_text("")
    before = list(sys.path)
    with pytest.raises(native.NativeError, match="is missing"):
        native.load(tmp_path, tmp_path / "wheels")
    assert sys.path == before
    assert [path.name for path in tmp_path.iterdir()] == [f"{native.NAME}.py"], "nothing is unpacked"
    monkeypatch.syspath_prepend(tmp_path)
    assert Path(native.load().__file__).parent == tmp_path


def test_a_fitting_wheel_that_blender_has_not_installed_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(native, "IS_EXTENSION", True)
    system = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    wheel = f"{native.NAME}-1.0-{python}-{python}-{system}.whl"
    for name in (wheel, f"{native.NAME}-1.0-cp27-cp27-{system}.whl"):
        (tmp_path / name).touch()
    with pytest.raises(native.NativeError, match="disable and enable the add-on") as raised:
        native.load(tmp_path / "none", tmp_path)
    assert wheel in str(raised.value)
