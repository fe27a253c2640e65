// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "detail/csr.hpp"
#include "detail/half_edge.hpp"
#include "detail/paged_array.hpp"
#include "detail/prefetch.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// The mesh as the wavefront reads it: every triangle unfolded into the frame of each of its half-edges, in one cache
/// line each. Vertices and faces are renumbered breadth first, so that a front touches memory that lies together: they
/// have an internal number here, and an external one in the IntrinsicMesh. All numbers are internal unless a comment
/// says otherwise.
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
    /// The half-edge a path enters next over tail-apex, over tip-apex; -1 on the boundary and where it has siblings.
    std::int32_t left, right;
  };
  static_assert(sizeof(HalfEdge) == 64);

  struct Loose {
    std::int32_t to;
    double length;
  };
  /// A straight line to a vertex nearby, along an edge, or over one through two triangles. Lengths are in single
  /// precision, and where those of the mesh are huge or tiny, in another unit: they say where to look for a path.
  struct Hop {
    std::int32_t to;
    float length;
  };

  /// Throws as ExactGeodesics does.
  explicit GeodesicMesh(const IntrinsicMesh& mesh, const Task& task = {});

  /// Makes the mesh anew after a change. `before` is the IntrinsicMesh that this one was made of, `mesh` the new one.
  /// Most faces and vertices, by their numbers, should be the same in both. They are shared, and only the others are
  /// made anew. The time is that of comparing the two and of copying the hops. The result equals one made from scratch,
  /// except for internal numbers; faces and vertices that keep their external number mostly keep the internal one.
  ///
  /// Nothing if too much has changed, if loose edges have changed, if edges have siblings, or if lengths are huge or
  /// tiny. Throws as the constructor does.
  std::optional<GeodesicMesh> patched(const IntrinsicMesh& before, const IntrinsicMesh& mesh,
                                      const Task& task = {}) const;

  std::size_t vertex_count() const { return external_vertex_.size(); }
  const HalfEdge& half_edge(std::int32_t h) const { return half_edges_[index(h)]; }
  std::size_t half_edge_count() const { return half_edges_.size(); }
  /// The twin of h, -1 if it has none.
  std::int32_t twin(std::int32_t h) const { return half_edge(previous_in_face(h)).right; }
  /// The next half-edge of h's edge among siblings (IntrinsicMesh::siblings), -1 if h has none.
  std::int32_t sibling(std::int32_t h) const { return siblings_.empty() ? -1 : siblings_[index(h)]; }
  bool has_siblings() const { return !siblings_.empty(); }
  /// Calls see(other) for each other half-edge of h's edge: its twin, or its siblings. A path that leaves the face of h
  /// over that edge enters one of their faces.
  template <class See>
  void for_each_beyond(std::int32_t h, const See& see) const {
    if (const std::int32_t other = twin(h); other >= 0) {
      see(other);
      return;
    }
    const std::int32_t first = sibling(h);
    if (first < 0) return;
    for (std::int32_t other = first; other != h; other = sibling(other)) see(other);
  }
  /// Whether two half-edges of an edge run the same way. A path from the face of one continues in the face of the other
  /// as its mirror image: x becomes length - x.
  bool is_mirrored(std::int32_t h, std::int32_t beyond) const {
    return twin(h) < 0 && half_edge(h).tail == half_edge(beyond).tail;
  }

  /// The angle at the tail of h in its triangle.
  double angle(std::int32_t h) const { return angle_[index(h)]; }

  /// Half-edges that leave a vertex, of all its umbrellas.
  std::span<const std::int32_t> out(std::int32_t vertex) const { return out_[vertex]; }
  std::span<const Loose> loose(std::int32_t vertex) const { return loose_[vertex]; }
  /// Calls see(to, h, length) for each edge of a vertex, once for each of its half-edges without a twin; h is a
  /// half-edge of it, -1 for an edge without a face.
  template <class See>
  void for_each_edge(std::int32_t vertex, const See& see) const {
    for (const std::int32_t h : out(vertex)) {
      const HalfEdge& edge = half_edge(h);
      see(edge.tip, h, edge.length);
      if (edge.left < 0) see(edge.apex, previous_in_face(h), edge.left_length);  // else that of the corner beside
    }
    for (const auto& [to, length] : loose(vertex)) see(to, -1, length);
  }
  /// The hops from a vertex: along each of its edges, those without a face too, and over the edges opposite to it where
  /// that is a shortcut. Without the latter, distances along hops on a regular mesh are up to 41 % too long.
  std::span<const Hop> hops(std::int32_t vertex) const { return hops_[vertex]; }
  float mean_hop() const { return mean_hop_; }
  float longest_hop() const { return longest_hop_; }
  /// Shortest paths may bend here: a total angle of more than 2 pi, a boundary, several umbrellas, or a loose edge.
  bool is_pseudo_source(std::int32_t vertex) const { return is_pseudo_source_[vertex] != 0; }
  /// Whether an edge of the vertex has siblings. Then it is a pseudo-source too.
  bool is_branching(std::int32_t vertex) const { return (is_pseudo_source_[vertex] & kBranching) != 0; }

  /// From internal numbers to those of the IntrinsicMesh, and back.
  std::int32_t external_vertex(std::int32_t v) const { return external_vertex_[v]; }
  std::int32_t internal_vertex(std::int32_t external) const { return internal_vertex_[external]; }
  std::int32_t internal_face(std::int32_t external) const { return internal_face_[external]; }
  std::int32_t external_half_edge(std::int32_t h) const { return 3 * external_face_[h / 3] + h % 3; }
  /// Whether a half-edge is in the memory of another mesh, which this one was patched from, or it from this one.
  bool shares(const GeodesicMesh& other, std::int32_t h) const {
    return half_edges_.shares(other.half_edges_, index(h));
  }

 private:
  friend class SubmeshCutter;
  GeodesicMesh() = default;
  void renumber(const IntrinsicMesh& mesh, std::vector<std::int32_t>& internal_face, const Task& task);
  static Csr<std::int32_t> leaving(std::size_t vertex_count, const std::vector<Triangle>& corners,
                                   const Task& task = {});
  void set_face(const IntrinsicMesh& mesh, std::int32_t external);
  void list_loose_edges(const IntrinsicMesh& mesh);
  template <class Add>
  void each_hop(std::int32_t vertex, const Add& add) const;
  void list_hops(const IntrinsicMesh& mesh, const Task& task);
  /// Finds the mean and the longest of all hops.
  void measure_hops();
  void patch_rows(const GeodesicMesh& former, const std::vector<std::int32_t>& faces,
                  const std::vector<std::int32_t>& vertices);
  bool may_bend(std::int32_t vertex) const;
  void set_siblings(const IntrinsicMesh& mesh);
  void find_pseudo_sources(const Task& task);

  static constexpr std::uint8_t kPseudoSource = 1, kBranching = 2;

  PagedArray<HalfEdge> half_edges_;
  PagedArray<double> angle_;
  Csr<std::int32_t> out_;
  Csr<Loose> loose_;
  Csr<Hop> hops_;
  double hop_unit_ = 1.0;
  float mean_hop_ = 0.0F, longest_hop_ = 0.0F;
  std::vector<std::uint8_t> is_pseudo_source_;  ///< 0, kPseudoSource, or that and kBranching
  std::vector<std::int32_t> siblings_;          ///< empty without any
  std::vector<std::int32_t> external_vertex_, internal_vertex_, external_face_, internal_face_;
};

}  // namespace seamwire::detail
