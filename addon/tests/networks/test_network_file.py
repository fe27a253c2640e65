# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks as files: what was written is read, and what cannot be read is refused with what is wrong and where."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from fake_live import grid_edges, grid_points
from seamwire.core.network.drawn import Drawn
from seamwire.core.network.picks import FacePoint
from seamwire.core.network.strokes import Stroke
from seamwire.core.network.wires import FOLLOWS, Wire
from seamwire.core.offers.edge_loops import KINDS
from seamwire.terms.choices import ALONG, FINISHES, METRICS
from seamwire_networks import network_file
from seamwire_networks.network_file import NetworkFile, NetworkFileError
from seamwire_networks.placing import Shape

SIZE = 6
POINTS = grid_points(SIZE)
EDGES = grid_edges(SIZE)
SCHEMA = json.loads(Path(network_file.__file__).with_name("network.schema.json").read_text(encoding="utf-8"))
STRETCH = np.diag([2.0, 1.0, 0.5])


def triangles() -> np.ndarray:
    a = np.arange(SIZE * SIZE).reshape(SIZE, SIZE)[:-1, :-1].ravel()
    return np.concatenate([np.stack([a, a + 1, a + SIZE + 1], 1), np.stack([a, a + SIZE + 1, a + SIZE], 1)]).astype(
        np.int32
    )


SHAPE = Shape(POINTS, triangles(), EDGES, STRETCH)


def wire(*vertices: int, **options: object) -> Wire:
    picks = {"start": vertices[0], "end": vertices[-1], **options}
    return Wire("EDGES", vertices, POINTS[list(vertices)], **picks)


@pytest.fixture
def network() -> Drawn:
    """All kinds of wires and seeds."""
    loop = (7, 8, 14, 13)
    curve = np.array([[0.0, 5.0, 0.0], [0.7, 4.2, 0.0], [2.0, 4.0, 0.0]])
    return Drawn(
        (
            wire(0, 1, 2, end=(1, 2), strength=10.0, follow=1, mirror=(0,)),
            wire(2, 3, 4, start=(1, 2), heading=(1, 2), planned=True),
            Wire("EDGES", loop, POINTS[[*loop, 7]], (7, 8), (7, 8), closed=True, kind="CLOSED", through=(7, 8)),
            Wire(
                "SURFACE",
                (30, 24, 25, 26),
                curve,
                30,
                FacePoint(3, (26, 27, 33), (0.5, 0.25, 0.25)),
                np.array([41, 38]),
                finish="CUT",
            ),
            wire(28, 29, marks=False),
        ),
        strokes=(Stroke(POINTS[[0, 6]], np.array([[0] * 3, [6] * 3], np.int32), np.array([-1, -1]), radius=0.3),),
    )


def written(network: Drawn) -> NetworkFile:
    return NetworkFile.of(network, SHAPE, name="Hémd", metric="concave", clamp=95.0)


def test_what_is_read_is_what_was_written(network: Drawn) -> None:
    file = NetworkFile.parse(written(network).text())
    assert (file.origin.name, file.origin.vertices, file.metric, file.clamp) == ("Hémd", 36, "concave", 95.0)
    wires = file.wires(SHAPE)
    kept = [one for one in network.wires if one.marks]
    names = ("along", "vertices", "start", "closed", "heading", "follow", "strength", "mirror", "kind", "through")
    for name in (*names, "finish", "planned"):
        assert [getattr(one, name) for one in wires] == [getattr(one, name) for one in kept], name
    assert [one.end for one in wires] == [(1, 2), 4, (7, 8), 26], "a seam ends at vertices"
    for one, before in zip(wires, kept, strict=True):
        assert np.allclose(one.points, before.points, atol=1e-6)
    assert [one.faces for one in wires] == [None] * 4, "another mesh has other triangles"
    (stroke,) = file.strokes_on(SHAPE)
    assert np.allclose(stroke.points, POINTS[[0, 6]]) and stroke.radius == pytest.approx(0.3)
    assert not file.problem_with(SHAPE)


