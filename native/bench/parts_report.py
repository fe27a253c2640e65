# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of the benchmark of parts, in Markdown."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from auto_seams_report import markdown, median, shown

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    Values = Sequence[float | None]

ARTIST, OURS, BEST, UVGAMI, XATLAS, SHARP_45 = ("artist", "ours", "best of five", "uvgami", "xatlas", "sharp 45")
AMOUNTS = (0.1, 0.3, 0.5, 0.7, 0.9)
"""The amounts of parts among which an artist takes the best one."""
CLASSES = ("hard", "organic", "clothes")
_CLOTHES = re.compile(r"(suit|coat|hat|shoes?|glove|dress|shirt|jacket|pants|trousers|boots?)\d*(_|$)")
_HARD = 0.5
_BOUND = 4.2
_REACHED = 0.005
_BEST = {"agree": max, "exact": max, "exact_mean": max, "presses": min, "tolerant": min}
"""Which amount is the best one for a number."""


@dataclass(frozen=True)
class Result:
    """The numbers of one method on one model: those of `SeamMeasures`, of its map, and its seconds, by name."""

    model: str
    method: str
    kind: str
    faces: int
    artist_islands: int
    values: dict[str, Any]

    def __getitem__(self, name: str) -> float | None:
        return self.values.get(name)


def class_of(name: str, sharp: float) -> str:
    """Return the class of a model: clothes by its name, and otherwise hard if an artist's seams are mostly on sharp edges.

    sharp: the share of the artist's seams on edges of more than 30 degrees, by length.
    """
    if _CLOTHES.search(name):
        return "clothes"
    return "hard" if sharp > _HARD else "organic"


def with_best(results: Sequence[Result]) -> list[Result]:
    """Return results in which the runs with different amounts are replaced by the best number of any of them."""
    names = {f"{OURS} {amount:g}" for amount in AMOUNTS}
    found = [result for result in results if result.method not in names]
    for model in dict.fromkeys(result.model for result in results):
        runs = [result for result in results if result.model == model and result.method in names]
        if len(runs) == len(AMOUNTS):
            values = {
                name: best(known)
                for name, best in _BEST.items()
                if (known := [run[name] for run in runs if run[name] is not None])
            }
            found.append(Result(model, BEST, runs[0].kind, runs[0].faces, runs[0].artist_islands, values))
    return found


def common(results: Sequence[Result], methods: Sequence[str]) -> list[Result]:
    """Return the results of the models that all of these methods have."""
    every = {r.model for r in results}
    models = every.intersection(*({r.model for r in results if r.method == method} for method in methods))
    return [result for result in results if result.model in models]


@dataclass(frozen=True)
class Measure:
    """A row of the goals: its title, the value of a method's results, the bound or bounds, and decimals."""

    title: str
    value: Callable[[Sequence[Result]], float | None]
    least: float | None = None
    most: float | None = None
    decimals: int = 2

    def goal(self) -> str:
        """Return the goal as a cell of a table."""
        least, most = (None if bound is None else f"{bound:g}" for bound in (self.least, self.most))
        if least and most:
            return f"{least} to {most}"
        return f">= {least}" if least else f"<= {most}"

    def is_met(self, value: float | None) -> str:
        """Return whether a value reaches the goal, as a cell of a table."""
        if value is None:
            return "-"
        rounded = round(value, 4)
        is_met = (self.least is None or rounded >= self.least) and (self.most is None or rounded <= self.most)
        return "yes" if is_met else "no"


def median_of(name: str, kind: str | None = None) -> Callable[[Sequence[Result]], float | None]:
    """Return the function that takes the median of a number over the results of a class, or over all."""
    return lambda results: median(r[name] for r in results if kind in (None, r.kind))


def share(name: str, holds: Callable[[float], bool]) -> Callable[[Sequence[Result]], float | None]:
    """Return the function that counts for which share of the results a number has a property; a missing number has not."""

    def value(results: Sequence[Result]) -> float | None:
        if not any(r[name] is not None for r in results):
            return None
        return sum(r[name] is not None and holds(r[name]) for r in results) / len(results)

    return value


