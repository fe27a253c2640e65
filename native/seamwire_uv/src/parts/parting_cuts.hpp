// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/task.hpp"
#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// Marks the edges of a cut that parts a piece into two connected parts, and of its mirror image in another piece. Each
/// part has a fifth of the area or more if such a cut is found. A piece that is its own mirror image is cut
/// symmetrically. Returns whether there is a cut. Throws Cancelled.
bool mark_half(const SlitProblem& problem, std::int32_t piece, std::vector<std::uint8_t>& is_marked, const Task& task);

/// Cuts along the rims of large regions that are flat, or that sharp edges surround, such as the ends of a cylinder. A
/// rim with many corners needs this: a slit to each corner would be too many. `pieces`: the pieces in which to look.
std::vector<Slit> rim_cuts(const SlitProblem& problem, std::span<const std::int32_t> pieces, const Task& task);

/// How many pieces the problem's pieces can be parted into at most, with seams wherever they may run.
std::size_t count_blocks(const SlitProblem& problem);

/// Cuts that part the largest pieces into halves until there are `count` pieces. On a symmetric mesh they are
/// symmetric, so there may be more. There are fewer pieces only if no seam may run inside of any.
std::vector<Slit> halving_cuts(SlitProblem problem, std::size_t count, const Task& task);

}  // namespace seamwire::detail
