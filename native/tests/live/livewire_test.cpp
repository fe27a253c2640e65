// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/live/livewire.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "live/live_worker.hpp"
#include "live/prepared_metrics.hpp"
#include "seamwire/edges/shortest_cycle.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/wires/bent_wires.hpp"
#include "seamwire/wires/closed_wires.hpp"
#include "shapes.hpp"
#include "thread_sanitizer.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Seconds = std::chrono::duration<double>;

std::shared_ptr<const Surface> shared(const shapes::Mesh& mesh) {
  return std::make_shared<const Surface>(mesh.points, mesh.triangles);
}

Metric metric_of(const Surface& surface, Follow follow, const Strength& strength) {
  return feature_metric(surface, principal_curvatures(surface), follow, strength);
}

/// Wires are final in the embedding of the whole surface (live_refinement_test.cpp has the others).
const LiveWireOptions kPlain = {.max_error = 0.0};

const Strength kEdgeStrength = {.max_anisotropy = 10, .clamp_percentile = 99};
const LiveWireOptions kAlongEdges = {.along = Along::kEdges,
                                     .metrics = live_metrics(MetricFamily::kFeature, kEdgeStrength, Along::kEdges)};

LiveWireOptions in(MetricFamily family, const Strength& strength = {}, Along along = Along::kSurface) {
  return {.along = along, .metrics = live_metrics(family, strength, along), .max_error = 0.0};
}

const LiveWireOptions kConcave = in(MetricFamily::kConcave, {.parameter = 1.0});

/// Both wires to a vertex from a live wire that has just been made.
LiveWires fresh_wires(const std::shared_ptr<const Surface>& surface, const LiveWireOptions& options, const Pick& from,
                      const Pick& to) {
  LiveWireOptions plain = options;
  plain.max_error = 0.0;
  LiveWire live(surface, plain);
  live.seed(from);
  live.wait();
  return live.wires(to);
}

void expect_equal(const LiveWires& got, const LiveWires& expected) {
  EXPECT_TRUE(got.final());
  EXPECT_TRUE(got.settled);
  EXPECT_EQ(got.active, expected.active);
  ASSERT_EQ(got.wires.size(), expected.wires.size());
  for (std::size_t which = 0; which < got.wires.size(); ++which) {
    EXPECT_EQ(got.wires[which].points, expected.wires[which].points);
    EXPECT_EQ(got.wires[which].vertices, expected.wires[which].vertices);
    EXPECT_EQ(got.wires[which].length, expected.wires[which].length);
  }
}

/// The kinds of metrics that a live wire across the surface has if it is told nothing.
constexpr std::array kKinds = {MetricKind::kConcave, MetricKind::kMin, MetricKind::kMax};

/// In the library's default strength.
Metric default_metric_of(const Surface& surface, MetricKind kind) {
  if (kind != MetricKind::kConcave) {
    return metric_of(surface, kind == MetricKind::kMin ? Follow::kMin : Follow::kMax, {.parameter = 0.1});
  }
  return concave_metric(surface, smoothed_curvatures(surface, principal_curvatures(surface), 0.01));
}

