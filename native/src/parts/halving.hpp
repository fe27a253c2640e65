// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// Marks the edges of a cut that parts a piece into two connected parts, and of its mirror image in another piece. Each
/// part has a fifth of the area or more if such a cut is found. A piece that is its own mirror image is cut
/// symmetrically. Returns whether there is a cut. Throws Cancelled.
bool mark_half(const SlitProblem& problem, std::int32_t piece, std::vector<std::uint8_t>& is_marked, const Task& task);

}  // namespace seamwire::detail
