// SPDX-License-Identifier: GPL-3.0-or-later
//
// Changes of the metrics and of the strokes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <thread>
#include <vector>

#include "context/interactive_embedding.hpp"
#include "live/live_wires.hpp"
#include "live/prepared_metrics.hpp"
#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/context/surface_context.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/live/livewire.hpp"
#include "seamwire/metric/scribble.hpp"
#include "shapes.hpp"

namespace seamwire {

using namespace detail;
using namespace live_wires;

namespace {

TEST(LiveWire, MetricsThatStayKeepTheirProgress) {
  const std::vector<MetricSpec> specs{MetricSpec::euclidean(), MetricSpec::concave()};
  const MetricSet former({.wires = specs}, {});
  *former.fractions[0] = 0.25;
  *former.fractions[1] = 0.75;
  const MetricSet later({.wires = {specs[0], MetricSpec::feature(Follow::kMin, {.parameter = 0.1}), specs[1]}}, {},
                        former);
  EXPECT_EQ(later.fraction(0), 0.25);
  EXPECT_EQ(later.fraction(1), 0.0);
  *later.fractions[0] = 0.875;
  EXPECT_EQ(former.fraction(0), 0.875) << "the work is that of both";
}

TEST(LiveWire, NoTwoThreadsPrepareOneMetric) {
  const MetricSpec one = MetricSpec::euclidean(), other = MetricSpec::concave();
  const MetricSet former({.wires = {one, other}}, {});
  const MetricSet later({.wires = {one, MetricSpec::feature(Follow::kMin), one, other}}, {}, former);
  EXPECT_EQ(later.prepared[0], former.prepared[0]);
  EXPECT_NE(later.prepared[2], former.prepared[0]) << "its thread may make way for the one that would wait";
  EXPECT_NE(later.prepared[3], former.prepared[1]);
  EXPECT_EQ(later.fraction(3), 0.0);
}

TEST(LiveWire, RefinesToTheSameErrorWhetherStrokesComeBeforeItsMetricsOrAfter) {
  const auto surface = shared(shapes::bumpy(shapes::torus(32, 20), 0.02));
  const SurfaceContext context(surface), other_context(surface);
  Scribble stroke{.points = {surface->points()[7], surface->points()[8]}, .faces = {}, .vertices = {7, 8}, .rings = 3};
  const LiveMetrics metrics{.wires = {MetricSpec::euclidean()}};
  MetricSet plain(metrics, {});
  const auto prepared_in = [&](const SurfaceContext& on, MetricSet& set) {
    return set.prepared[0]->get({}, [&](const Task&) { return prepare(on, Along::kSurface, set, 0, {}); });
  };
  const double length = prepared_in(context, plain)->embedded->embedding().mean_edge_length;
  MetricSet after(metrics, {stroke}, plain), before(metrics, {stroke});
  EXPECT_EQ(prepared_in(context, after)->embedded->embedding().mean_edge_length, length);
  EXPECT_EQ(prepared_in(other_context, before)->embedded->embedding().mean_edge_length, length);
  MetricSet taken_back(metrics, {}, before);
  EXPECT_EQ(prepared_in(other_context, taken_back)->embedded->embedding().mean_edge_length, length);
}

bool is_embedded(const SurfaceContext& context, const MetricSpec& spec) {
  return EmbeddedSurface::find(context, spec, interactive_options(*context.surface())).has_value();
}

TEST(LiveWire, AThreadNeverMakesWayWhileOthersMayWaitForIt) {
  const SurfaceContext context(shared(shapes::bumpy(shapes::torus(32, 20), 0.02)));
  const MetricSpec spec = MetricSpec::euclidean();
  MetricSet metrics({.wires = {spec}}, {});
  int made_way = 0, shown = 0;
  const PreparationSteps steps{.make_way =
                                   [&](const auto&) {
                                     ++made_way;
                                     EXPECT_FALSE(is_embedded(context, spec)) << "others wait for its geodesics";
                                   },
                               .preview = [&](const auto&, const auto&) { shown += is_embedded(context, spec); }};
  prepare(context, Along::kSurface, metrics, 0, {}, steps);
  EXPECT_GT(made_way, 0);
  EXPECT_GT(shown, 0) << "no step of the geodesics was seen";
}

TEST(LiveWire, AMetricThatComesFirstAsWellIsPrepared) {
  const std::size_t last = std::max(2U, std::thread::hardware_concurrency());  // the first thread that makes way
  std::vector<MetricSpec> specs;
  for (std::size_t i = 0; i <= last; ++i)
    specs.push_back(MetricSpec::concave({.parameter = 0.5 + 0.1 * static_cast<double>(i)}));
  LiveWire live(shared(shapes::bumpy(shapes::torus(90, 60), 0.02)), kConcave);
  live.set_metrics({.wires = specs});
  live.seed({7});
  live.wait(1e-3);
  specs.front() = specs.back();
  live.set_metrics({.wires = specs});
  EXPECT_TRUE(live.wait(60.0)) << "two threads wait for each other";
}

TEST(LiveWire, AnotherMetricIsThatOfALiveWireMadeWithIt) {
  const auto surface = shared(shapes::bumpy(shapes::torus(32, 20), 0.02));
  for (LiveWireOptions options : {kPlain, kAlongEdges}) {
    LiveWire live(surface, options);
    live.seed({7});
    const std::vector<LiveMetrics> all = {
        live_metrics(MetricFamily::kFeature, {.max_anisotropy = 20, .clamp_percentile = 95}, options.along),
        live_metrics(MetricFamily::kCampen, {.max_anisotropy = 5}),
        live_metrics(MetricFamily::kPottmannKovacs, {.max_anisotropy = 5}),
        live_metrics(MetricFamily::kConcave, {.max_anisotropy = 5}),
        live_metrics(MetricFamily::kEuclidean, {}),
        options.metrics};
    for (const LiveMetrics& metrics : all) {
      live.set_metrics(metrics);
      ASSERT_TRUE(live.wait());
      options.metrics = metrics;
      expect_equal(live.wires({333}), fresh_wires(surface, options, {7}, {333}));
    }
  }
}

TEST(LiveWire, OfConcaveCreasesTheFirstWireLeadsAndTheSecondIsTheShortestPath) {
  const auto surface = shared(shapes::bumpy(shapes::torus(32, 20), 0.02));
  const LiveWireOptions concave = in(MetricFamily::kConcave, {.parameter = 1.0});
  const LiveWires wires = fresh_wires(surface, concave, {7}, {333});
  const LiveWires shortest = fresh_wires(surface, in(MetricFamily::kEuclidean), {7}, {333});
  EXPECT_EQ(wires.wires[1].points, shortest.wires[0].points);
  const Metric metric = concave_metric(*surface, smoothed_curvatures(*surface, principal_curvatures(*surface), 0.01));
  const Embedding embedding = embed(*surface, metric, {.max_error = 0});
  EXPECT_NEAR(wires.wires[0].length, ExactGeodesics(embedding.mesh).solve(7).distances()[333], 1e-12);
  EXPECT_EQ(wires.active, 0);
  // Half as strong by either of the two; so strong that the second is shorter, the first leads all the same.
  const LiveWireOptions half = in(MetricFamily::kConcave, {.parameter = 0.5});
  const LiveWireOptions same = in(MetricFamily::kConcave, {.max_anisotropy = 10.5});
  expect_equal(fresh_wires(surface, half, {7}, {333}), fresh_wires(surface, same, {7}, {333}));
  const LiveWireOptions strong = in(MetricFamily::kConcave, {.parameter = 50.0});
  EXPECT_EQ(fresh_wires(surface, strong, {7}, {333}).active, 0);
}

TEST(LiveWire, OfTheEuclideanMetricThereIsOneWire) {
  const auto surface = shared(shapes::torus(24, 16));
  for (const Along along : {Along::kSurface, Along::kEdges}) {
    LiveWire live(surface, in(MetricFamily::kEuclidean, {}, along));
    live.seed({0});
    ASSERT_TRUE(live.wait());
    const LiveWires found = live.wires({100});
    ASSERT_EQ(found.wires.size(), 1U);
    EXPECT_TRUE(found.final() && found.settled);
    EXPECT_EQ(found.active, 0);
    EXPECT_EQ(live.embeddings().size(), 1U);
    EXPECT_EQ(live.progress(), 1.0);
    if (along == Along::kEdges) {
      live.loop({0, 1});
      ASSERT_TRUE(live.wait());
      EXPECT_FALSE(live.loop({0, 1}).vertices.empty());
    }
    live.set_metrics(live_metrics(MetricFamily::kFeature, {.max_anisotropy = 10.0}, along));
    ASSERT_TRUE(live.wait());
    EXPECT_GT(live.wires({100}).wires.size(), 1U);
  }
  EXPECT_THROW(LiveWire(std::shared_ptr<const Surface>()), InvalidInput);
}

TEST(LiveWire, WhileTheMetricChangesTheWiresAreTheFormerOnesAndNotFinal) {
  const auto surface = shared(shapes::torus(160, 120));
  LiveWire live(surface, kPlain);
  live.seed({0});
  ASSERT_TRUE(live.wait());
  live.wires({900});
  ASSERT_TRUE(live.wait());  // for the newest target
  const LiveWires before = live.wires({900});
  EXPECT_TRUE(before.final());
  live.set_metrics(live_metrics(MetricFamily::kFeature, {.max_anisotropy = 8}));
  LiveWires now = live.wires({900});
  EXPECT_FALSE(now.final());
  for (std::size_t which = 0; which < 2; ++which) {
    while (!now.wires[which].final && now.wires[which].points.empty()) now = live.wires({900});
    if (now.wires[which].final) continue;
    EXPECT_EQ(now.wires[which].points, before.wires[which].points);
  }
  live.seed({5});  // the former metric's wires are from the former seed
  for (const LiveCandidate& wire : live.wires({900}).wires) EXPECT_TRUE(wire.final || wire.points.empty());
  ASSERT_TRUE(live.wait());
  EXPECT_TRUE(live.wires({900}).final());
}

TEST(LiveWire, OfMetricsTheOneSetLastCounts) {
  const auto surface = shared(shapes::bumpy(shapes::torus(48, 32), 0.02));
  LiveWireOptions options = kAlongEdges;
  LiveWire live(surface, options);
  live.seed({7});
  for (int i = 0; i < 100; ++i) {
    options.metrics = live_metrics(MetricFamily::kFeature, {.max_anisotropy = 2 + 0.1 * i}, Along::kEdges);
    live.set_metrics(options.metrics);
    if (i % 10 == 0) live.wait(0.002);
  }
  ASSERT_TRUE(live.wait());
  expect_equal(live.wires({777}), fresh_wires(surface, options, {7}, {777}));
}

TEST(LiveWire, ScribblesChangeTheMetricsTheyAreMeantForAndGoWithoutATrace) {
  const auto surface = shared(shapes::grid(40));
  Scribble scribble;
  scribble.points = {{0.1, 0.2, 0}, {0.5, 0.4, 0}, {0.9, 0.2, 0}};
  for (const Vector& p : scribble.points) {
    scribble.vertices.push_back(static_cast<std::int32_t>(std::lround(p.y() * 40) * 41 + std::lround(p.x() * 40)));
  }
  scribble.acts_on = MetricKind::kMin;
  const Pick from{scribble.vertices.front()}, to{scribble.vertices.back()};
  for (const LiveWireOptions& options : {kPlain, kAlongEdges}) {
    LiveWire live(surface, options);
    live.seed(from);
    ASSERT_TRUE(live.wait());
    const LiveWires before = live.wires(to);
    live.set_scribbles({scribble});
    const LiveWires meanwhile = live.wires(to);
    ASSERT_TRUE(live.wait());
    const LiveWires after = live.wires(to);
    ASSERT_TRUE(after.final());
    const std::size_t min = options.along == Along::kEdges ? 0 : 1, max = min + 1;
    if (meanwhile.wires[min].final) {
      EXPECT_EQ(meanwhile.wires[min].points, after.wires[min].points)
          << "what is said to be final is of the new metric";
    }
    EXPECT_EQ(after.wires[max].points, before.wires[max].points);
    const Strength strength = options.along == Along::kEdges ? kEdgeStrength : Strength{.parameter = 0.1};
    const Metric metric =
        apply_scribbles(*surface, metric_of(*surface, Follow::kMin, strength), std::vector{scribble}, MetricKind::kMin);
    if (options.along == Along::kEdges) {
      const auto graph = make_edge_graph(*surface, metric, nullptr, std::vector{scribble}, MetricKind::kMin);
      EXPECT_EQ(after.wires[min].vertices, edge_wires(graph, from).trace(to)->vertices);
    } else {
      const Embedding embedding = embed(*surface, metric, {.max_error = 0});
      const DistanceField field = ExactGeodesics(embedding.mesh).solve(from.a);
      EXPECT_EQ(after.wires[min].points, trace_wire(*surface, embedding, field, to.a)->points);
      const bool bends = std::ranges::any_of(after.wires[min].points, [](const Vector& p) { return p.y() > 0.35; });
      EXPECT_TRUE(bends) << "as the stroke does";
    }
    live.set_metrics(live_metrics(MetricFamily::kFeature, {.max_anisotropy = 3}, options.along));  // scribbles stay
    ASSERT_TRUE(live.wait());
    EXPECT_EQ(live.wires(to).wires[max].points, before.wires[max].points) << "a plane has no features";
    EXPECT_EQ(live.wires(to).wires[min].length, after.wires[min].length);
    live.set_metrics(options.metrics);
    live.set_scribbles({});
    ASSERT_TRUE(live.wait());
    expect_equal(live.wires(to), before);
    live.set_scribbles({});
    EXPECT_TRUE(live.wires(to).final()) << "nothing has changed";

    Scribble off = scribble;
    off.vertices[1] = 41 * 41;
    live.set_scribbles({off});
    EXPECT_THROW(live.wait(), InvalidInput);
  }
}

TEST(LiveWire, AStrokeForOneMetricLeavesWhatIsPreparedForTheOther) {
  constexpr std::size_t kConcaveOne = 0, kMinOne = 1, kMaxOne = 2;
  Scribble one, two;
  one.acts_on = two.acts_on = MetricKind::kMin;
  two.rings = 3;
  const LiveMetrics metrics = live_metrics(MetricFamily::kFeature, {.parameter = 0.1});
  const auto after = [&](const MetricSet& before, const std::vector<Scribble>& scribbles) {
    return std::make_unique<MetricSet>(metrics, scribbles, before);
  };
  const MetricSet none(metrics, {});
  const auto with_one = after(none, {one}), with_both = after(*with_one, {one, two});
  EXPECT_TRUE(with_one->shares(none, kMaxOne));
  EXPECT_FALSE(with_one->shares(none, kMinOne));
  EXPECT_TRUE(with_both->shares(none, kMaxOne));
  EXPECT_FALSE(with_both->shares(*with_one, kMinOne));
  EXPECT_FALSE(after(*with_both, {two, one})->shares(*with_both, kMinOne)) << "their order counts";
  Scribble three;
  three.acts_on = MetricKind::kMax;
  const auto with_three = after(*with_both, {three, one, two});
  EXPECT_TRUE(with_three->shares(*with_both, kMinOne));
  EXPECT_FALSE(with_three->shares(*with_both, kMaxOne));
  EXPECT_TRUE(with_three->shares(none, kConcaveOne));
}

TEST(LiveWire, MetricsThatStayAreNotPreparedAgain) {
  const LiveMetrics metrics{.wires = {MetricSpec::concave(), MetricSpec::euclidean()}};
  const MetricSet before(metrics, {});
  before.prepared[1]->get({}, [&](const Task&) {
    return Prepared{.spec = metrics.wires[1], .surface = nullptr, .embedded = std::nullopt, .graph = nullptr};
  });
  const MetricSet changed({.wires = {MetricSpec::euclidean(), MetricSpec::concave({.parameter = 0.5})}}, {}, before);
  EXPECT_EQ(changed.prepared[0], before.prepared[1]);
  EXPECT_NE(changed.prepared[1], before.prepared[0]);
}

TEST(LiveWire, WiresInMetricsThatAnotherOneHasAreTheSame) {
  const SurfaceContext context(shared(shapes::bumpy(shapes::torus(32, 20), 0.02)));
  LiveWire live(context, kPlain);
  LiveWire cuts(context, {.metrics = {.wires = {MetricSpec::concave(), MetricSpec::euclidean()}}, .max_error = 0});
  for (LiveWire* each : {&live, &cuts}) {
    each->seed({7});
    ASSERT_TRUE(each->wait());
  }
  EXPECT_EQ(cuts.wires({333}).wires[0].points, live.wires({333}).wires[0].points);
  EXPECT_EQ(cuts.wires({333}).wires[0].length, live.wires({333}).wires[0].length);
}

TEST(LiveWire, AfterManyChangesOfTheStrokesWiresAreThoseOfTheListAlone) {
  const auto surface = shared(shapes::bumpy(shapes::torus(40, 24), 0.02));
  std::mt19937 random(3);
  const auto stroke = [&] {
    Scribble scribble;
    auto v = static_cast<std::int32_t>(random() % surface->vertex_count());
    for (int i = 0; i < 12; ++i) {
      scribble.vertices.push_back(v);
      scribble.points.push_back(surface->points()[static_cast<std::size_t>(v)]);
      v = (v + (i % 3 == 0 ? 40 : 1)) % 960;
    }
    scribble.rings = 1 + static_cast<int>(random() % 6);
    scribble.attracts = random() % 4 != 0;
    if (random() % 2 == 0) scribble.acts_on = static_cast<MetricKind>(random() % 3);
    return scribble;
  };
  LiveWire live(surface, kPlain);
  live.seed({7});
  ASSERT_TRUE(live.wait());
  std::vector<Scribble> strokes;
  for (int i = 0; i < 30; ++i) {
    const std::size_t at = strokes.empty() ? 0 : random() % strokes.size();
    if (random() % 3 > 0 || strokes.empty()) {
      strokes.insert(strokes.begin() + static_cast<std::ptrdiff_t>(at), stroke());
    } else if (random() % 2 == 0) {
      strokes.erase(strokes.begin() + static_cast<std::ptrdiff_t>(at));
    } else {
      std::swap(strokes[at], strokes.front());
    }
    live.set_scribbles(strokes);
    if (i % 3 != 2) continue;  // the others are replaced while they are being worked on
    ASSERT_TRUE(live.wait());
    LiveWire fresh(surface, kPlain);
    fresh.set_scribbles(strokes);
    fresh.seed({7});
    ASSERT_TRUE(fresh.wait());
    const LiveWires is = live.wires({333}), expected = fresh.wires({333});
    EXPECT_EQ(is.active, expected.active);
    for (std::size_t which = 0; which < 3; ++which) {
      // Triangles may have other numbers, so sums are in another order.
      EXPECT_NEAR(is.wires[which].length, expected.wires[which].length, 1e-12);
      ASSERT_EQ(is.wires[which].points.size(), expected.wires[which].points.size());
      for (std::size_t k = 0; k < is.wires[which].points.size(); ++k) {
        EXPECT_NEAR((is.wires[which].points[k] - expected.wires[which].points[k]).norm(), 0, 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace seamwire
