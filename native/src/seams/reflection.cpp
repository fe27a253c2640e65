// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/reflection.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "detail/index.hpp"
#include "seams/point_grid.hpp"

namespace seamwire::detail {
namespace {

constexpr double kNear = 0.012;    // of the diagonal: as near as this to the surface an image corresponds
constexpr double kSpacing = 0.75;  // of the median edge: the same between vertices of coarse meshes
constexpr double kMostArea = 0.9;  // the share of the area that has to correspond

/// Whether nearly all edges have an edge as their image, and that one the first as its image.
bool maps_edges(const PlanMesh& mesh, const Reflection& reflection) {
  constexpr double kNearlyAll = 0.95;
  std::size_t mapped = 0;
  const auto back = [&](std::int32_t v, std::int32_t image) { return image >= 0 && reflection.images[image] == v; };
  for (const std::int32_t h : mesh.half_edge_of) {
    const std::int32_t a = mesh.start(h), b = mesh.end(h);
    const std::int32_t a_image = reflection.images[a], b_image = reflection.images[b];
    if (!back(a, a_image) || !back(b, b_image)) continue;
    const auto& around = mesh.all_neighbors[a_image];
    mapped += std::ranges::any_of(around, [&](const PlanNeighbor& next) { return next.vertex == b_image; }) ? 1 : 0;
  }
  return static_cast<double>(mapped) >= kNearlyAll * static_cast<double>(mesh.edge_count());
}

/// The reflection in one plane.
std::optional<Reflection> reflection_at(const PlanMesh& mesh, int axis, double offset, double diagonal) {
  const std::vector<FaceFrame> frames = face_frames(mesh);
  const std::vector<double> areas = vertex_areas(mesh, frames);
  const std::vector<Vector> normals = vertex_normals(mesh, frames);
  // On coarse meshes the nearest vertex may be far along the surface, though the surface is near.
  const PointGrid grid(mesh.points, std::max(kNear * diagonal, kSpacing * median_length(mesh)));
  const auto surface_distance = [&](std::int32_t v, const Vector& point) {
    const Vector away = point - mesh.points[v];
    return normals[v].isZero() ? away.norm() : std::min(away.norm(), std::abs(away.dot(normals[v])));
  };
  Reflection found{.axis = axis, .offset = offset, .images = {}, .sides = {}};
  double corresponding = 0.0, total = 0.0;
  for (std::int32_t v = 0; index(v) < mesh.vertex_count(); ++v) {
    const Vector image = found.mirrored(mesh.points[v]);
    std::int32_t nearest = grid.nearest(image);
    if (nearest >= 0 && surface_distance(nearest, image) > kNear * diagonal) nearest = -1;
    found.images.push_back(nearest);
    total += areas[v];
    corresponding += nearest >= 0 ? areas[v] : 0.0;
    const auto side = static_cast<std::int8_t>(mesh.points[v][axis] < offset ? -1 : 1);
    found.sides.push_back(nearest == v ? std::int8_t{0} : side);
  }
  if (!(total > 0.0) || corresponding < kMostArea * total) return std::nullopt;
  found.is_exact = maps_edges(mesh, found);
  return found;
}

}  // namespace

std::optional<Reflection> find_reflection(const PlanMesh& mesh, int axis) {
  Eigen::AlignedBox3d box;
  for (const Vector& point : mesh.points) box.extend(point);
  const double diagonal = box.isEmpty() ? 0.0 : box.diagonal().norm();
  if (!(diagonal > 0.0)) return std::nullopt;
  std::optional<Reflection> found = reflection_at(mesh, axis, 0.0, diagonal);
  return found ? found : reflection_at(mesh, axis, box.center()[axis], diagonal);
}

}  // namespace seamwire::detail
