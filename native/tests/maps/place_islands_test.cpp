// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/maps/place_islands.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace seamwire {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

/// Squares of two triangles.
struct Squares : NewIslands {
  /// Corners lie at `low + size * turned corner`.
  void add(const Vector2d& low, const Vector2d& size, double area, double angle = 0.0,
           const Vector2d& size_now = {1.0, 1.0}) {
    const auto first = static_cast<std::int32_t>(after.size());
    const Eigen::Rotation2Dd turn(angle);
    for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 1), Vector2d(0, 1)}) {
      before.emplace_back(low + turn * size.cwiseProduct(corner));
      after.emplace_back(size_now.cwiseProduct(corner));
    }
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
    islands.insert(islands.end(), 2, static_cast<std::int32_t>(areas.size()));
    areas.push_back(area);
  }
  std::vector<std::vector<Vector2d>> placed(const std::vector<AlignedBox2d>& taken) const {
    const auto placements = place_islands(*this, taken);
    std::vector<std::vector<Vector2d>> all(areas.size());
    for (std::size_t c = 0; c < after.size(); ++c) {
      all[c / 4].emplace_back(placements[c / 4] * after[c].homogeneous());
    }
    return all;
  }
  std::vector<AlignedBox2d> boxes(const std::vector<AlignedBox2d>& taken) const {
    std::vector<AlignedBox2d> found;
    for (const auto& corners : placed(taken)) {
      found.emplace_back();
      for (const Vector2d& corner : corners) found.back().extend(corner);
    }
    return found;
  }
};

AlignedBox2d box(double left, double bottom, double width, double height) {
  return {Vector2d(left, bottom), Vector2d(left + width, bottom + height)};
}

void expect_apart(const std::vector<AlignedBox2d>& boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(boxes[i].intersects(boxes[j])) << i << " " << j;
  }
}

constexpr double kArea = 0.0625;  // of a square of a quarter

TEST(PlaceIslands, AnIslandLiesWhereItWasAsLargeAndTurnedAsItWas) {
  for (const double angle : {0.0, 0.5 * std::numbers::pi, 0.3}) {
    Squares islands;
    islands.add({0.6, 0.25}, {0.25, 0.25}, kArea, angle, {3.0, 3.0});
    const auto placed = islands.placed({box(0.0, 0.0, 0.2, 1.0)});
    for (std::size_t c = 0; c < 4; ++c) EXPECT_LT((placed[0][c] - islands.before[c]).norm(), 2.0 / 512) << angle;
  }
}

TEST(PlaceIslands, WhatIsInTheWayIsKeptClearOf) {
  Squares islands;
  islands.add({0.5, 0.25}, {0.25, 0.25}, kArea);
  const AlignedBox2d there = box(0.55, 0.3, 0.1, 0.1);
  const AlignedBox2d found = islands.boxes({there}).front();
  expect_apart({found, there});
  EXPECT_LT((found.center() - Vector2d(0.625, 0.375)).norm(), 0.21);
  EXPECT_TRUE(box(0, 0, 1, 1).contains(found));
}

TEST(PlaceIslands, NewIslandsKeepClearOfEachOther) {
  Squares islands;
  for (int i = 0; i < 5; ++i) islands.add({0.5, 0.25}, {0.25, 0.25}, kArea);
  std::vector<AlignedBox2d> found = islands.boxes({box(0, 0, 0.1, 0.1)});
  found.push_back(box(0, 0, 0.1, 0.1));
  expect_apart(found);
}

TEST(PlaceIslands, WithoutRoomTheyLieToTheRightOfAll) {
  Squares islands;
  for (int i = 0; i < 3; ++i) islands.add({0.1, 0.1}, {0.5, 0.5}, 0.36);
  const std::vector<AlignedBox2d> found = islands.boxes({box(0, 0, 1.2, 1)});
  expect_apart(found);
  for (const AlignedBox2d& each : found) {
    EXPECT_GT(each.min().x(), 1.2);
    EXPECT_LE(each.max().y(), 1.01);
  }
}

