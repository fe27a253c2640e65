// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "detail/prefetch.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"

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
    double left_length, right_length;  ///< of tail-apex and of tip-apex
    std::int32_t tail, tip, apex;
    std::int32_t left, right;  ///< the half-edge a path enters next over tail-apex, over tip-apex; -1 on the boundary
  };
  static_assert(sizeof(HalfEdge) == 64);

  struct Loose {
    std::int32_t to;
    double length;
  };
  /// A straight way to a vertex nearby, along an edge or over one, through two triangles; in single precision, and in a
  /// unit that is not that of lengths where these are huge or tiny: for a first look at where to go.
  struct Step {
    std::int32_t to;
    float length;
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
  /// The steps from a vertex: along each of its edges, those without a face too, and over the edges opposite to it
  /// where that is a shortcut. Without the latter a regular mesh has directions that are up to 41 % too long.
  std::span<const Step> steps(std::int32_t vertex) const { return row(steps_, first_step_, vertex); }
  float mean_step() const { return mean_step_; }
  float longest_step() const { return longest_step_; }
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
  friend class MeshCutter;
  GeodesicMesh() = default;
  void renumber(const IntrinsicMesh& mesh, std::vector<std::int32_t>& own_face);
  void list_out(const std::vector<Triangle>& corners);
  double unit_of_steps() const;
  void list_steps();
  void find_bending_vertices();

  std::vector<HalfEdge> half_edges_;
  std::vector<double> angle_;
  std::vector<std::int32_t> out_, first_out_;
  std::vector<Loose> loose_;
  std::vector<std::int32_t> first_loose_;
  std::vector<Step> steps_;
  std::vector<std::int32_t> first_step_;
  float mean_step_ = 0.0F, longest_step_ = 0.0F;
  std::vector<std::uint8_t> bends_paths_;
  std::vector<std::int32_t> original_vertex_, own_vertex_, original_face_;
};

/// Triangles of a mesh as a mesh of their own, without steps(): its caller is whoever cut it, so it has no other
/// numbers. Paths may bend at its border as at any other; on the whole mesh they are paths all the same.
struct MeshPart {
  std::shared_ptr<const GeodesicMesh> mesh;
  std::vector<std::int32_t> vertices, faces;  ///< the whole mesh's, for each of the part's
};

/// Cuts parts out of a mesh in time proportional to their size; it has to outlive the cutter.
class MeshCutter {
 public:
  explicit MeshCutter(const GeodesicMesh& mesh)
      : mesh_(mesh), part_vertex_(mesh.vertex_count()), part_face_(mesh.half_edge_count() / 3) {}

  /// The triangles that have one of the given vertices, and the loose edges between these.
  MeshPart cut(std::span<const std::int32_t> vertices);
  /// In the last part cut, -1 outside of it.
  std::int32_t part_vertex(std::int32_t vertex) const { return part_vertex_[vertex] - 1; }

 private:
  /// Zeros that take no time: memory that the system hands out, when it is first touched, is zero.
  class Numbers {
   public:
    explicit Numbers(std::size_t count);
    std::int32_t& operator[](std::int32_t i) { return memory_[static_cast<std::size_t>(i)]; }
    std::int32_t operator[](std::int32_t i) const { return memory_[static_cast<std::size_t>(i)]; }

   private:
    struct Free {
      void operator()(std::int32_t* memory) const { std::free(memory); }
    };
    std::unique_ptr<std::int32_t[], Free> memory_;
  };

  const GeodesicMesh& mesh_;
  Numbers part_vertex_, part_face_;  ///< and one; 0: outside
  std::vector<std::int32_t> used_vertices_, used_faces_;
};

}  // namespace seamwire
