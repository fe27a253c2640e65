// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/neck_rings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "seam_problems.hpp"
#include "slits/slit_tree.hpp"

namespace seamwire {

using namespace detail;

namespace {

double mean_x(const PlanMesh& mesh, const std::vector<std::int32_t>& loop) {
  double sum = 0.0;
  for (const std::int32_t v : loop) sum += mesh.points[v].x() / mesh.scale;
  return sum / static_cast<double>(loop.size());
}

void expect_closed(const PlanMesh& mesh, const std::vector<std::int32_t>& loop) {
  ASSERT_GE(loop.size(), 3U);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    EXPECT_GE(mesh.edge_between(loop[i], loop[(i + 1) % loop.size()]), 0);
    EXPECT_EQ(std::ranges::count(loop, loop[i]), 1);
  }
}

TEST(NeckRings, AreAtTheNecksOfADumbbell) {
  const SlitProblem problem = problem_on(shapes::dumbbell(16, 32).surface());
  const std::vector<NeckRing> rings = find_necks(problem, {});
  ASSERT_EQ(rings.size(), 2U);
  for (const NeckRing& ring : rings) {
    expect_closed(*problem.mesh, ring.loop);
    EXPECT_TRUE(ring.image.empty());
    EXPECT_NEAR(std::abs(mean_x(*problem.mesh, ring.loop)), 0.5, 0.1);
    EXPECT_GT(ring.narrowness, 1.8);
    EXPECT_NEAR(loop_length(ring.loop, problem.mesh->points) / problem.mesh->scale, 2 * std::numbers::pi * 0.08, 0.1);
    EXPECT_LT(ring.area, 0.3);
  }
  EXPECT_LT(mean_x(*problem.mesh, rings[0].loop) * mean_x(*problem.mesh, rings[1].loop), 0.0);
}

TEST(NeckRings, ComeInPairsOnASymmetricMesh) {
  const SlitProblem problem = problem_on(shapes::dumbbell(16, 32).surface(), {.mirror = 0});
  const std::vector<NeckRing> rings = find_necks(problem, {});
  ASSERT_EQ(rings.size(), 1U);
  const NeckRing& ring = rings.front();
  expect_closed(*problem.mesh, ring.image);
  ASSERT_EQ(ring.image.size(), ring.loop.size());
  for (std::size_t i = 0; i < ring.loop.size(); ++i) {
    EXPECT_EQ(ring.image[i], problem.reflection->images[ring.loop[i]]);
  }
}

TEST(NeckRings, DoNotExistOnABallAndABox) {
  EXPECT_TRUE(find_necks(problem_on(shapes::icosphere(3).surface()), {}).empty());
  EXPECT_TRUE(find_necks(problem_on(shapes::quad_cube(6).surface()), {}).empty());
  EXPECT_TRUE(find_necks(problem_on(shapes::grid(8).surface()), {}).empty());
}

TEST(NeckRings, DoNotCrossKeepOutAreas) {
  // A barred line along the whole dumbbell: every ring would cross it.
  const Surface surface = shapes::dumbbell(16, 32).surface();
  std::vector<double> weights(surface.vertex_count(), 1.0);
  for (std::size_t v = 0; v < weights.size(); ++v) {
    const Vector& point = surface.points()[v];
    if (std::abs(point.z()) < 1e-9 && point.y() >= 0.0) weights[v] = std::numeric_limits<double>::infinity();
  }
  EXPECT_TRUE(find_necks(problem_on(surface, {.weights = weights}), {}).empty());
}

TEST(NeckRings, AsSlitsAreTheRing) {
  const NeckRing ring{.loop = {4, 7, 9, 2, 5}, .image = {14, 17, 19}};
  std::vector<Edge> edges;
  for (const Slit& slit : slits_of(ring)) {
    EXPECT_TRUE(slit.is_needed && slit.image.empty());
    for (std::size_t i = 1; i < slit.path.size(); ++i) edges.push_back({slit.path[i - 1], slit.path[i]});
  }
  EXPECT_EQ(edges, (std::vector<Edge>{{4, 7}, {7, 9}, {9, 2}, {2, 5}, {5, 4}, {14, 17}, {17, 19}, {19, 14}}));
}

}  // namespace
}  // namespace seamwire
