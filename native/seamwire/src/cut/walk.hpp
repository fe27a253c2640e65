// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cut/cut_mesh.hpp"
#include "cut/nodes.hpp"

namespace seamwire::detail {

/// Barycentric coordinates of the place in a triangle that is a point or near it.
struct Barycentric {
  std::array<double, 3> weights;
  /// How far the point is from that place, as part of the triangle's longest side. Infinite if it has no area.
  double off;
};
Barycentric barycentric_in(const std::array<Vector, 3>& corners, const Vector& point);

/// The pieces of a curve, from polygon to polygon.
struct Walk {
  std::vector<Piece> pieces;
  std::int32_t left_near = -1;  ///< if the curve does not run over the mesh, a vertex near where it leaves it
};

/// Walks along a curve, and adds the nodes that it passes.
///
/// If the curve lies in the triangles that it names, the walk uses them. Otherwise the walk is the cheapest one
/// (Dijkstra's algorithm). A step costs nothing if the next point of the curve lies in a neighboring polygon. Where
/// faces lie on each other, the walk therefore prefers the face that also holds the next points. Throws Cancelled.
Walk walk_along(const CutMesh& mesh, const CutCurve& curve, NodeTable& nodes, const Task& task);

}  // namespace seamwire::detail
