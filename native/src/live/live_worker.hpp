// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
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

struct LiveWire::Impl {
  /// What one worker is at. Numbers of requests are those of Impl.
  struct Worker {
    std::shared_ptr<const Solved> solved;  // of the newest seed; of a former metric where solved_for is not `request`
    std::int64_t solved_for = -1;
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

  Impl(std::shared_ptr<Ground> on, std::shared_ptr<Metrics> by, const LiveWireOptions& with);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  const Surface& surface() const { return *ground->surface; }
  void work(std::size_t which, const std::stop_token& quit);
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
  mutable std::condition_variable_any changed;
  std::shared_ptr<Metrics> metrics;
  std::int64_t request = 0;  // grows with each seed and each change of the metric
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
