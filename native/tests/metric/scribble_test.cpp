// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/metric/scribble.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/wires/wire.hpp"
#include "shapes.hpp"

namespace seamwire {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

Metric flat_metric(const Surface& surface) { return euclidean_metric(surface, principal_curvatures(surface)); }

// A stroke through points of a surface in the plane z = 0, each in the triangle it lies in.
Scribble stroke_on_plane(const Surface& surface, const std::vector<Vector>& points) {
  Scribble scribble;
  scribble.points = points;
  for (const Vector& p : points) {
    std::int32_t best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < surface.face_count(); ++f) {
      const Triangle& t = surface.triangles()[f];
      double outside = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vector &a = surface.points()[at(t[i])], &b = surface.points()[at(t[(i + 1) % 3])];
        outside = std::max(outside, -(b - a).cross(p - a).z() / (b - a).norm());
      }
      if (outside < least) least = outside, best = static_cast<std::int32_t>(f);
    }
    scribble.faces.push_back(best);
  }
  return scribble;
}

std::vector<Vector> arc(const Vector& center, double radius, double from, double to, int count) {
  std::vector<Vector> points;
  for (int i = 0; i <= count; ++i) {
    const double a = from + (to - from) * i / count;
    points.emplace_back(center + radius * Vector(std::cos(a), std::sin(a), 0));
  }
  return points;
}

Wire wire_in(const Surface& surface, const Metric& metric, std::int32_t from, std::int32_t to) {
  const Embedding embedding = embed(surface, metric, {.max_error = 0});
  return trace_wire(surface, embedding, ExactGeodesics(embedding.mesh).solve(from), to).value();
}

// How far a wire leaves a curve, given by the distance to it.
template <class Distance>
double furthest(const Wire& wire, const Distance& distance) {
  double most = 0;
  for (std::size_t i = 0; i + 1 < wire.points.size(); ++i) {
    for (int j = 0; j <= 8; ++j) {
      most = std::max(most, distance(Vector(wire.points[i] + j / 8.0 * (wire.points[i + 1] - wire.points[i]))));
    }
  }
  return most;
}

std::vector<Vector> line(const Vector& from, const Vector& to, int count) {
  std::vector<Vector> points;
  for (int i = 0; i <= count; ++i) points.emplace_back(from + i / double(count) * (to - from));
  return points;
}

// Rings of vertices around the given ones, found by sweeps over the triangles.
std::vector<int> rings(const Surface& surface, const std::vector<bool>& first) {
  std::vector<int> ring(surface.vertex_count(), 1'000'000);
  for (std::size_t v = 0; v < ring.size(); ++v) {
    if (first[v]) ring[v] = 0;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const Triangle& t : surface.triangles()) {
      for (const std::int32_t a : t) {
        for (const std::int32_t b : t) {
          if (ring[at(a)] > ring[at(b)] + 1) ring[at(a)] = ring[at(b)] + 1, changed = true;
        }
      }
    }
  }
  return ring;
}

Eigen::Matrix3d drawn_tensor(double eta, const Vector& along, const Vector& normal) {
  const Vector across = normal.cross(along);
  return along * along.transpose() / eta + eta * across * across.transpose();
}

// Symmetric, positive in the tangent plane, zero along the normal, and no more anisotropic than eta.
void expect_sound(const Metric& metric, double eta) {
  for (std::size_t v = 0; v < metric.size(); ++v) {
    const Eigen::Matrix3d& m = metric.tensors[v];
    ASSERT_TRUE(m.allFinite()) << v;
    ASSERT_LE((m - m.transpose()).norm(), 1e-12 * eta) << v;
    if (metric.normals[v].isZero(0)) continue;
    ASSERT_LE((m * metric.normals[v]).norm(), 1e-12 * eta) << v;
    ASSERT_LE(anisotropy({metric.normals[v], m}), eta * (1 + 1e-9)) << v;
  }
}

const Vector kUp = Vector::UnitZ();

