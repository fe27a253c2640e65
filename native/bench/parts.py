# SPDX-License-Identifier: GPL-3.0-or-later
"""Suggested seams beside an artist's, on models whose seams an artist marked, and pictures of models without such seams.

    python native/bench/parts.py --data FOLDER... --work FOLDER [--blender FOLDER] [--uvgami FOLDER] [--only NAME...] [--methods NAME...]
        [--most-faces N] [--json FILE] [--page FILE...] [--pictures FOLDER] [--blind FOLDER [--votes FILE]]

A model is a file NAME.npz that uv_maps.py describes. If it has an artist's seams, each method is measured against them. It is moved to
the origin and scaled to a size of 2. It faces +z, with y up, unless frames.json in its folder says otherwise. seam_measures.py says
what each number is.

These are the methods:

- artist: the artist's seams.
- ours: what *Suggest Seamwires* makes by default in Blender. addon/bench/blender_maps.py writes the folder of --blender. Without
  this option, ours is the library's parts at the default amount, with the planner's slits along edges.
- ours .1 to ours .9: the library's parts at five amounts. Tables show the best one of each model as "best of five".
- uvgami: hard-surface mode of UVgami, whose sources are in the folder of --uvgami.
- xatlas: its Python package, if it can be imported.
- sharp 30, sharp 45, sharp 60: all edges sharper than so many degrees.

The seams of each method are kept in the folder of --work, so another run only measures them. Delete a method's folder to find its seams
again. UVgami and xatlas leave models with more than --most-faces faces out.

--json keeps all numbers, and --page renews the tables of Markdown pages, between comments "begin NAME" and "end NAME". --pictures draws
the models of `PICTURED` from two sides.

--blind draws a sheet of each model with the methods in random order and without names;
key.json in the same folder has the names. With --votes, a file {"NAME": "LETTER"} of what a judge keeps, the program counts votes
instead of drawing sheets.
The program needs numpy, scipy, and seamwire_core on the path. Pictures need matplotlib.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import random
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import seam_methods
from auto_seams_report import tables_on, with_tables
from parts_report import (
    AMOUNTS,
    ARTIST,
    OURS,
    SHARP_45,
    UVGAMI,
    XATLAS,
    Result,
    class_of,
    scan_table,
    tables,
    votes_table,
)
from seam_measures import Artist, SeamMesh
from seam_methods import Seams, cached, centered
from uv_maps import Model, UvMap, read_frames
from uv_measures import Reference
from uv_pictures import Surface, best_view, draw_columns

if TYPE_CHECKING:
    from collections.abc import Callable

DEFAULT_AMOUNT = 0.5
SHARP = (30, 45, 60)
PICTURED = {
    "parts-scans": ("beast", "dragon", "decimated-max", "teddy", "Input_wheel"),
    "parts-clothes": (
        "mk_male_worksuit01",
        "mk_female_casualsuit02",
        "mk_male_casualsuit05",
        "mk_shoes01",
        "mk_female1605",
    ),
}
"""Models of the pictures, by the picture's name. They were chosen before their results were seen, and their licenses allow pictures."""
ON_PICTURES = (OURS, ARTIST, UVGAMI, SHARP_45)
_PIXELS = 240


def main() -> None:
    """Find seams, measure, print and draw what the options say."""
    options = parsed_options()
    results: list[Result] = []
    scans: dict[str, dict[str, float]] = {}
    drawn: dict[str, tuple[Model, dict[str, Surface]]] = {}
    for folder in options.data:
        frames = read_frames(folder)
        for file in sorted(folder.glob("*.npz")):
            if options.only and file.stem not in options.only:
                continue
            model = Model.read(file, frames.get(file.stem))
            model = dataclasses.replace(model, points=centered(model.points))
            if model.seams is not None and not len(model.seams):
                model = dataclasses.replace(model, seams=None)
            found, surfaces, own_map = measured(model, options)
            results += found
            if own_map is not None and model.artist_seams is None:
                scans[model.name] = seam_methods.scan_measures(own_map)
            drawn[model.name] = model, surfaces
            print(model.name, *(f"{r.method} {r['agree'] or 0:.2f}" for r in found), file=sys.stderr, flush=True)
    if not drawn:
        sys.exit("no models")
    if options.json:
        options.json.write_text(json.dumps([dataclasses.asdict(result) for result in results], indent=1) + "\n")
    made = tables(results) | {"parts-scans": scan_table(scans)}
    if options.votes:
        votes, key = (json.loads(file.read_text()) for file in (options.votes, options.blind / "key.json"))
        made["parts-votes"] = votes_table(votes, key, {result.model: result.kind for result in results})
    print(*made.values(), sep="\n\n")
    for page in options.page:
        text = page.read_text(encoding="utf-8")
        page.write_text(
            with_tables(text, {name: made[name] for name in tables_on(text) if name in made}), encoding="utf-8"
        )
    if options.pictures:
        draw_pictures(drawn, options.pictures)
    if options.blind and not options.votes:
        draw_blind(drawn, options.blind)


def parsed_options() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, required=True, nargs="+", help="folders of models, NAME.npz")
    parser.add_argument(
        "--work", type=Path, default=Path("build/bench/parts"), help="folder for the seams that are found"
    )
    parser.add_argument("--blender", type=Path, help="folder of the add-on's maps, NAME.addon.npz")
    parser.add_argument("--uvgami", type=Path, help="sources of UVgami")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="these models only")
    parser.add_argument("--methods", nargs="+", metavar="NAME", help="these methods only")
    parser.add_argument("--most-faces", type=int, default=20_000, help="the most that slow peers get")
    parser.add_argument("--json", type=Path, help="file for all numbers")
    parser.add_argument("--page", type=Path, nargs="+", default=[], help="Markdown pages whose tables are renewed")
    parser.add_argument("--pictures", type=Path, help="folder for the pictures of the page")
    parser.add_argument("--blind", type=Path, help="folder for sheets without names")
    parser.add_argument("--votes", type=Path, help="file of what a judge of the sheets of --blind keeps")
    return parser.parse_args()


