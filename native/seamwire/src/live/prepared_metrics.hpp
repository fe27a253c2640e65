// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "detail/computed_once.hpp"
#include "detail/thread_safety.hpp"
#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/context/surface_context.hpp"
#include "seamwire/edges/edge_graph.hpp"
#include "seamwire/live/livewire.hpp"

/// The parts that a live wire computes before the first seed. Each is computed once, when it is first needed.
namespace seamwire::detail {

/// Fractions of the first seed's work, preparation included, at which its parts begin.
inline constexpr double kEmbedBegins = 0.1, kSolveBegins = 0.5;

/// The data that one metric needs for any seed: `graph` along edges, `embedded` across the surface.
struct Prepared {
  MetricSpec spec;
  std::shared_ptr<const Surface> surface;
  std::optional<EmbeddedSurface> embedded;
  std::shared_ptr<const EdgeGraph> graph;
};

/// The metrics of a live wire, after the scribbles. Shared by forks.
class MetricSet {
 public:
  MetricSet(LiveMetrics of, std::vector<Scribble> after);
  /// The same in place of `former`: a metric that is in both, and for which the scribbles are the same, is shared. If
  /// it has another number than in `former`, it is shared only if it is prepared. Otherwise two threads could wait for
  /// each other.
  ///
  /// Embeddings of a metric with other scribbles are made from those of `former`, or, where these are not there yet,
  /// from what they would have been made from: scribbles change little.
  MetricSet(LiveMetrics of, std::vector<Scribble> after, const MetricSet& former);

  std::size_t count() const { return metrics.wires.size(); }
  /// Whether the wire of the first metric is offered first, whichever is shorter.
  bool first_leads() const;
  /// The prepared data of a metric; null if it is not prepared, or does not exist.
  std::shared_ptr<const Prepared> peek(std::size_t metric) const;
  /// Fraction of a metric's preparation that is done; 0 if there is no such metric.
  double fraction(std::size_t metric) const;
  /// Whether both have the same metric of a number in common.
  bool shares(const MetricSet& other, std::size_t metric) const;

  std::shared_ptr<const Prepared> former(std::size_t metric) const;
  /// Once the metric is prepared.
  void forget_former(std::size_t metric);

  const LiveMetrics metrics;
  const std::vector<Scribble> scribbles;
  std::vector<std::shared_ptr<ComputedOnce<Prepared>>> prepared;
  std::vector<std::shared_ptr<std::atomic<double>>> fractions;  // of the preparation, shared as it is

 private:
  mutable Mutex mutex_;
  std::vector<std::shared_ptr<const Prepared>> former_ SEAMWIRE_GUARDED_BY(mutex_);
};

/// Functions that prepare() calls now and then, and that may take their time.
struct PreparationSteps {
  /// Lets another thread go first, and calls meanwhile() now and then until it returns. It is not called while the
  /// geodesics are built, which other live wires of the surface may find.
  std::function<void(const std::function<void()>&)> make_way = [](const auto&) {};
  /// Shows what can be seen before the metric is prepared. It receives the data so far, without `embedded`, and the
  /// metric that is being embedded from scratch.
  std::function<void(const Prepared&, const std::shared_ptr<const Metric>&)> preview = [](const auto&, const auto&) {};
};

/// Makes what one of the metrics needs; throws Cancelled where `stop` tells it to. The metric's fractions of
/// progress are told to `metrics`.
Prepared prepare(const SurfaceContext& context, Along along, MetricSet& metrics, std::size_t which,
                 const std::stop_token& stop, const PreparationSteps& steps = {});

}  // namespace seamwire::detail
