// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <memory>
#include <new>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include "detail/computed_once.hpp"
#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/context/surface_context.hpp"
#include "seamwire/live/livewire.hpp"
#include "seamwire/metric/metric_spec.hpp"
#include "seamwire_uv/seams/seam_planner.hpp"
#include "shapes.hpp"

namespace seamwire {

using namespace detail;

namespace {

std::shared_ptr<const Surface> shared(const shapes::Mesh& mesh) {
  return std::make_shared<const Surface>(mesh.points, mesh.triangles);
}

std::shared_ptr<const Surface> bumpy_torus() { return shared(shapes::bumpy(shapes::torus(32, 20), 0.02)); }

MetricSpec spec_of(MetricFamily family, Follow follow, const Strength& strength) {
  return {.family = family, .follow = follow, .strength = strength};
}

template <class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(SurfaceContext, IsMadeOfASharedSurfaceThatIsNotConst) {
  const shapes::Mesh mesh = shapes::torus(12, 8);
  const auto surface = std::make_shared<Surface>(mesh.points, mesh.triangles);
  EXPECT_EQ(SurfaceContext(surface).surface(), surface);
  EXPECT_EQ(EmbeddedSurface(surface, MetricSpec::euclidean(), {.max_error = 0}).context().surface(), surface);
  EXPECT_EQ(LiveWire(surface).surface(), surface);
  EXPECT_TRUE((std::is_constructible_v<SeamPlanner, std::shared_ptr<Surface>>));
}

TEST(MetricSpecs, AreEqualExactlyIfAllTheirValuesAre) {
  const MetricSpec one = MetricSpec::feature(Follow::kMin, {.max_anisotropy = 20.0});
  EXPECT_EQ(one, MetricSpec::feature(Follow::kMin, {.max_anisotropy = 20.0}));
  EXPECT_NE(one, MetricSpec::feature(Follow::kMax, {.max_anisotropy = 20.0}));
  EXPECT_NE(one, MetricSpec::feature(Follow::kMin, {.max_anisotropy = 21.0}));
  EXPECT_NE(one, spec_of(MetricFamily::kCampen, Follow::kMin, {.max_anisotropy = 20.0}));
  EXPECT_EQ(MetricSpec::euclidean(), MetricSpec{});
}

TEST(MetricSpecs, OfOneFamilyAndStrengthAreCounterpartsIfTheyFollowDifferentDirections) {
  const MetricSpec min = MetricSpec::feature(Follow::kMin), max = MetricSpec::feature(Follow::kMax);
  EXPECT_TRUE(is_counterpart(min, max));
  EXPECT_FALSE(is_counterpart(min, min));
  EXPECT_FALSE(is_counterpart(min, MetricSpec::feature(Follow::kMax, {.parameter = 0.2})));
  EXPECT_FALSE(is_counterpart(MetricSpec::concave(), MetricSpec::concave()));
  EXPECT_FALSE(is_counterpart(MetricSpec::concave(), MetricSpec::euclidean()));
}

TEST(MetricSpecs, KnowWhatTheirPathsFollow) {
  EXPECT_EQ(spec_of(MetricFamily::kCampen, Follow::kMin, {.parameter = 2.0}).kind(), MetricKind::kMin);
  EXPECT_EQ(spec_of(MetricFamily::kPottmannKovacs, Follow::kMax, {.parameter = 2.0}).kind(), MetricKind::kMax);
  EXPECT_EQ(MetricSpec::concave().kind(), MetricKind::kConcave);
  EXPECT_EQ(MetricSpec::euclidean().kind(), MetricKind::kEuclidean);
}

TEST(MetricFamilies, AreListedInTheOrderOfTheirEnumerationAndFoundByName) {
  std::set<std::string_view> names;
  for (const MetricFamilyInfo& info : metric_families()) {
    EXPECT_EQ(&info_of(info.family), &info);
    EXPECT_EQ(metric_family(info.name), info.family);
    names.insert(info.name);
    const std::optional<Follow> follow = info.has_directions ? std::optional(Follow::kMin) : std::nullopt;
    EXPECT_NO_THROW(check_metric({.family = info.family, .follow = follow, .strength = info.initial}));
  }
  EXPECT_EQ(names.size(), 5U);
  EXPECT_EQ(message_of([] { metric_family("flat"); }),
            "metric: expected 'feature', 'campen', 'pottmann_kovacs', 'concave' or 'euclidean', got 'flat'");
}

TEST(MetricSpecs, ThatDescribeNoMetricAreRefused) {
  EXPECT_EQ(message_of([] { check_metric({.family = MetricFamily::kFeature, .strength = {.parameter = 1.0}}); }),
            "the metric 'feature' needs a direction to follow");
  EXPECT_EQ(message_of([] { check_metric({.follow = Follow::kMin}); }), "the metric 'euclidean' follows no direction");
  EXPECT_EQ(message_of([] { check_metric({.strength = {.parameter = 1.0}}); }),
            "the metric 'euclidean' has no strength");
  EXPECT_THROW(check_metric(MetricSpec::concave({.parameter = -1.0})), InvalidInput);
  EXPECT_THROW(check_metric(spec_of(MetricFamily::kCampen, Follow::kMin, {.parameter = 0.5})), InvalidInput);
  EXPECT_THROW(check_metric(MetricSpec::feature(Follow::kMin, {})), InvalidInput);
  EXPECT_EQ(message_of([] { check_metric({.family = static_cast<MetricFamily>(9)}); }), "metric: there is no family 9");
}

TEST(MetricSpecs, DescribeTheMetricsOfTheFunctionsOfTheirFamilies) {
  const auto surface = bumpy_torus();
  const SurfaceContext context(surface);
  const Curvature curvature = principal_curvatures(*surface);
  const Curvature smoothed = smoothed_curvatures(*surface, curvature, 0.01);
  const Strength strength{.max_anisotropy = 8.0};
  const auto tensors = [&](const MetricSpec& spec) { return make_metric(context, spec).tensors; };
  for (const Follow follow : {Follow::kMin, Follow::kMax}) {
    EXPECT_EQ(tensors(MetricSpec::feature(follow, strength)),
              feature_metric(*surface, curvature, follow, strength).tensors);
    EXPECT_EQ(tensors(spec_of(MetricFamily::kCampen, follow, strength)),
              campen_metric(*surface, curvature, follow, strength).tensors);
    EXPECT_EQ(tensors(spec_of(MetricFamily::kPottmannKovacs, follow, strength)),
              pottmann_kovacs_metric(*surface, curvature, follow, strength).tensors);
  }
  EXPECT_EQ(tensors(MetricSpec::euclidean()), euclidean_metric(*surface, curvature).tensors);
  EXPECT_EQ(tensors(MetricSpec::concave({.max_anisotropy = 10.5})), concave_metric(*surface, smoothed, 0.5).tensors);
  EXPECT_EQ(tensors(MetricSpec::concave_like({.parameter = 0.05})), concave_metric(*surface, smoothed, 0.5).tensors);
}

TEST(SurfaceContext, ComputesEachThingOnceForAllItsCopies) {
  const auto surface = bumpy_torus();
  const SurfaceContext context(surface), copy = context;
  EXPECT_EQ(context, copy);
  EXPECT_EQ(context.surface(), surface);
  EXPECT_EQ(context.curvature(), copy.curvature());
  EXPECT_EQ(context.curvature()->k1, principal_curvatures(*surface).k1);
  EXPECT_EQ(context.smoothed_curvature(), copy.smoothed_curvature());
  EXPECT_EQ(context.edge_adjacency(), copy.edge_adjacency());
  EXPECT_EQ(*context.feature_strength(), context.curvature()->difference());
  EXPECT_NE(SurfaceContext(surface), context);
}

TEST(SurfaceContext, TellsWhatIsThereWithoutComputingIt) {
  const shapes::Mesh mesh = shapes::torus(12, 8);
  const SurfaceContext context(mesh.points, mesh.triangles);
  EXPECT_EQ(context.vertex_count(), 96U);
  EXPECT_EQ(context.face_count(), 192U);
  EXPECT_EQ(context.peek_surface(), nullptr);
  EXPECT_FALSE(context.wait_for_surface(0.0));
  const auto surface = context.surface();
  EXPECT_EQ(context.peek_surface(), surface);
  EXPECT_TRUE(context.wait_for_surface(0.0));
  EXPECT_EQ(context.peek_feature_strength(), nullptr);
  EXPECT_EQ(context.peek_edge_adjacency(), nullptr);
  const auto strength = context.feature_strength();
  const auto adjacency = context.edge_adjacency();
  EXPECT_EQ(context.peek_feature_strength(), strength);
  EXPECT_EQ(context.peek_edge_adjacency(), adjacency);
}

TEST(SurfaceContext, OfASurfaceThatCannotBeBuiltEveryCallSaysWhy) {
  const SurfaceContext context(std::vector<Vector>{Vector::Zero()}, {{0, 0, 7}});
  const std::string why = message_of([&] { context.surface(); });
  EXPECT_NE(why.find("7"), std::string::npos);
  EXPECT_EQ(message_of([&] { context.surface(); }), why);
  EXPECT_EQ(message_of([&] { context.curvature(); }), why);
  EXPECT_EQ(message_of([&] { context.edge_adjacency(); }), why);
  EXPECT_EQ(message_of([&] { context.peek_surface(); }), why);
  EXPECT_EQ(message_of([&] { context.wait_for_surface(1.0); }), why);
  EXPECT_EQ(message_of([&] { make_metric(context, MetricSpec::euclidean()); }), why);
  EXPECT_THROW(SurfaceContext(std::shared_ptr<const Surface>()), InvalidInput);
}

TEST(SurfaceContext, AfterACancelledCallTheNextOneComputes) {
  const shapes::Mesh mesh = shapes::torus(100, 80);
  const SurfaceContext context(mesh.points, mesh.triangles);
  std::stop_source stop;
  stop.request_stop();
  const Task stopped{.stop = stop.get_token(), .progress = {}},
      refused{.stop = {}, .progress = [](double) { return false; }};
  for (const Task& task : {stopped, refused}) {
    EXPECT_THROW(context.surface(task), Cancelled);
    EXPECT_THROW(context.curvature(task), Cancelled);
    EXPECT_THROW(context.smoothed_curvature(task), Cancelled);
    EXPECT_THROW(context.edge_adjacency(task), Cancelled);
  }
  EXPECT_NE(context.smoothed_curvature(), nullptr);
  EXPECT_NE(context.edge_adjacency(), nullptr);
}

TEST(SurfaceContext, ManyThreadsGetTheSame) {
  const shapes::Mesh mesh = shapes::torus(40, 24);
  const SurfaceContext context(mesh.points, mesh.triangles);
  std::array<std::shared_ptr<const Curvature>, 8> found;
  std::array<std::optional<EmbeddedSurface>, 8> embedded;
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < found.size(); ++i) {
      threads.emplace_back([&, i] {
        found[i] = context.smoothed_curvature();
        context.edge_adjacency();
        embedded[i].emplace(context, MetricSpec::concave());
        embedded[i]->field(0).trace(100);
      });
    }
  }
  for (const auto& each : found) EXPECT_EQ(each, found[0]);
  for (const auto& each : embedded) {
    EXPECT_EQ(each->field(0).distances().distances(), embedded[0]->field(0).distances().distances());
  }
}

