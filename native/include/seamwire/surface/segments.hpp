// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire {

/// Finds the segments into which cuts along edges part a surface. Returns the number of the segment of each of the
/// caller's triangles. Segment 0 has the most triangles, and so on. Of segments of equal size, the one with the first
/// triangle comes first.
///
/// Two triangles that share an edge are in one segment unless the edge is cut. Edges with three or more triangles join
/// nothing, and neither do unorientable ones (SurfaceReport): the surface is cut open there. A triangle that the
/// surface left out is in the segment of one of its neighbors.
///
/// `cut_edges`: vertex pairs of either order. Pairs that are not real edges, such as diagonals of polygons, cut
/// nothing. Throws InvalidInput for a vertex out of range.
SEAMWIRE_API std::vector<std::int32_t> face_segments(const Surface& surface, std::span<const Edge> cut_edges);

}  // namespace seamwire
