// SPDX-License-Identifier: GPL-3.0-or-later
//
// The methods that the benchmarks measure beside ours, where distances are known: the plane with the same tensor all
// over.
#include "direct_methods.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
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
// The heat method solves with 1e-8 of mass added.
constexpr double kHeatRounding = 1e-6;
// Each time that edges are halved, an error that falls with the root of their length, half an order, falls by this.
// The methods that converge are of first order, but for the logarithm that a point as source costs.
const double kHalfOrder = std::sqrt(0.5);

TEST(DirectMethods, EdgePathsAreNeverTooShortAndDoNotConverge) {
  const Errors coarse = errors(16, edge_dijkstra), fine = errors(64, edge_dijkstra);
  EXPECT_GE(fine.lowest, -kRounding);
  EXPECT_GT(fine.mean, kHalfOrder * coarse.mean);
}

TEST(DirectMethods, EdgePathsAreExactAlongEdges) {
  const Surface surface = shapes::grid(8).surface();
  const Metric metric = embeddings::plane_metric(surface, kL1, kL2, 0.0);
  const std::vector<double> distances = edge_dijkstra(metric_surface(surface, metric), 0);
  EXPECT_NEAR(distances[8], std::sqrt(kL1), kRounding);  // along x
  EXPECT_NEAR(distances[80], std::sqrt(kL1 + kL2), kRounding);
}

TEST(DirectMethods, SteinerPointsAreOfFirstOrderInTheirSpacing) {
  const Errors none = errors(32, steiner(0)), some = errors(32, steiner(2)), many = errors(32, steiner(8));
  EXPECT_NEAR(none.mean, errors(32, edge_dijkstra).mean, kRounding);
  EXPECT_GE(many.lowest, -kRounding);
  EXPECT_LT(some.mean, none.mean / 3);
  EXPECT_LT(many.mean, some.mean / 3);
}

TEST(DirectMethods, ShortTermVectorsAreBetweenEdgesAndTheStraightLine) {
  const Errors edges = errors(32, edge_dijkstra);
  EXPECT_NEAR(errors(32, vectors(1)).mean, edges.mean, kRounding);
  const Errors ten = errors(32, vectors(10)), all = errors(32, vectors(1000));
  EXPECT_GE(ten.lowest, -kRounding);
  EXPECT_LT(ten.mean, edges.mean);
  EXPECT_LE(ten.highest, edges.highest);
  EXPECT_LT(all.highest, kRounding);
}

// A linear interpolation between two points of a convex function, as the distance is here, lies above it.
TEST(DirectMethods, MarchingMethodsAreNeverTooShortOnThePlane) {
  const Errors upwind = errors(64, ordered_upwind), edges = errors(64, edge_dijkstra);
  const Errors marching = errors(64, [](const MetricSurface& s, std::int32_t seed) {
    return FastMarching(embed(plane(64), s.metric, {.max_error = 0}).mesh).solve(seed);
  });
  EXPECT_GE(upwind.lowest, -kRounding);
  EXPECT_GE(marching.lowest, -kRounding);
  EXPECT_LT(upwind.mean, edges.mean);
  EXPECT_LT(marching.mean, edges.mean);
}

TEST(DirectMethods, ShortTermVectorsUnrollACylinder) {
  constexpr int kAround = 24, kRows = 12;
  const Surface surface = shapes::cylinder(kAround, kRows).surface();
  Metric metric = embeddings::identity_metric(surface);
  for (std::size_t v = 0; v < metric.size(); ++v) {
    const Vector& p = surface.points()[v];
    metric.normals[v] = Vector(p.x(), p.y(), 0).normalized();
    metric.tensors[v] -= metric.normals[v] * metric.normals[v].transpose();
  }
  const std::vector<double> distances = short_term_vector_dijkstra(metric_surface(surface, metric), 0, 1000);
  const double side = (surface.points()[1] - surface.points()[0]).norm();
  for (std::size_t v = 0; v < distances.size(); ++v) {
    const std::size_t column = v % kAround;
    const double around = side * static_cast<double>(std::min(column, kAround - column));
    EXPECT_NEAR(distances[v], std::hypot(around, surface.points()[v].z()), kRounding);
  }
}

