# SPDX-License-Identifier: GPL-3.0-or-later
"""What the artist has drawn: wires, seeds and strokes, their symmetry, and the history of changes."""
