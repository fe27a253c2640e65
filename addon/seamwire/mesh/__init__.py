# SPDX-License-Identifier: GPL-3.0-or-later
"""The edit mesh: read, marked, and what stays with it."""

from ..words import sentences as _sentences  # noqa: F401 - gives all messages and errors their words
