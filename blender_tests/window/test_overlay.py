# SPDX-License-Identifier: GPL-3.0-or-later
"""What the overlay shows of a session: the pixels of the viewport, row by row of what there is to be seen.

The sessions are made by hand: what they say is known, and the drawing of it is all that is tested.
"""

from __future__ import annotations

import weakref
from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from itertools import pairwise
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
import show
import ui as driver
from numpy.typing import NDArray
from scene import add_grid, add_object, edit
from seamwire.core.islands.islands import IslandMaker
from seamwire.core.network.network import Snap
from seamwire.core.network.picks import Edge
from seamwire.core.network.wires import Wire
from seamwire.core.sketch.picture import Picture, Role, ShownWire, shown_seeds
from seamwire.mesh import edit_mesh
from seamwire.mesh.edit_mesh import Pose
from seamwire.terms.options import Options
from seamwire.view.object_view import ShownIslands
from seamwire.view.overlay import Overlay
from seamwire.view.theme import Looks, Style, looks_of

pytestmark = pytest.mark.oldest_and_newest

SIDE = 9
HUES = {"red": (0, 30), "orange": (35, 60), "green": (110, 170), "blue": (190, 225)}


@dataclass
class Drawn:
    """A stroke as the session keeps it."""

    points: NDArray[np.float64]
    attracts: bool = True


class Said:
    """A picture that says what a test wants it to."""

    def __init__(self) -> None:
        self.picture = Picture()
        self.cuts: tuple[Wire, ...] = ()
        self._said: dict[str, object] = {}

    @property
    def network_revision(self) -> int:
        return self.picture.network_revision

    @property
    def wires(self) -> tuple[Wire, ...]:
        return self.cuts

    def edges_to_mark(self) -> list[Edge]:
        return [edge for wire in self.cuts if wire.marks for edge in wire.edges()]

    def edges_to_clear(self) -> list[Edge]:
        return [edge for wire in self.cuts if not wire.marks for edge in wire.edges()]

    def say(self, **what: object) -> None:
        """Say something else from here on: wires and seeds by their roles, anything else as pictures and options have it."""
        self._said.update(what)
        said, images = dict(self._said), self._said.get("images", {})
        said.pop("images", None)

        def wires(role: Role, name: str) -> list[ShownWire]:
            found = said.pop(name, ()) or ()
            found = (found,) if isinstance(found, Wire) else found
            kept = role is Role.KEPT
            own = {wire.id: wire.images or () for wire in found} if kept else images
            return [ShownWire(wire, role, tuple(own.get(wire.id, ())), "SNAP") for wire in found]

        self.cuts = tuple(said.get("wires", ()))
        moved = {wire.id for wire in said.get("moved", ())}
        active = Role.COMPUTING if said.pop("preliminary", False) else Role.ACTIVE
        shown = [
            *(one for one in wires(Role.KEPT, "wires") if one.wire.id not in moved),
            *wires(Role.HOVERED, "hovered_wire"),
            *wires(Role.OTHER, "others")[::-1],
            *wires(Role.MOVED, "moved"),
            *wires(active, "active"),
            *wires(Role.OFFER, "loop_preview"),
            *wires(Role.EXTENSION, "end_preview"),
        ]
        hovered, dragged = said.pop("hovered_seed", None), said.pop("dragged_seed", None)
        seeds = shown_seeds(
            said.pop("placed", ()),
            said.pop("seed_place", None),
            said.pop("closing_point", None),
            hovered if dragged is None else dragged,
            (),
        )
        names = {field.name for field in fields(Options)}
        options = Options(**{name: said.pop(name) for name in names & said.keys()})
        self.picture = Picture(
            options=options,
            revision=self.picture.revision + 1,
            network_revision=self.picture.network_revision + ("wires" in what),
            wires=tuple(shown),
            seeds=seeds,
            **{"strength": options.strength, **said},
        )


