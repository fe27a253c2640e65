// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/livewire.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <utility>

#include "computed_once.hpp"
#include "seamwire/embedding.hpp"
#include "seamwire/geodesics.hpp"
#include "seamwire/quick_paths.hpp"

namespace seamwire {

namespace {

constexpr std::array kFollow = {Follow::kMin, Follow::kMax};

/// Fractions of the first seed's work, preparation included, at which its parts begin.
constexpr double kEmbedBegins = 0.1, kSolveBegins = 0.5;

/// An artist waits for an embedding, and one that runs away is better cut short, with small holes: at most so many
/// triangles are added, or so many times the surface's.
constexpr std::size_t kFacesAdded = 200'000, kFacesAddedPerFace = 12;

struct Curved {
  Curvature curvature;
  std::vector<double> difference;
};

/// What the surface alone decides. Shared by all forks.
struct Ground {
  Ground(std::shared_ptr<const Surface> on, Along how) : surface(std::move(on)), along(how) {}

  std::shared_ptr<const Curved> curved_now(const std::stop_token& stop) {
    return curved.get(stop, [&] {
      Curved made{.curvature = principal_curvatures(*surface), .difference = {}};
      made.difference = made.curvature.difference();
      return made;
    });
  }
  std::shared_ptr<const SnapGraph> snap_graph_now(const std::stop_token& stop) {
    return snap_graph.get(stop, [&] { return SnapGraph(*surface); });
  }
  std::shared_ptr<const EdgeFans> fans_now(const std::stop_token& stop) {
    const auto held = fans.get(stop, [&] { return make_edge_fans(*surface, {.stop = stop, .progress = {}}); });
    return *held;
  }

  const std::shared_ptr<const Surface> surface;
  const Along along;
  ComputedOnce<Curved> curved;
  ComputedOnce<SnapGraph> snap_graph;
  ComputedOnce<std::shared_ptr<const EdgeFans>> fans;
};

/// What one metric needs for any seed: across the surface the first three, along edges the last.
struct Prepared {
  std::optional<Embedding> embedding;
  std::optional<ExactGeodesics> geodesics;
  std::shared_ptr<const SnapGraph> snap_graph;
  std::shared_ptr<const EdgeGraph> graph;
};

/// The two metrics of one family and strength, after the scribbles. Shared by forks.
struct Metrics {
  Metrics(MetricFamily of, const Strength& with, std::vector<Scribble> after)
      : family(of), strength(with), scribbles(std::move(after)) {}

  const MetricFamily family;
  const Strength strength;
  const std::vector<Scribble> scribbles;
  std::array<ComputedOnce<Prepared>, 2> prepared;
  std::array<std::atomic<double>, 2> fractions = {};  // of the preparation
};

/// The wires of one metric from one seed. Along edges it may still be at work.
struct Solved {
  std::shared_ptr<const Prepared> prepared;
  std::optional<DistanceField> field;
  std::optional<EdgeWires> wires;

