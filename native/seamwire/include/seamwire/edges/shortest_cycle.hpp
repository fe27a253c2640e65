// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "seamwire/api.hpp"
#include "seamwire/edges/edge_graph.hpp"
#include "seamwire/surface/types.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Find the cheapest closed chain through an edge, without repeated vertices.
///
/// If the cheapest walk crosses itself, another chain replaces it, as in EdgeWires::trace(). Going around a face beside
/// the edge costs about 4 `turning` edges, so no more expensive chain is found. To find larger rings on finer meshes,
/// use a larger `turning`.
///
/// \param graph the edges and their lengths
/// \param edge two vertices in either order
/// \param turning q, the factor for turning (EdgeGraph): finite, 0 or more
/// \returns the chain, which does not repeat its first vertex, or nullopt if there is no such chain
/// \throws InvalidInput if there is no such edge, or `turning` is out of range
SEAMWIRE_API std::optional<EdgeChain> shortest_cycle(const EdgeGraph& graph, const Edge& edge, double turning = 20.0,
                                                     const Task& = {});

}  // namespace seamwire
