// SPDX-License-Identifier: GPL-3.0-or-later
// The triangle test is that of Moeller and Trumbore, "Fast, minimum storage ray-triangle intersection" (1997).
#include "seamwire/surface/ray_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <stop_token>
#include <thread>
#include <utility>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "surface/box_tree.hpp"
#include "surface/extreme_exponent.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// By how much a ray may pass a triangle, as part of its sides: else rounding would let it through between two.
constexpr double kSlack = 1e-9;
/// Of a distance along a ray, how much of it may be rounding.
constexpr double kRounding = 1e-12;

/// A box that a ray comes into wherever it meets the triangle: as far outside as it may pass the triangle, and as the
/// divisions in FirstHit::inside() may be off.
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

  int exponent = 0;  ///< of what points were divided by, a power of two
  std::vector<Vector> points;
  std::vector<Triangle> triangles;
  BoxTree tree;  ///< of the triangles that are finite
  std::atomic<State> state = State::kBuilding;
  std::jthread thread;  ///< last, so that it ends first

  void build(const std::stop_token& stop);
};

namespace {

/// One ray on its way through the triangles.
struct FirstHit {
  const std::vector<Vector>& points;
  const std::vector<Triangle>& triangles;
  Vector origin, direction;
  RayHit best{-1, kInfinity};

  /// From where to where the ray is in a box, as far as it is asked for; nowhere where the first is the greater.
  std::array<double, 2> inside(const Box& box, double farthest) const {
    double in = 0.0, out = farthest;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = box.min()[axis] - origin[axis], high = box.max()[axis] - origin[axis];
      if (direction[axis] == 0.0) {
        if (low > 0.0 || high < 0.0) return {1.0, 0.0};
        continue;
      }
      const double one = low / direction[axis], two = high / direction[axis];
      in = std::max(in, std::min(one, two));
      out = std::min(out, std::max(one, two));
    }
    return {in, out};
  }

  /// Takes the triangle if it is met before the best hit so far.
  void look_at(std::int32_t triangle) {
    const auto& [a, b, c] = triangles[triangle];
    const Vector& corner = points[a];
    const Vector one = points[b] - corner, two = points[c] - corner;
    const Vector across = direction.cross(two);
    const double volume = one.dot(across);
    if (!(std::abs(volume) > 0.0)) return;  // seen edgewise, without an area, or not finite
    const Vector from = origin - corner;
    const double u = from.dot(across) / volume;
    if (!(u >= -kSlack && u <= 1.0 + kSlack)) return;
    const Vector turned = from.cross(one);
    const double v = direction.dot(turned) / volume;
    if (!(v >= -kSlack && u + v <= 1.0 + kSlack)) return;
    const double distance = two.dot(turned) / volume;
    if (!(distance >= 0.0)) return;
    // Where corners are in line but for rounding, the numbers above are rounding too. A hit outside of the triangle's
    // box would be found or not as the order has it.
    const auto [in, out] = inside(box_of(corner, points[b], points[c]), kInfinity);
    const double room = (out - in) + kRounding * out;
    if (!(in <= out && distance >= in - room && distance <= out + room)) return;
    const double met = std::clamp(distance, in, out);
    if (met < best.distance || (met == best.distance && triangle < best.triangle)) best = {triangle, met};
  }
};

}  // namespace

void RayTree::Parts::build(const std::stop_token& stop) {
  State reached = State::kFailed;  // every triangle is looked at for ever
  try {
    const auto box = [this](std::int32_t t) {
      const auto& [a, b, c] = triangles[t];
      const bool is_finite = points[a].allFinite() && points[b].allFinite() && points[c].allFinite();
      return is_finite ? box_of(points[a], points[b], points[c]) : Box();
    };
    if (tree.build(triangles.size(), box, [&stop] { return !stop.stop_requested(); })) reached = State::kBuilt;
  } catch (...) {
    // There is no memory for it.
  }
  state.store(reached, std::memory_order_release);
  state.notify_all();
}

RayTree::RayTree(std::vector<Vector> points, std::vector<Triangle> triangles) : parts_(std::make_shared<Parts>()) {
  for (const Triangle& triangle : triangles) {
    for (const std::int32_t v : triangle) {
      if (!is_index(v, points.size())) check_index(v, points.size(), "triangles: vertex");
    }
  }
  parts_->exponent = extreme_exponent(points);
  if (parts_->exponent != 0) {
    for (Vector& p : points) p = scaled(p, -parts_->exponent);
  }
  parts_->points = std::move(points);
  parts_->triangles = std::move(triangles);
  parts_->thread = std::jthread([parts = parts_.get()](const std::stop_token& stop) { parts->build(stop); });
}

RayHit RayTree::first_hit(const Vector& origin, const Vector& direction) const {
  return find_hit(origin, direction, false);
}

bool RayTree::is_met(const Vector& origin, const Vector& direction) const {
  return find_hit(origin, direction, true).triangle >= 0;
}

RayHit RayTree::find_hit(const Vector& given_origin, const Vector& given_direction, bool is_any_enough) const {
  const int exponent = parts_->exponent, of_direction = extreme_exponent({&given_direction, 1});
  const Vector origin = exponent == 0 ? given_origin : scaled(given_origin, -exponent);
  const Vector direction = of_direction == 0 ? given_direction : scaled(given_direction, -of_direction);
  FirstHit search{parts_->points, parts_->triangles, origin, direction};
  const auto found = [&]() -> RayHit {
    if (search.best.triangle < 0) return {};
    return {search.best.triangle, std::ldexp(search.best.distance, exponent - of_direction)};
  };
  if (!ready()) {
    for (std::size_t t = 0; t < parts_->triangles.size(); ++t) search.look_at(static_cast<std::int32_t>(t));
    return found();
  }
  const BoxTree& tree = parts_->tree;
  const auto comes_in_at = [&](std::int32_t node) {
    const auto [in, out] = search.inside(tree.nodes[node].box, search.best.distance);
    return in <= out ? in : kInfinity;
  };
  std::array<std::int32_t, BoxTree::kMostDepth> waiting{};  // a node at each depth
  std::size_t count = tree.nodes.empty() ? 0 : 1;
  while (count > 0 && !(is_any_enough && search.best.triangle >= 0)) {
    const BoxTree::Node& node = tree.nodes[waiting[--count]];
    // Better hits may have been found since it was put there.
    const auto [in, out] = search.inside(node.box, search.best.distance);
    if (!(in <= out)) continue;
    for (std::int32_t i = 0; i < node.count; ++i) search.look_at(tree.order[node.first + i]);
    if (node.count > 0) continue;
    const bool second_is_nearer = comes_in_at(node.first + 1) < comes_in_at(node.first);
    waiting[count++] = node.first + (second_is_nearer ? 0 : 1);
    waiting[count++] = node.first + (second_is_nearer ? 1 : 0);
  }
  return found();
}

bool RayTree::ready() const { return parts_->state.load(std::memory_order_acquire) == Parts::State::kBuilt; }

void RayTree::wait(const Task& task) const {
  constexpr std::chrono::milliseconds kPeriod{5};
  task.check(0.0);
  if (!task.progress && !task.stop.stop_possible()) {
    parts_->state.wait(Parts::State::kBuilding, std::memory_order_acquire);
    return;
  }
  while (parts_->state.load(std::memory_order_acquire) == Parts::State::kBuilding) {
    task.check(0.0);
    std::this_thread::sleep_for(kPeriod);
  }
}

}  // namespace seamwire
