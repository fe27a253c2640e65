// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "seams/group_planning.hpp"
#include "seams/planned_wires.hpp"
#include "seamwire/seams/seam_planner.hpp"

namespace seamwire::detail {

/// A surface prepared for planning: groups of pieces, each with its meshes and their prices.
struct PreparedSurface {
  /// Throws InvalidInput for a strength; Cancelled.
  PreparedSurface(const SurfaceContext& context, SeamPlannerOptions with, const Task& task);

  std::shared_ptr<const Surface> surface;
  SeamPlannerOptions options;
  PlanMesh whole;  ///< empty if one group is the whole surface
  std::vector<GroupProblem> groups;
  std::unique_ptr<const PlannedWires> wires;

  /// The mesh of the whole surface.
  const PlanMesh& mesh() const {
    return whole.triangles.empty() && !groups.empty() ? groups.front().original.mesh : whole;
  }

 private:
  void find_meshes(const Task& task);
  void add_simplified(GroupProblem& group, std::size_t triangles, const Task& task) const;
  Visibility visibility_of_all(const Task& task) const;
  void find_prices_of_all(const Visibility& visibility, const Task& task);
  void join_copies(const Task& task);
  std::vector<double> weights_of(const PlanMesh& mesh) const;
};

}  // namespace seamwire::detail
