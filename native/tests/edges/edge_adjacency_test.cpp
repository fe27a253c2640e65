// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "seamwire/edges/edge_loop.hpp"
#include "shapes.hpp"

namespace seamwire {
namespace {

using Chain = std::vector<std::int32_t>;

std::int32_t vertex_at(const Surface& surface, double x, double y, double z) {
  const auto it = std::ranges::find(surface.points(), Vector(x, y, z));
  return static_cast<std::int32_t>(it - surface.points().begin());
}

EdgeLoop strip_of(const Surface& surface, const Edge& edge, const Chain& stops = {}) {
  return edge_loop(*make_edge_adjacency(surface), edge, stops);
}

// ---------------------------------------------------------------------------------------------------------------------
// Running on

TEST(RunOn, FollowsTheRingsOfATorusUntilItMeetsItself) {
  const int nu = 12, nv = 8;
  const auto adjacency = make_edge_adjacency(shapes::quad_torus(nu, nv).surface());
  Chain around;
  for (int i = 1; i <= nu; ++i) around.push_back(i % nu);
  EXPECT_EQ(extend_straight(*adjacency, {0, 1}, {}), around) << "up to the vertex it came from";
  Chain down{nu * (nv - 1)};
  for (int j = nv - 2; j >= 0; --j) down.push_back(nu * j);
  EXPECT_EQ(extend_straight(*adjacency, {0, nu * (nv - 1)}, {}), down);
}

TEST(RunOn, StopsAtAStopButNotAtItsBeginning) {
  const auto adjacency = make_edge_adjacency(shapes::quad_torus(12, 8).surface());
  const Chain stops{1, 4, 90};
  EXPECT_EQ(extend_straight(*adjacency, {0, 1}, stops), (Chain{1, 2, 3, 4}));
  EXPECT_EQ(extend_straight(*adjacency, {0, 1}, Chain{0}).back(), 0);
}

TEST(RunOn, StopsAtABoundaryAndGoesOnAlongOne) {
  const auto adjacency = make_edge_adjacency(shapes::quad_grid(4).surface());  // five vertices a row
  EXPECT_EQ(extend_straight(*adjacency, {2, 7}, {}), (Chain{7, 12, 17, 22}));
  EXPECT_EQ(extend_straight(*adjacency, {7, 2}, {}), Chain{2}) << "already there";
  EXPECT_EQ(extend_straight(*adjacency, {0, 1}, {}), (Chain{1, 2, 3, 4, 9, 14, 19, 24, 23, 22, 21, 20, 15, 10, 5, 0}))
      << "a boundary does not turn at its corners";
}

TEST(RunOn, GoesAroundTheEdgeOfACubeOnlyWhereThatIsStraight) {
  // At a corner of the cube three right angles meet: the two ways on turn by 60 degrees.
  const int n = 4;
  const Surface surface = shapes::quad_cube(n).surface();
  const auto adjacency = make_edge_adjacency(surface);
  const auto find = [&](double x, double y, double z) {
    const auto it = std::ranges::find(surface.points(), Vector(x, y, z));
    return static_cast<std::int32_t>(it - surface.points().begin());
  };
  const Chain rim = extend_straight(*adjacency, {find(0, 0, 0), find(0.25, 0, 0)}, {});
  EXPECT_EQ(rim, (Chain{find(0.25, 0, 0), find(0.5, 0, 0), find(0.75, 0, 0), find(1, 0, 0)}));
  const Chain ring = extend_straight(*adjacency, {find(0.25, 0.5, 1), find(0.5, 0.5, 1)}, {});
  EXPECT_EQ(ring.size(), 4 * n) << "over four sides and back";
  EXPECT_EQ(ring.back(), find(0.25, 0.5, 1));
}

TEST(RunOn, KeepsToAStraightLineOnTriangles) {
  const auto adjacency = make_edge_adjacency(shapes::grid(6).surface());
  EXPECT_EQ(extend_straight(*adjacency, {8, 16}, {}), (Chain{16, 24, 32, 40, 48})) << "along the diagonals";
}

TEST(RunOn, GoesOnInSpaceWhereFacesAreNoFan) {
  // A chain of loose edges: straight on by 45 degrees, not by 90.
  const std::vector<Vector> points = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {5, 5, 5}, {6, 5, 5}, {5, 6, 5}};
  const Surface surface(points, {{4, 5, 6}}, std::vector<Edge>{{0, 1}, {1, 2}, {2, 3}, {4, 5}, {5, 6}, {4, 6}});
  EXPECT_EQ(extend_straight(*make_edge_adjacency(surface), {0, 1}, {}), (Chain{1, 2}));
}

TEST(RunOn, RefusesWhatIsNoEdge) {
  const auto adjacency = make_edge_adjacency(shapes::quad_grid(2).surface());
  for (const Edge& edge : {Edge{0, 4}, Edge{0, 9}, Edge{-1, 0}, Edge{1, 1}}) {
    EXPECT_THROW(extend_straight(*adjacency, edge, {}), InvalidInput);
  }
}

// ---------------------------------------------------------------------------------------------------------------------
// Strips

TEST(EdgeLoop, RunsThroughAGridFromBoundaryToBoundary) {
  const Surface surface = shapes::quad_grid(4).surface();  // five vertices a row
  const EdgeLoop strip = strip_of(surface, {12, 13});
  EXPECT_EQ(strip.vertices, (Chain{10, 11, 12, 13, 14}));
  EXPECT_FALSE(strip.closed);
  EXPECT_EQ(strip_of(surface, {13, 12}).vertices, (Chain{14, 13, 12, 11, 10})) << "the edge has a direction";
  EXPECT_EQ(strip_of(surface, {2, 7}).vertices, (Chain{2, 7, 12, 17, 22}));
}

TEST(EdgeLoop, RunsAlongABoundaryToTheCornersOfSingleFaces) {
  const Surface surface = shapes::quad_grid(4).surface();
  EXPECT_EQ(strip_of(surface, {1, 2}).vertices, (Chain{0, 1, 2, 3, 4}));
  EXPECT_EQ(strip_of(surface, {9, 4}).vertices, (Chain{24, 19, 14, 9, 4}));

  // The border of a hole has no such corners.
  const auto outside = [](const auto& q) { return q[0] != 6; };
  shapes::QuadMesh hole = shapes::quad_grid(4);
  std::erase_if(hole.quads, [&](const auto& q) { return !outside(q); });
  const EdgeLoop rim = strip_of(hole.surface(), {6, 7});
  EXPECT_TRUE(rim.closed);
  EXPECT_EQ(rim.vertices, (Chain{6, 7, 12, 11}));
}

TEST(EdgeLoop, IsARingOnACylinderAndATorus) {
  const int n = 12;
  const Surface cylinder = shapes::quad_cylinder(n, 3).surface();
  for (int row = 0; row < 4; ++row) {  // the first and the last are boundaries
    const EdgeLoop ring = strip_of(cylinder, {n * row + 3, n * row + 4});
    EXPECT_TRUE(ring.closed);
    Chain expected;
    for (int i = 3; i < 3 + n; ++i) expected.push_back(n * row + i % n);
    EXPECT_EQ(ring.vertices, expected);
  }
  EXPECT_EQ(strip_of(cylinder, {n + 5, 2 * n + 5}).vertices, (Chain{5, n + 5, 2 * n + 5, 3 * n + 5}));

  const int nu = 12, nv = 8;
  const EdgeLoop around = strip_of(shapes::quad_torus(nu, nv).surface(), {2 * nu + 7, nu + 7});
  EXPECT_TRUE(around.closed);
  EXPECT_EQ(around.vertices.size(), nv);
  EXPECT_EQ((Chain{around.vertices[0], around.vertices[1]}), (Chain{2 * nu + 7, nu + 7}));
}

TEST(EdgeLoop, EndsAtStopsOnBothSides) {
  const int nu = 12;
  const Surface surface = shapes::quad_torus(nu, 8).surface();
  const EdgeLoop part = strip_of(surface, {4, 5}, {2, 8, 10});
  EXPECT_FALSE(part.closed);
  EXPECT_EQ(part.vertices, (Chain{2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(strip_of(surface, {4, 5}, {4, 5}).vertices, (Chain{4, 5})) << "stops at its own ends";
  EXPECT_EQ(strip_of(surface, {4, 5}, {5, 2}).vertices, (Chain{2, 3, 4, 5}));
  for (const std::int32_t stop : {2, 4, 5}) {  // around, and to the same stop again
    const EdgeLoop ring = strip_of(surface, {4, 5}, {stop});
    EXPECT_TRUE(ring.closed);
    EXPECT_EQ(ring.vertices.size(), nu);
    EXPECT_EQ(ring.vertices.front(), stop);
  }
}

TEST(EdgeLoop, EndsAtThePolesOfACube) {
  const int n = 4;
  const Surface surface = shapes::quad_cube(n).surface();
  const auto find = [&](double x, double y, double z) { return vertex_at(surface, x, y, z); };
  const EdgeLoop rim = strip_of(surface, {find(0.25, 0, 0), find(0.5, 0, 0)});
  EXPECT_FALSE(rim.closed);
  EXPECT_EQ(rim.vertices, (Chain{find(0, 0, 0), find(0.25, 0, 0), find(0.5, 0, 0), find(0.75, 0, 0), find(1, 0, 0)}));
  const EdgeLoop ring = strip_of(surface, {find(0.25, 0.5, 1), find(0.5, 0.5, 1)});
  EXPECT_TRUE(ring.closed);
  EXPECT_EQ(ring.vertices.size(), 4 * n);
}

TEST(EdgeLoop, FollowsTheThreeDirectionsOfATriangleGrid) {
  const Surface surface = shapes::grid(6).surface();  // seven vertices a row, diagonals up to the right
  EXPECT_EQ(strip_of(surface, {24, 25}).vertices, (Chain{21, 22, 23, 24, 25, 26, 27}));
  EXPECT_EQ(strip_of(surface, {24, 31}).vertices, (Chain{3, 10, 17, 24, 31, 38, 45}));
  EXPECT_EQ(strip_of(surface, {24, 32}).vertices, (Chain{0, 8, 16, 24, 32, 40, 48}));
  // A vertex of five triangles is a pole.
  const Surface ico = shapes::icosphere(2).surface();
  const EdgeLoop strip = strip_of(ico, {0, ico.edges()[0][1]});
  EXPECT_FALSE(strip.closed);
  EXPECT_EQ(strip.vertices.size(), 5U) << "four edges from one vertex of the icosahedron to the next";
  EXPECT_EQ(strip.vertices.front(), 0);
  EXPECT_LT(strip.vertices.back(), 12);
}

TEST(EdgeLoop, GoesOnWhereFourEdgesPartTrianglesFromQuads) {
  // Two quads below the row 3-4-5, and two triangles with the apex 6 above it.
  const std::vector<Vector> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {1, 2, 0}};
  const std::vector<Triangle> faces = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {3, 4, 6}, {4, 5, 6}};
  const std::vector<Edge> quads = {{0, 1}, {1, 2}, {0, 3}, {1, 4}, {2, 5}, {3, 4}, {4, 5}, {3, 6}, {4, 6}, {5, 6}};
  EXPECT_EQ(strip_of(Surface(points, faces, quads), {3, 4}).vertices, (Chain{3, 4, 5}));
  // Four triangles alone: a pole of a triangle mesh.
  EXPECT_EQ(strip_of(Surface({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 0}},
                             {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}),
                     {0, 4})
                .vertices,
            (Chain{0, 4}));
}

TEST(EdgeLoop, GoesAllTheWayBeforeItCloses) {
  // A torus glued with a shift by one column: the way around the tube comes back beside its beginning.
  const int nu = 5, nv = 4;
  shapes::QuadMesh mesh = shapes::quad_torus(nu, nv);
  mesh.quads.clear();
  const auto number = [&](int i, int j) { return (j % nv) * nu + (i + (j >= nv ? 1 : 0)) % nu; };
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      mesh.quads.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  }
  const Surface surface = mesh.surface();
  const EdgeLoop spiral = strip_of(surface, {0, nu});
  EXPECT_TRUE(spiral.closed);
  EXPECT_EQ(spiral.vertices.size(), nu * nv) << "every vertex, once";
  EXPECT_EQ(strip_of(surface, {0, 1}).vertices, (Chain{0, 1, 2, 3, 4}));
}

