// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "live/candidates.hpp"
#include "live/prepared_metrics.hpp"
#include "seamwire/live/livewire.hpp"
#include "seamwire/wires/bent_wires.hpp"
#include "seamwire/wires/closed_wires.hpp"

namespace seamwire::detail {

/// A closed wire through a point, and where it is bent to.
struct BendPlace {
  WireEnd through, second;
  ClosedCutId cut;

  bool operator==(const BendPlace&) const = default;
};

/// Finds the closed wires through a point in the metrics of a live wire, and bends them. Keeps what it found for one
/// point, so that the next question about it is answered at once. For one thread at a time. It starts no threads.
class ClosedCutSearch {
 public:
  using Show = std::function<void(LiveClosedWires)>;

  /// Uses the metrics that are prepared, and prepares the others.
  ClosedCutSearch(const SurfaceContext& context, std::shared_ptr<MetricSet> metrics);

  /// The closed wires through a point; final, unless it is given to `show`, which gets what is known meanwhile. Throws
  /// Cancelled, and why a metric cannot be prepared.
  LiveClosedWires through(const WireEnd& point, const std::stop_token& stop, const Show& show);
  /// One of these wires bent to a second point; none if it does not lead there. Throws as through().
  LiveClosedWires bent(const BendPlace& place, const std::stop_token& stop);

 private:
  /// The closed wires through a point in one metric.
  struct InMetric {
    std::shared_ptr<const Prepared> prepared;
    DistanceField field;
    std::vector<ClosedWire> cuts;
  };
  /// The closed wires through a point, as far as they were requested, and the object that bends one of them.
  struct Around {
    WireEnd through;
    std::vector<std::optional<InMetric>> in;  // of the metrics
    ClosedCutId bent_cut = {};
    std::optional<BentWires> bent = std::nullopt;  // of that cut
  };
  using Cuts = std::vector<std::vector<ClosedWire>>;  // of each metric

  std::shared_ptr<const Prepared> prepared(std::size_t metric, const std::stop_token& stop);
  const InMetric* in_metric(const WireEnd& point, std::size_t metric, const std::stop_token& stop);
  LiveClosedWires choose(const WireEnd& point, const Cuts& cuts, const std::stop_token& stop);
  LiveClosedWire in_pieces(const WireEnd& point, const ClosedWire& cut, const ClosedCutId& id,
                           const std::stop_token& stop);
  LiveClosedWire in_pieces(const BendPlace& place, const ClosedWire& cut, BentWire bent, const std::stop_token& stop);
  void add_pieces(std::size_t metric, const Wire& wire, std::size_t count, const std::stop_token& stop,
                  LiveClosedWire& closed);
  const std::vector<std::size_t>& closing() const { return metrics_->metrics.cuts; }

  SurfaceContext context_;
  std::shared_ptr<MetricSet> metrics_;
  std::optional<Around> around_;  // the point asked for last
};

}  // namespace seamwire::detail
