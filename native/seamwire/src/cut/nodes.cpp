// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut/nodes.hpp"

#include <algorithm>
#include <cmath>

#include "cut/tolerances.hpp"
#include "detail/drop_repeats.hpp"
#include "detail/infinity.hpp"
#include "surface/point_segment.hpp"

namespace seamwire::detail {
namespace {

/// A node that lies on a polygon's side, as a node between the side's ends; any other node as it is.
CutNode on_side(const CutMesh& mesh, std::int32_t polygon, const CutNode& node, double near) {
  const std::vector<std::int32_t>& corners = mesh.corners(polygon);
  const std::size_t count = vertices_of(node).size();
  if (corners.size() < 4 || count == 1) return node;
  if (count == 2 && mesh.is_side(polygon, node.vertices[0], node.vertices[1])) return node;
  const Vector place = place_of(node, mesh);
  std::size_t best = 0;
  double least = kInfinity, part = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector &a = mesh.points()[corners[i]], &b = mesh.points()[corners[(i + 1) % corners.size()]];
    const double gap = to_segment(place, a, b).norm();
    if (gap < least) {
      best = i;
      least = gap;
      part = nearest_on_segment(place, a, b);
    }
  }
  const std::array<std::int32_t, 2> side{corners[best], corners[(best + 1) % corners.size()]};
  if (!(least < kOn * (mesh.points()[side[1]] - mesh.points()[side[0]]).norm())) return node;
  return node_between(side, std::array{1.0 - part, part}, near);
}

}  // namespace

CutNode node_between(std::span<const std::int32_t> vertices, std::span<const double> weights, double near) {
  std::vector<std::pair<std::int32_t, double>> kept;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (weights[i] > near) kept.emplace_back(vertices[i], weights[i]);
  }
  const auto total = [&kept] {
    double sum = 0.0;
    for (const auto& [vertex, weight] : kept) sum += weight;
    return sum;
  };
  if (kept.size() < 3) {
    // Points near an edge may still be near one of its ends.
    std::erase_if(kept, [limit = near * total()](const auto& item) { return !(item.second > limit); });
  }
  std::ranges::sort(kept);
  CutNode node;
  const double sum = total();
  for (std::size_t i = 0; i < kept.size(); ++i) {
    node.vertices[i] = kept[i].first;
    node.weights[i] = kept[i].second / sum;
  }
  return node;
}

double weight_of(const CutNode& node, std::int32_t vertex) {
  const auto found = std::ranges::find(node.vertices, vertex);
  return found == node.vertices.end() ? 0.0 : node.weights[static_cast<std::size_t>(found - node.vertices.begin())];
}

bool is_near(const CutNode& one, const CutNode& other) {
  if (one.vertices != other.vertices) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(std::abs(one.weights[i] - other.weights[i]) < kCutNear)) return false;
  }
  return true;
}

CutNode in_polygon(const CutMesh& mesh, std::int32_t polygon, const CutNode& node, double near) {
  CutNode moved = on_side(mesh, polygon, node, near);
  const std::size_t count = vertices_of(moved).size();
  if (count == 3 || (count == 2 && !mesh.is_side(polygon, moved.vertices[0], moved.vertices[1]))) {
    moved.polygon = polygon;
  }
  return moved;
}

std::int32_t NodeTable::add(const CutNode& node) {
  const auto [found, is_new] = number_of_.try_emplace(node, static_cast<std::int32_t>(nodes_.size()));
  if (is_new) nodes_.push_back(node);
  return found->second;
}

std::map<NodePair, std::vector<std::int32_t>> nodes_on_pairs(const NodeTable& nodes, std::span<const Piece> pieces) {
  std::map<NodePair, std::vector<std::int32_t>> found;
  for (const Piece& piece : pieces) {
    for (const std::int32_t n : {piece.one, piece.two}) {
      const CutNode& node = nodes[n];
      if (vertices_of(node).size() == 2) found[{{node.vertices[0], node.vertices[1]}, node.polygon}].push_back(n);
    }
  }
  for (auto& [pair, own] : found) {
    std::ranges::sort(own);
    drop_repeats(own);
    std::ranges::stable_sort(own, {}, [&nodes](std::int32_t n) { return nodes[n].weights[1]; });
  }
  return found;
}

}  // namespace seamwire::detail
