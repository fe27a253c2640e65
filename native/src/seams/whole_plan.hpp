// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "seams/group_planning.hpp"
#include "seams/planned_wires.hpp"
#include "seams/prepared_surface.hpp"

namespace seamwire::detail {

/// Makes plans for the whole surface from the plans of its groups.
class WholePlan {
 public:
  /// `distortion`: the bound for the mean over the surface. `prepared` and `plans` must outlive this object.
  WholePlan(const PreparedSurface& prepared, const std::vector<GroupPlanning>& plans, double distortion);

  /// The present plan, without a map.
  SeamPlan shown(const Task& task) const { return plan_with(chains(), task); }
  /// The plan with the map that belongs to its wires. Wires that leave a piece without a good map come nearer to the
  /// slits. `bound`: on the energy of each group.
  SeamPlan finished(double bound, const Task& task);

 private:
  const std::vector<GroupProblem>& groups() const { return prepared_.groups; }
  std::vector<SlitChains> chains() const;
  SeamPlan plan_with(std::span<const SlitChains> chains, const Task& task) const;
  std::vector<std::uint8_t> are_kept(const CutMaps& maps, double bound) const;
  void add_maps(SeamPlan& plan, const PlanMesh& mesh, const Place* place, const CutMaps& maps);
  void measure(SeamPlan& plan, const Task& task) const;

  const PreparedSurface& prepared_;
  const std::vector<GroupPlanning>& plans_;  // by group
  double distortion_;
  /// All places of all groups, one group after another.
  struct Placed {
    std::size_t group, place;
  };
  std::vector<Placed> places_;
  std::vector<std::int32_t> place_of_face_;          // of each face of the whole mesh
  std::vector<std::uint8_t> is_counted_;             // the same: 0 in pieces that may not be cut
  std::vector<double> areas_;                        // the same
  std::vector<std::pair<double, double>> energies_;  // with areas, of the counted triangles of the planned map
  bool is_mapped_ = true;                            // whether all counted triangles have a map
};

}  // namespace seamwire::detail