def test_one_more_wire_is_lines_more_and_no_line_changed(network: Drawn) -> None:
    before = written(replace(network, wires=network.wires[:3])).text().splitlines()
    after = written(network).text().splitlines()
    strip = {line.rstrip(",") for line in before}, {line.rstrip(",") for line in after}
    assert not strip[0] - strip[1]
    assert len(strip[1] - strip[0]) == 1, "a wire"


def test_it_is_written_the_same_in_whatever_order_a_mesh_has_its_wires(network: Drawn) -> None:
    assert written(replace(network, wires=network.wires[::-1])).text() == written(network).text()


def test_the_schema_holds(network: Drawn) -> None:
    jsonschema = pytest.importorskip("jsonschema")
    validator = jsonschema.Draft202012Validator(SCHEMA)
    validator.check_schema(SCHEMA)
    data = json.loads(written(network).text())
    assert list(validator.iter_errors(data)) == []
    del data["wires"][0]["heading"]
    assert len(list(validator.iter_errors(data))) == 1


def test_the_schema_has_the_values_of_the_tables() -> None:
    wires, strokes = (SCHEMA["properties"][name]["items"]["properties"] for name in ("wires", "strokes"))
    assert SCHEMA["properties"]["metric"]["enum"] == list(METRICS)
    assert wires["along"]["enum"] == list(ALONG)
    assert wires["finish"]["enum"] == list(FINISHES)
    assert sorted(wires["kind"]["enum"]) == sorted(KINDS)
    assert wires["follow"]["enum"] == list(range(len(FOLLOWS)))
    assert strokes["acts_on"]["enum"] == ["both", *FOLLOWS]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d.update(format="other"), "no Seamwire network"),
        (lambda d: d.update(version=2), "it has version 2, and this one reads up to 1"),
        (lambda d: d.update(version="one"), "its version is not a number"),
        (lambda d: d.pop("mesh"), "damaged: mesh"),
        (lambda d: d["wires"][1].update(vertices=[0, 1, 2, 99]), "damaged: wire 2"),
        (lambda d: d["wires"][2]["vertices"].__setitem__(0, 36), "damaged: wire 3"),
        (lambda d: d["wires"][3].update(curve=[[0, 0]]), "damaged: wire 4"),
        (lambda d: d["wires"][0].update(strength="much"), "damaged: wire 1"),
        (lambda d: d["strokes"][0].update(corners=[[0, 0, 99], [6, 6, 6]]), "damaged: stroke 1"),
    ],
)
def test_what_is_damaged_is_refused_with_where(network: Drawn, change: object, message: str) -> None:
    data = json.loads(written(network).text())
    change(data)
    with pytest.raises(NetworkFileError, match=message):
        NetworkFile.parse(json.dumps(data))


@pytest.mark.parametrize("text", ["", "{", "[" * 100_000, "null", '{"format": "seamwire-network"'])
def test_what_is_no_json_is_refused(text: str) -> None:
    with pytest.raises(NetworkFileError, match=r"damaged: (it|line 1) is not valid JSON|no Seamwire network"):
        NetworkFile.parse(text)


def test_every_cut_of_a_file_is_refused_and_nothing_else_is_raised(network: Drawn) -> None:
    text = written(network).text()
    for end in range(0, len(text) - 2, 97):
        with pytest.raises(NetworkFileError):
            NetworkFile.parse(text[:end])


def test_another_mesh_is_told_by_its_vertices_and_edges(network: Drawn) -> None:
    file = written(network)
    assert (
        str(file.problem_with(replace(SHAPE, points=POINTS[:35])))
        == "The network belongs to a mesh with 36 vertices, but this one has 35"
    )
    fewer = EDGES[~(np.sort(EDGES, axis=1) == [2, 3]).all(axis=1)]
    assert (
        str(file.problem_with(replace(SHAPE, edges=fewer)))
        == "The network belongs to a mesh with other edges: edge 2-3 is missing here"
    )
