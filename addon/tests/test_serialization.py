# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks kept as text, and found again on meshes that have changed."""

from __future__ import annotations

import json

import numpy as np
import pytest
from fake_live import grid_edges, grid_points
from seamwire.core.network import Network
from seamwire.core.serialization import dump, load
from table import SIZE, Table, chain

EDGES = grid_edges(SIZE)


def drawn(along: str = "EDGES") -> tuple[Table, str]:
    table = Table(along)
    session = table.session
    for pick in (0, 3, 21):
        session.click(pick)
    if along == "EDGES":
        session.toggle_marking()
        session.loop((27, 28))
        session.set_mirror((1,))
    return table, dump(session.network, table.points)


def test_a_network_comes_back_as_it_was() -> None:
    table, text = drawn()
    network, problems = load(text, table.points, EDGES)
    assert problems == []
    for wire, was in zip(network.wires, table.session.wires, strict=True):
        assert wire.vertices == was.vertices
        assert wire.points.tolist() == was.points.tolist()
        for name in ("along", "start", "end", "closed", "marks", "heading", "follow", "strength", "kind", "through"):
            assert getattr(wire, name) == getattr(was, name), name
    assert network.mirror == (1,)
    assert network.seed is None
    assert network.lost == ()


def test_a_curve_across_the_surface_is_kept_while_the_mesh_stays() -> None:
    table, text = drawn("SURFACE")
    curve = table.session.wires[0].points + np.array([0.0, 0.25, 0.0])
    data = json.loads(text)
    data["wires"][0]["curve"] = curve.tolist()
    network, problems = load(json.dumps(data), table.points, EDGES)
    assert problems == []
    assert network.wires[0].points.tolist() == curve.tolist()
    moved = table.points + np.where(np.arange(SIZE**2)[:, None] == 1, 0.5, 0.0)
    network, _ = load(json.dumps(data), moved, EDGES)
    assert network.wires[0].points.tolist() == moved[[0, 1, 2, 3]].tolist(), "else it runs along its edges"


def test_vertices_with_other_numbers_are_found_by_their_places() -> None:
    table, text = drawn()
    order = np.random.default_rng(3).permutation(SIZE**2)
    where = np.argsort(order)
    network, problems = load(text, table.points[order], where[EDGES])
    assert problems == []
    assert network.wires[0].vertices == tuple(where[[0, 1, 2, 3]].tolist())
    assert network.wires[1].start == where[3]


def test_a_mesh_that_was_only_moved_about_keeps_its_network() -> None:
    table, text = drawn()
    bent = table.points + np.stack([np.zeros(36), np.zeros(36), np.sin(table.points[:, 0])], axis=1) + 0.3
    network, problems = load(text, bent, EDGES)
    assert problems == []
    assert [wire.vertices for wire in network.wires] == [wire.vertices for wire in table.session.wires]
    assert network.wires[0].points.tolist() == bent[[0, 1, 2, 3]].tolist()


def test_wires_on_a_deleted_part_are_told_and_the_rest_is_there() -> None:
    table, text = drawn()
    kept = np.flatnonzero(
        table.points[:, 1] <= 2.0
    )  # the lower half: the loop, and the end of the second wire, are gone
    edges = EDGES[np.isin(EDGES, kept).all(axis=1)]
    network, problems = load(text, table.points[kept], edges)
    assert [wire.vertices for wire in network.wires] == [(0, 1, 2, 3)]
    assert network.lost == ()
    assert problems == ["2 of 3 stored wires are left out: what they ran on is gone or hidden"]


def test_a_wire_whose_edges_are_gone_is_drawn_anew_between_its_seeds() -> None:
    table, text = drawn()
    edges = EDGES[~(EDGES == [9, 15]).all(axis=1)]
    network, problems = load(text, table.points, edges)
    assert [wire.vertices for wire in network.wires] == [(0, 1, 2, 3), (27, 28, 22, 16, 15, 21)]
    assert problems == ["1 of 3 stored wires ran where edges are gone or hidden: drawn anew between their seeds"]
    again = Table(fork_ready=(False, False))
    assert again.session.resume(network)
    assert len(again.session.wires) == 2
    again.session.click(30)
    again.session.click(32)
    assert again.session.waiting_clicks == 1, "drawing goes on while it is computed"
    again.compute()
    assert [(wire.start, wire.end) for wire in again.session.wires[2:]] == [(30, 32), (3, 21)]
    again.session.undo()
    again.session.undo()
    assert [(wire.start, wire.end) for wire in again.session.wires[2:]] == [(3, 21)]
    assert again.session.undo()
    assert again.session.wires == (), "all of it is one step"


