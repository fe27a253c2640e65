// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/box_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "shapes.hpp"
#include "surface/point_tree.hpp"
#include "thread_sanitizer.hpp"

namespace seamwire {

using namespace detail;

namespace {

TEST(PointTree, FindsWhatALookAtAllPointsFinds) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
  const auto point = [&] {
    const double x = anywhere(random), y = anywhere(random), z = anywhere(random);
    return Vector(x, y, z);
  };
  for (const double radius : {0.05, 0.3, 3.0}) {
    std::vector<Vector> points(200);
    for (Vector& one : points) one = point();
    points.push_back(points.front());  // of equals the first
    const PointTree tree(points, {});
    for (int i = 0; i < 200; ++i) {
      const Vector to = i == 0 ? points.front() : point();
      std::int32_t nearest = -1;
      double least = radius * radius;
      for (std::size_t k = 0; k < points.size(); ++k) {
        const double distance = (points[k] - to).squaredNorm();
        if (distance < least) {
          least = distance;
          nearest = static_cast<std::int32_t>(k);
        }
      }
      EXPECT_EQ(tree.nearest(to, radius), nearest);
    }
  }
}

TEST(BoxTree, VisitsFewItemsNearAPlace) {
  // Thousands of points are within the radius.
  const std::vector<Vector> points = shapes::icosphere(sized(6, 4)).points;
  BoxTree tree;
  const auto box_of = [&](std::int32_t i) { return Box(points[i]); };
  ASSERT_TRUE(tree.build(points.size(), box_of, [] { return true; }));
  std::size_t visited = 0;
  for (const Vector& point : points) {
    const Vector place(-point.x(), point.y(), point.z());
    tree.visit_near(place, 0.25, BoxTree::kRounded, [&](std::int32_t i, double& least) {
      ++visited;
      least = std::min(least, (points[tree.order[i]] - place).squaredNorm());
    });
  }
  EXPECT_LT(visited, 60 * points.size());
}

TEST(BoxTree, BuiltInOrderKeepsTheOrder) {
  for (const std::int32_t count : {0, 1, 4, 5, 100}) {
    BoxTree tree;
    const auto box_of = [](std::int32_t i) { return Box(Vector(i, 0, 0), Vector(i + 1, 1, 1)); };
    tree.build_in_order(static_cast<std::size_t>(count), box_of);
    std::vector<std::int32_t> visited;
    tree.visit_in(Box(Vector(-1, -1, -1), Vector(200, 2, 2)), [&](std::int32_t i) {
      EXPECT_EQ(tree.order[i], i);
      visited.push_back(i);
      return true;
    });
    std::ranges::sort(visited);
    ASSERT_EQ(visited.size(), static_cast<std::size_t>(count));
    for (std::int32_t i = 0; i < count; ++i) EXPECT_EQ(visited[i], i);
    visited.clear();
    const auto take = [&](std::int32_t i) {
      visited.push_back(i);
      return i != 10;
    };
    EXPECT_EQ(tree.visit_in(Box(Vector(10.5, 0.5, 0.5)), take), count <= 10) << "until it is told to stop";
    EXPECT_EQ(std::ranges::count(visited, 10), count > 10 ? 1 : 0);
    EXPECT_LE(visited.size(), 4U);
  }
}

TEST(BoxTree, IsNotBuiltIfItIsToldToStop) {
  BoxTree tree;
  EXPECT_FALSE(tree.build(
      10, [](std::int32_t) { return Box(Vector(0, 0, 0)); }, [] { return false; }));
}

}  // namespace
}  // namespace seamwire
