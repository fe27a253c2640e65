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
  std::int32_t triangle = -1;  ///< -1: it meets none
  double distance = 0.0;       ///< in lengths of the ray's direction
};

/// Finds the first triangle that a ray meets, from either side.
///
/// A separate thread builds a tree of boxes. Until it is there every triangle is looked at: the answers are the same
/// from the start, and one takes some milliseconds where it takes microseconds later. Triangles without an area, or
/// with a corner that is not finite, are met by no ray. Copies share the tree; the last one to go stops the building.
class SEAMWIRE_API RayTree {
 public:
  /// Throws InvalidInput where a triangle has a vertex that is not there.
  RayTree(std::vector<Vector> points, std::vector<Triangle> triangles);

  /// Of triangles that are met at the same distance, the one with the smallest number. A ray that runs along an edge or
  /// through a vertex meets the triangles there.
  RayHit first_hit(const Vector& origin, const Vector& direction) const;

  /// Whether the tree is built.
  bool ready() const;
  /// Waits until it is, or until there turns out to be no memory for it. Throws Cancelled.
  void wait(const Task& task = {}) const;

 private:
  struct Parts;  // ray_tree.cpp
  std::shared_ptr<Parts> parts_;
};

}  // namespace seamwire
