// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "seamwire/api.hpp"
#include "seamwire/edges/edge_graph.hpp"
#include "seamwire/surface/types.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// The cheapest closed chain through an edge, without repeated vertices; the first vertex is not given twice. Empty if
/// no such chain exists. As for EdgeWires::trace(), a cheapest walk that crosses itself is replaced by another chain.
///
/// `edge`: two vertices in either order. `turning`: q, not negative. Going around a face beside the edge costs about 4
/// `turning` edges, and no more expensive chain is found. For larger rings on finer meshes, take a larger `turning`.
/// Throws InvalidInput where there is no such edge or `turning` is wrong; Cancelled.
SEAMWIRE_API EdgeChain shortest_cycle(const EdgeGraph& graph, const Edge& edge, double turning = 20.0,
                                      const Task& task = {});

}  // namespace seamwire
