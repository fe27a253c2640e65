# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators of Blender beside the tool, and the bases of operators."""
