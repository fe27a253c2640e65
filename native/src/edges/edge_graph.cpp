// SPDX-License-Identifier: GPL-3.0-or-later
#include "edges/edge_graph.hpp"

#include <cmath>
#include <utility>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "detail/text.hpp"
#include "edges/stroke_chain.hpp"
#include "metric/metric_check.hpp"
#include "metric/scribble_points.hpp"

namespace seamwire {

using namespace detail;

namespace {

// Edges between two looks at the task: well under a millisecond.
constexpr std::size_t kStepsBetweenChecks = 1024;

}  // namespace

EdgeGraph::EdgeGraph(const Surface& surface, const Metric& metric, std::shared_ptr<const EdgeAdjacency> adjacency,
                     const Task& task) {
  if (metric.size() != surface.vertex_count()) {
    throw InvalidInput("the metric has " + std::to_string(metric.size()) + " tensors, the surface " +
                       std::to_string(surface.vertex_count()) + " vertices");
  }
  check_finite(metric);
  const std::size_t edges = surface.edges().size();
  adjacency_ = adjacency ? std::move(adjacency) : make_edge_adjacency(surface, task);
  if (index(vertex_count()) != surface.vertex_count() || directed_count() != 2 * edges) {
    throw InvalidInput("the adjacency is of another surface: it has " + std::to_string(vertex_count()) +
                       " vertices and " + std::to_string(directed_count() / 2) + " edges");
  }
  resize(lengths_, directed_count(), task, 0.0);
  std::vector<std::int32_t> next(index(vertex_count()));
  for (std::int32_t v = 0; v < vertex_count(); ++v) next[v] = begin(v);
  std::size_t count = 0;
  for (const auto& [a, b] : surface.edges()) {  // in the order in which the rows were filled
    const double length = edge_length(surface, metric, a, b);
    lengths_[next[a]++] = lengths_[next[b]++] = length;
    mean_length_ += length / static_cast<double>(edges);
    if (++count % kStepsBetweenChecks == 0) task.check(static_cast<double>(count) / static_cast<double>(edges));
  }
}

void EdgeGraph::follow(const Surface& surface, const Metric& metric, const Scribble& scribble) {
  if (drawn_.empty()) drawn_.assign(directed_count(), false);
  for (const std::vector<std::int32_t>& chain : stroke_chains(surface, *adjacency_, scribble)) {
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const std::int32_t a = chain[i], b = chain[i + 1], e = find(a, b);
      const double straight = surface.scale() * (surface.points()[b] - surface.points()[a]).norm();
      const double length = scribble.attracts ? straight / std::sqrt(scribble.eta) : edge_length(surface, metric, a, b);
      lengths_[e] = lengths_[twin(e)] = length;
      drawn_[e] = drawn_[twin(e)] = scribble.attracts;
    }
  }
}

std::shared_ptr<const EdgeGraph> make_edge_graph(const Surface& surface, const Metric& metric,
                                                 std::shared_ptr<const EdgeAdjacency> adjacency,
                                                 std::span<const Scribble> scribbles, std::optional<MetricKind> kind,
                                                 const Task& task) {
  for (std::size_t i = 0; i < scribbles.size(); ++i) check_scribble(surface, scribbles[i], i);
  auto graph = std::make_shared<EdgeGraph>(surface, metric, std::move(adjacency), task);
  for (const Scribble& scribble : scribbles) {
    task.check(1.0);
    if (!kind || scribble.acts_on(*kind)) graph->follow(surface, metric, scribble);
  }
  return graph;
}

void check_edge(const EdgeGraph& graph, std::int32_t a, std::int32_t b, const std::string& what) {
  for (const std::int32_t v : {a, b}) check_index(v, index(graph.vertex_count()), what + ": vertex");
  if (graph.find(a, b) >= 0) return;
  throw InvalidInput(what + ": there is no edge between the vertices " + std::to_string(a) + " and " +
                     std::to_string(b));
}

void check_turning(double turning) {
  if (!(turning >= 0.0) || turning == kInfinity) {
    throw InvalidInput("turning must be a number that is not negative, not " + text(turning));
  }
}

}  // namespace seamwire
