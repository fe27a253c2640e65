# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what the session shows, on the surface, in every 3D view. Decides nothing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils import Matrix

from ..core.network.network import edges_after, place_of
from . import legend, text_overlay
from .gpu_draw import Eye, Faces, Lines, blended, draw_dots
from .theme import Looks, Style, hue_colors

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import ArrayLike, NDArray

    from ..core.drawing.session import Session
    from ..core.islands.islands import IslandMaker
    from ..core.network.network import Edge, Finish, Pick, Wire
    from .metric_views import MetricViews
    from .stretch_heat import StretchHeat

_NO_ROOM = (0.0, 0.0, 0.0, 0.0)


class _Sheet:
    """What is drawn together: lines by their style, those added first below, and dots above them all."""

    def __init__(self, points: NDArray[np.float64]) -> None:
        self._points = points
        self._pieces: dict[Style, list[NDArray[np.float64]]] = {}
        self._places: dict[Style, list[NDArray[np.float64]]] = {}
        self.lines: list[Lines] = []
        self.dots: list[tuple[Style, NDArray[np.float64]]] = []

    def curve(self, style: Style, points: NDArray[np.float64]) -> None:
        if len(points) > 1:
            self._pieces.setdefault(style, []).append(np.stack([points[:-1], points[1:]], axis=1))

    def edges(self, style: Style, edges: Iterable[Edge]) -> None:
        pairs = np.array(list(edges), dtype=np.int64).reshape(-1, 2)
        if len(pairs):
            self._pieces.setdefault(style, []).append(self._points[pairs])

    def dot(self, style: Style, pick: Pick) -> None:
        """Add a dot at a pick."""
        self._places.setdefault(style, []).append(place_of(pick, self._points))

    def finish(self) -> None:
        self.lines = [Lines(style, np.concatenate(parts)) for style, parts in self._pieces.items()]
        self.dots = [(style, np.array(places)) for style, places in self._places.items()]


