// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <stop_token>
#include <tuple>
#include <vector>

#include "maps/cut_open.hpp"
#include "maps/island_map.hpp"
#include "maps/open_island.hpp"
#include "maps/outline.hpp"
#include "shapes.hpp"
#include "surface/corner_fans.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// The islands of a mesh whose vertices and fans are the same.
std::vector<Island> islands_of(const Surface& surface, const std::set<Edge>& cuts = {}) {
  std::vector<std::uint8_t> is_cut(corner_fans(surface).twins.size(), 0);
  for (std::size_t h = 0; h < is_cut.size(); ++h) {
    const Triangle& t = corner_fans(surface).triangles[h / 3];
    const auto [a, b] = std::minmax(t[h % 3], t[(h + 1) % 3]);
    is_cut[h] = cuts.contains({a, b}) ? 1 : 0;
  }
  return cut_open(corner_fans(surface), is_cut);
}

Island whole(const shapes::Mesh& mesh, const std::set<Edge>& cuts = {}) {
  std::vector<Island> islands = islands_of(mesh.surface(), cuts);
  EXPECT_EQ(islands.size(), 1U);
  return islands.front();
}

/// All half-edges of an island may be cut.
std::vector<std::uint8_t> all_real(const Island& island) { return std::vector<std::uint8_t>(island.twins.size(), 1); }

std::set<Edge> column(int n, int rows) {
  std::set<Edge> cuts;
  for (int j = 0; j < rows; ++j) cuts.insert({j * n, (j + 1) * n});
  return cuts;
}

/// A flat staircase around the z axis, which cannot be laid flat without covering itself if it turns more than once.
shapes::Mesh staircase(double turns, int n, int rows) {
  return shapes::parametric(n, rows, false, false, [=](double u, double v) {
    const double angle = 2 * std::numbers::pi * turns * u, radius = 0.5 + 0.5 * v;
    return Vector(radius * std::cos(angle), radius * std::sin(angle), 0.1 * angle);
  });
}

constexpr MapOptions kExact{.max_steps = 100, .tolerance = 1e-9};

TEST(CutOpen, ASlitHasItsOwnVerticesOnBothSides) {
  const shapes::Mesh mesh = shapes::cylinder(8, 4);
  const Island closed = whole(mesh), open = whole(mesh, column(8, 4));
  EXPECT_EQ(closed.boundaries().size(), 2U);
  EXPECT_EQ(closed.vertices.size(), 40U);
  ASSERT_EQ(open.boundaries().size(), 1U);
  EXPECT_EQ(open.boundaries()[0].size(), 8U + 8U + 4U + 4U);
  EXPECT_EQ(open.vertices.size(), 45U);
  for (std::size_t f = 0; f < open.triangles.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(open.vertices[static_cast<std::size_t>(open.triangles[f][i])],
                mesh.triangles[static_cast<std::size_t>(open.faces[f])][i]);
    }
  }
}

TEST(CutOpen, AnEdgeInTheMiddleIsALoopOfTwoEdges) {
  const Island island = whole(shapes::grid(3), {{5, 6}});
  ASSERT_EQ(island.boundaries().size(), 2U);
  EXPECT_EQ(island.vertices.size(), 16U) << "a single cut edge parts no vertex";
  std::vector<std::int32_t> loop = island.boundaries()[1].size() == 2 ? island.boundaries()[1] : island.boundaries()[0];
  for (std::int32_t& v : loop) v = island.vertices[static_cast<std::size_t>(v)];
  std::ranges::sort(loop);
  EXPECT_EQ(loop, (std::vector<std::int32_t>{5, 6}));
}

TEST(CutOpen, PartsAreOrderedByTheirFirstFaces) {
  std::set<Edge> cuts;
  for (int j = 0; j < 4; ++j) cuts.insert({j * 5 + 2, (j + 1) * 5 + 2});
  const std::vector<Island> islands = islands_of(shapes::grid(4).surface(), cuts);
  ASSERT_EQ(islands.size(), 2U);
  EXPECT_EQ(islands[0].faces.front(), 0);
  EXPECT_EQ(islands[0].faces.size(), 16U);
  EXPECT_EQ(islands[0].vertices.size(), 15U);
}

