// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "seamwire/task.hpp"

namespace seamwire {

/// A point that a geodesic passes: a vertex (half_edge < 0), or a point on an edge.
struct PathPoint {
  std::int32_t vertex = -1;     ///< -1: on an edge
  std::int32_t half_edge = -1;  ///< -1: at a vertex
  double t = 0.0;               ///< 0 at the tail of the half-edge, 1 at its tip
};

/// A geodesic over an IntrinsicMesh, from the seed to a target: straight in each triangle.
struct IntrinsicPath {
  std::vector<PathPoint> points;    ///< empty where the target is unreachable; one point where it is the seed
  std::vector<std::int32_t> faces;  ///< the triangle each segment crosses or bounds; -1 along a loose edge
  double length = std::numeric_limits<double>::infinity();  ///< sum of the segments' lengths
};

/// Distances from one seed to every vertex of an IntrinsicMesh, with what it takes to trace the paths; exact, or from a
/// bounded number of windows (ExactGeodesics makes both). Immutable; copies share the data.
class DistanceField {
 public:
  std::int32_t seed() const;  ///< the vertex that distances are from
  bool is_exact() const;      ///< or from a bounded number of windows
  /// One a vertex; infinite where no path leads. Where the field is not exact they may be too long or too short.
  const std::vector<double>& distances() const;

  /// The shortest path from the seed to a vertex, in time proportional to the triangles it crosses. Its length is the
  /// distance to rounding. Where the field is not exact, it is a real path all the same, with its true length: the
  /// shortest one within the triangles around the path that the field tells; it may be longer than the geodesic, but
  /// not shorter.
  ///
  /// Throws InvalidInput for a vertex out of range. Where the field is not exact, the work takes long enough for `task`
  /// to be looked at, and Cancelled may be thrown.
  IntrinsicPath trace(std::int32_t vertex, const Task& task = {}) const;

  struct Data;  // the solver's own
  /// By ExactGeodesics only.
  explicit DistanceField(std::shared_ptr<const Data> data);

 private:
  std::shared_ptr<const Data> data_;
};

}  // namespace seamwire
