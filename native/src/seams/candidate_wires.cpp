// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/candidate_wires.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <stop_token>
#include <system_error>
#include <thread>
#include <utility>

#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/wires/snap.hpp"
#include "seamwire/wires/wire.hpp"

namespace seamwire {
namespace {

/// A solve takes memory for a part of the surface, so threads are not begun without end.
constexpr std::size_t kMostThreads = 8;
constexpr double kTurning = 3.0;  // as LiveWireOptions

/// How often the caller is told of the progress, and asked whether to go on.
constexpr std::chrono::milliseconds kPeriod{20};

/// Calls work(i, task) for each i below `count` on as many threads as there are cores, while this one tells the caller
/// fraction(how many are done). What one of them throws comes out of here, when all have ended.
void run_on_threads(std::size_t count, const Task& task, const std::function<double(std::size_t)>& fraction,
                    const std::function<void(std::size_t, const Task&)>& work) {
  std::stop_source stop;
  const std::stop_callback forward(task.stop, [&stop] { stop.request_stop(); });
  std::mutex mutex;
  std::condition_variable changed;
  std::size_t next = 0, done = 0, running = 0;  // with the mutex
  std::exception_ptr error;                     // with the mutex
  const auto take = [&] {
    std::unique_lock lock(mutex);
    while (next < count && !error) {
      const std::size_t i = next++;
      lock.unlock();
      std::exception_ptr thrown;
      try {
        work(i, {.stop = stop.get_token(), .progress = {}});
      } catch (...) {
        thrown = std::current_exception();
        stop.request_stop();
      }
      lock.lock();
      if (thrown && !error) error = thrown;
      ++done;
    }
    --running;
    changed.notify_one();
  };
  const std::size_t cores = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, kMostThreads);
  std::vector<std::jthread> threads;
  running = std::min(cores, count);
  try {
    for (std::size_t i = 0; i < std::min(cores, count); ++i) threads.emplace_back(take);
  } catch (const std::system_error&) {
    if (threads.empty()) throw;
    const std::scoped_lock lock(mutex);
    running -= std::min(cores, count) - threads.size();
  }
  std::unique_lock lock(mutex);
  while (!changed.wait_for(lock, kPeriod, [&] { return running == 0; })) {
    if (!task.progress) continue;
    const std::size_t now = done;
    lock.unlock();
    const bool goes_on = task.progress(fraction(now));
    if (!goes_on) stop.request_stop();
    lock.lock();
    if (!goes_on && !error) error = std::make_exception_ptr(Cancelled());
  }
  if (error) std::rethrow_exception(error);
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
  std::vector<Found> found;
  for (const std::int32_t v : fan.to) {
    EdgeChain chain = wires.trace({.a = v});
    std::vector<Vector> points;
    points.reserve(chain.vertices.size());
    for (const std::int32_t vertex : chain.vertices) points.push_back(surface().points()[vertex]);
    double euclidean = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) euclidean += (points[i] - points[i - 1]).norm();
    found.push_back({std::move(chain.vertices), std::move(points), {}, chain.length, euclidean * surface().scale()});
  }
  return found;
}

}  // namespace seamwire
