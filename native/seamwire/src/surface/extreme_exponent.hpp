// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdlib>
#include <span>

#include "seamwire/surface/vector.hpp"

namespace seamwire::detail {

/// Coordinates beyond 2 to this, and below its inverse, are brought near 1: products of several lengths would overflow
/// or vanish.
inline constexpr int kMostExponent = 100;

/// The exponent of the largest coordinate of some points that is finite, where it is beyond kMostExponent; otherwise 0.
inline int extreme_exponent(std::span<const Vector> points) {
  double largest = 0.0;
  for (const Vector& p : points) {
    for (const double x : p) {
      if (std::abs(x) > largest && std::isfinite(x)) largest = std::abs(x);
    }
  }
  const int exponent = largest > 0.0 ? std::ilogb(largest) : 0;
  return std::abs(exponent) > kMostExponent ? exponent : 0;
}

inline Vector scaled(const Vector& v, int exponent) {
  return {std::ldexp(v.x(), exponent), std::ldexp(v.y(), exponent), std::ldexp(v.z(), exponent)};
}

}  // namespace seamwire::detail
