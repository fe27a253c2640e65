// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <queue>
#include <vector>

#include "detail/index.hpp"
#include "embedding/degenerate_faces.hpp"
#include "seamwire/embedding/embedding.hpp"

/// The subdivision of Section 4.1 of the paper, and what goes beyond it (docs/method.md, Section 4).
namespace seamwire {

/// A triangle is valid where its longest edge is shorter than the others together by this fraction: exact geodesics
/// unfold it, and the square root in the unfolding leaves half of its digits.
constexpr double kSlack = 1e-10;
/// Splits between two reports of progress: about a millisecond.
constexpr std::size_t kReportEvery = 1024;

/// Which triangles are bisected, and where.
enum class Scheme {
  kPaper,      ///< an invalid triangle and the neighbour behind its longest edge are bisected, whatever the neighbour
  kPropagate,  ///< the neighbour is first bisected until the common edge is the right one for it too
  kShallow,    ///< the same, but no part deeper than kShallowDepth is bisected for its own sake
  kFitAlone,   ///< nothing is bisected for its own sake before fit()
};

/// Where the quadratic form of the ambient norm (metric.hpp) is one matrix: M + sqrt(l1 l2) n n^T.
struct MetricNode {
  Vector point;                // in the caller's coordinates
  std::array<double, 6> form;  // xx, yy, zz, 2 xy, 2 xz, 2 yz

  double norm(const Vector& e) const {
    const double x = e.x(), y = e.y(), z = e.z();
    const double squared =
        form[0] * x * x + form[1] * y * y + form[2] * z * z + form[3] * x * y + form[4] * x * z + form[5] * y * z;
    return std::sqrt(std::max(0.0, squared));
  }
};

/// Triangles glued along their edges, in flat arrays: half-edge 3 f + i runs from corner i of triangle f to the next.
struct FlatMesh {
  std::vector<Triangle> corners;
  std::vector<std::int32_t> twins;

  std::int32_t tail(std::int32_t h) const { return corners[h / 3][h % 3]; }
  std::int32_t tip(std::int32_t h) const { return corners[h / 3][(h + 1) % 3]; }
};

/// The half-edge after h in its triangle.
inline std::int32_t next(std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }

/// Whether all vertices and faces of the half-edge mesh have the caller's numbers.
bool keeps_numbers(const Surface& surface);

/// The surface's triangles, refined in place.
class Refinement {
 public:
  Refinement(const Surface& surface, const Metric& metric, const EmbedOptions& options, Scheme scheme);
  /// Goes on from an embedding of the surface in another metric, which must be `local`.
  Refinement(const Surface& surface, const Metric& metric, const EmbedOptions& options, Embedding&& old);

  /// False where more than `most` triangles would have to be added. Progress goes on from `progress`.
  bool run(const Task& task, std::size_t most, double& progress);
  /// Goes on where run() has returned false.
  bool work_off(const Task& task, std::size_t most, double& progress);
  /// The same for the triangles at vertices where the metric has changed from `former`, and what they lead to.
  bool run_changes(const Metric& former, const Task& task, std::size_t most);
  /// Bisects each triangle that is still invalid once more, with lengths that make its parts valid; false where some
  /// are left, because of the cap or rounding.
  bool fit(const Task& task, double progress);
  /// Whether an invalid part of a face with an area has become so flat that it cannot be bisected on.
  bool has_decayed() const { return has_decayed_; }
  std::size_t faces_added() const { return faces_added_; }
  bool hit_cap() const { return hit_cap_; }
  /// Triangles that fit() has left, or would look at.
  std::size_t count_unfit() const;
  /// From here on, remember when there were fewest of them, and how many triangles had been added by then.
  void watch_unfit();
  std::size_t least_unfit() const { return least_unfit_; }
  std::size_t least_unfit_at() const { return least_unfit_at_; }
  Embedding result() &&;

 private:
  struct Candidate {
    float perimeter;  // rounded, so that the scale of the input does not choose between equal ones
    std::int32_t face;
    // Of equal ones, the first: in an order that knows the original face and the bisections of it alone, so that what
    // happens elsewhere on the surface does not decide.
    std::uint64_t place;

    friend bool operator<(const Candidate& a, const Candidate& b) {
      return a.perimeter != b.perimeter ? a.perimeter < b.perimeter : a.place > b.place;
    }
  };
  enum class State : std::uint8_t {
    kOriginal,  ///< as it was given
    kRunning,   ///< bisected, or to be looked at, in this run
    kKept,      ///< bisected in the former metric, and to stay so
  };