  bool is_final(const Pick& target) const { return !wires || wires->is_final(target); }
};

/// A wire to one target, computed before there is a field.
struct Preview {
  std::int64_t request;
  Pick target;
  LiveCandidate candidate;
};

Metric make_metric(const Surface& surface, const Curvature& curvature, Follow follow, const Metrics& metrics) {
  switch (metrics.family) {
    case MetricFamily::kFeature:
      return feature_metric(surface, curvature, follow, metrics.strength);
    case MetricFamily::kCampen:
      return campen_metric(surface, curvature, follow, metrics.strength);
    case MetricFamily::kPottmannKovacs:
      return pottmann_kovacs_metric(surface, curvature, follow, metrics.strength);
    case MetricFamily::kEuclidean:
      break;
  }
  return euclidean_metric(surface, curvature);
}

/// The metric's fractions of progress are told to `metrics`.
Prepared prepare(Ground& ground, Metrics& metrics, std::size_t which, const std::stop_token& stop) {
  const bool on_surface = ground.along == Along::kSurface;
  std::atomic<double>& fraction = metrics.fractions[which];
  Prepared prepared;
  std::shared_ptr<const EdgeFans> fans;
  const auto prepare_edges = [&] {
    if (on_surface) prepared.snap_graph = ground.snap_graph_now(stop);
    fans = ground.fans_now(stop);
  };
  if (which == 1) prepare_edges();  // while the other thread is at the curvatures
  const std::shared_ptr<const Curved> curved = ground.curved_now(stop);
  if (which == 0) prepare_edges();
  Task task{.stop = stop, .progress = {}};
  task.check(0.0);
  Metric metric = make_metric(*ground.surface, curved->curvature, kFollow[which], metrics);
  task.check(0.0);
  if (!metrics.scribbles.empty()) {
    metric = apply_scribbles(*ground.surface, metric, metrics.scribbles, kFollow[which]);
  }
  fraction = kEmbedBegins / kSolveBegins;
  task.progress = [&fraction](double done) {
    fraction = (kEmbedBegins + (kSolveBegins - kEmbedBegins) * done) / kSolveBegins;
    return true;
  };
  if (on_surface) {
    const std::size_t most = std::max(kFacesAdded, kFacesAddedPerFace * ground.surface->face_count());
    prepared.embedding = embed(*ground.surface, metric, {.max_faces_added = most}, task);
    prepared.geodesics.emplace(prepared.embedding->mesh);
  } else {
    prepared.graph = make_edge_graph(*ground.surface, metric, std::move(fans), task, metrics.scribbles, kFollow[which]);
  }
  return prepared;
}

void check_edge(const Surface& surface, const Edge& edge) {
  const Edge sorted = {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])};
  if (!std::binary_search(surface.edges().begin(), surface.edges().end(), sorted)) {
    throw InvalidInput("the surface has no edge between the vertices " + std::to_string(edge[0]) + " and " +
                       std::to_string(edge[1]));
  }
}

void check_pick(const Surface& surface, Along along, const Pick& pick) {
  if (pick.is_edge()) {
    if (along == Along::kSurface) throw InvalidInput("across the surface wires lead from vertex to vertex, not edge");
    check_edge(surface, {pick.a, pick.b});
  } else if (pick.a < 0 || static_cast<std::size_t>(pick.a) >= surface.vertex_count()) {
    throw InvalidInput("vertex " + std::to_string(pick.a) + " is out of range: the surface has " +
                       std::to_string(surface.vertex_count()) + " vertices");
  }
}

void check_metric(MetricFamily family, const Strength& strength) {
  if (family != MetricFamily::kEuclidean) check_strength(strength, family == MetricFamily::kCampen ? 1.0 : 0.0);
}

void check_options(const LiveWireOptions& options) {
  check_metric(options.family, options.strength);
  for (const double turning : {options.turning, options.loop_turning.value_or(0.0)}) {
    if (!(std::isfinite(turning) && turning >= 0)) {
      throw InvalidInput("turning is " + std::to_string(turning) + ", not a finite number of at least 0");
    }
  }
}

double loop_turning_for(std::size_t edges) { return std::max(20.0, std::sqrt(static_cast<double>(edges)) / 4.0); }

}  // namespace

struct LiveWire::Impl {
  /// What one worker is at. Numbers of requests are those of Impl.
  struct Worker {
    std::shared_ptr<const Solved> solved;  // of the newest seed; of a former metric where solved_for is not `request`
    std::int64_t solved_for = -1;
    std::shared_ptr<const Preview> preview;
    std::vector<std::shared_ptr<const Solved>> dropped;  // to be freed here: that takes long for a large field
    std::int64_t handled = -1;                           // the request that was answered, or failed, last
    std::exception_ptr error;                            // why it failed
    EdgeChain loop;
    std::int64_t loop_handled = 0;
    std::stop_source preparing, solving;  // of the running work
    bool is_at_loop = false;
    bool was_prepared = false;  // when it began
    std::atomic<double> fraction = 0.0;
  };

