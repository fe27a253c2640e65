# SPDX-License-Identifier: GPL-3.0-or-later
"""Suggested seams beside an artist's, on models whose seams an artist marked.

    python native/bench/parts.py --data FOLDER... --work FOLDER [--uvgami FOLDER] [--before FOLDER] [--only NAME...] [--methods NAME...]
        [--most-faces N] [--json FILE] [--page FILE...] [--pictures FOLDER] [--blind FOLDER [--votes FILE]]

A model is a file NAME.npz that uv_maps.py describes, with the artist's seams. It is moved to the origin and scaled to a size of 2. It
faces +z, with y up, unless frames.json in its folder says otherwise. seam_measures.py says what each number is.

These are the methods:

- artist: the artist's seams.
- ours: the parts at the default amount, and the planner's slits inside of them.
- ours .1 to ours .9: five amounts of parts. Tables show the best one of each model as "best of five".
- before: seams and maps NAME.edges.npz in the folder of --before, which an earlier add-on made in Blender.
- uvgami: hard-surface mode of UVgami, whose sources are in the folder of --uvgami.
- xatlas: its Python package, if it can be imported.
- sharp 30, sharp 45, sharp 60: all edges sharper than so many degrees.

The seams of each method are kept in the folder of --work, so another run only measures them. Delete a method's folder to find its seams
again. Models with more than --most-faces faces are left out.

--json keeps all numbers, and --page renews the tables of Markdown pages, between comments "begin NAME" and "end NAME". --pictures draws
the models of `PICTURED`. --blind draws a sheet of each model with the methods in random order and without names; key.json in the same
folder has the names. With --votes, a file {"NAME": "LETTER"} of what a judge keeps, the program counts votes instead of drawing sheets.
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
from parts_report import AMOUNTS, ARTIST, BEFORE, OURS, SHARP_45, UVGAMI, XATLAS, Result, class_of, tables, votes_table
from seam_measures import Artist, SeamMesh
from seam_methods import Seams, cached
from uv_maps import Model, read_frames
from uv_measures import Reference
from uv_pictures import Surface, best_view, draw_columns

if TYPE_CHECKING:
    from collections.abc import Callable

DEFAULT_AMOUNT = 0.5
SHARP = (30, 45, 60)
PROPS = (
    "godot_flying_forklift_cube_000",
    "godot_flying_forklift_cube_002",
    "pc_portal_portalframe_portalframe_0",
    "raylib_plane",
    "sk_dieselpunk_mech",
    "sk_drone",
)
OTHERS = (
    "bevy_fox_fox1",
    "mh_male_casualsuit03",
    "sk_crab",
    "sk_ornitier_hat",
    "test_spot",
    "vk_cesiumman_cesium_man",
)
PICTURED = {"parts-props": PROPS, "parts-others": OTHERS}
"""Models of the pictures, by the picture's name. They were chosen before their results were seen."""
ON_PICTURES = (OURS, ARTIST, UVGAMI, SHARP_45)
_PIXELS = 240


def main() -> None:
    """Find seams, measure, print and draw what the options say."""
    options = parsed_options()
    results: list[Result] = []
    drawn: dict[str, tuple[Model, dict[str, Surface]]] = {}
    for folder in options.data:
        frames = read_frames(folder)
        for file in sorted(folder.glob("*.npz")):
            if options.only and file.stem not in options.only:
                continue
            model = centered(Model.read(file, frames.get(file.stem)))
            if model.artist_seams is None or not len(model.artist_seams):
                continue
            if len(model.start) - 1 > options.most_faces:
                print(f"{model.name}: left out, {len(model.start) - 1} faces", file=sys.stderr, flush=True)
                continue
            found, surfaces = measured(model, options)
            results += found
            drawn[model.name] = model, surfaces
            print(model.name, *(f"{r.method} {r.values['agree'] or 0:.2f}" for r in found), file=sys.stderr, flush=True)
    if not results:
        sys.exit("no models")
    if options.json:
        options.json.write_text(json.dumps([dataclasses.asdict(result) for result in results], indent=1) + "\n")
    made = tables(results)
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
    parser.add_argument("--before", type=Path, help="folder of an earlier add-on's results, NAME.edges.npz")
    parser.add_argument("--uvgami", type=Path, help="sources of UVgami")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="these models only")
    parser.add_argument("--methods", nargs="+", metavar="NAME", help="these methods only")
    parser.add_argument("--most-faces", type=int, default=20_000, help="leave larger models out")
    parser.add_argument("--json", type=Path, help="file for all numbers")
    parser.add_argument("--page", type=Path, nargs="+", default=[], help="Markdown pages whose tables are renewed")
    parser.add_argument("--pictures", type=Path, help="folder for the pictures of the page")
    parser.add_argument("--blind", type=Path, help="folder for sheets without names")
    parser.add_argument("--votes", type=Path, help="file of what a judge of the sheets of --blind keeps")
    return parser.parse_args()


