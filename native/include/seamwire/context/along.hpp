// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace seamwire {

/// Where wires run: across the surface, as exact geodesics, or along its real edges.
enum class Along { kSurface, kEdges };

}  // namespace seamwire