  Impl(std::shared_ptr<Ground> on, std::shared_ptr<Metrics> by, const LiveWireOptions& with);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  const Surface& surface() const { return *ground->surface; }
  void work(std::size_t which);
  void work_on_seed(std::size_t which, std::unique_lock<std::mutex>& lock);
  void work_on_loop(std::size_t which, std::unique_lock<std::mutex>& lock);
  std::shared_ptr<const Solved> find_field(std::size_t which, const std::shared_ptr<const Prepared>& prepared,
                                           std::int32_t from, std::int64_t at, Task task);
  std::shared_ptr<const Solved> find_chains(std::size_t which, const std::shared_ptr<const Prepared>& prepared,
                                            const Pick& from, bool is_forward, std::int64_t at, const Task& task);
  LiveCandidate candidate_of(std::size_t which, const Prepared& prepared, Wire wire) const;
  LiveCandidate candidate(std::size_t which, const Solved& solved, const Pick& target) const;
  void change_metrics(std::shared_ptr<Metrics> to);

  /// With the lock.
  bool idle() const {
    return std::ranges::all_of(workers,
                               [&](const Worker& w) { return w.handled == request && w.loop_handled == loop_request; });
  }
  void rethrow() const {
    for (const Worker& worker : workers) {
      if (worker.error) std::rethrow_exception(worker.error);
    }
  }
  /// Without the lock.
  std::shared_ptr<Metrics> metrics_now() const {
    const std::scoped_lock lock(mutex);
    return metrics;
  }
  /// With the lock.
  void drop_loop() {
    loop_edge = {-1, -1};
    for (Worker& worker : workers) worker.loop_handled = loop_request;
  }

  const std::shared_ptr<Ground> ground;
  const double turning;
  const double loop_turning;

  mutable std::mutex mutex;  // guards what follows, but for the fractions
  mutable std::condition_variable changed;
  bool quit = false;
  std::shared_ptr<Metrics> metrics;
  std::int64_t request = 0;  // grows with each seed and each change of the metric
  std::optional<Pick> seed;
  bool forward = false;
  Pick target;                            // what wires were asked for last
  std::atomic<std::int64_t> targets = 0;  // how often that was another one
  std::int64_t loop_request = 0;
  Edge loop_edge = {-1, -1};  // of the newest loop asked for
  std::array<Worker, 2> workers;

  std::array<std::jthread, 2> threads;  // last, so that they end first
};

LiveWire::Impl::Impl(std::shared_ptr<Ground> on, std::shared_ptr<Metrics> by, const LiveWireOptions& with)
    : ground(std::move(on)),
      turning(with.turning),
      loop_turning(with.loop_turning.value_or(loop_turning_for(ground->surface->edges().size()))),
      metrics(std::move(by)) {
  for (std::size_t which = 0; which < kFollow.size(); ++which) {
    threads[which] = std::jthread([this, which] { work(which); });
  }
}

LiveWire::Impl::~Impl() {
  const std::scoped_lock lock(mutex);
  quit = true;
  for (Worker& worker : workers) {
    worker.preparing.request_stop();
    worker.solving.request_stop();
  }
  changed.notify_all();
}

void LiveWire::Impl::work(std::size_t which) {
  Worker& worker = workers[which];
  std::unique_lock lock(mutex);
  while (true) {
    changed.wait(lock, [&] {
      return quit || worker.handled != request || worker.loop_handled != loop_request || !worker.dropped.empty();
    });
    if (quit) return;
    if (!worker.dropped.empty()) {
      std::vector<std::shared_ptr<const Solved>> dropped = std::exchange(worker.dropped, {});
      lock.unlock();
      dropped.clear();
      lock.lock();
      continue;
    }
    worker.preparing = std::stop_source();
    worker.solving = std::stop_source();
    if (worker.handled != request) {
      work_on_seed(which, lock);
    } else {
      work_on_loop(which, lock);
    }
    changed.notify_all();
  }
}