TEST(Scribble, AHalfCircleOnAFlatGridIsFollowed) {
  const int n = 60;
  for (const double jitter : {0.0, 0.15}) {
    const Surface surface = shapes::grid(n, jitter).surface();
    const Metric flat = flat_metric(surface);
    for (const int radius : {8, 12, 20, 27}) {
      const double h = 1.0 / n;
      const Vector center(30 * h, 20 * h, 0);
      const Scribble scribble = stroke_on_plane(surface, arc(center, radius * h, std::numbers::pi, 0, 120));
      const std::int32_t from = 20 * (n + 1) + 30 - radius, to = from + 2 * radius;
      const auto off = [&](const Vector& p) { return std::abs((p - center).norm() - radius * h) / h; };
      EXPECT_GT(furthest(wire_in(surface, flat, from, to), off), 5);
      const Wire wire = wire_in(surface, apply_scribbles(surface, flat, {{scribble}}), from, to);
      EXPECT_LE(furthest(wire, off), 0.3) << "radius " << radius << ", jitter " << jitter;
    }
  }
}

TEST(Scribble, APartOfTheLineIsEnough) {
  const int n = 60;
  const Surface surface = shapes::grid(n).surface();
  const Metric flat = flat_metric(surface);
  const double h = 1.0 / n;
  const Vector center(30 * h, 20 * h, 0);
  // A tenth of the half circle is missing at either end.
  const Scribble scribble =
      stroke_on_plane(surface, arc(center, 12 * h, 0.9 * std::numbers::pi, 0.1 * std::numbers::pi, 80));
  const std::int32_t from = 20 * (n + 1) + 18;
  const Wire wire = wire_in(surface, apply_scribbles(surface, flat, {{scribble}}), from, from + 24);
  EXPECT_LE(furthest(wire, [&](const Vector& p) { return std::abs((p - center).norm() - 12 * h) / h; }), 1);
}

TEST(Scribble, WiresCrossARepellingLineAndDoNotFollowIt) {
  const int n = 40;
  const Surface surface = shapes::grid(n).surface();
  const Metric flat = flat_metric(surface);
  const double h = 1.0 / n;
  Scribble scribble = stroke_on_plane(surface, line(Vector(0.2, 0.5 + 0.3 * h, 0), Vector(0.8, 0.5 + 0.3 * h, 0), 50));
  scribble.attracts = false;
  const Metric repelling = apply_scribbles(surface, flat, {{scribble}});
  const auto id = [&](int i, int j) { return j * (n + 1) + i; };
  const auto height = [&](const Vector& p) { return std::abs(p.y() - 0.5) / h; };
  EXPECT_LE(furthest(wire_in(surface, flat, id(8, 20), id(32, 20)), height), 1e-9);
  EXPECT_GT(furthest(wire_in(surface, repelling, id(8, 20), id(32, 20)), height), 5);
  const double across = wire_in(surface, repelling, id(20, 10), id(20, 30)).length;
  EXPECT_LT(across, 0.7 * wire_in(surface, flat, id(20, 10), id(20, 30)).length);
}

TEST(Scribble, BlendsRingByRingWithTheMetricAsItWas) {
  const int n = 30;
  const Surface surface = shapes::grid(n).surface();
  const Metric flat = flat_metric(surface);
  const double h = 1.0 / n;
  const Vector direction = Vector(2, 1, 0).normalized();
  Scribble scribble = stroke_on_plane(surface, line(Vector(0.2, 0.3, 0), Vector(0.2, 0.3, 0) + 0.5 * direction, 33));
  for (const int k : {1, 4, 10}) {
    scribble.rings = k;
    scribble.eta = 12;
    const Metric metric = apply_scribbles(surface, flat, {{scribble}});
    EXPECT_EQ(metric.normals, flat.normals);
    const Eigen::Matrix3d drawn = drawn_tensor(12, direction, kUp);
    std::vector<bool> first(surface.vertex_count());
    for (std::size_t v = 0; v < first.size(); ++v) first[v] = (metric.tensors[v] - drawn).norm() < 1e-9;
    // The stroke is fifteen edges long and crosses about 1.5 edges in each.
    EXPECT_GT(std::ranges::count(first, true), 20);
    EXPECT_LT(std::ranges::count(first, true), 60);
    const std::vector<int> ring = rings(surface, first);
    for (std::size_t v = 0; v < first.size(); ++v) {
      if (ring[v] >= k) {
        ASSERT_EQ(metric.tensors[v], flat.tensors[v]) << v;
      } else {
        const double weight = 1 - double(ring[v]) / k;
        const Eigen::Matrix3d expected = weight * drawn + (1 - weight) * flat.tensors[v];
        ASSERT_NEAR((metric.tensors[v] - expected).norm(), 0, 1e-9) << v << " in ring " << ring[v];
      }
    }
    for (std::size_t v = 0; v < first.size(); ++v) {
      if (!first[v]) continue;
      const Vector e = surface.points()[v] - Vector(0.2, 0.3, 0);
      EXPECT_LE(std::abs(e.cross(direction).z()), 1.5 * h);
    }
  }
}

