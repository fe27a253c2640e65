// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/geodesics/exact_geodesics.hpp"

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "detail/index.hpp"
#include "detail/text.hpp"
#include "geodesics/distance_field.hpp"
#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/placed_point.hpp"
#include "geodesics/wavefront.hpp"

namespace seamwire {

using namespace detail;

ExactGeodesics::ExactGeodesics(const IntrinsicMesh& mesh, const Task& task)
    : mesh_(std::make_shared<const GeodesicMesh>(mesh, task)) {}

ExactGeodesics::ExactGeodesics(const ExactGeodesics& former, const IntrinsicMesh& former_mesh,
                               const IntrinsicMesh& mesh, const Task& task) {
  std::optional<GeodesicMesh> patched = former.mesh_->patched(former_mesh, mesh, task);
  mesh_ = patched ? std::make_shared<const GeodesicMesh>(std::move(*patched))
                  : std::make_shared<const GeodesicMesh>(mesh, task);
}

DistanceField ExactGeodesics::solve(std::int32_t seed, const Task& task) const {
  check_index(seed, mesh_->vertex_count(), "seed");
  return run(std::array{SurfacePoint::at_vertex(seed)}, {}, 0, task);
}

DistanceField ExactGeodesics::solve(std::span<const SurfacePoint> sources, const SolveOptions& options,
                                    const Task& task) const {
  if (sources.empty()) throw InvalidInput("no source to have distances from");
  if (!(options.max_distance >= 0)) {
    throw InvalidInput("max_distance is " + text(options.max_distance) + ", not 0 or more");
  }
  return run(sources, options, 0, task);
}

DistanceField ExactGeodesics::solve_bounded(std::int32_t seed, std::uint32_t windows, const Task& task) const {
  if (windows == 0) throw InvalidInput("windows must be at least 1");
  check_index(seed, mesh_->vertex_count(), "seed");
  return run(std::array{SurfacePoint::at_vertex(seed)}, {}, windows, task);
}

DistanceField ExactGeodesics::run(std::span<const SurfacePoint> sources, const SolveOptions& options,
                                  std::uint32_t windows, const Task& task) const {
  std::vector<PlacedPoint> placed;
  for (const SurfacePoint& source : sources) {
    placed.push_back(PlacedPoint::of(*mesh_, source, "source " + std::to_string(placed.size())));
  }
  WavefrontEnd end{.max_distance = options.max_distance, .targets = {}};
  for (const SurfacePoint& target : options.targets) {
    end.targets.push_back(PlacedPoint::of(*mesh_, target, "target " + std::to_string(end.targets.size())));
  }
  SourcePoints from(std::move(placed));
  WavefrontResult result = propagate_wavefront(*mesh_, from, task, windows, end);
  std::vector<double> distances(mesh_->vertex_count());
  for (std::size_t v = 0; v < distances.size(); ++v) {
    distances[mesh_->external_vertex(static_cast<std::int32_t>(v))] = result.distances[v];
  }
  return DistanceField(
      std::make_shared<const DistanceField::Data>(DistanceField::Data{.mesh = mesh_,
                                                                      .given_sources = {sources.begin(), sources.end()},
                                                                      .sources = std::move(from),
                                                                      .distances = std::move(distances),
                                                                      .records = std::move(result.records),
                                                                      .crossings = std::move(result.crossings),
                                                                      .is_exact = windows == 0,
                                                                      .counters = result.counters,
                                                                      .radius = result.radius}));
}

}  // namespace seamwire