TEST(LiveWire, AcrossTheSurfaceGivesTheGeodesicsOfThreeMetricsAndTheConcaveOneLeads) {
  const auto surface = shared(shapes::bumpy(shapes::torus(32, 20), 0.02));
  LiveWire live(surface, kPlain);
  live.seed({7});
  ASSERT_TRUE(live.wait());
  EXPECT_EQ(live.progress(), 1);
  const SnapGraph graph(*surface);
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    const Embedding embedding = embed(*surface, default_metric_of(*surface, kKinds[i]));
    const DistanceField field = ExactGeodesics(embedding.mesh).solve(7);
    for (const std::int32_t target : {7, 8, 100, 639}) {
      const LiveWires wires = live.wires({target});
      ASSERT_EQ(wires.wires.size(), 3U);
      const LiveCandidate& got = wires.wires[i];
      const Wire expected = trace_wire(*surface, embedding, field, target);
      EXPECT_EQ(got.metric.kind(), kKinds[i]);
      EXPECT_TRUE(got.final);
      EXPECT_EQ(got.points, expected.points);
      EXPECT_EQ(got.faces, expected.faces);
      EXPECT_EQ(got.length, expected.length);
      EXPECT_EQ(got.vertices, snap_to_edges(*surface, graph, expected));
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
  RightOfWay right_of_way;
  right_of_way.wait({});  // nobody has it
  right_of_way.set_busy(true);
  std::stop_source stop;
  std::atomic<int> through = 0;
  std::jthread stopped([&] {
    right_of_way.wait(stop.get_token());
    ++through;
  });
  std::jthread patient([&] {
    right_of_way.wait({});
    through += 10;
  });
  EXPECT_EQ(through, 0);
  stop.request_stop();
  stopped.join();
  EXPECT_EQ(through, 1);
  right_of_way.set_busy(false);
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
  const SurfacePoint seed{.face = 40, .barycentric = {0.2, 0.5, 0.3}};
  LiveWire live(surface, kPlain);
  live.seed_at(seed);
  ASSERT_TRUE(live.wait());
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    const auto shared_embedding =
        std::make_shared<const Embedding>(embed(*surface, default_metric_of(*surface, kKinds[i])));
    const Embedding& embedding = *shared_embedding;
    const EmbeddedPoints points(surface, shared_embedding);
    const DistanceField field = ExactGeodesics(embedding.mesh).solve(std::array{*points.find(seed)});
    const std::array targets{SurfacePoint{.face = 40, .barycentric = {0.6, 0.1, 0.3}},
                             SurfacePoint{.face = 900, .barycentric = {0.1, 0.8, 0.1}},
                             SurfacePoint{.face = 517, .barycentric = {0.0, 0.4, 0.6}},
                             SurfacePoint{.face = 3, .barycentric = {0.0, 1.0, 0.0}}, SurfacePoint::at_vertex(100)};
    for (const SurfacePoint& target : targets) {
      const LiveCandidate got = live.wires_to(target).wires[i];
      const Wire expected = trace_wire(*surface, embedding, field, *points.find(target));
      EXPECT_TRUE(got.final);
      EXPECT_EQ(got.points, expected.points);
      EXPECT_EQ(got.faces, expected.faces);
      EXPECT_EQ(got.length, expected.length);
      ASSERT_FALSE(got.vertices.empty());
      EXPECT_EQ(got.vertices.front(), nearest_corner(*surface, seed));
      EXPECT_EQ(got.vertices.back(), target.vertex >= 0 ? target.vertex : nearest_corner(*surface, target));
    }
  }
  EXPECT_EQ(live.wires_to(SurfacePoint::at_vertex(100)).wires[0].points, live.wires({100}).wires[0].points);
  live.seed_at(SurfacePoint::at_vertex(7));
  ASSERT_TRUE(live.wait());
  expect_equal(live.wires({100}), fresh_wires(surface, kPlain, {7}, {100}));
}

TEST(LiveWire, AlongEdgesAPointAtAVertexIsThatVertex) {
  const auto surface = shared(shapes::torus(8, 6));
  LiveWire live(surface, kAlongEdges);
  live.seed_at(SurfacePoint::at_vertex(3));
  ASSERT_TRUE(live.wait());
  const LiveWires there = live.wires_to(SurfacePoint::at_vertex(20));
  ASSERT_FALSE(there.wires[0].vertices.empty());
  EXPECT_EQ(there.wires[0].vertices.front(), 3);
  EXPECT_EQ(there.wires[0].vertices.back(), 20);
  expect_equal(there, fresh_wires(surface, kAlongEdges, {3}, {20}));
  EXPECT_THROW(live.seed_at(SurfacePoint::at_vertex(48)), InvalidInput);
  EXPECT_THROW(live.wires_to(SurfacePoint::at_vertex(48)), InvalidInput);
  EXPECT_THROW(live.wires_to({.face = 3, .barycentric = {1.0, 0.0, 0.0}}), InvalidInput);
}

TEST(LiveWire, MetricsThatStayKeepTheirProgress) {
  const std::vector<MetricSpec> specs{MetricSpec::euclidean(), MetricSpec::concave()};
  const MetricSet former({.wires = specs}, {});
  *former.fractions[0] = 0.25;
  *former.fractions[1] = 0.75;
  const MetricSet later({.wires = {specs[1], MetricSpec::feature(Follow::kMin, {.parameter = 0.1}), specs[0]}}, {},
                        former);
  EXPECT_EQ(later.fraction(0), 0.75);
  EXPECT_EQ(later.fraction(1), 0.0);
  EXPECT_EQ(later.fraction(2), 0.25);
  *later.fractions[0] = 0.875;
  EXPECT_EQ(former.fraction(1), 0.875) << "the work is that of both";
}

