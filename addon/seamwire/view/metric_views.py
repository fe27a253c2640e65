# SPDX-License-Identifier: GPL-3.0-or-later
"""What the metric sees of one mesh, drawn over it: heat, ridges, ellipses, paths, bands, invalid triangles, each with its legend."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.fields import color_maps, metric_fields
from ..core.fields.metric_fields import FieldMaker, Request
from .gpu_draw import ColoredLines, Faces, Lines, ShadedFaces, blended
from .legend import Legend
from .theme import Style

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import ModuleType

    import seamwire_core
    from numpy.typing import NDArray

    from ..core.base.mesh_arrays import Arrays
    from ..core.fields.color_maps import ColorMap
    from ..core.fields.crests import Crests
    from ..core.fields.metric_fields import Ellipses, Fields, Part, Source
    from ..mesh.pose import Pose
    from ..mesh.settings import ToolOptions
    from .gpu_draw import Eye
    from .theme import Color

HEATS: tuple[Part, ...] = ("STRENGTH", "CONCAVITY", "DISTANCE")
"""The heat views, as the tool's setting names them."""
_STEPS = 64
"""Colors of a legend's bar."""
_OPACITY = 0.85
_PERCENTILE = 98.0
"""Of the values, has the last color: the strongest few would leave all others dark."""
_CORNERS = 24
"""Of an ellipse."""
_RIM: Color = (0.97, 0.97, 0.97, 1.0)
_RIM_WIDTH = 0.06
"""In distances between ellipses."""
_BAND = Style((1.0, 1.0, 1.0, 0.9), 1.5, halo=1.5, lift=3.0)
_RIDGE = Style((0.98, 0.45, 0.10, 1.0), 2.0, halo=1.0, lift=4.0)
_VALLEY = Style((0.20, 0.50, 1.0, 1.0), 2.0, halo=1.0, lift=4.0)
_SILHOUETTE = Style((1.0, 0.93, 0.30, 1.0), 2.0, halo=1.0, lift=4.0)
_SPLIT: Color = (0.13, 0.44, 0.94, 0.9)
_REPAIRED: Color = (0.96, 0.60, 0.10, 0.95)
_LEFT: Color = (0.92, 0.10, 0.12, 1.0)
_PIECES = Style((0.02, 0.02, 0.03, 0.75), 1.0, lift=3.0)
_NO_SOURCE = "Click a seed, or select a vertex"


