# SPDX-License-Identifier: GPL-3.0-or-later
"""What artists read, type and press: keys, hints and messages. It knows no Blender."""
