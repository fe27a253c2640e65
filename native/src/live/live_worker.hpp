// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <memory>
#include <optional>
#include <stop_token>
#include <thread>
#include <variant>

#include "live/candidates.hpp"
#include "live/closed_cut_search.hpp"
#include "live/deadline.hpp"
#include "live/discards.hpp"
#include "live/event_count.hpp"
#include "live/mailbox.hpp"
#include "live/prepared_metrics.hpp"
#include "live/right_of_way.hpp"
#include "live/seed_solver.hpp"
#include "live/wire_end.hpp"

namespace seamwire::detail {

/// What a closed wire leads through: along edges an edge, across the surface one point, or two.
using LoopPlace = std::variant<Edge, WireEnd, BendPlace>;
/// The closed wires: along edges one chain, across the surface cuts.
using LoopAnswer = std::variant<EdgeChain, LiveClosedWires>;

/// One of the threads behind a LiveWire, for one of its metrics. It builds the surface if nobody does yet, prepares the
/// metric, then answers the newest seed and after it the newest loop. No member waits for the thread but
/// wait_until_idle() and the destructor.
class LiveWorker {
 public:
  /// `which`: the metric's number in kFollow. If the family has no such metric, there is nothing to do.
  /// `right_of_way`: shared by all workers of a live wire.
  LiveWorker(std::size_t which, std::shared_ptr<SurfaceCache> surface_cache, std::shared_ptr<MetricSet> metrics,
             const LiveSettings& settings, std::shared_ptr<RightOfWay> right_of_way);
  /// Waits until the thread has ended.
  ~LiveWorker();
  LiveWorker(const LiveWorker&) = delete;
  LiveWorker& operator=(const LiveWorker&) = delete;

  /// Tells the thread to end.
  void request_stop();

  /// Keeps the solution, as that of the former metric, until the same seed has one in this metric. Forgets the loop.
  void change_metric(std::shared_ptr<MetricSet> metrics);
  /// Drops the solution of the former seed. The caller has checked the seed; an edge only if there is a surface.
  void seed(const WireEnd& seed, bool forward);

  /// What is known of the wires now.
  struct Snapshot {
    std::shared_ptr<const SeedSolution> solution;  ///< null: none yet
    bool is_newest = false;                        ///< whether it is of the newest seed and metric
    /// A wire to the target, of the newest seed and metric, as long as the solution is not.
    std::shared_ptr<const LiveCandidate> preview;
  };
  /// `target` is where a preview leads to from now on. The solution has to be given back by release().
  Snapshot snapshot(const WireEnd& target);
  void release(std::shared_ptr<const SeedSolution> solution) { seeds_.give_back(std::move(solution)); }
  /// The wire from a seed to a target.
  LiveCandidate candidate(const SeedSolution& solution, const WireEnd& seed, const WireEnd& target) const {
    return candidate_of(surface_cache_->surface(), solution, which_, seed, target);
  }

  /// Along edges searches the loop through an edge, `edge[0] < edge[1]`, across the surface the closed wires through a
  /// point, or one of them bent to a second point. Does nothing if that was searched for last. If only the second point
  /// differs, the work on the cut goes on.
  void find_loop(const LoopPlace& through);
  /// Along edges; nullopt until it is found.
  std::optional<EdgeChain> loop() const;
  /// Across the surface.
  LiveClosedWires closed_wires() const;

  /// Fraction of the newest seed's work, preparation included, that is done.
  double progress() const;
  /// Why the newest seed or metric failed; null if they did not.
  std::exception_ptr error() const { return seeds_.error(); }
  /// The same, or why the newest loop failed.
  std::exception_ptr loop_error() const;
  /// Whether it has answered all requests, or will answer none because there is no surface.
  bool wait_until_idle(const Deadline& deadline) const;

 private:
  using LoopBox = Mailbox<LoopPlace, LoopAnswer>;

  void run();
  bool build_surface();
  bool work();
  void work_on(const SeedBox::Job& job);
  void work_on(const LoopBox::Job& job);
  LoopAnswer find_closed(const LoopBox::Job& job);
  EdgeChain find_cycle(const Edge& edge, const std::stop_token& stop) const;
  void tell_right_of_way();
  bool is_idle() const { return has_failed_ || (seeds_.is_finished() && loops_.is_finished()); }

  const std::size_t which_;
  const std::shared_ptr<SurfaceCache> surface_cache_;
  const LiveSettings settings_;
  const bool has_right_of_way_;  // if the family has its metric
  const std::shared_ptr<RightOfWay> right_of_way_;
  Mutex right_of_way_mutex_;              // held while it is told
  std::stop_source quit_;                 // its state guards itself
  std::atomic<bool> has_failed_ = false;  // there is no surface

  EventCount events_;  // in the boxes and discards
  Discards discards_{events_};
  SeedBox seeds_{events_, discards_};
  TargetBox targets_{events_, discards_};
  LoopBox loops_{events_, discards_};
  SeedSolver solver_;
  std::optional<ClosedCutSearch> closed_cuts_;  // the thread's own; in the metrics of the newest seed

  std::jthread thread_;  // last, so that all else is there when it begins
};

}  // namespace seamwire::detail
