// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cut/cut_mesh.hpp"
#include "cut/nodes.hpp"

namespace seamwire::detail {

/// A segment between two nodes, by their numbers.
using Cut = std::array<std::int32_t, 2>;

/// Returns which parts of the segments a-b and c-d lie before the place where they cross, in the plane of x and y.
std::optional<std::array<double, 2>> crossing_of(const Vector& a, const Vector& b, const Vector& c, const Vector& d);

/// A polygon in the plane, seen along its normal. A polygon that is folded or has no area is seen as a regular one,
/// where its triangles lie beside each other as well. The third coordinate of places is 0.
class PolygonShape {
 public:
  PolygonShape(const CutMesh& mesh, const NodeTable& nodes, std::int32_t polygon);

  /// Whether the polygon is replaced by a regular one.
  bool is_folded() const { return is_folded_; }
  /// Whether a node is a corner or on a side.
  bool is_on_rim(std::int32_t node) const;
  /// Where a node of the polygon is seen.
  Vector seen(std::int32_t node) const;
  CutNode node_at(const Vector& place) const;
  /// Returns the index of the node that is farthest from the line between the ends; -1 if the chain hardly bends.
  std::ptrdiff_t farthest(std::span<const std::int32_t> chain) const;
  /// Whether the straight line between two nodes lies inside.
  bool holds_line(std::int32_t one, std::int32_t two) const;

 private:
  std::array<std::int32_t, 2> side(std::size_t i) const { return {corners_[i], corners_[(i + 1) % corners_.size()]}; }
  const Vector& place_of_corner(std::int32_t vertex) const { return places_[mesh_.place_of_corner(polygon_, vertex)]; }
  bool holds(const Vector& place) const;

  const CutMesh& mesh_;
  const NodeTable& nodes_;
  std::int32_t polygon_;
  const std::vector<std::int32_t>& corners_;
  std::vector<Vector> places_;  // of the corners
  bool is_folded_ = false;
};

}  // namespace seamwire::detail
