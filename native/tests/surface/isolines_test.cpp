// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/isolines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "shapes.hpp"

namespace seamwire {
namespace {

using Values = std::vector<double>;

Values values_of(const Surface& surface, double (*f)(const Vector&)) {
  Values values;
  for (const Vector& p : surface.points()) values.push_back(f(p));
  return values;
}

double length(const std::array<Vector, 2>& segment) { return (segment[1] - segment[0]).norm(); }

TEST(Isolines, OfALinearFunctionAreStraightAndAsLongAsTheyAre) {
  const Surface surface = shapes::grid(9, 0.3).surface();
  const Values values = values_of(surface, [](const Vector& p) { return p.x() + 0.5 * p.y(); });
  const Values levels{0.2, 0.7, 1.4};
  const Isolines lines = isolines(surface, values, levels);
  Values total(levels.size(), 0.0);
  for (std::size_t i = 0; i < lines.segments.size(); ++i) {
    const std::int32_t level = lines.levels[i];
    for (const Vector& p : lines.segments[i]) EXPECT_NEAR(p.x() + 0.5 * p.y(), levels[level], 1e-14);
    total[level] += length(lines.segments[i]);
    // The higher values lie to the left.
    const Vector along = lines.segments[i][1] - lines.segments[i][0];
    EXPECT_GE(along.x() * 0.5 - along.y() * 1.0, 0.0);
  }
  EXPECT_NEAR(total[0], std::hypot(0.2, 0.4), 1e-12);
  EXPECT_NEAR(total[1], std::hypot(0.5, 1.0), 1e-12);
  EXPECT_NEAR(total[2], std::hypot(0.1, 0.2), 1e-12);
}

TEST(Isolines, OfDistancesOnAPlaneAreChordsOfCircles) {
  const int n = 64;
  const Surface surface = shapes::grid(n, 0.2).surface();
  const Values distances = values_of(surface, [](const Vector& p) { return (p - Vector(0.5, 0.5, 0)).norm(); });
  const Values levels{0.1, 0.2, 0.3, 0.4};
  const Isolines lines = isolines(surface, distances, levels);
  Values total(levels.size(), 0.0);
  for (std::size_t i = 0; i < lines.segments.size(); ++i) {
    const double radius = levels[lines.levels[i]];
    for (const Vector& p : lines.segments[i]) {
      // A function of curvature 1 / r, linear on edges of up to h: off by h^2 / 8 r.
      const double h = 2.0 / n;
      EXPECT_NEAR((p - Vector(0.5, 0.5, 0)).norm(), radius, h * h / (8 * radius));
    }
    total[lines.levels[i]] += length(lines.segments[i]);
  }
  for (std::size_t i = 0; i < levels.size(); ++i) {
    EXPECT_NEAR(total[i] / (2 * std::numbers::pi * levels[i]), 1.0, 0.01);
  }
}

// Isolines of a closed surface end nowhere: each end is the beginning of the next segment, to the last bit.
TEST(Isolines, OnAClosedSurfaceAreClosed) {
  for (const bool is_at_vertices : {false, true}) {
    const Surface surface = shapes::icosphere(3).surface();
    const Values values = values_of(surface, [](const Vector& p) { return p.z() + 0.3 * std::sin(9 * p.x()); });
    Values levels{-0.2, 0.0, 0.31};
    if (is_at_vertices) levels = {std::min(values[7], values[90]), std::max(values[7], values[90])};
    const Isolines lines = isolines(surface, values, levels);
    EXPECT_GT(lines.segments.size(), 100U);
    std::map<std::tuple<double, double, double>, int> ends;
    for (const auto& [a, b] : lines.segments) {
      if (a == b) continue;  // at a vertex whose value is the level
      ++ends[{a.x(), a.y(), a.z()}];
      --ends[{b.x(), b.y(), b.z()}];
    }
    for (const auto& [point, open] : ends) EXPECT_EQ(open, 0);
  }
}

TEST(Isolines, OfLargeValuesLieWhereThoseOfSmallOnesDo) {
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const Isolines small = isolines(surface, Values{-1.7, 1.7, 1.7}, Values{1.6});
  const Isolines large = isolines(surface, Values{-1.7e308, 1.7e308, 1.7e308}, Values{1.6e308});
  ASSERT_EQ(large.segments.size(), 1U);
  for (std::size_t end = 0; end < 2; ++end) {
    EXPECT_NEAR((large.segments[0][end] - small.segments[0][end]).norm(), 0.0, 1e-15);
  }
}

TEST(Isolines, LeaveOutTrianglesWithAnInfiniteValueAndFlatOnes) {
  const Surface surface = shapes::grid(4).surface();
  Values values = values_of(surface, [](const Vector& p) { return p.x(); });
  const Values levels{0.1};
  EXPECT_EQ(isolines(surface, values, levels).segments.size(), 8U);
  values[0] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(isolines(surface, values, levels).segments.size(), 6U);
  EXPECT_TRUE(isolines(surface, Values(surface.vertex_count(), 0.1), levels).segments.empty());
}

TEST(Isolines, NameWhatIsWrongWithValuesAndLevels) {
  const Surface surface = shapes::grid(2).surface();
  const auto message = [&](const Values& values, const Values& levels) -> std::string {
    try {
      isolines(surface, values, levels);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  const Values good(9, 0.0);
  Values bad = good;
  bad[5] = std::nan("");
  EXPECT_EQ(message(Values(4), {}), "values of 4 vertices given for a surface of 9");
  EXPECT_EQ(message(bad, {}), "the value of vertex 5 is not a number");
  EXPECT_EQ(message(good, {0.0, HUGE_VAL}), "level 1 is not finite");
  EXPECT_EQ(message(good, {0.0, 0.5, 0.5}), "levels are not ascending: level 2 is 0.5, after 0.5");
}

TEST(Isolines, AreThereOnceAndHaveALength) {
  // Two triangles that touch along the level, and one of them twice.
  shapes::Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0.5, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}, {2, 0, 1}};
  const Surface surface = mesh.surface();
  ASSERT_EQ(surface.report().duplicate_faces, std::vector<std::int32_t>{3});
  const Isolines half = isolines(surface, values_of(surface, [](const Vector& p) { return p.x(); }), Values{0.5});
  EXPECT_EQ(half.faces, (std::vector<std::int32_t>{0, 1}));
  const Isolines corner =
      isolines(surface, values_of(surface, [](const Vector& p) { return p.x() + p.y(); }), Values{2});
  for (const auto& segment : corner.segments) EXPECT_GT(length(segment), 0.0);
}

}  // namespace
}  // namespace seamwire
