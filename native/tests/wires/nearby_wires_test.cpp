// SPDX-License-Identifier: GPL-3.0-or-later
#include "wires/nearby_wires.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <thread>
#include <vector>

#include "detail/deadline.hpp"
#include "live/event_count.hpp"
#include "live/right_of_way.hpp"
#include "live/seed_solver.hpp"
#include "seamwire/context/surface_context.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/live/livewire.hpp"
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
  const Embedding embedding = embed(*surface, metric);
  const ExactGeodesics geodesics(embedding.mesh);
  std::vector<double> out;
  for (std::int32_t seed = 0; seed < static_cast<std::int32_t>(surface->vertex_count()); ++seed) {
    const SurfacePoint target = SurfacePoint::at_vertex(near(seed));
    NearbyWires wires(surface, shared, SurfacePoint::at_vertex(seed), surface->face_count() / 3);
    const std::optional<Wire> wire = wires.wire(target, {});
    if (!wire) {
      ADD_FAILURE() << "no wire from " << seed;
      continue;
    }
    EXPECT_EQ(wire->from, seed);
    EXPECT_EQ(wire->to, target.vertex);
    const DistanceField field = geodesics.solve(std::array{SurfacePoint::at_vertex(seed)}, {.targets = {target}});
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
  const SurfacePoint seed = {.face = 100, .barycentric = {0.2, 0.3, 0.5}};
  NearbyWires wires(surface, metric, seed, surface->face_count() / 3);
  const auto embedding = std::make_shared<const Embedding>(embed(*surface, *metric));
  const DistanceField field = ExactGeodesics(embedding->mesh).solve(std::array{seed});
  for (const std::int32_t face : {700, 104, 200, 98, 101, 100}) {
    const SurfacePoint target = {.face = face, .barycentric = {0.5, 0.25, 0.25}};
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
  NearbyWires wires(surface, metric, SurfacePoint::at_vertex(0), 80);
  EXPECT_FALSE(wires.wire(SurfacePoint::at_vertex(near(0)), {}));
  EXPECT_TRUE(wires.wire(SurfacePoint::at_vertex(1), {})) << "a target that is nearer";
}

TEST(NearbyWires, StopWhileFacesAreEmbedded) {
  const auto surface = bumpy_torus();
  const auto metric = std::make_shared<const Metric>(euclidean_metric(*surface, principal_curvatures(*surface)));
  NearbyWires wires(surface, metric, SurfacePoint::at_vertex(0), surface->face_count() / 3);
  int looks = 0;
  const Task task{.stop = {}, .progress = [&](double) { return ++looks <= 4; }};  // faces are chosen in two looks
  EXPECT_THROW(wires.wire(SurfacePoint::at_vertex(near(0)), task), Cancelled);
}

TEST(NearbyWires, LetTheThreadWithTheRightOfWayGoFirst) {
  constexpr int kSide = 330;
  const auto surface = bumpy_torus(kSide, kSide);
  const std::size_t metric = std::max(1U, std::thread::hardware_concurrency());
  const SurfaceContext context(surface);
  context.curvature({});
  context.snap_graph({});
  const auto right_of_way = std::make_shared<RightOfWay>();
  right_of_way->update([] { return true; });
  EventCount events;
  SeedBox seeds(events);
  TargetBox targets(events);
  const LiveSettings settings{.along = Along::kSurface, .turning = 0.0, .loop_turning = {}, .max_error = 0.0};
  SeedSolver solver(metric, context, settings, right_of_way, targets);
  const LiveMetrics metrics{.wires = std::vector(metric + 1, MetricSpec::euclidean())};
  seeds.post(
      {.metrics = std::make_shared<MetricSet>(metrics, std::vector<Scribble>()), .preparing = {}, .seed = Pick{0}});
  targets.post(Pick{20 * kSide + 20});
  const SeedBox::Job job = seeds.take().value();
  const std::uint64_t seen = events.count();
  const std::jthread thread([&] { seeds.answer(job, [&] { return solver.solve(job, nullptr, seeds); }); });
  EXPECT_FALSE(events.wait_beyond(seen, deadline_after(1.0))) << "no preview is shown";
  right_of_way->update([] { return false; });
  events.wait_beyond(seen);
  EXPECT_TRUE(targets.read().answer) << "now it is";
  std::stop_source preparing = job.request->preparing;
  preparing.request_stop();
  seeds.close();
}

TEST(NearbyWires, AreSeenBeforeTheSurfaceIsEmbedded) {
  constexpr int kSide = 330;
  const auto surface = bumpy_torus(kSide, kSide);
  LiveWire live(surface, LiveWireOptions{.max_error = 0.0});
  live.seed({0});
  const std::int32_t target = 20 * kSide + 20;
  std::vector<double> first(live.wires({target}).wires.size(), 0.0);
  LiveWires found;
  do {
    found = live.wires({target});
    const auto embeddings = live.embeddings();
    for (std::size_t i = 0; i < first.size(); ++i) {
      if (!found.wires[i].points.empty() && !embeddings[i] && first[i] == 0) {
        EXPECT_FALSE(found.wires[i].final);
        first[i] = found.wires[i].length;
      }
    }
    live.wait(1e-3);
  } while (!found.final());
  if (std::ranges::count(first, 0.0) > 0) GTEST_SKIP() << "this thread was kept away for too long";
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_NEAR(first[i], found.wires[i].length, 0.2 * found.wires[i].length) << i;
  }
}

}  // namespace
}  // namespace seamwire
