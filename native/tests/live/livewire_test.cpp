// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wires from seeds to targets, and forks.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <thread>
#include <vector>

#include "live/live_wires.hpp"
#include "live/right_of_way.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/live/livewire.hpp"
#include "seamwire/wires/embedded_points.hpp"
#include "seamwire/wires/snap.hpp"
#include "shapes.hpp"
#include "thread_sanitizer.hpp"

namespace seamwire {

using namespace detail;
using namespace live_wires;

namespace {

TEST(LiveWire, AcrossTheSurfaceGivesTheGeodesicsOfThreeMetricsAndTheConcaveOneLeads) {
  const auto surface = shared(shapes::bumpy(shapes::torus(32, 20), 0.02));
  LiveWire live(surface, kPlain);
  live.seed({7});
  ASSERT_TRUE(live.wait());
  EXPECT_EQ(live.progress(), 1);
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    const Embedding embedding = embed(*surface, default_metric_of(*surface, kKinds[i]), {.max_error = 0});
    const DistanceField field = ExactGeodesics(embedding.mesh).solve(7);
    for (const std::int32_t target : {7, 8, 100, 639}) {
      const LiveWires wires = live.wires({target});
      ASSERT_EQ(wires.wires.size(), 3U);
      const LiveCandidate& got = wires.wires[i];
      const Wire expected = trace_wire(*surface, embedding, field, target).value();
      EXPECT_EQ(got.metric.kind(), kKinds[i]);
      EXPECT_TRUE(got.final);
      EXPECT_EQ(got.points, expected.points);
      EXPECT_EQ(got.faces, expected.faces);
      EXPECT_EQ(got.length, expected.length);
      EXPECT_EQ(got.vertices, snap_to_edges(*surface, expected));
      EXPECT_EQ(wires.active, 0);
      EXPECT_TRUE(wires.settled);
    }
  }
}

TEST(LiveWire, OfTheStrengthsOfTheOtherMetricsTheConcaveOneHasAShare) {
  const auto surface = shared(shapes::bumpy(shapes::torus(32, 20), 0.02));
  const auto concave = [&](const LiveWireOptions& options, std::size_t which) {
    return fresh_wires(surface, options, {7}, {333}).wires[which].length;
  };
  const double half = concave(in(MetricFamily::kConcave, {.parameter = 0.5}), 0);
  EXPECT_EQ(concave(in(MetricFamily::kFeature, {.parameter = 0.05}), 0), half);
  EXPECT_EQ(concave(in(MetricFamily::kFeature, {.max_anisotropy = 10.5}), 0), half);
}

TEST(LiveWire, WithAnotherFamilyOrAlongEdgesTheShorterOfTwoWiresLeads) {
  const auto surface = shared(shapes::bumpy(shapes::torus(32, 20), 0.02));
  LiveWire live(surface, kPlain);
  live.seed({7});
  ASSERT_TRUE(live.wait());
  live.set_metrics(live_metrics(MetricFamily::kCampen, {.max_anisotropy = 4}));
  ASSERT_TRUE(live.wait());
  for (const std::int32_t target : {8, 100, 333, 639}) {
    for (const LiveWires& found : {live.wires({target}), fresh_wires(surface, kAlongEdges, {7}, {target})}) {
      ASSERT_EQ(found.wires.size(), 2U);
      EXPECT_EQ(found.active, found.wires[1].length < found.wires[0].length ? 1 : 0);
    }
  }
  live.set_metrics(live_metrics(MetricFamily::kFeature, {.parameter = 0.1}));
  EXPECT_EQ(live.wires({333}).wires.size(), 3U);
  ASSERT_TRUE(live.wait());
  expect_equal(live.wires({333}), fresh_wires(surface, kPlain, {7}, {333}));
}

TEST(LiveWire, WhereTheLeadingWireIsFinalTheOthersNeedNotBeWaitedFor) {
  const auto surface = shared(shapes::torus(160, 120));
  LiveWire live(surface, kPlain);
  live.seed({77});
  for (LiveWires wires = live.wires({9000});; wires = live.wires({9000})) {
    EXPECT_EQ(wires.active, 0) << "before it is there, too";
    EXPECT_EQ(wires.settled, wires.wires[0].final);
    if (wires.final()) break;
    std::this_thread::yield();
  }
}

TEST(RightOfWay, IsWaitedForUntilItIsGivenUpOrTheWaitIsStopped) {
  constexpr std::chrono::hours kLong{1};
  RightOfWay right_of_way;
  EXPECT_TRUE(right_of_way.wait_for(kLong, {})) << "nobody has it";
  right_of_way.update([] { return true; });
  EXPECT_FALSE(right_of_way.wait_for(std::chrono::milliseconds(1), {})) << "the time is over";
  std::stop_source stop;
  std::atomic<int> through = 0;
  std::jthread stopped([&] { through += right_of_way.wait_for(kLong, stop.get_token()) ? 1 : 0; });
  std::jthread patient([&] { through += right_of_way.wait_for(kLong, {}) ? 10 : 0; });
  EXPECT_EQ(through, 0);
  stop.request_stop();
  stopped.join();
  EXPECT_EQ(through, 1);
  right_of_way.update([] { return false; });
  patient.join();
  EXPECT_EQ(through, 11);
}

/// The corner of its face that a point has most of.
std::int32_t nearest_corner(const Surface& surface, const SurfacePoint& point) {
  const auto most = std::max_element(point.barycentric.begin(), point.barycentric.end());
  return surface
      .triangles()[static_cast<std::size_t>(point.face)][static_cast<std::size_t>(most - point.barycentric.begin())];
}

TEST(LiveWire, FromPointsOfFacesGivesTheGeodesicsBetweenThem) {
  const auto surface = shared(shapes::torus(32, 20));
  const SurfacePoint seed{40, {0.2, 0.5, 0.3}};
  LiveWire live(surface, kPlain);
  live.seed_at(seed);
  ASSERT_TRUE(live.wait());
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    const auto shared_embedding =
        std::make_shared<const Embedding>(embed(*surface, default_metric_of(*surface, kKinds[i]), {.max_error = 0}));
    const Embedding& embedding = *shared_embedding;
    const EmbeddedPoints points(surface, shared_embedding);
    const DistanceField field = ExactGeodesics(embedding.mesh).solve(std::array{*points.find(seed)});
    const std::array targets{SurfacePoint{40, {0.6, 0.1, 0.3}}, SurfacePoint{900, {0.1, 0.8, 0.1}},
                             SurfacePoint{517, {0.0, 0.4, 0.6}}, SurfacePoint{3, {0.0, 1.0, 0.0}}, SurfacePoint(100)};
    for (const SurfacePoint& target : targets) {
      const LiveCandidate got = live.wires_to(target).wires[i];
      const Wire expected = trace_wire(*surface, embedding, field, *points.find(target)).value();
      EXPECT_TRUE(got.final);
      EXPECT_EQ(got.points, expected.points);
      EXPECT_EQ(got.faces, expected.faces);
      EXPECT_EQ(got.length, expected.length);
      ASSERT_FALSE(got.vertices.empty());
      EXPECT_EQ(got.vertices.front(), nearest_corner(*surface, seed));
      EXPECT_EQ(got.vertices.back(), target.vertex >= 0 ? target.vertex : nearest_corner(*surface, target));
    }
  }
  EXPECT_EQ(live.wires_to(SurfacePoint(100)).wires[0].points, live.wires({100}).wires[0].points);
  live.seed_at(SurfacePoint(7));
  ASSERT_TRUE(live.wait());
  expect_equal(live.wires({100}), fresh_wires(surface, kPlain, {7}, {100}));
}

