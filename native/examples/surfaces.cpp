// SPDX-License-Identifier: GPL-3.0-or-later
// The snippets of docs/library/surfaces.md.
#include <cassert>
#include <cstdio>
#include <vector>

#include "mesh.hpp"
#include "seamwire/files/mesh_file.hpp"
#include "seamwire/surface/nearest_points.hpp"
#include "seamwire/surface/ray_tree.hpp"
#include "seamwire/surface/segments.hpp"
#include "seamwire/surface/surface.hpp"

using namespace seamwire;

int main() {
  const auto [points, triangles] = sheet();
  //! [surface]
  const Surface surface(points, triangles);
  std::printf("%zu vertices, %zu triangles, %zu edges\n", surface.vertex_count(), surface.face_count(),
              surface.edges().size());
  //! [surface]

  //! [files]
  const std::vector<Vector> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  write_mesh("quad.ply", {.points = square, .corners = {0, 1, 2, 3}, .sizes = {4}, .colors = {}});
  const Surface quad = make_surface(read_mesh("quad.ply"));
  //! [files]
  std::printf("%zu edges\n", quad.edges().size());

  //! [report]
  const Surface fin({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {0.5, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  for (const auto& [a, b] : fin.report().nonmanifold_edges) std::printf("three faces at edge %d-%d\n", a, b);
  //! [report]

  //! [islands]
  std::vector<Edge> cuts;
  for (int j = 0; j < 100; ++j) cuts.push_back({75 * 101 + j, 75 * 101 + j + 1});  // the middle column of the grid
  const std::vector<std::int32_t> segments = face_segments(surface, cuts);
  //! [islands]
  std::printf("the last triangle is in segment %d\n", segments.back());

  //! [rays]
  const RayTree rays(points, triangles);
  const RayHit hit = rays.first_hit({0, 0, 9}, {0, 0, -1});
  std::printf("triangle %d at distance %g\n", hit.triangle, hit.distance);
  //! [rays]

  //! [nearest]
  const NearestPoints nearest(points, triangles);
  const std::vector<Vector> places{{0, 0, 9}, {2, 0, 0}};
  for (const NearestPoint& found : nearest.find(places))
    std::printf("triangle %d at distance %g\n", found.triangle, found.distance);
  //! [nearest]
}
