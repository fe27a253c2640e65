# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions for scripts: draw wires, suggest seams, unwrap and cut.

Each works on one object. All objects keep their modes. The functions push no step of Blender's undo.

Raises
------
ValueError
    If an argument is wrong, or it cannot be done. Nothing has changed.
TypeError
    If there is no option of a name. Nothing has changed.
ImportError
    If the compiled part is missing. Nothing has changed.
RuntimeError
    If an error comes while the mesh is changed. It may have a part of the change.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Mapping, Set
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from itertools import pairwise
from numbers import Real
from typing import TYPE_CHECKING, Any, Union

import bpy
import numpy as np

from .core.base import native
from .core.network.picks import FacePoint, undirected
from .core.offers.edge_loops import KINDS
from .mesh import edit_mesh, finishes, modes, settings
from .mesh.object_session import ObjectSession
from .terms.choices import ALONG, DEFAULT_FINISH, FINISHES, METRICS
from .terms.options import STRENGTH_RANGE, Options, strength_name
from .words.reports import HALFWAY, not_cut
from .words.scripted import draw_chain, draw_loop

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from .core.network.picks import Pick
    from .core.network.wires import Wire
    from .terms.choices import Along, Finish, MetricName

Seed = Union[int, "tuple[int, int]", "tuple[float, float, float]"]
"""A vertex, an edge as its two vertices, or a place in object coordinates."""
TAKES = ("FIRST", *KINDS)
"""Which loop along edges `mark` takes: the first that a click would offer, or one of a kind."""
_NO_LIMIT = 1e9
"""Blender's limits beyond this are those of the type."""


@dataclass(frozen=True)
class Marked:
    """What `mark` has done."""

    wires: int  # how many are new
    marked: int  # how many edges became seams
    cleared: int  # how many are seams no longer
    problems: tuple[str, ...] = ()  # sentences about what could not be drawn


def mark(
    obj: bpy.types.Object,
    chains: Sequence[Sequence[Seed]] = (),
    *,
    loops: Sequence[Seed] = (),
    take: str = "FIRST",
    strokes: Sequence[Sequence[int]] = (),
    avoid: Sequence[Sequence[int]] = (),
    along: Along = "EDGES",
    finish: Finish = DEFAULT_FINISH,
    clear: bool = False,
    mirror: Iterable[str] | None = None,
    strength: float | None = None,
    metric: MetricName = "feature",
) -> Marked:
    """Draw wires between seeds, and mark or clear their edges, as the tool would.

    Parameters
    ----------
    chains
        Chains of seeds. Wires run from each seed to the next. A seed is a vertex, an edge such as ``(7, 9)`` (along edges), or a place
        such as ``(0.3, 0.0, 1.2)`` in object coordinates (across the surface).
    loops
        Edges: the loop through each is added. Across the surface, vertices or places: the closed cut through each is added.
    take
        Which loop along edges: the first that a click would offer, or a kind of loop.
    strokes, avoid
        Vertices along strokes that attract wires, and along strokes that repel wires.
    along, finish, metric
        How wires run, how wires across the surface become seams, and what wires follow: keys of the tables in `terms/choices.py`.
    clear
        Whether to clear seams instead of marking them.
    mirror
        Axes to mirror wires over, such as ``"X"`` or ``"XY"``. None takes the mesh's own mirror option.
    strength
        How strongly wires follow the shape, 1 to 100. None takes the tool's default.

    Raises
    ------
    ValueError
        If an argument is wrong, or no seam was marked. The message names the chain and the seed, such as ``chains[0][2]``.
    """
    for name, value, allowed in (
        ("along", along, ALONG),
        ("finish", finish, FINISHES),
        ("metric", metric, METRICS),
        ("take", take, TAKES),
    ):
        _checked(name, value, "ENUM", allowed)
    clear = _checked("clear", clear, "BOOLEAN")
    if strength is not None:
        strength = _checked("strength", strength, "FLOAT", (), *STRENGTH_RANGE)
    axes = None if mirror is None else _listed("mirror", mirror, "axes, such as 'XY'", is_ordered=False)
    for axis in axes or ():
        if axis not in ("X", "Y", "Z"):
            raise ValueError(f"mirror: {axis!r} is not an axis, such as 'X'")
    chains, loops = _listed("chains", chains, "chains"), _listed("loops", loops, "seeds")
    strokes, avoid = _listed("strokes", strokes, "strokes"), _listed("avoid", avoid, "strokes")
    across = along == "SURFACE"
    if across and FINISHES[finish].cuts and clear:
        raise ValueError("A cut cannot clear seams: choose another finish")
    if across and take != "FIRST":
        raise ValueError("take needs along='EDGES'")
    with editing(obj):
        mirrored = settings.mirror_axes(obj.data) if axes is None else tuple(map("XYZ".index, axes))
        options = Options(along=along, finish=finish, metric=metric, clear=clear, mirror=mirrored)
        if strength is not None:
            options = Options(**{**vars(options), strength_name(along): strength})
        mesh = ObjectSession(obj, options)
        reader = _Reader(mesh, across)
        through = [reader.chain(f"chains[{row}]", chain) for row, chain in enumerate(chains)]
        around = [reader.seed(f"loops[{row}]", seed, "LOOP") for row, seed in enumerate(loops)]
        guides = [
            (f"{name}[{row}]", reader.stroke(f"{name}[{row}]", vertices), name == "strokes")
            for name, group in (("strokes", strokes), ("avoid", avoid))
            for row, vertices in enumerate(group)
        ]
        if not through and not around:
            raise ValueError("There is nothing to draw: give chains or loops")
        mesh.make_live.wait()
        before = set(mesh.session.wires)
        problems = [notice.text for notice in mesh.notices.take()]
        for where, vertices, attracts in guides:
            if not mesh.session.draw_stroke(vertices=vertices, attracts=attracts, acts_on="both"):
                problems.append(f"{where}: {mesh.session.reason}")
        for row, seeds in enumerate(through):
            problems += [f"chains[{row}]: {problem}" for problem in draw_chain(mesh.session, seeds)]
        for row, pick in enumerate(around):
            problem = draw_loop(mesh.session, pick, None if take == "FIRST" else take)
            problems += [f"loops[{row}]: {problem}"] if problem else []
        # A wire that changed its edges is another one.
        wires = [wire for wire in mesh.session.wires if wire not in before]
        if not wires:
            raise ValueError(". ".join(["No seam was marked", *problems]))
        if options.into_faces and across:
            return _cut(mesh, wires, problems)
        return _write(mesh, wires, problems, finish if across and not clear else DEFAULT_FINISH)


