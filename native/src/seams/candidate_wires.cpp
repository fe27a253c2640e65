// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/candidate_wires.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <optional>
#include <stop_token>
#include <system_error>
#include <thread>
#include <utility>

#include "detail/thread_safety.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/wires/snap.hpp"
#include "seamwire/wires/wire.hpp"
#include "surface/exact_unit.hpp"

namespace seamwire {
namespace {

/// A solve takes memory for a part of the surface, so threads are not begun without end.
constexpr std::size_t kMostThreads = 8;
constexpr double kTurning = 3.0;  // as LiveWireOptions

/// How often the caller is told of the progress, and asked whether to go on.
constexpr std::chrono::milliseconds kPeriod{20};

/// The work of the threads of run_on_threads(): done and left.
class SharedWork {
 public:
  SharedWork(std::size_t count, std::size_t threads) : count_(count), running_(threads) {}

  /// The next piece of work; nullopt if all are taken or one has failed.
  std::optional<std::size_t> take() {
    const MutexLock lock(mutex_);
    if (next_ == count_ || error_) return std::nullopt;
    return next_++;
  }
  /// A piece of work is done; `thrown`: what it threw, or null.
  void finish(const std::exception_ptr& thrown) {
    const MutexLock lock(mutex_);
    if (thrown && !error_) error_ = thrown;
    ++done_;
  }
  /// No more pieces are taken. An earlier error stays.
  void fail(const std::exception_ptr& error) {
    const MutexLock lock(mutex_);
    if (!error_) error_ = error;
  }
  /// That many threads have ended, or could not be started.
  void end_threads(std::size_t threads) {
    const MutexLock lock(mutex_);
    running_ -= threads;
    changed_.notify_one();
  }

  /// Waits at most that long; whether all threads have ended.
  bool wait(std::chrono::milliseconds duration) {
    MutexLock lock(mutex_);
    return changed_.wait_for(lock, duration, [this]() SEAMWIRE_REQUIRES(mutex_) { return running_ == 0; });
  }
  std::size_t done() const {
    const MutexLock lock(mutex_);
    return done_;
  }
  std::exception_ptr error() const {
    const MutexLock lock(mutex_);
    return error_;
  }

 private:
  const std::size_t count_;
  mutable Mutex mutex_;
  std::condition_variable_any changed_;  // running_
  std::size_t next_ SEAMWIRE_GUARDED_BY(mutex_) = 0;
  std::size_t done_ SEAMWIRE_GUARDED_BY(mutex_) = 0;
  std::size_t running_ SEAMWIRE_GUARDED_BY(mutex_);
  std::exception_ptr error_ SEAMWIRE_GUARDED_BY(mutex_);
};

/// Calls work(i, task) for each i below `count` on as many threads as there are cores, while this one tells the caller
/// fraction(how many are done). What one of them throws comes out of here, when all have ended.
void run_on_threads(std::size_t count, const Task& task, const std::function<double(std::size_t)>& fraction,
                    const std::function<void(std::size_t, const Task&)>& work) {
  std::stop_source stop;
  const std::stop_callback forward(task.stop, [&stop] { stop.request_stop(); });
  const std::size_t cores = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, kMostThreads);
  const std::size_t thread_count = std::min(cores, count);
  SharedWork shared(count, thread_count);
  const auto run = [&] {
    while (const std::optional<std::size_t> i = shared.take()) {
      std::exception_ptr thrown;
      try {
        work(*i, {.stop = stop.get_token(), .progress = {}});
      } catch (...) {
        thrown = std::current_exception();
        stop.request_stop();
      }
      shared.finish(thrown);
    }
    shared.end_threads(1);
  };
  std::vector<std::jthread> threads;
  try {
    for (std::size_t i = 0; i < thread_count; ++i) threads.emplace_back(run);
  } catch (const std::system_error&) {
    if (threads.empty()) throw;
    shared.end_threads(thread_count - threads.size());
  }
  while (!shared.wait(kPeriod)) {
    if (!task.progress || task.progress(fraction(shared.done()))) continue;
    stop.request_stop();
    shared.fail(std::make_exception_ptr(Cancelled()));
  }
  if (const std::exception_ptr error = shared.error()) std::rethrow_exception(error);
}

}  // namespace

CandidateWires::CandidateWires(std::shared_ptr<const Surface> surface, Along along, const Strength& strength,
                               const Task& task)
    : along_(along), surfaces_(std::make_unique<SurfaceCache>(std::move(surface))) {
  curvatures_ = surfaces_->curvatures_now(task.stop);
  MetricSet metrics(MetricFamily::kFeature, along_, strength, {});
  run_on_threads(
      metrics_.size(), task, [&](std::size_t) { return 0.5 * (metrics.fractions[0] + metrics.fractions[1]); },
      [&](std::size_t which, const Task& own) {
        metrics_[which] = prepare(*surfaces_, along_, metrics, which, own.stop);
      });
}

