// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "chains.hpp"
#include "shapes.hpp"

namespace seamwire::chains {
namespace {

TEST(EdgeLoop, IsTheRingOnACylinderAndATorus) {
  const Surface cylinder = shapes::quad_cylinder(24, 10).surface();
  const EdgeChain ring = shortest_cycle(*plain_graph(cylinder), {24 * 4 + 7, 24 * 4 + 8}).value();
  Chain expected;
  for (int i = 0; i < 24; ++i) expected.push_back(24 * 4 + i);
  EXPECT_TRUE(same_loop(ring.vertices, expected));
  EXPECT_NEAR(ring.length, 24 * plain_length(cylinder, 0, 1), kRounding);

  const Surface torus = shapes::quad_torus(20, 12).surface();
  const auto graph = plain_graph(torus);
  Chain around_axis, around_tube;
  for (int i = 0; i < 20; ++i) around_axis.push_back(20 * 3 + i);
  for (int j = 0; j < 12; ++j) around_tube.push_back(20 * j + 5);
  EXPECT_TRUE(same_loop(shortest_cycle(*graph, {65, 66})->vertices, around_axis));
  EXPECT_TRUE(same_loop(shortest_cycle(*graph, {65, 85})->vertices, around_tube));
}

TEST(EdgeLoop, IsTheBoundaryOfAnOpenCylinder) {
  const Surface cylinder = shapes::quad_cylinder(24, 10).surface();
  const EdgeChain ring = shortest_cycle(*plain_graph(cylinder), {0, 23}).value();
  EXPECT_EQ(ring.vertices.size(), 24u);
  EXPECT_TRUE(std::ranges::all_of(ring.vertices, [](std::int32_t v) { return v < 24; }));
}

TEST(EdgeLoop, PaysForItsTurns) {
  const Surface grid = shapes::quad_grid(40).surface();
  // In the middle of a wide plane nothing is cheaper than once around a quad: four edges and four right angles.
  const EdgeChain square = shortest_cycle(*plain_graph(grid), {41 * 20 + 20, 41 * 20 + 21}, 20.0).value();
  EXPECT_EQ(square.vertices.size(), 4u);
  EXPECT_NEAR(square.length, (4 + 4 * 20.0) / 40, kRounding);
  // Near a boundary, which costs no turn, it is cheaper to go there and back along it.
  const Surface small = shapes::quad_grid(9).surface();
  EXPECT_NEAR(shortest_cycle(*plain_graph(small), {44, 45}, 20.0)->length, (26 + 2 * 20.0) / 9, kRounding);
}

TEST(EdgeLoop, IsThereForNoBridge) {
  // A triangle with a tail of loose edges.
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1, 2}},
                        std::vector<Edge>{{0, 1}, {1, 2}, {0, 2}, {1, 3}, {3, 4}});
  const auto graph = plain_graph(surface);
  EXPECT_FALSE(shortest_cycle(*graph, {1, 3}));
  EXPECT_FALSE(shortest_cycle(*graph, {3, 4}));
  EXPECT_EQ(sorted(shortest_cycle(*graph, {0, 2})->vertices), Chain({0, 1, 2}));
}

TEST(EdgeLoop, IsTheCheapestOfAllOnSmallMeshes) {
  constexpr double kTurning = 20.0;
  int loops = 0, dearer = 0;
  const auto compare = [&](const Surface& surface) {
    const Table table(surface);
    for (const Edge& edge : surface.edges()) {
      const EdgeChain loop = shortest_cycle(*table.graph(), edge, kTurning).value();
      ASSERT_GE(loop.vertices.size(), 3u);
      ASSERT_FALSE(has_repeated_vertex(loop.vertices));
      ASSERT_EQ(loop.vertices[0], edge[0]);
      ASSERT_EQ(loop.vertices[1], edge[1]);
      ASSERT_NEAR(loop.length, table.loop_cost(loop.vertices, kTurning), kTableRounding);
      const double cheapest = table.cheapest_loop(edge, kTurning, loop.length + 1);
      EXPECT_GE(loop.length, cheapest - kTableRounding);
      ++loops;
      dearer += loop.length > cheapest + kTableRounding;
    }
  };
  for (unsigned seed = 1; seed <= 3; ++seed) compare(shapes::grid(3, 0.4, seed).surface());
  compare(shapes::icosphere(1).surface());
  compare(shapes::quad_cylinder(5, 3).surface());
  compare(shapes::quad_cube(2).surface());
  EXPECT_GT(loops, 200);
  EXPECT_LT(dearer, loops / 50);  // NP-hard, as for wires
}

}  // namespace
}  // namespace seamwire::chains
