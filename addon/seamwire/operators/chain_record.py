# SPDX-License-Identifier: GPL-3.0-or-later
"""How the wires of a chain get into the mesh when the chain ends, and out of it when the chain is dropped."""

from __future__ import annotations

import traceback
from contextlib import suppress
from typing import TYPE_CHECKING, TypeVar

import bpy
import numpy as np

from ..core.base.messages import NOTHING
from ..core.drawing.change import Change
from ..core.network.network import Network, edges_after
from ..mesh import finishes
from ..view.edited_objects import edited
from ..view.object_view import let_blender_tell
from ..words.reports import count, summary
from . import undo_steps
from .unwrap_islands import unwrap_after_chain

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from ..view.object_view import ObjectView
    from ..words.notices import Notices

_Result = TypeVar("_Result")


class ChainRecord:
    """The wires that a chain drew, on one object at a time.

    Parameters
    ----------
    notices
        Receives a report for each step of undo.

    Attributes
    ----------
    drawn_on
        The object that is drawn on. None if nothing has been drawn since the last step.
    has_kept
        Whether the chain has changed a mesh.
    """

    def __init__(self, notices: Notices) -> None:
        self._notices = notices
        self._before = Network()
        self._seams = np.empty((0, 2), dtype=np.int32)
        self._titles: set[str] = set()
        self._is_saved = False
        self.drawn_on: ObjectView | None = None
        self.has_kept = False

    def begin(self, view: ObjectView) -> None:
        """Draw on an object from now on."""
        self.drawn_on, self._before = view, view.session.network
        self._seams = view.mesh.arrays.seams

    def note(self, title: str) -> None:
        """Note what was done, by a title of `undo_steps`."""
        self._titles.add(title)

    def trouble(self, reason: str) -> str:
        """Follow a change of the mesh by others.

        Parameters
        ----------
        reason
            Another reason why the chain cannot go on, or an empty text.

        Returns
        -------
        str
            Why the chain cannot go on, or an empty text.
        """
        view = self.drawn_on
        if view is None or not (view.stale or not view.mesh.alive()):
            return reason
        # Blender reports a change of the mesh. Others may mark seams.
        obj = bpy.data.objects.get(view.name)
        if obj is None:
            self.drawn_on = None
            return "The object was removed"
        known, found = self._before, view.mesh.follow_change(obj, self._before)
        if found is None:
            return reason or "The mesh was changed"
        self._before = found
        view.renew()
        return reason or ("" if found is known else "Undo has changed the wires of the mesh")

    def keep(self, context: bpy.types.Context, at_once: bool = False) -> None:
        """End the chains of all objects after their last wires are computed, and write what was drawn as a step of Blender's undo.

        It reports clicks that waited and could not be done.

        Parameters
        ----------
        context
            With the mode of the window.
        at_once
            Whether to forget clicks that wait, and to push no step.

        Raises
        ------
        ValueError
            If an edge is gone. Then the mesh is unchanged.
        """
        # The object that is drawn on comes first, because outside Edit Mode it is not among the views.
        drawn_on = [] if self.drawn_on is None else [self.drawn_on]
        for view in dict.fromkeys((*drawn_on, *edited.views())):
            view.session.end_chain(wait=not at_once)
            drawing = view.session.drawing
            for told in (drawing.failure, drawing.warning):
                if told:
                    self._notices.add("WARNING", str(told))
            drawing.failure = drawing.warning = NOTHING
        view = self.drawn_on
        change = None if view is None else Change(self._before, view.session.network)
        title = undo_steps.EDIT if self._titles == {undo_steps.EDIT} else undo_steps.DRAW
        self._titles.clear()
        if view is None or change is None or not (self._is_saved or change):
            self.drawn_on = None
            return
        try:
            view.mesh.write(view.mesh.plan())
        except ValueError:
            raise
        except Exception:
            self._is_saved = True  # the mesh may have a part of the wires: dropping the chain writes the former ones
            raise
        self.drawn_on, self._is_saved = None, False
        # Saving within the chain may have marked some of them already.
        marked, cleared = (len(each) for each in _changed(self._seams, view.mesh.arrays.seams))
        # The wires are in the mesh by now. Whatever fails, a step of undo must lead back.
        self._try("drawing them", view, view.renew)
        done = self._try("finishing them", view, lambda: _apply(view, change)) or ""
        problem = ""
        if not at_once:
            if (marked or cleared or done) and context.mode == "EDIT_MESH":
                problem = self._try("unwrapping", view, lambda: unwrap_after_chain(context)) or ""
            undo_steps.push(title)
        self.has_kept = True
        told = f"{title}: {done or summary(change, marked, cleared)}"
        self._notices.add("WARNING" if problem else "INFO", f"{told}. {problem}" if problem else told)

    def _try(self, what: str, view: ObjectView, work: Callable[[], _Result]) -> _Result | None:
        """Do some of the work on a mesh that has its wires already. Report an error instead of raising it, and return None."""
        try:
            return work()
        except Exception as error:
            traceback.print_exc()
            edited.forget(view)
            self._notices.add("ERROR", f"Wires are kept, but {what} ended on an error, undo leads back: {error}")
            return None

    def save(self) -> None:
        """Write the wires so far to the mesh, so that Blender saves them. The chain goes on."""
        if self.drawn_on is None:
            return
        let_blender_tell()
        self.trouble("")
        if self.drawn_on is not None:
            with suppress(ValueError):  # the mesh has other vertices: the chain ends at its next event
                _write(self.drawn_on, adopt=False)
                self._is_saved = True

    def drop(self) -> bool:
        """Undo everything since the last step.

        Return False if wires that were saved stay in the mesh: after a change by others, the former wires cannot be written.
        """
        view, self.drawn_on = self.drawn_on, None
        if view is None:
            return True
        if not view.mesh.alive():
            return not self._is_saved
        view.mesh.drop_changes(self._before)
        if self._is_saved:
            _write(view, adopt=True)
        return True


def _changed(before: NDArray[np.int32], after: NDArray[np.int32]) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return the edges, each (k, 2), that are seams only after a change, and those that were seams only before."""
    return edges_after(after, (), before), edges_after(before, (), after)


def _write(view: ObjectView, adopt: bool) -> None:
    view.mesh.write(view.mesh.plan(), adopt)
    view.renew()


def _apply(view: ObjectView, change: Change) -> str:
    """Let the mesh do what a change asks, and return what was done, in words."""
    if not view.mesh.alive():
        left = sum(map(change.finishes, change.after.wires))
        return f"{count(left, 'wire')} kept along edges, because the mesh was changed meanwhile" if left else ""
    _, done = finishes.apply(view.mesh, change)
    if done.text:
        edited.forget(view)
    return done.text
