// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "detail/csr.hpp"
#include "parameterization/cut_open.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// The vertices and edges of an island, for distances along edges within it.
struct IslandGraph {
  struct Neighbor {
    std::int32_t vertex = -1;
    double length = 0.0;
  };
  IslandGraph(const Island& island, std::span<const Vector> points);

  /// Distances along edges from a vertex.
  std::vector<double> distances_from(std::int32_t vertex) const;
  /// The mean geodesic distance of each vertex to the surface (Hilaga et al. 2001), from samples that are spread over
  /// the area. On several threads.
  std::vector<double> mean_distances(const Task& task) const;
  /// The local maxima of a function that stand out from their surroundings by `prominence` or more, highest first.
  std::vector<std::int32_t> peaks(std::span<const double> heights, double prominence) const;

  Csr<Neighbor> neighbors;
  std::vector<double> areas;  ///< a third of that of the triangles around each vertex
};

}  // namespace seamwire::detail
