# SPDX-License-Identifier: GPL-3.0-or-later
"""Values over the surface that views show: metrics, crests, colors."""
