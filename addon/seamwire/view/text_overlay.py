# SPDX-License-Identifier: GPL-3.0-or-later
"""The few lines of text in the corner of the viewport: what the drawing is set to."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ..core.network import LOOP_NAMES
from . import gpu_draw as paint

if TYPE_CHECKING:
    from ..core.session import Session

_METRICS = {
    "feature": "",
    "campen": "Campen's metric",
    "pottmann_kovacs": "Pottmann and Kovacs' metric",
    "euclidean": "shortest ways",
}


def lines(session: Session, segments: int | None, xray: bool = False, features: bool = False) -> list[str]:
    """Return what is to be read, top line first.

    Parameters
    ----------
    session
        The drawing.
    segments
        How many there are; None where that is not known.
    xray, features
        Whether picking goes through the mesh, and whether seeds snap to features.
    """
    found = []
    if session.loop_choice is not None:
        offers = session.loop_offers
        which = f" ({offers.index(session.loop_choice) + 1} of {len(offers)})" if len(offers) > 1 else ""
        found.append(LOOP_NAMES[session.loop_choice].capitalize() + which)
    if segments is not None:
        found.append(f"{segments} segment" + ("s" if segments != 1 else ""))
    way = "Along edges" if session.along == "EDGES" else "Across the surface"
    metric = _METRICS.get(session.metric, session.metric)
    strength = "" if session.metric == "euclidean" else f"strength {session.strength:.3g}"
    found.append(", ".join(part for part in (way, strength, metric) if part))
    modes = [
        "" if session.marking else "Clearing seams",
        "Mirror " + " ".join("XYZ"[axis] for axis in sorted(session.mirror_axes)) if session.mirror_axes else "",
        "X-ray" if xray else "",
        "Snapping to features" if features else "",
    ]
    said = ", ".join(mode for mode in modes if mode)
    return [*found, said] if said else found


def draw(text: Sequence[str], corner: tuple[float, float], scale: float, colour: Sequence[float]) -> None:
    """Draw lines of text above a corner.

    Parameters
    ----------
    text
        Top line first.
    corner
        Left and bottom of where there is room, in pixels.
    scale
        Of the display.
    colour
        Red, green, blue.
    """
    size = paint.text_size(scale)
    paint.set_text(size)
    x = corner[0] + 1.2 * size
    y = corner[1] + 1.1 * size
    for line in reversed(text):
        paint.draw_text(line, (x, y), (*colour[:3], 1.0))
        y += 1.5 * size
