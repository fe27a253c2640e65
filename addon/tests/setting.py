# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests do to sessions."""

from __future__ import annotations

from dataclasses import replace

from seamwire.core.network.picks import Pick
from seamwire.core.network.wires import Wire
from seamwire.core.sketch.interaction import Edit
from seamwire.core.sketch.sketch import Sketch


def use(session: Sketch, **changes: object) -> bool:
    """Let a session follow its settings with some changes; return whether it could."""
    return session.follow(replace(session.options, **changes))


def stronger(session: Sketch, steps: int) -> bool:
    """Change the strength by some steps, as keys do; return whether there was another one."""
    options = session.options.stepped(steps)
    return options != session.options and session.follow(options)


def insert(session: Sketch, wire: Wire, pick: Pick) -> bool:
    """Put a seed into a kept wire, as a chain that begins there does; return whether that was done."""
    own = session.base.find(wire.id)
    network = session.base.with_seed_in(wire, pick, session.points, own is not None and session.is_final(own))
    return network is not None and session.edit(Edit(network))


def end_line(session: Sketch) -> bool:
    """Release the line that is drawn and keep its wires, as releasing the button does; return whether that was done."""
    return session.line_end()
