// SPDX-License-Identifier: GPL-3.0-or-later
#include "slits/slit_paths.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "seam_problems.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Chain = std::vector<std::int32_t>;

constexpr double kRounded = 1e-4;  // of lengths, which have 16 bits

/// Each edge costs its length, and turns are free.
EdgePrices by_length(const PlanMesh& mesh) {
  EdgePrices prices;
  prices.of_edge = mesh.lengths;
  for (std::size_t e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.is_real[e] == 0) prices.of_edge[e] = kInfinity;
  }
  prices.visibility.assign(mesh.vertex_count(), 1.0);
  prices.is_exposed.assign(mesh.vertex_count(), 0);
  return prices;
}

TurningPaths paths_from(const PlanMesh& mesh, const EdgePrices& prices, const Chain& from, double exponent = 1.0) {
  const std::vector<std::uint8_t> none(mesh.vertex_count(), 0);
  return slit_paths(mesh, prices, nullptr, flags_at(mesh, from), none, {.half = Half::kAny, .exponent = exponent}, {});
}

TEST(SlitPaths, AreTheShortestWherePricesAreLengths) {
  const PlanMesh mesh = plan_mesh(shapes::quad_grid(6).surface(), {});
  const TurningPaths paths = paths_from(mesh, by_length(mesh), {0});
  for (std::int32_t v = 0; v < 49; ++v) {
    const std::int32_t column = v % 7, row = v / 7;
    EXPECT_NEAR(paths.price(v), (column + row) / 6.0, kRounded);
    const Chain path = paths.path(v);
    if (v == 0) continue;
    EXPECT_EQ(path.size(), static_cast<std::size_t>(v % 7 + v / 7) + 1);
    for (std::size_t i = 1; i < path.size(); ++i) EXPECT_GE(mesh.edge_between(path[i - 1], path[i]), 0);
  }
  EXPECT_TRUE(paths.path(0).empty());
}

TEST(SlitPaths, TakeFewTurnsIfTurnsCost) {
  const PlanMesh mesh = plan_mesh(shapes::quad_grid(6).surface(), {});
  EdgePrices prices = by_length(mesh);
  prices.turning = 0.01;
  const TurningPaths paths = paths_from(mesh, prices, {0});
  EXPECT_NEAR(paths.price(48), 2.0 + 0.01, kRounded) << "one turn";
  const Chain path = paths.path(48);
  std::size_t turns = 0;
  for (std::size_t i = 2; i < path.size(); ++i) turns += path[i] - path[i - 1] != path[i - 1] - path[i - 2] ? 1 : 0;
  EXPECT_EQ(turns, 1U);
}

TEST(SlitPaths, GoAroundWhatIsExpensive) {
  const PlanMesh mesh = plan_mesh(shapes::quad_grid(6).surface(), {});
  EdgePrices prices = by_length(mesh);
  for (std::int32_t row = 0; row < 6; ++row) prices.of_edge[mesh.edge_between(7 * row + 2, 7 * row + 3)] *= 10.0;
  // Row 6 is the only cheap way across. The shortest path does not know prices.
  const Chain cheapest = paths_from(mesh, prices, {0}).path(6), shortest = paths_from(mesh, prices, {0}, 0.0).path(6);
  EXPECT_EQ(shortest.size(), 7U);
  EXPECT_EQ(cheapest.size(), 7U) << "ten times an edge is less than both ways down and up";
  for (std::int32_t row = 0; row < 6; ++row) prices.of_edge[mesh.edge_between(7 * row + 2, 7 * row + 3)] = kInfinity;
  const Chain around = paths_from(mesh, prices, {0}).path(6);
  EXPECT_EQ(around.size(), 19U);
  EXPECT_TRUE(std::ranges::find(around, 44) != around.end());
  prices.of_edge[mesh.edge_between(44, 45)] = kInfinity;
  EXPECT_EQ(paths_from(mesh, prices, {0}).price(6), kInfinity);
  EXPECT_TRUE(paths_from(mesh, prices, {0}).path(6).empty());
}

TEST(SlitPaths, EndAtRims) {
  const PlanMesh mesh = plan_mesh(shapes::quad_grid(6).surface(), {});
  Chain wall;
  for (std::int32_t row = 0; row < 7; ++row) wall.push_back(7 * row + 3);
  const EdgePrices prices = by_length(mesh);
  const TurningPaths paths = slit_paths(mesh, prices, nullptr, flags_at(mesh, {0}), flags_at(mesh, wall), {}, {});
  EXPECT_NEAR(paths.price(3), 0.5, kRounded);
  EXPECT_EQ(paths.price(4), kInfinity);
}

TEST(SlitPaths, FromMoreVerticesAreThoseOfAWholeSearch) {
  const PlanMesh mesh = plan_mesh(shapes::bumpy(shapes::grid(20, 0.3), 0.05).surface(), {});
  EdgePrices prices = by_length(mesh);
  prices.turning = 0.02;
  const std::vector<std::uint8_t> none(mesh.vertex_count(), 0);
  Chain from = {0};
  TurningPaths paths = paths_from(mesh, prices, from);
  for (const std::int32_t next : {440, 220, 231, 20, 221, 100}) {
    std::vector<double> before;
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.vertex_count()); ++v) before.push_back(paths.price(v));
    from.push_back(next);
    std::vector<std::int32_t> cheaper =
        add_slit_paths(paths, mesh, prices, nullptr, {&next, 1}, flags_at(mesh, from), none, {}, {});
    std::ranges::sort(cheaper);
    const TurningPaths whole = paths_from(mesh, prices, from);
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.vertex_count()); ++v) {
      ASSERT_NEAR(paths.price(v), whole.price(v), 1e-12);
      ASSERT_EQ(paths.path(v), whole.path(v));
      ASSERT_EQ(std::ranges::binary_search(cheaper, v), paths.price(v) < before[v]);
    }
  }
}

