// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "polygon_meshes.hpp"
#include "seamwire/surface/segments.hpp"
#include "seamwire_uv/maps/flatten.hpp"

namespace seamwire {
namespace {

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Whether two triangles of a map overlap by more than a length: no side of either has the other triangle beyond it.
bool overlap(const std::array<Eigen::Vector2d, 3>& one, const std::array<Eigen::Vector2d, 3>& other, double length) {
  for (const auto* of : {&one, &other}) {
    const auto& beyond = of == &one ? other : one;
    const double sign = turn((*of)[0], (*of)[1], (*of)[2]) > 0 ? 1.0 : -1.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector2d &a = (*of)[i], &b = (*of)[(i + 1) % 3];
      const double least = length * (b - a).norm();
      if (std::ranges::all_of(beyond, [&](const auto& p) { return sign * turn(a, b, p) <= least; })) return false;
    }
  }
  return true;
}

/// Looks at each pair of triangles of an island.
bool covers_itself(const Flattening& flat, double length) {
  for (std::size_t f = 0; f < flat.uvs.size(); ++f) {
    for (std::size_t g = f + 1; g < flat.uvs.size(); ++g) {
      if (flat.islands[f] == flat.islands[g] && overlap(flat.uvs[f], flat.uvs[g], length)) return true;
    }
  }
  return false;
}

/// Each corner of a polygon has one UV, no triangle is flipped, and islands that are not said to overlap do not.
void expect_map_of_polygons(const shapes::PolygonMesh& mesh, const Surface& surface, std::span<const Edge> cuts,
                            bool may_overlap = false) {
  const Flattening flat = flatten(surface, cuts);
  EXPECT_EQ(flat.islands, face_segments(surface, cuts));
  const std::vector<std::size_t> polygons = mesh.polygon_of_triangles();
  std::map<std::pair<std::size_t, std::int32_t>, Eigen::Vector2d> uvs;
  std::size_t torn = 0;
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector2d& uv = flat.uvs[f][i];
      torn += uvs.emplace(std::pair(polygons[f], surface.triangles()[f][i]), uv).first->second == uv ? 0 : 1;
    }
  }
  EXPECT_EQ(torn, 0U) << "corners of polygons with two UVs";
  const MapReport report = measure_map(surface, flat.uvs, flat.islands);
  EXPECT_TRUE(report.flipped.empty());
  if (!may_overlap) {
    EXPECT_TRUE(report.overlapping.empty());
    EXPECT_FALSE(covers_itself(flat, 1e-5));
  }
  EXPECT_TRUE(std::isfinite(flat.energy));
}

std::vector<shapes::PolygonMesh> polygon_meshes() {
  return {shapes::of_quads(shapes::quad_cube(1)),
          shapes::of_quads(shapes::quad_cube(3)),
          shapes::closed_cylinder(12, 1),
          shapes::closed_cylinder(32, 3),
          shapes::closed_cylinder(3, 1),
          shapes::of_quads(shapes::quad_torus(12, 8)),
          shapes::of_quads(shapes::quad_torus(3, 3)),
          shapes::uv_ball(12, 7),
          shapes::of_quads(shapes::plate({"###", "#.#", "###"}, 1)),
          shapes::one_sided(12, 2, false),
          shapes::one_sided(16, 8, true)};
}

TEST(FlattenPolygons, CutsRunAlongRealEdgesOnly) {
  std::mt19937 random(5);
  const std::vector<shapes::PolygonMesh> meshes = polygon_meshes();
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (int round = 0; round < 8; ++round) {
      shapes::PolygonMesh mesh = meshes[m];
      const double moved = round % 2 == 0 ? 0.0 : 0.01;
      std::normal_distribution<double> noise;
      for (Vector& p : mesh.points) p += moved * Vector(noise(random), noise(random), noise(random));
      if (round > 3) {
        for (auto& polygon : mesh.polygons) {
          std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(random() % polygon.size()),
                      polygon.end());
          if (random() % 4 == 0) std::ranges::reverse(polygon);
        }
      }
      const Surface surface = mesh.surface(round % 2 == 0 ? shapes::Cutting::kFan : shapes::Cutting::kStrip);
      for (const Edge& edge : surface.report().unorientable_edges) {
        EXPECT_TRUE(std::ranges::binary_search(surface.edges(), edge));
      }
      std::vector<Edge> cuts;
      for (int i = 0; i < round % 4; ++i) cuts.push_back(surface.edges()[random() % surface.edges().size()]);
      SCOPED_TRACE(testing::Message() << "mesh " << m << ", round " << round);
      expect_map_of_polygons(mesh, surface, cuts);
    }
  }
}

TEST(FlattenPolygons, EachSingleSeamOfABallIsFine) {
  for (const shapes::PolygonMesh& mesh :
       {shapes::uv_ball(12, 8), shapes::of_quads(shapes::quad_torus(12, 8)), shapes::of_quads(shapes::quad_cube(1))}) {
    const Surface surface = mesh.surface();
    for (std::size_t e = 0; e < surface.edges().size(); e += 3) {
      SCOPED_TRACE(e);
      expect_map_of_polygons(mesh, surface, std::vector<Edge>{surface.edges()[e]});
    }
  }
}

