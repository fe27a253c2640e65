// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/parting_cuts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "seam_problems.hpp"
#include "seams/group_planning.hpp"
#include "seamwire_uv/seams/seam_planner.hpp"
#include "slits/slit_tree.hpp"

namespace seamwire {

using namespace detail;

namespace {

SeamPlan plan_of(const Surface& surface, const SeamGoal& goal = {}, int mirror = -1) {
  const SeamPlannerOptions options{.along = Along::kEdges, .mirror = mirror};
  return SeamPlanner(std::make_shared<const Surface>(surface), options).plan(goal);
}

/// Polygons, triangulated in strips.
Surface polygons(const std::vector<Vector>& points, const std::vector<std::vector<std::int32_t>>& faces) {
  std::vector<Triangle> triangles;
  std::set<Edge> edges;
  for (const std::vector<std::int32_t>& face : faces) {
    for (std::size_t i = 0; i < face.size(); ++i) {
      const auto [a, b] = std::minmax(face[i], face[(i + 1) % face.size()]);
      edges.insert({a, b});
    }
    for (std::size_t low = 0, high = face.size() - 1; high - low > 1;) {
      if ((low + high) % 2 == face.size() % 2) {
        triangles.push_back({face[low], face[low + 1], face[high]});
        ++low;
      } else {
        triangles.push_back({face[low], face[high - 1], face[high]});
        --high;
      }
    }
  }
  return {points, triangles, std::vector<Edge>(edges.begin(), edges.end())};
}

/// A prism of two polygons with n corners, or a cone over one.
Surface prism(int n, double height, bool is_cone) {
  std::vector<Vector> points;
  std::vector<std::vector<std::int32_t>> faces;
  for (const double z : {0.0, height}) {
    for (int i = 0; i < n && !(is_cone && z > 0.0); ++i) {
      const double a = 2 * std::numbers::pi * i / n;
      points.emplace_back(0.5 * std::cos(a), 0.5 * std::sin(a), z);
    }
  }
  if (is_cone) points.emplace_back(0.0, 0.0, height);
  std::vector<std::int32_t> low, high;
  for (std::int32_t i = 0; i < n; ++i) {
    low.push_back(n - 1 - i);
    high.push_back(n + i);
    const std::int32_t next = (i + 1) % n;
    faces.push_back(is_cone ? std::vector{i, next, n} : std::vector{i, next, n + next, n + i});
  }
  faces.push_back(low);
  if (!is_cone) faces.push_back(high);
  return polygons(points, faces);
}

/// An open tube of quads around a helix with eight sides.
shapes::QuadMesh helix(int rows, double step, double large) {
  return shapes::parametric_quads(8, rows, true, false, [=](double u, double v) {
    const double a = 2 * std::numbers::pi * u, turn = v * rows * step / large;
    const Vector outwards(std::cos(turn), std::sin(turn), 0.0);
    const Vector middle = large * outwards + Vector(0.0, 0.0, 0.175 * turn);
    return Vector(middle + 0.25 * (std::cos(a) * outwards + std::sin(a) * Vector(0.0, 0.0, 1.0)));
  });
}

double length_of(const Surface& surface, const SeamPlan& plan) {
  double sum = 0.0;
  for (const PlannedWire& wire : plan.wires) {
    for (std::size_t i = 1; i < wire.vertices.size(); ++i) {
      sum += (surface.points()[wire.vertices[i]] - surface.points()[wire.vertices[i - 1]]).norm();
    }
  }
  return sum;
}

/// The plan has a map without flips and overlaps.
void expect_map(const Surface& surface, const SeamPlan& plan) {
  EXPECT_EQ(plan.islands_to_cut, 0U);
  ASSERT_EQ(plan.uvs.size(), surface.face_count());
  const MapReport report = measure_map(surface, plan.uvs, plan.islands);
  EXPECT_TRUE(report.flipped.empty());
  EXPECT_TRUE(report.overlapping.empty());
}

/// The map is within the bound too.
void expect_valid(const Surface& surface, const SeamPlan& plan) {
  EXPECT_TRUE(plan.is_reached);
  expect_map(surface, plan);
}

TEST(PartingCuts, RimsOfManyCornersAreCut) {
  for (const bool is_cone : {false, true}) {
    const Surface surface = prism(1500, 1.0, is_cone);
    const SeamPlan plan = plan_of(surface);
    expect_valid(surface, plan);
    EXPECT_EQ(plan.island_count, is_cone ? 2U : 3U);
    EXPECT_LT(plan.energy, 4.001);
    EXPECT_LT(plan.steps, 100.0);
  }
}

TEST(PartingCuts, ALaterSearchHasItsOwnShareOfTheProgress) {
  const Surface surface = prism(1500, 1.0, false);
  GroupProblem group;
  group.original = problem_on(surface);
  GroupPlanning planning(group);
  planning.grow(true, {});
  std::vector<double> fractions;
  const Task watched{.stop = {}, .progress = [&](double fraction) {
                       fractions.push_back(fraction);
                       return true;
                     }};
  planning.search({}, {}, watched);
  ASSERT_GT(planning.result().maps.maps.size(), 1U) << "a later search has taken place";
  // The later search takes its share of what the first one leaves.
  EXPECT_GE(std::ranges::max(fractions), 0.75);
  EXPECT_LT(std::ranges::max(fractions), 1.0);
}

TEST(PartingCuts, RimsOfFewCornersStay) {
  const SlitProblem cube = problem_on(shapes::quad_cube(2).surface());
  EXPECT_TRUE(rim_cuts(cube, std::vector<std::int32_t>{0}, {}).empty());
  const Surface surface = prism(12, 1.0, false);
  EXPECT_TRUE(rim_cuts(problem_on(surface), std::vector<std::int32_t>{0}, {}).empty());
}

TEST(PartingCuts, TheLeastNumberOfIslandsHolds) {
  const std::vector<std::pair<Surface, std::size_t>> surfaces = {
      {shapes::icosphere(2).surface(), 7},      {shapes::quad_cube(1).surface(), 6},
      {shapes::quad_torus(12, 8).surface(), 7}, {shapes::quad_grid(6).surface(), 36},
      {shapes::dumbbell(12, 20).surface(), 9},  {prism(64, 1.0, false), 66},
  };
  for (const auto& [surface, most] : surfaces) {
    for (const std::size_t wanted : {std::size_t{2}, std::size_t{4}, most}) {
      for (const int mirror : {-1, 0}) {
        const SeamPlan plan = plan_of(surface, {.distortion = 4.4, .islands = wanted}, mirror);
        EXPECT_GE(plan.island_count, wanted);
        EXPECT_LE(plan.island_count, wanted + 1);  // mirrored pieces are cut together
        expect_map(surface, plan);
      }
    }
  }
  EXPECT_EQ(plan_of(shapes::quad_cube(1).surface(), {.islands = 9}).island_count, 6U) << "one for each face";
}

TEST(PartingCuts, TheLeastNumberOfIslandsHoldsForSeveralPieces) {
  shapes::QuadMesh cubes = shapes::quad_cube(2);
  const shapes::QuadMesh other = shapes::quad_cube(3);
  const auto first = static_cast<std::int32_t>(cubes.points.size());
  for (const Vector& point : other.points) cubes.points.push_back(2.0 * point + Vector(3.0, 0.0, 0.0));
  for (const auto& [a, b, c, d] : other.quads) cubes.quads.push_back({first + a, first + b, first + c, first + d});
  const Surface surface = cubes.surface();
  const SeamPlan plan = plan_of(surface, {.islands = 5});
  EXPECT_EQ(plan.island_count, 5U);
  expect_valid(surface, plan);
}

TEST(PartingCuts, TheLeastNumberOfIslandsHoldsOnASimplifiedMesh) {
  const Surface surface = shapes::quad_cylinder(8, 1000, 0.25, 200.0).surface();
  const SeamPlan plan = plan_of(surface, {.islands = 4});
  EXPECT_GE(plan.island_count, 4U);
  expect_valid(surface, plan);
}

TEST(PartingCuts, HalvesAreOfComparableSizeAndSymmetric) {
  const SlitProblem problem = problem_on(shapes::icosphere(3).surface(), {.mirror = 0});
  SlitProblem parted = problem;
  parted.is_seam = cut_of(problem, halving_cuts(problem, 2, {}), {}).is_cut;
  find_pieces_of(parted, {});
  ASSERT_EQ(parted.pieces.count, 2);
  for (const SlitProblem::Piece& piece : parted.by_piece) EXPECT_GT(piece.area, 0.29);
  const PlanMesh& mesh = *problem.mesh;
  for (std::int32_t e = 0; e < static_cast<std::int32_t>(mesh.edge_count()); ++e) {
    const std::int32_t a = problem.reflection->images[mesh.tail(mesh.half_edge_of[e])];
    const std::int32_t b = problem.reflection->images[mesh.tip(mesh.half_edge_of[e])];
    EXPECT_EQ(parted.is_seam[e], parted.is_seam[mesh.edge_between(a, b)]);
  }
}

TEST(PartingCuts, KeepOutAreasAreNotParted) {
  const Surface surface = shapes::quad_grid(4).surface();
  const SlitProblem problem = problem_on(surface, {.weights = std::vector<double>(surface.vertex_count(), kInfinity)});
  EXPECT_TRUE(halving_cuts(problem, 4, {}).empty());
  EXPECT_EQ(count_blocks(problem), 1U);
}

TEST(PartingCuts, ALongTubeIsCutLengthwise) {
  // Straight, and so long that a circle holds no good start; bent, with ends that are open to all sides.
  const std::vector<std::pair<Surface, double>> tubes = {
      {shapes::quad_cylinder(8, 3000, 0.25, 3000.0).surface(), 3000.0}, {helix(3000, 0.5, 20.0).surface(), 1500.0}};
  for (const auto& [surface, length] : tubes) {
    const SeamPlan plan = plan_of(surface);
    expect_valid(surface, plan);
    EXPECT_EQ(plan.island_count, 1U);
    EXPECT_LT(plan.energy, 4.01);
    EXPECT_LT(length_of(surface, plan), 1.05 * length);
    EXPECT_LT(plan.steps, 1000.0);
  }
}

TEST(PartingCuts, TheEndOfATubeIsNoHoleInAnExposedPlace) {
  SlitProblem problem = problem_on(shapes::quad_cylinder(12, 40, 0.1, 2.0).surface());
  std::ranges::fill(problem.prices.is_exposed, 1);
  const SlitTree tree = grow_tree(problem, {.has_tips = true, .keeps_holes = false}, {});
  const auto island = open_piece(problem, cut_of(problem, tree.slits, tree.roots), 0, {});
  ASSERT_TRUE(island);
  EXPECT_EQ(island->boundaries().size(), 1U);
}

/// A plate of quads in z = 0 with fins on it, whose lower edges are edges of the plate.
Surface plate_with_fins(int fins) {
  const int columns = fins + 2;
  std::vector<Vector> points;
  std::vector<std::vector<std::int32_t>> faces;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < columns; ++i) points.emplace_back(i, j, 0.0);
  }
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i + 1 < columns; ++i) {
      const int a = j * columns + i;
      faces.push_back({a, a + 1, a + columns + 1, a + columns});
    }
  }
  for (int f = 1; f <= fins; ++f) {
    const auto top = static_cast<std::int32_t>(points.size());
    for (int j = 0; j < 3; ++j) points.emplace_back(f, j, 1.0);
    for (int j = 0; j < 2; ++j) faces.push_back({j * columns + f, (j + 1) * columns + f, top + j + 1, top + j});
  }
  return polygons(points, faces);
}

TEST(PartingCuts, SheetsThatMeetInNonManifoldEdgesAreApart) {
  for (const int fins : {1, 20}) {  // one fin: three sheets
    const Surface surface = plate_with_fins(fins);
    const SeamPlan plan = plan_of(surface);
    EXPECT_EQ(plan.island_count, static_cast<std::size_t>(2 * fins + 1));
    EXPECT_TRUE(plan.wires.empty());
    EXPECT_NEAR(plan.energy, 4.0, 1e-9);
    expect_valid(surface, plan);
  }
}

}  // namespace

}  // namespace seamwire
