// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <limits>
#include <memory>
#include <thread>
#include <vector>

#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/live/livewire.hpp"
#include "shapes.hpp"
#include "thread_sanitizer.hpp"
#include "wires/local_wires.hpp"

namespace seamwire {

using namespace detail;

namespace {

const LiveWireOptions kUnrefined{.max_error = 0};

std::shared_ptr<const Surface> bumpy_torus() {
  const shapes::Mesh mesh = shapes::bumpy(shapes::torus(32, 20), 0.02);
  return std::make_shared<const Surface>(mesh.points, mesh.triangles);
}

/// Asks for the wires to a target and waits for them.
LiveWires final_wires(const LiveWire& live, std::int32_t target) {
  live.wires({target});
  EXPECT_TRUE(live.wait());
  return live.wires({target});
}

void expect_equal(const LiveWires& got, const LiveWires& expected) {
  EXPECT_EQ(got.active, expected.active);
  ASSERT_EQ(got.wires.size(), expected.wires.size());
  for (std::size_t i = 0; i < got.wires.size(); ++i) {
    EXPECT_EQ(got.wires[i].points, expected.wires[i].points);
    EXPECT_EQ(got.wires[i].vertices, expected.wires[i].vertices);
    EXPECT_EQ(got.wires[i].length, expected.wires[i].length);
  }
}

TEST(LiveRefinement, WiresAreFinalOnceTheyAreRefinedAndNotBefore) {
  const auto surface = bumpy_torus();
  LiveWire live(surface), plain(surface, kUnrefined);
  live.seed({7});
  plain.seed({7});
  ASSERT_TRUE(live.wait());
  ASSERT_TRUE(plain.wait());
  const Metric metric =
      feature_metric(*surface, principal_curvatures(*surface), Follow::kMin, Strength{.parameter = 0.1});
  const Embedding embedding = embed(*surface, metric, {.max_error = 0});
  const DistanceField field = ExactGeodesics(embedding.mesh).solve(7);
  bool differs = false;
  for (const std::int32_t target : {100, 333, 639}) {
    const LiveWires early = live.wires({target});
    for (std::size_t i = 0; i < early.wires.size(); ++i) {
      if (early.wires[i].final) continue;
      EXPECT_EQ(early.wires[i].points, plain.wires({target}).wires[i].points) << "first that of the whole embedding";
    }
    EXPECT_TRUE(plain.wires({target}).final());
    const LiveWires late = final_wires(live, target);
    EXPECT_TRUE(late.final() && late.settled);
    const std::optional<Wire> expected =
        refined_wire(surface, metric, trace_wire(*surface, embedding, field, target).value(), SurfacePoint(7),
                     SurfacePoint(target), {.max_error = 0.01, .mean_edge_length = embedding.mean_edge_length}, {});
    ASSERT_TRUE(expected);
    const auto is_refined = [&](const LiveCandidate& wire) { return wire.points == expected->points; };
    EXPECT_TRUE(std::ranges::any_of(late.wires, is_refined)) << "that in M_min";
    for (const LiveCandidate& wire : late.wires) {
      EXPECT_EQ(wire.vertices.front(), 7);
      EXPECT_EQ(wire.vertices.back(), target);
      EXPECT_EQ(wire.faces.size() + 1, wire.points.size());
    }
    for (std::size_t i = 0; i < late.wires.size(); ++i) {
      differs = differs || late.wires[i].length != early.wires[i].length;
    }
  }
  EXPECT_TRUE(differs);
}

TEST(LiveRefinement, OfTargetsTheNewestIsRefined) {
  const auto surface = bumpy_torus();
  LiveWire live(surface);
  live.seed({7});
  ASSERT_TRUE(live.wait());
  for (std::int32_t target = 50; target < 150; ++target) {
    live.wires({target});
    if (target % 10 == 0) live.wait(0.001);
  }
  const LiveWires last = final_wires(live, 149);
  EXPECT_TRUE(last.final());
  LiveWire fresh(surface);
  fresh.seed({7});
  expect_equal(last, final_wires(fresh, 149));
  // The other thread may have refined before the answer is read, if this one has to wait for the processor in between.
  // An answer that was kept would be final every time.
  bool is_anew = false;
  for (int i = 0; i < 100 && !is_anew; ++i) {
    is_anew = !live.wires({100}).final();
    final_wires(live, 149);
  }
  EXPECT_TRUE(is_anew) << "asked for anew";
}

TEST(LiveRefinement, ANewTargetOrSeedDoesNotWaitForARefinement) {
  if (sized(false, true)) GTEST_SKIP() << "takes minutes under ThreadSanitizer";
  const shapes::Mesh mesh = shapes::bumpy(shapes::torus(300, 200), 0.002);
  const auto surface = std::make_shared<const Surface>(mesh.points, mesh.triangles);
  LiveWire live(surface, {.max_error = 0.0002});
  live.seed({0});
  ASSERT_TRUE(live.wait());
  // Processor time of all threads: the same work on a busy machine.
  const std::clock_t start = std::clock();
  final_wires(live, 30100);
  const std::clock_t one = std::clock() - start;
  const std::clock_t again = std::clock();
  for (std::int32_t target = 30101; target < 30121; ++target) {
    live.wires({target});
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  live.wires({300});
  ASSERT_TRUE(live.wait());
  const std::clock_t twenty = std::clock() - again;
  EXPECT_LT(twenty, 10 * one) << "as if all of them had been refined";
}

TEST(LiveRefinement, ATargetWithoutAWireIsFinal) {
  shapes::Mesh mesh = shapes::grid(4);
  mesh.points.emplace_back(3, 3, 3);
  LiveWire live(std::make_shared<const Surface>(mesh.points, mesh.triangles));
  live.seed({0});
  const LiveWires none = final_wires(live, 25);
  EXPECT_TRUE(none.final());
  for (const LiveCandidate& wire : none.wires) {
    EXPECT_TRUE(wire.points.empty() && wire.vertices.empty());
    EXPECT_EQ(wire.length, std::numeric_limits<double>::infinity());
  }
  const LiveWires itself = final_wires(live, 0);
  EXPECT_TRUE(itself.final());
  EXPECT_EQ(itself.wires[0].points.size(), 1U);
}

TEST(LiveRefinement, AlongEdgesNothingChanges) {
  const auto surface = bumpy_torus();
  LiveWire live(surface, {.along = Along::kEdges}), plain(surface, {.along = Along::kEdges, .max_error = 0});
  for (LiveWire* each : {&live, &plain}) {
    each->seed({7});
    ASSERT_TRUE(each->wait());
  }
  for (const std::int32_t target : {100, 333}) {
    EXPECT_TRUE(live.wires({target}).final()) << "at once";
    expect_equal(live.wires({target}), plain.wires({target}));
  }
}

TEST(LiveRefinement, StrokesRefineTheWireInTheNewMetric) {
  const auto surface = bumpy_torus();
  Scribble scribble;
  for (std::int32_t v = 100; v < 110; ++v) {
    scribble.vertices.push_back(v);
    scribble.points.push_back(surface->points()[static_cast<std::size_t>(v)]);
  }
  LiveWire live(surface);
  live.seed({7});
  const LiveWires before = final_wires(live, 333);
  live.set_scribbles({scribble});
  EXPECT_FALSE(live.wires({333}).final());
  const LiveWires after = final_wires(live, 333);
  EXPECT_TRUE(after.final());
  live.set_scribbles({});
  const LiveWires again = final_wires(live, 333);
  for (std::size_t i = 0; i < again.wires.size(); ++i) {
    EXPECT_NE(after.wires[i].length, before.wires[i].length);
    // Triangles of the whole embedding may have other numbers, so sums are in another order.
    EXPECT_NEAR(again.wires[i].length, before.wires[i].length, 1e-9);
  }
}

TEST(LiveRefinement, EndsInTheMiddleOfIt) {
  const auto surface = bumpy_torus();
  for (const int milliseconds : {0, 1, 5}) {
    LiveWire live(surface);
    live.seed({0});
    live.wait();
    live.wires({333});
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  }
}

TEST(LiveRefinement, RefusesAnErrorThatIsNone) {
  const auto surface = bumpy_torus();
  for (const double wrong : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(LiveWire(surface, {.max_error = wrong}), InvalidInput);
  }
}

}  // namespace
}  // namespace seamwire
