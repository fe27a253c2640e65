// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/candidates.hpp"

#include <utility>
#include <variant>

#include "seamwire/wires/snap.hpp"

namespace seamwire::detail {

LiveCandidate snapped_candidate(const Prepared& prepared, Wire wire, const Task& task) {
  LiveCandidate candidate;
  candidate.metric = prepared.spec;
  candidate.vertices = snap_to_edges(*prepared.surface, wire, task);
  candidate.length = wire.length;
  candidate.points = std::move(wire.points);
  candidate.faces = std::move(wire.faces);
  return candidate;
}

LiveCandidate candidate_between(const Prepared& prepared, Wire wire, const WireEnd& seed, const WireEnd& target,
                                const Task& task) {
  wire.from = nearest_vertex(*prepared.surface, seed);
  wire.to = nearest_vertex(*prepared.surface, target);
  return snapped_candidate(prepared, std::move(wire), task);
}

std::optional<Wire> wire_of(const SeedSolution& solution, const WireEnd& target, const Task& task) {
  if (!solution.field) return std::nullopt;
  const EmbeddedSurface& on = *solution.prepared->embedded;
  const std::optional<SurfacePoint> to = on.points().find(point_of(target), "target");
  return to ? trace_wire(on.surface(), on.embedding(), *solution.field, *to, task) : std::nullopt;
}

LiveCandidate candidate_of(const SeedSolution& solution, const WireEnd& target, const Task& task) {
  const Prepared& prepared = *solution.prepared;
  LiveCandidate candidate;
  candidate.metric = prepared.spec;
  if (solution.field) {
    std::optional<Wire> wire = wire_of(solution, target, task);
    return wire ? candidate_between(prepared, std::move(*wire), solution.seed, target, task) : candidate;
  }
  if (!solution.wires) return candidate;
  std::optional<EdgeChain> chain = solution.wires->trace(std::get<Pick>(target));
  if (!chain) return candidate;
  candidate.length = chain->length;
  candidate.vertices = std::move(chain->vertices);
  candidate.points.reserve(candidate.vertices.size());
  for (const std::int32_t v : candidate.vertices) candidate.points.push_back(prepared.surface->points()[v]);
  return candidate;
}

}  // namespace seamwire::detail