TEST(EdgeLoop, EndsWhereItCrossesItself) {
  // A square whose left side is glued to its lower one, the cell at their corner left out: a cone of a right angle. The
  // line y = 2 goes on as the line x = 2 there.
  const int n = 5, columns = n + 1;
  shapes::QuadMesh mesh = shapes::quad_grid(n);
  for (auto& quad : mesh.quads) {
    for (std::int32_t& v : quad) {
      if (v % columns == 0) v /= columns;
    }
  }
  mesh.quads.erase(mesh.quads.begin());
  for (Vector& p : mesh.points) {
    const double r = std::hypot(p.x(), p.y()), angle = 4 * std::atan2(p.y(), p.x());
    p = {r * std::cos(angle), r * std::sin(angle), r};
  }
  const Surface surface = mesh.surface();
  const auto at = [&](int x, int y) { return x == 0 ? y : y * columns + x; };
  const EdgeLoop lasso = strip_of(surface, {at(4, 2), at(3, 2)});
  EXPECT_FALSE(lasso.closed);
  EXPECT_EQ(lasso.vertices, (Chain{at(5, 2), at(4, 2), at(3, 2), at(2, 2), at(1, 2), at(0, 2), at(2, 1), at(2, 2)}));
  EXPECT_EQ(strip_of(surface, {at(1, 2), at(0, 2)}).vertices,
            (Chain{at(2, 2), at(1, 2), at(0, 2), at(2, 1), at(2, 2), at(2, 3), at(2, 4), at(2, 5)}));
}

