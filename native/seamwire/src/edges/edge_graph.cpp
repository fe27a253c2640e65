// SPDX-License-Identifier: GPL-3.0-or-later
#include "edges/edge_graph.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "detail/text.hpp"
#include "edges/edge_adjacency.hpp"
#include "metric/metric_check.hpp"
#include "metric/scribble_points.hpp"
#include "seamwire/metric/scribble.hpp"
#include "seamwire/surface/surface.hpp"
#include "surface/exact_unit.hpp"
#include "surface/point_segment.hpp"

namespace seamwire {

using namespace detail;

namespace {

// A chain may leave the line by this many times the length of the edge it leaves over.
constexpr double kCorridor = 2.5;
// A chain is sought for this many edges of the line at a time. It is long enough not to wind between two rows of edges
// beside the line, and short enough for a line that comes back to itself.
constexpr double kEdgesAtATime = 24.0;
// Points of the line nearer to each other than this part of an edge say nothing more about it.
constexpr double kPointsPerEdge = 4.0;

double distance_to_line(const Vector& p, std::span<const Vector> line) {
  double least = kInfinity;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    least = std::min(least, to_segment(p, line[i], line[i + 1]).squaredNorm());
  }
  return std::sqrt(least);
}

/// The real edges that stay nearest to a scribble, as chains of vertices in its order; more than one where no edges
/// lead on. The scribble must be one that apply_scribbles() takes.
class StrokeChains {
 public:
  StrokeChains(const Surface& surface, const EdgeAdjacency& adjacency, const Scribble& scribble)
      : surface_(surface), adjacency_(adjacency), scribble_(scribble) {}

  std::vector<std::vector<std::int32_t>> find() const {
    const std::vector<Vector>& points = scribble_.points;
    std::vector<std::vector<std::int32_t>> chains;
    if (points.size() < 2) return chains;
    double total = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) total += (points[i + 1] - points[i]).norm();
    std::int32_t from = nearest_vertex(surface_, scribble_, 0);
    for (std::size_t i = 0; i + 1 < points.size();) {
      const double edge = mean_edge(from);
      // A line that closes falls into three parts at least: between two ends that are one there is nothing to find.
      const double most = std::min(kEdgesAtATime * edge, total / 3);
      std::vector<Vector> line{points[i]};
      double length = 0;
      while (i + 1 < points.size() && (line.size() == 1 || length < most)) {
        ++i;
        length += (points[i] - points[i - 1]).norm();
        const bool is_last = i + 1 == points.size() || !(length < most);
        if (is_last || (points[i] - line.back()).norm() * kPointsPerEdge > edge) line.push_back(points[i]);
      }
      const std::int32_t to = nearest_vertex(surface_, scribble_, i);
      if (from != to) {
        const std::vector<std::int32_t> chain = join(from, to, line);
        if (!chains.empty() && !chain.empty() && chains.back().back() == from) {
          chains.back().insert(chains.back().end(), chain.begin() + 1, chain.end());
        } else if (!chain.empty()) {
          chains.push_back(chain);
        }
      }
      from = to;
    }
    return chains;
  }

 private:
  const Vector& point(std::int32_t v) const { return surface_.points()[v]; }

  double mean_edge(std::int32_t v) const {
    double sum = 0;
    for (std::int32_t e = adjacency_.begin(v); e < adjacency_.end(v); ++e)
      sum += (point(adjacency_.head(e)) - point(v)).norm();
    return sum / std::max(1, adjacency_.end(v) - adjacency_.begin(v));
  }

  std::vector<std::int32_t> join(std::int32_t from, std::int32_t to, std::span<const Vector> line) const {
    const auto neighbors = [this](std::int32_t v, const auto& visit) {
      for (std::int32_t e = adjacency_.begin(v); e < adjacency_.end(v); ++e) visit(adjacency_.head(e));
    };
    return chain_along(
        from, to, {.slack = 0.0, .edges = kCorridor}, [this](std::int32_t v) { return point(v); }, neighbors,
        [&](std::int32_t v) { return distance_to_line(point(v), line); });
  }

  const Surface& surface_;
  const EdgeAdjacency& adjacency_;
  const Scribble& scribble_;
};

}  // namespace

EdgeGraph::EdgeGraph(const Surface& surface, const Metric& metric, std::shared_ptr<const EdgeAdjacency> adjacency,
                     const Task& task) {
  check_size(surface, metric);
  check_tensors(metric);
  const std::size_t edges = surface.edges().size();
  const double begins = adjacency ? 0.0 : 0.5;
  adjacency_ = adjacency ? std::move(adjacency) : make_edge_adjacency(surface, part_of(task, 0.0, begins));
  adjacency_->check_size(surface);
  resize(lengths_, directed_count(), task, begins);
  std::vector<std::int32_t> next(index(vertex_count()));
  for (std::int32_t v = 0; v < vertex_count(); ++v) next[v] = begin(v);
  Poll poll(task, begins, 1.0, edges);
  for (const auto& [a, b] : surface.edges()) {  // in the order in which the rows were filled
    const double length = edge_length(surface, metric, a, b);
    lengths_[next[a]++] = lengths_[next[b]++] = length;
    mean_length_ += length / static_cast<double>(edges);
    poll.next();
  }
}

void EdgeGraph::follow(const Surface& surface, const Metric& metric, const Scribble& scribble) {
  if (drawn_.empty()) drawn_.assign(directed_count(), false);
  const double unit = exact_unit(surface);
  for (const std::vector<std::int32_t>& chain : StrokeChains(surface, *adjacency_, scribble).find()) {
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const std::int32_t a = chain[i], b = chain[i + 1], e = find(a, b);
      const double straight = (unit * (surface.points()[b] - surface.points()[a])).norm() / unit;
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
    if (!kind || scribble.changes(*kind)) graph->follow(surface, metric, scribble);
  }
  return graph;
}

void check_turning(double turning) {
  if (!(turning >= 0.0) || turning == kInfinity) {
    throw InvalidInput("turning must be a number that is not negative, not " + text(turning));
  }
}

}  // namespace seamwire
