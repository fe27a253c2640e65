// SPDX-License-Identifier: GPL-3.0-or-later
// The snippets of docs/library/maps.md.
#include <Eigen/Geometry>
#include <cstdio>
#include <vector>

#include "mesh.hpp"
#include "seamwire_uv/maps/flatten.hpp"
#include "seamwire_uv/maps/pack.hpp"

using namespace seamwire;

int main() {
  const auto [points, triangles] = sheet();
  const Surface surface(points, triangles);
  //! [flatten]
  std::vector<Edge> cuts;
  for (int j = 0; j < 100; ++j) cuts.push_back({75 * 101 + j, 75 * 101 + j + 1});
  const Flattening flat = flatten(surface, cuts);
  std::printf("energy %g, %zu islands\n", flat.energy, flat.by_island.size());
  //! [flatten]

  //! [pack]
  const Packing packing = pack_islands(flat.uvs, flat.islands);
  const Eigen::Vector2d corner = packing.placements[0] * flat.uvs[0][0].homogeneous();
  std::printf("%g of the square used, a corner at %g %g\n", packing.used, corner.x(), corner.y());
  //! [pack]

  //! [measure]
  const MapReport report = measure_map(surface, flat.uvs, flat.islands);
  std::printf("%zu flipped triangles, %zu overlapping islands\n", report.flipped.size(), report.overlapping.size());
  //! [measure]
}
