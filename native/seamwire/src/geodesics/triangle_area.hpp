// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

namespace seamwire::detail {

/// Four times the area of a triangle by its side lengths, 0 if they make none. W. Kahan, "Miscalculating area and
/// angles of a needle-like triangle".
inline double four_areas(double a, double b, double c) {
  if (a < b) std::swap(a, b);
  if (a < c) std::swap(a, c);
  if (b < c) std::swap(b, c);
  const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return std::sqrt(std::max(product, 0.0));
}

}  // namespace seamwire::detail
