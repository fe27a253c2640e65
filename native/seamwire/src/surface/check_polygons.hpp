// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "detail/index.hpp"
#include "seamwire/errors.hpp"

namespace seamwire::detail {

/// Checks that the vertex numbers of `corners` are below `count`, and that `sizes` of at least 3 add up to the number
/// of corners. Throws InvalidInput, which names the first that is wrong.
inline void check_polygons(std::size_t count, std::span<const std::int32_t> corners,
                           std::span<const std::int32_t> sizes) {
  for (const std::int32_t v : corners) {
    check_index(v, count, "corners: vertex", "points");
  }
  std::size_t total = 0;
  for (std::size_t p = 0; p < sizes.size(); ++p) {
    if (sizes[p] < 3) {
      throw InvalidInput("sizes: polygon " + std::to_string(p) + " has " + std::to_string(sizes[p]) +
                         " corners, less than 3");
    }
    total += static_cast<std::size_t>(sizes[p]);
  }
  if (total != corners.size()) {
    throw InvalidInput("sizes: they add up to " + std::to_string(total) + ", but there are " +
                       std::to_string(corners.size()) + " corners");
  }
}

}  // namespace seamwire::detail
