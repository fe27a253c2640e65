# SPDX-License-Identifier: GPL-3.0-or-later
"""All settings of the tool: their defaults, limits, names and tooltips, and their values at one moment."""

# ruff: noqa: RUF009 - the fields of `Options` are made by a function
from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any, NamedTuple

from .choices import (
    ALONG,
    AUTO_ALONG,
    AUTO_FINISH,
    DEFAULT_FINISH,
    FINISHES,
    HEATS,
    METRICS,
    Along,
    Finish,
    Finishing,
    Metric,
    MetricName,
    Term,
)

STRENGTHS: Mapping[Along, float] = {"EDGES": 10.0, "SURFACE": 20.0}
"""The metric's largest anisotropy to begin with: how strongly wires are drawn to features; docs/method/defaults.md says why."""
STRENGTH_STEP = 1.25
STRENGTH_RANGE = (1.0, 100.0)
CLAMP_PERCENTILE = 99.0
"""The percentile of feature strengths that counts as the strongest, to begin with."""


class Auto(NamedTuple):
    """The values that Auto stands for: how wires run, and how wires across the surface become seams."""

    along: Along
    finish: Finish


PLACED = Auto("EDGES", "SNAP")
"""For meshes whose edges an artist placed: nothing cuts their faces."""
SCANNED = Auto("SURFACE", "CUT")
"""For scans, sculpts and remeshed surfaces."""


class Setting(NamedTuple):
    """How Blender shows a setting. It is grayed out unless it `matters` for the way of running and the metric."""

    name: str
    tooltip: str
    group: str  # the panel that shows it: Drawing, Finish, Islands or Advanced, or Views
    limits: tuple[float, float] | None = None  # smaller and larger numbers are moved to the limits
    choices: Mapping[str, Term | Finishing | Metric] | None = None  # the table of its values
    auto: str = ""  # the tooltip of Auto, if that is the default in Blender; `Auto` has the value that it stands for
    matters: Callable[[Along, MetricName], bool] = lambda _along, _metric: True
    slider: bool = False  # whether a number is shown as a slider
    others: Mapping[str, object] = {}  # more arguments of Blender's property


def _setting(default: object, *words: str, **others: object) -> Any:  # noqa: ANN401 - a field of any type
    return field(default=default, metadata={"setting": Setting(*words, **others)})


def _across(along: Along, _metric: MetricName) -> bool:
    return along == "SURFACE"


def _strength(along: Along) -> float:
    return _setting(
        STRENGTHS[along],
        "Strength",
        "How strongly wires follow the shape. 1 gives the shortest path",
        "Drawing",
        limits=STRENGTH_RANGE,
        matters=lambda way, _: way == along,
    )


@dataclass(frozen=True)
class Options:
    """A snapshot of the settings. Values beyond their limits are moved to the limits.

    A strength is the metric's largest anisotropy. The stroke radius is in the object's units. `mirror` has the axes, 0 to 2, over which
    wires are mirrored. It is a setting of the mesh.
    """

    along: Along = _setting("EDGES", "Along", "How wires run on the mesh", "Drawing", choices=ALONG, auto=AUTO_ALONG)
    strength_edges: float = _strength("EDGES")
    strength_surface: float = _strength("SURFACE")
    finish: Finish = _setting(
        DEFAULT_FINISH,
        "Finish",
        "How a wire across the surface becomes a seam when its chain ends",
        "Finish",
        choices=FINISHES,
        auto=AUTO_FINISH,
        matters=_across,
    )
    straight: bool = _setting(
        False, "Straight in View", "Offer the wire that is straight on screen first", "Drawing", matters=_across
    )
    clear: bool = _setting(False, "Clear Seams", "Clear seams instead of marking them", "Drawing")
    snap: bool = _setting(
        False, "Snap to Features", "Snap seeds to ridges, valleys and other features near the cursor", "Drawing"
    )
    xray: bool = _setting(False, "X-Ray", "Show wires through the mesh, and pick through it", "Drawing")
    unwrap: bool = _setting(
        False,
        "Unwrap After Each Chain",
        "When a chain ends, unwrap the islands whose seams it has changed. All other UVs stay in place",
        "Islands",
    )
    metric: MetricName = _setting(next(iter(METRICS)), "Metric", "What wires follow", "Advanced", choices=METRICS)
    clamp: float = _setting(
        CLAMP_PERCENTILE,
        "Feature Percentile",
        "Clip feature strength at this percentile, so that noise does not dominate",
        "Advanced",
        limits=(50.0, 100.0),
        matters=lambda _, metric: "min" in METRICS[metric].follows,
        slider=True,
        others={"precision": 1},
    )
    stroke_radius: float = _setting(
        0.0,
        "Stroke Radius",
        "How far strokes reach. 0 means ten rings of vertices",
        "Advanced",
        others={"min": 0.0, "soft_max": 1.0, "precision": 3, "subtype": "DISTANCE"},
    )
    heat: str = _setting("NONE", "Heat", "Color faces by the stretch of the UV map", "Views", choices=HEATS)
    show_crests: bool = _setting(
        False,
        "Ridges and Valleys",
        "Show where the surface bends most sharply. Alt-click a line to draw wires along it",
        "Views",
    )
    mirror: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        for name, setting in SETTINGS.items():
            if setting.limits is not None:
                low, high = setting.limits
                object.__setattr__(self, name, min(max(getattr(self, name), low), high))
        object.__setattr__(self, "mirror", tuple(sorted(set(self.mirror))))

    @property
    def marking(self) -> bool:
        return not self.clear

    @property
    def into_faces(self) -> bool:
        return self.marking and FINISHES[self.finish].cuts

    @property
    def strengths(self) -> Mapping[Along, float]:
        return {along: getattr(self, strength_name(along)) for along in ALONG}

    @property
    def strength(self) -> float:
        return self.strengths[self.along]

    @property
    def computes(self) -> tuple[object, ...]:
        """What decides how wires are computed, besides the way that they run."""
        return self.metric, *self.strengths.values(), self.clamp

    @property
    def draws(self) -> tuple[object, ...]:
        """What decides which wires clicks draw, and what the wires do to the mesh."""
        return self.along, *self.computes, self.finish, self.straight, self.clear, self.mirror

    def stepped(self, steps: int) -> Options:
        """Return options with a strength that is some steps greater, or less; the same at the limit."""
        return replace(self, **{strength_name(self.along): self.strength * STRENGTH_STEP**steps})


SETTINGS: Mapping[str, Setting] = {
    each.name: each.metadata["setting"] for each in fields(Options) if "setting" in each.metadata
}
"""All settings in the order in which panels show them."""


def strength_name(along: Along) -> str:
    return f"strength_{along.lower()}"