void expect_isometric(const Island& island, std::span<const Vector> points, const IslandMap& map) {
  EXPECT_NEAR(map.energy, 4.0, 1e-8);
  for (const Triangle& t : island.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = static_cast<std::size_t>(t[i]), b = static_cast<std::size_t>(t[(i + 1) % 3]);
      const double length =
          (points[static_cast<std::size_t>(island.vertices[a])] - points[static_cast<std::size_t>(island.vertices[b])])
              .norm();
      EXPECT_NEAR((map.uvs[a] - map.uvs[b]).norm(), length, 1e-4 * length);
    }
  }
}

TEST(IslandMap, DevelopableSurfacesAreMappedIsometrically) {
  for (const shapes::Mesh& mesh : {shapes::grid(1), shapes::grid(12), shapes::grid(12, 0.3)}) {
    const Island island = whole(mesh);
    expect_isometric(island, mesh.points, map_island(island, mesh.points, kExact, {}));
  }
  const shapes::Mesh cylinder = shapes::cylinder(16, 10);
  const Island slit = whole(cylinder, column(16, 10));
  expect_isometric(slit, cylinder.points, map_island(slit, cylinder.points, kExact, {}));
}

TEST(IslandMap, AHalfSphereIsAsGoodAsTheBestMapThatKeepsCircles) {
  // A map that sends circles of latitude to circles has a radius r(t) for the angle t from the pole. Its energy is the
  // integral of (r'^2 + 1 / r'^2 + (r / sin t)^2 + (sin t / r)^2) sin t. Minimized over r with 400 steps of t, this is
  // 4.1405.
  const shapes::Mesh mesh = shapes::parametric(48, 16, true, false, [](double u, double v) {
    const double a = 2 * std::numbers::pi * u, t = 0.5 * std::numbers::pi * (v + 1e-3) / (1 + 1e-3);
    return Vector(std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t));
  });
  const Island island = whole(mesh);
  const IslandMap map = map_island(island, mesh.points, kExact, {});
  EXPECT_FALSE(map.overlaps);
  EXPECT_NEAR(map.energy, 4.1405, 0.01);
}

TEST(IslandMap, DoesNotDependOnSizeAndPlace) {
  const shapes::Mesh mesh = shapes::bumpy(shapes::grid(12), 0.04);
  const Island island = whole(mesh);
  const IslandMap map = map_island(island, mesh.points, kExact, {});
  for (const double scale : {1e-140, 1e-6, 1e6, 1e140}) {
    std::vector<Vector> points = mesh.points;
    for (Vector& p : points) p = scale * p;
    const IslandMap scaled = map_island(island, points, kExact, {});
    EXPECT_NEAR(scaled.energy, map.energy, 1e-7);
    EXPECT_NEAR((scaled.uvs[7] - scaled.uvs[100]).norm() / scale, (map.uvs[7] - map.uvs[100]).norm(), 1e-4);
  }
  std::vector<Vector> points = mesh.points;
  for (Vector& p : points) p += Vector(1000, -300, 20);
  EXPECT_NEAR(map_island(island, points, kExact, {}).energy, map.energy, 1e-7);
}

TEST(IslandMap, DoesNotDependOnTheOrderOfTriangles) {
  shapes::Mesh mesh = shapes::bumpy(shapes::grid(12), 0.04);
  const double energy = map_island(whole(mesh), mesh.points, kExact, {}).energy;
  std::mt19937 random(8);
  std::ranges::shuffle(mesh.triangles, random);
  for (Triangle& t : mesh.triangles) std::rotate(t.begin(), t.begin() + 1, t.end());
  EXPECT_NEAR(map_island(whole(mesh), mesh.points, kExact, {}).energy, energy, 1e-7);
}

TEST(IslandMap, IsTheSameEachTime) {
  const shapes::Mesh mesh = shapes::bumpy(shapes::grid(12), 0.04);
  const Island island = whole(mesh);
  const IslandMap one = map_island(island, mesh.points, {}, {}), other = map_island(island, mesh.points, {}, {});
  EXPECT_EQ(one.energy, other.energy);
  EXPECT_EQ(one.uvs, other.uvs);
}

TEST(IslandMap, ABarrierKeepsAStaircaseFromCoveringItself) {
  const shapes::Mesh mesh = staircase(1.5, 60, 4);
  const Island island = whole(mesh);
  const IslandMap free = map_island(island, mesh.points, {.keep_apart = false}, {});
  EXPECT_TRUE(free.overlaps);
  EXPECT_LT(free.energy, 4.001);
  const IslandMap apart = map_island(island, mesh.points, {}, {});
  EXPECT_FALSE(apart.overlaps);
  EXPECT_GT(apart.energy, free.energy);
  EXPECT_LT(apart.energy, 4.1);
  for (const double energy : triangle_energies(island, mesh.points, apart.uvs)) EXPECT_TRUE(std::isfinite(energy));
}

