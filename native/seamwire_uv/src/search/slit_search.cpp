// SPDX-License-Identifier: GPL-3.0-or-later
#include "search/slit_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "detail/rounded.hpp"
#include "detail/run_on_threads.hpp"
#include "search/slit_solver.hpp"
#include "slits/slit_paths.hpp"
#include "slits/slit_plan.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

/// How much more than an isometry the triangles around each vertex have, by area.
std::vector<double> excess_at_vertices(const SlitProblem& problem, const SlitPlan& plan) {
  const PlanMesh& mesh = *problem.mesh;
  std::vector<double> excess(mesh.vertex_count(), 0.0);
  for (const auto& map : plan.maps) {
    if (!map) continue;
    for (std::size_t k = 0; k < map->energies.size(); ++k) {
      const std::int32_t f = map->island.faces[k];
      const double above = std::clamp(map->energies[k] - 4.0, 0.0, tuning::kMostExcess);
      for (const std::int32_t v : mesh.triangles[f]) excess[v] += problem.areas[f] / 3.0 * above;
    }
  }
  return excess;
}

/// Spreads amounts at vertices over about a radius, as heat spreads. The total stays.
std::vector<double> spread(const PlanMesh& mesh, std::vector<double> amounts, double radius, const Task& task) {
  Poll poll(task);
  const double median = mesh.median_length;
  if (!(median > 0.0)) return amounts;
  const auto rounds = static_cast<int>(std::clamp(radius * radius / (median * median), 1.0, 200.0));
  std::vector<double> next(amounts.size());
  for (int round = 0; round < rounds; ++round) {
    std::ranges::fill(next, 0.0);
    for (std::int32_t v = 0; index(v) < amounts.size(); ++v) {
      poll.next();
      const auto around = mesh.all_neighbors[v];
      if (around.empty()) continue;
      next[v] += 0.5 * amounts[v];
      const double share = 0.5 * amounts[v] / static_cast<double>(around.size());
      for (const PlanNeighbor& neighbor : around) next[neighbor.vertex] += share;
    }
    amounts.swap(next);
  }
  return amounts;
}

/// Adds the vertices with the largest values that are local maxima and apart from those chosen before.
void add_peaks(const PlanMesh& mesh, std::span<const double> values, std::span<const double> from_cut,
               std::size_t count, std::vector<std::int32_t>& chosen) {
  std::vector<std::int32_t> maxima;
  for (std::int32_t v = 0; index(v) < values.size(); ++v) {
    if (!(values[v] > 0.0) || !(from_cut[v] > tuning::kApart) || !std::isfinite(from_cut[v])) continue;
    const bool is_highest = std::ranges::all_of(
        mesh.all_neighbors[v], [&](const PlanNeighbor& next) { return values[next.vertex] <= values[v]; });
    if (is_highest) maxima.push_back(v);
  }
  std::ranges::stable_sort(maxima, std::ranges::greater(), [&](std::int32_t v) { return values[v]; });
  for (const std::int32_t v : maxima) {
    if (count == 0) return;
    const bool is_apart = std::ranges::all_of(
        chosen, [&](std::int32_t other) { return (mesh.points[v] - mesh.points[other]).norm() > tuning::kApart; });
    if (!is_apart) continue;
    chosen.push_back(v);
    --count;
  }
}

/// Distances along edges from the cut; infinite if unreachable.
std::vector<double> distances_from_cut(const PlanMesh& mesh, std::span<const std::uint8_t> is_on_cut,
                                       const Task& task) {
  std::vector<std::int32_t> cut;
  for (std::int32_t v = 0; index(v) < is_on_cut.size(); ++v) {
    if (is_on_cut[v] != 0) cut.push_back(v);
  }
  return edge_distances(mesh, cut, task);
}

}  // namespace

std::vector<std::int32_t> distortion_peaks(const SlitProblem& problem, const SlitPlan& plan,
                                           std::span<const std::uint8_t> is_on_cut, const Task& task) {
  const PlanMesh& mesh = *problem.mesh;
  const std::vector<double> from_cut = distances_from_cut(mesh, is_on_cut, task);
  const std::vector<double> excess = excess_at_vertices(problem, plan);
  const std::vector<double> areas = vertex_areas(mesh, face_frames(mesh, task));
  const auto density = [&](double radius) {
    std::vector<double> amounts = spread(mesh, excess, radius, task);
    const std::vector<double> around = spread(mesh, areas, radius, task);
    for (std::size_t v = 0; v < amounts.size(); ++v) amounts[v] = around[v] > 0.0 ? amounts[v] / around[v] : 0.0;
    return amounts;
  };
  std::vector<std::int32_t> chosen;
  add_peaks(mesh, density(tuning::kClosePeak), from_cut, tuning::kOfEachKind, chosen);
  add_peaks(mesh, density(tuning::kWidePeak), from_cut, tuning::kOfEachKind, chosen);
  add_peaks(mesh, from_cut, from_cut, tuning::kOfEachKind, chosen);
  return chosen;
}

