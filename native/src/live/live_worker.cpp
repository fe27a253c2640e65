// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/live_worker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "seamwire/edges/shortest_cycle.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"

namespace seamwire {
namespace {

double loop_turning_for(std::size_t edges) { return std::max(20.0, std::sqrt(static_cast<double>(edges)) / 4.0); }

}  // namespace

bool has_edge(const Surface& surface, const Edge& edge) {
  const Edge sorted = {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])};
  return std::binary_search(surface.edges().begin(), surface.edges().end(), sorted);
}

LiveWire::Impl::Impl(std::shared_ptr<SurfaceCache> on, std::shared_ptr<MetricPair> by, const LiveWireOptions& with)
    : surface_cache(std::move(on)),
      along(with.along),
      turning(with.turning),
      loop_turning(with.loop_turning),
      metrics(std::move(by)) {
  for (std::size_t which = 0; which < kFollow.size(); ++which) {
    threads[which] = std::jthread([this, which](const std::stop_token& quit) { work(which, quit); });
  }
}

LiveWire::Impl::~Impl() {
  for (std::jthread& thread : threads) thread.request_stop();  // both, before the first of them is joined
}

/// Builds the surface, or waits for the thread that does; false where there is none.
bool LiveWire::Impl::await_surface(const std::stop_token& quit) {
  std::exception_ptr error;
  try {
    surface_cache->surface_now(quit);
  } catch (const Cancelled&) {
    return false;
  } catch (...) {
    error = std::current_exception();
  }
  const std::scoped_lock lock(mutex);
  failure = error;
  changed.notify_all();
  return !failure;
}

