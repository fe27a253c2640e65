// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/polygon_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "detail/drop_repeats.hpp"
#include "seamwire/errors.hpp"
#include "seamwire/surface/triangulate.hpp"
#include "surface/check_polygons.hpp"

namespace seamwire {

void check(const PolygonMesh& mesh) {
  detail::check_polygons(mesh.points.size(), mesh.corners, mesh.sizes);
  if (mesh.colors.empty() || mesh.colors.size() == mesh.points.size()) return;
  throw InvalidInput("colors: there are " + std::to_string(mesh.colors.size()) + " for " +
                     std::to_string(mesh.points.size()) + " points");
}

std::vector<Edge> polygon_edges(const PolygonMesh& mesh) {
  check(mesh);
  std::vector<Edge> edges;
  edges.reserve(mesh.corners.size());
  const std::int32_t* corner = mesh.corners.data();
  for (const std::int32_t size : mesh.sizes) {
    for (std::int32_t i = 0; i < size; ++i) {
      const auto [a, b] = std::minmax(corner[i], corner[i + 1 < size ? i + 1 : 0]);
      if (a != b) edges.push_back({a, b});
    }
    corner += size;
  }
  std::ranges::sort(edges);
  detail::drop_repeats(edges);
  return edges;
}

Surface make_surface(const PolygonMesh& mesh, const Task& task) {
  std::vector<Edge> edges = polygon_edges(mesh);
  return {mesh.points, triangulate(mesh.points, mesh.corners, mesh.sizes).triangles, std::move(edges), task};
}

}  // namespace seamwire
