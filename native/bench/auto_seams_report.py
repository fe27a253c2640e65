# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of the benchmark of automatic seams, in Markdown."""

from __future__ import annotations

import dataclasses
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from uv_measures import Measures

    Value = Callable[["Result"], float | None]


@dataclass(frozen=True)
class Result:
    """One map of one model, measured."""

    model: str
    method: str
    triangles: int
    is_hard: bool
    measures: Measures
    info: dict[str, Any]

    def as_json(self) -> dict[str, Any]:
        """Return all numbers by name."""
        return {
            "model": self.model,
            "method": self.method,
            "triangles": self.triangles,
            "is_hard": self.is_hard,
            **dataclasses.asdict(self.measures),
            "lift": self.measures.lift,
            "info": self.info,
        }


@dataclass(frozen=True)
class Column:
    """A column of a table: its title, what it shows of a result, and with how many decimals."""

    title: str
    value: Value
    decimals: int = 2


COLUMNS = (
    Column("islands", lambda r: r.measures.islands, 0),
    Column("seam", lambda r: r.measures.seam),
    Column("E_d", lambda r: r.measures.energy),
    Column("density 5 %", lambda r: r.measures.density),
    Column("visible", lambda r: r.measures.visibility),
    Column("angles", lambda r: r.measures.angles, 3),
    Column("areas", lambda r: r.measures.areas, 3),
    Column("angles 95 %", lambda r: r.measures.angles_most),
    Column("areas 95 %", lambda r: r.measures.areas_most),
    Column("mirrored", lambda r: r.measures.mirrored),
    Column("lift", lambda r: r.measures.lift),
    Column("sharp", lambda r: r.measures.sharp),
    Column("tiny", lambda r: r.measures.tiny, 0),
    Column("loose ends", lambda r: r.measures.loose_ends, 0),
    Column("overlapping", lambda r: r.measures.overlapping, 0),
    Column("flips", lambda r: r.measures.flips, 0),
    Column("packing", lambda r: r.measures.packing if r.info.get("is_packed", True) else None),
    Column("first s", lambda r: r.info.get("first"), 1),
    Column("s", lambda r: r.info.get("sec"), 1),
    Column("MB", lambda r: r.info.get("mem"), 0),
)


def value_of(title: str) -> Value:
    """Return what the column of a title shows of a result."""
    return next(column.value for column in COLUMNS if column.title == title)


SEAM, ENERGY, DENSITY, VISIBLE, MIRRORED = map(value_of, ("seam", "E_d", "density 5 %", "visible", "mirrored"))
ANGLES, AREAS, LIFT, SHARP, TINY = map(value_of, ("angles", "areas", "lift", "sharp", "tiny"))
OVERLAPPING, FLIPS, PACKING, FIRST, SECONDS = map(value_of, ("overlapping", "flips", "packing", "first s", "s"))


def median(values: Iterable[float | None]) -> float | None:
    """Return the median of the numbers that exist, or None if no number exists."""
    known = [value for value in values if value is not None]
    return float(np.median(known)) if known else None


def shown(value: float | None, decimals: int = 2) -> str:
    """Return a number as a cell of a table; very large ones by their power of ten."""
    if value is None:
        return "-"
    return f"{value:.0e}" if abs(value) >= 1e5 else f"{value:.{decimals}f}"


