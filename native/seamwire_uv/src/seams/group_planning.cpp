// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/group_planning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "decimation/decimation.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "parts/parting_cuts.hpp"
#include "slits/slit_tree.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

constexpr double kFirstEnd = 0.75;  // of the progress: where the first search ends
constexpr double kGrowing = 0.05;   // share of a later search: the tree

/// The work of each part of a round: the search, and the map of the original mesh.
struct RoundWork {
  double search, map;
};
std::array<RoundWork, tuning::kRounds + 1> work_of_rounds(const GroupProblem& group, std::size_t level, double budget) {
  const auto faces = static_cast<double>(group.searched(level).mesh->face_count());
  const double map = kStepsOfMap * static_cast<double>(group.original.mesh->face_count());
  std::array<RoundWork, tuning::kRounds + 1> rounds{};
  for (RoundWork& round : rounds) {
    round = {budget * faces, map};
    if (group.simplified_at(level) == nullptr) break;
    budget *= tuning::kLaterBudget;
  }
  return rounds;
}

/// Which of two plans on the original mesh is better: the cheaper one within the bound, or else the one with less
/// energy.
std::pair<double, double> rank(const GroupPlanning::Result& solved, double bound) {
  return solved.is_within(bound) ? std::pair(0.0, solved.price) : std::pair(1.0, solved.energy);
}

/// A problem with slits as its seams.
SlitProblem with_seams(const SlitProblem& problem, std::span<const Slit> slits, const Task& task) {
  SlitProblem cut;
  cut.mesh = problem.mesh;
  cut.prices = problem.prices;
  cut.reflection = problem.reflection;
  cut.is_seam = cut_of(problem, slits, {}).is_cut;
  find_pieces_of(cut, task);
  return cut;
}

/// How many more cuts all islands between slits together need to become discs.
std::int64_t missing_cuts_of(const SlitProblem& problem, std::span<const Slit> slits, const Task& task) {
  const std::vector<std::uint8_t> is_cut = cut_of(problem, slits, {}).is_cut;
  std::int64_t missing = 0;
  for (std::int32_t p = 0; p < problem.pieces.count; ++p) {
    for (const Island& island : islands_of(problem, is_cut, p, task)) missing += island.missing_cuts();
  }
  return missing;
}

bool has_barred_edges(const SlitProblem& problem) {
  const std::vector<double>& prices = problem.prices.of_edge;
  for (std::size_t e = 0; e < prices.size(); ++e) {
    if (prices[e] == kInfinity && problem.mesh->is_real[e] != 0) return true;
  }
  return false;
}

}  // namespace

double GroupProblem::work_on(std::size_t level, double budget) const {
  double sum = 0.0;
  for (const RoundWork& round : work_of_rounds(*this, level, budget)) sum += round.search + round.map;
  return sum;
}

