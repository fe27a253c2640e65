# SPDX-License-Identifier: GPL-3.0-or-later
"""The edit mesh: read, marked, and what stays with it."""

from ..words import messages as _messages  # noqa: F401 - gives all messages and errors their words
