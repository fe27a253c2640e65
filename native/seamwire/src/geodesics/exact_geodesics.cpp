// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/geodesics/exact_geodesics.hpp"

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/path_tracing.hpp"
#include "geodesics/placed_point.hpp"
#include "geodesics/point_search.hpp"
#include "geodesics/solve_check.hpp"
#include "geodesics/trace_record.hpp"
#include "geodesics/wavefront.hpp"
#include "seamwire/geodesics/distance_field.hpp"

namespace seamwire {

using namespace detail;

class ExactField::Solved final : public SolvedField {
 public:
  double distance(const SurfacePoint& point, const Task& task) const override {
    const PlacedPoint target = PlacedPoint::of(*geodesic_mesh, point, "point");
    const SolvedDistances solved = solved_distances();
    if (target.vertex >= 0) return solved.at(target.vertex);
    return find_straight_start(solved, target, task).distance;
  }
  std::optional<IntrinsicPath> trace(const SurfacePoint& point, const Task& task) const override {
    const PlacedPoint target = PlacedPoint::of(*geodesic_mesh, point, "point");
    const SolvedDistances solved = solved_distances();
    if (target.vertex >= 0 && std::isinf(solved.at(target.vertex))) return std::nullopt;
    IntrinsicPath path = trace_records(solved, records, crossings, target, task);
    if (path.points.empty()) return std::nullopt;
    to_external(*geodesic_mesh, path);
    return path;
  }

  std::shared_ptr<const GeodesicMesh> geodesic_mesh;
  SourcePoints placed_sources;       ///< in internal numbers
  std::vector<TraceRecord> records;  ///< in internal numbers
  std::vector<SiblingCrossing> crossings;
  GeodesicCounters counters;

 private:
  SolvedDistances solved_distances() const { return {*geodesic_mesh, distances, placed_sources, radius}; }
};

ExactField::ExactField(std::shared_ptr<const Solved> solved) : DistanceField(std::move(solved)) {}
const GeodesicCounters& ExactField::counters() const { return static_cast<const Solved&>(solved()).counters; }

ExactGeodesics::ExactGeodesics(const IntrinsicMesh& mesh, const Task& task)
    : mesh_(std::make_shared<const GeodesicMesh>(mesh, task)) {}

ExactGeodesics::ExactGeodesics(const ExactGeodesics& former, const IntrinsicMesh& former_mesh,
                               const IntrinsicMesh& mesh, const Task& task) {
  std::optional<GeodesicMesh> patched = former.mesh_->patched(former_mesh, mesh, task);
  mesh_ = patched ? std::make_shared<const GeodesicMesh>(std::move(*patched))
                  : std::make_shared<const GeodesicMesh>(mesh, task);
}

ExactField ExactGeodesics::solve(const SurfacePoint& seed, const Task& task) const {
  return solve({&seed, 1}, {}, task);
}

ExactField ExactGeodesics::solve(std::span<const SurfacePoint> sources, const SolveOptions& options,
                                 const Task& task) const {
  check_solve(sources, options);
  std::vector<PlacedPoint> placed;
  for (const SurfacePoint& source : sources) {
    placed.push_back(PlacedPoint::of(*mesh_, source, "source " + std::to_string(placed.size())));
  }
  WavefrontOptions front{.max_distance = options.max_distance};
  for (const SurfacePoint& target : options.targets) {
    front.targets.push_back(PlacedPoint::of(*mesh_, target, "target " + std::to_string(front.targets.size())));
  }
  const auto solved = std::make_shared<ExactField::Solved>();
  solved->placed_sources = SourcePoints(std::move(placed));
  WavefrontResult result = propagate_wavefront(*mesh_, solved->placed_sources, front, task);
  solved->distances.resize(mesh_->vertex_count());
  for (std::size_t v = 0; v < solved->distances.size(); ++v) {
    solved->distances[mesh_->external_vertex(static_cast<std::int32_t>(v))] = result.distances[v];
  }
  solved->sources.assign(sources.begin(), sources.end());
  solved->radius = result.radius;
  solved->face_count = mesh_->half_edge_count() / 3;
  solved->mesh = mesh_;
  solved->geodesic_mesh = mesh_;
  solved->records = std::move(result.records);
  solved->crossings = std::move(result.crossings);
  solved->counters = result.counters;
  return ExactField(solved);
}

DistanceField ExactGeodesics::solve_checked(std::span<const SurfacePoint> sources, const SolveOptions& options,
                                            const Task& task) const {
  return solve(sources, options, task);
}

}  // namespace seamwire
