// SPDX-License-Identifier: GPL-3.0-or-later
//
// Paths that descend a function which is linear in each triangle.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "detail/csr.hpp"
#include "geodesics/placed_point.hpp"
#include "seamwire/geodesics/distance_field.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// A mesh with what a path needs to walk over it.
class TracingMesh {
 public:
  struct Loose {
    std::int32_t to;
    double length;
  };
  using Corners = std::array<Point2, 3>;

  /// The mesh must be valid. Throws Cancelled.
  TracingMesh(const IntrinsicMesh& mesh, const Task& task);

  const IntrinsicMesh& mesh() const { return mesh_; }
  std::span<const std::int32_t> leaving(std::int32_t vertex) const { return leaving_[vertex]; }
  std::span<const Loose> loose(std::int32_t vertex) const { return loose_[vertex]; }
  /// A triangle in the plane, counterclockwise.
  Corners corners(std::int32_t face) const;
  /// A vertex, or a point in one face or in all faces of an edge, in the numbers of the mesh. Throws InvalidInput,
  /// which begins with `what`, for numbers out of range and invalid coordinates.
  PlacedPoint place(const SurfacePoint& point, const std::string& what) const;

 private:
  IntrinsicMesh mesh_;
  Csr<std::int32_t> leaving_;
  Csr<Loose> loose_;
};

/// Where paths end.
class PathEnds {
 public:
  explicit PathEnds(std::vector<PlacedPoint> points);

  bool has_vertex(std::int32_t vertex) const { return vertices_.contains(vertex); }
  /// An end on a face, and how far it is from a point of that face.
  struct Straight {
    double length;
    PathPoint end;
  };
  /// The end on a face that is nearest to a point of it. Infinitely far if the face has no end.
  Straight nearest(const TracingMesh& mesh, std::int32_t face, const Point2& from) const;
  /// Whether an end is on one of the faces around a vertex.
  bool are_around(const TracingMesh& mesh, std::int32_t vertex) const;

 private:
  std::vector<PlacedPoint> points_;
  std::unordered_set<std::int32_t> vertices_;
  std::unordered_map<std::int32_t, std::vector<std::size_t>> in_face_;  // numbers of points
};

/// The position of barycentric coordinates between corners.
inline Point2 between(const TracingMesh::Corners& corners, const std::array<double, 3>& weights) {
  return {weights[0] * corners[0].x + weights[1] * corners[1].x + weights[2] * corners[2].x,
          weights[1] * corners[1].y + weights[2] * corners[2].y};
}

/// The path of steepest descent from a point to one of the ends, in the direction from the end to the point.
///
/// `values` has a value for each vertex, infinite where no end can be reached; the path then has no points. The path
/// goes straight to an end that is on the same face. At a vertex that is lower than all around it, it follows edges to
/// the nearest lower one. Such detours apart, each vertex of the path is lower than the one before, so the path ends.
/// Throws Cancelled.
IntrinsicPath descend(const TracingMesh& mesh, const std::vector<double>& values, const PathEnds& ends,
                      const PlacedPoint& from, const Task& task);

}  // namespace seamwire::detail
