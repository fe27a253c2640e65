# SPDX-License-Identifier: GPL-3.0-or-later
"""What a click means."""

from __future__ import annotations

from enum import Enum, auto


class Intent(Enum):
    """The effect of a click."""

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
    WAIT = auto()
    """Keep a wire as soon as it is computed."""
    MOVE = auto()
    """Leave the dragged seed here."""
    DRAW = auto()
    """Keep the line that is being drawn."""
