// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sources and targets between the vertices. The reference is a mesh that has the point as a vertex.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "geodesics/path_tracing.hpp"
#include "inserted_point.hpp"
#include "intrinsic.hpp"
#include "paths.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"

namespace seamwire {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Relative: both sides sum up some hundred roundings, and the inserted vertex' lengths are rounded themselves.
constexpr double kTolerance = 1e-11;

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

struct Named {
  std::string name;
  IntrinsicMesh mesh;
};

std::vector<Named> meshes() {
  std::vector<Named> out;
  Eigen::Matrix3d stretched = Eigen::Matrix3d::Identity();
  stretched.diagonal() << 1.0, 4.0, 0.7;
  stretched(0, 1) = 1.5;
  for (const auto& [name, mesh] : shapes::exactness_meshes(1)) {
    out.push_back({name, shapes::intrinsic(mesh)});
    out.push_back({name + ", stretched", shapes::intrinsic(mesh, stretched)});
  }
  return out;
}

SurfacePoint at(std::int32_t face, double a, double b, double c) { return {face, {a, b, c}}; }

/// Two ends of a path name the same point: by a face and its coordinates, or by a half-edge and a part of it.
void expect_is(const IntrinsicMesh& mesh, const PathPoint& end, const SurfacePoint& point) {
  if (point.vertex >= 0) {
    EXPECT_EQ(end.vertex, point.vertex);
    return;
  }
  const std::int32_t face = end.face >= 0 ? end.face : end.half_edge / 3;
  ASSERT_EQ(face, point.face);
  const Eigen::Vector2d expected = points::in_plane(mesh, face, point.barycentric);
  EXPECT_LT((paths::place(mesh, face, end) - expected).norm(), 1e-13);
}

void expect_path(const IntrinsicMesh& mesh, const IntrinsicPath& path, double distance, const SurfacePoint& from,
                 const SurfacePoint& to) {
  ASSERT_FALSE(path.points.empty());
  EXPECT_NEAR(path.length, distance, kTolerance * distance);
  EXPECT_NEAR(paths::length_of(mesh, path), distance, kTolerance * distance + 1e-15);  // places are rounded
  expect_is(mesh, path.points.front(), from);
  expect_is(mesh, path.points.back(), to);
}

TEST(SurfacePoints, TargetsHaveTheDistancesOfInsertedVertices) {
  for (const auto& [name, mesh] : meshes()) {
    const ExactGeodesics geodesics(mesh);
    for (const std::int32_t seed : {0, mesh.vertex_count / 3, mesh.vertex_count - 1}) {
      const DistanceField field = geodesics.solve(seed);
      for (const auto& [kind, point] : points::all_kinds(mesh, static_cast<unsigned>(seed))) {
        SCOPED_TRACE(testing::Message() << name << ", " << kind << ", seed " << seed);
        const double expected = ExactGeodesics(points::insert(mesh, point)).solve(seed).distances().back();
        if (std::isinf(expected)) continue;  // a vertex without a face
        EXPECT_NEAR(field.distance(point), expected, kTolerance * expected);
        expect_path(mesh, field.trace(point).value(), expected, SurfacePoint(seed), point);
      }
    }
  }
}

TEST(SurfacePoints, SourcesGiveTheDistancesOfInsertedVertices) {
  for (const auto& [name, mesh] : meshes()) {
    const ExactGeodesics geodesics(mesh);
    for (const unsigned draw : {1U, 2U, 3U}) {
      for (const auto& [kind, point] : points::all_kinds(mesh, draw)) {
        SCOPED_TRACE(testing::Message() << name << ", " << kind << " of face " << point.face);
        const DistanceField field = geodesics.solve(std::array{point});
        EXPECT_EQ(field.seed(), -1);
        EXPECT_EQ(field.sources(), std::vector{point});
        const std::vector<double> expected =
            ExactGeodesics(points::insert(mesh, point)).solve(mesh.vertex_count).distances();
        for (std::int32_t v = 0; v < mesh.vertex_count; ++v) {
          const double distance = expected[index(v)];
          if (std::isinf(distance)) {
            EXPECT_EQ(field.distances()[index(v)], kInfinity);
            EXPECT_FALSE(field.trace(v));
            continue;
          }
          ASSERT_NEAR(field.distances()[index(v)], distance, kTolerance * distance) << "vertex " << v;
          expect_path(mesh, field.trace(v).value(), distance, point, SurfacePoint(v));
        }
        EXPECT_EQ(field.distance(point), 0.0);
        EXPECT_EQ(field.trace(point)->points.size(), 1U);
        EXPECT_EQ(field.trace(point)->length, 0.0);
      }
    }
  }
}

TEST(SurfacePoints, FromPointToPointIsTheSameBothWays) {
  for (const auto& [name, mesh] : meshes()) {
    const ExactGeodesics geodesics(mesh);
    const auto from = points::all_kinds(mesh, 11), to = points::all_kinds(mesh, 12);
    for (const auto& [kind, source] : from) {
      const DistanceField field = geodesics.solve(std::array{source});
      const IntrinsicMesh with_source = points::insert(mesh, source);
      for (const auto& [other_kind, target] : to) {
        SCOPED_TRACE(testing::Message() << name << ", from a point " << kind << " to one " << other_kind);
        const double distance = field.distance(target);
        EXPECT_NEAR(geodesics.solve(std::array{target}).distance(source), distance, kTolerance * distance);
        expect_path(mesh, field.trace(target).value(), distance, source, target);
        const bool is_untouched = with_source.triangles[index(target.face)] == mesh.triangles[index(target.face)];
        if (!is_untouched) continue;
        const DistanceField expected = ExactGeodesics(with_source).solve(mesh.vertex_count);
        EXPECT_NEAR(distance, expected.distance(target), kTolerance * distance);
      }
    }
  }
}

TEST(SurfacePoints, WithinOneFaceTheWayIsStraight) {
  const IntrinsicMesh mesh = shapes::intrinsic(shapes::grid(4, 0.2));
  const SurfacePoint a = at(9, 0.2, 0.3, 0.5), b = at(9, 0.5, 0.5, 0.0);
  const DistanceField field = ExactGeodesics(mesh).solve(std::array{a});
  const double straight = (points::in_plane(mesh, 9, a.barycentric) - points::in_plane(mesh, 9, b.barycentric)).norm();
  EXPECT_NEAR(field.distance(b), straight, 1e-15);
  EXPECT_EQ(field.trace(b)->faces, std::vector{9});
}

TEST(SurfacePoints, APlaneIsAsFlatAsItIs) {
  const shapes::Mesh plane = shapes::grid(12, 0.3, 4);
  const IntrinsicMesh mesh = shapes::intrinsic(plane);
  const auto place = [&](const SurfacePoint& p) {
    Vector sum = Vector::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      sum += p.barycentric[i] * plane.points[index(plane.triangles[index(p.face)][i])];
    }
    return sum;
  };
  const ExactGeodesics geodesics(mesh);
  for (const unsigned draw : {1U, 2U, 3U, 4U}) {
    const auto some = points::all_kinds(mesh, draw), others = points::all_kinds(mesh, draw + 100);
    for (const auto& [kind, from] : some) {
      const DistanceField field = geodesics.solve(std::array{from});
      for (const auto& [other_kind, to] : others) {
        const double straight = (place(from) - place(to)).norm();
        EXPECT_NEAR(field.distance(to), straight, 1e-14) << kind << " to " << other_kind;
      }
    }
  }
}

