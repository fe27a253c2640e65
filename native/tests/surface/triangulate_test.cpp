// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/triangulate.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace seamwire {
namespace {

using Numbers = std::vector<std::int32_t>;

const std::vector<Vector> kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(Triangulation, KeepsTrianglesAndCutsQuadsFromTheFirstCornerToTheThird) {
  const Triangulation cut = triangulate(kSquare, Numbers{0, 1, 2, 0, 1, 2, 3, 1, 2, 3}, Numbers{3, 4, 3});
  EXPECT_EQ(cut.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {1, 2, 3}}));
  EXPECT_EQ(cut.polygons, (Numbers{0, 1, 1, 2}));
}

TEST(Triangulation, CutsAQuadThatIsBentInAtThatCornerWhicheverItIs) {
  for (std::size_t bent = 0; bent < 4; ++bent) {
    std::vector<Vector> points = kSquare;
    points[bent] = Vector(0.5, 0.5, 0) - 0.4 * (points[bent] - Vector(0.5, 0.5, 0));
    const Triangulation cut = triangulate(points, Numbers{0, 1, 2, 3}, Numbers{4});
    double area = 0;
    for (const auto& [a, b, c] : cut.triangles) {
      const auto at = [&](std::int32_t v) { return points[static_cast<std::size_t>(v)]; };
      const double part = 0.5 * (at(b) - at(a)).cross(at(c) - at(a)).z();
      EXPECT_GT(part, 0) << "corner " << bent;
      area += part;
    }
    EXPECT_NEAR(area, 0.3, 1e-12) << "corner " << bent;  // half the square, less 0.4 times as much
  }
}

TEST(Triangulation, LeavesNoTriangleWithoutAreaWhereACornerLiesBetweenTwoOthers) {
  const std::vector<Vector> triangle = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  for (std::size_t start = 0; start < 4; ++start) {
    std::vector<Vector> points = {triangle[0], {1, 1e-6, 0}, triangle[1], triangle[2]};
    std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(start), points.end());
    for (const auto& [a, b, c] : triangulate(points, Numbers{0, 1, 2, 3}, Numbers{4}).triangles) {
      const auto at = [&](std::int32_t v) { return points[static_cast<std::size_t>(v)]; };
      EXPECT_GT((at(b) - at(a)).cross(at(c) - at(a)).z(), 1.0) << "from corner " << start;
    }
  }
}

TEST(Triangulation, CutsASquareOfNoSizeAndNothingAtAll) {
  EXPECT_EQ(triangulate(std::vector<Vector>(4, Vector::Zero()), Numbers{0, 1, 2, 3}, Numbers{4}).triangles.size(), 2);
  EXPECT_TRUE(triangulate({}, {}, {}).triangles.empty());
}

/// Twice the sum of the areas, and the smallest area, of a flat polygon's triangles.
std::pair<double, double> areas_of(const std::vector<Vector>& points, const Vector& up) {
  Numbers corners(points.size());
  std::iota(corners.begin(), corners.end(), 0);
  double sum = 0, least = 1e9;
  const Triangulation cut = triangulate(points, corners, Numbers{static_cast<std::int32_t>(points.size())});
  EXPECT_EQ(cut.triangles.size(), points.size() - 2);
  for (const auto& [a, b, c] : cut.triangles) {
    const auto at = [&](std::int32_t v) { return points[static_cast<std::size_t>(v)]; };
    const double area = (at(b) - at(a)).cross(at(c) - at(a)).dot(up);
    sum += area;
    least = std::min(least, area);
  }
  return {sum, least};
}