TEST(LiveWire, AlongEdgesAPointAtAVertexIsThatVertex) {
  const auto surface = shared(shapes::torus(8, 6));
  LiveWire live(surface, kAlongEdges);
  live.seed_at(SurfacePoint(3));
  ASSERT_TRUE(live.wait());
  const LiveWires there = live.wires_to(SurfacePoint(20));
  ASSERT_FALSE(there.wires[0].vertices.empty());
  EXPECT_EQ(there.wires[0].vertices.front(), 3);
  EXPECT_EQ(there.wires[0].vertices.back(), 20);
  expect_equal(there, fresh_wires(surface, kAlongEdges, {3}, {20}));
  EXPECT_THROW(live.seed_at(SurfacePoint(48)), InvalidInput);
  EXPECT_THROW(live.wires_to(SurfacePoint(48)), InvalidInput);
  EXPECT_THROW(live.wires_to({3, {1.0, 0.0, 0.0}}), InvalidInput);
}

TEST(LiveWire, PointsThatAreNoneAreRefused) {
  const auto surface = shared(shapes::torus(8, 6));  // 96 triangles
  LiveWire live(surface, kPlain), along_edges(surface, kAlongEdges);
  const SurfacePoint right{3, {0.2, 0.5, 0.3}};
  EXPECT_THROW(along_edges.seed_at(right), InvalidInput);
  live.seed_at(right);
  for (const SurfacePoint& wrong : {SurfacePoint{96, {1, 0, 0}}, SurfacePoint{}, SurfacePoint{3, {0.5, 0.6, -0.1}},
                                    SurfacePoint{3, {0.5, 0.6, 0.1}}, SurfacePoint(48)}) {
    EXPECT_THROW(live.seed_at(wrong), InvalidInput);
    EXPECT_THROW(live.wires_to(wrong), InvalidInput);
  }
  ASSERT_TRUE(live.wait());
  EXPECT_FALSE(live.wires_to(right).wires[0].points.empty()) << "the seed before stays";
}

