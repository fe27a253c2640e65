// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <stop_token>
#include <thread>
#include <variant>
#include <vector>

#include "detail/thread_safety.hpp"
#include "live/deadline.hpp"
#include "live/prepared_metrics.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"
#include "seamwire/wires/bent_wires.hpp"
#include "seamwire/wires/closed_wires.hpp"

namespace seamwire::detail {

/// In either direction.
bool has_edge(const Surface& surface, const Edge& edge);

/// Where wires begin, or what they lead to: across the surface a vertex or another point, along edges a pick.
using WireEnd = std::variant<Pick, SurfacePoint>;

/// A closed wire through a point, by LiveClosedWire::which, and where it is bent to.
struct BendPlace {
  WireEnd through, second;
  std::size_t which;

  bool operator==(const BendPlace&) const = default;
};

/// What closed wires lead through: along edges an edge, across the surface a vertex or another point, or two of them.
using LoopPlace = std::variant<Edge, WireEnd, BendPlace>;

/// The wires of one metric from one seed: across the surface a field, along edges chains, which may still be at work.
/// Neither: no wires begin there.
struct SeedSolution {
  std::shared_ptr<const Prepared> prepared;
  std::optional<DistanceField> field;
  std::optional<EdgeWires> wires;

  bool is_final(const WireEnd& target) const { return !wires || wires->is_final(std::get<Pick>(target)); }
};

/// Lets the threads of a live wire make way for the one whose wire is offered first, where there are fewer processors
/// than threads.
class RightOfWay {
 public:
  /// Whether that thread has something to do.
  void set_busy(bool is_busy) {
    const MutexLock lock(mutex_);
    is_busy_ = is_busy;
    changed_.notify_all();
  }
  /// Waits until it has not, or `stop` is requested.
  void wait(const std::stop_token& stop) {
    MutexLock lock(mutex_);
    changed_.wait(lock, stop, [this]() SEAMWIRE_REQUIRES(mutex_) { return !is_busy_; });
  }

 private:
  Mutex mutex_;
  std::condition_variable_any changed_;
  bool is_busy_ SEAMWIRE_GUARDED_BY(mutex_) = false;
};

/// How wires run, whatever the metric.
struct LiveSettings {
  Along along;
  double turning;
  std::optional<double> loop_turning;
};

/// One of the threads behind a LiveWire, for one of the metrics. It builds the surface where nobody does yet,
/// prepares the metric, then answers the newest seed and after it the newest loop; what it is at is stopped where it is
/// no longer wanted. None of the members waits for that but wait_until_idle() and the destructor.
///
/// Freeing what belongs to a seed or a metric takes long. So that the caller does not do it, nor wait for the mutex
/// while the thread does it, such memory is handed over to dropped_, from which the thread frees it without the mutex.
class LiveWorker {
 public:
  /// `right_of_way`: shared by all workers of a live wire.
  LiveWorker(std::size_t which, std::shared_ptr<SurfaceCache> surface_cache, std::shared_ptr<MetricSet> metrics,
             const LiveSettings& settings, std::shared_ptr<RightOfWay> right_of_way);
  /// Waits until the thread has ended.
  ~LiveWorker();
  LiveWorker(const LiveWorker&) = delete;
  LiveWorker& operator=(const LiveWorker&) = delete;

  /// Tells the thread to end.
  void request_stop();

  /// The solution stays, as that of a former metric, until the same seed has one in this metric. The loop is forgotten.
  void change_metric(std::shared_ptr<MetricSet> metrics);
  /// Drops the solution of the former seed. The seed was checked, an edge where there is a surface.
  void seed(const WireEnd& seed, bool forward);

  /// What is there of the wires now.
  struct Snapshot {
    std::shared_ptr<const SeedSolution> solution;  ///< null: none yet
    bool is_newest = false;                        ///< it is of the newest seed and metric
    /// Of the newest seed and metric, to the target, where a solution is not.
    std::shared_ptr<const LiveCandidate> preview;
  };
  /// `target` is where a preview leads to from now on. The solution has to be given back by release().
  Snapshot snapshot(const WireEnd& target);
  void release(std::shared_ptr<const SeedSolution> solution);
  /// The wire from a seed to a target.
  LiveCandidate candidate(const SeedSolution& solution, const WireEnd& seed, const WireEnd& target) const;