TEST(LiveWire, PointsThatAreNoneAreRefused) {
  const auto surface = shared(shapes::torus(8, 6));  // 96 triangles
  LiveWire live(surface, kPlain), along_edges(surface, kAlongEdges);
  const SurfacePoint right{.face = 3, .barycentric = {0.2, 0.5, 0.3}};
  EXPECT_THROW(along_edges.seed_at(right), InvalidInput);
  live.seed_at(right);
  for (const SurfacePoint& wrong :
       {SurfacePoint{.face = 96, .barycentric = {1, 0, 0}}, SurfacePoint{},
        SurfacePoint{.face = 3, .barycentric = {0.5, 0.6, -0.1}},
        SurfacePoint{.face = 3, .barycentric = {0.5, 0.6, 0.1}}, SurfacePoint::at_vertex(48)}) {
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
  live.seed_at({.face = flat, .barycentric = {0.2, 0.5, 0.3}});
  ASSERT_TRUE(live.wait());
  const LiveWires none = live.wires({20});
  EXPECT_TRUE(none.final());
  EXPECT_TRUE(none.wires[0].points.empty());
  live.seed({20});
  ASSERT_TRUE(live.wait());
  EXPECT_TRUE(live.wires_to({.face = flat, .barycentric = {0.2, 0.5, 0.3}}).wires[1].points.empty());
}

TEST(LiveWire, BeforeItIsFinalAWireLeadsFromPointToPoint) {
  const auto surface = shared(shapes::torus(160, 120));
  LiveWire live(surface, kPlain);
  const SurfacePoint target{.face = 9000, .barycentric = {0.3, 0.3, 0.4}};
  live.seed_at({.face = 77, .barycentric = {0.6, 0.3, 0.1}});
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
  for (const Edge& edge : {Edge{0, 1}, Edge{24, 0}, Edge{5, 29}}) {  // loops need no seed
    live.loop(edge);
    ASSERT_TRUE(live.wait());
    const LiveLoop loop = live.loop(edge);
    ASSERT_TRUE(loop.final);
    double least = std::numeric_limits<double>::infinity();
    for (const Follow follow : {Follow::kMin, Follow::kMax}) {
      const auto graph = make_edge_graph(*surface, metric_of(*surface, follow, kEdgeStrength));
      least = std::min(least, shortest_cycle(*graph, edge).length);
    }
    EXPECT_EQ(loop.length, least);
    EXPECT_GE(loop.vertices.size(), 3u);
  }
}

/// The closed wires of a concave LiveWire, made without one.
struct ClosedInBoth {
  explicit ClosedInBoth(std::shared_ptr<const Surface> of)
      : surface(std::move(of)), curvature(principal_curvatures(*surface)) {
    const Curvature smoothed = smoothed_curvatures(*surface, curvature, 0.01);
    embeddings[0] = embed(*surface, concave_metric(*surface, smoothed, 1.0));
    embeddings[1] = embed(*surface, euclidean_metric(*surface, curvature));
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
    live.closed_wires(SurfacePoint::at_vertex(7));
    live.closed_wires(SurfacePoint::at_vertex(through));
    ASSERT_TRUE(live.wait());
    const LiveClosedWires found = live.closed_wires(SurfacePoint::at_vertex(through));
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
  const SurfacePoint through = SurfacePoint::at_vertex(100);
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

TEST(LiveWire, OnALargeSurfaceClosedWiresAreThereBeforeTheyAreFinal) {
  // In TheClosedWiresOfTheFirstMetricAreThereBeforeThoseOfTheSecond, threads exchange the same on a smaller surface.
  if (sized(false, true)) GTEST_SKIP() << "takes minutes under ThreadSanitizer";
  const auto surface = shared(shapes::torus(300, 200));
  LiveWire live(surface, in(MetricFamily::kEuclidean));
  const SurfacePoint through = SurfacePoint::at_vertex(0);
  live.wait();
  LiveClosedWires early = live.closed_wires(through);
  while (early.cuts.empty() && !early.final) early = live.closed_wires(through);
  ASSERT_FALSE(early.cuts.empty());
  EXPECT_FALSE(early.final);
  live.wait();
  const LiveClosedWires late = live.closed_wires(through);
  ASSERT_TRUE(late.final);
  ASSERT_FALSE(late.cuts.empty());
  EXPECT_NEAR(late.cuts[0].length, early.cuts[0].length, 0.02 * late.cuts[0].length);
}

TEST(LiveWire, ClosedWiresLeadThroughPointsOfTheSurface) {
  const auto surface = shared(shapes::torus(24, 16));
  LiveWire live(surface, kPlain), along_edges(surface, kAlongEdges);
  EXPECT_THROW(live.closed_wires(SurfacePoint::at_vertex(24 * 16)), InvalidInput);
  EXPECT_THROW(live.closed_wires({.face = -1, .barycentric = {1, 0, 0}}), InvalidInput);
  EXPECT_THROW(along_edges.closed_wires(SurfacePoint::at_vertex(0)), InvalidInput);
}

TEST(LiveWire, AClosedWireIsBentToASecondPointInItsMetric) {
  const auto surface = shared(shapes::torus(40, 24));
  LiveWire live(surface, kConcave);
  const ClosedInBoth both(surface);
  const SurfacePoint through = SurfacePoint::at_vertex(100);
  const auto closed = both.closed(100);
  for (const std::size_t metric : {0U, 1U, 0U}) {
    ASSERT_FALSE(closed[metric].empty());
    const BentWires bent(surface, std::make_shared<const Embedding>(both.embeddings[metric]), both.solvers[metric],
                         both.solvers[metric].solve(100), closed[metric][0]);
    for (const std::int32_t vertex : {103, 420, 500}) {
      const SurfacePoint second = SurfacePoint::at_vertex(vertex);
      const ClosedCutId id{.metric = metric};
      live.bent_wire(through, SurfacePoint::at_vertex(7), id);  // the newest counts
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
    live.bent_wire(through, SurfacePoint::at_vertex(420), id);
    ASSERT_TRUE(live.wait());
    const LiveClosedWires none = live.bent_wire(through, SurfacePoint::at_vertex(420), id);
    EXPECT_TRUE(none.final && none.cuts.empty()) << "there is no cut of that number";
  }
  EXPECT_THROW(live.bent_wire(through, SurfacePoint::at_vertex(40 * 24)), InvalidInput);
}

TEST(LiveWire, BeforeItIsFinalAWireIsARealPathThatMayBeLonger) {
  const auto surface = shared(shapes::torus(160, 120));
  LiveWire live(surface, kPlain);
  live.seed({0});
  const Pick target{3000};
  std::array<std::vector<LiveCandidate>, 2> seen;
  const auto start = std::chrono::steady_clock::now();
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
    ASSERT_LT(Seconds(std::chrono::steady_clock::now() - start).count(), 60);
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
  const auto start = std::chrono::steady_clock::now();
  for (const double seconds : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e-3}) live.wait(seconds);
  EXPECT_LT(Seconds(std::chrono::steady_clock::now() - start).count(), 30) << "as if it had been told to wait forever";
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
  const Embedding embedding = embed(*surface, metric);
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
  const LiveWires before = live.wires({900});
  live.set_metrics(live_metrics(MetricFamily::kFeature, {.max_anisotropy = 8}));
  const LiveWires now = live.wires({900});
  EXPECT_FALSE(now.final());
  for (std::size_t which = 0; which < 2; ++which) {
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
  scribble.meant_for = MetricKind::kMin;
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
      EXPECT_EQ(after.wires[min].vertices, edge_wires(graph, from).trace(to).vertices);
    } else {
      const Embedding embedding = embed(*surface, metric);
      const DistanceField field = ExactGeodesics(embedding.mesh).solve(from.a);
      EXPECT_EQ(after.wires[min].points, trace_wire(*surface, embedding, field, to.a).points);
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
  one.meant_for = two.meant_for = MetricKind::kMin;
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
  three.meant_for = MetricKind::kMax;
  const auto with_three = after(*with_both, {three, one, two});
  EXPECT_TRUE(with_three->shares(*with_both, kMinOne));
  EXPECT_FALSE(with_three->shares(*with_both, kMaxOne));
  EXPECT_TRUE(with_three->shares(none, kConcaveOne));
}

TEST(LiveWire, MetricsThatStayAreNotPreparedAgain) {
  const LiveMetrics metrics{.wires = {MetricSpec::concave(), MetricSpec::euclidean()}};
  const MetricSet before(metrics, {});
  const MetricSet changed({.wires = {MetricSpec::euclidean(), MetricSpec::concave({.parameter = 0.5})}}, {}, before);
  EXPECT_EQ(changed.prepared[0], before.prepared[1]);
  EXPECT_NE(changed.prepared[1], before.prepared[0]);
}

TEST(LiveWire, WiresInMetricsThatAnotherOneHasAreTheSame) {
  const SurfaceContext context(shared(shapes::bumpy(shapes::torus(32, 20), 0.02)));
  LiveWire live(context, kPlain);
  LiveWire cuts(context, {.metrics = {.wires = {MetricSpec::concave(), MetricSpec::euclidean()}}, .max_error = 0.0});
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
    if (random() % 2 == 0) scribble.meant_for = static_cast<MetricKind>(random() % 3);
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
    const Embedding embedding =
        embed(*surface, feature_metric(*surface, curvature, follow, strength), {.max_faces_added = 200'000});
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

TEST(LiveWire, RunsOnAlongBothKinds) {
  const auto surface = std::make_shared<const Surface>(shapes::quad_cylinder(12, 6, 0.5, 1.0).surface());
  for (const LiveWireOptions& options : {kPlain, kAlongEdges}) {
    const LiveWire live(surface, options);
    ASSERT_TRUE(live.wait());
    const EdgeChain up = live.extend_straight({0, 12}, {});
    EXPECT_EQ(up.vertices, (std::vector<std::int32_t>{12, 24, 36, 48, 60, 72}));
    EXPECT_NEAR(up.length, 5.0 / 6, 1e-12);
    EXPECT_THROW(live.extend_straight({0, 13}, {}), InvalidInput);
  }
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

/// A live wire that builds the mesh's surface itself.
LiveWire live_on(const shapes::Mesh& mesh, const LiveWireOptions& options = kPlain) {
  return {mesh.points, mesh.triangles, std::nullopt, options};
}

/// A mesh whose surface takes long enough to build for a caller to have something in the meantime.
const shapes::Mesh& slow_mesh() {
  static const shapes::Mesh mesh = shapes::torus(300, 200);
  return mesh;
}

TEST(LiveWireBuildingItsSurface, GivesTheWiresOfOneOnThatSurface) {
  const shapes::Mesh mesh = shapes::bumpy(shapes::torus(40, 24), 0.02);
  const auto surface = shared(mesh);
  for (const LiveWireOptions& options : {kPlain, kAlongEdges}) {
    LiveWire live = live_on(mesh, options);
    live.seed({7});  // asked for before it is there, most likely
    ASSERT_TRUE(live.wait());
    EXPECT_EQ(live.progress(), 1);
    expect_equal(live.wires({333}), fresh_wires(surface, options, {7}, {333}));
    ASSERT_NE(live.surface(), nullptr);
    EXPECT_EQ(live.surface()->edges(), surface->edges());
    EXPECT_EQ(live.surface()->twins(), surface->twins());
    EXPECT_EQ(*live.feature_strength(), principal_curvatures(*surface).difference());
  }
}

TEST(LiveWireBuildingItsSurface, RunsAlongTheRealEdgesThatItIsGiven) {
  const Surface quads = shapes::quad_cylinder(12, 6, 0.5, 1.0).surface();
  const LiveWire live(quads.points(), quads.triangles(), quads.edges(), kAlongEdges);
  ASSERT_TRUE(live.wait());
  EXPECT_EQ(live.surface()->edges(), quads.edges());
  EXPECT_EQ(live.extend_straight({0, 12}, {}).vertices, (std::vector<std::int32_t>{12, 24, 36, 48, 60, 72}));
  EXPECT_THROW(live.extend_straight({0, 13}, {}), InvalidInput);
}

TEST(LiveWireBuildingItsSurface, SaysUntilItIsThereThatNothingIsFinal) {
  LiveWire live = live_on(slow_mesh(), kAlongEdges);
  live.seed({0});
  const LiveWires wires = live.wires({900});
  const LiveLoop loop = live.loop({0, 1});
  const EdgeChain on = live.extend_straight({0, 1}, {});
  const EdgeLoop strip = live.edge_loop({0, 1}, {});
  const auto strength = live.feature_strength();
  const double progress = live.progress();
  const bool was_idle = live.wait(0);
  if (live.surface()) GTEST_SKIP() << "this thread was kept away for so long that the surface is there";
  EXPECT_FALSE(wires.wires[0].final || wires.wires[1].final);
  EXPECT_EQ(wires.wires[0].metric.kind(), MetricKind::kMin);
  EXPECT_EQ(wires.wires[1].metric.kind(), MetricKind::kMax);
  for (const LiveCandidate& wire : wires.wires) EXPECT_TRUE(wire.points.empty() && wire.vertices.empty());
  EXPECT_FALSE(loop.final);
  EXPECT_TRUE(loop.vertices.empty() && on.vertices.empty() && strip.vertices.empty());
  EXPECT_EQ(strength, nullptr);
  EXPECT_EQ(progress, 0);
  EXPECT_FALSE(was_idle);
  ASSERT_TRUE(live.wait());  // for the loop too
  EXPECT_TRUE(live.wires({900}).final());
  EXPECT_TRUE(live.loop({0, 1}).final);
}

TEST(LiveWireBuildingItsSurface, DoesThenWhatItWasAskedForBefore) {
  const shapes::Mesh mesh = shapes::torus(100, 80);
  const auto surface = shared(mesh);
  Scribble scribble;
  for (std::int32_t v = 7; v < 20; ++v) {
    scribble.vertices.push_back(v);
    scribble.points.push_back(mesh.points[static_cast<std::size_t>(v)]);
  }
  const auto ask = [&](LiveWire& live) {
    live.seed({3});
    live.seed({7, 8}, true);
    live.set_metrics(live_metrics(MetricFamily::kCampen, {.max_anisotropy = 5}));
    live.set_scribbles({scribble});
  };
  LiveWire live = live_on(mesh, kAlongEdges), on_surface(surface, kAlongEdges);
  ask(live);
  ask(on_surface);
  ASSERT_TRUE(live.wait());
  ASSERT_TRUE(on_surface.wait());
  expect_equal(live.wires({300, 301}), on_surface.wires({300, 301}));
}

TEST(LiveWireBuildingItsSurface, IsSharedByForksAndSiblingsAndBuiltOnce) {
  auto live = std::make_optional<LiveWire>(live_on(shapes::torus(100, 80), kAlongEdges));
  LiveWire fork = live->fork(), across = live->sibling(in(MetricFamily::kEuclidean, {}));
  EXPECT_THROW(live->sibling(in(MetricFamily::kFeature, {})), InvalidInput);
  fork.seed({3});
  across.seed({5});
  ASSERT_TRUE(across.wait_for_surface());
  EXPECT_EQ(across.surface(), fork.surface());
  EXPECT_EQ(across.surface(), live->surface());
  live.reset();
  ASSERT_TRUE(fork.wait());
  ASSERT_TRUE(across.wait());
  EXPECT_EQ(across.feature_strength(), fork.feature_strength()) << "and so are the curvatures";
  const auto surface = fork.surface();
  expect_equal(fork.wires({99}), fresh_wires(surface, kAlongEdges, {3}, {99}));
  expect_equal(across.wires({99}), fresh_wires(surface, in(MetricFamily::kEuclidean, {}), {5}, {99}));
}

TEST(LiveWireBuildingItsSurface, AForkBuildsItWhereItsOriginIsGone) {
  const shapes::Mesh& mesh = slow_mesh();
  for (const int milliseconds : {0, 3, 20}) {
    auto live = std::make_optional<LiveWire>(live_on(mesh, kAlongEdges));
    LiveWire fork = live->fork();
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    live.reset();
    ASSERT_TRUE(fork.wait_for_surface());
    EXPECT_EQ(fork.surface()->triangles(), mesh.triangles);
  }
}

TEST(LiveWireBuildingItsSurface, EndsInTheMiddleOfIt) {
  for (const int milliseconds : {0, 1, 5, 20, 60}) {
    LiveWire live = live_on(slow_mesh());
    live.seed({0});
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  }
}

TEST(LiveWireBuildingItsSurface, OtherThreadsMayWaitForIt) {
  LiveWire live = live_on(slow_mesh());
  std::shared_ptr<const Surface> seen;
  {
    const std::jthread other([&] {
      if (live.wait_for_surface()) seen = live.surface();
    });
    for (std::int32_t v = 0; v < 50; ++v) {
      live.seed({v});
      live.wires({900});
    }
  }
  ASSERT_NE(seen, nullptr);
  EXPECT_EQ(seen, live.surface());
  EXPECT_TRUE(live.wait_for_surface(0));
}

TEST(LiveWireBuildingItsSurface, AnEdgeThatTurnsOutToBeNoneIsRefused) {
  LiveWire live = live_on(slow_mesh(), kAlongEdges);
  try {
    live.seed({0, 777});
    live.loop({0, 777});
  } catch (const InvalidInput&) {
    GTEST_SKIP() << "this thread was kept away for so long that the surface is there";
  }
  EXPECT_TRUE(live.wait()) << "nothing has failed";
  EXPECT_EQ(live.progress(), 1);
  try {
    live.wires({1});
    FAIL() << "wires from an edge that is none";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "the surface has no edge between the vertices 0 and 777");
  }
  EXPECT_THROW(live.loop({0, 777}), InvalidInput);
  live.set_metrics(live_metrics(MetricFamily::kEuclidean, {}));
  EXPECT_THROW(live.wires({1}), InvalidInput) << "still";
  live.seed({0, 1});
  ASSERT_TRUE(live.wait());
  EXPECT_TRUE(live.wires({900}).final());
}

TEST(LiveWireBuildingItsSurface, RefusesAtOnceWhatCanBeToldWithoutIt) {
  LiveWire across = live_on(slow_mesh()), along = live_on(slow_mesh(), kAlongEdges);
  EXPECT_THROW(across.wires({0}), InvalidInput) << "no seed";
  for (const Pick pick : {Pick{-1}, Pick{200'000}, Pick{0, 1}}) EXPECT_THROW(across.seed(pick), InvalidInput);
  EXPECT_THROW(along.seed({200'000}), InvalidInput);
  EXPECT_THROW(across.loop({0, 1}), InvalidInput);
  EXPECT_THROW(live_on(slow_mesh(), in(MetricFamily::kFeature, {})), InvalidInput);
}

TEST(LiveWireBuildingItsSurface, EveryCallThrowsWhyItCannotBeBuilt) {
  const auto expect_refused = [](const shapes::Mesh& mesh, const std::optional<std::vector<Edge>>& edges) {
    std::string why;
    try {
      const Surface surface(mesh.points, mesh.triangles, edges);
    } catch (const InvalidInput& error) {
      why = error.what();
    }
    ASSERT_FALSE(why.empty());
    LiveWire live(mesh.points, mesh.triangles, edges, kAlongEdges);
    std::optional<LiveWire> fork;
    try {
      fork = live.fork();
    } catch (const InvalidInput&) {
      // It is known already.
    }
    const auto expect_thrown = [&](const auto& call) {
      try {
        call();
        ADD_FAILURE() << "not refused: " << why;
      } catch (const InvalidInput& error) {
        EXPECT_EQ(error.what(), why);
      }
    };
    expect_thrown([&] { live.wait(); });
    if (fork) expect_thrown([&] { fork->wait(); });
    expect_thrown([&] { live.wait_for_surface(); });
    expect_thrown([&] { live.surface(); });
    expect_thrown([&] { live.fork(); });
    expect_thrown([&] { live.sibling({}); });
    expect_thrown([&] { live.set_metrics(live_metrics(MetricFamily::kEuclidean, {})); });
    expect_thrown([&] { live.set_scribbles({}); });
    expect_thrown([&] { live.seed({0}); });
    expect_thrown([&] { live.wires({0}); });
    expect_thrown([&] { live.loop({0, 1}); });
    expect_thrown([&] { live.extend_straight({0, 1}, {}); });
    expect_thrown([&] { live.edge_loop({0, 1}, {}); });
    expect_thrown([&] { live.feature_strength(); });
    expect_thrown([&] { live.progress(); });
  };
  const shapes::Mesh grid = shapes::grid(4);
  shapes::Mesh wrong = grid;
  wrong.triangles[3][1] = 25;
  expect_refused(wrong, std::nullopt);
  wrong = grid;
  wrong.points[7].x() = std::numeric_limits<double>::quiet_NaN();
  expect_refused(wrong, std::nullopt);
  expect_refused(grid, std::vector<Edge>{{0, 1}, {2, 2}});
  wrong = grid;
  wrong.triangles.clear();
  expect_refused(wrong, std::nullopt);
}

}  // namespace
}  // namespace seamwire