TEST(Scribble, WithARadiusTheDensityOfTheMeshDoesNotMatter) {
  std::vector<Metric> metrics;
  for (const int n : {20, 40}) {
    const Surface surface = shapes::grid(n).surface();
    Scribble scribble = stroke_on_plane(surface, line(Vector(0.21, 0.5, 0), Vector(0.79, 0.5, 0), 60));
    scribble.radius = 0.2;
    metrics.push_back(apply_scribbles(surface, flat_metric(surface), {{scribble}}));
    for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
      const double y = std::abs(surface.points()[v].y() - 0.5), x = std::abs(surface.points()[v].x() - 0.5);
      const double distance = std::hypot(y, std::max(0.0, x - 0.29));
      if (x > 0.29 && y < 1.0 / n) continue;  // at the ends of the stroke, all corners of its triangles are along it
      const double weight = std::max(0.0, 1 - distance / 0.2);
      // The ring beyond the stroke's ends takes its direction from there.
      const Eigen::Matrix3d expected =
          weight * drawn_tensor(20, Vector::UnitX(), kUp) + (1 - weight) * flat_metric(surface).tensors[v];
      ASSERT_NEAR((metrics.back().tensors[v] - expected).norm(), 0, 1e-9) << v << " at " << x << ", " << y;
    }
  }
}

TEST(Scribble, ARadiusIsInTheUnitsOfTheModel) {
  shapes::Mesh mesh = shapes::grid(20);
  const Surface surface = mesh.surface();
  Scribble scribble = stroke_on_plane(surface, line(Vector(0.21, 0.5, 0), Vector(0.79, 0.5, 0), 60));
  scribble.radius = 0.17;
  const Metric metric = apply_scribbles(surface, flat_metric(surface), {{scribble}});
  for (Vector& p : mesh.points) p *= 64;  // exact in binary
  for (Vector& p : scribble.points) p *= 64;
  *scribble.radius *= 64;
  const Surface large = mesh.surface();
  const Metric of_large = apply_scribbles(large, flat_metric(large), {{scribble}});
  for (std::size_t v = 0; v < metric.size(); ++v) {
    ASSERT_NEAR((of_large.tensors[v] - metric.tensors[v]).norm(), 0, 1e-12) << v;
  }
}

TEST(Scribble, TheDirectionIsThatOfTheDrawnLineDespiteATremblingHand) {
  const Surface surface = shapes::grid(40, 0.2).surface();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> tremble(-0.1 / 40, 0.1 / 40);
  const Vector direction = Vector(3, 2, 0).normalized();
  std::vector<Vector> points = line(Vector(0.1, 0.1, 0), Vector(0.1, 0.1, 0) + 0.9 * direction, 400);
  for (Vector& p : points) {
    p.x() += tremble(random);
    p.y() += tremble(random);
  }
  const Metric metric = apply_scribbles(surface, flat_metric(surface), {{stroke_on_plane(surface, points)}});
  int along = 0;
  for (const Eigen::Matrix3d& m : metric.tensors) {
    if (std::abs(m.trace() - 20.05) > 1e-9) continue;
    ++along;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(m.topLeftCorner<2, 2>());
    const Eigen::Vector2d minor = eigen.eigenvectors().col(0);
    // Ends of a chord of two edges are off by a tenth of an edge each: an angle of up to 0.15.
    EXPECT_LT(std::abs(minor.x() * direction.y() - minor.y() * direction.x()), 0.15);
  }
  EXPECT_GT(along, 50);
}