TEST(SurfacePoints, NextToAnEdgeIsAsGoodAsOnIt) {
  constexpr double kAway = 1e-13;
  for (const auto& [name, mesh] : meshes()) {
    const ExactGeodesics geodesics(mesh);
    const DistanceField from_vertex = geodesics.solve(mesh.triangles[0][0]);
    for (std::int32_t face = 0; index(face) < mesh.face_count(); face += 7) {
      SCOPED_TRACE(testing::Message() << name << ", face " << face);
      const SurfacePoint on = at(face, 0, 0.3, 0.7), beside = at(face, kAway, 0.3, 0.7 - kAway);
      const double expected = from_vertex.distance(on);
      EXPECT_NEAR(from_vertex.distance(beside), expected, kTolerance);
      if (std::isinf(expected)) continue;
      expect_path(mesh, from_vertex.trace(beside).value(), expected, from_vertex.sources()[0], beside);
      const DistanceField field = geodesics.solve(std::array{beside}), edge_field = geodesics.solve(std::array{on});
      for (std::int32_t v = 0; v < mesh.vertex_count; v += 5) {
        const double distance = edge_field.distances()[index(v)];
        if (std::isinf(distance)) continue;
        ASSERT_NEAR(field.distances()[index(v)], distance, kTolerance);
        expect_path(mesh, field.trace(v).value(), distance, beside, SurfacePoint(v));
      }
    }
  }
}

