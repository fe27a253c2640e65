// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/edges/edge_adjacency.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/metric/scribble.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// A chain of real edges. It repeats no vertex, except that one from a forward seed may end where it began.
struct EdgeChain {
  std::vector<std::int32_t> vertices;  ///< in order, picked edges included; empty: no chain
  /// The chain's cost: metric length of the model scaled to the unit cube, plus turning.
  double length = std::numeric_limits<double>::infinity();
};

/// EdgeAdjacency with the lengths of the edges in a metric. The cost of a chain is
///   sum of metric lengths + q * (mean metric edge length) * sum over its inner vertices of (1 - cos kappa).
/// Immutable, so searches may run on several threads.
class EdgeGraph;

/// `adjacency`: that of the surface if it has been made already. Throws InvalidInput where metric or adjacency are of
/// another surface, and what apply_scribbles() throws for scribbles; Cancelled.
///
/// `scribbles`: those that `metric` has been through; `kind` as in apply_scribbles(). Tensors alone lead no chain
/// along a stroke that runs askew to the edges, since each edge is then partly across the stroke, which is long in the
/// metric. So the edges that stay nearest to a stroke that attracts get the length that the stroke itself has, their
/// Euclidean length / sqrt(eta), and turning from one of them to the next costs nothing. A later stroke that repels
/// undoes this on the edges it runs along.
SEAMWIRE_API std::shared_ptr<const EdgeGraph> make_edge_graph(const Surface& surface, const Metric& metric,
                                                              std::shared_ptr<const EdgeAdjacency> adjacency = nullptr,
                                                              std::span<const Scribble> scribbles = {},
                                                              std::optional<MetricKind> kind = std::nullopt,
                                                              const Task& task = {});

}  // namespace seamwire
