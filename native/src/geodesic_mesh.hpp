// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/intrinsic_mesh.hpp"

namespace seamwire {

/// What the wavefront reads: every triangle unfolded into the frame of each of its half-edges, in one cache line each.
/// Vertices and faces are renumbered breadth first, so that a front touches memory that lies together.
///
/// The frame of a half-edge has its tail at the origin, its tip at (length, 0), its own triangle above and the triangle
/// that paths come from below.
class GeodesicMesh {
 public:
  struct alignas(64) HalfEdge {
    double length;
    double apex_x, apex_y;
    double left_inverse, right_inverse;  ///< one over the lengths of tail-apex and of tip-apex
    std::int32_t tail, tip, apex;
    std::int32_t left, right;  ///< the half-edge a path enters next over tail-apex, over tip-apex; -1 on the boundary
  };
  static_assert(sizeof(HalfEdge) == 64);

  struct Loose {
    std::int32_t to;
    double length;
  };

  /// Throws as ExactGeodesics does.
  explicit GeodesicMesh(const IntrinsicMesh& mesh);

  std::size_t vertex_count() const { return original_vertex_.size(); }
  const HalfEdge& half_edge(std::int32_t h) const { return half_edges_[static_cast<std::size_t>(h)]; }
  std::size_t half_edge_count() const { return half_edges_.size(); }
  static std::int32_t next(std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::int32_t previous(std::int32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  /// The other half-edge of h's edge, -1 on the boundary.
  std::int32_t twin(std::int32_t h) const { return half_edge(previous(h)).right; }

  /// The angle at the tail of h in its triangle.
  double angle(std::int32_t h) const { return angle_[static_cast<std::size_t>(h)]; }

  /// Half-edges that leave a vertex, of all its fans.
  std::span<const std::int32_t> out(std::int32_t vertex) const { return row(out_, first_out_, vertex); }
  std::span<const Loose> loose(std::int32_t vertex) const { return row(loose_, first_loose_, vertex); }
  /// Shortest paths may bend here: more than 2 pi around it, a boundary, several fans, or a loose edge.
  bool bends_paths(std::int32_t vertex) const { return bends_paths_[static_cast<std::size_t>(vertex)] != 0; }

  /// The caller's numbers, and the way back.
  std::int32_t original_vertex(std::int32_t v) const { return original_vertex_[static_cast<std::size_t>(v)]; }
  std::int32_t own_vertex(std::int32_t original) const { return own_vertex_[static_cast<std::size_t>(original)]; }
  std::int32_t original_half_edge(std::int32_t h) const {
    return 3 * original_face_[static_cast<std::size_t>(h / 3)] + h % 3;
  }

 private:
  template <class T>
  static std::span<const T> row(const std::vector<T>& items, const std::vector<std::int32_t>& first, std::int32_t i) {
    const auto index = static_cast<std::size_t>(i);
    const auto begin = static_cast<std::size_t>(first[index]), end = static_cast<std::size_t>(first[index + 1]);
    return {items.data() + begin, end - begin};
  }
  void renumber(const IntrinsicMesh& mesh);
  void find_bending_vertices();

  std::vector<HalfEdge> half_edges_;
  std::vector<double> angle_;
  std::vector<std::int32_t> out_, first_out_;
  std::vector<Loose> loose_;
  std::vector<std::int32_t> first_loose_;
  std::vector<std::uint8_t> bends_paths_;
  std::vector<std::int32_t> original_vertex_, own_vertex_, original_face_;
};

}  // namespace seamwire
