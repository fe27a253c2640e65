# SPDX-License-Identifier: GPL-3.0-or-later
"""The session in which the artist draws, with one module for each gesture."""
