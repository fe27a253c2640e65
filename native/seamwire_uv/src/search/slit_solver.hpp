// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "seamwire/task.hpp"
#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// How the maps of plans are solved.
inline constexpr MapOptions kPlanMap{.max_steps = 60, .tolerance = 3e-4};

/// The map of each piece from which the relaxed map was made last, and that map.
struct RelaxedMaps {
  std::vector<std::shared_ptr<const PieceMap>> from, relaxed;
};

/// Maps pieces with given slits to the plane, several pieces on several threads. May be called from several threads.
///
/// A piece that slits do not make a disc has no map, and the plan's energy is infinite.
class SlitSolver {
 public:
  /// `roots`: as cut_of().
  SlitSolver(const SlitProblem& problem, std::vector<std::int32_t> roots);

  /// A plan with these slits. All maps start from Tutte's embedding.
  SlitPlan solve(std::vector<Slit> slits, const Task& task) const;
  /// A plan with these slits, which differ from those of another plan in some pieces only; these maps start from
  /// Tutte's embedding. Stops early, with an energy above `most`, once it is certain to end above that.
  SlitPlan solve_changed(std::vector<Slit> slits, const SlitPlan& before, std::span<const std::int32_t> pieces,
                         double most, const Task& task) const;
  /// A plan with a slit more. The maps continue from those before.
  SlitPlan extend(const SlitPlan& before, const Slit& slit, const Task& task) const;
  /// The plan with maps that may overlap themselves: the energy that trials are compared with. `known`: maps of such
  /// plans, which it adds to.
  SlitPlan relaxed(const SlitPlan& plan, RelaxedMaps& known, const Task& task) const;
  /// A relaxed plan with a slit more, after a few steps: what the slit is about worth.
  SlitPlan try_out(const SlitPlan& relaxed, const Slit& slit, const Task& task) const;

  Cut cut(std::span<const Slit> slits) const { return cut_of(problem_, slits, roots_); }

 private:
  /// Calls solve(piece, task) for pieces, and adds up the steps that it returns.
  double for_each(std::span<const std::int32_t> pieces, const Task& task,
                  const std::function<double(std::int32_t, const Task&)>& solve) const;
  SlitPlan continued(const SlitPlan& before, const Slit& slit, const MapOptions& options, const Task& task) const;

  const SlitProblem& problem_;
  std::vector<std::int32_t> roots_;
};

/// The maps of the islands into which a cut parts a mesh.
struct CutMaps {
  std::vector<std::shared_ptr<const PieceMap>> maps;  ///< by island; null where an island has no map
  std::vector<std::int32_t> first_faces;              ///< of each island
};
/// `is_cut`: of each edge. On several threads. Throws Cancelled.
CutMaps solve_cut(const PlanMesh& mesh, std::span<const std::uint8_t> is_cut, const Task& task);

}  // namespace seamwire::detail
