// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace seamwire::detail {

/// A number with 16 significant bits.
///
/// Coordinates of a turned, moved or scaled model are rounded. Measures that are equal, or exactly at a threshold, on
/// one model differ a little on another one. Rounded measures are the same on both, and so is all that follows.
inline double rounded(double value) {
  int exponent = 0;
  const double digits = std::frexp(value, &exponent);
  return std::ldexp(std::round(digits * 65536.0), exponent - 16);
}

/// The same for a number near 1, or near 0, where only the difference counts: a multiple of 2^-14.
inline double rounded_share(double value) { return std::round(value * 16384.0) / 16384.0; }

}  // namespace seamwire::detail
