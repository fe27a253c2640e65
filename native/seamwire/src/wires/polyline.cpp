// SPDX-License-Identifier: GPL-3.0-or-later
#include "wires/polyline.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "detail/infinity.hpp"

namespace seamwire::detail {
namespace {

/// Points in which the distance along an edge is integrated. The distance has kinks, so many points serve better than a
/// rule of high order.
constexpr std::size_t kSamples = 8;
constexpr double kRoom = 1.0 + 1e-9;  // much more than distances are rounded by
constexpr std::size_t kSegmentsOfALeaf = 4;

double fraction(std::size_t sample) { return (static_cast<double>(sample) + 0.5) / kSamples; }

}  // namespace

double length_of(std::span<const Vector> points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

Polyline::Polyline(const std::vector<Vector>& points) {
  segments_.reserve(points.size());
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vector along = points[i + 1] - points[i];
    const double length2 = along.squaredNorm();
    segments_.push_back({points[i], along, length2 > 0 ? 1.0 / length2 : 0.0});
  }
  build(points, 0, segments_.size());
}

double Polyline::squared_distance(const Vector& p, const Segment& s) {
  const double t = std::clamp((p - s.from).dot(s.along) * s.per_length2, 0.0, 1.0);
  return (p - s.from - t * s.along).squaredNorm();
}

double Polyline::distance(const Vector& p, double bound) const {
  double best = bound * bound;
  std::array<std::int32_t, 64> stack;  // the tree is balanced: 64 levels hold any number of segments
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (node.box.squaredExteriorDistance(p) > best) continue;
    if (node.left < 0) {
      for (std::size_t s = node.begin; s < node.end; ++s) best = std::min(best, squared_distance(p, segments_[s]));
      continue;
    }
    const std::int32_t left = node.left, right = node.right;
    const bool left_first = nodes_[left].box.squaredExteriorDistance(p) <= nodes_[right].box.squaredExteriorDistance(p);
    stack[size++] = left_first ? right : left;
    stack[size++] = left_first ? left : right;
  }
  return std::sqrt(best);
}

double Polyline::integral(const Vector& a, const Vector& b, double at_a, double at_b) const {
  std::array<double, kSamples> x, y, z, best;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double t = fraction(i);
    x[i] = (1.0 - t) * a.x() + t * b.x();
    y[i] = (1.0 - t) * a.y() + t * b.y();
    z[i] = (1.0 - t) * a.z() + t * b.z();
    best[i] = kInfinity;
  }
  // Distances change no faster than their points move, so none on the edge is more than this.
  const double length = (b - a).norm(), most = 0.5 * (at_a + at_b + length) * kRoom;
  Eigen::AlignedBox3d reach(a.cwiseMin(b).array() - most, a.cwiseMax(b).array() + most);
  std::array<std::int32_t, 64> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (!reach.intersects(node.box)) continue;
    if (node.left >= 0) {
      stack[size++] = node.left;
      stack[size++] = node.right;
      continue;
    }
    for (std::size_t s = node.begin; s < node.end; ++s) {
      const auto& [from, along, per_length2] = segments_[s];
      for (std::size_t i = 0; i < kSamples; ++i) {  // a loop that compilers make vectors of
        const double px = x[i] - from.x(), py = y[i] - from.y(), pz = z[i] - from.z();
        double t = (px * along.x() + py * along.y() + pz * along.z()) * per_length2;
        t = t < 0.0 ? 0.0 : t;
        t = t > 1.0 ? 1.0 : t;
        const double dx = px - t * along.x(), dy = py - t * along.y(), dz = pz - t * along.z();
        const double squared = dx * dx + dy * dy + dz * dz;
        best[i] = squared < best[i] ? squared : best[i];
      }
    }
  }
  double sum = 0.0;
  for (const double squared : best) sum += std::sqrt(squared);
  return sum * length / kSamples;
}

double Polyline::least_integral(double length, double at_a, double at_b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double t = fraction(i) * length;
    sum += std::max({0.0, at_a - t, at_b - (length - t)});
  }
  return sum * length / kSamples / kRoom;
}

std::int32_t Polyline::build(const std::vector<Vector>& points, std::size_t begin, std::size_t end) {
  const auto number = static_cast<std::int32_t>(nodes_.size());
  Node node{.box = {}, .begin = begin, .end = end};
  for (std::size_t i = begin; i <= end; ++i) node.box.extend(points[i]);
  nodes_.push_back(node);
  if (end - begin > kSegmentsOfALeaf) {
    const std::size_t middle = begin + (end - begin) / 2;
    const std::int32_t left = build(points, begin, middle), right = build(points, middle, end);
    nodes_[number].left = left;
    nodes_[number].right = right;
  }
  return number;
}

}  // namespace seamwire::detail