std::vector<std::vector<CandidateWire>> CandidateWires::find(std::span<const Fan> fans, const Task& task,
                                                             Effort effort) const {
  std::vector<std::array<std::vector<Found>, 2>> found(fans.size());
  const auto all = static_cast<double>(std::max<std::size_t>(2 * fans.size(), 1));
  run_on_threads(
      2 * fans.size(), task, [&](std::size_t done) { return static_cast<double>(done) / all; },
      [&](std::size_t i, const Task& own) {
        found[i / 2][i % 2] = find_in(metrics_[i % 2], fans[i / 2], effort, own);
      });
  std::vector<std::vector<CandidateWire>> wires(fans.size());
  for (std::size_t i = 0; i < fans.size(); ++i) {
    for (std::size_t k = 0; k < fans[i].to.size(); ++k) {
      const std::size_t which = found[i][1][k].length < found[i][0][k].length ? 1 : 0;
      Found& best = found[i][which][k];
      const double strength = best.length > 0.0 ? best.euclidean / best.length : 1.0;
      wires[i].push_back({.follow = kFollow[which],
                          .vertices = std::move(best.vertices),
                          .points = std::move(best.points),
                          .faces = std::move(best.faces),
                          .strength = strength});
    }
  }
  return wires;
}

std::vector<CandidateWires::Found> CandidateWires::find_in(const Prepared& metric, const Fan& fan, Effort effort,
                                                           const Task& task) const {
  if (along_ == Along::kEdges) return find_along_edges(metric, fan, task);
  return effort == Effort::kExact ? find_on_surface(metric, fan, task) : find_quickly(metric, fan, task);
}

CandidateWires::Found CandidateWires::found(const Prepared& metric, Wire wire, const Task& task) const {
  std::vector<std::int32_t> vertices = snap_to_edges(surface(), *metric.snap_graph, wire, task);
  return {std::move(vertices), std::move(wire.points), std::move(wire.faces), wire.length, wire.euclidean_length};
}

std::vector<CandidateWires::Found> CandidateWires::find_quickly(const Prepared& metric, const Fan& fan,
                                                                const Task& task) const {
  CorridorPaths paths(*metric.geodesics, fan.from);
  std::vector<Found> all;
  for (const std::int32_t v : fan.to) {
    Wire wire = map_wire(surface(), *metric.embedding, paths.path(v, task));
    wire.from = fan.from;
    wire.to = v;
    all.push_back(found(metric, std::move(wire), task));
  }
  return all;
}

std::vector<CandidateWires::Found> CandidateWires::find_on_surface(const Prepared& metric, const Fan& fan,
                                                                   const Task& task) const {
  SolveOptions until;
  for (const std::int32_t v : fan.to) until.targets.push_back(SurfacePoint::at_vertex(v));
  const std::array<SurfacePoint, 1> from = {SurfacePoint::at_vertex(fan.from)};
  const DistanceField field = metric.geodesics->solve(from, until, task);
  std::vector<Found> all;
  all.reserve(fan.to.size());
  for (const std::int32_t v : fan.to) {
    all.push_back(found(metric, trace_wire(surface(), *metric.embedding, field, v, task), task));
  }
  return all;
}

std::vector<CandidateWires::Found> CandidateWires::find_along_edges(const Prepared& metric, const Fan& fan,
                                                                    const Task& task) const {
  EdgeWires wires(metric.graph, {.a = fan.from}, kTurning);
  bool is_enough = false;
  const Task until{.stop = task.stop, .progress = [&](double fraction) {
                     is_enough = std::ranges::all_of(fan.to, [&](std::int32_t v) { return wires.is_final({.a = v}); });
                     return !is_enough && (!task.progress || task.progress(fraction));
                   }};
  try {
    wires.run(until);
  } catch (const Cancelled&) {
    if (!is_enough) throw;
  }
  const double unit = exact_unit(surface());
  std::vector<Found> found;
  for (const std::int32_t v : fan.to) {
    EdgeChain chain = wires.trace({.a = v});
    std::vector<Vector> points;
    points.reserve(chain.vertices.size());
    for (const std::int32_t vertex : chain.vertices) points.push_back(surface().points()[vertex]);
    double euclidean = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) euclidean += (unit * (points[i] - points[i - 1])).norm();
    euclidean *= surface().scale() / unit;
    found.push_back({std::move(chain.vertices), std::move(points), {}, chain.length, euclidean});
  }
  return found;
}

}  // namespace seamwire
