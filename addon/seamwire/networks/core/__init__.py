# SPDX-License-Identifier: GPL-3.0-or-later
"""The computations of this package, which do not know Blender."""