TEST(SurfacePoints, NextToAVertexIsAsGoodAsAtIt) {
  for (const auto& [name, mesh] : meshes()) {
    const ExactGeodesics geodesics(mesh);
    for (const double away : {1e-13, 2e-16, 1.2e-16, 1e-17, 1e-200, 1e-310}) {
      for (std::int32_t face = 0; index(face) < mesh.face_count(); face += 29) {
        SCOPED_TRACE(testing::Message() << name << ", face " << face << ", " << std::log10(away));
        const DistanceField expected = geodesics.solve(mesh.triangles[index(face)][1]);
        for (const SurfacePoint& beside : {at(face, away, 1 - 3 * away, 2 * away), at(face, away, 1 - away, 0)}) {
          const DistanceField field = geodesics.solve(std::array{beside});
          for (std::int32_t v = 0; v < mesh.vertex_count; v += 3) {
            const double distance = expected.distances()[index(v)];
            if (std::isinf(distance)) continue;
            ASSERT_NEAR(field.distances()[index(v)], distance, kTolerance) << v;
            EXPECT_NEAR(field.trace(v)->length, distance, kTolerance) << v;
          }
          const SurfacePoint far = at(static_cast<std::int32_t>(mesh.face_count()) / 2, 0.3, 0.3, 0.4);
          EXPECT_NEAR(field.distance(far), expected.distance(far), kTolerance);
          EXPECT_NEAR(geodesics.solve(std::array{far}).trace(beside)->length, expected.distance(far), kTolerance);
        }
      }
    }
  }
}

TEST(SurfacePoints, OnASpikeTheyTakeNoLongerThanElsewhere) {
  for (const double width : {1e-3, 1e-6, 1e-9}) {
    // A spike of six triangles that stands on a sheet.
    shapes::Mesh mesh;
    for (const double radius : {width, 0.5}) {
      for (int k = 0; k < 6; ++k) {
        const double angle = k * std::numbers::pi / 3;
        mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
      }
    }
    mesh.points.emplace_back(0.3, 0.2, 1.0);
    for (std::int32_t k = 0; k < 6; ++k) {
      const std::int32_t next = (k + 1) % 6;
      mesh.triangles.push_back({k, next, 12});
      mesh.triangles.push_back({k, k + 6, next + 6});
      mesh.triangles.push_back({k, next + 6, next});
    }
    const ExactGeodesics geodesics(shapes::intrinsic(mesh));
    for (const std::int32_t seed : {0, 6, 9, 12}) {
      const DistanceField field = geodesics.solve(seed);
      for (const SurfacePoint& point : {at(0, 0.3, 0.3, 0.4), at(0, 0.5, 0.0, 0.5), at(9, 0.1, 0.8, 0.1),
                                        at(9, 0.01, 0.01, 0.98), at(1, 0.3, 0.3, 0.4), at(8, 0.4, 0.2, 0.4)}) {
        SCOPED_TRACE(testing::Message() << width << ", seed " << seed << ", face " << point.face);
        std::size_t looks = 0;
        const Task task{.stop = {}, .progress = [&](double) { return ++looks < 3; }};  // each after 2048 beams
        double distance = 0.0;
        ASSERT_NO_THROW(distance = field.distance(point, task));
        EXPECT_NO_THROW(field.trace(point, task));
        // Along one of the edges of its face it is as near, but for the width of the spike.
        const Triangle& corners = mesh.triangles[index(point.face)];
        Vector place = Vector::Zero();
        for (std::size_t i = 0; i < 3; ++i) place += point.barycentric[i] * mesh.points[index(corners[i])];
        double over_corners = kInfinity;
        for (const std::int32_t v : corners) {
          over_corners = std::min(over_corners, field.distances()[index(v)] + (mesh.points[index(v)] - place).norm());
        }
        EXPECT_LE(distance, over_corners * (1 + kTolerance));
        if (point.face % 3 == 0) {
          EXPECT_GE(distance, over_corners - 6 * width) << "on the spike";
        }
      }
    }
  }
}