TEST(Scribble, IsCarriedOverACurvedSurfaceInItsTangentPlanes) {
  const shapes::Mesh mesh = shapes::cylinder(64, 40);
  const Surface surface = mesh.surface();
  const Metric base = euclidean_metric(surface, principal_curvatures(surface));
  Scribble scribble;  // half around, along the vertices in the middle
  for (int i = 10; i <= 42; ++i) {
    scribble.vertices.push_back(20 * 64 + i);
    scribble.points.push_back(mesh.points[at(20 * 64 + i)]);
  }
  const Metric metric = apply_scribbles(surface, base, {{scribble}});
  expect_sound(metric, 20);
  for (int row = 20; row < 30; ++row) {
    // All triangles have a diagonal that leans to one side; away from the stroke's ends its direction is the only one.
    for (int i = 22; i <= 32; ++i) {
      const std::size_t v = at(row * 64 + i);
      const Vector& n = metric.normals[v];
      const double weight = 1 - (row - 20) / 10.0;
      const Eigen::Matrix3d expected =
          weight * drawn_tensor(20, kUp.cross(n).normalized(), n) + (1 - weight) * base.tensors[v];
      EXPECT_NEAR((metric.tensors[v] - expected).norm(), 0, 1e-6) << "row " << row << ", column " << i;
    }
  }
}

TEST(Scribble, IsTurnedByTheLeastRotationFromNormalToNormal) {
  // On a coarse cylinder, where projecting onto the next tangent plane would be another thing. Turned from normal to
  // normal, a direction keeps its angle to the axis, whichever way it is carried.
  const int n = 12, rows = 24;
  const shapes::Mesh mesh = shapes::cylinder(n, rows);
  const Surface surface = mesh.surface();
  const Metric base = euclidean_metric(surface, principal_curvatures(surface));
  Scribble scribble;  // a helix; around it all is as it is one step further up
  for (int i = 0; i <= 16; ++i) {
    scribble.vertices.push_back((4 + i) * n + i % n);
    scribble.points.push_back(mesh.points[at(scribble.vertices.back())]);
  }
  scribble.rings = 4;
  const Metric metric = apply_scribbles(surface, base, {{scribble}});
  const auto angle_to_axis = [&](std::int32_t v) {
    const Vector& normal = metric.normals[at(v)];
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(metric.tensors[at(v)] +
                                                               100 * normal * normal.transpose());
    const Vector along = eigen.eigenvectors().col(0);
    return std::atan(along.dot(kUp.cross(normal)) / along.z());
  };
  const int middle = 12;  // the row where the stroke is half way
  const double drawn = angle_to_axis(middle * n + middle - 4);
  EXPECT_GT(std::abs(drawn), 0.3);
  int carried = 0;
  for (int aside = -3; aside <= 3; ++aside) {
    const std::int32_t v = middle * n + (middle - 4 + aside + n) % n;
    if (metric.tensors[at(v)].isApprox(base.tensors[at(v)])) continue;
    ++carried;
    EXPECT_NEAR(angle_to_axis(v), drawn, 1e-9) << aside << " columns aside";
  }
  EXPECT_GE(carried, 5);
}

TEST(Scribble, OfTwoThatCrossTheLaterWinsAlongItsLine) {
  const Surface surface = shapes::grid(30).surface();
  const Metric flat = flat_metric(surface);
  const Scribble first = stroke_on_plane(surface, line(Vector(0.2, 0.51, 0), Vector(0.8, 0.51, 0), 40));
  const Scribble second = stroke_on_plane(surface, line(Vector(0.51, 0.2, 0), Vector(0.51, 0.8, 0), 40));
  const Metric one_two = apply_scribbles(surface, flat, {{first, second}});
  const Metric two_one = apply_scribbles(surface, flat, {{second, first}});
  const Metric one = apply_scribbles(surface, flat, {{first}}), two = apply_scribbles(surface, flat, {{second}});
  int along_both = 0;
  for (std::size_t v = 0; v < flat.size(); ++v) {
    const bool along_one = std::abs(one.tensors[v].trace() - 20.05) < 1e-9;
    const bool along_two = std::abs(two.tensors[v].trace() - 20.05) < 1e-9;
    if (along_two) {
      EXPECT_EQ(one_two.tensors[v], two.tensors[v]) << v;
    }
    if (along_one) {
      EXPECT_EQ(two_one.tensors[v], one.tensors[v]) << v;
    }
    along_both += along_one && along_two;
  }
  EXPECT_GT(along_both, 0);
}

