// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/wires/closed_wires.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/metric/metric.hpp"
#include "shapes.hpp"

namespace seamwire {
namespace {

constexpr double kTau = 2 * std::numbers::pi;

/// Distances and loops over a mesh in the Euclidean metric, unless another one is given.
struct Solved {
  explicit Solved(const shapes::Mesh& mesh)
      : surface(mesh.surface()),
        embedding(embed(surface, euclidean_metric(surface, principal_curvatures(surface)), {.max_error = 0})) {}

  DistanceField field(const SurfacePoint& seed, const SolveOptions& options = {}) const {
    return ExactGeodesics(embedding.mesh).solve(std::vector{seed}, options);
  }
  std::vector<ClosedWire> loops(const SurfacePoint& seed, std::size_t count = 3) const {
    return closed_wires(surface, embedding, field(seed), count);
  }
  std::vector<ClosedWire> loops(std::int32_t seed, std::size_t count = 3) const {
    return loops(SurfacePoint(seed), count);
  }

  Surface surface;
  Embedding embedding;
};

/// A closed surface of revolution about the z axis, with n cells around and `rows` from pole to pole. The profile gives
/// the distance from the axis and the height for u in [0, 1]. The last two vertices are the poles.
shapes::Mesh revolution(int n, int rows, const std::function<std::array<double, 2>(double)>& profile) {
  shapes::Mesh mesh = shapes::parametric(n, rows - 2, true, false, [&](double u, double v) {
    const auto [r, z] = profile((1 + v * (rows - 2)) / rows);
    return Vector(r * std::cos(kTau * u), r * std::sin(kTau * u), z);
  });
  const int bottom = static_cast<int>(mesh.points.size()), last = (rows - 2) * n;
  mesh.points.emplace_back(0, 0, profile(0)[1]);
  mesh.points.emplace_back(0, 0, profile(1)[1]);
  for (int i = 0; i < n; ++i) {
    mesh.triangles.push_back({bottom, (i + 1) % n, i});
    mesh.triangles.push_back({bottom + 1, last + i, last + (i + 1) % n});
  }
  return mesh;
}

/// Of radius 0.1, with flat ends at z = 0 and z = 1.
std::array<double, 2> rod(double u) {
  const double along = 1.2 * u;
  if (along < 0.1) return {along, 0.0};
  return along > 1.1 ? std::array{1.2 - along, 1.0} : std::array{0.1, along - 0.1};
}

/// Two balls, of radius 0.25 or so, and a neck of radius 0.05 at z = 0.
std::array<double, 2> dumbbell(double u) {
  const double angle = std::numbers::pi * u, z = -0.5 * std::cos(angle);
  return {std::sin(angle) * (0.05 + z * z), z};
}

shapes::Mesh joined(shapes::Mesh mesh, const shapes::Mesh& other, const Vector& offset) {
  const auto start = static_cast<std::int32_t>(mesh.points.size());
  for (const Vector& p : other.points) mesh.points.push_back(p + offset);
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + start, b + start, c + start});
  return mesh;
}

double highest(const Wire& wire) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vector& p : wire.points) most = std::max(most, p.z());
  return most;
}

double lowest(const Wire& wire) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector& p : wire.points) least = std::min(least, p.z());
  return least;
}