TEST(ComputedOnce, AProgressFunctionMayAskForWhatItsThreadComputes) {
  ComputedOnce<int> once;
  const auto inner = once.get({}, [&](const Task&) {
    EXPECT_EQ(*once.get({}, [](const Task&) { return 1; }), 1);
    return 2;
  });
  EXPECT_EQ(*inner, 1) << "the one that was there first";
  EXPECT_EQ(once.peek(), inner);
}

TEST(ComputedOnce, AfterAFailureTheNextCallTriesAgain) {
  ComputedOnce<int> once;
  EXPECT_THROW(once.get({}, [](const Task&) -> int { throw std::bad_alloc(); }), std::bad_alloc);
  EXPECT_NE(once.error(), nullptr);
  const Task refused{.stop = {}, .progress = [](double) { return false; }};
  const auto make = [](const Task& own) {
    own.check(0.5);
    return 1;
  };
  EXPECT_THROW(once.get(refused,
                        [&](const Task& own) {
                          EXPECT_EQ(once.error(), nullptr) << "while a thread tries again";
                          return make(own);
                        }),
               Cancelled);
  EXPECT_NE(once.error(), nullptr) << "nothing more is known";
  EXPECT_EQ(*once.get({}, make), 1);
  EXPECT_EQ(once.error(), nullptr);
}

