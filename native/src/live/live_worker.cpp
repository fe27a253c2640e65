// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/live_worker.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "seamwire/edges/shortest_cycle.hpp"
#include "wires/wire_pieces.hpp"

namespace seamwire::detail {
namespace {

/// How many closed wires there are to choose from, and of how many pieces each is: one that is shorter than half of it
/// is the shortest way between its ends.
constexpr std::size_t kClosedWires = 3, kPiecesOfClosedWire = 3, kPiecesOfBentHalf = 2;
/// From so many faces on the exact field takes longer than one likes to wait, and closed wires from a field of so many
/// windows come first.
constexpr std::size_t kManyFaces = 50'000;
constexpr std::uint32_t kWindowsBefore = 4;

double loop_turning_for(std::size_t edges) { return std::max(20.0, std::sqrt(static_cast<double>(edges)) / 4.0); }

bool is_missing_edge(const Surface& surface, const WireEnd& end) {
  const auto* pick = std::get_if<Pick>(&end);
  return pick != nullptr && pick->is_edge() && !has_edge(surface, {pick->a, pick->b});
}

SurfacePoint point_of(const WireEnd& end) {
  const auto* pick = std::get_if<Pick>(&end);
  return pick != nullptr ? SurfacePoint::at_vertex(pick->a) : std::get<SurfacePoint>(end);
}

/// A vertex itself, of another point the corner of its face that it has most of.
std::int32_t nearest_vertex(const Surface& surface, const WireEnd& end) {
  const SurfacePoint point = point_of(end);
  if (point.vertex >= 0) return point.vertex;
  const auto most = std::ranges::max_element(point.barycentric) - point.barycentric.begin();
  return surface.triangles()[point.face][static_cast<std::size_t>(most)];
}

/// Beside the thread that has the right of way the first of the others goes on where there are two processors, both
/// where there are three.
bool has_to_make_way(std::size_t which) {
  const std::size_t processors = std::max(1U, std::thread::hardware_concurrency());
  return which + 1 < kMostMetrics && which + 2 > processors;
}

}  // namespace

bool has_edge(const Surface& surface, const Edge& edge) {
  const Edge sorted = {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])};
  return std::binary_search(surface.edges().begin(), surface.edges().end(), sorted);
}

LiveWorker::LiveWorker(std::size_t which, std::shared_ptr<SurfaceCache> surface_cache,
                       std::shared_ptr<MetricSet> metrics, const LiveSettings& settings,
                       std::shared_ptr<RightOfWay> right_of_way)
    : which_(which),
      surface_cache_(std::move(surface_cache)),
      settings_(settings),
      is_third_(which + 1 == kMostMetrics),
      makes_way_(has_to_make_way(which)),
      right_of_way_(std::move(right_of_way)),
      metrics_(std::move(metrics)) {
  {
    const MutexLock lock(mutex_);
    tell_right_of_way();
  }
  thread_ = std::jthread([this] { run(); });
}

LiveWorker::~LiveWorker() {
  request_stop();
  thread_.join();
}

void LiveWorker::request_stop() {
  const MutexLock lock(mutex_);
  quit_.request_stop();
  preparing_.request_stop();
  solving_.request_stop();
  tell_right_of_way();
  changed_.notify_all();
}

void LiveWorker::change_metric(std::shared_ptr<MetricSet> metrics) {
  const MutexLock lock(mutex_);
  metrics_.swap(metrics);
  ++request_;
  tell_right_of_way();
  loop_through_ = Edge{-1, -1};
  loop_handled_ = ++loop_request_;  // what is found in the former metric answers nothing
  loop_error_ = nullptr;
  if (metrics_->prepared[which_] != metrics->prepared[which_]) preparing_.request_stop();
  solving_.request_stop();
  error_ = nullptr;
  dropped_.push_back(std::move(metrics));  // the former ones
  changed_.notify_all();
}

