// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distances on embedded surfaces against closed forms, and against paths and distances found by other means.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <queue>
#include <set>
#include <vector>

#include "embeddings.hpp"
#include "intrinsic.hpp"
#include "reference_geodesics.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "shapes.hpp"

namespace seamwire {
namespace {

using embeddings::at;
using embeddings::plane_metric;
using embeddings::random_metric;
using shapes::Mesh;

// Distances in an embedding, from one of the caller's vertices to all of them.
std::vector<double> distances(const Surface& surface, const Embedding& embedding, std::int32_t seed) {
  std::vector<double> all = ExactGeodesics(embedding.mesh).solve(seed).distances();
  all.resize(surface.vertex_count());
  return all;
}

std::vector<double> distances(const Surface& surface, const Metric& metric, std::int32_t seed) {
  return distances(surface, embed(surface, metric, {.max_error = 0}), seed);
}

// Largest relative difference, the seed left out, whose expected distance may be a rounding.
double largest_error(const std::vector<double>& is, const std::function<double(std::size_t)>& expected) {
  double largest = 0;
  for (std::size_t v = 0; v < is.size(); ++v) {
    const double e = expected(v);
    if (e > 1e-12) largest = std::max(largest, std::abs(is[v] - e) / e);
  }
  return largest;
}

// Distance from an angle to another one.
double turn(double from, double to) { return std::abs(std::remainder(to - from, 2 * std::numbers::pi)); }

TEST(EmbeddedDistance, OnAPlaneWithAConstantTensorIsTheNormOfTheVector) {
  const Surface surface = shapes::grid(24, 0.3).surface();
  for (const double a : {1.0, 5.0, 20.0, 100.0}) {
    for (const double angle : {0.0, 0.4, 2.0}) {
      const Metric metric = plane_metric(surface, a, 1 / a, angle);
      for (const std::int32_t seed : {0, 12 * 25 + 12}) {
        const std::vector<double> d = distances(surface, metric, seed);
        const auto expected = [&](std::size_t v) {
          const Vector e = surface.points()[v] - surface.points()[at(seed)];
          return std::sqrt(e.dot(metric.tensors[0] * e));
        };
        EXPECT_LT(largest_error(d, expected), 1e-9) << "A = " << a << ", angle " << angle;
      }
    }
  }
}

TEST(EmbeddedDistance, AtGammaZeroIsEuclidean) {
  for (const Mesh& mesh : {shapes::grid(9, 0.3), shapes::icosphere(3), shapes::cylinder(20, 12), shapes::torus(24, 12),
                           shapes::bumpy(shapes::icosphere(3), 0.05)}) {
    const Surface surface = mesh.surface();
    const Metric metric = feature_metric(surface, principal_curvatures(surface), Follow::kMax, {.parameter = 0});
    const Embedding embedding = embed(surface, metric, {.max_error = 0});
    EXPECT_EQ(embedding.faces_added, 0U);
    const std::vector<double> euclidean = ExactGeodesics(shapes::intrinsic(mesh)).solve(5).distances();
    EXPECT_LT(largest_error(distances(surface, embedding, 5), [&](std::size_t v) { return euclidean[v]; }), 1e-12);
  }
}

TEST(EmbeddedDistance, OnASphereIsTheArcAtAnyGamma) {
  for (const auto& [level, bound] : {std::pair(3, 4e-3), {4, 1e-3}, {5, 2.5e-4}}) {
    const Surface surface = shapes::icosphere(level).surface();
    const Curvature curvature = principal_curvatures(surface);
    for (const Follow follow : {Follow::kMin, Follow::kMax}) {
      const std::vector<double> d =
          distances(surface, feature_metric(surface, curvature, follow, {.parameter = 50}), 0);
      const Vector from = surface.points()[0].normalized();
      EXPECT_LT(largest_error(d,
                              [&](std::size_t v) {
                                const Vector to = surface.points()[v].normalized();
                                return 0.5 * std::atan2(from.cross(to).norm(), from.dot(to));
                              }),
                bound)
          << "level " << level;
    }
  }
}

TEST(EmbeddedDistance, OnACylinderConvergesToThatOfItsUnrolledPlane) {
  const double r = 0.25, gamma = 1, l1 = 1 + gamma / r;
  struct Row {
    int n;
    double min, max;
  };
  for (const auto& [n, min, max] :
       {Row{32, 8e-3, 2.6e-2}, Row{64, 2e-3, 6.6e-3}, Row{128, 5e-4, 1.7e-3}, Row{256, 1.3e-4, 4.2e-4}}) {
    const int rows = n / 2;
    const Surface surface = shapes::cylinder(n, rows, r).surface();
    ASSERT_DOUBLE_EQ(surface.scale(), 1);
    const Curvature curvature = principal_curvatures(surface);
    const std::int32_t seed = rows / 2 * n;
    for (const Follow follow : {Follow::kMin, Follow::kMax}) {
      const double around = follow == Follow::kMin ? l1 : 1 / l1;
      const std::vector<double> d =
          distances(surface, feature_metric(surface, curvature, follow, {.parameter = gamma}), seed);
      const Vector& from = surface.points()[at(seed)];
      EXPECT_LT(
          largest_error(d,
                        [&](std::size_t v) {
                          const Vector& to = surface.points()[v];
                          const double du = turn(std::atan2(from.y(), from.x()), std::atan2(to.y(), to.x()));
                          return std::sqrt(around * std::pow(r * du, 2) + std::pow(to.z() - from.z(), 2) / around);
                        }),
          follow == Follow::kMin ? min : max)
          << "n = " << n;
    }
  }
}

// Geodesics on a torus of radii R and r from the point v = pi of its inner equator, after Clairaut. The metric is
// E dv^2 + G du^2. Geodesics that leave the groove where G is least have c^2 < min G, so they run on in v and never
// turn. The distance to a point beyond the groove is the least over its images under full turns, with one geodesic
// each.
struct ClairautTorus {
  double large, small, gamma;
  Follow follow;
  double groove = 0;  // w at which G(pi + w) is least

