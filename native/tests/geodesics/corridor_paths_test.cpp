// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/geodesics/corridor_paths.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>

#include "inserted_point.hpp"
#include "intrinsic.hpp"
#include "paths.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/metric/curvature.hpp"
#include "seamwire/metric/metric.hpp"

namespace seamwire {
namespace {

using paths::index;
using paths::length_of;
using shapes::exactness_meshes;
using shapes::intrinsic;

/// The sum of (length / distance - 1), and how many.
struct Excess {
  double sum = 0.0;
  int count = 0;
  double mean() const { return sum / count; }
};

/// Paths to some vertices are real, from seed to target, as long as they say, and not shorter than the geodesic (to
/// rounding, 1e-9) nor more than `longest` times as long.
Excess expect_paths(const IntrinsicMesh& mesh, std::int32_t seed, double longest,
                    const CorridorPathOptions& options = {}) {
  const ExactGeodesics geodesics(mesh);
  const DistanceField field = geodesics.solve(seed);
  CorridorPaths quick(geodesics, seed, options);
  EXPECT_EQ(quick.seed(), seed);
  Excess excess;
  const std::int32_t step = std::max(1, mesh.vertex_count / 60);
  for (std::int32_t v = 0; v < mesh.vertex_count; v += step) {
    const double distance = field.distances()[index(v)];
    const std::optional<IntrinsicPath> found = quick.path(v);
    EXPECT_EQ(found.has_value(), !std::isinf(distance)) << "vertex " << v;
    if (!found) continue;
    const IntrinsicPath& path = *found;
    EXPECT_EQ(path.points.front().vertex, seed);
    EXPECT_EQ(path.points.back().vertex, v);
    EXPECT_NEAR(path.length, length_of(mesh, path), 1e-9 * distance) << "vertex " << v;
    EXPECT_GE(path.length, distance * (1 - 1e-9)) << "vertex " << v;
    EXPECT_LE(path.length, distance * longest + 1e-15) << "vertex " << v;
    if (distance > 0) excess.sum += path.length / distance - 1;
    ++excess.count;
  }
  return excess;
}

class CorridorPathsOn : public testing::TestWithParam<int> {};

TEST_P(CorridorPathsOn, AWholeCorridorAndAllWindowsAreExact) {
  const auto [name, mesh] = exactness_meshes(2)[static_cast<std::size_t>(GetParam())];
  SCOPED_TRACE(name);
  expect_paths(intrinsic(mesh), mesh.triangles[7][1], 1 + 1e-9, {.corridor_vertices = 100000, .windows = 0});
  for (const std::uint32_t windows : {1U, 4U}) {
    expect_paths(intrinsic(mesh), mesh.triangles[7][1], 1.05, {.corridor_vertices = 100000, .windows = windows});
  }
}

// The bounds that previews are to keep: 5 % for any vertex, 0.1 % on average.
TEST_P(CorridorPathsOn, CloseToTheGeodesicOnLargerMeshes) {
  const auto [name, mesh] = exactness_meshes(4)[static_cast<std::size_t>(GetParam())];
  SCOPED_TRACE(name);
  const Excess excess = expect_paths(intrinsic(mesh), mesh.triangles[3][0], 1.05, {.corridor_vertices = 400});
  EXPECT_LT(excess.mean(), 1e-3);
}

// In a corridor of a third of the vertices at most: the default one holds more than most of these meshes have.
TEST_P(CorridorPathsOn, EmbeddedLengths) {
  const auto [name, mesh] = exactness_meshes(4)[static_cast<std::size_t>(GetParam())];
  SCOPED_TRACE(name);
  const Surface surface = mesh.surface();
  const Curvature curvature = principal_curvatures(surface);
  for (const Follow follow : {Follow::kMin, Follow::kMax}) {
    const Metric metric = feature_metric(surface, curvature, follow, {.max_anisotropy = 30.0});
    const Embedding embedding = embed(surface, metric, {.max_error = 0});
    const auto third = static_cast<std::uint32_t>(embedding.mesh.vertex_count / 3);
    const Excess excess =
        expect_paths(embedding.mesh, mesh.triangles[3][0], 1.05, {.corridor_vertices = std::min(400U, third)});
    EXPECT_LT(excess.mean(), 1e-3);
  }
}

TEST_P(CorridorPathsOn, RandomLengths) {
  const auto [name, mesh] = exactness_meshes(2)[static_cast<std::size_t>(GetParam())];
  SCOPED_TRACE(name);
  std::mt19937 random(7);
  expect_paths(intrinsic(mesh, [&](int, int) { return points::draw(random, 1.02, 2.0); }), mesh.triangles[3][0], 1.05);
}

void expect_ends_at(const IntrinsicMesh& mesh, const PathPoint& end, const SurfacePoint& point) {
  const std::int32_t face = end.face >= 0 ? end.face : end.half_edge / 3;
  ASSERT_EQ(face, point.face);
  EXPECT_LT((paths::place(mesh, face, end) - points::in_plane(mesh, face, point.barycentric)).norm(), 1e-13);
}

/// The same from and to points within faces and on edges: real paths, from point to point, no shorter than the
/// geodesic.
void expect_paths_between_points(const IntrinsicMesh& mesh, double longest, const CorridorPathOptions& options = {}) {
  const ExactGeodesics geodesics(mesh);
  for (const auto& [kind, seed] : points::all_kinds(mesh, 21)) {
    const DistanceField field = geodesics.solve(std::array{seed});
    CorridorPaths quick(geodesics, seed, options);
    EXPECT_EQ(quick.seed(), -1);
    std::vector<SurfacePoint> targets{seed, {seed.face, {0.1, 0.2, 0.7}}};
    for (const unsigned draw : {22U, 23U, 24U}) {
      for (const auto& [other_kind, target] : points::all_kinds(mesh, draw)) targets.push_back(target);
    }
    for (const SurfacePoint& target : targets) {
      SCOPED_TRACE(testing::Message() << kind << " of face " << seed.face << ", to face " << target.face);
      const double distance = field.distance(target);
      const std::optional<IntrinsicPath> found = quick.path(target);
      EXPECT_EQ(found.has_value(), !std::isinf(distance));
      if (!found) continue;
      const IntrinsicPath& path = *found;
      expect_ends_at(mesh, path.points.front(), seed);
      expect_ends_at(mesh, path.points.back(), target);
      EXPECT_NEAR(path.length, length_of(mesh, path), 1e-9 * distance + 1e-15);
      EXPECT_GE(path.length, distance * (1 - 1e-9));
      EXPECT_LE(path.length, distance * longest + 1e-15);
    }
  }
}

TEST_P(CorridorPathsOn, BetweenPointsOfFaces) {
  const auto [name, mesh] = exactness_meshes(2)[static_cast<std::size_t>(GetParam())];
  SCOPED_TRACE(name);
  std::mt19937 random(7);
  expect_paths_between_points(intrinsic(mesh), 1 + 1e-9, {.corridor_vertices = 100000, .windows = 0});
  expect_paths_between_points(intrinsic(mesh), 1.05);
  expect_paths_between_points(intrinsic(mesh), 1.2, {.corridor_vertices = 1});
  expect_paths_between_points(intrinsic(mesh, [&](int, int) { return points::draw(random, 1.02, 2.0); }), 1.05);
}

INSTANTIATE_TEST_SUITE_P(CorridorPaths, CorridorPathsOn, testing::Range(0, 7));

// A corridor of the shortest chain of edges and no more still has a path, shortened within the triangles around it.
TEST(CorridorPaths, TheNarrowestCorridorHasAPath) {
  const IntrinsicMesh mesh = intrinsic(shapes::bumpy(shapes::torus(60, 30), 0.08));
  for (const std::uint32_t windows : {0u, 1u, 2u}) {
    expect_paths(mesh, 5, 1.2, {.corridor_vertices = 1, .windows = windows});
  }
}

// On a grid all chains that never turn back are equally long: the corridor is as wide as it gets.
TEST(CorridorPaths, StraightOverAGrid) {
  const IntrinsicMesh mesh = intrinsic(shapes::grid(60));
  expect_paths(mesh, 30 * 61 + 30, 1.05);
  expect_paths(mesh, 0, 1.05, {.corridor_vertices = 300});
}

TEST(CorridorPaths, AreTheSameWhateverWasAskedBefore) {
  const ExactGeodesics geodesics(intrinsic(shapes::bumpy(shapes::icosphere(5), 0.1)));
  CorridorPaths far_first(geodesics, 0, {.corridor_vertices = 500});
  for (const std::int32_t target : {10000, 3, 77, 5000, 10000}) {
    const IntrinsicPath path = far_first.path(target).value();
    const IntrinsicPath fresh = CorridorPaths(geodesics, 0, {.corridor_vertices = 500}).path(target).value();
    EXPECT_EQ(path.length, fresh.length) << "vertex " << target;
    EXPECT_EQ(path.faces, fresh.faces) << "vertex " << target;
  }
}

TEST(CorridorPaths, RunAlongLooseEdges) {
  // Two separate squares and a chain of loose edges between them, one of length zero.
  shapes::Mesh mesh = shapes::grid(6);
  const auto half = static_cast<std::int32_t>(mesh.points.size());
  const shapes::Mesh other = shapes::grid(6);
  for (const Vector& p : other.points) mesh.points.push_back(p + Vector(3, 0, 0));
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + half, b + half, c + half});
  mesh.points.emplace_back(2, 0, 0);
  mesh.points.emplace_back(2, 0, 0);
  mesh.points.emplace_back(9, 9, 9);
  IntrinsicMesh joined = intrinsic(mesh);
  const std::int32_t middle = 2 * half;
  joined.loose_edges = {{24, middle, 1.5}, {middle, middle + 1, 0.0}, {half + 24, middle + 1, 0.5}, {0, 48, 0.25}};
  for (const std::int32_t seed : {0, 24, middle, half + 3, middle + 2}) expect_paths(joined, seed, 1 + 1e-9);
}