void LiveWorker::seed(const WireEnd& seed, bool forward) {
  const MutexLock lock(mutex_);
  ++request_;
  tell_right_of_way();
  seed_ = seed;
  is_forward_ = forward;
  target_ = std::nullopt;
  solving_.request_stop();
  error_ = nullptr;
  preview_ = nullptr;
  if (solution_) dropped_.push_back(std::exchange(solution_, nullptr));
  changed_.notify_all();
}

LiveWorker::Snapshot LiveWorker::snapshot(const WireEnd& target) {
  const MutexLock lock(mutex_);
  if (target_ != target) {
    target_ = target;
    ++targets_;
  }
  Snapshot now{.solution = solution_, .is_newest = solution_ && solution_for_ == request_, .preview = nullptr};
  if (!now.is_newest && preview_ && preview_->request == request_ && preview_->target == target) {
    now.preview = {preview_, &preview_->candidate};
  }
  return now;
}

void LiveWorker::release(std::shared_ptr<const SeedSolution> solution) {
  const MutexLock lock(mutex_);
  if (solution == solution_) {
    solution = nullptr;  // not the last one, as long as the mutex is held
    return;
  }
  dropped_.push_back(std::move(solution));
  changed_.notify_all();
}

void LiveWorker::find_loop(const LoopPlace& through) {
  const MutexLock lock(mutex_);
  if (loop_through_ == through) return;
  // What takes time is what they have in common: it goes on, however fast the second point moves.
  const auto *before = std::get_if<BendPlace>(&loop_through_), *now = std::get_if<BendPlace>(&through);
  const bool is_same_cut =
      before != nullptr && now != nullptr && before->through == now->through && before->which == now->which;
  ++loop_request_;
  loop_through_ = through;
  loop_error_ = nullptr;
  if (is_at_loop_ && !is_same_cut) solving_.request_stop();
  changed_.notify_all();
}

std::optional<EdgeChain> LiveWorker::loop() const {
  const MutexLock lock(mutex_);
  if (loop_handled_ != loop_request_) return std::nullopt;
  return loop_;
}

LiveClosedWires LiveWorker::closed_wires() const {
  const MutexLock lock(mutex_);
  if (closed_wires_for_ != loop_request_) return {.cuts = {}, .final = loop_handled_ == loop_request_};
  return closed_wires_;
}

double LiveWorker::progress() const {
  const MutexLock lock(mutex_);
  if (handled_ == request_) return 1.0;
  const double solved = std::clamp(fraction_.load(), 0.0, 1.0);
  const double prepared = std::clamp(metrics_->fractions[which_].load(), 0.0, 1.0);
  return was_prepared_ ? solved : kSolveBegins * prepared + (1.0 - kSolveBegins) * solved;
}

std::exception_ptr LiveWorker::error() const {
  const MutexLock lock(mutex_);
  return error_;
}

std::exception_ptr LiveWorker::loop_error() const {
  const MutexLock lock(mutex_);
  return error_ ? error_ : loop_error_;
}

bool LiveWorker::wait_until_idle(const Deadline& deadline) const {
  MutexLock lock(mutex_);
  while (!is_idle() && wait_once(changed_, lock, deadline)) continue;
  return is_idle();
}

void LiveWorker::run() {
  if (!build_surface()) return;
  while (std::optional<Job> job = next_job()) {
    if (auto* seed = std::get_if<SeedJob>(&*job)) work_on(std::move(*seed));
    if (const auto* loop = std::get_if<LoopJob>(&*job)) work_on(*loop);
    // Dropped: ends here.
  }
}

/// Or waits for the thread that does; false where there is no surface, or no more time for it.
bool LiveWorker::build_surface() {
  try {
    surface_cache_->surface_now(quit_.get_token());
    return true;
  } catch (...) {
    // Cancelled, to end; the cache has all else.
    const MutexLock lock(mutex_);
    has_failed_ = true;
    if (is_third_) right_of_way_->set_busy(false);
    changed_.notify_all();
    return false;
  }
}

