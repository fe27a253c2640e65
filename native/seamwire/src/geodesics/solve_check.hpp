// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "detail/text.hpp"
#include "seamwire/errors.hpp"
#include "seamwire/geodesics/distance_method.hpp"
#include "seamwire/surface/surface_point.hpp"

namespace seamwire::detail {

/// Throws InvalidInput if there is no source, or the largest distance is negative or not a number.
inline void check_solve(std::span<const SurfacePoint> sources, const SolveOptions& options) {
  if (sources.empty()) throw InvalidInput("no source to have distances from");
  if (!(options.max_distance >= 0)) {
    throw InvalidInput("max_distance is " + text(options.max_distance) + ", not 0 or more");
  }
}

}  // namespace seamwire::detail
