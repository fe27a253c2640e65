# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a surface, as Python sees them. The library's own tests have the shapes."""

import numpy as np
import pytest
import seamwire_core as sw
from numpy.typing import NDArray


@pytest.fixture(scope="module")
def box() -> sw.Surface:
    """Return a box of 1 x 1 x 2 with one quad on each side."""
    points = np.array([[x, y, z] for z in (0, 2) for y in (0, 1) for x in (0, 1)], dtype=np.float64)
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    edges = sorted({tuple(sorted(pair)) for q in quads for pair in zip(q, (*q[1:], q[0]), strict=True)})
    return sw.Surface(points, np.array(triangles, dtype=np.int32), edges=np.array(edges, dtype=np.int32))


def edges_of(parts: sw.Parts) -> NDArray[np.int32]:
    return np.concatenate([np.stack([chain[:-1], chain[1:]], axis=1) for chain in parts.borders])


def test_a_box_has_six_parts(box: sw.Surface) -> None:
    parts = sw.PartFinder(box).find(1.0)
    assert parts.count == 6
    assert parts.of_face.dtype == np.int32
    assert len(edges_of(parts)) == 12
    assert parts.of_face.tolist() == sw.face_segments(box, edges_of(parts)).tolist()
    assert repr(parts) == "<Parts: 6 parts>"


def test_edits_and_seams_count(box: sw.Surface) -> None:
    all_edges = edges_of(sw.PartFinder(box).find(1.0))
    assert sw.PartFinder(box).find(0.0).count == 1
    assert sw.PartFinder(box).find(1.0, dropped=all_edges[:1]).count < 6
    assert sw.PartFinder(box).find(1.0, dropped=all_edges).count == 1
    assert sw.PartFinder(box).find(0.0, parted=[0]).count == 2
    around = [(0, 1), (1, 3), (2, 3), (0, 2)]
    assert sw.PartFinder(box).find(0.0, kept=around).count == 2
    assert sw.PartFinder(box, seams=around).find(0.0).count == 2
    assert sw.PartFinder(box, mirror=0, marked=[around]).find(0.0).count == 1


@pytest.mark.parametrize(
    ("arguments", "message"),
    [({"mirror": 5}, "mirror"), ({"marked": [[(0, 99)]]}, "marked"), ({"seams": [(0, -1)]}, "seams")],
)
def test_bad_options_are_refused(box: sw.Surface, arguments: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        sw.PartFinder(box, **arguments)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("amount", "edits", "message"),
    [(2.0, {}, "amount"), (0.5, {"kept": [(0, 99)]}, "kept"), (0.5, {"parted": [99]}, "parted")],
)
def test_bad_requests_are_refused(box: sw.Surface, amount: float, edits: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        sw.PartFinder(box).find(amount, **edits)  # type: ignore[arg-type]


def test_the_stub_names_what_there_is(box: sw.Surface) -> None:
    finder = sw.PartFinder(box)
    assert {name for name in dir(finder) if not name.startswith("_")} == {"find", "by"}
    assert {name for name in dir(finder.find()) if not name.startswith("_")} == {"of_face", "count", "borders"}


def test_cancelled(box: sw.Surface) -> None:
    with pytest.raises(sw.Cancelled):
        sw.PartFinder(box, progress=lambda _: False)


def test_the_search_can_be_cancelled(box: sw.Surface) -> None:
    finder = sw.PartFinder(box)
    with pytest.raises(sw.Cancelled):
        finder.find(progress=lambda _: False)
    assert finder.find(progress=lambda _: True).count == 1
    with pytest.raises(ZeroDivisionError):
        finder.find(progress=lambda done: 1 / 0)


def test_limbs_of_a_dumbbell() -> None:
    angles, heights = np.linspace(0, 2 * np.pi, 24, endpoint=False), np.linspace(-1.9, 1.9, 39)
    radii = np.maximum(0.1, np.sqrt(np.maximum(0, 1 - (np.abs(heights) - 1) ** 2)))
    ring = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    points = np.concatenate([np.column_stack([r * ring, np.full(24, z)]) for r, z in zip(radii, heights, strict=True)])
    first = np.arange(38 * 24)
    beside = first // 24 * 24 + (first + 1) % 24
    sides = [(first, beside, beside + 24), (first, beside + 24, first + 24)]
    surface = sw.Surface(points, np.concatenate([np.stack(side, axis=1) for side in sides]).astype(np.int32))
    finder = sw.PartFinder(surface, by="limbs")
    assert finder.by == "limbs"
    assert sw.PartFinder(surface).by == "rims"
    assert sw.PartFinder(surface, by="panels", front=(0, 0, 1)).by == "panels"
    assert sw.PartFinder(surface, by="shape").by == "rims"
    assert sw.PartFinder(surface, by="shape", scan=True).by in {"rims", "limbs"}
    parts = finder.find(0.5)
    upper = parts.of_face[points[surface.triangles].mean(axis=1)[:, 2] > 0.5]
    lower = parts.of_face[points[surface.triangles].mean(axis=1)[:, 2] < -0.5]
    assert len(set(upper)) == len(set(lower)) == 1
    assert upper[0] != lower[0]
    assert finder.find(0).count == 1
    for wrong in (-1, 2, float("nan")):
        with pytest.raises(ValueError, match="amount"):
            finder.find(wrong)
    with pytest.raises(ValueError, match="by: expected"):
        sw.PartFinder(surface, by="tails")