TEST(SlitPaths, CostInProportionToTheEdgesOfAPole) {
  constexpr std::int32_t kEdges = 60000;
  shapes::Mesh cone{{{0, 0, 0.3}}, {}};
  Chain rim;
  for (std::int32_t i = 0; i < kEdges; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kEdges;
    cone.points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    cone.triangles.push_back({0, 1 + i, 1 + (i + 1) % kEdges});
    rim.push_back(1 + i);
  }
  const PlanMesh mesh = plan_mesh(cone.surface(), {});
  EdgePrices prices = by_length(mesh);
  prices.turning = 0.1;
  EXPECT_NEAR(paths_from(mesh, prices, {1}).price(1 + kEdges / 2), 2.0 * mesh.lengths[mesh.edge_between(0, 1)], 0.15);
  EXPECT_NEAR(paths_from(mesh, prices, rim).price(0), mesh.lengths[mesh.edge_between(0, 1)], 1e-12);
  EXPECT_TRUE(find_reflection(mesh, 0, {})->is_exact) << "every edge's image is looked up";
}

TEST(SlitPaths, StayOnOneSideOfTheMirrorPlane) {
  const SlitProblem problem = problem_on(shapes::dumbbell(12, 24).surface(), {.mirror = 1});
  ASSERT_TRUE(problem.reflection && problem.reflection->is_exact);
  const auto& sides = problem.reflection->sides;
  const std::int32_t pole = nearest_vertex(*problem.mesh, {-1, 0, 0});
  const std::vector<std::uint8_t> from = flags_at(*problem.mesh, {pole}), none(from.size(), 0);
  const TurningPaths above =
      slit_paths(*problem.mesh, problem.prices, problem.mirror(), from, none, {.half = Half::kPositive}, {});
  const TurningPaths plane =
      slit_paths(*problem.mesh, problem.prices, problem.mirror(), from, none, {.half = Half::kPlane}, {});
  std::size_t reached = 0;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(sides.size()); ++v) {
    if (sides[v] < 0) {
      EXPECT_EQ(above.price(v), kInfinity);
    }
    if (sides[v] != 0) {
      EXPECT_EQ(plane.price(v), kInfinity);
    }
    bool has_left = false;
    for (const std::int32_t on : above.path(v)) {
      EXPECT_GE(sides[on], 0);
      EXPECT_FALSE(has_left && sides[on] == 0) << "back on the plane";
      has_left = has_left || sides[on] > 0;
    }
    reached += above.path(v).empty() ? 0 : 1;
  }
  EXPECT_GT(reached, sides.size() / 2);
}

TEST(SlitFinder, FindsExactImages) {
  const SlitProblem problem = problem_on(shapes::dumbbell(12, 24).surface(), {.mirror = 1});
  const std::int32_t pole = nearest_vertex(*problem.mesh, {-1, 0, 0});
  const std::vector<std::uint8_t> from = flags_at(*problem.mesh, {pole});
  const SlitFinder finder(problem, from, from, {});
  const std::int32_t end = nearest_vertex(*problem.mesh, {0, 0.4, 0.2});
  const std::optional<Slit> slit = finder.slit_to(end);
  ASSERT_TRUE(slit);
  EXPECT_EQ(slit->path.front(), pole);
  EXPECT_EQ(slit->path.back(), end);
  ASSERT_GT(slit->image.size(), 1U);
  const std::size_t on_plane = slit->path.size() - slit->image.size();
  for (std::size_t i = 0; i < slit->image.size(); ++i) {
    EXPECT_EQ(slit->image[i], problem.reflection->images[slit->path[on_plane + i]]);
  }
  EXPECT_EQ(finder.price_to(pole), 0.0);
  EXPECT_FALSE(finder.slit_to(pole));
}

TEST(ChainAlong, StaysNearALine) {
  const PlanMesh mesh = plan_mesh(shapes::quad_grid(8).surface(), {});
  const std::vector<Vector> line = {{0, 0, 0}, {1, 1, 0}};
  const std::vector<std::uint8_t> none(mesh.vertex_count(), 0);
  const Chain chain = chain_along(mesh, line, 0.05, 0, 80, none, by_length(mesh), {});
  ASSERT_EQ(chain.size(), 17U);
  EXPECT_EQ(chain.front(), 0);
  EXPECT_EQ(chain.back(), 80);
  for (const std::int32_t v : chain) EXPECT_LE(std::abs(v % 9 - v / 9), 1) << "a staircase";
  std::vector<std::uint8_t> barred(none);
  for (std::int32_t v = 0; v < 9; ++v) barred[9 * v + 4] = 1;
  EXPECT_TRUE(chain_along(mesh, line, 0.05, 0, 80, barred, by_length(mesh), {}).empty());
}

TEST(EdgeDistances, PassOverDiagonals) {
  const PlanMesh mesh = plan_mesh(shapes::quad_grid(4).surface(), {});
  const Chain from = {0};
  const std::vector<double> distances = edge_distances(mesh, from, {});
  EXPECT_NEAR(distances[24], std::sqrt(2.0), kRounded);
  EXPECT_NEAR(distances[4], 1.0, kRounded);
  EXPECT_EQ(edge_distances(mesh, {}, {})[0], kInfinity);
}

}  // namespace
}  // namespace seamwire
