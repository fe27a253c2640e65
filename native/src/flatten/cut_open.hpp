// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/surface/types.hpp"
#include "seamwire/surface/vector.hpp"

namespace seamwire::detail {

/// A connected piece of a surface that is cut open. It has its own vertices: a mesh vertex that a cut passes through
/// has one for each side. Each own vertex lies inside the island, or on exactly one boundary loop.
struct Island {
  std::vector<Triangle> triangles;     ///< of own vertices, counter-clockwise in a map without flips
  std::vector<std::int32_t> vertices;  ///< the mesh vertex of each own vertex
  std::vector<std::int32_t> faces;     ///< the mesh face of each triangle, ascending
  /// For half-edge 3 f + i of the island's triangle f, the half-edge on the other side; -1 on the boundary.
  std::vector<std::int32_t> twins;

  /// The boundary loops: own vertices in the direction of the triangles along them. The loops are ordered by their
  /// smallest vertex, with which each of them starts.
  std::vector<std::vector<std::int32_t>> boundaries() const;
};

/// The length of a boundary loop. `points`: of own vertices.
double loop_length(std::span<const std::int32_t> loop, std::span<const Vector> points);

/// The boundary loop that becomes the outline of Tutte's embedding: the longest of three or more edges. -1 without such
/// a loop. `points`: of own vertices.
std::int32_t outer_loop(const std::vector<std::vector<std::int32_t>>& boundaries, std::span<const Vector> points);

/// Cuts a mesh open and returns its islands, ordered by their first faces. Own vertices are numbered in the order of
/// the triangles' corners.
///
/// `triangles`: faces that share an edge are oriented alike. `twins`: for half-edge 3 f + i, from corner i of face f to
/// the next, the half-edge on the other side; -1 on the boundary. `is_cut`: 1 where a half-edge is cut, and then its
/// twin is cut too. Both have three entries for each triangle.
std::vector<Island> cut_open(std::span<const Triangle> triangles, std::span<const std::int32_t> twins,
                             std::span<const std::uint8_t> is_cut);

}  // namespace seamwire::detail
