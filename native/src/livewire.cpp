// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/livewire.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "seamwire/embedding.hpp"
#include "seamwire/geodesics.hpp"

namespace seamwire {

namespace {

constexpr std::array kFollow = {Follow::kMin, Follow::kMax};

/// Fractions of the first solve's work, preparation included, at which its parts begin.
constexpr double kEmbedBegins = 0.1, kSolveBegins = 0.5;

/// An artist waits for an embedding, and one that runs away is better cut short, with small holes: at most so many
/// triangles are added, or so many times the surface's.
constexpr std::size_t kFacesAdded = 200'000, kFacesAddedPerFace = 12;

/// What one metric needs for any seed: the first two across the surface, the last along edges.
struct Prepared {
  std::optional<Embedding> embedding;
  std::optional<ExactGeodesics> geodesics;
  std::shared_ptr<const EdgeGraph> graph;
};

/// The wires of one metric from one seed.
struct Solved {
  std::shared_ptr<const Prepared> prepared;
  std::optional<DistanceField> field;
  std::optional<EdgeWires> wires;
};

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

void check_options(const LiveWireOptions& options) {
  check_strength(options.strength);
  for (const double turning : {options.turning, options.loop_turning.value_or(0.0)}) {
    if (!(std::isfinite(turning) && turning >= 0)) {
      throw InvalidInput("turning is " + std::to_string(turning) + ", not a finite number of at least 0");
    }
  }
}

double loop_turning_for(std::size_t edges) { return std::max(20.0, std::sqrt(static_cast<double>(edges)) / 4.0); }

}  // namespace

struct LiveWire::Impl {
  /// What one worker is at. `request` numbers are those of Impl.
  struct Worker {
    std::shared_ptr<const Prepared> prepared;
    std::shared_ptr<const Solved> solved;  // for the newest request, if at all
    std::int64_t handled = -1;             // the request that was answered, or failed, last
    std::exception_ptr error;              // why it failed
    std::stop_source solving;
    std::atomic<double> fraction = 0.0;
  };

  Impl(std::shared_ptr<const Surface> on, const LiveWireOptions& with) : surface(std::move(on)), options(with) {}

  Prepared prepare(std::size_t which, std::atomic<double>& fraction);
  Solved solve(const std::shared_ptr<const Prepared>& prepared, const Pick& pick, bool is_forward,
               const Task& task) const;
  void work(std::size_t which);
  LiveCandidate candidate(std::size_t which, const Solved* solved, const Pick& target) const;

  bool idle() const {
    return std::all_of(workers.begin(), workers.end(), [&](const Worker& w) { return w.handled == request; });
  }
  void rethrow() const {
    for (const Worker& worker : workers) {
      if (worker.error) std::rethrow_exception(worker.error);
    }
  }

  const std::shared_ptr<const Surface> surface;
  const LiveWireOptions options;

  // Made by the first worker that needs them, not changed after.
  std::once_flag curvature_made, snap_graph_made;
  Curvature curvature;
  std::optional<SnapGraph> snap_graph;

  mutable std::mutex mutex;  // guards what follows, but for the fractions
  mutable std::condition_variable changed;
  std::stop_source quit;
  std::int64_t request = 0;  // number of the newest seed; 0: none yet
  Pick seed;
  bool forward = false;
  std::array<Worker, 2> workers;