def markdown(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


SECTIONS = {
    "length": ("islands", "seam", "E_d", "density 5 %", "visible"),
    "stretch": ("angles", "areas", "angles 95 %", "areas 95 %"),
    "place": ("mirrored", "lift", "sharp", "tiny", "loose ends"),
    "cost": ("overlapping", "flips", "packing", "first s", "s", "MB"),
}
"""Titles of the columns that stand in one table, by the table's name. No table has more than seven columns."""
_LONGEST = 5
"""Columns up to which a table also has the number of triangles or models."""
_COUNTED = {"tiny", "overlapping", "flips"}
_LARGEST = "areas"
"""The column whose largest value of any model stands beside its median."""
FORMER = ("before", "before stretch")
"""Maps of the planner that the present one replaced. They have separate tables."""


def columns_of(section: str) -> list[Column]:
    """Return the columns of a section's table."""
    return [next(column for column in COLUMNS if column.title == title) for title in SECTIONS[section]]


def model_table(results: Sequence[Result], method: str, section: str) -> str:
    """Return a table of the maps of one method, a row for each model, and their medians."""
    columns = columns_of(section)
    has_size = len(columns) <= _LONGEST
    chosen = [result for result in results if result.method == method]
    rows = [
        [r.model, *([str(r.triangles)] if has_size else []), *(shown(c.value(r), c.decimals) for c in columns)]
        for r in chosen
    ]
    medians = [shown(median(map(column.value, chosen)), column.decimals) for column in columns]
    size = ["triangles"] if has_size else []
    head = [f"{method}: model", *size, *(column.title for column in columns)]
    return markdown(head, [*rows, ["median", *("" for _ in size), *medians]])


def median_table(results: Sequence[Result], section: str, *, former: bool = False) -> str:
    """Return a table of the medians of each method over the models that it has a map of.

    Tiny islands, overlapping islands and flips are the numbers of models that have any. The stretch of areas also has the largest
    value of any model. With ``former`` the rows are the former planner's, otherwise those of all other methods.
    """
    columns = columns_of(section)
    has_size = len(columns) <= _LONGEST
    rows = []
    for method in dict.fromkeys(result.method for result in results):
        if (method in FORMER) != former:
            continue
        chosen = [result for result in results if result.method == method]
        size = [str(len(chosen))] if has_size else []
        rows.append([method, *size, *(cell for column in columns for cell in typical(column, chosen))])
    titles = [title for column in columns for title in titles_of(column)]
    return markdown(["method", *(["models"] if has_size else []), *titles], rows)


def titles_of(column: Column) -> list[str]:
    """Return the titles of a column in a table of medians."""
    if column.title == _LARGEST:
        return [column.title, f"{column.title}, largest"]
    return [f"models: {column.title}" if column.title in _COUNTED else column.title]


def typical(column: Column, results: Sequence[Result]) -> list[str]:
    """Return the cells of a column in a table of medians: the median, and the largest value where it has a column.

    For islands and triangles that are counted, this is the number of results that have any.
    """
    values = [column.value(result) for result in results]
    if column.title in _COUNTED:
        return [str(sum(value is not None and value > 0 for value in values))]
    cells = [shown(median(values), max(column.decimals, 1) if column.title == "islands" else column.decimals)]
    if column.title == _LARGEST:
        cells.append(shown(max((value for value in values if value is not None), default=None), column.decimals))
    return cells


def tables_on(page: str) -> list[str]:
    """Return the names of the tables that a page has a place for."""
    return re.findall(r"<!-- begin ([\w-]+) -->", page)


def with_tables(page: str, tables: dict[str, str]) -> str:
    """Return a page in which tables stand between the comments ``begin NAME`` and ``end NAME``.

    Raises ValueError if the page has no place for one of them.
    """
    for name, table in tables.items():
        begin, end = f"<!-- begin {name} -->\n", f"<!-- end {name} -->"
        before, found, rest = page.partition(begin)
        _, closed, after = rest.partition(end)
        if not found or not closed:
            raise ValueError(f"no place for the table {name}")
        page = f"{before}{begin}\n{table}\n\n{end}{after}"
    return page


@dataclass(frozen=True)
class Comparison:
    """A table of methods model by model: its methods, two values, the second one in parentheses, and their decimals."""

    methods: Sequence[str]
    title: str = "seam (E_d)"
    values: tuple[Value, Value] = (SEAM, ENERGY)
    decimals: int = 2

    def cell(self, result: Result) -> str:
        """Return the cell of a result."""
        first, second = (shown(value(result), self.decimals) for value in self.values)
        return f"{first} ({second})"


COMPARED = {
    "artists": Comparison(("ours", "ours as artist", "ours as artist flattened", "artist", "artist as published")),
    "programs": Comparison(("ours", "tree", "ours 4.1", "optcuts", "xatlas")),
    "former": Comparison(("ours", "before")),
    "stretch": Comparison(
        ("ours", "xatlas", "smart", "artist", "artist abf", "artist as published"), "areas (angles)", (AREAS, ANGLES), 3
    ),
}
"""Tables that show methods model by model, by name."""


def comparison_table(results: Sequence[Result], name: str) -> str:
    """Return a table of two values, for instance the seam's length and, in parentheses, E_d, of each model and method."""
    comparison = COMPARED[name]
    cells = {(r.model, r.method): comparison.cell(r) for r in results}
    methods = [method for method in comparison.methods if any(r.method == method for r in results)]
    models = dict.fromkeys(r.model for r in results)
    return markdown(
        [comparison.title, *methods],
        [[model, *(cells.get((model, method), "-") for method in methods)] for model in models],
    )


def with_artist(results: Sequence[Result]) -> list[Result]:
    """Return the results of the models that have an artist's seams."""
    models = {result.model for result in results if result.method == "artist"}
    return [result for result in results if result.model in models]


def ratios(results: Sequence[Result], one: str, other: str, value: Value) -> list[float]:
    """Return value(one) / value(other) of each model that has maps of both methods."""
    by_method = {
        method: {r.model: value(r) for r in results if r.method == method and value(r) is not None}
        for method in (one, other)
    }
    return [number / by_method[other][model] for model, number in by_method[one].items() if by_method[other].get(model)]


@dataclass(frozen=True)
class Goal:
    """A goal: what is measured, the bound, whether it bounds from above, and the values of the models that count."""

    name: str
    bound: float
    is_most: bool
    values: Sequence[float | None]

    def row(self) -> list[str]:
        """Return the row of the goals' table."""
        reached = median(self.values)
        known = [value for value in self.values if value is not None]
        is_met = reached is not None and (reached <= self.bound if self.is_most else reached >= self.bound)
        sign = "<=" if self.is_most else ">="
        within = sum(value <= self.bound if self.is_most else value >= self.bound for value in known)
        answer = "-" if reached is None else ("yes" if is_met else "no")
        return [self.name, f"{sign} {self.bound:g}", shown(reached), f"{within} of {len(known)}", answer]


_REACHED = 0.005
"""A map whose energy is at most this much above its bound reaches the bound."""


def seam_ratios(results: Sequence[Result], one: str, other: str) -> list[float]:
    """Return seam(one) / seam(other) of each model that has maps of both methods; infinite if the one misses its bound."""

    def seam(result: Result) -> float:
        bound = result.info.get("bound")
        return SEAM(result) if bound is None or ENERGY(result) <= bound + _REACHED else np.inf

    return ratios(results, one, other, seam)


SIZES = ((4_000, 14_000, 0.3, 10.0), (14_000, 50_000, 1.0, 25.0), (50_000, 150_000, 3.0, 60.0))
"""Classes of models by triangles, from and below, with the goals for the seconds to the first tree and to the end."""


def goals(results: Sequence[Result]) -> list[Goal]:
    """Return the goals of the planner with what was reached; medians over models count."""
    ours = [result for result in results if result.method == "ours"]
    artist_ends = {r.model: r.measures.loose_ends for r in results if r.method == "artist"}
    more_ends = [r.measures.loose_ends - artist_ends[r.model] for r in ours if r.model in artist_ends]
    found = [
        Goal("islands that overlap", 0, True, [OVERLAPPING(r) for r in ours]),
        Goal("flipped triangles", 0, True, [FLIPS(r) for r in ours]),
        Goal("E_d", 4.2, True, [ENERGY(r) for r in ours]),
        Goal("density that 95 % reach", 0.87, False, [DENSITY(r) for r in ours]),
        Goal("seam at E_d 4.1 / OptCuts", 0.9, True, seam_ratios(results, "ours 4.1", "optcuts")),
        Goal(
            "seam at the artist's E_d / artist",
            0.6,
            True,
            seam_ratios(results, "ours as artist", "artist as published"),
        ),
        Goal("visible", 0.5, True, [VISIBLE(r) for r in ours]),
        Goal("mirrored", 0.99, False, [MIRRORED(r) for r in ours]),
        Goal("lift", 0.5, False, [LIFT(r) for r in ours]),
        Goal("on sharp edges, hard surface", 0.6, False, [SHARP(r) for r in ours if r.is_hard]),
        Goal("islands under .1 %", 0, True, [TINY(r) for r in ours]),
        Goal("loose ends, more than the artist", 0, True, more_ends),
        Goal("packing in Blender", 0.6, False, [PACKING(r) for r in results if r.method == "addon"]),
    ]
    for least, most, first, end in SIZES:
        sized = [r for r in ours if least <= r.triangles < most]
        label = f"{least:,} to {most:,} triangles: seconds"
        found.append(Goal(f"{label} to the first tree", first, True, [FIRST(r) for r in sized]))
        found.append(Goal(f"{label} to the end", end, True, [SECONDS(r) for r in sized]))
    return found


def goal_table(results: Sequence[Result]) -> str:
    """Return the table of the goals: the median over the models, how many models are within the goal, and whether it is met."""
    head = ["goal", "bound", "median", "models within", "met"]
    return markdown(head, [goal.row() for goal in goals(results)])