def models_with(name: str) -> Callable[[Sequence[Result]], float | None]:
    """Return the function that counts the results in which a number is above 0."""

    def value(results: Sequence[Result]) -> float | None:
        known = [r[name] for r in results if r[name] is not None]
        return sum(number > 0 for number in known) if known else None

    return value


def of_size(name: str, least: int, most: int) -> Callable[[Sequence[Result]], float | None]:
    """Return the function that takes the median of a number over models with so many faces."""
    return lambda results: median(r[name] for r in results if least <= r.faces < most)


AGREEMENT = ("agreement", "agree", ((0.60, 0.70), (0.36, 0.45), (0.55, 0.55)))
TOLERANT = ("tolerant presses", "tolerant", ((0.52, 0.35), (1.00, 0.60), (0.65, 0.50)))


def by_class(column: int) -> list[Measure]:
    """Return the goals for agreement and presses: column 0 for the default amount, 1 for the best of five."""
    made = []
    for kind, bounds in zip(CLASSES, AGREEMENT[2], strict=True):
        made.append(Measure(f"{AGREEMENT[0]}, {kind}", median_of(AGREEMENT[1], kind), least=bounds[column]))
    for kind, bounds in zip(CLASSES, TOLERANT[2], strict=True):
        made.append(Measure(f"{TOLERANT[0]}, {kind}", median_of(TOLERANT[1], kind), most=bounds[column]))
    return made


GOALS = (
    *by_class(0),
    Measure("islands / artist's", median_of("islands_ratio"), 0.7, 1.4),
    Measure("crumbs", median_of("crumbs"), most=0, decimals=1),
    Measure("loose ends, more than the artist", median_of("loose_ends"), most=0, decimals=1),
    Measure("models with E_d within 4.2", share("energy", lambda e: e <= _BOUND + _REACHED), least=0.98),
    Measure("models with overlap", models_with("overlapping"), most=0, decimals=0),
    Measure("models with flips", models_with("flips"), most=0, decimals=0),
    Measure("models with UVs outside the tile", models_with("outside"), most=0, decimals=0),
    Measure("used share of the UV square", median_of("used"), least=0.6),
    Measure("mirrored share", median_of("mirrored"), least=0.99),
    Measure("3,000 to 8,000 faces: seconds to parts", of_size("first", 3_000, 8_000), most=0.1),
    Measure("3,000 to 8,000 faces: seconds to the end", of_size("sec", 3_000, 8_000), most=3, decimals=1),
)


def goal_table(results: Sequence[Result]) -> str:
    """Return the table of the goals for the default amount: the results of three methods, the goal, and whether ours meet it."""
    shown_methods = (SHARP_45, UVGAMI, OURS)
    by_method = {method: [r for r in results if r.method == method] for method in shown_methods}
    rows = []
    for goal in GOALS:
        values = [goal.value(by_method[method]) for method in shown_methods]
        rows.append(
            [goal.title, *(shown(value, goal.decimals) for value in values), goal.goal(), goal.is_met(values[-1])]
        )
    return markdown(["median", *shown_methods, "goal", "met"], rows)


def best_table(results: Sequence[Result]) -> str:
    """Return the table of the goals for the best of five amounts."""
    by_method = {method: [r for r in results if r.method == method] for method in (OURS, BEST)}
    rows = []
    for goal in by_class(1):
        default, best = (goal.value(by_method[method]) for method in (OURS, BEST))
        rows.append([goal.title, shown(default), shown(best), goal.goal(), goal.is_met(best)])
    return markdown(["median", OURS, BEST, "goal", "met"], rows)


