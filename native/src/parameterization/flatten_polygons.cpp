// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/parameterization/flatten_polygons.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "parameterization/overlaps.hpp"
#include "parameterization/straight_corners.hpp"
#include "seamwire/parameterization/flatten.hpp"
#include "surface/real_edges.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// The vertices of a map, with numbers of their own, and without corners that are left out.
class MapVertices {
 public:
  MapVertices(const UnwrapMesh& mesh, const std::vector<Triangle>& triangles)
      : number_(mesh.arrays().points.size(), -1) {
    const std::vector<std::int32_t>& vertices = mesh.arrays().vertices;
    for (const Triangle& t : triangles) {
      for (const std::int32_t c : t) number_[vertices[c]] = 0;
    }
    for (std::size_t v = 0; v < number_.size(); ++v) {
      if (number_[v] < 0) continue;
      number_[v] = static_cast<std::int32_t>(points_.size());
      points_.push_back(mesh.arrays().points[v]);
    }
    for (const Triangle& t : triangles) {
      triangles_.push_back({number_[vertices[t[0]]], number_[vertices[t[1]]], number_[vertices[t[2]]]});
    }
    onto_.resize(number_.size());
    for (std::size_t v = 0; v < onto_.size(); ++v) onto_[v] = static_cast<std::int32_t>(v);
    for (const auto& left_out : straight_corners(mesh).left_out) {
      onto_[vertices[left_out.corner]] = vertices[straight_corners(mesh).onto[left_out.corner]];
    }
  }

  const std::vector<Vector>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// The edges of the mesh that the map has.
  std::vector<Edge> own(const std::vector<Edge>& edges) const {
    std::vector<Edge> found;
    for (const auto& [a, b] : edges) {
      const Edge edge = ascending(number_[onto_[a]], number_[onto_[b]]);
      if (edge[0] >= 0 && edge[0] != edge[1]) found.push_back(edge);
    }
    return found;
  }

 private:
  std::vector<std::int32_t> number_, onto_;  // of each vertex of the mesh
  std::vector<Vector> points_;
  std::vector<Triangle> triangles_;
};

/// The seams of the map: a side that only a part of is a seam is none. A seam that ends at a vertex that is left out
/// ends before it in the map.
std::vector<Edge> seams_in_map(const UnwrapMesh& mesh, const MapVertices& vertices,
                               const std::vector<std::uint8_t>& is_chosen) {
  std::vector<Edge> seams, partly;
  for (std::int32_t c = 0; index(c) < mesh.corner_count(); ++c) {
    const std::int32_t island = mesh.island(c);
    if (island < 0 || is_chosen[island] == 0 || mesh.arrays().seams[mesh.arrays().edges[c]] == 0) continue;
    seams.push_back({mesh.arrays().vertices[c], mesh.arrays().vertices[mesh.following(c)]});
  }
  for (const auto& left_out : straight_corners(mesh).left_out) {
    const auto& [low, high] = left_out.ends;
    if (!left_out.is_cut) partly.push_back({mesh.arrays().vertices[low], mesh.arrays().vertices[high]});
  }
  seams = vertices.own(seams);
  const std::vector<Edge> not_cut = vertices.own(partly);
  const std::set<Edge> excluded(not_cut.begin(), not_cut.end());
  std::erase_if(seams, [&](const Edge& edge) { return excluded.contains(edge); });
  return seams;
}

}  // namespace

FlatPolygons flatten_polygons(const UnwrapMesh& mesh, const std::vector<std::uint8_t>& is_chosen,
                              const std::vector<Eigen::Vector2d>& start, std::optional<double> straighten,
                              std::optional<Vector> up, const Task& task) {
  if (is_chosen.size() != mesh.island_count()) {
    throw InvalidInput("is_chosen has " + std::to_string(is_chosen.size()) + " items: there are " +
                       std::to_string(mesh.island_count()) + " islands");
  }
  if (!start.empty()) check_uvs(mesh, start);
  std::vector<Triangle> triangles;
  for (const Triangle& t : mesh.arrays().triangles) {
    if (mesh.island(t[0]) >= 0 && is_chosen[mesh.island(t[0])] != 0) triangles.push_back(t);
  }
  triangles = triangles_to_map(mesh, triangles);
  const MapVertices vertices(mesh, triangles);
  FlattenOptions options{.straighten = straighten, .up = up};
  for (const Triangle& t : triangles) {
    if (!start.empty()) options.start.push_back(uvs_of(t, start));
  }
  if (!std::ranges::all_of(options.start, is_placed)) options.start.clear();
  const Surface surface(vertices.points(), vertices.triangles(), vertices.own(visible_edges(mesh, is_chosen)),
                        part_of(task, 0.0, 0.1));
  const Flattening flat = flatten(surface, seams_in_map(mesh, vertices, is_chosen), options, part_of(task, 0.1, 1.0));

  FlatPolygons result{.corners = {}, .uvs = {}, .islands = {}, .straight = is_chosen};
  std::vector<std::pair<double, std::size_t>> order;  // the smallest first
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    order.emplace_back(doubled_area(mesh, triangles[t]), t);
    if (!flat.by_island[flat.islands[t]].is_straight) result.straight[mesh.island(triangles[t][0])] = 0;
  }
  std::ranges::sort(order);
  std::vector<std::int32_t> islands(mesh.corner_count(), -1);
  std::vector<Eigen::Vector2d> uvs(mesh.corner_count(), Eigen::Vector2d::Zero());
  // A corner of several triangles is where the largest has it: one without area may be anywhere.
  for (const auto& [area, t] : order) {
    for (std::size_t i = 0; i < 3; ++i) {
      uvs[triangles[t][i]] = flat.uvs[t][i];
      islands[triangles[t][i]] = flat.islands[t];
    }
  }
  const std::vector<Eigen::Vector2d> kept = uvs;
  for (const auto& [corner, ends, share, is_cut] : straight_corners(mesh).left_out) {
    uvs[corner] = kept[ends[0]] + share * (kept[ends[1]] - kept[ends[0]]);
    islands[corner] = islands[straight_corners(mesh).onto[corner]];
  }
  for (std::int32_t c = 0; index(c) < mesh.corner_count(); ++c) {
    if (islands[c] < 0) continue;
    result.corners.push_back(c);
    result.uvs.push_back(uvs[c]);
    result.islands.push_back(islands[c]);
  }
  return result;
}

}  // namespace seamwire