std::vector<std::int32_t> spread_vertices(const SlitProblem& problem, std::span<const std::uint8_t> is_on_cut,
                                          std::size_t count, const Task& task) {
  std::vector<double> away = distances_from_cut(*problem.mesh, is_on_cut, task);
  for (double& distance : away) distance = std::isfinite(distance) ? distance : 0.0;
  std::vector<std::int32_t> chosen;
  while (chosen.size() < count) {
    const auto farthest = std::ranges::max_element(away);
    if (farthest == away.end() || *farthest <= 0.0) break;
    chosen.push_back(static_cast<std::int32_t>(farthest - away.begin()));
    const std::vector<double> from_it = edge_distances(*problem.mesh, {&chosen.back(), 1}, task);
    for (std::size_t v = 0; v < away.size(); ++v) away[v] = std::min(away[v], from_it[v]);
  }
  return chosen;
}

namespace {

constexpr std::size_t kFullSolves = 2;  // of candidates at once
constexpr std::size_t kBatch = 2;       // solves at once; the same on every machine

/// The boundary loops of an island, of mesh vertices.
std::vector<std::vector<std::int32_t>> loops_of(const Island& island) {
  std::vector<std::vector<std::int32_t>> loops = island.boundaries();
  for (std::vector<std::int32_t>& loop : loops) {
    for (std::int32_t& v : loop) v = island.vertices[v];
  }
  return loops;
}

/// Finds slits from holes to other boundary loops of the same piece.
class JoinFinder {
 public:
  JoinFinder(const SlitProblem& problem, const SlitPlan& plan, const Task& task)
      : problem_(problem), task_(task), excess_(excess_at_vertices(problem, plan)) {
    for (std::int32_t p = 0; index(p) < plan.maps.size(); ++p) {
      if (plan.maps[p]) add_loops(p, loops_of(plan.maps[p]->island));
    }
    std::ranges::stable_sort(holes_, std::ranges::greater(), [](const Hole& hole) { return hole.excess; });
  }

  /// The slits from the holes around which the map is distorted most.
  std::vector<Slit> most_useful() const {
    std::vector<Slit> slits;
    std::vector<std::uint8_t> is_done(loops_.size(), 0);
    for (const Hole& hole : holes_) {
      if (slits.size() == tuning::kOfEachKind) break;
      if (std::exchange(is_done[hole.loop], 1) != 0) continue;
      std::optional<Slit> slit = join(hole.loop);
      if (!slit) continue;
      if (!slit->image.empty()) mark_loops_with(slit->image.back(), is_done);
      slits.push_back(std::move(*slit));
    }
    return slits;
  }

 private:
  struct Loop {
    std::int32_t piece;
    std::vector<std::int32_t> vertices;
  };
  struct Hole {
    double excess;
    std::size_t loop;
  };

  void add_loops(std::int32_t piece, std::vector<std::vector<std::int32_t>> loops) {
    if (loops.size() < 2) return;
    const auto length = [&](const auto& loop) { return rounded(loop_length(loop, problem_.mesh->points)); };
    const auto longest = std::ranges::max_element(loops, {}, length) - loops.begin();
    for (std::ptrdiff_t i = 0; i < std::ssize(loops); ++i) {
      double excess = 0.0;
      for (const std::int32_t v : loops[i]) excess += excess_[v];
      if (i != longest && excess > 0.0) holes_.push_back({rounded(excess), loops_.size()});
      loops_.push_back({piece, std::move(loops[i])});
    }
  }

  void mark_loops_with(std::int32_t vertex, std::vector<std::uint8_t>& marks) const {
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      if (lies_on(vertex, i)) marks[i] = 1;
    }
  }

  bool lies_on(std::int32_t vertex, std::size_t loop) const {
    return std::ranges::find(loops_[loop].vertices, vertex) != loops_[loop].vertices.end();
  }
  bool is_on_plane(std::int32_t v) const { return problem_.reflection && problem_.reflection->sides[v] == 0; }