TEST(ComputedOnce, WhoWaitsForAnotherThreadIsAskedWhetherToGoOn) {
  ComputedOnce<int> once;
  std::atomic<bool> has_begun = false, may_end = false;
  const std::jthread other([&] {
    once.get({}, [&](const Task&) {
      has_begun = true;
      while (!may_end) std::this_thread::yield();
      return 1;
    });
  });
  while (!has_begun) std::this_thread::yield();
  int asked = 0;
  const Task task{.stop = {}, .progress = [&](double) { return ++asked < 3; }};
  EXPECT_THROW(once.get(task, [](const Task&) { return 2; }), Cancelled);
  EXPECT_EQ(asked, 3);
  may_end = true;
  EXPECT_EQ(*once.get({}, [](const Task&) { return 2; }), 1);
}

TEST(ComputedOnce, WhatAProgressFunctionThrowsIsForItsCallerAlone) {
  ComputedOnce<int> once;
  const Task task{.stop = {}, .progress = [](double) -> bool { throw std::logic_error("enough"); }};
  const auto make = [](const Task& own) {
    own.check(0.5);
    return 1;
  };
  EXPECT_THROW(once.get(task, make), std::logic_error);
  EXPECT_EQ(once.error(), nullptr);
  EXPECT_EQ(*once.get({}, make), 1);
}

