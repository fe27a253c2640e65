// SPDX-License-Identifier: GPL-3.0-or-later
#include "wires/local_wires.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <stop_token>
#include <vector>

#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/wires/embedded_points.hpp"
#include "shapes.hpp"
#include "surface/face_rings.hpp"

namespace seamwire {

using namespace detail;

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// A metric on a plane, z = 0, whose cheap direction runs in circles around a center outside of the unit square.
Metric circular_metric(const Surface& surface, double anisotropy) {
  Metric metric;
  for (const Vector& point : surface.points()) {
    const Vector out = (point - Vector(0.5, -0.3, 0)).normalized(), around = Vector::UnitZ().cross(out);
    metric.normals.push_back(Vector::UnitZ());
    metric.tensors.emplace_back(anisotropy * out * out.transpose() + around * around.transpose() / anisotropy);
  }
  return metric;
}

/// The length of a wire in a metric on a plane, where forms vary linearly in each face.
double integrated(const Surface& surface, const Metric& metric, const Wire& wire) {
  constexpr int kSamples = 64;
  double length = 0.0;
  for (std::size_t i = 0; i < wire.faces.size(); ++i) {
    const Triangle& corners = surface.triangles()[at(wire.faces[i])];
    const Vector step = (wire.points[i + 1] - wire.points[i]) / kSamples;
    for (int k = 0; k < kSamples; ++k) {
      const double t = (k + 0.5) / kSamples;
      const Vector p = (1 - t) * wire.points[i] + t * wire.points[i + 1];
      const Vector &a = surface.points()[at(corners[0])], &b = surface.points()[at(corners[1])],
                   &c = surface.points()[at(corners[2])];
      const double area = (b - a).cross(c - a).z();
      const std::array weights{(b - p).cross(c - p).z() / area, (c - p).cross(a - p).z() / area,
                               (a - p).cross(b - p).z() / area};
      double square = 0.0;
      for (std::size_t j = 0; j < 3; ++j) square += weights[j] * step.dot(metric.tensors[at(corners[j])] * step);
      length += std::sqrt(square);
    }
  }
  return length;
}

/// A surface that its scope owns.
std::shared_ptr<const Surface> shared(const Surface& surface) { return {std::shared_ptr<void>(), &surface}; }

/// A wire as the embedding of the whole surface has it, and what it takes to refine it.
struct First {
  First(const Surface& on, const Metric& by, const SurfacePoint& begin, const SurfacePoint& end)
      : surface(shared(on)), metric(by), from(begin), to(end), embedding(embed(on, by, {.max_error = 0})) {
    const EmbeddedPoints points(surface, std::make_shared<const Embedding>(embedding));
    wire = trace_wire(on, embedding, ExactGeodesics(embedding.mesh).solve(std::array{*points.find(from)}),
                      *points.find(to))
               .value();
  }
  std::optional<Wire> refined(double max_error, const Task& task = {}) const {
    return refined_wire(surface, metric, wire, from, to,
                        {.max_error = max_error, .mean_edge_length = embedding.mean_edge_length}, task);
  }

  std::shared_ptr<const Surface> surface;
  const Metric& metric;
  SurfacePoint from, to;
  Embedding embedding;
  Wire wire;
};

TEST(FaceRings, InARegularMeshGrowBySixTimesTheRing) {
  const shapes::Mesh mesh = shapes::torus(40, 30);
  const Surface surface(mesh.points, mesh.triangles);
  for (const int rings : {0, 1, 2, 5}) {
    EXPECT_EQ(faces_within_rings(surface, {700}, rings, {}).size(), 1 + 6 * rings * (rings + 1));
  }
}

TEST(FaceRings, AreTheFacesThatShareVerticesUpToTheBoundary) {
  const shapes::Mesh mesh = shapes::grid(12);
  const Surface surface(mesh.points, mesh.triangles);
  std::set<std::int32_t> expected{0, 5, 200};
  for (int ring = 0; ring < 4; ++ring) {
    EXPECT_TRUE(std::ranges::equal(faces_within_rings(surface, {200, 0, 5}, ring, {}), expected));
    std::set<std::int32_t> vertices;
    for (const std::int32_t face : expected) {
      vertices.insert(mesh.triangles[at(face)].begin(), mesh.triangles[at(face)].end());
    }
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      const auto touches = [&](std::int32_t v) { return vertices.contains(v); };
      if (std::ranges::any_of(mesh.triangles[f], touches)) expected.insert(static_cast<std::int32_t>(f));
    }
  }
}

