// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/minimum_cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace seamwire {

using namespace detail;

namespace {

struct Link {
  std::int32_t a, b;
  double price;
};

double price_of(const std::vector<Link>& links, const std::vector<std::uint8_t>& side) {
  double sum = 0.0;
  for (const Link& link : links) sum += side[link.a] != side[link.b] ? link.price : 0.0;
  return sum;
}

std::vector<std::uint8_t> cut(std::size_t nodes, const std::vector<Link>& links, std::int32_t source,
                              std::int32_t sink) {
  MinimumCut network(nodes);
  for (const Link& link : links) network.add(link.a, link.b, link.price);
  return network.source_side(source, sink, {});
}

TEST(MinimumCut, PartsAChainAtItsCheapestLink) {
  const std::vector<Link> links = {{0, 1, 3.0}, {1, 2, 1.0}, {2, 3, 2.0}};
  EXPECT_EQ(cut(4, links, 0, 3), (std::vector<std::uint8_t>{1, 1, 0, 0}));
  EXPECT_EQ(cut(4, links, 3, 0), (std::vector<std::uint8_t>{0, 0, 1, 1}));
}

TEST(MinimumCut, CutsNothingBetweenNodesThatAreApart) {
  EXPECT_EQ(cut(4, {{0, 1, 1.0}, {2, 3, 1.0}}, 0, 3), (std::vector<std::uint8_t>{1, 1, 0, 0}));
}

TEST(MinimumCut, IsTheCheapestOfAllPartitions) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> price(0.0, 1.0);
  constexpr std::int32_t kNodes = 8;
  for (int round = 0; round < 200; ++round) {
    std::vector<Link> links;
    for (std::int32_t a = 0; a < kNodes; ++a) {
      for (std::int32_t b = a + 1; b < kNodes; ++b) {
        if (random() % 2 == 0) links.push_back({a, b, random() % 8 == 0 ? 0.0 : price(random)});
      }
    }
    const std::vector<std::uint8_t> found = cut(kNodes, links, 0, kNodes - 1);
    ASSERT_EQ(found.front(), 1);
    ASSERT_EQ(found.back(), 0);
    double least = std::numeric_limits<double>::infinity();
    for (unsigned inner = 0; inner < 1U << (kNodes - 2); ++inner) {
      std::vector<std::uint8_t> side(kNodes, 0);
      side[0] = 1;
      for (std::size_t v = 1; v + 1 < kNodes; ++v) side[v] = inner >> (v - 1) & 1U;
      least = std::min(least, price_of(links, side));
    }
    ASSERT_NEAR(price_of(links, found), least, 1e-9) << "round " << round;
  }
}

}  // namespace
}  // namespace seamwire
