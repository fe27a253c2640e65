// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "detail/computed_once.hpp"
#include "detail/half_edge.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/triangle_connectivity.hpp"

namespace seamwire::detail {

/// The mesh inside a Surface without those triangles without an area that could be removed.
struct CleanedFans : TriangleConnectivity {
  std::vector<std::int32_t> origins;  ///< per triangle: that of CornerFans that it was
  /// Pairs of an origin and a triangle, ascending. A triangle that was removed gives its place to its neighbor.
  std::vector<std::pair<std::int32_t, std::int32_t>> by_origin;
  std::vector<std::int32_t> vertices;  ///< as CornerFans::vertices, with the second one of merged vertices
  /// Pairs of vertices at one place that were merged: triangles have the second one only.
  std::vector<Edge> merged;
  std::vector<std::int32_t> degenerate;  ///< the origins of the triangles without an area that are left, ascending
};

/// The mesh inside a Surface: manifold and consistently oriented. Where the caller's mesh is not, this mesh is cut
/// open. Its vertices are corner fans: a vertex whose faces form several fans is here once for each fan. Siblings are
/// the half-edges at edges where it is cut open. Triangles begin at the caller's first corner. Two edges may join the
/// same two fans (a slit one edge long), so find half-edges by walking, never by their end points.
struct CornerFans : TriangleConnectivity {
  /// The caller's vertex of each fan, ascending: the identity on a clean mesh. A vertex without a face has no fan.
  std::vector<std::int32_t> vertices;
  std::vector<std::int32_t> faces;    ///< the caller's face of each triangle, ascending
  std::vector<std::int32_t> leaving;  ///< of each fan: its half-edge in its last triangle
  /// For cleaned_fans() (embedding/degenerate_faces.hpp): every embedding of the surface needs them.
  std::shared_ptr<ComputedOnce<CleanedFans>> cleaned = std::make_shared<ComputedOnce<CleanedFans>>();

  /// Calls visit(h) for each half-edge h of triangles that begins at a fan, counter-clockwise: from the boundary on, or
  /// from leaving[fan] on. Returns whether the fan has a boundary.
  template <class Visit>
  bool for_each_leaving(std::int32_t fan, const Visit& visit) const {
    const std::int32_t start = last(leaving[fan], [&](std::int32_t h) { return clockwise(h); });
    std::int32_t h = start;
    do {
      visit(h);
      h = counter_clockwise(h);
    } while (h >= 0 && h != start);
    return h < 0;
  }

  /// Calls visit(h) for the same half-edges clockwise: from the boundary on, or from leaving[fan] on. Before the
  /// others, calls at_boundary(v) for the vertex at the end of the boundary edge that no half-edge runs along from the
  /// fan.
  template <class Visit, class AtBoundary>
  void for_each_leaving_clockwise(std::int32_t fan, const Visit& visit, const AtBoundary& at_boundary) const {
    const std::int32_t start = last(leaving[fan], [&](std::int32_t h) { return counter_clockwise(h); });
    if (counter_clockwise(start) < 0) at_boundary(apex(start));
    std::int32_t h = start;
    do {
      visit(h);
      h = clockwise(h);
    } while (h >= 0 && h != start);
  }

 private:
  /// The next half-edge that begins at the same fan, -1 beyond the boundary.
  std::int32_t clockwise(std::int32_t h) const { return twins[h] < 0 ? -1 : next_in_face(twins[h]); }
  std::int32_t counter_clockwise(std::int32_t h) const { return twins[previous_in_face(h)]; }

  /// The last half-edge before the boundary, or `start` if there is no boundary.
  template <class Turn>
  static std::int32_t last(std::int32_t start, const Turn& turn) {
    for (std::int32_t h = start;;) {
      const std::int32_t next = turn(h);
      if (next < 0) return h;
      if (next == start) return start;
      h = next;
    }
  }
};

/// The mesh inside a surface.
inline const CornerFans& corner_fans(const Surface& surface) { return *surface.fans_; }

}  // namespace seamwire::detail
