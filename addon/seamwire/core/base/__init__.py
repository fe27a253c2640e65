# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays, geometry and the compiled library: what every other room builds on."""
