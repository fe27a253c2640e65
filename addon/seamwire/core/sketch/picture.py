# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that is to be seen of a drawing, at one moment."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum, auto
from typing import TYPE_CHECKING

from ...terms.choices import DEFAULT_FINISH
from ...terms.options import Options
from ..network.picks import undirected

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy as np
    from numpy.typing import NDArray

    from ...terms.choices import Finish, LoopKind
    from ..islands.islands import Islands
    from ..network.network import Snap
    from ..network.picks import Edge, Pick
    from ..network.strokes import Stroke
    from ..network.wires import Wire


class Role(Enum):
    """The role of a wire in a picture. Later roles lie above earlier ones."""

    KEPT = auto()
    HOVERED = auto()
    """The kept wire under the cursor; it is also there as a kept one."""
    OTHER = auto()
    """A candidate that a click would not keep."""
    MOVED = auto()
    """A kept wire that follows a dragged seed."""
    FOLLOWING = auto()
    """A wire that follows a line that is drawn."""
    COMPUTING = auto()
    """The wire that a click would keep, while it is still being computed."""
    ACTIVE = auto()
    """The wire that a click would keep."""
    OFFER = auto()
    """The loop that a click would add."""
    EXTENSION = auto()
    """The live wire with its way on to the end."""


LIVE = frozenset(Role) - {Role.KEPT, Role.HOVERED, Role.OTHER}
"""The roles of wires that are shown with their mirror images and the edges that they would mark."""


class SeedRole(Enum):
    """The role of a seed in a picture. Later roles lie above earlier ones."""

    PLACED = auto()
    LIVE = auto()
    """The live wire begins there."""
    CLOSING = auto()
    """A wire that leads there closes the chain."""
    HOVERED = auto()
    """It is under the cursor, or dragged."""


class Intent(Enum):
    NOTHING = auto()
    SEED = auto()
    """Begin a chain on the mesh."""
    CONTINUE = auto()
    """Begin a chain at a seed of the network."""
    BRANCH = auto()
    """Begin a chain on a wire."""
    KEEP = auto()
    """Keep the active wire and go on from its end."""
    JOIN = auto()
    """Keep the active wire, which ends on another seed or wire or on a seam, and end the chain."""
    CLOSE = auto()
    """Keep the active wire, which leads to the chain's first seed, and end the chain."""
    LOOP = auto()
    """Keep the loop that is shown."""
    RUN = auto()
    """Keep the wire that runs to the end."""
    MOVE = auto()
    """Leave the dragged seed here."""
    DRAW = auto()
    """Keep the line that is being drawn."""


@dataclass(frozen=True)
class ShownWire:
    """A wire in a picture, with the edges of its mirror images, and how it becomes a seam."""

    wire: Wire
    role: Role
    images: tuple[Edge, ...] = ()
    finish: Finish = DEFAULT_FINISH


@dataclass(frozen=True)
class ShownSeed:
    pick: Pick
    role: SeedRole = SeedRole.PLACED


@dataclass(frozen=True)
class Choice:
    """One of several candidates: its place among them from 0, how many there are, and whether it is straight in the view."""

    number: int = 0
    count: int = 1
    straight: bool = False


@dataclass(frozen=True)
class Offered:
    """The loops that a click offers: their kinds, the likeliest first, the number of the shown one, and whether it bends a cut."""

    kinds: tuple[LoopKind, ...] = ()
    number: int = 0
    bends: bool = False

    @property
    def kind(self) -> LoopKind | None:
        return self.kinds[self.number] if self.number < len(self.kinds) else None


@dataclass(frozen=True)
class Work:
    """The running computation: whether there is one, its finished fraction, and the number of waiting clicks."""

    computing: bool = False
    progress: float = 1.0
    waiting: int = 0


@dataclass(frozen=True)
class Picture:
    """Everything that is to be seen of a drawing. Overlay, text and status bar read nothing else.

    Attributes
    ----------
    revision, network_revision
        Grow with every change of what is seen, and of the kept wires.
    wires, seeds
        From bottom to top.
    missing
        The ends of wires that have no course, or not yet.
    line
        The line that is being drawn, (k, 3).
    target
        The pick under the cursor.
    seed
        Where the live wire begins; None between chains.
    intent
        The effect of a click.
    strength
        How strongly the shown wires follow the shape.
    islands, pointed_island
        The islands that seams make, the gaps in seams, and the island under the cursor.
    stroke
        The stroke that is being drawn: its points, (k, 3), and whether wires will follow it.
    front
        Whether the object is the one under the cursor: text tells of that one.
    """

    options: Options = field(default_factory=Options)
    revision: int = 0
    network_revision: int = 0
    wires: tuple[ShownWire, ...] = ()
    missing: tuple[tuple[Pick, Pick], ...] = ()
    seeds: tuple[ShownSeed, ...] = ()
    strokes: tuple[Stroke, ...] = ()
    line: NDArray[np.float64] | None = None
    target: Snap | None = None
    seed: Pick | None = None
    choice: Choice = Choice()
    offered: Offered = Offered()
    intent: Intent = Intent.NOTHING
    can_close: bool = False
    can_bend: bool = False
    can_undo: bool = False
    can_redo: bool = False
    strength: float = 1.0
    work: Work = Work()
    message: str = ""
    islands: Islands | None = None
    pointed_island: int | None = None
    stroke: tuple[NDArray[np.float64], bool] | None = None
    front: bool = True

    def all(self, role: Role) -> tuple[Wire, ...]:
        return tuple(shown.wire for shown in self.wires if shown.role is role)

    def one(self, *roles: Role) -> Wire | None:
        return next((shown.wire for shown in self.wires if shown.role in roles), None)

    @property
    def active(self) -> Wire | None:
        """The wire that a click would keep, computed or not."""
        return self.one(Role.ACTIVE, Role.COMPUTING)

    @property
    def others(self) -> tuple[Wire, ...]:
        return self.all(Role.OTHER)[::-1]


def shown_seeds(
    placed: Iterable[Pick], live: Pick | None, closing: Pick | None, hovered: Pick | None, begins: Iterable[Pick]
) -> tuple[ShownSeed, ...]:
    """Return the seeds of a picture, from bottom to top. `placed` has all of the network, and `begins` those of a drawn line's wires."""
    found = [
        ShownSeed(pick, SeedRole.LIVE if pick == live else SeedRole.PLACED)
        for pick in placed
        if pick not in (hovered, closing)
    ]
    found += [ShownSeed(undirected(pick)) for pick in begins]
    if closing is not None:
        found.append(ShownSeed(closing, SeedRole.CLOSING))
    if hovered is not None and hovered != closing:
        found.append(ShownSeed(hovered, SeedRole.HOVERED))
    return tuple(found)
