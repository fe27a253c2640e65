# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks on other meshes: placed on the surface, mirrored, by pairs; connected, with what is not sure and what is missing told."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from seamwire.core.base import native
from seamwire.core.base.geometry import nearest_on_segments
from seamwire.core.network.drawn import Drawn
from seamwire.core.network.strokes import Stroke
from seamwire.core.network.wires import Wire
from seamwire_networks.network_file import NetworkFile, NetworkFileError
from seamwire_networks.placing import PLACED, Landmarks, NearestSurface, Shape, Similarity, doubt_between
from seamwire_networks.transfer import Transfer, transfer

pytest.importorskip("seamwire_core")


def by_numbers(file: NetworkFile, target: Shape) -> Transfer:
    return transfer(file, target, place="NUMBERS")


def by_surface(file: NetworkFile, target: Shape, **options: object) -> Transfer:
    return transfer(file, target, place="SURFACE", **options)


def by_landmarks(file: NetworkFile, source: Shape, target: Shape, pairs: object) -> Transfer:
    return transfer(file, target, place="PAIRS", source=source, pairs=pairs)


def tube(around: int, along: int, bend: float = 0.0) -> Shape:
    """Return a tube of radius 0.3 and length 4 along x, bent to an arc; vertex i * around + j is j of ring i."""
    turn = 2.0 * np.pi * np.arange(around) / around
    x = np.linspace(-2.0, 2.0, along)
    ring = 0.3 * np.stack([np.zeros(around), np.cos(turn), np.sin(turn)], axis=1)
    points = x[:, None, None] * (1.0, 0.0, 0.0) + ring[None] * (1.0, 1.0, 1.3)
    points = points.reshape(-1, 3)
    if bend:
        angle, height = points[:, 0] * bend, 1.0 / bend - points[:, 2]
        points = np.stack([height * np.sin(angle), points[:, 1], 1.0 / bend - height * np.cos(angle)], axis=1)
    number = np.arange(around * along).reshape(along, around)
    a, b = number[:-1].ravel(), number[1:].ravel()
    c, d = np.roll(number, -1, axis=1)[1:].ravel(), np.roll(number, -1, axis=1)[:-1].ravel()
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]).astype(np.int32)
    rings = np.stack([number.ravel(), np.roll(number, -1, axis=1).ravel()], 1)
    return Shape(points, triangles, np.concatenate([np.stack([a, b], 1), rings]).astype(np.int32))


def wire(shape: Shape, vertices: list[int], **options: object) -> Wire:
    around = [*vertices, *(vertices[:1] if options.get("closed") else ())]
    ends = {"start": vertices[0], "end": vertices[-1], "strength": 10.0, **options}
    return Wire("EDGES", tuple(vertices), shape.points[around], **ends)


SOURCE = tube(16, 41)
ALONG = [ring * 16 for ring in range(5, 36)]
ACROSS = [20 * 16 + place for place in range(9)]
RING = [30 * 16 + place for place in range(16)]
COURSES = (ALONG, ACROSS, [*RING, RING[0]])


def network() -> Drawn:
    """A wire along the tube; one from its middle half around; a loop that it crosses."""
    edge = (RING[4], RING[5])
    loop = wire(SOURCE, RING, closed=True, start=edge, end=edge, kind="CLOSED", through=edge)
    return Drawn((wire(SOURCE, ALONG), wire(SOURCE, ACROSS), loop))


@pytest.fixture
def file() -> NetworkFile:
    return NetworkFile.parse(NetworkFile.of(network(), SOURCE).text())


def off(found: Transfer, places: NDArray[np.float64]) -> float:
    """Return how far the middles of marked edges are from the network at most; `places` are the target's vertices in its pose."""
    middles = places[found.seams].mean(axis=1)
    starts = np.concatenate([SOURCE.points[course[:-1]] for course in COURSES])
    ends = np.concatenate([SOURCE.points[course[1:]] for course in COURSES])
    return max(float(nearest_on_segments(place, starts, ends)[1].min()) for place in middles)


def pieces(found: Transfer) -> int:
    """Return in how many parts the seams hang together."""
    of: dict[int, int] = {}

    def root(vertex: int) -> int:
        while of.setdefault(vertex, vertex) != vertex:
            vertex = of[vertex]
        return vertex

    for one, two in found.seams.tolist():
        of[root(one)] = root(two)
    return len({root(vertex) for vertex in of})