TEST(EdgeLoop, EndsWhereFacesAreNoSingleUmbrella) {
  // A quad strip of three columns with a fin on the second cross edge of the row in the middle.
  shapes::QuadMesh mesh = shapes::quad_grid(4);
  mesh.points.emplace_back(0.5, 0.5, 0.5);
  mesh.points.emplace_back(0.75, 0.5, 0.5);
  mesh.quads.push_back({12, 13, 26, 25});
  const Surface surface = mesh.surface();
  EXPECT_EQ(strip_of(surface, {10, 11}).vertices, (Chain{10, 11, 12}));
  EXPECT_EQ(strip_of(surface, {12, 13}).vertices, (Chain{12, 13}));
  EXPECT_EQ(strip_of(surface, {2, 7}).vertices, (Chain{2, 7, 12}));

  const Surface loose({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}, {6, 5, 5}, {5, 6, 5}}, {{3, 4, 5}},
                      std::vector<Edge>{{0, 1}, {1, 2}, {3, 4}, {4, 5}, {3, 5}});
  EXPECT_EQ(strip_of(loose, {0, 1}).vertices, (Chain{0, 1}));
}

TEST(EdgeLoop, RefusesWhatIsNoEdge) {
  const Surface surface = shapes::quad_grid(2).surface();
  for (const Edge& edge : {Edge{0, 4}, Edge{0, 9}, Edge{-1, 0}, Edge{1, 1}}) {
    EXPECT_THROW(strip_of(surface, edge), InvalidInput);
  }
}

}  // namespace
}  // namespace seamwire
