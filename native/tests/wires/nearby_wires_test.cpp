// SPDX-License-Identifier: GPL-3.0-or-later
#include "wires/local_wires.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/metric/curvature.hpp"
#include "shapes.hpp"

namespace seamwire {

using namespace detail;

namespace {

constexpr int kAround = 48, kTube = 30;

std::shared_ptr<const Surface> bumpy_torus(int around = kAround, int tube = kTube) {
  const shapes::Mesh mesh = shapes::bumpy(shapes::torus(around, tube), 0.01);
  return std::make_shared<const Surface>(mesh.points, mesh.triangles);
}

/// Some edges away in both directions, without going far around the tube.
std::int32_t near(std::int32_t seed) {
  const std::int32_t u = seed % kAround, v = seed / kAround;
  return (v + 3) % kTube * kAround + (u + 4) % kAround;
}

/// How much longer a wire is than the distance on an embedding of the whole surface, at every seed.
std::vector<double> excesses(const std::shared_ptr<const Surface>& surface, const Metric& metric) {
  const auto shared = std::make_shared<const Metric>(metric);
  const Embedding embedding = embed(*surface, metric, {.max_error = 0});
  const ExactGeodesics geodesics(embedding.mesh);
  std::vector<double> out;
  for (std::int32_t seed = 0; seed < static_cast<std::int32_t>(surface->vertex_count()); ++seed) {
    const SurfacePoint target = SurfacePoint(near(seed));
    NearbyWires wires(surface, shared, SurfacePoint(seed), surface->face_count() / 3);
    const std::optional<Wire> wire = wires.wire(target, {});
    if (!wire) {
      ADD_FAILURE() << "no wire from " << seed;
      continue;
    }
    EXPECT_EQ(wire->from, seed);
    EXPECT_EQ(wire->to, target.vertex);
    const DistanceField field = geodesics.solve(std::array{SurfacePoint(seed)}, {.targets = {target}});
    out.push_back(wire->length / field.distance(target) - 1);
  }
  return out;
}

TEST(NearbyWires, AreShortestInTheEuclideanMetric) {
  const auto surface = bumpy_torus();
  for (const double excess : excesses(surface, euclidean_metric(*surface, principal_curvatures(*surface)))) {
    EXPECT_NEAR(excess, 0.0, 1e-12);
  }
}

TEST(NearbyWires, AreMostlyShortestInAnisotropicMetrics) {
  const auto surface = bumpy_torus();
  const Curvature curvature = principal_curvatures(*surface);
  for (const Follow follow : {Follow::kMin, Follow::kMax}) {
    const std::vector<double> found =
        excesses(surface, feature_metric(*surface, curvature, follow, {.max_anisotropy = 8.0}));
    const auto exact = std::ranges::count_if(found, [](double excess) { return std::abs(excess) < 1e-12; });
    EXPECT_GT(static_cast<double>(exact), 0.8 * static_cast<double>(found.size()));
    for (const double excess : found) {
      EXPECT_GT(excess, -0.02) << "edges at the border of the faces may be bisected otherwise";
      EXPECT_LT(excess, 0.5);
    }
  }
}

TEST(NearbyWires, ServeOtherTargetsAndPointsInFaces) {
  const auto surface = bumpy_torus();
  const auto metric = std::make_shared<const Metric>(euclidean_metric(*surface, principal_curvatures(*surface)));
  const SurfacePoint seed = {100, {0.2, 0.3, 0.5}};
  NearbyWires wires(surface, metric, seed, surface->face_count() / 3);
  const auto embedding = std::make_shared<const Embedding>(embed(*surface, *metric, {.max_error = 0}));
  const DistanceField field = ExactGeodesics(embedding->mesh).solve(std::array{seed});
  for (const std::int32_t face : {700, 104, 200, 98, 101, 100}) {
    const SurfacePoint target = {face, {0.5, 0.25, 0.25}};
    const std::optional<Wire> wire = wires.wire(target, {});
    ASSERT_EQ(wire.has_value(), face != 700) << face;
    if (wire) {
      EXPECT_NEAR(wire->length, field.distance(target), 1e-12) << face;
    }
  }
}

TEST(NearbyWires, AreNoneWhereTheyTakeTooManyFaces) {
  const auto surface = bumpy_torus();
  const auto metric = std::make_shared<const Metric>(euclidean_metric(*surface, principal_curvatures(*surface)));
  NearbyWires wires(surface, metric, SurfacePoint(0), 80);
  EXPECT_FALSE(wires.wire(SurfacePoint(near(0)), {}));
  EXPECT_TRUE(wires.wire(SurfacePoint(1), {})) << "a target that is nearer";
}

TEST(NearbyWires, StopWhileFacesAreEmbedded) {
  const auto surface = bumpy_torus();
  const auto metric = std::make_shared<const Metric>(euclidean_metric(*surface, principal_curvatures(*surface)));
  NearbyWires wires(surface, metric, SurfacePoint(0), surface->face_count() / 3);
  int looks = 0;
  const Task task{.stop = {}, .progress = [&](double) { return ++looks <= 4; }};  // faces are chosen in two looks
  EXPECT_THROW(wires.wire(SurfacePoint(near(0)), task), Cancelled);
}

}  // namespace
}  // namespace seamwire