TEST(EmbeddedSurface, HasTheDistancesAndWiresOfItsParts) {
  const auto surface = bumpy_torus();
  const MetricSpec spec = MetricSpec::feature(Follow::kMax, {.max_anisotropy = 8.0});
  const EmbeddedSurface embedded(SurfaceContext(surface), spec, {.max_error = 0});
  const Metric metric = feature_metric(*surface, principal_curvatures(*surface), *spec.follow, spec.strength);
  const Embedding embedding = embed(*surface, metric, {.max_error = 0});
  const DistanceField expected = ExactGeodesics(embedding.mesh).solve(7);
  EXPECT_EQ(embedded.spec(), spec);
  EXPECT_EQ(embedded.embedding().mesh.lengths, embedding.mesh.lengths);
  const EmbeddedField field = embedded.field(7);
  EXPECT_EQ(field.on(), embedded);
  EXPECT_EQ(field.distances().distances(), expected.distances());
  const Wire wire = field.trace(333).value(), traced = trace_wire(*surface, embedding, expected, 333).value();
  EXPECT_EQ(wire.points, traced.points);
  EXPECT_EQ(wire.length, traced.length);
  const SurfacePoint inside{500, {0.2, 0.3, 0.5}};
  const SurfacePoint located = *EmbeddedPoints(surface, embedded.shared_embedding()).find(inside);
  EXPECT_EQ(embedded.locate(inside), located);
  EXPECT_EQ(field.distance(inside), expected.distance(located));
  EXPECT_EQ(field.trace(inside)->points, trace_wire(*surface, embedding, expected, located)->points);
  const EmbeddedField nearest = embedded.field(std::array{inside, SurfacePoint(7)});
  EXPECT_LE(nearest.distances().distances()[333], field.distances().distances()[333]);
}