TEST(FlattenPolygons, LargePolygonsHaveMaps) {
  for (const auto cutting : {shapes::Cutting::kFan, shapes::Cutting::kStrip}) {
    const shapes::PolygonMesh mesh = shapes::closed_cylinder(4096, 1);
    const Surface surface = mesh.surface(cutting);
    const Flattening flat = flatten(surface, {});
    EXPECT_TRUE(std::isfinite(flat.energy));
    const MapReport report = measure_map(surface, flat.uvs, flat.islands);
    EXPECT_TRUE(report.flipped.empty() && report.overlapping.empty());
  }
}

TEST(FlattenPolygons, AFlatPolygonIsItsOwnMap) {
  // A comb of 300 teeth, each as a triangle upon a strip.
  shapes::PolygonMesh mesh;
  std::vector<std::int32_t> comb;
  std::vector<Triangle> triangles;
  const Eigen::Vector3d along(0.6, 0.8, 0.0), up(0.0, 0.0, 1.0);
  const std::int32_t teeth = 300;
  for (std::int32_t i = 0; i <= teeth; ++i) mesh.points.push_back(i * along - up);
  for (std::int32_t i = teeth; i >= 0; --i) {
    mesh.points.push_back(i * along);
    if (i > 0) mesh.points.push_back((i - 0.5) * along + 20.0 * up);
  }
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.points.size()); ++v) comb.push_back(v);
  const auto upper = [&](std::int32_t i) { return teeth + 1 + 2 * (teeth - i); };
  for (std::int32_t i = 0; i < teeth; ++i) {
    triangles.push_back({i, i + 1, upper(i + 1)});
    triangles.push_back({i, upper(i + 1), upper(i)});
    triangles.push_back({upper(i), upper(i + 1), upper(i + 1) + 1});
  }
  mesh.polygons.push_back(comb);
  const Flattening flat = flatten(Surface(mesh.points, triangles, mesh.edges()), {});
  EXPECT_NEAR(flat.energy, 4.0, 1e-9);
  EXPECT_LE(flat.by_island[0].steps, 1U);
}

TEST(FlattenPolygons, AFanOfFiftyThousandTrianglesHasAMap) {
  const int n = 50000;
  shapes::Mesh mesh;
  mesh.points.emplace_back(0, 0, 0.2);
  for (std::int32_t i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n, radius = 1.0 + 0.2 * std::sin(5 * a);
    mesh.points.emplace_back(radius * std::cos(a), radius * std::sin(a), 0.1 * std::cos(3 * a));
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  const Surface surface = mesh.surface();
  const Flattening flat = flatten(surface, {});
  EXPECT_LT(flat.energy, 4.1);
  const MapReport report = measure_map(surface, flat.uvs, flat.islands);
  EXPECT_TRUE(report.flipped.empty() && report.overlapping.empty());
}

TEST(FlattenPolygons, QuadsOnTheSameDiagonalKeepTheirOwn) {
  // Two quads that share two opposite corners: their diagonals join the same two vertices.
  const shapes::PolygonMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}, {0, 1, 1}},
                                 {{0, 1, 2, 3}, {0, 4, 2, 5}}};
  const Surface surface = mesh.surface();
  EXPECT_TRUE(surface.report().nonmanifold_edges.empty());
  EXPECT_EQ(face_segments(surface, {}), (std::vector<std::int32_t>{0, 0, 1, 1}));
  expect_map_of_polygons(mesh, surface, {});
}

TEST(FlattenPolygons, PolygonsWithACommonTriangleStayWhole) {
  // Vertex 1 is in two quads only, which both have the triangle 0 1 2, turned differently.
  const shapes::PolygonMesh mesh{{{0, 0, 0}, {1, 0, 0.2}, {2, 0, 0}, {1, 1, 0}, {1, -1, 0}},
                                 {{0, 1, 2, 3}, {2, 1, 0, 4}}};
  const Surface surface(mesh.points, {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {2, 0, 4}}, mesh.edges());
  EXPECT_TRUE(surface.report().duplicate_faces.empty());
  EXPECT_TRUE(surface.report().nonmanifold_edges.empty());
  EXPECT_EQ(face_segments(surface, {}), (std::vector<std::int32_t>(4, 0)));
  expect_map_of_polygons(mesh, surface, {});
  // A quad that is there twice is left out still.
  EXPECT_EQ(Surface(mesh.points, {{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 2, 3}}, mesh.edges()).report().duplicate_faces,
            (std::vector<std::int32_t>{2, 3}));
}

