// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/cut/plan_cuts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace seamwire {
namespace {

/// A row of unit quads, each cut from its first corner to its third. Vertex y * (count + 1) + x lies at (x, y).
struct Row {
  explicit Row(std::int32_t count) {
    for (const double y : {0.0, 1.0}) {
      for (std::int32_t x = 0; x <= count; ++x) points.emplace_back(x, y, 0.0);
    }
    for (std::int32_t x = 0; x < count; ++x) {
      triangles.push_back({x, x + 1, x + count + 2});
      triangles.push_back({x, x + count + 2, x + count + 1});
      polygons.insert(polygons.end(), 2, x);
    }
  }
  TriangulatedPolygons mesh() const { return {.points = points, .triangles = triangles, .polygons = polygons}; }

  std::vector<Vector> points;
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> polygons;
};

/// A curve from the lower left corner of a row of two quads to the upper right one.
CutCurve across_two() {
  return {
      .points = {{0.0, 0.0, 0.0}, {1.0, 0.5, 0.0}, {2.0, 1.0, 0.0}}, .start = SurfacePoint(0), .end = SurfacePoint(5)};
}

TEST(PlanCuts, SplitsTheEdgeBetweenTwoQuadsAndBothQuads) {
  const Row row(2);
  const CutCurve curve = across_two();
  const CutPlan plan = plan_cuts(row.mesh(), {&curve, 1});
  ASSERT_EQ(plan.splits.size(), 1U);
  EXPECT_EQ(plan.splits[0].edge, (Edge{1, 4}));
  ASSERT_EQ(plan.splits[0].nodes.size(), 1U);
  const CutNode& middle = plan.nodes[plan.splits[0].nodes[0]];
  EXPECT_EQ(middle, (CutNode{.vertices = {1, 4, -1}, .weights = {0.5, 0.5, 0.0}}));
  ASSERT_EQ(plan.across.size(), 2U);
  for (const PolygonCuts& own : plan.across) {
    EXPECT_EQ(own.cuts.size(), 1U);
    EXPECT_FALSE(own.is_folded);
  }
  EXPECT_TRUE(plan.along.empty());
  EXPECT_TRUE(plan.left_out.empty());
}

TEST(PlanCuts, PolygonsBackToBackAreCutEach) {
  const std::vector<Vector> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Triangle> triangles{{0, 1, 3}, {1, 2, 3}, {3, 2, 0}, {2, 1, 0}};
  const std::vector<std::int32_t> polygons{0, 0, 1, 1};
  const auto diagonal = [&](std::int32_t from, std::int32_t to, std::vector<std::int32_t> faces) {
    return CutCurve{.points = {points[from], 0.5 * (points[from] + points[to]), points[to]},
                    .start = SurfacePoint(from),
                    .end = SurfacePoint(to),
                    .faces = std::move(faces)};
  };
  const std::vector<CutCurve> curves{diagonal(0, 2, {0, 1}), diagonal(2, 0, {2, 2})};
  const CutPlan plan = plan_cuts({.points = points, .triangles = triangles, .polygons = polygons}, curves);
  EXPECT_EQ(plan.across.size(), 2U);
}

TEST(PlanCuts, NamedTrianglesDecideWhereFacesLieOnEachOther) {
  // Two rows on each other that share the corners at both ends.
  Row row(2);
  const auto first = static_cast<std::int32_t>(row.points.size());
  row.points.push_back(row.points[1]);
  row.points.push_back(row.points[4]);
  const std::vector<Triangle> below = row.triangles;
  for (Triangle triangle : below) {
    for (std::int32_t& v : triangle) v = v == 1 ? first : v == 4 ? first + 1 : v;
    row.triangles.push_back(triangle);
    row.polygons.push_back(row.polygons[row.triangles.size() - 1 - below.size()] + 2);
  }
  CutCurve curve = across_two();
  for (const std::vector<std::int32_t>& faces : {std::vector{0, 3}, std::vector{4, 7}}) {
    curve.faces = faces;
    const CutPlan plan = plan_cuts(row.mesh(), {&curve, 1});
    ASSERT_EQ(plan.across.size(), 2U);
    EXPECT_EQ(plan.across[0].polygon, row.polygons[faces[0]]);
    EXPECT_EQ(plan.across[1].polygon, row.polygons[faces[1]]);
  }
}

TEST(PlanCuts, FindsTrianglesThatTheCurveNamesWrongly) {
  const Row row(2);
  CutCurve curve = across_two();
  const CutPlan wanted = plan_cuts(row.mesh(), {&curve, 1});
  for (const std::vector<std::int32_t>& faces : {std::vector{3, 0}, std::vector{0, 9}, std::vector{-1, 3}}) {
    curve.faces = faces;
    const CutPlan plan = plan_cuts(row.mesh(), {&curve, 1});
    EXPECT_EQ(plan.nodes, wanted.nodes);
    EXPECT_EQ(plan.across.size(), wanted.across.size());
  }
}

TEST(PlanCuts, NamesCurvesThatDoNotRunOverTheMesh) {
  const Row row(2);
  std::vector<CutCurve> curves(3, across_two());
  curves[0].points[1].z() = 3.0;
  curves[1].image_of = 0;
  const CutPlan plan = plan_cuts(row.mesh(), curves);
  ASSERT_EQ(plan.left_out.size(), 1U);
  EXPECT_EQ(plan.left_out[0].curve, 0);
  EXPECT_EQ(plan.left_out[0].vertex, 0);
  EXPECT_EQ(plan.across.size(), 2U);
}

TEST(PlanCuts, ReportsProgressAndCanBeCancelled) {
  const Row row(300);
  CutCurve curve{.points = {}, .start = SurfacePoint(0)};
  for (int x = 0; x <= 300; ++x) curve.points.emplace_back(x, 0.5 + 0.3 * std::sin(1.3 * x), 0.0);
  const std::vector<std::int32_t> one_polygon(row.polygons.size(), 0);
  for (const TriangulatedPolygons& mesh :
       {row.mesh(), TriangulatedPolygons{.points = row.points, .triangles = row.triangles, .polygons = one_polygon}}) {
    std::size_t looks = 0;
    double last = 0.0;
    plan_cuts(mesh, {&curve, 1}, {.stop = {}, .progress = [&](double fraction) {
                                    EXPECT_GE(fraction, last);
                                    EXPECT_LE(fraction, 1.0);
                                    last = fraction;
                                    return ++looks > 0;
                                  }});
    EXPECT_GE(looks, 300U) << "at least once for each point of the curve";
    const Task task{.stop = {}, .progress = [&](double) { return --looks > 0; }};
    EXPECT_THROW(plan_cuts(mesh, {&curve, 1}, task), Cancelled) << "at the last look";
  }
}

TEST(PlanCuts, RefusesWhatIsOutOfRange) {
  Row row(2);
  const auto plan = [&row](CutCurve curve) { return plan_cuts(row.mesh(), {&curve, 1}); };
  CutCurve curve = across_two();
  curve.start = SurfacePoint(6);
  EXPECT_THROW(plan(curve), InvalidInput);
  curve.start = {4, {1.0, 0.0, 0.0}};
  EXPECT_THROW(plan(curve), InvalidInput);
  curve.start = {0, {1.0, 1.0, 0.0}};
  EXPECT_THROW(plan(curve), InvalidInput);
  curve = across_two();
  curve.faces = {0};
  EXPECT_THROW(plan(curve), InvalidInput);
  curve = across_two();
  for (const std::int32_t number : {0, -2}) {
    curve.image_of = number;
    EXPECT_THROW(plan(curve), InvalidInput);
  }
  curve = across_two();
  curve.points.resize(1);
  EXPECT_THROW(plan(curve), InvalidInput);
  row.points[2].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(plan(across_two()), InvalidInput);
  row.points[2].x() = 2.0;
  row.polygons.back() = 0;
  EXPECT_THROW(plan(across_two()), InvalidInput);  // not ascending
  row.polygons.assign(4, 0);
  row.triangles[1] = row.triangles[0];
  EXPECT_THROW(plan(across_two()), InvalidInput);  // no polygon
}

}  // namespace
}  // namespace seamwire
