# SPDX-License-Identifier: GPL-3.0-or-later
"""Unwraps when a chain has changed seams."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..mesh.settings import settings
from ..words.reports import in_words

if TYPE_CHECKING:
    import bpy


def unwrap_after_chain(context: bpy.types.Context) -> str:
    """Unwrap after a change of seams, as the tool or Blender is set. Return what went wrong, or an empty text."""
    if not settings(context).unwrap:
        from ..mesh import edit_mesh

        edit_mesh.live_unwrap(context)
        return ""
    from ..core.base.native import NativeError
    from ..mesh.unwrap import unwrap_changed

    try:
        return ", ".join(in_words(unwrap_changed(context).faults))
    except (ValueError, NativeError) as error:
        return str(error)