  /// Along edges searches the loop through an edge, `edge[0] < edge[1]`, across the surface the closed wires through a
  /// point, or one of them bent to a second point, unless that is what was searched for last. Where the second point
  /// alone is another one, what is under way for the cut goes on.
  void find_loop(const LoopPlace& through);
  /// Along edges; nullopt until it is found.
  std::optional<EdgeChain> loop() const;
  /// Across the surface.
  LiveClosedWires closed_wires() const;

  /// Fraction of the newest seed's work, preparation included, that is done.
  double progress() const;
  /// Why the newest seed or metric failed; null where they did not.
  std::exception_ptr error() const;
  /// The same, or why the newest loop failed.
  std::exception_ptr loop_error() const;
  /// Whether it has answered all requests, or will answer none for want of a surface.
  bool wait_until_idle(const Deadline& deadline) const;

 private:
  struct SeedJob {
    std::int64_t request;
    std::shared_ptr<MetricSet> metrics;
    std::optional<WireEnd> seed;
    bool is_forward;
    std::shared_ptr<const SeedSolution> before;
    std::stop_token preparing, solving;
  };
  struct LoopJob {
    std::int64_t request;
    LoopPlace through;
    std::shared_ptr<MetricSet> metrics;
    std::shared_ptr<const Prepared> prepared;  // the thread's own metric; null: that failed
    std::stop_token solving;
  };
  using Dropped = std::vector<std::shared_ptr<const void>>;
  using Job = std::variant<Dropped, SeedJob, LoopJob>;

  /// The closed wires through a point in one metric.
  struct ClosedIn {
    std::shared_ptr<const Prepared> prepared;
    DistanceField field;
    std::vector<ClosedWire> cuts;
  };
  /// The closed wires through a point, as far as they were asked for, and what bends one of them.
  struct ClosedAround {
    WireEnd through;
    std::array<std::optional<ClosedIn>, kMostMetrics> in = {};
    std::size_t which = 0;
    std::optional<BentWires> bent = std::nullopt;  // of that one
  };

  /// A wire to one target, computed before there is a field.
  struct Preview {
    std::int64_t request;
    WireEnd target;
    LiveCandidate candidate;
  };

  void run();
  bool build_surface();
  std::optional<Job> next_job();
  void work_on(SeedJob job);
  void work_on(const LoopJob& job);
  LiveClosedWires find_closed_wires(const LoopJob& job, const WireEnd& through);
  LiveClosedWires find_bent_wire(const LoopJob& job, const BendPlace& place);
  std::shared_ptr<const Prepared> prepared_for(const LoopJob& job, std::size_t metric);
  const ClosedIn* closed_in(const LoopJob& job, const WireEnd& through, std::size_t metric);
  LiveClosedWire closed_wire(const LoopJob& job, const WireEnd& through, const ClosedWire& cut,
                             const ClosedWireChoice& choice) const;
  void show(const LoopJob& job, LiveClosedWires found);
  void add_pieces(const LoopJob& job, const Prepared& prepared, std::size_t metric, const Wire& wire, std::size_t count,
                  LiveClosedWire& closed) const;
  std::shared_ptr<const SeedSolution> solve(const SeedJob& job);
  std::shared_ptr<const SeedSolution> find_field(const SeedJob& job, const std::shared_ptr<const Prepared>& prepared,
                                                 Task task);
  std::shared_ptr<const SeedSolution> find_chains(const SeedJob& job, const std::shared_ptr<const Prepared>& prepared,
                                                  const Task& task);
  void make_way(const std::stop_token& stop);
  void make_preview(const SeedJob& job, const Prepared& prepared, CorridorPaths& paths, std::int64_t& answered);
  LiveCandidate snapped(const Prepared& prepared, std::size_t metric, Wire wire, const Task& task = {}) const;
  LiveCandidate candidate_of(const Prepared& prepared, Wire wire, const WireEnd& seed, const WireEnd& target) const;
  const Surface& surface() const { return surface_cache_->surface(); }

