// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>

#include "detail/poll.hpp"
#include "graph/cotree.hpp"
#include "graph/disjoint_sets.hpp"
#include "graph/edge_chains.hpp"
#include "graph/loop_erasure.hpp"
#include "graph/shortest_paths.hpp"

namespace seamwire::detail {
namespace {

using Nodes = std::vector<std::int32_t>;

TEST(EdgeChains, EndAtJunctionsAndWhereTheyAreToldTo) {
  // A path 0 1 2 3 that meets a triangle 3 4 5 and a loose edge 3 6, and a separate triangle 7 8 9.
  const std::vector<EdgeChains::Edge> edges{{1, 0}, {1, 2}, {3, 2}, {3, 4}, {4, 5},
                                            {5, 3}, {3, 6}, {8, 7}, {8, 9}, {7, 9}};
  const auto nowhere = [](std::int32_t) { return false; };
  EXPECT_EQ(EdgeChains(10, edges).all(nowhere), (std::vector<Nodes>{{0, 1, 2, 3}, {3, 4, 5, 3}, {3, 6}, {7, 8, 9, 7}}));
  EXPECT_EQ(EdgeChains(10, edges).all([](std::int32_t node) { return node == 2 || node == 9; }),
            (std::vector<Nodes>{{0, 1, 2}, {2, 3}, {3, 4, 5, 3}, {3, 6}, {9, 8, 7, 9}}));
}

TEST(Cotree, TakesEdgesInTheirOrderAndLeavesThoseThatCloseLoops) {
  const std::vector<std::array<std::int32_t, 2>> sides{{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 0}, {4, 4}};
  const Task task;
  Cotree cotree(
      6, sides.size(), [&](std::size_t i) { return sides[i]; }, Poll(task));
  EXPECT_EQ(cotree.crossed, (Nodes{0, 1, 3}));
  EXPECT_EQ(cotree.generators, (Nodes{2, 4, 5}));
  EXPECT_EQ(cotree.parts.numbering().of, (Nodes{0, 0, 0, 0, 1, 2}));
}

TEST(LoopErasure, LeavesOutLoopsAsTheWalkClosesThem) {
  EXPECT_EQ(without_loops(Nodes{}), Nodes{});
  EXPECT_EQ(without_loops(Nodes{4, 2, 9}), (Nodes{4, 2, 9}));
  EXPECT_EQ(without_loops(Nodes{0, 1, 2, 3, 1, 4}), (Nodes{0, 1, 4}));
  EXPECT_EQ(without_loops(Nodes{0, 1, 2, 3, 1, 5, 2, 6}), (Nodes{0, 1, 5, 2, 6})) << "2 is on a loop that is gone";
  EXPECT_EQ(without_loops(Nodes{7, 8, 7}), Nodes{7});
  Nodes there_and_back(20000);
  for (std::size_t i = 0; i < there_and_back.size(); ++i) {
    there_and_back[i] = static_cast<std::int32_t>(std::min(i, there_and_back.size() - 1 - i));
  }
  EXPECT_EQ(without_loops(there_and_back), Nodes{0});
}

TEST(EdgeChains, TwoEdgesBetweenTheSameNodesAreAClosedChain) {
  const std::vector<EdgeChains::Edge> edges{{0, 1}, {1, 0}};
  EdgeChains chains(2, edges);
  const EdgeChains::Chain chain = chains.follow(1, 0, [](std::int32_t) { return false; });
  EXPECT_EQ(chain.nodes, (Nodes{1, 0, 1}));
  EXPECT_EQ(chain.edges, (Nodes{0, 1}));
  EXPECT_TRUE(chains.is_taken(1));
}

TEST(ShortestPaths, AreThoseOfRelaxingAllEdgesAgainAndAgain) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(0.1, 1.0);
  constexpr std::int32_t kNodes = 40;
  struct Edge {
    std::int32_t a, b;
    double length;
  };
  std::vector<Edge> edges;
  for (int i = 0; i < 70; ++i) {
    const auto any = [&] { return static_cast<std::int32_t>(random() % kNodes); };
    edges.push_back({any(), any(), number(random)});
  }
  constexpr double kUnreached = std::numeric_limits<double>::infinity();
  const std::array<std::int32_t, 2> from{3, 17};
  std::vector<double> expected(kNodes, kUnreached), found = expected;
  for (const std::int32_t v : from) expected[v] = 0.0;
  for (std::int32_t round = 0; round < kNodes; ++round) {
    for (const auto& [a, b, length] : edges) {
      expected[b] = std::min(expected[b], expected[a] + length);
      expected[a] = std::min(expected[a], expected[b] + length);
    }
  }
  double last = 0.0;
  Nodes before(kNodes, -1);
  find_shortest_paths(from, found, [&](std::int32_t v, const auto& step) {
    EXPECT_LE(last, found[v]);
    last = found[v];
    for (const auto& [a, b, length] : edges) {
      if (a == v && step(b, length)) before[b] = v;
      if (b == v && step(a, length)) before[a] = v;
    }
  });
  EXPECT_EQ(found, expected);
  for (std::int32_t v = 0; v < kNodes; ++v) {
    EXPECT_EQ(before[v] >= 0, found[v] > 0.0 && found[v] < kUnreached);
    if (before[v] >= 0) {
      EXPECT_LT(found[before[v]], found[v]);
    }
  }
}

TEST(DisjointSets, AreNumberedByTheirLeastNumbers) {
  DisjointSets sets(6);
  sets.join(5, 1);
  sets.join(4, 2);
  sets.join(2, 5);
  const DisjointSets::Numbering numbering = sets.numbering();
  EXPECT_EQ(numbering.of, (Nodes{0, 1, 1, 2, 1, 1}));
  EXPECT_EQ(numbering.count, 3);
}

}  // namespace
}  // namespace seamwire::detail
