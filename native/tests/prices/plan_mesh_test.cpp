// SPDX-License-Identifier: GPL-3.0-or-later
#include "prices/plan_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "shapes.hpp"

namespace seamwire {

using namespace detail;

namespace {

double area_of(const PlanMesh& mesh) {
  double sum = 0.0;
  for (const FaceFrame& frame : face_frames(mesh, {})) sum += frame.area;
  return sum;
}

TEST(PlanMesh, HasAreaOneWhateverTheUnit) {
  for (const double size : {1e-6, 1.0, 1e6, 1e100}) {
    shapes::Mesh ball = shapes::icosphere(2);
    for (Vector& point : ball.points) point *= size;
    const PlanMesh mesh = plan_mesh(ball.surface(), {});
    EXPECT_NEAR(area_of(mesh), 1.0, 1e-12) << size;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      const Vector scaled = mesh.scale * ball.points[static_cast<std::size_t>(mesh.sources[v])];
      EXPECT_LT((mesh.points[v] - scaled).norm(), 1e-12) << size;
    }
  }
}

TEST(PlanMesh, DoesNotDependOnTheOrderOfTriangles) {
  shapes::Mesh ball = shapes::icosphere(2);
  const PlanMesh mesh = plan_mesh(ball.surface(), {});
  std::mt19937 random(5);
  std::vector<std::int32_t> order(ball.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::shuffle(order, random);
  shapes::Mesh shuffled = ball;
  for (std::size_t f = 0; f < order.size(); ++f) {
    const Triangle& from = ball.triangles[order[f]];
    for (std::size_t i = 0; i < 3; ++i) shuffled.triangles[f][i] = from[(i + f) % 3];
  }
  const PlanMesh other = plan_mesh(shuffled.surface(), {});
  EXPECT_EQ(other.triangles, mesh.triangles);
  EXPECT_EQ(other.twins, mesh.twins);
  for (std::size_t f = 0; f < order.size(); ++f) EXPECT_EQ(order[other.faces[f]], mesh.faces[f]);
}

TEST(PlanMesh, NumbersEachEdgeOnce) {
  const PlanMesh mesh = plan_mesh(shapes::grid(3).surface(), {});
  EXPECT_EQ(mesh.vertex_count(), 16U);
  EXPECT_EQ(mesh.face_count(), 18U);
  EXPECT_EQ(mesh.edge_count(), 33U);
  std::size_t boundary = 0;
  for (std::int32_t e = 0; e < 33; ++e) {
    const std::int32_t h = mesh.half_edge_of[e];
    EXPECT_EQ(mesh.edge_of[h], e);
    if (mesh.twins[h] >= 0) {
      EXPECT_EQ(mesh.edge_of[mesh.twins[h]], e);
    }
    boundary += mesh.is_boundary(e) ? 1 : 0;
    EXPECT_EQ(mesh.edge_between(mesh.tail(h), mesh.tip(h)), e);
    EXPECT_EQ(mesh.edge_between(mesh.tip(h), mesh.tail(h)), e);
    EXPECT_NEAR(mesh.lengths[e], (mesh.points[mesh.tail(h)] - mesh.points[mesh.tip(h)]).norm(), 1e-5);
  }
  EXPECT_EQ(boundary, 12U);
  EXPECT_EQ(mesh.edge_between(0, 15), -1);
}

TEST(PlanMesh, DiagonalsOfPolygonsAreNoRealEdges) {
  const PlanMesh mesh = plan_mesh(shapes::quad_grid(3).surface(), {});
  EXPECT_EQ(std::ranges::count(mesh.is_real, 1), 24);
  EXPECT_EQ(mesh.edge_count(), 33U);
  EXPECT_EQ(mesh.edge_between(0, 5), -1) << "a diagonal";
  EXPECT_GE(mesh.edge_between(0, 1), 0);
  EXPECT_EQ(mesh.neighbors[5].size(), 4U);
  EXPECT_EQ(mesh.all_neighbors[5].size(), 6U);
}

TEST(PlanMesh, WithoutRealEdgesNoEdgeIsReal) {
  const shapes::Mesh ball = shapes::icosphere(1);
  const PlanMesh mesh = plan_mesh(Surface(ball.points, ball.triangles, std::vector<Edge>{}), {});
  EXPECT_EQ(std::ranges::count(mesh.is_real, 1), 0);
  EXPECT_EQ(mesh.neighbors[0].size(), 0U);
  EXPECT_EQ(mesh.all_neighbors[0].size(), 5U);
}

TEST(PlanMesh, PiecesThatMeetInAVertexAreApart) {
  const std::vector<Vector> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  const PlanMesh mesh = plan_mesh(Surface(points, {{0, 1, 2}, {0, 3, 4}}), {});
  EXPECT_EQ(mesh.vertex_count(), 6U);
  EXPECT_EQ(std::ranges::count(mesh.sources, 0), 2);
  EXPECT_EQ(find_pieces(mesh, std::vector<std::uint8_t>(mesh.edge_count(), 0), {}).count, 2);
}

TEST(PlanMesh, LeavesOutTrianglesWithoutCornersOfTheirOwn) {
  const std::vector<Vector> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}, {5, 5, 5}};
  const Surface surface(points, {{0, 0, 1}, {0, 1, 2}, {1, 2, 0}}, std::vector<Edge>{{0, 1}, {1, 2}, {0, 2}, {0, 4}});
  const PlanMesh mesh = plan_mesh(surface, {});
  EXPECT_EQ(mesh.faces, std::vector<std::int32_t>{1});
  EXPECT_EQ(mesh.sources, (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_NEAR(area_of(mesh), 1.0, 1e-12);
}

TEST(PlanMesh, NormalsOfABallPointOutwards) {
  const PlanMesh mesh = plan_mesh(shapes::icosphere(3).surface(), {});
  const std::vector<FaceFrame> frames = face_frames(mesh, {});
  const std::vector<Vector> normals = vertex_normals(mesh, frames, {});
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) EXPECT_GT(normals[v].dot(mesh.points[v].normalized()), 0.999);
  const std::vector<double> areas = vertex_areas(mesh, frames);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 1.0, 1e-12);
}

TEST(PlanMesh, PiecesAreNumberedByTheirFirstFaces) {
  const PlanMesh mesh = plan_mesh(shapes::grid(2).surface(), {});
  std::vector<std::uint8_t> is_cut(mesh.edge_count(), 0);
  EXPECT_EQ(find_pieces(mesh, is_cut, {}).count, 1);
  is_cut[mesh.edge_between(1, 4)] = is_cut[mesh.edge_between(4, 7)] = 1;
  const Pieces halves = find_pieces(mesh, is_cut, {});
  EXPECT_EQ(halves.count, 2);
  EXPECT_EQ(halves.of_face, (std::vector<std::int32_t>{0, 0, 1, 1, 0, 0, 1, 1}));
}

TEST(PlanMesh, MedianLength) {
  EXPECT_NEAR(plan_mesh(shapes::grid(4).surface(), {}).median_length, 0.25, 1e-12);
  EXPECT_EQ(PlanMesh().median_length, 0.0);
}

}  // namespace
}  // namespace seamwire
