// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "seamwire/context/surface_context.hpp"
#include "seamwire/seams/seam_planner.hpp"
#include "seamwire/task.hpp"
#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// Slits as chains between the vertices where slits meet and end.
struct SlitChains {
  using Chain = std::vector<std::int32_t>;  ///< vertices joined by edges

  explicit SlitChains(std::span<const Slit> slits = {});

  std::vector<Chain> chains;
  double size = 1.0;  ///< the root of the share of the surface's area that these slits cut
  /// How near wires across the surface stay to the slits. Wires at kClosest run along the slits' edges.
  int closeness = 0;
  static constexpr int kClosest = 2;
};

class CandidateWires;

/// Makes wires of slits: between seeds where slits meet, end, and bend.
class PlannedWires {
 public:
  /// Prepares the metrics of wires across the surface. `rim`: as find_touches() takes it. Throws InvalidInput for a
  /// strength; Cancelled.
  PlannedWires(const SurfaceContext& context, Along along, const Strength& strength, std::vector<Edge> rim,
               const Task& task);

  ~PlannedWires();

  bool are_across() const { return across_ != nullptr; }
  /// Along edges, wires are the slits. Across the surface, they are the shortest curves between seeds of the slits,
  /// with as many seeds as it takes to stay near them. Where no such curve exists, they run along the slits' edges.
  /// `mesh`: of the whole surface. Throws Cancelled.
  std::vector<PlannedWire> along(const PlanMesh& mesh, std::span<const SlitChains> slits, const Task& task) const;

 private:
  using Chain = SlitChains::Chain;

  PlannedWire along_edges(const PlanMesh& mesh, const Chain& chain) const;
  std::vector<PlannedWire> along_edges(const PlanMesh& mesh, const SlitChains& slits) const;

  std::shared_ptr<const Surface> surface_;
  std::vector<Edge> rim_;
  std::unique_ptr<const CandidateWires> across_;  // null along edges
};

}  // namespace seamwire::detail
