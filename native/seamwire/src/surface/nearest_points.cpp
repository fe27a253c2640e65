// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/nearest_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "detail/run_on_threads.hpp"
#include "surface/box_tree.hpp"
#include "surface/extreme_exponent.hpp"
#include "surface/point_segment.hpp"

namespace seamwire {

using namespace detail;

namespace {

constexpr std::size_t kPlacesInAChunk = 256;

void check_finite(std::span<const Vector> points, const char* what, const Task& task) {
  const Poll poll(task, 0.0, 0.0, 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    poll.at(i);
    if (!points[i].allFinite()) throw InvalidInput(std::string(what) + " " + std::to_string(i) + " is not finite");
  }
}

/// Returns the places in an order in which those that follow each other mostly lie near each other: along a Morton
/// curve (1966).
std::vector<std::int32_t> along_curve(std::span<const Vector> places, const Task& task) {
  Poll poll(task, 0.0, 0.0, 1);
  Box box;
  for (const Vector& place : places) box.extend(place);
  constexpr double kCells = 1 << 10;  // on each axis
  const Vector sizes = box.sizes().cwiseMax(std::numeric_limits<double>::min());
  std::vector<std::pair<std::uint32_t, std::int32_t>> keys;
  keys.reserve(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    poll.next();
    std::uint32_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double part = (places[i][axis] - box.min()[axis]) / sizes[axis];
      const auto cell = static_cast<std::uint32_t>(part > 0.0 ? std::min(part * kCells, kCells - 1.0) : 0.0);
      for (int bit = 0; bit < 10; ++bit) key |= (cell >> bit & 1U) << (3 * bit + axis);
    }
    keys.emplace_back(key, static_cast<std::int32_t>(i));
  }
  std::ranges::sort(keys, [&](const auto& one, const auto& other) {
    poll.next();
    return one < other;
  });
  std::vector<std::int32_t> order;
  order.reserve(keys.size());
  for (const auto& [key, i] : keys) order.push_back(i);
  return order;
}

/// The normal of a triangle, of any length; zero if the triangle is too thin to have one.
Vector normal_of(const Vector& u, const Vector& v) {
  constexpr double kThin = 1e-10;  // the sine of an angle that rounding may make
  const Vector normal = u.cross(v);
  return normal.norm() > kThin * std::max(u.squaredNorm(), v.squaredNorm()) ? normal : Vector(Vector::Zero());
}

/// The point of a triangle that is nearest to a place.
Vector nearest_in(const std::array<Vector, 3>& corners, const Vector& place) {
  const Vector u = corners[1] - corners[0], v = corners[2] - corners[0], w = place - corners[0];
  const Vector normal = normal_of(u, v);
  const double square = normal.squaredNorm();
  if (square > 0.0) {
    // Where the place lies above the triangle, that is the point below. Otherwise it lies on a side.
    const double s = w.cross(v).dot(normal) / square, t = u.cross(w).dot(normal) / square;
    if (s >= 0.0 && t >= 0.0 && s + t <= 1.0) return place - (w.dot(normal) / square) * normal;
  }
  Vector best = corners[0];
  double least = kInfinity;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector to = to_segment(place, corners[i], corners[(i + 1) % 3]);
    if (to.squaredNorm() < least) {
      least = to.squaredNorm();
      best = place + to;
    }
  }
  return best;
}

}  // namespace

struct NearestPoints::Impl {
  int exponent = 0;                            ///< of what points were divided by, a power of two
  std::vector<std::array<Vector, 3>> corners;  ///< of each triangle, in the order of the tree
  std::vector<Vector> normals;                 ///< the same, of any length; zero for a triangle without an area
  BoxTree tree;

  /// Finds the point nearest to a place. `normal`: triangles that face away from it do not count; null: all count. No
  /// triangle if none counts. `hint`: where in the order of the tree to begin to look, and where the triangle was
  /// found.
  NearestPoint find(const Vector& place, const Vector* normal, std::int32_t& hint) const;
  /// The same with a place and a result in the caller's coordinates.
  NearestPoint find_given(const Vector& place, const Vector* normal, std::int32_t& hint) const;
};

