// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// Vertices to which a further slit might lead. The map is distorted most there, close around them or farther around;
/// or the cut is farthest away; or they are the most distorted ones ahead of a slit's end. None is near the cut.
/// `is_on_cut`: 1 at the vertices of the cut.
std::vector<std::int32_t> distortion_peaks(const SlitProblem& problem, const SlitPlan& plan,
                                           std::span<const std::uint8_t> is_on_cut);

/// Vertices spread over all of the surface that is not near the cut, each as far from the others and the cut as
/// possible.
std::vector<std::int32_t> spread_vertices(const SlitProblem& problem, std::span<const std::uint8_t> is_on_cut,
                                          std::size_t count);

}  // namespace seamwire::detail
