// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "maps/polygon_meshes.hpp"
#include "seamwire_uv/maps/flatten.hpp"
#include "shapes.hpp"

namespace seamwire {
namespace {

constexpr double kCost = 0.05;

/// A rectangle of cells: a mesh, cuts that leave it in one piece, and how many cells there are along its sides.
struct Strip {
  shapes::QuadMesh mesh;
  std::vector<Edge> cuts;
  std::size_t columns, rows;
};

/// The wall of a cylinder, cut open along a line from bottom to top.
Strip wall(int n, int rows) {
  Strip strip{shapes::quad_cylinder(n, rows), {}, static_cast<std::size_t>(n), static_cast<std::size_t>(rows)};
  for (std::int32_t j = 0; j < rows; ++j) strip.cuts.push_back({j * n, (j + 1) * n});
  return strip;
}

/// A band that bends around an axis and to the side.
Strip belt() {
  return {shapes::parametric_quads(20, 2, false, false,
                                   [](double u, double v) {
                                     const double a = 2.0 * u, ring = 1.0 + 0.1 * (v - 0.5);
                                     return Vector(ring * std::cos(a), ring * std::sin(a), 0.1 * v + 0.3 * u * u);
                                   }),
          {},
          20,
          2};
}

/// A flat board of one row, with cells of different lengths.
Strip plank() {
  return {shapes::parametric_quads(5, 1, false, false,
                                   [](double u, double v) { return Vector(3.0 * u * u, 0.2 * v, 0.0); }),
          {},
          5,
          1};
}

/// The outer half of a torus, cut open: a ring between two circles on top and bottom.
Strip ring() {
  Strip strip{shapes::parametric_quads(32, 4, true, false,
                                       [](double u, double v) {
                                         const double a = 2 * std::numbers::pi * u;
                                         const double b = std::numbers::pi * (v - 0.5);
                                         const double r = 1.0 + 0.08 * std::cos(b);
                                         return Vector(r * std::cos(a), r * std::sin(a), 0.08 * std::sin(b));
                                       }),
              {},
              32,
              4};
  for (std::int32_t j = 0; j < 4; ++j) strip.cuts.push_back({j * 32, (j + 1) * 32});
  return strip;
}

/// Squares in a plane, each of n x n quads.
shapes::QuadMesh floor_of(const std::vector<std::string>& rows, int n) {
  shapes::QuadMesh mesh = shapes::plate(rows, n);
  std::erase_if(mesh.quads, [&](const auto& quad) {
    return std::ranges::any_of(quad,
                               [&](std::int32_t v) { return mesh.points[static_cast<std::size_t>(v)].z() < 0.5; });
  });
  return mesh;
}

/// How quads are cut into triangles whose edges are all real.
enum class Diagonal : std::uint8_t { kOne, kOther, kRandom };

Surface triangulated(const shapes::QuadMesh& mesh, Diagonal diagonal) {
  std::mt19937 random(7);
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c, d] : mesh.quads) {
    const bool is_one = diagonal == Diagonal::kRandom ? random() % 2 == 0 : diagonal == Diagonal::kOne;
    if (is_one) {
      triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
    } else {
      triangles.insert(triangles.end(), {{a, b, d}, {b, c, d}});
    }
  }
  return {mesh.points, triangles};
}

/// The mean symmetric Dirichlet energy, from the singular values of each triangle's map.
double measured_energy(const Surface& surface, const CornerUvs& uvs) {
  double sum = 0.0, area = 0.0;
  for (std::size_t f = 0; f < uvs.size(); ++f) {
    const auto point = [&](std::size_t i) {
      return surface.points()[static_cast<std::size_t>(surface.triangles()[f][i])];
    };
    const Vector x = (point(1) - point(0)).normalized(), normal = (point(1) - point(0)).cross(point(2) - point(0));
    const Vector y = normal.normalized().cross(x);
    Eigen::Matrix2d rest, map;
    rest << x.dot(point(1) - point(0)), x.dot(point(2) - point(0)), 0.0, y.dot(point(2) - point(0));
    map << uvs[f][1] - uvs[f][0], uvs[f][2] - uvs[f][0];
    const Eigen::Matrix2d jacobian = map * rest.inverse();
    if (!(jacobian.determinant() > 0.0)) return std::numeric_limits<double>::infinity();
    sum += 0.5 * normal.norm() * (jacobian.squaredNorm() + jacobian.inverse().squaredNorm());
    area += 0.5 * normal.norm();
  }
  return sum / area;
}

