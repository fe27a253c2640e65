# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn on the surface of an edited object, below its wires. Other add-ons can add layers, see `interface`."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    import seamwire_core

    from ..core.base.mesh_arrays import Arrays
    from ..core.solver.solver import End
    from ..mesh.pose import Pose
    from ..terms.options import Options
    from .gpu_draw import Eye
    from .legend import Legend

    LayerMaker = Callable[[Arrays, Callable[[], seamwire_core.Surface], Pose], "Layer"]
    """Makes a layer of the mesh, a function that waits for the library's surface of it, and the pose in which it is seen."""


class Layer:
    """A layer over one object. This one shows nothing."""

    @property
    def busy(self) -> bool:
        """Whether something is being computed, so that `poll` must be called from time to time."""
        return False

    def follow(self, options: Options, source: End | None, strokes: tuple[object, ...]) -> None:
        """Show what the settings ask for.

        Parameters
        ----------
        options
            The tool's settings.
        source
            Where distances are from: the seed of the chain, otherwise the active vertex, otherwise the last seed.
        strokes
            The library's scribbles.
        """

    def poll(self) -> bool:
        """Return whether there is something new to see since the last call. Raise what went wrong in a thread."""
        return False

    def repose(self) -> None:
        """Draw everything where the pose has it now."""

    def draw_heat(self, _eye: Eye) -> bool:
        """Color the faces, and return whether there was anything to color. The first layer that does so replaces the islands' tint."""
        return False

    def draw_lines(self, eye: Eye) -> None:
        """Draw everything else."""

    def legends(self) -> list[Legend]:
        """Return the legends, the lowest first."""
        return []

    def close(self) -> None:
        """End all computations."""


makers: list[LayerMaker] = []
"""Make the layers of other add-ons for each object that is drawn on."""