void LiveWire::Impl::work(std::size_t which, const std::stop_token& quit) {
  if (!await_surface(quit)) return;
  Worker& worker = workers[which];
  const std::stop_callback stop_work(quit, [&] {
    const std::scoped_lock lock(mutex);
    worker.preparing.request_stop();
    worker.solving.request_stop();
  });
  std::unique_lock lock(mutex);
  while (true) {
    changed.wait(lock, quit, [&] {
      return worker.handled != request || worker.loop_handled != loop_request || !worker.dropped.empty();
    });
    if (quit.stop_requested()) return;
    if (!worker.dropped.empty()) {
      std::vector<std::shared_ptr<const void>> dropped = std::exchange(worker.dropped, {});
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
  std::shared_ptr<MetricPair> with = metrics;
  const std::int64_t at = request;
  const std::optional<Pick> pick = seed;
  const bool is_forward = forward;
  const std::stop_token preparing = worker.preparing.get_token();
  // For this seed, if there is one: a new seed drops it.
  std::shared_ptr<const SeedSolution> before = worker.solution;
  worker.fraction = 0.0;
  worker.was_prepared = with->prepared[which]->peek() != nullptr;
  const Task task{.stop = worker.solving.get_token(), .progress = [&worker](double done) {
                    worker.fraction = done;
                    return true;
                  }};
  lock.unlock();

  std::shared_ptr<const SeedSolution> solution;
  std::exception_ptr error;
  try {
    const std::shared_ptr<const Prepared> prepared =
        with->prepared[which]->get(preparing, [&] { return prepare(*surface_cache, along, *with, which, preparing); });
    with->forget_former(which);
    const bool is_sown =
        pick && (!pick->is_edge() || has_edge(surface(), {pick->a, pick->b}));  // wires() refuses others
    if (before && before->field && before->prepared == prepared) {
      solution = before;  // the other metric was changed
    } else if (is_sown) {
      task.check(0.0);
      solution = along == Along::kSurface ? find_field(which, prepared, pick->a, at, task)
                                          : find_chains(which, prepared, *pick, is_forward, at, task);
    }
  } catch (const Cancelled&) {
    // By a newer request, or to quit.
  } catch (...) {
    error = std::current_exception();
  }
  with = nullptr;  // without the lock: it may be the last to hold a former metric

  lock.lock();
  worker.handled = at;
  if (at == request) {
    if (worker.solution != solution) worker.dropped.push_back(std::exchange(worker.solution, solution));
    worker.solution_for = at;
    worker.preview = nullptr;
    worker.error = std::move(error);
  }
  lock.unlock();
  before = solution = nullptr;
  lock.lock();
}

void LiveWire::Impl::work_on_loop(std::size_t which, std::unique_lock<std::mutex>& lock) {
  Worker& worker = workers[which];
  const std::int64_t at = loop_request;
  const Edge edge = loop_edge;
  std::shared_ptr<const Prepared> prepared = metrics->prepared[which]->peek();  // null: that failed
  const Task task{.stop = worker.solving.get_token(), .progress = {}};
  worker.is_at_loop = true;
  lock.unlock();

  EdgeChain loop;
  std::exception_ptr error;
  bool is_cancelled = false;
  try {
    if (prepared && has_edge(surface(), edge)) {  // loop() refuses others
      loop = shortest_cycle(*prepared->graph, edge, loop_turning.value_or(loop_turning_for(surface().edges().size())),
                            task);
    }
  } catch (const Cancelled&) {
    is_cancelled = true;  // by a newer loop, which counts then, or by a seed, which goes first
  } catch (...) {
    error = std::current_exception();
  }
  prepared = nullptr;  // without the lock, as in work_on_seed()

  lock.lock();
  worker.is_at_loop = false;
  if (is_cancelled || at != loop_request) return;
  worker.loop_handled = at;
  worker.loop = std::move(loop);
  if (error) worker.error = std::move(error);
}

/// Between the steps of the search for the field it finds wires to the targets that are asked for meanwhile: on a
/// thread of its own that would take turns with the search all the same.
std::shared_ptr<const SeedSolution> LiveWire::Impl::find_field(std::size_t which,
                                                               const std::shared_ptr<const Prepared>& prepared,
                                                               std::int32_t from, std::int64_t at, Task task) {
  Worker& worker = workers[which];
  CorridorPaths quick(*prepared->geodesics, from);
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
  return std::make_shared<const SeedSolution>(
      SeedSolution{.prepared = prepared, .field = std::move(field), .wires = std::nullopt});
}

/// What is found can be seen from the beginning.
std::shared_ptr<const SeedSolution> LiveWire::Impl::find_chains(std::size_t which,
                                                                const std::shared_ptr<const Prepared>& prepared,
                                                                const Pick& from, bool is_forward, std::int64_t at,
                                                                const Task& task) {
  EdgeWires wires(prepared->graph, from, turning, is_forward);
  auto solution =
      std::make_shared<const SeedSolution>(SeedSolution{.prepared = prepared, .field = std::nullopt, .wires = wires});
  {
    const std::scoped_lock lock(mutex);
    if (at == request) {
      Worker& worker = workers[which];
      worker.dropped.push_back(std::exchange(worker.solution, solution));
      worker.solution_for = at;
    }
  }
  wires.run(task);
  return solution;
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

LiveCandidate LiveWire::Impl::candidate(std::size_t which, const SeedSolution& solution, const Pick& target) const {
  if (solution.field) {
    const Prepared& prepared = *solution.prepared;
    return candidate_of(which, prepared, trace_wire(surface(), *prepared.embedding, *solution.field, target.a));
  }
  LiveCandidate candidate;
  candidate.follow = kFollow[which];
  EdgeChain chain = solution.wires->trace(target);
  candidate.length = chain.length;
  candidate.vertices = std::move(chain.vertices);
  candidate.points.reserve(candidate.vertices.size());
  for (const std::int32_t v : candidate.vertices) {
    candidate.points.push_back(surface().points()[static_cast<std::size_t>(v)]);
  }
  return candidate;
}

void LiveWire::Impl::change_metrics(std::shared_ptr<MetricPair> to) {
  const std::scoped_lock lock(mutex);
  metrics.swap(to);
  ++request;
  drop_loop();
  for (std::size_t which = 0; which < workers.size(); ++which) {
    Worker& worker = workers[which];
    if (metrics->prepared[which] != to->prepared[which]) worker.preparing.request_stop();
    worker.solving.request_stop();
    worker.error = nullptr;
  }
  workers.front().dropped.push_back(std::move(to));  // the former ones
  changed.notify_all();
}

}  // namespace seamwire
