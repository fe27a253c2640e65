# SPDX-License-Identifier: GPL-3.0-or-later
"""The views of one mesh, drawn over it, each with its legend. In Edit Mode they are a layer of the tool."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from . import color_tables, fields
from .fields import FieldMaker, FieldRequest
from .lab_settings import LINES, settings
from .shaded import ColoredLines, ShadedFaces
from .tool import ColoredFaces, Legend, Lines, Newest, Style, blended, kinds_of, load, steps
from .tool import colors as colors_of

if TYPE_CHECKING:
    from collections.abc import Callable

    import seamwire_core
    from numpy.typing import NDArray

    from .fields import Ellipses, Fields, Part, Source
    from .tool import Arrays, Color, ColorMap, Eye, Options, Pose

_STEPS = 64
"""Colors of a legend's bar."""
_OPACITY = 0.85
_PERCENTILE = 98.0
"""This percentile of the values has the last color, because the few strongest would leave all others dark."""
_CORNERS = 24
"""Corners of an ellipse."""
_RIM: Color = (0.97, 0.97, 0.97, 1.0)
_RIM_WIDTH = 0.06
"""In distances between ellipses."""
_BAND = {"color": (1.0, 1.0, 1.0, 0.9), "width": 1.5, "halo": 1.5, "lift": 3.0}
_SILHOUETTE = {"color": (1.0, 0.93, 0.30, 1.0), "width": 2.0, "halo": 1.0, "lift": 4.0}
_PIECES = {"color": (0.02, 0.02, 0.03, 0.75), "width": 1.0, "lift": 3.0}
_SPLIT: Color = (0.13, 0.44, 0.94, 0.9)
_REPAIRED: Color = (0.96, 0.60, 0.10, 0.95)
_LEFT: Color = (0.92, 0.10, 0.12, 1.0)
_NO_SOURCE = "Click a seed, or select a vertex"
_PARTS: dict[str, Part] = dict(zip(LINES, ("SILHOUETTE", "ELLIPSES", "PATHS", "ISOLINES", "INVALID"), strict=True))
"""The part of the fields that each toggle shows."""


def request_for(
    options: Options, parts: frozenset[Part], source: Source | None, strokes: tuple[object, ...] = ()
) -> FieldRequest:
    """Return a request for fields in the metric that the settings of the tool and of this add-on name."""
    kinds = kinds_of(options.metric)
    kind = kinds[min(("MIN", "MAX").index(settings().shown_metric), len(kinds) - 1)]
    return FieldRequest(parts, options.metric, options.strength, options.clamp, kind, source, strokes)