/// It begins and ends at a place, each segment lies in the face that it names, and its length is that of its points.
void expect_closed(const Solved& solved, const ClosedWire& loop, const Vector& seed) {
  const Wire& wire = loop.wire;
  ASSERT_GE(wire.points.size(), 3U);
  ASSERT_EQ(wire.faces.size() + 1, wire.points.size());
  EXPECT_LT((wire.points.front() - seed).norm(), 1e-9);
  EXPECT_LT((wire.points.back() - seed).norm(), 1e-9);
  EXPECT_NEAR(wire.length, wire.euclidean_length, 1e-6 * wire.length);
  EXPECT_GE(loop.turn, 0.0);
  EXPECT_LE(loop.turn, std::numbers::pi);
  for (std::size_t i = 0; i < wire.faces.size(); ++i) {
    ASSERT_GE(wire.faces[i], 0);
    const auto& [a, b, c] = solved.surface.triangles()[wire.faces[i]];
    const std::vector<Vector>& points = solved.surface.points();
    const Vector u = points[b] - points[a], v = points[c] - points[a], normal = u.cross(v);
    for (const Vector& end : {wire.points[i], wire.points[i + 1]}) {
      const Vector w = end - points[a];
      const double at_b = w.cross(v).dot(normal) / normal.squaredNorm();
      const double at_c = u.cross(w).dot(normal) / normal.squaredNorm();
      EXPECT_GT(std::min({at_b, at_c, 1 - at_b - at_c}), -1e-6);
      EXPECT_LT(std::abs(w.dot(normal.normalized())), 1e-9);
    }
  }
}

TEST(ClosedWires, AroundTheTubeOfATorusItDoesNotSeparate) {
  const Solved solved(shapes::torus(60, 30));
  const std::vector<ClosedWire> loops = solved.loops(0);
  ASSERT_FALSE(loops.empty());
  expect_closed(solved, loops[0], solved.surface.points()[0]);
  EXPECT_FALSE(loops[0].separates);
  EXPECT_NEAR(loops[0].wire.euclidean_length, kTau * 0.15, 0.01);
  EXPECT_LT(loops[0].turn, 0.1);
  for (const Vector& p : loops[0].wire.points) EXPECT_LT(std::abs(p.y()), 0.02);
}

TEST(ClosedWires, AroundARodItIsTheRing) {
  const Solved solved(revolution(24, 60, rod));
  const std::int32_t seed = 24 * 30;
  const std::vector<ClosedWire> loops = solved.loops(seed);
  ASSERT_FALSE(loops.empty());
  expect_closed(solved, loops[0], solved.surface.points()[seed]);
  EXPECT_TRUE(loops[0].separates);
  EXPECT_NEAR(loops[0].wire.euclidean_length, kTau * 0.1, 0.01);
  EXPECT_LT(loops[0].turn, 0.1);
  EXPECT_LT(highest(loops[0].wire) - lowest(loops[0].wire), 0.025);  // it may end a row off, 0.02
}

TEST(ClosedWires, FromWithinAFaceItIsTheRingToo) {
  const Solved solved(revolution(24, 60, rod));
  const std::int32_t face = 2 * 24 * 30 + 7;
  const auto& [a, b, c] = solved.surface.triangles()[face];
  const std::vector<Vector>& points = solved.surface.points();
  const std::vector<ClosedWire> loops = solved.loops({face, {0.2, 0.3, 0.5}});
  ASSERT_FALSE(loops.empty());
  expect_closed(solved, loops[0], 0.2 * points[a] + 0.3 * points[b] + 0.5 * points[c]);
  EXPECT_NEAR(loops[0].wire.euclidean_length, kTau * 0.1, 0.01);
}

TEST(ClosedWires, OnTheNeckOfADumbbellItIsTheNeck) {
  const Solved solved(revolution(32, 64, dumbbell));
  for (const int row : {29, 31, 33}) {
    const std::int32_t seed = 32 * row;
    const std::vector<ClosedWire> loops = solved.loops(seed);
    ASSERT_FALSE(loops.empty());
    EXPECT_TRUE(loops[0].separates);
    EXPECT_LT(loops[0].wire.euclidean_length, kTau * 0.08);
  }
}

TEST(ClosedWires, ThereIsNoneOnASphere) {
  const Solved solved(shapes::icosphere(4));
  for (const std::int32_t seed : {0, 5, 100, 777, 2000}) EXPECT_TRUE(solved.loops(seed).empty()) << seed;
}

TEST(ClosedWires, ThereIsNoneFromTheTipOfALimb) {
  const Solved solved(revolution(32, 64, dumbbell));
  const auto tip = static_cast<std::int32_t>(solved.surface.vertex_count()) - 1;
  EXPECT_TRUE(solved.loops(tip).empty());
}

