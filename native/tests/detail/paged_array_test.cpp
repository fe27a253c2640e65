// SPDX-License-Identifier: GPL-3.0-or-later
#include "detail/paged_array.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

namespace seamwire {

using namespace detail;

namespace {

constexpr std::size_t kMany = 10'000;  // several pages, the last one not full

PagedArray<int> counting(std::size_t size) {
  PagedArray<int> array;
  array.resize(size);
  for (std::size_t i = 0; i < size; ++i) array.edit(i) = static_cast<int>(i);
  return array;
}

std::size_t shared_items(const PagedArray<int>& a, const PagedArray<int>& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) count += a.shares(b, i) ? 1 : 0;
  return count;
}

TEST(PagedArray, IsEmptyAtFirst) { EXPECT_EQ(PagedArray<int>().size(), 0U); }

TEST(PagedArray, KeepsWhatIsWritten) {
  const PagedArray<int> array = counting(kMany);
  for (std::size_t i = 0; i < kMany; ++i) ASSERT_EQ(array[i], static_cast<int>(i));
}

TEST(PagedArray, ACopySharesAllItems) {
  const PagedArray<int> array = counting(kMany);
  const PagedArray<int> copy = array;
  EXPECT_EQ(shared_items(array, copy), kMany);
}

TEST(PagedArray, WritingToACopyLeavesTheOtherAsItIs) {
  PagedArray<int> array = counting(kMany);
  PagedArray<int> copy = array;
  copy.edit(5000) = -1;
  EXPECT_EQ(array[5000], 5000);
  EXPECT_EQ(copy[5000], -1);
  array.edit(1) = -2;
  EXPECT_EQ(copy[1], 1);
}

TEST(PagedArray, WritingOneItemCopiesOnePage) {
  const PagedArray<int> array = counting(kMany);
  PagedArray<int> copy = array;
  copy.edit(5000) = -1;
  const std::size_t shared = shared_items(array, copy);
  EXPECT_LT(shared, kMany);
  EXPECT_GE(shared, kMany - 2048);
  copy.edit(5001) = -1;  // on the same page, which is the copy's own by now
  EXPECT_EQ(shared_items(array, copy), shared);
}

TEST(PagedArray, AnArrayThatSharesNothingIsWrittenInPlace) {
  PagedArray<int> array = counting(kMany);
  const int* place = &array[5000];
  array.edit(5000) = -1;
  EXPECT_EQ(&array[5000], place);
}

TEST(PagedArray, OutlivesWhatItWasCopiedFrom) {
  std::optional<PagedArray<int>> array = counting(kMany);
  const PagedArray<int> copy = *array;
  array.reset();
  for (std::size_t i = 0; i < kMany; ++i) ASSERT_EQ(copy[i], static_cast<int>(i));
}

TEST(PagedArray, KeepsItsItemsWhenItGrowsAndShrinks) {
  PagedArray<int> array = counting(3000);
  array.resize(kMany);
  array.edit(kMany - 1) = 7;
  EXPECT_EQ(array[2999], 2999);
  EXPECT_EQ(array[kMany - 1], 7);
  array.resize(100);
  EXPECT_EQ(array.size(), 100U);
  EXPECT_EQ(array[99], 99);
}

TEST(PagedArray, ManyCopiesChangeAsLoneVectorsWould) {
  std::mt19937 random(1);
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  std::vector<PagedArray<int>> arrays = {counting(kMany)};
  std::vector<std::vector<int>> vectors(1);
  for (std::size_t i = 0; i < kMany; ++i) vectors[0].push_back(static_cast<int>(i));
  for (int step = 0; step < 3000; ++step) {
    const std::size_t which = below(arrays.size());
    if (arrays.size() < 6 && below(50) == 0) {
      arrays.push_back(arrays[which]);
      vectors.push_back(vectors[which]);
    } else {
      const std::size_t i = below(kMany);
      arrays[which].edit(i) = step;
      vectors[which][i] = step;
    }
  }
  for (std::size_t a = 0; a < arrays.size(); ++a) {
    for (std::size_t i = 0; i < kMany; ++i) ASSERT_EQ(arrays[a][i], vectors[a][i]) << a << " " << i;
  }
}

}  // namespace
}  // namespace seamwire