class Views:
    """The views of one mesh. `seamwire.interface.Layer` tells what most methods do.

    Parameters
    ----------
    arrays
        The mesh.
    surface
        Returns the library's surface of it. Called in a thread, where it may wait.
    pose
        Where the mesh is seen.
    """

    def __init__(self, arrays: Arrays, surface: Callable[[], seamwire_core.Surface], pose: Pose) -> None:
        self._arrays = arrays
        self._pose = pose
        core = load()
        maker = FieldMaker(core, surface, lambda: not self._maker.superseded)
        self._maker = Newest(maker.make, "seamwire-lab", (core.Cancelled,))
        self._asked: FieldRequest | None = None
        self._heat: Part | None = None
        self._visible: frozenset[Part] = frozenset()
        self._request = FieldRequest(frozenset())
        self._made: dict[str, tuple[object, object]] = {}
        self._seen: Fields | None = None

    def close(self) -> None:
        """End all computations."""
        self._maker.close()

    def follow(self, options: Options, source: Source | None, strokes: tuple[object, ...] = ()) -> None:
        """Show what the settings ask for, in the tool's metric, with distances from a source."""
        chosen = settings()
        self._heat = chosen.heat if chosen.heat != "NONE" else None
        lines = frozenset(part for name, part in _PARTS.items() if getattr(chosen, name))
        self._visible = lines | ({self._heat} if self._heat else set())
        is_far = bool(self._visible & {"DISTANCE", "PATHS", "ISOLINES"})
        self._request = request_for(options, self._visible, source if is_far else None, strokes)
        if self._visible and self._request != self._asked:
            self._asked = self._request
            self._maker.want(self._request)

    @property
    def busy(self) -> bool:
        """Whether something is being computed, so that `poll` must be called from time to time."""
        return self._maker.busy or self._maker.answer is not self._seen

    def poll(self) -> bool:
        """Return whether there is something new to see since the last call. Raise what went wrong in the thread."""
        try:
            self._maker.check()
        except Exception:
            self._asked = None  # so that the same can be asked for again
            raise
        new = self._maker.answer is not self._seen
        self._seen = self._maker.answer
        return new

    @property
    def fields(self) -> Fields | None:
        """The latest fields that are wanted and belong to the current metric."""
        found = self._maker.answer
        if found is None or not self._request.parts or found.request.metric_key != self._request.metric_key:
            return None
        return found

    @property
    def is_complete(self) -> bool:
        """Whether everything that is asked for is computed."""
        fields = self.fields
        return fields is not None and fields.request == self._request and not self._maker.busy

    def _values(self) -> NDArray[np.float64] | None:
        fields = self.fields
        if fields is None or self._heat is None:
            return None
        return getattr(fields, self._heat.lower())

    def _shown(self, part: Part) -> object:
        fields = self.fields
        if fields is None or part not in self._visible:
            return None
        return getattr(fields, part.lower())

    def _once(self, name: str, of: object, make: Callable[[], object]) -> object:
        """Return what draws some data. It is made when the data is first seen."""
        if name not in self._made or self._made[name][0] is not of:
            self._made[name] = of, make()
        return self._made[name][1]

    # Drawing

    def repose(self) -> None:
        """Draw everything where the pose has it now."""
        self._made.clear()

    def _seen_at(self, segments: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return where segments on the mesh, (k, 2, 3), are seen."""
        return self._pose.places(segments.reshape(-1, 3)).reshape(-1, 2, 3)

    def _lines(self, style: dict[str, object], segments: NDArray[np.float64]) -> Lines:
        return Lines(Style(**style), segments)

    def draw_heat(self, eye: Eye) -> bool:
        """Color the faces, and return whether there was anything to color."""
        values = self._values()
        if values is None:
            return False
        scale = HeatScale.of(self._heat, values)

        def make() -> ShadedFaces:
            colors = np.full((len(values), 4), _OPACITY)
            colors[:, :3] = scale.colors(values)
            colors[~np.isfinite(values)] = 0.0
            return ShadedFaces(self._pose.points, self._arrays.triangles, colors)

        self._once("heat", values, make).draw_over(eye)
        return True

    def draw_lines(self, eye: Eye) -> None:
        """Draw everything else."""
        invalid = self._shown("INVALID")
        if invalid is not None:
            self._once("invalid", invalid, lambda: self._invalid_faces(invalid)).draw_over(
                eye, [_SPLIT, _REPAIRED, _LEFT]
            )
            with blended("LESS_EQUAL"):
                self._once("pieces", invalid, lambda: self._lines(_PIECES, self._seen_at(invalid.edges))).draw(eye)
        ellipses = self._shown("ELLIPSES")
        if ellipses is not None:
            rims, insides = self._once("ellipses", ellipses, lambda: _ellipse_faces(ellipses))
            with blended("LESS_EQUAL"):
                rims.draw(eye, 5.0)
                insides.draw(eye, 6.0)
        with blended("LESS_EQUAL"):
            silhouette = self._shown("SILHOUETTE")
            if silhouette is not None:
                self._seen_silhouette(silhouette, eye).draw(eye)
            isolines = self._shown("ISOLINES")
            if isolines is not None:
                self._once("isolines", isolines, lambda: self._lines(_BAND, self._seen_at(isolines.segments))).draw(eye)
            paths = self._shown("PATHS")
            if paths is not None:
                self._once("paths", paths, lambda: _path_lines(paths)).draw(eye)

    def _seen_silhouette(self, silhouette: fields.Silhouette, eye: Eye) -> Lines:
        """Return the silhouette from where the mesh is seen now. It is computed again whenever that changes."""
        kept = self._once("silhouette", silhouette, lambda: [b"", None])
        if kept[0] != eye.key:
            place = _place_of(eye)
            segments = np.empty((0, 2, 3)) if place is None else silhouette.seen_from(place)
            kept[:] = eye.key, self._lines(_SILHOUETTE, segments)
        return kept[1]

    def _invalid_faces(self, invalid: fields.Invalid) -> ColoredFaces:
        faces = ColoredFaces(self._pose.points)
        kinds = (invalid.split, invalid.repaired, invalid.left)
        faces.fill((color, self._arrays.triangles[numbers]) for color, numbers in enumerate(kinds))
        return faces

    # Legends

    def legends(self) -> list[Legend]:
        """Return the legends, the lowest first."""
        parts, found = self._visible, []
        if not parts:
            return []
        has_source = self._request.source is not None
        values = self._values()
        if values is not None:
            found.append(HeatScale.of(self._heat, values).legend(self._heat))
        for part, legend in (
            ("INVALID", _of_invalid),
            ("ELLIPSES", _of_ellipses),
            ("ISOLINES", _of_bands),
            ("SILHOUETTE", _of_silhouette),
            ("PATHS", _of_paths),
        ):
            if (shown := self._shown(part)) is not None:
                found.append(legend(shown))
        if not has_source and parts & {"DISTANCE", "PATHS", "ISOLINES"}:
            found.append(_legend((_NO_SOURCE,)))
        elif not self.is_complete:
            found.append(_legend(("Computing...",)))
        return found


class HeatScale:
    """The colors of numbers.

    Parameters
    ----------
    low, high
        The numbers that have the first and the last color.
    map
        The colors.
    clipped
        Whether larger numbers exist.
    """

    def __init__(self, low: float, high: float, map: ColorMap, clipped: bool) -> None:
        self.low, self.high, self.map, self.clipped = low, high, map, clipped

    @classmethod
    def of(cls, heat: Part, values: NDArray[np.float64]) -> HeatScale:
        """Return the scale for the values of a heat view."""
        some = values[np.isfinite(values)]
        if heat == "DISTANCE":
            return cls(0.0, float(some.max(initial=0.0)), color_tables.PLASMA, False)
        high = float(np.percentile(np.abs(some), _PERCENTILE)) if len(some) else 0.0
        clipped = bool(np.abs(some).max(initial=0.0) > high)
        if heat == "CONCAVITY":
            return cls(-high, high, color_tables.PURPLE_ORANGE, clipped)
        return cls(0.0, high, color_tables.VIRIDIS, clipped)

    def colors(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the colors of numbers, (n, 3)."""
        width = self.high - self.low
        parts = (values - self.low) / width if width > 0.0 else np.zeros_like(values)
        return colors_of(np.nan_to_num(parts, posinf=1.0), self.map)

    def legend(self, heat: Part) -> Legend:
        """Return the legend of a heat view."""
        middle = 0.5 * (self.low + self.high)
        more = "+" if self.clipped else ""
        less = "\N{MINUS SIGN}" if self.low < 0.0 else ""
        marks = (
            (0.0, f"{less}{_text(abs(self.low))}{more if less else ''}"),
            (0.5, _text(middle)),
            (1.0, f"{_text(self.high)}{more}"),
        )
        titles = {
            "STRENGTH": ("Feature strength",),
            "CONCAVITY": ("Curvature", "Concave: purple, convex: orange"),
            "DISTANCE": ("Distance in the metric",),
        }
        return _legend(titles[heat], steps(self.map, _STEPS), marks)


def _place_of(eye: Eye) -> NDArray[np.float64] | None:
    """Return the place of an eye, (4,): x, y, z and 1, or the direction to it and 0. None if the object is flattened."""
    try:
        place = np.linalg.inv(eye.to_clip) @ (0.0, 0.0, -1.0, 0.0)
    except np.linalg.LinAlgError:
        return None
    return np.append(place[:3], 0.0) if eye.is_orthographic else place / place[3]


def _legend(*parts: object, **swatches: object) -> Legend:
    return Legend(*parts, **swatches)


def _text(number: float) -> str:
    return f"{number:.3g}" if number < 1000.0 else f"{number:.0f}"


def _ellipse_faces(ellipses: Ellipses) -> tuple[ShadedFaces, ShadedFaces]:
    """Return the rims of ellipses, and the colored insides that lie above the rims."""
    colors = np.ones((len(ellipses.centres), 4))
    colors[:, :3] = colors_of(_anisotropy_parts(ellipses), color_tables.VIRIDIS)
    rims = np.broadcast_to(np.array(_RIM), colors.shape)
    return _fans(ellipses, _RIM_WIDTH * ellipses.spacing, rims), _fans(ellipses, 0.0, colors)


def _anisotropy_parts(ellipses: Ellipses) -> NDArray[np.float64]:
    largest = float(ellipses.anisotropy.max(initial=1.0))
    return np.log(ellipses.anisotropy) / np.log(largest) if largest > 1.0 else np.zeros(len(ellipses.anisotropy))


def _fans(ellipses: Ellipses, margin: float, colors: NDArray[np.float64]) -> ShadedFaces:
    count = len(ellipses.centres)
    angles = np.linspace(0.0, 2.0 * np.pi, _CORNERS, endpoint=False)
    sizes = np.linalg.norm(ellipses.axes, axis=2, keepdims=True)
    axes = ellipses.axes * (1.0 + margin / np.maximum(sizes, 1e-300))
    rims = ellipses.centres[:, None] + np.einsum(
        "kac,ia->kic", axes, np.stack([np.cos(angles), np.sin(angles)], axis=1)
    )
    points = np.concatenate([ellipses.centres[:, None], rims], axis=1).reshape(-1, 3)
    # A little above the surface, which curves away below.
    points += np.repeat(ellipses.normals, _CORNERS + 1, axis=0) * (0.04 * ellipses.spacing)
    corner = np.arange(_CORNERS)
    fan = np.stack([np.zeros_like(corner), 1 + corner, 1 + (corner + 1) % _CORNERS], axis=1)
    triangles = (np.arange(count)[:, None, None] * (_CORNERS + 1) + fan).reshape(-1, 3)
    return ShadedFaces(points, triangles, np.repeat(colors, _CORNERS + 1, axis=0))


def _path_lines(paths: fields.Paths) -> ColoredLines:
    pieces, lengths = paths.segments()
    colors = np.ones((len(pieces), 4))
    colors[:, :3] = HeatScale.of("DISTANCE", paths.lengths).colors(lengths)
    # The shortest last: above those that go on from where they end.
    order = np.argsort(-lengths, kind="stable")
    return ColoredLines(pieces[order], colors[order], 2.0, lift=4.0)


def _of_invalid(invalid: fields.Invalid) -> Legend:
    title = f"Invalid triangles: {invalid.before}, {invalid.added} added"
    kinds = (
        (_SPLIT, f"{len(invalid.split)} made valid by bisection"),
        (_REPAIRED, f"{len(invalid.repaired)} with changed lengths"),
        (_LEFT, f"{len(invalid.left)} left as holes"),
    )
    return _legend((title,), swatches=tuple(((*color[:3], 1.0), text) for color, text in kinds))


def _of_ellipses(ellipses: Ellipses) -> Legend:
    largest = float(ellipses.anisotropy.max(initial=1.0))
    marks = ((0.0, "1"), (0.5, _text(largest**0.5)), (1.0, _text(largest)))
    return _legend(("Anisotropy; long where paths are short",), steps(color_tables.VIRIDIS, _STEPS), marks)


def _of_silhouette(_silhouette: fields.Silhouette) -> Legend:
    return _legend((), swatches=((_SILHOUETTE["color"], "Silhouette of this view"),))


def _of_bands(isolines: fields.Isolines) -> Legend:
    return _legend((f"Distance bands, {_text(isolines.spacing)} wide",))


def _of_paths(paths: fields.Paths) -> Legend:
    scale = HeatScale.of("DISTANCE", paths.lengths)
    marks = ((0.0, "0"), (0.5, _text(0.5 * scale.high)), (1.0, _text(scale.high)))
    return _legend((f"Length of {len(paths.lengths)} shortest paths",), steps(scale.map, _STEPS), marks)
