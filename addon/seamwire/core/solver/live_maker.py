# SPDX-License-Identifier: GPL-3.0-or-later
"""The library's live wires on a mesh that is given as arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...terms.options import CLAMP_PERCENTILE, STRENGTHS
from ..base import native

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    import seamwire_core
    from numpy.typing import NDArray

    from ...terms.choices import Along
    from ..base.mesh_arrays import Arrays
    from .solver import LiveWire


class LiveMaker:
    """Makes the library's live wires on a mesh. They share one surface, which they build in their own threads.

    Parameters
    ----------
    mesh
        The mesh that wires run on: (n, 3) points, (m, 3) triangles, and (e, 2) edges. Finding parts also needs the edges that are `marked`.
    """

    def __init__(self, mesh: Arrays) -> None:
        self._core = native.load()
        self._mesh = mesh
        self._first: seamwire_core.LiveWire | None = None

    def __call__(self, along: Along) -> LiveWire:
        """Return live wires for one way of running."""
        if self._first is not None:
            return self._first.sibling(**_options(along))
        mesh = self._mesh
        self._first = self._core.LiveWire(mesh.points, mesh.triangles, mesh.edges, **_options(along))
        return self._first

    def wait(self) -> seamwire_core.Surface:
        """Wait for the surface, once there are live wires, and return it; any thread may.

        Raises
        ------
        ValueError
            If wires cannot run on the mesh.
        """
        assert self._first is not None
        self._first.wait_for_surface()
        return self._first.surface

    def part_finder(
        self, mirror: int | None, seams: NDArray[np.int32], progress: Callable[[float], bool]
    ) -> seamwire_core.PartFinder:
        """Return what finds the parts of the mesh; it waits for the surface.

        Parameters
        ----------
        mirror
            The axis over which parts come in pairs, or None.
        seams
            (k, 2) edges that part the mesh already.
        progress
            Is told the fraction done; where it returns False, `seamwire_core.Cancelled` is raised.
        """
        return self._core.PartFinder(
            self.wait(), mirror=mirror, marked=self._mesh.marked, seams=seams, progress=progress
        )

    def face_segments(self, cuts: NDArray[np.int32]) -> NDArray[np.int32]:
        """Return the island of each triangle where edges are cut; it waits for the surface."""
        return self._core.face_segments(self.wait(), cuts)

    def missing_cuts(self, cuts: NDArray[np.int32], islands: NDArray[np.int32]) -> NDArray[np.int32]:
        """Return how many more cuts each island needs to become a disc; it waits for the surface."""
        return self._core.missing_cuts(self.wait(), cuts, islands)


def _options(along: Along) -> dict[str, object]:
    return {"along": along.lower(), "max_anisotropy": STRENGTHS[along], "clamp_percentile": CLAMP_PERCENTILE}
