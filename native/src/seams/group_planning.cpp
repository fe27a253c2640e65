// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/group_planning.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "seams/carried_slits.hpp"

namespace seamwire::detail {
namespace {

/// How often a search is repeated because the original mesh distorts more than the simplified one.
constexpr int kRounds = 2;
constexpr double kNearBound = 0.02;  // a map whose energy is this far below the bound may have too many seams
constexpr double kMargin = 3e-3;
constexpr double kLaterBudget = 0.5;  // of a repetition, as a share of the one before

/// The work of each part of a round: the search, and the map of the original mesh.
struct RoundWork {
  double search, map;
};
std::array<RoundWork, kRounds + 1> work_of_rounds(const GroupProblem& group, double budget) {
  const auto faces = static_cast<double>(group.searched().mesh.face_count());
  const double map = kStepsOfMap * static_cast<double>(group.original.mesh.face_count());
  std::array<RoundWork, kRounds + 1> rounds{};
  for (RoundWork& round : rounds) {
    round = {budget * faces, map};
    if (!group.simplified_mesh) break;
    budget *= kLaterBudget;
  }
  return rounds;
}

/// Which of two plans on the original mesh is better: the cheaper one within the bound, or else the one with less
/// energy.
std::pair<double, double> rank(const GroupPlanning::Result& solved, double bound) {
  return solved.is_within(bound) ? std::pair(0.0, solved.price) : std::pair(1.0, solved.energy);
}

}  // namespace

double GroupProblem::work(double budget) const {
  double sum = 0.0;
  for (const RoundWork& round : work_of_rounds(*this, budget)) sum += round.search + round.map;
  return sum;
}

double GroupProblem::counted_area() const {
  double counted = 0.0, all = 0.0;
  for (const SlitProblem::Piece& piece : original.by_piece) {
    all += piece.area;
    counted += piece.may_be_cut ? piece.area : 0.0;
  }
  const double share = counted < all ? counted / all : 1.0;
  return counted > 0.0 ? static_cast<double>(places.size()) * size * size * share : 0.0;
}

void GroupPlanning::part(const std::vector<NeckRing>& rings) {
  if (rings.empty()) return;
  for (const NeckRing& ring : rings) {
    for (Slit& slit : slits_of(ring)) rings_.push_back(std::move(slit));
  }
  parted_ = group_->searched();
  parted_->is_seam = cut_of(*parted_, rings_, {}).is_cut;
  find_pieces_of(*parted_);
}

void GroupPlanning::grow(bool has_tips, const Task& task) {
  SlitTree tree = grow_tree(problem(), has_tips, part_of(task, 0.0, 0.5));
  roots_ = std::move(tree.roots);
  start_ = SlitSolver(problem(), roots_).solve(std::move(tree.slits), part_of(task, 0.5, 1.0));
  show(start_);
}

void GroupPlanning::show(const SlitPlan& plan) {
  result_ = {.slits = on_original(plan.slits),
             .energy = plan.energy,
             .price = plan.price,
             .overlaps = plan.overlaps,
             .maps = {}};
}

void GroupPlanning::search(const SlitGoal& goal, const std::function<void()>& found, const Task& task) {
  SlitGoal aim = goal;
  Result best;
  const std::array<RoundWork, kRounds + 1> work = work_of_rounds(*group_, goal.budget);
  const double all = group_->work(goal.budget);
  double done = 0.0;
  const auto next = [&](double amount) {
    const double begin = done / all;
    done += amount;
    return part_of(task, begin, done / all);
  };
  for (int round = 0;; ++round) {
    const bool is_simplified = group_->simplified_mesh.has_value();
    bool is_start = true;  // which grow() has shown
    const auto tell = [&](const SlitPlan& plan) {
      if (std::exchange(is_start, false) || round > 0 || !found) return;
      show(plan);
      found();
    };
    if (round > 0) start_ = SlitSolver(problem(), roots_).solve(std::move(start_.slits), next(0.0));
    const SlitPlan plan =
        search_slits(problem(), std::move(start_), roots_, aim, tell, next(work[index(round)].search));
    steps_ += plan.work;
    Result solved = solved_on_original(on_original(plan.slits), next(work[index(round)].map));
    // The simplified mesh distorts less or more than the original one. The bound is moved by as much.
    const double excess = solved.energy - goal.energy;
    const bool is_near = excess <= 0.0 && (excess > -kNearBound || plan.slits.empty());
    if (round == 0 || rank(solved, goal.energy) < rank(best, goal.energy)) best = std::move(solved);
    const double energy = plan.energy - excess - kMargin;
    const bool is_last = !is_simplified || !std::isfinite(goal.energy) || round == kRounds || is_near ||
                         plan.energy > aim.energy || !(energy > 4.0);
    if (is_last) break;
    aim.energy = energy;
    aim.budget *= kLaterBudget;
    start_ = {};
    start_.slits = plan.slits;
  }
  result_ = std::move(best);
}

std::vector<Slit> GroupPlanning::on_original(const std::vector<Slit>& slits) const {
  std::vector<Slit> all = rings_;
  all.insert(all.end(), slits.begin(), slits.end());
  if (!group_->simplified_mesh) return all;
  return carried_slits(problem(), *group_->simplified_mesh, group_->original, all);
}

GroupPlanning::Result GroupPlanning::solved_on_original(std::vector<Slit> slits, const Task& task) const {
  const SlitProblem& original = group_->original;
  Result solved;
  solved.maps = solve_cut(original.mesh, cut_of(original, slits, {}).is_cut, task);
  std::vector<std::pair<double, double>> energies;
  bool is_mapped = true;
  for (std::size_t i = 0; i < solved.maps.maps.size(); ++i) {
    if (!original.by_piece[original.pieces.of_face[solved.maps.first_faces[i]]].may_be_cut) continue;
    const auto& map = solved.maps.maps[i];
    is_mapped = is_mapped && map != nullptr;
    if (!map) continue;
    solved.overlaps = solved.overlaps || map->map.overlaps;
    for (std::size_t k = 0; k < map->energies.size(); ++k) {
      energies.emplace_back(map->energies[k], original.areas[map->island.faces[k]]);
    }
  }
  solved.energy = is_mapped ? mean_energy(std::move(energies)) : kNever;
  for (const Slit& slit : slits) solved.price += original.price(slit);
  solved.slits = std::move(slits);
  return solved;
}

}  // namespace seamwire::detail
