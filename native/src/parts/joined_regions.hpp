// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/task.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {

/// A region. Lengths are in diagonals of the piece of surface in which it lies, areas in squared diagonals.
struct Region {
  double area = 0.0;
  double least_area = 0.0;  ///< a smaller region joins a neighbor, unless a sharp rim encloses it
  std::int32_t image = -1;  ///< the region on the other side of a mirror plane; -1 if it has none
};

/// A border between two regions, in the same units.
struct RegionBorder {
  std::int32_t one = -1, other = -1;
  double gain = 0.0;  ///< its log odds times its length: what keeping it gains, and joining loses
  double length = 0.0;
  double bend = 0.0;     ///< how many degrees the surface bends there, times the length
  bool is_kept = false;  ///< whether small regions must not join across it
};

/// Which regions to join.
struct RegionRules {
  double region_price = 0.0;             ///< what each region costs
  double sharp_rim = tuning::kSharpRim;  ///< the mean log odds of a rim that encloses a small region
  double least_width = 0.0;              ///< narrower regions join a neighbor if they are steps of a chamfer
  /// How many degrees the surface bends at the sides of such a step.
  double least_step = tuning::kLeastStep, most_step = tuning::kMostStep;
};

/// Joins regions, always the two that gain the most, as long as that gains anything, then small and narrow ones.
/// Returns for each region the joined region in which it is, named after one of them. Throws Cancelled.
std::vector<std::int32_t> joined_regions(std::span<const Region> regions, std::span<const RegionBorder> borders,
                                         const RegionRules& rules, const Task& task = {});

}  // namespace seamwire::detail
