// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/seed_solver.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "detail/infinity.hpp"
#include "surface/real_edges.hpp"
#include "wires/local_wires.hpp"

namespace seamwire::detail {
namespace {

/// On smaller surfaces the first wire is hardly earlier if it is found around the seed.
constexpr std::size_t kLeastFacesForNearby = 200'000;
/// And no more than one in so many faces is embedded for it.
constexpr std::size_t kFacesPerNearby = 5;
/// A thread that makes way looks that often whether another preview is asked for.
constexpr std::chrono::milliseconds kBetweenPreviews{10};

bool is_missing_edge(const Surface& surface, const WireEnd& end) {
  const auto* pick = std::get_if<Pick>(&end);
  return pick != nullptr && pick->is_edge() && !has_edge(surface, {pick->a, pick->b});
}

/// Beside the thread of the first metric, which may have the right of way, as many threads go on as there are other
/// processors.
bool has_to_make_way(std::size_t metric) {
  const std::size_t processors = std::max(1U, std::thread::hardware_concurrency());
  return metric > 0 && metric + 1 > processors;
}

}  // namespace

/// The last preview that was made before the surface was embedded.
struct SeedSolver::Nearby {
  std::int64_t seed = -1, target = -1;  ///< the numbers of their requests
  std::optional<NearbyWires> wires;     ///< from that seed
};

SeedSolver::SeedSolver(std::size_t metric, const SurfaceContext& context, const LiveSettings& settings,
                       std::shared_ptr<RightOfWay> right_of_way, TargetBox& targets)
    : metric_(metric),
      context_(context),
      settings_(settings),
      makes_way_(has_to_make_way(metric)),
      right_of_way_(std::move(right_of_way)),
      targets_(targets) {}

double SeedSolver::progress(const SeedRequest& request) const {
  const double solved = std::clamp(fraction_.load(), 0.0, 1.0);
  const double prepared = request.metrics->fraction(metric_);
  return was_prepared_ ? solved : kSolveBegins * prepared + (1.0 - kSolveBegins) * solved;
}

std::shared_ptr<const SeedSolution> SeedSolver::solve(const SeedBox::Job& job,
                                                      const std::shared_ptr<const SeedSolution>& former,
                                                      SeedBox& seeds) {
  MetricSet& metrics = *job.request->metrics;
  fraction_ = 0.0;
  was_prepared_ = metrics.peek(metric_) != nullptr;
  if (metric_ >= metrics.count()) return nullptr;
  const std::stop_token preparing = job.request->preparing.get_token();
  const std::shared_ptr<const Prepared> prepared =
      metrics.prepared[metric_]->get({.stop = preparing, .progress = {}}, [&](const Task&) {
        Nearby nearby;
        return prepare(context_, settings_.along, metrics, metric_, preparing,
                       {.make_way = [&](const auto& meanwhile) { make_way(preparing, meanwhile); },
                        .preview =
                            [&](const Prepared& so_far, const std::shared_ptr<const Metric>& metric) {
                              make_nearby_preview(seeds, so_far, metric, preparing, nearby);
                            }});
      });
  metrics.forget_former(metric_);
  if (former && former->field && former->prepared == prepared) return former;  // only the other metrics have changed
  const std::optional<WireEnd>& seed = job.request->seed;
  if (!seed || is_missing_edge(*context_.peek_surface(), *seed)) return nullptr;
  const Task task{.stop = job.stop, .progress = [this](double done) {
                    fraction_ = done;
                    return true;
                  }};
  task.check(0.0);
  return settings_.along == Along::kSurface ? find_field(job, prepared, task) : find_chains(job, prepared, task, seeds);
}

/// Calls meanwhile() now and then.
void SeedSolver::make_way(const std::stop_token& stop, const std::function<void()>& meanwhile) {
  while (makes_way_ && !right_of_way_->wait_for(kBetweenPreviews, stop)) meanwhile();
}

/// Finds the wire from the newest seed to the newest target around the seed. A newer seed stops it.
void SeedSolver::make_nearby_preview(const SeedBox& seeds, const Prepared& prepared,
                                     const std::shared_ptr<const Metric>& metric, const std::stop_token& stop,
                                     Nearby& nearby) {
  const std::size_t faces = prepared.surface->face_count();
  if (faces < kLeastFacesForNearby) return;
  const std::int64_t seed_number = seeds.number(), target_number = targets_.number();
  if (seed_number == nearby.seed && target_number == nearby.target) return;
  const std::optional<WireEnd> seed = seeds.newest()->seed;
  const std::shared_ptr<const WireEnd> target = targets_.newest();
  if (!seed || !target) return;
  if (seed_number != nearby.seed) {
    nearby.wires.emplace(prepared.surface, metric, point_of(*seed), faces / kFacesPerNearby);
  }
  nearby.seed = seed_number;
  nearby.target = target_number;
  const Task task{.stop = stop, .progress = [&](double) { return seeds.number() == seed_number; }};
  try {
    std::optional<Wire> wire = nearby.wires->wire(point_of(*target), task);
    if (!wire) return;
    show_preview(target_number, seed_number, *target,
                 candidate_between(prepared, *std::move(wire), *seed, *target, task));
  } catch (const InvalidInput&) {
    // The faces around the seed may not do for geodesics by themselves. Then there is no preview.
  } catch (const Cancelled&) {
    if (stop.stop_requested()) throw;  // otherwise by a newer seed, which the next step makes one for
  }
}

void SeedSolver::show_preview(std::int64_t target_number, std::int64_t seed_number, const WireEnd& target,
                              LiveCandidate candidate) {
  const double length = candidate.length;
  targets_.show(target_number,
                std::make_shared<const TargetWire>(TargetWire{seed_number, target, std::move(candidate), length}));
}

/// Finds wires to the targets that are asked for meanwhile between the steps of the search for the field. A separate
/// thread would still take turns with the search.
std::shared_ptr<const SeedSolution> SeedSolver::find_field(const SeedBox::Job& job,
                                                           const std::shared_ptr<const Prepared>& prepared, Task task) {
  const EmbeddedSurface& on = *prepared->embedded;
  const std::optional<SurfacePoint> seed = on.points().find(point_of(*job.request->seed), "seed");
  if (!seed)
    return std::make_shared<const SeedSolution>(
        SeedSolution{.prepared = prepared, .seed = *job.request->seed, .field = {}, .wires = {}});
  CorridorPaths paths(on.geodesics(), *seed);
  std::int64_t answered = -1;
  const auto preview = [&] { make_preview(job, *prepared, paths, answered); };
  task.progress = [&, report = std::move(task.progress)](double done) {
    preview();
    make_way(job.stop, preview);
    return report(done);
  };
  task.check(0.0);
  DistanceField field = on.geodesics().solve(*seed, task);
  return std::make_shared<const SeedSolution>(
      SeedSolution{.prepared = prepared, .seed = *job.request->seed, .field = std::move(field), .wires = std::nullopt});
}

/// `answered`: the number of the target at the last preview.
void SeedSolver::make_preview(const SeedBox::Job& job, const Prepared& prepared, CorridorPaths& paths,
                              std::int64_t& answered) {
  const std::int64_t asked = targets_.number();
  if (asked == answered) return;
  answered = asked;
  const std::shared_ptr<const WireEnd> target = targets_.newest();
  if (!target) return;
  LiveCandidate candidate;
  candidate.metric = prepared.spec;
  const EmbeddedSurface& on = *prepared.embedded;
  if (const std::optional<SurfacePoint> to = on.points().find(point_of(*target), "target")) {
    const Task task{.stop = job.stop, .progress = {}};
    if (const std::optional<IntrinsicPath> path = paths.path(*to, task)) {
      Wire wire = map_wire(on.surface(), on.embedding(), *path);
      candidate = candidate_between(prepared, std::move(wire), *job.request->seed, *target, task);
    }
  }
  show_preview(asked, job.number, *target, std::move(candidate));
}

TargetWire SeedSolver::refine(const SeedBox::Reading& found, const WireEnd& target, bool is_refined,
                              const std::function<void(TargetWire)>& show, const std::stop_token& stop) const {
  const SeedSolution& solution = *found.answer;
  const Prepared& prepared = *solution.prepared;
  const EmbeddedSurface& on = *prepared.embedded;
  const Task task{.stop = stop, .progress = {}};
  std::optional<Wire> wire = wire_of(solution, target, task);
  TargetWire answer{
      .seed_number = found.number, .target = target, .candidate = {}, .first_length = wire ? wire->length : kInfinity};
  answer.candidate.metric = prepared.spec;
  const auto take = [&](Wire of) {
    answer.candidate = candidate_between(prepared, std::move(of), solution.seed, target, task);
    answer.candidate.solved = true;
  };
  if (wire && is_refined) {
    if (show) {
      take(*wire);
      show(answer);
    }
    const WireRefinement how{.max_error = settings_.max_error, .mean_edge_length = on.embedding().mean_edge_length};
    if (std::optional<Wire> better =
            refined_wire(prepared.surface, on.metric(), *wire, point_of(solution.seed), point_of(target), how, task)) {
      wire = std::move(better);
    }
  }
  if (wire) take(*std::move(wire));
  answer.candidate.solved = true;
  answer.candidate.final = answer.is_refined = true;
  return answer;
}

/// The chains that are found can be seen from the beginning.
std::shared_ptr<const SeedSolution> SeedSolver::find_chains(const SeedBox::Job& job,
                                                            const std::shared_ptr<const Prepared>& prepared,
                                                            const Task& task, SeedBox& seeds) {
  EdgeWires wires(prepared->graph, std::get<Pick>(*job.request->seed), settings_.turning, job.request->is_forward);
  auto solution = std::make_shared<const SeedSolution>(
      SeedSolution{.prepared = prepared, .seed = *job.request->seed, .field = std::nullopt, .wires = wires});
  seeds.show(job, solution);
  wires.run(task);
  return solution;
}

}  // namespace seamwire::detail
