// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <variant>

#include "detail/deadline.hpp"
#include "detail/infinity.hpp"
#include "live/candidates.hpp"
#include "live/closed_cut_search.hpp"
#include "live/mailbox.hpp"
#include "live/prepared_metrics.hpp"
#include "live/right_of_way.hpp"
#include "live/seed_solver.hpp"

namespace seamwire::detail {

/// The place that a closed wire leads through: an edge (along edges), or one or two points (across the surface).
using LoopPlace = std::variant<Edge, WireEnd, BendPlace>;
/// The closed wires: along edges one chain, across the surface cuts.
using LoopAnswer = std::variant<EdgeChain, LiveClosedWires>;

/// One of the threads behind a LiveWire, for one of its metrics. It builds the surface if nobody does yet, prepares the
/// metric, then answers the newest seed, refines the wire to the newest target, and answers the newest loop. On a
/// large surface, a second thread traces the former metric's wires meanwhile. No member waits for the threads but
/// wait_until_idle() and the destructor.
class LiveWorker {
 public:
  /// `which`: the metric's number. If there is no such metric, there is nothing to do. `right_of_way`: shared by all
  /// workers of a live wire; the thread of the first metric has it.
  LiveWorker(std::size_t which, const SurfaceContext& context, std::shared_ptr<MetricSet> metrics,
             const LiveSettings& settings, std::shared_ptr<RightOfWay> right_of_way);
  /// Waits until the threads have ended.
  ~LiveWorker();
  LiveWorker(const LiveWorker&) = delete;
  LiveWorker& operator=(const LiveWorker&) = delete;

  /// Tells the threads to end.
  void request_stop();

  /// Keeps the solution, as that of the former metric, until the same seed has one in this metric. Forgets the loop.
  void change_metric(std::shared_ptr<MetricSet> metrics);
  /// Drops the solution of the former seed. The caller has checked the seed; an edge only if there is a surface.
  void seed(const WireEnd& seed, bool forward);

  /// The current knowledge of a wire.
  struct Known {
    std::optional<LiveCandidate> candidate;  ///< nullopt: nothing yet
    double first_length = kInfinity;         ///< of the wire before it is refined
  };
  /// The wire from the newest seed to a target. The thread works on this target from now on: previews lead to it until
  /// there is a field, and then its wire is refined. Along edges, needs the surface to be built.
  Known wire(const WireEnd& target);

  /// Along edges searches the loop through an edge, `edge[0] < edge[1]`, across the surface the closed wires through a
  /// point, or one of them bent to a second point. Does nothing if that was searched for last. If only the second point
  /// differs, the work on the cut goes on.
  void find_loop(const LoopPlace& through);
  /// What find_loop() found along edges; nullopt until then, or if another loop was searched for since.
  std::optional<EdgeChain> loop(const Edge& through) const;
  /// The same across the surface; empty and not final until then.
  LiveClosedWires closed_wires(const LoopPlace& through) const;

  /// Fraction of the newest seed's work, preparation included, that is done.
  double progress() const;
  /// Why the newest seed, metric or target failed; null if they did not.
  std::exception_ptr error() const;
  /// The same, or why the newest loop failed.
  std::exception_ptr loop_error() const;
  /// Whether it has answered all requests.
  bool wait_until_idle(const Deadline& deadline) const;

 private:
  using LoopBox = Mailbox<LoopPlace, LoopAnswer>;
  /// A wire of a solution to a target.
  struct TraceRequest {
    std::shared_ptr<const SeedSolution> solution;
    WireEnd target;

    friend bool operator==(const TraceRequest&, const TraceRequest&) = default;
  };
  using TraceBox = Mailbox<TraceRequest, LiveCandidate>;

  void run();
  void run_tracer();
  std::optional<LiveCandidate> traced(const std::shared_ptr<const SeedSolution>& solution, const WireEnd& target);
  bool work();
  void work_on(const SeedBox::Job& job);
  void work_on(const TargetBox::Job& job);
  void work_on(const LoopBox::Job& job);
  LoopAnswer find_closed(const LoopBox::Job& job);
  EdgeChain find_cycle(const Edge& edge, const std::stop_token& stop) const;
  void tell_right_of_way();
  bool refines() const;
  bool works_on_targets() const;
  bool is_wire_finished() const { return (targets_.is_finished() || !works_on_targets()) && traces_.is_finished(); }
  bool is_idle() const { return seeds_.is_finished() && is_wire_finished() && loops_.is_finished(); }

  const std::size_t which_;
  const SurfaceContext context_;
  const LiveSettings settings_;
  const bool is_large_;  // tracing a wire and snapping it to edges takes longer than a caller can wait
  const std::shared_ptr<RightOfWay> right_of_way_;
  std::stop_source quit_;  // its state guards itself

  EventCount events_;  // in the boxes, with what is to be freed
  SeedBox seeds_{events_};
  TargetBox targets_{events_};
  LoopBox loops_{events_};
  TraceBox traces_{events_};
  SeedSolver solver_;
  std::optional<ClosedCutSearch> closed_cuts_;  // the thread's own; in the metrics of the newest seed

  std::once_flag begin_tracing_;
  std::optional<std::jthread> tracer_;  // begins with the first request
  std::jthread thread_;                 // last, so that all else is there when it begins
};

}  // namespace seamwire::detail
