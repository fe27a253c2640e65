# SPDX-License-Identifier: GPL-3.0-or-later
"""The command ``seamwire-batch``."""

from __future__ import annotations

import argparse
import os
import re
import shlex
import shutil
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import Any

from . import process, tables
from .jobs import PARTS, Job, Journal, Machine, SeamOptions, UsageError, find_assets, is_done, read_list

EPILOG = """\
Exit codes: 0 if all assets are done, 1 if some are not and the table says why, 2 if nothing was begun. A run that was ended goes on when it
is started again. Finished assets are left alone unless the asset, the network, the source or the options have changed. Failed assets are
left alone unless --retry is given. Assets are never written to.
"""
_ON_PICTURES = 200
"""The most assets on one contact sheet."""


def parser() -> argparse.ArgumentParser:
    """Return what reads the command line."""
    command = argparse.ArgumentParser(
        prog="seamwire-batch",
        description="Seams, islands and UV maps for many files, one Blender process each.",
        epilog=EPILOG,
    )
    command.add_argument("assets", nargs="*", help="files (.blend .obj .fbx .glb .ply .stl) and folders of such")
    command.add_argument("--list", metavar="FILE", help="a file with more of them, one a line")
    command.add_argument("--out", metavar="FOLDER", required=True, help="where results go")
    command.add_argument("--recursive", action="store_true", help="folders in folders too")
    ways = command.add_argument_group("where seams come from, one of")
    ways.add_argument("--network", metavar="FILE", help="a network saved by Blender")
    ways.add_argument("--source", metavar="FILE", help="an asset that has seams")
    ways.add_argument(
        "--mark", metavar="NAME=VALUE", action="append", help="an argument of seamwire.mark, as JSON; repeat it"
    )
    ways.add_argument(
        "--suggest",
        metavar="NAME=VALUE",
        action="append",
        help="an argument of mesh.seamwire_suggest; repeat it; - for none",
    )
    how = command.add_argument_group("how")
    how.add_argument(
        "--unwrap",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="an argument of mesh.seamwire_unwrap; repeat it",
    )
    how.add_argument(
        "--place", choices=("auto", "numbers", "surface", "pairs"), default="auto", help="how seeds are placed"
    )
    how.add_argument(
        "--pairs", metavar="'A-B ...'", default="", help="vertices of source and asset that are the same point"
    )
    how.add_argument("--mirror", choices=("x", "y", "z"), help="mirror the network first")
    how.add_argument("--no-align", action="store_true", help="take networks where they lie")
    how.add_argument("--object", default="", help="the object that gets the seams, in files with several")
    how.add_argument(
        "--format",
        choices=("blend", "obj", "fbx", "glb", "ply"),
        default="",
        help="what is written, if not the same again",
    )
    how.add_argument("--no-pictures", action="store_true", help="render none")
    how.add_argument("--picture-size", metavar="PIXELS", type=_positive, default=240, help="the side of each (240)")
    what = command.add_argument_group("with what")
    what.add_argument(
        "--blender",
        metavar="COMMAND",
        default=os.environ.get("BLENDER", "blender"),
        help="Blender ($BLENDER or blender)",
    )
    what.add_argument("--bpy", action="store_true", help="this Python's module bpy in Blender's place")
    what.add_argument(
        "--addon",
        metavar="FOLDER",
        default="",
        help="the folder that has the add-ons' folders, if they are not installed",
    )
    what.add_argument("--engine", choices=("here", "dask"), default="here", help="what works on the assets (here)")
    what.add_argument("--scheduler", metavar="ADDRESS", default="", help="of Dask, such as tcp://10.0.0.1:8786")
    what.add_argument(
        "--shard", metavar="I/N", type=_shard, default=(0, 0), help="the Ith of N runs with one --out: without tables"
    )
    what.add_argument("--jobs", metavar="N", type=_positive, default=1, help="how many at once (1)")
    what.add_argument("--limit", metavar="SECONDS", type=float, default=600.0, help="most time for an asset (600)")
    what.add_argument(
        "--memory", metavar="MB", type=int, default=0, help="most memory for an asset beside Blender's own (Linux)"
    )
    what.add_argument("--retry", action="store_true", help="try again what failed before")
    what.add_argument("--fresh", action="store_true", help="begin anew, whatever is done already")
    return command


def _positive(text: str) -> int:
    number = int(text)
    if number < 1:
        raise ValueError
    return number


def _shard(text: str) -> tuple[int, int]:
    number, count = (int(part) for part in text.split("/"))
    if not 1 <= number <= count:
        raise ValueError
    return number, count