@pytest.mark.parametrize("size", [(23, 60), (12, 30), (40, 97)], ids=["odd", "coarser", "finer"])
def test_wires_run_within_an_edge_of_where_they_did_and_hang_together(file: NetworkFile, size: tuple[int, int]) -> None:
    target = tube(*size)
    found = by_surface(file, target)
    assert found.lost == []
    assert off(found, target.places) <= target.spacing.mean()
    assert pieces(found) == 1
    assert {seed.confidence >= 0.9 for seed in found.seeds} == {True}
    assert len(found.seeds) == 3 + 1, "the middle, where one begins, is an end too"
    assert sum(one.closed for one in found.wires) == 1


def test_a_wire_that_the_surface_does_not_lead_gets_seeds(file: NetworkFile) -> None:
    zigzag = [
        10 * 16,
        *[11 * 16 + place for place in range(6)],
        *[12 * 16 + place for place in range(5, -1, -1)],
        13 * 16,
    ]
    drawn = NetworkFile.of(Drawn((wire(SOURCE, zigzag),)), SOURCE)
    target = tube(23, 81)
    found = by_surface(drawn, target)
    assert found.added >= 1
    middles = target.places[found.seams].mean(axis=1)
    course = SOURCE.points[zigzag]
    gaps = [nearest_on_segments(place, course[:-1], course[1:])[1].min() for place in middles]
    assert max(gaps) <= 1.5 * target.spacing.mean()
    ends = [end for one in found.wires for end in (one.vertices[0], one.vertices[-1])]
    assert ends[1:-1:2] == ends[2:-1:2], "each goes on where the one before ends"


