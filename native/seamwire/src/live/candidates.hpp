// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>

#include "live/prepared_metrics.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/geodesics/distance_field.hpp"
#include "seamwire/live/livewire.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/task.hpp"
#include "seamwire/wires/wire.hpp"

namespace seamwire::detail {

/// Where a live wire begins or ends: across the surface a vertex or another point, along edges a pick.
using WireEnd = std::variant<Pick, SurfacePoint>;

/// The point of an end across the surface.
inline SurfacePoint point_of(const WireEnd& end) {
  const auto* pick = std::get_if<Pick>(&end);
  return pick != nullptr ? SurfacePoint(pick->a) : std::get<SurfacePoint>(end);
}

/// A vertex itself; of another point the corner of its face with the largest barycentric coordinate.
inline std::int32_t nearest_vertex(const Surface& surface, const WireEnd& end) {
  const SurfacePoint point = point_of(end);
  if (point.vertex >= 0) return point.vertex;
  const auto most = std::ranges::max_element(point.barycentric) - point.barycentric.begin();
  return surface.triangles()[point.face][static_cast<std::size_t>(most)];
}

/// The wires of one metric from one seed: across the surface a field, along edges chains that may still grow. Has
/// neither if no wires begin at the seed.
struct SeedSolution {
  std::shared_ptr<const Prepared> prepared;
  WireEnd seed;
  std::optional<DistanceField> field;
  std::optional<EdgeWires> wires;

  bool is_final(const WireEnd& target) const { return !wires || wires->is_final(std::get<Pick>(target)); }
};

/// A wire across the surface as a candidate in a metric, with the chain of edges that it snaps to.
LiveCandidate snapped_candidate(const Prepared& prepared, Wire wire, const Task& task);

/// The same for a wire from a seed to a target, whose nearest vertices it is to begin and end at.
LiveCandidate candidate_between(const Prepared& prepared, Wire wire, const WireEnd& seed, const WireEnd& target,
                                const Task& task);

/// The wire of a field to a target; nullopt if no wire leads there. Throws Cancelled.
std::optional<Wire> wire_of(const SeedSolution& solution, const WireEnd& target, const Task& task);

/// The candidate of a solution to a target; without points if no wire leads there. It is not marked as final. Throws
/// Cancelled.
LiveCandidate candidate_of(const SeedSolution& solution, const WireEnd& target, const Task& task);

}  // namespace seamwire::detail
