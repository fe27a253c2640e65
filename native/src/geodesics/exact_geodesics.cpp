// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/geodesics/exact_geodesics.hpp"

#include <utility>

#include "detail/index.hpp"
#include "geodesics/distance_field.hpp"
#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/wavefront.hpp"

namespace seamwire {

ExactGeodesics::ExactGeodesics(const IntrinsicMesh& mesh, const Task& task)
    : mesh_(std::make_shared<const GeodesicMesh>(mesh, task)) {}

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
  check_index(seed, vertex_count, "seed");
  WavefrontResult result = propagate_wavefront(*mesh_, mesh_->internal_vertex(seed), task, windows);
  if (counters != nullptr) *counters = result.counters;
  std::vector<double> distances(vertex_count);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    distances[mesh_->external_vertex(static_cast<std::int32_t>(v))] = result.distances[v];
  }
  return DistanceField(std::make_shared<const DistanceField::Data>(
      DistanceField::Data{mesh_, seed, std::move(distances), std::move(result.records), /*is_exact=*/windows == 0}));
}

}  // namespace seamwire
