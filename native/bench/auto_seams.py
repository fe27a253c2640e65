# SPDX-License-Identifier: GPL-3.0-or-later
"""Automatic seams beside an artist's and those of other methods, measured on the same models.

    python native/bench/auto_seams.py --models FOLDER [--peers FOLDER] [--maps FOLDER] [--only NAME...] [--along edges|surface]
        [--measure-only] [--json FILE] [--page FILE... [--tables NAME...]] [--sheets FOLDER [--blind]]

uv_maps.py describes the files of models and maps, and uv_measures.py the numbers. The folder of --peers has the maps of other methods,
NAME.METHOD.npz. The library plans and flattens our maps, each model in a separate process, and the program writes them to the folder of
--maps. With --measure-only it measures the maps that are there already.

These methods are ours:

- ours: the plan at the planner's default bound.
- tree: the slits that the planner begins with.
- ours 4.1: the plan at the bound of OptCuts, on models that have a map of OptCuts.
- ours as artist: the plan at the energy of the artist's own map, where the model's file has it.
- ours as artist flattened: the plan at the energy of the artist's seams, flattened by the library.
- artist: the artist's seams, flattened by the library.

"artist as published" is the artist's own map.

The program prints Markdown tables. They have our maps of each model, the seams of each model and method, the medians of all methods, and
the goals beside the results. --page replaces the tables of Markdown pages, between comments "begin NAME" and "end NAME". With --tables it
replaces only these.

--sheets draws a picture of each model with a row for each of the methods ours, artist, xatlas and optcuts. With --blind the rows are
shuffled and have letters instead of names. The file key.json in the same folder has the names. The program needs numpy, scipy, and
seamwire_core on the path. Sheets need matplotlib.
"""

from __future__ import annotations

import argparse
import json
import random
import sys
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path

import seam_planning
from auto_seams_report import (
    COMPARED,
    SECTIONS,
    Result,
    comparison_table,
    goal_table,
    median_table,
    model_table,
    tables_on,
    with_artist,
    with_tables,
)
from seam_planning import ARTIST, OURS, in_own_process
from uv_maps import Model, UvMap, read_frames
from uv_measures import Reference, measure
from uv_pictures import Row, draw_sheet

OPTCUTS, XATLAS = "optcuts", "xatlas"
OURS_AS_OPTCUTS, OURS_AS_ARTIST, OURS_AS_FLATTENED = "ours 4.1", "ours as artist", "ours as artist flattened"
PUBLISHED = "artist as published"
OPTCUTS_BOUND = 4.1
ON_SHEETS = (OURS, ARTIST, XATLAS, OPTCUTS)


def main() -> None:
    """Plan, measure, print and draw what the options say."""
    options = parsed_options()
    options.maps.mkdir(parents=True, exist_ok=True)
    frames = read_frames(options.models)
    results = []
    files = sorted(options.models.glob("*.npz"))
    chosen = [file for file in files if not options.only or file.stem in options.only]
    if not chosen:
        sys.exit(f"no models in {options.models}")
    for file in chosen:
        model = Model.read(file, frames.get(file.stem))
        print(f"{model.name}: {len(model.triangles)} triangles", file=sys.stderr, flush=True)
        reference = Reference(model)
        if not options.measure_only:
            plan(model, reference, options)
        maps = maps_of(model.name, [options.maps, *([options.peers] if options.peers else [])])
        if model.published_map is not None:
            maps[PUBLISHED] = model.published_map
        for method, uv_map in maps.items():
            size = len(model.triangles)
            results.append(
                Result(model.name, method, size, model.frame.is_hard, measure(uv_map, reference), uv_map.info)
            )
        if options.json:
            options.json.write_text(json.dumps([result.as_json() for result in results], indent=1) + "\n")
        if options.sheets:
            draw(model, maps, options.sheets, blind=options.blind)
    made = tables(results)
    print(*made.values(), sep="\n\n")
    for page in options.page:
        text = page.read_text(encoding="utf-8")
        names = [name for name in tables_on(text) if not options.tables or name in options.tables]
        page.write_text(with_tables(text, {name: made[name] for name in names}), encoding="utf-8")


