// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>

#include "seamwire/surface/surface.hpp"

namespace seamwire::detail {

inline Edge ascending(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// Whether two vertices are the ends of a real edge (Surface::edges()), in either order.
inline bool has_edge(const Surface& surface, const Edge& edge) {
  return std::ranges::binary_search(surface.edges(), ascending(edge[0], edge[1]));
}

}  // namespace seamwire::detail
