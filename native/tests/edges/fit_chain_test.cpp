// SPDX-License-Identifier: GPL-3.0-or-later
//
// Chains of edges that fit lines drawn on a surface.
#include "seamwire/edges/fit_chain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "seamwire/edges/edge_loop.hpp"
#include "shapes.hpp"
#include "surface/point_segment.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Chain = std::vector<std::int32_t>;

constexpr int kSquares = 20;
constexpr double kEdge = 1.0 / kSquares;

/// The vertex in a column and a row of quad_grid(kSquares).
std::int32_t at(int column, int row) { return row * (kSquares + 1) + column; }

/// A surface, and lines on it by their points: the face of a point is the one whose middle is nearest.
class Paper {
 public:
  explicit Paper(const shapes::QuadMesh& mesh) : Paper(mesh.surface()) {}
  explicit Paper(Surface surface) : surface_(std::move(surface)), adjacency_(make_edge_adjacency(surface_)) {}

  std::int32_t face_at(const Vector& p) const {
    std::int32_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < surface_.face_count(); ++f) {
      const auto& [a, b, c] = surface_.triangles()[f];
      for (const auto& [from, to] : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
        // Near its sides, and on equal terms near its middle: points lie on sides mostly.
        const double gap =
            to_segment(p, point(from), point(to)).norm() + 1e-3 * ((point(a) + point(b) + point(c)) / 3 - p).norm();
        if (gap < least) {
          least = gap;
          best = static_cast<std::int32_t>(f);
        }
      }
    }
    return best;
  }
  FittedChain fit(const std::vector<Vector>& points, std::optional<std::int32_t> begin = std::nullopt,
                  std::optional<std::int32_t> end = std::nullopt) const {
    std::vector<std::int32_t> faces;
    for (const Vector& p : points) faces.push_back(face_at(p));
    return fit_chain(surface_, *adjacency_, {points, faces}, begin, end);
  }
  /// A line along a chain, `count` points an edge, each off by up to `wobble` in the directions `across`.
  std::vector<Vector> along(const Chain& chain, double wobble = 0.0, unsigned seed = 1, int count = 6,
                            const Vector& across = {1, 1, 0}) const {
    std::mt19937 random(seed);
    const auto off = [&] { return wobble * (2.0 * static_cast<double>(random()) / 4294967295.0 - 1.0); };
    std::vector<Vector> points;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      for (int k = 0; k < count; ++k) {
        points.push_back(point(chain[i]) + static_cast<double>(k) / count * (point(chain[i + 1]) - point(chain[i])));
      }
    }
    points.push_back(point(chain.back()));
    for (Vector& p : points) p += Vector(across.x() * off(), across.y() * off(), across.z() * off());
    return points;
  }
  const Surface& surface() const { return surface_; }
  const EdgeAdjacency& adjacency() const { return *adjacency_; }
  const Vector& point(std::int32_t v) const { return surface_.points()[static_cast<std::size_t>(v)]; }

 private:
  Surface surface_;
  std::shared_ptr<const EdgeAdjacency> adjacency_;
};

/// Right along a row, up, and left again: two bends.
Chain hook() {
  Chain chain;
  for (int x = 3; x <= 12; ++x) chain.push_back(at(x, 5));
  for (int y = 6; y <= 10; ++y) chain.push_back(at(12, y));
  for (int x = 11; x >= 8; --x) chain.push_back(at(x, 10));
  return chain;
}

TEST(LinesAlongEdges, ThatAreExactGiveExactlyTheirEdges) {
  const Paper quads(shapes::quad_grid(kSquares));
  EXPECT_EQ(quads.fit(quads.along(hook())).vertices, hook());
  const Paper cylinder(shapes::quad_cylinder(16, 12));
  for (const std::int32_t first : {0, 5, 40}) {
    const Chain chain =
        edge_loop(cylinder.adjacency(), cylinder.surface().edges()[static_cast<std::size_t>(first)], {}).vertices;
    ASSERT_GT(chain.size(), 4u);
    EXPECT_EQ(cylinder.fit(cylinder.along(chain)).vertices, chain) << first;
  }
}

