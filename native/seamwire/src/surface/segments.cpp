// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/segments.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "graph/disjoint_sets.hpp"
#include "surface/corner_fans.hpp"
#include "surface/cuts.hpp"
#include "surface/real_edges.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// Adds each triangle that the surface left out to the segment of one neighbor, so that it joins no segments. The
/// neighbor beyond a diagonal of its polygon comes first. Neighbors that were left out themselves follow.
void join_left_out(const Surface& surface, const Cuts& cuts, DisjointSets& sets, Poll& poll) {
  const SurfaceReport& report = surface.report();
  std::vector<std::int32_t> left_out = report.degenerate_faces;
  left_out.insert(left_out.end(), report.duplicate_faces.begin(), report.duplicate_faces.end());
  if (left_out.empty()) return;
  std::ranges::sort(left_out);
  /// The triangles at an edge of one that was left out.
  struct AtEdge {
    std::int32_t first = -1;            // to be in a segment
    std::vector<std::int32_t> waiting;  // left out, until `first` is known
  };
  std::map<Edge, AtEdge> at_edge;
  const auto edges_of = [&](std::int32_t f) {
    const Triangle& t = surface.triangles()[f];
    return std::array<Edge, 3>{ascending(t[0], t[1]), ascending(t[1], t[2]), ascending(t[2], t[0])};
  };
  std::vector<std::uint8_t> is_near(surface.vertex_count(), 0);
  for (const std::int32_t f : left_out) {
    poll.next();
    for (const Edge& edge : edges_of(f)) {
      if (edge[0] == edge[1] || cuts.contains(edge[0], edge[1])) continue;
      at_edge[edge].waiting.push_back(f);
      is_near[edge[0]] = is_near[edge[1]] = 1;
    }
  }
  // Rounds over the triangles that have a neighbor in a segment, by ascending numbers.
  using Turn = std::pair<std::int32_t, std::int32_t>;  // round and triangle
  std::priority_queue<Turn, std::vector<Turn>, std::greater<>> turns;
  const auto add = [&](std::int32_t f, const Turn& now) {
    for (const Edge& edge : edges_of(f)) {
      if (is_near[edge[0]] == 0 || is_near[edge[1]] == 0) continue;
      const auto found = at_edge.find(edge);
      if (found == at_edge.end() || found->second.first >= 0) continue;
      found->second.first = f;
      for (const std::int32_t other : found->second.waiting) {
        turns.emplace(other > now.second ? now.first : now.first + 1, other);
      }
      found->second.waiting = {};
    }
  };
  for (const std::int32_t f : corner_fans(surface).faces) {
    poll.next();
    add(f, {0, -1});
  }
  const auto neighbor_of = [&](std::int32_t f) {
    std::int32_t neighbor = -1;
    for (const Edge& edge : edges_of(f)) {
      const auto found = at_edge.find(edge);
      if (found == at_edge.end() || found->second.first < 0) continue;
      if (!has_edge(surface, edge)) return found->second.first;
      if (neighbor < 0) neighbor = found->second.first;
    }
    return neighbor;
  };
  std::vector<std::uint8_t> is_added(surface.face_count(), 0);
  for (const std::int32_t start : left_out) {
    while (!turns.empty()) {
      poll.next();
      const Turn now = turns.top();
      turns.pop();
      const std::int32_t f = now.second;
      if (is_added[f] != 0) continue;
      is_added[f] = 1;
      sets.join(neighbor_of(f), f);
      add(f, now);
    }
    // None of the others has a neighbor in a segment: the first begins a new one.
    if (is_added[start] != 0) continue;
    is_added[start] = 1;
    add(start, {0, -1});
  }
}

}  // namespace

std::vector<std::int32_t> face_segments(const Surface& surface, std::span<const Edge> cut_edges, const Task& task) {
  Poll poll(task);
  const Cuts cuts(surface, cut_edges, "cut_edges", task);
  DisjointSets sets(surface.face_count());
  const CornerFans& fans = corner_fans(surface);
  for (std::int32_t h = 0; index(h) < fans.twins.size(); ++h) {
    poll.next();
    const std::int32_t twin = fans.twins[h];
    if (twin < h) continue;  // on the boundary, or seen from the other side
    if (cuts.contains(fans.vertices[fans.tail(h)], fans.vertices[fans.tip(h)])) continue;
    sets.join(fans.faces[h / 3], fans.faces[twin / 3]);
  }
  join_left_out(surface, cuts, sets, poll);

  auto [labels, count] = sets.numbering();
  std::vector<std::int32_t> sizes(index(count), 0), order(index(count)), rank(index(count));
  for (const std::int32_t label : labels) ++sizes[label];
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::int32_t i) { return sizes[i]; });
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<std::int32_t>(i);
  for (std::int32_t& label : labels) label = rank[label];
  return std::move(labels);
}

}  // namespace seamwire
