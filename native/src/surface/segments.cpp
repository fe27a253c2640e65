// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/segments.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <string>
#include <utility>

namespace seamwire {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

Edge sorted(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// The set's representative is its least member, so that labels do not depend on the order of the cuts.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t find(std::int32_t i) {
    while (parent_[at(i)] != i) i = parent_[at(i)] = parent_[at(parent_[at(i)])];
    return i;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = find(a);
    b = find(b);
    if (a < b) {
      parent_[at(b)] = a;
    } else {
      parent_[at(a)] = b;
    }
  }

 private:
  std::vector<std::int32_t> parent_;
};

/// Answers quickly for edges between vertices that no cut touches, which are nearly all.
class Cuts {
 public:
  Cuts(const Surface& surface, std::span<const Edge> edges) : touched_(surface.vertex_count(), 0) {
    for (const auto& [a, b] : edges) {
      for (const std::int32_t v : {a, b}) {
        if (v >= 0 && at(v) < surface.vertex_count()) continue;
        throw InvalidInput("cut_edges: vertex " + std::to_string(v) + " is out of range: the surface has " +
                           std::to_string(surface.vertex_count()) + " vertices");
      }
      if (!std::binary_search(surface.edges().begin(), surface.edges().end(), sorted(a, b))) continue;
      edges_.push_back(sorted(a, b));
      touched_[at(a)] = touched_[at(b)] = 1;
    }
    std::sort(edges_.begin(), edges_.end());
  }
  bool contains(std::int32_t a, std::int32_t b) const {
    return touched_[at(a)] != 0 && touched_[at(b)] != 0 &&
           std::binary_search(edges_.begin(), edges_.end(), sorted(a, b));
  }

 private:
  std::vector<std::uint8_t> touched_;
  std::vector<Edge> edges_;
};

/// Across edges where the half-edge mesh is cut open, and to the triangles that it left out.
void join_across_odd_edges(const Surface& surface, const Cuts& cuts, DisjointSets& sets) {
  std::map<Edge, std::int32_t> odd;  // with the first triangle seen there
  const SurfaceReport& report = surface.report();
  for (const std::vector<Edge>* edges : {&report.nonmanifold_edges, &report.unorientable_edges}) {
    for (const auto& [a, b] : *edges) odd.emplace(sorted(a, b), -1);
  }
  const auto for_each_side = [&](std::int32_t f, const auto& visit) {
    const Triangle& t = surface.triangles()[at(f)];
    for (std::size_t i = 0; i < 3; ++i) visit(t[i], t[(i + 1) % 3]);
  };
  for (const std::vector<std::int32_t>* faces : {&report.degenerate_faces, &report.duplicate_faces}) {
    for (const std::int32_t f : *faces) {
      for_each_side(f, [&](std::int32_t a, std::int32_t b) { odd.emplace(sorted(a, b), -1); });
    }
  }
  if (odd.empty()) return;
  std::vector<std::uint8_t> touched(surface.vertex_count(), 0);
  for (const auto& [edge, face] : odd) touched[at(edge[0])] = touched[at(edge[1])] = 1;
  for (std::int32_t f = 0; at(f) < surface.face_count(); ++f) {
    for_each_side(f, [&](std::int32_t a, std::int32_t b) {
      if (touched[at(a)] == 0 || touched[at(b)] == 0 || a == b || cuts.contains(a, b)) return;
      const auto found = odd.find(sorted(a, b));
      if (found == odd.end()) return;
      if (found->second >= 0) sets.join(found->second, f);
      found->second = f;
    });
  }
}

}  // namespace

std::vector<std::int32_t> face_segments(const Surface& surface, std::span<const Edge> cut_edges) {
  const Cuts cuts(surface, cut_edges);
  DisjointSets sets(surface.face_count());
  const HalfEdgeMesh& mesh = surface.half_edges();
  const std::vector<std::int32_t>& source = surface.face_of_half_edge_face();
  const std::vector<std::int32_t>& vertex_of_fan = surface.vertex_of_fan();
  for (std::size_t e = 0; e < mesh.n_edges(); ++e) {
    const HalfEdgeMesh::HalfedgeHandle h(static_cast<int>(2 * e)), opposite(static_cast<int>(2 * e + 1));
    if (mesh.is_boundary(h) || mesh.is_boundary(opposite)) continue;
    const std::int32_t a = vertex_of_fan[at(mesh.to_vertex_handle(opposite).idx())];
    const std::int32_t b = vertex_of_fan[at(mesh.to_vertex_handle(h).idx())];
    if (cuts.contains(a, b)) continue;
    sets.join(source[at(mesh.face_handle(h).idx())], source[at(mesh.face_handle(opposite).idx())]);
  }
  join_across_odd_edges(surface, cuts, sets);

  std::vector<std::int32_t> labels(surface.face_count()), sizes, roots;
  for (std::int32_t f = 0; at(f) < labels.size(); ++f) {
    const std::int32_t root = sets.find(f);
    if (root == f) {  // the least of its set, so seen before the others
      labels[at(f)] = static_cast<std::int32_t>(roots.size());
      roots.push_back(f);
      sizes.push_back(0);
    } else {
      labels[at(f)] = labels[at(root)];
    }
    ++sizes[at(labels[at(f)])];
  }
  std::vector<std::int32_t> order(roots.size()), rank(roots.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::int32_t i) { return sizes[at(i)]; });
  for (std::size_t i = 0; i < order.size(); ++i) rank[at(order[i])] = static_cast<std::int32_t>(i);
  for (std::int32_t& label : labels) label = rank[at(label)];
  return labels;
}

}  // namespace seamwire
