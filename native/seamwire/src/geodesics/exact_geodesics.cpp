// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/geodesics/exact_geodesics.hpp"

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "detail/index.hpp"
#include "detail/text.hpp"
#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/path_tracing.hpp"
#include "geodesics/placed_point.hpp"
#include "geodesics/trace_record.hpp"
#include "geodesics/wavefront.hpp"
#include "seamwire/geodesics/distance_field.hpp"

namespace seamwire {

using namespace detail;

struct DistanceField::Data {
  std::shared_ptr<const GeodesicMesh> mesh;
  std::vector<SurfacePoint> given_sources;
  SourcePoints sources;              ///< the same in internal numbers
  std::vector<double> distances;     ///< in external numbers
  std::vector<TraceRecord> records;  ///< in internal numbers
  std::vector<SiblingCrossing> crossings;
  GeodesicCounters counters;
  double radius;  ///< distances beyond it are infinite
};

DistanceField::DistanceField(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

std::int32_t DistanceField::seed() const {
  const std::vector<SurfacePoint>& sources = data_->given_sources;
  return sources.size() == 1 ? sources.front().vertex : -1;
}
const std::vector<SurfacePoint>& DistanceField::sources() const { return data_->given_sources; }
const GeodesicCounters& DistanceField::counters() const { return data_->counters; }
double DistanceField::radius() const { return data_->radius; }
bool DistanceField::fits(const IntrinsicMesh& mesh) const {
  return data_->mesh->vertex_count() == index(mesh.vertex_count) &&
         data_->mesh->half_edge_count() == 3 * mesh.face_count();
}
std::weak_ptr<const void> DistanceField::mesh_id() const { return data_->mesh; }
const std::vector<double>& DistanceField::distances() const { return data_->distances; }

IntrinsicPath DistanceField::trace(const SurfacePoint& point, const Task& task) const {
  const GeodesicMesh& mesh = *data_->mesh;
  const PlacedPoint target = PlacedPoint::of(mesh, point, "point");
  const SolvedDistances solved{mesh, data_->distances, data_->sources, data_->radius};
  if (target.vertex >= 0 && std::isinf(solved.at(target.vertex))) return {};
  IntrinsicPath path = trace_records(solved, data_->records, data_->crossings, target, task);
  to_external(mesh, path);
  return path;
}

double DistanceField::distance(const SurfacePoint& point, const Task& task) const {
  const PlacedPoint target = PlacedPoint::of(*data_->mesh, point, "point");
  const SolvedDistances solved{*data_->mesh, data_->distances, data_->sources, data_->radius};
  if (target.vertex >= 0) return solved.at(target.vertex);
  return find_straight_start(solved, target, task).distance;
}

ExactGeodesics::ExactGeodesics(const IntrinsicMesh& mesh, const Task& task)
    : mesh_(std::make_shared<const GeodesicMesh>(mesh, task)) {}

ExactGeodesics::ExactGeodesics(const ExactGeodesics& former, const IntrinsicMesh& former_mesh,
                               const IntrinsicMesh& mesh, const Task& task) {
  std::optional<GeodesicMesh> patched = former.mesh_->patched(former_mesh, mesh, task);
  mesh_ = patched ? std::make_shared<const GeodesicMesh>(std::move(*patched))
                  : std::make_shared<const GeodesicMesh>(mesh, task);
}

DistanceField ExactGeodesics::solve(const SurfacePoint& seed, const Task& task) const {
  return solve({&seed, 1}, {}, task);
}

DistanceField ExactGeodesics::solve(std::span<const SurfacePoint> sources, const SolveOptions& options,
                                    const Task& task) const {
  if (sources.empty()) throw InvalidInput("no source to have distances from");
  if (!(options.max_distance >= 0)) {
    throw InvalidInput("max_distance is " + text(options.max_distance) + ", not 0 or more");
  }
  std::vector<PlacedPoint> placed;
  for (const SurfacePoint& source : sources) {
    placed.push_back(PlacedPoint::of(*mesh_, source, "source " + std::to_string(placed.size())));
  }
  WavefrontOptions front{.max_distance = options.max_distance};
  for (const SurfacePoint& target : options.targets) {
    front.targets.push_back(PlacedPoint::of(*mesh_, target, "target " + std::to_string(front.targets.size())));
  }
  SourcePoints from(std::move(placed));
  WavefrontResult result = propagate_wavefront(*mesh_, from, front, task);
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
                                                                      .counters = result.counters,
                                                                      .radius = result.radius}));
}

}  // namespace seamwire
