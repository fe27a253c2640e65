# SPDX-License-Identifier: GPL-3.0-or-later
"""The base of all operators that work on the meshes in Edit Mode."""

from __future__ import annotations

import traceback
from contextlib import contextmanager
from typing import TYPE_CHECKING, TypeVar

from ..tool.running import NeedsEditMode, chains, steps
from ..words.reports import ALL_HIDDEN, HALFWAY

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    import bpy

    from ..mesh.object_session import ObjectSession

_Found = TypeVar("_Found")


def description_of_item(name: str) -> classmethod:
    """Return an operator's `description`: the tooltip of a menu entry describes the item of the property of this name."""

    def description(_cls: type, _context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        return properties.bl_rna.properties[name].enum_items[getattr(properties, name)].description

    return classmethod(description)


class Halfway(Exception):  # noqa: N818 - reads as a state of the work
    """Work has changed a mesh, and ended on an error. Its message is the error's."""


@contextmanager
def changing(context: bpy.types.Context | None = None) -> Iterator[None]:
    """Raise `Halfway` instead of any error. All of an operator that changes meshes must be in this block.

    Blender's Live Unwrap follows a block that is given the context, because seams have changed there.
    """
    from ..mesh import edit_mesh

    try:
        yield
        if context is not None:
            edit_mesh.live_unwrap(context)
    except Exception as error:
        raise Halfway(str(error)) from error


class EditMeshOperator(NeedsEditMode):
    """Gives an operator its poll, its options and a way to report what went wrong. The operator has `run`.

    If an error comes while meshes are changed, see `changing`, the operator ends with a step of undo.

    An operator that `ends_chain` keeps the chain that is drawn in its window: a button in the tool's header can be clicked while a wire is
    live.
    """

    bl_options = {"REGISTER", "UNDO"}
    ends_chain = False

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not super().poll(context):
            return False
        if cls.ends_chain and any(chain.window != context.window for chain in chains):
            cls.poll_message_set("A chain is being drawn in another window")
            return False
        if cls.ends_chain and steps:
            cls.poll_message_set(f"{steps[0].bl_label} is running")
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        self.end_chain()
        return self.outcome(lambda: self.run(context))

    def end_chain(self) -> None:
        for chain in tuple(chains) if self.ends_chain else ():
            chain.finish()
            chain.notices.tell(self.report)

    def outcome(self, work: Callable[[], set[str]]) -> set[str]:
        """Do work and return its result. Report a ValueError, a NativeError or `Halfway`."""
        from ..core.base.native import NativeError

        try:
            return work()
        except (ValueError, NativeError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        except Halfway as error:
            traceback.print_exception(error.__cause__)
            self.report({"ERROR"}, f"{HALFWAY}, undo leads back: {error}")
            return {"FINISHED"}

    def run(self, context: bpy.types.Context) -> set[str]:
        """Do the work, and return the result that Blender expects.

        If it cannot be done, raises ValueError or NativeError with a sentence for the artist, and nothing has changed. Raises `Halfway` if
        an error comes while meshes are changed.
        """
        raise NotImplementedError

    def for_each_object(
        self, context: bpy.types.Context, work: Callable[[bpy.types.Object], _Found]
    ) -> dict[bpy.types.Object, _Found]:
        """Do the work for each object in Edit Mode that has something visible, and return the results.

        ValueErrors and NativeErrors of the work are reported, and the other objects are still worked on.
        """
        from ..core.base.native import NativeError

        found, problems = {}, []
        for obj in context.objects_in_mode_unique_data:
            try:
                found[obj] = work(obj)
            except (ValueError, NativeError) as error:
                problems.append(str(error))
        for problem in problems if found else (*problems, ALL_HIDDEN)[:1]:
            self.report({"WARNING"} if found else {"ERROR"}, problem)
        return found

    def open_mesh(self, obj: bpy.types.Object) -> ObjectSession:
        """Read an object to draw on, and report problems with the wires that are stored with it."""
        from ..mesh.object_session import ObjectSession

        mesh = ObjectSession(obj)
        mesh.notices.tell(self.report)
        return mesh

    def write(self, context: bpy.types.Context, meshes: Iterable[ObjectSession], follow: bool = True) -> int:
        """Plan everything, then write what was drawn on meshes, and return how many edges became seams. Live Unwrap may `follow`."""
        plans = {mesh: mesh.plan() for mesh in meshes}
        with changing(context if follow else None):
            return sum(mesh.write(plan)[0] for mesh, plan in plans.items())

    def open_meshes(self, context: bpy.types.Context) -> list[ObjectSession]:
        """Read all objects in Edit Mode as `open_mesh` does. See `for_each_object`."""
        return list(self.for_each_object(context, self.open_mesh).values())