// The plane in 24 x 24 cells with one tensor, but for a ditch from x = 1/3 to 2/3 where all ways cost `kDear`.
constexpr int kCells = 24, kFrom = 8, kTo = 16;
constexpr double kDear = 10.0;

int column(const Surface& surface, std::size_t v) {
  return static_cast<int>(std::lround(kCells * surface.points()[v].x()));
}

Metric ditch_metric(const Surface& surface, double l1, double l2) {
  Metric metric = embeddings::plane_metric(surface, l1, l2, 0.0);
  for (std::size_t v = 0; v < metric.size(); ++v) {
    if (column(surface, v) < kFrom || column(surface, v) > kTo) continue;
    metric.tensors[v].diagonal() = Vector(kDear * kDear, kDear * kDear, 0.0);
  }
  return metric;
}

// Behind the front nothing counts, however far a vertex looks: here from the right over the ditch.
TEST(DirectMethods, OrderedUpwindSeesNoFartherThanTheFront) {
  const Surface surface = shapes::grid(kCells).surface();
  const Metric metric = ditch_metric(surface, 1.0, 1.0 / 400);  // anisotropy 20; fronts are upright
  const std::vector<double> distances = ordered_upwind(metric_surface(surface, metric), middle(kCells) - kCells / 2);
  // Up to an edge at both ends of the ditch goes by the form on the other side.
  const double crossing = kDear * (kTo - kFrom - 2) / kCells;
  for (std::size_t v = 0; v < metric.size(); ++v) {
    if (column(surface, v) > kTo) {
      EXPECT_GT(distances[v], crossing);
    }
  }
}

TEST(DirectMethods, OrderedUpwindLooksFartherOnlyWhereTheMetricIsAnisotropic) {
  const Surface surface = shapes::grid(kCells).surface();
  const Metric round = ditch_metric(surface, 1.0, 1.0);
  Metric metric = round;
  metric.tensors.back().diagonal() = Vector(400.0, 1.0, 0.0);  // the corner that is reached last: anisotropy 20
  std::vector<double> found = ordered_upwind(metric_surface(surface, metric), 0);
  std::vector<double> expected = ordered_upwind(metric_surface(surface, round), 0);
  found.pop_back();
  expected.pop_back();
  EXPECT_EQ(found, expected);
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
  for (std::size_t v = 0; v < found.size(); ++v) EXPECT_NEAR(found[v], expected[v], kHeatRounding);
}

TEST(DirectMethods, HeatConvergesWhereTrianglesAreRound) {
  const auto mean = [](int n) {
    const Surface surface = plane(n);
    const Metric metric = embeddings::plane_metric(surface, 1.0, 1.0, 0.0);
    const std::vector<double> found = HeatMethod(metric_surface(surface, metric)).solve(middle(n));
    double sum = 0.0;
    for (std::size_t v = 0; v < found.size(); ++v) {
      const double distance = (surface.points()[v] - surface.points()[embeddings::at(middle(n))]).norm();
      sum += std::abs(found[v] - distance);
    }
    return sum / static_cast<double>(found.size());
  };
  EXPECT_LT(mean(64), kHalfOrder * kHalfOrder * mean(16));
}

TEST(DirectMethods, WhereTrianglesAreObtuseHeatNeedsALongerTimeStep) {
  // Along the diagonals of the squares without an edge.
  const Surface surface = plane(64);
  const Metric metric = embeddings::plane_metric(surface, 20.0, 1.0 / 20.0, std::numbers::pi / 4);
  const MetricSurface input = metric_surface(surface, metric);
  const std::vector<double> exact =
      ExactGeodesics(embed(surface, metric, {.max_error = 0}).mesh).solve(middle(64)).distances();
  const auto mean = [&](double steps) {
    const std::vector<double> found = HeatMethod(input, steps).solve(middle(64));
    double sum = 0.0;
    for (std::size_t v = 0; v < found.size(); ++v) sum += std::abs(found[v] - exact[v]);
    return sum / static_cast<double>(found.size());
  };
  EXPECT_LT(mean(64.0), 0.5 * mean(1.0));
}

