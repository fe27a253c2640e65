// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/bucket_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace seamwire {

using namespace detail;

namespace {

std::vector<double> pop_all(BucketQueue& queue) {
  std::vector<double> keys;
  while (!queue.empty()) keys.push_back(queue.pop().key);
  return keys;
}

TEST(BucketQueue, ANewQueueIsEmpty) { EXPECT_TRUE(BucketQueue(1.0).empty()); }

TEST(BucketQueue, ReturnsKeysInOrderWhereStepsMayBeShort) {
  BucketQueue queue(1.0);
  for (const double key : {5.0, 0.25, 3.0, 0.125, 4.0}) queue.push(key, 0, 0.0);
  EXPECT_EQ(pop_all(queue), (std::vector{0.125, 0.25, 3.0, 4.0, 5.0}));
}

TEST(BucketQueue, ReturnsEqualKeysByTheirStates) {
  BucketQueue queue(1.0);
  for (const std::int32_t state : {3, 1, 2}) queue.push(0.0, state, 0.0);
  for (const std::int32_t state : {1, 2, 3}) EXPECT_EQ(queue.pop().state, state);
}

TEST(BucketQueue, ReturnsKeysBeyondAllBuckets) {
  BucketQueue queue(1.0);  // its buckets hold keys up to 8
  for (const double key : {1e6, 100.0, 1.0, 1e9}) queue.push(key, 0, 0.0);
  EXPECT_EQ(pop_all(queue), (std::vector{1.0, 100.0, 1e6, 1e9}));
}

TEST(BucketQueue, KeepsTheOrderWithStepsThatAreTooSmallForBuckets) {
  BucketQueue queue(std::numeric_limits<double>::denorm_min());
  for (const double key : {2.0, 0.0, 1.0}) queue.push(key, 0, 0.0);
  EXPECT_EQ(pop_all(queue), (std::vector{0.0, 1.0, 2.0}));
}

TEST(BucketQueue, NoKeyLeftIsBelowItsFloor) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> step(0.0, 2.0);
  BucketQueue queue(1.0);
  std::multiset<double> keys;
  const auto push = [&](double key) {
    queue.push(key, 0, 0.0);
    keys.insert(key);
  };
  for (int i = 0; i < 50; ++i) push(step(random));
  for (int i = 0; i < 2000 && !queue.empty(); ++i) {
    EXPECT_LE(queue.floor(), *keys.begin());
    const double key = queue.pop().key;
    keys.erase(keys.find(key));
    if (i < 1000) push(key + step(random));
  }
  EXPECT_TRUE(keys.empty());
}

/// A search that adds random steps to what comes out, as searches along edges do.
TEST(BucketQueue, ReturnsWhatABinaryHeapReturns) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> step(0.0, 3.0);
  BucketQueue queue(1.0);
  std::priority_queue<std::pair<double, std::int32_t>, std::vector<std::pair<double, std::int32_t>>, std::greater<>>
      heap;
  const auto push = [&](double key, std::int32_t state) {
    queue.push(key, state, 0.0);
    heap.emplace(key, state);
  };
  push(0.0, 0);
  for (std::int32_t i = 1; !heap.empty(); ++i) {
    const BucketQueue::Entry entry = queue.pop();
    ASSERT_EQ(std::pair(entry.key, entry.state), heap.top());
    heap.pop();
    if (i > 3000) continue;
    push(entry.key + step(random), 2 * i);
    push(entry.key + step(random), 2 * i + 1);
  }
  EXPECT_TRUE(queue.empty());
}

/// A state whose steps all cost more than a bucket's width may come out before one of a slightly smaller key.
TEST(BucketQueue, MixesOnlyKeysOfOneBucketWhereStepsAreLong) {
  constexpr double kWidth = 1.0 / 128;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> key(0.0, 20.0);
  BucketQueue queue(1.0);
  for (int i = 0; i < 1000; ++i) queue.push(key(random), i, 1.0);
  double most = 0.0;
  while (!queue.empty()) {
    const double next = queue.pop().key;
    EXPECT_GT(next, most - kWidth);
    most = std::max(most, next);
  }
}

}  // namespace
}  // namespace seamwire
