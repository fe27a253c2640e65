# SPDX-License-Identifier: GPL-3.0-or-later
"""The edit mesh: read, marked, and what stays with it."""
