// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "detail/thread_safety.hpp"
#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/context/surface_context.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/task.hpp"
#include "seamwire_uv/seams/seam_planner.hpp"

namespace seamwire::detail {

/// Finds the wires across the surface that LiveWire shows, many at once.
///
/// Plans that follow each other have most of their wires in common. So the wires that were found last are kept, with
/// at most as many points as the surface has vertices. Several threads may call the methods at once.
class CandidateWires {
 public:
  /// Prepares both metrics, on two threads. Throws as SeamPlanner does.
  CandidateWires(const SurfaceContext& context, const Strength& strength, const Task& task);

  /// Two seeds: vertices of the surface.
  struct Ends {
    std::int32_t from, to;
    auto operator<=>(const Ends&) const = default;
  };

  /// The wire between each two seeds, the shorter one of the two metrics. It has no vertices if no wire exists. Nearly
  /// always it is the shortest one, see CorridorPaths. On several threads.
  std::vector<PlannedWire> find(std::span<const Ends> ends, const Task& task) const;

  /// How many points the kept wires have.
  std::size_t kept_points() const;

 private:
  /// A wire in one metric, with its length there.
  struct Found {
    PlannedWire wire;
    double length;
  };

  Found find_in(std::size_t metric, const Ends& ends, const Task& task) const;
  void keep(const Ends& ends, const PlannedWire& wire) const SEAMWIRE_REQUIRES(mutex_);

  SurfaceContext context_;
  std::array<std::optional<EmbeddedSurface>, 2> metrics_;  // M_min, M_max
  std::size_t most_points_ = 0;                            // of all wires that are kept
  mutable Mutex mutex_;
  mutable std::map<Ends, PlannedWire> kept_ SEAMWIRE_GUARDED_BY(mutex_);
  mutable std::size_t kept_points_ SEAMWIRE_GUARDED_BY(mutex_) = 0;
};

}  // namespace seamwire::detail