  double around_tube(double v) const {
    const double l1 = 1 + gamma * (1 / small - std::abs(std::cos(v)) / (large + small * std::cos(v)));
    return follow == Follow::kMin ? l1 : 1 / l1;
  }
  double g(double w) const {
    const double v = std::numbers::pi + w;
    return std::pow(large + small * std::cos(v), 2) / around_tube(v);
  }

  void find_groove() {
    for (int i = 0; i < 100'000; ++i) {
      const double w = std::numbers::pi * i / 100'000;
      if (g(w) < g(groove)) groove = w;
    }
  }

  // u and length between pi + w0 and pi + w1, on one side of the groove, along the geodesic with Clairaut's constant
  // c^2 = (1 - delta) min G.
  Eigen::Vector2d shoot(double w0, double w1, double delta) const {
    const double c2 = (1 - delta) * g(groove), root = std::sqrt(delta), side = w1 > groove ? 1 : -1;
    // The integrand is like 1 / sqrt(delta + x^2), x away from the groove: smooth in y, x = sqrt(delta) sinh y.
    const double first = std::asinh(side * (w0 - groove) / root), last = std::asinh(side * (w1 - groove) / root);
    const int n = 400;
    Eigen::Vector2d sum(0, 0);
    for (int i = 0; i < n; ++i) {
      const double y = first + (last - first) * (i + 0.5) / n, w = groove + side * root * std::sinh(y);
      const double e = around_tube(std::numbers::pi + w) * small * small, gap = std::sqrt(g(w) - c2);
      sum += std::abs(last - first) / n * root * std::cosh(y) / gap *
             Eigen::Vector2d(std::sqrt(c2 * e / g(w)), std::sqrt(e * g(w)));
    }
    return sum;
  }

