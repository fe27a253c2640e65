// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "seamwire/surface/triangle_connectivity.hpp"

namespace seamwire {

/// An edge without a face, along which a path may run.
struct LooseEdge {
  std::int32_t a;  ///< one end
  std::int32_t b;  ///< the other end
  double length;   ///< finite, 0 or more; 0 between vertices at the same place
};

/// Triangles glued along edges, known by their edge lengths alone.
///
/// Twins have the same orientation. Triangles at other edges may have any orientation, and there may be any number of
/// them.
struct IntrinsicMesh : TriangleConnectivity {
  std::int32_t vertex_count = 0;  ///< number of vertices, with or without triangles
  /// Per half-edge: its length, above 0. It is the same for all half-edges of an edge. The longest edge of a triangle
  /// is shorter than the two others together, by at least 1e-13 of its length.
  std::vector<double> lengths;
  std::vector<LooseEdge> loose_edges;  ///< edges without a triangle
  /// Empty, or per triangle: its area if it is so thin that the lengths leave too few digits of it. 0 elsewhere. The
  /// lengths of a triangle with an area may miss the condition above by rounding.
  std::vector<double> areas = {};
};

}  // namespace seamwire
