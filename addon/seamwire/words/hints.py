# SPDX-License-Identifier: GPL-3.0-or-later
"""What is to be read of a drawing, and of the parts that Suggest shows: hints in the status bar, and the corner of the view."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..terms.choices import KINDS, LOOPS, METRICS, PARTS_BY, ignores_shape
from .keys import Action, Bindings, Key
from .reports import count, percent, square_used

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping

    from ..core.islands.uv_maps import SquareUse
    from ..core.seams.seam_plan import PartChoice
    from ..core.sketch.picture import Picture
    from ..terms.choices import LoopKind, PartsBy

Hint = tuple[str, str]
"""The name of one of Blender's icons, and a text."""
Deed = tuple[Action, str]
"""An action, and what it would do at the moment."""
MOST = 8
"""The largest number of hints at once, so that a status bar shows all of them."""

_CLICKS = {
    "SEED": "Add Seed, Drag: Draw Line",
    "CONTINUE": "Begin at This Seed, Drag: Move It",
    "BRANCH": "Begin on This Wire, Drag: New Seed",
    "KEEP": "Keep Wire",
    "JOIN": "Join Here",
    "CLOSE": "Close Chain",
    "RUN": "Keep Wire to the End",
    "WAIT": "Confirm When Ready",
    "MOVE": "Release to Confirm",
    "DRAW": "Release to Keep Line",
}
"""The text for a click, by the session's intent."""
_IDLE = (
    ("CLICK", "Draw Line", True),
    ("LOOP", "Add Loop", False),
    ("GUIDE", "Draw Stroke", True),
)
"""The gestures between chains: the name of the key, the text, and whether the mouse is dragged. Blender itself names a click."""


def idle_hints(keys: Mapping[str, Key]) -> list[Hint]:
    """Return what a newcomer can do before the first click, with the keys of the tool by the names of what they begin with."""
    found: list[Hint] = []
    for name, text, is_drag in _IDLE:
        key = keys.get(name)
        if key is not None:
            icon = f"{key.icon}_DRAG" if is_drag and key.icon == "MOUSE_LMB" else key.icon
            found.append(_hint(icon, key.modifiers if icon else key.text, text))
    return found


def _hint(icon: str, before: str, text: str) -> Hint:
    return icon or "NONE", f"{before}: {text}" if before else text


def hints(picture: Picture, keys: Bindings, message: str = "", mirror_offer: str = "") -> list[Hint]:
    """Return at most `MOST` hints: first messages, then what a click does and how to end, then other keys by their usefulness.

    `message` is the result of the last key. `mirror_offer` has the letters of the axes that the mesh is symmetric over and not mirrored.
    """
    found: list[Hint] = []
    work = picture.work
    if work.computing:
        waiting = f", {count(work.waiting, 'wire')} left" if work.waiting else ""
        found.append(("SORTTIME", f"Computing {min(99.0, 100.0 * work.progress):.0f} %{waiting}"))
    if message:
        found.append(("INFO", message))
    if picture.message:
        found.append(("ERROR", picture.message))
    ways = ((Action.END, "End Chain"), (Action.KEYS, "Keys"))
    deeds = [*_click(picture), *ways, *_wires(picture), *_guides(picture, mirror_offer)]
    found += [_hint(*keys.icon(action), text) for action, text in deeds if keys.keys_of(action)]
    return found[:MOST]


def _click(picture: Picture) -> Iterator[Deed]:
    """Yield what a click does, and what it does after W."""
    offered, choice = picture.offered, picture.choice
    kinds, kind, number = offered.kinds, offered.kind, offered.number
    if kind is not None and offered.bends:
        yield Action.BEND, "Bend Closed Cut"
    elif kind is not None:
        which = f", {number + 1} of {len(kinds)}" if len(kinds) > 1 else ""
        yield Action.LOOP, f"Add {_offer(kind)}{which}"
        if which:
            yield Action.NEXT, f"{_offer(kinds[(number + 1) % len(kinds)])} Instead"
    else:
        if picture.intent.name in _CLICKS:
            yield Action.CLICK, _CLICKS[picture.intent.name]
        if picture.seed is not None and choice.count > 1:
            yield Action.NEXT, f"Next Candidate ({(choice.number + 1) % choice.count + 1} of {choice.count})"


def _offer(kind: LoopKind) -> str:
    # Title case as Blender has it: small words stay small.
    return " ".join(word if word in {"a", "of"} else word.capitalize() for word in LOOPS[kind].split())


def _wires(picture: Picture) -> Iterator[Deed]:
    # Imported late, because it needs NumPy, and Blender's start should not wait for that.
    from ..core.sketch.picture import Role

    is_along_edges = picture.options.along == "EDGES"
    if picture.seed is not None and picture.can_close:
        yield Action.CLOSE, "Close"
    if picture.seed is not None and is_along_edges:
        yield Action.EXTEND, "Extend to End" if picture.one(Role.EXTENSION) is None else "Keep It"
    wire = picture.one(Role.HOVERED)
    if wire is not None:
        yield Action.REMOVE, "Remove Wire"
        if picture.seed is None and (wire.kind is not None or not wire.closed):
            yield Action.NEXT, "Swap Path"
    target = picture.target
    on_edge = target is not None and isinstance(target.pick, tuple)
    if picture.offered.kind is None and target is not None and on_edge == is_along_edges:
        yield Action.LOOP, "Loop" if on_edge else "Closed Cut"
        if picture.can_bend:
            yield Action.BEND, "Bend Closed Cut"
    if picture.can_undo:
        yield Action.UNDO, "Undo"


