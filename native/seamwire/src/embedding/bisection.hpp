// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <queue>
#include <vector>

#include "embedding/bisected_mesh.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Which triangles are bisected, and at which edge (docs/method/embedding.md).
enum class Scheme {
  /// Longest-edge bisection, as in the paper: an invalid triangle and the neighbor behind its longest edge.
  kLongestEdge,
  /// Longest-edge propagation (LEPP): the neighbor first, until the common edge is the longest one of the neighbor too.
  /// Invalid triangles that are deep below their original face are left to newest-vertex bisection.
  kPropagation,
  /// Propagation that bisects no triangle below a small depth for its own sake.
  kShallowPropagation,
  /// Propagation that also bisects valid triangles that do not resolve the metric (EmbedOptions::max_error). It bisects
  /// no triangle that is deep below its original face for its own sake, and few others for one.
  kResolving,
  /// Nothing is bisected: all is left to length repair.
  kNone,
};

/// Bisections between two looks at the task: about a millisecond.
inline constexpr std::size_t kBisectionsBetweenChecks = 1024;

/// The faces of the surface that take part where only a part of it is embedded anew (embedding.cpp). A face that was
/// bisected in the former metric must not be bisected on; where that would be needed, there is a conflict.
class ActiveFaces {
 public:
  explicit ActiveFaces(const BisectedMesh& mesh);

  /// Makes a face ready to be bisected; false for one that was bisected before.
  bool activate(BisectedMesh& mesh, std::int32_t face);
  /// Faces that are as given once more, after BisectedMesh::undo().
  void reset(const std::vector<std::int32_t>& faces);
  void add_conflict(std::int32_t one, std::int32_t other);
  /// The faces in conflicts, which are then forgotten. Triangles bisected until now count as bisected before.
  std::vector<std::int32_t> take_conflicts(const BisectedMesh& mesh);
  bool has_conflicts() const { return !conflicts_.empty(); }
  /// How often a face was made ready.
  std::size_t activations() const { return activations_; }

 private:
  enum class State : std::uint8_t {
    kGiven,   ///< not bisected yet
    kActive,  ///< bisected, or to be looked at, in this run
    kKept,    ///< bisected before, and to stay so
  };
  void keep_bisected(const BisectedMesh& mesh);

  std::vector<State> states_;  // per face of the surface's corner fans
  std::vector<std::int32_t> active_, conflicts_;
  std::size_t activations_ = 0;
};

/// Bisects invalid triangles of a mesh, the largest perimeter first, until no triangle is left that the scheme bisects.
/// If the scheme is kResolving, valid triangles follow, the largest error_score() first.
class Bisection {
 public:
  /// `active`: nullptr for the whole surface. Options and active faces must outlive it.
  Bisection(BisectedMesh mesh, const EmbedOptions& options, Scheme scheme, ActiveFaces* active = nullptr);

  /// Looks at all triangles, and bisects. Returns false where more than `most` triangles would have to be added.
  /// Progress goes on from `progress`.
  bool run(const Task& task, std::size_t most, double& progress);
  /// Goes on where run() has returned false, or after consider().
  bool work_off(const Task& task, std::size_t most, double& progress);
  /// Queues a triangle if it is to be bisected.
  void consider(std::int32_t f);

  BisectedMesh& mesh() { return mesh_; }
  const BisectedMesh& mesh() const { return mesh_; }
  const EmbedOptions& options() const { return options_; }
  /// Whether an invalid part of a face with an area has become so flat that it cannot be bisected on.
  bool has_decayed() const { return has_decayed_; }
  bool hit_cap() const { return hit_cap_; }
  /// Whether at some time no invalid triangle was left that the scheme kResolving bisects.
  bool were_all_valid() const { return were_all_valid_; }

  /// The embedding, with the counters of this work.
  Embedding to_embedding() &&;

 private:
  struct Candidate {
    // Rounded, so that the scale of the input does not choose between equal ones. Of an invalid triangle the perimeter,
    // of a valid one -1 / error_score().
    float priority;
    std::int32_t face;
    // Of equal ones, the first: in an order that knows the original face and the bisections of it alone, so that what
    // happens elsewhere on the surface does not decide.
    std::uint64_t place;

    friend bool operator<(const Candidate& a, const Candidate& b) {
      return a.priority != b.priority ? a.priority < b.priority : a.place > b.place;
    }
  };

  std::int32_t longest_edge(std::int32_t f) const;
  std::int32_t refinement_edge(std::int32_t f) const;
  void begin_newest_vertex_bisection();
  void queue(std::int32_t f, double priority);
  bool is_stale(const Candidate& candidate) const;
  bool refine(std::int32_t f, std::size_t most);
  void bisect(std::int32_t h);

  BisectedMesh mesh_;
  const EmbedOptions& options_;
  Scheme scheme_;
  ActiveFaces* active_;
  std::priority_queue<Candidate> queue_;  // triangles that may be bisected; entries grow stale
  std::vector<std::int32_t> chain_;       // triangles to bisect, the last one first
  std::vector<std::int32_t> parts_;       // of those bisected last
  std::vector<std::int32_t> deferred_;    // invalid triangles left to newest-vertex bisection
  std::size_t first_newest_ = 0;          // vertices from here on are of newest-vertex bisection; 0: it has not begun
  std::size_t invalid_before_ = 0, newest_bisections_ = 0;
  bool has_decayed_ = false, hit_cap_ = false, were_all_valid_ = false;
};

}  // namespace seamwire::detail