TEST(LinesAlongEdges, OfAHandThatWobblesByAFifthOfAnEdgeGiveTheSameEdges) {
  const Paper quads(shapes::quad_grid(kSquares));
  for (unsigned seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(quads.fit(quads.along(hook(), 0.2 * kEdge, seed)).vertices, hook()) << seed;
  }
}

TEST(LinesAlongEdges, AreNoLessGoodInTheOtherDirection) {
  const Paper quads(shapes::quad_grid(kSquares));
  std::vector<Vector> points = quads.along(hook(), 0.2 * kEdge, 7);
  std::ranges::reverse(points);
  Chain back = quads.fit(points).vertices;
  std::ranges::reverse(back);
  EXPECT_EQ(back, hook());
}

TEST(LinesAlongEdges, AreLedByFewPointsAsByMany) {
  const Paper quads(shapes::quad_grid(kSquares));
  const std::vector<Vector> corners = {quads.point(at(3, 5)), quads.point(at(12, 5)), quads.point(at(12, 10)),
                                       quads.point(at(8, 10))};
  EXPECT_EQ(quads.fit(corners).vertices, hook());
  EXPECT_EQ(quads.fit(quads.along(hook(), 0.0, 1, 100)).vertices, hook());
}

TEST(LinesAlongEdges, TurnNoMoreThanTheyHaveTo) {
  // Between the corners of a diagonal one may go right first or up first; going on as one came saves every other turn.
  const Paper quads(shapes::quad_grid(kSquares));
  const Chain chain = quads.fit({quads.point(at(3, 3)), quads.point(at(11, 11))}).vertices;
  ASSERT_EQ(chain.size(), 17u);
  int turns = 0;
  for (std::size_t i = 2; i < chain.size(); ++i) turns += chain[i] - chain[i - 1] != chain[i - 1] - chain[i - 2];
  EXPECT_EQ(turns, 8);
}

TEST(LinesAlongEdges, DropWhatIsDrawnBeyondUpToHalfAnEdge) {
  const Paper quads(shapes::quad_grid(kSquares));
  Chain chain;
  for (int x = 3; x <= 9; ++x) chain.push_back(at(x, 5));
  std::vector<Vector> points = quads.along(chain);
  points.insert(points.begin(), points.front() - Vector(0.45 * kEdge, 0, 0));
  points.push_back(points.back() + Vector(0.45 * kEdge, 0.1 * kEdge, 0));
  EXPECT_EQ(quads.fit(points).vertices, chain);
  points.push_back(points.back() + Vector(0.1 * kEdge, 0, 0));
  chain.push_back(at(10, 5));
  EXPECT_EQ(quads.fit(points).vertices, chain) << "more than half of an edge is an edge";
}

TEST(LinesAlongEdges, ThatTurnBackTakeTheChainBack) {
  const Paper quads(shapes::quad_grid(kSquares));
  Chain there, whole;
  for (int x = 3; x <= 12; ++x) there.push_back(at(x, 5));
  std::vector<Vector> points = quads.along(there, 0.1 * kEdge, 3);
  const std::vector<Vector> back = quads.along({at(12, 5), at(11, 5), at(10, 5), at(9, 5)}, 0.1 * kEdge, 4);
  points.insert(points.end(), back.begin(), back.end());
  there.resize(7);
  EXPECT_EQ(quads.fit(points).vertices, there);
  const std::vector<Vector> rest = quads.along({at(9, 5), at(8, 5), at(7, 5), at(6, 5), at(5, 5), at(4, 5), at(3, 5)});
  points.insert(points.end(), rest.begin(), rest.end());
  EXPECT_TRUE(quads.fit(points).vertices.empty()) << "all of it";
}