TEST(SurfacePoints, FromPointToPointOnASpikeTakesNoLongerThanElsewhere) {
  for (const double width : {1e-3, 1e-5, 1e-7}) {
    shapes::Mesh mesh;
    for (int k = 0; k < 6; ++k) {
      const double angle = k * std::numbers::pi / 3;
      mesh.points.emplace_back(width * std::cos(angle), width * std::sin(angle), 0);
    }
    mesh.points.emplace_back(0.3, 0.2, 1.0);
    for (std::int32_t k = 0; k < 6; ++k) mesh.triangles.push_back({k, (k + 1) % 6, 6});
    const ExactGeodesics geodesics(shapes::intrinsic(mesh));
    for (const double one : {0.1, 0.3, 0.44, 0.6}) {
      for (const double other : {0.2, 0.4, 0.7, 0.87}) {  // parts of the way from the tip
        // In faces opposite to each other. Ways around the tip are nearly as short, however often they go around.
        const SurfacePoint from = at(5, 0.3 * one, 0.7 * one, 1 - one), to = at(2, 0.6 * other, 0.4 * other, 1 - other);
        const DistanceField field = geodesics.solve(std::array{from});
        std::size_t looks = 0;
        const Task task{.stop = {}, .progress = [&](double) { return ++looks < 2; }};  // each after 2048 beams
        double distance = 0.0;
        ASSERT_NO_THROW(distance = field.distance(to, task)) << width << ", " << one << ", " << other;
        ASSERT_NO_THROW(field.trace(to, task)) << width << ", " << one << ", " << other;
        EXPECT_NEAR(distance, std::abs(one - other) * mesh.points[6].norm(), 6 * width);
      }
    }
  }
}

TEST(SurfacePoints, CoordinatesThatAreAVertexAreThatVertexToTheBit) {
  for (const auto& [name, mesh] : meshes()) {
    const ExactGeodesics geodesics(mesh);
    const std::int32_t v = mesh.triangles[5][1];
    const DistanceField expected = geodesics.solve(v);
    for (const SurfacePoint& same : {at(5, 0, 1, 0), SurfacePoint(v)}) {
      const DistanceField field = geodesics.solve(std::array{same});
      EXPECT_EQ(field.distances(), expected.distances()) << name;
    }
    EXPECT_EQ(expected.distance(at(5, 1, 0, 0)), expected.distances()[index(mesh.triangles[5][0])]);
  }
}

TEST(SurfacePoints, OfSeveralSourcesTheNearestCounts) {
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const ExactGeodesics geodesics(mesh);
    std::vector<SurfacePoint> sources;
    for (const auto& [kind, point] : points::all_kinds(mesh, 21)) sources.push_back(point);
    sources.push_back(SurfacePoint(mesh.triangles[7][2]));
    sources.push_back(at(sources.front().face, 0.1, 0.1, 0.8));  // two in one face
    std::vector<DistanceField> each;
    for (const SurfacePoint& source : sources) each.push_back(geodesics.solve(std::array{source}));
    const DistanceField field = geodesics.solve(sources);
    EXPECT_EQ(field.seed(), -1);
    const auto check = [&, &mesh = mesh](const SurfacePoint& target) {
      std::size_t nearest = 0;
      for (std::size_t k = 1; k < each.size(); ++k) {
        if (each[k].distance(target) < each[nearest].distance(target)) nearest = k;
      }
      const double expected = each[nearest].distance(target);
      if (std::isinf(expected)) {
        EXPECT_EQ(field.distance(target), kInfinity);
        return;
      }
      ASSERT_NEAR(field.distance(target), expected, kTolerance * expected);
      const bool is_tie = std::ranges::any_of(each, [&, k = std::size_t{0}](const DistanceField& other) mutable {
        return k++ != nearest && other.distance(target) <= expected * (1 + 1e-9);
      });
      if (!is_tie) expect_path(mesh, field.trace(target).value(), expected, sources[nearest], target);
    };
    for (std::int32_t v = 0; v < mesh.vertex_count; ++v) check(SurfacePoint(v));
    for (const unsigned draw : {31U, 32U, 33U}) {
      for (const auto& [kind, point] : points::all_kinds(mesh, draw)) check(point);
    }
  }
}