class MetricViews:
    """The views of one mesh.

    Parameters
    ----------
    arrays
        The mesh.
    core
        The library's module.
    surface
        Returns the library's surface of it; called on a thread.
    pose
        Where the mesh is seen. None: where it is.
    """

    def __init__(
        self,
        arrays: Arrays,
        core: ModuleType,
        surface: Callable[[], seamwire_core.Surface],
        pose: Pose | None = None,
    ) -> None:
        self._arrays = arrays
        self._pose = pose
        self._maker = FieldMaker(core, surface)
        self._heat: Part | None = None
        self._visible: frozenset[Part] = frozenset()
        self._request = Request(frozenset())
        self._made: dict[str, tuple[object, object]] = {}
        self._seen: Fields | None = None

    def close(self) -> None:
        """Let go of what works on a thread."""
        self._maker.close()

    def follow(
        self,
        options: ToolOptions,
        source: Source | None,
        strokes: tuple[object, ...] = (),
        crests: bool = False,
    ) -> None:
        """Show what the settings ask for.

        Parameters
        ----------
        options
            The options.
        source
            Where distances are from; None: nowhere.
        strokes
            The library's strokes.
        crests
            Whether `crests` are wanted, seen or not.
        """
        self._heat = options.heat if options.heat in HEATS else None
        parts = {
            "CRESTS": options.show_crests,
            "SILHOUETTE": options.show_silhouette,
            "ELLIPSES": options.show_ellipses,
            "PATHS": options.show_paths,
            "ISOLINES": options.show_bands,
            "INVALID": options.show_invalid,
        }
        self._visible = frozenset(name for name, on in parts.items() if on) | ({self._heat} if self._heat else set())
        wanted = self._visible | ({"CRESTS"} if crests else set())
        far = bool(wanted & {"DISTANCE", "PATHS", "ISOLINES"})
        self._request = Request(
            wanted,
            options.metric,
            options.strength,
            options.clamp,
            options.shown_metric.lower(),
            source if far else None,
            strokes,
        )
        if wanted:
            self._maker.want(self._request)

    @property
    def busy(self) -> bool:
        """Whether something is being computed: `poll` is to be called now and then."""
        return self._maker.busy or self._maker.newest is not self._seen

    def poll(self) -> bool:
        """Return whether there is something new to be seen since the last call. Raises what went wrong on the thread."""
        self._maker.check()
        new = self._maker.newest is not self._seen
        self._seen = self._maker.newest
        return new

    @property
    def fields(self) -> Fields | None:
        """The latest fields that are wanted and belong to the current metric."""
        found = self._maker.newest
        if found is None or not self._request.parts or found.request.metric_key != self._request.metric_key:
            return None
        return found

    @property
    def is_complete(self) -> bool:
        """Whether all that is asked for is there."""
        fields = self.fields
        return fields is not None and fields.request == self._request and not self._maker.busy

    @property
    def crests(self) -> Crests | None:
        """Ridges and valleys, where they were asked for and are computed."""
        found = self._maker.newest
        return None if found is None else found.crests

    @property
    def has_heat(self) -> bool:
        """Whether there is heat to be seen."""
        return self._values() is not None

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
        """Return what is drawn of some data, made when that is first seen."""
        if name not in self._made or self._made[name][0] is not of:
            self._made[name] = of, make()
        return self._made[name][1]

    # Drawing

    def repose(self) -> None:
        """Draw everything where it is seen now."""
        self._made.clear()

    @property
    def _points(self) -> NDArray[np.float64]:
        return self._arrays.points if self._pose is None else self._pose.points

    def _seen_at(self, segments: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return where segments on the mesh, (k, 2, 3), are seen."""
        return segments if self._pose is None else self._pose.places(segments.reshape(-1, 3)).reshape(-1, 2, 3)

    def draw_heat(self, eye: Eye) -> None:
        """Draw the heat over the faces; there must be some."""
        values = self._values()
        scale = HeatScale.of(self._heat, values)

        def make() -> ShadedFaces:
            colors = np.full((len(values), 4), _OPACITY)
            colors[:, :3] = scale.colors(values)
            colors[~np.isfinite(values)] = 0.0
            return ShadedFaces(self._points, self._arrays.triangles, colors)

        self._once("heat", values, make).draw_over(eye)

    def draw_lines(self, eye: Eye) -> None:
        """Draw all else on the surface."""
        invalid = self._shown("INVALID")
        if invalid is not None:
            self._once("invalid", invalid, lambda: self._invalid_faces(invalid)).draw_over(
                eye, [_SPLIT, _REPAIRED, _LEFT]
            )
            with blended("LESS_EQUAL"):
                self._once("pieces", invalid, lambda: Lines(_PIECES, self._seen_at(invalid.edges))).draw(eye)
        ellipses = self._shown("ELLIPSES")
        if ellipses is not None:
            rims, insides = self._once("ellipses", ellipses, lambda: _ellipse_faces(ellipses))
            with blended("LESS_EQUAL"):
                rims.draw(eye, 5.0)
                insides.draw(eye, 6.0)
        with blended("LESS_EQUAL"):
            crests = self._shown("CRESTS")
            if crests is not None:
                for lines in self._once("crests", crests, lambda: self._crest_lines(crests)):
                    lines.draw(eye)
            silhouette = self._shown("SILHOUETTE")
            if silhouette is not None:
                self._seen_silhouette(silhouette, eye).draw(eye)
            isolines = self._shown("ISOLINES")
            if isolines is not None:
                self._once("isolines", isolines, lambda: Lines(_BAND, self._seen_at(isolines.segments))).draw(eye)
            paths = self._shown("PATHS")
            if paths is not None:
                self._once("paths", paths, lambda: _path_lines(paths)).draw(eye)

    def _seen_silhouette(self, silhouette: metric_fields.Silhouette, eye: Eye) -> Lines:
        """Return the silhouette from where it is seen now: found anew where that has changed."""
        kept = self._once("silhouette", silhouette, lambda: [b"", None])
        if kept[0] != eye.key:
            place = eye.place
            segments = np.empty((0, 2, 3)) if place is None else silhouette.seen_from(place)
            kept[:] = eye.key, Lines(_SILHOUETTE, segments)
        return kept[1]

    def _crest_lines(self, crests: Crests) -> tuple[Lines, Lines]:
        is_ridge, segments = crests.ridges[crests.owners[crests.pieces]], self._seen_at(crests.segments)
        return Lines(_VALLEY, segments[~is_ridge]), Lines(_RIDGE, segments[is_ridge])

    def _invalid_faces(self, invalid: metric_fields.Invalid) -> Faces:
        faces = Faces(self._points)
        for color, numbers in enumerate((invalid.split, invalid.repaired, invalid.left)):
            if len(numbers):
                faces.add(color, self._arrays.triangles[numbers])
        return faces

    # Legends

    def legends(self) -> list[Legend]:
        """Return what is to be read, from below."""
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
            ("CRESTS", _of_crests),
            ("SILHOUETTE", _of_silhouette),
            ("PATHS", _of_paths),
        ):
            if (shown := self._shown(part)) is not None:
                found.append(legend(shown))
        if not has_source and parts & {"DISTANCE", "PATHS", "ISOLINES"}:
            found.append(Legend((_NO_SOURCE,)))
        elif not self.is_complete:
            found.append(Legend(("Computing...",)))
        return found


class HeatScale:
    """Which number has which color.

    Parameters
    ----------
    low, high
        The numbers of the first and the last color.
    map
        The colors.
    clipped
        Whether there are numbers above the last.
    """

    def __init__(self, low: float, high: float, map: ColorMap, clipped: bool) -> None:
        self.low, self.high, self.map, self.clipped = low, high, map, clipped

    @classmethod
    def of(cls, heat: Part, values: NDArray[np.float64]) -> HeatScale:
        """Return that of a heat's values."""
        some = values[np.isfinite(values)]
        if heat == "DISTANCE":
            return cls(0.0, float(some.max(initial=0.0)), color_maps.PLASMA, False)
        high = float(np.percentile(np.abs(some), _PERCENTILE)) if len(some) else 0.0
        clipped = bool(np.abs(some).max(initial=0.0) > high)
        if heat == "CONCAVITY":
            return cls(-high, high, color_maps.PURPLE_ORANGE, clipped)
        return cls(0.0, high, color_maps.VIRIDIS, clipped)

    def colors(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the colors of numbers, (n, 3)."""
        width = self.high - self.low
        parts = (values - self.low) / width if width > 0.0 else np.zeros_like(values)
        return color_maps.colors(np.nan_to_num(parts, posinf=1.0), self.map)

    def legend(self, heat: Part) -> Legend:
        """Return the colors with their numbers."""
        middle = 0.5 * (self.low + self.high)
        more = "+" if self.clipped else ""
        less = "\N{MINUS SIGN}" if self.low < 0.0 else ""
        marks = (
            (0.0, f"{less}{_text(abs(self.low))}{more if less else ''}"),
            (0.5, _text(middle)),
            (1.0, f"{_text(self.high)}{more}"),
        )
        titles = {
            "STRENGTH": ("Feature strength s",),
            "CONCAVITY": ("Curvature", "Concave: purple, convex: orange"),
            "DISTANCE": ("Distance in the metric",),
        }
        return Legend(titles[heat], color_maps.steps(self.map, _STEPS), marks)


def _text(number: float) -> str:
    return f"{number:.3g}" if number < 1000.0 else f"{number:.0f}"


def _ellipse_faces(ellipses: Ellipses) -> tuple[ShadedFaces, ShadedFaces]:
    """Return the ellipses as fans: their rims, and the colored insides above them."""
    colors = np.ones((len(ellipses.centres), 4))
    colors[:, :3] = color_maps.colors(_anisotropy_parts(ellipses), color_maps.VIRIDIS)
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


def _path_lines(paths: metric_fields.Paths) -> ColoredLines:
    pieces, lengths = paths.segments()
    colors = np.ones((len(pieces), 4))
    colors[:, :3] = HeatScale.of("DISTANCE", paths.lengths).colors(lengths)
    # The shortest last: above those that go on from where they end.
    order = np.argsort(-lengths, kind="stable")
    return ColoredLines(pieces[order], colors[order], 2.0, lift=4.0)


def _of_invalid(invalid: metric_fields.Invalid) -> Legend:
    title = f"Invalid triangles: {invalid.before}, {invalid.added} added"
    kinds = (
        (_SPLIT, f"{len(invalid.split)} made valid by bisection"),
        (_REPAIRED, f"{len(invalid.repaired)} with changed lengths"),
        (_LEFT, f"{len(invalid.left)} left as holes"),
    )
    return Legend((title,), swatches=tuple(((*color[:3], 1.0), text) for color, text in kinds))


def _of_ellipses(ellipses: Ellipses) -> Legend:
    largest = float(ellipses.anisotropy.max(initial=1.0))
    marks = ((0.0, "1"), (0.5, _text(largest**0.5)), (1.0, _text(largest)))
    return Legend(("Anisotropy; long where paths are short",), color_maps.steps(color_maps.VIRIDIS, _STEPS), marks)


def _of_crests(crests: Crests) -> Legend:
    ridges = int(crests.ridges.sum())
    kinds = ((_RIDGE, ridges, "ridge"), (_VALLEY, len(crests) - ridges, "valley"))
    swatches = tuple((style.color, f"{count} {name}{'' if count == 1 else 's'}") for style, count, name in kinds)
    strongest = _text(float(crests.strengths.max(initial=0.0)))
    return Legend((f"Strength from 1 to {strongest} radians",) if len(crests) else (), swatches=swatches)


def _of_silhouette(_silhouette: metric_fields.Silhouette) -> Legend:
    return Legend((), swatches=((_SILHOUETTE.color, "Silhouette of this view"),))


def _of_bands(isolines: metric_fields.Isolines) -> Legend:
    return Legend((f"Distance bands, {_text(isolines.spacing)} wide",))


def _of_paths(paths: metric_fields.Paths) -> Legend:
    scale = HeatScale.of("DISTANCE", paths.lengths)
    marks = ((0.0, "0"), (0.5, _text(0.5 * scale.high)), (1.0, _text(scale.high)))
    return Legend((f"Length of {len(paths.lengths)} shortest paths",), color_maps.steps(scale.map, _STEPS), marks)
