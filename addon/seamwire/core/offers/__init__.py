# SPDX-License-Identifier: GPL-3.0-or-later
"""The loops that a click offers, along edges and across the surface."""
