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
  std::int32_t triangle = -1;     ///< its triangle; of several at the same distance, usually the smallest number
  Vector point = Vector::Zero();  ///< in the caller's coordinates
  double distance = 0.0;          ///< from the place, in the caller's unit, 0 or more
};

/// Finds the nearest points of triangles with a tree of boxes.
///
/// A triangle without an area counts as its sides do. Copies share the tree. Several threads may use it at once.
class SEAMWIRE_API NearestPoints {
 public:
  /// Build the tree.
  ///
  /// \param points finite coordinates
  /// \param triangles vertex numbers in [0, points.size())
  /// \throws InvalidInput if there is no triangle, a vertex is out of range, or a coordinate is not finite
  NearestPoints(std::vector<Vector> points, std::vector<Triangle> triangles, const Task& = {});

  /// Find the nearest point for each place, on several threads.
  ///
  /// \param places finite coordinates
  /// \param normals a direction for each place. Triangles that face away from it do not count, unless all do. Triangles
  ///   without an area never face away. Empty: all triangles count.
  /// \returns the nearest points, in the order of the places
  /// \throws InvalidInput if the numbers of normals and places differ, or a coordinate is not finite
  std::vector<NearestPoint> find(std::span<const Vector> places, std::span<const Vector> normals = {},
                                 const Task& = {}) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace seamwire
