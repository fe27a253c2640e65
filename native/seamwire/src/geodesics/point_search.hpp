// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "detail/infinity.hpp"
#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/placed_point.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// The results of a solve that points between the vertices need.
struct SolvedDistances {
  const GeodesicMesh& mesh;
  const std::vector<double>& distances;  ///< exact, in external numbers
  const SourcePoints& sources;
  /// Distances that are not below it may be missing (infinite).
  double radius = kInfinity;

  double at(std::int32_t vertex) const { return distances[mesh.external_vertex(vertex)]; }
};

/// The shortest path from a point in a face, as far as it is straight: to a vertex or to a source.
struct StraightStart {
  double distance = kInfinity;            ///< of the point; infinite: no path, or beyond the radius
  std::int32_t vertex = -1, source = -1;  ///< where it ends; one of them is -1
  IntrinsicPath path;  ///< from the point to there, in internal numbers; its length is the straight part's
};

/// Finds the distance of a point between the vertices, and how its shortest path begins.
StraightStart find_straight_start(const SolvedDistances& solved, const PlacedPoint& point, const Task& task);

}  // namespace seamwire::detail
