// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/candidates.hpp"

#include <utility>
#include <variant>

namespace seamwire::detail {

LiveCandidate snapped_candidate(const Surface& surface, const Prepared& prepared, std::size_t metric, Wire wire,
                                const Task& task) {
  LiveCandidate candidate;
  candidate.follow = kFollow[metric];
  candidate.vertices = snap_to_edges(surface, *prepared.snap_graph, wire, task);
  candidate.length = wire.length;
  candidate.points = std::move(wire.points);
  candidate.faces = std::move(wire.faces);
  return candidate;
}

LiveCandidate candidate_between(const Surface& surface, const Prepared& prepared, std::size_t metric, Wire wire,
                                const WireEnd& seed, const WireEnd& target) {
  wire.from = nearest_vertex(surface, seed);
  wire.to = nearest_vertex(surface, target);
  return snapped_candidate(surface, prepared, metric, std::move(wire));
}

LiveCandidate candidate_of(const Surface& surface, const SeedSolution& solution, std::size_t metric,
                           const WireEnd& seed, const WireEnd& target) {
  LiveCandidate candidate;
  candidate.follow = kFollow[metric];
  if (solution.field) {
    const Prepared& prepared = *solution.prepared;
    const std::optional<SurfacePoint> to = prepared.points->find(point_of(target), "target");
    if (!to) return candidate;
    Wire wire = trace_wire(surface, *prepared.embedding, *solution.field, *to);
    return candidate_between(surface, prepared, metric, std::move(wire), seed, target);
  }
  if (!solution.wires) return candidate;
  EdgeChain chain = solution.wires->trace(std::get<Pick>(target));
  candidate.length = chain.length;
  candidate.vertices = std::move(chain.vertices);
  candidate.points.reserve(candidate.vertices.size());
  for (const std::int32_t v : candidate.vertices) candidate.points.push_back(surface.points()[v]);
  return candidate;
}

}  // namespace seamwire::detail
