// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>

namespace seamwire::detail {

/// The half-edges after and before another in its triangle; half-edge 3 f + i runs from corner i of triangle f to the
/// next corner.
constexpr std::int32_t next_in_face(std::int32_t half_edge) {
  return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}
constexpr std::int32_t previous_in_face(std::int32_t half_edge) {
  return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
}

/// The lowest half-edge of h's edge, by which the edge is named.
template <class Mesh>
std::int32_t first_of_edge(const Mesh& mesh, std::int32_t h) {
  std::int32_t first = h;
  mesh.for_each_beyond(h, [&](std::int32_t other) { first = std::min(first, other); });
  return first;
}

}  // namespace seamwire::detail
