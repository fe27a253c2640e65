# SPDX-License-Identifier: GPL-3.0-or-later
"""One asset in a separate process, so that its faults hurt no other asset."""

from __future__ import annotations

import contextlib
import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
import threading
import time
from pathlib import Path
from typing import Any

from .jobs import PARTS, Job, Machine, stamp_of

WORKER = Path(__file__).with_name("worker.py")
_LOG_LINES = 40
_NO_MEMORY = re.compile(
    r"MemoryError|[Mm]alloc returns null|bad_alloc|Unable to allocate|Out of memory|Cannot allocate memory"
    r"|thread constructor failed|can't start new thread"
)
"""What Blender, NumPy, Python and C++ say where there is no memory left, before they end or of what failed for it."""

_running: set[subprocess.Popen] = set()
_lock = threading.Lock()


def stop_all() -> None:
    """End all that this process has started."""
    with _lock:
        for process in _running:
            _end(process)


def run(job: Job, fingerprint: str) -> dict[str, Any]:
    """Work on one asset and return its record; its files are there whole, or not at all.

    Parameters
    ----------
    job
        The asset.
    fingerprint
        Of the options.
    """
    out = Path(job.out)
    began = time.monotonic()
    record = _record(job, fingerprint)
    with _folder(out) as folder:
        status, result = start(job.machine, job.told(folder), folder)
        if status == "done":
            target = out / Path(job.name).parent
            target.mkdir(parents=True, exist_ok=True)
            made = sorted(file for file in folder.iterdir() if file.name not in {"job.json", "log.txt", "result.json"})
            # The asset itself comes last: where it is, all of it is.
            for file in sorted(made, key=lambda file: file.name == job.output):
                file.replace(target / file.name)
    record |= {"status": status, "seconds": round(time.monotonic() - began, 2), **result}
    return record


def lost(job: Job, fingerprint: str, why: str) -> dict[str, Any]:
    """Return the record of an asset of which nothing came back."""
    return {**_record(job, fingerprint), "status": "crashed", "seconds": 0.0, "error": why, "warnings": []}


def _record(job: Job, fingerprint: str) -> dict[str, Any]:
    return {"name": job.name, "asset": job.asset, "options": fingerprint, "stamp": stamp_of(Path(job.asset))}


class _folder:  # noqa: N801 - reads as a statement
    """A temporary folder among the results."""

    def __init__(self, out: Path) -> None:
        (out / PARTS).mkdir(parents=True, exist_ok=True)
        self._path = Path(tempfile.mkdtemp(dir=out / PARTS))

    def __enter__(self) -> Path:
        return self._path

    def __exit__(self, *_: object) -> None:
        shutil.rmtree(self._path, ignore_errors=True)


def start(machine: Machine, told: dict[str, Any], folder: Path) -> tuple[str, dict[str, Any]]:
    """Have the worker do something, and return how that ended and what it says of it.

    Returns
    -------
    status
        ``done``; ``failed``: it says why; ``crashed``, ``hung``, ``memory``: a fault, the time limit or
        a lack of memory ended it.
    result
        The worker's answer, with at least `error` and `warnings`.
    """
    (folder / "job.json").write_text(json.dumps(told), encoding="utf-8")
    with (folder / "log.txt").open("wb") as log:
        try:
            process = subprocess.Popen(
                [*machine.command, str(WORKER), "--", str(folder / "job.json")],
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
        except OSError as error:
            return "failed", {"error": f"Blender does not start: {error}", "warnings": []}
        with _lock:
            _running.add(process)
        try:
            code = process.wait(machine.limit)
        except subprocess.TimeoutExpired:
            return "hung", {"error": f"Not finished after {machine.limit:g} s", "warnings": []}
        finally:
            # Its own children too, on whatever way it ended.
            _end(process)
            process.wait()
            with _lock:
                _running.discard(process)
    try:
        result = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        text = (folder / "log.txt").read_text(encoding="utf-8", errors="replace")
        last = "\n".join(text.strip().splitlines()[-_LOG_LINES:])
        if _is_too_much(text, machine):
            return "memory", {"error": f"More than {machine.memory} MB", "warnings": [], "log": last}
        how = f"signal {signal.Signals(-code).name}" if code < 0 else f"exit code {code}"
        return "crashed", {"error": f"Blender ended with {how}", "warnings": [], "log": last}
    if result["error"] == "Out of memory":
        return "memory", result
    if result["error"] and _is_too_much(result["error"], machine):
        return "memory", {**result, "error": f"More than {machine.memory} MB", "log": result["error"]}
    return ("failed" if result["error"] else "done"), result


def _is_too_much(said: str, machine: Machine) -> bool:
    return bool(machine.memory and _NO_MEMORY.search(said))


def _end(process: subprocess.Popen) -> None:
    with contextlib.suppress(ProcessLookupError, PermissionError):
        if hasattr(os, "killpg"):
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()
