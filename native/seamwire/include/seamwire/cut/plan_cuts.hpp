// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/errors.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/surface/types.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// A cut that passes nearer than this to a vertex or an edge goes through it. The unit is the length of an edge, or the
/// height of a triangle.
inline constexpr double kCutNear = 0.05;

/// Polygons, cut into triangles. The arrays belong to the caller.
struct TriangulatedPolygons {
  std::span<const Vector> points;          ///< finite
  std::span<const Triangle> triangles;     ///< vertex numbers; triangles of one polygon have the same orientation
  std::span<const std::int32_t> polygons;  ///< the polygon of each triangle, 0 or more, ascending
};

/// A curve to be cut into a mesh.
struct CutCurve {
  /// Two or more finite points, on the mesh or near it. The curve is straight between two points.
  std::vector<Vector> points;
  /// Where the curve begins: a vertex, or a point of a triangle. If the first point does not lie there, a vertex only
  /// names the polygons in which the curve may begin.
  SurfacePoint start;
  /// Where the curve ends. Other vertices and edges may lie at the same place. nullopt: wherever the last point lies.
  std::optional<SurfacePoint> end = std::nullopt;
  /// The triangle of each segment, one fewer than points. If the curve does not run in these triangles, or one of them
  /// does not exist, they are found as if unknown. Empty: unknown.
  std::vector<std::int32_t> faces = {};
  /// An earlier curve that this curve mirrors. If the earlier curve is left out, so is this one. -1: not a mirror
  /// image.
  std::int32_t image_of = -1;
};

/// A place that cuts pass: a vertex, a point between two vertices, or a point between three vertices.
struct CutNode {
  std::array<std::int32_t, 3> vertices{-1, -1, -1};  ///< ascending; unused numbers are -1 and come last
  std::array<double, 3> weights{};                   ///< of each vertex, above 0; their sum is 1
  /// The polygon that contains the node, -1 if the node is a vertex or lies on an edge.
  std::int32_t polygon = -1;

  /// Compare the numbers. Nodes at the same place may have different numbers.
  bool operator==(const CutNode&) const = default;
};

/// New vertices on an edge.
struct EdgeSplit {
  Edge edge;                        ///< smaller vertex first
  std::vector<std::int32_t> nodes;  ///< in order, from the smaller vertex on
};

/// Cuts inside a polygon.
struct PolygonCuts {
  std::int32_t polygon = -1;  ///< its number
  /// Straight cuts from node to node. They meet only in nodes. Nodes are corners, on sides, or inside.
  std::vector<std::array<std::int32_t, 2>> cuts;
  /// Whether the polygon is folded or has no area. Its cuts were then planned on a regular polygon with as many
  /// corners.
  bool is_folded = false;
};

/// A curve that is not cut, because it does not run over the mesh.
struct UncutCurve {
  std::int32_t curve = -1;   ///< its number
  std::int32_t vertex = -1;  ///< a vertex near where it leaves the mesh
};

/// The changes to a mesh that cut curves into it. A node's number is its index in `nodes`.
struct SEAMWIRE_API CutPlan {
  std::vector<CutNode> nodes;                      ///< all nodes of the plan
  std::vector<EdgeSplit> splits;                   ///< the edges that get new vertices
  std::vector<std::array<std::int32_t, 2>> along;  ///< cuts between two neighboring vertices or nodes of one edge
  std::vector<PolygonCuts> across;                 ///< for each polygon that is cut
  std::vector<UncutCurve> left_out;                ///< curves that are not cut, without their mirror images

  /// Find the node at a point between three vertices, or the node that was moved away from there.
  ///
  /// \param corners three vertices
  /// \param barycentric the weights of the vertices
  /// \returns the number of the node, -1 if no cut passes there
  std::int32_t node_at(const Triangle& corners, const std::array<double, 3>& barycentric) const;
};

/// Plan how to cut curves into a mesh.
///
/// A curve may end inside a polygon, where no other curve continues. Then it is cut only as far as the last edge that
/// it crosses. Curves that cross or run close to each other meet in common nodes. Slivers between them are left out.
/// docs/method/finishing.md describes the method.
///
/// In each polygon the time may grow with the square of the number of its corners and of the points of curves there.
///
/// \param mesh the mesh
/// \param curves the curves
/// \returns the changes to the mesh
/// \throws InvalidInput if sizes do not fit, an index is out of range, or a coordinate is not finite. The message names
///   the element.
/// \throws InvalidInput if barycentric coordinates are below 0, or their sum is not 1
/// \throws InvalidInput if polygons are not ascending, or the triangles of a polygon that a curve passes do not form a
///   polygon
SEAMWIRE_API CutPlan plan_cuts(const TriangulatedPolygons& mesh, std::span<const CutCurve> curves, const Task& = {});

}  // namespace seamwire
