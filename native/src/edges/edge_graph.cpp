// SPDX-License-Identifier: GPL-3.0-or-later
#include "edges/edge_graph.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <span>
#include <unordered_map>
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
#include "surface/point_segment.hpp"

namespace seamwire {

using namespace detail;

namespace {

// How much more it costs a chain to be off the line than to be long.
constexpr double kOffLine = 4.0;
// A chain may leave the line by this many times the length of the edge it leaves over.
constexpr double kCorridor = 2.5;
// A chain is sought for this many edges of the line at a time. It is long enough not to wind between two rows of edges
// beside the line, and short enough for a line that comes back to itself.
constexpr double kEdgesAtATime = 24.0;
// Points of the line nearer to each other than this part of an edge say nothing more about it.
constexpr double kPointsPerEdge = 4.0;
// Vertices looked at for one chain, so that a line from one component to another is not searched for long.
constexpr std::size_t kMostLookedAt = 50'000;

double distance_to_line(const Vector& p, std::span<const Vector> line) {
  double least = kInfinity;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    least = std::min(least, to_segment(p, line[i], line[i + 1]).squaredNorm());
  }
  return std::sqrt(least);
}

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

  // The chain from one vertex to another that stays nearest to a line, by A*; empty where none leads there.
  std::vector<std::int32_t> join(std::int32_t from, std::int32_t to, std::span<const Vector> line) const {
    struct Node {
      std::int32_t before;
      double cost, off;
      bool is_done = false;
    };
    struct Open {
      double bound;
      std::int32_t vertex;
      bool operator>(const Open& o) const { return bound != o.bound ? bound > o.bound : vertex > o.vertex; }
    };
    std::unordered_map<std::int32_t, Node> nodes{{from, {-1, 0.0, 0.0}}};
    std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
    open.push({0.0, from});
    while (!open.empty() && nodes.size() < kMostLookedAt) {
      const std::int32_t v = open.top().vertex;
      open.pop();
      Node& here = nodes.at(v);
      if (here.is_done) continue;
      here.is_done = true;
      if (v == to) {
        std::vector<std::int32_t> chain;
        for (std::int32_t u = v; u >= 0; u = nodes.at(u).before) chain.push_back(u);
        std::ranges::reverse(chain);
        return chain;
      }
      const double cost = here.cost;
      for (std::int32_t e = adjacency_.begin(v); e < adjacency_.end(v); ++e) {
        const std::int32_t w = adjacency_.head(e);
        const double length = (point(w) - point(v)).norm();
        const auto [known, is_new] = nodes.try_emplace(w, Node{v, kInfinity, 0.0});
        Node& node = known->second;
        if (is_new) node.off = distance_to_line(point(w), line);
        const double there = cost + length + kOffLine * node.off;
        if (node.is_done || node.off > kCorridor * length || !(there < node.cost)) continue;
        node.before = v;
        node.cost = there;
        open.push({there + (point(to) - point(w)).norm(), w});
      }
    }
    return {};
  }

  const Surface& surface_;
  const EdgeAdjacency& adjacency_;
  const Scribble& scribble_;
};

/// The real edges that stay nearest to a scribble, as chains of vertices in its order; more than one where no edges
/// lead on. The scribble must be one that apply_scribbles() takes.
std::vector<std::vector<std::int32_t>> stroke_chains(const Surface& surface, const EdgeAdjacency& adjacency,
                                                     const Scribble& scribble) {
  return StrokeChains(surface, adjacency, scribble).find();
}

// Edges between two looks at the task: well under a millisecond.
constexpr std::size_t kStepsBetweenChecks = 1024;

}  // namespace

EdgeGraph::EdgeGraph(const Surface& surface, const Metric& metric, std::shared_ptr<const EdgeAdjacency> adjacency,
                     const Task& task) {
  check_size(surface, metric);
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
