# SPDX-License-Identifier: GPL-3.0-or-later
"""An object in Edit Mode for a while, whatever modes the objects of its view layer are in."""

from __future__ import annotations

from contextlib import AbstractContextManager, contextmanager, nullcontext
from typing import TYPE_CHECKING

import bpy

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator


def problem_with(obj: object) -> str:
    """Return what keeps an object from being edited in the view layer of the context, or an empty text."""
    if not isinstance(obj, bpy.types.Object):
        return f"{obj!r} is not an object"
    try:
        name = obj.name
    except ReferenceError:
        return "The object was removed"
    if obj.type != "MESH":
        return f"{name} has no mesh: it is of type {obj.type}"
    for item, what in ((obj, "it"), (obj.data, "its mesh")):
        if item.library is not None:
            return f"{name} cannot be edited: {what} is linked from {item.library.filepath}. Make it local"
        if item.override_library is not None:
            return f"{name} cannot be edited: {what} is a library override. Make it local"
    layer = bpy.context.view_layer
    # Blender adds new objects and collections to the layer, and computes where objects are, only as it updates.
    layer.update()
    # A linked object may have the name of another one.
    if layer.objects.get(name) != obj and obj not in tuple(layer.objects):
        scenes = [scene.name for scene in obj.users_scene]
        where = "its collection is excluded. Include the collection in the view layer"
        if not scenes:
            where = "it is in no scene. Link it to a collection of the scene"
        elif bpy.context.scene.name not in scenes:
            where = f"it is in the scene {scenes[0]}. Switch to that scene"
        return f"{name} is not in the view layer {layer.name}: {where}"
    if not obj.visible_get():
        return f"{name} cannot be edited: it is hidden. Show it and its collections"
    return ""


@contextmanager
def editing(obj: bpy.types.Object, alone: bool = False) -> Iterator[None]:
    """Have an object in Edit Mode, then restore all modes, the selection and the active object.

    With `alone`, no other mesh is in Edit Mode meanwhile. Raises ValueError if the object cannot be edited.
    """
    problem = problem_with(obj)
    if problem:
        raise ValueError(problem)
    layer = bpy.context.view_layer
    with _in_view(obj):
        others = {each for each in bpy.context.objects_in_mode_unique_data if each.data != obj.data}
        if obj.mode == "EDIT" and bpy.context.mode == "EDIT_MESH" and not (alone and others):
            yield
            return
    active = layer.objects.active
    selected = [each for each in layer.objects if each.select_get()]
    # Other objects can stay in other modes while they are not active.
    modes = {
        each: each.mode
        for each in layer.objects
        if each.mode != "OBJECT" and each.type == "MESH" and (each.mode == "EDIT" or each.data == obj.data)
    }
    try:
        for each in modes:
            if each.mode != "OBJECT":
                _set_mode([each], "OBJECT")
        _set_mode([obj], "EDIT")
        with _in_view(obj):
            yield
    finally:
        if obj.mode == "EDIT":
            _set_mode([obj], "OBJECT")
        together = [each for each, mode in modes.items() if mode == "EDIT"]
        # The active one first, because Blender takes its settings for all.
        together.sort(key=lambda each: each != active)
        for group, mode in ((together, "EDIT"), *(([each], mode) for each, mode in modes.items() if mode != "EDIT")):
            if group:
                _set_mode(group, mode)
        _select(selected)
        layer.objects.active = active


def _set_mode(objects: list[bpy.types.Object], mode: str) -> None:
    """Change the mode of objects of one type, which become all that is selected. Raises ValueError if Blender cannot."""
    _select(objects)
    bpy.context.view_layer.objects.active = objects[0]
    try:
        bpy.ops.object.mode_set(mode=mode)
    except RuntimeError as error:
        text = str(error).strip().removeprefix("Error: ")
        title = mode.replace("_", " ").title()
        raise ValueError(f"{objects[0].name} cannot change to {title} Mode: {text}") from None


def _select(objects: Iterable[bpy.types.Object]) -> None:
    for each in bpy.context.view_layer.objects:
        if each.select_get():
            each.select_set(False)
    for each in objects:
        each.select_set(True)


def _in_view(obj: bpy.types.Object) -> AbstractContextManager[None]:
    """Return a context in which operators see an object, even if the 3D view is a local view of others."""
    view = bpy.context.space_data
    if isinstance(view, bpy.types.SpaceView3D) and view.local_view and not obj.local_view_get(view):
        return bpy.context.temp_override(area=None, region=None)
    return nullcontext()