TEST(IslandMap, ContinuesAfterACutHasBecomeLonger) {
  const shapes::Mesh mesh = shapes::cylinder(16, 10);
  std::set<Edge> cuts = column(16, 9);
  const Island before = whole(mesh, cuts), after = whole(mesh, column(16, 10));
  const IslandMap first = map_island(before, mesh.points, kExact, {});
  // Both have the same corners, so that each own vertex of the longer cut knows its place.
  std::vector<Point2> start(after.vertices.size());
  for (std::size_t f = 0; f < after.triangles.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      start[static_cast<std::size_t>(after.triangles[f][i])] =
          first.uvs[static_cast<std::size_t>(before.triangles[f][i])];
    }
  }
  const IslandMap second = continue_map(after, mesh.points, start, kExact, {});
  expect_isometric(after, mesh.points, second);
  EXPECT_LT(second.energy, first.energy);
  EXPECT_FALSE(second.overlaps);
  const IslandMap again = continue_map(after, mesh.points, second.uvs, kExact, {});
  EXPECT_LE(again.steps, 2U) << "nothing is left to do";
}

TEST(IslandMap, LowTrianglesHaveFiniteMaps) {
  shapes::Mesh mesh = shapes::grid(6);
  mesh.points[16] = mesh.points[17];                            // an edge without a length
  mesh.points[24] = 0.5 * (mesh.points[23] + mesh.points[25]);  // triangles without an area
  mesh.points[32] = mesh.points[31] + 1e-13 * Vector(0.3, 1.0, 0.0);
  const Island island = whole(mesh);
  const IslandMap map = map_island(island, mesh.points, {}, {});
  EXPECT_TRUE(std::isfinite(map.energy));
  for (const Point2& uv : map.uvs) EXPECT_TRUE(uv.allFinite());
  for (const double energy : triangle_energies(island, mesh.points, map.uvs)) EXPECT_TRUE(std::isfinite(energy));
}

TEST(IslandMap, RefusesWhatHasNoMap) {
  const shapes::Mesh sphere = shapes::icosphere(1), torus = shapes::torus(8, 6);
  EXPECT_THROW(map_island(whole(sphere), sphere.points, {}, {}), InvalidInput);
  EXPECT_THROW(map_island(whole(torus), torus.points, {}, {}), InvalidInput);
  const Triangle& t = sphere.triangles[0];
  const auto [a, b] = std::minmax(t[0], t[1]);
  EXPECT_THROW(map_island(whole(sphere, {{a, b}}), sphere.points, {}, {}), InvalidInput) << "a loop of two edges";
  const shapes::Mesh grid = shapes::grid(2);
  const Island island = whole(grid);
  std::vector<Point2> flat;
  for (const std::int32_t v : island.vertices) flat.emplace_back(grid.points[static_cast<std::size_t>(v)].head<2>());
  EXPECT_THROW(continue_map(island, grid.points, std::vector<Point2>{flat[0]}, {}, {}), InvalidInput);
  std::swap(flat[0], flat[1]);
  EXPECT_THROW(continue_map(island, grid.points, flat, {}, {}), InvalidInput);
}

TEST(IslandMap, AStartMustBeAMap) {
  const shapes::Mesh grid = shapes::grid(4);
  const Island island = whole(grid);
  std::vector<Point2> flat;
  for (const std::int32_t v : island.vertices) flat.emplace_back(grid.points[static_cast<std::size_t>(v)].head<2>());
  const IslandMap same = continue_map(island, grid.points, flat, {}, {});
  EXPECT_NEAR(same.energy, 4.0, 1e-9);
  EXPECT_FALSE(same.overlaps);
  const auto middle = static_cast<std::size_t>(std::ranges::find(island.vertices, 12) - island.vertices.begin());
  const auto is_refused = [&](const Point2& place) {
    std::vector<Point2> start = flat;
    start[middle] = place;
    try {
      continue_map(island, grid.points, start, {}, {});
      return false;
    } catch (const InvalidInput&) {
      return true;
    }
  };
  EXPECT_FALSE(is_refused({0.55, 0.5}));
  EXPECT_TRUE(is_refused({0.8, 0.5})) << "triangles are flipped";
  EXPECT_TRUE(is_refused({0.75, 0.5})) << "triangles have no area";
  EXPECT_TRUE(is_refused({std::nan(""), 0.5})) << "a number is not finite";
  EXPECT_TRUE(is_refused({0.5, std::numeric_limits<double>::infinity()})) << "a number is not finite";
  // No triangle of a start that lies on itself has a fault.
  const shapes::Mesh stairs = staircase(1.5, 60, 4);
  const Island turning = whole(stairs);
  const IslandMap lying_on_itself = map_island(turning, stairs.points, {.keep_apart = false}, {});
  EXPECT_TRUE(continue_map(turning, stairs.points, lying_on_itself.uvs, {.max_steps = 2}, {}).overlaps);
}

