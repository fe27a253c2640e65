// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace seamwire::detail {

/// A border between two regions.
struct RegionBorder {
  std::int32_t one = -1, other = -1;
  double gain = 0.0;    ///< how much is gained by keeping it: log odds times length; joining gains the opposite
  double length = 0.0;  ///< as a share of the size of the whole
};

/// Joins regions, always the two that gain the most, as long as that gains anything.
struct RegionRules {
  double part_price = 0.05;  ///< what each region costs
  /// Regions with a smaller share of the area join a neighbor, unless the mean log odds of their borders are above
  /// `sharp_rim`.
  double least_area = 0.003;
  double sharp_rim = 2.0;
  /// Regions that are narrower join a neighbor, as steps of a chamfer.
  double least_width = 0.0;
};

/// `areas`: of each region, shares of the whole. `images`: of each region the one on the other side of a mirror plane,
/// -1 if it has none; empty: no symmetry. Returns the number of the joined region of each region: that of one of them.
///
/// `apart`: pairs of regions that may not end in one region. Pairs that no border separates end so anyhow.
std::vector<std::int32_t> joined_regions(std::span<const double> areas, std::span<const RegionBorder> borders,
                                         std::span<const std::int32_t> images, const RegionRules& rules);

}  // namespace seamwire::detail
