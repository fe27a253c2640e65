// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/types.hpp"

namespace seamwire {

/// Triangles that are glued along edges, without any geometry.
///
/// Half-edge 3 f + i runs from corner i to corner (i + 1) mod 3 of triangle f. A vertex may have any number of fans of
/// triangles, or no triangle.
struct SEAMWIRE_API TriangleConnectivity {
  std::vector<Triangle> triangles;  ///< vertex numbers
  /// Per half-edge: the other half-edge of its edge, which runs the opposite way, or -1.
  std::vector<std::int32_t> twins;
  /// Per half-edge: the next half-edge of the same edge, if the half-edge has no twin but the edge has other triangles.
  /// Otherwise -1. Siblings form a cycle of three or more half-edges, or of two that run the same way. Empty if there
  /// are no siblings. The term is geometry-central's (SurfaceMesh, "general" meshes).
  std::vector<std::int32_t> siblings{};

  /// Return the number of triangles.
  std::size_t face_count() const { return triangles.size(); }
  /// Return the vertex where a half-edge begins.
  ///
  /// \param half_edge the half-edge
  std::int32_t tail(std::int32_t half_edge) const { return corner(half_edge / 3, half_edge % 3); }
  /// Return the vertex where a half-edge ends.
  ///
  /// \param half_edge the half-edge
  std::int32_t tip(std::int32_t half_edge) const { return corner(half_edge / 3, (half_edge + 1) % 3); }
  /// Return the vertex opposite to a half-edge, in its triangle.
  ///
  /// \param half_edge the half-edge
  std::int32_t apex(std::int32_t half_edge) const { return corner(half_edge / 3, (half_edge + 2) % 3); }
  /// Return whether a half-edge has siblings.
  ///
  /// \param half_edge the half-edge
  bool has_siblings(std::int32_t half_edge) const {
    return !siblings.empty() && siblings[static_cast<std::size_t>(half_edge)] >= 0;
  }
  /// Call a function for each other half-edge of the same edge: its twin, or its siblings in the order of their cycle.
  ///
  /// \param half_edge the half-edge
  /// \param visit called as visit(other)
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
  /// Return the Euler characteristic V - E + F. Siblings count as separate edges.
  ///
  /// \param vertex_count V, which the triangles alone do not tell
  std::int64_t euler_characteristic(std::size_t vertex_count) const;
  /// Find the boundary loops.
  ///
  /// \param vertex_count the number of vertices. At most one boundary half-edge begins at each of them.
  /// \returns for each loop its vertices in the direction of the triangles along it, beginning with the smallest. Loops
  ///          are ordered by their smallest vertex.
  std::vector<std::vector<std::int32_t>> boundary_loops(std::size_t vertex_count) const;

 private:
  std::int32_t corner(std::int32_t face, std::int32_t i) const {
    return triangles[static_cast<std::size_t>(face)][static_cast<std::size_t>(i)];
  }
};

}  // namespace seamwire
