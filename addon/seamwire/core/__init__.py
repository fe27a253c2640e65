# SPDX-License-Identifier: GPL-3.0-or-later
"""What a drawing is, and how it goes on; knows neither Blender nor the GPU."""
