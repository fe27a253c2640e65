// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "seamwire/api.hpp"
#include "seamwire/edges/edge_graph.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// A picked vertex `a` (b = -1), or the picked edge between `a` and `b`.
struct Pick {
  std::int32_t a = -1;  ///< the vertex, or one end of the edge
  std::int32_t b = -1;  ///< the other end; -1: a vertex

  /// Whether an edge was picked.
  bool is_edge() const { return b >= 0; }
  /// Member by member; the direction of an edge counts.
  friend bool operator==(const Pick&, const Pick&) = default;
};

/// The cheapest chains from one pick to every edge and vertex. While run() is at work on one thread, another may ask
/// for those found so far. Copies share the search.
class SEAMWIRE_API EdgeWires {
 public:
  /// `turning`: q, not negative. `forward`: the seed edge has just been drawn from seed.a to seed.b, so the chain
  /// leaves it over b (a directed seed counts its turn there too). Throws InvalidInput where the seed is not a vertex
  /// or an edge of the surface.
  EdgeWires(std::shared_ptr<const EdgeGraph> graph, const Pick& seed, double turning = 3.0, bool forward = false);

  /// Runs the search, nearest first; to be called once. Throws Cancelled: what was found until then can be asked for.
  void run(const Task& task = {});

  /// Whether trace() gives the cheapest chain already, or knows that no chain exists. Throws InvalidInput where the
  /// target is not a vertex or an edge of the surface.
  bool is_final(const Pick& target) const;

  /// The cheapest chain to a target, both picks included. A picked edge has no direction: the better of both. The chain
  /// to the seed is the seed itself. Behind a forward seed, a target at the seed's first vertex closes the chain there.
  /// Takes time in proportion to the chain. Throws InvalidInput where the target is not a vertex or an edge of the
  /// surface.
  ///
  /// The cheapest walk may cross itself, where it can turn more cheaply in a small circle of short edges than at once.
  /// The chain is then another one, without repeated vertices, though not always the cheapest of those: that is
  /// NP-hard.
  EdgeChain trace(const Pick& target) const;

 private:
  struct Run;
  std::shared_ptr<Run> run_;
};

/// An EdgeWires whose search has been run to its end. Throws what its constructor and run() throw.
SEAMWIRE_API EdgeWires edge_wires(std::shared_ptr<const EdgeGraph> graph, const Pick& seed, double turning = 3.0,
                                  bool forward = false, const Task& task = {});

}  // namespace seamwire