  void orient_normals(const HalfEdgeMesh& mesh);
  std::int32_t number(std::int32_t v) const {
    if (index(v) < fans_) return vertex_of_fan_[v];
    return static_cast<std::int32_t>(index(v) - fans_ + surface_.vertex_count());
  }
  const MetricNode& node(std::int32_t v) const { return index(v) < fans_ ? nodes_[v] : new_nodes_[index(v) - fans_]; }
  void set_node(std::int32_t fan);
  TensorAt tensor_at(std::int32_t v) const;
  Vector vector(std::int32_t h) const {
    return (node(mesh_.tip(h)).point - node(mesh_.tail(h)).point) * surface_.scale();
  }
  double measure(std::int32_t h) const;
  void measure_all();
  bool is_valid(std::int32_t f) const;
  bool is_flat(std::int32_t f) const;
  double perimeter(std::int32_t f) const;
  std::int32_t longest(std::int32_t f) const;
  void consider(std::int32_t f);
  std::int32_t refinement_edge(std::int32_t f) const;
  void begin_newest_vertex_bisection();
  bool refine(std::int32_t f, std::size_t most);
  void bisect(std::int32_t h);
  std::int32_t fitting_edge(std::int32_t f) const;
  bool is_unfit(std::int32_t f) const;
  bool can_be_fitted(std::int32_t f) const;
  double fitted(std::int32_t h, double half, double next_side, double last_side) const;
  void halve(std::int32_t h, std::int32_t middle);
  void set_length(std::int32_t h, double length);
  void note_unfit(std::int32_t h, std::int32_t beyond, bool are_new);
  std::vector<std::int32_t> changed_faces(const Metric& former) const;
  void reset(const std::vector<std::int32_t>& seeds);
  bool enter(std::int32_t face);
  bool is_given_valid(std::int32_t face, const Metric& metric) const;
  std::vector<std::int32_t> unreachable(const IntrinsicMesh& mesh) const;

  const Surface& surface_;
  const Metric& metric_;
  const EmbedOptions& options_;
  Scheme scheme_;
  const std::vector<std::int32_t>& vertex_of_fan_;
  std::size_t fans_;   // vertices of the surface's half-edge mesh
  std::size_t faces_;  // triangles before the first bisection
  FlatMesh mesh_;
  std::vector<double> lengths_;        // per half-edge
  std::vector<std::int32_t> origins_;  // per triangle: the face of the surface's half-edge mesh that it lies in
  std::vector<std::uint32_t>
      branch_;                       // per triangle: which part of that it is, as the number of a node of a binary tree
  std::vector<std::uint8_t> depth_;  // per triangle: bisections since the original face, up to kNewestDepth
  std::unique_ptr<MetricNode[]> nodes_;  // per fan
  std::vector<MetricNode> new_nodes_;
  std::vector<TensorAt> tensors_;         // of the new vertices
  std::vector<bool> is_turned_;           // per fan: its side is the other one than its vertex's normal's; empty: none
  std::size_t first_newest_ = 0;          // vertices from here on are of newest-vertex bisection; 0: it has not begun
  std::vector<std::int32_t> deferred_;    // invalid triangles left to newest-vertex bisection
  std::vector<std::int32_t> chain_;       // triangles to bisect, the last one first
  std::priority_queue<Candidate> queue_;  // invalid triangles that may be bisected; entries grow stale
  std::vector<LooseEdge> merged_;
  std::vector<State> states_;            // per face of the surface's half-edge mesh, for a run of changes
  std::vector<std::int32_t> conflicts_;  // faces that were kept and should not have been
  std::vector<std::int32_t> running_;    // faces with State::kRunning
  std::vector<Vector> points_;           // in the caller's coordinates, the caller's first
  bool has_mended_ = false, has_decayed_ = false;
  std::vector<bool> is_flat_origin_;  // per face of the surface's half-edge mesh: it has no area; empty: none is
  std::size_t invalid_before_ = 0;
  std::size_t faces_added_ = 0;
  std::size_t newest_bisections_ = 0;
  bool hit_cap_ = false;
  std::size_t clamped_edges_ = 0;
  double worst_clamp_ = 1.0;
  bool watches_unfit_ = false;
  std::size_t unfit_ = 0, least_unfit_ = 0, least_unfit_at_ = 0;
};

// Used in the innermost loops, and so inline.

// Length of an edge in the metric, from both of its ends.
inline double Refinement::measure(std::int32_t h) const {
  const MetricNode &a = node(mesh_.tail(h)), &b = node(mesh_.tip(h));
  const Vector e = (b.point - a.point) * surface_.scale();
  return integrated_length(a.norm(e), b.norm(e));
}

inline void Refinement::set_length(std::int32_t h, double length) {
  lengths_[h] = length;
  if (const std::int32_t twin = mesh_.twins[h]; twin >= 0) lengths_[twin] = length;
}

inline bool Refinement::is_valid(std::int32_t f) const {
  const double *l = &lengths_[3 * index(f)], most = std::max({l[0], l[1], l[2]});
  return most < (l[0] + l[1] + l[2] - most) * (1 - kSlack);
}

inline bool Refinement::is_flat(std::int32_t f) const {
  return lacks_area(vector(3 * f), vector(3 * f + 1), vector(3 * f + 2));
}

inline double Refinement::perimeter(std::int32_t f) const {
  const double* l = &lengths_[3 * index(f)];
  if (options_.perimeter == Perimeter::kMetric) return l[0] + l[1] + l[2];
  return vector(3 * f).norm() + vector(3 * f + 1).norm() + vector(3 * f + 2).norm();
}

}  // namespace seamwire
