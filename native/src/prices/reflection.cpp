// SPDX-License-Identifier: GPL-3.0-or-later
#include "prices/reflection.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "prices/point_tree.hpp"

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
    const std::int32_t a = mesh.tail(h), b = mesh.tip(h);
    const std::int32_t a_image = reflection.images[a], b_image = reflection.images[b];
    if (!back(a, a_image) || !back(b, b_image)) continue;
    const auto& around = mesh.all_neighbors[a_image];
    mapped += std::ranges::any_of(around, [&](const PlanNeighbor& next) { return next.vertex == b_image; }) ? 1 : 0;
  }
  return static_cast<double>(mapped) >= kNearlyAll * static_cast<double>(mesh.edge_count());
}

Eigen::AlignedBox3d box_of(const PlanMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vector& point : mesh.points) box.extend(point);
  return box;
}

}  // namespace

double diagonal_of(const PlanMesh& mesh) {
  const Eigen::AlignedBox3d box = box_of(mesh);
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

std::optional<Reflection> reflection_in(const PlanMesh& mesh, int axis, double offset, double diagonal,
                                        const Task& task) {
  const std::vector<FaceFrame> frames = face_frames(mesh, task);
  const std::vector<double> areas = vertex_areas(mesh, frames);
  const std::vector<Vector> normals = vertex_normals(mesh, frames, task);
  task.check(0.0);
  // On coarse meshes the nearest vertex may be far along the surface, though the surface is near.
  const PointTree tree(mesh.points, task);
  const double radius = std::max(kNear * diagonal, kSpacing * median_length(mesh));
  const auto surface_distance = [&](std::int32_t v, const Vector& point) {
    const Vector away = point - mesh.points[v];
    return normals[v].isZero() ? away.norm() : std::min(away.norm(), std::abs(away.dot(normals[v])));
  };
  Reflection found{.axis = axis, .offset = offset, .images = {}, .sides = {}};
  double corresponding = 0.0, total = 0.0;
  const Poll poll(task, 0.0, 1.0, mesh.vertex_count());
  for (std::int32_t v = 0; index(v) < mesh.vertex_count(); ++v) {
    poll.at(index(v));
    const Vector image = found.mirrored(mesh.points[v]);
    std::int32_t nearest = tree.nearest(image, radius).point;
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

std::optional<Reflection> find_reflection(const PlanMesh& mesh, int axis, const Task& task) {
  const double diagonal = diagonal_of(mesh);
  if (!(diagonal > 0.0)) return std::nullopt;
  std::optional<Reflection> found = reflection_in(mesh, axis, 0.0, diagonal, task);
  return found ? found : reflection_in(mesh, axis, box_of(mesh).center()[axis], diagonal, task);
}

std::int32_t image_of_edge(const PlanMesh& mesh, const Reflection& reflection, std::int32_t edge) {
  const std::int32_t h = mesh.half_edge_of[edge];
  const std::int32_t a = reflection.images[mesh.tail(h)], b = reflection.images[mesh.tip(h)];
  return a < 0 || b < 0 ? -1 : mesh.edge_between(a, b);
}

}  // namespace seamwire::detail
