# SPDX-License-Identifier: GPL-3.0-or-later
"""Events turned into calls of sessions."""