TEST(LinesAlongEdges, MayComeBackBesideThemselvesAndCrossThemselves) {
  const Paper quads(shapes::quad_grid(kSquares));
  Chain beside;
  for (int x = 3; x <= 12; ++x) beside.push_back(at(x, 5));
  for (int x = 12; x >= 3; --x) beside.push_back(at(x, 6));
  EXPECT_EQ(quads.fit(quads.along(beside, 0.2 * kEdge)).vertices, beside);
  Chain crossing;
  for (int x = 3; x <= 12; ++x) crossing.push_back(at(x, 5));
  for (int y = 6; y <= 9; ++y) crossing.push_back(at(12, y));
  for (int x = 11; x >= 8; --x) crossing.push_back(at(x, 9));
  for (int y = 8; y >= 2; --y) crossing.push_back(at(8, y));
  EXPECT_EQ(quads.fit(quads.along(crossing, 0.2 * kEdge)).vertices, crossing);
}

TEST(LinesAlongEdges, ThatEndWhereTheyBeganGiveAClosedChain) {
  const Paper quads(shapes::quad_grid(kSquares));
  Chain ring;
  for (int x = 3; x <= 9; ++x) ring.push_back(at(x, 5));
  for (int y = 6; y <= 10; ++y) ring.push_back(at(9, y));
  for (int x = 8; x >= 3; --x) ring.push_back(at(x, 10));
  for (int y = 9; y >= 5; --y) ring.push_back(at(3, y));
  EXPECT_EQ(quads.fit(quads.along(ring, 0.2 * kEdge)).vertices, ring);
}

TEST(LinesAlongEdges, WithinAFaceGiveItsBorderOrNothing) {
  const Paper quads(shapes::quad_grid(4));
  EXPECT_TRUE(quads.fit({{0.30, 0.30, 0}, {0.34, 0.33, 0}}).vertices.empty()) << "both ends are nearest to one corner";
  EXPECT_TRUE(quads.fit({{0.30, 0.30, 0}, {0.30, 0.30, 0}}).vertices.empty());
  EXPECT_EQ(quads.fit({{0.27, 0.27, 0}, {0.48, 0.27, 0}}).vertices, Chain({6, 7}));
  EXPECT_TRUE(quads.fit({{0.3, 0.3, 0}}).vertices.empty());
  EXPECT_TRUE(quads.fit({}).vertices.empty());
}

TEST(LinesAlongEdges, FollowTheBoundary) {
  const Paper quads(shapes::quad_grid(kSquares));
  Chain rim;
  for (int x = 4; x <= kSquares; ++x) rim.push_back(at(x, 0));
  for (int y = 1; y <= 8; ++y) rim.push_back(at(kSquares, y));
  std::vector<Vector> points = quads.along(rim, 0.2 * kEdge);
  for (Vector& p : points) p = p.cwiseMax(0.0).cwiseMin(1.0);
  EXPECT_EQ(quads.fit(points).vertices, rim);
}

TEST(LinesAlongEdges, EndWhereNoEdgesLeadOn) {
  // Two strips of four squares each, a gap of a tenth apart.
  std::vector<Vector> points;
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;
  for (int strip = 0; strip < 2; ++strip) {
    const std::int32_t first = 10 * strip;
    for (int x = 0; x <= 4; ++x) {
      for (int y = 0; y <= 1; ++y) points.emplace_back(x + 4.1 * strip, y, 0);
    }
    for (std::int32_t a = first; a < first + 10; a += 2) {
      edges.push_back({a, a + 1});
      if (a + 2 == first + 10) continue;
      edges.insert(edges.end(), {{a, a + 2}, {a + 1, a + 3}});
      triangles.insert(triangles.end(), {{a, a + 2, a + 3}, {a, a + 3, a + 1}});
    }
  }
  const Paper strips(Surface(points, triangles, edges));
  std::vector<Vector> line;
  for (int i = 0; i <= 60; ++i) line.emplace_back(1.0 + 0.1 * i, 0.0, 0.0);
  EXPECT_EQ(strips.fit(line).vertices, Chain({2, 4, 6, 8}));
  std::ranges::reverse(line);
  EXPECT_EQ(strips.fit(line).vertices, Chain({16, 14, 12, 10})) << "the component that it begins on";
}