TEST(EmbeddedSurface, FindsAndBendsClosedWires) {
  const auto surface = shared(shapes::torus(40, 24));
  const EmbeddedSurface embedded(SurfaceContext(surface), MetricSpec::euclidean(), {.max_error = 0});
  const EmbeddedField field = embedded.field(100);
  const std::vector<ClosedWire> cuts = field.closed_wires();
  ASSERT_FALSE(cuts.empty());
  EXPECT_EQ(cuts[0].wire.points, closed_wires(*surface, embedded.embedding(), field.distances())[0].wire.points);
  const std::optional<BentWire> bent = field.bend(cuts[0]).through(SurfacePoint(103));
  ASSERT_TRUE(bent);
  EXPECT_EQ(bent->there.points.back(), surface->points()[103]);
  const EmbeddedSurface other(embedded.context(), MetricSpec::euclidean(), {.max_faces_added = 10, .max_error = 0});
  EXPECT_EQ(message_of([&] { other.field(100).bend(cuts[0]); }), "the cut is of another embedding");
}

TEST(EmbeddedSurface, OfOneContextMetricAndOptionsIsMadeOnce) {
  const SurfaceContext context(bumpy_torus());
  const MetricSpec spec = MetricSpec::concave();
  EXPECT_FALSE(EmbeddedSurface::find(context, spec, {.max_error = 0}));
  std::optional<EmbeddedSurface> one(std::in_place, context, spec, EmbedOptions{.max_error = 0});
  EXPECT_EQ(EmbeddedSurface(context, spec, {.max_error = 0}), *one);
  EXPECT_EQ(EmbeddedSurface::find(context, spec, {.max_error = 0}), *one);
  EXPECT_NE(EmbeddedSurface(context, MetricSpec::concave({.parameter = 0.5}), {.max_error = 0}), *one);
  EXPECT_NE(EmbeddedSurface(context, spec, {.max_faces_added = 10, .max_error = 0}), *one);
  EXPECT_NE(EmbeddedSurface(SurfaceContext(context.surface()), spec, {.max_error = 0}), *one);
  one.reset();
  EXPECT_FALSE(EmbeddedSurface::find(context, spec, {.max_error = 0})) << "nobody holds it any more";
}

TEST(EmbeddedSurface, OfAnyMetricIsNotFiledUnderASpec) {
  const SurfaceContext context(bumpy_torus());
  const MetricSpec spec = MetricSpec::euclidean();
  const auto metric = std::make_shared<const Metric>(make_metric(context, MetricSpec::concave()));
  static_assert(!std::is_constructible_v<EmbeddedSurface, const SurfaceContext&, const MetricSpec&,
                                         std::shared_ptr<const Metric>, const EmbedOptions&>);
  const EmbeddedSurface any(context, metric, {.max_error = 0}), same(context, metric, Embedding(any.embedding()));
  for (const EmbeddedSurface& embedded : {any, same, any.with_metric(metric)}) EXPECT_FALSE(embedded.spec());
  EXPECT_FALSE(EmbeddedSurface::find(context, spec, {.max_error = 0}));
  EXPECT_FALSE(EmbeddedSurface::find(context, MetricSpec::concave(), {.max_error = 0}));
  EXPECT_EQ(EmbeddedSurface(context, spec, {.max_error = 0}).metric().tensors, make_metric(context, spec).tensors);
}

TEST(EmbeddedSurface, InAnotherMetricIsTheOneMadeAnew) {
  const auto surface = bumpy_torus();
  const SurfaceContext context(surface);
  const EmbeddedSurface plain(context, MetricSpec::euclidean(), {.max_error = 0});
  plain.geodesics();
  Scribble stroke{.points = {surface->points()[7], surface->points()[8]}, .faces = {}, .vertices = {7, 8}, .rings = 3};
  const auto drawn = std::make_shared<const Metric>(apply_scribbles(*surface, plain.metric(), std::vector{stroke}));
  const EmbeddedSurface changed = plain.with_metric(drawn), fresh(context, drawn, {.max_error = 0});
  EXPECT_FALSE(changed.spec());
  EXPECT_EQ(changed.embedding().mesh.face_count(), fresh.embedding().mesh.face_count());
  EXPECT_NEAR(changed.field(0).distances().distances()[333], fresh.field(0).distances().distances()[333], 1e-12);
}

