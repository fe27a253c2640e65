// SPDX-License-Identifier: GPL-3.0-or-later
#include "prices/edge_prices.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "seam_problems.hpp"

namespace seamwire {

using namespace detail;

namespace {

double unit_price(const SlitProblem& problem, std::int32_t edge) {
  return problem.prices.of_edge[edge] / problem.mesh->lengths[edge];
}

/// The mean price of a unit of length where the middle of an edge fulfills a condition.
template <class Condition>
double mean_price(const SlitProblem& problem, const Condition& holds) {
  double price = 0.0, length = 0.0;
  for (std::int32_t e = 0; e < static_cast<std::int32_t>(problem.mesh->edge_count()); ++e) {
    const std::int32_t h = problem.mesh->half_edge_of[e];
    const Vector middle =
        0.5 * (problem.mesh->points[problem.mesh->tail(h)] + problem.mesh->points[problem.mesh->tip(h)]);
    if (problem.prices.of_edge[e] == kInfinity || !holds(Vector(middle / problem.mesh->scale))) continue;
    price += problem.prices.of_edge[e];
    length += problem.mesh->lengths[e];
  }
  return price / length;
}

TEST(EdgePrices, AreLowestBehind) {
  const SlitProblem problem = problem_on(shapes::icosphere(3).surface(), {.front = Vector(0, 0, 1)});
  const double front = mean_price(problem, [](const Vector& p) { return p.z() > 0.3; });
  const double side = mean_price(problem, [](const Vector& p) { return std::abs(p.z()) < 0.1; });
  const double back = mean_price(problem, [](const Vector& p) { return p.z() < -0.3; });
  EXPECT_LT(back, 0.7 * side);
  EXPECT_LT(side, 0.5 * front);
  double sum = 0.0;
  const std::vector<double> areas = vertex_areas(*problem.mesh, face_frames(*problem.mesh, {}));
  for (std::size_t v = 0; v < areas.size(); ++v) sum += areas[v] * problem.prices.visibility[v];
  EXPECT_NEAR(sum, 1.0, 1e-5) << "1 on average";
}

TEST(EdgePrices, SharpEdgesAreCheap) {
  const SlitProblem problem = problem_on(shapes::quad_cube(4).surface());
  const auto is_sharp = [](const Vector& p) {
    int at_side = 0;
    for (const double x : {p.x(), p.y(), p.z()}) at_side += std::abs(x - 0.5) > 0.49 ? 1 : 0;
    return at_side == 2;
  };
  EXPECT_LT(mean_price(problem, is_sharp), 0.2 * mean_price(problem, [&](const Vector& p) { return !is_sharp(p); }));
}

TEST(EdgePrices, DiagonalsAndKeepOutAreasHaveNone) {
  const Surface surface = shapes::quad_cube(3).surface();
  std::vector<double> weights(surface.vertex_count(), 1.0);
  weights[5] = std::numeric_limits<double>::infinity();
  const SlitProblem problem = problem_on(surface, {.weights = weights});
  for (std::int32_t e = 0; e < static_cast<std::int32_t>(problem.mesh->edge_count()); ++e) {
    const std::int32_t h = problem.mesh->half_edge_of[e];
    const bool is_barred = problem.mesh->is_real[e] == 0 || problem.mesh->tail(h) == 5 || problem.mesh->tip(h) == 5;
    EXPECT_EQ(problem.prices.of_edge[e] == kInfinity, is_barred);
    EXPECT_GE(problem.prices.of_edge[e], 0.0);
  }
  EXPECT_TRUE(std::isfinite(problem.prices.turning));
}

TEST(EdgePrices, GrowWithWeights) {
  const Surface surface = shapes::icosphere(2).surface();
  const SlitProblem plain = problem_on(surface);
  const SlitProblem heavy = problem_on(surface, {.weights = std::vector<double>(surface.vertex_count(), 3.0)});
  for (std::int32_t e = 0; e < static_cast<std::int32_t>(plain.mesh->edge_count()); ++e) {
    EXPECT_NEAR(unit_price(heavy, e), 3.0 * unit_price(plain, e), 1e-12);
  }
}

TEST(EdgePrices, AreTheSameOnBothSides) {
  const Surface surface = shapes::dumbbell(12, 20).surface();
  std::vector<double> weights(surface.vertex_count(), 1.0);
  const SlitProblem before = problem_on(surface, {.mirror = 0, .front = Vector(1, 1, 0)});
  weights[static_cast<std::size_t>(before.mesh->sources[nearest_vertex(*before.mesh, {0.45, 0, 0})])] = 4.0;
  // Free on one side, barred on the other: barred on both.
  weights[static_cast<std::size_t>(before.mesh->sources[nearest_vertex(*before.mesh, {-1, 0, 0})])] = 0.0;
  weights[static_cast<std::size_t>(before.mesh->sources[nearest_vertex(*before.mesh, {1, 0, 0})])] = kInfinity;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(before.mesh->vertex_count()); ++v) {
    if (before.mesh->points[v].x() / before.mesh->scale < -0.95) weights[before.mesh->sources[v]] = 0.0;
  }
  const SlitProblem problem = problem_on(surface, {.mirror = 0, .front = Vector(1, 1, 0), .weights = weights});
  ASSERT_TRUE(problem.reflection && problem.reflection->is_exact);
  for (std::int32_t e = 0; e < static_cast<std::int32_t>(problem.mesh->edge_count()); ++e) {
    const std::int32_t h = problem.mesh->half_edge_of[e];
    const auto& images = problem.reflection->images;
    const std::int32_t image = problem.mesh->edge_between(images[problem.mesh->tail(h)], images[problem.mesh->tip(h)]);
    ASSERT_GE(image, 0);
    const double one = problem.prices.of_edge[e], other = problem.prices.of_edge[image];
    EXPECT_FALSE(std::isnan(one));
    if (std::isfinite(one)) {
      EXPECT_NEAR(one, other, 1e-12);
    }
    EXPECT_EQ(std::isfinite(one), std::isfinite(other));
  }
}

TEST(EdgePrices, AreLowerOnTheMirrorPlane) {
  const Surface top = shapes::lathe(24, {{-1.0, 0.0}, {-0.5, 0.15}, {0.0, 0.3}, {0.5, 0.15}, {1.0, 0.0}}).surface();
  const auto is_on_plane = [](const Vector& p) { return std::abs(p.x()) < 1e-9; };
  const double plain = mean_price(problem_on(top), is_on_plane);
  const double mirrored = mean_price(problem_on(top, {.mirror = 0}), is_on_plane);
  EXPECT_LT(mirrored, 0.6 * plain);
  EXPECT_GT(mirrored, 0.5 * plain) << "the plane is favored already, because a path on it is cut once";
}

TEST(EdgePrices, OfAFlatSheetAreFinite) {
  // Everything is as visible as everything else, and triangles without an area have no normals.
  const SlitProblem problem = problem_on(Surface({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 1, 3}}),
                                         {.front = Vector(0, 0, 1)});
  for (const double price : problem.prices.of_edge) EXPECT_TRUE(std::isfinite(price));
}

}  // namespace
}  // namespace seamwire
