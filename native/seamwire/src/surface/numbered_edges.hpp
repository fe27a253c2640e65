// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "seamwire/surface/triangle_connectivity.hpp"

namespace seamwire::detail {

/// The edges of triangles, numbered by their lowest half-edges. Half-edges that are siblings share an edge.
struct NumberedEdges {
  std::vector<std::int32_t> half_edge_of;  ///< the lowest half-edge of each edge, ascending
  std::vector<std::int32_t> edge_of;       ///< the edge of each half-edge

  std::size_t edge_count() const { return half_edge_of.size(); }
};

/// Numbers the edges of a mesh. `poll` is asked at each half-edge. Throws Cancelled.
inline NumberedEdges numbered_edges(const TriangleConnectivity& mesh, const Poll& poll) {
  const std::size_t half_edges = 3 * mesh.face_count();
  NumberedEdges edges;
  edges.edge_of.reserve(half_edges);
  edges.half_edge_of.reserve(half_edges / 2 + 1);
  for (std::int32_t h = 0; index(h) < half_edges; ++h) {
    poll.at(index(h));
    const std::int32_t first = first_of_edge(mesh, h);
    edges.edge_of.push_back(first < h ? edges.edge_of[first] : static_cast<std::int32_t>(edges.edge_count()));
    if (first == h) edges.half_edge_of.push_back(h);
  }
  return edges;
}

}  // namespace seamwire::detail