def centered(model: Model) -> Model:
    """Return a model around the origin, with its longest side 2."""
    low, high = model.points.min(axis=0), model.points.max(axis=0)
    return dataclasses.replace(model, points=(model.points - (low + high) / 2) * 2 / (high - low).max())


def measured(model: Model, options: argparse.Namespace) -> tuple[list[Result], dict[str, Surface]]:
    """Return the results of a model, and its surface with the seams of each method."""
    mesh, mirror = SeamMesh(model), Reference(model).mirror_axis
    triangles = SeamMesh(
        dataclasses.replace(model, start=np.arange(0, model.triangles.size + 1, 3), corners=model.triangles.ravel())
    )
    assert model.artist_seams is not None
    artist = Artist(mesh, model.artist_seams, mirror)
    kind = class_of(model.name, artist.sharp)
    results, surfaces = [], {}
    for method, find in methods(model, mesh, options).items():
        if options.methods and method not in options.methods:
            continue
        try:
            seams = find()
        except (RuntimeError, ValueError, IndexError, KeyError) as error:
            print(f"{model.name}: {method}: failed: {error!r}", file=sys.stderr, flush=True)
            continue
        on = triangles if seams.of_triangles else mesh
        values = dataclasses.asdict(artist.measure(seams.pairs, on)) | seam_methods.map_measures(model, seams)
        values |= {"sec": seams.info.get("sec"), "first": seams.info.get("first")}
        results.append(Result(model.name, method, kind, len(model.start) - 1, artist.islands, values))
        mask = on.mask(seams.pairs)
        surfaces[method] = Surface(model.points, model.triangles, triangle_islands(on, mask, model), on.edges[mask])
    return results, surfaces


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

    found: dict[str, Callable[[], Seams]] = {ARTIST: lambda: Seams(model.artist_seams), OURS: our(DEFAULT_AMOUNT)}
    found |= {f"{OURS} {amount:g}": our(amount) for amount in AMOUNTS}
    if options.before and (options.before / f"{model.name}.edges.npz").is_file():
        found[BEFORE] = lambda: seam_methods.from_blender(model, options.before / f"{model.name}.edges.npz")
    if options.uvgami:
        found[UVGAMI] = kept(UVGAMI, lambda: seam_methods.uvgami(model, options.uvgami))
    if seam_methods.has_xatlas():
        found[XATLAS] = kept(XATLAS, lambda: seam_methods.xatlas(model))
    return found | {f"sharp {angle}": lambda angle=angle: seam_methods.sharp(mesh, angle) for angle in SHARP}


def draw_pictures(drawn: dict[str, tuple[Model, dict[str, Surface]]], folder: Path) -> None:
    """Draw the pictures of the page: a row for each model, a column for each method, from the view that shows most seams."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, models in PICTURED.items():
        rows = []
        for model in models:
            if model in drawn:
                frame, surfaces = drawn[model][0].frame, drawn[model][1]
                view = best_view(surfaces[ARTIST], frame)
                rows.append((model, frame, [(view, surfaces.get(method)) for method in ON_PICTURES]))
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
        azimuth, elevation = best_view(surfaces[ARTIST], model.frame)
        views = ((azimuth, elevation), (azimuth + 180, elevation))
        rows = [("", model.frame, [(view, surfaces[method]) for method in order]) for view in views]
        draw_columns(folder / f"{name}.png", letters, rows, 2 * _PIXELS)


if __name__ == "__main__":
    main()
