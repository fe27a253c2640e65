// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/surface/triangle_connectivity.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// A connected piece of a surface that is cut open. It has its own vertices: a mesh vertex that a cut passes through
/// has one for each side. Each own vertex lies inside the island, or on exactly one boundary loop.
/// Its triangles are counter-clockwise in a map without flips.
struct Island : TriangleConnectivity {
  std::vector<std::int32_t> vertices;  ///< the mesh vertex of each own vertex
  std::vector<std::int32_t> faces;     ///< the mesh face of each triangle, ascending

  /// The boundary loops, of own vertices.
  std::vector<std::vector<std::int32_t>> boundaries() const { return boundary_loops(vertices.size()); }
  std::int64_t euler_characteristic() const { return TriangleConnectivity::euler_characteristic(vertices.size()); }
  /// How many more cuts the island needs to become a disc: see missing_cuts().
  std::int64_t missing_cuts() const;
};

/// The length of a boundary loop. `points`: of own vertices.
double loop_length(std::span<const std::int32_t> loop, std::span<const Vector> points);

/// The boundary loop that becomes the outline of Tutte's embedding: the longest of three or more edges. -1 without such
/// a loop. `points`: of own vertices.
std::int32_t outer_loop(const std::vector<std::vector<std::int32_t>>& boundaries, std::span<const Vector> points);

/// Cuts a mesh open and returns its islands, ordered by their first faces. Own vertices are numbered in the order of
/// the triangles' corners.
///
/// `is_cut`: per half-edge, 1 if it is cut, and then its twin is cut too. Throws Cancelled.
std::vector<Island> cut_open(const TriangleConnectivity& mesh, std::span<const std::uint8_t> is_cut,
                             const Task& task = {});

}  // namespace seamwire::detail