  /// The cheapest slit from another loop to a hole.
  std::optional<Slit> join(std::size_t hole) const {
    const PlanMesh& mesh = *problem_.mesh;
    const std::vector<std::int32_t>& own = loops_[hole].vertices;
    std::vector<std::uint8_t> from(mesh.vertex_count(), 0), is_outside(mesh.edge_count(), 1);
    for (const std::int32_t v : own) from[v] = 1;
    std::vector<std::uint8_t> starts = from;  // of images too
    if (problem_.reflection) {
      for (const std::int32_t v : own) {
        if (problem_.reflection->images[v] >= 0) starts[problem_.reflection->images[v]] = 1;
      }
    }
    for (const std::int32_t f : problem_.by_piece[loops_[hole].piece].faces) {
      for (std::int32_t i = 0; i < 3; ++i) is_outside[mesh.edge_of[3 * f + i]] = 0;
    }
    const SlitFinder finder(problem_, from, starts, task_, 1.0, std::move(is_outside));
    const bool has_plane = std::ranges::any_of(own, [&](std::int32_t v) { return is_on_plane(v); });
    std::pair<double, std::int32_t> best{kInfinity, -1};
    std::size_t other = hole;
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      if (i == hole || loops_[i].piece != loops_[hole].piece) continue;
      // Between two loops across the mirror plane, a slit elsewhere and its image would part the piece.
      const bool stays_on_plane =
          has_plane && std::ranges::any_of(loops_[i].vertices, [&](std::int32_t v) { return is_on_plane(v); });
      for (const std::int32_t v : loops_[i].vertices) {
        if ((stays_on_plane && !is_on_plane(v)) || from[v] != 0) continue;
        const std::pair<double, std::int32_t> found{finder.price_to(v), v};
        if (!(found < best)) continue;
        best = found;
        other = i;
      }
    }
    std::optional<Slit> slit = best.second < 0 ? std::nullopt : finder.slit_to(best.second);
    if (!slit) return std::nullopt;
    slit->is_join = true;
    for (auto* chain : {&slit->path, &slit->image}) std::ranges::reverse(*chain);
    const auto joins_as_well = [&](std::size_t one, std::size_t two) {
      return lies_on(slit->image.front(), one) && lies_on(slit->image.back(), two);
    };
    const bool parts = !slit->image.empty() && (joins_as_well(hole, other) || joins_as_well(other, hole));
    if (parts) slit->image.clear();
    return slit;
  }

  const SlitProblem& problem_;
  Task task_;
  std::vector<double> excess_;
  std::vector<Loop> loops_;
  std::vector<Hole> holes_;  // most distorted first
};

/// How a slit of a plan might become shorter.
struct Cutback {
  double needed = 0.0;       ///< the share of its length that has to stay
  bool is_whole = false;     ///< whether it goes whole or not at all
  std::size_t level = 0;     ///< which of kShorterShares is tried next; their number if all were tried in vain
  double ratio = kInfinity;  ///< saved price for each lost energy, as of the last look; infinite before the first one
  std::optional<SlitPlan> plan = std::nullopt;  ///< what comes of it, if it was looked at for the present plan

  bool is_open() const { return level < tuning::kShorterShares.size(); }
  double share() const { return std::max(tuning::kShorterShares[level], needed); }
  /// Goes on to a share that leaves more than has to stay.
  void skip_useless_shares() {
    while (is_open() && (needed >= 1.0 || (level > 0 && (is_whole || tuning::kShorterShares[level] <= needed)))) {
      ++level;
    }
  }
  void fail() {
    ++level;
    ratio = kInfinity;
    plan.reset();
    skip_useless_shares();
  }
};

/// The results of a plan that was tried.
struct Trial {
  double energy = kInfinity;
  double price = 0.0;
  bool overlaps = false;
};

class Search {
 public:
  Search(const SlitProblem& problem, std::vector<std::int32_t> roots, const SlitGoal& goal,
         const std::function<void(const SlitPlan&)>& found, const Task& task)
      : problem_(problem), solver_(problem, std::move(roots)), goal_(goal), found_(found), task_(task) {}

