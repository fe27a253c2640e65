# SPDX-License-Identifier: GPL-3.0-or-later
"""Keys, toolbar, menus, preferences and the status bar."""