TEST(Triangulation, CutsLargerPolygonsWithDents) {
  // A comb, a star and a spiral, in several planes and from either side.
  std::vector<Eigen::Vector2d> comb = {{0, 0}, {5, 0}, {5, 3}}, star;
  for (const double x : {4.0, 3.0, 2.0, 1.0}) {
    comb.insert(comb.end(), {{x + 0.5, 1}, {x, 3}});
  }
  for (int i = 0; i < 24; ++i) {
    const double angle = i * std::numbers::pi / 12, r = i % 2 == 0 ? 2.0 : 0.3;
    star.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  for (const std::vector<Eigen::Vector2d>& shape : {comb, star}) {
    double area = 0;
    for (std::size_t i = 0; i < shape.size(); ++i) {
      const Eigen::Vector2d &a = shape[i], &b = shape[(i + 1) % shape.size()];
      area += a.x() * b.y() - a.y() * b.x();
    }
    for (const Eigen::AngleAxisd& turn :
         {Eigen::AngleAxisd(0.0, Vector::UnitX()), Eigen::AngleAxisd(2.0, Vector::UnitX()),
          Eigen::AngleAxisd(3.1, Vector(1, 1, 0).normalized())}) {
      std::vector<Vector> points;
      for (const Eigen::Vector2d& p : shape) points.push_back(turn * Vector(p.x(), p.y(), 0));
      for (std::size_t start = 0; start < points.size(); start += 5) {
        std::rotate(points.begin(), points.begin() + 1, points.end());
        const auto [sum, least] = areas_of(points, turn * Vector::UnitZ());
        EXPECT_NEAR(sum, area, 1e-9);
        EXPECT_GT(least, 0.0);
      }
    }
  }
}

TEST(Triangulation, CutsPolygonsWithAHoleThatAnEdgeJoins) {
  // A square with a square hole. The border goes to the hole and back along one edge, as in files of CAD programs.
  const std::vector<Vector> points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0},
                                      {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}};
  const Numbers border = {0, 1, 2, 3, 0, 4, 5, 6, 7, 4};
  const Triangulation cut = triangulate(points, border, Numbers{10});
  ASSERT_EQ(cut.triangles.size(), 8);
  double sum = 0;
  for (const auto& [a, b, c] : cut.triangles) {
    const auto at = [&](std::int32_t v) { return points[static_cast<std::size_t>(v)]; };
    const double area = 0.5 * (at(b) - at(a)).cross(at(c) - at(a)).z();
    EXPECT_GT(area, 0.0);
    sum += area;
  }
  EXPECT_NEAR(sum, 12.0, 1e-12);
}

TEST(Triangulation, CutsAnyPolygonIntoTrianglesEvenOneThatCrossesItself) {
  const std::vector<Vector> bow = {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}, {-1, 1, 0}};
  EXPECT_EQ(triangulate(bow, Numbers{0, 1, 2, 3, 4}, Numbers{5}).triangles.size(), 3);
  EXPECT_EQ(triangulate(std::vector<Vector>(6, Vector::Zero()), Numbers{0, 1, 2, 3, 4, 5}, Numbers{6}).triangles.size(),
            4);
  EXPECT_EQ(triangulate(kSquare, Numbers{0, 1, 1, 2, 3, 0}, Numbers{6}).triangles.size(), 4);
}

TEST(Triangulation, SaysWhatIsWrong) {
  const auto said = [](const Numbers& corners, const Numbers& sizes) -> std::string {
    try {
      triangulate(kSquare, corners, sizes);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(said({0, 1, 2, 4}, {4}), "corners: vertex 4 is out of range: there are 4 points");
  EXPECT_EQ(said({0, 1, -1}, {3}), "corners: vertex -1 is out of range: there are 4 points");
  EXPECT_EQ(said({0, 1}, {2}), "sizes: polygon 0 has 2 corners, less than 3");
  EXPECT_EQ(said({0, 1, 2, 3, 0}, {3, -2, 4}), "sizes: polygon 1 has -2 corners, less than 3");
  EXPECT_EQ(said({0, 1, 2, 3}, {3}), "sizes: they add up to 3, but there are 4 corners");
  EXPECT_EQ(said({0, 1, 2}, {3, 3}), "sizes: they add up to 6, but there are 3 corners");
}

}  // namespace
}  // namespace seamwire