/// How many different places there are along each axis.
std::array<std::size_t, 2> lines_of(const CornerUvs& uvs) {
  std::array<std::set<double>, 2> lines;
  for (const auto& corners : uvs) {
    for (const Eigen::Vector2d& uv : corners) {
      for (const Eigen::Index k : {0, 1}) lines[static_cast<std::size_t>(k)].insert(uv[k]);
    }
  }
  return {lines[0].size(), lines[1].size()};
}

/// The height and the width of a map.
Eigen::Vector2d size_of(const CornerUvs& uvs) {
  Eigen::Vector2d low = uvs[0][0], high = low;
  for (const auto& corners : uvs) {
    for (const Eigen::Vector2d& uv : corners) {
      low = low.cwiseMin(uv);
      high = high.cwiseMax(uv);
    }
  }
  return high - low;
}

void expect_straight(const Surface& surface, const Strip& strip) {
  const Flattening flat = flatten(surface, strip.cuts), straight = flatten(surface, strip.cuts, {.straighten = kCost});
  ASSERT_EQ(straight.by_island.size(), 1U);
  EXPECT_FALSE(flat.by_island[0].is_straight);
  ASSERT_TRUE(straight.by_island[0].is_straight);
  std::array<std::size_t, 2> lines = lines_of(straight.uvs);
  std::array<std::size_t, 2> expected{strip.columns + 1, strip.rows + 1};
  std::ranges::sort(lines);
  std::ranges::sort(expected);
  EXPECT_EQ(lines, expected);
  const double energy = measured_energy(surface, straight.uvs);
  EXPECT_LE(energy, measured_energy(surface, flat.uvs) + kCost);
  EXPECT_NEAR(straight.by_island[0].energy, energy, 1e-9);
  const MapReport report = measure_map(surface, straight.uvs, straight.islands);
  EXPECT_TRUE(report.flipped.empty());
  EXPECT_TRUE(report.overlapping.empty());
}

void expect_unchanged(const Surface& surface, const std::vector<Edge>& cuts = {}) {
  const Flattening flat = flatten(surface, cuts), straight = flatten(surface, cuts, {.straighten = kCost});
  for (const FlatIsland& island : straight.by_island) EXPECT_FALSE(island.is_straight);
  EXPECT_EQ(straight.uvs, flat.uvs);
}

TEST(StraightStrips, StripsOfQuadsAreLaidOutStraight) {
  for (const Strip& strip : {wall(12, 1), wall(24, 5), belt(), plank(), ring()}) {
    expect_straight(strip.mesh.surface(), strip);
  }
}

TEST(StraightStrips, StripsOfTriangulatedQuadsAreLaidOutStraight) {
  for (const Strip& strip : {wall(12, 1), wall(24, 5), belt(), plank(), ring()}) {
    for (const Diagonal diagonal : {Diagonal::kOne, Diagonal::kOther, Diagonal::kRandom}) {
      expect_straight(triangulated(strip.mesh, diagonal), strip);
    }
  }
}

TEST(StraightStrips, ABandThatIsARingWhenFlatIsLaidOutStraight) {
  // The side of a cone of 6 degrees. Flat, it bends by 38 degrees.
  Strip strip{shapes::parametric_quads(24, 1, true, false,
                                       [](double u, double v) {
                                         const double a = 2 * std::numbers::pi * u, r = 1.0 + 0.05 * v;
                                         return Vector(r * std::cos(a), r * std::sin(a), 0.5 * v);
                                       }),
              {{0, 24}},
              24,
              1};
  const Surface surface = strip.mesh.surface();
  EXPECT_GT(lines_of(flatten(surface, strip.cuts).uvs)[0], 25U);
  expect_straight(surface, strip);
}

