# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks in files, on other meshes, and at other places of the same mesh. The drawing tool does not need this package."""
