# SPDX-License-Identifier: GPL-3.0-or-later
"""What there is to do, and the journal of what was done."""

from __future__ import annotations

import codecs
import hashlib
import json
import os
import re
import time
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

SUFFIXES = (".blend", ".obj", ".fbx", ".glb", ".ply", ".stl")
PARTS = ".parts"
"""The folder in the results where assets are worked on; what is left of a run that was killed lies there, and counts for nothing."""


class UsageError(Exception):
    """The request cannot be fulfilled; the text is a sentence."""


@dataclass(frozen=True)
class SeamOptions:
    """How seams are made, the same for all assets of a run: see `cli` for what each means."""

    way: str
    network: str = ""
    source: str = ""
    arguments: dict[str, str] = field(default_factory=dict)
    place: str = "AUTO"
    mirror: int | None = None
    align: bool = True
    pairs: tuple[tuple[int, int], ...] = ()
    unwrap: dict[str, str] = field(default_factory=dict)
    object: str = ""
    format: str = ""
    pictures: bool = True
    size: int = 240
    samples: int = 8

    def fingerprint(self) -> str:
        """Return a text that is another one where results would be; files count by what is in them."""
        told = asdict(self)
        for name in ("network", "source"):
            path = told[name]
            told[name] = hashlib.sha256(Path(path).read_bytes()).hexdigest() if path else ""
        return hashlib.sha256(json.dumps(told, sort_keys=True).encode()).hexdigest()[:16]


@dataclass(frozen=True)
class Machine:
    """What assets are worked on with.

    Parameters
    ----------
    command
        What starts Blender, to which the worker and the job are added.
    addon
        The folder that has the add-on's; empty: it is installed.
    limit
        Seconds an asset may take.
    memory
        Megabytes it may take beside what Blender has at its start; 0: as many as there are.
    """

    command: tuple[str, ...]
    addon: str = ""
    limit: float = 600.0
    memory: int = 0


@dataclass(frozen=True)
class Job:
    """One asset.

    Parameters
    ----------
    asset
        The file.
    name
        Where its results go, relative to the folder of results: the asset's own path below the folder that was given.
    out
        The folder of results.
    options, machine
        How and with what.
    sources
        Of a source asset, the stems of the files that were made of its objects.
    """

    asset: str
    name: str
    out: str
    options: SeamOptions
    machine: Machine
    sources: dict[str, str] = field(default_factory=dict)

    @property
    def output(self) -> str:
        """The name of the file that is written: with the asset's ending where that format knows UV maps."""
        suffix = Path(self.asset).suffix.lower()
        wanted = f".{self.options.format}" if self.options.format else ".blend" if suffix == ".stl" else suffix
        name = Path(self.name).name
        return name if wanted == suffix else f"{name}{wanted}"

    def told(self, folder: Path) -> dict[str, Any]:
        """Return it as the worker reads it."""
        return {
            **asdict(self.options),
            "kind": "asset",
            "asset": self.asset,
            "name": Path(self.name).name,
            "output": self.output,
            "folder": str(folder),
            "addon": self.machine.addon,
            "memory": self.machine.memory,
            "sources": self.sources,
        }


def find_assets(given: Iterable[str], out: Path, recursive: bool) -> list[tuple[Path, str]]:
    """Return files and the names of their results, in the order given, those of a folder by name.

    Parameters
    ----------
    given
        Files and folders.
    out
        The folder of results: what is in there is no asset.
    recursive
        Whether folders in folders are looked into.

    Raises
    ------
    UsageError
        Where one is not there or no asset, two would have the same results, or results would be written over assets.
    """
    found: dict[str, Path] = {}
    for text in given:
        path = Path(text).resolve()
        if path.is_dir():
            files = path.rglob("*") if recursive else path.iterdir()
            some = [(file, file.relative_to(path).as_posix()) for file in sorted(files) if _is_asset(file)]
        elif path.suffix.lower() not in SUFFIXES:
            raise UsageError(f"{text}: neither a folder nor one of {', '.join(SUFFIXES)}")
        else:
            some = [(path, path.name)]  # a missing asset fails alone, in the table
        for file, name in some:
            if out in file.parents:
                if path.is_dir():
                    continue
                raise UsageError(f"{text} lies in the folder of results")
            if found.setdefault(name, file) != file:
                raise UsageError(
                    f"{file} and {found[name]} would have the same results: run them into different folders"
                )
    return [(file, name) for name, file in found.items()]


