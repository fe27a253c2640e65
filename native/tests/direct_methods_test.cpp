// SPDX-License-Identifier: GPL-3.0-or-later
//
// The methods that the benchmarks measure beside ours, where distances are known: the plane with the same tensor all
// over.
#include "direct_methods.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "embeddings.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "shapes.hpp"

namespace seamwire::bench {
namespace {

using Distances = std::function<std::vector<double>(const MetricSurface&, std::int32_t seed)>;

constexpr double kL1 = 4.0, kL2 = 0.25, kAngle = 0.4;  // anisotropy 4, along no edge

struct Errors {
  double mean = 0.0, lowest = 0.0, highest = 0.0;  // relative; lowest: the most that a distance is too short
};

Surface plane(int n) { return shapes::grid(n, 0.2).surface(); }

std::int32_t middle(int n) { return (n + 1) * (n / 2) + n / 2; }

Errors errors(int n, const Distances& method) {
  const Surface surface = plane(n);
  const Metric metric = embeddings::plane_metric(surface, kL1, kL2, kAngle);
  const std::int32_t seed = middle(n);
  const std::vector<double> distances = method(metric_surface(surface, metric), seed);
  Errors result;
  for (std::int32_t v = 0; v < std::int32_t(distances.size()); ++v) {
    const Vector d = surface.points()[v] - surface.points()[seed];
    if (v == seed) continue;
    const double error = distances[v] / std::sqrt(d.dot(metric.tensors[0] * d)) - 1;
    result.mean += std::abs(error) / static_cast<double>(distances.size() - 1);
    result.lowest = std::min(result.lowest, error);
    result.highest = std::max(result.highest, error);
  }
  return result;
}

Distances steiner(int points) {
  return [=](const MetricSurface& s, std::int32_t seed) { return steiner_dijkstra(s, seed, points); };
}
Distances vectors(int memory) {
  return [=](const MetricSurface& s, std::int32_t seed) { return short_term_vector_dijkstra(s, seed, memory); };
}

constexpr double kRounding = 1e-9;

TEST(DirectMethods, EdgePathsAreNeverTooShortAndDoNotConverge) {
  const Errors coarse = errors(16, edge_dijkstra), fine = errors(64, edge_dijkstra);
  EXPECT_GE(fine.lowest, -kRounding);
  EXPECT_GT(fine.mean, coarse.mean / 2);
  EXPECT_GT(fine.mean, 0.02);
}

TEST(DirectMethods, EdgePathsAreExactAlongEdges) {
  const Surface surface = shapes::grid(8).surface();
  const Metric metric = embeddings::plane_metric(surface, kL1, kL2, 0.0);
  const std::vector<double> distances = edge_dijkstra(metric_surface(surface, metric), 0);
  EXPECT_NEAR(distances[8], std::sqrt(kL1), kRounding);  // along x
  EXPECT_NEAR(distances[80], std::sqrt(kL1 + kL2), kRounding);
}

TEST(DirectMethods, SteinerPointsComeNearerTheMoreTheyAre) {
  const Errors none = errors(32, steiner(0)), some = errors(32, steiner(2)), many = errors(32, steiner(8));
  EXPECT_NEAR(none.mean, errors(32, edge_dijkstra).mean, kRounding);
  EXPECT_GE(many.lowest, -kRounding);
  EXPECT_LT(some.mean, none.mean / 3);
  EXPECT_LT(many.mean, some.mean / 3);
  EXPECT_LT(many.mean, 0.01);
}

TEST(DirectMethods, ShortTermVectorsAreEdgesWithoutMemoryAndExactWithAll) {
  const Errors edges = errors(32, edge_dijkstra);
  EXPECT_NEAR(errors(32, vectors(1)).mean, edges.mean, kRounding);
  const Errors ten = errors(32, vectors(10)), all = errors(32, vectors(1000));
  EXPECT_GE(ten.lowest, -kRounding);
  EXPECT_LT(ten.mean, edges.mean / 3);
  EXPECT_LT(all.highest, kRounding);
}

TEST(DirectMethods, OrderedUpwindComesNear) {
  const Errors found = errors(64, ordered_upwind);
  EXPECT_GE(found.lowest, -kRounding);  // linear between vertices is above the distance, which is convex
  EXPECT_LT(found.mean, 0.003);
}

TEST(DirectMethods, HeatInAMetricIsThatOnTheStretchedPlane) {
  const Surface surface = plane(32);
  const Metric metric = embeddings::plane_metric(surface, kL1, kL2, kAngle);
  const Metric root = embeddings::plane_metric(surface, std::sqrt(kL1), std::sqrt(kL2), kAngle);
  std::vector<Vector> points;
  for (const Vector& p : surface.points()) points.push_back(root.tensors[0] * p);
  const Surface stretched(points, surface.triangles());
  const Metric euclidean = embeddings::plane_metric(stretched, 1.0, 1.0, 0.0);
  const std::vector<double> found = HeatMethod(metric_surface(surface, metric)).solve(middle(32));
  const std::vector<double> expected = HeatMethod(metric_surface(stretched, euclidean)).solve(middle(32));
  for (std::size_t v = 0; v < found.size(); ++v) EXPECT_NEAR(found[v], expected[v] / stretched.scale(), 1e-4);
}

TEST(DirectMethods, HeatComesNearWhereTrianglesAreRound) {
  const Surface surface = plane(64);
  const Metric metric = embeddings::plane_metric(surface, 1.0, 1.0, 0.0);
  const std::vector<double> found = HeatMethod(metric_surface(surface, metric)).solve(middle(64));
  double mean = 0.0;
  for (std::size_t v = 0; v < found.size(); ++v) {
    const double distance = (surface.points()[v] - surface.points()[embeddings::at(middle(64))]).norm();
    mean += std::abs(found[v] - distance) / static_cast<double>(found.size());
  }
  EXPECT_LT(mean, 0.02);
}

TEST(DirectMethods, FastMarchingOnTheEmbeddingConverges) {
  const auto marching = [](int n) {
    return errors(n, [=](const MetricSurface& s, std::int32_t seed) {
      return FastMarching(embed(plane(n), s.metric).mesh).solve(seed);
    });
  };
  const Errors coarse = marching(16), fine = marching(64);
  EXPECT_GE(fine.lowest, -kRounding);
  EXPECT_LT(fine.mean, 0.6 * coarse.mean);
  EXPECT_LT(fine.mean, 0.02);
}

TEST(DirectMethods, TheReferenceIsExact) {
  const Errors reference = errors(8, [](const MetricSurface& s, std::int32_t seed) {
    const auto [surface, metric] = refined(plane(8), s.metric, 2);
    std::vector<double> distances = ExactGeodesics(embed(surface, metric).mesh).solve(seed).distances();
    distances.resize(s.points.size());
    return distances;
  });
  EXPECT_GE(reference.lowest, -kRounding);
  EXPECT_LT(reference.highest, kRounding);
}

TEST(DirectMethods, SurfacesThatWereCutOpenAreRefused) {
  const Surface surface = shapes::moebius(8).surface();
  const Metric metric = euclidean_metric(surface, principal_curvatures(surface));
  EXPECT_THROW(metric_surface(surface, metric), InvalidInput);
}

}  // namespace
}  // namespace seamwire::bench
