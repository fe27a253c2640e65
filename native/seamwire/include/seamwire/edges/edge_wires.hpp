// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "seamwire/api.hpp"
#include "seamwire/edges/edge_graph.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// One end of a chain of edges: the vertex `a`, or the edge between `a` and `b`.
struct Pick {
  std::int32_t a = -1;  ///< the vertex, or one end of the edge
  std::int32_t b = -1;  ///< the other end of the edge; -1 if a vertex was picked

  /// Return whether an edge was picked.
  bool is_edge() const { return b >= 0; }
  /// Compare member by member. The direction of an edge counts.
  friend bool operator==(const Pick&, const Pick&) = default;
};

/// Finds the cheapest chains from one pick to every edge and vertex.
///
/// While one thread executes run(), another may ask for the chains found so far. Copies share the search.
class SEAMWIRE_API EdgeWires {
 public:
  /// Prepare a search.
  ///
  /// \param graph the edges and their lengths
  /// \param seed a vertex or an edge of the surface
  /// \param turning q, the factor for turning (EdgeGraph): finite, 0 or more
  /// \param forward whether the seed edge has just been drawn from seed.a to seed.b. Then the chain leaves it over b,
  ///   and the turn there counts too.
  /// \throws InvalidInput if the graph is null, the seed is not part of the surface, or `turning` is out of range
  EdgeWires(std::shared_ptr<const EdgeGraph> graph, const Pick& seed, double turning = 3.0, bool forward = false);

  /// Run the search, nearest targets first. Call it only once.
  ///
  /// After a cancellation, chains found until then are still available.
  void run(const Task& = {});

  /// Return whether trace() gives the cheapest chain already, or knows that there is no chain.
  ///
  /// \param target a vertex or an edge of the surface
  /// \throws InvalidInput if the target is not part of the surface
  bool is_final(const Pick& target) const;

  /// Trace the cheapest chain to a target, including both picks.
  ///
  /// A picked edge has no direction, so the cheaper of both directions is taken. The chain to the seed is the seed
  /// itself. After a forward seed, a target at the seed's first vertex closes the chain there. The time is proportional
  /// to the length of the chain.
  ///
  /// The cheapest walk may cross itself, if a small circle of short edges is cheaper than a sharp turn. Then the result
  /// is another chain without repeated vertices. It need not be the cheapest such chain, because finding that is
  /// NP-hard.
  ///
  /// \param target a vertex or an edge of the surface
  /// \returns the chain, or nullopt if none is known
  /// \throws InvalidInput if the target is not part of the surface
  std::optional<EdgeChain> trace(const Pick& target) const;

 private:
  struct Run;
  std::shared_ptr<Run> run_;
};

/// Make an EdgeWires and run its search.
///
/// \param graph the edges and their lengths
/// \param seed a vertex or an edge of the surface
/// \param turning q, the factor for turning (EdgeGraph): finite, 0 or more
/// \param forward whether the seed edge has just been drawn from seed.a to seed.b
/// \returns the finished search
/// \throws InvalidInput if the constructor of EdgeWires rejects its arguments
SEAMWIRE_API EdgeWires edge_wires(std::shared_ptr<const EdgeGraph> graph, const Pick& seed, double turning = 3.0,
                                  bool forward = false, const Task& = {});

}  // namespace seamwire
