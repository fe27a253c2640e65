// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/edges/edge_adjacency.hpp"
#include "seamwire/surface/types.hpp"

namespace seamwire {

/// A run of edges straight through a mesh.
struct EdgeLoop {
  std::vector<std::int32_t> vertices;  ///< in order; where it is closed, the first one is not given twice
  bool closed = false;                 ///< its ends are one vertex
};

/// The edge loop through an edge, as modellers select it. It goes on in both directions over the opposite edge. A
/// vertex has an opposite edge if it has four edges and not only triangles, or six edges and only triangles. A loop
/// from an edge of the boundary runs along the boundary. It ends at other vertices: poles, boundaries, corners of a
/// single face, and vertices whose faces are not a single umbrella. It also ends at a vertex of `stops`, even at an end
/// of the edge itself, and where it meets itself. It is closed if its ends are one vertex. If it crosses itself, its
/// first or last vertex is also an inner one.
///
/// `edge`: two vertices in either order; the loop has this direction. Throws InvalidInput where there is no such edge.
SEAMWIRE_API EdgeLoop edge_loop(const EdgeAdjacency& adjacency, const Edge& edge, std::span<const std::int32_t> stops);

/// The straight extension of a chain whose last edge runs from edge[0] to edge[1]: at each vertex over the edge that
/// turns least. It ends at a vertex of `stops` other than edge[1], and at a boundary. A chain along a boundary goes on
/// along it. It also ends at a vertex it has visited, such as edge[0], and where every turn is 60 degrees or more.
///
/// Returns the vertices from edge[1] on; only the last one may be a repeated one. Throws InvalidInput where there is no
/// such edge.
SEAMWIRE_API std::vector<std::int32_t> extend_straight(const EdgeAdjacency& adjacency, const Edge& edge,
                                                       std::span<const std::int32_t> stops);

}  // namespace seamwire