class Sight:
    """A grid seen from above with an overlay on it. Vertex y * 9 + x is column x of row y."""

    def __init__(self, ui: driver.Ui, obj: bpy.types.Object | None = None) -> None:
        self.ui = ui
        self.obj = add_grid(SIDE) if obj is None else obj
        ui.wait()
        with ui.override():
            edit()
            bpy.ops.mesh.select_all(action="DESELECT")
        ui.look_from_top(distance=4.0)
        self.arrays = edit_mesh.read(self.obj)
        self.session = Said()
        self.overlay = self.make()
        self.errors: list[Exception] = []
        add = bpy.types.SpaceView3D.draw_handler_add
        self.handles = [
            add(self.draw, ("draw_in_scene",), "WINDOW", "POST_VIEW"),
            add(self.draw, ("draw_on_screen",), "WINDOW", "POST_PIXEL"),
        ]

    def draw(self, part: str) -> None:
        try:
            getattr(self.overlay, part)(self.look(), self.obj)
        except Exception as error:
            self.errors.append(error)

    def make(self, **options: object) -> Overlay:
        return Overlay(Pose(self.arrays), self.arrays.to_object, **options)

    def look(self) -> Picture:
        return self.session.picture

    def wire(self, *vertices: int, along: str = "EDGES", marks: bool = True, points: object = None) -> Wire:
        curve = self.arrays.points[list(vertices)] if points is None else np.array(points)
        return Wire(along, vertices, curve, vertices[0], vertices[-1], marks=marks)

    def at(self, *vertices: int) -> tuple[float, float]:
        return self.ui.on_screen(tuple(self.arrays.points[list(vertices)].mean(axis=0)))

    def tint(self, maker: IslandMaker) -> None:
        """Show the islands that a maker finds."""
        islands = ShownIslands(maker, self.session, ())

        def look() -> Picture:
            islands.poll()
            return replace(self.session.picture, islands=islands.newest)

        self.overlay, self.look = self.make(), look

    def pixels(self, **said: object) -> NDArray[np.float32]:
        self.session.say(**said)
        found = self.ui.screen()
        if self.errors:
            raise self.errors[0]
        return found

    def remove(self) -> None:
        while self.handles:
            bpy.types.SpaceView3D.draw_handler_remove(self.handles.pop(), "WINDOW")


@pytest.fixture
def sight(ui: driver.Ui) -> Iterator[Sight]:
    made = Sight(ui)
    yield made
    made.remove()


def hue_and_strength(pixels: NDArray[np.float32]) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Return the hue in degrees and how far from grey it is, of pixels (..., 3)."""
    rgb = pixels[..., :3]
    high, low = rgb.max(axis=-1), rgb.min(axis=-1)
    chroma = high - low
    safe = np.maximum(chroma, 1e-6)
    red, green, blue = (rgb[..., i] for i in range(3))
    sixth = np.where(
        high == red,
        (green - blue) / safe % 6.0,
        np.where(high == green, (blue - red) / safe + 2.0, (red - green) / safe + 4.0),
    )
    return 60.0 * sixth, chroma


def around(pixels: NDArray[np.float32], at: tuple[float, float], radius: int = 4) -> NDArray[np.float32]:
    x, y = round(at[0]), round(at[1])
    return pixels[y - radius : y + radius + 1, x - radius : x + radius + 1]


def has(pixels: NDArray[np.float32], at: tuple[float, float], hue: str, chroma: float = 0.5, radius: int = 4) -> bool:
    """Whether three pixels or more near a position have a hue, and are that far from grey."""
    return amount(pixels, at, hue, chroma, radius) >= 3


def amount(pixels: NDArray[np.float32], at: tuple[float, float], hue: str, chroma: float = 0.5, radius: int = 4) -> int:
    angle, strength = hue_and_strength(around(pixels, at, radius))
    low, high = HUES[hue]
    return int(((angle >= low) & (angle <= high) & (strength > chroma)).sum())


def bright(pixels: NDArray[np.float32], at: tuple[float, float], radius: int) -> int:
    """Return how many pixels near a position are white."""
    return int((around(pixels, at, radius)[..., :3].min(axis=-1) > 0.9).sum())


def profile(pixels: NDArray[np.float32], one: tuple[float, float], two: tuple[float, float]) -> NDArray[np.float32]:
    """Return the pixels, (k, 3), on the way from one position to another."""
    steps = int(np.hypot(two[0] - one[0], two[1] - one[1]))
    places = np.linspace(one, two, steps).round().astype(int)
    return pixels[places[:, 1], places[:, 0], :3]


def width(pixels: NDArray[np.float32], way: tuple[tuple[float, float], tuple[float, float]]) -> int:
    """Return how many pixels on a way are not what its first one is: the mesh may change from picture to picture."""
    colors = profile(pixels, *way)
    return int(np.count_nonzero(np.abs(colors - colors[0]).max(axis=1) > 0.1))


@pytest.mark.parametrize("colors", ["DARK", "LIGHT"])
@pytest.mark.parametrize("name", show.SHADINGS)
def test_the_active_wire_stands_out_from_the_other_and_from_the_mesh(sight: Sight, name: str, colors: str) -> None:
    show.theme(colors)
    show.shading(sight.ui, name)
    try:
        empty = sight.pixels()
        other, last = sight.wire(36, 45, 54, 63, 64, 65, 66), sight.wire(36, 27, 18, 9, 10, 11, 12)
        seen = sight.pixels(active=sight.wire(*range(36, 45)), others=(other, last))
        for vertex in range(38, 42):
            place = sight.at(vertex, vertex + 1)
            assert has(seen, place, "orange"), f"the active wire at {vertex}"
            assert not has(empty, place, "orange"), "nothing of that color was there before"
        for beside in (sight.at(64, 65), sight.at(10, 11)):
            assert not has(seen, beside, "orange")
            assert has(seen, beside, "blue", chroma=0.25)
        wide = width(seen, crossing(sight, 39, 40))
        thin = width(seen, crossing(sight, 64, 65))
        assert wide >= thin + 2, "the active one is wider too, for those who see no colors"
    finally:
        show.shading(sight.ui, "SOLID")
        show.theme("DARK")


def crossing(sight: Sight, one: int, two: int) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return two positions across the middle of an edge that runs along x."""
    x, y = sight.at(one, two)
    return (x + 4.0, y - 12.0), (x + 4.0, y + 12.0)


