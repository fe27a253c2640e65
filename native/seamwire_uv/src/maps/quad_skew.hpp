// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>

namespace seamwire::detail {

/// Degrees of the fold between two triangles that count as a quad, at most.
inline constexpr double kMostFold = 40.0;
/// Degrees of quad_skew() of two triangles that count as a quad, at most.
inline constexpr double kMostSkew = 55.0;

/// How far two triangles with a common edge are from a flat rectangle: the fold between them, plus how far the corners
/// are from a right angle on average. The result and the parameters have the same unit.
inline double quad_skew(double fold, const std::array<double, 4>& corners, double right_angle) {
  double off = 0.0;
  for (const double corner : corners) off += std::abs(corner - right_angle);
  return fold + 0.25 * off;
}

}  // namespace seamwire::detail