TEST(IslandMap, StopsOnceItIsCertainToBeWorse) {
  // A tube as a ring cannot have much less than 7.
  const shapes::Mesh mesh = shapes::cylinder(20, 30);
  const Island island = whole(mesh);
  const IslandMap map = map_island(island, mesh.points, kExact, {});
  EXPECT_GT(map.energy, 6.5);
  const IslandMap worse = map_island(island, mesh.points, {.tolerance = 1e-9, .worse_than = 5.0}, {});
  EXPECT_LT(worse.steps, map.steps);
  EXPECT_GT(worse.energy, 5.0);
  const IslandMap better =
      map_island(island, mesh.points, {.max_steps = 100, .tolerance = 1e-9, .worse_than = 8.0}, {});
  EXPECT_EQ(better.energy, map.energy);
}

TEST(IslandMap, StopsWhenToldTo) {
  const shapes::Mesh mesh = shapes::grid(12);
  const Island island = whole(mesh);
  int asked = 0;
  const Task task{.stop = {}, .progress = [&](double) { return ++asked < 6; }};
  EXPECT_THROW(map_island(island, mesh.points, {}, task), Cancelled);
  EXPECT_EQ(asked, 6);
}

TEST(Outline, TouchingIsNotCrossing) {
  const shapes::Mesh mesh = shapes::grid(1);  // vertices 0 to 3 of a square, with its diagonal
  const Island island = whole(mesh);
  const Outline outline(island.boundaries(), 0.1);
  const auto at = [&](const std::array<Point2, 4>& mesh_places) {
    std::vector<double> map(8);
    for (std::size_t v = 0; v < 4; ++v) {
      const Point2& p = mesh_places[static_cast<std::size_t>(island.vertices[v])];
      map[2 * v] = p.x();
      map[2 * v + 1] = p.y();
    }
    return map;
  };
  EXPECT_FALSE(outline.covers_twice(at({Point2(0, 0), Point2(1, 0), Point2(0, 1), Point2(1, 1)}), 1e-6, {}));
  EXPECT_TRUE(outline.covers_twice(at({Point2(0, 0), Point2(1, 0), Point2(1, 1), Point2(0, 1)}), 1e-6, {}))
      << "a bow tie";
  const auto touching = at({Point2(0, 0), Point2(2, 0), Point2(1, 0), Point2(1, 1)});
  EXPECT_FALSE(outline.covers_twice(touching, 1e-6, {})) << "a corner on an edge";
  const auto shallow = at({Point2(0, 0), Point2(2, 0), Point2(1, -1e-4), Point2(1, 1)});
  EXPECT_TRUE(outline.covers_twice(shallow, 1e-6, {}));
  EXPECT_FALSE(outline.covers_twice(shallow, 1e-3, {}));
}

TEST(Outline, AHoleThatIsTurnedInsideOutCoversThePlaneTwice) {
  // A slit of two edges: its middle lies on both sides, and each side may move.
  const shapes::Mesh mesh = shapes::grid(4);
  const Island island = whole(mesh, {{11, 12}, {12, 13}});
  const Outline outline(island.boundaries(), 0.1);
  std::vector<double> map;
  for (const std::int32_t v : island.vertices) {
    for (const double value : mesh.points[static_cast<std::size_t>(v)].head<2>()) map.push_back(value);
  }
  EXPECT_FALSE(outline.covers_twice(map, 1e-6, {}));
  // The own vertex of the middle that has a triangle below the slit.
  for (const Triangle& t : island.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto own = static_cast<std::size_t>(t[i]);
      const bool is_below =
          std::ranges::any_of(t, [&](std::int32_t v) { return map[2 * static_cast<std::size_t>(v) + 1] < 0.49; });
      if (island.vertices[own] == 12 && is_below && map[2 * own + 1] == 0.5) map[2 * own + 1] = 0.499;
    }
  }
  EXPECT_FALSE(outline.covers_twice(map, 1e-6, {})) << "the slit is open";
  for (std::size_t v = 0; v < island.vertices.size(); ++v) {
    if (island.vertices[v] == 12 && map[2 * v + 1] == 0.499) map[2 * v + 1] = 0.501;
  }
  EXPECT_TRUE(outline.covers_twice(map, 1e-6, {})) << "its sides lie over each other";
}