TEST(Scribble, TheListAloneDecides) {
  const shapes::Mesh mesh = shapes::torus(40, 24);
  const Surface surface = mesh.surface();
  const Curvature curvature = principal_curvatures(surface);
  const Metric base = feature_metric(surface, curvature, Follow::kMin, {.max_anisotropy = 10});
  std::vector<Scribble> scribbles(3);
  for (int s = 0; s < 3; ++s) {
    for (int i = 0; i < 12; ++i) {
      const std::int32_t v = (5 * s + i) % 24 * 40 + (3 + 2 * i) % 40;
      scribbles[at(s)].vertices.push_back(v);
      scribbles[at(s)].points.push_back(mesh.points[at(v)]);
    }
  }
  scribbles[1].attracts = false;
  EXPECT_EQ(apply_scribbles(surface, base, {}).tensors, base.tensors);
  const Metric all = apply_scribbles(surface, base, scribbles);
  expect_sound(all, 20);
  EXPECT_NE(all.tensors, base.tensors);
  EXPECT_EQ(apply_scribbles(surface, base, scribbles).tensors, all.tensors);
  // One at a time is all at once.
  Metric step = base;
  for (const Scribble& scribble : scribbles) step = apply_scribbles(surface, step, {{scribble}});
  EXPECT_EQ(step.tensors, all.tensors);
  // A scribble removed from the list leaves no trace, bit for bit. Scribbles in another order make another metric.
  const std::vector<Scribble> without{scribbles[0], scribbles[2]}, reordered{scribbles[2], scribbles[0], scribbles[1]};
  const Metric two = apply_scribbles(surface, apply_scribbles(surface, base, {{scribbles[0]}}), {{scribbles[2]}});
  scribbles.erase(scribbles.begin() + 1);
  EXPECT_EQ(apply_scribbles(surface, base, scribbles).tensors, two.tensors);
  EXPECT_EQ(scribbles, without);
  EXPECT_NE(apply_scribbles(surface, base, reordered).tensors, all.tensors);
  EXPECT_EQ(apply_scribbles(surface, base, reordered).tensors,
            apply_scribbles(surface, apply_scribbles(surface, base, {{reordered[0], reordered[1]}}), {{reordered[2]}})
                .tensors);
  scribbles.clear();
  const Metric back = apply_scribbles(surface, base, scribbles);
  EXPECT_EQ(back.tensors, base.tensors);
  EXPECT_EQ(back.normals, base.normals);
}

TEST(Scribble, ActsOnTheMetricsItIsMeantFor) {
  const Surface surface = shapes::grid(20).surface();
  const Metric flat = flat_metric(surface);
  Scribble scribble = stroke_on_plane(surface, line(Vector(0.2, 0.51, 0), Vector(0.8, 0.51, 0), 40));
  scribble.acts_on = MetricKind::kMin;
  const Metric changed = apply_scribbles(surface, flat, {{scribble}});
  EXPECT_NE(changed.tensors, flat.tensors);
  EXPECT_EQ(apply_scribbles(surface, flat, {{scribble}}, MetricKind::kMin).tensors, changed.tensors);
  EXPECT_EQ(apply_scribbles(surface, flat, {{scribble}}, MetricKind::kMax).tensors, flat.tensors);
  EXPECT_EQ(apply_scribbles(surface, flat, {{scribble}}, MetricKind::kConcave).tensors, flat.tensors);
  scribble.acts_on = std::nullopt;
  for (const MetricKind kind : {MetricKind::kMin, MetricKind::kMax, MetricKind::kConcave}) {
    EXPECT_EQ(apply_scribbles(surface, flat, {{scribble}}, kind).tensors, changed.tensors);
  }
}

TEST(Scribble, WithoutMovementChangesNothing) {
  const Surface surface = shapes::grid(10).surface();
  const Metric flat = flat_metric(surface);
  const Scribble none, point = stroke_on_plane(surface, {Vector(0.51, 0.52, 0)}),
                       rest = stroke_on_plane(surface, std::vector<Vector>(50, Vector(0.51, 0.52, 0)));
  EXPECT_EQ(apply_scribbles(surface, flat, {{none, point, rest}}).tensors, flat.tensors);
}

