// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Find the segments into which cuts along edges separate a surface.
///
/// Two triangles that share an edge are in one segment unless the edge is cut. The surface is also cut open at
/// non-manifold and unorientable edges (SurfaceReport). A triangle that the surface left out is in the segment of one
/// of its neighbors.
///
/// \param surface the surface to cut
/// \param cut_edges vertex pairs in either order. Pairs that are not real edges, such as diagonals of polygons, cut
///   nothing.
/// \returns the segment of each of the caller's triangles. Segments are numbered from the one with the most triangles
///   to the one with the fewest. If two have the same size, the segment with the first triangle comes first.
/// \throws InvalidInput if a vertex is out of range
SEAMWIRE_API std::vector<std::int32_t> face_segments(const Surface& surface, std::span<const Edge> cut_edges,
                                                     const Task& = {});

}  // namespace seamwire
