# SPDX-License-Identifier: GPL-3.0-or-later
"""Chains and loops drawn without a hand, and what could not be drawn, in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..core.network.picks import pick_name
from ..core.sketch.picture import Role
from ..terms.choices import LOOPS

if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..core.network.picks import Edge, Pick
    from ..core.sketch.sketch import Sketch
    from ..terms.choices import LoopKind


def draw_chain(session: Sketch, seeds: Iterable[Pick]) -> list[str]:
    """Draw a chain of seeds, and return what could not be done. After a failure, it goes on from the last seed that was reached."""
    problems = []
    session.end_chain()
    for pick in seeds:
        done = session.click(pick)
        session.wait()
        if not done or session.told:
            problems.append(session.told)
    session.end_chain()
    return problems


def draw_loop(session: Sketch, pick: Pick, kind: LoopKind | None = None) -> str:
    """Take the loop of a kind, or the first one, through an edge, or the closed cut through a point. Return what could not be done."""
    before = session.wires
    if kind is not None and isinstance(pick, tuple) and not _turn_to(session, pick, kind):
        return f"No {LOOPS[kind]} runs through {pick_name(pick)}"
    done = session.loop(pick)
    session.wait()
    if done and session.wires != before:
        return ""
    # The shape may suggest no cut at a place.
    return session.told or f"The loop through {pick_name(pick)} is there already"


def _turn_to(session: Sketch, edge: Edge, kind: LoopKind) -> bool:
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
        border = session.offering.edges.part_border(edge)
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