def tables(results: list[Result]) -> dict[str, str]:
    """Return all tables of the results, by the names that pages have for them."""
    return {
        **{f"models-{section}": model_table(results, OURS, section) for section in SECTIONS},
        **{f"comparison-{name}": comparison_table(results, name) for name in COMPARED},
        **{f"methods-{section}": median_table(results, section) for section in SECTIONS},
        **{f"former-{section}": median_table(results, section, former=True) for section in SECTIONS},
        "artist-models-stretch": median_table(with_artist(results), "stretch"),
        "goals": goal_table(results),
    }


def parsed_options() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", type=Path, required=True, help="folder of models, NAME.npz")
    parser.add_argument("--peers", type=Path, help="folder of other methods' maps, NAME.METHOD.npz")
    parser.add_argument("--maps", type=Path, default=Path("build/bench/auto-seams"), help="folder for our maps")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="these models only")
    parser.add_argument("--along", choices=("edges", "surface"), default="edges")
    parser.add_argument("--measure-only", action="store_true", help="plan nothing")
    parser.add_argument("--json", type=Path, help="file for all numbers")
    parser.add_argument("--page", type=Path, nargs="+", default=[], help="Markdown pages whose tables are renewed")
    parser.add_argument("--tables", nargs="+", metavar="NAME", help="renew these tables only")
    parser.add_argument("--sheets", type=Path, help="folder for pictures")
    parser.add_argument("--blind", action="store_true", help="hide the methods' names in pictures")
    return parser.parse_args()


def maps_of(name: str, folders: list[Path]) -> dict[str, UvMap]:
    """Read the maps NAME.METHOD.npz of a model from folders, by method; the first folder that has one counts."""
    maps: dict[str, UvMap] = {}
    for folder in folders:
        for file in sorted(folder.glob(f"{name}.*.npz")):
            method = file.name.removeprefix(f"{name}.").removesuffix(".npz").replace("_", " ")
            maps.setdefault(method, UvMap.read(file))
    return maps


def plan(model: Model, reference: Reference, options: argparse.Namespace) -> None:
    """Write our maps of a model: the artist's seams flattened, and plans with the bounds that it is compared at."""
    bounds: dict[str, float | None] = {OURS: None}
    if options.peers and (options.peers / f"{model.name}.{OPTCUTS}.npz").is_file():
        bounds[OURS_AS_OPTCUTS] = OPTCUTS_BOUND
    maps: dict[str, UvMap] = {}
    try:
        artist = in_own_process(seam_planning.artist_map, model)
        if artist is not None:
            maps[ARTIST] = artist
            bounds[OURS_AS_FLATTENED] = measure(artist, reference).energy
        if model.published_map is not None:
            bounds[OURS_AS_ARTIST] = measure(model.published_map, reference).energy
        maps |= in_own_process(seam_planning.planned_maps, model, reference.mirror_axis, bounds, options.along)
    except (BrokenProcessPool, RuntimeError, ValueError) as error:
        print(f"{model.name}: failed: {error!r}", file=sys.stderr, flush=True)
    for method, uv_map in maps.items():
        uv_map.write(options.maps / f"{model.name}.{method.replace(' ', '_')}.npz")


def draw(model: Model, maps: dict[str, UvMap], folder: Path, *, blind: bool) -> None:
    """Draw the sheet of a model; if it is blind, add the order of its rows to key.json."""
    folder.mkdir(parents=True, exist_ok=True)
    methods = [method for method in ON_SHEETS if method in maps]
    labels = methods
    if blind:
        random.SystemRandom().shuffle(methods)
        labels = [chr(ord("A") + i) for i in range(len(methods))]
        key = folder / "key.json"
        known = json.loads(key.read_text()) if key.is_file() else {}
        key.write_text(json.dumps(known | {model.name: dict(zip(labels, methods, strict=True))}, indent=1) + "\n")
    rows = [Row(label, maps[method]) for label, method in zip(labels, methods, strict=True)]
    if rows:
        draw_sheet(folder / f"{model.name}.png", rows, model.frame)


if __name__ == "__main__":
    main()
