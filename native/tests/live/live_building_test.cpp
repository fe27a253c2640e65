// SPDX-License-Identifier: GPL-3.0-or-later
//
// Live wires that build their surface themselves.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "live/live_wires.hpp"
#include "seamwire/live/livewire.hpp"
#include "seamwire/metric/scribble.hpp"
#include "shapes.hpp"
#include "surface/corner_fans.hpp"

namespace seamwire {

using namespace detail;
using namespace live_wires;

namespace {

/// A live wire that builds the mesh's surface itself.
LiveWire live_on(const shapes::Mesh& mesh, const LiveWireOptions& options = kPlain) {
  return LiveWire({mesh.points, mesh.triangles}, options);
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
    EXPECT_EQ(corner_fans(*live.surface()).twins, corner_fans(*surface).twins);
    EXPECT_EQ(*live.feature_strength(), principal_curvatures(*surface).difference());
  }
}

TEST(LiveWireBuildingItsSurface, RunsAlongTheRealEdgesThatItIsGiven) {
  const Surface quads = shapes::quad_cylinder(12, 6, 0.5, 1.0).surface();
  const LiveWire live({quads.points(), quads.triangles(), quads.edges()}, kAlongEdges);
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
    LiveWire live({mesh.points, mesh.triangles, edges}, kAlongEdges);
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