TEST(Outline, CrossingsThroughVerticesCoverThePlaneTwice) {
  // A strip of squares around a square hole. The last square lies on the first one, or beside it.
  shapes::Mesh mesh;
  for (std::int32_t i = 0; i < 11; ++i) {
    mesh.points.emplace_back(i, 0, 0);
    mesh.points.emplace_back(i, 1, 0);
    if (i == 0) continue;
    mesh.triangles.push_back({2 * i - 2, 2 * i, 2 * i + 1});
    mesh.triangles.push_back({2 * i - 2, 2 * i + 1, 2 * i - 1});
  }
  const Island island = whole(mesh);
  const Outline outline(island.boundaries(), 0.1);
  // The right side goes around the outside of three squares by three, the left side around their middle.
  const std::vector<Point2> outer{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {3, 2},
                                  {3, 3}, {2, 3}, {1, 3}, {0, 3}, {0, 2}};
  const std::vector<Point2> inner{{0, 1}, {1, 1}, {2, 1}, {2, 1}, {2, 1}, {2, 2},
                                  {2, 2}, {2, 2}, {1, 2}, {1, 2}, {1, 2}};
  std::vector<double> map(2 * island.vertices.size());
  const auto place = [&](double turned, const std::vector<Point2>& right, const std::vector<Point2>& left) {
    for (std::size_t v = 0; v < island.vertices.size(); ++v) {
      const auto of = static_cast<std::size_t>(island.vertices[v]);
      const Point2 p = Eigen::Rotation2Dd(turned) * (of % 2 == 0 ? right : left)[of / 2];
      map[2 * v] = p.x();
      map[2 * v + 1] = p.y();
    }
  };
  for (const double turned : {0.0, 0.3}) {
    place(turned, outer, inner);
    EXPECT_FALSE(outline.covers_twice(map, 1e-6, {})) << turned;
    std::vector<Point2> right = outer, left = inner;
    right[10] = {0, 1};
    left[10] = {1, 1};
    place(turned, right, left);
    EXPECT_FALSE(outline.covers_twice(map, 1e-6, {})) << "the ends touch, turned by " << turned;
    right[10] = {0, 0};
    left[10] = {1, 0};
    place(turned, right, left);
    EXPECT_TRUE(outline.covers_twice(map, 1e-6, {})) << "the end lies on the first square, turned by " << turned;
  }
}

TEST(Outline, FirstContactIsWhereAVertexMeetsAnEdge) {
  const shapes::Mesh mesh = shapes::grid(1);
  const Island island = whole(mesh);
  const Outline outline(island.boundaries(), 0.1);
  std::vector<double> map(8), direction(8, 0.0);
  std::size_t moved = 0;
  for (std::size_t v = 0; v < 4; ++v) {
    map[2 * v] = island.vertices[v] % 2;
    map[2 * v + 1] = island.vertices[v] < 2 ? 0.0 : 1.0;
    if (island.vertices[v] == 3) moved = v;
  }
  // Corner (1, 1) moves straight down through corner (1, 0) and the edge that ends there.
  direction[2 * moved] = -0.5;
  direction[2 * moved + 1] = -2.0;
  EXPECT_NEAR(outline.first_contact(map, direction, 1.0), 0.5, 1e-9) << "at (0.75, 0)";
  EXPECT_EQ(outline.first_contact(map, direction, 0.4), 0.4);
}

/// Second differences of the barrier for the six numbers of a pair.
Eigen::MatrixXd barrier_hessian(const Outline& outline, const Outline::Pair& pair, std::vector<double> map) {
  constexpr double kStep = 1e-6;
  const std::array<std::int32_t, 3> vertices{pair.vertex, pair.a, pair.b};
  const auto number = [&](int i) -> double& { return map[static_cast<std::size_t>(2 * vertices[i / 2] + i % 2)]; };
  Eigen::MatrixXd hessian(6, 6);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const auto moved = [&](double di, double dj) {
        const std::vector<double> before = map;
        number(i) += di;
        number(j) += dj;
        const double energy = outline.energy(map);
        map = before;
        return energy;
      };
      hessian(i, j) = (moved(kStep, kStep) - moved(kStep, -kStep) - moved(-kStep, kStep) + moved(-kStep, -kStep)) /
                      (4.0 * kStep * kStep);
    }
  }
  return hessian;
}

