// SPDX-License-Identifier: GPL-3.0-or-later
#include "wires/polyline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "detail/infinity.hpp"

namespace seamwire::detail {
namespace {

/// Five turns around the third axis.
std::vector<Vector> helix(int segments) {
  std::vector<Vector> points;
  for (int i = 0; i <= segments; ++i) {
    const double angle = 10.0 * std::numbers::pi * i / segments;
    points.emplace_back(std::cos(angle), std::sin(angle), 0.05 * angle);
  }
  return points;
}

double distance_to(const std::vector<Vector>& points, const Vector& p) {
  double least = kInfinity;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vector along = points[i] - points[i - 1];
    const double t = std::clamp((p - points[i - 1]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - points[i - 1] - t * along).norm());
  }
  return least;
}

// An edge that is near to few segments, and one that is near to hundreds, look for them in different ways.
TEST(Polyline, TellsDistancesAndIntegralsWhateverTheNumberOfSegments) {
  const std::vector<Vector> from = {{0, 0, 0.5}, {1.1, 0, 0.2}, {0, 0, -0.3}, {3, 3, 3}};
  const std::vector<Vector> to = {{1.2, 0.1, 0.6}, {1.1, 0.05, 0.21}, {0, 0, 2}, {0, 0.1, 1}};
  for (const int segments : {1, 30, 1000}) {
    const std::vector<Vector> points = helix(segments);
    const Polyline line(points);
    for (std::size_t k = 0; k < from.size(); ++k) {
      const double at_from = line.distance(from[k], kInfinity), at_to = line.distance(to[k], kInfinity);
      EXPECT_NEAR(at_from, distance_to(points, from[k]), 1e-12);
      const double length = (to[k] - from[k]).norm();
      double sum = 0.0;
      for (int i = 0; i < 8; ++i) sum += distance_to(points, from[k] + (i + 0.5) / 8 * (to[k] - from[k]));
      const double integral = line.integral(from[k], to[k], at_from, at_to);
      EXPECT_NEAR(integral, sum * length / 8, 1e-12) << segments << " segments, edge " << k;
      EXPECT_LE(Polyline::least_integral(length, at_from, at_to), integral);
    }
  }
}

}  // namespace
}  // namespace seamwire::detail