def test_a_kept_wire_has_the_seam_color_of_the_theme(sight: Sight) -> None:
    view = bpy.context.preferences.themes[0].view_3d
    name = "seam" if hasattr(view, "seam") else "edge_seam"
    before = tuple(getattr(view, name))
    wire = sight.wire(*range(36, 45))
    assert has(sight.pixels(wires=(wire,)), sight.at(38, 39), "red")
    try:
        setattr(view, name, (0.0, 0.9, 0.35))
        assert has(sight.pixels(), sight.at(38, 39), "green")
    finally:
        setattr(view, name, before)


def orange_width(sight: Sight) -> int:
    """Return how many pixels wide the active wire is."""
    seen = sight.pixels(active=sight.wire(*range(36, 45)))
    angle, chroma = hue_and_strength(profile(seen, *crossing(sight, 39, 40)))
    return int(((angle > 35) & (angle < 60) & (chroma > 0.4)).sum())


def test_the_width_of_lines_comes_from_the_preferences(sight: Sight) -> None:
    before = orange_width(sight)
    sight.overlay = sight.make(preferences=SimpleNamespace(line_width=2.5))
    assert orange_width(sight) >= 2 * before


def test_lines_grow_with_the_display_scale(sight: Sight) -> None:
    view = bpy.context.preferences.view
    before = orange_width(sight)
    try:
        view.ui_scale = 2.0
        sight.ui.wait(4, redraw=True)
        assert orange_width(sight) >= 1.6 * before
    finally:
        view.ui_scale = 1.0
        sight.ui.wait(4, redraw=True)


def test_across_the_surface_the_edges_that_become_seams_are_shown_beside_the_wire(sight: Sight) -> None:
    points = sight.arrays.points
    curve = [points[36] + (0.0, 0.08, 0.0), points[44] + (0.0, 0.08, 0.0)]
    wire = sight.wire(*range(36, 45), along="SURFACE", points=curve)
    for said in ({"wires": (wire,)}, {"wires": (), "active": wire}):
        seen = sight.pixels(**said)
        assert has(seen, sight.at(38, 39), "red", radius=2), "the edges"
        x, y = sight.ui.on_screen(tuple(np.mean(curve, axis=0)))
        assert has(seen, (x, y), "red" if said["wires"] else "orange", radius=2), "the wire"


def gaps(line: NDArray[np.float32]) -> int:
    """Return how often pixels on the way change from light to dark."""
    light = line.min(axis=1) > 0.6
    return int(np.count_nonzero(light[:-1] & ~light[1:]))


