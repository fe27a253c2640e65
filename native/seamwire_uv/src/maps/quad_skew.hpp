// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "detail/infinity.hpp"
#include "seamwire/surface/vector.hpp"

namespace seamwire::detail {

/// Returns how far two triangles with a common edge are from a flat rectangle, in degrees: the fold between them, plus
/// how far the corners of both together are from a right angle in the mean. It is kInfinity if they do not count as a
/// quad.
///
/// `corners`: around both triangles, from an end of the common edge; the third is its other end.
inline double quad_skew(const std::array<Vector, 4>& corners) {
  constexpr double kGrid = 1024.0;  // steps in a degree: quads of equal shape have equal skews, however turned
  constexpr double kMostFold = 40.0, kMostSkew = 55.0;
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const auto angle = [](const Vector& one, const Vector& other) {
    return kDegrees * std::atan2(one.cross(other).norm(), one.dot(other));
  };
  const auto& [start, right, end, left] = corners;
  const Vector across = end - start;
  const double fold = angle((right - start).cross(across), across.cross(left - start));
  if (!(fold <= kMostFold)) return kInfinity;
  const double at_start = angle(right - start, across) + angle(across, left - start);
  const double at_end = angle(right - end, -across) + angle(-across, left - end);
  double off = 0.0;
  for (const double corner : {at_start, at_end, angle(start - right, end - right), angle(start - left, end - left)}) {
    off += std::abs(corner - 90.0);
  }
  const double skew = std::round(kGrid * (fold + 0.25 * off)) / kGrid;
  return skew <= kMostSkew ? skew : kInfinity;
}

}  // namespace seamwire::detail
