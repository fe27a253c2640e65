// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>

#include "live/candidates.hpp"
#include "live/mailbox.hpp"
#include "live/prepared_metrics.hpp"
#include "live/right_of_way.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Settings of wires in every metric.
struct LiveSettings {
  Along along;
  double turning;
  std::optional<double> loop_turning;
  double max_error;  ///< 0: wires are not refined
};

/// What wires are asked for.
struct SeedRequest {
  std::shared_ptr<MetricSet> metrics;
  std::stop_source preparing;   ///< stops the preparation of the metric; requests with the same metric share it
  std::optional<WireEnd> seed;  ///< nullopt: only the metric is prepared
  bool is_forward = false;      ///< as EdgeWires has it
};

/// A wire to one target: a preview, computed before there is a field, or a refined wire.
struct TargetWire {
  std::int64_t seed_number;  ///< of the seed's request
  WireEnd target;
  LiveCandidate candidate;
  double first_length;      ///< of the wire in the embedding of the whole surface
  bool is_refined = false;  ///< nothing will change it
};

using SeedBox = Mailbox<SeedRequest, SeedSolution>;
using TargetBox = Mailbox<WireEnd, TargetWire>;

/// Prepares one of the metrics and finds the wires from a seed in it. Used by one thread, but for progress().
class SeedSolver {
 public:
  /// `metric`: its number. Previews lead to the newest of `targets`, which gets them. The solver waits for
  /// `right_of_way` if there are too few processors.
  SeedSolver(std::size_t metric, const SurfaceContext& context, const LiveSettings& settings,
             std::shared_ptr<RightOfWay> right_of_way, TargetBox& targets);

  /// The solution of a job, shown in `seeds` before if it grows. `former`: the solution of the same seed in the former
  /// metric. Null if there is no seed, no such metric, or the seed is not part of the surface.
  std::shared_ptr<const SeedSolution> solve(const SeedBox::Job& job, const std::shared_ptr<const SeedSolution>& former,
                                            SeedBox& seeds);
  /// The wire of a solution to a target, refined in its corridor if `is_refined`. `show`, if set, gets the unrefined
  /// wire first. `target`: without a face or vertex in the embedding, there is no wire. Throws Cancelled.
  TargetWire refine(const SeedBox::Reading& found, const WireEnd& target, bool is_refined,
                    const std::function<void(TargetWire)>& show, const std::stop_token& stop) const;
  /// Fraction of a request's work, preparation included, that is done, as far as it is the request being worked on.
  double progress(const SeedRequest& request) const;

 private:
  std::shared_ptr<const SeedSolution> find_field(const SeedBox::Job& job,
                                                 const std::shared_ptr<const Prepared>& prepared, Task task);
  std::shared_ptr<const SeedSolution> find_chains(const SeedBox::Job& job,
                                                  const std::shared_ptr<const Prepared>& prepared, const Task& task,
                                                  SeedBox& seeds);
  void make_way(const std::stop_token& stop, const std::function<void()>& meanwhile);
  struct Nearby;
  void make_nearby_preview(const SeedBox& seeds, const Prepared& prepared, const std::shared_ptr<const Metric>& metric,
                           const std::stop_token& stop, Nearby& nearby);
  void make_preview(const SeedBox::Job& job, const Prepared& prepared, CorridorPaths& paths, std::int64_t& answered);
  void show_preview(std::int64_t target_number, std::int64_t seed_number, const WireEnd& target,
                    LiveCandidate candidate);

  const std::size_t metric_;
  const SurfaceContext context_;
  const LiveSettings settings_;
  const bool makes_way_;
  const std::shared_ptr<RightOfWay> right_of_way_;
  TargetBox& targets_;
  std::atomic<double> fraction_ = 0.0;      // of what is done once the metric is prepared
  std::atomic<bool> was_prepared_ = false;  // when the last job began
};

}  // namespace seamwire::detail