NearestPoints::NearestPoints(std::vector<Vector> points, std::vector<Triangle> triangles, const Task& task) {
  if (triangles.empty()) throw InvalidInput("There are no triangles");
  check_finite(points, "point", task);
  Poll poll(task, 0.0, 0.0, 1);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    poll.next();
    for (const std::int32_t v : triangles[t]) {
      if (!is_index(v, points.size())) check_index(v, points.size(), "triangle " + std::to_string(t) + ": vertex");
    }
  }
  auto impl = std::make_shared<Impl>();
  impl->exponent = extreme_exponent(points);
  if (impl->exponent != 0) {
    for (Vector& p : points) p = scaled(p, -impl->exponent);
  }
  const auto box_of = [&](std::int32_t t) {
    const auto& [a, b, c] = triangles[t];
    return Box(points[a]).extend(points[b]).extend(points[c]);
  };
  impl->tree.build(triangles.size(), box_of, [&task] {
    task.check(0.0);
    return true;
  });
  impl->corners.reserve(triangles.size());
  impl->normals.reserve(triangles.size());
  for (const std::int32_t t : impl->tree.order) {
    poll.next();
    const auto& [a, b, c] = triangles[t];
    impl->corners.push_back({points[a], points[b], points[c]});
    impl->normals.push_back(normal_of(points[b] - points[a], points[c] - points[a]));
  }
  impl_ = std::move(impl);
}

NearestPoint NearestPoints::Impl::find(const Vector& place, const Vector* normal, std::int32_t& hint) const {
  NearestPoint best;
  const auto look_at = [&](std::int32_t i, double& least) {
    if (normal != nullptr && normals[i].dot(*normal) < 0.0) return;
    const Vector point = nearest_in(corners[i], place);
    const double square = (point - place).squaredNorm();
    const std::int32_t triangle = tree.order[i];
    if (square > least || (square == least && best.triangle >= 0 && triangle > best.triangle)) return;
    least = square;
    best = {.triangle = triangle, .point = point, .distance = std::sqrt(square)};
    hint = i;
  };
  double squared = kInfinity;
  look_at(hint, squared);
  tree.visit_near(place, squared, BoxTree::kRounded, look_at);
  return best;
}

NearestPoint NearestPoints::Impl::find_given(const Vector& place, const Vector* normal, std::int32_t& hint) const {
  constexpr int kFarthest = 400;
  // To a place beyond this all points are in one direction, and a nearer one in that direction finds the same.
  const int nearer = std::max(0, extreme_exponent({&place, 1}) - exponent - kFarthest), moved = -exponent - nearer;
  if (moved == 0) return find(place, normal, hint);
  NearestPoint found = find(scaled(place, moved), normal, hint);
  found.point = scaled(found.point, exponent);
  found.distance = std::ldexp(found.distance, -moved);
  return found;
}

std::vector<NearestPoint> NearestPoints::find(std::span<const Vector> places, std::span<const Vector> normals,
                                              const Task& task) const {
  if (!normals.empty() && normals.size() != places.size()) {
    throw InvalidInput("There are " + std::to_string(places.size()) + " places, but " + std::to_string(normals.size()) +
                       " normals");
  }
  check_finite(places, "place", task);
  check_finite(normals, "normal", task);
  std::vector<NearestPoint> found(places.size());
  const std::vector<std::int32_t> order = along_curve(places, task);
  const std::size_t chunks = (places.size() + kPlacesInAChunk - 1) / kPlacesInAChunk;
  const auto find_chunk = [&](std::size_t chunk, const Task& own) {
    own.check(0.0);
    const std::size_t end = std::min((chunk + 1) * kPlacesInAChunk, places.size());
    std::int32_t hint = 0;
    for (std::size_t k = chunk * kPlacesInAChunk; k < end; ++k) {
      const std::int32_t i = order[k];
      if (!normals.empty()) {
        const Vector normal = normals[i].stableNormalized();
        found[i] = impl_->find_given(places[i], &normal, hint);
      }
      if (found[i].triangle < 0) found[i] = impl_->find_given(places[i], nullptr, hint);
    }
  };
  run_on_threads(
      chunks, task, [chunks](std::size_t done) { return static_cast<double>(done) / static_cast<double>(chunks); },
      find_chunk);
  return found;
}

}  // namespace seamwire