  // For du and w within half a turn; the other images are farther, as the length grows with both.
  double distance(double du, double w) const {
    const auto along = [&](double delta) { return Eigen::Vector2d(shoot(0, groove, delta) + shoot(groove, w, delta)); };
    double low = 1e-13, high = 1;  // delta: u falls with it
    for (int i = 0; i < 50; ++i) {
      const double middle = std::sqrt(low * high);
      (along(middle).x() > du ? low : high) = middle;
    }
    return along(high).y();
  }
};

TEST(EmbeddedDistance, OnATorusConvergesToClairautsIntegral) {
  for (const Follow follow : {Follow::kMin, Follow::kMax}) {
    ClairautTorus exact{.large = 0.35, .small = 0.15, .gamma = 0.3, .follow = follow};
    exact.find_groove();
    ASSERT_LT(exact.groove, 0.9 * std::numbers::pi / 5);
    struct Target {
      int i, j;  // in fortieths of a turn of u, twentieths of one of v
      double distance;
    };
    std::vector<Target> targets;
    for (int j = 2; j <= 10; j += 2) {
      for (int i = 1; i <= 20; i += 3) {
        targets.push_back({i, j, exact.distance(i * std::numbers::pi / 20, j * std::numbers::pi / 10)});
      }
    }
    for (const auto& [n, bound] : {std::pair(40, 6e-3), {80, 1.5e-3}, {160, 4e-4}}) {
      const Surface surface = shapes::torus(n, n / 2).surface();
      ASSERT_DOUBLE_EQ(surface.scale(), 1);
      const Metric metric = feature_metric(surface, principal_curvatures(surface), follow, {.parameter = exact.gamma});
      const std::vector<double> d = distances(surface, metric, n / 4 * n);
      double sum = 0;
      for (const Target& t : targets) {
        const int row = (n / 4 + t.j * n / 40) % (n / 2), column = t.i * n / 40;
        sum += std::abs(d[at(row * n + column)] - t.distance) / t.distance;
      }
      // M_max stretches the chords of the tube more; on the cylinder, too, it is off by three times as much.
      const double factor = follow == Follow::kMin ? 1 : 3;
      EXPECT_LT(sum / static_cast<double>(targets.size()), factor * bound) << "n = " << n;
    }
  }
}

// Shortest paths over a surface with m points on each edge, joined within each face by straight lines, whose length is
// that of the ambient norm interpolated along the edges. The embedding is no part of this.
std::vector<double> steiner_distances(const Surface& surface, const Metric& metric, int m, std::int32_t seed) {
  struct Node {
    Vector point;
    Eigen::Matrix3d form;
  };
  std::vector<Node> nodes;
  for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
    const Eigen::Matrix3d& tensor = metric.tensors[v];
    nodes.push_back(
        {surface.points()[v], tensor + normal_weight(tensor) * metric.normals[v] * metric.normals[v].transpose()});
  }
  std::map<Edge, std::vector<std::size_t>> on_edge;
  for (const Edge& edge : surface.edges()) {
    std::vector<std::size_t>& list = on_edge[edge];
    list.push_back(at(edge[0]));
    for (int i = 1; i <= m; ++i) {
      const double t = double(i) / (m + 1);
      const Node &a = nodes[at(edge[0])], &b = nodes[at(edge[1])];
      list.push_back(nodes.size());
      nodes.push_back({(1 - t) * a.point + t * b.point, (1 - t) * a.form + t * b.form});
    }
    list.push_back(at(edge[1]));
  }
  std::vector<std::vector<std::pair<std::size_t, double>>> links(nodes.size());
  const auto join = [&](std::size_t a, std::size_t b) {
    const Vector e = nodes[b].point - nodes[a].point;
    const double length = integrated_length(std::sqrt(e.dot(nodes[a].form * e)), std::sqrt(e.dot(nodes[b].form * e)));
    links[a].emplace_back(b, length);
    links[b].emplace_back(a, length);
  };
  for (const auto& [edge, list] : on_edge) {
    for (std::size_t i = 1; i < list.size(); ++i) join(list[i - 1], list[i]);
  }
  for (const auto& [a, b, c] : surface.triangles()) {
    const std::array sides{Edge{std::min(a, b), std::max(a, b)}, Edge{std::min(b, c), std::max(b, c)},
                           Edge{std::min(c, a), std::max(c, a)}};
    for (std::size_t i = 0; i < 3; ++i) {
      for (const std::size_t p : on_edge[sides[i]]) {
        for (const std::size_t q : on_edge[sides[(i + 1) % 3]]) {
          if (p != q) join(p, q);
        }
      }
    }
  }
  std::vector<double> result(nodes.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  result[at(seed)] = 0;
  queue.emplace(0, at(seed));
  while (!queue.empty()) {
    const auto [distance, node] = queue.top();
    queue.pop();
    if (distance > result[node]) continue;
    for (const auto& [to, length] : links[node]) {
      if (distance + length >= result[to]) continue;
      result[to] = distance + length;
      queue.emplace(result[to], to);
    }
  }
  result.resize(surface.vertex_count());
  return result;
}

TEST(EmbeddedDistance, IsWhatPathsOverPointsOnTheEdgesFallTowards) {
  const Surface surface = shapes::torus(48, 24).surface();
  const Metric metric = feature_metric(surface, principal_curvatures(surface), Follow::kMin, {.max_anisotropy = 5});
  const std::vector<double> d = distances(surface, metric, 0);
  double last = 1;
  for (const auto& [m, bound] : {std::pair(3, 1.7e-2), {6, 6e-3}, {12, 1e-3}}) {
    const std::vector<double> steiner = steiner_distances(surface, metric, m, 0);
    double above = 0;
    for (std::size_t v = 1; v < d.size(); ++v) above += (steiner[v] - d[v]) / d[v];
    above /= static_cast<double>(d.size() - 1);
    EXPECT_LT(above, bound) << m;
    EXPECT_LT(above, last) << m;
    // They fall towards the distance of another interpolation of the norm, which differs by the order of h^2.
    EXPECT_GT(above, -1e-3) << m;
    last = above;
  }
}

TEST(EmbeddedDistance, IsExactOnTheEmbeddedLengths) {
  const Surface surface = shapes::bumpy(shapes::icosphere(2), 0.05).surface();
  const Curvature curvature = principal_curvatures(surface);
  const Strength strength{.max_anisotropy = 20};
  std::size_t added = 0;
  for (const Metric& metric : {feature_metric(surface, curvature, Follow::kMin, strength),
                               feature_metric(surface, curvature, Follow::kMax, strength),
                               campen_metric(surface, curvature, Follow::kMin, {.max_anisotropy = 8}),
                               pottmann_kovacs_metric(surface, curvature, Follow::kMin, strength)}) {
    const Embedding embedding = embed(surface, metric, {.max_error = 0});
    added += embedding.faces_added;
    const ExactGeodesics solver(embedding.mesh);
    const DistanceField field = solver.solve(3);
    const std::vector<double> expected = reference::Geodesics(embedding.mesh).distances(3);
    EXPECT_LT(largest_error(field.distances(), [&](std::size_t v) { return expected[v]; }), 1e-9);
    for (std::int32_t v = 0; v < embedding.mesh.vertex_count; ++v) {
      const double distance = field.distances()[at(v)];
      EXPECT_NEAR(field.trace(v)->length, distance, 1e-9 * distance);
    }
  }
  EXPECT_GT(added, 200U);
}

TEST(EmbeddedDistance, DoesNotDependOnTheScaleOfTheInput) {
  const Mesh mesh = shapes::bumpy(shapes::torus(32, 16), 0.03);
  const auto along = [](const Mesh& scaled) {
    const Surface surface = scaled.surface();
    const Metric metric = feature_metric(surface, principal_curvatures(surface), Follow::kMax, {.max_anisotropy = 10});
    const Embedding embedding = embed(surface, metric, {.max_error = 0});
    EXPECT_GT(embedding.faces_added, 100U);
    return distances(surface, embedding, 7);
  };
  const std::vector<double> expected = along(mesh);
  for (const double scale : {1e-3, 0.3, 7.0, 1e5}) {
    Mesh scaled = mesh;
    for (Vector& p : scaled.points) p *= scale;
    EXPECT_LT(largest_error(along(scaled), [&](std::size_t v) { return scale * expected[v]; }), 1e-12) << scale;
  }
}

TEST(EmbeddedDistance, GoesStraightOverFacesWithoutAnArea) {
  // A jittered grid with an additional vertex on an edge, for one of the edge's two faces only, and another one at the
  // place of a vertex. Distances are those of the plane.
  Mesh mesh = shapes::grid(8, 0.3);
  std::vector<Triangle> triangles;
  const std::int32_t on_edge = static_cast<std::int32_t>(mesh.points.size()), twin = on_edge + 1;
  // The first face of cell (3, 3) has corners 30, 31, 40; its diagonal 30-40 gets the new vertex.
  mesh.points.push_back((mesh.points[30] + mesh.points[40]) / 2);
  std::erase(mesh.triangles, Triangle{30, 31, 40});
  for (const Triangle& t : {Triangle{30, 31, on_edge}, Triangle{31, 40, on_edge}, Triangle{30, on_edge, 40}}) {
    mesh.triangles.push_back(t);
  }
  // Vertex 20 is one for its faces below and right of it, and another one for those above and left.
  mesh.points.push_back(mesh.points[20]);
  for (Triangle& t : mesh.triangles) {
    for (std::int32_t& v : t) {
      if (v == 20 && std::ranges::count(t, 30) + std::ranges::count(t, 29) + std::ranges::count(t, 19) > 0) v = twin;
    }
  }
  std::vector<std::int32_t> rim;
  for (const Triangle& t : mesh.triangles) {
    if (std::ranges::count(t, twin) > 0) rim.insert(rim.end(), t.begin(), t.end());
  }
  // The two fans part along the two edges that have one vertex of each: close the gaps.
  std::set<std::int32_t> shared;
  for (const Triangle& t : mesh.triangles) {
    if (std::ranges::count(t, 20) == 0) continue;
    for (const std::int32_t v : t) {
      if (v != 20 && std::ranges::count(rim, v) > 0) shared.insert(v);
    }
  }
  ASSERT_EQ(shared.size(), 2U);
  for (const std::int32_t v : shared) mesh.triangles.push_back({20, twin, v});
  const Surface surface = mesh.surface();
  ASSERT_EQ(surface.report().zero_area_faces.size(), 3U);
  ASSERT_EQ(surface.report().boundary_edges, 32U);
  const Embedding embedding = embed(surface, plane_metric(surface, 1, 1, 0), {.max_error = 0});
  EXPECT_EQ(embedding.invalid_before, 3U);
  EXPECT_EQ(embedding.invalid_left, 0U);
  for (const std::int32_t seed : {0, 10, 20, twin, on_edge, 44}) {
    const std::vector<double> d = distances(surface, embedding, seed);
    for (std::size_t v = 0; v < d.size(); ++v) {
      EXPECT_NEAR(d[v], (surface.points()[v] - surface.points()[at(seed)]).norm(), 1e-12);
    }
  }
}

TEST(EmbeddedDistance, IsFiniteOverHoles) {
  const Surface surface = shapes::grid(12).surface();
  const Metric metric = random_metric(surface, 10, 3);
  for (const std::size_t cap : {0, 40}) {
    const Embedding embedding = embed(surface, metric, {.max_faces_added = cap, .max_error = 0});
    ASSERT_GT(embedding.invalid_left, 0U);
    for (const double d : distances(surface, embedding, 0)) EXPECT_TRUE(std::isfinite(d));
  }
}

// A plane of triangles that are all `aspect` times as long as high, turned in space.
Mesh thin_plane(double aspect) {
  Mesh mesh = shapes::grid(14, 0.3, 5);
  const Eigen::AngleAxisd turned(0.7, Vector(1, 2, 3).normalized());
  for (Vector& p : mesh.points) p = turned * Vector(p.x(), p.y() / aspect, 0.0);
  return mesh;
}

// A plane where every triangle is split at a point so near to its first side that a cap results.
Mesh capped_plane(double aspect) {
  Mesh mesh = shapes::grid(5, 0.2, 3);
  std::vector<Triangle> split;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto at = [&](std::int32_t v) { return mesh.points[static_cast<std::size_t>(v)]; };
    const auto d = static_cast<std::int32_t>(mesh.points.size());
    const Vector foot = 0.37 * at(a) + 0.63 * at(b);
    mesh.points.push_back(foot + (at(c) - foot) / aspect);
    split.insert(split.end(), {{a, b, d}, {b, c, d}, {c, a, d}});
  }
  mesh.triangles = split;
  return mesh;
}

// Needles around a vertex, the others fat.
Mesh needle_fan(double aspect) {
  Mesh mesh;
  mesh.points.emplace_back(0, 0, 0);
  for (int i = 0; i < 30; ++i) mesh.points.emplace_back(std::cos(i / aspect), std::sin(i / aspect), 0);
  for (int i = 1; i < 12; ++i) {
    const double angle = std::numbers::pi * i / 6;
    mesh.points.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  const auto rim = static_cast<std::int32_t>(mesh.points.size()) - 1;
  for (std::int32_t i = 0; i < rim; ++i) mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % rim});
  return mesh;
}

