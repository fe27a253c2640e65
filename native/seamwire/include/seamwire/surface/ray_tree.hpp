// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/errors.hpp"
#include "seamwire/surface/types.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Where a ray meets a triangle.
struct RayHit {
  std::int32_t triangle = -1;  ///< -1 if the ray meets no triangle
  double distance = 0.0;       ///< from the origin, in lengths of the ray's direction, 0 or more
};

/// Finds the first triangle that a ray meets, from either side.
///
/// A separate thread builds a tree of boxes. Until the tree is ready, each query checks every triangle. The answers are
/// the same, but take milliseconds instead of microseconds. Rays miss triangles without an area, and triangles with a
/// corner that is not finite.
///
/// Copies share the tree. Several threads may use it at once. Destroying the last copy stops the building.
class SEAMWIRE_API RayTree {
 public:
  /// Start to build the tree, and return at once.
  ///
  /// \param points coordinates
  /// \param triangles vertex numbers in [0, points.size())
  /// \throws InvalidInput if a vertex is out of range
  RayTree(std::vector<Vector> points, std::vector<Triangle> triangles);

  /// Find the first triangle that a ray meets.
  ///
  /// A ray that runs along an edge or through a vertex meets the triangles there.
  ///
  /// \param origin where the ray starts
  /// \param direction where it leads, of any length
  /// \returns the first hit. Of several triangles at the same distance, it has the smallest number.
  RayHit first_hit(const Vector& origin, const Vector& direction) const;
  /// Return whether a ray meets any triangle. This takes less time than finding the first one.
  bool is_met(const Vector& origin, const Vector& direction) const;

  /// Return whether the tree is built.
  bool ready() const;
  /// Wait until the tree is built, or until there is not enough memory for it. The reported fraction stays 0.
  void wait(const Task& = {}) const;

 private:
  struct Parts;  // ray_tree.cpp
  RayHit find_hit(const Vector& origin, const Vector& direction, bool is_any_enough) const;
  std::shared_ptr<Parts> parts_;
};

}  // namespace seamwire
