// SPDX-License-Identifier: GPL-3.0-or-later
#include "prices/visibility.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "detail/run_on_threads.hpp"
#include "seamwire/surface/ray_tree.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

constexpr std::size_t kBlock = 256;

/// Point i of `count` on a hemisphere around `axis`, spread evenly (Fibonacci spiral).
Vector on_hemisphere(int i, int count, const Vector& axis) {
  const double height = 1.0 - (i + 0.5) / count, turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
  const Vector x = axis.unitOrthogonal(), y = axis.cross(x);
  return std::sqrt(1.0 - height * height) * (std::cos(turn) * x + std::sin(turn) * y) + height * axis;
}

/// The same with a density that is proportional to the cosine of the angle to the axis.
Vector by_cosine(int i, int count, const Vector& axis) {
  const double radius = std::sqrt((i + 0.5) / count), turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
  const Vector x = axis.unitOrthogonal(), y = axis.cross(x);
  return radius * (std::cos(turn) * x + std::sin(turn) * y) + std::sqrt(std::max(1.0 - radius * radius, 0.0)) * axis;
}

}  // namespace

std::vector<std::int32_t> nearest_of(const PlanMesh& mesh, std::span<const std::int32_t> vertices, const Task& task) {
  std::vector<std::int32_t> nearest(mesh.vertex_count(), -1);
  std::vector<std::int32_t> open;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    nearest[vertices[i]] = static_cast<std::int32_t>(i);
    open.push_back(vertices[i]);
  }
  const Poll poll(task, 0.0, 0.0, 1);
  for (std::size_t i = 0; i < open.size(); ++i) {
    poll.at(i);
    for (const PlanNeighbor& next : mesh.all_neighbors[open[i]]) {
      if (nearest[next.vertex] >= 0) continue;
      nearest[next.vertex] = nearest[open[i]];
      open.push_back(next.vertex);
    }
  }
  return nearest;
}

Visibility find_visibility(const PlanMesh& mesh, const std::optional<Vector>& front, const Task& task,
                           std::span<const double> sizes, std::size_t most) {
  constexpr double kAbove = 2e-3;  // start this far above a part of area 1, to miss the faces around the vertex
  const RayTree rays(mesh.points, mesh.triangles);
  rays.wait(task);
  const std::vector<Vector> normals = vertex_normals(mesh, face_frames(mesh, task), task);
  std::vector<Vector> views;
  for (int i = 0; front && i < tuning::kViews; ++i) {
    views.push_back(on_hemisphere(i, tuning::kViews, front->stableNormalized()));
  }
  Visibility found;
  found.ambient.assign(mesh.vertex_count(), 1.0);
  if (front) found.front.assign(mesh.vertex_count(), 1.0);
  const auto look = [&](std::size_t v) {
    const Vector& normal = normals[v];
    if (normal.isZero()) return;
    const Vector origin = mesh.points[v] + kAbove * (sizes.empty() ? 1.0 : sizes[v]) * normal;
    const auto is_free = [&](const Vector& direction) {
      return direction.dot(normal) > 0.0 && rays.first_hit(origin, direction).triangle < 0;
    };
    int seen = 0;
    for (int i = 0; i < tuning::kSkyRays; ++i) seen += is_free(by_cosine(i, tuning::kSkyRays, normal)) ? 1 : 0;
    found.ambient[v] = static_cast<double>(seen) / tuning::kSkyRays;
    if (!front) return;
    const auto views_that_see = std::ranges::count_if(views, is_free);
    found.front[v] = static_cast<double>(views_that_see) / tuning::kViews;
  };
  std::vector<std::int32_t> chosen;
  const std::size_t step = (mesh.vertex_count() - 1) / std::max<std::size_t>(most, 1) + 1;
  for (std::size_t v = 0; v < mesh.vertex_count(); v += step) chosen.push_back(static_cast<std::int32_t>(v));
  const std::size_t blocks = (chosen.size() + kBlock - 1) / kBlock;
  run_on_threads(
      blocks, task, [&](std::size_t done) { return static_cast<double>(done) / static_cast<double>(blocks); },
      [&](std::size_t block, const Task& own) {
        own.check(0.0);
        const std::size_t end = std::min(chosen.size(), (block + 1) * kBlock);
        for (std::size_t i = block * kBlock; i < end; ++i) look(index(chosen[i]));
      });
  if (step == 1) return found;
  const std::vector<std::int32_t> nearest = nearest_of(mesh, chosen, task);
  for (std::vector<double>* values : {&found.front, &found.ambient}) {
    for (std::size_t v = 0; v < values->size(); ++v) {
      if (nearest[v] >= 0) (*values)[v] = (*values)[chosen[nearest[v]]];
    }
  }
  return found;
}

}  // namespace seamwire::detail
