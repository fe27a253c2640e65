// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>
#include <utility>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "maps/straight_corners.hpp"
#include "seamwire_uv/maps/flatten.hpp"
#include "seamwire_uv/maps/unwrap_mesh.hpp"
#include "surface/real_edges.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// Edges without the vertices that are left out.
std::vector<Edge> edges_in_map(const UnwrapMesh& mesh, std::vector<Edge> edges) {
  std::vector<std::int32_t> onto(mesh.points.size());
  for (std::size_t v = 0; v < onto.size(); ++v) onto[v] = static_cast<std::int32_t>(v);
  for (const auto& left_out : mesh.straight->left_out) {
    onto[mesh.vertices[left_out.corner]] = mesh.vertices[mesh.straight->onto[left_out.corner]];
  }
  for (Edge& edge : edges) edge = ascending(onto[edge[0]], onto[edge[1]]);
  std::erase_if(edges, [](const Edge& edge) { return edge[0] == edge[1]; });
  return edges;
}

/// The seams of the map. A side does not count if only a part of it is a seam. So a seam that ends at a left-out vertex
/// ends before it in the map.
std::vector<Edge> seams_in_map(const UnwrapMesh& mesh, const std::vector<std::uint8_t>& is_chosen) {
  std::set<Edge> partly;
  for (const auto& [corner, ends, share, is_cut] : mesh.straight->left_out) {
    if (!is_cut) partly.insert(ascending(mesh.vertices[ends[0]], mesh.vertices[ends[1]]));
  }
  std::vector<Edge> seams = edges_in_map(mesh, edges_of(mesh, is_chosen, true));
  std::erase_if(seams, [&](const Edge& edge) { return partly.contains(edge); });
  return seams;
}

}  // namespace

FlatIslands flatten_islands(const UnwrapMesh& mesh, const std::vector<std::uint8_t>& is_chosen,
                            const FlattenIslandsOptions& options, const Task& task) {
  check_islands(mesh, is_chosen);
  if (!options.start.empty()) check_corners(mesh, options.start);
  std::vector<Triangle> triangles, of_vertices;
  for (const Triangle& t : mesh.triangles) {
    if (mesh.island(t[0]) >= 0 && is_chosen[mesh.island(t[0])] != 0) triangles.push_back(t);
  }
  triangles = triangles_to_map(mesh, triangles);
  FlattenOptions own{.straighten = options.straighten, .up = options.up};
  for (const Triangle& t : triangles) {
    of_vertices.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
    if (!options.start.empty()) own.start.push_back(uvs_of(t, options.start));
  }
  if (!std::ranges::all_of(own.start, is_placed)) own.start.clear();
  const Surface surface(mesh.points, std::move(of_vertices), edges_in_map(mesh, edges_of(mesh, is_chosen)),
                        part_of(task, 0.0, 0.1));
  const Flattening flat = flatten(surface, seams_in_map(mesh, is_chosen), own, part_of(task, 0.1, 1.0));

  FlatIslands result{.corners = {}, .uvs = {}, .parts = {}, .straight = is_chosen};
  std::vector<std::pair<double, std::size_t>> order;  // the smallest first
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    order.emplace_back(doubled_area(mesh, triangles[t]), t);
    if (!flat.by_island[flat.islands[t]].is_straight) result.straight[mesh.island(triangles[t][0])] = 0;
  }
  std::ranges::sort(order);
  std::vector<std::int32_t> parts(mesh.vertices.size(), -1);
  std::vector<Eigen::Vector2d> uvs(mesh.vertices.size(), Eigen::Vector2d::Zero());
  // A corner of several triangles is where the largest has it: one without area may be anywhere.
  for (const auto& [area, t] : order) {
    for (std::size_t i = 0; i < 3; ++i) {
      uvs[triangles[t][i]] = flat.uvs[t][i];
      parts[triangles[t][i]] = flat.islands[t];
    }
  }
  for (const auto& [corner, ends, share, is_cut] : mesh.straight->left_out) {
    uvs[corner] = uvs[ends[0]] + share * (uvs[ends[1]] - uvs[ends[0]]);
    parts[corner] = parts[mesh.straight->onto[corner]];
  }
  for (std::int32_t c = 0; index(c) < parts.size(); ++c) {
    if (parts[c] < 0) continue;
    result.corners.push_back(c);
    result.uvs.push_back(uvs[c]);
    result.parts.push_back(parts[c]);
  }
  return result;
}

}  // namespace seamwire
