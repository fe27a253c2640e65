# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings and their values: the codes of the core and of files, with the words of the interface. Knows no other package, and no NumPy."""
