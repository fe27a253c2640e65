// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "cut/cut_mesh.hpp"
#include "seamwire/cut/plan_cuts.hpp"

namespace seamwire::detail {

/// The vertices of a node that are used.
inline std::span<const std::int32_t> vertices_of(const CutNode& node) {
  std::size_t count = 0;
  while (count < 3 && node.vertices[count] >= 0) ++count;
  return {node.vertices.data(), count};
}

inline CutNode node_at_vertex(std::int32_t v) { return {.vertices = {v, -1, -1}, .weights = {1.0, 0.0, 0.0}}; }

/// The node of barycentric coordinates. It is moved to an edge or a vertex if it is `near`, as part of the triangle's
/// height or the edge's length.
CutNode node_between(std::span<const std::int32_t> vertices, std::span<const double> weights, double near = 0.0);

/// Where a node is. `point_of(v)`: where a vertex is.
template <class PointOf>
Vector place_of(const CutNode& node, const PointOf& point_of) {
  Vector place = Vector::Zero();
  for (std::size_t i = 0; i < vertices_of(node).size(); ++i) place += node.weights[i] * point_of(node.vertices[i]);
  return place;
}
inline Vector place_of(const CutNode& node, const CutMesh& mesh) {
  return place_of(node, [&mesh](std::int32_t v) -> const Vector& { return mesh.points()[v]; });
}

/// The weight of any vertex; 0 if the node is not between this one and others.
double weight_of(const CutNode& node, std::int32_t vertex);

/// Whether two nodes lie between the same vertices, less than kCutNear apart.
bool is_near(const CutNode& one, const CutNode& other);

/// Returns a node of a polygon's triangles as a node on the polygon's side, or else as a node inside it. Diagonals past
/// corners in a row lie on sides as well. A node that is `near` an end of its side, as part of the side, becomes that
/// vertex.
CutNode in_polygon(const CutMesh& mesh, std::int32_t polygon, const CutNode& node, double near);

/// A straight cut between two nodes, by their numbers, and the polygon that it lies in.
struct Piece {
  std::int32_t one = -1, two = -1, polygon = -1;
};

/// Numbers nodes in the order in which they are added.
class NodeTable {
 public:
  /// Returns the number of a node. Nodes with the same numbers get the same one.
  std::int32_t add(const CutNode& node);
  const CutNode& operator[](std::int32_t number) const { return nodes_[number]; }
  std::size_t size() const { return nodes_.size(); }

 private:
  struct Before {
    bool operator()(const CutNode& one, const CutNode& other) const {
      return std::tie(one.vertices, one.weights, one.polygon) < std::tie(other.vertices, other.weights, other.polygon);
    }
  };
  std::vector<CutNode> nodes_;
  std::map<CutNode, std::int32_t, Before> number_of_;
};

/// Two vertices, ascending, and the polygon in which they form a diagonal; -1 if they form an edge.
using NodePair = std::pair<Edge, std::int32_t>;

/// Returns the nodes between each two vertices, in order from the smaller one.
std::map<NodePair, std::vector<std::int32_t>> nodes_on_pairs(const NodeTable& nodes, std::span<const Piece> pieces);

}  // namespace seamwire::detail
