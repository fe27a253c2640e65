// SPDX-License-Identifier: GPL-3.0-or-later
#include "slits/slit_paths.hpp"

#include <algorithm>
#include <cmath>

#include "detail/index.hpp"
#include "detail/shortest_paths.hpp"

namespace seamwire::detail {
namespace {

/// Whether a path within a half may step from a vertex on one side to a vertex on another.
bool may_step(Half half, std::int8_t from, std::int8_t to) {
  if (half == Half::kAny) return true;
  if (to == 0) return from == 0;
  return half != Half::kPlane && to == static_cast<std::int8_t>(half);
}

double distance_to_segment(const Vector& point, const Vector& a, const Vector& b) {
  const Vector along = b - a;
  const double square = along.squaredNorm();
  const double t = square > 0.0 ? std::clamp((point - a).dot(along) / square, 0.0, 1.0) : 0.0;
  return (point - a - t * along).norm();
}

double distance_to_line(const Vector& point, std::span<const Vector> line) {
  double least = (point - line[0]).norm();
  for (std::size_t i = 1; i < line.size(); ++i) {
    least = std::min(least, distance_to_segment(point, line[i - 1], line[i]));
  }
  return least;
}

}  // namespace

SlitPaths::SlitPaths(const PlanMesh& mesh, const EdgePrices& prices, const Reflection* reflection,
                     std::span<const std::uint8_t> from, std::span<const std::uint8_t> ends, const Rules& rules)
    : paths_(mesh) {
  const auto side = [&](std::int32_t v) { return reflection->sides[v]; };
  const double plane_width = 0.5 * median_length(mesh);
  const bool hugs_plane = reflection != nullptr && rules.half == Half::kPlane && !reflection->is_exact;
  const auto edge_price = [&](std::int32_t e, std::int32_t a, std::int32_t b) {
    if (!rules.barred_edges.empty() && rules.barred_edges[e] != 0) return kInfinity;
    if (from[b] != 0 || (ends[a] != 0 && from[a] == 0)) return kInfinity;
    const double unit = mesh.lengths[e] > 0.0 ? prices.of_edge[e] / mesh.lengths[e] : 1.0;
    const double price = rules.exponent == 1.0 ? prices.of_edge[e] : mesh.lengths[e] * std::pow(unit, rules.exponent);
    if (reflection == nullptr) return price;
    if (hugs_plane) {
      const double place = 0.5 * (mesh.points[a] + mesh.points[b])[reflection->axis];
      const double away = (place - reflection->offset) / plane_width;
      return price * (0.5 + away * away);
    }
    if (!may_step(rules.half, side(a), side(b))) return kInfinity;
    return side(a) == 0 && side(b) == 0 ? 0.5 * price : price;
  };
  paths_.find(from, edge_price, prices.turning, -1);
}

std::vector<std::int32_t> TurningPaths::path(std::int32_t vertex) const {
  std::vector<std::int32_t> vertices;
  if (arrival_[vertex] < 0) return vertices;
  vertices.push_back(vertex);
  for (std::int32_t d = arrival_[vertex]; d >= 0; d = before_[d]) {
    const std::int32_t h = mesh_.half_edge_of[d / 2];
    vertices.push_back(d % 2 == 0 ? mesh_.tail(h) : mesh_.tip(h));
  }
  std::ranges::reverse(vertices);
  // With turns paid for, a path may come back to a vertex. The loop is left out.
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (std::size_t k = vertices.size() - 1; k > i; --k) {
      if (vertices[k] != vertices[i]) continue;
      vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(i),
                     vertices.begin() + static_cast<std::ptrdiff_t>(k));
      break;
    }
  }
  return vertices;
}

std::vector<std::int32_t> chain_along(const PlanMesh& mesh, std::span<const Vector> line, double spread,
                                      std::int32_t from, std::int32_t to, std::span<const std::uint8_t> barred,
                                      const EdgePrices& prices) {
  std::vector<double> away(mesh.vertex_count(), -1.0);
  const auto distance = [&](std::int32_t v) {
    if (away[v] < 0.0) away[v] = distance_to_line(mesh.points[v], line) / spread;
    return away[v];
  };
  const auto edge_price = [&](std::int32_t e, std::int32_t a, std::int32_t b) {
    if (barred[b] != 0 && b != to) return kInfinity;
    const double d = 0.5 * (distance(a) + distance(b));
    return prices.of_edge[e] * (1.0 + d * d * d * d);
  };
  std::vector<std::uint8_t> starts(mesh.vertex_count(), 0);
  starts[from] = 1;
  TurningPaths paths(mesh);
  paths.find(starts, edge_price, prices.turning, to);
  return paths.path(to);
}

std::vector<double> edge_distances(const PlanMesh& mesh, std::span<const std::int32_t> from) {
  std::vector<double> least(mesh.vertex_count(), kInfinity);
  find_shortest_paths(from, least, [&](std::int32_t v, const auto& step) {
    for (const auto& [next, edge] : mesh.all_neighbors[v]) step(next, mesh.lengths[edge]);
  });
  return least;
}

}  // namespace seamwire::detail
