# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests do to sessions."""

from __future__ import annotations

from dataclasses import replace

from seamwire.core.drawing.session import Session
from seamwire.core.network.picks import Pick
from seamwire.core.network.wires import Wire


def use(session: Session, **changes: object) -> bool:
    """Let a session follow its settings with some changes; return whether it could."""
    return session.follow(replace(session.options, **changes))


def stronger(session: Session, steps: int) -> bool:
    """Change the strength by some steps, as keys do; return whether there was another one."""
    options = session.options.stepped(steps)
    return options != session.options and session.follow(options)


def insert(session: Session, wire: Wire, pick: Pick) -> bool:
    """Put a seed into a kept wire, as a chain that begins there does; return whether that was done."""
    session.calm()
    network = session.drawing.network.with_seed_in(wire, pick, session.drawing.points)
    return network is not None and session.step(network)


def end_line(session: Session) -> bool:
    """Release the line that is drawn and keep its wires, as releasing the button does; return whether that was done."""
    line = session.cursor.line_release()
    return line is not None and session.line_keep(line)
