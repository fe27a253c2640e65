// SPDX-License-Identifier: GPL-3.0-or-later
#include "prices/polygons.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "detail/disjoint_sets.hpp"
#include "detail/index.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

constexpr double kDegreesOfRadian = 180.0 / std::numbers::pi;
constexpr std::size_t kMostEdges = 24;  // around a vertex; lines end at the middle of larger fans

double angle_between(const Vector& one, const Vector& other) {
  return kDegreesOfRadian * std::atan2(one.cross(other).norm(), one.dot(other));
}

/// How far the two triangles beside a half-edge are from a rectangle, in degrees; kInfinity if they are no quad.
double skew_of(const PlanMesh& mesh, std::span<const FaceFrame> frames, std::int32_t h) {
  const std::int32_t twin = mesh.twins[h];
  const double fold = angle_between(frames[h / 3].normal, frames[twin / 3].normal);
  if (!(fold < tuning::kMostFold)) return kInfinity;
  const std::array<Vector, 4> corners{mesh.points[mesh.tail(h)], mesh.points[mesh.apex(twin)], mesh.points[mesh.tip(h)],
                                      mesh.points[mesh.apex(h)]};
  double deviation = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector& at = corners[i];
    deviation += std::abs(angle_between(corners[(i + 1) % 4] - at, corners[(i + 3) % 4] - at) - 90.0);
  }
  const double skew = fold + deviation / 4.0;
  return skew < tuning::kMostSkew ? skew : kInfinity;
}

}  // namespace

Polygons find_polygons(const PlanMesh& mesh, std::span<const FaceFrame> frames,
                       std::span<const std::uint8_t> is_border) {
  DisjointSets sets(mesh.face_count());
  std::vector<std::uint8_t> is_alone(mesh.face_count(), 1);
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
    if (mesh.is_real[e] != 0 || twin < 0) continue;
    sets.join(h / 3, twin / 3);
    is_alone[h / 3] = is_alone[twin / 3] = 0;
  }
  std::vector<std::tuple<double, std::int32_t>> pairs;
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
    if (twin < 0 || is_alone[h / 3] == 0 || is_alone[twin / 3] == 0) continue;
    if (!is_border.empty() && is_border[e] != 0) continue;
    const double skew = skew_of(mesh, frames, h);
    if (skew != kInfinity) pairs.emplace_back(skew, e);
  }
  std::ranges::sort(pairs);
  for (const auto& [skew, e] : pairs) {
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
    if (is_alone[h / 3] == 0 || is_alone[twin / 3] == 0) continue;
    sets.join(h / 3, twin / 3);
    is_alone[h / 3] = is_alone[twin / 3] = 0;
  }
  auto [of_face, count] = sets.numbering();
  Polygons found{.of_face = std::move(of_face), .is_diagonal = {}, .count = index(count)};
  for (const std::int32_t h : mesh.half_edge_of) {
    const std::int32_t twin = mesh.twins[h];
    found.is_diagonal.push_back(twin >= 0 && found.of_face[h / 3] == found.of_face[twin / 3] ? 1 : 0);
  }
  return found;
}

EdgeLines find_lines(const PlanMesh& mesh, const Polygons& polygons) {
  const auto sides = [&](std::int32_t e) {
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
    return std::array{polygons.of_face[h / 3], twin < 0 ? -1 : polygons.of_face[twin / 3]};
  };
  const auto share_polygon = [&](std::int32_t one, std::int32_t other) {
    const auto [a, b] = sides(one);
    const auto [c, d] = sides(other);
    return a == c || a == d || (b >= 0 && (b == c || b == d));
  };
  // The edge on which each edge goes on: at the start of its half-edge, and at the end.
  std::vector<std::array<std::int32_t, 2>> next(mesh.edge_count(), {-1, -1});
  std::vector<PlanNeighbor> around;
  std::vector<std::int32_t> choice;
  const auto end_at = [&](std::int32_t e, std::int32_t v) { return mesh.tail(mesh.half_edge_of[e]) == v ? 0 : 1; };
  for (std::int32_t v = 0; index(v) < mesh.vertex_count(); ++v) {
    around.clear();
    for (const PlanNeighbor& neighbor : mesh.neighbors[v]) {
      if (polygons.is_diagonal[neighbor.edge] == 0) around.push_back(neighbor);
    }
    if (around.size() > kMostEdges) continue;
    choice.assign(around.size(), -1);
    for (std::size_t i = 0; i < around.size(); ++i) {
      const Vector in = mesh.points[v] - mesh.points[around[i].vertex];
      double least = tuning::kMostTurn;
      for (std::size_t k = 0; k < around.size(); ++k) {
        if (k == i) continue;
        const double turn = angle_between(in, mesh.points[around[k].vertex] - mesh.points[v]);
        const bool is_opposite =
            around.size() == 4 && !mesh.is_boundary(around[i].edge) && !share_polygon(around[i].edge, around[k].edge);
        if (is_opposite && turn < tuning::kOverVertex) {
          choice[i] = static_cast<std::int32_t>(k);
          break;
        }
        if (turn < least) {
          least = turn;
          choice[i] = static_cast<std::int32_t>(k);
        }
      }
    }
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (choice[i] >= 0 && index(choice[choice[i]]) == i) {
        next[around[i].edge][end_at(around[i].edge, v)] = around[choice[i]].edge;
      }
    }
  }
  EdgeLines lines{.of_edge = std::vector<std::int32_t>(mesh.edge_count(), -1), .edges = {}};
  for (std::int32_t first = 0; index(first) < mesh.edge_count(); ++first) {
    if (polygons.is_diagonal[first] != 0 || lines.of_edge[first] >= 0) continue;
    const auto line = static_cast<std::int32_t>(lines.edges.size());
    lines.of_edge[first] = line;
    std::vector<std::int32_t> edges{first};
    for (const int end : {0, 1}) {
      std::int32_t e = first;
      const std::int32_t h = mesh.half_edge_of[first];
      std::int32_t v = end == 0 ? mesh.tail(h) : mesh.tip(h);
      for (;;) {
        const std::int32_t following = next[e][end_at(e, v)];
        if (following < 0 || lines.of_edge[following] >= 0) break;
        lines.of_edge[following] = line;
        edges.push_back(following);
        e = following;
        const std::int32_t own = mesh.half_edge_of[e];
        v = mesh.tail(own) == v ? mesh.tip(own) : mesh.tail(own);
      }
      if (end == 0) std::ranges::reverse(edges);
    }
    lines.edges.push_back(std::move(edges));
  }
  return lines;
}

}  // namespace seamwire::detail
