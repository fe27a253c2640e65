// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "seamwire/metric/metric.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/surface/surface.hpp"
#include "surface/half_edge_mesh.hpp"

namespace seamwire::detail {

/// OpenMesh's half-edges, but for those of deleted faces, in the order of faces, each from its first corner on, as
/// OpenMesh lists them.
std::vector<HalfEdgeMesh::HalfedgeHandle> half_edges_of_faces(const HalfEdgeMesh& mesh);

/// A surface's corner fans without those degenerate faces that could be removed.
struct CleanMesh {
  HalfEdgeMesh mesh;
  std::vector<std::int32_t> origins;  ///< the surface's half-edge face of each face left, in the order of the faces
  /// Between vertices at one place that were merged: faces have the second one only.
  std::vector<LooseEdge> merged;
  std::vector<std::int32_t> vertex_of_fan;  ///< as CornerFans::vertices, with the second one of merged vertices
  /// Per edge of the mesh: half-edges with equal numbers and ends are of one edge of the surface, as its siblings are,
  /// or of two that a needle has joined. Empty if the surface has no siblings.
  std::vector<std::int32_t> names;
  std::vector<std::int32_t> degenerate;  ///< the origins of the degenerate faces left, ascending
};

/// Removes degenerate faces (SurfaceReport::zero_area_faces) in OpenMesh's half-edge mesh. They have no area, so no
/// path can cross them.
///
/// Needles are removed by collapsing their shortest edge, which has no length. Caps are removed by flipping their
/// longest edge. An edge is collapsed in all corner fans of the vertex that goes, so edges of three or more faces stay
/// joined. Faces that allow neither stay. Returns nullopt if the surface has no degenerate face.
std::optional<CleanMesh> remove_degenerate_faces(const Surface& surface, const Metric& metric);

}  // namespace seamwire::detail
