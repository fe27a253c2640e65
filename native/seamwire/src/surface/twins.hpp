// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "surface/real_edges.hpp"

namespace seamwire::detail {

/// The half-edges of triangles by their edges: pairs of an ascending edge and a half-edge, sorted.
using HalfEdgesByEdge = std::vector<std::pair<Edge, std::int32_t>>;

inline HalfEdgesByEdge half_edges_by_edge(std::span<const Triangle> triangles) {
  HalfEdgesByEdge sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t h = 0; h < 3 * triangles.size(); ++h) {
    const Triangle& t = triangles[h / 3];
    sides.emplace_back(ascending(t[h % 3], t[(h + 1) % 3]), static_cast<std::int32_t>(h));
  }
  std::ranges::sort(sides);
  return sides;
}

/// The twin of each half-edge: the other one of its edge, or -1 unless two half-edges run there in opposite directions.
inline std::vector<std::int32_t> twins_of(std::span<const Triangle> triangles, const HalfEdgesByEdge& sides) {
  const auto tail = [&](std::int32_t h) { return triangles[h / 3][h % 3]; };
  std::vector<std::int32_t> twins(sides.size(), -1);
  for (auto begin = sides.begin(); begin != sides.end();) {
    const auto end = std::find_if(begin, sides.end(), [&](const auto& side) { return side.first != begin->first; });
    const std::int32_t h = begin->second, other = std::prev(end)->second;
    if (end - begin == 2 && tail(h) != tail(other)) {
      twins[h] = other;
      twins[other] = h;
    }
    begin = end;
  }
  return twins;
}

}  // namespace seamwire::detail
