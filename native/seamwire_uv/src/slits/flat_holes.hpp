// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "maps/cut_open.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Which boundary loops of an island are holes in a surface that is nearly flat around them: 1 for each such loop. A
/// map with little stretch can keep these holes. The end of a tube is no such hole. Nor are the longest loop and the
/// two sides of a closed seam.
///
/// By the theorem of Gauss and Bonnet, the turns along a loop tell the curvature of what would fill its hole. It is
/// 0 in a plane, and 2 pi at the end of a cylinder. With the curvature near the loop it is known for a wider hole,
/// which decides. So neither a short collar around a hole matters, nor a narrow flange at the end of a tube. Only the
/// curvature on an open seam itself decides, because nothing fills a seam.
///
/// `points`: of mesh vertices. `boundaries`: Island::boundaries(). Throws Cancelled.
std::vector<std::uint8_t> flat_holes(const Island& island, std::span<const Vector> points,
                                     const std::vector<std::vector<std::int32_t>>& boundaries, const Task& task);

}  // namespace seamwire::detail
