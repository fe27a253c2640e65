// SPDX-License-Identifier: GPL-3.0-or-later
// The triangle test is that of Moeller and Trumbore, "Fast, minimum storage ray-triangle intersection" (1997); the tree
// is split at the median of the longest side, after Kay and Kajiya, "Ray tracing complex scenes" (1986).
#include "seamwire/rays.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <new>
#include <string>
#include <utility>

namespace seamwire {

namespace {

constexpr std::int32_t kLeaf = 4;
/// By how much a ray may pass a triangle, as part of its sides: else rounding would let it through between two.
constexpr double kSlack = 1e-9;
/// Larger than any path down a tree that is split at medians.
constexpr std::size_t kDepth = 64;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

float below(double x) { return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity()); }
float above(double x) { return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity()); }

}  // namespace

struct RayTree::Ray {
  Vector origin, direction;

  /// Whether it comes into a box before a distance. Boxes are rounded outwards by more than this here is off.
  bool enters(const Node& node, double before) const {
    double in = 0.0, out = before;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = node.low[static_cast<std::size_t>(axis)], high = node.high[static_cast<std::size_t>(axis)];
      if (direction[axis] == 0.0) {
        if (origin[axis] < low || origin[axis] > high) return false;
        continue;
      }
      const double one = (low - origin[axis]) / direction[axis], two = (high - origin[axis]) / direction[axis];
      in = std::max(in, std::min(one, two));
      out = std::min(out, std::max(one, two));
    }
    return in <= out;
  }
};

RayTree::RayTree(std::vector<Vector> points, std::vector<Triangle> triangles)
    : points_(std::move(points)), triangles_(std::move(triangles)) {
  const auto count = static_cast<std::int32_t>(points_.size());
  for (const Triangle& triangle : triangles_) {
    for (const std::int32_t v : triangle) {
      if (v < 0 || v >= count) {
        throw InvalidInput("triangles: there is no vertex " + std::to_string(v) + " of " + std::to_string(count));
      }
    }
  }
  builder_ = std::jthread([this](const std::stop_token& stop) {
    try {
      build(stop);
    } catch (const std::bad_alloc&) {
      state_.store(State::kFailed, std::memory_order_release);  // every triangle is looked at for ever
    }
    state_.notify_all();
  });
}

void RayTree::build(const std::stop_token& stop) {
  std::vector<std::array<float, 3>> centres(triangles_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    const Vector centre = (points_[at(a)] + points_[at(b)] + points_[at(c)]) / 3.0;
    centres[t] = {static_cast<float>(centre.x()), static_cast<float>(centre.y()), static_cast<float>(centre.z())};
    if (centre.allFinite()) order_.push_back(static_cast<std::int32_t>(t));
  }
  struct Part {
    std::int32_t first, last;
    std::int32_t parent;  // whose second child it is; -1: none's
  };
  std::vector<Part> parts;
  if (!order_.empty()) parts.push_back({0, static_cast<std::int32_t>(order_.size()), -1});
  nodes_.reserve(order_.size() / (kLeaf / 2) + 1);
  while (!parts.empty()) {
    if (stop.stop_requested()) return;
    const Part part = parts.back();
    parts.pop_back();
    const auto number = static_cast<std::int32_t>(nodes_.size());
    if (part.parent >= 0) nodes_[at(part.parent)].first = number;
    Eigen::AlignedBox3d box;
    Eigen::AlignedBox3f middles;
    for (std::int32_t i = part.first; i < part.last; ++i) {
      const std::int32_t t = order_[at(i)];
      for (const std::int32_t v : triangles_[at(t)]) box.extend(points_[at(v)]);
      middles.extend(Eigen::Vector3f(centres[at(t)].data()));
    }
    // As far outside as a ray may pass a triangle, and the divisions in Ray::enters may be off.
    const double slack =
        2.0 * kSlack * box.sizes().maxCoeff() + 1e-12 * box.min().cwiseAbs().cwiseMax(box.max()).maxCoeff();
    Node& node = nodes_.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
      node.low[static_cast<std::size_t>(axis)] = below(box.min()[axis] - slack);
      node.high[static_cast<std::size_t>(axis)] = above(box.max()[axis] + slack);
    }
    if (part.last - part.first <= kLeaf) {
      node.first = part.first;
      node.count = part.last - part.first;
      continue;
    }
    Eigen::Index longest = 0;
    middles.sizes().maxCoeff(&longest);
    const auto axis = static_cast<std::size_t>(longest);
    const std::int32_t middle = part.first + (part.last - part.first) / 2;
    std::nth_element(
        order_.begin() + part.first, order_.begin() + middle, order_.begin() + part.last,
        [&](std::int32_t one, std::int32_t two) { return centres[at(one)][axis] < centres[at(two)][axis]; });
    parts.push_back({middle, part.last, number});
    parts.push_back({part.first, middle, -1});
  }
  state_.store(State::kBuilt, std::memory_order_release);
}

void RayTree::try_triangle(const Ray& ray, std::int32_t triangle, RayHit& best) const {
  const auto& [a, b, c] = triangles_[at(triangle)];
  const Vector& origin = points_[at(a)];
  const Vector one = points_[at(b)] - origin, two = points_[at(c)] - origin;
  const Vector across = ray.direction.cross(two);
  const double volume = one.dot(across);
  if (!(std::abs(volume) > 0.0)) return;  // seen edgewise, without an area, or not finite
  const Vector from = ray.origin - origin;
  const double u = from.dot(across) / volume;
  if (!(u >= -kSlack && u <= 1.0 + kSlack)) return;
  const Vector turned = from.cross(one);
  const double v = ray.direction.dot(turned) / volume;
  if (!(v >= -kSlack && u + v <= 1.0 + kSlack)) return;
  const double distance = two.dot(turned) / volume;
  if (!(distance >= 0.0)) return;
  const bool nearer = distance < best.distance || (distance == best.distance && triangle < best.triangle);
  if (best.triangle < 0 || nearer) best = {triangle, distance};
}

RayHit RayTree::first_hit(const Vector& origin, const Vector& direction) const {
  const Ray ray{origin, direction};
  RayHit best;
  if (!ready()) {
    for (std::size_t t = 0; t < triangles_.size(); ++t) try_triangle(ray, static_cast<std::int32_t>(t), best);
    return best;
  }
  std::array<std::int32_t, kDepth> open;
  std::size_t depth = 0;
  if (!nodes_.empty()) open[depth++] = 0;
  while (depth > 0) {
    const std::int32_t number = open[--depth];
    const Node& node = nodes_[at(number)];
    if (!ray.enters(node, best.triangle < 0 ? std::numeric_limits<double>::infinity() : best.distance)) continue;
    if (node.count == 0) {
      open[depth++] = node.first;
      open[depth++] = number + 1;
      continue;
    }
    for (std::int32_t i = 0; i < node.count; ++i) try_triangle(ray, order_[at(node.first + i)], best);
  }
  return best;
}

}  // namespace seamwire
