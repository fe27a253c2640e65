# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool while it is used: its modal operator, what events mean and do, and the chain that is drawn."""