TEST(FaceRings, GoOnOverAnEdgeWithThreeFaces) {
  const Surface fin({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  EXPECT_EQ(faces_within_rings(fin, {0}, 1, {}), (std::vector<std::int32_t>{0, 1, 2}));
}

TEST(FaceRings, OfNoFaceThereAreNone) {
  const shapes::Mesh mesh = shapes::grid(3);
  EXPECT_TRUE(faces_within_rings(Surface(mesh.points, mesh.triangles), {}, 5, {}).empty());
}

TEST(RefinedWire, IntegratesShorterWhereDirectionsTurn) {
  const shapes::Mesh mesh = shapes::grid(16);
  const Surface surface(mesh.points, mesh.triangles);
  const Metric metric = circular_metric(surface, 20);
  for (const auto& [from, to] : {std::pair{0, 16}, std::pair{17 * 4, 17 * 4 + 16}}) {
    const First first(surface, metric, SurfacePoint(from), SurfacePoint(to));
    const std::optional<Wire> refined = first.refined(0.001);
    ASSERT_TRUE(refined);
    EXPECT_EQ(refined->vertices.front(), from);
    EXPECT_EQ(refined->vertices.back(), to);
    const double before = integrated(surface, metric, first.wire), after = integrated(surface, metric, *refined);
    EXPECT_LT(after, 0.97 * before);
    EXPECT_NEAR(refined->length, after, 0.01 * after) << "its length is about the integral";
    EXPECT_GT(std::abs(first.wire.length - after), 0.04 * after) << "that of the first wire is not";
  }
}

TEST(RefinedWire, AWireWhereTheMetricIsConstantStaysAsItIs) {
  const shapes::Mesh mesh = shapes::grid(10);
  const Surface surface(mesh.points, mesh.triangles);
  const Metric metric{.normals = std::vector<Vector>(121, Vector::UnitZ()),
                      .tensors = std::vector<Eigen::Matrix3d>(121, Eigen::Vector3d(2, 0.5, 0).asDiagonal())};
  const First first(surface, metric, {3, {0.2, 0.3, 0.5}}, SurfacePoint(118));
  EXPECT_FALSE(first.refined(0.001));
  const Metric turning = circular_metric(surface, 20);
  const First other(surface, turning, {3, {0.2, 0.3, 0.5}}, SurfacePoint(118));
  const std::optional<Wire> refined = other.refined(0.001);
  ASSERT_TRUE(refined);
  EXPECT_NEAR((refined->points.front() - other.wire.points.front()).norm(), 0, 1e-12);
  EXPECT_NEAR((refined->points.back() - other.wire.points.back()).norm(), 0, 1e-12);
}

TEST(RefinedWire, InTheWholeSurfaceIsThatOfRefiningAllOfIt) {
  const shapes::Mesh mesh = shapes::grid(6);  // within five rings of a wire through the middle lie all faces
  const Surface surface(mesh.points, mesh.triangles);
  const Metric metric = circular_metric(surface, 10);
  const First first(surface, metric, SurfacePoint(7), SurfacePoint(13));
  const Embedding all =
      embed(surface, metric, {.max_error = 0.01, .mean_edge_length = first.embedding.mean_edge_length});
  EXPECT_NEAR(first.refined(0.01)->length, ExactGeodesics(all.mesh).solve(7).distances()[13], 1e-12);
}

TEST(RefinedWire, ThereIsNoneOfAWireWithoutFaces) {
  const shapes::Mesh mesh = shapes::grid(4);
  const Surface surface(mesh.points, mesh.triangles);
  const Metric metric = circular_metric(surface, 5);
  const SurfacePoint end = SurfacePoint(3);
  const WireRefinement how{.max_error = 0.01, .mean_edge_length = 0.1};
  EXPECT_FALSE(refined_wire(shared(surface), metric, {}, end, SurfacePoint(9), how, {}));
  EXPECT_FALSE(refined_wire(shared(surface), metric, First(surface, metric, end, end).wire, end, end, how, {}));
}

TEST(RefinedWire, IsCancelled) {
  const shapes::Mesh mesh = shapes::grid(16);
  const Surface surface(mesh.points, mesh.triangles);
  const Metric metric = circular_metric(surface, 20);
  const First first(surface, metric, SurfacePoint(0), SurfacePoint(16));
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(first.refined(0.01, {.stop = stop.get_token(), .progress = {}}), Cancelled);
}

}  // namespace
}  // namespace seamwire
