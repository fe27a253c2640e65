// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "live/prepared_metrics.hpp"
#include "seamwire/live/livewire.hpp"
#include "seamwire/metric/curvature.hpp"
#include "seamwire/task.hpp"
#include "seamwire/wires/wire.hpp"

namespace seamwire {

/// A wire between two seeds, the shorter one of the two metrics.
struct CandidateWire {
  Follow follow = Follow::kMin;
  std::vector<std::int32_t> vertices;  ///< the chain of edges that it marks; empty: there is no wire
  std::vector<Vector> points;          ///< its curve
  std::vector<std::int32_t> faces;     ///< as Wire has them; none of one along edges
  /// Its Euclidean length over that in its metric: 1 where it follows nothing, more along features.
  double strength = 1.0;
};

/// Finds the wires that LiveWire shows, many at once.
class CandidateWires {
 public:
  /// Prepares both metrics, on two threads. Throws as SeamPlanner does.
  CandidateWires(std::shared_ptr<const Surface> surface, Along along, const Strength& strength, const Task& task);

  const Surface& surface() const { return surfaces_->surface(); }
  Along along() const { return along_; }
  const Curvature& curvature() const { return curvatures_->curvature; }
  /// s of eq. 5.
  const std::vector<double>& feature_strength() const { return curvatures_->difference; }

  /// One end that wires begin at, and the others.
  struct Fan {
    std::int32_t from;
    std::vector<std::int32_t> to;
  };
  /// kExact: wires are the shortest ones. kQuick: across the surface they are nearly always, and found in a third of
  /// the time, see CorridorPaths.
  enum class Effort : std::uint8_t { kExact, kQuick };
  /// For each fan its wires, in order. On several threads.
  std::vector<std::vector<CandidateWire>> find(std::span<const Fan> fans, const Task& task,
                                               Effort effort = Effort::kExact) const;

 private:
  /// A wire in one metric, with its length there.
  struct Found {
    std::vector<std::int32_t> vertices;
    std::vector<Vector> points;
    std::vector<std::int32_t> faces;
    double length, euclidean;
  };
  std::vector<Found> find_in(const Prepared& metric, const Fan& fan, Effort effort, const Task& task) const;
  Found found(const Prepared& metric, Wire wire, const Task& task) const;
  std::vector<Found> find_quickly(const Prepared& metric, const Fan& fan, const Task& task) const;
  std::vector<Found> find_on_surface(const Prepared& metric, const Fan& fan, const Task& task) const;
  std::vector<Found> find_along_edges(const Prepared& metric, const Fan& fan, const Task& task) const;

  Along along_;
  std::unique_ptr<SurfaceCache> surfaces_;
  std::shared_ptr<const CurvatureCache> curvatures_;
  std::array<Prepared, 2> metrics_;
};

}  // namespace seamwire
