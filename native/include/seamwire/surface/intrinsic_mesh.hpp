// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "seamwire/surface/types.hpp"

namespace seamwire {

/// An edge without a face, along which a path may run. Its length is finite and not negative: it is 0 between vertices
/// at the same place.
struct LooseEdge {
  std::int32_t a;  ///< one end
  std::int32_t b;  ///< the other one
  double length;   ///< 0 or more
};

/// Triangles glued along edges, known by their edge lengths alone. Half-edge 3 f + i runs from corner i to corner i + 1
/// (mod 3) of triangle f. A vertex may have any number of fans of triangles, or none. Twins are oriented alike; the
/// triangles at any other edge may be oriented in any way, and there may be any number of them.
struct IntrinsicMesh {
  std::int32_t vertex_count = 0;    ///< in triangles or not
  std::vector<Triangle> triangles;  ///< vertex numbers
  std::vector<std::int32_t> twins;  ///< per half-edge: the other half-edge of its edge, -1 if it has none
  /// Per half-edge without a twin whose edge has other triangles: the next half-edge of the same edge, in a cycle
  /// through all of them. They are three or more, or two that run the same way. -1 for every other half-edge. Empty if
  /// there are no such edges. The term is geometry-central's (SurfaceMesh, "general" meshes).
  std::vector<std::int32_t> siblings{};
  std::vector<double> lengths;  ///< per half-edge, positive, the same for all half-edges of an edge; each triangle
                                ///< fulfils the triangle inequality
  std::vector<LooseEdge> loose_edges;  ///< edges without a triangle

  /// The number of triangles.
  std::size_t face_count() const { return triangles.size(); }
  /// The vertex that a half-edge begins at.
  std::int32_t tail(std::int32_t half_edge) const { return corner(half_edge / 3, half_edge % 3); }
  /// The vertex that a half-edge ends at.
  std::int32_t tip(std::int32_t half_edge) const { return corner(half_edge / 3, (half_edge % 3 + 1) % 3); }
  /// The vertex opposite to a half-edge, in its triangle.
  std::int32_t apex(std::int32_t half_edge) const { return corner(half_edge / 3, (half_edge % 3 + 2) % 3); }
  /// Calls visit(other) for each other half-edge of a half-edge's edge: its twin, or its siblings.
  template <class Visit>
  void for_each_beyond(std::int32_t half_edge, const Visit& visit) const {
    const auto h = static_cast<std::size_t>(half_edge);
    if (twins[h] >= 0) visit(twins[h]);
    if (siblings.empty() || siblings[h] < 0) return;
    for (auto other = siblings[h]; other != half_edge; other = siblings[static_cast<std::size_t>(other)]) visit(other);
  }
  /// Whether a half-edge has siblings.
  bool has_siblings(std::int32_t half_edge) const {
    return !siblings.empty() && siblings[static_cast<std::size_t>(half_edge)] >= 0;
  }

 private:
  std::int32_t corner(std::int32_t face, std::int32_t i) const {
    return triangles[static_cast<std::size_t>(face)][static_cast<std::size_t>(i)];
  }
};

}  // namespace seamwire
