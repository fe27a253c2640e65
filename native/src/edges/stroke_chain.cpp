// SPDX-License-Identifier: GPL-3.0-or-later
#include "edges/stroke_chain.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <queue>
#include <span>
#include <unordered_map>

#include "detail/infinity.hpp"
#include "metric/scribble_points.hpp"
#include "surface/point_segment.hpp"

namespace seamwire::detail {
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

  std::vector<std::vector<std::int32_t>> find() const;

 private:
  const Vector& point(std::int32_t v) const { return surface_.points()[v]; }
  double mean_edge(std::int32_t v) const;
  std::vector<std::int32_t> join(std::int32_t from, std::int32_t to, std::span<const Vector> line) const;

  const Surface& surface_;
  const EdgeAdjacency& adjacency_;
  const Scribble& scribble_;
};

double StrokeChains::mean_edge(std::int32_t v) const {
  double sum = 0;
  for (std::int32_t e = adjacency_.begin(v); e < adjacency_.end(v); ++e)
    sum += (point(adjacency_.head(e)) - point(v)).norm();
  return sum / std::max(1, adjacency_.end(v) - adjacency_.begin(v));
}

// The chain from one vertex to another that stays nearest to a line, by A*; empty where none leads there.
std::vector<std::int32_t> StrokeChains::join(std::int32_t from, std::int32_t to, std::span<const Vector> line) const {
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

std::vector<std::vector<std::int32_t>> StrokeChains::find() const {
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

}  // namespace

std::vector<std::vector<std::int32_t>> stroke_chains(const Surface& surface, const EdgeAdjacency& adjacency,
                                                     const Scribble& scribble) {
  return StrokeChains(surface, adjacency, scribble).find();
}

}  // namespace seamwire::detail
