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

/// Lists unusual parts of the input. They are not errors, and the surface was built despite them.
struct SurfaceReport {
  /// Edges with three or more faces. Geodesics cross such an edge from each face to each other face. Normals, curvature
  /// and islands end there as at a boundary.
  std::vector<Edge> nonmanifold_edges;
  /// Edges with two faces that cannot have the same orientation, as on a Moebius strip. Geodesics cross them. Normals,
  /// curvature and islands end there as at a boundary.
  std::vector<Edge> unorientable_edges;
  std::vector<std::int32_t> flipped_faces;  ///< faces turned over to agree with their neighbors
  /// Faces with three different corners, but lower than 1e-9 of their longest side. The surface keeps them. An
  /// embedding removes them, or leaves them as holes.
  std::vector<std::int32_t> zero_area_faces;
  /// Faces lower than 2^-22 of the unit cube, including faces without an area. The surface keeps them. Normals and
  /// curvature ignore them, because only rounding decides which way they face.
  std::vector<std::int32_t> low_faces;
  /// Faces with the same vertex at two corners. They are left out, but their edges stay.
  std::vector<std::int32_t> degenerate_faces;
  std::vector<std::int32_t> duplicate_faces;    ///< faces with the same three vertices as an earlier face; left out
  std::vector<std::int32_t> isolated_vertices;  ///< vertices without a face or an edge
  std::size_t boundary_edges = 0;               ///< number of edges with one face
  std::size_t components = 0;                   ///< number of parts connected by edges, without isolated vertices
};

/// A triangle mesh as people have it, with the caller's numbers of vertices and faces.
///
/// It may have boundaries, several components, isolated vertices, faces without an area, and mixed orientation. It may
/// also have edges with three or more faces, and duplicate faces.
///
/// Inside, the surface is cut open where it is not manifold or not consistently oriented. Paths do not see these cuts:
/// to a path, a vertex is one vertex, and all faces at an edge meet there.
///
/// Immutable. Copies share the mesh inside.
class SEAMWIRE_API Surface {
 public:
  /// Build a surface.
  ///
  /// Cancelling takes effect within about 0.1 s at a million faces.
  ///
  /// \param points finite coordinates, at most 1e150 in size
  /// \param triangles vertex numbers in [0, points.size())
  /// \param edges the real edges if faces are triangulated polygons, and edges without a face; nullopt if every edge of
  ///   a triangle is real
  /// \throws InvalidInput if a coordinate is not finite or above 1e150 in size, or an index is out of range. The
  ///   message names the element.
  /// \throws InvalidInput if the longest side of the bounding box of the used vertices is below 1e-150, but not 0
  /// \throws InvalidInput if an edge joins a vertex to itself, or the mesh has no edge
  Surface(std::vector<Vector> points, std::vector<Triangle> triangles,
          std::optional<std::vector<Edge>> edges = std::nullopt, const Task& = {});

  /// Return the number of points, used or not.
  std::size_t vertex_count() const { return points_.size(); }
  /// Return the number of triangles that the caller gave.
  std::size_t face_count() const { return triangles_.size(); }

  /// Return the caller's coordinates.
  const std::vector<Vector>& points() const { return points_; }
  /// Return the caller's triangles, in their original orientation.
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Return the real edges: unique, smaller vertex first, sorted.
  const std::vector<Edge>& edges() const { return edges_; }

  /// Return the factor that scales the caller's coordinates to the unit cube.
  ///
  /// It is one over the longest side of the bounding box of the used vertices, or 1 if that side is 0.
  ///
  /// \see Zhuang et al. 2014, Section 3
  double scale() const { return scale_; }

  /// Return edges along which a path may run, although no triangle has them.
  ///
  /// They are edges without faces, and edges whose faces were all left out.
  const std::vector<Edge>& loose_edges() const { return loose_edges_; }

  /// Return the unusual parts of the input.
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
