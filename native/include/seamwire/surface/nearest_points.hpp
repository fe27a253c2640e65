// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/errors.hpp"
#include "seamwire/surface/types.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// The point of some triangles that is nearest to a place.
struct NearestPoint {
  std::int32_t triangle = -1;     ///< of those at the same distance, usually the one with the smallest number
  Vector point = Vector::Zero();  ///< in the caller's coordinates
  double distance = 0.0;          ///< from the place, in the same unit
};

/// Finds the nearest points of triangles with a tree of boxes. Triangles without an area count as their sides do.
/// Copies share the tree. Several threads may use it.
class SEAMWIRE_API NearestPoints {
 public:
  /// Builds the tree, in half a second for a million triangles. Throws InvalidInput if there is no triangle, if a
  /// triangle has a vertex that is not there, or for a coordinate that is not finite; Cancelled.
  NearestPoints(std::vector<Vector> points, std::vector<Triangle> triangles, const Task& task = {});

  /// Returns the nearest point for each place. `normals`: a direction for each place; triangles that face away from it
  /// do not count, unless all do. Triangles without an area never face away. Empty: all triangles count.
  ///
  /// Works on several threads. Throws InvalidInput if there are not as many normals as places, or for a coordinate that
  /// is not finite; Cancelled.
  std::vector<NearestPoint> find(std::span<const Vector> places, std::span<const Vector> normals = {},
                                 const Task& task = {}) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace seamwire
