// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "seamwire/surface/triangle_connectivity.hpp"

namespace seamwire {

/// An edge without a face, along which a path may run. Its length is finite and not negative: it is 0 between vertices
/// at the same place.
struct LooseEdge {
  std::int32_t a;  ///< one end
  std::int32_t b;  ///< the other one
  double length;   ///< 0 or more
};

/// Triangles glued along edges, known by their edge lengths alone. Twins are oriented alike. The triangles at any other
/// edge may be oriented in any way, and there may be any number of them.
struct IntrinsicMesh : TriangleConnectivity {
  std::int32_t vertex_count = 0;  ///< in triangles or not
  std::vector<double> lengths;    ///< per half-edge, positive, the same for all half-edges of an edge; each triangle
                                  ///< fulfils the triangle inequality
  std::vector<LooseEdge> loose_edges;  ///< edges without a triangle
};

}  // namespace seamwire