  SlitPlan run(SlitPlan plan) {
    steps_ += plan.work;
    offer(plan);
    if (std::isfinite(goal_.energy)) {  // without a bound, the tree is all that is asked for
      grow_finer(plan);
      // Exposed places are cut only if the bound is out of reach otherwise.
      const bool has_exposed =
          std::ranges::any_of(problem_.prices.is_exposed, [](std::uint8_t exposed) { return exposed != 0; });
      if (!is_within(plan) && !goal_.may_be_exposed && has_exposed) {
        goal_.may_be_exposed = true;
        grow_finer(plan);
      }
      shrink(plan);
      while (is_within(best_) && exchange(best_)) continue;
    }
    best_.work = steps_;
    return std::move(best_);
  }

 private:
  bool is_within(const SlitPlan& plan) const {
    return std::isfinite(plan.energy) && plan.energy <= goal_.energy && !plan.overlaps;
  }
  bool is_spent() const { return steps_ >= goal_.budget; }
  double fraction() const { return std::min(1.0, steps_ / goal_.budget); }
  /// For work on this thread: it can be cancelled, and reports the progress of the search.
  Task own_task() const {
    return {.stop = task_.stop, .progress = [this](double) { return !task_.progress || task_.progress(fraction()); }};
  }

  /// Keeps a plan if it is the best one.
  void offer(const SlitPlan& plan) {
    task_.check(fraction());
    const auto rank = [&](const SlitPlan& one) {
      return is_within(one) ? std::pair(0.0, one.price) : std::pair(1.0, one.energy + (one.overlaps ? 100.0 : 0.0));
    };
    if (!best_.maps.empty() && !(rank(plan) < rank(best_))) return;
    best_ = plan;
    if (found_) found_(plan);
  }

  /// Calls work(i, task) for each i below `count` at the same time, and adds up what it returns.
  template <class Work>
  void in_parallel(std::size_t count, const Work& work) {
    std::vector<double> steps(count, 0.0);
    run_on_threads(
        count, task_, [this](std::size_t) { return fraction(); },
        [&](std::size_t i, const Task& own) { steps[i] = work(i, own); });
    for (const double one : steps) steps_ += one;
  }

  /// Slits that might be added.
  std::vector<Slit> candidates(const SlitPlan& plan, bool is_thorough) const {
    const Task task = own_task();
    const Cut cut = solver_.cut(plan.slits);
    const PlanMesh& mesh = *problem_.mesh;
    std::vector<std::int32_t> ends;
    std::vector<std::int32_t> places = distortion_peaks(problem_, plan, cut.is_on_cut, task);
    if (is_thorough) {
      const std::vector<std::int32_t> more = spread_vertices(problem_, cut.is_on_cut, tuning::kThoroughPlaces, task);
      places.insert(places.end(), more.begin(), more.end());
    }
    for (std::int32_t v : places) {
      if (problem_.reflection && problem_.reflection->sides[v] < 0 && problem_.reflection->images[v] >= 0) {
        v = problem_.reflection->images[v];
      }
      // Places all over the surface are as far apart as they can be, and may all be near each other on a small piece.
      const bool is_new = std::ranges::all_of(ends, [&](std::int32_t end) {
        return is_thorough ? v != end : (mesh.points[v] - mesh.points[end]).norm() > tuning::kApart;
      });
      if (is_new && cut.is_on_cut[v] == 0) ends.push_back(v);
    }
    std::vector<Slit> found;
    const SlitFinder cheap(problem_, cut.is_on_cut, cut.is_on_cut, task);
    const SlitFinder direct(problem_, cut.is_on_cut, cut.is_on_cut, task, 0.5);
    const auto add = [&](std::optional<Slit> slit) {
      const bool is_new = slit && (goal_.may_be_exposed || !is_exposed(problem_, *slit)) &&
                          std::ranges::none_of(found, [&](const Slit& one) { return one.path == slit->path; });
      if (is_new) found.push_back(std::move(*slit));
    };
    for (const std::int32_t v : ends) {
      for (const SlitFinder* finder : {&cheap, &direct}) add(finder->slit_to(v));
    }
    for (Slit& slit : JoinFinder(problem_, plan, task).most_useful()) add(std::move(slit));
    return found;
  }

  /// The gain of a plan over another one, down to a bound on the energy, divided by the additional cost.
  double gain_ratio(const SlitPlan& before, const Trial& after, double bound) const {
    const double price = std::max(after.price - before.price, 0.0) + tuning::kChoicePrice * tuning::kSlitPrice;
    return std::max(before.energy - std::max(after.energy, bound), 0.0) / price;
  }