def test_a_wire_that_clears_seams_is_dashed_and_not_in_the_color_of_seams(sight: Sight) -> None:
    seen = sight.pixels(wires=(sight.wire(*range(36, 45), marks=False),))
    for vertex in range(37, 43):
        assert not has(seen, sight.at(vertex, vertex + 1), "red")
    assert gaps(profile(seen, sight.at(37), sight.at(43))) >= 6
    plain = sight.pixels(wires=(sight.wire(*range(36, 45)),))
    assert gaps(profile(plain, sight.at(37), sight.at(43))) == 0


def test_dashes_are_as_long_on_the_screen_from_near_and_from_far(sight: Sight) -> None:
    wire = sight.wire(*range(36, 45), marks=False)
    near = sight.pixels(wires=(wire,))
    ends = sight.at(37), sight.at(43)
    count = gaps(profile(near, *ends))
    sight.ui.look_from_top(distance=8.0)
    far = sight.pixels()
    fewer = gaps(profile(far, sight.at(37), sight.at(43)))
    assert fewer == pytest.approx(count / 2, abs=2)


def test_hidden_parts_are_faint_and_in_xray_plain(sight: Sight) -> None:
    at = sight.at(38, 39)
    free = sight.pixels(wires=(sight.wire(*range(36, 45)),))
    assert has(free, at, "red")
    mesh = bpy.data.meshes.new("Cover")
    mesh.from_pydata([(-3, -3, 1), (3, -3, 1), (3, 3, 1), (-3, 3, 1)], [], [(0, 1, 2, 3)])
    cover = bpy.data.objects.new("Cover", mesh)
    bpy.context.collection.objects.link(cover)
    behind = sight.pixels()
    assert not has(behind, at, "red", chroma=0.5)
    assert has(behind, at, "red", chroma=0.08), "reddish still"
    assert has(sight.pixels(xray=True), at, "red")


def test_the_live_wire_is_drawn_over_the_kept_ones(sight: Sight) -> None:
    seen = sight.pixels(wires=(sight.wire(*range(36, 45)),), active=sight.wire(4, 13, 22, 31, 40, 49, 58))
    assert has(seen, sight.at(40), "orange", radius=2)


def test_a_wire_that_is_not_final_is_paler(sight: Sight) -> None:
    at = sight.at(38, 39)
    final = sight.pixels(active=sight.wire(*range(36, 45)))
    preview = sight.pixels(preliminary=True)
    assert amount(preview, at, "orange", chroma=0.6, radius=2) < amount(final, at, "orange", chroma=0.6, radius=2) / 2
    assert has(preview, at, "orange", chroma=0.25)


def test_a_hovered_seed_is_larger_and_the_closing_point_ringed(sight: Sight) -> None:
    at = sight.at(40)
    plain = sight.pixels(placed=(40, 50))
    assert bright(plain, at, 9) > 30
    assert not has(plain, at, "orange", radius=9)
    hovered = sight.pixels(hovered_seed=40)
    assert bright(hovered, at, 9) > bright(plain, at, 9) * 1.3
    assert has(hovered, at, "orange", radius=9)
    assert not has(hovered, sight.at(50), "orange", radius=9), "the others stay as they were"
    closing = sight.pixels(hovered_seed=None, closing_point=40)
    assert has(closing, at, "green", radius=10)
    both = sight.pixels(hovered_seed=40)
    assert has(both, at, "green", radius=10)


def test_the_seed_of_the_live_wire_is_told_from_the_others(sight: Sight) -> None:
    seen = sight.pixels(placed=(40, 50), seed_place=50)
    assert has(seen, sight.at(50), "orange", radius=8)
    assert not has(seen, sight.at(40), "orange", radius=8)


def test_a_seed_on_an_edge_is_shown_on_its_middle(sight: Sight) -> None:
    seen = sight.pixels(placed=((40, 41),))
    assert bright(seen, sight.at(40, 41), 5) > 20
    assert bright(seen, sight.at(41), 5) == 0


