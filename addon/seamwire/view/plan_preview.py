# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws planned wires and the islands that they make over objects in edit mode, while better ones are being looked for."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..core.base import native
from ..core.islands.islands import IslandMaker
from ..mesh import settings as chosen
from ..mesh.pose import Pose
from .edited_objects import edited
from .failures import failures
from .gpu_draw import Eye, Faces, Lines, blended
from .theme import HUES, Looks, hue_colors

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from ..core.base.mesh_arrays import Arrays

_TINT = 0.35
"""The least opacity of the islands: they are what a preview is for."""


class _Shown:
    """The drawing over one object.

    Parameters
    ----------
    obj, arrays
        The object and its mesh.
    """

    def __init__(self, obj: bpy.types.Object, arrays: Arrays) -> None:
        core = native.load()
        self.obj = obj
        self._pose = Pose(replace(arrays, points=arrays.in_object, to_object=np.eye(3)))
        surface = core.Surface(arrays.in_object, arrays.triangles, arrays.edges)
        self._islands = IslandMaker(arrays.triangles, lambda cuts: np.asarray(core.face_segments(surface, cuts)), HUES)
        self._curves: Sequence[NDArray[np.float64]] = ()
        self._lines: Lines | None = None
        self._faces: Faces | None = None
        self._tinted: object = None
        self._count = 0

    @property
    def is_new(self) -> bool:
        """Whether there are islands that were not drawn yet."""
        found = self._islands.newest
        return found is not None and found.key != self._tinted

    def follow(self, curves: Sequence[NDArray[np.float64]], cuts: NDArray[np.int32]) -> None:
        """Show other wires, and ask for their islands."""
        if self._pose.follow(self.obj):
            self._faces = self._tinted = None
        self._curves, self._lines = [self._pose.places(curve) for curve in curves], None
        self._count += 1
        self._islands.want(self._count, cuts)

    def check(self) -> None:
        """Raise what went wrong while islands were computed."""
        self._islands.check()

    def close(self) -> None:
        """Let go of the thread that computes islands."""
        self._islands.close()

    def draw(self, looks: Looks) -> None:
        """Draw in the view that Blender is drawing now."""
        eye = Eye(bpy.context.region_data, self.obj.matrix_world)
        found = self._islands.newest
        if self._faces is None:
            self._faces = Faces(self._pose.points)
        if found is not None and found.key != self._tinted:
            self._faces.clear()
            for hue, triangles in found.pieces:
                self._faces.add(hue, triangles)
            self._tinted = found.key
        self._faces.draw_over(eye, hue_colors(max(looks.tint, _TINT)))
        if self._lines is None:
            pieces = [np.stack([curve[:-1], curve[1:]], axis=1) for curve in self._curves if len(curve) > 1]
            self._lines = Lines(looks.kept, np.concatenate([np.empty((0, 2, 3)), *pieces]))
        with blended("GREATER"):
            self._lines.draw_hidden(eye, looks.kept.hidden)
        with blended("LESS_EQUAL"):
            self._lines.draw(eye)


class PlanPreview:
    """The drawing, in all 3D views, until it is closed."""

    def __init__(self) -> None:
        self._shown: dict[str, _Shown] = {}
        self._handle: object | None = None

    def show(
        self, obj: bpy.types.Object, arrays: Arrays, curves: Sequence[NDArray[np.float64]], cuts: NDArray[np.int32]
    ) -> None:
        """Draw wires over an object, and tint the islands that they make, in place of what was drawn over it.

        Parameters
        ----------
        obj, arrays
            The object and its mesh.
        curves
            (k, 3) each, in object coordinates.
        cuts
            (c, 2) the edges that are seams with them.
        """
        if self._handle is None and not bpy.app.background:
            self._handle = bpy.types.SpaceView3D.draw_handler_add(self._draw, (), "WINDOW", "POST_VIEW")
            edited.covered = True
        if obj.name_full not in self._shown:
            self._shown[obj.name_full] = _Shown(obj, arrays)
        shown = self._shown[obj.name_full]
        failures.take("preview")  # another plan is another try
        failures.attempt(("preview", "follow", obj.name_full), partial(shown.follow, curves, cuts))
        edited.redraw()

    def poll(self) -> None:
        """Show islands that were computed."""
        for name, shown in self._shown.items():
            failures.attempt(("preview", "islands", name), shown.check)
        if any(shown.is_new for shown in self._shown.values()):
            edited.redraw()

    def close(self) -> None:
        """Draw nothing any more."""
        if self._handle is not None:
            bpy.types.SpaceView3D.draw_handler_remove(self._handle, "WINDOW")
            edited.covered = False
            edited.redraw()
        self._handle = None
        for shown in self._shown.values():
            shown.close()
        self._shown.clear()

    def _draw(self) -> None:
        context = bpy.context
        if not self._shown or not context.space_data.overlay.show_overlays:
            return
        looks = Looks.of(context.preferences.themes[0].view_3d, chosen.preferences())
        for name, shown in self._shown.items():
            with suppress(ReferenceError):  # the object may be gone
                if shown.obj.visible_in_viewport_get(context.space_data):
                    failures.attempt(("preview", "draw", name), partial(shown.draw, looks))