TEST(CorridorPaths, ToTheSeedAndToNowhere) {
  shapes::Mesh mesh = shapes::grid(4);
  mesh.points.emplace_back(5, 5, 5);
  const ExactGeodesics geodesics(intrinsic(mesh));
  CorridorPaths quick(geodesics, 3);
  const IntrinsicPath to_seed = quick.path(3).value();
  ASSERT_EQ(to_seed.points.size(), 1u);
  EXPECT_EQ(to_seed.points[0].vertex, 3);
  EXPECT_EQ(to_seed.length, 0.0);
  EXPECT_FALSE(quick.path(25));
  EXPECT_EQ(quick.path(4)->points.size(), 2u);
  EXPECT_THROW(quick.path(26), InvalidInput);
  EXPECT_THROW(quick.path(-1), InvalidInput);
  EXPECT_THROW(CorridorPaths(geodesics, 26), InvalidInput);
}

TEST(CorridorPaths, CancelledOnesCanBeAskedAgain) {
  const ExactGeodesics geodesics(intrinsic(shapes::bumpy(shapes::icosphere(5), 0.1)));
  CorridorPaths quick(geodesics, 0);
  Task task;
  int left = 0;
  task.progress = [&](double) { return left-- > 0; };
  int cancelled = 0;
  for (int looks = 0; looks < 50; ++looks) {
    left = looks;
    try {
      quick.path(10000, task);
    } catch (const Cancelled&) {
      ++cancelled;
    }
  }
  EXPECT_GT(cancelled, 2);
  EXPECT_EQ(quick.path(10000)->length, CorridorPaths(geodesics, 0).path(10000)->length);
}

