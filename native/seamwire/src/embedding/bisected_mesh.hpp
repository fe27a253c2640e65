// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "detail/index.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"
#include "surface/exact_unit.hpp"

namespace seamwire::detail {

struct CleanedFans;

/// Whether vertices and faces have the same numbers in the corner fans as in the surface.
bool keeps_numbers(const Surface& surface);

/// A quadratic form on space: xx, yy, zz, 2 xy, 2 xz, 2 yz.
using SpaceForm = std::array<double, 6>;

/// A surface, or some of its faces, to embed in a metric. The surface, the metric and the options must outlive it.
struct EmbeddingInput {
  /// Throws InvalidInput if a face of the options is out of range.
  EmbeddingInput(const Surface& on, const Metric& by, const EmbedOptions& with);

  std::size_t face_count() const { return faces ? faces->size() : surface.face_count(); }

  const Surface& surface;
  const Metric& metric;
  const EmbedOptions& options;
  /// The caller's faces that are embedded, and those of the surface's corner fans, both ascending; nullopt: all.
  std::optional<std::vector<std::int32_t>> callers_faces, faces;
};

/// A triangle is valid if its longest edge is shorter than the others together by this fraction. Exact geodesics unfold
/// triangles, and the square root in the unfolding leaves half of the digits.
inline constexpr double kValidityMargin = 1e-10;

/// Whether three lengths are those of a valid triangle.
inline bool has_valid_lengths(const double* l) {
  const double most = std::max({l[0], l[1], l[2]});
  return most < (l[0] + l[1] + l[2] - most) * (1 - kValidityMargin);
}

/// Whether three lengths are those of the sides of a triangle with an area. Its area is then known better from the
/// sides than from the lengths.
bool are_lengths_of(const double* lengths, const std::array<Vector, 3>& sides);

/// How an edge is measured.
enum class EdgeRule {
  /// By the norms at both of its ends, as in the paper.
  kEnds,
  /// Also by the norm in its middle, where the normal is nearly across the edge: the lengths measured as a whole and in
  /// two halves, extrapolated.
  kMiddle,
};

/// A surface's triangles, which are bisected in place, with the lengths of their edges in a metric. Other parts decide
/// which triangles to bisect, and in which order (bisection.hpp, length_repair.hpp).
///
/// Lengths are in the unit of exact_unit(), until to_embedding() converts them.
///
/// Half-edge 3 f + i runs from corner i of triangle f to the next corner. The first vertices are the surface's corner
/// fans, the others midpoints of edges in the order in which they are made. Of the halves of a bisected triangle one
/// takes its place, the other becomes the last triangle.
class BisectedMesh : public TriangleConnectivity {  // until to_embedding(), two siblings may run opposite ways
 public:
  /// The triangles to embed, without those degenerate ones that can be removed. The surface and the metric must outlive
  /// the mesh. The task is told `progress`; throws Cancelled.
  BisectedMesh(const EmbeddingInput& input, const Task& task, double progress, EdgeRule rule = EdgeRule::kEnds);
  /// The triangles of an embedding of the surface, which must be `is_local`. Points of the metric have to be set with
  /// set_node() before they are used. Throws Cancelled.
  BisectedMesh(const Surface& on, const Metric& by, const Embedding& old, const Task& task);

  std::size_t vertex_count() const { return fans_ + new_nodes_.size(); }
  /// Triangles before the first bisection.
  std::size_t given_face_count() const { return given_faces_; }
  std::size_t faces_added() const { return triangles.size() - given_faces_; }

  /// The length of an edge in the metric.
  double measure(std::int32_t h) const;
  /// The length of an edge as set last.
  double length(std::int32_t h) const { return lengths[h]; }
  void set_length(std::int32_t h, double length);
  double perimeter(std::int32_t f) const;
  /// The mean length of an edge in the metric before the first bisection, or the one that the options give.
  double mean_edge_length() const { return mean_edge_length_; }
  /// The form of the ambient norm (metric.hpp) at a vertex.
  const SpaceForm& form(std::int32_t v) const { return node(v).form; }
  /// A half-edge.
  Vector vector(std::int32_t h) const { return (node(tip(h)).point - node(tail(h)).point) * unit_; }
  /// Whether the lengths fulfill the triangle inequality, with some room for rounding; or are those of a triangle in
  /// space that is so thin that rounding leaves no room.
  bool is_valid(std::int32_t f) const { return has_room(f) || is_as_in_space(f); }
  /// Whether a triangle is degenerate in space.
  bool is_degenerate(std::int32_t f) const;
  /// Whether it is a part of a face that was degenerate from the beginning.
  bool is_of_degenerate_face(std::int32_t f) const {
    return !is_degenerate_origin_.empty() && is_degenerate_origin_[origins[f]];
  }

  /// Bisects an edge from a to b, and with it all triangles at the edge. With n triangles before: half-edge h then runs
  /// from a to the midpoint, 3 n from there to b, and 3 n + 2 from the apex of h's triangle to the midpoint. The new
  /// half of the i-th triangle beyond the edge (for_each_beyond(), from 1 on) is n + i, and 3 (n + i) + 2 runs from its
  /// apex to the midpoint.
  void bisect(std::int32_t h);

