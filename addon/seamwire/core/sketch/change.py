# SPDX-License-Identifier: GPL-3.0-or-later
"""What a drawing asks of the mesh."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from ...terms.choices import FINISHES

if TYPE_CHECKING:
    from ..network.drawn import Drawn
    from ..network.wires import Wire


@dataclass(frozen=True)
class Change:
    """A network that has become another one. The mesh marks and clears the edges of wires, and slides or cuts them."""

    before: Drawn
    after: Drawn

    def __bool__(self) -> bool:
        return self.after.wires != self.before.wires or self.after.strokes != self.before.strokes

    @cached_property
    def drawn(self) -> int:
        """How many wires are new. A part of a wire that was split is not."""
        known = {wire.id for wire in self.before.wires}
        return sum(wire.id not in known and not self._is_part(wire) for wire in self.after.wires)

    @cached_property
    def changed(self) -> frozenset[int]:
        """The numbers of the wires that are new or have another course."""
        return frozenset(wire.id for wire in self._new)

    def on(self, found: Drawn) -> Drawn:
        """Return other drawn wires with the ones that are new or changed here."""
        gone = {wire.vertices for wire in self._gone}
        wires = (*(wire for wire in found.wires if wire.vertices not in gone), *self._new)
        strokes = {id(stroke) for stroke in self.before.strokes}
        return replace(
            found, wires=wires, strokes=(*found.strokes, *(one for one in self.after.strokes if id(one) not in strokes))
        )

    @cached_property
    def _new(self) -> tuple[Wire, ...]:
        same = {id(wire) for wire in self.before.wires}
        return tuple(wire for wire in self.after.wires if id(wire) not in same)

    @cached_property
    def rerouted(self) -> int:
        known = {wire.id: wire for wire in self.before.wires}
        return sum(
            wire.id in known and not wire.like(known[wire.id]) and not self._is_part(wire) for wire in self.after.wires
        )

    @cached_property
    def removed(self) -> int:
        left = {wire.id for wire in self.after.wires}
        return sum(wire.id not in left for wire in self.before.wires)

    @cached_property
    def strokes(self) -> tuple[int, int]:
        before, after = ({stroke.id for stroke in network.strokes} for network in (self.before, self.after))
        return len(after - before), len(before - after)

    @cached_property
    def _gone(self) -> tuple[Wire, ...]:
        left = {id(wire) for wire in self.after.wires}
        return tuple(wire for wire in self.before.wires if id(wire) not in left)

    def _is_part(self, wire: Wire) -> bool:
        return any(_is_run(wire.vertices, own) for own in self._gone)

    def finishes(self, wire: Wire) -> bool:
        """Whether a wire has a finish that edits the mesh, and has changed."""
        return wire.id in self.changed and wire.along == "SURFACE" and wire.marks and FINISHES[wire.finish].edits


def _is_run(part: tuple[int, ...], wire: Wire) -> bool:
    if len(part) >= len(wire.vertices) or part[0] not in wire.vertices:
        return False
    begin = wire.vertices.index(part[0])
    return (wire.vertices * (2 if wire.closed else 1))[begin : begin + len(part)] == part
