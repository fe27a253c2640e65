# SPDX-License-Identifier: GPL-3.0-or-later
"""What the artist wants, where it runs, and what the mouse does to it. `docs/development/design.md` describes it."""
