// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/quad_skew.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "detail/infinity.hpp"

namespace seamwire::detail {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A square of two triangles, folded over the diagonal by an angle in degrees.
std::array<Vector, 4> folded_square(double fold) {
  const Eigen::AngleAxisd turn(fold * kDegree, Vector(1, 1, 0).normalized());
  return {Vector(0, 0, 0), Vector(1, 0, 0), Vector(1, 1, 0), turn * Vector(0, 1, 0)};
}

/// A parallelogram with corners of an angle in degrees, and of the rest to 180.
std::array<Vector, 4> parallelogram(double angle) {
  const Vector side(std::cos(angle * kDegree), std::sin(angle * kDegree), 0);
  return {Vector(0, 0, 0), Vector(1, 0, 0), Vector(1, 0, 0) + side, side};
}

TEST(QuadSkew, IsTheFoldAndTheMeanDeviationOfTheCorners) {
  EXPECT_EQ(quad_skew(folded_square(0.0)), 0.0);
  EXPECT_NEAR(quad_skew(folded_square(25.0)), 25.0, 2e-3);
  EXPECT_NEAR(quad_skew(parallelogram(60.0)), 30.0, 2e-3);
  // A dart: corners of 16, 40, 16 and 288 degrees. With 72 instead of 288 it would count as a quad.
  const double slope = std::tan(20.0 * kDegree);
  const std::array<Vector, 4> dart{Vector(0, 0, 0), Vector(1, -slope, 0), Vector(0.5, 0, 0), Vector(1, slope, 0)};
  EXPECT_EQ(quad_skew(dart), kInfinity);
}

TEST(QuadSkew, HasLimitsThatDoNotDependOnThePose) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto posed = [&](std::array<Vector, 4> corners) {
    const Eigen::Quaterniond turn(normal(random), normal(random), normal(random), normal(random));
    const Vector to(normal(random), normal(random), normal(random));
    for (Vector& corner : corners) corner = turn.normalized() * corner + to;
    return corners;
  };
  for (int i = 0; i < 200; ++i) {
    EXPECT_NEAR(quad_skew(posed(folded_square(40.0))), 40.0, 2e-3);
    EXPECT_EQ(quad_skew(posed(folded_square(40.01))), kInfinity);
    EXPECT_NEAR(quad_skew(posed(parallelogram(35.0))), 55.0, 2e-3);
    EXPECT_EQ(quad_skew(posed(parallelogram(34.99))), kInfinity);
  }
}

TEST(QuadSkew, IsTheSameFromEachEndAndSide) {
  const auto [start, right, end, left] = folded_square(10.0);
  const double skew = quad_skew({start, right, end, left});
  EXPECT_EQ(quad_skew({end, left, start, right}), skew);
  EXPECT_EQ(quad_skew({start, left, end, right}), skew);
}

TEST(QuadSkew, IsInfiniteWithoutTwoTriangles) {
  EXPECT_EQ(quad_skew({Vector(0, 0, 0), Vector(1, 0, 0), Vector(2, 0, 0), Vector(1, 1, 0)}), kInfinity) << "collinear";
  EXPECT_EQ(quad_skew({Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 0, 0), Vector(0, 1, 0)}), kInfinity) << "no edge";
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(quad_skew({Vector(0, 0, 0), Vector(1, 0, bad), Vector(1, 1, 0), Vector(0, 1, 0)}), kInfinity);
  }
}

}  // namespace
}  // namespace seamwire::detail
