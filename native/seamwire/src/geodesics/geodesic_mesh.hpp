// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "detail/always_inline.hpp"
#include "detail/csr.hpp"
#include "detail/half_edge.hpp"
#include "detail/paged_array.hpp"
#include "detail/prefetch.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Throws InvalidInput as the constructor of ExactGeodesics does; Cancelled. It takes the first tenth of the task.
void check_mesh(const IntrinsicMesh& mesh, const Task& task);

/// The mesh as the wavefront reads it: a triangle is one cache line, from which it is unfolded into the frame of each
/// of its half-edges. Vertices and faces are renumbered breadth first, so that a front touches memory that lies
/// together: they have an internal number here, and an external one in the IntrinsicMesh. All numbers are internal
/// unless a comment says otherwise.
///
/// The frame of a half-edge has its tail at the origin, its tip at (length, 0), its own triangle above and the triangle
/// that paths come from below.
class GeodesicMesh {
 public:
  struct HalfEdge {
    double length;
    double apex_x, apex_y;
    double left_length, right_length;  ///< of tail-apex and of tip-apex
    std::int32_t tail, tip, apex;
    /// The half-edge a path enters next over tail-apex, over tip-apex; -1 on the boundary and where it has siblings.
    std::int32_t left, right;
  };

  struct Loose {
    std::int32_t to;
    double length;
  };

  /// Throws as ExactGeodesics does.
  explicit GeodesicMesh(const IntrinsicMesh& mesh, const Task& task);

  /// Makes the mesh anew after a change. `before` is the IntrinsicMesh that this one was made of, `mesh` the new one.
  /// Most faces and vertices, by their numbers, should be the same in both. They are shared, and only the others are
  /// made anew. The time is that of comparing the two. The result equals one made from scratch, except for internal
  /// numbers; faces and vertices that keep their external number mostly keep the internal one.
  ///
  /// Nothing if too much has changed, if loose edges have changed, or if edges have siblings. Throws as the constructor
  /// does.
  std::optional<GeodesicMesh> patched(const IntrinsicMesh& before, const IntrinsicMesh& mesh, const Task& task) const;

  std::size_t vertex_count() const { return external_vertex_.size(); }
  HalfEdge half_edge(std::int32_t h) const;
  /// Asks memory for a half-edge in advance.
  void prefetch_half_edge(std::int32_t h) const { prefetch(&faces_[index(h / 3)]); }
  std::size_t half_edge_count() const { return 3 * faces_.size(); }
  /// The twin of h, -1 if it has none.
  std::int32_t twin(std::int32_t h) const { return faces_[index(h / 3)].twins[index(h % 3)]; }
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
  double angle(std::int32_t h) const {
    const HalfEdge edge = half_edge(h);
    return std::atan2(edge.apex_y, edge.apex_x);
  }

  /// Half-edges that leave a vertex, of all its umbrellas.
  std::span<const std::int32_t> out(std::int32_t vertex) const { return out_[vertex]; }
  std::span<const Loose> loose(std::int32_t vertex) const { return loose_[vertex]; }
  /// Calls see(to, h, length) for each edge of a vertex, once for each of its half-edges without a twin; h is a
  /// half-edge of it, -1 for an edge without a face.
  template <class See>
  void for_each_edge(std::int32_t vertex, const See& see) const {
    for (const std::int32_t h : out(vertex)) {
      const HalfEdge edge = half_edge(h);
      see(edge.tip, h, edge.length);
      if (edge.left < 0) see(edge.apex, previous_in_face(h), edge.left_length);  // else that of the corner beside
    }
    for (const auto& [to, length] : loose(vertex)) see(to, -1, length);
  }
  /// Calls see(to, length) for each hop from a vertex. Hops are straight lines along each of its edges, those without a
  /// face too, and over the edges opposite to it where that is a shortcut. Without the latter, distances along hops on
  /// a regular mesh are up to 41 % too long.
  ///
  /// Lengths are in single precision, and where those of the mesh are huge or tiny, in another unit: they say where to
  /// look for a path.
  template <class See>
  void for_each_hop(std::int32_t vertex, const See& see) const;
  /// In the unit of hops: the mean length of edges, and a length that no hop exceeds.
  float mean_edge() const { return mean_edge_; }
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
  bool shares(const GeodesicMesh& other, std::int32_t h) const { return faces_.shares(other.faces_, index(h / 3)); }

