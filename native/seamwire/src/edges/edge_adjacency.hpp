// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "seamwire/edges/edge_adjacency.hpp"

namespace seamwire {

/// The directed edges that leave vertex v are numbered from begin(v) to end(v), by ascending head. A directed edge's
/// number is also that of the search's state "just arrived over this edge".
class EdgeAdjacency {
 public:
  EdgeAdjacency(const Surface& surface, const Task& task);

  std::int32_t vertex_count() const { return static_cast<std::int32_t>(first_.size()) - 1; }
  std::size_t directed_count() const { return head_.size(); }
  std::int32_t begin(std::int32_t v) const { return first_[v]; }
  std::int32_t end(std::int32_t v) const { return first_[v + 1]; }
  std::int32_t head(std::int32_t e) const { return head_[e]; }
  std::int32_t twin(std::int32_t e) const { return twin_[e]; }
  std::int32_t tail(std::int32_t e) const { return head(twin(e)); }

  /// The directed edge from a to b; -1 if they have no edge.
  std::int32_t find(std::int32_t a, std::int32_t b) const;
  /// The same, but throws InvalidInput if there is no such edge, or no such vertex. `what` says what it was given for.
  std::int32_t checked(const Edge& edge, const std::string& what) const;
  /// Throws InvalidInput if it cannot be the adjacency of a surface.
  void check_size(const Surface& surface) const;

  /// 1 - cos kappa of a chain that arrives against `back` and leaves over `out`, both directed edges from one vertex.
  double turn(std::int32_t back, std::int32_t out) const {
    const Direction &p = directions_[back], &r = directions_[out];
    return std::max(0.0, 1.0 + p[0] * r[0] + p[1] * r[1] + p[2] * r[2]);
  }
  /// The vector of a directed edge: the turn between two edges of a vertex is 1 plus the product of their vectors.
  ///
  /// In a closed umbrella of total angle T, the edge at angle a is the unit vector at 2 pi a / T. Then
  /// -cos(2 pi (a - b) / T) = cos(pi |left - right| / T).
  ///
  /// In an open umbrella it is the unit vector at a itself, and the turn is pi minus the angle between. The third
  /// components of the two boundary edges make their own turn zero. The other edges have no third component.
  ///
  /// Elsewhere it is the edge's direction in space.
  using Direction = std::array<double, 3>;
  const Direction& direction(std::int32_t e) const { return directions_[e]; }

  /// The directed edge that leaves the same vertex straight opposite, in a regular mesh of quads or of triangles and
  /// along a boundary; -1: the vertex is irregular there.
  std::int32_t opposite(std::int32_t e) const { return opposite_[e]; }

  /// Whether the faces at the vertex are one open umbrella; whether the directed edge is one of the two at its
  /// boundary.
  bool is_open(std::int32_t v) const { return is_open_[v]; }
  bool is_on_boundary(std::int32_t e, std::int32_t v) const {
    return boundary_edges_[v][0] == e || boundary_edges_[v][1] == e;
  }

 private:
  struct StarEdge {
    std::int32_t edge;
    double angle;
    bool triangle;  // the face behind it is a triangle with three real edges
  };

  void set_umbrella(const Surface& surface, std::int32_t fan);
  void set_opposites(const std::vector<StarEdge>& star);
  void set_directions_in_space(const Surface& surface, std::int32_t v);

  std::vector<std::int32_t> first_, head_, twin_;
  std::vector<std::int32_t> opposite_;
  std::vector<Direction> directions_;
  std::vector<bool> is_open_;                                // per vertex
  std::vector<std::array<std::int32_t, 2>> boundary_edges_;  // per vertex; -1: none, or not a real edge
};

}  // namespace seamwire