void LiveWire::Impl::work_on_seed(std::size_t which, std::unique_lock<std::mutex>& lock) {
  Worker& worker = workers[which];
  const std::shared_ptr<Metrics> with = metrics;
  const std::int64_t at = request;
  const std::optional<Pick> pick = seed;
  const bool is_forward = forward;
  const std::stop_token preparing = worker.preparing.get_token();
  worker.fraction = 0.0;
  worker.was_prepared = with->prepared[which].peek() != nullptr;
  const Task task{.stop = worker.solving.get_token(), .progress = [&worker](double done) {
                    worker.fraction = done;
                    return true;
                  }};
  lock.unlock();

  std::shared_ptr<const Solved> solved;
  std::exception_ptr error;
  try {
    const std::shared_ptr<const Prepared> prepared =
        with->prepared[which].get(preparing, [&] { return prepare(*ground, *with, which, preparing); });
    if (pick) {
      task.check(0.0);
      solved = ground->along == Along::kSurface ? find_field(which, prepared, pick->a, at, task)
                                                : find_chains(which, prepared, *pick, is_forward, at, task);
    }
  } catch (const Cancelled&) {
    // By a newer request, or to quit.
  } catch (...) {
    error = std::current_exception();
  }

  lock.lock();
  worker.handled = at;
  if (at == request) {
    if (worker.solved != solved) worker.dropped.push_back(std::exchange(worker.solved, solved));
    worker.solved_for = at;
    worker.preview = nullptr;
    worker.error = std::move(error);
  }
  lock.unlock();
  solved = nullptr;
  lock.lock();
}

void LiveWire::Impl::work_on_loop(std::size_t which, std::unique_lock<std::mutex>& lock) {
  Worker& worker = workers[which];
  const std::int64_t at = loop_request;
  const Edge edge = loop_edge;
  const std::shared_ptr<const Prepared> prepared = metrics->prepared[which].peek();  // null: that failed
  const Task task{.stop = worker.solving.get_token(), .progress = {}};
  worker.is_at_loop = true;
  lock.unlock();

  EdgeChain loop;
  std::exception_ptr error;
  bool is_cancelled = false;
  try {
    if (prepared) loop = edge_loop(*prepared->graph, edge, loop_turning, task);
  } catch (const Cancelled&) {
    is_cancelled = true;  // by a newer loop, which counts then, or by a seed, which goes first
  } catch (...) {
    error = std::current_exception();
  }

  lock.lock();
  worker.is_at_loop = false;
  if (is_cancelled || at != loop_request) return;
  worker.loop_handled = at;
  worker.loop = std::move(loop);
  if (error) worker.error = std::move(error);
}

/// Between the steps of the search for the field it finds wires to the targets that are asked for meanwhile: on a
/// thread of its own that would take turns with the search all the same.
std::shared_ptr<const Solved> LiveWire::Impl::find_field(std::size_t which,
                                                         const std::shared_ptr<const Prepared>& prepared,
                                                         std::int32_t from, std::int64_t at, Task task) {
  Worker& worker = workers[which];
  QuickPaths quick(*prepared->geodesics, from);
  std::int64_t answered = -1;
  const auto answer = [&] {
    const std::int64_t asked = targets;
    if (asked == answered) return;
    Pick to;
    {
      const std::scoped_lock lock(mutex);
      to = target;
    }
    answered = asked;
    if (to.a < 0) return;
    Wire wire = map_wire(surface(), *prepared->embedding, quick.path(to.a, {.stop = task.stop, .progress = {}}));
    wire.from = from;
    wire.to = to.a;
    const auto preview =
        std::make_shared<const Preview>(Preview{at, to, candidate_of(which, *prepared, std::move(wire))});
    const std::scoped_lock lock(mutex);
    if (at == request) worker.preview = preview;
  };
  answer();
  task.progress = [&, report = std::move(task.progress)](double done) {
    answer();
    return report(done);
  };
  DistanceField field = prepared->geodesics->solve(from, task);
  return std::make_shared<const Solved>(Solved{.prepared = prepared, .field = std::move(field), .wires = std::nullopt});
}

/// What is found can be seen from the beginning.
std::shared_ptr<const Solved> LiveWire::Impl::find_chains(std::size_t which,
                                                          const std::shared_ptr<const Prepared>& prepared,
                                                          const Pick& from, bool is_forward, std::int64_t at,
                                                          const Task& task) {
  EdgeWires wires(prepared->graph, from, turning, is_forward);
  auto solved = std::make_shared<const Solved>(Solved{.prepared = prepared, .field = std::nullopt, .wires = wires});
  {
    const std::scoped_lock lock(mutex);
    if (at == request) {
      Worker& worker = workers[which];
      worker.dropped.push_back(std::exchange(worker.solved, solved));
      worker.solved_for = at;
    }
  }
  wires.run(task);
  return solved;
}

