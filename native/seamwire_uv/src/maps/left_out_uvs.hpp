// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "seamwire/surface/surface.hpp"
#include "seamwire_uv/maps/measure_map.hpp"

namespace seamwire::detail {

/// Sets the UVs of triangles that the surface left out: those that their vertices have in their island. A vertex that
/// is not in the island gets the island's center. `islands`: of each of the caller's triangles.
void fill_left_out(const Surface& surface, std::span<const std::int32_t> islands, CornerUvs& uvs);

}  // namespace seamwire::detail
