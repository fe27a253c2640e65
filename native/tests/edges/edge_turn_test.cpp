// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "chains.hpp"
#include "shapes.hpp"

namespace seamwire::chains {
namespace {

constexpr double kPi = std::numbers::pi;

/// Corners of n triangles around vertex 0 in the plane, at the given angles.
Surface flat_fan(const std::vector<double>& angles, bool closed) {
  shapes::Mesh mesh;
  mesh.points.emplace_back(0, 0, 0);
  for (const double a : angles) mesh.points.emplace_back(std::cos(a), std::sin(a), 0);
  const auto n = static_cast<std::int32_t>(angles.size());
  for (std::int32_t i = 1; i < n; ++i) mesh.triangles.push_back({0, i, i + 1});
  if (closed) mesh.triangles.push_back({0, n, 1});
  return mesh.surface();
}

TEST(EdgeTurn, IsZeroStraightAheadAndARightAngleAsideInAQuadGrid) {
  const Surface surface = shapes::quad_grid(4).surface();
  // Vertex 12 is the middle; diagonals of the quads run through it on one side only and must not count.
  EXPECT_NEAR(turn(surface, 11, 12, 13), 0.0, kTurnRounding);
  EXPECT_NEAR(turn(surface, 7, 12, 17), 0.0, kTurnRounding);
  EXPECT_NEAR(turn(surface, 11, 12, 17), 1.0, kTurnRounding);
  EXPECT_NEAR(turn(surface, 11, 12, 7), 1.0, kTurnRounding);
}

TEST(EdgeTurn, ComparesTheAnglesOnBothSidesAtAnIrregularVertex) {
  std::vector<double> angles;
  for (int i = 0; i < 5; ++i) angles.push_back(2 * kPi * i / 5);
  const Surface five = flat_fan(angles, true);
  EXPECT_NEAR(turn(five, 1, 0, 2), 1 - std::cos(kPi * (288.0 - 72.0) / 360.0), kTurnRounding);
  EXPECT_NEAR(turn(five, 1, 0, 3), 1 - std::cos(kPi * (216.0 - 144.0) / 360.0), kTurnRounding);

  // Any angles: 0, 50, 170, 200 degrees.
  const Surface uneven = flat_fan({0, 50 * kPi / 180, 170 * kPi / 180, 200 * kPi / 180}, true);
  EXPECT_NEAR(turn(uneven, 2, 0, 4), 1 - std::cos(kPi * (210.0 - 150.0) / 360.0), kTurnRounding);
}

TEST(EdgeTurn, IsMeasuredOnTheSurfaceNotInSpace) {
  const shapes::QuadMesh cube = shapes::quad_cube(2);
  const Surface surface = cube.surface();
  const auto number = [&](double x, double y, double z) {
    const auto it = std::ranges::find_if(cube.points, [&](const Vector& p) { return p == Vector(x, y, z); });
    return static_cast<std::int32_t>(it - cube.points.begin());
  };
  // Over the middle of a cube's edge from one side onto the next: bent in space, straight on the surface.
  EXPECT_NEAR(turn(surface, number(0.5, 0.5, 0), number(0.5, 0, 0), number(0.5, 0, 0.5)), 0.0, kTurnRounding);
  // At a corner three right angles meet: 90 degrees on one side, 180 on the other.
  EXPECT_NEAR(turn(surface, number(0.5, 0, 0), number(0, 0, 0), number(0, 0.5, 0)), 1 - std::cos(kPi / 3),
              kTurnRounding);
}

TEST(EdgeTurn, IsZeroAlongABoundaryAndPiMinusTheAngleWhenLeavingIt) {
  const Surface grid = shapes::quad_grid(4).surface();
  EXPECT_NEAR(turn(grid, 1, 2, 3), 0.0, kTurnRounding);
  EXPECT_NEAR(turn(grid, 1, 0, 5), 0.0, kTurnRounding) << "round the square's corner";
  EXPECT_NEAR(turn(grid, 1, 2, 7), 1.0, kTurnRounding);
  EXPECT_NEAR(turn(grid, 7, 2, 3), 1.0, kTurnRounding);

  const auto degrees = [](double d) { return d * kPi / 180; };
  const Surface open = flat_fan({0, degrees(40), degrees(110), degrees(250)}, false);
  EXPECT_NEAR(turn(open, 1, 0, 4), 0.0, kTurnRounding);
  EXPECT_NEAR(turn(open, 1, 0, 3), 1 - std::cos(degrees(70)), kTurnRounding);
  EXPECT_NEAR(turn(open, 4, 0, 2), 1 - std::cos(degrees(30)), kTurnRounding);
  EXPECT_NEAR(turn(open, 2, 0, 3), 1 - std::cos(degrees(110)), kTurnRounding);
}

TEST(EdgeTurn, IsTakenInSpaceWhereAnEdgeHasThreeFaces) {
  // Three pages, at 0, 90 and 180 degrees, on a spine of two edges 0 - 1 - 2.
  shapes::QuadMesh book;
  for (int i = 0; i < 3; ++i) book.points.emplace_back(0, 0, i);
  const Vector out[] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  for (const Vector& direction : out) {
    const auto first = static_cast<std::int32_t>(book.points.size());
    for (int i = 0; i < 3; ++i) book.points.push_back(direction + Vector(0, 0, i));
    book.quads.push_back({0, 1, first + 1, first});
    book.quads.push_back({1, 2, first + 2, first + 1});
  }
  const Surface surface = book.surface();
  ASSERT_EQ(surface.report().nonmanifold_edges.size(), 2u);
  EXPECT_NEAR(turn(surface, 0, 1, 2), 0.0, kTurnRounding);
  EXPECT_NEAR(turn(surface, 4, 1, 10), 0.0, kTurnRounding) << "from the first page straight onto the third";
  EXPECT_NEAR(turn(surface, 4, 1, 7), 1.0, kTurnRounding);
  EXPECT_NEAR(turn(surface, 0, 1, 4), 1.0, kTurnRounding);
}

TEST(EdgeTurn, IsTakenInSpaceAtABowTieAndAlongLooseEdges) {
  // Two triangles that share vertex 0, and a loose edge from it to 5 and on to 6.
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 1, 1}},
                        {{0, 1, 2}, {0, 3, 4}},
                        std::vector<Edge>{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {3, 4}, {0, 4}, {0, 5}, {5, 6}});
  EXPECT_NEAR(turn(surface, 1, 0, 3), 0.0, kTurnRounding);
  EXPECT_NEAR(turn(surface, 2, 0, 3), 1.0, kTurnRounding);
  EXPECT_NEAR(turn(surface, 1, 0, 5), 1.0, kTurnRounding);
  EXPECT_NEAR(turn(surface, 0, 5, 6), 1.0, kTurnRounding);
  EXPECT_EQ(edge_wires(plain_graph(surface), {2, -1}).trace({5, 6})->vertices, Chain({2, 0, 5, 6}));
}

}  // namespace
}  // namespace seamwire::chains
