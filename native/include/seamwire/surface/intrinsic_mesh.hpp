// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "seamwire/surface/types.hpp"

namespace seamwire {

/// An edge without a face, along which a path may run.
struct LooseEdge {
  std::int32_t a;  ///< one end
  std::int32_t b;  ///< the other end
  double length;   ///< finite, 0 or more; 0 between vertices at the same place
};

/// Triangles glued along edges, known by their edge lengths alone.
///
/// Half-edge 3 f + i runs from corner i to corner (i + 1) mod 3 of triangle f. A vertex may have any number of fans of
/// triangles, or no triangle. Twins have the same orientation. Triangles at other edges may have any orientation, and
/// there may be any number of them.
struct IntrinsicMesh {
  std::int32_t vertex_count = 0;    ///< number of vertices, with or without triangles
  std::vector<Triangle> triangles;  ///< vertex numbers
  std::vector<std::int32_t> twins;  ///< per half-edge: the other half-edge of its edge, or -1
  /// Per half-edge: the next half-edge of the same edge, if the half-edge has no twin but the edge has other triangles.
  /// Otherwise -1. Siblings form a cycle of three or more half-edges, or of two that run the same way. Empty if there
  /// are no siblings. The term is geometry-central's (SurfaceMesh, "general" meshes).
  std::vector<std::int32_t> siblings{};
  /// Per half-edge: its length, above 0. It is the same for all half-edges of an edge. Each triangle satisfies the
  /// triangle inequality.
  std::vector<double> lengths;
  std::vector<LooseEdge> loose_edges;  ///< edges without a triangle

  /// Return the number of triangles.
  std::size_t face_count() const { return triangles.size(); }
  /// Return the vertex where a half-edge begins.
  std::int32_t tail(std::int32_t half_edge) const { return corner(half_edge / 3, half_edge % 3); }
  /// Return the vertex where a half-edge ends.
  std::int32_t tip(std::int32_t half_edge) const { return corner(half_edge / 3, (half_edge % 3 + 1) % 3); }
  /// Return the vertex opposite to a half-edge, in its triangle.
  std::int32_t apex(std::int32_t half_edge) const { return corner(half_edge / 3, (half_edge % 3 + 2) % 3); }
  /// Call a function for each other half-edge of the same edge: its twin, or its siblings.
  ///
  /// \param half_edge the half-edge
  /// \param visit called as visit(other)
  template <class Visit>
  void for_each_beyond(std::int32_t half_edge, const Visit& visit) const {
    const auto h = static_cast<std::size_t>(half_edge);
    if (twins[h] >= 0) visit(twins[h]);
    if (siblings.empty() || siblings[h] < 0) return;
    for (auto other = siblings[h]; other != half_edge; other = siblings[static_cast<std::size_t>(other)]) visit(other);
  }
  /// Return whether a half-edge has siblings.
  bool has_siblings(std::int32_t half_edge) const {
    return !siblings.empty() && siblings[static_cast<std::size_t>(half_edge)] >= 0;
  }

 private:
  std::int32_t corner(std::int32_t face, std::int32_t i) const {
    return triangles[static_cast<std::size_t>(face)][static_cast<std::size_t>(i)];
  }
};

}  // namespace seamwire
