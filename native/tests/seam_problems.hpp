// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "prices/edge_prices.hpp"
#include "shapes.hpp"
#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// Options of a SlitProblem for a test.
struct ProblemOptions {
  int mirror = -1;
  std::optional<Vector> front = std::nullopt;
  std::vector<double> weights = {};
  std::vector<Edge> seams = {};
};

/// A problem on a surface itself, without a simplified mesh.
inline SlitProblem problem_on(const Surface& surface, const ProblemOptions& options = {}) {
  SlitProblem problem;
  problem.mesh = std::make_shared<const PlanMesh>(plan_mesh(surface, {}));
  const auto is_seam = [&](std::int32_t h) {
    const std::int32_t a = problem.mesh->sources[problem.mesh->tail(h)],
                       b = problem.mesh->sources[problem.mesh->tip(h)];
    return std::ranges::any_of(options.seams, [&](const Edge& e) { return e == Edge{a, b} || e == Edge{b, a}; });
  };
  for (const std::int32_t h : problem.mesh->half_edge_of) problem.is_seam.push_back(is_seam(h) ? 1 : 0);
  if (options.mirror >= 0) problem.reflection = find_reflection(*problem.mesh, options.mirror, {});
  const Visibility visibility = find_visibility(*problem.mesh, options.front, {});
  std::vector<double> weights;
  for (const std::int32_t v : problem.mesh->sources) {
    if (!options.weights.empty()) weights.push_back(options.weights[v]);
  }
  problem.prices = find_prices(*problem.mesh, visibility, problem.reflection, weights, {});
  find_pieces_of(problem, {});
  return problem;
}

/// The vertex of a mesh nearest to a point in the caller's coordinates.
inline std::int32_t nearest_vertex(const PlanMesh& mesh, const Vector& point) {
  const auto away = [&](const Vector& own) { return (own - mesh.scale * point).norm(); };
  return static_cast<std::int32_t>(std::ranges::min_element(mesh.points, {}, away) - mesh.points.begin());
}

/// Flags with 1 at some vertices.
inline std::vector<std::uint8_t> flags_at(const PlanMesh& mesh, const std::vector<std::int32_t>& vertices) {
  std::vector<std::uint8_t> flags(mesh.vertex_count(), 0);
  for (const std::int32_t v : vertices) flags[v] = 1;
  return flags;
}

}  // namespace seamwire::detail