double GroupProblem::work(double budget) const {
  double sum = 0.0;
  const auto count = level_count();
  for (std::size_t level = 0; level < count; ++level) sum += work_on(level, budget / static_cast<double>(count));
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

void GroupPlanning::part(const std::vector<NeckRing>& rings, const Task& task) {
  std::vector<Slit> slits;
  for (const NeckRing& ring : rings) {
    for (Slit& slit : slits_of(ring)) slits.push_back(std::move(slit));
  }
  add_rings(std::move(slits), task);
}

void GroupPlanning::halve(std::size_t count, const Task& task) {
  least_pieces_ = count;
  add_rings(halving_cuts(problem(), count, task), task);
}

std::size_t GroupPlanning::most_pieces() const { return count_blocks(problem()); }

void GroupPlanning::add_rings(std::vector<Slit> rings, const Task& task) {
  if (rings.empty()) return;
  std::ranges::move(rings, std::back_inserter(rings_));
  parted_ = with_seams(group_->searched(level_), rings_, task);
}

void GroupPlanning::grow(bool has_tips, const Task& task) {
  const auto grown = [&](const TreeGoal& goal, const Task& own) {
    tree_goal_ = goal;
    SlitTree tree = grow_tree(problem(), goal, part_of(own, 0.0, 0.5));
    roots_ = std::move(tree.roots);
    start_ = SlitSolver(problem(), roots_).solve(std::move(tree.slits), part_of(own, 0.5, 1.0));
  };
  // Without a bound on the energy, only discs are wanted.
  grown({.has_tips = has_tips, .keeps_holes = has_tips}, part_of(task, 0.0, 0.9));
  // Double precision may be unable to hold a map with holes.
  if (has_tips && !std::isfinite(start_.energy))
    grown({.has_tips = true, .keeps_holes = false}, part_of(task, 0.9, 1.0));
  show(start_, task);
}

void GroupPlanning::show(const SlitPlan& plan, const Task& task) {
  result_ = {.slits = completed(on_original(plan.slits, task), plan.slits, task),
             .energy = plan.energy,
             .price = plan.price,
             .overlaps = plan.overlaps,
             .maps = {}};
}

void GroupPlanning::search(const SlitGoal& goal, const std::function<void()>& found, const Task& task) {
  double end = kFirstEnd;
  search_levels(goal, found, part_of(task, 0.0, end));
  // Without a good plan the group is parted further: along the rims of the pieces that miss the bound. Without any map,
  // it is also parted into halves.
  for (int round = 0; round <= tuning::kHalvings && !result_.is_within(goal.energy); ++round) {
    if (round > 0 && std::isfinite(result_.energy)) return;
    // Only machine parts have rims. On others, these would enclose scales and wrinkles. But slits alone may be too few
    // where the weights keep seams away.
    if (round == 0 && !problem().prices.is_machine_part && !has_barred_edges(problem())) continue;
    std::vector<Slit> cuts = round == 0 ? rim_cuts(problem(), missed_, task)
                                        : halving_cuts(problem(), 2 * index(problem().pieces.count), task);
    if (cuts.empty()) continue;
    add_rings(std::move(cuts), task);
    const Result before = std::move(result_);
    // How many searches follow is not known: each takes half of what is left.
    const double begin = std::exchange(end, 0.5 * (end + 1.0)), grown = begin + kGrowing * (end - begin);
    grow(std::isfinite(goal.energy), part_of(task, begin, grown));
    search_once(goal, {}, part_of(task, grown, end));
    if (rank(before, goal.energy) <= rank(result_, goal.energy)) result_ = before;
  }
}

/// Searches on each level, and keeps the best plan. Rings lie on the finest of these meshes: with rings, the others are
/// not searched.
void GroupPlanning::search_levels(const SlitGoal& goal, const std::function<void()>& found, const Task& task) {
  const std::size_t levels = rings_.empty() && std::isfinite(goal.energy) ? group_->level_count() : 1;
  SlitGoal aim = goal;
  aim.budget /= static_cast<double>(levels);
  std::vector<double> ends;
  for (std::size_t level = 0; level < levels; ++level) {
    ends.push_back((ends.empty() ? 0.0 : ends.back()) + group_->work_on(level, aim.budget));
  }
  search_once(aim, found, part_of(task, 0.0, ends.front() / ends.back()));
  for (std::size_t level = 1; level < levels && (result_.price > 0.0 || !result_.is_within(goal.energy)); ++level) {
    const double begin = ends[level - 1] / ends.back(), end = ends[level] / ends.back();
    const double grown = begin + kGrowing * (end - begin);
    Result before = std::move(result_);
    std::vector<std::int32_t> missed = std::move(missed_);
    const std::size_t best = std::exchange(level_, level);
    grow(true, part_of(task, begin, grown));
    search_once(aim, {}, part_of(task, grown, end));
    if (rank(result_, goal.energy) < rank(before, goal.energy)) continue;
    result_ = std::move(before);
    missed_ = std::move(missed);
    level_ = best;
  }
}

void GroupPlanning::search_once(const SlitGoal& goal, const std::function<void()>& found, const Task& task) {
  SlitGoal aim = goal;
  Result best;
  const std::array<RoundWork, tuning::kRounds + 1> work = work_of_rounds(*group_, level_, goal.budget);
  const double all = group_->work_on(level_, goal.budget);
  double done = 0.0;
  const auto next = [&](double amount) {
    const double begin = done / all;
    done += amount;
    return part_of(task, begin, done / all);
  };
  std::vector<Slit> last;  // of the round before
  const auto is_same = [](const Slit& a, const Slit& b) { return a.path == b.path && a.image == b.image; };
  for (int round = 0;; ++round) {
    const bool is_simplified = group_->simplified_at(level_) != nullptr;
    bool is_start = true;  // which grow() has shown
    const auto tell = [&](const SlitPlan& plan) {
      if (std::exchange(is_start, false) || round > 0 || !found) return;
      show(plan, task);
      found();
    };
    if (round > 0) start_ = SlitSolver(problem(), roots_).solve(std::move(start_.slits), next(0.0));
    const SlitPlan plan =
        search_slits(problem(), std::move(start_), roots_, aim, tell, next(work[index(round)].search));
    steps_ += plan.work;
    if (round == 0) missed_ = missed_pieces(plan, goal.energy);
    std::vector<Slit> slits = completed(on_original(plan.slits, task), plan.slits, task);
    // The moved bound has given the same slits. Another round would rarely give others.
    if (round > 0 && std::ranges::equal(slits, last, is_same)) break;
    last = slits;
    Result solved = solved_on_original(std::move(slits), next(work[index(round)].map));
    // The simplified mesh distorts less or more than the original one. The bound is moved by as much.
    const double excess = solved.energy - goal.energy;
    const bool is_near = excess <= 0.0 && (excess > -tuning::kNearBound || plan.slits.empty());
    if (round == 0 || rank(solved, goal.energy) < rank(best, goal.energy)) best = std::move(solved);
    const double energy = plan.energy - excess - tuning::kMargin;
    const bool is_last = !is_simplified || !std::isfinite(goal.energy) || round == tuning::kRounds || is_near ||
                         plan.energy > aim.energy || !(energy > 4.0);
    if (is_last) break;
    aim.energy = energy;
    aim.budget *= tuning::kLaterBudget;
    start_ = {};
    start_.slits = plan.slits;
  }
  result_ = std::move(best);
}

std::vector<Slit> GroupPlanning::on_original(const std::vector<Slit>& slits, const Task& task) const {
  std::vector<Slit> all = rings_;
  all.insert(all.end(), slits.begin(), slits.end());
  const GroupProblem::Simplified* simple = group_->simplified_at(level_);
  if (simple == nullptr) return all;
  all = carried_slits(problem(), simple->vertices, group_->original, all, task);
  // A closed cut may not have been carried whole.
  if (least_pieces_ > 0) {
    std::ranges::move(halving_cuts(with_seams(group_->original, all, task), least_pieces_, task),
                      std::back_inserter(all));
  }
  return all;
}

/// Adds the cuts that pieces of the original mesh need where slits were not carried whole. `simple`: the slits that
/// were carried, beside the rings.
std::vector<Slit> GroupPlanning::completed(std::vector<Slit> slits, const std::vector<Slit>& simple,
                                           const Task& task) const {
  if (group_->simplified_at(level_) == nullptr) return slits;
  if (missing_cuts_of(group_->original, slits, task) > missing_cuts_of(problem(), simple, task)) {
    const SlitProblem original = with_seams(group_->original, slits, task);
    std::ranges::move(
        grow_tree(original, {.has_tips = false, .keeps_holes = tree_goal_.keeps_holes}, part_of(task, 0.0, 0.0)).slits,
        std::back_inserter(slits));
  }
  return slits;
}

std::vector<std::int32_t> GroupPlanning::missed_pieces(const SlitPlan& plan, double bound) const {
  std::vector<std::int32_t> missed;
  for (std::int32_t p = 0; index(p) < plan.maps.size(); ++p) {
    const auto& map = plan.maps[p];
    if (!map || map->map.overlaps || !(map->map.energy <= bound)) missed.push_back(p);
  }
  return missed;
}

GroupPlanning::Result GroupPlanning::solved_on_original(std::vector<Slit> slits, const Task& task) const {
  const SlitProblem& original = group_->original;
  Result solved;
  solved.maps = solve_cut(*original.mesh, cut_of(original, slits, {}).is_cut, task);
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
  solved.energy = is_mapped ? mean_energy(std::move(energies), task) : kInfinity;
  for (const Slit& slit : slits) solved.price += original.price(slit);
  solved.slits = std::move(slits);
  return solved;
}

}  // namespace seamwire::detail
