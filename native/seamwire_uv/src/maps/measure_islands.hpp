// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "seamwire_uv/maps/measure_map.hpp"

namespace seamwire::detail {

/// measure_map(), which also takes islands that are not placed yet. Those may lie on each other, so the
/// report does not list islands that collide.
MapReport measure_islands(const Surface& surface, std::span<const std::array<Eigen::Vector2d, 3>> uvs,
                          std::span<const std::int32_t> islands, bool are_placed, const Task& task);

}  // namespace seamwire::detail