SECTIONS: dict[str, tuple[Measure, ...]] = {
    "agreement": (
        *(Measure(kind, median_of("agree", kind)) for kind in CLASSES),
        *(Measure(f"exact, {kind}", median_of("exact_mean", kind)) for kind in CLASSES),
    ),
    "near": (
        Measure("lift", median_of("lift")),
        Measure("recall lift", median_of("rlift")),
        Measure("exact share", median_of("exact")),
        Measure("length", median_of("length")),
        Measure("straight", median_of("straightness")),
        Measure("mirrored", median_of("mirrored")),
    ),
    "presses": (
        *(Measure(f"strict, {kind}", median_of("presses", kind)) for kind in CLASSES),
        *(Measure(f"tolerant, {kind}", median_of("tolerant", kind)) for kind in CLASSES),
    ),
    "islands": (
        Measure("islands / artist's", median_of("islands_ratio")),
        Measure("crumbs", median_of("crumbs"), decimals=1),
        Measure("models: crumbs", models_with("crumbs"), decimals=0),
        Measure("loose ends", median_of("loose_ends"), decimals=1),
        Measure("discs", median_of("discs")),
    ),
    "maps": (
        Measure("E_d", median_of("energy")),
        Measure("within 4.2", share("energy", lambda e: e <= _BOUND + _REACHED)),
        Measure("models: overlap", models_with("overlapping"), decimals=0),
        Measure("models: flips", models_with("flips"), decimals=0),
        Measure("used", median_of("used")),
        Measure("s", median_of("sec"), decimals=1),
    ),
}
"""Columns of the tables that compare methods, by the table's name. No table has more than seven columns."""


def method_table(results: Sequence[Result], section: str) -> str:
    """Return a table with a row for each method."""
    rows = []
    for method in dict.fromkeys(r.method for r in results):
        chosen = [r for r in results if r.method == method]
        rows.append([method, *(shown(column.value(chosen), column.decimals) for column in SECTIONS[section])])
    return markdown(["method", *(column.title for column in SECTIONS[section])], rows)


COMPARED = (OURS, UVGAMI, SHARP_45, XATLAS)


def model_table(results: Sequence[Result], name: str) -> str:
    """Return a table of a number, and in parentheses the islands, of each model and method."""
    cells = {(r.model, r.method): f"{shown(r[name])} ({r['islands']})" for r in results}
    rows = []
    for kind in CLASSES:
        for model, islands in dict.fromkeys((r.model, r.artist_islands) for r in results if r.kind == kind):
            rows.append([f"{kind}: {model}", str(islands), *(cells.get((model, m), "-") for m in COMPARED)])
    return markdown(["model", ARTIST, *COMPARED], rows)


def votes_table(votes: dict[str, str], key: dict[str, dict[str, str]], kinds: dict[str, str]) -> str:
    """Return the table of how often a blind judge keeps each method, by class.

    votes: the letter that the judge keeps on the sheet of each model. key: the methods of the letters. kinds: the class
    of each model with an artist's seams.
    """
    kept = [(key[model][letter], kinds.get(model, "")) for model, letter in votes.items()]
    methods = sorted({method for letters in key.values() for method in letters.values()})
    rows = [
        [method, str(sum(m == method for m, _ in kept)), *(str(kept.count((method, kind))) for kind in CLASSES)]
        for method in methods
    ]
    return markdown(["kept", "models", *CLASSES], rows)


def scan_table(scans: Mapping[str, Mapping[str, float]]) -> str:
    """Return the table of models without an artist's seams, with a row for each."""
    decimals = {"triangles": 0, "islands": 0, "crumbs": 0, "used": 2, "flat": 2, "ms": 2}
    rows = [[name, *(shown(values[key], places) for key, places in decimals.items())] for name, values in scans.items()]
    return markdown(["model", "triangles", "islands", "crumbs", "used", "flat slits", "ms a triangle"], rows)


def tables(results: Sequence[Result]) -> dict[str, str]:
    """Return all tables of the results, by the names that pages have for them."""
    every = with_best(results)
    present = [m for m in (OURS, UVGAMI, SHARP_45) if any(r.method == m for r in every)]
    fair = common(every, present)
    without_best = [r for r in fair if r.method != BEST]
    return {
        "parts-goals": goal_table(fair),
        "parts-best": best_table(fair),
        **{
            f"parts-{name}": method_table(fair if name in ("agreement", "presses") else without_best, name)
            for name in SECTIONS
        },
        "parts-models-agreement": model_table(every, "agree"),
        "parts-models-tolerant": model_table(every, "tolerant"),
    }