def options_of(arguments: argparse.Namespace) -> SeamOptions:
    """Return the options of a run; raises UsageError."""
    ways = [way for way in ("network", "source", "mark", "suggest") if getattr(arguments, way)]
    if len(ways) != 1:
        raise UsageError("Say where seams come from: one of --network, --source, --mark, --suggest")
    (way,) = ways
    texts = getattr(arguments, way) if way in {"mark", "suggest"} else []
    given = _values(way, [text for text in texts if (way, text) != ("suggest", "-")])
    for name in ("network", "source"):
        if getattr(arguments, name) and not Path(getattr(arguments, name)).is_file():
            raise UsageError(f"--{name}: there is no file {getattr(arguments, name)}")
    pairs = []
    for text in arguments.pairs.split():
        match = re.fullmatch(r"(\d+)-(\d+)", text)
        if match is None:
            raise UsageError(f"--pairs: '{text}' is not a pair of vertices such as 7-12")
        pairs.append((int(match[1]), int(match[2])))
    if arguments.place == "pairs" and way != "source":
        raise UsageError("--place pairs needs --source: distances are those on the mesh that has the seams")
    return SeamOptions(
        way,
        network=str(Path(arguments.network).resolve()) if arguments.network else "",
        source=str(Path(arguments.source).resolve()) if arguments.source else "",
        arguments=given,
        place=arguments.place.upper(),
        mirror=None if arguments.mirror is None else "xyz".index(arguments.mirror),
        align=not arguments.no_align,
        pairs=tuple(pairs),
        unwrap=_values("unwrap", arguments.unwrap),
        object=arguments.object,
        format=arguments.format,
        pictures=not arguments.no_pictures,
        size=arguments.picture_size,
    )


def _values(option: str, texts: Sequence[str]) -> dict[str, str]:
    """Return the values by their names; raises UsageError."""
    values: dict[str, str] = {}
    for text in texts:
        key, equals, value = text.partition("=")
        if not equals:
            raise UsageError(f"--{option} {text}: give NAME=VALUE")
        values[key] = value
    return values


def machine_of(arguments: argparse.Namespace) -> Machine:
    """Return what assets are worked on with; raises UsageError."""
    if arguments.bpy:
        command: tuple[str, ...] = (sys.executable,)
    else:
        words = shlex.split(arguments.blender)
        if not words or shutil.which(words[0]) is None:
            raise UsageError(f"There is no Blender '{arguments.blender}': name one with --blender")
        command = (*words, "--background", "--factory-startup", "--python-exit-code", "3", "--python")
    if arguments.memory and not sys.platform.startswith("linux"):
        raise UsageError("--memory works on Linux only")
    addon = str(Path(arguments.addon).resolve()) if arguments.addon else ""
    for name in ("seamwire", "seamwire_networks"):
        if addon and not (Path(addon) / name / "__init__.py").is_file():
            raise UsageError(f"--addon: there is no folder {name} in {arguments.addon}")
    return Machine(command, addon, arguments.limit, arguments.memory)


Engine = Callable[[Sequence[Job], str], Iterator[dict[str, Any]]]
"""Works on assets and yields their records as they come."""


def on_this_machine(at_once: int) -> Engine:
    """Return what works on so many assets at once here."""

    def work(jobs: Sequence[Job], fingerprint: str) -> Iterator[dict[str, Any]]:
        pool = ThreadPoolExecutor(at_once)
        try:
            waiting = [pool.submit(process.run, job, fingerprint) for job in jobs]
            for done in as_completed(waiting):
                yield done.result()
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
            process.stop_all()

    return work


def on_dask(scheduler: str) -> Engine:
    """Return what works on assets on a Dask cluster, whose workers see the same files by the same names and have this package.

    Where a worker is lost, Dask gives its asset to another one.
    """
    try:
        from distributed import Client, as_completed
    except ImportError as error:
        raise UsageError("--engine dask needs Dask: pip install seamwire-batch[dask]") from error
    if not scheduler:
        raise UsageError("--engine dask needs --scheduler")
    try:
        client = Client(scheduler, timeout=20, set_as_default=False)
    except (OSError, ValueError) as error:
        raise UsageError(f"--scheduler {scheduler}: {error}") from error

    def work(jobs: Sequence[Job], fingerprint: str) -> Iterator[dict[str, Any]]:
        with client:
            futures = client.map(process.run, jobs, [fingerprint] * len(jobs), pure=False)
            job_of = dict(zip(futures, jobs, strict=True))
            # Held by their names alone: what is done need not be kept until all are.
            del futures
            for future in as_completed(job_of):
                job = job_of.pop(future)
                try:
                    record = future.result()
                except Exception as error:  # any fault of the cluster costs only that asset
                    record = process.lost(job, fingerprint, f"{type(error).__name__}: {error}")
                yield record

    return work


