// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "seams/candidate_wires.hpp"
#include "seams/slit_plan.hpp"
#include "seamwire/seams/seam_planner.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Makes wires of slits: between seeds where slits meet, end, and bend.
class PlannedWires {
 public:
  using Chain = std::vector<std::int32_t>;  ///< vertices joined by edges

  /// Prepares the metrics of wires across the surface. Throws InvalidInput for a strength; Cancelled.
  PlannedWires(const SurfaceContext& context, Along along, const Strength& strength, const Task& task);

  /// Along edges, wires are the slits. Across the surface, they are the shortest curves between seeds of the slits,
  /// with as many seeds as it takes to stay near them. Throws Cancelled.
  std::vector<PlannedWire> along(const SlitProblem& problem, std::span<const Slit> slits, const Task& task) const;

 private:
  std::vector<PlannedWire> along_edges(const PlanMesh& mesh, const std::vector<Chain>& sections) const;
  std::vector<PlannedWire> across_surface(const PlanMesh& mesh, std::vector<Chain> chains, const Task& task) const;

  std::shared_ptr<const Surface> surface_;
  std::unique_ptr<const CandidateWires> across_;  // null along edges
};

}  // namespace seamwire::detail