TEST(SurfacePoints, OtherComponentsAreOutOfReach) {
  shapes::Mesh two = shapes::grid(3);
  const auto first = static_cast<std::int32_t>(two.points.size());
  const auto faces = static_cast<std::int32_t>(two.triangles.size());
  const shapes::Mesh other = shapes::icosphere(1);
  for (const Vector& p : other.points) two.points.push_back(p + Vector(5, 0, 0));
  for (const auto& [a, b, c] : other.triangles) two.triangles.push_back({a + first, b + first, c + first});
  const IntrinsicMesh mesh = shapes::intrinsic(two);
  const DistanceField field = ExactGeodesics(mesh).solve(std::array{at(2, 0.3, 0.3, 0.4)});
  EXPECT_LT(field.distance(at(3, 0.3, 0.3, 0.4)), 1.0);
  EXPECT_EQ(field.distance(at(faces + 2, 0.3, 0.3, 0.4)), kInfinity);
  EXPECT_FALSE(field.trace(at(faces + 2, 0.3, 0.7, 0)));
  EXPECT_EQ(field.distances()[index(first)], kInfinity);
}

TEST(SurfacePoints, ASolveThatStopsKnowsWhatItWasFor) {
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const ExactGeodesics geodesics(mesh);
    const std::array source{points::all_kinds(mesh, 41).front().point};
    const DistanceField whole = geodesics.solve(source);
    double farthest = 0.0;
    for (const double d : whole.distances()) {
      if (d < kInfinity) farthest = std::max(farthest, d);
    }
    const auto compare = [&, &mesh = mesh](const DistanceField& field) {
      for (std::size_t v = 0; v < whole.distances().size(); ++v) {
        const double d = whole.distances()[v];
        if (d < kInfinity && d <= field.radius()) {
          ASSERT_NEAR(field.distances()[v], d, kTolerance * d) << "vertex " << v;
        } else {
          ASSERT_EQ(field.distances()[v], kInfinity) << "vertex " << v;
        }
      }
      for (const unsigned draw : {51U, 52U, 53U, 54U}) {
        for (const auto& [kind, point] : points::all_kinds(mesh, draw)) {
          const double d = whole.distance(point);
          if (d <= field.radius()) {
            ASSERT_NEAR(field.distance(point), d, kTolerance * d) << kind;
            expect_path(mesh, field.trace(point).value(), d, source[0], point);
          } else {
            ASSERT_EQ(field.distance(point), kInfinity) << kind;
            ASSERT_FALSE(field.trace(point)) << kind;
          }
        }
      }
    };
    for (const double part : {0.0, 0.1, 0.3, 0.6, 0.9}) {
      const DistanceField field = geodesics.solve(source, {.max_distance = part * farthest, .targets = {}});
      EXPECT_EQ(field.radius(), part * farthest);
      compare(field);
    }
    for (const auto& [kind, target] : points::all_kinds(mesh, 61)) {
      const DistanceField field = geodesics.solve(source, {.targets = {target, SurfacePoint(3)}});
      EXPECT_NEAR(field.distances()[3], whole.distances()[3], kTolerance * whole.distances()[3]);
      EXPECT_NEAR(field.distance(target), whole.distance(target), kTolerance * whole.distance(target));
      compare(field);
    }
  }
}

TEST(SurfacePoints, StoppingSavesWork) {
  const IntrinsicMesh mesh = shapes::intrinsic(shapes::grid(40, 0.2));
  const ExactGeodesics geodesics(mesh);
  const std::array source{at(1, 0.2, 0.2, 0.6)};
  const GeodesicCounters whole = geodesics.solve(source).counters();
  const GeodesicCounters stopped = geodesics.solve(source, {.targets = {at(200, 0.3, 0.3, 0.4)}}).counters();
  const GeodesicCounters at_distance = geodesics.solve(source, {.max_distance = 0.2, .targets = {}}).counters();
  EXPECT_LT(stopped.windows, whole.windows / 4);
  EXPECT_LT(at_distance.windows, whole.windows / 4);
}

/// Low faces: paths leave them on both sides, as if they were not there.
TEST(SurfacePoints, FacesOfHardlyAnyHeightHaveTheirPoints) {
  // A square of two triangles with its diagonal (0, 2) doubled: between the two is the low triangle (0, 2, 4).
  for (const auto& [height, most_error] : {std::pair(0.1, 1e-14), std::pair(1e-6, 1e-10)}) {
    shapes::Mesh square;
    square.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5 - height, 0.5 + height, 0}};
    square.triangles = {{0, 1, 2}, {0, 2, 4}, {0, 4, 3}, {4, 2, 3}};
    const ExactGeodesics geodesics(shapes::intrinsic(square));
    for (const SurfacePoint& point : {at(1, 0.3, 0.3, 0.4), at(1, 0.5, 0.2, 0.3)}) {
      Vector place = Vector::Zero();
      for (std::size_t i = 0; i < 3; ++i) place += point.barycentric[i] * square.points[index(square.triangles[1][i])];
      const DistanceField field = geodesics.solve(std::array{point});
      for (const std::int32_t v : {1, 3}) {
        const double expected = (square.points[index(v)] - place).norm();
        EXPECT_NEAR(field.distances()[index(v)], expected, most_error) << v;
        EXPECT_NEAR(geodesics.solve(v).distance(point), expected, most_error) << v;
      }
    }
  }
}

