// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/straight_corners.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

namespace seamwire::detail {
namespace {

const std::vector<Vector> kPoints{{0, 0, 0}, {1, 0, 0}, {3, 0, 0},  {4, 0, 0},
                                  {4, 2, 0}, {0, 2, 0}, {4, -2, 0}, {0, -2, 0}};
/// Two polygons with the vertices 1 and 2 on their common side, and triangles of their corners.
const std::vector<std::int32_t> kAbove{0, 1, 2, 3, 4, 5}, kBelow{3, 2, 1, 0, 7, 6};
const std::vector<Triangle> kEars{{0, 1, 2}, {0, 2, 3}, {0, 3, 4},  {0, 4, 5},
                                  {6, 7, 8}, {6, 8, 9}, {6, 9, 10}, {6, 10, 11}};

UnwrapMesh mesh_of(const std::vector<std::vector<std::int32_t>>& polygons, const std::vector<Triangle>& triangles,
                   const std::vector<Vector>& points = kPoints) {
  UnwrapArrays arrays;
  arrays.points = points;
  arrays.triangles = triangles;
  for (const auto& polygon : polygons) {
    arrays.vertices.insert(arrays.vertices.end(), polygon.begin(), polygon.end());
    arrays.sizes.push_back(static_cast<std::int32_t>(polygon.size()));
    arrays.islands.push_back(0);
  }
  arrays.edges.resize(arrays.vertices.size(), 0);
  arrays.seams.resize(1, 0);
  return UnwrapMesh(arrays);
}

std::map<std::int32_t, std::int32_t> left_out(const UnwrapMesh& mesh) {
  std::map<std::int32_t, std::int32_t> found;
  for (const auto& each : mesh.straight->left_out) {
    found[each.corner] = mesh.straight->onto[each.corner];
  }
  return found;
}

std::vector<Triangle> in_order(std::vector<Triangle> triangles) {
  for (Triangle& triangle : triangles) std::ranges::sort(triangle);
  std::ranges::sort(triangles);
  return triangles;
}

TEST(StraightCorners, VerticesBetweenTwoPolygonsFallOnTheNearerEndInBoth) {
  const UnwrapMesh mesh = mesh_of({kAbove, kBelow}, kEars);
  EXPECT_EQ(left_out(mesh), (std::map<std::int32_t, std::int32_t>{{1, 0}, {2, 3}, {7, 6}, {8, 9}}));
  EXPECT_EQ(triangles_to_map(mesh, kEars), (std::vector<Triangle>{{0, 3, 4}, {0, 4, 5}, {6, 9, 10}, {6, 10, 11}}));
}

TEST(StraightCorners, BentVerticesAndThoseOfOtherEdgesStay) {
  std::vector<Vector> bent = kPoints;
  bent[1].y() = bent[2].y() = 0.1;
  EXPECT_TRUE(left_out(mesh_of({kAbove, kBelow}, kEars, bent)).empty());
  // Three polygons meet at vertex 1.
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4},  {0, 4, 5},
                                        {6, 7, 8}, {6, 8, 9}, {6, 9, 10}, {11, 12, 13}};
  EXPECT_EQ(left_out(mesh_of({kAbove, {3, 2, 1, 7, 6}, {0, 7, 1}}, triangles)),
            (std::map<std::int32_t, std::int32_t>{{2, 3}, {7, 6}}));
}

TEST(StraightCorners, APolygonThatWouldLoseAllTrianglesKeepsItsCorners) {
  const std::vector<Triangle> triangles{{0, 1, 2}, {3, 4, 5}, {3, 5, 6}, {3, 6, 7}};
  EXPECT_TRUE(left_out(mesh_of({{0, 1, 3}, {3, 1, 0, 7, 6}}, triangles)).empty());
  EXPECT_TRUE(left_out(mesh_of({{0, 1, 3}}, {{0, 0, 1}})).empty()) << "a triangle with a corner twice";
}

TEST(StraightCorners, AStraightCornerGetsTheTriangleWithItsNeighbors) {
  const std::vector<Triangle> triangles{{0, 1, 3}, {1, 2, 3}};
  const UnwrapMesh mesh = mesh_of({{0, 1, 3, 4}}, triangles);
  const std::vector<Triangle> in_map = triangles_to_map(mesh, triangles);
  EXPECT_EQ(in_order(in_map), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  for (const auto& [a, b, c] : in_map) {
    const Vector one = point_of(mesh, b) - point_of(mesh, a), two = point_of(mesh, c) - point_of(mesh, a);
    EXPECT_GE(one.cross(two).z(), 0.0);
  }
}

TEST(StraightCorners, PolygonsWithoutStraightCornersKeepTheirTriangles) {
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(triangles_to_map(mesh_of({{0, 3, 4, 5}}, triangles), triangles), triangles);
}

}  // namespace
}  // namespace seamwire::detail
