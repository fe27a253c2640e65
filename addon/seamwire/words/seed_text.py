# SPDX-License-Identifier: GPL-3.0-or-later
"""Chains of seeds as text, and drawn without a hand."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..core.drawing.picture import Role
from ..core.network.picks import undirected
from .names import LOOP_NAMES, pick_name

if TYPE_CHECKING:
    from ..core.drawing.session import Session
    from ..core.network.picks import Edge, Pick
    from ..core.network.wires import LoopKind

_TOKENS = re.compile(r"\([^()]*\)|[^\s,()]+|[()]")
_TOKEN = re.compile(r"(\d+)(?:-(\d+))?")
_VERTEX = re.compile(r"\d+")


Place = tuple[float, float, float]
"""In object coordinates."""


def parse_chains(text: str, find: Callable[[Place], Pick]) -> list[list[Pick]]:
    """Read chains of seeds, such as ``"0 512 88; 7-9 40 7-9"`` or ``"0 (0.1 -0.25 1)"``.

    Parameters
    ----------
    text
        Chains separated by semicolons; in each, seeds separated by spaces or commas: a vertex number, an edge as its
        two vertex numbers with a hyphen between them, or a place in parentheses.
    find
        Returns the point of the surface that is nearest to a place.

    Raises
    ------
    ValueError
        If a seed is malformed or repeats the one before, a chain has fewer than two seeds, or the text has no chain.
    """
    chains: list[list[Pick]] = []
    pick: Pick
    for number, part in enumerate((p for p in text.split(";") if p.strip()), start=1):
        chain: list[Pick] = []
        for token in _TOKENS.findall(part):
            match = _TOKEN.fullmatch(token)
            if match is None:
                pick = find(_place(token, f"Chain {number}"))
            else:
                first, second = match.groups()
                if second is not None and int(first) == int(second):
                    raise ValueError(f"Chain {number}: '{token}' is not an edge: both its vertices are the same")
                pick = int(first) if second is None else (int(first), int(second))
            if chain and undirected(chain[-1]) == undirected(pick):
                raise ValueError(f"Chain {number}: '{token}' comes twice in a row: a wire needs two different ends")
            chain.append(pick)
        if len(chain) < 2:
            raise ValueError(f"Chain {number}: a chain needs at least two seeds, not only '{part.strip()}'")
        chains.append(chain)
    if not chains:
        raise ValueError("There are no chains of seeds: give vertex numbers such as '0 512 88; 7-9 40'")
    return chains


def _place(token: str, where: str) -> Place:
    """Read a place such as ``"(0.1 -0.25 1)"``; raises ValueError, which begins with where it is."""
    what = f"{where}: '{token}' is neither a vertex number, nor an edge such as 7-9, nor a place such as (0.1 0 2.5)"
    try:
        x, y, z = (float(part) for part in token[1:-1].replace(",", " ").split())
    except ValueError:
        raise ValueError(what) from None
    if not (token.startswith("(") and all(map(math.isfinite, (x, y, z)))):
        raise ValueError(what)
    return x, y, z


def parse_edges(text: str) -> list[Edge]:
    """Read edges, such as ``"7-9 40-41"``.

    Raises
    ------
    ValueError
        Where one of them is not an edge.
    """
    edges: list[Edge] = []
    for token in text.replace(",", " ").replace(";", " ").split():
        match = _TOKEN.fullmatch(token)
        if match is None or match[2] is None or int(match[1]) == int(match[2]):
            raise ValueError(f"Loops: '{token}' is not an edge such as 7-9")
        edges.append((int(match[1]), int(match[2])))
    return edges


def parse_pairs(text: str) -> list[Edge]:
    """Read pairs of vertices of two meshes, such as ``"7-12 40-41"``.

    Raises
    ------
    ValueError
        If an item is malformed.
    """
    pairs: list[Edge] = []
    for token in text.replace(",", " ").replace(";", " ").split():
        match = _TOKEN.fullmatch(token)
        if match is None or match[2] is None:
            raise ValueError(f"Pairs: '{token}' is not a pair of vertices such as 7-12")
        pairs.append((int(match[1]), int(match[2])))
    return pairs


def parse_points(text: str, find: Callable[[Place], Pick]) -> list[Pick]:
    """Read vertices and places, such as ``"12 (0.1 -0.25 1)"``; `find` as of `parse_chains`.

    Raises
    ------
    ValueError
        Where one of them is neither.
    """
    tokens = _TOKENS.findall(text.replace(";", " "))
    edge = next((token for token in tokens if _TOKEN.fullmatch(token) and not _VERTEX.fullmatch(token)), None)
    if edge is not None:
        raise ValueError(f"Loops: across the surface they lead through vertices or places, not through edge {edge}")
    return [int(token) if _VERTEX.fullmatch(token) else find(_place(token, "Loops")) for token in tokens]


def draw_loops(session: Session, picks: Iterable[Pick], kind: LoopKind | None = None) -> list[str]:
    """Take the loops or strips through edges, or the closed cuts through points of the surface, without a hand.

    Parameters
    ----------
    session
        That draws along edges, or across the surface.
    picks
        The edges or points, one after the other.
    kind
        The kind of loop through edges, or None for the first one that a click offers.

    Returns
    -------
    list of str
        What could not be done, in words.
    """
    problems = []
    for pick in picks:
        before = session.wires
        if kind is not None and isinstance(pick, tuple) and not _turn_to(session, pick, kind):
            problems.append(f"No {LOOP_NAMES[kind]} runs through {pick_name(pick)}")
            continue
        done = session.loop(pick)
        session.wait()
        if not done or session.wires == before:
            # Report places where the shape suggests no cut.
            why = str(session.message) or f"The loop through {pick_name(pick)} is there already"
            problems.append(why if isinstance(pick, tuple) else f"{pick_name(pick).capitalize()}: {why}")
    return problems


def _turn_to(session: Session, edge: Edge, kind: LoopKind) -> bool:
    """Let a click on an edge take what is asked for; returns whether there is such a thing.

    No two offers are alike: what runs as one before it does is not offered by its own name.
    """
    session.hover(edge, loop=True)
    session.wait()
    edges: dict[LoopKind, set[Edge]] = {}
    for _ in session.picture.offered.kinds:
        offer, shown = session.picture.one(Role.OFFER), session.picture.offered.kind
        if offer is not None and shown is not None:
            edges[shown] = set(offer.edges())
        session.next_candidate()
    wanted: LoopKind | None = kind
    if kind == "FLAT" and kind not in edges:
        border = session.part_border(edge)
        wanted = next((other for other, own in edges.items() if own == border), None)
    elif kind not in edges:
        closed, strip = edges.get("CLOSED"), edges.get("STRIP")
        if kind == "CLOSED" or closed is None:
            wanted = "STRIP" if kind in {"PAST", "WHOLE"} and strip is not None else None
        else:
            wanted = "CLOSED" if strip is None or strip <= closed else "STRIP"
    while wanted in edges and session.picture.offered.kind != wanted:
        session.next_candidate()
    return wanted in edges


def draw_chains(session: Session, chains: Iterable[Sequence[Pick]]) -> list[str]:
    """Draw chains of seeds without a hand, waiting for each wire.

    Returns
    -------
    list of str
        What could not be done, in words. A chain goes on from the last seed that was reached.
    """
    problems = []
    for number, chain in enumerate(chains, start=1):
        session.end_chain()
        for pick in chain:
            done = session.click(pick)
            session.wait()
            if not done or session.message:
                problems.append(f"Chain {number}: {session.message}")
    session.end_chain()
    return problems


@dataclass(frozen=True)
class VertexStroke:
    """A stroke through vertices, that wires follow where it `attracts`, else keep from."""

    vertices: list[int]
    attracts: bool = True


def parse_strokes(text: str) -> list[VertexStroke]:
    """Read strokes, such as ``"0 5 9 12; ~3 4 8"``.

    Parameters
    ----------
    text
        Strokes separated by semicolons; in each, vertex numbers along it separated by spaces or commas. Wires keep from
        a stroke that begins with a tilde. Vertices may be far apart.

    Raises
    ------
    ValueError
        Where something else is there than vertex numbers, or only one of them.
    """
    strokes = []
    for number, part in enumerate((p for p in text.split(";") if p.strip()), start=1):
        part = part.strip()
        tokens = part.removeprefix("~").replace(",", " ").split()
        wrong = next((token for token in tokens if not _VERTEX.fullmatch(token)), None)
        if wrong is not None:
            raise ValueError(f"Stroke {number}: '{wrong}' is not a vertex number")
        if len(tokens) < 2:
            raise ValueError(f"Stroke {number}: a stroke runs through at least two vertices, not only '{part}'")
        strokes.append(VertexStroke([int(token) for token in tokens], attracts=not part.startswith("~")))
    return strokes


def draw_strokes(session: Session, strokes: Iterable[VertexStroke]) -> list[str]:
    """Draw strokes without a hand; return what could not be done, in words. Wires that are drawn later follow them."""
    problems = []
    for number, stroke in enumerate(strokes, start=1):
        if not session.draw_stroke(vertices=stroke.vertices, attracts=stroke.attracts, acts_on="both"):
            problems.append(f"Stroke {number}: {session.message}")
    return problems
