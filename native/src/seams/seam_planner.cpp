// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/seams/seam_planner.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "detail/run_on_threads.hpp"
#include "seams/group_planning.hpp"
#include "seams/prepared_surface.hpp"
#include "seams/whole_plan.hpp"
#include "tuning/constants.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// Groups with fewer triangles are planned at the same time, on one thread each.
constexpr std::size_t kSmallGroup = 600;

void check_options(const Surface& surface, const SeamPlannerOptions& options) {
  check_strength(options.strength);
  if (options.mirror < -1 || options.mirror > 2) {
    throw InvalidInput("mirror is " + std::to_string(options.mirror) + ", not an axis from 0 to 2, or -1");
  }
  if (options.front && !(options.front->allFinite() && options.front->norm() > 0.0)) {
    throw InvalidInput("front is not a direction: it has no length, or is not finite");
  }
  const std::size_t count = surface.vertex_count();
  if (!options.weights.empty() && options.weights.size() != count) {
    throw InvalidInput("weights has " + std::to_string(options.weights.size()) + " items: there are " +
                       std::to_string(count) + " vertices");
  }
  for (std::size_t v = 0; v < options.weights.size(); ++v) {
    if (!(options.weights[v] >= 0.0)) throw InvalidInput("weights: item " + std::to_string(v) + " is not 0 or more");
  }
  for (const auto& [a, b] : options.seams) {
    for (const std::int32_t v : {a, b}) check_index(v, count, "seams: vertex");
  }
}

/// One call of SeamPlanner::plan().
class Planning {
 public:
  Planning(const PreparedSurface& prepared, const SeamGoal& goal, const std::function<void(const SeamPlan&)>& found,
           const Task& task)
      : prepared_(prepared),
        goal_(goal),
        found_(found),
        task_(task),
        plans_(prepared.groups.begin(), prepared.groups.end()),
        whole_(prepared, plans_, goal.distortion) {}

  SeamPlan run() {
    part_limbs(part_of(task_, 0.0, kLimbsEnd));
    const bool is_bounded = std::isfinite(goal_.distortion);
    const double budget = goal_.steps > 0 ? static_cast<double>(goal_.steps) : tuning::kBudget;
    const double search_end = kTreesEnd + (1.0 - kTreesEnd) * share_of_search(budget);
    for_each_group(part_of(task_, kLimbsEnd, kTreesEnd),
                   [&](std::size_t g, const Task& own) { plans_[g].grow(is_bounded, own); });
    tell();
    const double bound = bound_of_groups();
    const SlitGoal aim{.energy = bound, .may_cross_faces = goal_.distortion < tuning::kLowStretch, .budget = budget};
    for_each_group(part_of(task_, kTreesEnd, search_end), [&](std::size_t g, const Task& own) {
      plans_[g].search(
          aim, is_small(g) ? std::function<void()>() : [&] { tell(); }, own);
    });
    return whole_.finished(bound, part_of(task_, search_end, 1.0));
  }

 private:
  static constexpr double kLimbsEnd = 0.02, kTreesEnd = 0.06;  // shares of all work

  bool is_small(std::size_t group) const {
    return plans_.size() > 1 && groups()[group].searched().mesh.face_count() < kSmallGroup;
  }
  const std::vector<GroupProblem>& groups() const { return prepared_.groups; }
  /// The share of the search in the work of the search and of what follows.
  double share_of_search(double budget) const;
  void part_limbs(const Task& task);
  void halve_groups(const Task& task);
  void for_each_group(const Task& task, const std::function<void(std::size_t, const Task&)>& work) const;
  double bound_of_groups() const;
  void tell() const {
    if (found_) found_(whole_.shown({.stop = task_.stop, .progress = {}}));
  }

  const PreparedSurface& prepared_;
  const SeamGoal& goal_;
  const std::function<void(const SeamPlan&)>& found_;
  const Task& task_;
  std::vector<GroupPlanning> plans_;  // by group
  WholePlan whole_;
};

double Planning::share_of_search(double budget) const {
  constexpr double kStepsOfMeasuring = 4.0;  // wires, islands and the measure, in Newton steps on the surface
  double search = 0.0;
  if (std::isfinite(goal_.distortion)) {
    for (const GroupProblem& group : groups()) search += group.work(budget);
  }
  double after = kStepsOfMeasuring;
  if (prepared_.wires->are_across()) after += (SlitChains::kClosest + 1) * (kStepsOfMap + kStepsOfMeasuring);
  after *= static_cast<double>(prepared_.mesh().face_count());
  return after > 0.0 ? search / (search + after) : 1.0;
}