  /// Takes the metric of a vertex of the surface's corner fans from the metric.
  void set_node(std::int32_t fan);
  /// Makes faces what they were before any bisection, and with them those that they were bisected together with, that
  /// is those with which they have a bisected edge in common. The last triangles and vertices take the numbers that
  /// become free. Returns all the faces; their lengths have to be measured anew.
  std::vector<std::int32_t> undo(const std::vector<std::int32_t>& seeds);

  /// The embedding: invalid triangles become holes. All is set but the counters of the work. `is_scheme_local`: whether
  /// what was done to a triangle depends on those alone that it was bisected together with.
  Embedding to_embedding(bool is_scheme_local) &&;

  const Surface& surface;
  const Metric& metric;
  std::vector<double> lengths;        ///< per half-edge
  std::vector<std::int32_t> origins;  ///< per triangle: the face of the surface's corner fans that it lies in
  /// Per triangle: which part of that face it is, as the number of a node of a binary tree of bisections.
  std::vector<std::uint32_t> branches;
  /// Per triangle: bisections since the original face, up to kMostDepth.
  std::vector<std::uint8_t> depths;
  static constexpr std::uint8_t kMostDepth = 14;
  std::size_t degenerate_faces_removed = 0;

 private:
  /// A point with the quadratic form of the ambient norm (metric.hpp) there, M + sqrt(l1 l2) n n^T.
  struct MetricNode {
    Vector point;  // in the caller's coordinates
    SpaceForm form;

    double norm(const Vector& e) const {
      const double x = e.x(), y = e.y(), z = e.z();
      const double squared =
          form[0] * x * x + form[1] * y * y + form[2] * z * z + form[3] * x * y + form[4] * x * z + form[5] * y * z;
      return std::sqrt(std::max(0.0, squared));
    }
  };
  static MetricNode node_of(const Vector& point, const Vector& n, const Eigen::Matrix3d& m);

  const MetricNode& node(std::int32_t v) const { return index(v) < fans_ ? nodes_[v] : new_nodes_[index(v) - fans_]; }
  TensorAt tensor_at(std::int32_t v) const;
  void take_faces(const EmbeddingInput& input, const Task& task, double progress);
  void take_all(const TriangleConnectivity& all, const Task& task, double progress);
  void select(const TriangleConnectivity& all, const std::vector<std::int32_t>& faces);
  std::int32_t external_vertex(std::int32_t v) const;
  bool has_room(std::int32_t f) const { return has_valid_lengths(&lengths[3 * index(f)]); }
  bool is_as_in_space(std::int32_t f) const;
  double measure_with_middle(std::int32_t h) const;
  std::pair<Vector, Vector> end_normals(std::int32_t h) const;
  double norm_in_middle(std::int32_t h, const Vector& e) const;
  Vector normal(std::int32_t v) const;
  TensorAt midpoint(std::int32_t h) const;
  void bisect_siblings(std::int32_t h);
  void link(const std::vector<std::int32_t>& cycle);
  void make_twins_of_pairs();
  void orient_normals();
  void measure_all(const Task& task, double progress);
  void halve(std::int32_t h, std::int32_t middle);
  void remove_parts(const std::vector<bool>& is_undone);
  void remove_unused_vertices();
  void remove_triangles(const std::vector<std::int32_t>& sorted);
  std::vector<std::int32_t> unreachable(const IntrinsicMesh& mesh) const;

  double unit_;  // see exact_unit()
  EdgeRule rule_ = EdgeRule::kEnds;
  std::shared_ptr<const CleanedFans> cleaned_;              // null: as the surface has them
  std::optional<std::vector<std::int32_t>> callers_faces_;  // that are embedded, ascending; nullopt: all
  std::vector<std::int32_t> selected_fans_;                 // then: the surface's corner fans that they have, ascending
  std::vector<std::int32_t> vertex_of_selected_;            // and the vertices of these
  std::span<const std::int32_t> vertex_of_fan_;
  std::size_t fans_ = 0;
  std::size_t given_faces_ = 0;
  std::unique_ptr<MetricNode[]> nodes_;  // per fan
  std::vector<MetricNode> new_nodes_;
  std::vector<TensorAt> tensors_;  // of the new vertices
  // In the embedding, the number of a new vertex among the new ones. Where an edge with siblings is bisected, each of
  // its triangles has a separate vertex here, as it has separate corner fans. Empty without siblings.
  std::vector<std::int32_t> number_of_new_;
  std::vector<Vector> points_;     // in the caller's coordinates, the caller's vertices first
  std::vector<bool> is_turned_;    // per fan: its side is the other one than its vertex's normal's; empty: none
  std::vector<LooseEdge> merged_;  // see CleanedFans
  double mean_edge_length_ = 0.0;
  std::vector<bool> is_degenerate_origin_;  // per face of the surface's corner fans; empty: none is
};

// Used in the innermost loops, and so inline.

inline double BisectedMesh::measure(std::int32_t h) const {
  if (rule_ == EdgeRule::kMiddle) return measure_with_middle(h);
  const MetricNode &a = node(tail(h)), &b = node(tip(h));
  const Vector e = (b.point - a.point) * unit_;
  return integrated_length(a.norm(e), b.norm(e));
}

inline void BisectedMesh::set_length(std::int32_t h, double length) {
  lengths[h] = length;
  for_each_beyond(h, [&](std::int32_t other) { lengths[other] = length; });
}

inline double BisectedMesh::perimeter(std::int32_t f) const {
  const double* l = &lengths[3 * index(f)];
  return l[0] + l[1] + l[2];
}

}  // namespace seamwire::detail
