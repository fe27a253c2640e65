// SPDX-License-Identifier: GPL-3.0-or-later
#include "search/slit_solver.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "detail/index.hpp"
#include "detail/run_on_threads.hpp"
#include "maps/open_island.hpp"
#include "slits/slit_plan.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

constexpr double kReserve = 0.01;  // for what the worst triangles add to an energy, beyond what they add now

}  // namespace

SlitSolver::SlitSolver(const SlitProblem& problem, std::vector<std::int32_t> roots)
    : problem_(problem), roots_(std::move(roots)) {}

SlitPlan SlitSolver::solve(std::vector<Slit> slits, const Task& task) const {
  SlitPlan none;
  none.maps.resize(problem_.by_piece.size());
  std::vector<std::int32_t> all(none.maps.size());
  std::iota(all.begin(), all.end(), 0);
  return solve_changed(std::move(slits), none, all, kInfinity, task);
}

SlitPlan SlitSolver::solve_changed(std::vector<Slit> slits, const SlitPlan& before,
                                   std::span<const std::int32_t> pieces, double most, const Task& task) const {
  SlitPlan plan{.slits = std::move(slits), .maps = before.maps};
  const Cut cut = cut_of(problem_, plan.slits, roots_);
  // The bound on the energies of the solved pieces depends on the others.
  double others = 0.0, area = 0.0, all_before = 0.0;
  for (std::size_t p = 0; p < plan.maps.size(); ++p) {
    area += problem_.by_piece[p].area;
    if (plan.maps[p]) all_before += problem_.by_piece[p].area * plan.maps[p]->map.energy;
  }
  for (const std::int32_t p : pieces) plan.maps[p] = nullptr;
  for (std::size_t p = 0; p < plan.maps.size(); ++p) {
    if (plan.maps[p]) others += problem_.by_piece[p].area * plan.maps[p]->map.energy;
  }
  // The worst triangles count here, and not in a plan's energy.
  const double reserve = std::isfinite(before.energy) ? kReserve + all_before / area - before.energy : 0.0;
  plan.work = for_each(pieces, task, [&](std::int32_t p, const Task& own_task) {
    const double own = problem_.by_piece[p].area;
    if (!problem_.by_piece[p].has_area) return 0.0;
    std::optional<Island> island = open_piece(problem_, cut, p, own_task);
    if (!island) return 0.0;
    MapOptions options = kPlanMap;
    if (pieces.size() == 1 && own > 0.0) options.worse_than = ((most + reserve) * area - others) / own;
    IslandMap map = map_island(*island, problem_.mesh->points, options, own_task);
    const double steps = static_cast<double>(map.steps) * problem_.by_piece[p].work;
    if (!map.uvs.empty()) {
      plan.maps[p] = piece_map(problem_.mesh->points, std::move(*island), std::move(map));
    }
    return steps;
  });
  sum_up(problem_, plan, task);
  return plan;
}

double SlitSolver::for_each(std::span<const std::int32_t> pieces, const Task& task,
                            const std::function<double(std::int32_t, const Task&)>& solve) const {
  if (pieces.size() == 1) return solve(pieces.front(), task);
  std::vector<double> steps(pieces.size(), 0.0);
  run_on_threads(
      pieces.size(), task,
      [&](std::size_t done) { return static_cast<double>(done) / static_cast<double>(pieces.size()); },
      [&](std::size_t i, const Task& own) { steps[i] = solve(pieces[i], own); });
  return std::accumulate(steps.begin(), steps.end(), 0.0);
}

SlitPlan SlitSolver::extend(const SlitPlan& before, const Slit& slit, const Task& task) const {
  return continued(before, slit, kPlanMap, task);
}