// A curved surface in a metric that varies, cut into fours: what the direct methods are measured on.
class DirectMethodsOnTheTorus : public ::testing::Test {
 protected:
  DirectMethodsOnTheTorus()
      : torus(shapes::torus(24, 12).surface()),
        metric(feature_metric(torus, principal_curvatures(torus), Follow::kMin, {.max_anisotropy = 3.0})),
        reference(exact(3)) {}

  std::vector<double> exact(int levels) const {
    const auto [surface, fine] = refined(torus, metric, levels);
    return ExactGeodesics(embed(surface, fine, {.max_error = 0}).mesh).solve(0).distances();
  }
  MetricSurface cut(int levels) const {
    const auto [surface, fine] = refined(torus, metric, levels);
    return metric_surface(surface, fine);
  }
  // The mean relative differences at the torus' own vertices: with their sign, and without.
  struct Difference {
    double is_longer = 0.0, is_other = 0.0;
  };
  Difference difference(const std::vector<double>& found, const std::vector<double>& expected) const {
    Difference result;
    const std::size_t count = torus.vertex_count();
    for (std::size_t v = 1; v < count; ++v) {
      const double error = found[v] / expected[v] - 1;
      result.is_longer += error / static_cast<double>(count - 1);
      result.is_other += std::abs(error) / static_cast<double>(count - 1);
    }
    return result;
  }
  double error(const std::vector<double>& found) const { return difference(found, reference).is_other; }

  Surface torus;
  Metric metric;
  std::vector<double> reference;
};

// Dijkstra's paths over Steiner points share with the embedding neither lengths of edges nor unfolding: they are summed
// up in space, through the forms. Their excess over the shortest is quadratic in the spacing.
TEST_F(DirectMethodsOnTheTorus, SteinerPointsConvergeToTheReference) {
  const MetricSurface surface = cut(2);
  const double wide = difference(steiner_dijkstra(surface, 0, 5), reference).is_longer;
  const double close = difference(steiner_dijkstra(surface, 0, 11), reference).is_longer;
  EXPECT_GT(close, 0.0);
  EXPECT_LT(close, wide / 2);
  // The error of the extrapolation is no more than the change of either when the surface is cut.
  EXPECT_LT(std::abs(close - (wide - close) / 3), error(exact(1)));
}

TEST_F(DirectMethodsOnTheTorus, OursIsOfSecondOrder) {
  EXPECT_LT(error(exact(1)), error(exact(0)) / 2);
  EXPECT_LT(error(exact(2)), error(exact(1)) / 2);
}

TEST_F(DirectMethodsOnTheTorus, MarchingMethodsConverge) {
  const auto marching = [&](int levels) {
    const auto [surface, fine] = refined(torus, metric, levels);
    return error(FastMarching(embed(surface, fine, {.max_error = 0}).mesh).solve(0));
  };
  const auto upwind = [&](int levels) { return error(ordered_upwind(cut(levels), 0)); };
  EXPECT_LT(upwind(1), kHalfOrder * upwind(0));
  EXPECT_LT(upwind(2), kHalfOrder * upwind(1));
  EXPECT_LT(marching(1), kHalfOrder * marching(0));
  EXPECT_LT(marching(2), kHalfOrder * marching(1));
}

// On a curved surface the sum of edges cuts corners: less so the shorter they are.
TEST_F(DirectMethodsOnTheTorus, ShortTermVectorsAreTooShortByLessTheFinerTheMesh) {
  const auto shortest = [&](int levels) {
    const std::vector<double> found = short_term_vector_dijkstra(cut(levels), 0, 10);
    double lowest = 0.0;
    for (std::size_t v = 1; v < torus.vertex_count(); ++v) lowest = std::min(lowest, found[v] / reference[v] - 1);
    return -lowest;
  };
  EXPECT_LT(shortest(1), kHalfOrder * shortest(0));
  EXPECT_LT(shortest(2), kHalfOrder * shortest(1));
}

