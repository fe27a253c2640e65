// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

namespace seamwire {

/// The three vertices of a triangle, numbered from 0.
using Triangle = std::array<std::int32_t, 3>;
/// The two vertices of an edge, numbered from 0. The smaller number comes first if the edge has no direction.
using Edge = std::array<std::int32_t, 2>;

}  // namespace seamwire
