// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/strip_tree.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace seamwire::detail {
namespace {

using Pairs = std::set<std::pair<std::int32_t, std::int32_t>>;

/// The pairs that a tree of segments visits, and how many visits there are.
std::pair<Pairs, std::size_t> close_pairs(const std::vector<Eigen::Vector2d>& ends, double reach) {
  const Task task;
  Poll poll(task, 0.0, 0.0, 1);
  const StripTree tree(ends, 2, poll);
  Pairs pairs;
  std::size_t visits = 0;
  const auto skips_nothing = [](const StripTree::Part&, const StripTree::Part&) { return false; };
  ClosePairs(tree, tree, reach, skips_nothing, poll).any([&](std::int32_t i, std::int32_t j) {
    ++visits;
    pairs.insert({i, j});
    return false;
  });
  return {pairs, visits};
}

TEST(StripTree, FindsAllClosePairsOnce) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(-1.0, 1.0);
  for (const double length : {0.01, 0.3, 2.0}) {
    std::vector<Eigen::Vector2d> ends;
    for (int i = 0; i < 300; ++i) {
      ends.emplace_back(at(random), at(random));
      ends.emplace_back(ends.back() + length * Eigen::Vector2d(at(random), at(random)));
    }
    const double reach = 0.05;
    const auto [pairs, visits] = close_pairs(ends, reach);
    EXPECT_EQ(pairs.size(), visits);
    std::size_t close = 0;
    for (std::int32_t i = 0; i < 300; ++i) {
      for (std::int32_t j = i + 1; j < 300; ++j) {
        double least = 1e9;  // between points of both
        for (int s = 0; s <= 20; ++s) {
          for (int t = 0; t <= 20; ++t) {
            const Eigen::Vector2d one = ends[2 * i] + s / 20.0 * (ends[2 * i + 1] - ends[2 * i]);
            const Eigen::Vector2d other = ends[2 * j] + t / 20.0 * (ends[2 * j + 1] - ends[2 * j]);
            least = std::min(least, (one - other).norm());
          }
        }
        if (least > reach) continue;
        ++close;
        EXPECT_TRUE(pairs.contains({i, j})) << i << ", " << j;
      }
    }
    EXPECT_GT(close, 50U);
  }
}

TEST(StripTree, TellsTheTeethOfACombApart) {
  std::vector<Eigen::Vector2d> ends;
  constexpr int kTeeth = 2000;
  const Eigen::Rotation2Dd turn(0.7);
  const auto add = [&](double x, double y, double to_x, double to_y) {
    ends.emplace_back(turn * Eigen::Vector2d(x, y));
    ends.emplace_back(turn * Eigen::Vector2d(to_x, to_y));
  };
  for (int i = 0; i < kTeeth; ++i) {
    add(4 * i, 0, 4 * i, kTeeth);
    add(4 * i, kTeeth, 4 * i + 2, kTeeth);
    add(4 * i + 2, kTeeth, 4 * i + 2, 0);
    add(4 * i + 2, 0, 4 * i + 4, 0);
  }
  EXPECT_LT(close_pairs(ends, 0.5).second, 8U * kTeeth) << "their boxes all meet";
}

}  // namespace
}  // namespace seamwire::detail
