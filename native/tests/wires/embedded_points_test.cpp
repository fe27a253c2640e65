// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/wires/embedded_points.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "embeddings.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/wires/wire.hpp"
#include "shapes.hpp"
#include "unowned.hpp"

namespace seamwire {
namespace {

using embeddings::at;

template <class Points>
Vector place(const Points& points, const std::vector<Triangle>& triangles, const SurfacePoint& point) {
  if (point.vertex >= 0) return points[at(point.vertex)];
  Vector sum = Vector::Zero();
  for (std::size_t i = 0; i < 3; ++i) sum += point.barycentric[i] * points[at(triangles[at(point.face)][i])];
  return sum;
}

/// A random metric bisects nearly all faces, some of them many times.
struct Refined {
  explicit Refined(shapes::Mesh shape, double anisotropy = 30)
      : mesh(std::move(shape)),
        surface(mesh.surface()),
        embedding(embed(surface, embeddings::random_metric(surface, anisotropy, 3), {.max_error = 0})) {}

  shapes::Mesh mesh;
  Surface surface;
  Embedding embedding;
};

std::vector<SurfacePoint> random_points(const Surface& surface) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0, 1);
  std::vector<SurfacePoint> out;
  for (std::int32_t f = 0; at(f) < surface.face_count(); ++f) {
    const double s = part(random), t = part(random);
    out.push_back({f, {s * t, s * (1 - t), 1 - s}});
    out.push_back({f, {0, t, 1 - t}});
    out.push_back({f, {1 - t, 0, t}});
    out.push_back({f, {t, 1 - t, 0}});
  }
  return out;
}

TEST(EmbeddedPoints, ArePointsOfTheSameFaceAtTheSamePlace) {
  shapes::Mesh far = shapes::grid(5, 0.2);
  for (Vector& p : far.points) p += Vector(1000, -2000, 500);
  for (const Refined& on : {Refined(shapes::grid(6, 0.2)), Refined(shapes::icosphere(2)), Refined(far),
                            Refined(shapes::torus(12, 8), 200)}) {
    ASSERT_GT(on.embedding.faces_added, on.surface.face_count() / 4);
    const EmbeddedPoints points(unowned(on.surface), unowned(on.embedding));
    double size = 0;
    for (const Vector& p : on.mesh.points) size = std::max(size, p.norm());
    for (const SurfacePoint& point : random_points(on.surface)) {
      const std::optional<SurfacePoint> found = points.find(point);
      ASSERT_TRUE(found);
      EXPECT_EQ(on.embedding.source_face[at(found->face)], point.face);
      const Vector expected = place(on.mesh.points, on.mesh.triangles, point);
      EXPECT_LT((place(on.embedding.points, on.embedding.mesh.triangles, *found) - expected).norm(), 1e-14 * size);
    }
  }
}

TEST(EmbeddedPoints, OnEdgesStayOnEdges) {
  for (const Refined& on : {Refined(shapes::grid(6, 0.2)), Refined(shapes::icosphere(2))}) {
    const EmbeddedPoints points(unowned(on.surface), unowned(on.embedding));
    for (const SurfacePoint& point : random_points(on.surface)) {
      const bool is_on_edge = std::ranges::count(point.barycentric, 0.0) > 0;
      if (!is_on_edge) continue;
      const SurfacePoint found = points.find(point).value();
      EXPECT_EQ(std::ranges::count(found.barycentric, 0.0), 1) << "face " << point.face;
    }
  }
}

TEST(EmbeddedPoints, VerticesKeepTheirNumbers) {
  const Refined on(shapes::grid(4, 0.2));
  const EmbeddedPoints points(unowned(on.surface), unowned(on.embedding));
  EXPECT_EQ(points.find(SurfacePoint(7)), SurfacePoint(7));
  for (std::int32_t f = 0; at(f) < on.surface.face_count(); ++f) {
    EXPECT_EQ(points.find({f, {0, 1, 0}}), SurfacePoint(on.surface.triangles()[at(f)][1]));
  }
}

TEST(EmbeddedPoints, WiresEndWhereOneClicks) {
  const Refined on(shapes::icosphere(2));
  const EmbeddedPoints points(unowned(on.surface), unowned(on.embedding));
  const std::vector<SurfacePoint> clicks = random_points(on.surface);
  const ExactGeodesics geodesics(on.embedding.mesh);
  const DistanceField field = geodesics.solve(std::array{*points.find(clicks[0])});
  for (std::size_t i = 1; i < clicks.size(); i += 13) {
    const SurfacePoint to = points.find(clicks[i]).value();
    const Wire wire = trace_wire(on.surface, on.embedding, field, to).value();
    EXPECT_EQ(wire.from, -1);
    EXPECT_EQ(wire.to, -1);
    EXPECT_NEAR(wire.length, field.distance(to), 1e-12);
    EXPECT_LT((wire.points.front() - place(on.mesh.points, on.mesh.triangles, clicks[0])).norm(), 1e-14);
    EXPECT_LT((wire.points.back() - place(on.mesh.points, on.mesh.triangles, clicks[i])).norm(), 1e-14);
    EXPECT_EQ(wire.faces.front(), clicks[0].face);
  }
}

TEST(EmbeddedPoints, HolesHaveNone) {
  shapes::Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {-2, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};  // the second one without an area
  const Surface surface = mesh.surface();
  const Embedding embedding = embed(surface, embeddings::identity_metric(surface), {.max_error = 0});
  ASSERT_EQ(embedding.invalid_left, 1U);
  const EmbeddedPoints points(unowned(surface), unowned(embedding));
  EXPECT_TRUE(points.find({0, {0.2, 0.3, 0.5}}));
  EXPECT_FALSE(points.find({1, {0.2, 0.3, 0.5}}));
}

TEST(EmbeddedPoints, WhatIsNoPointIsRefused) {
  const Refined on(shapes::grid(3));
  const EmbeddedPoints points(unowned(on.surface), unowned(on.embedding));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const SurfacePoint& wrong :
       {SurfacePoint{18, {1, 0, 0}}, SurfacePoint{0, {0.5, 0.6, -0.1}}, SurfacePoint{0, {nan, 0, 1}},
        SurfacePoint{0, {0.5, 0.6, 0.1}}, SurfacePoint(16), SurfacePoint{}}) {
    EXPECT_THROW(points.find(wrong), InvalidInput);
  }
  EXPECT_THROW(EmbeddedPoints(nullptr, unowned(on.embedding)), InvalidInput);
  EXPECT_THROW(EmbeddedPoints(unowned(on.surface), nullptr), InvalidInput);
  const Surface other = shapes::grid(2).surface();
  EXPECT_THROW(EmbeddedPoints(unowned(other), unowned(on.embedding)), InvalidInput);
}

}  // namespace
}  // namespace seamwire
