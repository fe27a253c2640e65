// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "live/prepared_metrics.hpp"
#include "live/wire_end.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/geodesics/distance_field.hpp"
#include "seamwire/live/livewire.hpp"
#include "seamwire/task.hpp"
#include "seamwire/wires/wire.hpp"

namespace seamwire::detail {

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
LiveCandidate snapped_candidate(const Prepared& prepared, Wire wire, const Task& task = {});

/// The same for a wire from a seed to a target, whose nearest vertices it is to begin and end at.
LiveCandidate candidate_between(const Prepared& prepared, Wire wire, const WireEnd& seed, const WireEnd& target,
                                const Task& task = {});

/// The wire of a field to a target; without points if no wire leads there. Throws Cancelled.
Wire wire_of(const SeedSolution& solution, const WireEnd& target, const Task& task = {});

/// The candidate of a solution to a target; without points if no wire leads there. It is not marked as final.
LiveCandidate candidate_of(const SeedSolution& solution, const WireEnd& target);

}  // namespace seamwire::detail