TEST(SurfacePoints, WhatIsNoPointIsRefused) {
  const IntrinsicMesh mesh = shapes::intrinsic(shapes::grid(2));  // 8 triangles, 9 vertices
  const ExactGeodesics geodesics(mesh);
  const DistanceField field = geodesics.solve(0);
  const auto message = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "taken";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<SurfacePoint, std::string>> wrong{
      {at(8, 1, 0, 0), "face 8 is out of range: there are 8 faces"},
      {at(-1, 1, 0, 0), "face -1 is out of range: there are 8 faces"},
      {SurfacePoint(9), "vertex 9 is out of range: there are 9 vertices"},
      {at(3, 0.5, 0.6, -0.1), "a barycentric coordinate is -0.1, not finite and 0 or more"},
      {at(3, nan, 0.5, 0.5), "a barycentric coordinate is nan, not finite and 0 or more"},
      {at(3, kInfinity, 0, 0), "a barycentric coordinate is inf, not finite and 0 or more"},
      {at(3, 0.5, 0.5, 0.5), "the barycentric coordinates' sum is 1.5, not 1"},
      {at(3, 0, 0, 0), "the barycentric coordinates' sum is 0, not 1"}};
  const SurfacePoint right = at(3, 0.2, 0.3, 0.5);
  for (const auto& [point, what] : wrong) {
    EXPECT_EQ(message([&, &point = point] { field.distance(point); }), "point: " + what);
    EXPECT_EQ(message([&, &point = point] { field.trace(point); }), "point: " + what);
    EXPECT_EQ(message([&, &point = point] { geodesics.solve(std::array{right, point}); }), "source 1: " + what);
    EXPECT_EQ(message([&, &point = point] {
                geodesics.solve(std::array{right}, {.targets = {right, right, point}});
              }),
              "target 2: " + what);
  }
  EXPECT_EQ(message([&] { field.distance(at(3, 0.2 + 1e-10, 0.3, 0.5)); }), "taken");
  EXPECT_EQ(message([&] { geodesics.solve(std::vector<SurfacePoint>{}); }), "no source to have distances from");
  EXPECT_EQ(message([&] { geodesics.solve(std::array{right}, {.max_distance = -1.0, .targets = {}}); }),
            "max_distance is -1, not 0 or more");
  EXPECT_EQ(message([&] { geodesics.solve(std::array{right}, {.max_distance = nan, .targets = {}}); }),
            "max_distance is nan, not 0 or more");
}

// Rounding may lead a line out of the mesh. No vertex is nearer to the source then, and no corner of the source's face
// is reached straight.
TEST(SurfacePoints, APathWithoutALineAndWithoutEdgesToFollowEndsAtItsSource) {
  const detail::GeodesicMesh plane(shapes::intrinsic(shapes::grid(4)), {});
  std::int32_t border = 0;
  while (plane.twin(border) >= 0) ++border;
  const std::int32_t target = plane.half_edge(border).apex;
  const auto count = static_cast<std::int32_t>(plane.vertex_count());
  const detail::SourcePoints sources({detail::PlacedPoint::in_face(plane, {.face = 9, .weights = {0.2, 0.3, 0.5}})});
  std::vector<double> distances(plane.vertex_count(), 2.0);
  std::vector<detail::TraceRecord> records(plane.vertex_count(), {.half_edge = detail::TraceRecord::kLooseEdge});
  distances[index(plane.external_vertex(target))] = 1.0;
  records[index(target)] = {.x = 0.0, .y = -1.0, .half_edge = border, .source = count};
  const IntrinsicPath path =
      detail::trace_records({plane, distances, sources}, records, {}, detail::PlacedPoint::at_vertex(target), {});
  ASSERT_EQ(path.points.size(), 2u);
  EXPECT_EQ(path.points.front().face, 9);
  EXPECT_EQ(path.points.back().vertex, target);
  EXPECT_EQ(path.length, 1.0);
}

}  // namespace
}  // namespace seamwire