def lopsided(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return points of a tube so that one way alone of laying it onto itself fits."""
    x, y, z = points.T
    return np.stack([x, y * (1.0 + 0.2 * x), z * (1.0 + 0.2 * x) + 0.15 * x**2 + 0.1 * (y > 0.0) * y], axis=1)


@pytest.mark.parametrize("scale", [1.0, 3.0])
def test_it_is_aligned_where_it_does_not_lie_on_the_mesh(scale: float) -> None:
    source = replace(SOURCE, points=lopsided(SOURCE.points))
    wires = tuple(replace(one, points=lopsided(one.points)) for one in network().wires)
    file = NetworkFile.of(Drawn(wires), source)
    flat = tube(23, 60)
    turn = np.array([[0.8, -0.6, 0.0], [0.6, 0.8, 0.0], [0.0, 0.0, 1.0]])
    target = replace(flat, points=scale * lopsided(flat.points) @ turn.T + (5.0, -2.0, 1.0))
    assert by_surface(file, target, align=False).wires == []
    found = by_surface(file, target)
    assert found.lost == found.doubts == []
    assert {seed.confidence > 0.5 for seed in found.seeds} == {True}
    assert off(found, flat.places) <= 1.5 * flat.spacing.mean()


def test_where_it_fits_as_well_turned_that_is_said_and_every_seed_is_doubtful(file: NetworkFile) -> None:
    flat = tube(23, 60)
    target = replace(flat, points=flat.points + np.array([5.0, -2.0, 1.0]))
    found = by_surface(file, target)
    assert found.lost == []
    assert [text for text in found.doubts if "network also fits" in str(text)] == found.doubts != []
    assert {seed.degree for seed in found.seeds} == {"doubtful"}
    assert by_surface(file, flat).doubts == [], "it lies on it as it is"


def test_what_only_lies_elsewhere_is_not_called_turned() -> None:
    shifted = replace(Similarity.mirroring(), shift=np.array([2.0, 0.0, 0.0]))
    assert str(doubt_between(Similarity.mirroring(), shifted)).startswith("the network also fits in another place")
    turned = replace(shifted, rotation=np.diag([-1.0, -1.0, 1.0]))
    assert str(doubt_between(Similarity.mirroring(), turned)).startswith(
        "the network also fits if rotated by 180 degrees"
    )


def test_it_is_mirrored(file: NetworkFile) -> None:
    target = tube(23, 60)
    found = by_surface(file, target, mirror=0)
    assert found.lost == []
    assert off(found, target.places * (-1.0, 1.0, 1.0)) <= target.spacing.mean()


def test_mirror_images_of_wires_come_too() -> None:
    one = wire(SOURCE, ACROSS, mirror=(2,))
    file = NetworkFile.of(Drawn((one,)), SOURCE)
    target = tube(23, 60)
    found = by_surface(file, target)
    middles = target.places[found.seams].mean(axis=1)
    assert middles[:, 2].min() < -0.3 and middles[:, 2].max() > 0.3
    same = by_numbers(file, SOURCE)
    assert len(same.seams) == 16, "all around"


def test_places_are_found_on_a_mesh_that_is_stretched_by_its_object(file: NetworkFile) -> None:
    flat = tube(23, 60)
    stretch = np.diag([2.0, 1.0, 1.0])
    target = replace(flat, points=flat.points @ stretch, to_object=np.linalg.inv(stretch))
    found = by_surface(file, target)
    assert found.lost == []
    assert off(found, flat.places) <= flat.spacing.mean()
    assert np.allclose(found.wires[0].points, target.points[list(found.wires[0].vertices)])


def test_what_has_no_place_is_told_and_left_out(file: NetworkFile) -> None:
    whole = tube(23, 61)
    half = whole.triangles[(whole.points[whole.triangles][:, :, 0] < 0.3).all(axis=1)]
    used = np.unique(half)
    target = Shape(whole.points, half, whole.edges[np.isin(whole.edges, used).all(axis=1)])
    found = by_surface(file, target, align=False)
    assert any("loop" in text and "could not be placed" in text for text in map(str, found.lost))
    assert any(seed.vertex is None and str(seed.text).endswith("not placed (0.00)") for seed in found.seeds) or any(
        seed.vertex is None for seed in found.seeds
    )
    middles = target.places[found.seams].mean(axis=1)
    assert len(middles) and middles[:, 0].max() <= 0.35
    assert "not placed" in found.degrees


def test_parts_that_do_not_hang_together_are_told() -> None:
    file = NetworkFile.of(Drawn((wire(SOURCE, ALONG),)), SOURCE)
    target = tube(23, 61)
    middle = (np.abs(target.points[:, 0]) < 0.1)[target.triangles].any(axis=1)
    kept = target.triangles[~middle]
    sides = np.sort(kept[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    there = {tuple(pair) for pair in sides.tolist()}
    edges = np.array([pair for pair in target.edges.tolist() if tuple(sorted(pair)) in there], dtype=np.int32)
    found = by_surface(file, replace(target, triangles=kept, edges=edges), align=False)
    assert found.wires == []
    assert len(found.lost) == 1 and "no wire leads from vertex" in str(found.lost[0])


def test_what_hangs_together_stays_on_one_part() -> None:
    """Of two tubes, one in the other, the outer one was thicker: some of it is nearer to the inner one now."""
    ends_there = [ring * 16 for ring in range(5, 30)]
    drawn = NetworkFile.of(Drawn((wire(SOURCE, ends_there),)), SOURCE)
    inner, outer = tube(16, 41), tube(16, 41)
    closer = np.where(np.abs(outer.points[:, :1] - 0.9) < 0.2, 1.2, 1.03)
    inside = np.where(np.abs(outer.points[:, :1] - 0.9) < 0.2, 1.02, 0.9)
    count = len(inner.points)
    target = Shape(
        np.concatenate([inner.points, outer.points]),
        np.concatenate([inner.triangles, outer.triangles + count]).astype(np.int32),
        np.concatenate([inner.edges, outer.edges + count]).astype(np.int32),
    )
    target.points[:count, 1:] *= inside
    target.points[count:, 1:] *= closer
    found = by_surface(drawn, target, align=False)
    assert found.lost == []
    assert all(min(one.vertices) >= count for one in found.wires), "all on the outer one"
    assert pieces(found) == 1


@pytest.mark.parametrize("bend", [0.2, 0.4])
def test_pairs_find_another_pose_with_another_topology(file: NetworkFile, bend: float) -> None:
    straight, target = tube(24, 61), tube(24, 61, bend)

    def at(shape: Shape, x: float, turn: float) -> int:
        place = np.array([x, 0.3 * np.cos(turn), 0.39 * np.sin(turn)])
        return int(np.linalg.norm(shape.places - place, axis=1).argmin())

    marks = [(-2.0, 0.0), (-2.0, 1.6), (-2.0, 3.2), (2.0, 0.0), (2.0, 1.6), (0.0, 3.2), (0.0, 4.7)]
    pairs = [(at(SOURCE, *mark), at(straight, *mark)) for mark in marks]
    found = by_landmarks(file, SOURCE, target, pairs)
    assert found.lost == []
    assert all(seed.confidence >= 0.25 for seed in found.seeds)
    assert off(found, straight.places) <= 2.0 * target.spacing.mean()
    assert pieces(found) == 1
    # The nearest surface of the bent tube, without pairs, is elsewhere.
    wrong = by_surface(file, target)
    assert wrong.lost or off(wrong, straight.places) > 2.0 * target.spacing.mean()


def test_where_pairs_leave_it_open_seeds_are_less_sure(file: NetworkFile) -> None:
    target = tube(24, 61)
    line = [(0, 0), (20 * 16, 30 * 24), (40 * 16, 60 * 24)]
    few = Landmarks(SOURCE, target, line).place(np.array([10 * 16 + 4]))
    more = Landmarks(SOURCE, target, [*line, (4, 6), (40 * 16 + 4, 60 * 24 + 6), (20 * 16 + 8, 30 * 24 + 12)]).place(
        np.array([10 * 16 + 4])
    )
    assert few.confidence[0] < 0.5 < more.confidence[0]


def test_distances_are_in_object_coordinates() -> None:
    pairs = [(0, 0), (160, 160), (320, 320)]
    landmarks = Landmarks(SOURCE, SOURCE, pairs)
    placed = landmarks.place(np.arange(0, 640, 37))
    assert np.allclose(landmarks._here[16 * 10, 0], 1.0, atol=1e-6), "straight along the tube"
    assert np.allclose(placed.places[0], SOURCE.places[0])


def test_a_place_that_is_edges_off_is_not_sure() -> None:
    """The same pairs and the same stretch: on a fine mesh it is many edges."""
    source = tube(16, 41)
    line = [(ring, turn) for ring in (0, 0.5, 1) for turn in (0, 0.5)]

    def confidence(around: int, along: int) -> float:
        target = tube(around, along)
        target.points[:, 0] += 0.15 * np.cos(0.25 * np.pi * target.points[:, 0])
        pairs = [
            (round(ring * 40) * 16 + round(turn * 16), round(ring * (along - 1)) * around + round(turn * around))
            for ring, turn in line
        ]
        return float(Landmarks(source, target, pairs).place(np.array([10 * 16])).confidence[0])

    assert confidence(16, 41) > 0.75 > 0.5 > confidence(96, 241) >= 0.25


@pytest.mark.parametrize(
    ("pairs", "message"),
    [
        ([(0, 0), (1, 1)], "three pairs"),
        ([(0, 0), (1, 1), (2, 99999)], "vertex 99999 is not on a visible face of the target"),
    ],
)
def test_pairs_that_are_wrong_are_refused(file: NetworkFile, pairs: list, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        by_landmarks(file, SOURCE, tube(12, 30), pairs)


def test_by_numbers_the_same_edges_are_marked_and_another_mesh_is_refused(file: NetworkFile) -> None:
    posed = tube(16, 41, 0.5)
    found = by_numbers(file, posed)
    wanted = {edge for one in network().wires for edge in one.edges()}
    assert {tuple(edge) for edge in found.seams.tolist()} == wanted
    with pytest.raises(NetworkFileError, match="a mesh with 656 vertices"):
        by_numbers(file, tube(12, 30))


def test_automatic_takes_numbers_on_the_same_mesh_and_otherwise_the_surface(file: NetworkFile) -> None:
    read = NetworkFile.parse(file.text())
    target = tube(23, 60)
    found = transfer(read, target)
    assert len(found.seams) and np.array_equal(found.seams, by_surface(file, target).seams)
    same = {tuple(edge) for edge in transfer(read, SOURCE).seams.tolist()}
    assert same == {edge for one in network().wires for edge in one.edges()}


@pytest.mark.parametrize("place", ["SURFACE", "PAIRS"])
def test_a_transfer_tells_its_progress_and_can_be_stopped(file: NetworkFile, place: str) -> None:
    target = tube(23, 60)
    pairs = [(0, 0), (4, 6), (8, 12), (40 * 16, 59 * 23)]
    seen: list[float] = []

    def note(fraction: float) -> bool:
        seen.append(fraction)
        return True

    assert transfer(file, target, place=place, source=SOURCE, pairs=pairs, progress=note).wires
    assert seen == sorted(seen)
    assert seen[0] == 0.0 and 0.5 < seen[-1] < 1.0
    with pytest.raises(native.load().Cancelled):
        transfer(file, target, place=place, source=SOURCE, pairs=pairs, progress=lambda fraction: fraction < 0.5)


def test_measuring_distances_can_be_stopped_at_each_step(file: NetworkFile) -> None:
    pairs = [(0, 0), (4, 6), (8, 12), (40 * 16, 59 * 23)]
    for least in (0.01, 0.1, 0.2, 0.25):
        seen: list[float] = []

        def stop(fraction: float, least: float = least, seen: list[float] = seen) -> bool:
            seen.append(fraction)
            return fraction < least

        with pytest.raises(native.load().Cancelled):
            transfer(file, tube(23, 60), place="PAIRS", source=SOURCE, pairs=pairs, progress=stop)
        assert seen[-1] >= least > seen[-2]
        assert seen[-1] < PLACED


@pytest.mark.parametrize("work", ["__init__", "find"])
def test_a_search_for_the_nearest_point_can_be_stopped(work: str) -> None:
    asked: list[bool] = []

    def stop(_fraction: float) -> bool:
        asked.append(True)
        return work == "find" and len(asked) < 2

    surface = NearestSurface(SOURCE, stop)
    with pytest.raises(native.load().Cancelled):
        surface.nearest(np.tile(SOURCE.places, (100, 1)))
    assert len(asked) == (2 if work == "find" else 1)


def test_choices_that_do_not_fit_are_refused(file: NetworkFile) -> None:
    with pytest.raises(ValueError, match="Mirror needs Place: Nearest Surface"):
        transfer(file, SOURCE, place="NUMBERS", mirror=0)
    with pytest.raises(ValueError, match="Pairs need the source object"):
        by_landmarks(file, None, SOURCE, [(0, 0), (1, 1), (2, 2)])


def test_strokes_come_too() -> None:
    rows = np.array([8 * 16, 9 * 16, 10 * 16, 11 * 16])
    stroke = Stroke(
        SOURCE.points[rows], np.repeat(rows[:, None], 3, 1).astype(np.int32), np.full(4, -1), attracts=False
    )
    drawn = NetworkFile.of(Drawn((wire(SOURCE, ACROSS),), strokes=(stroke,)), SOURCE)
    found = by_surface(drawn, tube(23, 60))
    (there,) = found.strokes
    assert not there.attracts
    assert np.allclose(there.points, SOURCE.points[rows], atol=0.01)


def test_sides_that_face_away_do_not_count() -> None:
    points = np.array([[x, y, z] for z in (0.0, 0.01) for x, y in ((0, 0), (1, 0), (0, 1))], dtype=float)
    shape = Shape(points, np.array([[0, 2, 1], [3, 4, 5]], np.int32), np.array([[0, 1], [3, 4]], np.int32))
    place = np.array([[0.2, 0.2, 0.008]])
    assert NearestSurface(shape).nearest(place, np.array([[0.0, 0.0, -1.0]]))[0].tolist() == [0]
    assert NearestSurface(shape).nearest(place, np.array([[0.0, 0.0, 1.0]]))[0].tolist() == [1]


def test_a_similarity_is_found_again() -> None:
    draw = np.random.default_rng(5)
    points = draw.normal(size=(20, 3))
    rotation, _ = np.linalg.qr(draw.normal(size=(3, 3)))
    rotation *= np.sign(np.linalg.det(rotation))
    found = Similarity.between(points, Similarity(2.5, rotation, np.array([1.0, 2.0, 3.0])).of(points))
    assert found.scale == pytest.approx(2.5)
    assert np.allclose(found.rotation, rotation) and np.allclose(found.shift, [1.0, 2.0, 3.0])


def test_a_crease_stays_on_the_crease() -> None:
    """A roof whose ridge lies off the middle of the nearest column: its seed goes to the ridge, a flat one to the nearest vertex."""
    x, y = np.meshgrid([-1.0, -0.5, 0.0, 0.5, 1.0], np.arange(3.0), indexing="ij")
    points = np.stack([x.ravel(), y.ravel(), -np.abs(x.ravel())], axis=1)
    number = np.arange(15).reshape(5, 3)
    a, b, c, d = number[:-1, :-1].ravel(), number[1:, :-1].ravel(), number[1:, 1:].ravel(), number[:-1, 1:].ravel()
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]).astype(np.int32)
    edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0).astype(np.int32)
    surface = NearestSurface(Shape(points, triangles, edges))
    place = np.array([0.3, 1.0, -0.3])
    triangle = int(surface.nearest(place[None])[0][0])
    assert surface.vertex(triangle, place, crease=90.0) == 7
    assert surface.vertex(triangle, place, crease=5.0) == 10
