// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include "live/prepared_metrics.hpp"

/// The two threads behind a LiveWire, and what they share with its caller.
namespace seamwire {

/// In either direction.
bool has_edge(const Surface& surface, const Edge& edge);

/// The wires of one metric from one seed. Along edges it may still be at work.
struct SeedSolution {
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

struct LiveWire::Impl {
  /// What one worker is at. Numbers of requests are those of Impl.
  struct Worker {
    // Of the newest seed; of a former metric where solution_for is not `request`.
    std::shared_ptr<const SeedSolution> solution;
    std::int64_t solution_for = -1;
    std::shared_ptr<const Preview> preview;
    std::vector<std::shared_ptr<const void>> dropped;  // to be freed here, without the lock: that takes long
    std::int64_t handled = -1;                         // the request that was answered, or failed, last
    std::exception_ptr error;                          // why it failed
    EdgeChain loop;
    std::int64_t loop_handled = 0;
    std::stop_source preparing, solving;  // of the running work
    bool is_at_loop = false;
    bool was_prepared = false;  // when it began
    std::atomic<double> fraction = 0.0;
  };

  /// `with`: but for the metrics.
  Impl(std::shared_ptr<SurfaceCache> on, std::shared_ptr<MetricPair> by, const LiveWireOptions& with);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  /// Once it is built, as in all that workers do.
  const Surface& surface() const { return surface_cache->surface(); }
  bool await_surface(const std::stop_token& quit);
  void work(std::size_t which, const std::stop_token& quit);
  void work_on_seed(std::size_t which, std::unique_lock<std::mutex>& lock);
  void work_on_loop(std::size_t which, std::unique_lock<std::mutex>& lock);
  std::shared_ptr<const SeedSolution> find_field(std::size_t which, const std::shared_ptr<const Prepared>& prepared,
                                                 std::int32_t from, std::int64_t at, Task task);
  std::shared_ptr<const SeedSolution> find_chains(std::size_t which, const std::shared_ptr<const Prepared>& prepared,
                                                  const Pick& from, bool is_forward, std::int64_t at, const Task& task);
  LiveCandidate candidate_of(std::size_t which, const Prepared& prepared, Wire wire) const;
  LiveCandidate candidate(std::size_t which, const SeedSolution& solution, const Pick& target) const;
  void change_metrics(std::shared_ptr<MetricPair> to);

  /// With the lock.
  bool idle() const {
    return failure || std::ranges::all_of(workers, [&](const Worker& w) {
             return w.handled == request && w.loop_handled == loop_request;
           });
  }
  void rethrow_failure() const {
    if (failure) std::rethrow_exception(failure);
  }
  void rethrow() const {
    rethrow_failure();
    for (const Worker& worker : workers) {
      if (worker.error) std::rethrow_exception(worker.error);
    }
  }
  /// Without the lock. Throws why there will be no surface.
  void check_surface() const {
    const std::scoped_lock lock(mutex);
    rethrow_failure();
  }
  /// The same; null until the surface is built.
  std::shared_ptr<const Surface> surface_if_built() const {
    const std::scoped_lock lock(mutex);
    rethrow_failure();
    return surface_cache->peek_surface();
  }
  std::shared_ptr<MetricPair> metrics_now() const {
    const std::scoped_lock lock(mutex);
    return metrics;
  }
  /// With the lock, which it gives up while it waits; at most `seconds`.
  template <class Condition>
  void wait_until(std::unique_lock<std::mutex>& lock, double seconds, const Condition& condition) const {
    constexpr double kForever = 1e9;  // a longer time would overflow the clock
    if (seconds >= kForever) {
      changed.wait(lock, condition);
    } else {
      changed.wait_for(lock, std::chrono::duration<double>(std::max(0.0, seconds)), condition);
    }
  }
  /// With the lock.
  void drop_loop() {
    loop_edge = {-1, -1};
    for (Worker& worker : workers) worker.loop_handled = loop_request;
  }

  const std::shared_ptr<SurfaceCache> surface_cache;
  const Along along;
  const double turning;
  const std::optional<double> loop_turning;

  mutable std::mutex mutex;  // guards what follows, but for the fractions
  mutable std::condition_variable_any changed;
  std::shared_ptr<MetricPair> metrics;
  std::exception_ptr failure;  // why there is no surface, for good
  std::int64_t request = 0;    // grows with each seed and each change of the metric
  std::optional<Pick> seed;
  bool forward = false;
  Pick target;                            // what wires were asked for last
  std::atomic<std::int64_t> targets = 0;  // how often that was another one
  std::int64_t loop_request = 0;
  Edge loop_edge = {-1, -1};  // of the newest loop asked for
  std::array<Worker, 2> workers;

  std::array<std::jthread, 2> threads;  // last, so that they end first, also where the second cannot be made
};

}  // namespace seamwire
