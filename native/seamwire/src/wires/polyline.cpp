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
/// If an edge has so many segments nearby, each sample searches for its nearest one.
constexpr std::size_t kManySegments = 64;

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
  tree_.build_in_order(segments_.size(), [&](std::int32_t s) { return Box(points[s]).extend(points[s + 1]); });
}

double Polyline::squared_distance(double x, double y, double z, const Segment& s) {
  const double px = x - s.from.x(), py = y - s.from.y(), pz = z - s.from.z();
  double t = (px * s.along.x() + py * s.along.y() + pz * s.along.z()) * s.per_length2;
  t = t < 0.0 ? 0.0 : t;
  t = t > 1.0 ? 1.0 : t;
  const double dx = px - t * s.along.x(), dy = py - t * s.along.y(), dz = pz - t * s.along.z();
  return dx * dx + dy * dy + dz * dz;
}

double Polyline::distance(const Vector& p, double bound) const {
  double best = bound * bound;
  tree_.visit_near(p, best, 1.0, [&](std::int32_t s, double& least) {
    least = best = std::min(least, squared_distance(p.x(), p.y(), p.z(), segments_[s]));
  });
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
  const Box reach(a.cwiseMin(b).array() - most, a.cwiseMax(b).array() + most);
  std::size_t seen = 0;
  const bool are_few = tree_.visit_in(reach, [&](std::int32_t s) {
    const Segment segment = segments_[s];
    for (std::size_t i = 0; i < kSamples; ++i) {  // a loop that compilers make vectors of
      const double squared = squared_distance(x[i], y[i], z[i], segment);
      best[i] = squared < best[i] ? squared : best[i];
    }
    return ++seen < kManySegments;
  });
  for (std::size_t i = 0; i < kSamples && !are_few; ++i) {
    tree_.visit_near({x[i], y[i], z[i]}, best[i], BoxTree::kRounded, [&](std::int32_t s, double& least) {
      least = best[i] = std::min(least, squared_distance(x[i], y[i], z[i], segments_[s]));
    });
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

}  // namespace seamwire::detail
