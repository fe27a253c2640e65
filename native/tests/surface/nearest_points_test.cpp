// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/nearest_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <stop_token>
#include <vector>

#include "shapes.hpp"
#include "surface/point_segment.hpp"

namespace seamwire {
namespace {

TEST(NearestPoints, OfASquareLieInsideOnSidesAndAtCorners) {
  const std::vector<Vector> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const NearestPoints nearest(points, {{0, 1, 2}, {1, 3, 2}});
  const std::vector<Vector> places{{0.2, 0.3, 2.0}, {0.5, -3.0, 4.0}, {2.0, 2.0, 0.0}, {0.9, 0.8, -1.0}};
  const std::vector<NearestPoint> found = nearest.find(places);
  EXPECT_EQ(found[0].triangle, 0);
  EXPECT_TRUE(found[0].point.isApprox(Vector(0.2, 0.3, 0.0)));
  EXPECT_DOUBLE_EQ(found[0].distance, 2.0);
  EXPECT_EQ(found[1].triangle, 0);
  EXPECT_TRUE(found[1].point.isApprox(Vector(0.5, 0.0, 0.0)));
  EXPECT_DOUBLE_EQ(found[1].distance, 5.0);
  EXPECT_EQ(found[2].triangle, 1);
  EXPECT_TRUE(found[2].point.isApprox(points[3]));
  EXPECT_EQ(found[3].triangle, 1);
  EXPECT_DOUBLE_EQ(found[3].distance, 1.0);
}

/// Sides and middles of all triangles are at least as far away as the point that the tree finds.
TEST(NearestPoints, NoPointOfARandomMeshIsNearer) {
  const shapes::Mesh mesh = shapes::icosphere(3, 0.5);
  const NearestPoints nearest(mesh.points, mesh.triangles);
  std::mt19937 random(3);
  std::normal_distribution<double> coordinate;
  std::vector<Vector> places;
  for (int i = 0; i < 1000; ++i) places.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  const std::vector<NearestPoint> found = nearest.find(places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[found[i].triangle];
    EXPECT_NEAR((found[i].point - places[i]).norm(), found[i].distance, 1e-12);
    const Vector u = mesh.points[b] - mesh.points[a], v = mesh.points[c] - mesh.points[a];
    EXPECT_NEAR(u.cross(v).normalized().dot(found[i].point - mesh.points[a]), 0.0, 1e-12) << "it lies on its triangle";
    for (const Triangle& triangle : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector &p = mesh.points[triangle[k]], &q = mesh.points[triangle[(k + 1) % 3]];
        ASSERT_GE(detail::to_segment(places[i], p, q).norm(), found[i].distance - 1e-12);
      }
      const Vector middle = (mesh.points[triangle[0]] + mesh.points[triangle[1]] + mesh.points[triangle[2]]) / 3.0;
      ASSERT_GE((places[i] - middle).norm(), found[i].distance - 1e-12);
    }
  }
}

TEST(NearestPoints, TrianglesThatFaceAwayDoNotCountUnlessAllDo) {
  const std::vector<Vector> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {1, 0, -1}, {0, 1, -1}};
  const NearestPoints cloth(points, {{0, 1, 2}, {3, 5, 4}});  // upwards, and below it downwards
  const std::vector<Vector> places(3, {0.2, 0.2, 0.5}), normals{{0, 0, 1}, {0, 0, -1}, {0, 0, 0}};
  const std::vector<NearestPoint> found = cloth.find(places, normals);
  EXPECT_EQ(found[0].triangle, 0);
  EXPECT_EQ(found[1].triangle, 1);
  EXPECT_EQ(found[2].triangle, 0);
  EXPECT_EQ(NearestPoints(points, {{0, 1, 2}}).find(places, normals)[1].triangle, 0);
}

TEST(NearestPoints, RoundingMakesNoInsideOfATriangleWithoutArea) {
  const Vector along(0.1, 0.7, 0.9);
  const std::vector<Vector> points{{0, 0, 0}, 7.0 * along, 0.1 * along};
  const std::vector<Vector> places{points[1], points[2], 3.0 * along};
  for (const NearestPoint& found : NearestPoints(points, {{0, 1, 2}}).find(places))
    EXPECT_NEAR(found.distance, 0.0, 1e-12);
}

TEST(NearestPoints, TrianglesWithoutAreaCountAsTheirSidesDo) {
  const std::vector<Vector> points{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {5, 5, 5}};
  const std::vector<Vector> place{{1.5, 1.0, 0.0}}, normal{{0, 0, -1}};
  for (const Triangle& flat : {Triangle{0, 1, 2}, Triangle{0, 1, 1}}) {
    const std::vector<NearestPoint> found = NearestPoints(points, {{3, 3, 3}, flat}).find(place, normal);
    EXPECT_EQ(found[0].triangle, 1);
    EXPECT_TRUE(found[0].point.isApprox(Vector(1.5, 0.0, 0.0)));
  }
}

TEST(NearestPoints, RefuseWrongInputAndCanBeCancelled) {
  const shapes::Mesh mesh = shapes::icosphere(2);
  EXPECT_THROW(NearestPoints(mesh.points, {}), InvalidInput);
  EXPECT_THROW(NearestPoints(mesh.points, {{0, 1, 100000}}), InvalidInput);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(NearestPoints({{0, 0, nan}}, {{0, 0, 0}}), InvalidInput);
  const NearestPoints nearest(mesh.points, mesh.triangles);
  const std::vector<Vector> places(2, Vector::Zero()), wrong{{0, nan, 0}};
  EXPECT_THROW(nearest.find(places, wrong), InvalidInput);
  EXPECT_THROW(nearest.find(wrong), InvalidInput);
  EXPECT_TRUE(nearest.find({}).empty());
  std::stop_source stop;
  stop.request_stop();
  const Task stopped{.stop = stop.get_token(), .progress = {}};
  EXPECT_THROW(nearest.find(places, {}, stopped), Cancelled);
  EXPECT_THROW(NearestPoints(mesh.points, mesh.triangles, stopped), Cancelled);
}

}  // namespace
}  // namespace seamwire
