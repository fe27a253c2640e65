# SPDX-License-Identifier: GPL-3.0-or-later
"""The islands that seams make, in the mesh and in its UV map."""
