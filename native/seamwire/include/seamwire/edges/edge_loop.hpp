// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/edges/edge_adjacency.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/types.hpp"

namespace seamwire {

/// A run of edges straight through a mesh.
struct EdgeLoop {
  std::vector<std::int32_t> vertices;  ///< in order; a closed loop does not repeat its first vertex
  bool closed = false;                 ///< whether its ends are the same vertex
};

/// Find the edge loop through an edge, as modelers select it.
///
/// The loop continues in both directions over the opposite edge. A vertex has opposite edges if it has four edges and
/// not only triangles, or six edges and only triangles. A loop from a boundary edge follows the boundary.
///
/// - The loop ends at other vertices: poles, boundaries, corners of a single face, and vertices whose faces are not a
///   single umbrella.
/// - It ends at a vertex of `stops`, even at an end of the edge itself.
/// - It ends where it meets itself. If it crosses itself, its first or last vertex is also an inner vertex.
///
/// \param adjacency the adjacency of the surface
/// \param edge two vertices in either order, which give the loop its direction
/// \param stops vertices where the loop ends
/// \returns the loop, closed if its ends are the same vertex
/// \throws InvalidInput if there is no such edge
SEAMWIRE_API EdgeLoop edge_loop(const EdgeAdjacency& adjacency, const Edge& edge, std::span<const std::int32_t> stops);

/// Extend a chain straight beyond its last edge.
///
/// At each vertex the extension takes the edge that turns least. A chain along a boundary follows the boundary.
///
/// - The extension ends at a boundary, and at a vertex of `stops` other than edge[1].
/// - It ends at a vertex that it has visited, such as edge[0].
/// - It ends where every turn is 60 degrees or more.
///
/// \param adjacency the adjacency of the surface
/// \param edge the last edge of the chain, from edge[0] to edge[1]
/// \param stops vertices where the extension ends
/// \returns the vertices from edge[1] on. Only the last vertex may be a repeated one.
/// \throws InvalidInput if there is no such edge
SEAMWIRE_API std::vector<std::int32_t> extend_straight(const EdgeAdjacency& adjacency, const Edge& edge,
                                                       std::span<const std::int32_t> stops);

/// Count the vertices where a closed chain turns off by 60 degrees or more, although straight ways go on there.
///
/// At such a vertex, the straight way does not follow the chain in either direction. Where three edges meet, both
/// directions lead into the same third edge, and no way is straight.
///
/// \param surface the surface
/// \param adjacency the adjacency of the surface
/// \param loop vertices of the surface; the first one is not repeated
/// \returns the number of corners
SEAMWIRE_API std::int32_t count_corners(const Surface& surface, const EdgeAdjacency& adjacency,
                                        std::span<const std::int32_t> loop);

}  // namespace seamwire
