// SPDX-License-Identifier: GPL-3.0-or-later
// The triangle test is that of Moeller and Trumbore, "Fast, minimum storage ray-triangle intersection" (1997).
#include "seamwire/rays.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <new>
#include <string>
#include <thread>
#include <unsupported/Eigen/BVH>
#include <utility>

namespace seamwire {

namespace {

using Box = Eigen::AlignedBox3d;

/// By how much a ray may pass a triangle, as part of its sides: else rounding would let it through between two.
constexpr double kSlack = 1e-9;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// A box that a ray comes into wherever it meets the triangle: as far outside as it may pass the triangle, and as the
/// divisions in FirstHit::intersectVolume may be off.
Box box_of(const Vector& a, const Vector& b, const Vector& c) {
  Box box(a);
  box.extend(b);
  box.extend(c);
  const double slack =
      2.0 * kSlack * box.sizes().maxCoeff() + 1e-12 * box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  return {(box.min().array() - slack).matrix(), (box.max().array() + slack).matrix()};
}

}  // namespace

struct RayTree::Parts {
  enum class State { kBuilding, kBuilt, kFailed };

  std::vector<Vector> points;
  std::vector<Triangle> triangles;
  Eigen::KdBVH<double, 3, std::int32_t> tree;
  std::atomic<State> state = State::kBuilding;

  void build();
};

namespace {

/// One ray on its way through the triangles; what Eigen::BVIntersect asks.
struct FirstHit {
  const std::vector<Vector>& points;
  const std::vector<Triangle>& triangles;
  Vector origin, direction;
  RayHit best{-1, std::numeric_limits<double>::infinity()};

  /// Whether the ray comes into a box before the best hit so far.
  // NOLINTNEXTLINE(readability-identifier-naming): Eigen's name
  bool intersectVolume(const Box& box) const {
    double in = 0.0, out = best.distance;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = box.min()[axis] - origin[axis], high = box.max()[axis] - origin[axis];
      if (direction[axis] == 0.0) {
        if (low > 0.0 || high < 0.0) return false;
        continue;
      }
      const double one = low / direction[axis], two = high / direction[axis];
      in = std::max(in, std::min(one, two));
      out = std::min(out, std::max(one, two));
    }
    return in <= out;
  }

  /// Takes the triangle if it is met before the best hit so far; false: the search goes on.
  // NOLINTNEXTLINE(readability-identifier-naming): Eigen's name
  bool intersectObject(std::int32_t triangle) {
    const auto& [a, b, c] = triangles[at(triangle)];
    const Vector& corner = points[at(a)];
    const Vector one = points[at(b)] - corner, two = points[at(c)] - corner;
    const Vector across = direction.cross(two);
    const double volume = one.dot(across);
    if (!(std::abs(volume) > 0.0)) return false;  // seen edgewise, without an area, or not finite
    const Vector from = origin - corner;
    const double u = from.dot(across) / volume;
    if (!(u >= -kSlack && u <= 1.0 + kSlack)) return false;
    const Vector turned = from.cross(one);
    const double v = direction.dot(turned) / volume;
    if (!(v >= -kSlack && u + v <= 1.0 + kSlack)) return false;
    const double distance = two.dot(turned) / volume;
    if (!(distance >= 0.0)) return false;
    if (distance < best.distance || (distance == best.distance && triangle < best.triangle))
      best = {triangle, distance};
    return false;
  }
};

}  // namespace

void RayTree::Parts::build() {
  try {
    std::vector<std::int32_t> numbers;
    std::vector<Box> boxes;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& [a, b, c] = triangles[t];
      if (!(points[at(a)] + points[at(b)] + points[at(c)]).allFinite()) continue;
      numbers.push_back(static_cast<std::int32_t>(t));
      boxes.push_back(box_of(points[at(a)], points[at(b)], points[at(c)]));
    }
    tree.init(numbers.begin(), numbers.end(), boxes.begin(), boxes.end());
    state.store(State::kBuilt, std::memory_order_release);
  } catch (const std::bad_alloc&) {
    state.store(State::kFailed, std::memory_order_release);  // every triangle is looked at for ever
  }
  state.notify_all();
}

RayTree::RayTree(std::vector<Vector> points, std::vector<Triangle> triangles) : parts_(std::make_shared<Parts>()) {
  const auto count = static_cast<std::int32_t>(points.size());
  for (const Triangle& triangle : triangles) {
    for (const std::int32_t v : triangle) {
      if (v < 0 || v >= count) {
        throw InvalidInput("triangles: there is no vertex " + std::to_string(v) + " of " + std::to_string(count));
      }
    }
  }
  parts_->points = std::move(points);
  parts_->triangles = std::move(triangles);
  // Eigen's building cannot be stopped; whoever drops the tree before it is built does not wait for it.
  std::thread([parts = parts_] { parts->build(); }).detach();
}

RayHit RayTree::first_hit(const Vector& origin, const Vector& direction) const {
  FirstHit search{parts_->points, parts_->triangles, origin, direction};
  if (ready()) {
    Eigen::BVIntersect(parts_->tree, search);
  } else {
    for (std::size_t t = 0; t < parts_->triangles.size(); ++t) search.intersectObject(static_cast<std::int32_t>(t));
  }
  return search.best.triangle < 0 ? RayHit{} : search.best;
}

bool RayTree::ready() const { return parts_->state.load(std::memory_order_acquire) == Parts::State::kBuilt; }

void RayTree::wait() const { parts_->state.wait(Parts::State::kBuilding, std::memory_order_acquire); }

}  // namespace seamwire