  std::array<std::jthread, 2> threads;  // last, so that they end first
};

Prepared LiveWire::Impl::prepare(std::size_t which, std::atomic<double>& fraction) {
  const bool on_surface = options.along == Along::kSurface;
  const auto make_snap_graph = [&] {
    if (on_surface) std::call_once(snap_graph_made, [&] { snap_graph.emplace(*surface); });
  };
  if (which == 1) make_snap_graph();  // while the other thread is at the curvatures
  std::call_once(curvature_made, [&] { curvature = principal_curvatures(*surface); });
  make_snap_graph();
  Task task{.stop = quit.get_token(), .progress = {}};
  task.check(0.0);
  const Metric metric = feature_metric(*surface, curvature, kFollow[which], options.strength);
  fraction = kEmbedBegins;
  Prepared prepared;
  if (on_surface) {
    task.progress = [&fraction](double done) {
      fraction = kEmbedBegins + (kSolveBegins - kEmbedBegins) * done;
      return true;
    };
    const EmbedOptions embed_options{.max_faces_added =
                                         std::max(kFacesAdded, kFacesAddedPerFace * surface->face_count())};
    prepared.embedding = embed(*surface, metric, embed_options, task);
    prepared.geodesics.emplace(prepared.embedding->mesh);
  } else {
    prepared.graph = make_edge_graph(*surface, metric);
  }
  return prepared;
}

Solved LiveWire::Impl::solve(const std::shared_ptr<const Prepared>& prepared, const Pick& pick, bool is_forward,
                             const Task& task) const {
  Solved solved{.prepared = prepared, .field = std::nullopt, .wires = std::nullopt};
  if (options.along == Along::kSurface) {
    solved.field = prepared->geodesics->solve(pick.a, task);
  } else {
    solved.wires = edge_wires(prepared->graph, pick, options.turning, is_forward, task);
  }
  return solved;
}

void LiveWire::Impl::work(std::size_t which) {
  Worker& worker = workers[which];
  std::unique_lock lock(mutex);
  while (true) {
    changed.wait(lock, [&] { return quit.stop_requested() || worker.handled != request; });
    if (quit.stop_requested()) return;
    const std::int64_t at = request;
    const Pick pick = seed;
    const bool is_forward = forward;
    worker.solving = std::stop_source();
    worker.fraction = 0.0;
    std::shared_ptr<const Prepared> prepared = worker.prepared;
    Task task{.stop = worker.solving.get_token(), .progress = {}};
    lock.unlock();

    std::shared_ptr<const Solved> solved;
    std::exception_ptr error;
    try {
      double begin = 0.0;
      if (!prepared) {
        prepared = std::make_shared<const Prepared>(prepare(which, worker.fraction));
        begin = kSolveBegins;
      }
      if (at > 0) {
        task.progress = [&worker, begin](double done) {
          worker.fraction = begin + (1.0 - begin) * done;
          return true;
        };
        solved = std::make_shared<const Solved>(solve(prepared, pick, is_forward, task));
      }
    } catch (const Cancelled&) {
      // By a newer seed, or to quit.
    } catch (...) {
      error = std::current_exception();
    }

    lock.lock();
    worker.prepared = prepared;
    worker.handled = at;
    if (at == request) {
      worker.solved = std::move(solved);
      worker.error = std::move(error);
    }
    changed.notify_all();
  }
}

LiveCandidate LiveWire::Impl::candidate(std::size_t which, const Solved* solved, const Pick& target) const {
  LiveCandidate candidate;
  candidate.follow = kFollow[which];
  candidate.final = solved != nullptr;
  if (solved == nullptr) return candidate;
  if (solved->wires) {
    EdgeChain chain = solved->wires->trace(target);
    candidate.length = chain.length;
    candidate.vertices = std::move(chain.vertices);
    for (const std::int32_t v : candidate.vertices) {
      candidate.points.push_back(surface->points()[static_cast<std::size_t>(v)]);
    }
  } else {
    Wire wire = trace_wire(*surface, *solved->prepared->embedding, *solved->field, target.a);
    candidate.vertices = snap_to_edges(*surface, *snap_graph, wire);
    candidate.length = wire.length;
    candidate.points = std::move(wire.points);
    candidate.faces = std::move(wire.faces);
  }
  return candidate;
}

LiveWire::LiveWire(std::shared_ptr<const Surface> surface, const LiveWireOptions& options) {
  check_options(options);
  impl_ = std::make_unique<Impl>(std::move(surface), options);
  for (std::size_t which = 0; which < kFollow.size(); ++which) {
    impl_->threads[which] = std::jthread([impl = impl_.get(), which] { impl->work(which); });
  }
}

LiveWire::~LiveWire() {
  const std::scoped_lock lock(impl_->mutex);
  impl_->quit.request_stop();
  for (Impl::Worker& worker : impl_->workers) worker.solving.request_stop();
  impl_->changed.notify_all();
}

void LiveWire::seed(const Pick& pick, bool forward) {
  check_pick(*impl_->surface, impl_->options.along, pick);
  std::array<std::shared_ptr<const Solved>, 2> dropped;  // freed without the lock
  const std::scoped_lock lock(impl_->mutex);
  ++impl_->request;
  impl_->seed = pick;
  impl_->forward = forward;
  for (std::size_t which = 0; which < kFollow.size(); ++which) {
    Impl::Worker& worker = impl_->workers[which];
    worker.solving.request_stop();
    worker.error = nullptr;
    dropped[which] = std::move(worker.solved);
    worker.solved = nullptr;
  }
  impl_->changed.notify_all();
}

LiveWires LiveWire::wires(const Pick& target) const {
  check_pick(*impl_->surface, impl_->options.along, target);
  std::array<std::shared_ptr<const Solved>, 2> solved;
  {
    const std::scoped_lock lock(impl_->mutex);
    if (impl_->request == 0) throw InvalidInput("there is no seed that wires could start from");
    impl_->rethrow();
    for (std::size_t which = 0; which < kFollow.size(); ++which) solved[which] = impl_->workers[which].solved;
  }
  LiveWires result;
  for (std::size_t which = 0; which < kFollow.size(); ++which) {
    result.wires[which] = impl_->candidate(which, solved[which].get(), target);
  }
  const auto& [min, max] = result.wires;
  result.shorter = max.final && (!min.final || max.length < min.length) ? 1 : 0;
  return result;
}

EdgeChain LiveWire::loop(const Edge& edge) const {
  if (impl_->options.along != Along::kEdges) throw InvalidInput("loops run along edges, not across the surface");
  check_edge(*impl_->surface, edge);
  std::array<std::shared_ptr<const Prepared>, 2> prepared;
  {
    const std::scoped_lock lock(impl_->mutex);
    impl_->rethrow();
    for (std::size_t which = 0; which < kFollow.size(); ++which) prepared[which] = impl_->workers[which].prepared;
  }
  if (!prepared[0] || !prepared[1]) return {};
  const double turning = impl_->options.loop_turning.value_or(loop_turning_for(impl_->surface->edges().size()));
  EdgeChain min = edge_loop(*prepared[0]->graph, edge, turning);
  EdgeChain max = edge_loop(*prepared[1]->graph, edge, turning);
  return max.length < min.length ? max : min;
}

double LiveWire::progress() const {
  const std::scoped_lock lock(impl_->mutex);
  double sum = 0.0;
  for (const Impl::Worker& worker : impl_->workers) {
    sum += worker.handled == impl_->request ? 1.0 : std::clamp(worker.fraction.load(), 0.0, 1.0);
  }
  return sum / static_cast<double>(impl_->workers.size());
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