  bool has_job() const SEAMWIRE_REQUIRES(mutex_) {
    return handled_ != request_ || loop_handled_ != loop_request_ || !dropped_.empty();
  }
  /// Whether the metric is one of the family's.
  bool has_metric() const SEAMWIRE_REQUIRES(mutex_) { return which_ < metrics_->count; }
  /// To be called where request_ or handled_ was changed.
  void tell_right_of_way() SEAMWIRE_REQUIRES(mutex_) {
    if (is_third_) right_of_way_->set_busy(has_metric() && handled_ != request_ && !quit_.stop_requested());
  }
  bool is_idle() const SEAMWIRE_REQUIRES(mutex_) {
    return has_failed_ || (handled_ == request_ && loop_handled_ == loop_request_);
  }

  const std::size_t which_;  // of kFollow; where the family has no such metric, there is nothing to do
  const std::shared_ptr<SurfaceCache> surface_cache_;
  const LiveSettings settings_;
  const bool is_third_;  // it has the right of way where the family has its metric
  const bool makes_way_;
  const std::shared_ptr<RightOfWay> right_of_way_;
  std::stop_source quit_;                  // its state guards itself
  std::optional<ClosedAround> around_;     // the thread's own: of the point asked for last
  std::atomic<double> fraction_ = 0.0;     // of what the thread does for the newest seed once the metric is prepared
  std::atomic<std::int64_t> targets_ = 0;  // how often target_ has become another one; grows with the mutex held

  mutable Mutex mutex_;
  mutable std::condition_variable_any changed_;  // what is asked for, and what has been answered

  // What is asked for.
  std::shared_ptr<MetricSet> metrics_ SEAMWIRE_GUARDED_BY(mutex_);
  std::int64_t request_ SEAMWIRE_GUARDED_BY(mutex_) = 0;  // grows with each seed and each change of the metric
  std::optional<WireEnd> seed_ SEAMWIRE_GUARDED_BY(mutex_);
  bool is_forward_ SEAMWIRE_GUARDED_BY(mutex_) = false;
  std::optional<WireEnd> target_ SEAMWIRE_GUARDED_BY(mutex_);  // of the preview
  std::int64_t loop_request_ SEAMWIRE_GUARDED_BY(mutex_) = 0;
  LoopPlace loop_through_ SEAMWIRE_GUARDED_BY(mutex_) = Edge{-1, -1};
  std::stop_source preparing_ SEAMWIRE_GUARDED_BY(mutex_);  // of the running job
  std::stop_source solving_ SEAMWIRE_GUARDED_BY(mutex_);

  // What has been answered.
  std::int64_t handled_ SEAMWIRE_GUARDED_BY(mutex_) = -1;  // the request that was answered, or failed, last
  std::shared_ptr<const SeedSolution> solution_ SEAMWIRE_GUARDED_BY(mutex_);
  std::int64_t solution_for_ SEAMWIRE_GUARDED_BY(mutex_) = -1;  // the request that solution_ answers
  std::shared_ptr<const Preview> preview_ SEAMWIRE_GUARDED_BY(mutex_);
  std::exception_ptr error_ SEAMWIRE_GUARDED_BY(mutex_);
  std::exception_ptr loop_error_ SEAMWIRE_GUARDED_BY(mutex_);
  std::int64_t loop_handled_ SEAMWIRE_GUARDED_BY(mutex_) = 0;
  EdgeChain loop_ SEAMWIRE_GUARDED_BY(mutex_);
  LiveClosedWires closed_wires_ SEAMWIRE_GUARDED_BY(mutex_);
  std::int64_t closed_wires_for_ SEAMWIRE_GUARDED_BY(mutex_) = -1;  // the loop request that they answer, final or not
  bool has_failed_ SEAMWIRE_GUARDED_BY(mutex_) = false;             // there is no surface
  bool is_at_loop_ SEAMWIRE_GUARDED_BY(mutex_) = false;             // the running job is one
  bool was_prepared_ SEAMWIRE_GUARDED_BY(mutex_) = false;           // when the last SeedJob began
  Dropped dropped_ SEAMWIRE_GUARDED_BY(mutex_);

  std::jthread thread_;  // last, so that all else is there when it begins
};

}  // namespace seamwire::detail
