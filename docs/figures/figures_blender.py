# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures of the paper, made again with the project's own code: Blender runs this for ``docs/figures/make``.

Arguments after ``--``: the folder to write into, the figures' numbers, models.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(Path(__file__).parent))
# Pillow and Matplotlib's letters; Blender's own packages come first.
sys.path += map(str, (ROOT / ".venv/lib").glob("python*/site-packages"))

import addon_utils
import bpy

addon_utils.enable("seamwire", default_set=True)
addon_utils.enable("seamwire_lab", default_set=True)

import figure_embeddings
import figure_features
import figure_metrics
import figure_networks
import figure_norm
from figure_models import Model, read, sphere
from figure_sheet import save
from figure_studio import Studio, evaluated
from seamwire.core.base import native

if TYPE_CHECKING:
    from collections.abc import Sequence

FIGURES = {
    1: figure_metrics.shortest_paths,
    2: figure_norm.norm_at_a_point,
    3: figure_metrics.on_a_sphere,
    4: figure_metrics.along_ridge_and_valley,
    5: figure_metrics.feature_strength,
    6: figure_metrics.four_metrics,
    7: figure_embeddings.embedding,
    8: figure_embeddings.times,
    9: figure_embeddings.campens_invalid,
    10: figure_networks.scribble,
    11: figure_networks.segmentation,
    12: figure_networks.more_segmentations,
    13: figure_features.feature_detection,
}
"""What makes each figure, as a picture or a table. The paper has no number 13."""


def suzanne(core: object) -> Model:
    """Return Blender's monkey, subdivided."""
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.object
    obj.modifiers.new("Subdivision", "SUBSURF").levels = 3
    return Model(core, "suzanne", *evaluated(obj))


def main(arguments: Sequence[str]) -> None:
    """Make the figures that are asked for."""
    folder, only, *files = arguments
    core = native.load()
    models = {path.stem.lower(): Model(core, path.stem.lower(), *read(path)) for path in map(Path, files)}
    models.setdefault("suzanne", suzanne(core))
    models["sphere"] = Model(core, "sphere", *sphere())
    studio = Studio(Path(folder), models)
    for number in map(int, only.split(",")):
        begin = time.perf_counter()
        made = FIGURES[number](studio)
        path = Path(folder) / f"figure-{number}.{'md' if isinstance(made, str) else 'png'}"
        if isinstance(made, str):
            path.write_text(made, encoding="utf-8")
            how = "table"
        else:
            how = save(made, path)
        print(f"   {path}: {how}; {time.perf_counter() - begin:.0f} s", flush=True)


if __name__ == "__main__":
    main(sys.argv[sys.argv.index("--") + 1 :])
