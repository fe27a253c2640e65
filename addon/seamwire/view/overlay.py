# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws pictures of a drawing on the surface, in every 3D view. Decides nothing."""

from __future__ import annotations

from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils import Matrix

from ..core.network.picks import place_of, undirected
from ..core.sketch.picture import LIVE, Role, SeedRole
from ..terms.choices import FINISHES
from ..words import hints
from .failures import failures
from .gpu_draw import (
    ColoredFaces,
    Eye,
    Lines,
    Made,
    blended,
    draw_dots,
    draw_rectangle,
    draw_text,
    set_text,
    text_size,
    text_width,
)
from .layers import Legend, draw_legends
from .theme import Looks, Style, hue_colors, looks_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from numpy.typing import NDArray

    from ..core.islands.islands import Islands
    from ..core.network.network import Snap
    from ..core.network.picks import Edge, Pick
    from ..core.network.wires import Wire
    from ..core.sketch.picture import Picture, ShownWire
    from ..mesh.edit_mesh import Pose
    from .layers import Layer

_NO_ROOM = (0.0, 0.0, 0.0, 0.0)
_DASHES = 12
"""Of the line between the seeds of a wire that has no course, or not yet."""
_KEY_OPACITY = 0.8
_PLATE_OPACITY = 0.7
"""Of the plate under the corner's text. White text stays legible on a white background."""


class Sheet:
    """Lines and dots that are drawn together. Lines that are added first lie below, and dots lie above all lines."""

    def __init__(self, pose: Pose) -> None:
        self._pose = pose
        self._pieces: dict[Style, list[NDArray[np.float64]]] = {}
        self._places: dict[Style, list[NDArray[np.float64]]] = {}
        self.lines: list[Lines] = []
        self.dots: list[tuple[Style, NDArray[np.float64]]] = []

    def curve(self, style: Style, points: NDArray[np.float64]) -> None:
        """Add a curve on the surface, through (k, 3) points of the mesh without modifiers."""
        if len(points) > 1:
            seen = self._pose.places(points)
            self._pieces.setdefault(style, []).append(np.stack([seen[:-1], seen[1:]], axis=1))

    def edges(self, style: Style, edges: Iterable[Edge]) -> None:
        pairs = np.array(list(edges), dtype=np.int64).reshape(-1, 2)
        if len(pairs):
            self._pieces.setdefault(style, []).append(self._pose.points[pairs])

    def dashes(self, style: Style, start: Pick, end: Pick) -> None:
        ends = np.array([place_of(start, self._pose.points), place_of(end, self._pose.points)])
        parts = np.linspace(0.0, 1.0, 2 * _DASHES)[:, None]
        self._pieces.setdefault(style, []).append((ends[0] + parts * (ends[1] - ends[0])).reshape(-1, 2, 3))

    def dot(self, style: Style, pick: Pick) -> None:
        self._places.setdefault(style, []).append(place_of(pick, self._pose.points))

    def finish(self) -> None:
        self.lines = [Lines(style, np.concatenate(parts)) for style, parts in self._pieces.items()]
        self.dots = [(style, np.array(places)) for style, places in self._places.items()]

    def draw_lines(self, eye: Eye, hidden: bool, xray: bool = False) -> None:
        for lines in self.lines:
            if hidden:
                lines.draw_hidden(eye, 1.0 if xray else lines.style.hidden)
            else:
                lines.draw(eye)

    def draw_dots(self, eye: Eye, hidden: bool, xray: bool) -> None:
        for style, places in self.dots:
            inside = eye.shows(places)
            shown = places if inside is None else places[inside]
            if len(shown):
                draw_dots(style, shown, eye, style.hidden if hidden and not xray else 1.0, rim=xray or not hidden)


