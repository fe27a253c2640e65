// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/geodesics/heat_geodesics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <stop_token>
#include <string>
#include <vector>

#include "geodesics/intrinsic_delaunay.hpp"
#include "geodesics/triangle_area.hpp"
#include "intrinsic.hpp"
#include "paths.hpp"
#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "shapes.hpp"

namespace seamwire {
namespace {

using paths::index;
using shapes::intrinsic;
using shapes::Mesh;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// How far distances are from others, in parts of these.
struct Errors {
  double mean = 0.0, most = 0.0;
};

Errors errors_of(const std::vector<double>& distances, const std::function<double(std::int32_t)>& expected) {
  Errors errors;
  double count = 0.0;
  for (std::int32_t v = 0; index(v) < distances.size(); ++v) {
    const double right = expected(v);
    if (!(right > 0 && right < kInfinity)) continue;
    const double error = std::abs(distances[index(v)] - right) / right;
    errors.mean += error;
    errors.most = std::max(errors.most, error);
    ++count;
  }
  errors.mean /= count;
  return errors;
}

std::int32_t nearest_vertex(const Mesh& mesh, const Vector& to) {
  const auto found = std::ranges::min_element(mesh.points, {}, [&](const Vector& p) { return (p - to).norm(); });
  return static_cast<std::int32_t>(found - mesh.points.begin());
}

/// A path from a seed to a point is one over the mesh, with the length that it says, and no shorter than the geodesic.
void expect_path(const IntrinsicMesh& mesh, const IntrinsicPath& path, double geodesic, double longest) {
  ASSERT_FALSE(path.points.empty());
  EXPECT_NEAR(paths::length_of(mesh, path), path.length, 1e-9 * path.length);
  EXPECT_GE(path.length, geodesic * (1 - 1e-9));
  EXPECT_LE(path.length, geodesic * longest);
}

TEST(HeatGeodesics, AreNearTheClosedFormOnAPlane) {
  const Mesh mesh = shapes::grid(50, 0.2);
  const std::int32_t seed = nearest_vertex(mesh, {0.3, 0.4, 0});
  const DistanceField field = HeatGeodesics(intrinsic(mesh)).solve(seed);
  const Errors errors = errors_of(
      field.distances(), [&](std::int32_t v) { return (mesh.points[index(v)] - mesh.points[index(seed)]).norm(); });
  EXPECT_LT(errors.mean, 0.02);
  EXPECT_LT(errors.most, 0.2);  // beside the seed
  EXPECT_EQ(field.distances()[index(seed)], 0.0);
  EXPECT_EQ(field.seed(), seed);
}

TEST(HeatGeodesics, AreNearTheClosedFormOnASphereAndConverge) {
  double before = kInfinity;
  for (const int level : {3, 4, 5}) {
    const Mesh mesh = shapes::icosphere(level);
    const DistanceField field = HeatGeodesics(intrinsic(mesh)).solve(0);
    const Errors errors = errors_of(field.distances(), [&](std::int32_t v) {
      const double cosine = mesh.points[index(v)].normalized().dot(mesh.points[0].normalized());
      return 0.5 * std::acos(std::clamp(cosine, -1.0, 1.0));
    });
    EXPECT_LT(errors.mean, 0.7 * before) << level;
    before = errors.mean;
  }
  EXPECT_LT(before, 0.01);
}

/// Counts triangles whose corners differ between two meshes with the same number of triangles.
std::size_t changed_triangles(const IntrinsicMesh& before, const IntrinsicMesh& after) {
  std::size_t changed = 0;
  for (std::size_t f = 0; f < before.face_count(); ++f) changed += before.triangles[f] != after.triangles[f];
  return changed;
}

TEST(HeatGeodesics, AreNearTheExactOnesOnATorus) {
  const IntrinsicMesh mesh = intrinsic(shapes::torus(80, 40));
  const DistanceField exact = ExactGeodesics(mesh).solve(5), field = HeatGeodesics(mesh).solve(5);
  const Errors errors = errors_of(field.distances(), [&](std::int32_t v) { return exact.distances()[index(v)]; });
  EXPECT_LT(errors.mean, 0.03);
  EXPECT_LT(errors.most, 0.15);
  EXPECT_TRUE(field.fits(mesh));
}

TEST(HeatGeodesics, AreNearTheNormOfAStretchedPlane) {
  const Mesh mesh = shapes::grid(60, 0.2);
  const Eigen::Matrix3d map = Vector(6, 1, 1).asDiagonal() * Eigen::Matrix3d(Eigen::AngleAxisd(0.4, Vector::UnitZ()));
  const std::int32_t seed = nearest_vertex(mesh, {0.5, 0.5, 0});
  const IntrinsicMesh stretched = intrinsic(mesh, map);
  EXPECT_GT(changed_triangles(stretched, detail::intrinsic_delaunay(stretched, {})), 1000U);
  const HeatGeodesics heat(stretched);
  const Errors errors = errors_of(heat.solve(seed).distances(), [&](std::int32_t v) {
    return (map * (mesh.points[index(v)] - mesh.points[index(seed)])).norm();
  });
  EXPECT_LT(errors.mean, 0.03);
}

TEST(HeatGeodesics, AreNearTheExactOnesInAnisotropicMetrics) {
  const Mesh mesh = shapes::torus(60, 40);
  struct Case {
    MetricSpec spec;
    double most_mean;
  };
  // The second metric is too strong for the mesh, so the embedding bisects edges, and lengths differ much.
  for (const auto& [spec, most_mean] : {Case{MetricSpec::feature(Follow::kMin, {.max_anisotropy = 10.0}), 0.04},
                                        Case{MetricSpec::feature(Follow::kMax, {.max_anisotropy = 20.0}), 0.25}}) {
    const EmbeddedSurface embedded(SurfaceContext(mesh.points, mesh.triangles), spec, {.max_error = 0});
    EXPECT_EQ(embedded.embedding().faces_added > 0, *spec.follow == Follow::kMax);
    const EmbeddedField exact = embedded.field(7);
    const EmbeddedField field = embedded.field(embedded.heat_geodesics(), std::array{SurfacePoint(7)});
    EXPECT_EQ(&embedded.heat_geodesics(), &embedded.heat_geodesics());
    const Errors errors = errors_of(field.distances().distances(),
                                    [&](std::int32_t v) { return exact.distances().distances()[index(v)]; });
    EXPECT_LT(errors.mean, most_mean);
    const Wire wire = field.trace(1300).value();
    EXPECT_EQ(wire.from, 7);
    EXPECT_EQ(wire.to, 1300);
    EXPECT_GE(wire.length, exact.distance(1300) * (1 - 1e-9));
    EXPECT_LE(wire.length, exact.distance(1300) * 1.02);
  }
}

TEST(HeatGeodesics, PathsDescendToTheSeed) {
  const Mesh shape = shapes::bumpy(shapes::icosphere(4), 0.1);
  const IntrinsicMesh mesh = intrinsic(shape);
  const DistanceField exact = ExactGeodesics(mesh).solve(100), field = HeatGeodesics(mesh).solve(100);
  double sum = 0.0, sum_exact = 0.0;
  for (std::int32_t v = 0; v < mesh.vertex_count; v += 7) {
    if (v == 100) continue;
    const IntrinsicPath path = field.trace(v).value();
    expect_path(mesh, path, exact.distances()[index(v)], 1.3);
    EXPECT_EQ(path.points.front().vertex, 100);
    EXPECT_EQ(path.points.back().vertex, v);
    double last = -1.0;
    for (const PathPoint& point : path.points) {
      if (point.vertex < 0) continue;
      EXPECT_GT(field.distances()[index(point.vertex)], last);
      last = field.distances()[index(point.vertex)];
    }
    sum += path.length;
    sum_exact += exact.distances()[index(v)];
  }
  EXPECT_LT(sum, 1.01 * sum_exact);
  const IntrinsicPath to_seed = field.trace(100).value();
  EXPECT_EQ(to_seed.points.size(), 1U);
  EXPECT_EQ(to_seed.length, 0.0);
}

TEST(HeatGeodesics, TakeSeedsAndTargetsInFacesAndOnEdges) {
  const IntrinsicMesh mesh = intrinsic(shapes::torus(60, 30));
  const HeatGeodesics heat(mesh);
  const ExactGeodesics geodesics(mesh);
  for (const SurfacePoint& seed : {SurfacePoint(100, {0.2, 0.3, 0.5}), SurfacePoint(200, {0.0, 0.4, 0.6})}) {
    const DistanceField exact = geodesics.solve(seed), field = heat.solve(seed);
    EXPECT_EQ(field.seed(), -1);
    EXPECT_NEAR(field.distance(seed), 0.0, 1e-15);
    for (const std::int32_t v : mesh.triangles[index(seed.face)]) {
      EXPECT_NEAR(field.distances()[index(v)], exact.distances()[index(v)], 1e-12);
    }
    EXPECT_LT(errors_of(field.distances(), [&](std::int32_t v) { return exact.distances()[index(v)]; }).mean, 0.04);
    for (const SurfacePoint& target : {SurfacePoint(1700, {0.6, 0.3, 0.1}), SurfacePoint(1701, {0.5, 0.5, 0.0}),
                                       SurfacePoint(900), SurfacePoint(100, {0.1, 0.1, 0.8})}) {
      const double expected = exact.distance(target);
      EXPECT_NEAR(field.distance(target), expected, 0.08 * expected + 1e-3);
      const IntrinsicPath path = field.trace(target).value();
      expect_path(mesh, path, expected, 1.2);
      const PathPoint& first = path.points.front();
      EXPECT_TRUE(first.face == seed.face || first.half_edge / 3 == seed.face);
      EXPECT_EQ(path.points.back().vertex, target.vertex);
    }
  }
}

TEST(HeatGeodesics, OfSeveralSeedsAreThoseOfTheNearest) {
  const IntrinsicMesh mesh = intrinsic(shapes::torus(80, 40));
  const std::array sources{SurfacePoint(3), SurfacePoint(2500, {0.2, 0.3, 0.5}), SurfacePoint(1600)};
  const DistanceField exact = ExactGeodesics(mesh).solve(sources), field = HeatGeodesics(mesh).solve(sources);
  EXPECT_LT(errors_of(field.distances(), [&](std::int32_t v) { return exact.distances()[index(v)]; }).mean, 0.07);
  EXPECT_EQ(field.distances()[3], 0.0);
  EXPECT_EQ(field.distances()[1600], 0.0);
  for (std::int32_t v = 0; v < mesh.vertex_count; v += 31) {
    expect_path(mesh, field.trace(v).value(), exact.distances()[index(v)], 1.5);
  }
}

TEST(HeatGeodesics, SayWhatIsUnreachable) {
  Mesh mesh = shapes::icosphere(2);
  const auto first = static_cast<std::int32_t>(mesh.points.size()),
             faces = static_cast<std::int32_t>(mesh.triangles.size());
  for (const Triangle& t : shapes::grid(6).triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  for (const Vector& p : shapes::grid(6).points) mesh.points.push_back(p);
  mesh.points.emplace_back(9, 9, 9);  // without a triangle
  const IntrinsicMesh both = intrinsic(mesh);
  const HeatGeodesics heat(both);
  const DistanceField field = heat.solve(5);
  for (std::int32_t v = 0; v < both.vertex_count; ++v) EXPECT_EQ(std::isinf(field.distances()[index(v)]), v >= first);
  EXPECT_EQ(field.distance(SurfacePoint(faces, {0.2, 0.3, 0.5})), kInfinity);
  EXPECT_FALSE(field.trace(first));
  EXPECT_FALSE(field.trace(SurfacePoint(faces, {0.2, 0.3, 0.5})));
  const DistanceField from_both = heat.solve(std::array{SurfacePoint(5), SurfacePoint(first)});
  EXPECT_EQ(std::ranges::count(from_both.distances(), kInfinity), 1);
  const DistanceField lonely = heat.solve(both.vertex_count - 1);
  EXPECT_EQ(lonely.distances().back(), 0.0);
  EXPECT_EQ(std::ranges::count(lonely.distances(), kInfinity), both.vertex_count - 1);
}

TEST(HeatGeodesics, EndAtTheLargestDistance) {
  const IntrinsicMesh mesh = intrinsic(shapes::torus(40, 20));
  const HeatGeodesics heat(mesh);
  const DistanceField whole = heat.solve(0);
  const DistanceField near = heat.solve(std::array{SurfacePoint(0)}, {.max_distance = 0.3, .targets = {}});
  EXPECT_EQ(near.radius(), 0.3);
  std::size_t beyond = 0;
  for (std::size_t v = 0; v < near.distances().size(); ++v) {
    const bool is_beyond = whole.distances()[v] > 0.3;
    beyond += is_beyond;
    EXPECT_EQ(near.distances()[v], is_beyond ? kInfinity : whole.distances()[v]);
    EXPECT_EQ(near.trace(static_cast<std::int32_t>(v)).has_value(), !is_beyond);
  }
  EXPECT_GT(beyond, 100U);
}

TEST(HeatGeodesics, LeadOverEdgesWithoutFaces) {
  Mesh mesh = shapes::grid(8);
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  for (const Triangle& t : shapes::grid(8).triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  for (const Vector& p : shapes::grid(8).points) mesh.points.emplace_back(p + Vector(0, 0, 1));
  IntrinsicMesh bridged = intrinsic(mesh);
  for (const double length : {0.0, 0.7}) {
    bridged.loose_edges = {{40, first + 40, length}};
    const DistanceField exact = ExactGeodesics(bridged).solve(0), field = HeatGeodesics(bridged).solve(0);
    for (const std::int32_t v : {first, first + 40, first + 80}) {
      EXPECT_NEAR(field.distances()[index(v)], exact.distances()[index(v)], 0.15 * exact.distances()[index(v)]);
      expect_path(bridged, field.trace(v).value(), exact.distances()[index(v)], 1.1);
    }
  }
}

TEST(HeatGeodesics, ArriveAtTheFarEndOfALongStrip) {
  // Heat falls to nothing on the way, if the time is not chosen for it.
  const Mesh mesh =
      shapes::parametric(4000, 1, false, false, [](double u, double v) { return Vector(4000 * u, v, 0); });
  const IntrinsicMesh strip = intrinsic(mesh);
  const DistanceField field = HeatGeodesics(strip).solve(0);
  EXPECT_NEAR(*std::ranges::max_element(field.distances()), 4000, 40);
  EXPECT_NEAR(field.trace(strip.vertex_count - 1)->length, 4000, 40);
}

TEST(HeatGeodesics, PathsEndOnMeshesOfAllKinds) {
  constexpr double kHuge = 1e9;  // some lengths are of no surface, where the method has no bound
  std::mt19937 random(11);
  std::uniform_real_distribution<double> length(1.01, 2.0), radius(-1.5, 1.5);
  std::vector<IntrinsicMesh> meshes{intrinsic(shapes::moebius(9)), intrinsic(shapes::moebius(40))};
  for (const shapes::Named& named : shapes::exactness_meshes(1)) {
    meshes.push_back(intrinsic(named.mesh));
    meshes.push_back(intrinsic(named.mesh, Eigen::Matrix3d(Vector(9, 1, 2).asDiagonal())));
    meshes.push_back(intrinsic(named.mesh, [&](int, int) { return length(random); }));
    std::vector<double> radii;
    for (std::size_t v = 0; v < named.mesh.points.size(); ++v) radii.push_back(std::exp(radius(random)));
    meshes.push_back(intrinsic(named.mesh, [&](int a, int b) { return radii[index(a)] + radii[index(b)]; }));
    Mesh fins = named.mesh;  // a third triangle at some edges, and some faces turned over
    for (std::size_t f = 0; f < named.mesh.triangles.size(); f += 9) {
      const Triangle on = fins.triangles[f];
      fins.triangles.push_back({on[0], on[1], static_cast<std::int32_t>(fins.points.size())});
      fins.points.emplace_back(fins.points[index(on[0])] + Vector(0.1, 0.05, 0.2));
      std::swap(fins.triangles[f][0], fins.triangles[f][1]);
    }
    meshes.push_back(intrinsic(fins));
  }
  for (const IntrinsicMesh& mesh : meshes) {
    const HeatGeodesics heat(mesh);
    const ExactGeodesics geodesics(mesh);
    for (int i = 0; i < 3; ++i) {
      const auto any_face = [&] { return static_cast<std::int32_t>(random() % mesh.face_count()); };
      const SurfacePoint seed = i == 0 ? SurfacePoint(mesh.triangles[index(any_face())][0])
                                       : SurfacePoint(any_face(), {i == 1 ? 0.5 : 0.0, 0.25, i == 1 ? 0.25 : 0.75});
      const DistanceField exact = geodesics.solve(seed), field = heat.solve(seed);
      for (std::int32_t v = 0; v < mesh.vertex_count; ++v) {
        ASSERT_EQ(std::isinf(exact.distances()[index(v)]), std::isinf(field.distances()[index(v)]));
        if (std::isinf(exact.distances()[index(v)])) continue;
        ASSERT_GE(field.distances()[index(v)], 0.0);
        expect_path(mesh, field.trace(v).value(), exact.distances()[index(v)], 1e9);
      }
      const SurfacePoint target(any_face(), {0.3, 0.6, 0.1});
      if (const double right = exact.distance(target); right < kInfinity) {
        expect_path(mesh, field.trace(target).value(), right, kHuge);
      }
    }
  }
}

template <class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(HeatGeodesics, RefuseWhatTheExactOnesRefuse) {
  const IntrinsicMesh mesh = intrinsic(shapes::grid(3));
  const HeatGeodesics heat(mesh);
  const ExactGeodesics exact(mesh);
  for (const SurfacePoint& point :
       {SurfacePoint(16), SurfacePoint(18, {0.2, 0.3, 0.5}), SurfacePoint(0, {0.2, 0.3, 0.6}),
        SurfacePoint(0, {-0.1, 0.6, 0.5}), SurfacePoint(-1, {0.2, 0.3, 0.5})}) {
    const std::array sources{SurfacePoint(0), point};
    EXPECT_EQ(message_of([&] { heat.solve(sources); }), message_of([&] { exact.solve(sources); }));
    const SolveOptions to{.targets = {point}};
    EXPECT_EQ(message_of([&] { heat.solve(std::array{SurfacePoint(0)}, to); }),
              message_of([&] { exact.solve(std::array{SurfacePoint(0)}, to); }));
    const DistanceField field = heat.solve(0), other = exact.solve(0);
    EXPECT_EQ(message_of([&] { field.distance(point); }), message_of([&] { other.distance(point); }));
    EXPECT_EQ(message_of([&] { field.trace(point); }), message_of([&] { other.trace(point); }));
    EXPECT_NE(message_of([&] { field.trace(point); }), "nothing was thrown");
  }
  IntrinsicMesh wrong = mesh;
  wrong.lengths[4] = -1.0;
  EXPECT_EQ(message_of([&] { HeatGeodesics{wrong}; }), message_of([&] { ExactGeodesics{wrong}; }));
}

TEST(HeatGeodesics, AgreeToTheBitWhenRepeated) {
  const IntrinsicMesh mesh = intrinsic(shapes::bumpy(shapes::icosphere(3), 0.1));
  const HeatGeodesics heat(mesh);
  EXPECT_EQ(heat.solve(5).distances(), heat.solve(5).distances());
  EXPECT_EQ(heat.solve(5).distances(), HeatGeodesics(mesh).solve(5).distances());
}

TEST(IntrinsicDelaunay, HasNoEdgeLeftToFlipAndTheSameArea) {
  const auto area = [](const std::vector<double>& lengths) {
    double sum = 0.0;
    for (std::size_t h = 0; h < lengths.size(); h += 3) {
      sum += detail::four_areas(lengths[h], lengths[h + 1], lengths[h + 2]) / 4;
    }
    return sum;
  };
  std::size_t changed = 0;
  for (const shapes::Named& named : shapes::exactness_meshes(2)) {
    const IntrinsicMesh mesh = intrinsic(named.mesh, Eigen::Matrix3d(Vector(7, 1, 1).asDiagonal()));
    const IntrinsicMesh flipped = detail::intrinsic_delaunay(mesh, {});
    changed += changed_triangles(mesh, flipped);
    EXPECT_NEAR(area(flipped.lengths), area(mesh.lengths), 1e-3 * area(mesh.lengths)) << named.name;
    const auto angle = [&](std::int32_t h) {
      const std::int32_t f = 3 * (h / 3);
      const double a = flipped.lengths[index(h)], b = flipped.lengths[index(f + (h + 1) % 3)],
                   c = flipped.lengths[index(f + (h + 2) % 3)];
      return std::acos(std::clamp((b * b + c * c - a * a) / (2 * b * c), -1.0, 1.0));
    };
    for (std::int32_t h = 0; index(h) < flipped.twins.size(); ++h) {
      const std::int32_t twin = flipped.twins[index(h)];
      if (twin < 0) continue;
      ASSERT_EQ(flipped.twins[index(twin)], h);
      ASSERT_EQ(flipped.lengths[index(twin)], flipped.lengths[index(h)]);
      ASSERT_EQ(flipped.triangles[index(twin / 3)][index((twin + 1) % 3)],
                flipped.triangles[index(h / 3)][index(h % 3)]);
      EXPECT_LT(angle(h) + angle(twin), std::numbers::pi + 1e-5) << named.name;
    }
  }
  EXPECT_GT(changed, 1000U);
}

}  // namespace
}  // namespace seamwire