TEST(Scribble, AClosedOneHasTheSameDirectionsWhereverItBegins) {
  const Surface surface = shapes::grid(40).surface();
  const Metric flat = flat_metric(surface);
  std::vector<Vector> circle = arc(Vector(0.5, 0.5, 0), 0.303, 0.2, 0.2 + 2 * std::numbers::pi, 90);
  circle.back() = circle.front();
  const Metric metric = apply_scribbles(surface, flat, {{stroke_on_plane(surface, circle)}});
  std::rotate(circle.begin(), circle.begin() + 37, circle.end() - 1);
  circle.back() = circle.front();
  const Metric turned = apply_scribbles(surface, flat, {{stroke_on_plane(surface, circle)}});
  for (std::size_t v = 0; v < flat.size(); ++v) ASSERT_NEAR((metric.tensors[v] - turned.tensors[v]).norm(), 0, 1e-9);
  // So wires run around it, across the place where it begins and ends as elsewhere.
  const Wire wire = wire_in(surface, metric, 12 * 41 + 29, 28 * 41 + 29);
  EXPECT_LE(furthest(wire, [&](const Vector& p) { return std::abs((p - Vector(0.5, 0.5, 0)).norm() - 0.303) * 40; }),
            1);
}

TEST(Scribble, IsDefinedOnWhateverIsDrawnAndLosesNothing) {
  const Surface surface = shapes::grid(24, 0.2).surface();
  const Metric flat = flat_metric(surface);
  const auto expect_fine = [&](const Scribble& scribble, const std::string& what) {
    SCOPED_TRACE(what);
    const Metric metric = apply_scribbles(surface, flat, {{scribble}});
    EXPECT_NE(metric.tensors, flat.tensors);
    expect_sound(metric, 20);
    const Embedding embedding = embed(surface, metric, {.max_error = 0});
    EXPECT_EQ(embedding.invalid_left, 0U);
    EXPECT_TRUE(embedding.unreachable.empty());
  };
  std::vector<Vector> eight;
  for (int i = 0; i <= 200; ++i) {
    const double t = 2 * std::numbers::pi * i / 200;
    eight.emplace_back(0.5 + 0.35 * std::sin(t), 0.5 + 0.3 * std::sin(2 * t), 0);
  }
  expect_fine(stroke_on_plane(surface, eight), "crossing itself");
  expect_fine(stroke_on_plane(surface, line(Vector(0, 0, 0), Vector(1, 0, 0), 50)), "along the boundary");
  expect_fine(stroke_on_plane(surface, line(Vector(0, 0, 0), Vector(1, 1, 0), 1)), "two points far apart");
  std::vector<Vector> back = line(Vector(0.1, 0.4, 0), Vector(0.9, 0.4, 0), 30);
  back.insert(back.end(), back.rbegin(), back.rend());
  expect_fine(stroke_on_plane(surface, back), "there and back");
  // A hand that wanders about: ten thousand points.
  std::mt19937 random(7);
  std::normal_distribution<double> step(0, 0.004);
  std::vector<Vector> walk{Vector(0.5, 0.5, 0)};
  while (walk.size() < 10'000) {
    const double dx = step(random), dy = step(random);
    const Vector p = walk.back() + Vector(dx, dy, 0);
    walk.emplace_back(std::clamp(p.x(), 0.0, 1.0), std::clamp(p.y(), 0.0, 1.0), 0);
  }
  expect_fine(stroke_on_plane(surface, walk), "ten thousand points");
}