def test_what_cannot_be_drawn_anew_is_said() -> None:
    table, text = drawn()
    network, _ = load(text, table.points, EDGES[~(EDGES == [9, 15]).all(axis=1)])
    again = Table(islands=(21,))
    assert not again.session.resume(network)
    assert again.session.message == "A stored wire could not be drawn again: none reaches vertex 21"


def test_a_resumed_network_is_edited_like_any_other() -> None:
    table, text = drawn()
    network, _ = load(text, table.points, EDGES)
    session = Table().session
    assert session.resume(network)
    assert session.mirror_axes == (1,)
    session.set_mirror(())
    assert session.edges_to_clear() == chain(27, 28, 22, 16, 15, 21, 27)
    session.drag(3)
    session.drag_to(4)
    session.drag_end()
    assert session.wires[1].vertices[0] == 4
    session.undo()
    session.undo()
    session.undo()
    assert session.wires == ()


def test_edge_seeds_come_back_if_their_edge_is_there() -> None:
    table = Table()
    for pick in ((0, 1), (14, 15)):
        table.session.click(pick)
    text = dump(table.session.network, table.points)
    network, _ = load(text, table.points, EDGES)
    assert (network.wires[0].start, network.wires[0].end) == ((0, 1), (14, 15))
    network, problems = load(text, table.points, EDGES[~(EDGES == [14, 15]).all(axis=1)])
    assert network == Network()
    assert len(problems) == 1


@pytest.mark.parametrize(
    "spoil",
    [
        lambda text: "",
        lambda text: "{",
        lambda text: "[]",
        lambda text: "null",
        lambda text: "{}",
        lambda text: "[" * 100_000,
        lambda text: text[: len(text) // 2],
        lambda text: text.replace("seamwire network", "a shopping list"),
        lambda text: text.replace('"version":1', '"version":"one"'),
        lambda text: text.replace('"version":1', '"version":2'),
        lambda text: text.replace('"coordinates":[[', '"coordinates":[[7,'),
        lambda text: text.replace('"vertices":[0', '"vertices":["x"'),
        lambda text: text.replace('"vertices":[0', '"vertices":[1e400'),
        lambda text: text.replace('"vertices":[0', f'"vertices":[{10**30}'),
        lambda text: text.replace('"start":0', '"start":77'),
        lambda text: text.replace('"start":0', '"start":[1,2,3]'),
        lambda text: text.replace('"start":0', '"start":null'),
        lambda text: text.replace('"along":"EDGES"', '"along":["EDGES"]'),
        lambda text: text.replace('"along":"EDGES"', '"along":"UNDER"'),
        lambda text: text.replace('"wires":[', '"wires":[3,'),
        lambda text: text.replace('"mirror":[1]', '"mirror":1'),
        lambda text: text.replace('"strength":10.0', '"strength":"much"'),
        lambda text: text.replace('"kind":"CLOSED"', '"kind":"OPEN"'),
        lambda text: text.replace('"kind":"CLOSED"', '"kind":["CLOSED"]'),
        lambda text: text.replace('"through":[27,28]', '"through":27'),
        lambda text: text.replace('"through":[27,28]', '"through":[27,77]'),
        lambda text: text.replace('"through":[27,28]', '"through":[27]'),
        lambda text: text.replace('"vertices":[0,1,2,3],"start"', '"vertices":[0],"start"'),
    ],
)
def test_what_is_no_network_is_told_in_words(spoil: object) -> None:
    table, text = drawn()
    spoiled = spoil(text)
    assert spoiled != text
    network, problems = load(spoiled, table.points, EDGES)
    assert network == Network()
    assert len(problems) == 1
    assert "cannot" in problems[0]


def test_of_an_empty_mesh_nothing_is_found() -> None:
    _, text = drawn()
    network, problems = load(text, np.empty((0, 3)), np.empty((0, 2), dtype=np.int32))
    assert network.wires == ()
    assert len(problems) == 1


def test_places_that_are_no_numbers_match_nothing() -> None:
    table, text = drawn()
    data = json.loads(text)
    data["coordinates"] = np.full((len(data["vertices"]), 3), np.nan).tolist()
    assert load(json.dumps(data), table.points, EDGES)[0].wires == ()


def test_a_million_vertices_do_not_matter() -> None:
    table, text = drawn()
    many = np.concatenate([np.random.default_rng(0).uniform(10.0, 20.0, (300_000, 3)), table.points])
    network, problems = load(text, many, EDGES + 300_000)
    assert problems == []
    assert network.wires[0].vertices == (300_000, 300_001, 300_002, 300_003)
    assert grid_points(SIZE).tolist() == table.points.tolist()
