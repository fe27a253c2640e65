# SPDX-License-Identifier: GPL-3.0-or-later
"""A pytest plugin that tells `scripts/blender-test` how far the tests are, so that a crash of Blender loses nothing."""

from __future__ import annotations

import faulthandler
import os
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Iterator

SECONDS_A_TEST = 300
"""A test that takes longer hangs. The longest one waits for Blender's automatic save, which comes after a minute."""


class Progress:
    """Writes down which test runs and which tests failed.

    Parameters
    ----------
    folder
        Where to write. The file ``running`` names the test that runs; the file ``failed`` has a line for each failure.
    has_limit
        Whether the process ends, with the traceback of every thread, when a test takes longer than `SECONDS_A_TEST`.
    """

    def __init__(self, folder: Path, has_limit: bool) -> None:
        self._running = folder / "running"
        self._failed = folder / "failed"
        # Pytest redirects the standard error while a test runs.
        self._stderr = os.dup(2) if has_limit else None

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        """Name the test while it runs, and limit its time."""
        self._running.write_text(item.nodeid)
        if self._stderr is not None:
            faulthandler.dump_traceback_later(SECONDS_A_TEST, exit=True, file=self._stderr)
        result = yield
        faulthandler.cancel_dump_traceback_later()
        self._running.write_text("")
        return result

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Write a failed test down."""
        self._note(report)

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        """Write down a file that cannot be read."""
        self._note(report)

    def _note(self, report: pytest.TestReport | pytest.CollectReport) -> None:
        if report.failed:
            crash = getattr(report.longrepr, "reprcrash", None)
            message = str(report.longrepr) if crash is None else crash.message
            with self._failed.open("a") as file:
                file.write(f"FAILED {report.nodeid} - {message.strip().splitlines()[0]}\n")


class SharedFiles:
    """Shares files of tests with other Blenders: each file is run by the Blender that comes to it first.

    Parameters
    ----------
    folder
        The folder that these Blenders share. ``selected`` lists the files with selected tests; every file that a Blender
        has taken has an empty file of its name in ``taken``.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._own: dict[Path, bool] = {}

    def pytest_collection_finish(self, session: pytest.Sketch) -> None:
        """List the files that have selected tests."""
        names = sorted({item.path.name for item in session.items})
        (self._folder / "selected").write_text("".join(f"{name}\n" for name in names))

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> bool | None:
        """Run nothing of a file that another Blender has taken."""
        if item.path not in self._own:
            self._own[item.path] = self._take(item.path)
        return None if self._own[item.path] else True

    def _take(self, path: Path) -> bool:
        try:
            (self._folder / "taken" / path.name).touch(exist_ok=False)
        except FileExistsError:
            return False
        return True


def plugins(has_limit: bool) -> list[object]:
    """Return the plugins that `scripts/blender-test` asks for with SEAMWIRE_PROGRESS and SEAMWIRE_SHARED_FILES."""
    found: list[object] = []
    if folder := os.environ.get("SEAMWIRE_PROGRESS"):
        found.append(Progress(Path(folder), has_limit))
    if folder := os.environ.get("SEAMWIRE_SHARED_FILES"):
        found.append(SharedFiles(Path(folder)))
    return found