TEST(StraightStrips, RowsAndColumnsHaveTheSizesOfTheirEdges) {
  const Strip strip = plank();
  const Flattening map = flatten(strip.mesh.surface(), {}, {.straighten = kCost, .up = Vector(1, 0, 0)});
  std::set<double> lines;
  for (const auto& corners : map.uvs) {
    for (const Eigen::Vector2d& uv : corners) lines.insert(uv.y());
  }
  double place = *lines.begin();
  std::vector<double> sizes;
  for (const double line : lines) {
    if (line > place) sizes.push_back(line - place);
    place = line;
  }
  ASSERT_EQ(sizes.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(sizes[i], 3.0 * (2.0 * static_cast<double>(i) + 1.0) / 25.0, 1e-9);
  EXPECT_NEAR(size_of(map.uvs).x(), 0.2, 1e-9);
}

TEST(StraightStrips, TheSizesOfRowsAndColumnsHaveTheLeastEnergy) {
  const Strip strip = ring();
  const Surface surface = strip.mesh.surface();
  const CornerUvs uvs = flatten(surface, strip.cuts, {.straighten = kCost}).uvs;
  const double least = measured_energy(surface, uvs);
  for (const Eigen::Index axis : {0, 1}) {
    for (const double factor : {0.99, 1.01}) {
      CornerUvs other = uvs;
      for (auto& corners : other) {
        for (Eigen::Vector2d& uv : corners) uv[axis] *= factor;
      }
      EXPECT_GT(measured_energy(surface, other), least);
    }
  }
}

TEST(StraightStrips, TheCostDecides) {
  const auto trapezoid = [](double top) {
    return shapes::QuadMesh{{{0, 0, 0}, {1, 0, 0}, {0.5 + 0.5 * top, 1, 0}, {0.5 - 0.5 * top, 1, 0}}, {{0, 1, 2, 3}}};
  };
  for (const double top : {1.0, 0.95, 0.9, 0.8, 0.7, 0.5}) {
    const Surface surface = trapezoid(top).surface();
    const Flattening any = flatten(surface, {}, {.straighten = 100.0});
    ASSERT_TRUE(any.by_island[0].is_straight);
    const double cost = measured_energy(surface, any.uvs) - measured_energy(surface, flatten(surface, {}).uvs);
    EXPECT_EQ(flatten(surface, {}, {.straighten = kCost}).by_island[0].is_straight, cost <= kCost) << top;
    EXPECT_EQ(cost <= kCost, top > 0.85) << cost;
  }
}

TEST(StraightStrips, OtherShapesStayAsTheyAre) {
  expect_unchanged(floor_of({"##", "#."}, 2).surface());
  expect_unchanged(floor_of({"###", "#.#", "###"}, 2).surface());
  expect_unchanged(shapes::quad_cylinder(12, 2).surface());             // open at both ends
  expect_unchanged(shapes::quad_grid(4).surface(), {{2, 7}, {7, 12}});  // with a slit
  expect_unchanged(shapes::icosphere(1).surface(), {});
  // A hexagon beside a square, and a square beside a triangle.
  shapes::PolygonMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, -0.5, 0}, {2.5, 0.5, 0}, {2, 1.5, 0}}, {}};
  mesh.polygons = {{0, 1, 2, 3}, {1, 4, 5, 6, 2}};
  expect_unchanged(mesh.surface());
  mesh.polygons = {{0, 1, 2, 3}, {1, 5, 2}};
  expect_unchanged(mesh.surface());
}

TEST(StraightStrips, SquaresAroundACornerOfThreeStayAsTheyAre) {
  shapes::QuadMesh corner = shapes::quad_cube(2);
  const auto& points = corner.points;
  std::erase_if(corner.quads, [&](const auto& quad) {
    Vector middle = Vector::Zero();
    for (const std::int32_t v : quad) middle += 0.25 * points[static_cast<std::size_t>(v)];
    return middle.minCoeff() > 0.0;  // the three sides that meet in the origin stay
  });
  EXPECT_EQ(corner.quads.size(), 12U);
  expect_unchanged(corner.surface());
}