def read_list(path: Path) -> list[str]:
    """Return the assets that a text file names, one on each line, in quotes or not. Raise UsageError if it cannot be read.

    The text is UTF-8 or UTF-16. In UTF-8, file names may have any bytes.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise UsageError(f"--list: {error}") from error
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        encoding = "utf-16"
    elif b"\0" in data:  # the first letter of a path is one of ASCII in most cases
        encoding = "utf-16-be" if data.startswith(b"\0") else "utf-16-le"
    else:
        encoding = "utf-8-sig"
    try:
        text = data.decode(encoding, errors="surrogateescape" if encoding == "utf-8-sig" else "strict")
    except UnicodeDecodeError:
        text = "\0"
    if "\0" in text:
        raise UsageError(f"--list {path}: this is not a text. Save it as UTF-8")
    lines = [line.strip() for line in re.split(r"[\r\n]+", text)]
    quoted = (re.fullmatch(r"([\"'])(.+)\1", line) for line in lines)
    names = [line if match is None else match[2] for line, match in zip(lines, quoted, strict=True)]
    return [name for name in names if name]


def _is_asset(path: Path) -> bool:
    return path.suffix.lower() in SUFFIXES and path.is_file() and not path.name.startswith(".")


def stamp_of(path: Path) -> str:
    """Return what tells whether a file has changed; an empty text: it is not there."""
    try:
        status = path.stat()
    except OSError:
        return ""
    return f"{status.st_size}-{status.st_mtime_ns}"


class Journal:
    """The record of a run, a line of JSON for each asset: a run that was killed has lost at most its last line.

    Parameters
    ----------
    out
        The folder of results.
    shard
        The number of this run among several at once, each of which writes a separate file; 0 for a single run.
    """

    def __init__(self, out: Path, shard: int = 0) -> None:
        self._out = out
        self._path = out / (f"journal-{shard}.jsonl" if shard else "journal.jsonl")

    def read(self) -> dict[str, dict[str, Any]]:
        """Return the last record of each asset, by the names of their results, whichever run wrote it."""
        records: dict[str, dict[str, Any]] = {}
        for path in sorted(self._out.glob("journal*.jsonl")):
            for line in path.read_text(encoding="utf-8", errors="replace").split("\n"):
                try:
                    record = json.loads(line)
                    if record["time"] >= records.get(record["name"], record)["time"]:
                        records[record["name"]] = record
                except (ValueError, KeyError, TypeError):
                    continue  # the line that was being written
        return records

    def add(self, record: dict[str, Any]) -> None:
        """Write a record to the disk, on a new line also behind a torn one."""
        record = {**record, "time": time.time()}
        with self._path.open("ab+") as file:
            torn = file.tell() > 0 and self._last(file) != b"\n"
            file.write((b"\n" if torn else b"") + json.dumps(record, sort_keys=True).encode() + b"\n")
            file.flush()
            os.fsync(file.fileno())

    @staticmethod
    def _last(file: Any) -> bytes:  # noqa: ANN401 - a binary file
        file.seek(-1, os.SEEK_END)
        return file.read(1)


def is_done(record: dict[str, Any] | None, job: Job, fingerprint: str, retry: bool) -> bool:
    """Whether a record is of this asset as it is, made in this way, and its file is there still; failures count unless `retry`."""
    if record is None or record.get("options") != fingerprint or record.get("stamp") != stamp_of(Path(job.asset)):
        return False
    if record["status"] != "done":
        return not retry
    return (Path(job.out) / Path(job.name).parent / job.output).is_file()
