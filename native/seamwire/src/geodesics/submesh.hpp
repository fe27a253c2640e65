// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "detail/zeroed_array.hpp"
#include "geodesics/geodesic_mesh.hpp"

namespace seamwire::detail {

/// Some triangles of a mesh as a separate mesh, whose edges are not measured for hops. Its external numbers are its
/// internal ones. Paths may bend at its border as at any other boundary; on the whole mesh they are paths all the same.
struct Submesh {
  std::shared_ptr<const GeodesicMesh> mesh;
  std::vector<std::int32_t> vertices, faces;  ///< the number of each in the whole mesh
};

/// Cuts submeshes out of a mesh, in time proportional to their size. The mesh has to outlive the cutter.
class SubmeshCutter {
 public:
  explicit SubmeshCutter(const GeodesicMesh& mesh)
      : mesh_(mesh), part_vertex_(mesh.vertex_count()), part_face_(mesh.half_edge_count() / 3) {}

  /// The triangles that have one of the given vertices, and the loose edges between these.
  Submesh cut(std::span<const std::int32_t> vertices);
  /// The number of a vertex, or a face, in the submesh cut last, -1 outside of it.
  std::int32_t part_vertex(std::int32_t vertex) const { return part_vertex_[vertex] - 1; }
  std::int32_t part_face(std::int32_t face) const { return part_face_[face] - 1; }

 private:
  /// Numbers the triangles that have one of the given vertices, and their corners.
  void number(std::span<const std::int32_t> vertices);

  const GeodesicMesh& mesh_;
  ZeroedArray<std::int32_t> part_vertex_, part_face_;  ///< the number in the submesh plus one; 0: outside
  std::vector<std::int32_t> used_vertices_, used_faces_;
};

}  // namespace seamwire::detail
