// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prices/plan_mesh.hpp"

namespace seamwire::detail {

/// The polygons that the triangles of a mesh belong to.
struct Polygons {
  std::vector<std::int32_t> of_face;      ///< of each triangle
  std::vector<std::uint8_t> is_diagonal;  ///< of each edge: 1 inside a polygon
  std::size_t count = 0;
};

/// Finds the polygons: those that were triangulated, and pairs of other triangles that look like a quad, the best pairs
/// first. `is_border`: of each edge, 1 if it cannot lie inside a quad; empty: all can.
Polygons find_polygons(const PlanMesh& mesh, std::span<const FaceFrame> frames,
                       std::span<const std::uint8_t> is_border = {});

/// The lines that edges form. An edge goes on over a vertex to the edge on the other side if that is nearly straight
/// and neither has a better continuation.
struct EdgeLines {
  std::vector<std::int32_t> of_edge;             ///< the line of each edge, -1 for diagonals
  std::vector<std::vector<std::int32_t>> edges;  ///< of each line, from end to end
};
EdgeLines find_lines(const PlanMesh& mesh, const Polygons& polygons);

}  // namespace seamwire::detail
