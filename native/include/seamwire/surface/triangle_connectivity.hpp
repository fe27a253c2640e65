// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/types.hpp"

namespace seamwire {

/// Triangles that are glued along edges, without any geometry. Half-edge 3 f + i runs from corner i of triangle f to
/// the next corner. A vertex may have any number of fans of triangles, or none.
struct SEAMWIRE_API TriangleConnectivity {
  std::vector<Triangle> triangles;  ///< vertex numbers
  /// Per half-edge: the other half-edge of its edge, which runs the opposite way; -1 if it has none.
  std::vector<std::int32_t> twins;
  /// Per half-edge without a twin whose edge has other triangles: the next half-edge of the same edge, in a cycle
  /// through all of them. They are three or more, or two that run the same way. -1 for every other half-edge. Empty if
  /// there are no such edges. The term is geometry-central's (SurfaceMesh, "general" meshes).
  std::vector<std::int32_t> siblings{};

  /// The number of triangles.
  std::size_t face_count() const { return triangles.size(); }
  /// The vertex that a half-edge begins at.
  std::int32_t tail(std::int32_t half_edge) const { return corner(half_edge / 3, half_edge % 3); }
  /// The vertex that a half-edge ends at.
  std::int32_t tip(std::int32_t half_edge) const { return corner(half_edge / 3, (half_edge + 1) % 3); }
  /// The vertex opposite to a half-edge, in its triangle.
  std::int32_t apex(std::int32_t half_edge) const { return corner(half_edge / 3, (half_edge + 2) % 3); }
  /// Whether a half-edge has siblings.
  bool has_siblings(std::int32_t half_edge) const {
    return !siblings.empty() && siblings[static_cast<std::size_t>(half_edge)] >= 0;
  }
  /// Calls visit(other) for each other half-edge of a half-edge's edge: its twin, or its siblings in their order.
  template <class Visit>
  void for_each_beyond(std::int32_t half_edge, const Visit& visit) const {
    const std::int32_t twin = twins[static_cast<std::size_t>(half_edge)];
    if (twin >= 0) visit(twin);
    if (!has_siblings(half_edge)) return;
    for (std::int32_t other = siblings[static_cast<std::size_t>(half_edge)]; other != half_edge;
         other = siblings[static_cast<std::size_t>(other)]) {
      visit(other);
    }
  }
  /// V - E + F, the Euler characteristic, of a mesh of that many vertices without siblings.
  std::int64_t euler_characteristic(std::size_t vertex_count) const;
  /// The boundary loops: vertices in the direction of the triangles along them. At most one boundary half-edge may
  /// begin at each of the `vertex_count` vertices. The loops are ordered by their smallest vertex, with which each
  /// begins.
  std::vector<std::vector<std::int32_t>> boundary_loops(std::size_t vertex_count) const;

 private:
  std::int32_t corner(std::int32_t face, std::int32_t i) const {
    return triangles[static_cast<std::size_t>(face)][static_cast<std::size_t>(i)];
  }
};

}  // namespace seamwire
