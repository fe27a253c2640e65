// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closed cuts, and closed chains of edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "live/live_wires.hpp"
#include "live/live_worker.hpp"
#include "live/prepared_metrics.hpp"
#include "live/right_of_way.hpp"
#include "seamwire/edges/shortest_cycle.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/live/livewire.hpp"
#include "seamwire/wires/bent_wires.hpp"
#include "seamwire/wires/closed_wires.hpp"
#include "shapes.hpp"
#include "thread_sanitizer.hpp"

namespace seamwire {

using namespace detail;
using namespace live_wires;

namespace {

TEST(LiveWire, TheLoopIsTheCheaperOfBothMetrics) {
  const auto surface = shared(shapes::torus(24, 16));
  LiveWire live(surface, kAlongEdges);
  for (const Edge& edge : {Edge{0, 1}, Edge{24, 0}, Edge{5, 29}}) {  // loops need no seed
    live.loop(edge);
    ASSERT_TRUE(live.wait());
    const LiveLoop loop = live.loop(edge);
    ASSERT_TRUE(loop.final);
    double least = std::numeric_limits<double>::infinity();
    for (const Follow follow : {Follow::kMin, Follow::kMax}) {
      const auto graph = make_edge_graph(*surface, metric_of(*surface, follow, kEdgeStrength));
      least = std::min(least, shortest_cycle(*graph, edge)->length);
    }
    EXPECT_EQ(loop.length, least);
    EXPECT_GE(loop.vertices.size(), 3u);
  }
}

TEST(LiveWorker, AnswersNoOtherLoopThanTheOneAskedFor) {
  const SurfaceContext context(shared(shapes::torus(24, 16)));
  const auto metrics = [](const MetricSpec& spec) {
    return std::make_shared<MetricSet>(LiveMetrics{.wires = {spec}}, std::vector<Scribble>());
  };
  const auto right_of_way = std::make_shared<RightOfWay>();
  LiveSettings settings{.along = Along::kEdges, .turning = 3.0, .loop_turning = std::nullopt, .max_error = 0};
  LiveWorker edges(0, context, metrics(MetricSpec::euclidean()), settings, right_of_way);
  const Edge edge{0, 1}, other_edge{0, 24};
  edges.find_loop(edge);
  edges.wait_until_idle(std::nullopt);
  EXPECT_TRUE(edges.loop(edge));
  EXPECT_FALSE(edges.loop(other_edge)) << "another thread asked for the other one meanwhile";
  edges.change_metric(metrics(MetricSpec::concave()));
  EXPECT_FALSE(edges.loop(edge)) << "another thread changed the metric meanwhile";
  settings.along = Along::kSurface;
  LiveWorker surface(0, context, metrics(MetricSpec::euclidean()), settings, right_of_way);
  const WireEnd point = Pick{0}, other_point = Pick{5};
  surface.find_loop(point);
  surface.wait_until_idle(std::nullopt);
  EXPECT_FALSE(surface.closed_wires(point).cuts.empty());
  EXPECT_TRUE(surface.closed_wires(point).final);
  EXPECT_TRUE(surface.closed_wires(other_point).cuts.empty());
  EXPECT_FALSE(surface.closed_wires(other_point).final);
}

/// The closed wires of a concave LiveWire, made without one.
struct ClosedInBoth {
  explicit ClosedInBoth(std::shared_ptr<const Surface> of)
      : surface(std::move(of)), curvature(principal_curvatures(*surface)) {
    const Curvature smoothed = smoothed_curvatures(*surface, curvature, 0.01);
    embeddings[0] = embed(*surface, concave_metric(*surface, smoothed, 1.0), {.max_error = 0});
    embeddings[1] = embed(*surface, euclidean_metric(*surface, curvature), {.max_error = 0});
    for (const Embedding& embedding : embeddings) solvers.emplace_back(embedding.mesh);
  }
  std::vector<std::vector<ClosedWire>> closed(std::int32_t through) const {
    std::vector<std::vector<ClosedWire>> found;
    for (std::size_t i = 0; i < 2; ++i) {
      found.push_back(closed_wires(*surface, embeddings[i], solvers[i].solve(through)));
    }
    return found;
  }