/// Waits for one; nullopt: to end.
std::optional<LiveWorker::Job> LiveWorker::next_job() {
  MutexLock lock(mutex_);
  while (!has_job() && !quit_.stop_requested()) changed_.wait(lock);
  if (quit_.stop_requested()) return std::nullopt;
  if (!dropped_.empty()) return std::exchange(dropped_, {});
  preparing_ = std::stop_source();
  solving_ = std::stop_source();
  is_at_loop_ = handled_ == request_;
  if (is_at_loop_) {
    return LoopJob{.request = loop_request_,
                   .through = loop_through_,
                   .metrics = metrics_,
                   .prepared = metrics_->prepared[which_]->peek(),
                   .solving = solving_.get_token()};
  }
  fraction_ = 0.0;
  was_prepared_ = metrics_->prepared[which_]->peek() != nullptr;
  return SeedJob{.request = request_,
                 .metrics = metrics_,
                 .seed = seed_,
                 .is_forward = is_forward_,
                 .before = solution_,  // for this seed, if there is one: a new seed drops it
                 .preparing = preparing_.get_token(),
                 .solving = solving_.get_token()};
}

void LiveWorker::work_on(SeedJob job) {
  around_ = std::nullopt;  // which may hold a former metric
  std::shared_ptr<const SeedSolution> solution;
  std::exception_ptr error;
  try {
    solution = solve(job);
  } catch (const Cancelled&) {
    // By a newer request, or to end.
  } catch (...) {
    error = std::current_exception();
  }
  job.metrics = nullptr;  // without the mutex: it may be the last to hold a former metric

  const MutexLock lock(mutex_);
  handled_ = job.request;
  tell_right_of_way();
  if (job.request == request_) {
    if (solution_ != solution) dropped_.push_back(std::exchange(solution_, solution));
    solution_for_ = job.request;
    preview_ = nullptr;
    error_ = std::move(error);
  }
  changed_.notify_all();
}

void LiveWorker::work_on(const LoopJob& job) {
  EdgeChain loop;
  LiveClosedWires closed;
  std::exception_ptr error;
  bool is_cancelled = false;
  const auto* edge = std::get_if<Edge>(&job.through);
  try {
    if (!job.prepared) {
      // Why is known already.
    } else if (const auto* bend = std::get_if<BendPlace>(&job.through)) {
      closed = find_bent_wire(job, *bend);
    } else if (edge == nullptr) {
      closed = find_closed_wires(job, std::get<WireEnd>(job.through));
    } else if (has_edge(surface(), *edge)) {  // LiveWire::loop() refuses others
      const double turning = settings_.loop_turning.value_or(loop_turning_for(surface().edges().size()));
      loop = shortest_cycle(*job.prepared->graph, *edge, turning, {.stop = job.solving, .progress = {}});
    }
  } catch (const Cancelled&) {
    is_cancelled = true;  // by a newer loop, which counts then, or by a seed, which goes first
  } catch (...) {
    error = std::current_exception();
  }

  const MutexLock lock(mutex_);
  is_at_loop_ = false;
  changed_.notify_all();
  if (is_cancelled || job.request != loop_request_) return;
  loop_handled_ = job.request;
  loop_ = std::move(loop);
  closed.final = true;
  closed_wires_ = std::move(closed);
  closed_wires_for_ = job.request;
  loop_error_ = std::move(error);
}

/// Adds the pieces of a wire, and where each ends.
void LiveWorker::add_pieces(const LoopJob& job, const Prepared& prepared, std::size_t metric, const Wire& wire,
                            std::size_t count, LiveClosedWire& closed) const {
  const Task task{.stop = job.solving, .progress = {}};
  for (WirePiece& piece : cut_in_pieces(surface(), wire, count)) {
    closed.pieces.push_back(snapped(prepared, metric, std::move(piece.wire), task));
    closed.joints.push_back(piece.end);
  }
}