 private:
  friend class SubmeshCutter;
  /// A triangle. Item i belongs to its half-edge i, or to that one's tail. The frames are not kept: the memory that
  /// they take costs more than the divisions.
  struct alignas(64) Face {
    std::array<double, 3> lengths;
    double four_areas;
    std::array<std::int32_t, 3> corners, twins;
  };
  static_assert(sizeof(Face) == 64);

  GeodesicMesh() = default;
  void renumber(const IntrinsicMesh& mesh, const Task& task);
  static Csr<std::int32_t> leaving(std::size_t vertex_count, const std::vector<Triangle>& corners, const Task& task);
  void set_face(const IntrinsicMesh& mesh, std::int32_t external);
  void list_loose_edges(const IntrinsicMesh& mesh);
  /// Chooses the unit of hops, and measures edges in it.
  void measure_edges();
  void patch_rows(const GeodesicMesh& former, const std::vector<std::int32_t>& faces,
                  const std::vector<std::int32_t>& vertices);
  bool may_bend(std::int32_t vertex) const;
  void set_siblings(const IntrinsicMesh& mesh);
  void find_pseudo_sources(const Task& task);

  static constexpr std::uint8_t kPseudoSource = 1, kBranching = 2;
  /// There is a hop over an edge if it is shorter than this part of the path along two edges.
  static constexpr double kShortcut = 0.95;

  PagedArray<Face> faces_;
  Csr<std::int32_t> out_;
  Csr<Loose> loose_;
  double hop_unit_ = 1.0;
  float mean_edge_ = 0.0F, longest_hop_ = 0.0F;
  std::vector<std::uint8_t> is_pseudo_source_;  ///< 0, kPseudoSource, or that and kBranching
  std::vector<std::int32_t> siblings_;          ///< empty without any
  std::vector<std::int32_t> external_vertex_, internal_vertex_, external_face_, internal_face_;
};

// Inline, so that callers compute only what they read.

/// Where the apex stands over the base, from its tail: (left^2 + base^2 - right^2) / (2 base), with the difference
/// taken between the two that are nearest to each other.
SEAMWIRE_INLINE double foot(double base, double left, double right) {
  const double square = std::abs(base - right) < std::abs(left - right) ? left * left + (base - right) * (base + right)
                                                                        : base * base + (left - right) * (left + right);
  return square / (2 * base);
}

SEAMWIRE_INLINE GeodesicMesh::HalfEdge GeodesicMesh::half_edge(std::int32_t h) const {
  const Face& face = faces_[index(h / 3)];
  const std::size_t i = index(h % 3), after = i == 2 ? 0 : i + 1, before = i == 0 ? 2 : i - 1;
  const double length = face.lengths[i], left = face.lengths[before], right = face.lengths[after];
  return {.length = length,
          .apex_x = foot(length, left, right),
          .apex_y = face.four_areas / (2 * length),
          .left_length = left,
          .right_length = right,
          .tail = face.corners[i],
          .tip = face.corners[after],
          .apex = face.corners[before],
          .left = face.twins[before],
          .right = face.twins[after]};
}

template <class See>
void GeodesicMesh::for_each_hop(std::int32_t vertex, const See& see) const {
  const auto hop = [&](std::int32_t to, double length) { see(to, static_cast<float>(length * hop_unit_)); };
  for (const std::int32_t h : out(vertex)) {
    const HalfEdge edge = half_edge(h);
    hop(edge.tip, edge.length);
    // On the boundary no half-edge leaves the vertex along the edge that arrives here.
    if (edge.left < 0) hop(edge.apex, edge.left_length);
    // Over the opposite edge, from below it in the frame of the half-edge entered.
    const std::int32_t opposite = next_in_face(h);
    const HalfEdge back = half_edge(opposite);
    for_each_beyond(opposite, [&](std::int32_t entered) {
      const HalfEdge over = half_edge(entered);
      const bool is_turned = is_mirrored(opposite, entered);
      const double x = is_turned ? back.apex_x : over.length - back.apex_x, y = -back.apex_y;
      const double dx = over.apex_x - x, dy = over.apex_y - y, foot = x * dy - dx * y;  // times dy, which is positive
      if (!(foot > 0 && foot < over.length * dy)) return;
      const double length = std::sqrt(dx * dx + dy * dy);
      const double around = is_turned ? std::min(edge.length + over.left_length, edge.left_length + over.right_length)
                                      : std::min(edge.length + over.right_length, edge.left_length + over.left_length);
      if (length < kShortcut * around) hop(over.apex, length);
    });
  }
  for (const auto& [to, length] : loose(vertex)) hop(to, length);
}

}  // namespace seamwire::detail
