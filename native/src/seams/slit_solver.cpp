// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/slit_solver.hpp"

#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "detail/index.hpp"
#include "seams/slit_edits.hpp"

namespace seamwire::detail {
namespace {

constexpr double kTolerance = 3e-4;  // of a map's energy: far below what slits differ by
constexpr double kReserve = 0.01;    // for what the worst triangles add to an energy, beyond what they add now
constexpr std::size_t kMostSteps = 60, kTrialSteps = 6;

}  // namespace

SlitSolver::SlitSolver(const SlitProblem& problem, std::vector<std::int32_t> roots)
    : problem_(problem), roots_(std::move(roots)) {}

SlitPlan SlitSolver::solve(std::vector<Slit> slits, const Task& task) const {
  SlitPlan none;
  none.maps.resize(problem_.by_piece.size());
  std::vector<std::int32_t> all(none.maps.size());
  std::iota(all.begin(), all.end(), 0);
  return solve_changed(std::move(slits), none, all, kNever, task);
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
  for (const std::int32_t p : pieces) {
    const double own = problem_.by_piece[p].area;
    std::optional<Island> island = open_piece(problem_, cut, p);
    MapOptions options{.max_steps = kMostSteps, .tolerance = kTolerance};
    if (pieces.size() == 1 && own > 0.0) options.worse_than = ((most + reserve) * area - others) / own;
    if (island) {
      IslandMap map = map_island(*island, problem_.mesh.points, options, task);
      plan.work += static_cast<double>(map.steps) * own;
      if (!map.uvs.empty()) {
        plan.maps[p] = std::make_shared<const PieceMap>(piece_map(problem_, std::move(*island), std::move(map)));
      }
    }
  }
  sum_up(problem_, plan);
  return plan;
}

SlitPlan SlitSolver::extend(const SlitPlan& before, const Slit& slit, const Task& task) const {
  return continued(before, slit, {.max_steps = kMostSteps, .tolerance = kTolerance}, task);
}

SlitPlan SlitSolver::relaxed(const SlitPlan& plan, const Task& task) const {
  SlitPlan loose = plan;
  loose.work = 0.0;
  const MapOptions options{.max_steps = kMostSteps, .tolerance = kTolerance, .keep_apart = false};
  for (std::size_t p = 0; p < plan.maps.size(); ++p) {
    if (!plan.maps[p]) continue;
    const PieceMap& before = *plan.maps[p];
    IslandMap map = continue_map(before.island, problem_.mesh.points, before.map.uvs, options, task);
    loose.work += static_cast<double>(map.steps) * problem_.by_piece[p].area;
    loose.maps[p] = std::make_shared<const PieceMap>(piece_map(problem_, before.island, std::move(map)));
  }
  sum_up(problem_, loose);
  return loose;
}

SlitPlan SlitSolver::try_out(const SlitPlan& relaxed, const Slit& slit, const Task& task) const {
  return continued(relaxed, slit, {.max_steps = kTrialSteps, .tolerance = kTolerance, .keep_apart = false}, task);
}

SlitPlan SlitSolver::continued(const SlitPlan& before, const Slit& slit, const MapOptions& options,
                               const Task& task) const {
  SlitPlan plan{.slits = with_slit(problem_.mesh, before.slits, slit), .maps = before.maps};
  const Cut cut = cut_of(problem_, plan.slits, roots_);
  for (const std::int32_t p : pieces_of(problem_, slit)) {
    std::optional<Island> island = open_piece(problem_, cut, p);
    if (!island || !before.maps[p]) return plan;
    IslandMap map = continue_map(*island, problem_.mesh.points, carried_over(*before.maps[p], *island), options, task);
    plan.work += static_cast<double>(map.steps) * problem_.by_piece[p].area;
    plan.maps[p] = std::make_shared<const PieceMap>(piece_map(problem_, std::move(*island), std::move(map)));
  }
  sum_up(problem_, plan);
  return plan;
}

}  // namespace seamwire::detail