/// That of another thread is waited for, or made here; throws why there is none.
std::shared_ptr<const Prepared> LiveWorker::prepared_for(const LoopJob& job, std::size_t metric) {
  if (metric == which_) return job.prepared;
  return job.metrics->prepared[metric]->get(
      job.solving, [&] { return prepare(*surface_cache_, settings_.along, *job.metrics, metric, job.solving); });
}

/// Kept, so that what is asked for next through the same point is there at once; the metrics are the same as long as
/// there is no SeedJob. Null where none begin there.
const LiveWorker::ClosedIn* LiveWorker::closed_in(const LoopJob& job, const WireEnd& through, std::size_t metric) {
  if (!around_ || around_->through != through) {
    around_ = std::nullopt;  // the former one's memory first
    around_ = ClosedAround{.through = through};
  }
  std::optional<ClosedIn>& in = around_->in[metric];
  if (!in) {
    const std::shared_ptr<const Prepared> prepared = prepared_for(job, metric);
    const std::optional<SurfacePoint> seed = prepared->points->find(point_of(through), "through");
    if (!seed) return nullptr;
    const Task task{.stop = job.solving, .progress = {}};
    DistanceField field = prepared->geodesics->solve(std::array{*seed}, {}, task);
    std::vector<ClosedWire> cuts = seamwire::closed_wires(surface(), *prepared->embedding, field, kClosedWires, task);
    in = ClosedIn{.prepared = prepared, .field = std::move(field), .cuts = std::move(cuts)};
  }
  return &*in;
}

/// In pieces.
LiveClosedWire LiveWorker::closed_wire(const LoopJob& job, const WireEnd& through, const ClosedWire& cut,
                                       const ClosedWireChoice& choice) const {
  LiveClosedWire closed{.pieces = {},
                        .joints = {},
                        .separates = cut.separates,
                        .turn = cut.turn,
                        .length = cut.wire.length,
                        .which = kClosedWires * choice.metric + choice.number};
  Wire wire = cut.wire;
  wire.from = wire.to = nearest_vertex(surface(), through);
  add_pieces(job, *job.prepared, job.metrics->closing()[choice.metric], wire, kPiecesOfClosedWire, closed);
  if (!closed.joints.empty()) closed.joints.pop_back();  // that is the point itself
  return closed;
}

/// While the job goes on.
void LiveWorker::show(const LoopJob& job, LiveClosedWires found) {
  const MutexLock lock(mutex_);
  if (job.request != loop_request_) return;
  closed_wires_ = std::move(found);
  closed_wires_for_ = job.request;
}

/// First, where the field takes long, those that a bounded number of windows tells, then those of the first metric,
/// which can be seen meanwhile.
LiveClosedWires LiveWorker::find_closed_wires(const LoopJob& job, const WireEnd& through) {
  const Prepared& prepared = *job.prepared;
  const std::span<const std::size_t> closing = job.metrics->closing();
  std::vector<std::vector<ClosedWire>> metrics(closing.size());
  const auto chosen = [&] {
    LiveClosedWires found;
    for (const ClosedWireChoice& choice : choose_closed_wires(metrics, kClosedWires)) {
      found.cuts.push_back(closed_wire(job, through, metrics[choice.metric][choice.number], choice));
    }
    return found;
  };
  const std::optional<SurfacePoint> seed = prepared.points->find(point_of(through), "through");
  const bool is_known = around_ && around_->through == through && around_->in[closing.front()];
  if (!is_known && seed && seed->vertex >= 0 && prepared.embedding->mesh.face_count() > kManyFaces) {
    const Task task{.stop = job.solving, .progress = {}};
    const DistanceField near = prepared.geodesics->solve_bounded(seed->vertex, kWindowsBefore, task);
    metrics[0] = seamwire::closed_wires(surface(), *prepared.embedding, near, kClosedWires, task);
    show(job, chosen());
  }
  LiveClosedWires found;
  for (std::size_t i = 0; i < closing.size(); ++i) {
    const ClosedIn* in = closed_in(job, through, closing[i]);
    metrics[i] = in != nullptr ? in->cuts : std::vector<ClosedWire>();
    found = chosen();
    if (i + 1 < closing.size()) show(job, found);
  }
  return found;
}

