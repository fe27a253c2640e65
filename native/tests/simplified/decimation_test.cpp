// SPDX-License-Identifier: GPL-3.0-or-later
#include "simplified/decimation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stop_token>
#include <vector>

#include "seam_problems.hpp"

namespace seamwire {

using namespace detail;

namespace {

DecimatedMesh simplify(const SlitProblem& problem, std::size_t triangles) {
  return decimate(problem.mesh, problem.is_seam, problem.mirror(), triangles, {});
}

std::int64_t euler(const PlanMesh& mesh) {
  return static_cast<std::int64_t>(mesh.vertex_count()) - static_cast<std::int64_t>(mesh.edge_count()) +
         static_cast<std::int64_t>(mesh.face_count());
}

/// Half-edges are twins of each other, and run in opposite directions.
void expect_manifold(const PlanMesh& mesh) {
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(mesh.twins.size()); ++h) {
    const std::int32_t twin = mesh.twins[h];
    if (twin < 0) continue;
    ASSERT_EQ(mesh.twins[twin], h);
    ASSERT_EQ(mesh.tail(twin), mesh.tip(h));
    ASSERT_EQ(mesh.tip(twin), mesh.tail(h));
  }
  for (const Triangle& t : mesh.triangles) ASSERT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
}

TEST(Decimation, KeepsShapeAndTopology) {
  for (const shapes::Mesh& shape : {shapes::icosphere(3), shapes::torus(40, 20), shapes::cylinder(24, 16)}) {
    const SlitProblem problem = problem_on(shape.surface());
    const DecimatedMesh simple = simplify(problem, 300);
    EXPECT_LE(simple.mesh.face_count(), 301U);
    EXPECT_GE(simple.mesh.face_count(), 250U);
    expect_manifold(simple.mesh);
    EXPECT_EQ(euler(simple.mesh), euler(problem.mesh));
    double area = 0.0;
    for (const FaceFrame& frame : face_frames(simple.mesh)) area += frame.area;
    EXPECT_NEAR(area, 1.0, 0.05);
    for (std::size_t v = 0; v < simple.mesh.vertex_count(); ++v) {
      EXPECT_EQ(simple.mesh.points[v], problem.mesh.points[simple.vertices[v]]);
      EXPECT_EQ(simple.mesh.sources[v], problem.mesh.sources[simple.vertices[v]]);
    }
  }
}

TEST(Decimation, SpendsTrianglesWhereTheShapeBends) {
  // A flat square needs few triangles, and its outline stays.
  const SlitProblem problem = problem_on(shapes::grid(16).surface());
  const DecimatedMesh simple = simplify(problem, 8);
  EXPECT_LE(simple.mesh.face_count(), 8U);
  double area = 0.0;
  for (const FaceFrame& frame : face_frames(simple.mesh)) area += frame.area;
  EXPECT_NEAR(area, 1.0, 1e-12);
}

TEST(Decimation, KeepsSeams) {
  const shapes::Mesh shape = shapes::torus(40, 20);
  std::vector<Edge> seams;
  for (std::int32_t i = 0; i < 40; ++i) seams.push_back({i, (i + 1) % 40});
  const SlitProblem problem = problem_on(shape.surface(), {.seams = seams});
  const DecimatedMesh simple = simplify(problem, 300);
  double length = 0.0;
  std::vector<std::size_t> at(simple.mesh.vertex_count(), 0);
  for (std::size_t e = 0; e < simple.mesh.edge_count(); ++e) {
    if (simple.is_seam[e] == 0) continue;
    length += simple.mesh.lengths[e] / simple.mesh.scale;
    ++at[simple.mesh.tail(simple.mesh.half_edge_of[e])];
    ++at[simple.mesh.tip(simple.mesh.half_edge_of[e])];
  }
  EXPECT_NEAR(length, 2 * std::numbers::pi * 0.5, 0.1) << "the outer equator";
  for (const std::size_t count : at) EXPECT_TRUE(count == 0 || count == 2) << "it is closed";
}

TEST(Decimation, StaysSymmetric) {
  const SlitProblem problem = problem_on(shapes::dumbbell(24, 40).surface(), {.mirror = 0});
  ASSERT_TRUE(problem.reflection && problem.reflection->is_exact);
  const DecimatedMesh simple = simplify(problem, 500);
  EXPECT_LE(simple.mesh.face_count(), 520U);
  const std::optional<Reflection> found = find_reflection(simple.mesh, 0);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->is_exact);
  for (std::size_t v = 0; v < simple.mesh.vertex_count(); ++v) {
    ASSERT_GE(found->images[v], 0);
    const Vector image = found->mirrored(simple.mesh.points[v]);
    EXPECT_LT((simple.mesh.points[found->images[v]] - image).norm(), 1e-12);
  }
}

/// A fan around a vertex, or a cone over it: the vertex is the last one.
Surface fan(int count, double height) {
  std::vector<Vector> points;
  std::vector<Triangle> triangles;
  for (std::int32_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    triangles.push_back({i, (i + 1) % count, count});
  }
  points.emplace_back(0.0, 0.0, height);
  return {points, triangles};
}

TEST(Decimation, AVertexMayHaveManyTriangles) {
  // With work that grows with the square of their number, this test would not end.
  for (const double height : {0.0, 2.0}) {
    const PlanMesh mesh = plan_mesh(fan(100'000, height));
    const DecimatedMesh simple = decimate(mesh, std::vector<std::uint8_t>(mesh.edge_count(), 0), nullptr, 7000, {});
    EXPECT_LE(simple.mesh.face_count(), 7000U);
    EXPECT_EQ(euler(simple.mesh), 1);
    double area = 0.0;
    for (const FaceFrame& frame : face_frames(simple.mesh)) area += frame.area;
    EXPECT_NEAR(area, 1.0, 1e-3);
  }
}

TEST(Decimation, IsTheMeshIfThatIsSmall) {
  const SlitProblem problem = problem_on(shapes::icosphere(1).surface());
  const DecimatedMesh simple = simplify(problem, 100);
  EXPECT_EQ(simple.mesh.triangles, problem.mesh.triangles);
  EXPECT_EQ(simple.mesh.twins, problem.mesh.twins);
}

TEST(Decimation, ATetrahedronStaysOne) {
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
  EXPECT_EQ(simplify(problem_on(surface), 1).mesh.face_count(), 4U);
}

TEST(Decimation, IsCancelled) {
  const SlitProblem problem = problem_on(shapes::icosphere(3).surface());
  std::stop_source stop;
  stop.request_stop();
  const Task task{.stop = stop.get_token(), .progress = {}};
  EXPECT_THROW(decimate(problem.mesh, problem.is_seam, nullptr, 100, task), Cancelled);
}

TEST(Decimation, AsksItsTaskWhileItStarts) {
  const PlanMesh mesh = plan_mesh(shapes::icosphere(6).surface());
  std::size_t looks = 0;
  const Task task{.stop = {}, .progress = [&](double) { return ++looks > 0; }};
  decimate(mesh, std::vector<std::uint8_t>(mesh.edge_count(), 0), nullptr, mesh.face_count(), task);
  // Over its triangles, edges and vertices, with a look at the task once in 4096 steps.
  EXPECT_GE(looks, (mesh.face_count() + mesh.edge_count() + mesh.vertex_count()) / 4096);
}

}  // namespace
}  // namespace seamwire
