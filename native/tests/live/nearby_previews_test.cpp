// SPDX-License-Identifier: GPL-3.0-or-later
//
// Previews on the faces around a seed, on the threads of live wires.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "context/interactive_embedding.hpp"
#include "live/live_wires.hpp"
#include "live/mailbox.hpp"
#include "live/right_of_way.hpp"
#include "live/seed_solver.hpp"
#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/context/surface_context.hpp"
#include "seamwire/live/livewire.hpp"
#include "shapes.hpp"

namespace seamwire {

using namespace detail;

namespace {

constexpr int kSide = 330;
/// Near vertex 0, and halfway to it.
constexpr std::int32_t kTarget = 20 * kSide + 20, kHalfway = 10 * kSide + 10;

/// With enough faces for these previews.
std::shared_ptr<const Surface> large_torus() {
  return live_wires::shared(shapes::bumpy(shapes::torus(kSide, kSide), 0.01));
}

TEST(NearbyPreviews, AreMadeByAThreadThatMakesWayAndEmbedsLater) {
  const auto surface = large_torus();
  const std::size_t metric = std::max(1U, std::thread::hardware_concurrency());
  const SurfaceContext context(surface);
  context.curvature({});
  const auto right_of_way = std::make_shared<RightOfWay>();
  right_of_way->update([] { return true; });
  EventCount events;
  SeedBox seeds(events);
  TargetBox targets(events);
  const LiveSettings settings{.along = Along::kSurface, .turning = 0.0, .loop_turning = {}, .max_error = 0.0};
  SeedSolver solver(metric, context, settings, right_of_way, targets);
  const LiveMetrics metrics{.wires = std::vector(metric + 1, MetricSpec::euclidean())};
  const auto set = std::make_shared<MetricSet>(metrics, std::vector<Scribble>());
  seeds.post({.metrics = set, .preparing = {}, .seed = Pick{0}});
  targets.post(Pick{kTarget});
  const SeedBox::Job job = seeds.take().value();
  const std::jthread thread([&] { seeds.answer(job, [&] { return solver.solve(job, nullptr, seeds); }); });
  const auto wait_for_preview = [&] {
    while (!targets.read().is_newest) std::this_thread::yield();
  };
  wait_for_preview();
  targets.post(Pick{kHalfway});
  wait_for_preview();
  EXPECT_EQ(set->fraction(metric), 0.0) << "it embeds the surface already";
  EXPECT_FALSE(EmbeddedSurface::find(context, MetricSpec::euclidean(), interactive_options(*surface)));
  right_of_way->update([] { return false; });
  while (!set->peek(metric)) std::this_thread::yield();
  seeds.close();
}

bool shows_any(const LiveWires& found) {
  return std::ranges::any_of(found.wires, [](const LiveCandidate& wire) { return !wire.points.empty(); });
}

TEST(NearbyPreviews, OfTheNewestSeedAreSeenBeforeTheSurfaceIsEmbedded) {
  LiveWire live(large_torus(), LiveWireOptions{.max_error = 0.0});
  live.seed({kHalfway});
  while (!shows_any(live.wires({kTarget}))) live.wait(1e-3);
  live.seed({0});  // while other threads are at their previews
  std::vector<double> first(live.wires({kTarget}).wires.size(), 0.0);
  LiveWires found;
  do {
    found = live.wires({kTarget});
    const auto embeddings = live.embeddings();
    for (std::size_t i = 0; i < first.size(); ++i) {
      if (!found.wires[i].points.empty() && !embeddings[i] && first[i] == 0) {
        EXPECT_FALSE(found.wires[i].final);
        first[i] = found.wires[i].length;
      }
    }
    live.wait(1e-3);
  } while (!found.final());
  if (std::ranges::count(first, 0.0) == std::ssize(first)) GTEST_SKIP() << "this thread was kept away for too long";
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] == 0) continue;  // its embedding was quicker
    EXPECT_NEAR(first[i], found.wires[i].length, 0.2 * found.wires[i].length) << i;
  }
}

}  // namespace
}  // namespace seamwire
