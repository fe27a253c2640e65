# SPDX-License-Identifier: GPL-3.0-or-later
"""What is seen in the 3D view, and what of it is under the cursor."""