// The embedding leaves out a face without area, which has its vertices all the same.
TEST(LiveWire, FromAFaceWithoutAreaNoWireBegins) {
  shapes::Mesh mesh = shapes::grid(4);
  const auto flat = static_cast<std::int32_t>(mesh.triangles.size());
  mesh.triangles.push_back({0, 1, 1});
  const auto surface = std::make_shared<const Surface>(mesh.points, mesh.triangles);
  LiveWire live(surface, kPlain);
  live.seed_at({flat, {0.2, 0.5, 0.3}});
  ASSERT_TRUE(live.wait());
  const LiveWires none = live.wires({20});
  EXPECT_TRUE(none.final());
  EXPECT_TRUE(none.wires[0].points.empty());
  live.seed({20});
  ASSERT_TRUE(live.wait());
  EXPECT_TRUE(live.wires_to({flat, {0.2, 0.5, 0.3}}).wires[1].points.empty());
}

TEST(LiveWire, BeforeItIsFinalAWireLeadsFromPointToPoint) {
  const auto surface = shared(shapes::torus(160, 120));
  LiveWire live(surface, kPlain);
  const SurfacePoint target{9000, {0.3, 0.3, 0.4}};
  live.seed_at({77, {0.6, 0.3, 0.1}});
  std::array<LiveCandidate, 3> early;
  LiveWires wires = live.wires_to(target);
  for (; !wires.final(); wires = live.wires_to(target)) {
    for (std::size_t which = 0; which < 3; ++which) {
      if (!wires.wires[which].final && !wires.wires[which].points.empty()) early[which] = wires.wires[which];
    }
    std::this_thread::yield();
  }
  for (std::size_t which = 0; which < 3; ++which) {
    const LiveCandidate& last = wires.wires[which];
    ASSERT_FALSE(early[which].points.empty());
    EXPECT_LT((early[which].points.front() - last.points.front()).norm(), 1e-12);
    EXPECT_LT((early[which].points.back() - last.points.back()).norm(), 1e-12);
    EXPECT_EQ(early[which].vertices.front(), last.vertices.front());
    EXPECT_GE(early[which].length, last.length * (1 - 1e-9));
    EXPECT_LE(early[which].length, last.length * 1.05);
  }
}

