// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/segments.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

#include "detail/disjoint_sets.hpp"
#include "detail/index.hpp"
#include "surface/corner_fans.hpp"
#include "surface/cuts.hpp"
#include "surface/real_edges.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// Adds each triangle that the surface left out to the segment of one neighbor, so that it joins no segments. The
/// neighbor beyond a diagonal of its polygon comes first. Neighbors that were left out themselves follow.
void join_left_out(const Surface& surface, const Cuts& cuts, DisjointSets& sets) {
  const SurfaceReport& report = surface.report();
  std::vector<std::int32_t> left_out = report.degenerate_faces;
  left_out.insert(left_out.end(), report.duplicate_faces.begin(), report.duplicate_faces.end());
  if (left_out.empty()) return;
  std::ranges::sort(left_out);
  std::map<Edge, std::vector<std::int32_t>> at_edge;  // the triangles that are in a segment
  const auto edges_of = [&](std::int32_t f) {
    const Triangle& t = surface.triangles()[f];
    return std::array<Edge, 3>{ascending(t[0], t[1]), ascending(t[1], t[2]), ascending(t[2], t[0])};
  };
  std::vector<std::uint8_t> is_near(surface.vertex_count(), 0);
  for (const std::int32_t f : left_out) {
    for (const Edge& edge : edges_of(f)) {
      if (edge[0] == edge[1] || cuts.contains(edge[0], edge[1])) continue;
      at_edge[edge];
      is_near[edge[0]] = is_near[edge[1]] = 1;
    }
  }
  const auto add = [&](std::int32_t f) {
    for (const Edge& edge : edges_of(f)) {
      if (is_near[edge[0]] == 0 || is_near[edge[1]] == 0) continue;
      const auto found = at_edge.find(edge);
      if (found != at_edge.end()) found->second.push_back(f);
    }
  };
  for (const std::int32_t f : corner_fans(surface).faces) add(f);
  const auto neighbor_of = [&](std::int32_t f) {
    std::int32_t neighbor = -1;
    for (const Edge& edge : edges_of(f)) {
      const auto found = at_edge.find(edge);
      if (found == at_edge.end() || found->second.empty()) continue;
      if (!has_edge(surface, edge)) return found->second.front();
      if (neighbor < 0) neighbor = found->second.front();
    }
    return neighbor;
  };
  while (!left_out.empty()) {
    std::vector<std::int32_t> remaining;
    for (const std::int32_t f : left_out) {
      const std::int32_t neighbor = neighbor_of(f);
      if (neighbor < 0) {
        remaining.push_back(f);
        continue;
      }
      sets.join(neighbor, f);
      add(f);
    }
    if (remaining.size() == left_out.size()) {
      // None of them has a neighbor in a segment: the first begins a new one.
      add(remaining.front());
      remaining.erase(remaining.begin());
    }
    left_out = std::move(remaining);
  }
}

}  // namespace

std::vector<std::int32_t> face_segments(const Surface& surface, std::span<const Edge> cut_edges) {
  const Cuts cuts(surface, cut_edges, "cut_edges");
  DisjointSets sets(surface.face_count());
  const CornerFans& fans = corner_fans(surface);
  for (std::int32_t h = 0; index(h) < fans.twins.size(); ++h) {
    const std::int32_t twin = fans.twins[h];
    if (twin < h) continue;  // on the boundary, or seen from the other side
    if (cuts.contains(fans.vertices[fans.tail(h)], fans.vertices[fans.tip(h)])) continue;
    sets.join(fans.faces[h / 3], fans.faces[twin / 3]);
  }
  join_left_out(surface, cuts, sets);

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
