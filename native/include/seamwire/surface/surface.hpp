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

namespace detail {
struct HalfEdgeMesh;  // in src/surface/half_edge_mesh.hpp
}

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
/// The half-edge mesh inside is manifold and consistently oriented. Where the input is not, the mesh is cut open. If
/// the faces of a vertex form several fans, each fan is one vertex of the half-edge mesh (a *corner fan*). To a path,
/// these fans are one vertex. siblings() tells which faces meet at the edges where the mesh is cut open.
///
/// Immutable. Copies share the half-edge mesh.
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
  /// \param task progress and cancellation
  /// \throws InvalidInput if a coordinate is not finite or above 1e150 in size, or an index is out of range. The
  ///   message names the element.
  /// \throws InvalidInput if an edge joins a vertex to itself, or the mesh has no edge
  /// \throws Cancelled if the task is cancelled
  Surface(std::vector<Vector> points, std::vector<Triangle> triangles,
          std::optional<std::vector<Edge>> edges = std::nullopt, const Task& task = {});

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

  /// Return the manifold mesh inside, for the library itself. Its type is not part of the interface.
  const detail::HalfEdgeMesh& half_edges() const { return *mesh_; }
  /// Return the caller's vertex of each vertex (corner fan) of half_edges().
  ///
  /// The numbers ascend; on a clean mesh they are the identity. A vertex without a face has no fan. Two edges may join
  /// the same two fans, at a slit one edge long. So find half-edges by walking, never by their end points.
  const std::vector<std::int32_t>& vertex_of_fan() const { return vertex_of_fan_; }
  /// Return the caller's face of each face of half_edges(). The numbers ascend; on a clean mesh they are the identity.
  const std::vector<std::int32_t>& face_of_half_edge_face() const { return source_face_; }
  /// Return the fans at the corners of each face of half_edges(), beginning with the caller's first corner.
  ///
  /// Together with twins(), this is half_edges() in flat arrays, for loops over the whole mesh.
  const std::vector<Triangle>& face_fans() const { return face_fans_; }
  /// Return the half-edge on the other side of each half-edge, -1 on the boundary.
  ///
  /// Half-edge 3 f + i runs from corner i of face f to the next corner.
  const std::vector<std::int32_t>& twins() const { return twins_; }
  /// Return the half-edges of each edge where half_edges() is cut open, as IntrinsicMesh::siblings. Empty if the
  /// surface is manifold and orientable.
  const std::vector<std::int32_t>& siblings() const { return siblings_; }
  /// Return edges along which a path may run, although no face of half_edges() has them.
  ///
  /// They are edges without faces, and edges whose faces were all left out.
  const std::vector<Edge>& loose_edges() const { return loose_edges_; }

  /// Return the unusual parts of the input.
  const SurfaceReport& report() const { return report_; }

 private:
  std::vector<Vector> points_;
  std::vector<Triangle> triangles_;
  std::vector<Edge> edges_;
  std::vector<Edge> loose_edges_;
  std::vector<std::int32_t> vertex_of_fan_;
  std::vector<std::int32_t> source_face_;
  std::vector<Triangle> face_fans_;
  std::vector<std::int32_t> twins_, siblings_;
  double scale_ = 1.0;
  std::shared_ptr<const detail::HalfEdgeMesh> mesh_;  // immutable, so copies of a surface share it
  SurfaceReport report_;
};

}  // namespace seamwire
