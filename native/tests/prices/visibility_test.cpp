// SPDX-License-Identifier: GPL-3.0-or-later
#include "prices/edge_prices.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stop_token>
#include <vector>

#include "seam_problems.hpp"

namespace seamwire {

using namespace detail;

namespace {

TEST(Visibility, OfABallIsHalfOfTheViews) {
  const PlanMesh mesh = plan_mesh(shapes::icosphere(3).surface(), {});
  const Visibility seen = find_visibility(mesh, Vector(0, 0, 3), {});
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_EQ(seen.ambient[v], 1.0) << "nothing covers the sky of a ball";
    const double height = mesh.points[v].normalized().z();
    // Of the half sphere of views, a wedge is seen: (1 + cos angle) / 2.
    EXPECT_NEAR(seen.front[v], 0.5 * (1.0 + height), 0.22) << "of 20 views";
  }
}

TEST(Visibility, WithoutAFrontOnlyTheSkyCounts) {
  const PlanMesh mesh = plan_mesh(shapes::dumbbell(12, 24).surface(), {});
  const Visibility seen = find_visibility(mesh, std::nullopt, {});
  EXPECT_TRUE(seen.front.empty());
  const std::int32_t neck = nearest_vertex(mesh, {0.5, 0.08, 0}), top = nearest_vertex(mesh, {0, 0.45, 0});
  EXPECT_EQ(seen.ambient[top], 1.0);
  EXPECT_LT(seen.ambient[neck], 0.9) << "the balls cover it";
}

TEST(Visibility, InsideABoxIsDark) {
  // A small ball in a large one whose normals point inwards: neither sees the sky.
  shapes::Mesh mesh = shapes::icosphere(2, 0.2);
  const shapes::Mesh outer = shapes::icosphere(2, 1.0);
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), outer.points.begin(), outer.points.end());
  for (const auto& [a, b, c] : outer.triangles) mesh.triangles.push_back({first + a, first + c, first + b});
  const Visibility seen = find_visibility(plan_mesh(mesh.surface(), {}), Vector(0, 0, 1), {});
  EXPECT_EQ(*std::ranges::max_element(seen.ambient), 0.0);
  EXPECT_EQ(*std::ranges::max_element(seen.front), 0.0);
}

TEST(Visibility, IsCancelled) {
  const PlanMesh mesh = plan_mesh(shapes::icosphere(3).surface(), {});
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(find_visibility(mesh, std::nullopt, {.stop = stop.get_token(), .progress = {}}), Cancelled);
}

}  // namespace
}  // namespace seamwire
