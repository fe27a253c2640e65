// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "seamwire/surface/vector.hpp"

namespace seamwire::detail {

/// Returns how far two triangles with a common edge are from a flat rectangle, in degrees: the fold between them, plus
/// the mean deviation of their four common corners from 90 degrees. At an end of the common edge, a corner is the sum
/// of two angles.
///
/// Returns kInfinity if they do not count as a quad: the fold is above 40, the result is above 55, a triangle has no
/// area, or a coordinate is not finite.
///
/// `corners`: around both triangles, from an end of the common edge; the third is its other end.
double quad_skew(const std::array<Vector, 4>& corners);

}  // namespace seamwire::detail