class Overlay:
    """The drawing of one session over one object.

    Parameters
    ----------
    session
        What to show.
    obj
        Whose mesh it is.
    points
        (n, 3) the vertices as the session has them.
    to_object
        (3, 3) takes those to object coordinates.
    triangles
        (m, 3) the visible faces, for the tint of islands.
    islands
        Computes the islands of those triangles; None: they are not shown.
    seams
        (s, 2) the edges that are seams.
    preferences
        The add-on's, see `Looks.of`.
    heat
        The stretch of the UV map, drawn in place of the islands' tint where there is something to be seen of it.
    views
        What the metric sees of the mesh; its heat is drawn there too.

    Attributes
    ----------
    xray
        Draw what lies behind the mesh like what lies before it.
    features
        Whether seeds snap to features: said in the text.
    front
        Whether this object is the one under the cursor: its session is the one that the text tells of.
    stroke
        The stroke that is being drawn: its points, (k, 3), as the session has them, and whether wires are to follow it.
    help_rows
        Keys and what they do, while the table of keys is to be seen.
    """

    def __init__(
        self,
        session: Session,
        obj: bpy.types.Object,
        points: NDArray[np.float64],
        to_object: NDArray[np.float64],
        *,
        triangles: NDArray[np.int32] | None = None,
        islands: IslandMaker | None = None,
        seams: ArrayLike = (),
        preferences: object | None = None,
        heat: StretchHeat | None = None,
        views: MetricViews | None = None,
    ) -> None:
        self._session = session
        self._obj = obj
        self._points = points
        self._triangles = triangles
        self._islands = islands
        self._seams = np.asarray(seams, dtype=np.int32).reshape(-1, 2)
        self._preferences = preferences
        self.heat = heat
        self._views = views
        self._to_object = Matrix(to_object.tolist()).to_4x4()
        self._looks = self._current_looks()
        self._kept: tuple[object, _Sheet] = (None, _Sheet(points))
        self._live: tuple[object, _Sheet] = (None, _Sheet(points))
        self._bands: tuple[object, _Sheet] = (None, _Sheet(points))
        self._gaps: tuple[object, _Sheet] = (None, _Sheet(points))
        self._faces: Faces | None = None
        self._tinted: object = None
        self._asked: object = None
        self._cuts: NDArray[np.int32] | None = None
        self._told: object = None
        self._seams_read = 0
        self.xray = False
        self.features = False
        self.front = True
        self.pointed: int | None = None
        """The triangle under the mouse; None: it is elsewhere."""
        self.stroke: tuple[NDArray[np.float64], bool] | None = None
        self.help_rows: Sequence[text_overlay.Row] | None = None
        self.poll()

    def renew(self, obj: bpy.types.Object, seams: NDArray[np.int32]) -> None:
        """Go on over an object that was read anew, with other seams."""
        self._obj = obj
        if not np.array_equal(self._seams, seams):
            self._seams = np.asarray(seams, dtype=np.int32).reshape(-1, 2)
            self._seams_read += 1

    # Segments come when they are ready

    @property
    def busy(self) -> bool:
        """Whether islands are being computed: `poll` is to be called now and then."""
        return self._islands is not None and (self._islands.busy or self._stale)

    @property
    def _stale(self) -> bool:
        return self._asked != (self._session.network_revision, self._seams_read)

    def poll(self) -> bool:
        """Ask for the islands of a network whose cuts have changed.

        Returns
        -------
        bool
            Whether there are islands to be seen that no call before told of.
        """
        if self._islands is None:
            return False
        if self._stale:
            self._asked = (self._session.network_revision, self._seams_read)
            wanted = cuts(self._session, self._seams)
            # A chain that ends turns cuts of wires into seams: the islands stay the same.
            if self._cuts is None or not np.array_equal(wanted, self._cuts):
                self._cuts = wanted
                self._islands.want(self._asked, wanted)
        newest = self._islands.newest
        before, self._told = self._told, None if newest is None else newest.key
        return self._told != before

    @property
    def pointed_island(self) -> int | None:
        """The island under the mouse; None where there is none, or nothing that tells islands apart."""
        found = None if self._islands is None else self._islands.newest
        if found is None or not found.cut or found.count < 2 or self.pointed is None:
            return None
        return int(found.labels[self.pointed])

    # Drawing

    def _current_looks(self) -> Looks:
        return Looks.of(bpy.context.preferences.themes[0].view_3d, self._preferences)

    def draw_in_scene(self) -> None:
        """Draw on the surface; to be called for each region, after the view."""
        self.poll()
        looks = self._current_looks()
        if looks != self._looks:
            self._looks = looks
            self._kept = self._live = self._bands = self._gaps = (None, self._live[1])
        sheets = self._bands_sheet(), self._gaps_sheet(), self._kept_sheet(), self._live_sheet()
        eye = Eye(bpy.context.region_data, self._obj.matrix_world @ self._to_object)
        if self.heat is not None and self.heat.shown:
            self.heat.draw(eye)
        elif self._views is not None and self._views.has_heat:
            self._views.draw_heat(eye)
        else:
            self._draw_tint(eye)
        if self._views is not None:
            self._views.draw_lines(eye)
        passes = [("NONE", False)] if self.xray else [("GREATER", True), ("LESS_EQUAL", False)]
        for test, hidden in passes:
            with blended(test):
                for sheet in sheets:
                    for lines in sheet.lines:
                        lines.draw(eye, lines.style.hidden if hidden else 1.0, rim=not hidden)
                for sheet in sheets:
                    for style, places in sheet.dots:
                        inside = eye.shows(places)
                        shown = places if inside is None else places[inside]
                        if len(shown):
                            draw_dots(style, shown, eye, style.hidden if hidden else 1.0, rim=not hidden)

    def _draw_tint(self, eye: Eye) -> None:
        found = None if self._islands is None else self._islands.newest
        if found is None or self._looks.tint <= 0.0:
            return
        if self._faces is None:
            self._faces = Faces(self._points)
        if found.key != self._tinted:
            self._faces.clear()
            # Without a cut the parts of a mesh are no news, and tinting them would only change its colors.
            for hue, triangles in found.pieces if found.cut else ():
                self._faces.add(hue, triangles)
            self._tinted = found.key
        self._faces.draw_over(eye, hue_colors(self._looks.tint))

    def draw_on_screen(self) -> None:
        """Draw over the region: text and the table of keys."""
        if not self.front:
            return
        left, bottom, width, height = room = free_room(bpy.context.area, bpy.context.region)
        if room == _NO_ROOM:
            return
        scale = bpy.context.preferences.system.ui_scale
        with blended("NONE"):
            if self._looks.text:
                found = None if self._islands is None else self._islands.newest
                lines = text_overlay.lines(
                    self._session, found, xray=self.xray, features=self.features, pointed=self.pointed_island
                )
                text_overlay.draw(lines, (left, bottom), scale, bpy.context.preferences.themes[0].view_3d.space.text_hi)
            legend.draw(self._legends(), room, scale)
            if self.help_rows is not None:
                text_overlay.draw_table(self.help_rows, (left, bottom, width, height), scale)

    def _legends(self) -> list[legend.Legend]:
        of_heat = None if self.heat is None else self.heat.legend()
        others = [] if self._views is None else self._views.legends()
        return others if of_heat is None else [of_heat, *others]

    # What there is to draw

    def _bands_sheet(self) -> _Sheet:
        """Return the strokes, the one that is being drawn among them."""
        strokes = [(stroke.points, stroke.attracts) for stroke in self._session.strokes]
        if self.stroke is not None:
            strokes.append(self.stroke)
        # The points themselves are held: their numbers alone could come again.
        key = [(id(points), len(points), attracts) for points, attracts in strokes]
        if self._bands[0] is not None and self._bands[0][0] == key:
            return self._bands[1]
        sheet = _Sheet(self._points)
        for points, attracts in strokes:
            sheet.curve(self._looks.attracting if attracts else self._looks.repelling, points)
        sheet.finish()
        self._bands = ((key, [points for points, _ in strokes]), sheet)
        return sheet

    def _gaps_sheet(self) -> _Sheet:
        """Return what keeps islands from separating: ends of seams, and the way to what they nearly meet."""
        found = None if self._islands is None else self._islands.newest
        key = (None if found is None else found.key,)
        if self._gaps[0] == key:
            return self._gaps[1]
        sheet = _Sheet(self._points)
        for gap in () if found is None else found.gaps:
            sheet.curve(self._looks.gap, self._points[list(gap.path)])
            sheet.dot(self._looks.open_end, gap.end)
        sheet.finish()
        self._gaps = (key, sheet)
        return sheet

    def _kept_sheet(self) -> _Sheet:
        """Return the kept wires: many, and seldom changed."""
        session = self._session
        moved = [wire.id for wire in session.moved]
        key = (session.network_revision, tuple(moved))
        if self._kept[0] == key:
            return self._kept[1]
        looks, sheet = self._looks, _Sheet(self._points)
        staying = [wire for wire in session.wires if wire.id not in moved]
        for wire in staying:
            sheet.edges(looks.mirrored if wire.marks else looks.clear, wire.images or ())
        for wire in staying:
            if wire.along == "SURFACE":
                sheet.edges(looks.marked if wire.marks else looks.clear, wire.edges())
        for wire in staying:
            sheet.curve(looks.kept if wire.marks else looks.clear, wire.points)
        sheet.finish()
        self._kept = (key, sheet)
        return sheet

    def _live_sheet(self) -> _Sheet:
        """Return what changes with every move of the cursor."""
        session = self._session
        key = (session.revision, session.finish)
        if self._live[0] == key:
            return self._live[1]
        looks, sheet = self._looks, _Sheet(self._points)
        hovered = session.hovered_wire
        if hovered is not None:
            sheet.curve(looks.hovered, hovered.points)
            sheet.curve(looks.kept if hovered.marks else looks.clear, hovered.points)
        for wire in reversed(session.others):
            sheet.curve(looks.other, wire.points)
        for wire in session.moved:
            self._add_live(sheet, wire, looks.active, wire.finish)
        for wire in session.following:
            self._add_live(sheet, wire, looks.active, session.finish)
        if session.drawn is not None:
            sheet.curve(looks.line, session.drawn)
        if session.active is not None:
            style = looks.computing if session.preliminary else looks.active
            self._add_live(sheet, session.active, style, session.finish)
        if session.loop_preview is not None:
            self._add_live(sheet, session.loop_preview, looks.loop, session.finish)
        if session.end_preview is not None:
            self._add_live(sheet, session.end_preview, looks.end)
        self._add_seeds(sheet)
        self._add_target(sheet)
        sheet.finish()
        self._live = (key, sheet)
        return sheet

    def _add_live(self, sheet: _Sheet, wire: Wire, style: Style, finish: Finish = "SNAP") -> None:
        looks = self._looks
        for image in self._session.mirrored(wire):
            sheet.edges(looks.mirrored_live, image.edges())
        # Where the seam will be the wire, the edges that it snaps to do not matter.
        if wire.along == "SURFACE" and not (finish != "SNAP" and wire.marks):
            sheet.edges(looks.will_mark if wire.marks else looks.clear, wire.edges())
        sheet.curve(style, wire.points)
        if not wire.marks and wire.along == "EDGES":
            sheet.curve(looks.clear, wire.points)

    def _add_seeds(self, sheet: _Sheet) -> None:
        session, looks = self._session, self._looks
        hovered, closing, live = session.hovered_seed, session.closing_point, session.seed_place
        if session.dragged_seed is not None:
            hovered = session.dragged_seed
        for pick in session.seeds():
            if pick in (hovered, closing):
                continue
            sheet.dot(looks.live_seed if pick == live else looks.seed, pick)
        for wire in session.following:
            sheet.dot(looks.seed, wire.start)
        if closing is not None:
            sheet.dot(looks.closing, closing)
        if hovered is not None and hovered != closing:
            sheet.dot(looks.hovered_seed, hovered)

    def _add_target(self, sheet: _Sheet) -> None:
        session, looks = self._session, self._looks
        snap = session.target
        if snap is None or snap.to == "SEED":
            return
        if isinstance(snap.pick, tuple):
            sheet.edges(looks.target, [snap.pick])
            return
        styles = {"WIRE": looks.dot_on_wire, "SEAM": looks.dot_on_seam, "FEATURE": looks.dot_on_feature}
        sheet.dot(styles.get(snap.to, looks.dot), snap.pick)


def cuts(session: Session, seams: NDArray[np.int32]) -> NDArray[np.int32]:
    """Return the edges, (c, 2), that are seams with the session's wires, where some are seams already."""
    return edges_after(seams, session.edges_to_mark(), session.edges_to_clear())


def free_room(area: bpy.types.Area, region: bpy.types.Region) -> tuple[float, float, float, float]:
    """Return what of a region no toolbar, sidebar, header or panel lies over: left, bottom, width, height."""
    left, bottom, right, top = 0, 0, region.width, region.height
    for other in area.regions:
        if other.type == "WINDOW" or other.width <= 1 or other.height <= 1:
            continue
        x, y = other.x - region.x, other.y - region.y
        if x >= region.width or y >= region.height or x + other.width <= 0 or y + other.height <= 0:
            continue
        if other.type == "TOOLS":
            left = max(left, x + other.width)
        elif other.type == "UI":
            right = min(right, x)
        elif other.type == "HUD":
            bottom = max(bottom, y + other.height)
        elif y > region.height // 2:
            top = min(top, y)
        else:
            bottom = max(bottom, y + other.height)
    if right <= left or top <= bottom:
        return _NO_ROOM
    return left, bottom, right - left, top - bottom