def suggest(obj: bpy.types.Object, **options: object) -> bool:
    """Mark the seams that *Suggest Seamwires* finds with its options, such as ``parts=50``, and return whether it found any."""
    with editing(obj, alone=True):
        return _call(bpy.ops.mesh.seamwire_suggest, options)


def unwrap(obj: bpy.types.Object, **options: object) -> bool:
    """Unwrap islands with the options of *Unwrap Changed Islands*, such as ``changed_only=False``. Return whether there were any."""
    with editing(obj, alone=True):
        return _call(bpy.ops.mesh.seamwire_unwrap, options)


def cut(obj: bpy.types.Object) -> None:
    """Cut all kept wires across the surface into the faces. Raise ValueError if there is no such wire."""
    with editing(obj, alone=True):
        _call(bpy.ops.mesh.seamwire_finish, {"finish": "CUT"})


def _write(mesh: ObjectSession, wires: list[Wire], problems: list[str], finish: Finish) -> Marked:
    plan = mesh.plan()
    with _changing():
        marked, cleared = mesh.write(plan)
        finishes.move(mesh, wires, finish)
        if marked or cleared:
            edit_mesh.live_unwrap(bpy.context)
    return Marked(len(wires), marked, cleared, tuple(problems))


def _cut(mesh: ObjectSession, wires: list[Wire], problems: list[str]) -> Marked:
    plan = finishes.plan_cut(mesh, wires)
    with _changing():
        # As if the mesh had the wires already: so it keeps the strokes too.
        _, done = finishes.cut(mesh, plan, wires, kept=True)
        edit_mesh.live_unwrap(bpy.context)
    return Marked(done.wires, len(done.edges), 0, (*problems, *not_cut(done.uncut, done.left_out)))


@contextmanager
def _changing() -> Iterator[None]:
    try:
        yield
    except Exception as error:
        raise RuntimeError(f"{HALFWAY}: {error}") from error


def _call(work: Callable[..., set[str]], options: dict[str, object]) -> bool:
    """Call an operator, and return whether it did anything. Raise what this module promises."""
    properties = work.get_rna_type().properties
    unknown = options.keys() - (set(properties.keys()) - {"rna_type"})
    if unknown:
        raise TypeError(f"There is no option {sorted(unknown)[0]!r}")
    options = {name: _option(name, value, properties[name]) for name, value in options.items()}
    try:
        return work(**options) == {"FINISHED"}
    except RuntimeError as error:
        text = str(error).strip().removeprefix("Error: ")
        raise (RuntimeError if text.startswith(HALFWAY) else ValueError)(text) from error


@contextmanager
def editing(obj: bpy.types.Object, alone: bool = False) -> Iterator[None]:
    """Have an object in Edit Mode, as `modes.editing` does, if there is the compiled part."""
    native.load()
    with modes.editing(obj, alone):
        yield