/// In halves, from the first point to the second and back, each in pieces.
LiveClosedWires LiveWorker::find_bent_wire(const LoopJob& job, const BendPlace& place) {
  const std::span<const std::size_t> closing = job.metrics->closing();
  const std::size_t metric = place.which / kClosedWires, number = place.which % kClosedWires;
  const ClosedIn* in = metric < closing.size() ? closed_in(job, place.through, closing[metric]) : nullptr;
  if (in == nullptr || number >= in->cuts.size()) return {};
  const Prepared& prepared = *in->prepared;
  const std::optional<SurfacePoint> second = prepared.points->find(point_of(place.second), "second");
  if (!second) return {};
  const Task task{.stop = job.solving, .progress = {}};
  const ClosedWire& cut = in->cuts[number];
  ClosedAround& around = *around_;
  if (!around.bent || around.which != place.which) {
    around.bent = std::nullopt;  // its memory first
    around.bent.emplace(surface(), *prepared.embedding, *prepared.geodesics, in->field, cut, task);
    around.which = place.which;
  }
  std::optional<BentWire> bent = around.bent->through(*second, task);
  if (!bent) return {};
  LiveClosedWire closed{.pieces = {},
                        .joints = {},
                        .separates = cut.separates,
                        .turn = cut.turn,
                        .length = bent->there.length + bent->back.length,
                        .which = place.which};
  bent->there.from = bent->back.to = nearest_vertex(surface(), place.through);
  bent->there.to = bent->back.from = nearest_vertex(surface(), place.second);
  for (const Wire* half : {&bent->there, &bent->back}) {
    add_pieces(job, prepared, closing[metric], *half, kPiecesOfBentHalf, closed);
    if (!closed.joints.empty()) closed.joints.back() = point_of(half == &bent->there ? place.second : place.through);
  }
  if (!closed.joints.empty()) closed.joints.pop_back();  // that is the point itself
  return {.cuts = {std::move(closed)}, .final = false};
}

/// Null where there is no seed, or none that is part of the surface, or no such metric.
std::shared_ptr<const SeedSolution> LiveWorker::solve(const SeedJob& job) {
  if (which_ >= job.metrics->count) return nullptr;
  const std::shared_ptr<const Prepared> prepared = job.metrics->prepared[which_]->get(job.preparing, [&] {
    return prepare(*surface_cache_, settings_.along, *job.metrics, which_, job.preparing,
                   [&] { make_way(job.preparing); });
  });
  job.metrics->forget_former(which_);
  if (job.before && job.before->field && job.before->prepared == prepared) return job.before;  // the other was changed
  if (!job.seed || is_missing_edge(surface(), *job.seed)) return nullptr;
  const Task task{.stop = job.solving, .progress = [this](double done) {
                    fraction_ = done;
                    return true;
                  }};
  task.check(0.0);
  return settings_.along == Along::kSurface ? find_field(job, prepared, task) : find_chains(job, prepared, task);
}

void LiveWorker::make_way(const std::stop_token& stop) {
  if (makes_way_) right_of_way_->wait(stop);
}

/// Between the steps of the search for the field it finds wires to the targets that are asked for meanwhile: on a
/// thread of its own that would take turns with the search all the same.
std::shared_ptr<const SeedSolution> LiveWorker::find_field(const SeedJob& job,
                                                           const std::shared_ptr<const Prepared>& prepared, Task task) {
  const std::optional<SurfacePoint> seed = prepared->points->find(point_of(*job.seed), "seed");
  if (!seed) return std::make_shared<const SeedSolution>(SeedSolution{.prepared = prepared, .field = {}, .wires = {}});
  make_way(job.solving);
  task.check(0.0);
  CorridorPaths paths(*prepared->geodesics, *seed);
  std::int64_t answered = -1;
  make_preview(job, *prepared, paths, answered);
  task.progress = [&, report = std::move(task.progress)](double done) {
    make_way(job.solving);
    make_preview(job, *prepared, paths, answered);
    return report(done);
  };
  DistanceField field = prepared->geodesics->solve(std::array{*seed}, {}, task);
  return std::make_shared<const SeedSolution>(
      SeedSolution{.prepared = prepared, .field = std::move(field), .wires = std::nullopt});
}