class Overlay:
    """Draws pictures over one object.

    `to_object`, (3, 3), takes places of the pose to object coordinates. The `layers` lie below the wires, and the list may change.
    """

    def __init__(
        self,
        pose: Pose,
        to_object: NDArray[np.float64],
        *,
        preferences: object | None = None,
        layers: Sequence[Layer] = (),
    ) -> None:
        self._pose = pose
        self._preferences = preferences
        self._layers = layers
        self._to_object = Matrix(to_object.tolist()).to_4x4()
        self._looks = Looks()
        self._made = Made()
        self._strokes: list[tuple[NDArray[np.float64], bool]] = []

    def repose(self) -> None:
        self._made.clear()
        list(self._ask_layers("repose"))

    def draw_in_scene(self, picture: Picture, obj: bpy.types.Object) -> None:
        looks = looks_of(bpy.context.preferences.themes[0].view_3d, self._preferences)
        if looks is not self._looks:
            self._looks = looks
            self._made.clear()
        sheets = self._current_sheets(picture)
        eye = Eye(bpy.context.region_data, obj.matrix_world @ self._to_object)
        found = picture.islands
        if not any(self._ask_layers("draw_heat", eye)) and found is not None and looks.tint > 0.0:
            faces = self._made.of("faces", None, lambda: ColoredFaces(self._pose.points))
            # Without a cut the parts of a mesh are no news, and tinting them would only change its colors.
            self._made.of("tint", found.key, lambda: faces.fill(found.pieces if found.cut else ()))
            faces.draw_over(eye, hue_colors(looks.tint))
        list(self._ask_layers("draw_lines", eye))
        xray = picture.options.xray
        for hidden in (True, False):
            with blended("GREATER" if hidden else "LESS_EQUAL"):
                for sheet in sheets:
                    sheet.draw_lines(eye, hidden, xray)
                for sheet in sheets:
                    sheet.draw_dots(eye, hidden, xray)

    def _ask_layers(self, method: str, *arguments: object) -> Iterator[object]:
        """Call a method of each layer, and yield what it returns. A layer that fails yields None, and the others are still drawn."""
        for number, layer in enumerate(self._layers):
            part = ("layer drawn", id(self), number, method)
            yield failures.attempt(part, partial(getattr(layer, method), *arguments))

    def draw_on_screen(self, picture: Picture, _obj: bpy.types.Object) -> None:
        if not picture.front:
            return
        room = free_room(bpy.context.area, bpy.context.region)
        if room == _NO_ROOM:
            return
        scale = bpy.context.preferences.system.ui_scale
        with blended("NONE"):
            lines = () if self._looks.text == "NONE" else hints.lines(picture)
            high = draw_corner([(line, "") for line in lines], room[:2], scale)
            if self._looks.text == "STEPS":
                left, bottom, width, height = room
                above = (left, high, width, height - (high - bottom))
                draw_legends([Legend(hints.FIRST_LINES)], above, scale, on_left=True)
            draw_legends([box for boxes in self._ask_layers("legends") for box in boxes or ()], room, scale)

    def _current_sheets(self, picture: Picture) -> list[Sheet]:
        """Return the sheets from the lowest to the highest, those made anew whose content has changed."""
        strokes = [(stroke.points, stroke.attracts) for stroke in picture.strokes]
        if picture.stroke is not None:
            strokes.append(picture.stroke)
        bands = [(id(points), len(points), on) for points, on in strokes]
        self._strokes = strokes  # while their points are kept, no other points have the same id
        islands, moved = picture.islands, tuple(wire.id for wire in picture.all(Role.MOVED))
        return [
            self._sheet("bands", bands, self._add_bands, strokes),
            self._sheet("gaps", None if islands is None else islands.key, self._add_gaps, islands),
            self._sheet("kept", (picture.network_revision, moved), self._add_kept, picture),
            self._sheet("live", picture.revision, self._add_live, picture),
        ]

    def _sheet(self, name: str, key: object, add: Callable[[Sheet, object], None], what: object) -> Sheet:
        def make() -> Sheet:
            sheet = Sheet(self._pose)
            add(sheet, what)
            sheet.finish()
            return sheet

        return self._made.of(name, key, make)

    def _add_bands(self, sheet: Sheet, strokes: Iterable[tuple[NDArray[np.float64], bool]]) -> None:
        for points, attracts in strokes:
            sheet.curve(self._looks.attracting if attracts else self._looks.repelling, points)

    def _add_gaps(self, sheet: Sheet, found: Islands | None) -> None:
        """Add what keeps islands from separating: ends of seams, and the way to what they nearly meet."""
        for gap in () if found is None else found.gaps:
            sheet.edges(self._looks.gap, pairwise(gap.path))
            sheet.dot(self._looks.open_end, gap.end)

    def _add_kept(self, sheet: Sheet, picture: Picture) -> None:
        looks = self._looks
        kept = [shown for shown in picture.wires if shown.role is Role.KEPT]
        for shown in kept:
            sheet.edges(looks.mirrored if shown.wire.marks else looks.clear, shown.images)
        for shown in kept:
            if shown.wire.along == "SURFACE":
                sheet.edges(looks.marked if shown.wire.marks else looks.clear, shown.wire.edges())
        for shown in kept:
            sheet.curve(looks.kept if shown.wire.marks else looks.clear, shown.wire.points)

    def _add_live(self, sheet: Sheet, picture: Picture) -> None:
        looks = self._looks
        for shown in picture.wires:
            if shown.role is Role.HOVERED:
                sheet.curve(looks.hovered, shown.wire.points)
                sheet.curve(looks.kept if shown.wire.marks else looks.clear, shown.wire.points)
            elif shown.role is Role.OTHER:
                sheet.curve(looks.other, shown.wire.points)
            elif shown.role in LIVE:
                self._add_live_wire(sheet, shown)
        for start, end in picture.missing:
            sheet.dashes(looks.computing, start, end)
        if picture.line is not None:
            sheet.curve(looks.line, picture.line)
        styles = {SeedRole.LIVE: looks.live_seed, SeedRole.CLOSING: looks.closing, SeedRole.HOVERED: looks.hovered_seed}
        for seed in picture.seeds:
            sheet.dot(styles.get(seed.role, looks.seed), seed.pick)
        self._add_target(sheet, picture.target, picture.one(Role.OFFER))

    def _add_live_wire(self, sheet: Sheet, shown: ShownWire) -> None:
        looks, wire = self._looks, shown.wire
        styles = {Role.COMPUTING: looks.computing, Role.OFFER: looks.loop, Role.EXTENSION: looks.end}
        sheet.edges(looks.mirrored_live, shown.images)
        # Where the seam will be the wire, the edges that it snaps to do not matter.
        if wire.along == "SURFACE" and not (wire.marks and FINISHES[shown.finish].on_wire):
            sheet.edges(looks.will_mark if wire.marks else looks.clear, wire.edges())
        sheet.curve(styles.get(shown.role, looks.active), wire.points)
        if not wire.marks and wire.along == "EDGES":
            sheet.curve(looks.clear, wire.points)

    def _add_target(self, sheet: Sheet, snap: Snap | None, offer: Wire | None) -> None:
        looks = self._looks
        if snap is None or snap.to == "SEED":
            return
        if isinstance(snap.pick, tuple):
            # An offer along the edge shows which edge is meant, and must not be hidden.
            if offer is None or undirected(snap.pick) not in offer.edges():
                sheet.edges(looks.target, [snap.pick])
            return
        styles = {"WIRE": looks.dot_on_seam, "SEAM": looks.dot_on_seam, "FEATURE": looks.dot_on_feature}
        sheet.dot(styles.get(snap.to, looks.dot), snap.pick)


