// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/livewire.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <thread>

#include "seamwire/embedding.hpp"
#include "seamwire/geodesics.hpp"
#include "shapes.hpp"

namespace seamwire {
namespace {

using Seconds = std::chrono::duration<double>;

std::shared_ptr<const Surface> shared(const shapes::Mesh& mesh) {
  return std::make_shared<const Surface>(mesh.points, mesh.triangles);
}

Metric metric_of(const Surface& surface, Follow follow, const Strength& strength) {
  return feature_metric(surface, principal_curvatures(surface), follow, strength);
}

const LiveWireOptions kAlongEdges = {.along = Along::kEdges,
                                     .strength = {.max_anisotropy = 10, .clamp_percentile = 99}};

TEST(LiveWire, AcrossTheSurfaceGivesTheGeodesicsOfBothMetrics) {
  const auto surface = shared(shapes::torus(32, 20));
  LiveWire live(surface);
  live.seed({7});
  ASSERT_TRUE(live.wait());
  EXPECT_EQ(live.progress(), 1);
  const SnapGraph graph(*surface);
  for (const Follow follow : {Follow::kMin, Follow::kMax}) {
    const Embedding embedding = embed(*surface, metric_of(*surface, follow, {.parameter = 0.1}));
    const DistanceField field = ExactGeodesics(embedding.mesh).solve(7);
    for (const std::int32_t target : {7, 8, 100, 639}) {
      const LiveWires wires = live.wires({target});
      const LiveCandidate& got = wires.wires[follow == Follow::kMin ? 0 : 1];
      const Wire expected = trace_wire(*surface, embedding, field, target);
      EXPECT_EQ(got.follow, follow);
      EXPECT_TRUE(got.final);
      EXPECT_EQ(got.points, expected.points);
      EXPECT_EQ(got.faces, expected.faces);
      EXPECT_EQ(got.length, expected.length);
      EXPECT_EQ(got.vertices, snap_to_edges(*surface, graph, expected));
      EXPECT_EQ(wires.shorter, wires.wires[1].length < wires.wires[0].length ? 1 : 0);
    }
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
        const EdgeWires chains = edge_wires(
            make_edge_graph(*surface, metric_of(*surface, follow, kAlongEdges.strength)), seed, 3.0, forward);
        for (const Pick target : {Pick{100}, Pick{300, 301}, Pick{8}}) {
          const LiveCandidate got = live.wires(target).wires[follow == Follow::kMin ? 0 : 1];
          const EdgeChain expected = chains.trace(target);
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

TEST(LiveWire, TheLoopIsTheCheaperOfBothMetrics) {
  const auto surface = shared(shapes::torus(24, 16));
  LiveWire live(surface, kAlongEdges);
  ASSERT_TRUE(live.wait());  // loops need no seed
  for (const Edge& edge : {Edge{0, 1}, Edge{24, 0}, Edge{5, 29}}) {
    const EdgeChain loop = live.loop(edge);
    double least = std::numeric_limits<double>::infinity();
    for (const Follow follow : {Follow::kMin, Follow::kMax}) {
      const auto graph = make_edge_graph(*surface, metric_of(*surface, follow, kAlongEdges.strength));
      least = std::min(least, edge_loop(*graph, edge).length);
    }
    EXPECT_EQ(loop.length, least);
    EXPECT_GE(loop.vertices.size(), 3u);
  }
}

TEST(LiveWire, WhatIsNotReadyIsNotFinalAndHasNoPoints) {
  const auto surface = shared(shapes::torus(96, 64));
  LiveWire live(surface);
  live.seed({0});
  const auto start = std::chrono::steady_clock::now();
  LiveWires wires;
  do {
    const double progress = live.progress();
    EXPECT_GE(progress, 0);
    EXPECT_LE(progress, 1);
    wires = live.wires({3000});
    for (const LiveCandidate& wire : wires.wires) {
      EXPECT_EQ(wire.final, !wire.points.empty());
      EXPECT_EQ(wire.final, std::isfinite(wire.length));
    }
    if (wires.wires[0].final != wires.wires[1].final) {
      EXPECT_TRUE(wires.wires[static_cast<std::size_t>(wires.shorter)].final);
    }
    ASSERT_LT(Seconds(std::chrono::steady_clock::now() - start).count(), 60);
    std::this_thread::yield();
  } while (!wires.final());
}

TEST(LiveWire, TheNewestSeedCounts) {
  const auto surface = shared(shapes::torus(64, 48));
  for (const LiveWireOptions& options : {LiveWireOptions{}, kAlongEdges}) {
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
    LiveWire live(surface);
    live.seed({0});
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  }
}

TEST(LiveWire, WaitsNoLongerThanItIsTold) {
  const auto surface = shared(shapes::torus(200, 150));
  LiveWire live(surface);
  live.seed({0});
  const auto start = std::chrono::steady_clock::now();
  for (const double seconds : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e-3}) live.wait(seconds);
  EXPECT_LT(Seconds(std::chrono::steady_clock::now() - start).count(), 30) << "as if it had been told to wait forever";
  EXPECT_TRUE(live.wait(1e30));
}

TEST(LiveWire, AVertexWithoutAPathHasAFinalWireWithoutPoints) {
  shapes::Mesh mesh = shapes::grid(4);
  mesh.points.emplace_back(3, 3, 3);
  for (const LiveWireOptions& options : {LiveWireOptions{}, kAlongEdges}) {
    LiveWire live(shared(mesh), options);
    live.seed({0});
    ASSERT_TRUE(live.wait());
    const LiveWires wires = live.wires({25});
    EXPECT_TRUE(wires.final());
    for (const LiveCandidate& wire : wires.wires) {
      EXPECT_TRUE(wire.points.empty() && wire.vertices.empty());
      EXPECT_EQ(wire.length, std::numeric_limits<double>::infinity());
    }
    EXPECT_EQ(wires.shorter, 0);
  }
}

TEST(LiveWire, FindsTheRingsOfADenseMesh) {
  // Around one quad a chain turns four times; with q = 20 that is cheaper than the longer ring here.
  const int nu = 400, nv = 250;
  const auto surface = std::make_shared<const Surface>(shapes::quad_torus(nu, nv).surface());
  LiveWire live(surface, kAlongEdges);
  live.seed({0});
  ASSERT_TRUE(live.wait());
  EXPECT_EQ(live.loop({0, 1}).vertices.size(), nu);
  EXPECT_EQ(live.loop({0, nu}).vertices.size(), nv);
}

TEST(LiveWire, RefusesWhatIsNotPartOfTheSurface) {
  const auto surface = shared(shapes::grid(4));
  LiveWire across(surface), along(surface, kAlongEdges);
  EXPECT_THROW(across.wires({0}), InvalidInput) << "no seed";
  for (const Pick pick : {Pick{-1}, Pick{25}, Pick{0, 1}}) EXPECT_THROW(across.seed(pick), InvalidInput);
  for (const Pick pick : {Pick{-1}, Pick{25}, Pick{0, 2}, Pick{0, 99}}) EXPECT_THROW(along.seed(pick), InvalidInput);
  across.seed({0});
  along.seed({0});
  EXPECT_THROW(across.wires({25}), InvalidInput);
  EXPECT_THROW(across.wires({0, 1}), InvalidInput);
  EXPECT_THROW(along.wires({0, 2}), InvalidInput);
  EXPECT_THROW(along.loop({0, 2}), InvalidInput);
  EXPECT_THROW(across.loop({0, 1}), InvalidInput);
}

TEST(LiveWire, RefusesWrongOptions) {
  const auto surface = shared(shapes::grid(4));
  EXPECT_THROW(LiveWire(surface, {.strength = {}}), InvalidInput);
  EXPECT_THROW(LiveWire(surface, {.strength = {.parameter = -1}}), InvalidInput);
  EXPECT_THROW(LiveWire(surface, {.strength = {.parameter = 1, .max_anisotropy = 2}}), InvalidInput);
  EXPECT_THROW(LiveWire(surface, {.turning = -1}), InvalidInput);
  EXPECT_THROW(LiveWire(surface, {.loop_turning = std::numeric_limits<double>::quiet_NaN()}), InvalidInput);
}

TEST(LiveWire, WhatFailsOnAThreadIsThrownToTheCaller) {
  LiveWire live(shared(shapes::torus(16, 12)), {.strength = {.parameter = 1e308}});  // eigenvalues overflow
  EXPECT_THROW(live.wait(), InvalidInput);
  live.seed({0});
  EXPECT_THROW(live.wait(), InvalidInput);
  EXPECT_THROW(live.wires({1}), InvalidInput);
}

}  // namespace
}  // namespace seamwire
