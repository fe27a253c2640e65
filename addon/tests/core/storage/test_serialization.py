# SPDX-License-Identifier: GPL-3.0-or-later
"""What a mesh keeps as text: records in an archive, stored texts, damaged texts."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fake_live import grid_edges
from paper_mesh import PaperMesh
from seamwire.core.network.drawn import Drawn
from seamwire.core.storage.serialization import FORMAT, VERSION, WAS_SEAM, Archive, NewerError, UnreadableError, packed
from setting import use
from table import SIZE, Table, chain, paper

EDGES = grid_edges(SIZE)
FIXTURES = Path(__file__).parent / "fixtures"


def drawn(**options: object) -> PaperMesh:
    """Return a mesh with a chain of two wires, a loop, a wire across the surface and a stroke."""
    table = Table(**options)
    session = table.session
    for pick in (0, 3, 21):
        session.click(pick)
    session.end_chain()
    session.loop((25, 26))
    use(session, along="SURFACE")
    for pick in (30, 32):
        session.click(pick)
    session.draw_stroke(vertices=[1, 8, 20], attracts=False)
    mesh = paper()
    mesh.write(session)
    return mesh


def body(text: str) -> dict[str, Any]:
    return json.loads(text.split(" ", 2)[2])


def text_of(data: object, version: object = VERSION) -> str:
    return f"{FORMAT} {version} {json.dumps(data)}"


# The archive


def test_a_records_number_follows_from_what_it_says() -> None:
    one, other = Archive(), Archive()
    record = {"along": "EDGES"}
    other.add(other.wires, {"along": "SURFACE"})
    assert one.add(one.wires, record) == other.add(other.wires, dict(record))
    assert one.add(one.strokes, {"along": "EDGES"}) != one.add(one.wires, record), "else a label could mean both"


def test_a_label_stands_for_its_members_in_any_order() -> None:
    archive = Archive()
    assert archive.label_of([]) == 0
    assert archive.label_of([77]) == 77
    label = archive.label_of([77, -78, WAS_SEAM])
    assert archive.label_of([WAS_SEAM, 77, -78]) == label
    assert set(archive.members(label)) == {77, -78, WAS_SEAM}
    assert archive.members(123) == (123,), "one of an unknown set is taken for a number"


def test_the_text_holds_what_labels_call_and_no_more() -> None:
    archive = Archive()
    table = Table()
    table.session.click(0)
    table.session.click(3)
    mesh = paper()
    mesh.write(table.session)
    (number,) = set(mesh.labels.values())
    other = mesh.archive.add(mesh.archive.wires, {**mesh.archive.wires[number], "follow": 1})
    assert set(body(mesh.archive.text([number]))["wires"]) == {str(number)}
    assert set(body(mesh.archive.text([number, other, 12345]))["wires"]) == {str(number), str(other)}
    assert archive.text([12345]) == ""
    both = mesh.archive.label_of([number, -other])
    assert Archive.parse(mesh.archive.text([both])).members(both) == mesh.archive.members(both)


def test_the_text_of_many_records_is_the_same_each_time() -> None:
    archive = Archive()
    numbers = [archive.add(archive.wires, {"along": "EDGES", "follow": number}) for number in range(100)]
    text = archive.text(numbers)
    assert body(text)["wires"] == {str(number): archive.wires[number] for number in sorted(numbers)}
    assert archive.text(numbers[::-1]) == text


def test_what_a_label_stands_for_is_kept_though_its_records_are_unknown() -> None:
    archive = Archive()
    label = archive.label_of([WAS_SEAM, 4711])
    assert set(Archive.parse(archive.text([label])).members(label)) == {WAS_SEAM, 4711}


# Texts without a network


@pytest.mark.parametrize("version", [3, 10, "2.1", "x"])
def test_a_newer_text_is_told_from_a_damaged_one(version: object) -> None:
    with pytest.raises(NewerError, match="newer"):
        Archive.parse(text_of({}, version))
    with pytest.raises(NewerError):
        Archive.parse(f"{FORMAT} {version}")


def test_no_text_is_an_empty_archive() -> None:
    assert Archive.parse("").wires == {}


def spoiled(change: Callable[[dict[str, Any]], object]) -> str:
    """Return the text of a network whose last wire, a loop, was changed."""
    data = body(drawn().text)
    number = next(number for number, record in data["wires"].items() if record["closed"])
    change(data["wires"][number])
    return text_of(data)


def line(count: int) -> str:
    """Return a stored line of so many points."""
    return packed(np.zeros((count, 3)))


@pytest.mark.parametrize(
    "text",
    [
        "{",
        "null",
        "seamwire",
        "seamwire 1",
        "seamwire 1 !",
        "a shopping list",
        text_of([]),
        text_of(None),
        text_of({}),
        text_of({"wires": [], "strokes": {}, "sets": {}}),
        text_of({"wires": {"77": 3}, "strokes": {}, "sets": {}}),
        text_of({"wires": {"77": {}}, "strokes": {}, "sets": {}}),
        text_of({"wires": {}, "strokes": {"77": 3}, "sets": {}}),
        text_of({"wires": {}, "strokes": {}, "sets": {"77": 3}}),
        text_of({"wires": {}, "strokes": {}, "sets": {"77": [float("inf")]}}),
        text_of({"wires": {}, "strokes": {}, "sets": {"1": [20, 30]}}),
        drawn().text[:-40],
        *map(
            spoiled,
            [
                lambda wire: wire.update(along=["EDGES"]),
                lambda wire: wire.update(along="UNDER"),
                lambda wire: wire.update(vertices=[27, 28]),
                lambda wire: wire.update(vertices=["27", 28, 29]),
                lambda wire: wire.update(vertices=[-1, 28, 29]),
                lambda wire: wire.update(vertices=3),
                lambda wire: wire.update(ends=[[0.0, 0.0, 0.0]]),
                lambda wire: wire.update(ends=[[0.0, 0.0, float("nan")]] * 2),
                lambda wire: wire.update(start=None),
                lambda wire: wire.update(start=[1, 2, 3]),
                lambda wire: wire.update(start=float("inf")),
                lambda wire: wire.update(through=27),
                lambda wire: wire.update(through=[27]),
                lambda wire: wire.update(kind=["CLOSED"]),
                lambda wire: wire.update(strength="much"),
                lambda wire: wire.update(strength=float("nan")),
                lambda wire: wire.update(mirror=1),
                lambda wire: wire.update(mirror=[3]),
                lambda wire: wire.update(heading=3),
                lambda wire: wire.pop("follow"),
                lambda wire: wire.update(follow=3),
                lambda wire: wire.pop("heading"),
                lambda wire: wire.pop("closed"),
                lambda wire: wire.update(along="SURFACE"),
                lambda wire: wire.update(along="SURFACE", curve="!", places="!"),
                lambda wire: wire.update(
                    along="SURFACE", curve=line(2), places=line(len(wire["vertices"])), faces=[0, 0]
                ),
            ],
        ),
    ],
)
def test_what_is_no_text_of_ours_is_told_in_words(text: str) -> None:
    with pytest.raises(UnreadableError, match="cannot be read") as caught:
        Archive.parse(text)
    assert not isinstance(caught.value, NewerError)


def test_a_loop_of_an_unknown_kind_keeps_its_edges() -> None:
    archive = Archive.parse(spoiled(lambda wire: wire.update(kind="SPIRAL")))
    mesh = drawn()
    mesh.text = ""
    loops = [wire for wire in mesh.read(archive).network.wires if wire.closed]
    assert [(wire.kind, wire.through) for wire in loops] == [(None, None)]


@pytest.mark.parametrize("follow", [0, 1, 2])
def test_which_of_the_wires_one_is_and_what_a_stroke_is_for_are_kept(follow: int) -> None:
    table = Table(ready=(True, True, True))
    session = table.session
    use(session, along="SURFACE")
    session.click(0)
    session.hover(14)
    while session.picture.active.follow != follow:
        session.next_candidate()
    session.draw_stroke(vertices=[1, 2, 3])
    session.click(14)
    mesh = paper()
    mesh.write(session)
    network = mesh.read().network
    assert [wire.follow for wire in network.wires] == [follow]
    assert [stroke.acts_on for stroke in network.strokes] == [("min", "max", "concave")[follow]]


# A stored text


def stored() -> PaperMesh:
    """Return the mesh of the fixture."""
    data = json.loads((FIXTURES / "network.json").read_text())
    mesh = paper(centred=True)
    mesh.text = data["text"]
    mesh.seams = {(one, two) for one, two in data["seams"]}
    mesh.labels = {(one, two): label for one, two, label in data["labels"]}
    return mesh


def test_a_stored_text_is_read() -> None:
    mesh = stored()
    found = mesh.read()
    assert (mesh.unknown(), found.broken) == (0, frozenset())
    wires = {wire.vertices: wire for wire in found.network.wires}
    assert sorted(wires) == [
        (0, 6, 7, 13, 14),
        (5, 4, 3, 9),
        (14, 15, 21),
        (14, 15, 21, 27, 26, 20),
        (24, 25, 26),
        (30, 31, 32),
    ]
    chained, curve, loop, strip = wires[14, 15, 21], wires[5, 4, 3, 9], wires[14, 15, 21, 27, 26, 20], wires[24, 25, 26]
    assert (chained.start, chained.end, chained.heading) == ((13, 14), 21, (13, 14))
    assert wires[0, 6, 7, 13, 14].start == (0, 6)
    assert (loop.closed, loop.kind, loop.through, loop.start) == (True, "CLOSED", (14, 15), (14, 15))
    assert (strip.kind, strip.through) == ("STRIP", (24, 25))
    assert curve.along == "SURFACE"
    assert np.allclose(curve.points[:, 1], [0.0, 0.125, 0.125, 1.125]), "its curve is that which was stored"
    assert all(wire.mirror == (0,) for wire in wires.values())
    assert all(wire.follow == 0 for wire in wires.values())
    assert sorted(curve.images) == chain(0, 1, 2, 8)
    assert all(wire.strength == 10.0 for wire in wires.values() if wire.along == "EDGES" and not wire.kind)
    assert [(one.attracts, one.radius, len(one.points)) for one in found.network.strokes] == [
        (True, 0.5, 12),
        (False, None, 3),
    ]
    session = Table(centred=True).session
    mesh.open(session)
    assert set(session.edges_to_mark()) == mesh.seams - {(17, 23)}, "which was a seam before"
    mesh.write(Drawn(), adopt=False)
    assert mesh.seams == {(17, 23), (2, 8)}, "and so was an edge under a wire"
    assert mesh.labels == {}


def test_archives_whose_numbers_stand_for_different_things_are_not_merged() -> None:
    one, other, third = Archive(), Archive(), Archive()
    number = one.add(one.strokes, {"order": 1})
    other.strokes[number] = {"order": 2}  # the same 31 bits
    assert not one.merge(other)
    assert one.strokes == {number: {"order": 1}}, "what was known stays"
    third.wires[number] = {"vertices": [0, 1]}
    assert not one.merge(third), "a number of a stroke is none of a wire"
    assert one.wires == {}
    again = Archive()
    again.add(again.strokes, {"order": 1})
    more = again.add(again.strokes, {"order": 3})
    assert one.merge(again)
    assert set(one.strokes) == {number, more}


def test_an_archive_knows_its_size_and_drops_the_oldest_records() -> None:
    archive = Archive()
    numbers = [archive.add(archive.wires, {"order": order}) for order in range(10)]
    assert archive.size == sum(len(json.dumps(record)) for record in archive.wires.values())
    size = archive.size
    archive.add(archive.wires, {"order": 3})
    again = Archive()
    again.add(again.wires, {"order": 4})
    assert archive.merge(again)
    assert archive.size == size, "records that are known take no more memory"
    newest = archive.newest(size // 2)
    assert list(newest.wires) == numbers[5:]
    assert newest.size == size // 2
    assert len(archive.wires) == 10, "whoever uses the old archive keeps all"