LiveCandidate LiveWire::Impl::candidate_of(std::size_t which, const Prepared& prepared, Wire wire) const {
  LiveCandidate candidate;
  candidate.follow = kFollow[which];
  candidate.vertices = snap_to_edges(surface(), *prepared.snap_graph, wire);
  candidate.length = wire.length;
  candidate.points = std::move(wire.points);
  candidate.faces = std::move(wire.faces);
  return candidate;
}

LiveCandidate LiveWire::Impl::candidate(std::size_t which, const Solved& solved, const Pick& target) const {
  if (solved.field) {
    const Prepared& prepared = *solved.prepared;
    return candidate_of(which, prepared, trace_wire(surface(), *prepared.embedding, *solved.field, target.a));
  }
  LiveCandidate candidate;
  candidate.follow = kFollow[which];
  EdgeChain chain = solved.wires->trace(target);
  candidate.length = chain.length;
  candidate.vertices = std::move(chain.vertices);
  candidate.points.reserve(candidate.vertices.size());
  for (const std::int32_t v : candidate.vertices) {
    candidate.points.push_back(surface().points()[static_cast<std::size_t>(v)]);
  }
  return candidate;
}

void LiveWire::Impl::change_metrics(std::shared_ptr<Metrics> to) {
  const std::scoped_lock lock(mutex);
  metrics = std::move(to);
  ++request;
  drop_loop();
  for (Worker& worker : workers) {
    worker.preparing.request_stop();
    worker.solving.request_stop();
    worker.error = nullptr;
  }
  changed.notify_all();
}

LiveWire::LiveWire(std::shared_ptr<const Surface> surface, const LiveWireOptions& options) {
  check_options(options);
  impl_ = std::make_unique<Impl>(std::make_shared<Ground>(std::move(surface), options.along),
                                 std::make_shared<Metrics>(options.family, options.strength, std::vector<Scribble>()),
                                 options);
}

LiveWire::LiveWire(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LiveWire::LiveWire(LiveWire&& other) noexcept = default;
LiveWire& LiveWire::operator=(LiveWire&& other) noexcept = default;
LiveWire::~LiveWire() = default;

LiveWire LiveWire::fork() const {
  const LiveWireOptions options{.turning = impl_->turning, .loop_turning = impl_->loop_turning};
  return LiveWire(std::make_unique<Impl>(impl_->ground, impl_->metrics_now(), options));
}

void LiveWire::set_metric(MetricFamily family, const Strength& strength) {
  check_metric(family, strength);
  impl_->change_metrics(std::make_shared<Metrics>(family, strength, impl_->metrics_now()->scribbles));
}

void LiveWire::set_scribbles(std::vector<Scribble> scribbles) {
  const std::shared_ptr<Metrics> now = impl_->metrics_now();
  if (scribbles == now->scribbles) return;
  impl_->change_metrics(std::make_shared<Metrics>(now->family, now->strength, std::move(scribbles)));
}

void LiveWire::seed(const Pick& pick, bool forward) {
  check_pick(impl_->surface(), impl_->ground->along, pick);
  const std::scoped_lock lock(impl_->mutex);
  ++impl_->request;
  impl_->seed = pick;
  impl_->forward = forward;
  impl_->target = {};
  for (Impl::Worker& worker : impl_->workers) {
    worker.solving.request_stop();
    worker.error = nullptr;
    worker.preview = nullptr;
    if (worker.solved) worker.dropped.push_back(std::exchange(worker.solved, nullptr));
  }
  impl_->changed.notify_all();
}

LiveWires LiveWire::wires(const Pick& target) const {
  check_pick(impl_->surface(), impl_->ground->along, target);
  std::array<std::shared_ptr<const Solved>, 2> solved;
  std::array<std::shared_ptr<const Preview>, 2> previews;
  std::array<bool, 2> is_newest{};
  {
    const std::scoped_lock lock(impl_->mutex);
    if (!impl_->seed) throw InvalidInput("there is no seed that wires could start from");
    impl_->rethrow();
    if (impl_->target != target) {
      impl_->target = target;
      ++impl_->targets;
    }
    for (std::size_t which = 0; which < kFollow.size(); ++which) {
      const Impl::Worker& worker = impl_->workers[which];
      solved[which] = worker.solved;
      is_newest[which] = worker.solved != nullptr && worker.solved_for == impl_->request;
      const bool fits = worker.preview && worker.preview->request == impl_->request && worker.preview->target == target;
      if (!is_newest[which] && fits) previews[which] = worker.preview;
    }
  }
  LiveWires result;
  for (std::size_t which = 0; which < kFollow.size(); ++which) {
    LiveCandidate& wire = result.wires[which];
    wire.follow = kFollow[which];
    if (previews[which]) {
      wire = previews[which]->candidate;
    } else if (solved[which]) {
      const bool is_final = is_newest[which] && solved[which]->is_final(target);  // before it is looked up
      wire = impl_->candidate(which, *solved[which], target);
      wire.final = is_final;
    }
  }
  result.shorter = result.wires[1].length < result.wires[0].length ? 1 : 0;
  return result;
}

LiveLoop LiveWire::loop(const Edge& edge) {
  if (impl_->ground->along != Along::kEdges) throw InvalidInput("loops run along edges, not across the surface");
  check_edge(impl_->surface(), edge);
  const Edge sorted = {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])};
  const std::scoped_lock lock(impl_->mutex);
  impl_->rethrow();
  auto& workers = impl_->workers;
  if (impl_->loop_edge != sorted) {
    ++impl_->loop_request;
    impl_->loop_edge = sorted;
    for (Impl::Worker& worker : workers) {
      if (worker.is_at_loop) worker.solving.request_stop();
    }
    impl_->changed.notify_all();
  }
  if (!std::ranges::all_of(workers, [&](const auto& w) { return w.loop_handled == impl_->loop_request; })) return {};
  const EdgeChain& cheaper = workers[1].loop.length < workers[0].loop.length ? workers[1].loop : workers[0].loop;
  return {.vertices = cheaper.vertices, .length = cheaper.length, .final = true};
}

