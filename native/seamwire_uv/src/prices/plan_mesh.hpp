// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "detail/csr.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/triangle_connectivity.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"
#include "surface/numbered_edges.hpp"

namespace seamwire::detail {

/// A neighbor of a vertex in a PlanMesh.
struct PlanNeighbor {
  std::int32_t vertex = -1;
  std::int32_t edge = -1;
};

/// The mesh on which seams are planned: flat arrays, scaled so that the whole surface has area 1.
struct PlanMesh : TriangleConnectivity, NumberedEdges {
  std::vector<Vector> points;
  std::vector<double> lengths;  ///< of each edge, rounded
  double median_length = 0.0;   ///< of the edges; 0 without edges
  /// Whether seams may run along an edge. They may not where triangulating a polygon has created it.
  std::vector<std::uint8_t> is_real;
  std::vector<std::int32_t> sources;  ///< the surface's vertex of each vertex
  std::vector<std::int32_t> faces;    ///< the surface's triangle of each triangle; empty for a simplified mesh
  double scale = 1.0;                 ///< multiply the caller's coordinates by this
  Csr<PlanNeighbor> neighbors;        ///< over real edges
  Csr<PlanNeighbor> all_neighbors;    ///< over all edges

  std::size_t vertex_count() const { return points.size(); }
  bool is_boundary(std::int32_t edge) const { return twins[half_edge_of[edge]] < 0; }
  /// The real edge between two vertices, the one with the smaller number if there are two; -1 if they have no edge.
  std::int32_t edge_between(std::int32_t a, std::int32_t b) const;
  /// The same with the diagonals of polygons.
  std::int32_t any_edge_between(std::int32_t a, std::int32_t b) const;
};

/// The triangles of a surface without degenerate and duplicate ones. They are in the same order for every order of the
/// surface's triangles. Vertices are the corner fans, so pieces that meet only in a vertex are apart. Throws Cancelled.
PlanMesh plan_mesh(const Surface& surface, const Task& task);

/// Fills in edges, lengths and neighbors of a mesh whose points, triangles and twins are known. `real_edges`: between
/// vertices of the mesh, sorted, the smaller vertex first; nullopt: all are real. Throws Cancelled.
void connect(PlanMesh& mesh, std::optional<std::span<const Edge>> real_edges, const Task& task);

/// Marks edges between two triangles, which are given by vertices of the surface: 1 for each. Throws
/// Cancelled.
std::vector<std::uint8_t> marked_edges(const PlanMesh& mesh, std::vector<Edge> edges, const Task& task);

/// Area and unit normal of a triangle; the normal of a triangle without area is zero.
struct FaceFrame {
  Vector normal = Vector::Zero();
  double area = 0.0;
};
FaceFrame face_frame(const PlanMesh& mesh, const Triangle& triangle);
/// Whether any of some triangles is more than a point or a line: higher than a millionth of the box around them all.
bool have_area(const PlanMesh& mesh, std::span<const Triangle> triangles);

/// Throws Cancelled.
std::vector<FaceFrame> face_frames(const PlanMesh& mesh, const Task& task);

/// Unit normals at vertices, weighted by the angles at corners. Throws Cancelled.
std::vector<Vector> vertex_normals(const PlanMesh& mesh, std::span<const FaceFrame> frames, const Task& task);

/// A third of the area of the triangles around each vertex.
std::vector<double> vertex_areas(const PlanMesh& mesh, std::span<const FaceFrame> frames);

/// The connected pieces of a mesh that is cut along some edges: the piece of each face, numbered by first faces. Throws
/// Cancelled.
struct Pieces {
  std::vector<std::int32_t> of_face;
  std::int32_t count = 0;
};
Pieces find_pieces(const PlanMesh& mesh, std::span<const std::uint8_t> is_cut, const Task& task);

/// How a mesh corresponds to its mirror image in a plane.
struct Reflection {
  int axis = 0;         ///< the plane's normal: 0 is x
  double offset = 0.0;  ///< where the plane meets this axis
  /// The vertex nearest to each vertex' mirror image; -1 if the image is farther than 1.2 % of the mesh's diagonal from
  /// the surface there.
  std::vector<std::int32_t> images;
  /// On which side of the plane each vertex lies: -1, 1, or 0 for a vertex that is its own image.
  std::vector<std::int8_t> sides;
  /// Whether nearly all edges are the mirror images of edges. The shape may deviate a little.
  bool is_exact = false;

  Vector mirrored(const Vector& point) const {
    Vector image = point;
    image[axis] = 2.0 * offset - image[axis];
    return image;
  }
};

/// The reflection in the plane through the origin whose normal is an axis, or in the one through the middle of the
/// mesh; nullopt if the mesh has no such symmetry. Throws Cancelled.
std::optional<Reflection> find_reflection(const PlanMesh& mesh, int axis, const Task& task);

/// The reflection in a plane that is known; nullopt if the mesh is not symmetric there. `diagonal`: of the shape whose
/// size decides what counts as near. Throws Cancelled.
std::optional<Reflection> reflection_in(const PlanMesh& mesh, int axis, double offset, double diagonal,
                                        const Task& task);

/// The mirror image of an edge; -1 without an image.
std::int32_t image_of_edge(const PlanMesh& mesh, const Reflection& reflection, std::int32_t edge);

/// The diagonal of the box around a mesh; 0 without vertices.
double diagonal_of(const PlanMesh& mesh);

}  // namespace seamwire::detail
