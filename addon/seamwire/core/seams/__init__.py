# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires and the edges of seams: chains, gaps, suggestions, cuts and slides."""
