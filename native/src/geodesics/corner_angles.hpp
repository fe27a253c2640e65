// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "geodesics/geodesic_mesh.hpp"

namespace seamwire::detail {

/// A corner of a vertex, and the angles from a direction at that vertex to both sides of the corner.
struct CornerAngles {
  std::int32_t half_edge;  ///< leaves the vertex; the corner is on its left
  double at_right;         ///< to that half-edge; infinite where no corners lead there
  double at_left;          ///< to the corner's other side
};

/// The angles from a direction at a vertex to the sides of all its corners, on the shortest way through the corners and
/// over all edges between them, those with siblings too. The direction is in the corner on the left of the half-edge
/// `corner`, at `angle` from that half-edge.
std::vector<CornerAngles> angles_around(const GeodesicMesh& mesh, std::int32_t vertex, std::int32_t corner,
                                        double angle);

}  // namespace seamwire::detail