  bool grow_once(SlitPlan& plan, double bound, bool is_thorough) {
    const std::vector<Slit> slits = candidates(plan, is_thorough);
    const SlitPlan loose = solver_.relaxed(plan, relaxed_, own_task());
    steps_ += loose.work;
    std::vector<Trial> trials(slits.size());
    in_parallel(slits.size(), [&](std::size_t i, const Task& own) {
      own.check(0.0);
      const SlitPlan trial = solver_.try_out(loose, slits[i], own);
      trials[i] = {trial.energy, trial.price, trial.overlaps};
      return trial.work;
    });
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < slits.size(); ++i) {
      // The barrier against overlaps raises the present energy. Trials have no barrier, so their gain is measured from
      // the relaxed plan.
      const double gain = loose.energy - trials[i].energy;
      const bool is_repaired = plan.overlaps && !trials[i].overlaps;
      if (!(gain >= least_gain_) && !is_repaired) continue;
      double ratio = gain_ratio(plan, {plan.energy - gain, trials[i].price, trials[i].overlaps}, bound);
      if (trials[i].overlaps && !loose.overlaps) ratio *= tuning::kOverlappingGain;
      if (is_repaired) ratio = std::max(ratio, 0.0) + 1.0;
      if (ratio > 0.0) order.push_back({-ratio, i});
    }
    std::ranges::sort(order);
    // A trial may overlap itself, or be far from its minimum. So the most promising ones are solved.
    for (std::size_t begin = 0; begin < order.size() && !is_spent(); begin += kFullSolves) {
      std::vector<SlitPlan> full(std::min(kFullSolves, order.size() - begin));
      in_parallel(full.size(), [&](std::size_t k, const Task& own) {
        full[k] = solver_.extend(plan, slits[order[begin + k].second], own);
        return full[k].work;
      });
      std::size_t best = full.size();
      double most = 0.0;
      for (std::size_t k = 0; k < full.size(); ++k) {
        if ((full[k].overlaps && !plan.overlaps) || !(plan.energy - full[k].energy >= least_gain_)) continue;
        const double ratio = plan.overlaps && !full[k].overlaps
                                 ? kInfinity
                                 : gain_ratio(plan, {full[k].energy, full[k].price, full[k].overlaps}, bound);
        if (ratio <= most) continue;
        most = ratio;
        best = k;
      }
      if (best == full.size()) continue;
      plan = std::move(full[best]);
      return true;
    }
    return false;
  }

  void grow(SlitPlan& plan, double bound) {
    while (!is_spent()) {
      const bool is_grown = grow_once(plan, bound, false) || (!is_within(plan) && grow_once(plan, bound, true));
      if (!is_grown) return;
      offer(plan);
    }
  }

  /// Grows, and takes slits that gain less while the bound is not reached.
  void grow_finer(SlitPlan& plan) {
    least_gain_ = tuning::kLeastGain;
    grow(plan, goal_.energy - tuning::kGrowBelow);
    while (!is_within(plan) && !is_spent() && least_gain_ > tuning::kFinestGain) {
      least_gain_ = std::max(0.25 * least_gain_, tuning::kFinestGain);
      grow(plan, goal_.energy - tuning::kGrowBelow);
    }
    least_gain_ = tuning::kLeastGain;
  }

  SlitPlan cut_back(const SlitPlan& plan, std::size_t slit, double share, const Task& task) const {
    std::vector<Slit> slits = plan.slits;
    if (std::optional<Slit> left = shortened(*problem_.mesh, slits[slit], share)) {
      slits[slit] = std::move(*left);
    } else {
      slits.erase(slits.begin() + static_cast<std::ptrdiff_t>(slit));
    }
    return solver_.solve_changed(std::move(slits), plan, pieces_of(problem_, plan.slits[slit]), goal_.energy, task);
  }

  std::vector<Cutback> first_cutbacks(const SlitPlan& plan) const {
    std::vector<Cutback> cutbacks(plan.slits.size());
    for (std::size_t k = 0; k < cutbacks.size(); ++k) {
      cutbacks[k].needed = needed_share(*problem_.mesh, plan.slits, k);
      cutbacks[k].is_whole = plan.slits[k].is_join;
      if (cutbacks[k].is_whole && cutbacks[k].needed > 0.0) cutbacks[k].needed = 1.0;
      cutbacks[k].skip_useless_shares();
    }
    return cutbacks;
  }

  /// Looks at the cutbacks with the highest ratios that were not looked at for this plan, several at once.
  void look_at_best(const SlitPlan& plan, std::vector<Cutback>& cutbacks) {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < cutbacks.size(); ++k) {
      if (cutbacks[k].is_open() && !cutbacks[k].plan) order.push_back(k);
    }
    std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t k) { return cutbacks[k].ratio; });
    order.resize(std::min(order.size(), kBatch));
    in_parallel(order.size(), [&](std::size_t i, const Task& own) {
      own.check(0.0);
      Cutback& cutback = cutbacks[order[i]];
      SlitPlan result = cut_back(plan, order[i], cutback.share(), own);
      const double work = result.work, saved = plan.price - result.price;
      const double ratio = saved / std::max(result.energy - plan.energy, 1e-4);
      if (is_within(result) && saved > 0.0) {
        cutback.ratio = ratio;
        cutback.plan = std::move(result);
      } else {
        cutback.fail();
      }
      return work;
    });
  }

  /// Lazy greedy: the ratios of the last look say which slits are worth another one.
  void shrink(SlitPlan& plan) {
    if (!is_within(plan)) return;
    std::vector<Cutback> cutbacks = first_cutbacks(plan);
    while (!is_spent()) {
      std::size_t best = cutbacks.size();
      for (std::size_t k = 0; k < cutbacks.size(); ++k) {
        if (cutbacks[k].is_open() && (best == cutbacks.size() || cutbacks[k].ratio > cutbacks[best].ratio)) best = k;
      }
      if (best == cutbacks.size()) return;
      if (!cutbacks[best].plan) {
        look_at_best(plan, cutbacks);
        continue;
      }
      SlitPlan next = std::move(*cutbacks[best].plan);
      if (next.slits.size() < plan.slits.size()) cutbacks.erase(cutbacks.begin() + static_cast<std::ptrdiff_t>(best));
      plan = std::move(next);
      offer(plan);
      for (Cutback& cutback : cutbacks) cutback.plan.reset();
    }
  }

  /// The slits that cost most for what they gain, without those that others need.
  std::vector<std::size_t> worst_slits(const SlitPlan& plan) {
    std::vector<std::size_t> free;
    for (std::size_t k = 0; k < plan.slits.size(); ++k) {
      if (without_slit(plan.slits, k).size() < plan.slits.size()) free.push_back(k);
    }
    std::vector<std::pair<double, std::size_t>> order(free.size());
    in_parallel(free.size(), [&](std::size_t i, const Task& own) {
      own.check(0.0);
      std::vector<Slit> slits = without_slit(plan.slits, free[i]);
      std::vector<std::int32_t> pieces = pieces_of(problem_, plan.slits[free[i]]);
      const SlitPlan result = solver_.solve_changed(std::move(slits), plan, pieces, kInfinity, own);
      const double gained = std::max(result.energy - plan.energy, 1e-4);
      order[i] = {-(plan.price - result.price) / gained, free[i]};
      return result.work;
    });
    std::ranges::sort(order);
    std::vector<std::size_t> worst;
    worst.reserve(order.size());
    for (const auto& [ratio, k] : order) worst.push_back(k);
    return worst;
  }

  /// Tries others in the place of the worst slits; whether that made a better plan.
  bool exchange(const SlitPlan& plan) {
    const SlitPlan before =
        plan;  // NOLINT(performance-unnecessary-copy-initialization): `plan` is replaced by better ones
    if (is_spent()) return false;
    std::size_t tries = 0;
    for (const std::size_t k : worst_slits(before)) {
      if (tries++ == tuning::kExchanges || is_spent()) return false;
      SlitPlan next = solver_.solve(without_slit(before.slits, k), own_task());
      steps_ += next.work;
      grow(next, goal_.energy - tuning::kGrowBelow);
      shrink(next);
      if (is_within(next) && next.price < before.price) {
        offer(next);
        return true;
      }
    }
    return false;
  }

  const SlitProblem& problem_;
  SlitSolver solver_;
  SlitGoal goal_;
  const std::function<void(const SlitPlan&)>& found_;
  const Task& task_;
  SlitPlan best_;
  RelaxedMaps relaxed_;
  double steps_ = 0.0;
  double least_gain_ = tuning::kLeastGain;
};

}  // namespace

SlitPlan search_slits(const SlitProblem& problem, SlitPlan start, std::vector<std::int32_t> roots, const SlitGoal& goal,
                      const std::function<void(const SlitPlan&)>& found, const Task& task) {
  return Search(problem, std::move(roots), goal, found, task).run(std::move(start));
}

}  // namespace seamwire::detail
