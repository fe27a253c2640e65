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

namespace seamwire {

/// A cut that passes a vertex or an edge at less than this distance goes through it. The unit is the length of an edge,
/// or the height of a triangle.
inline constexpr double kCutNear = 0.05;

/// Polygons, cut into triangles. The arrays belong to the caller.
struct PolygonMesh {
  std::span<const Vector> points;          ///< finite
  std::span<const Triangle> triangles;     ///< vertex numbers; those of one polygon are turned the same way
  std::span<const std::int32_t> polygons;  ///< the polygon of each triangle, 0 or more, ascending
};

/// A curve to be cut into a mesh.
struct CutCurve {
  std::vector<Vector> points;  ///< at least two, on the mesh or near it; between two points the curve is straight
  /// Where it begins: a vertex, or a point of a triangle. If the first point does not lie there, a vertex only names
  /// the polygons in which the curve may begin.
  SurfacePoint start;
  /// Where it ends. Other vertices and edges may lie in the same place. nullopt: wherever the last point lies.
  std::optional<SurfacePoint> end = std::nullopt;
  /// The triangle that each segment lies in, one less than points. Empty: not known. If the curve does not run in these
  /// triangles, or one of them does not exist, all are found as if they were not known.
  std::vector<std::int32_t> faces = {};
  /// The number of an earlier curve that this one is a mirror image of; -1: none. This curve is
  /// skipped if the earlier one is left out.
  std::int32_t image_of = -1;
};

/// A place that cuts pass: a vertex, a point between two vertices, or a point between three.
struct CutNode {
  std::array<std::int32_t, 3> vertices{-1, -1, -1};  ///< ascending; unused ones are -1, and come last
  std::array<double, 3> weights{};                   ///< of each vertex, positive; their sum is 1
  /// The polygon that it lies inside; -1 if it is a vertex or lies on an edge.
  std::int32_t polygon = -1;

  /// The same numbers, not only the same place.
  bool operator==(const CutNode&) const = default;
};

/// New vertices on an edge.
struct EdgeSplit {
  Edge edge;                        ///< the smaller vertex first
  std::vector<std::int32_t> nodes;  ///< from that vertex on
};

/// Cuts inside a polygon.
struct PolygonCuts {
  std::int32_t polygon = -1;  ///< its number
  /// From node to node, straight. They meet in nodes only. Nodes are corners, on sides, or inside.
  std::vector<std::array<std::int32_t, 2>> cuts;
  /// The polygon is folded or has no area. Its cuts were planned on a regular polygon with as many corners.
  bool is_folded = false;
};

/// A curve that is not cut, because it does not run over the mesh.
struct UncutCurve {
  std::int32_t curve = -1;   ///< its number
  std::int32_t vertex = -1;  ///< a vertex near where it leaves the mesh
};

/// The changes to a mesh that cut curves into it. Nodes are called by their numbers in `nodes`.
struct CutPlan {
  std::vector<CutNode> nodes;                      ///< all that edits name
  std::vector<EdgeSplit> splits;                   ///< the edges that get new vertices
  std::vector<std::array<std::int32_t, 2>> along;  ///< cuts between two neighboring vertices or nodes of one edge
  std::vector<PolygonCuts> across;                 ///< for each polygon that is cut
  std::vector<UncutCurve> left_out;                ///< without the images of such curves

  /// Returns the number of the node at a point between three vertices, or of the node that was moved away from there.
  /// -1 if no cut passes there.
  std::int32_t node_at(const Triangle& corners, const std::array<double, 3>& barycentric) const;
};

/// Plans how to cut curves into a mesh. The method is described in docs/method/finishing.md.
///
/// If a curve ends inside a polygon and no other curve continues from there, it is cut only as far as the last edge
/// that it crosses. Curves that cross or run close to each other meet in common nodes. Slivers between them are left
/// out.
///
/// Throws InvalidInput, naming the element, if sizes do not fit, if polygons are not ascending, for an index out of
/// range, or for a coordinate that is not finite. Throws InvalidInput, too, if the triangles of a polygon that a curve
/// passes do not form a polygon.
SEAMWIRE_API CutPlan plan_cuts(const PolygonMesh& mesh, std::span<const CutCurve> curves);

}  // namespace seamwire