TEST(FlattenPolygons, AnInnerVertexOfTwoTrianglesIsReachedByACut) {
  // A sheet of quads. One side has a bend, which is a corner of two polygons only. Both have a triangle there.
  shapes::PolygonMesh mesh = shapes::of_quads(shapes::quad_grid(6));
  const auto bend = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.emplace_back(0.55, 0.6, 0.1);
  for (auto& polygon : mesh.polygons) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const auto [a, b] = std::minmax(polygon[i], polygon[(i + 1) % polygon.size()]);
      if (a != 24 || b != 31) continue;
      polygon.insert(polygon.begin() + static_cast<std::ptrdiff_t>(i) + 1, bend);
      // The triangle at the bend comes first.
      std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(i), polygon.end());
      break;
    }
  }
  const Surface surface = mesh.surface();
  const Flattening flat = flatten(surface, {});
  EXPECT_GT(flat.by_island[0].opened, 0U);
  EXPECT_LT(flat.by_island[0].opened, 10U);
  expect_map_of_polygons(mesh, surface, {});
}

/// A tube of quads. `is_closed`: whether the end of the last row has a face.
shapes::PolygonMesh tube(int sides, int rows, double row_height, bool is_closed) {
  shapes::PolygonMesh mesh = shapes::closed_cylinder(sides, rows, 0.2, row_height * rows);
  const std::vector<std::int32_t> end = mesh.polygons.back();
  mesh.polygons.resize(mesh.polygons.size() - 2);
  if (is_closed) mesh.polygons.push_back(end);
  return mesh;
}

TEST(FlattenPolygons, ALongTubeIsOpenedFromEndToEnd) {
  const Flattening flat = flatten(tube(8, 300, 0.1, false).surface(), {});
  EXPECT_EQ(flat.by_island[0].opened, 300U);
  EXPECT_LT(flat.energy, 4.01);
}

TEST(FlattenPolygons, ATubeWithAnEndClosedIsOpenedIfSinglePrecisionWouldLoseItsFaces) {
  // Double precision holds Tutte's embedding, but in its shrunken part Newton's method gets nowhere.
  const Flattening flat = flatten(tube(4, 50, 0.3, true).surface(), {});
  EXPECT_EQ(flat.by_island[0].opened, 50U);
  EXPECT_LT(flat.by_island[0].energy, 5.0);
  EXPECT_FALSE(flat.by_island[0].overlaps);
}

TEST(FlattenPolygons, SlitsDoNotKeepALongTubeFromBeingOpened) {
  // Slits of one edge all around, so that each path meets some.
  std::vector<Edge> cuts;
  for (std::int32_t row = 2; row < 299; row += 2) {
    for (std::int32_t i = 0; i < 8; i += 2) cuts.push_back({row * 8 + i, row * 8 + i + 1});
  }
  const Flattening flat = flatten(tube(8, 300, 0.1, false).surface(), cuts);
  ASSERT_EQ(flat.by_island.size(), 1U);
  EXPECT_LE(flat.by_island[0].opened, 302U);
  EXPECT_LT(flat.energy, 5.0);
}

/// A flat sheet of n x n quads, with a fin upon each of some edges.
shapes::PolygonMesh sheet_with_fins(int n, int fins) {
  shapes::PolygonMesh mesh = shapes::of_quads(shapes::quad_grid(n));
  for (int i = 0; i < fins; ++i) {
    const int row = 1 + i / (n - 1), column = 1 + i % (n - 1);
    const std::int32_t a = row * (n + 1) + column, b = a + 1;
    const auto top = static_cast<std::int32_t>(mesh.points.size());
    mesh.points.push_back(mesh.points[static_cast<std::size_t>(a)] + Vector(0, 0, 0.1));
    mesh.points.push_back(mesh.points[static_cast<std::size_t>(b)] + Vector(0, 0, 0.1));
    mesh.polygons.push_back({a, b, top + 1, top});
  }
  return mesh;
}

TEST(FlattenPolygons, FinsAreIslandsOfTheirOwn) {
  const shapes::PolygonMesh mesh = sheet_with_fins(8, 20);
  const Surface surface = mesh.surface();
  const Flattening flat = flatten(surface, {});
  EXPECT_EQ(flat.islands, face_segments(surface, {}));
  EXPECT_EQ(flat.by_island.size(), 21U) << "a sheet and its fins";
  EXPECT_NEAR(flat.energy, 4.0, 1e-6);
  expect_map_of_polygons(mesh, surface, {});
}

TEST(FlattenPolygons, SheetsThatMeetInATAreIslandsOfTheirOwn) {
  shapes::PolygonMesh mesh;
  const int n = 6;
  for (int page = 0; page < 3; ++page) {
    const double a = std::numbers::pi / 2 * page;
    const auto first = static_cast<std::int32_t>(mesh.points.size());
    const auto at = [&](int i, int j) { return i == 0 && page > 0 ? j * (n + 1) : first + j * (n + 1) + i; };
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) mesh.points.emplace_back(i * std::cos(a), i * std::sin(a), j);
    }
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) mesh.polygons.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  const Surface surface = mesh.surface();
  EXPECT_EQ(std::ranges::max(face_segments(surface, {})), 2);
  expect_map_of_polygons(mesh, surface, {});
}

}  // namespace
}  // namespace seamwire