def draw_corner(rows: Sequence[tuple[str, str]], at: tuple[float, float], scale: float) -> float:
    """Draw rows of text above the lower left corner of the free room, top row first. Return the height where the room above begins.

    Each row has a text, and the keys that belong to it.
    """
    size = text_size(scale)
    set_text(size)
    x, y = at[0] + 1.2 * size, at[1] + 1.1 * size
    space = bpy.context.preferences.themes[0].view_3d.space
    beside = x + max((text_width(text) for text, keys in rows if keys), default=0.0) + 1.5 * size
    if not rows:
        return y - 1.1 * size
    right = max((beside + text_width(keys) if keys else x + text_width(text)) for text, keys in rows)
    shade = 0.0 if sum(space.text_hi) > 1.2 else 1.0
    high = y + 1.5 * size * (len(rows) - 1) + 1.3 * size
    plate = shade, shade, shade, _PLATE_OPACITY
    draw_rectangle((x - 0.7 * size, y - 0.8 * size), (right + 0.7 * size, high), plate, 4.0 * scale)
    for text, keys in reversed(rows):
        draw_text(text, (x, y), (*space.text_hi, 1.0))
        if keys:
            draw_text(keys, (beside, y), (*space.text_hi, _KEY_OPACITY))
        y += 1.5 * size
    return y - 1.1 * size


def free_room(area: bpy.types.Area, region: bpy.types.Region) -> tuple[float, float, float, float]:
    """Return what of a region no toolbar, sidebar, header or panel lies over: left, bottom, width, height."""
    left, bottom, right, top = 0, 0, region.width, region.height
    for other in area.regions:
        x, y = other.x - region.x, other.y - region.y
        is_seen = other.type != "WINDOW" and other.width > 1 and other.height > 1
        if not is_seen or x >= region.width or y >= region.height or x + other.width <= 0 or y + other.height <= 0:
            continue
        if other.type == "TOOLS":
            left = max(left, x + other.width)
        elif other.type == "UI":
            right = min(right, x)
        elif other.type != "HUD" and y > region.height // 2:
            top = min(top, y)
        else:
            bottom = max(bottom, y + other.height)
    if right <= left or top <= bottom:
        return _NO_ROOM
    return left, bottom, right - left, top - bottom
