// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/quad_skew.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "detail/infinity.hpp"
#include "maps/degrees_between.hpp"

namespace seamwire::detail {

double quad_skew(const std::array<Vector, 4>& corners) {
  constexpr double kMostFold = 40.0, kMostSkew = 55.0;
  const auto& [start, right, end, left] = corners;
  const Vector along = end - start;
  const Vector normal_right = (right - start).cross(along), normal_left = along.cross(left - start);
  if (!(normal_right.squaredNorm() > 0.0) || !(normal_left.squaredNorm() > 0.0)) return kInfinity;
  const double fold = degrees_between(normal_right, normal_left);
  const std::array<double, 4> angles{
      degrees_between(right - start, along) + degrees_between(along, left - start),
      degrees_between(start - right, end - right),
      degrees_between(right - end, -along) + degrees_between(-along, left - end),
      degrees_between(start - left, end - left),
  };
  double off = 0.0;
  for (const double angle : angles) off += std::abs(angle - 90.0);
  const double skew = fold + 0.25 * off;
  return fold <= kMostFold && skew <= kMostSkew ? skew : kInfinity;
}

}  // namespace seamwire::detail
