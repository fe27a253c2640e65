// SPDX-License-Identifier: GPL-3.0-or-later
//
// One live wire that several threads use at once.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "seamwire/live/livewire.hpp"
#include "shapes.hpp"

namespace seamwire {
namespace {

std::shared_ptr<const Surface> some_surface() {
  const shapes::Mesh mesh = shapes::bumpy(shapes::torus(24, 16), 0.02);
  return std::make_shared<const Surface>(mesh.points, mesh.triangles);
}

LiveMetrics metrics_of(int number, Along along) {
  switch (number % 4) {
    case 0:
      return live_metrics(MetricFamily::kFeature, {.max_anisotropy = 3.0 + number}, along);
    case 1:
      return live_metrics(MetricFamily::kConcave, {.max_anisotropy = 2.0 + number}, along);
    case 2:
      return live_metrics(MetricFamily::kCampen, {.max_anisotropy = 4.0}, along);
    default:
      return live_metrics(MetricFamily::kEuclidean, {}, along);
  }
}

Scribble stroke_on(const Surface& surface, std::int32_t from) {
  Scribble stroke;
  for (std::int32_t v = from; v < from + 4; ++v) {
    stroke.vertices.push_back(v);
    stroke.points.push_back(surface.points()[static_cast<std::size_t>(v)]);
  }
  stroke.rings = 2;
  return stroke;
}

/// Calls each of some functions over and over on a separate thread, `times` times, with the number of the call.
void call_at_once(const std::vector<std::function<void(int)>>& functions, int times) {
  std::vector<std::jthread> threads;
  for (const auto& function : functions) {
    threads.emplace_back([&function, times] {
      for (int i = 0; i < times; ++i) function(i);
    });
  }
}

void expect_as_fresh(LiveWire& live, const std::shared_ptr<const Surface>& surface, const LiveWireOptions& options) {
  live.set_scribbles({});
  live.set_metrics(options.metrics);
  live.seed({5});
  live.wires({100});
  ASSERT_TRUE(live.wait());
  LiveWire fresh(surface, options);
  fresh.seed({5});
  fresh.wires({100});
  ASSERT_TRUE(fresh.wait());
  const LiveWires got = live.wires({100}), expected = fresh.wires({100});
  EXPECT_TRUE(got.final() && got.settled);
  EXPECT_EQ(got.active, expected.active);
  ASSERT_EQ(got.wires.size(), expected.wires.size());
  for (std::size_t i = 0; i < got.wires.size(); ++i) {
    EXPECT_EQ(got.wires[i].metric, expected.wires[i].metric);
    EXPECT_NEAR(got.wires[i].length, expected.wires[i].length, 1e-12);
  }
}

class LiveWireForThreads : public testing::TestWithParam<Along> {};

TEST_P(LiveWireForThreads, AnswersAllOfThemAndEndsWithWhatWasSetLast) {
  const auto surface = some_surface();
  const LiveWireOptions options{.along = GetParam(), .max_error = 0.0};
  LiveWire live(surface, options);
  live.seed({1});
  const auto change_metrics = [&](int i) { live.set_metrics(metrics_of(i, GetParam())); };
  const auto change_strokes = [&](int i) {
    live.set_scribbles(i % 3 == 0 ? std::vector<Scribble>() : std::vector{stroke_on(*surface, 10 * (i % 5))});
  };
  const auto seed = [&](int i) { live.seed({i % 40}); };
  const auto ask = [&](int i) {
    const LiveWires found = live.wires({50 + i % 50});
    EXPECT_LT(static_cast<std::size_t>(found.active), found.wires.size());
    for (const LiveCandidate& wire : found.wires) {
      EXPECT_TRUE(!wire.final || wire.vertices.empty() || wire.vertices.back() == 50 + i % 50);
    }
  };
  const auto look = [&](int i) {
    EXPECT_GE(live.progress(), 0.0);
    EXPECT_FALSE(live.embeddings().empty());
    EXPECT_EQ(live.surface(), surface);
    if (GetParam() == Along::kEdges) {
      live.loop({i % 20, i % 20 + 1});
    } else {
      live.closed_wires(SurfacePoint(i % 20));
    }
    live.wait(0.001);
  };
  const auto copy = [&](int i) {
    if (i % 10 == 0) live.fork().seed({3});
  };
  call_at_once({change_metrics, change_strokes, seed, ask, ask, look, copy}, 40);
  expect_as_fresh(live, surface, options);
}

INSTANTIATE_TEST_SUITE_P(Along, LiveWireForThreads, testing::Values(Along::kSurface, Along::kEdges));

TEST(LiveWireMetrics, ListsOfMetricsMayGrowAndShrink) {
  const auto surface = some_surface();
  LiveWire live(surface, {.metrics = live_metrics(MetricFamily::kEuclidean, {}), .max_error = 0.0});
  live.seed({5});
  LiveMetrics many;
  for (const double strength : {0.25, 0.5, 0.75, 1.0, 1.25}) {
    many.wires.push_back(MetricSpec::concave({.parameter = strength}));
  }
  many.wires.push_back(MetricSpec::euclidean());
  live.set_metrics(many);
  ASSERT_TRUE(live.wait());
  const LiveWires found = live.wires({100});
  ASSERT_EQ(found.wires.size(), 6U);
  EXPECT_TRUE(found.final());
  EXPECT_EQ(found.active, 0);
  for (const LiveCandidate& wire : found.wires) EXPECT_EQ(wire.vertices.back(), 100);
  live.set_metrics({.wires = {many.wires[3], many.wires[5]}, .cuts = {1, 0}});
  ASSERT_TRUE(live.wait());
  EXPECT_EQ(live.wires({100}).wires.size(), 2U);
  EXPECT_EQ(live.wires({100}).wires[1].points, found.wires[5].points);
  EXPECT_THROW(live.set_metrics({}), InvalidInput);
  EXPECT_THROW(live.set_metrics({.wires = {MetricSpec::euclidean()}, .cuts = {1}}), InvalidInput);
  EXPECT_THROW(live.set_metrics({.wires = {MetricSpec::euclidean()}, .cuts = {}}), InvalidInput);
}

}  // namespace
}  // namespace seamwire
