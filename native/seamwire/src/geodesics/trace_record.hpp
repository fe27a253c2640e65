// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>

namespace seamwire::detail {

/// How the shortest path arrives at a vertex; in the numbers of the GeodesicMesh.
struct TraceRecord {
  /// The source unfolded into the frame of `half_edge`; y < 0, but y >= 0 where it is a point in the half-edge's own
  /// face. Along an edge: x is its length.
  double x = 0.0, y = 0.0;
  std::int32_t half_edge = kNone;  ///< crossed last (>= 0); ~h: straight along half-edge h; kNone: the seed, or none
  /// The vertex from which the path runs straight. The number of vertices plus k stands for source k, a point in a
  /// face. The number of vertices and sources plus k stands for the origin of crossing k.
  std::int32_t source = -1;

  static constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::min();
  static constexpr std::int32_t kLooseEdge = kNone + 1;  ///< straight along an edge without faces
};

/// Where a straight path crosses an edge with siblings: which face it comes from. The last one of a path names the one
/// before it, and so on.
struct SiblingCrossing {
  std::int32_t half_edge;  ///< of the face that the path leaves
  std::int32_t source;     ///< what the path comes from, as in a TraceRecord
};

}  // namespace seamwire::detail
