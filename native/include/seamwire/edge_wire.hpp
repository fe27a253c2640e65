// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "seamwire/metric.hpp"
#include "seamwire/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// What was picked: a vertex `a` (b = -1), or the edge between `a` and `b`.
struct Pick {
  std::int32_t a = -1;
  std::int32_t b = -1;

  bool is_edge() const { return b >= 0; }
  friend bool operator==(const Pick&, const Pick&) = default;
};

/// A chain of real edges.
struct EdgeChain {
  std::vector<std::int32_t> vertices;                       ///< in order, picked edges included; empty: there is none
  double length = std::numeric_limits<double>::infinity();  ///< metric lengths plus turning cost
};

/// The real edges of a surface with their lengths in a metric and what turning costs at each vertex: cost of a chain =
/// sum of metric lengths + q * (mean metric edge length) * sum over its inner vertices of (1 - cos kappa), where kappa
/// is the discrete geodesic curvature, pi |left - right| / (left + right) of the face angles on either side (Polthier
/// and Schmies, "Straightest Geodesics", 1998). Immutable, so searches may run on several threads.
class EdgeGraph;

std::shared_ptr<const EdgeGraph> make_edge_graph(const Surface& surface, const Metric& metric);

/// The cheapest chains from one pick to every edge and vertex.
class EdgeWires {
 public:
  /// The cheapest chain to a target, both picks included. A picked edge has no direction: the better of both. Throws
  /// InvalidInput where the target is not a vertex or an edge of the surface.
  EdgeChain trace(const Pick& target) const;

  struct Search;  // edge_wire.cpp
  explicit EdgeWires(std::shared_ptr<const Search> search);

 private:
  std::shared_ptr<const Search> search_;
};

/// `turning`: q, not negative. `forward`: the seed edge has just been drawn from seed.a to seed.b, so the chain leaves
/// it over b (a directed seed counts its turn there too). Throws InvalidInput where the seed is not a vertex or an edge
/// of the surface; Cancelled.
EdgeWires edge_wires(std::shared_ptr<const EdgeGraph> graph, const Pick& seed, double turning = 3.0,
                     bool forward = false, const Task& task = {});

/// The cheapest closed chain through an edge, the first vertex not repeated; empty where there is none.
EdgeChain edge_loop(const EdgeGraph& graph, const Edge& edge, double turning = 20.0, const Task& task = {});

}  // namespace seamwire
