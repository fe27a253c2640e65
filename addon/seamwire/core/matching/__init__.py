# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks carried to other meshes and to other places of the same mesh."""
