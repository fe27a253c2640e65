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

/// A chain of real edges. It repeats no vertex, except that a chain from a forward seed may end where it began.
struct EdgeChain {
  std::vector<std::int32_t> vertices;  ///< in order, including picked edges; empty if there is no chain
  /// The cost of the chain: its length in the metric, in the caller's unit, plus turning.
  double length = std::numeric_limits<double>::infinity();
};

/// An EdgeAdjacency with the lengths of the edges in a metric.
///
/// With a factor q for turning, the cost of a chain is
///
///     sum of metric lengths + q * (mean metric edge length) * sum over its inner vertices of (1 - cos kappa)
///
/// Immutable. Any number of threads may search it at once.
class EdgeGraph;

/// Make the edge graph of a surface in a metric.
///
/// Tensors alone do not lead a chain along a stroke that is oblique to the edges. Each edge is then partly across the
/// stroke, which is long in the metric. So the edges that stay nearest to an attracting stroke get the stroke's length,
/// their Euclidean length / sqrt(eta). Turning from one of them to the next costs nothing. A later stroke that repels
/// undoes this on the edges that it runs along.
///
/// \param surface the surface
/// \param metric a metric of its vertices
/// \param adjacency the adjacency of the surface, if it exists already
/// \param scribbles the strokes that were applied to `metric`
/// \param kind as in apply_scribbles()
/// \returns the graph, never null
/// \throws InvalidInput if the metric or the adjacency is of another surface, or apply_scribbles() rejects the metric
///   or a stroke
SEAMWIRE_API std::shared_ptr<const EdgeGraph> make_edge_graph(const Surface& surface, const Metric& metric,
                                                              std::shared_ptr<const EdgeAdjacency> adjacency = nullptr,
                                                              std::span<const Scribble> scribbles = {},
                                                              std::optional<MetricKind> kind = std::nullopt,
                                                              const Task& = {});

}  // namespace seamwire
