// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "seamwire/surface/vector.hpp"

namespace seamwire::detail {

/// The angle between two directions in degrees, rounded to a thousandth, so that the angles of a turned model lie on
/// the same side of every threshold. 0 if a vector is zero.
inline double degrees_between(const Vector& one, const Vector& other) {
  constexpr double kGrid = 1024.0;  // steps in a degree
  const double degrees = 180.0 / std::numbers::pi * std::atan2(one.cross(other).norm(), one.dot(other));
  return std::round(kGrid * degrees) / kGrid;
}

}  // namespace seamwire::detail