def read_source(options: SeamOptions, machine: Machine, out: Path, name: str) -> dict[str, str]:
    """Make networks of the objects of a source asset, in a separate Blender; return their files' stems by the objects' names."""
    folder = out / PARTS / f"source-{name}"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    told = {
        "kind": "source",
        "asset": options.source,
        "folder": str(folder),
        "addon": machine.addon,
        "memory": machine.memory,
    }
    status, result = process.start(machine, told, folder)
    if status != "done":
        raise UsageError(f"--source {options.source}: {result['error']}")
    return {name: str(folder / stem) for name, stem in result["sources"].items()}


def write_tables(out: Path, records: Sequence[dict[str, Any]], machine: Machine, sheet: bool) -> None:
    """Write the tables, and the contact sheet."""
    tables.write(out / "results.csv", tables.as_csv(records))
    if sheet:
        pictures = [str(path) for one in records if (path := out / f"{one['name']}.png").is_file()][:_ON_PICTURES]
        folder = out / PARTS / "sheet"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        if pictures:
            status, result = process.start(
                machine, {"kind": "sheet", "pictures": pictures, "folder": str(folder)}, folder
            )
            if status == "done":
                (folder / "sheet.png").replace(out / "sheet.png")
            else:
                print(f"No contact sheet: {result['error']}", file=sys.stderr)
    tables.write(out / "results.md", tables.as_markdown(records, out))


def work(arguments: argparse.Namespace) -> int:
    """Do what was asked for; return the exit code."""
    options, machine = options_of(arguments), machine_of(arguments)
    engine = on_dask(arguments.scheduler) if arguments.engine == "dask" else on_this_machine(arguments.jobs)
    out = Path(arguments.out).resolve()
    given = list(arguments.assets)
    if arguments.list:
        given += read_list(Path(arguments.list))
    assets = find_assets(given, out, arguments.recursive)
    if not assets:
        raise UsageError("There are no assets: name files or folders of .blend, .obj, .fbx, .glb, .ply or .stl")
    for path, name in assets:
        if (out / Path(name).parent).resolve() == path.parent:
            raise UsageError(f"Results would lie beside the asset {path}: choose another --out")
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"--out: {error}") from error
    shard, shards = arguments.shard
    journal = Journal(out, shard)
    records = {} if arguments.fresh else journal.read()
    if not shard:
        # The remains of a run that was killed.
        shutil.rmtree(out / PARTS, ignore_errors=True)
    fingerprint = options.fingerprint()
    jobs = [Job(str(path), name, str(out), options, machine) for path, name in assets]
    if shard:
        jobs = jobs[shard - 1 :: shards]
    left = [job for job in jobs if not is_done(records.get(job.name), job, fingerprint, arguments.retry)]
    if len(left) < len(jobs):
        print(f"{len(jobs) - len(left)} of {len(jobs)} assets were worked on before", flush=True)
    if left and options.way == "source":
        sources = read_source(options, machine, out, str(shard))
        left = [Job(job.asset, job.name, job.out, options, machine, sources) for job in left]
    for number, record in enumerate(engine(left, fingerprint), start=1):
        journal.add(record)
        records[record["name"]] = record
        print(f"[{number}/{len(left)}] {record['name']}: {_line(record)}", flush=True)
    if shard:
        # Failures are for the run that makes the tables to tell.
        return 0
    ours = [records[job.name] for job in jobs]
    write_tables(out, ours, machine, options.pictures)
    shutil.rmtree(out / PARTS, ignore_errors=True)
    failures = sum(record["status"] != "done" for record in ours)
    print(f"{len(ours) - failures} done, {failures} not; {out / 'results.md'}")
    return 1 if failures else 0


def _line(record: dict[str, Any]) -> str:
    if record["status"] != "done":
        return f"{record['status']} after {record['seconds']} s: {record['error']}"
    warned = f", {len(record['warnings'])} warnings" if record["warnings"] else ""
    return f"{record['seams']} seams, {record['islands']} islands, stretch {record['angle']:.2f}, {record['seconds']} s{warned}"


def main(words: Sequence[str] | None = None) -> int:
    """Run the command."""
    arguments = parser().parse_intermixed_args(words)
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="backslashreplace")  # file names may have any bytes

    def ended(number: int, _frame: object) -> None:
        raise SystemExit(128 + number)

    before = signal.signal(signal.SIGTERM, ended)
    try:
        return work(arguments)
    except UsageError as error:
        print(f"seamwire-batch: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("Ended; start it again to go on", file=sys.stderr)
        return 130
    finally:
        process.stop_all()
        signal.signal(signal.SIGTERM, before)


if __name__ == "__main__":
    sys.exit(main())