/// Cuts around limbs at their necks, as many as the goal asks for.
void Planning::part_limbs(const Task& task) {
  std::size_t islands = 0;
  for (std::size_t g = 0; g < plans_.size(); ++g) islands += groups()[g].places.size() * index(plans_[g].piece_count());
  if (goal_.islands <= islands) return;
  struct Neck {
    std::size_t group;
    NeckRing ring;
  };
  std::vector<Neck> necks;
  for (std::size_t g = 0; g < plans_.size(); ++g) {
    const auto count = static_cast<double>(plans_.size());
    const Task own = part_of(task, static_cast<double>(g) / count, static_cast<double>(g + 1) / count);
    for (NeckRing& ring : plans_[g].necks(own)) necks.push_back({g, std::move(ring)});
  }
  std::ranges::stable_sort(necks, std::ranges::greater(), [](const Neck& neck) { return neck.ring.narrowness; });
  std::vector<std::vector<NeckRing>> chosen(plans_.size());
  for (Neck& neck : necks) {
    if (islands >= goal_.islands) break;
    islands += groups()[neck.group].places.size() * (neck.ring.image.empty() ? 1 : 2);
    chosen[neck.group].push_back(std::move(neck.ring));
  }
  for (std::size_t g = 0; g < plans_.size(); ++g) plans_[g].part(chosen[g]);
  halve_groups(task);
}

/// Cuts into halves, in the group whose pieces are the largest, until there are as many islands as the goal asks for.
void Planning::halve_groups(const Task& task) {
  std::vector<std::size_t> counts, most;
  std::size_t islands = 0;
  for (std::size_t g = 0; g < plans_.size(); ++g) {
    counts.push_back(index(plans_[g].piece_count()));
    most.push_back(plans_[g].most_pieces());
    islands += groups()[g].places.size() * counts[g];
  }
  if (islands >= goal_.islands) return;
  const auto size = [&](std::size_t g) { return groups()[g].size * groups()[g].size / static_cast<double>(counts[g]); };
  while (islands < goal_.islands) {
    std::size_t largest = plans_.size();
    for (std::size_t g = 0; g < plans_.size(); ++g) {
      if (counts[g] < most[g] && (largest == plans_.size() || size(g) > size(largest))) largest = g;
    }
    if (largest == plans_.size()) break;
    ++counts[largest];
    islands += groups()[largest].places.size();
  }
  for (std::size_t g = 0; g < plans_.size(); ++g) plans_[g].halve(counts[g], task);
}

/// Works on small groups at the same time, then on the others one after another.
void Planning::for_each_group(const Task& task, const std::function<void(std::size_t, const Task&)>& work) const {
  std::vector<std::size_t> small, large;
  for (std::size_t g = 0; g < plans_.size(); ++g) (is_small(g) ? small : large).push_back(g);
  const auto size = [&](std::size_t g) { return static_cast<double>(groups()[g].searched().mesh.face_count()); };
  double all = 0.0, done = 0.0;
  for (std::size_t g = 0; g < plans_.size(); ++g) all += size(g);
  std::vector<double> ends = {0.0};
  for (const std::size_t g : small) ends.push_back(ends.back() + size(g));
  run_on_threads(
      small.size(), task, [&](std::size_t count) { return ends[count] / all; },
      [&](std::size_t i, const Task& own) { work(small[i], own); });
  done = ends.back();
  if (!small.empty() && !large.empty()) tell();
  for (const std::size_t g : large) {
    work(g, part_of(task, done / all, (done + size(g)) / all));
    done += size(g);
  }
}

/// The bound on the energy of each group, for the mean over the surface to be within the goal. Groups without seams
/// that distort less leave more to the others.
double Planning::bound_of_groups() const {
  constexpr double kUsed = 1.0 - 1e-6;  // of what they leave: rounding must not matter
  if (!std::isfinite(goal_.distortion)) return goal_.distortion;
  double left = 0.0, area = 0.0;
  std::vector<std::pair<double, double>> above;  // excess and area
  for (std::size_t g = 0; g < plans_.size(); ++g) {
    const GroupPlanning::Result& plan = plans_[g].result();
    const double own = groups()[g].counted_area(), excess = plan.energy - goal_.distortion;
    if (excess > 0.0) {
      above.emplace_back(excess, own);
      area += own;
    } else if (plan.slits.empty() && !plan.overlaps) {
      left -= kUsed * excess * own;
    }
  }
  std::ranges::sort(above);
  double level = 0.0;
  for (const auto& [excess, own] : above) {
    const double needed = (excess - level) * area;
    if (!(needed < left)) return goal_.distortion + level + (left > 0.0 ? left / area : 0.0);
    left -= needed;
    level = excess;
    area -= own;
  }
  return goal_.distortion + level;
}

}  // namespace

struct SeamPlanner::Impl {
  PreparedSurface prepared;
};

SeamPlanner::SeamPlanner(std::shared_ptr<const Surface> surface, const SeamPlannerOptions& options, const Task& task)
    : SeamPlanner(SurfaceContext(std::move(surface)), options, task) {}

SeamPlanner::SeamPlanner(const SurfaceContext& context, const SeamPlannerOptions& options, const Task& task) {
  const RisingProgress rising(task);
  check_options(*context.surface(rising.task()), options);
  impl_ = std::make_shared<const Impl>(Impl{PreparedSurface(context, options, rising.task())});
}

SeamPlan SeamPlanner::plan(const SeamGoal& goal, const std::function<void(const SeamPlan&)>& found,
                           const Task& task) const {
  if (!(goal.distortion > 4.0)) {
    throw InvalidInput("distortion is " + std::to_string(goal.distortion) + ", not above 4, that of an isometry");
  }
  const RisingProgress rising(task);
  return Planning(impl_->prepared, goal, found, rising.task()).run();
}

}  // namespace seamwire