TEST(EmbeddedDistance, OnAPlaneOfSliversIsTheStraightLine) {
  for (const double aspect : {1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8}) {
    for (const Mesh& mesh : {thin_plane(aspect), capped_plane(aspect), needle_fan(aspect)}) {
      const Surface surface = mesh.surface();
      const Embedding embedding =
          embed(surface, euclidean_metric(surface, principal_curvatures(surface)), {.max_error = 0});
      EXPECT_EQ(embedding.clamped_edges, 0U);
      EXPECT_EQ(embedding.invalid_left, 0U);
      for (const std::int32_t seed : {0, 40}) {
        const Vector& from = surface.points()[static_cast<std::size_t>(seed)];
        const auto straight = [&](std::size_t v) { return (surface.points()[v] - from).norm(); };
        const DistanceField field = ExactGeodesics(embedding.mesh).solve(seed);
        std::vector<double> lengths, distances(field.distances());
        distances.resize(surface.vertex_count());
        for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
          lengths.push_back(field.trace(static_cast<std::int32_t>(v))->length);
        }
        EXPECT_LT(largest_error(distances, straight), 1e-6) << aspect << ", " << mesh.triangles.size() << " triangles";
        EXPECT_LT(largest_error(lengths, straight), 1e-6) << aspect << ", " << mesh.triangles.size() << " triangles";
      }
    }
  }
}

}  // namespace
}  // namespace seamwire
