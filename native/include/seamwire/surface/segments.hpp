// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/surface/surface.hpp"

namespace seamwire {

/// The segments into which cuts along edges part a surface: a number for each of the caller's triangles, 0 for the
/// segment of the most triangles (of equals, the one with the first triangle), and so on. Triangles that share an edge
/// are in one segment unless it is cut; all of them where it has three or more. `cut_edges`: vertex pairs of either
/// order; those that are no real edges, as the diagonals of polygons, cut nothing. Throws InvalidInput for a vertex out
/// of range.
std::vector<std::int32_t> face_segments(const Surface& surface, std::span<const Edge> cut_edges);

}  // namespace seamwire
