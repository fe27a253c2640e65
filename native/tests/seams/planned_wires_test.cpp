// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/planned_wires.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "shapes.hpp"

namespace seamwire::detail {
namespace {

using Chain = SlitChains::Chain;
using Chains = std::vector<Chain>;

std::vector<Slit> slits(const Chains& paths) {
  std::vector<Slit> slits;
  for (const Chain& path : paths) slits.push_back({.path = path, .image = {}});
  return slits;
}

TEST(SlitChains, MeetWhereASlitStartsOrEndsOnAnotherOne) {
  EXPECT_EQ(SlitChains(slits({{0, 1, 2, 3, 4}, {1, 5, 6, 3}})).chains,
            (Chains{{0, 1}, {1, 2, 3}, {3, 4}, {1, 5, 6, 3}}));
}

TEST(SlitChains, MeetWhereSlitsCross) {
  EXPECT_EQ(SlitChains(slits({{0, 1, 2}, {3, 1, 4}})).chains, (Chains{{0, 1}, {1, 2}, {3, 1}, {1, 4}}));
}

TEST(SlitChains, HaveSharedEdgesOnce) {
  EXPECT_EQ(SlitChains(slits({{0, 1, 2, 3}, {4, 2, 1, 5}})).chains, (Chains{{0, 1}, {1, 2}, {2, 3}, {4, 2}, {1, 5}}));
}

TEST(SlitChains, KeepALoopWhole) { EXPECT_EQ(SlitChains(slits({{0, 1, 2, 0}})).chains, (Chains{{0, 1, 2, 0}})); }

/// The numbers of wires that touch, and where.
std::vector<std::pair<std::size_t, std::int32_t>> touches(const Chains& chains, const std::vector<double>& away,
                                                          const std::vector<Edge>& rim = {}) {
  std::vector<MarkedChain> wires;
  for (std::size_t i = 0; i < chains.size(); ++i) wires.push_back({chains[i], away[i]});
  std::vector<std::pair<std::size_t, std::int32_t>> found;
  for (const WireTouch& touch : find_touches(wires, Rim(rim), {})) found.emplace_back(touch.wire, touch.vertex);
  return found;
}
using Touches = std::vector<std::pair<std::size_t, std::int32_t>>;

TEST(WireTouches, WiresMayMeetAtTheirEnds) {
  EXPECT_EQ(touches({{0, 1, 2}, {2, 3, 4}, {2, 5, 0}}, {0.1, 0.2, 0.3}), Touches());
}

TEST(WireTouches, TheWireFartherFromItsSlitIsAtFault) {
  EXPECT_EQ(touches({{0, 1, 2, 3}, {4, 2, 5}}, {0.1, 0.2}), (Touches{{1, 2}}));
  EXPECT_EQ(touches({{0, 1, 2, 3}, {4, 2, 5}}, {0.2, 0.1}), (Touches{{0, 2}}));
  EXPECT_EQ(touches({{0, 1, 2, 3}, {4, 5, 2}}, {0.1, 0.2}), (Touches{{0, 2}})) << "an end is on its slit";
}

TEST(WireTouches, WiresMayShareEdgesFromACommonEnd) {
  EXPECT_EQ(touches({{0, 1, 2, 3}, {4, 2, 1, 0}}, {0.1, 0.2}), Touches());
  EXPECT_EQ(touches({{0, 1, 2, 3}, {0, 1, 2}}, {0.1, 0.2}), Touches());
  EXPECT_EQ(touches({{0, 1, 2, 3, 4, 5}, {0, 1, 6, 4, 7}}, {0.1, 0.2}), (Touches{{1, 4}})) << "but not meet again";
  EXPECT_EQ(touches({{0, 1, 2, 3}, {3, 2, 1, 0}}, {0.1, 0.2}), (Touches{{1, 2}})) << "nor all edges";
}

TEST(WireTouches, WiresMayRunAlongTheRimOnlyWhereTheyLeaveIt) {
  const std::vector<Edge> rim = {{0, 1}, {1, 2}, {2, 3}, {3, 4}};
  EXPECT_EQ(touches({{0, 1, 5, 6}}, {0.1}, rim), Touches());
  EXPECT_EQ(touches({{6, 5, 3, 4}}, {0.1}, rim), Touches());
  EXPECT_EQ(touches({{0, 5, 2, 6}}, {0.1}, rim), (Touches{{0, 2}}));
  EXPECT_EQ(touches({{0, 1, 2}}, {0.1}, rim), (Touches{{0, 1}})) << "it would cut nothing";
}

TEST(WireTouches, CanBeCancelled) {
  const Chains chains{{0, 1, 2}};
  const std::vector<MarkedChain> wires{{chains[0], 0.0}};
  const Task task{.stop = {}, .progress = [](double) { return false; }};
  EXPECT_THROW(find_touches(wires, Rim({}), task), Cancelled);
}

TEST(WireTouches, AWireDoesNotTouchItself) { EXPECT_EQ(touches({{0, 1, 2, 3, 1, 4}}, {0.1}), (Touches{{0, 1}})); }

/// A wall that rises above a curved valley 0-1-2-3-4, and flat ground with the edge 0-4 beside the valley. The wall has
/// rows 5 to 9, 10 to 14 and 15 to 19.
shapes::Mesh wall_above_ground() {
  constexpr std::int32_t kColumns = 5, kRows = 4;
  shapes::Mesh mesh;
  for (int row = 0; row < kRows; ++row) {
    for (int i = 0; i < kColumns; ++i) {
      const double along = 0.25 * i;
      mesh.points.emplace_back(3.0 * along, -0.6 * std::sin(std::numbers::pi * along) - 0.05 * row, row);
    }
  }
  for (std::int32_t row = 0; row + 1 < kRows; ++row) {
    for (std::int32_t i = 0; i + 1 < kColumns; ++i) {
      const std::int32_t a = row * kColumns + i, b = a + 1, c = b + kColumns, d = a + kColumns;
      mesh.triangles.push_back({a, d, c});
      mesh.triangles.push_back({a, c, b});
    }
  }
  for (std::int32_t i = 1; i + 1 < kColumns; ++i) mesh.triangles.push_back({0, i, i + 1});
  mesh.triangles.push_back({0, kColumns - 1, static_cast<std::int32_t>(mesh.points.size())});
  mesh.points.emplace_back(1.5, 3.0, 0.0);
  return mesh;
}

/// The chains that wires across the surface of that wall mark, for slits without seeds between their ends.
Chains wires_on_wall(const Chains& paths, std::vector<double> weights = {}) {
  const SurfaceContext context(std::make_shared<const Surface>(wall_above_ground().surface()));
  const PlanMesh mesh = plan_mesh(*context.surface(), {});
  const PlannedWires wires(context, Along::kSurface, {.max_anisotropy = 10.0}, Rim({}), std::move(weights), {});
  SlitChains slits;
  slits.chains = paths;
  slits.size = 100.0;
  Chains found;
  for (const PlannedWire& wire : wires.along(mesh, std::vector{slits}, {})) found.push_back(wire.vertices);
  return found;
}

TEST(PlannedWires, AWireOfAOneEdgeSlitIsLaidOnItsEdgeWhereItTouchesAnotherOne) {
  const Chain slit = {0, 4}, valley = {0, 1, 2, 3, 4}, upwards = {2, 7, 12, 17};
  EXPECT_EQ(wires_on_wall({slit}), (Chains{valley}));
  EXPECT_EQ(wires_on_wall({slit, upwards}), (Chains{slit, upwards}));
}

TEST(PlannedWires, AWireIsLaidOnItsSlitWhereItsCurveComesToAnInfiniteWeight) {
  const Chain slit = {0, 4}, valley = {0, 1, 2, 3, 4};
  std::vector<double> weights(wall_above_ground().points.size(), 1.0);
  EXPECT_EQ(wires_on_wall({slit}, weights), (Chains{valley}));
  weights[2] = kInfinity;
  EXPECT_EQ(wires_on_wall({slit}, weights), (Chains{slit}));
}

}  // namespace
}  // namespace seamwire::detail
