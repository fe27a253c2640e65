// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/geodesics/exact_geodesics.hpp"

#include <string>
#include <utility>

#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/wavefront.hpp"

namespace seamwire {

ExactGeodesics::ExactGeodesics(const IntrinsicMesh& mesh) : mesh_(std::make_shared<const GeodesicMesh>(mesh)) {}

DistanceField ExactGeodesics::solve(std::int32_t seed, const Task& task, GeodesicCounters* counters) const {
  return run(seed, 0, task, counters);
}

DistanceField ExactGeodesics::solve_bounded(std::int32_t seed, std::uint32_t windows, const Task& task,
                                            GeodesicCounters* counters) const {
  if (windows == 0) throw InvalidInput("windows must be at least 1");
  return run(seed, windows, task, counters);
}

DistanceField ExactGeodesics::run(std::int32_t seed, std::uint32_t windows, const Task& task,
                                  GeodesicCounters* counters) const {
  const std::size_t vertex_count = mesh_->vertex_count();
  if (seed < 0 || static_cast<std::size_t>(seed) >= vertex_count) {
    throw InvalidInput("seed " + std::to_string(seed) + " is out of range, there are " + std::to_string(vertex_count) +
                       " vertices");
  }
  WavefrontResult result = propagate_wavefront(*mesh_, mesh_->own_vertex(seed), task, windows);
  if (counters != nullptr) *counters = result.counters;
  std::vector<double> distances(vertex_count);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    distances[static_cast<std::size_t>(mesh_->original_vertex(static_cast<std::int32_t>(v)))] = result.distances[v];
  }
  return {mesh_, seed, std::move(distances), std::move(result.records), windows == 0};
}

}  // namespace seamwire