EdgeChain LiveWire::run_on(const Edge& edge, std::span<const std::int32_t> stops) const {
  check_edge(impl_->surface(), edge);
  const auto fans = impl_->ground->fans.peek();
  if (!fans) return {};
  EdgeChain way{.vertices = seamwire::run_on(**fans, edge, stops), .length = 0.0};
  const auto point = [&](std::int32_t v) -> const Vector& {
    return impl_->surface().points()[static_cast<std::size_t>(v)];
  };
  for (std::size_t i = 1; i < way.vertices.size(); ++i) {
    way.length += impl_->surface().scale() * (point(way.vertices[i]) - point(way.vertices[i - 1])).norm();
  }
  return way;
}

EdgeStrip LiveWire::strip(const Edge& edge, std::span<const std::int32_t> stops) const {
  check_edge(impl_->surface(), edge);
  const auto fans = impl_->ground->fans.peek();
  return fans ? edge_strip(**fans, edge, stops) : EdgeStrip{};
}

std::shared_ptr<const std::vector<double>> LiveWire::feature_strength() const {
  std::shared_ptr<const Curved> curved = impl_->ground->curved.peek();
  return curved ? std::shared_ptr<const std::vector<double>>(curved, &curved->difference) : nullptr;
}

double LiveWire::progress() const {
  const std::scoped_lock lock(impl_->mutex);
  double sum = 0.0;
  for (std::size_t which = 0; which < kFollow.size(); ++which) {
    const Impl::Worker& worker = impl_->workers[which];
    if (worker.handled == impl_->request) {
      sum += 1.0;
      continue;
    }
    const double solved = std::clamp(worker.fraction.load(), 0.0, 1.0);
    const double prepared = std::clamp(impl_->metrics->fractions[which].load(), 0.0, 1.0);
    sum += worker.was_prepared ? solved : kSolveBegins * prepared + (1.0 - kSolveBegins) * solved;
  }
  return sum / static_cast<double>(kFollow.size());
}

bool LiveWire::wait(double seconds) const {
  constexpr double kForever = 1e9;  // a longer time would overflow the clock
  std::unique_lock lock(impl_->mutex);
  const auto idle = [&] { return impl_->idle(); };
  if (seconds >= kForever) {
    impl_->changed.wait(lock, idle);
  } else {
    impl_->changed.wait_for(lock, std::chrono::duration<double>(std::max(0.0, seconds)), idle);
  }
  impl_->rethrow();
  return impl_->idle();
}

}  // namespace seamwire
