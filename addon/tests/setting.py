# SPDX-License-Identifier: GPL-3.0-or-later
"""Sessions that are told of other settings."""

from __future__ import annotations

from dataclasses import replace

from seamwire.core.drawing.session import Session


def use(session: Session, **changes: object) -> bool:
    """Let a session follow its settings with some changes; return whether it could."""
    return session.follow(replace(session.options, **changes))


def stronger(session: Session, steps: int) -> bool:
    """Change the strength by some steps, as keys do; return whether there was another one."""
    options = session.options.stepped(steps)
    return options != session.options and session.follow(options)