TEST(LiveWire, AlongEdgesGivesTheChainsOfBothMetrics) {
  const auto surface = shared(shapes::torus(32, 20));
  LiveWire live(surface, kAlongEdges);
  for (const Pick seed : {Pick{7}, Pick{7, 8}}) {
    for (const bool forward : {false, true}) {
      live.seed(seed, forward);
      ASSERT_TRUE(live.wait());
      for (const Follow follow : {Follow::kMin, Follow::kMax}) {
        const EdgeWires chains =
            edge_wires(make_edge_graph(*surface, metric_of(*surface, follow, kEdgeStrength)), seed, 3.0, forward);
        for (const Pick target : {Pick{100}, Pick{300, 301}, Pick{8}}) {
          const LiveCandidate got = live.wires(target).wires[follow == Follow::kMin ? 0 : 1];
          const EdgeChain expected = chains.trace(target).value();
          EXPECT_EQ(got.vertices, expected.vertices);
          EXPECT_EQ(got.length, expected.length);
          EXPECT_TRUE(got.faces.empty());
          ASSERT_EQ(got.points.size(), got.vertices.size());
          for (std::size_t i = 0; i < got.points.size(); ++i) {
            EXPECT_EQ(got.points[i], surface->points()[static_cast<std::size_t>(got.vertices[i])]);
          }
        }
      }
    }
  }
}

TEST(LiveWire, BeforeItIsFinalAWireIsARealPathThatMayBeLonger) {
  const auto surface = shared(shapes::torus(160, 120));
  LiveWire live(surface, kPlain);
  live.seed({0});
  const Pick target{3000};
  std::array<std::vector<LiveCandidate>, 2> seen;
  LiveWires wires;
  do {
    const double progress = live.progress();
    EXPECT_GE(progress, 0);
    EXPECT_LE(progress, 1);
    wires = live.wires(target);
    for (std::size_t which = 0; which < 2; ++which) {
      const LiveCandidate& wire = wires.wires[which];
      EXPECT_EQ(wire.points.empty(), std::isinf(wire.length));
      EXPECT_TRUE(!wire.final || !wire.points.empty());
      if (!wire.final && !wire.points.empty()) seen[which].push_back(wire);
    }
    std::this_thread::yield();
  } while (!wires.final());
  EXPECT_FALSE(seen[0].empty() && seen[1].empty()) << "none in the whole time";
  for (std::size_t which = 0; which < 2; ++which) {
    for (const LiveCandidate& early : seen[which]) {
      EXPECT_EQ(early.points.front(), surface->points()[0]);
      EXPECT_EQ(early.points.back(), surface->points()[3000]);
      EXPECT_EQ(early.vertices.front(), 0);
      EXPECT_EQ(early.vertices.back(), 3000);
      EXPECT_EQ(early.faces.size() + 1, early.points.size());
      EXPECT_GE(early.length, wires.wires[which].length * (1 - 1e-12));
      EXPECT_LE(early.length, wires.wires[which].length * 1.05);
    }
  }
}

TEST(LiveWire, AlongEdgesWiresNearTheSeedAreFinalFirst) {
  const int nu = sized(700, 350), nv = sized(500, 250);
  const auto surface = std::make_shared<const Surface>(shapes::quad_torus(nu, nv).surface());
  LiveWire live(surface, kAlongEdges);
  ASSERT_TRUE(live.wait());  // for the preparation
  const Pick near{3}, far{nu * nv / 2 + nu / 2};
  bool was_first = false;
  for (int attempt = 0; attempt < 50 && !was_first; ++attempt) {  // the machine may keep us away from a whole search
    live.seed({0});
    LiveWires wires;
    do {
      std::this_thread::yield();
      wires = live.wires(near);
    } while (!wires.final());
    was_first = !live.wires(far).final();
    const LiveWires early = wires;
    ASSERT_TRUE(live.wait());
    expect_equal(early, live.wires(near));
  }
  EXPECT_TRUE(was_first);
}