TEST(Scribble, RunsOverAnEdgeOfThreeFaces) {
  // Three leaves that meet in the edges from (0, 0, 0) to (0, 1, 0).
  shapes::Mesh mesh;
  const int n = 12;
  for (int leaf = 0; leaf < 3; ++leaf) {
    const double a = 2 * std::numbers::pi * leaf / 3;
    shapes::Mesh part = shapes::grid(n);
    const auto offset = static_cast<std::int32_t>(mesh.points.size());
    for (const Vector& p : part.points) mesh.points.emplace_back(p.x() * std::cos(a), p.y(), p.x() * std::sin(a));
    for (const Triangle& t : part.triangles) {
      Triangle joined = t;
      for (std::int32_t& v : joined) v = v % (n + 1) == 0 ? v : v + offset;
      mesh.triangles.push_back(joined);
    }
  }
  const Surface surface = mesh.surface();
  ASSERT_EQ(surface.report().nonmanifold_edges.size(), at(n));
  const Metric base = euclidean_metric(surface, principal_curvatures(surface));
  Scribble scribble;  // from the first leaf onto the second
  const std::int32_t row = 6 * (n + 1), second = (n + 1) * (n + 1);
  for (int i = 8; i >= 0; --i) scribble.vertices.push_back(row + i);
  for (int i = 1; i <= 8; ++i) scribble.vertices.push_back(second + row + i);
  for (const std::int32_t v : scribble.vertices) scribble.points.push_back(surface.points()[at(v)]);
  const Metric metric = apply_scribbles(surface, base, {{scribble}});
  expect_sound(metric, 20);
  for (const std::int32_t v : {row + 4, second + row + 4}) {
    EXPECT_NEAR(anisotropy({metric.normals[at(v)], metric.tensors[at(v)]}), 20, 1e-9);
  }
  EXPECT_TRUE(embed(surface, metric, {.max_error = 0}).unreachable.empty());
}

TEST(Scribble, HasAGapWhereItLeavesTheSurface) {
  // Two squares beside each other.
  shapes::Mesh mesh = shapes::grid(10);
  const shapes::Mesh other = shapes::grid(10);
  for (const Vector& p : other.points) mesh.points.emplace_back(p + Vector(1.5, 0, 0));
  for (const Triangle& t : other.triangles) mesh.triangles.push_back({t[0] + 121, t[1] + 121, t[2] + 121});
  const Surface surface = mesh.surface();
  const Metric flat = flat_metric(surface);
  std::vector<Vector> points = line(Vector(0.31, 0.52, 0), Vector(0.99, 0.52, 0), 20);
  for (const Vector& p : line(Vector(1.51, 0.52, 0), Vector(2.2, 0.52, 0), 20)) points.push_back(p);
  const Metric metric = apply_scribbles(surface, flat, {{stroke_on_plane(surface, points)}});
  expect_sound(metric, 20);
  for (const std::int32_t v : {5 * 11 + 7, 5 * 11 + 10, 121 + 5 * 11 + 2}) {
    EXPECT_NEAR((metric.tensors[at(v)] - drawn_tensor(20, Vector::UnitX(), kUp)).norm(), 0, 1e-9) << v;
  }
}

TEST(Scribble, SaysWhatIsWrongWithIt) {
  const Surface surface = shapes::grid(4).surface();
  const Metric flat = flat_metric(surface);
  const Scribble good = stroke_on_plane(surface, line(Vector(0.1, 0.1, 0), Vector(0.9, 0.8, 0), 9));
  const auto expect_refused = [&](const Scribble& bad, const std::string& words) {
    try {
      apply_scribbles(surface, flat, {{good, bad}});
      FAIL() << "expected: " << words;
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("scribble 1"), std::string::npos) << error.what();
    }
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Scribble bad = good;
  bad.points[3].z() = 0.2;
  expect_refused(bad, "point 3");
  bad = good;
  bad.points[4].x() = nan;
  expect_refused(bad, "point 4");
  bad = good;
  bad.faces[5] = 32;
  expect_refused(bad, "point 5 of scribble 1: face 32 is out of range: there are 32 faces");
  bad.faces[5] = -1;
  expect_refused(bad, "point 5 of scribble 1 has neither");
  bad.vertices.assign(10, -1);
  bad.vertices[5] = 25;
  expect_refused(bad, "point 5 of scribble 1: vertex 25 is out of range: there are 25 vertices");
  bad.vertices.pop_back();
  expect_refused(bad, "10 points and 9");
  for (const double eta : {0.5, nan}) {
    bad = good;
    bad.eta = eta;
    expect_refused(bad, "eta");
  }
  bad = good;
  bad.rings = 0;
  expect_refused(bad, "rings");
  bad = good;
  bad.radius = 0;
  expect_refused(bad, "radius");
  EXPECT_THROW(apply_scribbles(shapes::grid(3).surface(), flat, {}), InvalidInput);
}

}  // namespace
}  // namespace seamwire