class _Reader:
    """Reads the seeds that a script gives for a mesh, and for wires `across` the surface or along edges."""

    def __init__(self, mesh: ObjectSession, across: bool) -> None:
        self._mesh, self._across = mesh, across

    def chain(self, where: str, seeds: Sequence[Seed]) -> list[Pick]:
        seeds = _listed(where, seeds, "seeds, such as [0, 512]")
        picks = [self.seed(f"{where}[{row}]", seed) for row, seed in enumerate(seeds)]
        if len(picks) < 2:
            raise ValueError(f"{where}: a chain needs at least two seeds")
        for row, (one, two) in enumerate(pairwise(picks), start=1):
            if undirected(one) == undirected(two):
                raise ValueError(f"{where}[{row}]: the seed comes twice in a row, but a wire needs two different ends")
        return picks

    def stroke(self, where: str, vertices: Sequence[int]) -> list[int]:
        vertices = _listed(where, vertices, "vertices, such as [4, 90, 31]")
        numbers = [self.seed(f"{where}[{row}]", vertex, "STROKE") for row, vertex in enumerate(vertices)]
        if len(numbers) < 2:
            raise ValueError(f"{where}: a stroke needs at least two vertices")
        return numbers

    def seed(self, where: str, seed: Seed, of: str = "CHAIN") -> Pick:
        """Return the pick of a seed of a chain, a loop or a stroke."""
        pick = self._pick(where, seed)
        is_edge, problem = isinstance(pick, tuple), self._mesh.cage.problem_with(pick)
        if of == "STROKE" and not isinstance(pick, int):
            problem = "a stroke runs through vertices"
        elif self._across and is_edge:
            problem = "across the surface, a seed is a vertex or a place, not an edge"
        elif not self._across and isinstance(pick, FacePoint):
            problem = "along edges, a seed is a vertex or an edge, not a place"
        elif of == "LOOP" and not self._across and not is_edge and not problem:
            problem = "along edges, a loop runs through an edge such as (7, 9)"
        if problem:
            raise ValueError(f"{where}: {problem}")
        return pick

    def _pick(self, where: str, seed: Seed) -> Pick:
        vertex = _index(seed)
        if vertex is not None:
            return vertex
        place: list[float] = []
        try:
            parts = _listed(where, seed, "numbers")
            ends = [_index(part) for part in parts]
            if len(ends) == 2 and None not in ends and ends[0] != ends[1]:
                return ends[0], ends[1]
            place = [_checked(where, part, "FLOAT") for part in parts] if len(parts) == 3 else []
        except ValueError:
            pass
        if len(place) != 3 or not all(map(math.isfinite, place)):
            raise ValueError(
                f"{where}: {seed!r} is neither a vertex, nor an edge such as (7, 9), nor a place such as (0.1, 0.0, 2.5)"
            )
        try:
            return self._mesh.point_at(place)
        except ValueError as error:
            raise ValueError(f"{where}: {error}") from error


def _listed(where: str, values: object, of: str, is_ordered: bool = True) -> list[object]:
    """Return values as a list. Raise ValueError if they are no list, or are a set or a text although the list `is_ordered`."""
    try:
        if isinstance(values, (Mapping, bytes)) or (is_ordered and isinstance(values, (Set, str))):
            raise TypeError
        return list(values)
    except TypeError:
        raise ValueError(f"{where}: {values!r} is not a list of {of}") from None


def _index(value: object) -> int | None:
    try:
        return None if isinstance(value, bool) else operator.index(value)
    except TypeError:
        return None


def _checked(
    name: str, value: object, kind: str, of: Iterable[str] = (), low: float = -math.inf, high: float = math.inf
) -> Any:  # noqa: ANN401 - a value of the kind
    """Return a value of a kind, as Blender calls the types of properties. Raise ValueError if it is of another, or out of range."""
    number = math.nan
    if isinstance(value, Real) and not isinstance(value, bool):  # NumPy registers its numbers as such
        with suppress(OverflowError):
            number = float(value)
    if kind == "ENUM":
        is_good, wanted = isinstance(value, str) and value in of, f"one of {', '.join(of)}"
    elif kind == "STRING":
        is_good, wanted = isinstance(value, str), "a text"
    elif kind == "BOOLEAN":
        is_good = isinstance(value, (bool, np.bool_)) or (isinstance(value, int) and value in {0, 1})
        wanted = "True or False"
    elif kind == "INT" and _index(value) is None:
        is_good, wanted = False, "a whole number"
    elif not math.isfinite(number):
        is_good, wanted = False, "a number"
    else:
        is_good = low <= number <= high
        wanted = f"a number from {low:g} to {high:g}" if high < _NO_LIMIT else f"a number that is at least {low:g}"
    if not is_good:
        raise ValueError(f"{name}={value!r}: choose {wanted}")
    return {"BOOLEAN": bool, "INT": int, "FLOAT": float}[kind](value) if kind not in {"ENUM", "STRING"} else value


def _option(name: str, value: object, own: bpy.types.Property) -> object:
    """Return the value of an operator's property. Raise ValueError if it is of another type, or out of range."""
    if own.type == "ENUM":
        return _checked(name, value, own.type, own.enum_items.keys())
    if own.type in {"BOOLEAN", "STRING"}:
        return _checked(name, value, own.type)
    if not own.is_array:
        return _checked(name, value, own.type, low=own.hard_min, high=own.hard_max)
    numbers = [_checked(name, each, "FLOAT") for each in _listed(name, value, "numbers")]
    if len(numbers) != own.array_length:
        raise ValueError(f"{name}={value!r}: choose {own.array_length} numbers")
    return numbers
