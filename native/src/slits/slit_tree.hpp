// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "seamwire/task.hpp"
#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// The first slits of a plan.
struct SlitTree {
  std::vector<Slit> slits;
  std::vector<std::int32_t> roots;  ///< where slits start in pieces without a boundary
};

/// Slits that make every piece a disc, and, with `has_tips`, lead to the tips of its limbs.
///
/// Tips are local maxima of the mean geodesic distance (Hilaga et al. 2001). Handles are cut along the shortest loops
/// (Erickson and Whittlesey 2005). Slits start at the boundary, or at a hidden vertex in the middle of a closed piece.
/// They lead to further boundary loops and tips, each time to the one that is cheapest to reach. It uses several
/// threads. Throws Cancelled.
SlitTree grow_tree(const SlitProblem& problem, bool has_tips, const Task& task);

}  // namespace seamwire::detail
