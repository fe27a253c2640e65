# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks as data: in the mesh, on its edges, and in files."""