/// `answered`: the value of targets_ at the last preview.
void LiveWorker::make_preview(const SeedJob& job, const Prepared& prepared, CorridorPaths& paths,
                              std::int64_t& answered) {
  const std::int64_t asked = targets_;
  if (asked == answered) return;
  answered = asked;
  std::optional<WireEnd> target;
  {
    const MutexLock lock(mutex_);
    target = target_;
  }
  if (!target) return;
  LiveCandidate candidate;
  if (const std::optional<SurfacePoint> to = prepared.points->find(point_of(*target), "target")) {
    Wire wire = map_wire(surface(), *prepared.embedding, paths.path(*to, {.stop = job.solving, .progress = {}}));
    candidate = candidate_of(prepared, std::move(wire), *job.seed, *target);
  }
  auto preview = std::make_shared<const Preview>(Preview{job.request, *target, std::move(candidate)});
  const MutexLock lock(mutex_);
  if (job.request == request_) preview_.swap(preview);
}

/// What is found can be seen from the beginning.
std::shared_ptr<const SeedSolution> LiveWorker::find_chains(const SeedJob& job,
                                                            const std::shared_ptr<const Prepared>& prepared,
                                                            const Task& task) {
  EdgeWires wires(prepared->graph, std::get<Pick>(*job.seed), settings_.turning, job.is_forward);
  auto solution =
      std::make_shared<const SeedSolution>(SeedSolution{.prepared = prepared, .field = std::nullopt, .wires = wires});
  {
    const MutexLock lock(mutex_);
    if (job.request == request_) {
      dropped_.push_back(std::exchange(solution_, solution));
      solution_for_ = job.request;
    }
  }
  wires.run(task);
  return solution;
}

LiveCandidate LiveWorker::candidate_of(const Prepared& prepared, Wire wire, const WireEnd& seed,
                                       const WireEnd& target) const {
  wire.from = nearest_vertex(surface(), seed);
  wire.to = nearest_vertex(surface(), target);
  return snapped(prepared, which_, std::move(wire));
}

LiveCandidate LiveWorker::snapped(const Prepared& prepared, std::size_t metric, Wire wire, const Task& task) const {
  LiveCandidate candidate;
  candidate.follow = kFollow[metric];
  candidate.vertices = snap_to_edges(surface(), *prepared.snap_graph, wire, task);
  candidate.length = wire.length;
  candidate.points = std::move(wire.points);
  candidate.faces = std::move(wire.faces);
  return candidate;
}

LiveCandidate LiveWorker::candidate(const SeedSolution& solution, const WireEnd& seed, const WireEnd& target) const {
  LiveCandidate candidate;
  candidate.follow = kFollow[which_];
  if (solution.field) {
    const Prepared& prepared = *solution.prepared;
    const std::optional<SurfacePoint> to = prepared.points->find(point_of(target), "target");
    if (!to) return candidate;
    return candidate_of(prepared, trace_wire(surface(), *prepared.embedding, *solution.field, *to), seed, target);
  }
  if (!solution.wires) return candidate;
  EdgeChain chain = solution.wires->trace(std::get<Pick>(target));
  candidate.length = chain.length;
  candidate.vertices = std::move(chain.vertices);
  candidate.points.reserve(candidate.vertices.size());
  for (const std::int32_t v : candidate.vertices) candidate.points.push_back(surface().points()[v]);
  return candidate;
}

}  // namespace seamwire::detail