TEST(Outline, TheBarriersHessianHasThePositivePartOfEachTerm) {
  // Corner 3 of a pentagon is next to the edge from 0 to 1.
  const Outline outline({{0, 1, 2, 3, 4}}, 0.1);
  for (const double side : {1.0, -1.0}) {
    for (const auto& [away, along, is_beside] : {std::tuple(0.02, 0.3, true), {0.06, 0.8, true}, {0.03, 1.02, false}}) {
      std::vector<double> map;
      for (const Point2& p : {Point2(0, 0), Point2(1, 0), Point2(2, 1), Point2(along, away), Point2(-1, 1)}) {
        const Point2 turned = Eigen::Rotation2Dd(0.7) * Point2(p.x(), side * p.y());
        map.insert(map.end(), {turned.x(), turned.y()});
      }
      const std::vector<Outline::Pair> pairs = outline.close_pairs(map, 1.0);
      const auto pair = std::ranges::find_if(pairs, [](const auto& p) { return p.vertex == 3 && p.b == 1; });
      ASSERT_NE(pair, pairs.end());
      const Outline::Slope slope = outline.slope(*pair, map);
      const Eigen::Map<const Eigen::VectorXd> g(slope.of_distance.data(), 6), t(slope.turning.data(), 6);
      if (!is_beside) {
        EXPECT_EQ(t.norm(), 0.0) << "near a corner the distance's own Hessian is positive, and the slope negative";
        continue;
      }
      ASSERT_EQ(pairs.size(), 1U);
      const Eigen::MatrixXd rest = barrier_hessian(outline, *pair, map) - slope.second * g * g.transpose();
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(rest);
      const Eigen::MatrixXd positive =
          solved.eigenvectors() * solved.eigenvalues().cwiseMax(0.0).asDiagonal() * solved.eigenvectors().transpose();
      EXPECT_GT(t.squaredNorm(), 0.01 * slope.second) << "nothing to test";
      constexpr double kExact = 1e-5;  // of second differences
      EXPECT_LT((positive - t * t.transpose()).norm(), kExact * slope.second) << side << " " << away;
    }
  }
}

TEST(OpenIsland, HandlesAndBallsBecomeDiscs) {
  for (const shapes::Mesh& mesh : {shapes::icosphere(0), shapes::icosphere(2), shapes::torus(12, 8)}) {
    const Island island = whole(mesh);
    EXPECT_FALSE(is_planar(island));
    const OpenedIsland opened = open_to_plane(island, all_real(island), mesh.points, {});
    EXPECT_TRUE(is_planar(opened.island));
    EXPECT_EQ(opened.island.boundaries().size(), 1U);
    EXPECT_EQ(opened.island.boundaries()[0].size(), 2 * opened.opened) << "each opened edge has two sides";
    EXPECT_EQ(opened.island.faces, island.faces);
  }
}

TEST(OpenIsland, AHandleIsCutAlongItsShortWays) {
  const shapes::Mesh mesh = shapes::torus(30, 10);
  const Island island = whole(mesh);
  const OpenedIsland opened = open_to_plane(island, all_real(island), mesh.points, {});
  EXPECT_LE(opened.opened, 41U) << "once around the tube and once around the axis, and one shared edge at most";
}

TEST(OpenIsland, ASlitOfOneEdgeBecomesLonger) {
  const shapes::Mesh mesh = shapes::icosphere(1);
  const auto [a, b] = std::minmax(mesh.triangles[0][0], mesh.triangles[0][1]);
  const Island slit = whole(mesh, {{a, b}});
  const OpenedIsland opened = open_to_plane(slit, all_real(slit), mesh.points, {});
  EXPECT_EQ(opened.opened, 1U);
  EXPECT_TRUE(is_planar(opened.island));
  // Two slits of one edge, and no other vertex.
  const std::vector<Vector> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const shapes::Mesh tetrahedron{points, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  const Island slits = whole(tetrahedron, {{0, 1}, {2, 3}});
  EXPECT_TRUE(is_planar(open_to_plane(slits, all_real(slits), points, {}).island));
}

}  // namespace
}  // namespace seamwire
