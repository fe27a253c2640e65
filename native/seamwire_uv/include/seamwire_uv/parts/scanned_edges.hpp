// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "seamwire/surface/types.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire_uv/api.hpp"

namespace seamwire {

/// Return whether the edges of a mesh come from a scan, a sculpt or a remesher. Wires should then run across the
/// surface.
///
/// Artists let edges run along and across the bends of the surface, and make faces small where the shape needs it.
/// Scans have edges in all directions, and remeshed surfaces have edges of one length. Meshes of few triangles, or
/// mostly of quads, count as an artist's. Edges with other than two triangles are ignored.
///
/// \param points finite coordinates
/// \param triangles vertex numbers in [0, points.size())
/// \param polygons the polygon of each triangle. Empty: each triangle is one.
/// \throws InvalidInput if a vertex is out of range, or the sizes do not fit
SEAMWIRE_UV_API bool has_scanned_edges(std::span<const Vector> points, std::span<const Triangle> triangles,
                                       std::span<const std::int32_t> polygons = {});

}  // namespace seamwire
