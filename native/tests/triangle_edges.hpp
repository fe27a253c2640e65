// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "seamwire/surface/types.hpp"

namespace seamwire {

/// The edges of triangles, from corner to corner. Edges of two triangles are there twice.
inline std::vector<Edge> edges_of(const std::vector<Triangle>& triangles) {
  std::vector<Edge> edges;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) edges.push_back({t[i], t[(i + 1) % 3]});
  }
  return edges;
}

}  // namespace seamwire
