// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/segments.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>

#include "detail/disjoint_sets.hpp"
#include "detail/index.hpp"
#include "surface/cuts.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// Across edges where the half-edge mesh is cut open, and to the triangles that it left out.
void join_across_odd_edges(const Surface& surface, const Cuts& cuts, DisjointSets& sets) {
  std::map<Edge, std::int32_t> odd;  // with the first triangle seen there
  const SurfaceReport& report = surface.report();
  for (const std::vector<Edge>* edges : {&report.nonmanifold_edges, &report.unorientable_edges}) {
    for (const auto& [a, b] : *edges) odd.emplace(ascending(a, b), -1);
  }
  const auto for_each_side = [&](std::int32_t f, const auto& visit) {
    const Triangle& t = surface.triangles()[f];
    for (std::size_t i = 0; i < 3; ++i) visit(t[i], t[(i + 1) % 3]);
  };
  for (const std::vector<std::int32_t>* faces : {&report.degenerate_faces, &report.duplicate_faces}) {
    for (const std::int32_t f : *faces) {
      for_each_side(f, [&](std::int32_t a, std::int32_t b) { odd.emplace(ascending(a, b), -1); });
    }
  }
  if (odd.empty()) return;
  std::vector<std::uint8_t> touched(surface.vertex_count(), 0);
  for (const auto& [edge, face] : odd) touched[edge[0]] = touched[edge[1]] = 1;
  for (std::int32_t f = 0; index(f) < surface.face_count(); ++f) {
    for_each_side(f, [&](std::int32_t a, std::int32_t b) {
      if (touched[a] == 0 || touched[b] == 0 || a == b || cuts.contains(a, b)) return;
      const auto found = odd.find(ascending(a, b));
      if (found == odd.end()) return;
      if (found->second >= 0) sets.join(found->second, f);
      found->second = f;
    });
  }
}

}  // namespace

std::vector<std::int32_t> face_segments(const Surface& surface, std::span<const Edge> cut_edges) {
  const Cuts cuts(surface, cut_edges, "cut_edges");
  DisjointSets sets(surface.face_count());
  const std::vector<std::int32_t>& source = surface.face_of_half_edge_face();
  const std::vector<std::int32_t>& vertex_of_fan = surface.vertex_of_fan();
  for (std::int32_t h = 0; index(h) < surface.twins().size(); ++h) {
    const std::int32_t twin = surface.twins()[h];
    if (twin < h) continue;  // on the boundary, or seen from the other side
    const Triangle& fans = surface.face_fans()[h / 3];
    if (cuts.contains(vertex_of_fan[fans[h % 3]], vertex_of_fan[fans[(h + 1) % 3]])) continue;
    sets.join(source[h / 3], source[twin / 3]);
  }
  join_across_odd_edges(surface, cuts, sets);

  std::vector<std::int32_t> labels(surface.face_count()), sizes, roots;
  for (std::int32_t f = 0; index(f) < labels.size(); ++f) {
    const std::int32_t root = sets.find(f);
    if (root == f) {  // the least of its set, so seen before the others
      labels[f] = static_cast<std::int32_t>(roots.size());
      roots.push_back(f);
      sizes.push_back(0);
    } else {
      labels[f] = labels[root];
    }
    ++sizes[labels[f]];
  }
  std::vector<std::int32_t> order(roots.size()), rank(roots.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::int32_t i) { return sizes[i]; });
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<std::int32_t>(i);
  for (std::int32_t& label : labels) label = rank[label];
  return labels;
}

}  // namespace seamwire