def measured(model: Model, options: argparse.Namespace) -> tuple[list[Result], dict[str, Surface], UvMap | None]:
    """Return the results of a model, if an artist marked its seams, its surface with the seams of each method, and our map."""
    mesh = SeamMesh(model)
    triangles = SeamMesh(
        dataclasses.replace(model, start=np.arange(0, model.triangles.size + 1, 3), corners=model.triangles.ravel())
    )
    artist = None
    if model.artist_seams is not None:
        artist = Artist(mesh, model.artist_seams, Reference(model).mirror_axis)
    results, surfaces, own_map = [], {}, None
    for method, find in methods(model, mesh, options).items():
        if options.methods and method not in options.methods:
            continue
        try:
            seams = find()
        except (RuntimeError, ValueError, IndexError, KeyError) as error:
            print(f"{model.name}: {method}: failed: {error!r}", file=sys.stderr, flush=True)
            continue
        if method == OURS:
            own_map = seams.uv_map
        if seams.is_cut and seams.uv_map is not None:
            cut = seams.uv_map
            surfaces[method] = Surface(cut.points, cut.triangles, cut.islands, cut.seams)
            continue
        on = triangles if seams.of_triangles else mesh
        if artist is not None:
            values = dataclasses.asdict(artist.measure(seams.pairs, on)) | seam_methods.map_measures(model, seams)
            values |= {"sec": seams.info.get("sec"), "first": seams.info.get("first")}
            kind = class_of(model.name, artist.sharp)
            results.append(Result(model.name, method, kind, len(model.start) - 1, artist.islands, values))
        mask = on.mask(seams.pairs)
        surfaces[method] = Surface(model.points, model.triangles, triangle_islands(on, mask, model), on.edges[mask])
    return results, surfaces, own_map


def triangle_islands(mesh: SeamMesh, mask: np.ndarray, model: Model) -> np.ndarray:
    """Return the island of each triangle of a model."""
    islands = mesh.islands(mask)
    return islands if len(islands) == len(model.triangles) else np.repeat(islands, np.diff(model.start) - 2)


def methods(model: Model, mesh: SeamMesh, options: argparse.Namespace) -> dict[str, Callable[[], Seams]]:
    """Return how each method finds its seams, by name; results in the work folder are taken from there."""

    def kept(method: str, find: Callable[[], Seams]) -> Callable[[], Seams]:
        return lambda: cached(options.work / method / f"{model.name}.npz", find)

    def our(amount: float) -> Callable[[], Seams]:
        return kept(f"ours {amount:g}", lambda: seam_methods.ours(model, amount))

    found: dict[str, Callable[[], Seams]] = {}
    if model.artist_seams is not None:
        found = {ARTIST: lambda: Seams(model.artist_seams), OURS: our(DEFAULT_AMOUNT)}
        found |= {f"{OURS} {amount:g}": our(amount) for amount in AMOUNTS}
    if options.blender:
        found[OURS] = lambda: seam_methods.from_blender(model, options.blender / f"{model.name}.addon.npz")
    if len(model.start) - 1 <= options.most_faces:
        if options.uvgami:
            found[UVGAMI] = kept(UVGAMI, lambda: seam_methods.uvgami(model, options.uvgami))
        if seam_methods.has_xatlas():
            found[XATLAS] = kept(XATLAS, lambda: seam_methods.xatlas(model))
    return found | {f"sharp {angle}": lambda angle=angle: seam_methods.sharp(mesh, angle) for angle in SHARP}


def draw_pictures(drawn: dict[str, tuple[Model, dict[str, Surface]]], folder: Path) -> None:
    """Draw the pictures of the page: two rows for each model, a column for each method.

    The first row is the view that shows most of the artist's seams, or of ours. The second one is the view from behind.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for name, models in PICTURED.items():
        rows = []
        for model in models:
            if model in drawn:
                frame, surfaces = drawn[model][0].frame, drawn[model][1]
                azimuth, elevation = best_view(surfaces.get(ARTIST, surfaces.get(OURS)), frame)
                for label, view in ((model, (azimuth, elevation)), ("", (azimuth + 180, elevation))):
                    rows.append((label, frame, [(view, surfaces.get(method)) for method in ON_PICTURES]))
        if rows:
            draw_columns(folder / f"{name}.png", ON_PICTURES, rows, _PIXELS)


def draw_blind(drawn: dict[str, tuple[Model, dict[str, Surface]]], folder: Path) -> None:
    """Draw a sheet for each model: methods in random order, from the front and from behind; key.json has their names."""
    folder.mkdir(parents=True, exist_ok=True)
    key = {}
    for name, (model, surfaces) in drawn.items():
        order = [method for method in ON_PICTURES if method in surfaces]
        random.SystemRandom().shuffle(order)
        letters = [chr(ord("A") + i) for i in range(len(order))]
        key[name] = dict(zip(letters, order, strict=True))
        (folder / "key.json").write_text(json.dumps(key, indent=1) + "\n")
        azimuth, elevation = best_view(surfaces.get(ARTIST, surfaces.get(OURS)), model.frame)
        views = ((azimuth, elevation), (azimuth + 180, elevation))
        rows = [("", model.frame, [(view, surfaces[method]) for method in order]) for view in views]
        draw_columns(folder / f"{name}.png", letters, rows, 2 * _PIXELS)


if __name__ == "__main__":
    main()