def test_wires_follow_a_dragged_seed(sight: Sight) -> None:
    kept = sight.wire(*range(36, 45))
    moved = Wire("EDGES", (36, 45, 54), sight.arrays.points[[36, 45, 54]], 36, 54, id=kept.id)
    seen = sight.pixels(wires=(moved,), moved=(moved,), placed=(36, 54), dragged_seed=54)
    assert has(seen, sight.at(36, 45), "orange")
    assert bright(seen, sight.at(54), 9) > bright(seen, sight.at(36), 9) * 1.3, "the seed in the hand is larger"
    assert not has(seen, sight.at(40, 41), "red"), "no longer where it was"
    back = sight.pixels(wires=(kept,), moved=(), placed=(), dragged_seed=None)
    assert has(back, sight.at(40, 41), "red")


def test_a_hovered_wire_is_lit(sight: Sight) -> None:
    kept = sight.wire(*range(36, 45))
    plain = sight.pixels(wires=(kept,))
    lit = sight.pixels(hovered_wire=kept)
    at = sight.at(40, 41)
    assert bright(lit, at, 6) > bright(plain, at, 6) + 10
    assert has(lit, at, "red")


def test_mirrored_wires_are_thinner_than_the_wire(sight: Sight) -> None:
    kept, image = sight.wire(*range(9, 18)), sight.wire(*range(63, 72))
    seen = sight.pixels(wires=(replace(kept, images=tuple(image.edges())),), images={kept.id: image.edges()})
    own, other = amount(seen, sight.at(12, 13), "red", 0.3), amount(seen, sight.at(66, 67), "red", 0.3)
    assert 0 < other < 0.75 * own
    live = sight.pixels(wires=(), active=kept)
    assert amount(live, sight.at(12, 13), "orange", 0.3) > amount(live, sight.at(66, 67), "orange", 0.3) > 0


def test_the_loop_and_the_run_to_the_end_are_previewed(sight: Sight) -> None:
    loop = sight.wire(30, 31, 32, 41, 50, 49, 48, 39)
    end = sight.wire(*range(9, 18))
    seen = sight.pixels(loop_preview=loop, end_preview=end)
    assert has(seen, sight.at(31, 32), "green")
    assert sum(has(seen, sight.at(a, b), "orange", radius=6) for a, b in pairwise(range(9, 18))) >= 7
    angle, chroma = hue_and_strength(profile(seen, sight.at(10), sight.at(16)))
    on = (chroma > 0.4) & (angle > 30) & (angle < 60)
    assert np.count_nonzero(on[:-1] & ~on[1:]) >= 5, "dashed"


def test_what_a_click_would_take_is_lit_in_its_own_way(sight: Sight) -> None:
    at = sight.at(40)
    empty = bright(sight.pixels(), at, 7)  # the 3D cursor lies there
    assert bright(sight.pixels(target=Snap(40)), at, 7) > empty + 20
    on_wire = sight.pixels(target=Snap(40, "WIRE"))
    assert has(on_wire, at, "red", radius=8)
    assert has(sight.pixels(target=Snap(40, "FEATURE")), at, "blue", chroma=0.25, radius=8)
    assert bright(sight.pixels(target=Snap((40, 41))), sight.at(40, 41), 4) > 8
    assert bright(sight.pixels(target=None), at, 7) == empty


def stroke_over(sight: Sight) -> NDArray[np.float64]:
    """Return a stroke along the row of vertices 36 to 44, a little above it."""
    points = sight.arrays.points
    return np.linspace(points[36], points[44], 60) + np.array((0.0, 0.0, 0.001))


