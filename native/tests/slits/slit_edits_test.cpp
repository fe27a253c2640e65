// SPDX-License-Identifier: GPL-3.0-or-later
#include "slits/slit_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "shapes.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Chain = std::vector<std::int32_t>;

// Vertex 11 row + column of a square of 10 x 10 cells.
PlanMesh square() { return plan_mesh(shapes::grid(10).surface(), {}); }

const Slit kMirrored = {.path = {0, 1, 2, 3, 14, 25, 36, 47}, .image = {3, 4, 5, 6, 7}};  // leaves the plane at 3

TEST(SlitEdits, LengthIsTheSumOfEdges) {
  const PlanMesh mesh = square();
  EXPECT_NEAR(chain_length(mesh, kMirrored.path), 0.7, 1e-12);
  EXPECT_EQ(chain_length(mesh, Chain{5}), 0.0);
  EXPECT_EQ(chain_length(mesh, {}), 0.0);
}

TEST(SlitEdits, AShorterSlitIsTheStartOfAnother) {
  const PlanMesh mesh = square();
  for (const double share : {0.2, 0.5, 0.6, 0.85}) {
    const std::optional<Slit> left = shortened(mesh, kMirrored, share);
    ASSERT_TRUE(left);
    EXPECT_LE(chain_length(mesh, left->path), share * 0.7 + 1e-12);
    EXPECT_GT(chain_length(mesh, left->path), share * 0.7 - 0.1 - 1e-12) << "one edge more is too long";
    EXPECT_TRUE(std::ranges::equal(left->path, std::span(kMirrored.path).first(left->path.size())));
    // The image is as long as the path off the mirror plane.
    const std::size_t off_plane = left->path.size() > 4 ? left->path.size() - 3 : 0;
    EXPECT_EQ(left->image.size(), off_plane) << share;
    EXPECT_TRUE(std::ranges::equal(left->image, std::span(kMirrored.image).first(left->image.size())));
  }
  EXPECT_FALSE(shortened(mesh, kMirrored, 0.0));
}

TEST(SlitEdits, OtherSlitsNeedTheirStarts) {
  const PlanMesh mesh = square();
  const std::vector<Slit> slits = {{.path = {0, 1, 2, 3, 4}, .image = {}},
                                   {.path = {3, 14, 25}, .image = {}},
                                   {.path = {25, 26, 27}, .image = {}},
                                   {.path = {60, 61}, .image = {}, .is_needed = true}};
  EXPECT_NEAR(needed_share(mesh, slits, 0), 0.75, 1e-12);
  EXPECT_NEAR(needed_share(mesh, slits, 1), 1.0, 1e-12);
  EXPECT_EQ(needed_share(mesh, slits, 2), 0.0);
  EXPECT_EQ(needed_share(mesh, slits, 3), 1.0);
  // Without a slit, those that start on it go too.
  EXPECT_EQ(without_slit(slits, 2).size(), 3U);
  EXPECT_EQ(without_slit(slits, 1).size(), 2U);
  ASSERT_EQ(without_slit(slits, 0).size(), 1U);
  EXPECT_EQ(without_slit(slits, 0).front().path, slits[3].path);
  EXPECT_EQ(without_slit(slits, 3).size(), 4U) << "it is needed";
}

TEST(SlitEdits, ASlitThatGoesOnIsOneSlit) {
  const PlanMesh mesh = square();
  const std::vector<Slit> slits = {{.path = {0, 1, 2}, .image = {}}};
  const std::vector<Slit> longer = with_slit(mesh, slits, {.path = {2, 3, 4}, .image = {}});
  ASSERT_EQ(longer.size(), 1U);
  EXPECT_EQ(longer.front().path, (Chain{0, 1, 2, 3, 4}));
  const std::vector<Slit> branched = with_slit(mesh, slits, {.path = {1, 12}, .image = {}});
  EXPECT_EQ(branched.size(), 2U);
  // The first one ends where another one starts: a third one there is no continuation.
  const std::vector<Slit> two = {{.path = {0, 1, 2}, .image = {}}, {.path = {2, 13}, .image = {}}};
  EXPECT_EQ(with_slit(mesh, two, {.path = {2, 3}, .image = {}}).size(), 3U);
  // A slit that has reached another boundary loop ends there. One that goes on to a loop goes whole or not at all.
  const std::vector<Slit> join = {{.path = {0, 1, 2}, .image = {}, .is_join = true}};
  EXPECT_EQ(with_slit(mesh, join, {.path = {2, 3}, .image = {}}).size(), 2U);
  EXPECT_TRUE(with_slit(mesh, slits, {.path = {2, 3}, .image = {}, .is_join = true}).front().is_join);
}

}  // namespace
}  // namespace seamwire
