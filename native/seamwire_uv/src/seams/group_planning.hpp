// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "parts/neck_rings.hpp"
#include "seamwire/task.hpp"
#include "search/slit_search.hpp"
#include "search/slit_solver.hpp"
#include "slits/slit_plan.hpp"
#include "slits/slit_tree.hpp"

namespace seamwire::detail {

/// Where a copy of some faces lies on the whole mesh: its vertices and faces, in the order of the faces' own ones.
struct Place {
  std::vector<std::int32_t> vertices, faces;
  bool is_mirrored = false;
};

/// A group of pieces that is planned by itself, and the places on the surface where copies of it lie.
struct GroupProblem {
  /// The problem on a mesh with fewer triangles.
  struct Simplified {
    SlitProblem problem;
    std::vector<std::int32_t> vertices;  ///< of the original mesh, for each vertex
  };

  SlitProblem original;
  bool is_large = false;  ///< whether the original has too many triangles for a search
  /// From fine to coarse. A large original has one at least.
  std::vector<Simplified> simplified;
  double size = 1.0;  ///< the root of each copy's share of the surface's area
  std::vector<Place> places;

  /// On how many meshes seams are searched, one after another. Each search ends at another local optimum.
  std::size_t level_count() const { return simplified.size() + (is_large ? 0 : 1); }
  /// The simplified mesh of a level, from 0 for the finest; null if it is the original.
  const Simplified* simplified_at(std::size_t level) const {
    if (is_large) return &simplified[level];
    return level == 0 ? nullptr : &simplified[level - 1];
  }
  const SlitProblem& searched(std::size_t level = 0) const {
    const Simplified* simple = simplified_at(level);
    return simple != nullptr ? simple->problem : original;
  }
  /// About how many times a Newton step moves a triangle, if the search on a level takes all of its budget and every
  /// round.
  double work_on(std::size_t level, double budget) const;
  /// The same for all levels, which share the budget.
  double work(double budget) const;
  /// The share of the whole surface's area that all copies have, without pieces that may not be cut.
  double counted_area() const;
};

/// About how many Newton steps a map takes from Tutte's embedding.
inline constexpr double kStepsOfMap = 40.0;

/// Plans one group.
class GroupPlanning {
 public:
  /// The group must outlive this object.
  explicit GroupPlanning(const GroupProblem& group) : group_(&group) {}

  /// Closed cuts at necks, the narrowest first.
  std::vector<NeckRing> necks(const Task& task) const { return find_necks(problem(), task); }
  std::int32_t piece_count() const { return problem().pieces.count; }
  /// Cuts along rings.
  void part(const std::vector<NeckRing>& rings, const Task& task);
  /// Cuts pieces into halves until there are so many, see halving_cuts().
  void halve(std::size_t count, const Task& task);
  /// How many pieces there can be at most.
  std::size_t most_pieces() const;

  /// Grows the tree of slits and solves its maps. Throws Cancelled.
  void grow(bool has_tips, const Task& task);
  /// Looks for a better plan within `goal.energy`. `found` is called whenever the search on the finest mesh has made
  /// result() better. Throws Cancelled.
  void search(const SlitGoal& goal, const std::function<void()>& found, const Task& task);

  /// The best plan so far.
  struct Result {
    std::vector<Slit> slits;  ///< on the original mesh, rings first
    double energy = kInfinity, price = 0.0;
    bool overlaps = false;
    CutMaps maps;  ///< empty before search() has ended
    bool is_within(double bound) const { return energy <= bound && !overlaps; }
  };
  const Result& result() const { return result_; }
  double steps() const { return steps_; }

 private:
  void add_rings(std::vector<Slit> rings, const Task& task);
  void search_levels(const SlitGoal& goal, const std::function<void()>& found, const Task& task);
  void search_once(const SlitGoal& goal, const std::function<void()>& found, const Task& task);
  std::vector<std::int32_t> missed_pieces(const SlitPlan& plan, double bound) const;
  const SlitProblem& problem() const { return parted_ ? *parted_ : group_->searched(level_); }
  std::vector<Slit> on_original(const std::vector<Slit>& slits, const Task& task) const;
  std::vector<Slit> completed(std::vector<Slit> slits, const std::vector<Slit>& simple, const Task& task) const;
  Result solved_on_original(std::vector<Slit> slits, const Task& task) const;
  void show(const SlitPlan& plan, const Task& task);

  const GroupProblem* group_;
  std::size_t level_ = 0;  // of the mesh that is searched
  std::vector<Slit> rings_;
  std::optional<SlitProblem> parted_;  // with rings
  std::size_t least_pieces_ = 0;
  TreeGoal tree_goal_;
  std::vector<std::int32_t> roots_;
  std::vector<std::int32_t> missed_;  // pieces that the last search left without a map within the bound
  SlitPlan start_;
  Result result_;
  double steps_ = 0.0;
};

}  // namespace seamwire::detail
