// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/errors.hpp"
#include "seamwire/surface/types.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

class Surface;
namespace detail {
struct CornerFans;  // in src/surface/corner_fans.hpp
const CornerFans& corner_fans(const Surface& surface);
}  // namespace detail

/// Lists unusual parts of the input. Nothing here is an error: the surface was built all the same.
struct SurfaceReport {
  /// Edges with three or more faces. Geodesics cross them from each face to each other one. Normals and curvature end
  /// there as at a boundary, and so do islands.
  std::vector<Edge> nonmanifold_edges;
  /// Edges with two faces that cannot be oriented alike, as on a Moebius strip. Geodesics cross them. Normals and
  /// curvature end there as at a boundary, and so do islands.
  std::vector<Edge> unorientable_edges;
  std::vector<std::int32_t> flipped_faces;  ///< turned over to agree with their neighbors
  /// Lower than 1e-9 of their longest side, with three different corners: kept, but an embedding removes them, or
  /// leaves them as holes.
  std::vector<std::int32_t> zero_area_faces;
  /// Lower than 2^-22 of the unit cube, those without an area among them: kept, but which way they face is nothing but
  /// rounding, so normals and curvature leave them out.
  std::vector<std::int32_t> low_faces;
  std::vector<std::int32_t> degenerate_faces;   ///< two corners are one vertex: left out, their edges stay
  std::vector<std::int32_t> duplicate_faces;    ///< same three vertices as an earlier face: left out
  std::vector<std::int32_t> isolated_vertices;  ///< in no face and no edge
  std::size_t boundary_edges = 0;               ///< edges with one face
  std::size_t components = 0;                   ///< connected by edges; isolated vertices are not counted
};

/// A triangle mesh as people have it: boundaries, several components, isolated vertices, zero-area faces, mixed
/// orientation, edges with three or more faces, duplicate faces. Keeps the caller's numbers of vertices and faces.
///
/// Inside, the surface is manifold and consistently oriented: it is cut open where the input is not. To a path, the
/// parts of a vertex that is cut are one vertex, and all faces at an edge meet there.
class SEAMWIRE_API Surface {
 public:
  /// `points`: finite. `triangles`: vertex numbers in [0, points.size()). `edges`: the real edges if faces are
  /// triangulated polygons, and edges without a face. nullopt: every edge of a triangle.
  ///
  /// Throws InvalidInput, naming the element, for a coordinate that is not finite or above 1e150 in size, and for an
  /// index out of range. Throws InvalidInput, too, for an edge from a vertex to itself, or a mesh without any edge.
  /// Throws Cancelled within about a tenth of a second at a million faces.
  Surface(std::vector<Vector> points, std::vector<Triangle> triangles,
          std::optional<std::vector<Edge>> edges = std::nullopt, const Task& task = {});

  /// The number of points, used or not.
  std::size_t vertex_count() const { return points_.size(); }
  /// The number of triangles, as given.
  std::size_t face_count() const { return triangles_.size(); }

  /// The caller's coordinates, triangles (as given, not turned) and real edges (unique, smaller vertex first, sorted).
  const std::vector<Vector>& points() const { return points_; }
  /// As given, not turned.
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// The real edges: unique, smaller vertex first, sorted.
  const std::vector<Edge>& edges() const { return edges_; }

  /// Multiply the caller's coordinates by this to fit the model into the unit cube (Section 3 of the paper). It is one
  /// over the longest side of the bounding box of the vertices in use, or 1 if that side is zero.
  double scale() const { return scale_; }

  /// Edges without a triangle along which a path may run all the same: edges without faces, and edges whose faces were
  /// all left out.
  const std::vector<Edge>& loose_edges() const { return loose_edges_; }

  /// Unusual parts of the input.
  const SurfaceReport& report() const { return report_; }

 private:
  friend const detail::CornerFans& detail::corner_fans(const Surface& surface);

  std::vector<Vector> points_;
  std::vector<Triangle> triangles_;
  std::vector<Edge> edges_;
  std::vector<Edge> loose_edges_;
  double scale_ = 1.0;
  std::shared_ptr<const detail::CornerFans> fans_;  // immutable, so copies of a surface share it
  SurfaceReport report_;
};

}  // namespace seamwire