TEST(LinesAlongEdges, BeginAndEndWhereTheyAreToldTo) {
  const Paper quads(shapes::quad_grid(kSquares));
  Chain chain;
  for (int x = 3; x <= 9; ++x) chain.push_back(at(x, 5));
  const std::vector<Vector> points = quads.along(chain);
  chain.insert(chain.begin(), at(2, 5));
  chain.push_back(at(10, 5));
  EXPECT_EQ(quads.fit(points, at(2, 5), at(10, 5)).vertices, chain);
}

TEST(LinesAlongEdges, TellWhereOnTheLineEachVertexIs) {
  const Paper quads(shapes::quad_grid(kSquares));
  const FittedChain fitted = quads.fit(quads.along(hook()));
  ASSERT_EQ(fitted.places.size(), hook().size());
  for (std::size_t i = 0; i < fitted.places.size(); ++i)
    EXPECT_NEAR(fitted.places[i], 6.0 * static_cast<double>(i), 1e-9);
}

TEST(LinesAlongEdges, AskTheirTaskOftenAtAVertexOfManyEdges) {
  // Triangles around a vertex that share no edges, and a line three times around it. No edges lead to the
  // vertex where it has to end.
  constexpr std::size_t kFans = 100;
  std::vector<Vector> points{{0, 0, 0}}, line;
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> faces;
  const auto direction = [](std::size_t i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kFans;
    return Vector(std::cos(angle), std::sin(angle), 0.0);
  };
  for (std::int32_t i = 0; index(i) < kFans; ++i) {
    for (const double height : {-0.3, 0.3}) points.push_back(direction(index(i)) + Vector(0.0, 0.0, height));
    triangles.push_back({0, 2 * i + 1, 2 * i + 2});
  }
  const auto end = static_cast<std::int32_t>(points.size());
  for (std::int32_t corner = 0; corner < 3; ++corner) points.push_back(0.5 * direction(index(corner)));
  triangles.push_back({end, end + 1, end + 2});
  for (std::size_t i = 0; i < 3 * kFans; i += 5) {
    line.push_back(0.3 * direction(i));
    faces.push_back(static_cast<std::int32_t>(i % kFans));
  }
  const Surface surface(points, triangles);
  const auto adjacency = make_edge_adjacency(surface);
  std::size_t looks = 0;
  const Task task{.stop = {}, .progress = [&](double) { return ++looks > 0; }};
  fit_chain(surface, *adjacency, {line, faces}, std::nullopt, end, task);
  // Chains over the middle go on along each of its edges.
  EXPECT_GE(looks, kFans * kFans / Poll::kFewSteps);
  const Task never{.stop = {}, .progress = [](double) { return false; }};
  EXPECT_THROW(fit_chain(surface, *adjacency, {line, faces}, std::nullopt, end, never), Cancelled);
}

TEST(LinesAlongEdges, ThatAreDamagedAreRefused) {
  const Paper quads(shapes::quad_grid(4));
  const std::vector<Vector> points = {{0, 0, 0}, {0.5, 0, 0}};
  const std::vector<Vector> broken = {{0, 0, 0}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}};
  const std::vector<std::int32_t> faces = {0, 2}, few = {0}, far = {0, 99}, below = {-1, 0};
  const auto fit = [&](const std::vector<Vector>& p, const std::vector<std::int32_t>& f,
                       std::optional<std::int32_t> begin) {
    return fit_chain(quads.surface(), quads.adjacency(), {p, f}, begin);
  };
  EXPECT_THROW(fit(points, few, {}), InvalidInput);
  EXPECT_THROW(fit(points, far, {}), InvalidInput);
  EXPECT_THROW(fit(points, below, {}), InvalidInput);
  EXPECT_THROW(fit(broken, faces, {}), InvalidInput);
  EXPECT_THROW(fit(points, faces, 25), InvalidInput);
  EXPECT_NO_THROW(fit(points, faces, 24));
  const Paper others(shapes::quad_grid(3));
  EXPECT_THROW(fit_chain(quads.surface(), others.adjacency(), {points, faces}), InvalidInput);
}

}  // namespace
}  // namespace seamwire
