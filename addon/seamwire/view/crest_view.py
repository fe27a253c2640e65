# SPDX-License-Identifier: GPL-3.0-or-later
"""The ridges and valleys of one mesh: found in a thread, drawn over the mesh, and offered to the session."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..core.base import native
from ..core.base.newest import Newest
from ..core.fields.crests import Crests
from .gpu_draw import Lines, blended
from .layers import Layer, Legend
from .theme import Style

if TYPE_CHECKING:
    from collections.abc import Callable

    import seamwire_core

    from ..mesh.pose import Pose
    from ..terms.options import Options
    from .gpu_draw import Eye

_RIDGE = Style((0.98, 0.45, 0.10, 1.0), 2.0, halo=1.0, lift=4.0)
_VALLEY = Style((0.20, 0.50, 1.0, 1.0), 2.0, halo=1.0, lift=4.0)


class CrestView(Layer):
    """The layer of ridges and valleys. `surface` returns the library's surface of the mesh. A thread calls it, where it may wait."""

    def __init__(self, surface: Callable[[], seamwire_core.Surface], pose: Pose) -> None:
        core = native.load()

        def make(_request: None) -> Crests:
            return Crests.on(core, surface(), lambda _fraction: not self._maker.superseded)

        self._pose = pose
        self._maker: Newest[None, Crests] = Newest(make, "seamwire-crests", (core.Cancelled,))
        self._asked = False
        self._seen: Crests | None = None
        self._visible = False
        self._lines: tuple[Lines, ...] | None = None
        self.is_wanted = False  # whether the lines are needed even if they are not shown

    @property
    def crests(self) -> Crests | None:
        """The lines, once they are needed and found."""
        return self._maker.answer

    def follow(self, options: Options, _source: object, _strokes: object) -> None:
        """Show the lines if the settings say so. Find them the first time that they are needed."""
        self._visible = options.show_crests
        if (self._visible or self.is_wanted) and not self._asked:
            self._asked = True
            self._maker.want(None)

    @property
    def busy(self) -> bool:
        """Whether the lines are being searched for, or wait for `poll`."""
        return self._maker.busy or self._maker.answer is not self._seen

    def poll(self) -> bool:
        """Return whether lines were found since the last call. Raise what went wrong. Then they are searched for again."""
        try:
            self._maker.check()
        except Exception:
            self._asked = False
            raise
        new = self._maker.answer is not self._seen
        self._seen = self._maker.answer
        return new

    def close(self) -> None:
        self._maker.close()

    def repose(self) -> None:
        self._lines = None

    def draw_lines(self, eye: Eye) -> None:
        if not self._visible or self.crests is None:
            return
        if self._lines is None:
            crests = self.crests
            is_ridge = crests.ridges[crests.owners[crests.pieces]]
            seen = self._pose.places(crests.segments.reshape(-1, 3)).reshape(-1, 2, 3)
            self._lines = Lines(_VALLEY, seen[~is_ridge]), Lines(_RIDGE, seen[is_ridge])
        with blended("LESS_EQUAL"):
            for lines in self._lines:
                lines.draw(eye)

    def legends(self) -> list[Legend]:
        if not self._visible:
            return []
        crests = self.crests
        if crests is None:
            return [Legend(("Computing...",))]
        ridges = int(crests.ridges.sum())
        kinds = ((_RIDGE, ridges, "ridge"), (_VALLEY, len(crests) - ridges, "valley"))
        swatches = tuple((style.color, f"{count} {name}{'' if count == 1 else 's'}") for style, count, name in kinds)
        strongest = float(crests.strengths.max(initial=0.0))
        return [Legend((f"Strength from 1 to {strongest:.3g} radians",) if len(crests) else (), swatches=swatches)]
