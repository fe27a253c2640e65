// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"
#include "seamwire/wires/wire.hpp"

namespace seamwire {

/// Find a path of real edges that stays close to a wire and hardly zigzags.
///
/// The path leads from wire.from to wire.to along Surface::edges(). Its edges belong to the polygons that the wire
/// crosses, and to polygons that share an edge with these. Polygons are triangles joined across edges that are not
/// real. If these edges do not connect the ends, the polygons around them are added, ring by ring.
///
/// The path minimizes the sum of two terms. The first is its integral of the distance to the wire. The second is 1/2
/// (|u| |v| - u v) for any two consecutive edges u and v. The path repeats no vertex. The time is proportional to the
/// number of faces crossed, except beside vertices with thousands of edges.
///
/// \param surface the surface
/// \param wire a wire from one vertex to another
/// \returns the vertices of the path. Empty if no path of edges connects its ends.
/// \throws InvalidInput if the wire has no points or does not begin and end at vertices
/// \throws InvalidInput if its points do not lie in its faces
SEAMWIRE_API std::vector<std::int32_t> snap_to_edges(const Surface& surface, const Wire& wire, const Task& = {});

}  // namespace seamwire
