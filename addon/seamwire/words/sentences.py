# SPDX-License-Identifier: GPL-3.0-or-later
"""The words of every message that the core sends."""

from __future__ import annotations

from string import Formatter
from typing import TYPE_CHECKING

from ..core.base.messages import word_with
from .reports import count, pick_name

if TYPE_CHECKING:
    from ..core.base.messages import Message

SENTENCES = {
    "cannot-unpack": "Seamwire cannot unpack its compiled part to {folder}: {why}",
    "cut-is-gone": "The mesh has changed too much to find this cut again: undo, or add another cut",
    "cut-meets-no-edge": "No edge is left for the seam of this cut",
    "does-not-load": "Seamwire's compiled part does not load in this Blender (Python {version} on {system}): {why}",
    "drawing-failed": "Part of the drawing failed. It is tried again when the mode, the tool or the mesh changes: {why}",
    "loops-failed": "Loops could not be found: {why}",
    "ends-where-it-begins": "The wire ends where it begins: click somewhere else",
    "invalid-triangles": "{count, triangle} could not be made valid: wires go around {it}",
    "library": "{text}",
    "no-wire-leaves-face": "Nothing to cut: every wire stays inside one face",
    "cut-taken-back": "{why}. The old cut was removed: undo restores it",
    "line-too-short": "Drag farther along the surface to draw a line",
    "loop-has-one-way": "A loop has no other path",
    "no-bend-to": "Closed cuts bend to places on the surface, not to {pick}",
    "no-build": (
        "Seamwire's compiled part, {name}, is missing: install the Seamwire package made for Python {version}"
        " on {system}"
    ),
    "no-chain-to-close": "No chain to close: draw a wire first",
    "no-closed-cut": "The shape suggests no closed cut here",
    "no-crest-at": "No ridge or valley runs at {pick}",
    "no-cut-through": "Closed cuts need a vertex or a point of a face, not {pick}",
    "no-cut-through-both": "No closed cut leads through both points",
    "no-edge-across": "Wires across the surface need vertices or points of faces, not {pick}",
    "no-edges-run-on": "No edge continues at {pick}",
    "no-line-drawn": "No line is being drawn",
    "no-loop-through": "Loops need an edge, not {pick}",
    "no-loop-yet": "No loop found yet",
    "no-mirror-image": "Part of this wire has no mirror image: the mesh is not symmetric there",
    "no-next-candidate": "No other candidate found yet",
    "no-other-way-to-seed": "No other path to this seed",
    "no-run-across": "Extend to End works along edges, not across the surface",
    "no-seed-moves": "No seed is being moved",
    "no-seed-to-move": "No seed to move at {pick}",
    "no-result": "The computation ended without a result: this step was dropped",
    "no-way-on": "The wire cannot be extended from here",
    "no-wire-between": "No wire from {start} reaches {pick}",
    "no-wire-follows-line": "No wire fits this line: draw closer to the surface",
    "no-wire-further": "No wire fits the rest of the line",
    "no-wire-reaches": "No wire reaches {pick}: it is not connected to the seed",
    "nothing-else-here": "No other closed cut here",
    "nothing-else-through-edge": "No other loop through this edge",
    "nothing-runs-on": "Nothing to extend: place a seed first",
    "nothing-to-bend": "No closed cut to bend: add one first",
    "nothing-to-redo": "Nothing to redo in this drawing",
    "nothing-to-undo": "Nothing to undo in this drawing",
    "off-mesh-near": "A wire does not run over the mesh near vertex {vertex}",
    "other-build": (
        "Seamwire's compiled part was built for another Python or system ({found}), and this Blender has "
        "Python {version} on {system}: install the Seamwire package made for it"
    ),
    "point-where-to-run": "Point at where the wire should run",
    "same-edges": "All wires run along the same edges here",
    "stored-by-newer": "A newer version of Seamwire drew the wires of this mesh: they were not read or changed",
    "stored-unreadable": "The wires of this mesh cannot be read: its seams were not changed",
    "stroke-damaged": "The stroke is damaged: each point needs a place and a face",
    "stroke-is-gone": "This stroke no longer exists",
    "stroke-leaves-mesh": "The stroke leaves the mesh",
    "stroke-leaves-visible-part": "The stroke leaves the visible part of the mesh",
    "stroke-no-vertex": "There is no vertex {vertex} for the stroke: the mesh has {count}, numbered from 0",
    "stroke-without-direction": "A stroke needs a direction: drag along the surface",
    "updated-while-in-use": (
        "Seamwire was updated to {versions} while its version {used} was in use: restart Blender. If that "
        "does not help, remove the {name} in {folder}"
    ),
    "way-back-along-chain": "The way back runs along the chain itself: place another seed first",
    "wheel-not-installed": (
        "Blender has not installed Seamwire's compiled part, {wheel}, or has removed it since: disable and "
        "enable the add-on"
    ),
    "wire-is-gone": "This wire no longer exists",
    "wire-too-short": "Too short to become a seam: click farther away",
    "wire-went": "A wire was removed: no edge is left for its seam",
    "would-end-where-it-begins": "The wire would end where it begins: remove it instead",
}
"""The sentence for each code. `{pick}`, `{start}` and `{end}` name vertices, edges and points."""


def sentence(message: Message) -> str:
    """Return the sentence of a message, or an empty text for an empty message."""
    if not message:
        return ""
    if message.code not in SENTENCES:
        return message.code  # an error must not hide behind another one
    return _formatter.vformat(SENTENCES[message.code], (), dict(message.values))


class _Words(Formatter):
    """Puts values into sentences: names for picks, and numbers with their nouns."""

    def get_field(self, field_name: str, args: object, kwargs: dict[str, object]) -> tuple[object, str]:
        name, _, counted = field_name.partition(", ")
        if name == "it" and name not in kwargs:
            return ("it" if kwargs["count"] == 1 else "them"), name
        value = kwargs[name]
        if counted:
            value = count(int(value), counted)
        elif name in {"pick", "start"} and not isinstance(value, str):
            value = pick_name(value)
        return value, name


_formatter = _Words()
word_with(sentence)
