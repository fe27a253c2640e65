// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/corner_angles.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include "detail/csr.hpp"
#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"

namespace seamwire::detail {
namespace {

/// The least half-edge of an edge.
std::int32_t name_of_edge(const GeodesicMesh& mesh, std::int32_t h) {
  std::int32_t name = h;
  mesh.for_each_beyond(h, [&](std::int32_t other) { name = std::min(name, other); });
  return name;
}

}  // namespace

std::vector<CornerAngles> angles_around(const GeodesicMesh& mesh, std::int32_t vertex, std::int32_t corner,
                                        double angle) {
  // The corners join the edges at the vertex; the angles are distances in this graph.
  const auto corners = mesh.out(vertex);
  std::vector<std::int32_t> edges;
  for (const std::int32_t h : corners) {
    edges.push_back(name_of_edge(mesh, h));
    edges.push_back(name_of_edge(mesh, previous_in_face(h)));
  }
  std::vector<std::int32_t> names = edges;
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  for (std::int32_t& edge : edges) {
    edge = static_cast<std::int32_t>(std::ranges::lower_bound(names, edge) - names.begin());
  }
  struct Way {
    std::int32_t to;
    double angle;
  };
  const Csr<Way> ways(names.size(), [&](const auto& visit) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      visit(edges[2 * i], Way{edges[2 * i + 1], mesh.angle(corners[i])});
      visit(edges[2 * i + 1], Way{edges[2 * i], mesh.angle(corners[i])});
    }
  });

  std::vector<double> angles(names.size(), kInfinity);
  using Entry = std::pair<double, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto lower = [&](std::int32_t edge, double to) {
    if (!(to < angles[index(edge)])) return;
    angles[index(edge)] = to;
    queue.emplace(to, edge);
  };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] != corner) continue;
    lower(edges[2 * i], angle);
    lower(edges[2 * i + 1], mesh.angle(corner) - angle);
  }
  while (!queue.empty()) {
    const auto [so_far, edge] = queue.top();
    queue.pop();
    if (so_far > angles[index(edge)]) continue;
    for (const Way& way : ways[edge]) lower(way.to, so_far + way.angle);
  }

  std::vector<CornerAngles> out;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    out.push_back({corners[i], angles[index(edges[2 * i])], angles[index(edges[2 * i + 1])]});
  }
  return out;
}

}  // namespace seamwire::detail