TEST(ClosedWires, ThereIsNoneOnAPlane) {
  for (const double jitter : {0.0, 0.3}) {
    const Solved solved(shapes::grid(20, jitter));
    for (const std::int32_t seed : {0, 10, 21, 220, 224, 440}) EXPECT_TRUE(solved.loops(seed).empty()) << seed;
  }
}

TEST(ClosedWires, AroundAnOpenCylinderItIsTheRing) {
  const Solved solved(shapes::cylinder(32, 30));
  const std::int32_t seed = 32 * 15;
  const std::vector<ClosedWire> loops = solved.loops(seed);
  ASSERT_FALSE(loops.empty());
  expect_closed(solved, loops[0], solved.surface.points()[seed]);
  EXPECT_TRUE(loops[0].separates);
  EXPECT_NEAR(loops[0].wire.euclidean_length, kTau * 0.25, 0.02);
}

TEST(ClosedWires, OtherPartsOfTheSurfaceDoNotCount) {
  const shapes::Mesh alone = revolution(24, 60, rod);
  const shapes::Mesh ball = shapes::icosphere(3, 5.0);
  const Solved solved(alone), with_ball(joined(alone, ball, {20, 0, 0}));
  const std::int32_t seed = 24 * 30;
  const std::vector<ClosedWire> loops = solved.loops(seed), same = with_ball.loops(seed);
  ASSERT_FALSE(loops.empty());
  ASSERT_FALSE(same.empty());
  EXPECT_NEAR(same[0].wire.euclidean_length, loops[0].wire.euclidean_length, 1e-6);
}

TEST(ClosedWires, TheyAreApartAndNoMoreThanAskedFor) {
  const Solved solved(revolution(32, 64, dumbbell));
  const std::int32_t seed = 32 * 20;
  EXPECT_TRUE(solved.loops(seed, 0).empty());
  const std::vector<ClosedWire> one = solved.loops(seed, 1), more = solved.loops(seed, 5);
  ASSERT_EQ(one.size(), 1U);
  ASSERT_FALSE(more.empty());
  EXPECT_EQ(one[0].wire.points, more[0].wire.points);
}

/// A ring about the y axis.
ClosedWire ring(double radius, double height) {
  ClosedWire made;
  for (int i = 0; i <= 100; ++i) {
    const double angle = kTau * i / 100;
    made.wire.points.emplace_back(radius * std::cos(angle), height, radius * std::sin(angle));
  }
  return made;
}

TEST(ClosedWires, OfSeveralMetricsTheBestOfEachComeFirst) {
  const double apart = 0.03 * kTau;
  const std::vector<std::vector<ClosedWire>> metrics = {
      {ring(1, 0), ring(1, 1), ring(1, 2)}, {ring(1, 3), ring(1, 4)}, {}, {ring(1, 5)}};
  using Choices = std::vector<ClosedCutId>;
  EXPECT_EQ(choose_closed_wires(metrics), (Choices{{0, 0}, {1, 0}, {3, 0}}));
  EXPECT_EQ(choose_closed_wires(metrics, 9), (Choices{{0, 0}, {1, 0}, {3, 0}, {0, 1}, {0, 2}, {1, 1}}));
  EXPECT_EQ(choose_closed_wires(metrics, 0), Choices{});
  EXPECT_EQ(choose_closed_wires({}), Choices{});
  EXPECT_THROW(choose_closed_wires(std::vector<std::vector<ClosedWire>>{{ClosedWire{}}}), InvalidInput);

  const std::vector<std::vector<ClosedWire>> alike = {{ring(1, 0), ring(1, 3), ring(1, 6)},
                                                      {ring(1, 0.9 * apart), ring(1, 3 + 0.9 * apart), ring(1, 9)}};
  EXPECT_EQ(choose_closed_wires(alike, 9), (Choices{{0, 0}, {0, 1}, {0, 2}, {1, 2}})) << "those alike once";
  const std::vector<std::vector<ClosedWire>> second = {{ring(1, 0), ring(1, 3 + 0.9 * apart)}, {ring(1, 3)}};
  EXPECT_EQ(choose_closed_wires(second), (Choices{{0, 0}, {1, 0}})) << "the later one of them is left out";
  const std::vector<std::vector<ClosedWire>> unlike = {{ring(1, 0)}, {ring(1, 1.1 * apart)}};
  EXPECT_EQ(choose_closed_wires(unlike), (Choices{{0, 0}, {1, 0}}));
}