TEST(LiveWire, TheNewestSeedCounts) {
  const auto surface = shared(shapes::torus(64, 48));
  for (const LiveWireOptions& options : {kPlain, kAlongEdges}) {
    LiveWire live(surface, options);
    for (std::int32_t seed = 0; seed < 200; ++seed) {
      live.seed({seed * 15});
      if (seed % 20 == 0) live.wait(0.002);
      for (const LiveCandidate& wire : live.wires({33}).wires) {
        EXPECT_TRUE(!wire.final || wire.vertices.front() == seed * 15);
      }
    }
    ASSERT_TRUE(live.wait());
    const LiveWires wires = live.wires({33});
    ASSERT_TRUE(wires.final());
    for (const LiveCandidate& wire : wires.wires) {
      EXPECT_EQ(wire.vertices.front(), 199 * 15);
      EXPECT_EQ(wire.vertices.back(), 33);
    }
  }
}

TEST(LiveWire, EndsInTheMiddleOfItsWork) {
  const auto surface = shared(shapes::torus(200, 150));
  for (const int milliseconds : {0, 1, 10, 50}) {
    LiveWire live(surface, kPlain);
    live.seed({0});
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  }
}

TEST(LiveWire, WaitsNoLongerThanItIsTold) {
  const auto surface = shared(shapes::torus(200, 150));
  LiveWire live(surface, kPlain);
  live.seed({0});
  for (const double seconds : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e-3}) {
    EXPECT_FALSE(live.wait(seconds)) << "as if it had been told to wait forever";
  }
  EXPECT_TRUE(live.wait(1e30));
}

TEST(LiveWire, AVertexWithoutAPathHasAFinalWireWithoutPoints) {
  shapes::Mesh mesh = shapes::grid(4);
  mesh.points.emplace_back(3, 3, 3);
  for (const LiveWireOptions& options : {kPlain, kAlongEdges}) {
    LiveWire live(shared(mesh), options);
    live.seed({0});
    ASSERT_TRUE(live.wait());
    const LiveWires wires = live.wires({25});
    EXPECT_TRUE(wires.final());
    for (const LiveCandidate& wire : wires.wires) {
      EXPECT_TRUE(wire.points.empty() && wire.vertices.empty());
      EXPECT_EQ(wire.length, std::numeric_limits<double>::infinity());
    }
    EXPECT_EQ(wires.active, 0);
  }
}

TEST(LiveWire, AForkHasTheSameMetricsAndASeedOfItsOwn) {
  const auto surface = shared(shapes::bumpy(shapes::torus(40, 24), 0.02));
  for (const LiveWireOptions& options : {kPlain, kAlongEdges}) {
    auto live = std::make_optional<LiveWire>(surface, options);
    live->seed({7});
    LiveWire early = live->fork();  // while the metrics are being computed
    EXPECT_THROW(early.wires({0}), InvalidInput) << "it has no seed yet";
    early.seed({50});
    ASSERT_TRUE(early.wait());
    LiveWire late = live->fork();
    late.seed({99});
    ASSERT_TRUE(live->wait());
    live->set_metrics(live_metrics(MetricFamily::kEuclidean, {}));
    ASSERT_TRUE(late.wait());
    ASSERT_TRUE(live->wait());
    expect_equal(early.wires({700}), fresh_wires(surface, options, {50}, {700}));
    live.reset();  // forks live on
    late.seed({98});
    ASSERT_TRUE(late.wait());
    expect_equal(late.wires({700}), fresh_wires(surface, options, {98}, {700}));
  }
}

TEST(LiveWire, AForkGoesOnWithWhatItsOriginLeftUndone) {
  const auto surface = shared(shapes::torus(100, 80));
  for (const LiveWireOptions& options : {kPlain, kAlongEdges}) {
    auto live = std::make_optional<LiveWire>(surface, options);
    LiveWire fork = live->fork();
    fork.seed({3});
    live.reset();
    ASSERT_TRUE(fork.wait());
    EXPECT_TRUE(fork.wires({99}).final());
  }
}

TEST(LiveWire, TellsTheFeatureStrengthOfEachVertex) {
  const auto surface = shared(shapes::torus(32, 20));
  const LiveWire live(surface);
  ASSERT_TRUE(live.wait());
  ASSERT_NE(live.feature_strength(), nullptr);
  EXPECT_EQ(*live.feature_strength(), principal_curvatures(*surface).difference());
}

