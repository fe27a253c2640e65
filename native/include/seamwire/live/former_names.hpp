// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "seamwire/edges/edge_loop.hpp"
#include "seamwire/edges/shortest_cycle.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"

/// Names that the live wire still has; to be deleted when its files take the present ones.
namespace seamwire {

using EdgeFans = EdgeAdjacency;
using EdgeStrip = EdgeLoop;
using QuickPaths = CorridorPaths;

inline std::shared_ptr<const EdgeAdjacency> make_edge_fans(const Surface& surface, const Task& task = {}) {
  return make_edge_adjacency(surface, task);
}
inline EdgeChain edge_loop(const EdgeGraph& graph, const Edge& edge, double turning = 20.0, const Task& task = {}) {
  return shortest_cycle(graph, edge, turning, task);
}
inline EdgeLoop edge_strip(const EdgeAdjacency& adjacency, const Edge& edge, std::span<const std::int32_t> stops) {
  return edge_loop(adjacency, edge, stops);
}
inline std::vector<std::int32_t> run_on(const EdgeAdjacency& adjacency, const Edge& edge,
                                        std::span<const std::int32_t> stops) {
  return extend_straight(adjacency, edge, stops);
}

}  // namespace seamwire
