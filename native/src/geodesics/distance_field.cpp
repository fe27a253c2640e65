// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/distance_field.hpp"

#include <cmath>
#include <utility>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "geodesics/path_tracing.hpp"
#include "geodesics/submesh.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// Of a point, or of the corners of its faces the one over which it is nearest.
std::int32_t nearest_vertex(const SolvedDistances& solved, const PlacedPoint& point) {
  if (point.vertex >= 0) return point.vertex;
  std::int32_t nearest = solved.mesh.half_edge(3 * point.faces.front().face).tail;
  double least = kInfinity;
  point.for_each_corner(solved.mesh, [&](std::int32_t h, const Point2&, double straight) {
    const std::int32_t corner = solved.mesh.half_edge(h).apex;
    if (!(solved.at(corner) + straight < least)) return;
    least = solved.at(corner) + straight;
    nearest = corner;
  });
  return nearest;
}

}  // namespace

DistanceField::DistanceField(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

std::int32_t DistanceField::seed() const {
  const std::vector<SurfacePoint>& sources = data_->given_sources;
  return sources.size() == 1 ? sources.front().vertex : -1;
}
const std::vector<SurfacePoint>& DistanceField::sources() const { return data_->given_sources; }
bool DistanceField::is_exact() const { return data_->is_exact; }
const GeodesicCounters& DistanceField::counters() const { return data_->counters; }
double DistanceField::radius() const { return data_->radius; }
bool DistanceField::fits(const IntrinsicMesh& mesh) const {
  return data_->mesh->vertex_count() == index(mesh.vertex_count) &&
         data_->mesh->half_edge_count() == 3 * mesh.face_count();
}
std::weak_ptr<const void> DistanceField::mesh_id() const { return data_->mesh; }
const std::vector<double>& DistanceField::distances() const { return data_->distances; }

IntrinsicPath DistanceField::trace(std::int32_t vertex, const Task& task) const {
  check_index(vertex, data_->distances.size(), "vertex");
  return trace(SurfacePoint::at_vertex(vertex), task);
}

IntrinsicPath DistanceField::trace(const SurfacePoint& point, const Task& task) const {
  const GeodesicMesh& mesh = *data_->mesh;
  const PlacedPoint target = PlacedPoint::of(mesh, point, "point");
  const SolvedDistances solved{mesh, data_->distances, data_->sources, data_->radius};
  IntrinsicPath path;
  if (data_->is_exact) {
    if (target.vertex >= 0 && std::isinf(solved.at(target.vertex))) return {};
    path = trace_records(solved, data_->records, data_->crossings, target, task);
  } else {
    const std::int32_t vertex = nearest_vertex(solved, target);
    if (std::isinf(solved.at(vertex))) return {};
    path = trace_records(solved, data_->records, data_->crossings, PlacedPoint::at_vertex(vertex), task);
    SubmeshCutter cutter(mesh);
    path = shorten(mesh, cutter, path, data_->sources[0], target, task);
  }
  to_external(mesh, path);
  return path;
}

double DistanceField::distance(const SurfacePoint& point, const Task& task) const {
  const PlacedPoint target = PlacedPoint::of(*data_->mesh, point, "point");
  const SolvedDistances solved{*data_->mesh, data_->distances, data_->sources, data_->radius};
  if (target.vertex >= 0) return solved.at(target.vertex);
  if (!data_->is_exact) return trace(point, task).length;
  return find_straight_start(solved, target, task).distance;
}

}  // namespace seamwire