// Steps are in single precision; lengths may be larger and smaller than that goes.
TEST(CorridorPaths, LengthsBeyondSinglePrecision) {
  for (const double scale : {1e39, 1e70, 1e-39, 1e-70}) {
    SCOPED_TRACE(scale);
    IntrinsicMesh mesh = intrinsic(shapes::grid(20, 0.2));
    for (double& length : mesh.lengths) length *= scale;
    const ExactGeodesics geodesics(mesh);
    const DistanceField field = geodesics.solve(0);
    CorridorPaths quick(geodesics, 0);
    for (const std::int32_t to : {1, 21, 220, 440}) {
      const double distance = field.distances()[index(to)];
      EXPECT_NEAR(quick.path(to)->length, distance, 1e-9 * distance);
    }
  }
}

TEST(CorridorPaths, AreTheSameInAnyUnitThatIsAPowerOfTwo) {
  const IntrinsicMesh mesh = intrinsic(shapes::grid(20, 0.2));
  IntrinsicMesh larger = mesh;
  for (double& length : larger.lengths) length *= 0x1p130;
  const ExactGeodesics geodesics(mesh), of_larger(larger);
  CorridorPaths quick(geodesics, 0), quick_over_larger(of_larger, 0);
  for (std::int32_t to = 1; to < mesh.vertex_count; to += 7) {
    EXPECT_EQ(quick_over_larger.path(to)->length, quick.path(to)->length * 0x1p130);
  }
}

}  // namespace
}  // namespace seamwire