TEST(ClosedWires, WhatTheFieldHasNotReachedIsLeftAlone) {
  const Solved solved(revolution(24, 60, rod));
  const SurfacePoint seed = SurfacePoint(24 * 30);
  const DistanceField near = solved.field(seed, {.max_distance = 0.2, .targets = {}});
  EXPECT_TRUE(closed_wires(solved.surface, solved.embedding, near).empty());  // half around is 0.31
  const DistanceField enough = solved.field(seed, {.max_distance = 0.4, .targets = {}});
  const std::vector<ClosedWire> loops = closed_wires(solved.surface, solved.embedding, enough);
  ASSERT_FALSE(loops.empty());
  EXPECT_NEAR(loops[0].wire.euclidean_length, kTau * 0.1, 0.01);
}

TEST(ClosedWires, OnBumpyAndTornMeshesTheyAreClosedCutsAllTheSame) {
  const auto torn = [](const Vector& center) { return std::sin(40 * center.x()) * std::sin(37 * center.y()) > 0.75; };
  const std::vector<shapes::Mesh> meshes = {
      shapes::bumpy(shapes::torus(30, 16), 0.02), shapes::bumpy(revolution(20, 30, dumbbell), 0.02),
      shapes::without(shapes::torus(40, 20), torn), shapes::without(shapes::icosphere(3), torn), shapes::moebius(24)};
  std::size_t found = 0;
  for (const shapes::Mesh& mesh : meshes) {
    const Solved solved(mesh);
    for (std::size_t seed = 0; seed < mesh.points.size(); seed += mesh.points.size() / 9 + 1) {
      for (const ClosedWire& loop : solved.loops(static_cast<std::int32_t>(seed))) {
        expect_closed(solved, loop, mesh.points[seed]);
        ++found;
      }
    }
  }
  EXPECT_GT(found, 20U);
}

TEST(ClosedWires, OnTheSmallestMeshesNothingBreaks) {
  const std::vector<shapes::Mesh> meshes = {
      {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}},
      {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}},
      {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}}, {{0, 1, 2}, {0, 1, 1}}},                // a face without area
      {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}}};  // two fans at a vertex
  for (const shapes::Mesh& mesh : meshes) {
    const Solved solved(mesh);
    for (std::size_t seed = 0; seed < mesh.points.size(); ++seed) {
      for (const ClosedWire& loop : solved.loops(static_cast<std::int32_t>(seed))) {
        expect_closed(solved, loop, mesh.points[seed]);
      }
    }
  }
}

TEST(ClosedWires, SeveralSeedsOrAnotherEmbeddingAreRefused) {
  const Solved solved(shapes::cylinder(12, 6)), other(shapes::cylinder(12, 7));
  const std::vector two = {SurfacePoint(0), SurfacePoint(5)};
  const DistanceField field = ExactGeodesics(solved.embedding.mesh).solve(two);
  EXPECT_THROW(closed_wires(solved.surface, solved.embedding, field), InvalidInput);
  const DistanceField elsewhere = other.field(SurfacePoint(0));
  EXPECT_THROW(closed_wires(solved.surface, solved.embedding, elsewhere), InvalidInput);
}

TEST(ClosedWires, TheyCanBeStopped) {
  const Solved solved(shapes::torus(60, 30));
  const DistanceField field = solved.field(SurfacePoint(0));
  for (const double until : {0.0, 0.2, 0.5, 0.8}) {
    const Task task{.stop = {}, .progress = [until](double fraction) { return fraction < until; }};
    EXPECT_THROW(closed_wires(solved.surface, solved.embedding, field, 3, task), Cancelled) << until;
  }
}

}  // namespace
}  // namespace seamwire
