# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams and UV maps for many files: ``seamwire-batch``. One Blender process a file; docs/batch.md says what it promises."""
