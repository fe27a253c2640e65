# SPDX-License-Identifier: GPL-3.0-or-later
"""The live wires of the compiled library, and their settings."""
