// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "maps/cut_open.hpp"
#include "maps/island_map.hpp"
#include "seamwire/surface/vector.hpp"

namespace seamwire::detail {

/// Lays an island out straight if it is a rectangle of quads. Its rows and columns run along the axes, and their sizes
/// minimize the symmetric Dirichlet energy. Returns nullopt for any other island.
///
/// Two triangles are a quad if their common half-edge is not real. Two other triangles may be a quad if they look like
/// one by quad_skew(). `is_real`: 1 for each half-edge of the island that is a real
/// edge. `points`: of the mesh vertices; the map has the same unit, and its center is the origin.
std::optional<std::vector<Point2>> straight_map(const Island& island, std::span<const std::uint8_t> is_real,
                                                std::span<const Vector> points);

}  // namespace seamwire::detail
