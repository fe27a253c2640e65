// SPDX-License-Identifier: GPL-3.0-or-later
// The snippets of docs/library/seams.md.
#include <cstdio>
#include <memory>

#include "mesh.hpp"
#include "seamwire/surface/segments.hpp"
#include "seamwire_uv/parts/part_finder.hpp"
#include "seamwire_uv/seams/missing_cuts.hpp"
#include "seamwire_uv/seams/seam_planner.hpp"

using namespace seamwire;

int main() {
  //! [missing]
  const auto [closed, closed_triangles] = torus();
  const Surface uncut(closed, closed_triangles);
  std::printf("%d cuts\n", missing_cuts(uncut, {}, face_segments(uncut, {}))[0]);
  //! [missing]

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
