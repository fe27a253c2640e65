# SPDX-License-Identifier: GPL-3.0-or-later
"""What an add-on leaves in Blender while it is enabled, to find what it leaves behind."""

from __future__ import annotations

from collections import Counter

import addon_utils
import bpy
from scene import ADDON

Traces = dict[str, Counter]
"""For each kind of thing, how often each is there."""


def traces() -> Traces:
    """Return all handlers, keymap items, menu entries, classes and properties that Blender has now."""
    types = {name: getattr(bpy.types, name) for name in dir(bpy.types)}
    return {
        "handlers": Counter(
            f"{name}: {_name(handler)}"
            for name in dir(bpy.app.handlers)
            if isinstance(getattr(bpy.app.handlers, name), list)
            for handler in getattr(bpy.app.handlers, name)
        ),
        "keymap items": Counter(
            f"{keys.name}: {keymap.name}: {item.idname} {item.type}"
            for keys in bpy.context.window_manager.keyconfigs
            for keymap in keys.keymaps
            for item in keymap.keymap_items
        ),
        "entries": Counter(
            f"{name}: {_name(function)}"
            for name, kind in types.items()
            for function in getattr(getattr(kind, "draw", None), "_draw_funcs", ())
        ),
        "classes": Counter(types.keys()),
        "operators": Counter(f"{group}.{name}" for group in dir(bpy.ops) for name in dir(getattr(bpy.ops, group))),
        "properties": Counter(
            f"{name}.{prop}"
            for name, kind in types.items()
            if hasattr(kind, "bl_rna")
            for prop in kind.bl_rna.properties.keys()  # noqa: SIM118 - Blender's collections give their items otherwise
        ),
    }


def _name(function: object) -> str:
    return f"{getattr(function, '__module__', '')}.{getattr(function, '__qualname__', repr(function))}"


def ours(found: Traces) -> list[str]:
    """Return what of it is the add-on's."""
    return [f"{kind}: {name}" for kind, names in found.items() for name in names if "seamwire" in name.lower()]


def difference(before: Traces, after: Traces) -> dict[str, Counter]:
    """Return what came or went, by kind; empty where nothing did."""
    kinds = {kind: after[kind] - before[kind] + (before[kind] - after[kind]) for kind in before}
    return {kind: names for kind, names in kinds.items() if names}


def enable() -> None:
    """Enable the add-on as the preferences do."""
    assert addon_utils.enable(ADDON, default_set=True) is not None


def disable() -> None:
    """Disable it as the preferences do."""
    addon_utils.disable(ADDON, default_set=True)
