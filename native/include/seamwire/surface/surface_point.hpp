// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

namespace seamwire {

/// A point of a triangle mesh: a vertex, or a point of a face by barycentric coordinates, one for each of its corners,
/// in their order. If a coordinate is exactly 0, the point is on the edge opposite to that corner. If two are 0, the
/// point is the third corner. A coordinate below 2^-53, which the sum of the others does not notice, counts as 0.
struct SurfacePoint {
  std::int32_t face = -1;               ///< not looked at where `vertex` says which point it is
  std::array<double, 3> barycentric{};  ///< 0 or more; their sum is 1 within 1e-9, and is made 1 by dividing by it
  std::int32_t vertex = -1;             ///< a vertex, with a face or without; -1: `face` and `barycentric` say

  /// The point that a vertex is.
  static SurfacePoint at_vertex(std::int32_t v) { return {.vertex = v}; }

  /// The same numbers, not only the same point.
  bool operator==(const SurfacePoint&) const = default;
};

}  // namespace seamwire