/// The direction in the map in which one vertex lies from another.
Eigen::Vector2d direction(const Surface& surface, const CornerUvs& uvs, std::int32_t from, std::int32_t to) {
  for (std::size_t f = 0; f < uvs.size(); ++f) {
    const Triangle& t = surface.triangles()[f];
    const auto* one = std::ranges::find(t, from);
    const auto* other = std::ranges::find(t, to);
    if (one == t.end() || other == t.end()) continue;
    return (uvs[f][static_cast<std::size_t>(other - t.begin())] - uvs[f][static_cast<std::size_t>(one - t.begin())])
        .stableNormalized();
  }
  return Eigen::Vector2d::Zero();
}

TEST(UprightMaps, UpIsUpWhereTheSurfaceHasAnUp) {
  const Eigen::Vector2d up(0.0, 1.0);
  const Strip strip = wall(12, 3);
  const Surface surface = strip.mesh.surface();
  for (const std::optional<double> straighten : {std::optional<double>(), std::optional(kCost)}) {
    for (const double sign : {1.0, -1.0}) {
      const Flattening map = flatten(surface, strip.cuts, {.straighten = straighten, .up = Vector(0, 0, 2.5 * sign)});
      EXPECT_EQ(map.by_island[0].is_straight, straighten.has_value());
      const Eigen::Vector2d found = direction(surface, map.uvs, 5, 17);
      EXPECT_LT((found - sign * up).norm(), straighten ? 1e-15 : 1e-3);
    }
  }
}

TEST(UprightMaps, UpIsUpAtAnySize) {
  for (const double size : {1e-120, 1e120}) {
    Strip strip = wall(12, 3);
    for (Vector& p : strip.mesh.points) p *= size;
    const Surface surface = strip.mesh.surface();
    const Flattening map = flatten(surface, strip.cuts, {.up = Vector(0, 0, 1)});
    EXPECT_LT((direction(surface, map.uvs, 5, 17) - Eigen::Vector2d(0.0, 1.0)).norm(), 1e-3) << size;
  }
}

TEST(UprightMaps, AnIslandWithoutAnUpStandsOnItsShorterSide) {
  // A lying cylinder.
  const Strip strip = wall(12, 8);
  const Surface surface = strip.mesh.surface();
  for (const std::optional<double> straighten : {std::optional<double>(), std::optional(kCost)}) {
    const Eigen::Vector2d size =
        size_of(flatten(surface, strip.cuts, {.straighten = straighten, .up = Vector(1, 0, 0)}).uvs);
    EXPECT_NEAR(size.x(), 1.0, 1e-3);
    EXPECT_NEAR(size.y(), 12 * 0.5 * std::sin(std::numbers::pi / 12), 1e-3);
  }
  // A floor in the shape of an L, turned by any angle. Its longer side is 3 long.
  for (const double angle : {0.0, 0.3, 1.1, 2.0, 3.5, 5.0}) {
    shapes::QuadMesh floor = floor_of({"###", "#.."}, 1);
    for (Vector& p : floor.points) p = Eigen::AngleAxisd(angle, Vector::UnitZ()) * p;
    const Eigen::Vector2d size = size_of(flatten(floor.surface(), {}, {.up = Vector(0, 0, 1)}).uvs);
    EXPECT_NEAR(size.y() / size.x(), 1.5, 1e-6) << angle;
  }
}

TEST(UprightMaps, TurningKeepsTheEnergy) {
  const Surface surface = shapes::icosphere(2).surface();
  const Flattening flat = flatten(surface, {}), turned = flatten(surface, {}, {.up = Vector(0.3, 0.2, 1.0)});
  EXPECT_NEAR(measured_energy(surface, flat.uvs), measured_energy(surface, turned.uvs), 1e-9);
}

TEST(UprightMaps, UpMustBeADirection) {
  const Surface surface = shapes::grid(2).surface();
  for (const Vector& up : {Vector(0, 0, 0), Vector(0, std::numeric_limits<double>::infinity(), 1)}) {
    EXPECT_THROW(flatten(surface, {}, {.up = up}), InvalidInput);
  }
}

}  // namespace
}  // namespace seamwire