TEST(PlaceIslands, AnIslandInAnotherTileStaysInIt) {
  Squares islands;
  islands.add({2.5, -0.75}, {0.25, 0.25}, kArea);
  EXPECT_LT((islands.boxes({box(0, 0, 1, 1)}).front().min() - Vector2d(2.5, -0.75)).norm(), 2.0 / 512);
}

TEST(PlaceIslands, AnIslandIsTurnedAsItIsSeenOnAWideImage) {
  Squares islands;
  islands.add({0.0, 0.0}, {0.0625, 0.25}, 0.25 * kArea);
  const Eigen::Rotation2Dd turn(0.6);
  for (Vector2d& place : islands.after) place = turn * place;
  islands.aspects = {4.0};
  const auto found = islands.placed({box(0.9, 0.9, 0.1, 0.1)}).front();
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_LT((found[c] - found[0] - (islands.before[c] - islands.before[0])).norm(), 1e-12);
  }
}

TEST(PlaceIslands, AStraightIslandKeepsItsSidesAlongTheAxes) {
  for (const double angle : {0.2, 1.4, 2.9, -1.0}) {
    Squares islands;
    islands.add({0.5, 0.5}, {0.25, 0.25}, kArea, angle);
    islands.straight = {1};
    const auto found = islands.placed({box(0.9, 0.9, 0.1, 0.1)}).front();
    for (std::size_t c = 0; c < 4; ++c) {
      const Vector2d side = found[(c + 1) % 4] - found[c];
      EXPECT_LT(side.cwiseAbs().minCoeff(), 1e-12);
      EXPECT_NEAR(side.cwiseAbs().maxCoeff(), 0.25, 1e-12);
      const Vector2d wanted = islands.before[(c + 1) % 4] - islands.before[c];
      EXPECT_GE(side.dot(wanted), 0.0625 * std::cos(0.25 * std::numbers::pi) - 1e-12) << "the nearest of four";
    }
  }
}

TEST(PlaceIslands, AThousandIslandsFindRoomSideBySide) {
  std::mt19937 dice(5);
  std::uniform_real_distribution<double> length(0.01, 0.024), middle(0.1, 0.9);
  for (const bool is_new : {false, true}) {
    Squares islands;
    double away = 0.0;
    for (int i = 0; i < 1000; ++i) {
      const Vector2d size(length(dice), length(dice)), low(middle(dice), middle(dice));
      islands.add(low, is_new ? Vector2d(0, 0) : size, 0.0, 0.0, size);
      if (is_new && i % 2 == 0) islands.before.back().x() = std::numeric_limits<double>::quiet_NaN();
    }
    const std::vector<AlignedBox2d> found = islands.boxes({box(0, 0, 0.3, 1)});
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_GT(found[i].min().x(), 0.3);
      EXPECT_LE(found[i].max().maxCoeff(), 1.0);
      EXPECT_LT((found[i].sizes() - islands.after[4 * i + 2]).norm(), 1e-12);
      away += (found[i].center() - islands.before[4 * i]).norm() / 1000.0;
    }
    expect_apart(found);
    EXPECT_TRUE(is_new || away < 0.15) << away;
  }
}

TEST(PlaceIslands, WrongValuesAreRefused) {
  Squares islands;
  islands.add({0.5, 0.25}, {0.25, 0.25}, kArea);
  const auto expect_refusal = [&](auto&& change) {
    Squares wrong = islands;
    change(wrong);
    EXPECT_THROW(place_islands(wrong, {}), InvalidInput);
  };
  expect_refusal([](Squares& wrong) { wrong.after.back().x() = std::numeric_limits<double>::quiet_NaN(); });
  expect_refusal([](Squares& wrong) { wrong.after.pop_back(); });
  expect_refusal([](Squares& wrong) { wrong.triangles.back()[1] = 4; });
  expect_refusal([](Squares& wrong) { wrong.islands.back() = 1; });
  expect_refusal([](Squares& wrong) { wrong.areas.back() = -1.0; });
  expect_refusal([](Squares& wrong) { wrong.aspects = {0.0}; });
  expect_refusal([](Squares& wrong) { wrong.straight = {0, 1}; });
}

}  // namespace
}  // namespace seamwire