TEST_F(DirectMethodsOnTheTorus, PathsOverEdgesAndFacesAreAsLongBackwards) {
  const MetricSurface surface = cut(0);
  for (const std::int32_t v : {1, 77, 200}) {
    EXPECT_NEAR(edge_dijkstra(surface, 0)[embeddings::at(v)], edge_dijkstra(surface, v)[0], kRounding);
    EXPECT_NEAR(steiner_dijkstra(surface, 0, 3)[embeddings::at(v)], steiner_dijkstra(surface, v, 3)[0], kRounding);
  }
}

TEST_F(DirectMethodsOnTheTorus, DistancesAreTwiceAsLongInAMetricOfTwiceTheLengths) {
  Metric twice = metric;
  for (Eigen::Matrix3d& tensor : twice.tensors) tensor *= 4;
  const std::vector<Distances> methods = {
      edge_dijkstra,
      steiner(3),
      vectors(5),
      ordered_upwind,
      [](const MetricSurface& s, std::int32_t seed) { return HeatMethod(s).solve(seed); },
      [&](const MetricSurface& s, std::int32_t seed) {
        return FastMarching(embed(torus, s.metric, {.max_error = 0}).mesh).solve(seed);
      },
      [&](const MetricSurface& s, std::int32_t seed) {
        return SaddleVertexGraph(embed(torus, s.metric, {.max_error = 0}).mesh, 20).solve(seed);
      }};
  for (const Distances& method : methods) {
    const std::vector<double> once = method(metric_surface(torus, metric), 0);
    const std::vector<double> found = method(metric_surface(torus, twice), 0);
    for (std::size_t v = 0; v < torus.vertex_count(); ++v) EXPECT_NEAR(found[v], 2 * once[v], kHeatRounding);
  }
}

// The graph with all direct geodesics has every geodesic. With small discs, paths are real ones, but longer.
void expect_exact_with_all_vertices(const IntrinsicMesh& mesh) {
  const ExactGeodesics exact(mesh);
  const SaddleVertexGraph all(mesh, mesh.vertex_count), many(mesh, 100), few(mesh, 10);
  for (const std::int32_t seed : {0, mesh.vertex_count / 2, mesh.vertex_count - 1}) {
    const std::vector<double> expected = exact.solve(seed).distances();
    const std::vector<double> found = all.solve(seed), longer = many.solve(seed), longest = few.solve(seed);
    double sum = 0.0, longer_sum = 0.0, longest_sum = 0.0;
    for (std::size_t v = 0; v < expected.size(); ++v) {
      EXPECT_NEAR(found[v], expected[v], kRounding);
      EXPECT_GE(longer[v], expected[v] - kRounding);
      EXPECT_GE(longest[v], expected[v] - kRounding);
      sum += expected[v];
      longer_sum += longer[v];
      longest_sum += longest[v];
    }
    EXPECT_GT(longer_sum, sum);
    EXPECT_GT(longest_sum, longer_sum);
    EXPECT_LT(longest_sum, 1.1 * sum);
  }
}

TEST_F(DirectMethodsOnTheTorus, TheSaddleVertexGraphIsExactWithAllVertices) {
  expect_exact_with_all_vertices(embed(torus, metric, {.max_error = 0}).mesh);
}

TEST(DirectMethods, TheSaddleVertexGraphIsExactAroundABoundary) {
  const Surface surface = shapes::cylinder(24, 12).surface();
  expect_exact_with_all_vertices(
      embed(surface, euclidean_metric(surface, principal_curvatures(surface)), {.max_error = 0}).mesh);
}

TEST(DirectMethods, TheReferenceIsExact) {
  const Errors reference = errors(8, [](const MetricSurface& s, std::int32_t seed) {
    const auto [surface, metric] = refined(plane(8), s.metric, 2);
    std::vector<double> distances =
        ExactGeodesics(embed(surface, metric, {.max_error = 0}).mesh).solve(seed).distances();
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
