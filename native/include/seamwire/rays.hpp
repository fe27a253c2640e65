// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <stop_token>
#include <thread>
#include <vector>

#include "seamwire/surface.hpp"

namespace seamwire {

/// Where a ray meets a triangle.
struct RayHit {
  std::int32_t triangle = -1;  ///< -1: it meets none
  double distance = 0.0;       ///< in lengths of the ray's direction
};

/// Finds the first triangle that a ray meets, from either side.
///
/// A tree of boxes is built on a thread of its own, in about half a second for a million triangles. Until it is there
/// every triangle is looked at: the answers are the same from the start, and one takes some milliseconds where it takes
/// microseconds later. Triangles without an area, or with a corner that is not finite, are met by no ray.
class RayTree {
 public:
  /// Throws InvalidInput where a triangle has a vertex that is not there.
  RayTree(std::vector<Vector> points, std::vector<Triangle> triangles);

  /// Of triangles that are met at the same distance, the one with the smallest number. A ray that runs along an edge or
  /// through a vertex meets the triangles there.
  RayHit first_hit(const Vector& origin, const Vector& direction) const;

  /// Whether the tree is built.
  bool ready() const { return state_.load(std::memory_order_acquire) == State::kBuilt; }
  /// Waits until it is, or until there turns out to be no memory for it.
  void wait() const { state_.wait(State::kBuilding, std::memory_order_acquire); }

 private:
  enum class State { kBuilding, kBuilt, kFailed };
  struct Node {
    std::array<float, 3> low, high;
    std::int32_t first = 0;  ///< of a leaf: its place in order_; else the second child, the first one being the next
    std::int32_t count = 0;  ///< of a leaf: how many triangles; else 0
  };
  struct Ray;

  void build(const std::stop_token& stop);
  void try_triangle(const Ray& ray, std::int32_t triangle, RayHit& best) const;

  std::vector<Vector> points_;
  std::vector<Triangle> triangles_;
  std::vector<std::int32_t> order_;
  std::vector<Node> nodes_;
  std::atomic<State> state_ = State::kBuilding;
  std::jthread builder_;  // last: it is stopped before what it works on goes
};

}  // namespace seamwire
