// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/maps/unwrap_mesh.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "detail/index.hpp"
#include "maps/straight_corners.hpp"
#include "seamwire/errors.hpp"

namespace seamwire {

using namespace detail;

namespace {

void check_fit(const char* what, std::size_t size, std::size_t count, const char* kind) {
  if (size == count) return;
  throw InvalidInput(std::string(what) + " has " + std::to_string(size) + " items: there are " + std::to_string(count) +
                     " " + kind);
}

}  // namespace

UnwrapMesh::UnwrapMesh(UnwrapArrays arrays) : UnwrapArrays(std::move(arrays)) {
  const std::size_t count = vertices.size();
  check_fit("edges", edges.size(), count, "corners");
  check_fit("islands", islands.size(), sizes.size(), "polygons");
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!points[v].allFinite()) throw InvalidInput("point " + std::to_string(v) + " is not finite");
  }
  for (std::size_t p = 0; p < sizes.size(); ++p) {
    const auto first = static_cast<std::int32_t>(polygons.size());
    if (sizes[p] < 1 || index(sizes[p]) > count - polygons.size()) {
      throw InvalidInput("polygon " + std::to_string(p) + " has a wrong size");
    }
    for (std::int32_t i = 0; i < sizes[p]; ++i) {
      polygons.push_back(static_cast<std::int32_t>(p));
      following.push_back(first + (i + 1) % sizes[p]);
      preceding.push_back(first + (i + sizes[p] - 1) % sizes[p]);
    }
    if (islands[p] >= 0) check_index(islands[p], sizes.size(), "islands: island", "polygons");
    island_count = std::max(island_count, index(islands[p] + 1));
  }
  if (polygons.size() != count) throw InvalidInput("sizes do not add up to the number of corners");
  std::vector<std::array<std::int32_t, 3>> at_edge(seams.size(), {-1, -1, 0});  // two corners and how many there are
  for (std::int32_t c = 0; index(c) < count; ++c) {
    check_index(vertices[c], points.size(), "vertices: vertex");
    check_index(edges[c], seams.size(), "edges: edge", "edges");
    if (island(c) < 0) continue;
    std::array<std::int32_t, 3>& own = at_edge[edges[c]];
    if (own[2] < 2) own[static_cast<std::size_t>(own[2])] = c;
    ++own[2];
  }
  for (const auto& [one, two, uses] : at_edge) {
    if (uses == 2) joints.emplace_back(one, two);
  }
  for (const auto& [a, b, c] : triangles) {
    for (const std::int32_t corner : {a, b, c}) check_index(corner, count, "triangles: corner", "corners");
    if (polygons[a] == polygons[b] && polygons[a] == polygons[c]) continue;
    throw InvalidInput("triangles: a triangle has corners of several polygons");
  }
  straight = std::make_shared<StraightCorners>(find_straight_corners(*this));
}

void detail::check_corners(const UnwrapMesh& mesh, const std::vector<Eigen::Vector2d>& uvs) {
  check_fit("uvs", uvs.size(), mesh.vertices.size(), "corners");
}

void detail::check_islands(const UnwrapMesh& mesh, const std::vector<std::uint8_t>& flags) {
  check_fit("is_chosen", flags.size(), mesh.island_count, "islands");
}

std::vector<Edge> detail::edges_of(const UnwrapMesh& mesh, const std::vector<std::uint8_t>& is_chosen,
                                   bool only_seams) {
  std::vector<Edge> found;
  for (std::int32_t c = 0; index(c) < mesh.vertices.size(); ++c) {
    const std::int32_t island = mesh.island(c), v = mesh.vertices[c], next = mesh.vertices[mesh.following[c]];
    if (island < 0 || is_chosen[island] == 0 || v == next) continue;
    if (!only_seams || mesh.seams[mesh.edges[c]] != 0) found.push_back({v, next});
  }
  return found;
}

}  // namespace seamwire
