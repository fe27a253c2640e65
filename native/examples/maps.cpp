// SPDX-License-Identifier: GPL-3.0-or-later
// The snippets of docs/library/maps.md.
#include <Eigen/Geometry>
#include <cstdio>
#include <memory>
#include <vector>

#include "mesh.hpp"
#include "seamwire_uv/maps/flatten.hpp"
#include "seamwire_uv/maps/pack.hpp"
#include "seamwire_uv/parts/part_finder.hpp"
#include "seamwire_uv/seams/seam_planner.hpp"

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

  //! [parts]
  const auto [body, body_triangles] = torus();
  const PartFinder finder(std::make_shared<const Surface>(body, body_triangles));
  const Parts parts = finder.find(0.5);
  std::printf("%zu parts, %zu borders\n", parts.count, parts.borders.size());
  //! [parts]

  //! [limbs]
  const PartFinder by_limbs(std::make_shared<const Surface>(body, body_triangles), {.by = PartsBy::kLimbs});
  const Parts limbs = by_limbs.find(0.5);
  std::printf("%zu limbs\n", limbs.count);
  //! [limbs]

  //! [plan]
  const auto [ring, ring_triangles] = torus();
  const SeamPlanner planner(std::make_shared<const Surface>(ring, ring_triangles),
                            {.along = Along::kEdges, .front = Vector(0, 0, 1)});
  const SeamPlan plan = planner.plan({.distortion = 4.5, .steps = 20});
  std::printf("%zu wires, %zu islands, energy %g\n", plan.wires.size(), plan.island_count, plan.energy);
  //! [plan]
}