SlitPlan SlitSolver::relaxed(const SlitPlan& plan, RelaxedMaps& known, const Task& task) const {
  SlitPlan loose = plan;
  known.from.resize(plan.maps.size());
  known.relaxed.resize(plan.maps.size());
  MapOptions options = kPlanMap;
  options.keep_apart = false;
  std::vector<std::int32_t> changed;
  for (std::int32_t p = 0; index(p) < plan.maps.size(); ++p) {
    if (plan.maps[p] && plan.maps[p] != known.from[p]) changed.push_back(p);
  }
  loose.work = for_each(changed, task, [&](std::int32_t p, const Task& own) {
    const PieceMap& before = *plan.maps[p];
    IslandMap map = continue_map(before.island, problem_.mesh->points, before.map.uvs, options, own);
    const double steps = static_cast<double>(map.steps) * problem_.by_piece[p].work;
    known.relaxed[p] = piece_map(problem_.mesh->points, before.island, std::move(map));
    known.from[p] = plan.maps[p];
    return steps;
  });
  for (std::size_t p = 0; p < plan.maps.size(); ++p) {
    if (plan.maps[p]) loose.maps[p] = known.relaxed[p];
  }
  sum_up(problem_, loose, task);
  return loose;
}

SlitPlan SlitSolver::try_out(const SlitPlan& relaxed, const Slit& slit, const Task& task) const {
  MapOptions options = kPlanMap;
  options.max_steps = tuning::kTrialSteps;
  options.keep_apart = false;
  return continued(relaxed, slit, options, task);
}

SlitPlan SlitSolver::continued(const SlitPlan& before, const Slit& slit, const MapOptions& options,
                               const Task& task) const {
  SlitPlan plan{.slits = with_slit(*problem_.mesh, before.slits, slit), .maps = before.maps};
  const Cut cut = cut_of(problem_, plan.slits, roots_);
  for (const std::int32_t p : pieces_of(problem_, slit)) {
    std::optional<Island> island = open_piece(problem_, cut, p, task);
    if (!island || !before.maps[p]) return plan;
    IslandMap map = continue_map(*island, problem_.mesh->points, carried_over(*before.maps[p], *island), options, task);
    plan.work += static_cast<double>(map.steps) * problem_.by_piece[p].work;
    plan.maps[p] = piece_map(problem_.mesh->points, std::move(*island), std::move(map));
  }
  sum_up(problem_, plan, task);
  return plan;
}

CutMaps solve_cut(const PlanMesh& mesh, std::span<const std::uint8_t> is_cut, const Task& task) {
  std::vector<std::uint8_t> is_cut_half_edge(mesh.twins.size());
  for (std::size_t h = 0; h < is_cut_half_edge.size(); ++h) is_cut_half_edge[h] = is_cut[mesh.edge_of[h]];
  std::vector<Island> islands = cut_open(mesh, is_cut_half_edge, task);
  std::vector<std::size_t> order(islands.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t i) { return islands[i].faces.size(); });
  CutMaps found{.maps = std::vector<std::shared_ptr<const PieceMap>>(islands.size()), .first_faces = {}};
  for (const Island& island : islands) found.first_faces.push_back(island.faces.front());
  std::vector<double> sizes;
  double all = 0.0;
  for (const std::size_t i : order) {
    all += static_cast<double>(islands[i].faces.size());
    sizes.push_back(all);
  }
  const auto fraction = [&](std::size_t done) { return done > 0 ? sizes[done - 1] / all : 0.0; };
  MapOptions options = kPlanMap, loose = kPlanMap;
  options.max_steps = loose.max_steps = tuning::kFinishedSteps;
  loose.keep_apart = false;
  run_on_threads(islands.size(), task, fraction, [&](std::size_t k, const Task& own) {
    const std::size_t i = order[k];
    if (!is_planar(islands[i])) return;
    IslandMap map = map_island(islands[i], mesh.points, options, own);
    // With the barrier, the energy can be too large to compare cuts. A map without it says that it overlaps itself.
    if (!map.uvs.empty() && !(map.energy < kLostEnergy)) map = map_island(islands[i], mesh.points, loose, own);
    if (map.uvs.empty()) return;
    found.maps[i] = piece_map(mesh.points, std::move(islands[i]), std::move(map));
  });
  return found;
}

}  // namespace seamwire::detail