def test_strokes_are_soft_bands_and_those_that_repel_are_barred(sight: Sight) -> None:
    line = stroke_over(sight)
    ends = sight.at(41), sight.at(44)  # beside the 3D cursor
    empty = sight.pixels()

    def changed(seen: NDArray[np.float32]) -> NDArray[np.bool_]:
        return np.abs(profile(seen - empty, *ends)).max(axis=1) > 0.04

    attracting = sight.pixels(strokes=(Drawn(line),))
    assert changed(attracting).mean() > 0.95, "one band"
    across = np.abs(profile(attracting - empty, *crossing(sight, 39, 40))).max(axis=1)
    assert np.count_nonzero(across > 0.04) >= 10, "wide"
    middle, side = across[len(across) // 2], across[len(across) // 2 - 6]
    assert 0.0 < side < 0.8 * middle, "fading towards its sides"
    repelling = sight.pixels(strokes=(Drawn(line, attracts=False),))
    bars = changed(repelling)
    assert np.count_nonzero(bars[:-1] & ~bars[1:]) >= 5, "told apart without colors"
    (angle, _), (other, _) = (
        hue_and_strength(profile(seen - empty + 0.3, *ends).max(axis=0)[None]) for seen in (attracting, repelling)
    )
    assert abs(float(angle[0]) - float(other[0])) > 60.0, "and by them"
    gone = sight.pixels(strokes=())
    assert not changed(gone).any()


def test_a_stroke_is_seen_while_it_is_drawn_and_lies_under_the_wires(sight: Sight) -> None:
    at = sight.at(38, 39)
    empty = sight.pixels()
    drawn = sight.pixels(stroke=(stroke_over(sight), True))
    assert np.abs(around(drawn, at, 1) - around(empty, at, 1)).max() > 0.08
    assert np.abs(around(sight.pixels(stroke=None), at, 1) - around(empty, at, 1)).max() < 0.02
    over = sight.pixels(strokes=(Drawn(stroke_over(sight)),), active=sight.wire(*range(36, 45)))
    assert has(over, at, "orange"), "the wire is on top"


@pytest.mark.parametrize("name", ["WIREFRAME", "XRAY"])
def test_where_blender_shows_all_layers_the_nearest_is_tinted_and_hidden_wires_are_faint(
    ui: driver.Ui, name: str
) -> None:
    lower = [(x / 4.0 - 1.0, y / 4.0 - 1.0, 0.0) for y in range(SIDE) for x in range(SIDE)]
    quads = [(i, i + 1, i + SIDE + 1, i + SIDE) for i in range(SIDE * (SIDE - 1)) if i % SIDE < SIDE - 1]
    upper = [(-1.2, 0.0, 0.5), (1.2, 0.0, 0.5), (1.2, 1.2, 0.5), (-1.2, 1.2, 0.5)]
    count = len(lower)
    sight = Sight(ui, add_object(lower + upper, [*quads, (count, count + 1, count + 2, count + 3)]))
    triangles = sight.arrays.triangles
    maker = IslandMaker(triangles, lambda cuts: (triangles >= count).any(axis=1).astype(np.int32))
    sight.tint(maker)
    try:
        show.shading(ui, name)
        plain = sight.pixels()
        seen = sight.pixels(wires=(sight.wire(*range(18, 27)), sight.wire(*range(54, 63))))
        assert amount(seen, sight.at(58, 59), "red", 0.3, 2) < amount(seen, sight.at(22, 23), "red", 0.3, 2) / 2
        beside = ui.on_screen((1.1, 0.6, 0.5))  # where the upper layer alone is
        one, two = (around(seen - plain, at, 2).mean(axis=(0, 1)) for at in (beside, sight.at(64, 74)))
        assert np.abs(one).max() > 0.03
        assert np.abs(two - one).max() < 0.06, "one layer of tint where there are two faces"
    finally:
        show.shading(ui, "SOLID")
        sight.remove()


def test_styles_are_told_apart_by_more_than_their_hue() -> None:
    looks = Looks()
    styles: list[Style] = [looks.active, looks.other, looks.kept, looks.clear, looks.mirrored, looks.loop]
    told = {(round(sum(style.color[:3]), 1), style.width, style.dash) for style in styles}
    assert len(told) == len(styles)
    assert Looks(line_width=2.0).active.width == 2.0 * looks.active.width


def test_styles_are_made_anew_only_if_the_theme_or_the_preferences_change() -> None:
    theme = bpy.context.preferences.themes[0].view_3d
    preferences = SimpleNamespace(line_width=2.0, tint=0.3, text="NONE")
    looks = looks_of(theme, preferences)
    assert looks_of(theme, preferences) is looks
    assert (looks.tint, looks.text) == (0.3, "NONE")
    preferences.line_width = 1.0
    assert looks_of(theme, preferences).active.width == 0.5 * looks.active.width


def test_a_picture_is_freed_when_another_one_is_drawn(sight: Sight) -> None:
    sight.pixels(wires=(sight.wire(*range(36, 45)),), active=sight.wire(*range(4, 77, 9)))
    first = weakref.ref(sight.session.picture)
    sight.pixels(active=sight.wire(*range(3, 76, 9)))
    assert first() is None
