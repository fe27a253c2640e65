// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "seamwire/surface/vector.hpp"

namespace seamwire::detail {

/// Where on the segment from a to b the point nearest to p is: 0 at a, 1 at b; 0 where a and b are one point.
inline double nearest_on_segment(const Vector& p, const Vector& a, const Vector& b) {
  const Vector e = b - a;
  const double squared = e.squaredNorm();
  return squared > 0 ? std::clamp((p - a).dot(e) / squared, 0.0, 1.0) : 0.0;
}

/// The distance of p to the segment from a to b.
inline double distance_to_segment(const Vector& p, const Vector& a, const Vector& b) {
  return (p - a - nearest_on_segment(p, a, b) * (b - a)).norm();
}

/// From p to the nearest point of the segment from a to b.
inline Vector to_segment(const Vector& p, const Vector& a, const Vector& b) {
  return a + nearest_on_segment(p, a, b) * (b - a) - p;
}

}  // namespace seamwire::detail
