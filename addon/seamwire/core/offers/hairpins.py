# SPDX-License-Identifier: GPL-3.0-or-later
"""Hairpins: closed chains that come back beside themselves, which nobody wants first."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from .turns import SurfaceEdges

_BEND = np.radians(135.0)
"""A chain that turns so far within the surface comes back: up, over a rim, and down again."""
_SHORT_WAY = 0.165
"""The part of its length within which it does so. Around two square faces in a row it takes a sixth."""
_CIRCLE = np.radians(270.0)
"""A chain that turns so far in all goes around a patch, and not around a limb."""
_FEW_EDGES = 6
_TINY = 0.2
"""Such a circle of few edges is tiny if the square of its length is below this part of the surface's area."""


def is_hairpin(chain: Sequence[int], points: NDArray[np.float64], half_edges: SurfaceEdges) -> bool:
    """Return whether a closed chain doubles back within a short way, or is a tiny circle of a few edges.

    How far it turns is measured within the surface: a ring that leads over the rims of a thin plate goes straight on.

    Parameters
    ----------
    chain
        The vertices of the chain, the first one not repeated.
    points
        (n, 3) vertices of the mesh.
    half_edges
        Tell how the chain turns.
    """
    turns = half_edges.turns(chain)
    places = points[[*chain, chain[0]]]
    lengths = np.linalg.norm(np.diff(places, axis=0), axis=1)
    length = float(lengths.sum())
    is_tiny = len(chain) <= _FEW_EDGES and length**2 < _TINY * half_edges.area
    return (is_tiny and abs(float(turns.sum())) >= _CIRCLE) or _doubles_back(turns, lengths, _SHORT_WAY * length)


def _doubles_back(turns: NDArray[np.float64], lengths: NDArray[np.float64], way: float) -> bool:
    """Return whether a closed chain turns back on a part of it that is at most `way` long."""
    begins = np.concatenate([[0.0], np.cumsum(lengths)])
    if np.abs(turns).sum() < _BEND:
        return False
    total = begins[-1]
    at = np.concatenate([begins[:-1], begins[:-1] + total])
    sums = np.concatenate([[0.0], np.cumsum(np.concatenate([turns, turns]))])
    for first in range(len(turns)):
        last = np.searchsorted(at, at[first] + way * (1.0 + 1e-9), side="right")
        if np.abs(sums[first + 1 : last + 1] - sums[first]).max(initial=0.0) >= _BEND:
            return True
    return False
