// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/geodesics/heat_geodesics.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "detail/computed_once.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "geodesics/descent.hpp"
#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/heat_system.hpp"
#include "geodesics/path_tracing.hpp"
#include "geodesics/placed_point.hpp"
#include "geodesics/submesh.hpp"

namespace seamwire {

using namespace detail;

struct HeatGeodesics::Prepared {
  Prepared(const IntrinsicMesh& of, const Task& task)
      : mesh(of, part_of(task, 0.1, 0.15)), system(of, part_of(task, 0.15, 1.0)) {}

  /// What paths are shortened on, made for the first one.
  const GeodesicMesh& geodesic_mesh(const Task& task) const {
    return *made_geodesic_mesh.get(part_of(task, 0.0, 0.0),
                                   [&](const Task& own) { return GeodesicMesh(mesh.mesh(), own); });
  }

  TracingMesh mesh;
  HeatSystem system;
  mutable ComputedOnce<GeodesicMesh> made_geodesic_mesh;
};

namespace {

/// The largest number of rounds in which a path is shortened.
constexpr int kMostRounds = 20;
/// Rounds end once one of them shortens the path by less than this part of its length.
constexpr double kLeastGain = 1e-3;

SurfacePoint surface_point(const PathPoint& point) {
  if (point.vertex >= 0) return SurfacePoint(point.vertex);
  if (point.face >= 0) return {point.face, point.barycentric};
  SurfacePoint on_edge(point.half_edge / 3, {});
  on_edge.barycentric[static_cast<std::size_t>(point.half_edge % 3)] = 1 - point.t;
  on_edge.barycentric[static_cast<std::size_t>((point.half_edge + 1) % 3)] = point.t;
  return on_edge;
}

/// The locally shortest path near another one. Each round searches the triangles around the last path.
IntrinsicPath shortened(const GeodesicMesh& mesh, IntrinsicPath path, const Task& task) {
  if (path.points.size() < 2) return path;
  const PlacedPoint source = PlacedPoint::of(mesh, surface_point(path.points.front()), "source");
  const PlacedPoint target = PlacedPoint::of(mesh, surface_point(path.points.back()), "point");
  IntrinsicPath inside = path;
  for (PathPoint& point : inside.points) {
    if (point.vertex >= 0) point.vertex = mesh.internal_vertex(point.vertex);
    if (point.half_edge >= 0) point.half_edge = 3 * mesh.internal_face(point.half_edge / 3) + point.half_edge % 3;
  }
  SubmeshCutter cutter(mesh);
  for (int round = 0; round < kMostRounds; ++round) {
    IntrinsicPath next = shorten(mesh, cutter, inside, source, target, part_of(task, 0.0, 0.0));
    if (next.points.empty() || !(next.length < path.length)) break;
    const bool is_enough = next.length > (1 - kLeastGain) * path.length;
    inside = next;
    path = std::move(next);
    to_external(mesh, path);
    if (is_enough) break;
  }
  return path;
}

}  // namespace

class HeatGeodesics::Solved final : public SolvedField {
 public:
  Solved(std::shared_ptr<const Prepared> prepared, const std::vector<PlacedPoint>& placed)
      : prepared_(std::move(prepared)), ends_(placed) {}

  /// Sets the distances. Beyond the radius they are infinite, but paths still need them.
  void set_distances(std::vector<double> all) {
    distances = std::move(all);
    if (std::isinf(radius)) return;
    all_ = distances;
    for (double& distance : distances) distance = distance > radius ? kInfinity : distance;
  }

  double distance(const SurfacePoint& point, const Task& task) const override {
    task.check(0.0);
    return distance_of(prepared_->mesh.place(point, "point"));
  }
  std::optional<IntrinsicPath> trace(const SurfacePoint& point, const Task& task) const override {
    task.check(0.0);
    const PlacedPoint from = prepared_->mesh.place(point, "point");
    if (std::isinf(distance_of(from))) return std::nullopt;
    const GeodesicMesh& mesh = prepared_->geodesic_mesh(task);
    return shortened(mesh, descend(prepared_->mesh, complete(), ends_, from, task), task);
  }

 private:
  const std::vector<double>& complete() const { return all_.empty() ? distances : all_; }
  double distance_of(const PlacedPoint& point) const {
    if (point.vertex >= 0) return distances[static_cast<std::size_t>(point.vertex)];
    double least = kInfinity, value = 0.0;
    for (const auto& [face, weights] : point.faces) {
      const TracingMesh::Corners corners = prepared_->mesh.corners(face);
      least = std::min(least, ends_.nearest(prepared_->mesh, face, between(corners, weights)).length);
    }
    const auto& [face, weights] = point.faces.front();
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t v = prepared_->mesh.mesh().triangles[static_cast<std::size_t>(face)][i];
      if (weights[i] > 0) value += weights[i] * complete()[static_cast<std::size_t>(v)];
    }
    // The straight line to a source of the same face is better than what is interpolated, unless another is nearer.
    if (least == kInfinity || sources.size() > 1) least = std::min(least, value);
    return least > radius ? kInfinity : least;
  }

  std::shared_ptr<const Prepared> prepared_;
  PathEnds ends_;
  std::vector<double> all_;  // empty if no distance is beyond the radius
};

HeatGeodesics::HeatGeodesics(const IntrinsicMesh& mesh, const Task& task) {
  check_mesh(mesh, task);
  prepared_ = std::make_shared<const Prepared>(mesh, task);
}

DistanceField HeatGeodesics::solve_checked(std::span<const SurfacePoint> sources, const SolveOptions& options,
                                           const Task& task) const {
  const TracingMesh& mesh = prepared_->mesh;
  std::vector<PlacedPoint> placed;
  std::vector<HeatSource> heat;
  for (const SurfacePoint& source : sources) {
    placed.push_back(mesh.place(source, "source " + std::to_string(placed.size())));
    HeatSource& here = heat.emplace_back();
    if (placed.back().vertex >= 0) {
      here.vertices[0] = placed.back().vertex;
      here.weights[0] = 1.0;
      continue;
    }
    const auto& [face, weights] = placed.back().faces.front();
    const TracingMesh::Corners corners = mesh.corners(face);
    here.vertices = mesh.mesh().triangles[static_cast<std::size_t>(face)];
    here.weights = weights;
    for (std::size_t i = 0; i < 3; ++i) {
      here.distances[i] = seamwire::detail::distance(corners[i], between(corners, weights));
    }
  }
  for (std::size_t i = 0; i < options.targets.size(); ++i)
    mesh.place(options.targets[i], "target " + std::to_string(i));
  const auto solved = std::make_shared<Solved>(prepared_, placed);
  solved->sources.assign(sources.begin(), sources.end());
  solved->radius = options.max_distance;
  solved->face_count = mesh.mesh().face_count();
  solved->mesh = prepared_;
  solved->set_distances(prepared_->system.distances(heat, task));
  return DistanceField(solved);
}

}  // namespace seamwire