TEST(LiveWire, TellsWhatBecameOfItsEmbeddings) {
  const shapes::Mesh mesh = shapes::torus(24, 40);
  const auto surface = std::make_shared<const Surface>(mesh.points, mesh.triangles);
  const Strength strength{.parameter = {}, .max_anisotropy = 1000};
  LiveWire live(surface, in(MetricFamily::kFeature, strength));
  live.seed({0, -1});
  ASSERT_TRUE(live.wait());
  const Curvature curvature = principal_curvatures(*surface);
  std::size_t clamped = 0;
  for (const Follow follow : {Follow::kMin, Follow::kMax}) {
    // The most triangles that a live wire adds to so small a mesh.
    const Embedding embedding = embed(*surface, feature_metric(*surface, curvature, follow, strength),
                                      {.max_faces_added = 200'000, .max_error = 0});
    clamped += embedding.clamped_edges;
    const auto told = live.embeddings()[follow == Follow::kMin ? 1 : 2];
    ASSERT_TRUE(told);
    EXPECT_EQ(told->invalid_left, embedding.invalid_left);
    EXPECT_EQ(told->hit_cap, embedding.hit_cap);
    EXPECT_EQ(told->clamped_edges, embedding.clamped_edges);
    EXPECT_EQ(told->worst_clamp, embedding.worst_clamp);
  }
  EXPECT_GT(clamped, 0U);
  const LiveWire along_edges = live.sibling(kAlongEdges);
  EXPECT_FALSE(along_edges.embeddings()[0] || along_edges.embeddings()[1]);
}

TEST(LiveWire, RunsOnAlongEdgesOnly) {
  const auto surface = std::make_shared<const Surface>(shapes::quad_cylinder(12, 6, 0.5, 1.0).surface());
  const LiveWire live(surface, kAlongEdges);
  ASSERT_TRUE(live.wait());
  const EdgeChain up = live.extend_straight({0, 12}, {});
  EXPECT_EQ(up.vertices, (std::vector<std::int32_t>{12, 24, 36, 48, 60, 72}));
  EXPECT_NEAR(up.length, 5.0 / 6, 1e-12);
  EXPECT_THROW(live.extend_straight({0, 13}, {}), InvalidInput);
  const LiveWire across(surface, kPlain);
  EXPECT_THROW(across.extend_straight({0, 12}, {}), InvalidInput);
  EXPECT_THROW(across.edge_loop({0, 12}, {}), InvalidInput);
}

TEST(LiveWire, RefusesWhatIsNotPartOfTheSurface) {
  const auto surface = shared(shapes::grid(4));
  LiveWire across(surface), along(surface, kAlongEdges);
  EXPECT_THROW(across.wires({0}), InvalidInput) << "no seed";
  for (const Pick pick : {Pick{-1}, Pick{25}, Pick{0, 1}}) EXPECT_THROW(across.seed(pick), InvalidInput);
  for (const Pick pick : {Pick{-1}, Pick{25}, Pick{0, 2}, Pick{0, 99}}) EXPECT_THROW(along.seed(pick), InvalidInput);
  try {
    across.seed({25});
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "vertex 25 is out of range: there are 25 vertices");
  }
  across.seed({0});
  along.seed({0});
  EXPECT_THROW(across.wires({25}), InvalidInput);
  EXPECT_THROW(across.wires({0, 1}), InvalidInput);
  EXPECT_THROW(along.wires({0, 2}), InvalidInput);
  EXPECT_THROW(along.loop({0, 2}), InvalidInput);
  EXPECT_THROW(across.loop({0, 1}), InvalidInput);
}

TEST(LiveWire, TakesAnAnisotropyBeyondAllSense) {
  const auto surface = shared(shapes::bumpy(shapes::torus(20, 10), 0.05));
  for (const Along along : {Along::kSurface, Along::kEdges}) {
    const LiveWires wires =
        fresh_wires(surface, in(MetricFamily::kFeature, {.max_anisotropy = 1e100}, along), {0}, {100});
    for (const LiveCandidate& wire : wires.wires) {
      EXPECT_TRUE(wire.final);
      EXPECT_TRUE(std::isfinite(wire.length) && wire.length > 0) << wire.length;
      EXPECT_FALSE(wire.vertices.empty());
    }
  }
}

TEST(LiveWire, RefusesWrongOptions) {
  const auto surface = shared(shapes::grid(4));
  EXPECT_THROW(LiveWire(surface, in(MetricFamily::kFeature, {})), InvalidInput);
  EXPECT_THROW(LiveWire(surface, in(MetricFamily::kFeature, {.parameter = -1})), InvalidInput);
  EXPECT_THROW(LiveWire(surface, in(MetricFamily::kCampen, {.parameter = 0.5})), InvalidInput);
  LiveWire live(surface, kPlain);
  EXPECT_THROW(live.set_metrics(live_metrics(MetricFamily::kFeature, {})), InvalidInput);
  EXPECT_THROW(live.set_metrics(live_metrics(MetricFamily::kCampen, {.max_anisotropy = 0.5})), InvalidInput);
  EXPECT_THROW(LiveWire(surface, in(MetricFamily::kFeature, {.parameter = 1, .max_anisotropy = 2})), InvalidInput);
  EXPECT_THROW(LiveWire(surface, {.turning = -1}), InvalidInput);
  EXPECT_THROW(LiveWire(surface, {.loop_turning = std::numeric_limits<double>::quiet_NaN()}), InvalidInput);
}

TEST(LiveWire, WhatFailsOnAThreadIsThrownToTheCaller) {
  LiveWire live(shared(shapes::torus(16, 12)),
                in(MetricFamily::kFeature, {.parameter = 1e307}));  // eigenvalues overflow
  EXPECT_THROW(live.wait(), InvalidInput);
  live.seed({0});
  EXPECT_THROW(live.wait(), InvalidInput);
  EXPECT_THROW(live.wires({1}), InvalidInput);
  EXPECT_THROW(live.fork().wait(), InvalidInput);
  live.set_metrics(live_metrics(MetricFamily::kFeature, {.parameter = 0.1}));
  EXPECT_TRUE(live.wait()) << "a metric that can be computed mends it";
  EXPECT_TRUE(live.wires({1}).final());
}

TEST(LiveWire, TracesWiresOfALargeSurfaceInTheBackground) {
  const auto surface = shared(shapes::bumpy(shapes::torus(320, 160), 0.01));
  ASSERT_GT(surface->face_count(), 100'000U);
  LiveWire live(surface, in(MetricFamily::kEuclidean));
  live.seed({7});
  ASSERT_TRUE(live.wait());
  // A caller that traced the wires itself would have them all at once.
  int at_once = 0;
  for (std::int32_t target = 25'000; target < 25'200; ++target) at_once += live.wires({target}).final() ? 1 : 0;
  EXPECT_LT(at_once, 200);
  ASSERT_TRUE(live.wait());
  EXPECT_EQ(live.progress(), 1.0);
  const Pick target{25'199};  // the newest one, whose work has taken the place of the others'
  const LiveWires wires = live.wires(target);
  ASSERT_TRUE(wires.final());
  const Embedding embedding =
      embed(*surface, euclidean_metric(*surface, principal_curvatures(*surface)), {.max_error = 0});
  const Wire expected = trace_wire(*surface, embedding, ExactGeodesics(embedding.mesh).solve(7), target.a).value();
  EXPECT_EQ(wires.wires[0].points, expected.points);
  EXPECT_EQ(wires.wires[0].vertices, snap_to_edges(*surface, expected));
  live.seed({9});
  live.wires(target);  // asked before the seed's distances are there
  ASSERT_TRUE(live.wait());
  ASSERT_TRUE(live.wires(target).final());
  EXPECT_EQ(live.wires(target).wires[0].vertices.front(), 9);
}

}  // namespace
}  // namespace seamwire
