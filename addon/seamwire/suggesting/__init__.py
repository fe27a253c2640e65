# SPDX-License-Identifier: GPL-3.0-or-later
"""Suggest Seamwires: the operator, and the parts while an artist changes them."""