def _guides(picture: Picture, mirror_offer: str) -> Iterator[Deed]:
    options = picture.options
    if mirror_offer and not options.mirror:
        yield Action.MIRROR, f"Mirror? Symmetric on {mirror_offer}"
    if not ignores_shape(options.metric):
        yield Action.STRONGER, f"Strength {picture.strength:.3g}"
    yield Action.CLEAR, "Switch to Clear" if options.marking else "Switch to Mark"
    yield Action.SWITCH, "Across Surface" if options.along == "EDGES" else "Along Edges"
    if picture.target is not None:
        yield Action.GUIDE, "Guide Stroke"
        yield Action.AVOID, "Avoid Stroke"
    if options.mirror:
        yield Action.MIRROR, f"Mirror {''.join('XYZ'[axis] for axis in options.mirror)}"


# The corner of the view

STEPS = (
    ("MOUSE_LMB", "Click to begin, and click again to keep a wire"),
    ("MOUSE_LMB_DRAG", "Drag to draw a seam by hand"),
    ("MOUSE_LMB", "Hold Alt to pick a whole loop"),
    ("MOUSE_LMB_DRAG", "Hold Shift and drag to guide the wires"),
)
"""Blender's icon of each gesture, and what it does."""
FIRST_LINES = (*(text for _, text in STEPS), "Press F1 for all keys, and to hide these lines")
"""The lines for newcomers."""


def lines(picture: Picture) -> list[str]:
    """Return what is to be read, top line first. Lines about islands appear once cuts part the mesh."""
    found = []
    options, offered, choice, islands = picture.options, picture.offered, picture.choice, picture.islands
    if offered.kind is not None:
        which = f" ({offered.number + 1} of {len(offered.kinds)})" if len(offered.kinds) > 1 else ""
        found.append(LOOPS[offered.kind].capitalize() + which)
    if picture.active is not None and choice.count > 1:
        which = KINDS[METRICS[options.metric].follows[picture.active.follow]]
        if choice.straight:
            which = "Straight in the view"
        found.append(f"{which} ({choice.number + 1} of {choice.count})")
    if islands is not None and islands.parted:
        gaps = f", {count(len(islands.gaps), 'gap')} in seams" if islands.gaps else ""
        found.append(f"{count(islands.count, 'island')}{gaps}")
        number = picture.pointed_island
        if number is not None:
            cuts = int(islands.missing[number])
            needs = f", flat with {count(cuts, 'more cut')}" if cuts else ""
            found.append(f"Island {number + 1}: {count(int(islands.sizes[number]), 'triangle')}{needs}")
    way = "Along edges" if options.along == "EDGES" else "Across the surface"
    default = next(iter(METRICS))
    metric = "" if options.metric == default else METRICS[options.metric].name.lower()
    strength = "" if ignores_shape(options.metric) else f"strength {picture.strength:.3g}"
    found.append(", ".join(part for part in (way, strength, metric) if part))
    modes = [
        "" if options.marking else "Clearing seams",
        "Mirror " + " ".join("XYZ"[axis] for axis in options.mirror) if options.mirror else "",
        "X-ray" if options.xray else "",
        "Snapping to features" if options.snap else "",
    ]
    said = ", ".join(mode for mode in modes if mode)
    return [*found, said] if said else found


@dataclass(frozen=True)
class FoundMap:
    """The best map so far of the parts that Suggest shows."""

    stretch: float  # the mean, in percent
    islands: int
    length: str  # of all seams, in the scene's units
    used: SquareUse | None = None  # of its islands, packed; None: not packed yet


def rows_of_parts(
    choice: PartChoice,
    parts: int,
    past: Mapping[str, int],
    found: FoundMap | None,
    is_final: bool,
    automatic: Collection[PartsBy] = (),
) -> list[tuple[str, str]]:
    """Return what is to be read while Suggest shows parts, top line first: each text, and the keys that change it.

    `past` counts the notches of the wheel that were turned past an end, by what they turn. `automatic` has what *Auto* has taken.
    """

    def beyond(what: str) -> str:
        return f", {count(abs(past[what]), 'notch', 'notches')} past the end" if past.get(what) else ""

    names = ", ".join(PARTS_BY[by].name for by in sorted(automatic))
    taken = f" ({names})" if choice.by == "AUTO" and names else ""
    islands = f"at least {choice.islands}{beyond('islands')}"
    stretch = f"at most {percent(choice.stretch)}{beyond('stretch')}"
    if found is not None:
        islands, stretch = f"{found.islands}, {islands}", f"{percent(found.stretch)}, {stretch}"
    rows = [
        (f"Parts by: {PARTS_BY[choice.by].name}{taken}", "W"),
        (f"Parts: {parts}, amount {100.0 * choice.amount:.0f} %{beyond('amount')}", "Wheel"),
        (f"Islands: {islands}", "Shift Wheel"),
        (f"Stretch: {stretch}", "Ctrl Wheel"),
    ]
    if found is not None:
        if found.used is not None:
            rows.append((square_used(found.used), ""))
        rows.append((f"Seams: {found.length}", ""))
        rows.append(("Search ended" if is_final else "Searching: this is the best map so far", "Enter: Keep"))
    return rows