TEST(EmbeddedSurface, OfAnExistingEmbeddingKeepsItsOptions) {
  const auto surface = bumpy_torus();
  const SurfaceContext context(surface);
  const auto metric =
      std::make_shared<const Metric>(make_metric(context, MetricSpec::feature(Follow::kMin, {.max_anisotropy = 20.0})));
  Scribble stroke{.points = {surface->points()[7], surface->points()[8]}, .faces = {}, .vertices = {7, 8}, .rings = 3};
  const auto drawn = std::make_shared<const Metric>(apply_scribbles(*surface, *metric, std::vector{stroke}));
  std::vector<std::int32_t> half(surface->face_count() / 2);
  std::iota(half.begin(), half.end(), 0);
  for (const EmbedOptions& options :
       {EmbedOptions{.max_error = 0.02}, EmbedOptions{.faces = half}, EmbedOptions{.max_faces_added = 7}}) {
    const EmbeddedSurface made(context, metric, options);
    EXPECT_EQ(made.embedding().options, options);
    const EmbeddedSurface given(context, metric, Embedding(made.embedding()));
    const EmbeddedSurface expected = made.with_metric(drawn), again = given.with_metric(drawn);
    EXPECT_EQ(again.embedding().options, options);
    EXPECT_EQ(again.embedding().mesh.triangles, expected.embedding().mesh.triangles);
    EXPECT_EQ(again.embedding().mesh.lengths, expected.embedding().mesh.lengths);
  }
}

TEST(EmbeddedSurface, RefusesWhatIsNotPartOfIt) {
  const auto surface = shared(shapes::grid(4));
  const SurfaceContext context(surface);
  const EmbeddedSurface embedded(context, MetricSpec::euclidean(), {.max_error = 0});
  EXPECT_THROW(embedded.field(25), InvalidInput);
  EXPECT_THROW(embedded.field(std::vector<SurfacePoint>()), InvalidInput);
  EXPECT_THROW(embedded.locate({99, {1, 0, 0}}), InvalidInput);
  EXPECT_THROW(embedded.field(0).trace(25), InvalidInput);
  EXPECT_THROW(EmbeddedSurface(context, MetricSpec::concave({}), {.max_error = 0}), InvalidInput);
  EXPECT_THROW(EmbeddedSurface(context, std::shared_ptr<const Metric>(), {.max_error = 0}), InvalidInput);
  const auto metric = std::make_shared<const Metric>(make_metric(context, MetricSpec::euclidean()));
  const SurfaceContext other(shared(shapes::grid(5)));
  EXPECT_THROW(EmbeddedSurface(other, metric, {.max_error = 0}), InvalidInput);
  EXPECT_THROW(EmbeddedSurface(other, metric, embedded.embedding()), InvalidInput);
}

TEST(EmbeddedSurface, SaysWhyAFaceHasNoPoints) {
  const shapes::Mesh mesh{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {-2, 0, 0}},
                          .triangles = {{0, 1, 2}, {0, 3, 4}}};
  const EmbeddedSurface embedded(SurfaceContext(shared(mesh)), MetricSpec::euclidean(), {.max_error = 0});
  ASSERT_EQ(embedded.embedding().invalid_left, 1U);
  EXPECT_EQ(message_of([&] {
              embedded.locate({1, {0.2, 0.3, 0.5}}, "seed");
            }),
            "seed: face 1 is a hole of the embedding there");
  const EmbedOptions options{.faces = std::vector<std::int32_t>{1}};
  const SurfaceContext grid(shared(shapes::grid(2)));
  const EmbeddedSurface part(grid, MetricSpec::euclidean(), options);
  EXPECT_EQ(message_of([&] {
              part.locate({2, {0.2, 0.3, 0.5}}, "seed");
            }),
            "seed: face 2 is not among the faces that were embedded");
}

TEST(EmbeddedSurface, OutlivesItsContext) {
  std::optional<EmbeddedField> field;
  {
    const SurfaceContext context(bumpy_torus());
    field = EmbeddedSurface(context, MetricSpec::euclidean(), {.max_error = 0}).field(0);
  }
  EXPECT_EQ(field->trace(100)->to, 100);
}

}  // namespace
}  // namespace seamwire
