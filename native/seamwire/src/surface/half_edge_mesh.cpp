// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/half_edge_mesh.hpp"

#include <cstdint>
#include <vector>

#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "surface/corner_fans.hpp"

namespace seamwire::detail {

// Links the half-edges directly. OpenMesh's add_face() finds edges by their end points. The slit along a cut edge has
// two edges between the same two fans, and add_face() would glue or refuse them. Half-edges can represent them. Every
// fan is one disk or half-disk by construction, so nothing here can fail.
HalfEdgeMesh half_edge_mesh(const Surface& surface) {
  using OpenMesh::FaceHandle;
  using OpenMesh::HalfedgeHandle;
  using OpenMesh::VertexHandle;

  const CornerFans& fans = corner_fans(surface);
  const auto count = static_cast<std::int32_t>(fans.twins.size());
  std::vector<HalfedgeHandle> half_edge(fans.twins.size());
  std::int32_t edge_count = 0;
  for (std::int32_t h = 0; h < count; ++h) {
    const std::int32_t twin = fans.twins[h];
    const bool is_seen = twin >= 0 && twin < h;
    half_edge[h] = HalfedgeHandle(is_seen ? half_edge[twin].idx() + 1 : 2 * edge_count++);
  }
  HalfEdgeMesh mesh;
  mesh.resize(fans.vertices.size(), index(edge_count), fans.face_count());
  for (std::int32_t fan = 0; index(fan) < fans.vertices.size(); ++fan) {
    mesh.set_point(VertexHandle(fan), surface.points()[fans.vertices[fan]]);
    mesh.set_halfedge_handle(VertexHandle(fan), half_edge[fans.leaving[fan]]);
  }
  for (std::int32_t h = 0; h < count; ++h) {
    mesh.set_vertex_handle(half_edge[h], VertexHandle(fans.tip(h)));
    mesh.set_vertex_handle(mesh.opposite_halfedge_handle(half_edge[h]), VertexHandle(fans.tail(h)));
    mesh.set_face_handle(half_edge[h], FaceHandle(h / 3));
    mesh.set_next_halfedge_handle(half_edge[h], half_edge[next_in_face(h)]);
    // OpenMesh lists a face's vertices from the tip of its half-edge on: from the first corner.
    if (h % 3 == 2) mesh.set_halfedge_handle(FaceHandle(h / 3), half_edge[h]);
  }
  // OpenMesh wants a boundary vertex to know its outgoing boundary half-edge, of which each fan has one at most.
  const auto beyond = [&](std::int32_t h) { return mesh.opposite_halfedge_handle(half_edge[h]); };
  for (std::int32_t h = 0; h < count; ++h) {
    if (fans.twins[h] < 0) mesh.set_halfedge_handle(VertexHandle(fans.tip(h)), beyond(h));
  }
  for (std::int32_t h = 0; h < count; ++h) {
    if (fans.twins[h] < 0) mesh.set_next_halfedge_handle(beyond(h), mesh.halfedge_handle(VertexHandle(fans.tail(h))));
  }
  return mesh;
}

}  // namespace seamwire::detail