  std::shared_ptr<const Surface> surface;
  Curvature curvature;
  std::array<Embedding, 2> embeddings;
  std::vector<ExactGeodesics> solvers;
};

/// Whether a cut's pieces lead around, from a vertex to it.
void expect_around(const LiveClosedWire& cut, std::size_t pieces, std::int32_t through) {
  ASSERT_EQ(cut.pieces.size(), pieces);
  ASSERT_EQ(cut.joints.size(), pieces - 1);
  for (std::size_t k = 0; k < pieces; ++k) {
    const LiveCandidate &piece = cut.pieces[k], &next = cut.pieces[(k + 1) % pieces];
    EXPECT_EQ(piece.points.back(), next.points.front());
    EXPECT_EQ(piece.faces.size() + 1, piece.points.size());
    EXPECT_EQ(piece.vertices.back(), next.vertices.front());
  }
  EXPECT_EQ(cut.pieces[0].vertices.front(), through);
}

TEST(LiveWire, TheSecondClosedWireIsTheFirstOfTheEuclideanMetric) {
  const auto surface = shared(shapes::bumpy(shapes::torus(40, 24), 0.03));
  LiveWire live(surface, kConcave);
  const ClosedInBoth both(surface);
  std::size_t of_second_metric = 0;
  for (const std::int32_t through : {0, 100, 350, 500, 900}) {  // without a seed, the newest counts
    live.closed_wires(SurfacePoint(7));
    live.closed_wires(SurfacePoint(through));
    ASSERT_TRUE(live.wait());
    const LiveClosedWires found = live.closed_wires(SurfacePoint(through));
    ASSERT_TRUE(found.final);
    const auto closed = both.closed(through);
    const std::vector<ClosedCutId> expected = choose_closed_wires(closed);
    ASSERT_EQ(found.cuts.size(), expected.size());
    ASSERT_FALSE(expected.empty());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const auto& [metric, number] = expected[i];
      EXPECT_EQ(found.cuts[i].length, closed[metric][number].wire.length);
      EXPECT_EQ(found.cuts[i].id, expected[i]);
      expect_around(found.cuts[i], 3, through);
      of_second_metric += metric;
    }
  }
  EXPECT_GT(of_second_metric, 0U) << "or this shows nothing";
}

TEST(LiveWire, TheClosedWiresOfTheFirstMetricAreThereBeforeThoseOfTheSecond) {
  const auto surface = shared(shapes::bumpy(shapes::torus(120, 80), 0.01));
  LiveWire live(surface, kConcave);
  live.wait();
  const SurfacePoint through = SurfacePoint(100);
  LiveClosedWires early = live.closed_wires(through);
  while (early.cuts.empty() && !early.final) {
    std::this_thread::yield();
    early = live.closed_wires(through);
  }
  ASSERT_FALSE(early.cuts.empty());
  if (early.final) GTEST_SKIP() << "this thread was kept away for so long that all of them are there";
  for (const LiveClosedWire& cut : early.cuts) EXPECT_EQ(cut.id.metric, 0U);
  live.wait();
  const LiveClosedWires late = live.closed_wires(through);
  ASSERT_TRUE(late.final);
  EXPECT_EQ(late.cuts[0].id, early.cuts[0].id);
  EXPECT_EQ(late.cuts[0].length, early.cuts[0].length);
}

TEST(LiveWire, ClosedWiresLeadThroughPointsOfTheSurface) {
  const auto surface = shared(shapes::torus(24, 16));
  LiveWire live(surface, kPlain), along_edges(surface, kAlongEdges);
  EXPECT_THROW(live.closed_wires(SurfacePoint(24 * 16)), InvalidInput);
  EXPECT_THROW(live.closed_wires({-1, {1, 0, 0}}), InvalidInput);
  EXPECT_THROW(along_edges.closed_wires(SurfacePoint(0)), InvalidInput);
}

TEST(LiveWire, AClosedWireIsBentToASecondPointInItsMetric) {
  const auto surface = shared(shapes::torus(40, 24));
  LiveWire live(surface, kConcave);
  const ClosedInBoth both(surface);
  const SurfacePoint through = SurfacePoint(100);
  const auto closed = both.closed(100);
  for (const std::size_t metric : {0U, 1U, 0U}) {
    ASSERT_FALSE(closed[metric].empty());
    const BentWires bent(surface, std::make_shared<const Embedding>(both.embeddings[metric]), both.solvers[metric],
                         both.solvers[metric].solve(100), closed[metric][0]);
    for (const std::int32_t vertex : {103, 420, 500}) {
      const SurfacePoint second = SurfacePoint(vertex);
      const ClosedCutId id{.metric = metric};
      live.bent_wire(through, SurfacePoint(7), id);  // the newest counts
      live.bent_wire(through, second, id);
      ASSERT_TRUE(live.wait());
      const LiveClosedWires found = live.bent_wire(through, second, id);
      ASSERT_TRUE(found.final);
      ASSERT_EQ(found.cuts.size(), 1U);
      const LiveClosedWire& cut = found.cuts[0];
      const std::optional<BentWire> expected = bent.through(second);
      ASSERT_TRUE(expected);
      EXPECT_EQ(cut.length, expected->there.length + expected->back.length);
      EXPECT_EQ(cut.id, id);
      expect_around(cut, 4, 100);
      EXPECT_EQ(cut.joints[1], second);
      EXPECT_EQ(cut.pieces[1].vertices.back(), vertex);
    }
  }
  for (const ClosedCutId& id :
       {ClosedCutId{0, closed[0].size()}, ClosedCutId{1, closed[1].size()}, ClosedCutId{2, 0}}) {
    live.bent_wire(through, SurfacePoint(420), id);
    ASSERT_TRUE(live.wait());
    const LiveClosedWires none = live.bent_wire(through, SurfacePoint(420), id);
    EXPECT_TRUE(none.final && none.cuts.empty()) << "there is no cut of that number";
  }
  EXPECT_THROW(live.bent_wire(through, SurfacePoint(40 * 24)), InvalidInput);
}

TEST(LiveWire, FindsTheRingsOfADenseMesh) {
  // Around one quad a chain turns four times; with q = 20 that is cheaper than the longer ring here.
  const int nu = 400, nv = 250;
  const auto surface = std::make_shared<const Surface>(shapes::quad_torus(nu, nv).surface());
  LiveWire live(surface, kAlongEdges);
  live.seed({0});
  ASSERT_TRUE(live.wait());
  for (const auto& [edge, size] : {std::pair{Edge{0, 1}, nu}, std::pair{Edge{0, nu}, nv}}) {
    live.loop(edge);
    ASSERT_TRUE(live.wait());
    EXPECT_EQ(live.loop(edge).vertices.size(), size);
  }
}

TEST(LiveWire, OfLoopsTheOneAskedForLastCounts) {
  const int nu = 60, nv = 40;
  const auto surface = std::make_shared<const Surface>(shapes::quad_torus(nu, nv).surface());
  LiveWire live(surface, kAlongEdges);
  for (std::int32_t v = 0; v < 200; ++v) {
    const LiveLoop early = live.loop({v, v + nu});
    EXPECT_EQ(early.final, !early.vertices.empty());
    if (v % 7 == 0) live.seed({v});  // goes first, and does not make the loop forgotten
  }
  ASSERT_TRUE(live.wait());
  const LiveLoop loop = live.loop({199 + nu, 199});  // an edge has no direction
  ASSERT_TRUE(loop.final);
  EXPECT_EQ(loop.vertices.size(), nv);
  EXPECT_TRUE(std::ranges::count(loop.vertices, 199));
  EXPECT_TRUE(live.wires({0}).final());
}

}  // namespace
}  // namespace seamwire
